//! Standing gravity wave in a box of slightly compressible water, over many periods.
//!
//! Set-up, choices and tolerances: `docs/standing-wave.md`.

use super::manufactured::checks;
use super::manufactured::plan::{REMEDIES, ladder, levels, pairs, union};
use super::manufactured::{Boundary, Manufactured, numerical, parameters};
use crate::case::{CheckInfo, Headline, Quantity, RunSpec, Tier, error, headline};
use crate::error::Error;
use crate::exact::hydrostatic::Hydrostatic;
use crate::exact::standing_wave::{ENTRY, StandingWave};
use crate::exact::{Exact, Material};
use crate::parameter::{Domain, Parameter, Parameters};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};
use crate::verdict::{Kind, Verdict};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;
use std::sync::LazyLock;

use BasisName::{Bspline2, Gimp};

/// The linear wave on top of the exact state of rest of a compressible liquid: to first order in the
/// wave's steepness and in gH/c² an exact solution.
#[derive(Debug)]
struct CompressibleWave {
    wave: StandingWave,
    rest: Hydrostatic,
}

impl CompressibleWave {
    fn new(p: &Parameters) -> Result<Self, Error> {
        let wave = StandingWave::new(p)?;
        let rest = Hydrostatic {
            density: wave.density,
            bulk_modulus: p.number("bulk_modulus"),
            gravity: wave.gravity,
            width: wave.width,
            height: wave.depth,
        };
        Ok(Self { wave, rest })
    }
}

impl Exact for CompressibleWave {
    fn dimension(&self) -> usize {
        2
    }

    fn material(&self) -> Material {
        self.rest.material()
    }

    fn extent(&self) -> [[f64; 2]; 3] {
        self.rest.extent()
    }

    fn displacement(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.rest.displacement(x, t) + self.wave.displacement(x, t)
    }

    fn velocity(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.wave.velocity(x, t)
    }

    fn deformation_gradient(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        self.wave.deformation_gradient(x, t) * self.rest.deformation_gradient(x, t)
    }

    fn first_piola(&self, x: &Vector3<f64>, t: f64) -> Matrix3<f64> {
        self.wave.first_piola(x, t)
    }

    fn body_force(&self, x: &Vector3<f64>, t: f64) -> Vector3<f64> {
        self.wave.body_force(x, t)
    }
}

const BULK_MODULUS: Parameter = Parameter {
    name: "bulk_modulus",
    unit: "Pa",
    default: "2.5e6",
    domain: Domain::Number {
        least: 1e4,
        most: 1e12,
        below: false,
    },
    meaning: "bulk modulus K; sound then travels at √(K/ρ), 50 m/s unless changed",
};

/// ω of the wave (rad/s); NaN of parameters that make none.
fn frequency(p: &Parameters) -> f64 {
    StandingWave::new(p).map_or(f64::NAN, |wave| wave.angular_frequency())
}

const QUANTITIES: &[Quantity] = &[error("frequency_error", "relative error of the frequency")];

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact to first order in the steepness: Lamb 1932, §228, on top of the exact state of rest of a compressible liquid. Frequency ω² = g k tanh kH; the compressibility lowers it by about gH/(2c²) = 0.1 %.",
    ],
    limits: &[
        "The steepest slope of the wave is 3 %; terms of second order are left out of the exact solution.",
        "Sound travels at 50 m/s, not at 1,416 m/s.",
        "No remedy carries the wave through twenty periods with both bases: docs/remedy.md says what breaks.",
    ],
    boundary: Boundary::Vessel,
    fluid: true,
    frequency: Some(frequency),
    schemes: pairs(&[Gimp, Bspline2], &REMEDIES),
    levels: levels(1.0, [("n8", 8.0), ("n16", 16.0)]),
    plan,
    checks: CHECKS,
    judge,
    judge_study: |_| Vec::new(),
    headlines: HEADLINES,
    quantities: QUANTITIES,
    breaks_down: |r| {
        let averaged = r.remedy() != RemedyName::None;
        let early = r.basis() == Gimp && r.level == "n16" && r.remedy() == RemedyName::FbarTotal;
        let long = r.parameters.number("duration") > TWO_PERIODS && !survives(r);
        (averaged && (early || long)).then_some(
            "what Π can't see has next to no stiffness: particles lose their order, then J or the walls (docs/modes.md)",
        )
    },
    ..Manufactured::solid(
        [
            "standing-wave",
            "Standing wave",
            "Half a metre of water sways in a box for twenty periods without viscosity: the frequency is known, the energy must not grow, and particles have time to lose their order.",
        ],
        |p| Ok(Box::new(CompressibleWave::new(p)?)),
        parameters(
            ENTRY.parameters,
            &[],
            [BULK_MODULUS]
                .into_iter()
                .chain(numerical("2.4").map(|mut p| {
                    if p.name == "ppc_per_direction" {
                        p.default = "4";
                    }
                    p
                })),
        ),
    )
});

