//! A bar runs into a wall: the front behind which it rests, beside Rankine and Hugoniot's.
//!
//! Set-up, choices and tolerances: `docs/shock.md`.

mod checks;
mod jump;
mod metrics;
mod parameters;
mod tables;
mod watch;

use super::family::{BASES, REMEDIES, family, levels, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use watch::Bar;

use Tier::{Nightly, Pr, Quick};

/// Speeds other than half of that of waves.
const SPEEDS: [&[&str]; 3] = [&["mach=0.1"], &["mach=1"], &["mach=2"]];
/// An artificial viscosity that takes what rings, at some speeds, and one that doesn't.
const VISCOUS: [&[&str]; 3] = [
    &["linear_viscosity=0.5", "quadratic_viscosity=2"],
    &["mach=1", "linear_viscosity=0.5", "quadratic_viscosity=2"],
    &["mach=2", "linear_viscosity=0.5", "quadratic_viscosity=2"],
];
const WEAK: [&[&str]; 2] = [
    &["linear_viscosity=0.06", "quadratic_viscosity=1.5"],
    &["mach=2", "linear_viscosity=0.06", "quadratic_viscosity=1.5"],
];

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n64", 64.0), ("n128", 128.0), ("n256", 256.0)]);
    Case {
        name: "shock",
        title: "A bar runs into a wall",
        description: "A bar runs into a wall at a tenth to twice the speed of its waves and comes to rest behind a front, whose speed, \
                      stress and loss of energy are exact.",
        references: vec![
            "Exact: Rankine and Hugoniot's conditions in uniaxial strain, src/cases/shock/jump.rs."
                .to_owned(),
        ],
        limits: &[
            "Without an artificial viscosity what a front should take rings behind it: none is the default.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::SHOCK_SPEED_ERROR, "speed of the front (%)", 100.0, 2),
            headline(m::STRESS_ERROR, "mean stress (%)", 100.0, 2),
            headline(m::OVERSHOOT, "overshoot (%)", 100.0, 0),
            headline(m::RINGING, "rings (%)", 100.0, 1),
            headline(
                m::ENERGY_LOSS_ERROR,
                "energy lost, over the exact (%)",
                100.0,
                0,
            ),
            headline(m::LOSS_RATE_ERROR, "rate of the loss (%)", 100.0, 1),
            headline(m::FRONT_WIDTH, "width of the front (m)", 1.0, 4),
            headline(m::PREDICTED_WIDTH, "predicted (m)", 1.0, 4),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["front", "kinetic_energy"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-2)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Bar::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |r| {
            let smeared = r.basis() == BasisName::Linear && r.remedy() == RemedyName::FbarRecursive;
            let fine = r.discretisation.h < 0.01 && r.is_default();
            (smeared && fine).then_some(
                "under a pressure averaged hats are unstable at any step: docs/critical-step.md",
            )
        },
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let all = pairs(&BASES, &REMEDIES);
    let plain = pairs(&BASES, &[RemedyName::None]);
    let [slow, sonic, fast] = SPEEDS;
    let some = pairs(
        &BASES,
        &[
            RemedyName::None,
            RemedyName::FbarRecursive,
            RemedyName::FbarConsistent,
        ],
    );
    let sound = pairs(&BASES, &[RemedyName::None, RemedyName::FbarConsistent]);
    // Not of linear functions, whose stress fades as they cross cells.
    let viscous = pairs(&BASES[1..], &[RemedyName::None, RemedyName::FbarConsistent]);
    let [half, as_fast, twice] = VISCOUS;
    let weak = &pairs(&BASES[1..], &[RemedyName::None]);
    vec![
        family(Pr, &levels[..1], &viscous, half),
        family(Pr, &levels[..2], &viscous[..2], twice),
        family(Pr, &levels[1..2], &weak[..1], WEAK[1]),
        family(Nightly, levels, &viscous, half),
        family(Nightly, levels, &viscous, as_fast),
        family(Nightly, levels, &viscous, twice),
        family(Nightly, &levels[1..], weak, WEAK[0]),
        family(Nightly, &levels[1..], weak, WEAK[1]),
        family(Quick, &levels[..1], &plain[1..2], &[]),
        family(Pr, &levels[..1], &all, &[]),
        family(Pr, &levels[..2], &plain, &[]),
        family(Nightly, levels, &all, &[]),
        family(Pr, &levels[..1], &some, slow),
        family(Pr, &levels[..1], &some, sonic),
        family(Pr, &levels[..1], &sound, fast),
        family(Nightly, levels, &some, slow),
        family(Nightly, levels, &sound, sonic),
        family(Nightly, &levels[..2], &sound, fast),
    ]
}

fn sketch() -> Sketch {
    Sketch {
        shapes: vec![
            Shape::Held([0.0, -0.1], [0.0, 0.2]),
            Shape::Body(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [0.0, 0.1]]),
            Shape::Load([0.75, 0.05], [0.45, 0.05]),
            Shape::length([0.0, -0.08], [1.0, -0.08], "1 m"),
        ],
        description: "A bar of 1 m whose end touches a wall and which moves towards it.",
    }
}
