//! The dam break: water behind a gate that is removed at once, and the wall that it meets.
//!
//! Section 4.3 of Zhao, Jiang & Choo (2023). Set-up, choices and tolerances: `docs/dam-break.md`.

mod checks;
mod flow;
pub(super) mod foreign;
mod metrics;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod sketch;
mod tables;
mod watch;

use super::family::{family, pairs};
use crate::case::{Case, Family, FieldView, Tier};
use crate::drive::Drive;
use crate::metric::{Quantity, Sweep, error, value};
use crate::results::{Column, headline};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::spec::{Level, RunSpec};
use metrics as m;
use parameters::{CFL, PIC_RATE};
use scene::Dam;
use watch::Seen;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal};

const LEVELS: [Level; 4] = [
    level("h0.5", 0.5),
    level("h0.25", 0.25),
    level("h0.125", 0.125),
    level("h0.0625", 0.0625),
];

const fn level(name: &'static str, h: f64) -> Level {
    Level { name, h }
}

const BASES: [BasisName; 2] = [Gimp, Bspline2];

/// Runs over the levels take larger steps than the case's own.
const LADDER: &[&str] = &["cfl=0.3"];
/// Until the front has met the wall.
const SHORT: &[&str] = &["cfl=0.3", "duration=0.6"];

fn headlines() -> Vec<Column> {
    vec![
        headline(m::FRONT_X_EARLY, "front at 0.4 s (m)", 1.0, 3),
        headline(m::FRONT_RMS_ERROR, "front, rms error (m)", 1.0, 3),
        headline(m::ARRIVAL_ERROR, "arrival, error (ms)", 1e3, 1),
        headline(m::ENERGY_RATIO, "energy at 0.4 s (–)", 1.0, 4),
        headline(m::ENERGY_RATIO_2S, "energy at 2 s (–)", 1.0, 3),
        headline(m::MOTION_RATIO_2S, "without stress work (–)", 1.0, 3),
        headline(m::PRESSURE_RMS, "p rms at 0.4 s (kPa)", 1e-3, 1),
        headline(m::CHECKERBOARD_RMS, "p − Πp rms (kPa)", 1e-3, 2),
        headline(m::TENSION_SHARE, "in tension (%)", 100.0, 1),
        headline(m::COVERED_EARLY, "covered at 0.4 s (m²)", 1.0, 2),
        headline(m::WALL_IMPULSE, "wall impulse (kN s/m)", 1e-3, 2),
        headline(m::LOG_JACOBIAN_GAP, "ln(J/J̄) at 0.4 s (–)", 1.0, 4),
    ]
}

const QUANTITIES: &[Quantity] = &[
    error(m::FRONT_RMS_ERROR, "rms error of the front (m)"),
    error(m::ARRIVAL_ERROR, "error of the arrival (s)"),
    value(m::WALL_IMPULSE, "impulse on the wall (N s/m)"),
    value(m::CENTRE_X_MEAN, "mean centre of mass (m)"),
];

const SWEEPS: &[Sweep] = &[
    Sweep {
        parameter: CFL,
        label: "CFL number (–)",
        abscissa: |cfl| cfl,
        logarithmic: true,
    },
    Sweep {
        parameter: PIC_RATE,
        label: "PIC share per unit of time (1/s)",
        abscissa: |rate| rate,
        logarithmic: true,
    },
];

/// The dam break.
pub(super) fn case() -> Case {
    Case {
        name: "dam-break",
        title: "Dam break",
        description: "Water, nearly incompressible, 4 m × 2 m behind a gate that is removed at once; it runs along the floor of a \
         tank 6 m long and climbs the wall. The front is known from inviscid flow, energy may only be lost. \
         Standard MPM locks: it flows too slowly, with a pressure that is noise.",
        references: reference::describe(),
        limits: &[
            "Tension is allowed: water that is pulled apart holds together by cells.",
            "After the front has met the wall single particles are chaotic; only sums over the water, compared over levels and ensembles, mean something.",
            "There is no air and no surface tension: jets are not those of water.",
            "Nothing damps sound: the pressure of fbar-consistent is noisier than that of fbar-recursive.",
        ],
        parameters: parameters::ALL.to_vec(),
        levels: LEVELS.to_vec(),
        plan: plan(),
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: headlines(),
        quantities: QUANTITIES.to_vec(),
        sweeps: SWEEPS.to_vec(),
        watched: &["front", "energy", "front_force", "pressure_rms"],
        field: Some(FieldView {
            time: Some(0.3),
            value: "pressure",
            label: "pressure after 0.3 s (Pa)",
            range: (-1e5, 1e5),
            window: [(0.0, 5.0), (0.0, 2.0)],
        }),
        sketch: sketch::sketch(),
        cost: Box::new(cost),
        ladder: LADDER,
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| {
            let dam = Dam::new(spec, parameters)?;
            Ok(Box::new(Drive::new(dam, Seen::default())?))
        }),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: checks::breaks_down,
    }
}

fn cost(spec: &RunSpec) -> f64 {
    let sweep = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        FbarRecursive | FbarTotal | FbarRate => 1.4,
        FbarConsistent => 1.9,
    };
    sweep / spec.level.h.powi(3)
}

fn plan() -> Vec<Family> {
    use Tier::{Long, Nightly, Pr};
    let [h50, h25, h12, h06] = LEVELS;
    let flip = |remedies: &[RemedyName]| pairs(&BASES, remedies);
    let remedies = [RemedyName::None, FbarRecursive, FbarTotal, FbarConsistent];
    let apic = |s: &Scheme| Scheme::explicit(s.basis(), s.remedy(), TransferName::Apic);
    let mut all = flip(&remedies);
    all.extend(all.clone().iter().map(apic));
    all.extend(flip(&[FbarRate]));
    all.push(Scheme::flip(Bspline3, FbarConsistent));
    let ours = flip(&[FbarConsistent]);
    let finest = flip(&[FbarRecursive, FbarConsistent]);
    let others: Vec<Scheme> = all
        .iter()
        .filter(|s| !finest.contains(s))
        .copied()
        .collect();
    let three = flip(&[RemedyName::None, FbarRecursive, FbarConsistent]);
    let make_energy = pairs(&[Gimp], &[FbarTotal, FbarRate]);
    let fewer = &["cfl=0.3", "ppc_per_direction=3"];
    let studies: [&'static [&'static str]; 10] = [
        &["cfl=0.15"],
        &["start=gravity-stage"],
        &["pic_rate=0.1"],
        &["pic_rate=1"],
        &["pic_rate=10"],
        &["pic_rate=100"],
        &["wall_contact=sticky"],
        &["seed=1"],
        &["seed=2"],
        &["seed=3"],
    ];
    let mut plan = vec![
        family(Pr, &[h50, h25], &three, SHORT),
        family(Pr, &[h50], &make_energy, SHORT),
        family(Pr, &[h50], &finest[..2], &["duration=0.6"]),
        family(Nightly, &[h50, h25], &all, &[]),
        family(Nightly, &[h50, h25, h12], &all, LADDER),
        family(Nightly, &[h06], &finest, LADDER),
        family(Nightly, &[h50, h25, h12], &ours, fewer),
    ];
    plan.extend(studies.map(|set| family(Nightly, &[h25], &ours, set)));
    plan.push(family(Long, &[h06], &others, LADDER));
    plan
}
