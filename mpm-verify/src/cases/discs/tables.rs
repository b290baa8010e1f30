//! Tables of its results.

use super::metrics as m;
use super::parameters::{OFFSET, STEP_FACTOR};
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, percent};

pub(super) fn all() -> Vec<ResultTable> {
    vec![
        over_steps("discs-head-on", false),
        over_steps("discs-offset", true),
        balance(),
    ]
}

fn is_offset(r: &Record) -> bool {
    r.parameters.number(OFFSET) > 0.0
}

/// Energy over the time step.
fn over_steps(name: &str, offset: bool) -> ResultTable {
    let columns = ["1", "10", "100"].into_iter().flat_map(|factor| {
        let at = move |r: &Record| r.parameters.is(STEP_FACTOR, factor);
        [
            Column::metric(format!("gain, {factor} Δt"), m::ENERGY_GAIN, percent(3)).of(at),
            Column::metric("loss", m::ENERGY_LOSS, percent(3)).of(at),
        ]
    });
    let shows = move |r: &Record| {
        is_offset(r) == offset && r.changes_none_but(&[STEP_FACTOR.name, OFFSET.name])
    };
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
