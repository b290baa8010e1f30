//! Checks of the dam break. The tolerances are derived in `docs/dam-break.md`.

use super::*;
use crate::cases::parameters::is_of_own_problem;
use crate::exact::dam_break::{elastic_energy, energies, greatest_speed, passage, uncertainty};

/// Relative tolerance of the forces at rest: of the exact start, and after the gravity stage.
const AT_REST: (f64, f64) = (1e-3, 5e-3);
/// Rms error of the pressure at rest over that at the floor on cells of [`PROFILE_CELL`] (m).
const PROFILE: f64 = 0.01;
const PROFILE_CELL: f64 = 0.25;
/// Cells (m) from which on splashes are fine enough to show what coarse cells swallow.
const FINE: f64 = 0.125;
/// Cells (m) beyond which they swallow even what `fbar-rate` makes.
const COARSE: f64 = 0.25;
/// Duration (s) of the runs whose known limits were found by running.
const WHOLE: f64 = 2.0;

const MAKES_ENERGY: &str =
    "force and rate of volume average differently, so that the stress gives work for nothing: docs/remedy.md";
const DRIFTS: &str =
    "averages of averages let the true volumes drift until particles turn inside out: docs/dam-break.md";

/// Share of the front's error, a cell, that the time step may add to it.
const TIME_STEP: f64 = 0.1;
/// Relative difference of the front's advance between the two starts, whose pressures differ by twice that.
const STARTS: f64 = 2.5e-3;
/// Largest pressure and checkerboard of F̄ over those of standard MPM.
const SMOOTHER: f64 = 0.5;
const NOT_AT_REST: &str = "the water is not at rest: its J is replaced by an average";

type Water<'a> = Run<'a, DamBreak>;

/// The reason why a run is known to break down before its end.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    let run: Water = Run::of(record).ok()?;
    if run.duration < WHOLE {
        return None;
    }
    let gimp = run.basis() == Gimp;
    // On coarse cells quadratic splines, and on the coarsest fbar-rate with small steps in a slippery tank, make energy
    // too, but keep the water in it.
    let keeps_it =
        run.remedy() == FbarRate && run.h > COARSE && run.has_small_steps() && run.wall_contact == Contact::Separable;
    let leaves_it = gimp && !keeps_it || run.is_flip() && run.h <= FINE;
    if run.has_to_make_energy() && leaves_it {
        return Some(MAKES_ENERGY);
    }
    let printed = run.remedy() == FbarRecursive;
    (printed && gimp && run.is_flip() && run.h <= FINE).then_some(DRIFTS)
}

