//! The dam break: water behind a gate that is removed at once, and the wall that it meets.
//!
//! Section 4.3 of Zhao, Jiang & Choo (2022). Set-up, choices and tolerances: `docs/dam-break.md`.

mod checks;
mod flow;
mod reference;
mod simulation;
mod sketch;

use crate::case::{
    Case, CheckInfo, Headline, Job, Level, MetricInfo, Quantity, RunSpec, Sweep, Tier, error,
    headline, metric, runs,
};
use crate::error::Error;
use crate::parameter::{Domain, Parameter, Parameters, number, parameter};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::sketch::Sketch;
use crate::verdict::Verdict;
use simulation::Simulated;

pub(crate) use reference::dam_break_front;

/// The dam break.
pub(super) struct DamBreak;

const LEVELS: [Level; 4] = [
    Level {
        name: "h0.5",
        h: 0.5,
    },
    Level {
        name: "h0.25",
        h: 0.25,
    },
    Level {
        name: "h0.125",
        h: 0.125,
    },
    Level {
        name: "h0.0625",
        h: 0.0625,
    },
];

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarConsistent,
];

const PARAMETERS: [Parameter; 11] = [
    parameter(
        "bulk_modulus",
        "Pa",
        "2e9",
        number(1e5, 1e12, false),
        "bulk modulus K",
    ),
    parameter(
        "density",
        "kg/m³",
        "997.5",
        number(1e-3, 1e5, false),
        "density ρ without pressure",
    ),
    parameter(
        "viscosity",
        "Pa s",
        "0.001",
        number(0.0, 1e6, false),
        "dynamic viscosity μ",
    ),
    parameter(
        "duration",
        "s",
        "2",
        number(0.01, 10.0, false),
        "time after the removal of the gate",
    ),
    parameter(
        "start",
        "-",
        "exact",
        Domain::Choice(&["exact", "gravity-stage"]),
        "how the water comes to rest behind the gate: exactly, or by gravity that rises from zero, with damping",
    ),
    parameter(
        "wall_contact",
        "-",
        "separable",
        Domain::Choice(&["separable", "sticky"]),
        "whether water comes off the walls freely or they bear tension; it slides freely along either",
    ),
    parameter(
        "cfl",
        "-",
        "0.0567",
        number(1e-3, 1.0, true),
        "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.005 s, 10⁻⁵ s at h = 0.25 m",
    ),
    parameter(
        "pic_rate",
        "1/s",
        "0",
        number(0.0, 1e6, false),
        "share of PIC per unit of time, r: η = exp(−r Δt); 0 is FLIP",
    ),
    parameter(
        "wall",
        "-",
        "open-knot",
        Domain::Choice(&["open-knot", "wall-line"]),
        "how B-splines meet floor and walls",
    ),
    parameter(
        "ppc_per_direction",
        "-",
        "5",
        Domain::Integer { least: 1, most: 8 },
        "particles per cell and direction",
    ),
    parameter(
        "seed",
        "-",
        "0",
        Domain::Integer {
            least: 0,
            most: 1000,
        },
        "which member of an ensemble whose starts differ in last bits; 0 is the undisturbed one",
    ),
];

