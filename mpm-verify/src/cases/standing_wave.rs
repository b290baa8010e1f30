//! Standing gravity wave in a box of slightly compressible water, over many periods.

use super::manufactured::*;
use super::parameters::FLIP;
use crate::cases::prelude::*;
use crate::exact;
use crate::exact::hydrostatic::Hydrostatic;
use crate::exact::standing_wave::{DEPTH, ENTRY, HALF_WAVES, StandingWave, WIDTH};

/// The linear wave on top of the exact state of rest of a compressible liquid: to first order in the
/// wave's steepness and in gH/c² an exact solution.
#[derive(Debug, Clone)]
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
        Ok(Self { wave, rest: rest.upright("depth")? })
    }
}

impl Exact for CompressibleWave {
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
    BULK_MODULUS = "bulk_modulus", "Pa", "2.5e6", number(1e4, 1e12, false), "bulk modulus K; sound then travels at √(K/ρ), 50 m/s unless changed";
}

/// ω of the wave (rad/s); NaN of parameters that make none.
fn frequency(p: &Parameters) -> f64 {
    StandingWave::new(p).map_or(f64::NAN, |wave| wave.angular_frequency())
}

/// Two periods of 1.18 s (s), and twenty.
const TWO_PERIODS: f64 = 2.4;
const TWENTY_PERIODS: &str = "duration=24";
/// The stiffness of what Π can't see follows the pressure, and nothing relaxes it.
const HELD: &str = "duration=24 hold=10 relaxation=0";
/// Compression by the weight that counts as slight.
const SLIGHT: f64 = 0.01;

impl Known for CompressibleWave {
    const SOLUTION: Solution = |p| Ok(Box::new(CompressibleWave::new(p)?));
    const BOUNDARY: Boundary = Boundary::Vessel;
    const FLUID: bool = true;
    const FREQUENCY: Option<fn(&Parameters) -> f64> = Some(frequency);
    const PARAMETERS: Composed = (&[ENTRY.parameters, &[BULK_MODULUS]], &[(PPC_PER_DIRECTION, "4")], "2.4", &DYNAMIC);
}

/// Whether what Π can't see is stiffer than the pressure that drives it, by the pressure asked for.
fn is_held(r: &Setup<()>) -> bool {
    r.remedy() == FbarConsistent && r.number(HOLD) > 1.0 && r.number(RELAXATION) == 0.0
}

fn is_short(r: &Setup<()>) -> bool {
    r.number(DURATION) <= TWO_PERIODS
}

/// Largest error of the frequency of a scheme that does not lock.
fn tolerance(r: &Setup<()>) -> f64 {
    let kh = PI * r.number(HALF_WAVES) / r.number(WIDTH) * r.h;
    0.5 * kh * kh + 0.01
}

/// ρ g H/K: how far the weight compresses the water at the floor.
fn compression(r: &Setup<()>) -> f64 {
    r.number(DENSITY) * r.number(GRAVITY) * r.number(DEPTH) / r.number(BULK_MODULUS)
}

pub(super) fn case() -> Case {
    let all = pairs(&SMOOTH, &REMEDIES);
    let held = pairs(&[Gimp], &[FbarConsistent]);
    let moved = implicit(&[RuleName::Midpoint, RuleName::Newmark], &SMOOTH, &[RemedyName::None]);
    let steps: Label = ("CFL", |r| r.parameters.text(CFL));
    let plan = Plan::of(metre_levels()[..2].to_vec())
        .runs(Pr, "n8", &all, "")
        .each(Nightly, "n8 n16", &all, ["", TWENTY_PERIODS])
        .runs(Pr, "n8", &held, HELD)
        .runs(Nightly, "n8 n16", &held, HELD)
        .each(Nightly, "n8 n16", &moved, ["cfl=10 duration=24", "cfl=40 duration=24"]);
    known_case::<2, CompressibleWave>([
        "standing-wave",
        "Standing wave",
        "Half a metre of water sways in a box for twenty periods without viscosity: the frequency is known, the energy must not grow, and particles have time to lose their order.",
    ])
    .planned(plan)
    .reference("Exact to first order in the steepness: Lamb 1932, §228, on top of the exact state of rest of a compressible liquid. Frequency ω² = g k tanh kH; the compressibility lowers it by about gH/(2c²) = 0.1 %.")
    .limit("The steepest slope of the wave is 3 %; terms of second order are left out of the exact solution.")
    .limit("Sound travels at 50 m/s, not at 1,416 m/s.")
    .limit("No averaged remedy carries the wave through twenty periods with both bases: with GIMP fbar-consistent does at hold=10 and relaxation=0, with quadratic splines none does (docs/averages.md).")
    .anew()
    .wanted("frequency", "frequency over the periods", "frequency")
    .missed_by("locks motion-lost")
    .checks(checks())
    .headline(FREQUENCY_RATIO, "frequency / exact (–)", 1.0, 4)
    .headline(AMPLITUDE_RATIO, "amplitude, last / first period (–)", 1.0, 3)
    .headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5)
    .headline(ENERGY_LOSS, "energy loss (–)", 1.0, 4)
    .headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 5)
    .headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 4)
    .quantity(error(FREQUENCY_ERROR, "relative error of the frequency"))
    .table(periods("standing-wave-two-periods", &[SCHEME], Record::is_default))
    .table(periods("standing-wave-twenty-periods", &[SCHEME], |r| r.changes(TWENTY_PERIODS)))
    .table(periods("standing-wave-held", &[SCHEME], |r| r.changes(HELD)))
    .table(periods("standing-wave-rules", &[SCHEME, steps], |r| r.scheme().rule().is_some()))
    .breaks_down(|r| {
        let disordered = Setup::<()>::of_record(r).is_ok_and(|r| {
            let disorder = !is_short(&r) || r.basis() == Gimp && r.level == "n16";
            let at_walls = r.remedy() != FbarConsistent && r.values.is(WALL, WALL_LINE);
            (disorder || at_walls) && r.remedy() != RemedyName::None && !is_held(&r)
        });
        disordered.then_some("what Π can't see has next to no stiffness: particles lose their order, until sound in one outruns the step, J falls to zero or a wall is passed (docs/remedy.md)")
    })
    .pictures(pictures)
}

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
            Column::metric(title, metric, format).at(level)
        })
    };
    ResultTable::new(name, shows, labels, ["n8", "n16"].into_iter().flat_map(of_level))
}