impl Water<'_> {
    /// Whether the time step is the case's own, not a larger one.
    fn has_small_steps(&self) -> bool {
        self.cfl < 0.1
    }

    fn is_flip(&self) -> bool {
        self.transfer() == TransferName::Flip && self.pic_rate == 0.0
    }

    fn is_averaged(&self) -> bool {
        self.remedy() != RemedyName::None
    }

    /// Whether the first step replaces the exact J by its average.
    fn smooths(&self) -> bool {
        matches!(self.remedy(), FbarRecursive | FbarTotal)
    }

    /// Whether force and rate of volume are from different averages.
    fn averages_differ(&self) -> bool {
        matches!(self.remedy(), FbarTotal | FbarRate)
    }

    /// Whether averages differ and nothing dissipates enough.
    fn has_to_make_energy(&self) -> bool {
        // The loss of a step, ½ Σ m |Δv|², grows with it: large ones take more than little that is made.
        let little = self.remedy() == FbarRate && self.basis() == Bspline2 && self.h > COARSE;
        let outweighed = little && !self.has_small_steps();
        self.averages_differ() && !outweighed && (self.is_flip() || self.h <= FINE)
    }

    /// Whether a run makes energy, as is known of its remedy: it has exceeded the bound, or it has to and is judged for it.
    fn makes_energy(&self) -> bool {
        let known = is_of_own_problem(self.record) && self.has_to_make_energy();
        let made = self.metric(MOTION_EXCESS) > self.stored();
        self.averages_differ() && (known || made)
    }

    /// Elastic energy of the water at rest behind the gate over all its energy: what the stress can give back.
    fn stored(&self) -> f64 {
        let (at_start, _) = energies(self.density);
        elastic_energy(self.density, self.bulk_modulus) / at_start
    }

    /// Relative tolerance of forces at rest.
    fn at_rest(&self) -> f64 {
        if self.start == Rest::Exact { AT_REST.0 } else { AT_REST.1 }
    }

    /// Bound on the error of the pressure at rest: off by h in layers as thick as h, it is off by h^(3/2) in the mean.
    fn profile_bound(&self) -> f64 {
        PROFILE * (self.h / PROFILE_CELL).powf(1.5)
    }

    /// Distance (m) from the inviscid front that a grid may leave.
    fn front_bound(&self) -> f64 {
        self.h + uncertainty()
    }

    fn front_is_open(&self) -> Option<String> {
        if self.metric(FRONT_RMS_ERROR).is_nan() {
            Some("the run ends before the front is near the wall".to_owned())
        } else if !self.is_flip() {
            Some("this transfer is viscous: see docs/dam-break.md".to_owned())
        } else {
            None
        }
    }

    /// Force (N/m) on the gate at rest.
    fn gate_at_rest(&self) -> f64 {
        0.5 * self.density * GRAVITY * DEPTH * DEPTH
    }

    fn particles(&self) -> f64 {
        let cells = LENGTH * DEPTH / self.h.powi(2);
        f64::from(self.record.discretisation.ppc) * cells
    }

    /// Scheme and changed parameters.
    fn name(&self) -> String {
        format!("{} {}", self.scheme, self.set.join(" ")).trim_end().to_owned()
    }
}

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<DamBreak>;
    type Demand = crate::demand::Demand<DamBreak>;
    let at_rest = |check: Check| check.except(|w| w.smooths(), NOT_AT_REST);
    vec![
        Check::bookkeeping("particle-count", "L H / (h/n)² particles at n per direction: the paper's 3,200 at h = 0.25 m and five")
            .within(Quantity::new("particles", |w: &Water| w.record.work.particles as f64), |w| w.particles(), |_| 0.0)
            .because("Zhao et al. 2023, section 4.3: 3,200 at h = 0.25 m"),
        Check::bookkeeping("mass", "all: final mass ρ L H to rounding")
            .within(MASS, |w| w.density * LENGTH * DEPTH, |w| ROUNDING * (w.density * LENGTH * DEPTH))
            .because("conservation of mass"),
        at_rest(Check::truth("base-reaction", "none, fbar-rate, fbar-consistent: mean force on the floor behind the gate the water's weight within 0.1 %, within 0.5 % after a gravity stage"))
            .within(BASE_REACTION_RATIO, |_| 1.0, |w| w.at_rest())
            .because("weight of the water"),
        at_rest(Check::truth("gate-force", "none, fbar-rate, fbar-consistent: mean force on the gate ½ ρ g H² within 0.1 %, within 0.5 % after a gravity stage"))
            .within(GATE_FORCE, |w| w.gate_at_rest(), |w| w.at_rest() * w.gate_at_rest())
            .because("hydrostatics"),
        // Averages of averages diffuse the volume by h²/Δt: it takes an exact start and the case's own time step to see it.
        Check::known_limit("creeps", "fbar-recursive from the exact start, CFL below 0.1: force on the floor below the weight by more than 0.1 %, as the water sinks")
            .when(|w| w.remedy() == FbarRecursive && w.start == Rest::Exact && w.has_small_steps())
            .above(Quantity::new(BASE_REACTION_RATIO.name, |w: &Water| 1.0 - w.metric(BASE_REACTION_RATIO)), |w| w.at_rest())
            .because("averages of averages diffuse the volume: docs/column.md"),
        Check::truth("pressure-profile", "pressure behind the gate hydrostatic, rms within 1 % of the floor's at h = 0.25 m, elsewhere as h^(3/2)")
            .at_most(PRESSURE_PROFILE_ERROR, |w| w.profile_bound())
            .because("hydrostatics"),
        Check::known_limit("smoothed-start", "fbar-recursive, fbar-total from the exact start: pressure after one step off by more than pressure-profile allows: Π(J) ≠ J at floor and surface")
            .when(|w| w.smooths() && w.start == Rest::Exact)
            .above(PRESSURE_PROFILE_ERROR, |w| w.profile_bound())
            .because("Π takes the mean of J over what is there: at floor and surface that lies to one side"),
        Check::truth("front", "FLIP: front within a cell of the inviscid one, rms over t √(g/H) from 0.2 to 0.9")
            .unless(|w| w.front_is_open())
            .at_most(FRONT_RMS_ERROR, |w| w.front_bound())
            .because("inviscid front; a grid resolves no tongue thinner than a cell"),
        Check::truth("arrival", "FLIP: arrival at x = 6 m − 2h exact within the time in which the inviscid front crosses a cell")
            .unless(|w| w.front_is_open())
            .except(|w| w.metric(ARRIVAL_ERROR).is_nan(), "the front does not come so far by the end: see front")
            .at_most(ARRIVAL_ERROR, |w| {
                let passes = passage(TANK - 2.0 * w.h);
                w.front_bound() / passes.map_or(f64::NAN, |(_, speed)| speed)
            })
            .because("inviscid front; a grid resolves no tongue thinner than a cell"),
        Check::truth("front-speed", "all: front slower than 2 √(g H)")
            .at_most(FRONT_SPEED_MAX, |_| greatest_speed())
            .because("Ritter 1892"),
        Check::truth("energy-not-gained", "all: kinetic and potential energy and stress work never exceed their start, and never grow without APIC, whose affine energy is not counted")
            .each([
                Demand::at_most(ENERGY_EXCESS, |_| ROUNDING),
                Demand::at_most(ENERGY_GAIN, |_| ROUNDING).when(|w| w.transfer() != TransferName::Apic),
            ])
            .because("explicit steps with lumped masses take energy from the motion, never give it"),
        Check::truth("motion-not-gained", "all except makes-energy: kinetic and potential energy exceed their start by at most the elastic energy stored then")
            .when(|w| !w.makes_energy())
            .at_most(MOTION_EXCESS, |w| w.stored())
            .because("the elastic energy of the water at rest"),
        Check::known_limit("makes-energy", "fbar-total, fbar-rate over 2 s, FLIP (not bspline2, fbar-rate, h = 0.5 m, CFL 0.3) and APIC at h ≤ 0.125 m: energy is created")
            .when(|w| w.makes_energy())
            .above(MOTION_EXCESS, |w| w.stored())
            .because(MAKES_ENERGY),
        Check::truth("dissipation", "all that make no energy: loss of kinetic and potential energy at most that of water at rest in the tank")
            .when(|w| !w.makes_energy())
            .at_most(MOTION_LOSS, |w| {
                let (at_start, at_rest) = energies(w.density);
                1.0 - at_rest / at_start
            })
            .because("water at rest in the tank has two thirds of its energy"),
        Check::truth("volume", "all: area covered at 0.4 s equal to L H within strips two particles wide")
            .except(|w| w.metric(COVERED_EARLY).is_nan(), "the run ends before 0.4 s")
            .within(COVERED_EARLY, |_| LENGTH * DEPTH, |w| {
                // Strips are two particles wide and end at the highest particle of the water, whose surface drops by H
                // in all and whose edge is known to half a particle.
                let spacing = w.h / f64::from(w.record.discretisation.ppc).sqrt();
                0.5 * 2.0 * spacing * DEPTH + 0.5 * spacing * TANK
            })
            .because("conservation of mass of a body that hardly compresses"),
        Check::known_limit("locked", "none with GIMP: front more than a cell behind the inviscid one, rms")
            .when(|w| !w.is_averaged() && w.basis() == Gimp && w.front_is_open().is_none())
            .above(FRONT_RMS_ERROR, |w| w.front_bound())
            .because("standard MPM locks: Zhao et al. 2023, Figure 12"),
        Check::truth("front-converges", "F̄ with FLIP, one CFL number: rms error of the front falls from level to level")
            .study(|records| falls(&Water::ended(records), FRONT_RMS_ERROR)),
        Check::truth("start-converges", "F̄ with FLIP, one CFL number: rms error of the pressure behind the gate falls from level to level")
            .study(|records| falls(&Water::ended(records), PRESSURE_PROFILE_ERROR)),
        Check::truth("late-converges", "fbar-consistent with FLIP, one CFL number: wall impulse and mean centre of mass over 2 s change less per level, or within the ensemble's spread").study(|records| late(&Water::ended(records))),
        Check::truth("smoother", "F̄: rms and checkerboard of the pressure at 0.4 s less than half of standard MPM's").study(|records| against_standard(&Water::ended(records))),
        Check::truth("starts-agree", "all: advance of the front after a gravity stage that from the exact start within 0.25 %").study(|records| starts(&Water::ended(records))),
        Check::truth("time-step", "fbar-consistent with FLIP: a CFL number up to 0.3 moves the front at 0.4 s by less than a tenth of a cell").study(|records| time_steps(&Water::ended(records))),
    ]
}