/// Two periods of 1.18 s (s), and twenty.
const TWO_PERIODS: f64 = 2.4;
const TWENTY_PERIODS: &str = "duration=24";

const HEADLINES: &[Headline] = &[
    headline("frequency_ratio", "frequency / exact (–)", 1.0, 4),
    headline(
        "amplitude_ratio",
        "amplitude, last / first period (–)",
        1.0,
        3,
    ),
    headline("energy_gain", "energy gain (–)", 1.0, 5),
    headline("energy_loss", "energy loss (–)", 1.0, 4),
    headline("displacement_l2", "u rms error (m)", 1.0, 5),
    headline("log_jacobian_gap", "ln(J/J̄) (–)", 1.0, 4),
];

const CHECKS: &[CheckInfo] = &[
    checks::MASS,
    CheckInfo {
        name: "frequency",
        kind: Kind::Truth,
        statement: "F̄ over two periods: relative error of the frequency at most ½ (kh)² + 1 %, the error of the discretisation and of the linear theory of slight compressibility",
    },
    CheckInfo {
        name: "no-energy-gain",
        kind: Kind::Truth,
        statement: "none and fbar-consistent: kinetic + stored − gravity's energy never above its start by more than 2 % of the largest kinetic energy: the offset by half a step and the sound of the start",
    },
    CheckInfo {
        name: "locks",
        kind: Kind::KnownLimit,
        statement: "none with GIMP: the frequency is off by more than ½ (kh)² + 1 %",
    },
    CheckInfo {
        name: "breaks-down",
        kind: Kind::KnownLimit,
        statement: "F̄ over twenty periods, and fbar-total with GIMP at n16 over two: breaks down; fbar-consistent with GIMP, and with quadratic splines at n8, is judged by loses-order instead",
    },
    CheckInfo {
        name: "loses-order",
        kind: Kind::KnownLimit,
        statement: "F̄ over twenty periods, where it doesn't break down: rms ln(J/J̄) above 0.1 at the end",
    },
];

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    match tier {
        Tier::Quick => Vec::new(),
        Tier::Pr => ladder(&levels[..1], &case.schemes, &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(levels, &case.schemes, &[]),
            ladder(levels, &case.schemes, &[TWENTY_PERIODS]),
        ]),
        Tier::Long => Vec::new(),
    }
}

/// Whether twenty periods are run through although the particles have lost their order.
fn survives(r: &Record) -> bool {
    r.remedy() == RemedyName::FbarConsistent && (r.basis() == Gimp || r.level == "n8")
}

/// rms ln(J/J̄) that no motion of this steepness explains.
const PARTED: f64 = 0.1;

/// Largest error of the frequency of a scheme that does not lock.
fn tolerance(r: &Record) -> f64 {
    let kh =
        PI * r.parameters.number("half_waves") / r.parameters.number("width") * r.discretisation.h;
    0.5 * kh * kh + 0.01
}

fn judge(r: &Record) -> Vec<Verdict> {
    let mut verdicts = vec![checks::mass(r)];
    let (metric, error) = ("frequency_error", r.metric("frequency_error"));
    let short = r.parameters.number("duration") <= TWO_PERIODS;
    if r.remedy() == RemedyName::None && r.basis() == Gimp {
        verdicts.push(Verdict::above(
            "locks",
            Kind::KnownLimit,
            metric,
            error,
            tolerance(r),
            "every particle's volume is a constraint",
        ));
    } else if r.remedy() != RemedyName::None && short {
        verdicts.push(Verdict::at_most(
            "frequency",
            Kind::Truth,
            metric,
            error,
            tolerance(r),
            "½ (kh)² + 1 %",
        ));
    }
    if r.remedy() != RemedyName::None && !short {
        verdicts.push(Verdict::above(
            "loses-order",
            Kind::KnownLimit,
            "log_jacobian_gap",
            r.metric("log_jacobian_gap"),
            PARTED,
            "what Π can't see has little stiffness: J parts from J̄ (docs/modes.md)",
        ));
    }
    if matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent) {
        verdicts.push(Verdict::at_most(
            "no-energy-gain",
            Kind::Truth,
            "energy_gain",
            r.metric("energy_gain"),
            0.02,
            "the force takes what is stored",
        ));
    }
    verdicts
}