const METRICS: &[MetricInfo] = &[
    metric(
        "base_reaction_ratio",
        "-",
        "force on the floor over the weight of the water, behind the gate: mean over three of the water's longest periods from the exact start, over 0.005 s after a gravity stage",
    ),
    metric("gate_force", "N/m", "force on the gate, likewise"),
    metric("back_force", "N/m", "force on the back wall, likewise"),
    metric(
        "base_pressure",
        "Pa",
        "pressure at the floor behind the gate, one step from the exact start or after the gravity stage, by a line through the particles of the lower half",
    ),
    metric(
        "pressure_profile_error",
        "-",
        "rms over the particles of the pressure less the hydrostatic one, over that at the floor, then",
    ),
    metric(
        "start_kinetic_energy",
        "J/m",
        "kinetic energy behind the gate when the forces have been measured",
    ),
    metric(
        "front_x_0.4s",
        "m",
        "outermost particle and half its spacing, 0.4 s after the removal",
    ),
    metric(
        "front_rms_error",
        "m",
        "rms distance of the front from the inviscid one, t √(g/H) from 0.2 to 0.9",
    ),
    metric(
        "front_speed_max",
        "m/s",
        "largest speed of the front until it is two cells off the wall",
    ),
    metric(
        "arrival_time",
        "s",
        "when the front is two cells off the wall",
    ),
    metric(
        "arrival_error",
        "s",
        "distance of that time from the inviscid one",
    ),
    metric(
        "back_level_0.4s",
        "m",
        "highest particle within a cell of the back wall and half its spacing, at 0.4 s",
    ),
    metric(
        "energy_ratio",
        "-",
        "kinetic and potential energy and stress work at 0.4 s over those at the start",
    ),
    metric("energy_ratio_2s", "-", "likewise at 2 s"),
    metric(
        "energy_gain",
        "-",
        "largest growth of that energy in 0.005 s, over its start",
    ),
    metric(
        "energy_excess",
        "-",
        "largest excess of it over its start, relative",
    ),
    metric(
        "motion_ratio_2s",
        "-",
        "kinetic and potential energy at 2 s over those at the start",
    ),
    metric(
        "motion_excess",
        "-",
        "largest excess of kinetic and potential energy over their start, relative",
    ),
    metric("motion_loss", "-", "largest loss of them, over their start"),
    metric(
        "pressure_rms",
        "Pa",
        "rms over the particles of the pressure at 0.4 s",
    ),
    metric(
        "checkerboard_rms",
        "Pa",
        "rms over the particles of p − Πp at 0.4 s",
    ),
    metric(
        "tension_share",
        "-",
        "share of the particles in tension at 0.4 s",
    ),
    metric(
        "covered_0.4s",
        "m²",
        "area under the highest particles at 0.4 s, in strips two particles wide",
    ),
    metric("centre_x_0.4s", "m", "centre of mass at 0.4 s"),
    metric("centre_x_mean", "m", "centre of mass, mean over 2 s"),
    metric("centre_y_mean", "m", "its height, likewise"),
    metric("wall_impulse", "N s/m", "impulse on the front wall in 2 s"),
    metric("jacobian_min", "-", "least J of a particle at any time"),
    metric("jacobian_max", "-", "greatest J of a particle at any time"),
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at 0.4 s"),
    metric("mass", "kg/m", "mass of the water at the end"),
];

const HEADLINES: &[Headline] = &[
    headline("front_x_0.4s", "front at 0.4 s (m)", 1.0, 3),
    headline("front_rms_error", "front, rms error (m)", 1.0, 3),
    headline("arrival_error", "arrival, error (ms)", 1e3, 1),
    headline("energy_ratio", "energy at 0.4 s (–)", 1.0, 4),
    headline("energy_ratio_2s", "energy at 2 s (–)", 1.0, 3),
    headline("motion_ratio_2s", "without stress work (–)", 1.0, 3),
    headline("pressure_rms", "p rms at 0.4 s (kPa)", 1e-3, 1),
    headline("checkerboard_rms", "p − Πp rms (kPa)", 1e-3, 2),
    headline("tension_share", "in tension (%)", 100.0, 1),
    headline("covered_0.4s", "covered at 0.4 s (m²)", 1.0, 2),
    headline("wall_impulse", "wall impulse (kN s/m)", 1e-3, 2),
    headline("log_jacobian_gap", "ln(J/J̄) at 0.4 s (–)", 1.0, 4),
];

const QUANTITIES: &[Quantity] = &[
    error("front_rms_error", "rms error of the front (m)"),
    error("arrival_error", "error of the arrival (s)"),
    Quantity {
        metric: "wall_impulse",
        label: "impulse on the wall (N s/m)",
        is_error: false,
    },
    Quantity {
        metric: "centre_x_mean",
        label: "mean centre of mass (m)",
        is_error: false,
    },
];

const SWEEPS: &[Sweep] = &[
    Sweep {
        parameter: "cfl",
        label: "CFL number (–)",
        abscissa: |cfl| cfl,
        logarithmic: true,
    },
    Sweep {
        parameter: "pic_rate",
        label: "PIC share per unit of time (1/s)",
        abscissa: |rate| rate,
        logarithmic: true,
    },
];

