//! A prestressed body that crosses a hundred cells: its stress is constant, exactly; what it isn't is noise of crossing.
//!
//! Set-up, choices and tolerances: `docs/translate.md`.

mod checks;
mod metrics;
mod parameters;
mod tables;
mod watch;

use super::family::{BASES, REMEDIES, family, other_transfers, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use watch::{PERIOD, Translation};

use Tier::{Nightly, Pr, Quick};

const LEVELS: [Level; 1] = [Level {
    name: "n8",
    h: 1.0 / PERIOD as f64,
}];
const TENSION: &[&str] = &["stretch=1.02"];
const FAST: &[&str] = &["speed=0.1"];
/// The step is the one that is stable however particles lie.
const BY_RULE: &[&str] = &["time_step=auto"];
const TEN: &[&str] = &["cells=10"];

pub(super) fn case() -> Case {
    Case {
        name: "translate",
        title: "A stress that crosses a hundred cells",
        description: "A body under a uniform stress fills a periodic grid on a lattice that doesn't fit the cells and moves through a \
                      hundred of them: exactly, nothing changes. What does is the noise of crossing, basis by basis.",
        references: vec![
            "Exact: translation keeps a uniform stress.".to_owned(),
            "The forces of a lattice under a uniform stress and the stiffness that they meet, docs/translate.md.".to_owned(),
        ],
        limits: &[
            "One lattice, seven particles to four cells along the motion: another has other waves.",
            "What is foretold is of particles at rest relative to each other and small noise.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(),
        levels: LEVELS.to_vec(),
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::STRESS_NOISE, "noise of the stress (%)", 100.0, 3),
            headline(m::STRESS_NOISE_MEAN, "mean (%)", 100.0, 3),
            headline(m::PREDICTED_NOISE, "predicted (%)", 100.0, 3),
            headline(m::STRESS_KEPT, "mean stress kept (%)", 100.0, 1),
            headline(m::VELOCITY_NOISE, "of the velocity (%)", 100.0, 3),
            headline(m::ENERGY_GAIN, "energy gain (–)", 1.0, 5),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["stress_kept", "stress_noise"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|_| 0.2),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Translation::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn plan() -> Vec<Family> {
    let mut all = pairs(&BASES, &REMEDIES);
    all.extend(other_transfers());
    let musl = [BasisName::Linear, BasisName::Gimp];
    all.extend(musl.map(|b| Scheme::explicit(b, RemedyName::None, TransferName::Musl)));
    let plain = pairs(&BASES, &[RemedyName::None]);
    let offered = pairs(&BASES[1..], &[RemedyName::None, RemedyName::FbarConsistent]);
    vec![
        family(Quick, &LEVELS, &plain[1..2], TEN),
        family(Pr, &LEVELS, &all, &[]),
        family(Pr, &LEVELS, &plain, TENSION),
        family(Nightly, &LEVELS, &all, TENSION),
        family(Nightly, &LEVELS, &all, FAST),
        family(Nightly, &LEVELS, &offered, BY_RULE),
    ]
}

fn sketch() -> Sketch {
    let (long, high) = (1.0, 0.5);
    Sketch {
        shapes: vec![
            Shape::Body(vec![[0.0, 0.0], [long, 0.0], [long, high], [0.0, high]]),
            Shape::Load([0.35, 0.25], [0.65, 0.25]),
            Shape::note([0.5, 0.38], "0.05 c"),
            Shape::length([0.0, -0.08], [long, -0.08], "8 h, periodic"),
        ],
        description: "A body that fills a periodic grid of 8 by 4 cells and moves along it.",
    }
}
