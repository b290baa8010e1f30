//! Cook's membrane: nearly incompressible elasticity in bending and shear.
//!
//! Section 4.1 of Zhao, Jiang & Choo (2023). Set-up, choices and tolerances: `docs/cook.md`.

mod checks;
mod equilibrium;
pub(super) mod foreign;
mod geometry;
mod metrics;
mod parameters;
mod pictures;
mod probes;
mod reference;
mod scene;
mod sketch;
mod tables;
mod watch;

use super::family::{REMEDIES, family, more_particles, other_transfers, pairs};
use crate::case::{Case, Family, FieldView, Tier};
use crate::metric::{Sweep, error, value};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::{Level, RunSpec};
use equilibrium::Pressed;
use metrics::{FEM_EDGE_MEAN_ERROR, MEAN_STRESS_RMS_ERROR, TIP_UX, headlines};
use parameters::POISSON_RATIO;
use scene::forbid_static;
use watch::Loaded;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal};
use Tier::{Long, Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let sizes = [("h2", 2.0), ("h1", 1.0), ("h0.5", 0.5), ("h0.25", 0.25)];
    let levels = sizes.map(|(name, h)| Level { name, h });
    Case {
        name: "cook",
        title: "Cook's membrane",
        description: "A tapered membrane of nearly incompressible neo-Hookean rubber (plane strain, ν = 0.499), \
                      clamped on the left, sheared by a dead load on the right; run to rest. Standard MPM locks; \
                      the F̄ remedies don't; the recursive one creeps and never rests.",
        references: reference::describe(),
        limits: &[
            "The tip is a weakly singular point: the middle of the right side and the edge's mean are the primary measures.",
            "The particles fill cells of the lattice, 1,444 m² instead of 1,440 m² at h = 1 and ½; the sloping sides are stairs.",
            "The state of rest is approached by kinetic damping; the path to it has no physical meaning.",
            "With fbar-consistent the error does not fall from h = 1 m to ½ m: what the edge of the body adds stays.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(levels),
        levels: levels.to_vec(),
        metrics: metrics::all(),
        wanted: Vec::new(),
        checks: checks::checks(),
        headlines: headlines(),
        quantities: vec![
            error(FEM_EDGE_MEAN_ERROR, "relative error of edge-mean u_y"),
            error(MEAN_STRESS_RMS_ERROR, "rms error of σ_m (Pa)"),
            value(TIP_UX, "tip u_x (m)"),
        ],
        sweeps: vec![Sweep {
            parameter: POISSON_RATIO,
            label: "0.5 − ν",
            abscissa: |ratio| 0.5 - ratio,
            logarithmic: true,
        }],
        watched: &["tip_uy", "log_jacobian_gap_rms"],
        field: Some(FieldView {
            time: None,
            value: "mean_stress",
            label: "mean normal stress at rest (Pa)",
            range: (-1.0, 1.0),
            window: [(0.0, 48.0), (0.0, 60.0)],
        }),
        sketch: sketch::sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs: checks::own_runs,
        begin: Box::new(|spec, parameters| {
            Ok(match spec.scheme {
                Scheme::Implicit(_) | Scheme::Poro(_) => Box::new(Pressed::drive(spec, parameters)?),
                Scheme::Explicit(_) => {
                    forbid_static(spec, parameters)?;
                    Box::new(Loaded::drive(spec, parameters)?)
                }
            })
        }),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn cost(spec: &RunSpec) -> f64 {
    let sweep = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarRecursive => 2.5,
        RemedyName::FbarTotal | RemedyName::FbarRate => 1.5,
        RemedyName::FbarConsistent => 3.0,
    };
    sweep / spec.level.h.powi(3)
}

// The state of rest hardly depends on the time step (see the page): near each one's limit.
const HALVED: &[&str] = &["cfl=0.15"];
const LARGE: &[&str] = &["cfl=0.6"];
const GIMPS: &[&str] = &["cfl=0.45"];
// One step, on the lattice: what an equilibrium costs at least; with and without functions of the rim held.
const ONE_STEP: &[&str] = &["load_steps=1"];
const HELD: &[&str] = &["load_steps=1", "ghost=0.001"];
// Loads under which explicit bodies leave the grid, with functions of the rim held.
const LARGE_LOADS: [&[&str]; 5] = [
    &["load=10", "load_steps=5", "ghost=0.001"],
    &["load=20", "load_steps=8", "ghost=0.001"],
    &["load=30", "load_steps=12", "ghost=0.001"],
    &["load=40", "load_steps=16", "ghost=0.001"],
    &["load=50", "load_steps=20", "ghost=0.001"],
];

/// Quasi-static, without a remedy and with ours.
fn statics(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |&basis: &BasisName| [RemedyName::None, FbarConsistent].map(|remedy| Scheme::quasi_static(basis, remedy));
    bases.iter().flat_map(of).collect()
}

fn plan([h2, h1, half, quarter]: [Level; 4]) -> Vec<Family> {
    let none = RemedyName::None;
    let three = [Gimp, Bspline2, Bspline3];
    let gimp = |remedies: &[RemedyName]| pairs(&[Gimp], remedies);
    let two = |remedies: &[RemedyName]| pairs(&[Gimp, Bspline2], remedies);
    let every = pairs(&three, &REMEDIES);
    let averages = two(&[none, FbarTotal, FbarRate]);
    let rate = two(&[FbarRate]);
    let totals = two(&[FbarTotal, FbarRate]);
    let cubic = pairs(&[Bspline3], &[none, FbarTotal, FbarRate]);
    let averaged = [Gimp, Bspline2].map(|basis| Scheme::quasi_static(basis, FbarConsistent));
    let [three_per, four_per] = more_particles(Long, &[h2, h1]);
    let mut all = vec![
        family(Quick, &[h2], &gimp(&REMEDIES), &[]),
        family(Quick, &[h2], &gimp(&[FbarRecursive]), HALVED),
        family(Pr, &[h2], &two(&REMEDIES), &[]),
        family(Pr, &[h2], &pairs(&[Bspline3], &REMEDIES[..4]), &[]),
        family(Pr, &[h1], &gimp(&[none, FbarRecursive]), &[]),
        family(Pr, &[h1], &pairs(&[Bspline2], &[none]), &[]),
        family(Pr, &[h1], &gimp(&[FbarConsistent]), LARGE),
        family(Nightly, &[h2], &every, &[]),
        family(Nightly, &[h1], &every, &[]),
        family(Nightly, &[half, quarter], &gimp(&[none]), GIMPS),
        family(Nightly, &[half, quarter], &pairs(&[Bspline2], &[none]), LARGE),
        family(Nightly, &[half], &rate, LARGE),
        family(Nightly, &[half], &pairs(&three, &REMEDIES[..4]), &[]),
        family(Nightly, &[h2], &pairs(&three, &[FbarRecursive]), HALVED),
        family(Nightly, &[quarter], &rate, &[]),
        family(Nightly, &[h1], &averages, &["poisson_ratio=0.3"]),
        family(Nightly, &[h1], &averages, &["poisson_ratio=0.49"]),
        family(Nightly, &[h1], &averages, &["poisson_ratio=0.4999"]),
        family(Nightly, &[h1], &totals, &["load_at=edge"]),
        family(Nightly, &[h1], &pairs(&[Bspline2], &[none, FbarRate]), &["wall=wall-line"]),
        family(Nightly, &[h1], &gimp(&[FbarRate]), &["rest_window=1", "max_periods=5"]),
        family(Long, &[quarter], &pairs(&three, &[FbarRecursive]), &[]),
        family(Long, &[quarter], &two(&[FbarTotal]), LARGE),
        family(Long, &[quarter], &cubic, LARGE),
        family(Long, &[half], &pairs(&three, &[FbarConsistent]), &[]),
        family(Long, &[quarter], &pairs(&three, &[FbarConsistent]), LARGE),
        family(Long, &[h2, h1, half, quarter], &other_transfers(), &[]),
        three_per,
        four_per,
        family(Pr, &[h2, h1], &statics(&[Gimp, Bspline2]), &[]),
        family(Pr, &[h1], &averaged, HELD),
        family(Nightly, &[h2, h1, half, quarter], &averaged, ONE_STEP),
        family(Nightly, &[h1, half], &averaged, &["ghost=0.001"]),
        family(Nightly, &[half, quarter], &statics(&[Gimp, Bspline2]), &[]),
    ];
    all.extend(LARGE_LOADS.map(|set| family(Nightly, &[h1], &statics(&[Bspline2]), set)));
    all
}