/// The runs of each scheme of F̄ with FLIP that are divided in time in one way, coarsest first.
fn ladders<'a, 'r>(runs: &'a [Water<'r>]) -> Vec<Vec<&'a Water<'r>>> {
    let judged = |w: &&Water| w.record.changes_none_but(&["cfl", "duration"]) && w.is_averaged() && w.is_flip();
    let mut own: Vec<&Water> = runs.iter().filter(judged).collect();
    own.sort_by(|a, b| b.h.total_cmp(&a.h));
    let kinds = crate::distinct(own.iter().map(|w| (w.scheme, &w.set)));
    kinds.into_iter().map(|kind| own.iter().filter(|w| (w.scheme, &w.set) == kind).copied().collect()).collect()
}

fn falls(runs: &[Water], metric: Metric) -> Vec<Finding> {
    let ladders = ladders(runs);
    let fall = |pair: &[&Water]| {
        let (coarse, fine) = (pair[0].metric(metric), pair[1].metric(metric));
        let source = format!("{}: {} against {}", pair[0].name(), pair[1].level, pair[0].level);
        Finding::at_most(metric, fine, coarse, source)
    };
    ladders.iter().flat_map(|ladder| ladder.windows(2).map(fall)).collect()
}

/// Whether sums over the whole flow converge.
fn late(runs: &[Water]) -> Vec<Finding> {
    let mut found = Vec::new();
    for ladder in ladders(runs) {
        let whole = ladder.iter().all(|w| !w.metric(WALL_IMPULSE).is_nan());
        if ladder[0].remedy() != FbarConsistent || !whole {
            continue;
        }
        for metric in [WALL_IMPULSE, CENTRE_X_MEAN] {
            for three in ladder.windows(3) {
                let [a, b, c] = [0, 1, 2].map(|k: usize| three[k].metric(metric));
                let [coarse, middle, fine] = [0, 1, 2].map(|k: usize| &three[k].level);
                let source = format!("{}: from {middle} to {fine}, against from {coarse} to {middle}", three[0].name());
                let bound = (b - a).abs() + spread(runs, three[0], metric);
                found.push(Finding::at_most(metric, (c - b).abs(), bound, source));
            }
        }
    }
    found
}

