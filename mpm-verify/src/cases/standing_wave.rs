//! Standing gravity wave in a box of slightly compressible water, over many periods.
//!
//! Set-up, choices and tolerances: `docs/standing-wave.md`.

use super::family::{REMEDIES, family, implicit, levels, pairs};
use super::manufactured::checks::{mass, motion_lost, moves, rests, slowed};
use super::manufactured::metrics::{
    AMPLITUDE_RATIO, DISPLACEMENT_L2, ENERGY_GAIN, ENERGY_LOSS, FREQUENCY_ERROR, FREQUENCY_RATIO,
    LOG_JACOBIAN_GAP,
};
use super::manufactured::pictures::kinetic_energy;
use super::manufactured::{
    Boundary, CFL, DURATION, HOLD, Manufactured, PPC_PER_DIRECTION, RELAXATION, all_parameters,
};
use super::parameters::{DENSITY, DYNAMIC, FLIP};
use crate::case::{Case, Tier};
use crate::check::{Check, Finding, judge, run};
use crate::exact::common::GRAVITY;
use crate::exact::hydrostatic::Hydrostatic;
use crate::exact::standing_wave::{DEPTH, ENTRY, HALF_WAVES, StandingWave, WIDTH};
use crate::exact::{self, Exact, Material};
use crate::metric::error;
use crate::parameter::{Parameters, number, parameters};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, headline};
use crate::scheme::{BasisName, RemedyName, RuleName};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

use BasisName::{Bspline2, Gimp};
use Tier::{Nightly, Pr};

/// The linear wave on top of the exact state of rest of a compressible liquid: to first order in the
/// wave's steepness and in gH/c² an exact solution.
#[derive(Debug)]
struct CompressibleWave {
    wave: StandingWave,
    rest: Hydrostatic,
}

