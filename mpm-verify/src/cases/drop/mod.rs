//! An elastic block falls on a floor with friction, at an angle, and bounces.
//!
//! Set-up, choices and tolerances: `docs/drop.md`.

mod checks;
mod metrics;
mod parameters;
mod tables;
mod watch;

use super::family::{family, implicit, levels, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use watch::Falling;

use BasisName::{Bspline2, Bspline3, Gimp};
use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n8", 8.0), ("n16", 16.0)]);
    Case {
        name: "drop",
        title: "A block bounces",
        description: "An elastic block falls on a floor with a barrier and friction, at an angle, and bounces: no energy is gained, no gap \
                      closes, friction is Coulomb's, over the barrier's stiffness and the step.",
        references: vec!["Conservation of momentum and energy, Coulomb's law.".to_owned()],
        limits: &["No exact solution of the bounce: what is kept and bounded is judged."],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::ENERGY_GAIN, "energy gain (–)", 1.0, 5),
            headline(m::ENERGY_END, "at the end (–)", 1.0, 4),
            headline(m::LEAST_GAP, "least gap (–)", 1.0, 3),
            headline(m::FRICTION_RATIO, "friction over μN (–)", 1.0, 3),
            headline(m::RESTITUTION, "restitution (–)", 1.0, 3),
            headline(m::SPIN, "spin (–)", 1.0, 3),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["kinetic_energy", "force_across"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-3 * spec.level.h.powi(-2)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Falling::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |r| {
            let soft = r.parameters.number(parameters::STIFFNESS) < 0.1;
            let explicit = r.scheme().rule().is_none();
            (soft && explicit).then_some("a barrier that a step passes: the gap at its end is closed, and the program says so")
        },
    }
}

const SLIDES: &[&str] = &["slant=5"];
const STRAIGHT: &[&str] = &["slant=0"];
const STIFF: &[&str] = &["stiffness=10"];
const SOFT: &[&str] = &["stiffness=0.01"];
const FAST: &[&str] = &["speed=0.1"];
const LONG: &[&str] = &["step_factor=10"];
const LONGER: &[&str] = &["step_factor=30"];
const LONG_STIFF: &[&str] = &["step_factor=10", "stiffness=100"];

fn plan(levels: &[Level]) -> Vec<Family> {
    let coarse = &levels[..1];
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let mut explicit = pairs(&[Gimp, Bspline2, Bspline3], &remedies);
    explicit.extend(
        [TransferName::Apic, TransferName::Xpic2]
            .map(|t| Scheme::explicit(Gimp, RemedyName::None, t)),
    );
    let slow = implicit(
        &[RuleName::Midpoint, RuleName::Newmark],
        &[Gimp, Bspline2],
        &[RemedyName::None],
    );
    let mut plan = vec![family(Quick, coarse, &explicit[..1], &[])];
    for set in [&[], SLIDES, STIFF] {
        plan.push(family(Pr, coarse, &explicit, set));
    }
    for set in [LONG, LONG_STIFF] {
        plan.push(family(Pr, coarse, &slow, set));
    }
    for set in [SOFT, STRAIGHT, FAST] {
        plan.push(family(Nightly, coarse, &explicit, set));
    }
    for set in [&[], SLIDES, STIFF] {
        plan.push(family(Nightly, &levels[1..], &explicit, set));
        plan.push(family(Nightly, coarse, &slow, set));
    }
    plan.push(family(Nightly, coarse, &slow, LONGER));
    plan.push(family(Nightly, &levels[1..], &slow, LONG));
    plan
}

fn sketch() -> Sketch {
    let (side, up) = (0.5, 0.25);
    Sketch {
        shapes: vec![
            Shape::Body(vec![
                [0.0, up],
                [side, up],
                [side, up + side],
                [0.0, up + side],
            ]),
            Shape::Load([0.25, up + 0.3], [0.45, up + 0.1]),
            Shape::Held([-0.2, 0.0], [1.0, 0.0]),
            Shape::length([0.0, up + side + 0.08], [side, up + side + 0.08], "0.5 m"),
        ],
        description: "A block of 0.5 m that moves towards a floor at an angle.",
    }
}