impl Case for DamBreak {
    fn name(&self) -> &'static str {
        "dam-break"
    }

    fn title(&self) -> &'static str {
        "Dam break"
    }

    fn description(&self) -> &'static str {
        "Water, nearly incompressible, 4 m × 2 m behind a gate that is removed at once; it runs along the floor of a \
         tank 6 m long and climbs the wall. The front is known from inviscid flow, energy may only be lost. \
         Standard MPM locks: it flows too slowly, with a pressure that is noise."
    }

    fn references(&self) -> Vec<String> {
        reference::describe()
    }

    fn limits(&self) -> &'static [&'static str] {
        &[
            "Tension is allowed: water that is pulled apart holds together by cells.",
            "After the front has met the wall single particles are chaotic; only sums over the water, compared over levels and ensembles, mean something.",
            "There is no air and no surface tension: jets are not those of water.",
        ]
    }

    fn parameters(&self) -> &[Parameter] {
        &PARAMETERS
    }

    fn schemes(&self) -> Vec<Scheme> {
        let with = |transfer| {
            BASES.into_iter().flat_map(move |basis| {
                REMEDIES.map(move |remedy| Scheme::explicit(basis, remedy, transfer))
            })
        };
        let mut schemes: Vec<Scheme> = with(TransferName::Flip).collect();
        schemes.extend(with(TransferName::Apic));
        schemes.extend(BASES.map(|basis| Scheme::flip(basis, RemedyName::FbarRate)));
        schemes.push(Scheme::flip(
            BasisName::Bspline3,
            RemedyName::FbarConsistent,
        ));
        schemes
    }

    fn levels(&self) -> &[Level] {
        &LEVELS
    }

    fn metrics(&self) -> &'static [MetricInfo] {
        METRICS
    }

    fn checks(&self) -> &'static [CheckInfo] {
        checks::CHECKS
    }

    fn headlines(&self) -> &'static [Headline] {
        HEADLINES
    }

    fn quantities(&self) -> &'static [Quantity] {
        QUANTITIES
    }

    fn ladder(&self) -> &'static [&'static str] {
        &["cfl=0.3"]
    }

    fn sweeps(&self) -> &'static [Sweep] {
        SWEEPS
    }

    fn watched(&self) -> &'static [&'static str] {
        &["front", "energy", "front_force", "pressure_rms"]
    }

    fn sketch(&self) -> Sketch {
        sketch::sketch()
    }

    fn plan(&self, tier: Tier) -> Vec<RunSpec> {
        plan(tier)
    }

    fn cost(&self, spec: &RunSpec) -> f64 {
        let sweep = match spec.scheme.remedy() {
            RemedyName::None => 1.0,
            RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => 1.4,
            RemedyName::FbarConsistent => 1.9,
        };
        sweep / spec.level.h.powi(3)
    }

    fn start(&self, spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
        Ok(Box::new(Simulated::new(spec, parameters)?))
    }

    fn breaks_down(&self, record: &Record) -> Option<&'static str> {
        checks::breaks_down(record)
    }

    fn judge(&self, record: &Record) -> Vec<Verdict> {
        checks::judge(record)
    }

    fn judge_study(&self, records: &[Record]) -> Vec<Verdict> {
        checks::judge_study(records)
    }
}

fn plan(tier: Tier) -> Vec<RunSpec> {
    use RemedyName::{FbarConsistent, FbarRecursive, None};
    let [h50, h25, h12, h06] = LEVELS;
    let flip = |remedies: &[RemedyName]| -> Vec<Scheme> {
        let of = |&basis: &BasisName| remedies.iter().map(move |&r| Scheme::flip(basis, r));
        BASES.iter().flat_map(of).collect()
    };
    let three = flip(&[None, FbarRecursive, FbarConsistent]);
    let ours = flip(&[FbarConsistent]);
    let all = DamBreak.schemes();
    let finest = flip(&[FbarRecursive, FbarConsistent]);
    let fewer = ["cfl=0.3", "ppc_per_direction=3"];
    let studies = |sets: &[&str]| -> Vec<RunSpec> {
        let of = |set: &&str| runs(h25, &ours, &[*set]);
        sets.iter().flat_map(of).collect()
    };
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => [h50, h25]
            .iter()
            .flat_map(|&level| runs(level, &three, &["duration=0.6"]))
            .collect(),
        Tier::Nightly => [
            plan(Tier::Pr),
            runs(h50, &all, &[]),
            runs(h25, &all, &[]),
            runs(h50, &all, &["cfl=0.3"]),
            runs(h25, &all, &["cfl=0.3"]),
            runs(h12, &all, &["cfl=0.3"]),
            runs(h06, &finest, &["cfl=0.3"]),
            runs(h50, &ours, &fewer),
            runs(h25, &ours, &fewer),
            runs(h12, &ours, &fewer),
            studies(&["cfl=0.15", "start=gravity-stage"]),
            studies(&["pic_rate=0.1", "pic_rate=1", "pic_rate=10", "pic_rate=100"]),
            studies(&["wall_contact=sticky", "seed=1", "seed=2", "seed=3"]),
        ]
        .concat(),
        Tier::Long => {
            let others: Vec<Scheme> = (all.into_iter())
                .filter(|scheme| !finest.contains(scheme))
                .collect();
            runs(h06, &others, &["cfl=0.3"])
        }
    }
}
