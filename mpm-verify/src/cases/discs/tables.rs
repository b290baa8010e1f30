//! Tables of its results.

use super::metrics as m;
use super::parameters::{FLIP, OFFSET, STEP_FACTOR};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, fixed, percent};
use crate::scheme::Scheme;

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        over_steps("discs-head-on", 0.0),
        over_steps("discs-offset", 0.1),
        balance(),
        explicit(),
        through_the_grid(),
    ]
}

/// Whether a run is at this offset (m).
fn at(offset: f64) -> impl Fn(&Record) -> bool + Send + Sync + 'static {
    move |r| r.parameters.number(OFFSET) == offset
}

/// An explicit run with the paper's cells or half of them.
fn is_explicit(r: &Record) -> bool {
    matches!(r.scheme(), Scheme::Explicit(_)) && r.changes_none_but(&[OFFSET.name, FLIP.name])
}

const SHARE: crate::results::Label = ("η", |r| r.parameters.text(FLIP));

/// What becomes of energy, speed and angular momentum in explicit steps, head on and off centre.
fn explicit() -> ResultTable {
    let of = [0.0, 0.1, 0.2].into_iter().flat_map(|offset| {
        [
            Column::metric(format!("energy, {offset} m"), m::ENERGY_END, percent(2)).of(at(offset)),
            Column::metric("speed", m::RESTITUTION, fixed(3)).of(at(offset)),
        ]
    });
    let turning = Column::metric(
        "angular momentum off by, 0.1 m",
        m::ANGULAR_MOMENTUM_ERROR,
        SHORT,
    );
    let columns = of.chain([turning.of(at(0.1))]);
    let shows = |r: &Record| is_explicit(r) && r.level == "h0.05";
    ResultTable::new("discs-explicit", shows, &[SCHEME, SHARE], columns)
}

/// Discs that pass each other without touching.
fn through_the_grid() -> ResultTable {
    let columns = [0.4, 0.5, 0.65].into_iter().flat_map(|offset| {
        [
            Column::metric(format!("free until, {offset} m"), m::FREE_UNTIL, fixed(1))
                .of(at(offset)),
            Column::metric("velocity changed by", m::DEFLECTION, SHORT).of(at(offset)),
        ]
    });
    let shows = |r: &Record| is_explicit(r) && r.parameters.number(OFFSET) >= 0.4;
    let level: crate::results::Label = ("level", |r| r.level.clone());
    ResultTable::new("discs-passing", shows, &[SCHEME, SHARE, level], columns)
}

/// Energy over the time step.
fn over_steps(name: &str, offset: f64) -> ResultTable {
    let columns = ["1", "10", "100"].into_iter().flat_map(|factor| {
        let at = move |r: &Record| r.parameters.is(STEP_FACTOR, factor);
        [
            Column::metric(format!("gain, {factor} Δt"), m::ENERGY_GAIN, percent(3)).of(at),
            Column::metric("loss", m::ENERGY_LOSS, percent(3)).of(at),
        ]
    });
    let shows =
        move |r: &Record| at(offset)(r) && r.changes_none_but(&[STEP_FACTOR.name, OFFSET.name]);
    ResultTable::new(name, shows, &[SCHEME], columns)
}

/// Where the energy goes at a hundred steps, and what else is not kept.
fn balance() -> ResultTable {
    let columns = [
        Column::metric("energy at the end", m::ENERGY_END, percent(3)),
        Column::metric("lumped mass took", m::LUMPING_LOSS, percent(3)),
        Column::metric(
            "accumulated energy off by",
            m::ENERGY_ERROR_ACCUMULATED,
            percent(3),
        ),
        Column::metric("angular momentum off by", m::ANGULAR_MOMENTUM_ERROR, SHORT),
        Column::metric("linear momentum off by", m::MOMENTUM_ERROR, SHORT),
    ];
    let offset: crate::results::Label = ("offset (m)", |r| r.parameters.text(OFFSET));
    let changed: crate::results::Label = ("β", |r| r.parameters.text(super::parameters::LUMPED));
    let shows = |r: &Record| {
        r.parameters.is(STEP_FACTOR, "100")
            && r.changes_none_but(&[
                STEP_FACTOR.name,
                OFFSET.name,
                super::parameters::LUMPED.name,
            ])
    };
    ResultTable::new("discs-balance", shows, &[SCHEME, offset, changed], columns)
}
