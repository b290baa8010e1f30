//! Two elastic discs that collide: the dynamic case of the implicit paper.
//!
//! Section 3.2 of Wang, Vardon, Hicks & Chen (2016). Set-up, choices and tolerances: `docs/discs.md`.

mod checks;
mod flight;
mod metrics;
mod parameters;
mod pictures;
mod scene;
mod tables;
mod watch;

use super::family::{family, implicit};
use crate::case::{Case, Family, Tier};
use crate::parameter::Parameters;
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::{Level, RunSpec};
use metrics::{
    ANGULAR_MOMENTUM_ERROR, DEFLECTION, ENERGY_END, ENERGY_ERROR_ACCUMULATED, ENERGY_GAIN,
    ENERGY_LOSS, FREE_UNTIL, LUMPING_LOSS, MOMENTUM_ERROR, RESTITUTION,
};
use scene::{CENTRES, RADIUS};
use watch::Collision;

use BasisName::{Bspline2, Gimp, Linear};
use RuleName::{Midpoint, Newmark};
use Tier::{Nightly, Pr, Quick};
use TransferName::{Apic, Flip, Musl, Xpic2};

pub(super) fn case() -> Case {
    let levels = [("h0.05", 0.05), ("h0.025", 0.025)].map(|(name, h)| Level { name, h });
    Case {
        name: "discs",
        title: "Two discs that collide",
        description: "Two elastic discs meet in the middle of a square, touch through the grid and fly apart: the case by which the \
                      implicit paper shows its dynamics. The midpoint rule keeps energy at a hundred times the explicit step; \
                      the paper's Newmark rule gains it. Explicit steps with every transfer, head on, oblique, grazing, and past each other.",
        references: vec![
            "Conservation of mass, momentum and energy, and the symmetry of the scene.".to_owned(),
            "Exact: free flight, until a function sees both discs.".to_owned(),
        ],
        limits: &[
            "Bodies touch through the grid, cells before their rims do: they stick, and part when their functions do.",
            "No exact solution of the collision: energy and momentum are judged, not the motion.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(levels),
        levels: levels.to_vec(),
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(ENERGY_GAIN, "energy gain (%)", 100.0, 4),
            headline(ENERGY_LOSS, "loss (%)", 100.0, 4),
            headline(ENERGY_END, "end (%)", 100.0, 4),
            headline(ENERGY_ERROR_ACCUMULATED, "accumulated (%)", 100.0, 4),
            headline(LUMPING_LOSS, "lumped mass took (%)", 100.0, 4),
            headline(MOMENTUM_ERROR, "momentum error (–)", 1.0, 14),
            headline(ANGULAR_MOMENTUM_ERROR, "angular momentum error (–)", 1.0, 6),
            headline(RESTITUTION, "parting over meeting speed (–)", 1.0, 3),
            headline(DEFLECTION, "velocity changed by (–)", 1.0, 3),
            headline(FREE_UNTIL, "free until (s)", 1.0, 1),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["energy_change", "distance"],
        field: None,
        sketch: sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Collision::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |r| match r.scheme() {
            Scheme::Explicit(e) if e.basis == Linear && e.transfer == Flip => Some(
                "a particle that enters a cell meets nodes with hardly any mass, which its stress throws ahead",
            ),
            Scheme::Implicit(_) if r.parameters.number(parameters::LUMPED) == 0.0 => {
                Some("a consistent mass is singular where a function sees few particles")
            }
            _ => None,
        },
    }
}

fn cost(spec: &RunSpec) -> f64 {
    let steps = Parameters::new(&parameters::ALL, &spec.set)
        .map_or(0, |p| scene::timing(spec.level.h, &p).1);
    let a_step = match spec.scheme {
        Scheme::Explicit(_) => 1e-5,
        Scheme::Implicit(_) | Scheme::Poro(_) => 1e-3,
    };
    a_step * steps as f64 * (0.05 / spec.level.h).powi(2)
}

const OBLIQUE: &[&str] = &["offset=0.1"];
/// Rims that would just touch.
const GRAZING: &[&str] = &["offset=0.4"];
/// Beyond the reach of all functions.
const MISSING: &[&str] = &["offset=0.65"];
const ASIDE: [&[&str]; 4] = [OBLIQUE, &["offset=0.2"], &["offset=0.5"], MISSING];
/// Shares of PIC: a hundredth, and all.
const BLENDS: [&[&str]; 6] = [
    &["flip=0.99"],
    &["flip=0"],
    &["flip=0.99", "offset=0.1"],
    &["flip=0", "offset=0.1"],
    &["flip=0.99", "offset=0.4"],
    &["flip=0", "offset=0.4"],
];
const LONG_STEP: &[&str] = &["step_factor=100"];
const STEPS: &[&str] = &["step_factor=10"];
const OFFSET_LONG: &[&str] = &["offset=0.1", "step_factor=100"];
const OFFSET_STEPS: &[&str] = &["offset=0.1", "step_factor=10"];

fn schemes(rules: &[RuleName]) -> Vec<Scheme> {
    implicit(rules, &[Gimp, Linear, Bspline2], &[RemedyName::None])
}

fn plan([h1, h2]: [Level; 2]) -> Vec<Family> {
    let explicit = [Gimp, Bspline2].map(|b| Scheme::flip(b, RemedyName::None));
    let plain = |basis, transfer| Scheme::explicit(basis, RemedyName::None, transfer);
    let affine = [plain(Gimp, Apic)];
    let musl = [plain(Linear, Musl)];
    // What breaks down at once is left to the night.
    let all: Vec<Scheme> = [
        [Flip, Musl].map(|t| plain(Linear, t)).to_vec(),
        [Flip, Apic, Xpic2, Musl].map(|t| plain(Gimp, t)).to_vec(),
        [Flip, Apic, Xpic2].map(|t| plain(Bspline2, t)).to_vec(),
        vec![Scheme::flip(Gimp, RemedyName::FbarConsistent)],
    ]
    .concat();
    let blended = [Linear, Gimp, Bspline2].map(|b| Scheme::flip(b, RemedyName::None));
    let both = schemes(&[Midpoint, Newmark]);
    let midpoint = schemes(&[Midpoint]);
    let mut plan = vec![
        family(Pr, &[h1], &explicit, &[]),
        family(Quick, &[h1], &both[..1], LONG_STEP),
        family(Pr, &[h1], &both, LONG_STEP),
        family(Pr, &[h1], &affine, OBLIQUE),
        family(Pr, &[h1], &explicit[1..], GRAZING),
        family(Pr, &[h1], &musl, MISSING),
        family(Nightly, &[h1, h2], &all, &[]),
        family(Nightly, &[h1, h2], &all, GRAZING),
        family(Nightly, &[h1], &both, OFFSET_LONG),
        family(Nightly, &[h1], &both, STEPS),
        family(Nightly, &[h1], &both, OFFSET_STEPS),
        family(Nightly, &[h1], &both, &[]),
        family(Nightly, &[h2], &both, LONG_STEP),
        family(Nightly, &[h1], &midpoint, &["lumped=1", "step_factor=100"]),
        family(
            Nightly,
            &[h1],
            &midpoint,
            &["lumped=0.03", "step_factor=100"],
        ),
        family(Nightly, &[h1], &midpoint, &["lumped=0", "step_factor=100"]),
        family(
            Nightly,
            &[h1],
            &midpoint,
            &["lumped=1", "offset=0.1", "step_factor=100"],
        ),
        family(
            Nightly,
            &[h1],
            &midpoint,
            &["lumped=0.03", "offset=0.1", "step_factor=100"],
        ),
    ];
    plan.extend(ASIDE.map(|set| family(Nightly, &[h1], &all, set)));
    plan.extend(BLENDS.map(|set| family(Nightly, &[h1], &blended, set)));
    plan
}

fn sketch() -> Sketch {
    let circle = |[x, y]: [f64; 2]| {
        let at = |k: u32| {
            let angle = f64::from(k) / 48.0 * std::f64::consts::TAU;
            [x + RADIUS * angle.cos(), y + RADIUS * angle.sin()]
        };
        Shape::Body((0..48).map(at).collect())
    };
    let arrow = |[x, y]: [f64; 2], s: f64| Shape::Load([x, y], [x + s, y + s]);
    let [a, b] = CENTRES;
    Sketch {
        shapes: vec![
            circle(a),
            circle(b),
            arrow(a, 0.12),
            arrow(b, -0.12),
            Shape::note([0.62, 0.2], "0.005 m/s"),
            Shape::length([0.0, -0.08], [2.0 * RADIUS, -0.08], "0.4 m"),
        ],
        description: "Two discs of 0.4 m in diameter on a diagonal of a square of 1 m fly towards each other.",
    }
}