impl CompressibleWave {
    fn new(p: &Parameters) -> Result<Self, exact::Error> {
        let wave = StandingWave::new(p)?;
        let rest = Hydrostatic {
            density: wave.density,
            bulk_modulus: p.number(BULK_MODULUS),
            gravity: wave.gravity,
            width: wave.width,
            height: wave.depth,
        };
        let rest = rest.upright("depth")?;
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

parameters! { const:
    BULK_MODULUS = "bulk_modulus", "Pa", "2.5e6", number(1e4, 1e12, false),
        "bulk modulus K; sound then travels at √(K/ρ), 50 m/s unless changed";
}

/// ω of the wave (rad/s); NaN of parameters that make none.
fn frequency(p: &Parameters) -> f64 {
    StandingWave::new(p).map_or(f64::NAN, |wave| wave.angular_frequency())
}

/// Two periods of 1.18 s (s), and twenty.
const TWO_PERIODS: f64 = 2.4;
const TWENTY_PERIODS: &[&str] = &["duration=24"];
/// The stiffness of what Π can't see follows the pressure, and nothing relaxes it.
const HELD: &[&str] = &["duration=24", "hold=10", "relaxation=0"];

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n8", 8.0), ("n16", 16.0)]);
    let names = [
        "standing-wave",
        "Standing wave",
        "Half a metre of water sways in a box for twenty periods without viscosity: the frequency is known, the energy must not grow, and particles have time to lose their order.",
    ];
    let motion = Manufactured {
        boundary: Boundary::Vessel,
        fluid: true,
        frequency: Some(frequency),
        ..Manufactured::solid(|p| Ok(Box::new(CompressibleWave::new(p)?)))
    };
    let of_solution = [ENTRY.parameters, &[BULK_MODULUS]].concat();
    let parameters = all_parameters(&of_solution, &[(PPC_PER_DIRECTION, "4")], "2.4", &DYNAMIC);
    let all = pairs(&[Gimp, Bspline2], &REMEDIES);
    let held = pairs(&[Gimp], &[RemedyName::FbarConsistent]);
    let rules = [RuleName::Midpoint, RuleName::Newmark];
    let moved = implicit(&rules, &[Gimp, Bspline2], &[RemedyName::None]);
    Case {
        references: vec![
            "Exact to first order in the steepness: Lamb 1932, §228, on top of the exact state of rest of a compressible liquid. Frequency ω² = g k tanh kH; the compressibility lowers it by about gH/(2c²) = 0.1 %.".to_owned(),
        ],
        limits: &[
            "The steepest slope of the wave is 3 %; terms of second order are left out of the exact solution.",
            "Sound travels at 50 m/s, not at 1,416 m/s.",
            "No averaged remedy carries the wave through twenty periods with both bases: with GIMP fbar-consistent does at hold=10 and relaxation=0, with quadratic splines none does (docs/disorder.md).",
        ],
        plan: vec![
            family(Pr, &levels[..1], &all, &[]),
            family(Nightly, &levels, &all, &[]),
            family(Nightly, &levels, &all, TWENTY_PERIODS),
            family(Pr, &levels[..1], &held, HELD),
            family(Nightly, &levels, &held, HELD),
            family(Nightly, &levels, &moved, &["cfl=10", "duration=24"]),
            family(Nightly, &levels, &moved, &["cfl=40", "duration=24"]),
        ],
        levels,
        checks: checks(),
        headlines: vec![
            headline(FREQUENCY_RATIO, "frequency / exact (–)", 1.0, 4),
            headline(AMPLITUDE_RATIO, "amplitude, last / first period (–)", 1.0, 3),
            headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5),
            headline(ENERGY_LOSS, "energy loss (–)", 1.0, 4),
            headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 5),
            headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 4),
        ],
        quantities: vec![error(FREQUENCY_ERROR, "relative error of the frequency")],
        tables: vec![
            periods("standing-wave-two-periods", &[SCHEME], Record::is_default),
            periods("standing-wave-twenty-periods", &[SCHEME], |r| r.set == TWENTY_PERIODS),
            periods("standing-wave-held", &[SCHEME], |r| r.set == HELD),
            periods("standing-wave-rules", &[SCHEME, STEPS], |r| r.scheme().rule().is_some()),
        ],
        breaks_down: |r| {
            let disorder = !is_short(r) || r.basis() == Gimp && r.level == "n16";
            (disorder && r.remedy() != RemedyName::None && !is_held(r)).then_some(
                "what Π can't see has next to no stiffness: particles lose their order, until sound in one outruns the step, J falls to zero or a wall is passed (docs/modes.md)",
            )
        },
        pictures: |gallery| kinetic_energy(gallery, TWENTY_PERIODS),
        ..motion.case(names, parameters)
    }
}

/// Whether what Π can't see is stiffer than the pressure that drives it, by the pressure asked for.
fn is_held(r: &Record) -> bool {
    let number = |p| r.parameters.number(p);
    r.remedy() == RemedyName::FbarConsistent && number(HOLD) > 1.0 && number(RELAXATION) == 0.0
}

fn is_short(r: &Record) -> bool {
    r.parameters.number(DURATION) <= TWO_PERIODS
}

/// Compression by the weight that counts as slight.
const SLIGHT: f64 = 0.01;

/// Largest error of the frequency of a scheme that does not lock.
fn tolerance(r: &Record) -> f64 {
    let kh = PI * r.parameters.number(HALF_WAVES) / r.parameters.number(WIDTH) * r.discretisation.h;
    0.5 * kh * kh + 0.01
}

/// The steps of a row.
const STEPS: Label = ("CFL", |r| r.parameters.text(CFL));