/// Why the frequency of a run is not judged, if it is not.
fn frequency_unknown(r: &Run<()>) -> Option<String> {
    let why = if compression(r) > SLIGHT {
        "the theory is that of slight compressibility: ρ g H is above 1 % of K"
    } else if r.number(DURATION) * frequency(&r.values) < 2.0 * TAU {
        "the run is shorter than two periods"
    } else if r.number(FLIP) < 1.0 {
        "a blend with PIC takes the motion"
    } else {
        return None;
    };
    Some(why.to_owned())
}

fn checks() -> Vec<Check> {
    vec![
        mass(),
        rests(
            "no amplitude or no gravity: final rms displacement at most ρ g h H/2K, twice a quarter of a cell's head over the depth",
            |r| 0.5 * compression(r) * r.h,
        ),
        motion_lost(|_| Some("the phase is lost, or particles have left their order, as only what Π sees is stiff (docs/remedy.md)")),
        Gate::known_limit("locks", "none with GIMP: frequency off by more than ½ (kh)² + 1 %")
            .when(|r| r.remedy() == RemedyName::None && r.basis() == Gimp && moves(&r.values))
            .above(FREQUENCY_ERROR, |r| tolerance(r))
            .because("every particle's volume is a constraint"),
        Gate::truth("frequency", "F̄ over two periods (twenty with GIMP and an unseen stiffness above the pressure), implicit splines: relative error at most ½ (kh)² + 1 %")
            .when(|r| {
                let averaged = r.remedy() != RemedyName::None && (is_short(r) || is_held(r) && r.basis() == Gimp);
                (averaged || r.remedy() == RemedyName::None || r.is_implicit() && r.basis() == Bspline2) && moves(&r.values)
            })
            .unless(frequency_unknown)
            .within(FREQUENCY_RATIO, |r| slowed(r, frequency(&r.values)), |r| tolerance(r))
            .because("½ (kh)² + 1 %"),
        Gate::truth("order", "fbar-consistent with GIMP, no relaxation, hold above the pressure: final rms ln(J/J̄) at most one over the pressures held")
            .when(|r| is_held(r) && r.basis() == Gimp)
            .at_most(LOG_JACOBIAN_GAP, |r| 1.0 / r.number(HOLD))
            .because("the pressure drives it with no more than itself"),
        Gate::truth("no-energy-gain", "none and fbar-consistent, not newmark: energy above its start at most 2 % of the peak kinetic one, half a step and initial sound")
            .when(|r| matches!(r.remedy(), RemedyName::None | FbarConsistent) && r.rule() != Some(RuleName::Newmark))
            .except(|r| frequency(&r.values) * r.dt() > 1.0, "a step is longer than a radian of the wave")
            .at_most(ENERGY_GAIN, |_| 0.02)
            .because("the force takes what is stored"),
    ]
}

/// Kinetic energy over twenty periods with FLIP: a panel per basis and level. A cross marks a breakdown.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    let mut panels = Vec::new();
    for (basis, level) in SMOOTH.into_iter().flat_map(|b| [(b, "n8"), (b, "n16")]) {
        let own = |r: &&Record| r.level == level && r.basis() == basis && is_flip(r) && r.changes(TWENTY_PERIODS);
        let runs = || gallery.records.iter().filter(own);
        let broken = runs().filter(|r| r.status == Status::Failed);
        let energy = |t: &Table| t.points("time", "kinetic_energy");
        let last = |t: &Table| energy(t).last().copied().into_iter().collect();
        let panel = Panel::new(format!("{basis}, {level}"), ["time (s)", "kinetic energy (J/m)"])
            .log_y()
            .histories(gallery, runs(), |_, t| energy(t))?
            .by_run(|r, curve| Series { name: r.remedy().to_string(), ..curve })
            .histories(gallery, broken, |_, t| last(t))?
            .styled(|_, cross| Series { name: String::new(), marker: Marker::Cross, dash: Dash::None, ..cross });
        panels.push(panel);
    }
    let caption = format!("Kinetic energy with {TWENTY_PERIODS}; a cross marks a breakdown.");
    Figure::new("energy", caption, panels).columns(2).share_axes().draw(gallery)
}
