//! Two elastic discs that collide: the dynamic case of the implicit paper.
//!
//! Section 3.2 of Wang, Vardon, Hicks & Chen (2016). Set-up, choices and tolerances: `docs/discs.md`.

mod checks;
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
    ANGULAR_MOMENTUM_ERROR, ENERGY_END, ENERGY_ERROR_ACCUMULATED, ENERGY_GAIN, ENERGY_LOSS,
    LUMPING_LOSS, MOMENTUM_ERROR,
};
use scene::{CENTRES, RADIUS};
use watch::Collision;

use BasisName::{Bspline2, Gimp, Linear};
use RuleName::{Midpoint, Newmark};
use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = [("h0.05", 0.05), ("h0.025", 0.025)].map(|(name, h)| Level { name, h });
    Case {
        name: "discs",
        title: "Two discs that collide",
        description: "Two elastic discs meet in the middle of a square, touch through the grid and fly apart: the case by which the \
                      implicit paper shows its dynamics. The midpoint rule keeps energy at a hundred times the explicit step; \
                      the paper's Newmark rule gains it.",
        references: vec![
            "Conservation of mass, momentum and energy, and the symmetry of the scene.".to_owned(),
        ],
        limits: &[
            "Bodies touch through the grid: they stick, and part when their functions do.",
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
            Scheme::Explicit(e) if e.basis == Linear && e.transfer == TransferName::Flip => Some(
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

const LONG_STEP: &[&str] = &["step_factor=100"];
const STEPS: &[&str] = &["step_factor=10"];
const OFFSET_LONG: &[&str] = &["offset=0.1", "step_factor=100"];
const OFFSET_STEPS: &[&str] = &["offset=0.1", "step_factor=10"];

fn schemes(rules: &[RuleName]) -> Vec<Scheme> {
    implicit(rules, &[Gimp, Linear, Bspline2], &[RemedyName::None])
}

fn plan([h1, h2]: [Level; 2]) -> Vec<Family> {
    let explicit = [Gimp, Bspline2].map(|b| Scheme::flip(b, RemedyName::None));
    // F̄ for who asks for nothing else, and what breaks down.
    let others = [
        Scheme::flip(Gimp, RemedyName::FbarConsistent),
        Scheme::flip(Linear, RemedyName::None),
    ];
    let musl = [Scheme::explicit(
        Linear,
        RemedyName::None,
        TransferName::Musl,
    )];
    let both = schemes(&[Midpoint, Newmark]);
    let midpoint = schemes(&[Midpoint]);
    vec![
        family(Pr, &[h1], &explicit, &[]),
        family(Quick, &[h1], &both[..1], LONG_STEP),
        family(Pr, &[h1], &both, LONG_STEP),
        family(Pr, &[h1], &midpoint[..1], OFFSET_LONG),
        family(Nightly, &[h1, h2], &others, &[]),
        family(Nightly, &[h1, h2], &musl, &[]),
        family(Nightly, &[h1], &musl, &["offset=0.1"]),
        family(Nightly, &[h2], &explicit, &[]),
        family(Nightly, &[h1], &explicit, &["offset=0.1"]),
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
    ]
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