/// Frequency, amplitude, loss and order at both levels.
fn periods(name: &str, labels: &[Label], shows: fn(&Record) -> bool) -> ResultTable {
    let of_level = |level: &'static str| {
        let shown = [
            ("frequency / exact", FREQUENCY_RATIO, fixed(3)),
            ("amplitude", AMPLITUDE_RATIO, fixed(3)),
            ("energy loss", ENERGY_LOSS, fixed(3)),
            ("ln(J/J̄)", LOG_JACOBIAN_GAP, fixed(4)),
        ];
        shown.map(|(title, metric, format)| {
            let title = format!("{}: {title}", level.replace('n', "n = "));
            Column::metric(title, metric, format).of(move |r| r.level == level)
        })
    };
    let columns = ["n8", "n16"].into_iter().flat_map(of_level);
    ResultTable::new(name, shows, labels, columns)
}

/// ρ g H/K: how far the weight compresses the water at the floor.
fn compression(r: &Record) -> f64 {
    let number = |p| r.parameters.number(p);
    number(DENSITY) * number(GRAVITY) * number(DEPTH) / number(BULK_MODULUS)
}

fn of_frequency(r: &Record) -> Finding {
    let (number, omega) = (|p| r.parameters.number(p), frequency(&r.parameters));
    let why = if compression(r) > SLIGHT {
        "the theory is that of slight compressibility: ρ g H is above 1 % of K"
    } else if number(DURATION) * omega < 2.0 * TAU {
        "the run is shorter than two periods"
    } else if number(FLIP) < 1.0 {
        "a blend with PIC takes the motion"
    } else {
        let reference = slowed(r, omega);
        let why = "½ (kh)² + 1 %";
        return judge(r, FREQUENCY_RATIO).within(reference, tolerance(r), why);
    };
    Finding::not_applicable(FREQUENCY_RATIO, why)
}

fn checks() -> Vec<Check> {
    vec![
        mass(),
        rests(
            "without an amplitude or gravity: rms displacement at the end at most ρ g h H/2K: a wall's pressure may be off by a quarter of a cell's head, over the depth, twice when it is let go",
            |r| 0.5 * compression(r) * r.discretisation.h,
        ),
        motion_lost(|_| {
            Some(
                "the phase is lost, or particles have left their order, as only what Π sees is stiff (docs/modes.md)",
            )
        }),
        Check::known_limit(
            "locks",
            "none with GIMP: the frequency is off by more than ½ (kh)² + 1 %",
            run(|r| {
                let why = "every particle's volume is a constraint";
                let found = judge(r, FREQUENCY_ERROR).above(tolerance(r), why);
                let locks =
                    r.remedy() == RemedyName::None && r.basis() == Gimp && moves(&r.parameters);
                locks.then_some(found)
            }),
        ),
        Check::truth(
            "frequency",
            "F̄ over two periods, with GIMP and a stiffness of the unseen above the pressure over twenty as well, and implicit with quadratic splines, about what its steps make of it: relative error of the frequency at most ½ (kh)² + 1 %, the error of the discretisation and of the linear theory of slight compressibility",
            run(|r| {
                let found = of_frequency(r);
                let averaged = r.remedy() != RemedyName::None
                    && (is_short(r) || is_held(r) && r.basis() == Gimp);
                let judged = averaged || r.scheme().rule().is_some() && r.basis() == Bspline2;
                (judged && moves(&r.parameters)).then_some(found)
            }),
        ),
        Check::truth(
            "order",
            "fbar-consistent with GIMP, without relaxation, that holds more than the pressure: rms ln(J/J̄) at the end at most one over the pressures held",
            run(|r| {
                let why = "the pressure drives it with no more than itself";
                let bound = 1.0 / r.parameters.number(HOLD);
                let found = judge(r, LOG_JACOBIAN_GAP).at_most(bound, why);
                (is_held(r) && r.basis() == Gimp).then_some(found)
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "none and fbar-consistent, not newmark: kinetic + stored − gravity's energy never above its start by more than 2 % of the largest kinetic energy: the offset by half a step and the sound of the start",
            run(|r| {
                let why = "the force takes what is stored";
                let found = judge(r, ENERGY_GAIN).at_most(0.02, why);
                let keeps = matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent);
                (keeps && r.scheme().rule() != Some(RuleName::Newmark)).then_some(found)
            }),
        ),
    ]
}