/// The range of a metric over an ensemble of the scheme, of the level and the time step that have one.
fn spread(runs: &[Water], like: &Water, metric: Metric) -> f64 {
    let members = |w: &&Water| w.scheme == like.scheme && w.record.changes_only("seed");
    let values = || runs.iter().filter(members).map(|w| w.metric(metric));
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    range.max(0.0)
}

/// Pressure and checkerboard of F̄ over those of standard MPM.
fn against_standard(runs: &[Water]) -> Vec<Finding> {
    let found = runs.iter().filter(|w| w.is_averaged()).filter_map(|run| {
        let standard = runs.iter().find(|w| {
            let same = (w.basis(), w.transfer()) == (run.basis(), run.transfer());
            !w.is_averaged() && same && same_but_scheme(w, run)
        })?;
        let source = format!("{} {} against standard MPM", run.scheme, run.record.folder());
        Some([PRESSURE_RMS, CHECKERBOARD_RMS].map(|metric| {
            Finding::at_most(metric, run.metric(metric), SMOOTHER * standard.metric(metric), source.clone())
        }))
    });
    found.flatten().collect()
}

fn starts(runs: &[Water]) -> Vec<Finding> {
    let staged = |(run, _): &(&Water, &Water)| run.start == Rest::GravityStage;
    let found = from_own(runs, "start").filter(staged).map(|(run, own)| {
        let exact = own.metric(FRONT_X_EARLY);
        let source = format!("{} {}: the exact start", run.scheme, run.level);
        Finding::within(FRONT_X_EARLY, run.metric(FRONT_X_EARLY), exact, STARTS * (exact - LENGTH), source)
    });
    found.collect()
}

fn time_steps(runs: &[Water]) -> Vec<Finding> {
    let ours = |(run, _): &(&Water, &Water)| run.remedy() == FbarConsistent && run.is_flip();
    let found = from_own(runs, "cfl").filter(ours).map(|(run, own)| {
        let (value, exact) = (run.metric(FRONT_X_EARLY), own.metric(FRONT_X_EARLY));
        let source = format!("{} {}: CFL number {} against {}", run.scheme, run.level, run.cfl, own.cfl);
        Finding::within(FRONT_X_EARLY, value, exact, TIME_STEP * run.h, source)
    });
    found.collect()
}

/// Runs with a value of their own of the parameter `name`, each with the run that differs from it in that alone; the latter is
/// of the case's own parameters except for its duration.
fn from_own<'a, 'r>(runs: &'a [Water<'r>], name: &'static str) -> impl Iterator<Item = (&'a Water<'r>, &'a Water<'r>)> {
    changed(runs, name).filter(|(_, own)| own.record.changes_none_but(&["duration"]))
}
