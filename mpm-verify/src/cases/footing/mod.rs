//! A rigid strip footing on a cohesive, nearly incompressible ground.
//!
//! Section 4.2 of Zhao, Jiang & Choo (2023). Set-up, choices and tolerances: `docs/footing.md`.

mod checks;
mod curve;
pub(super) mod foreign;
mod geometry;
mod metrics;
mod own;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod sketch;
mod tables;
mod watch;

use super::family::{family, implicit, other_transfers, pairs};
use crate::case::{Case, Family, FieldView, Tier};
use crate::metric::{Sweep, error};
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::spec::{Level, RunSpec};
use metrics::{PRANDTL_ERROR, headlines};
use own::{SMALL, own_runs};
use parameters::PENETRATION_RATE;
use watch::Pressing;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};
use RuleName::QuasiStatic;
use Tier::{Long, Nightly, Pr};

pub(super) fn case() -> Case {
    let cells = [("b10", 10.0), ("b20", 20.0), ("b40", 40.0), ("b80", 80.0)];
    let levels = cells.map(|(name, cells)| Level {
        name,
        h: 1.0 / cells,
    });
    Case {
        name: "footing",
        title: "Strip footing",
        description: "A rough rigid strip footing pressed slowly into weightless ground, a Hencky solid with J2 plasticity \
                      (plane strain, ν = 0.49). Its bearing capacity is (2 + π) s_u (Prandtl). Standard MPM locks and finds \
                      no limit load; the F̄ remedies do, the recursive one depends on the rate.",
        references: reference::describe(),
        limits: &[
            "A footing of held nodes acts as wide as up to the middle between its last node and the first free one: B + h, with quadratic splines B.",
            "The footing's nodes stay where they are: strokes are small against a cell.",
            "The inertia of the start shows below s/B = 0.0003; the elastic slope is measured in runs of great strength.",
            "At B/80 three checks fail: the load swings, the mechanism ends a cell early, a mean stress is off by 5 % (docs/footing.md).",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(levels),
        levels: levels.to_vec(),
        metrics: metrics::all(),
        checks: checks::checks(),
        headlines: headlines(),
        quantities: vec![error(
            PRANDTL_ERROR,
            "relative error of the contact pressure",
        )],
        sweeps: vec![Sweep {
            parameter: PENETRATION_RATE,
            label: "penetration rate (m/s)",
            abscissa: |rate| rate,
            logarithmic: true,
        }],
        watched: &["pressure_over_strength", "jacobian_max"],
        field: Some(FieldView {
            time: None,
            value: "plastic_strain",
            label: "plastic strain (-)",
            range: (0.0, 0.004),
            window: [(0.0, 2.0), (-1.5, 0.0)],
        }),
        sketch: sketch::sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs,
        begin: Box::new(|spec, parameters| Ok(Box::new(Pressing::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

/// A strength beyond reach: the ground stays elastic.
const ELASTIC: &[&str] = &["undrained_strength=1e6"];
/// Steps of equilibrium at which the finite elements are tabulated, too.
const FINER: &[&str] = &["load_steps=40"];

fn plan([b10, b20, b40, b80]: [Level; 4]) -> Vec<Family> {
    let none = RemedyName::None;
    let both = |remedies: &[RemedyName]| pairs(&[Gimp, Bspline2], remedies);
    let all = both(&[none, FbarRecursive, FbarRate, FbarConsistent]);
    let three = both(&[none, FbarRecursive, FbarConsistent]);
    let two = both(&[none, FbarConsistent]);
    let rates = both(&[FbarRecursive, FbarConsistent]);
    let ours = both(&[FbarConsistent]);
    let cubic = pairs(&[Bspline3], &[FbarConsistent]);
    let smooth = pairs(&[Gimp], &[FbarRate, FbarConsistent]);
    let averaged = implicit(&[QuasiStatic], &[Gimp, Bspline2], &[FbarConsistent]);
    let statics = implicit(&[QuasiStatic], &[Gimp, Bspline2], &[none, FbarConsistent]);
    let dense: &[&str] = &["ppc_per_direction=4"];
    vec![
        family(Pr, &[b10], &three, SMALL),
        family(Pr, &[b20], &pairs(&[Gimp], &[none, FbarConsistent]), SMALL),
        family(Nightly, &[b20], &two, SMALL),
        family(Nightly, &[b10, b20], &all, &[]),
        family(Nightly, &[b20], &all, dense),
        family(Nightly, &[b20], &cubic, &[]),
        family(Nightly, &[b40], &three, &[]),
        family(Nightly, &[b20], &three, &["contact=barrier"]),
        family(Nightly, &[b10], &rates, &["penetration_rate=4e-3"]),
        family(Nightly, &[b10], &rates, &["penetration_rate=1e-3"]),
        family(
            Nightly,
            &[b10],
            &both(&[none, FbarRate, FbarConsistent]),
            ELASTIC,
        ),
        family(Nightly, &[b20], &ours, ELASTIC),
        family(Nightly, &[b10], &smooth, &["rough=false"]),
        family(
            Long,
            &[b40],
            &ours,
            &["ppc_per_direction=4", "penetration=0.003"],
        ),
        family(Long, &[b80], &ours, &["penetration=0.003"]),
        family(Long, &[b40], &both(&[FbarRate]), &[]),
        family(Long, &[b80], &all, &[]),
        family(Long, &[b10, b40, b80], &cubic, &[]),
        family(Long, &[b10, b20, b40, b80], &other_transfers(), &[]),
        family(Long, &[b10], &two, dense),
        family(Pr, &[b10], &averaged[1..], SMALL),
        family(Nightly, &[b10, b20], &statics, &[]),
        family(Nightly, &[b10], &averaged, FINER),
        family(Nightly, &[b20], &averaged, &["contact=barrier"]),
        family(Nightly, &[b10], &averaged, ELASTIC),
        family(Long, &[b40, b80], &statics, &[]),
    ]
}

fn cost(spec: &RunSpec) -> f64 {
    let sweep = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => 1.5,
        RemedyName::FbarConsistent => 2.5,
    };
    let dense = spec.set.iter().any(|s| s == "ppc_per_direction=4");
    let solver = if spec.scheme.rule().is_some() {
        0.15
    } else {
        1.0
    };
    solver * sweep * if dense { 4.0 } else { 1.0 } / spec.level.h.powi(3)
}
