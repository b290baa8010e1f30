//! Trials of a slope with reduced strength.

use super::*;
use crate::cases::slope::ground::{Ground, RISE, STAGE, STAGE_DAMPING};
use crate::cases::slope::section::GRAVITY;
use crate::exact::slope::spiral;
use mpm_core::material::MohrCoulomb;

/// A slope that moves by this share of its height in a trial fails.
const FAILS: f64 = 0.02;
/// One that moves by less than this share of its height between two looks has come to rest.
const RESTS: f64 = 1e-5;
/// Time (s) between two looks, and the largest number of looks in a trial.
const LOOK: f64 = 0.5;
const LOOKS: usize = 8;
/// Largest number of steps of equilibrium in a trial: each moves the particles among the functions, so that they are
/// not at rest at once.
const STATIC_LOOKS: usize = 40;
/// Local damping of a trial.
const TRIAL_DAMPING: f64 = 0.5;

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Trial {
    /// Factor by which the strength is divided.
    pub(super) factor: f64,
    /// Whether the slope fails.
    pub(super) fails: bool,
    /// Largest displacement (m) of a particle.
    pub(super) moved: f64,
    /// Duration (s).
    pub(super) time: f64,
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// The ground at rest with its full strength: initial state of a trial in motion. In equilibrium gravity rises anew.
    ground: Option<Saved>,
    /// Places (m) in it at rest with its full strength, in seeding order.
    rest: Vec<[f64; 2]>,
    trials: Vec<Trial>,
    /// The factor of the current or last trial; none under rising gravity.
    factor: Option<f64>,
}

/// Largest factor at which the slope stands and least at which it fails, of those tried.
pub(super) fn bracket(trials: &[Trial]) -> (f64, f64) {
    let of = |fails| trials.iter().filter(move |t| t.fails == fails).map(|t| t.factor);
    (of(false).fold(1.0, f64::max), of(true).fold(f64::INFINITY, f64::min))
}

impl Setup<Stability> {
    /// Factor of safety by limit analysis, after its lower and before its upper bound. With friction the spiral is the upper
    /// one, and the lower is as far below as that of the best circle without.
    pub(super) fn limits(&self) -> Option<[f64; 3]> {
        let (best, least, most) = STABILITY;
        if self.friction > 0.0 {
            let load = self.slope().factor_of_safety(self.strength, 1.0).recip();
            let [beta, phi] = [self.face_angle, self.friction].map(f64::to_radians);
            let factor = spiral::factor_of_safety(beta, phi, load).ok()?;
            return Some([factor * least / most, factor, factor]);
        }
        let factors = [least, best, most].map(|number| self.slope().factor_of_safety(self.strength, number));
        (self.face_angle == 45.0).then_some(factors)
    }

    /// Least and largest factor that the trials may find, where limit analysis knows them.
    pub(super) fn bounds(&self) -> Option<[f64; 2]> {
        let [least, _, most] = self.limits()?;
        // A slope with friction stops slowly: one that moves by less than what fails is lower by as much.
        let lower = if self.friction > 0.0 { FAILS } else { 0.0 };
        let too_strong = (1.0 + SLOW) * (1.0 + self.h / self.height) * (1.0 + lower);
        Some([least - self.resolution(), too_strong * most + self.resolution()])
    }

    /// The ground with its strength divided by a factor.
    fn law(&self, factor: f64) -> Result<SharedLaw, Fault> {
        let (slope, strength) = (self.slope(), self.strength / factor);
        if self.friction == 0.0 {
            return Ok(slope.law(Strength::perfect(strength)?)?.into());
        }
        let phi = (self.friction.to_radians().tan() / factor).atan();
        Ok(MohrCoulomb::new(slope.elasticity, strength / SQRT_2, [phi, phi])?.into())
    }

    /// Half of the bracket that the trials leave.
    pub(super) fn resolution(&self) -> f64 {
        0.5 * (self.most - 1.0) / 2.0_f64.powf(f64::from(self.trials) - 1.0)
    }

    /// Whether standard MPM locks. In equilibrium nothing overshoots, so that fine splines lock, too. Friction locks less.
    pub(super) fn locks(&self) -> bool {
        if self.friction > 0.0 {
            return self.remedy() == RemedyName::None && self.basis() == Gimp && self.h >= FINE;
        }
        let coarse = self.h > FINE || self.is_implicit() && self.h >= FINE;
        self.remedy() == RemedyName::None && (self.basis() == Gimp || coarse)
    }

    /// The factor of limit analysis; NaN where it is not known.
    pub(super) fn limit(&self) -> f64 {
        self.limits().map_or(f64::NAN, |limits| limits[1])
    }

    /// The factor to try next: the largest, then the middle of the bracket.
    fn next_factor(&self, seen: &Seen) -> f64 {
        let (stands, fails) = bracket(&seen.trials);
        if seen.trials.is_empty() { self.most } else { 0.5 * (stands + fails) }
    }

    fn is_known(&self, seen: &Seen) -> bool {
        let stands_always = bracket(&seen.trials).1.is_infinite() && !seen.trials.is_empty();
        stands_always || seen.trials.len() >= self.trials as usize
    }

    /// Time (s) between two looks: of equilibrium a step.
    fn look(&self) -> f64 {
        if self.is_implicit() { 1.0 / f64::from(self.load_steps) } else { LOOK }
    }

    /// The metrics of the trials of a ground of this mass (kg/m).
    pub(super) fn measure(&self, trials: &[Trial], mass: f64) -> Vec<(Metric, f64)> {
        let (stands, fails) = bracket(trials);
        let standing = trials.iter().find(|t| t.factor == stands);
        let middle = 0.5 * (stands + fails);
        let factor = if fails.is_finite() { middle } else { stands };
        vec![
            (STRENGTH_REDUCTION_FACTOR, factor),
            (FACTOR_ERROR, (middle / self.limit() - 1.0).abs()),
            (STANDS_AT, stands),
            (FAILS_AT, fails),
            (MOVED_STANDING, standing.map_or(f64::NAN, |t| t.moved)),
            (MASS, mass),
        ]
    }
}

pub(super) struct Trials {
    setup: Setup<Stability>,
    ground: Ground<2>,
}

impl Trials {
    /// Number of steps of a duration (s).
    fn steps(&self, time: f64) -> u64 {
        (time / self.ground.dt).round() as u64
    }

    /// A trial of ground that was at `rest` (m), with the strength of the current simulation.
    fn try_factor(&self, factor: f64, rest: &[[f64; 2]], phase: &mut Phase<2>) -> Result<Trial, Fault> {
        let height = self.setup.height;
        let (mut moved, mut time, mut fails) = (0.0, 0.0, false);
        let looks = if self.setup.is_implicit() { STATIC_LOOKS } else { LOOKS };
        if self.setup.is_implicit() {
            time = 1.0;
            if !finds_equilibrium(phase.steps(self.setup.load_steps as u64))? {
                return Ok(Trial { factor, fails: true, moved, time });
            }
        }
        for _ in 0..looks {
            let found = match self.setup.is_implicit() {
                true => finds_equilibrium(phase.steps(1))?,
                false => phase.steps(self.steps(LOOK)).map(|()| true)?,
            };
            time += self.setup.look();
            let before = moved;
            moved = farthest(rest, &places(phase.run.as_ref()));
            fails = !found || moved > FAILS * height;
            if fails || (moved - before).abs() < RESTS * height {
                break;
            }
        }
        Ok(Trial { factor, fails, moved, time })
    }
}

impl Problem<2> for Trials {
    type Parameters = Stability;
    type Seen = Seen;

    fn new(setup: Setup<Stability>) -> Result<Self, Error> {
        setup.forbid(if setup.is_implicit() { &["cfl", "wall"] } else { &["load_steps", "tolerance"] })?;
        let strain = setup.density * GRAVITY * setup.height / setup.young_modulus;
        let quotient = "density g height / young_modulus";
        let why = "above which it sinks elastically, γ H²/(2 E), by what a slope that fails moves by";
        require_quotient(quotient, strain, 0.0..=2.0 * FAILS, why)?;
        let at_45 = setup.slope().factor_of_safety(setup.strength, STABILITY.0);
        let factor = setup.limits().map_or(at_45, |limits| limits[1]);
        let quotient = "factor of safety by strength, density and height";
        require_quotient(quotient, factor, 1.0..=setup.most, "the factors that are tried")?;
        let ground = Ground::new(&setup, 1.0)?;
        Ok(Self { setup, ground })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, if self.setup.is_implicit() { self.setup.look() } else { self.ground.dt })
    }

    fn begin(&self, seen: &Seen) -> Begun<2> {
        let (setup, ground) = (&self.setup, &self.ground);
        let law = setup.law(seen.factor.unwrap_or(1.0))?;
        if let Some(settings) = setup.implicit_settings(setup.look()) {
            let scene = ground.scene(setup, law, 1.0)?;
            let settings = settings.stabilised(Stabilisation::Ghost(mpm_core::implicit::GHOST));
            return mpm_solvers::implicit(setup.scheme, scene, settings);
        }
        let (rise, damping) = if seen.factor.is_none() { (RISE, STAGE_DAMPING) } else { (0.0, TRIAL_DAMPING) };
        let scene = ground.scene(setup, law, rise)?;
        mpm_solvers::solver(setup.scheme, scene, setup.settings(ground.dt, damping)?)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let is_static = self.setup.is_implicit();
        let ground = match seen.ground.take() {
            Some(body) => body,
            None => {
                phase.steps(if is_static { self.setup.load_steps as u64 } else { self.steps(STAGE) })?;
                seen.rest = places(phase.run.as_ref());
                phase.run.body()?
            }
        };
        let factor = self.setup.next_factor(seen);
        seen.factor = Some(factor);
        phase.enter(self.begin(seen)?, Some(&ground).filter(|_| !is_static))?;
        let trial = self.try_factor(factor, &seen.rest, phase)?;
        seen.ground = Some(ground);
        seen.trials.push(trial);
        Ok(row! {
            "trial (-)": seen.trials.len() as f64,
            "factor (-)": factor,
            "fails (-)": f64::from(u8::from(trial.fails)),
            "moved (m)": trial.moved,
            "time (s)": trial.time,
        })
    }

    fn progress(&self, seen: &Seen, _: &Phase<2>) -> f64 {
        if self.setup.is_known(seen) { 1.0 } else { seen.trials.len() as f64 / f64::from(self.setup.trials) }
    }

    fn particles<'a>(&self, _: &Seen, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.field("plastic_strain", "-", Field::PlasticStrain)
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let mut values = self.setup.measure(&seen.trials, phase.run.totals().mass);
        if self.setup.is_implicit() {
            let iterations = phase.work().newton_iterations;
            values.push((NEWTON_ITERATIONS, iterations as f64));
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::setup;

    fn slope(set: &[&str]) -> Setup<Stability> {
        setup(Scheme::flip(Gimp, RemedyName::None), LEVELS[0], set)
    }

    /// Factors tried until the answer is known, of a slope that fails above `limit`, and the metrics.
    fn bisect(slope: Setup<Stability>, limit: f64) -> (Vec<f64>, impl Fn(Metric) -> f64) {
        let mut seen = Seen::default();
        while !slope.is_known(&seen) {
            let factor = slope.next_factor(&seen);
            seen.trials.push(Trial { factor, fails: factor > limit, moved: 0.01 * factor, time: LOOK });
        }
        let values = slope.measure(&seen.trials, 1.0);
        let value = move |of: Metric| values.iter().find(|(m, _)| *m == of).unwrap().1;
        (seen.trials.iter().map(|t| t.factor).collect(), value)
    }

    #[test]
    fn bisection_closes_in_on_the_limit() {
        let (tried, value) = bisect(slope(&["trials=5"]), 1.65);
        assert_eq!(tried, [3.0, 2.0, 1.5, 1.75, 1.625]);
        assert_eq!([STANDS_AT, FAILS_AT].map(&value), [1.625, 1.75]);
        assert!((value(STRENGTH_REDUCTION_FACTOR) - 1.6875).abs() < 1e-12);
        assert!((value(MOVED_STANDING) - 0.01625).abs() < 1e-12);
        assert!((value(FACTOR_ERROR) - (1.6875 / 1.6532 - 1.0)).abs() < 1e-4);
    }

    #[test]
    fn a_slope_that_stands_at_the_largest_factor_is_tried_no_further() {
        let (tried, value) = bisect(slope(&["most=2"]), 5.0);
        assert_eq!(tried, [2.0]);
        assert_eq!(value(STRENGTH_REDUCTION_FACTOR), 2.0);
        assert!(value(FAILS_AT).is_infinite() && value(FACTOR_ERROR).is_infinite());
    }

    /// 6.04 κ/√2 over ρ g H is 1.653, from 1.646 to 1.664; half of the last bracket is 1/128. On cells of 0.4 m a band is up to
    /// 8 % too strong.
    #[test]
    fn the_bounds_are_those_of_limit_analysis() {
        let own = slope(&[]);
        assert!((own.limit() - 1.6532).abs() < 1e-4);
        let [lower, upper] = own.bounds().unwrap();
        assert!(lower > 1.63 && lower < 1.64 && upper > 1.81 && upper < 1.83);
        assert!(slope(&["face_angle=60"]).bounds().is_none());
        // Chen's 16.16 for 45 and 20 degrees: there c is divided by as much as tan φ.
        let factor = slope(&["friction=20", "strength=14142"]).limit();
        let phi = (20.0_f64.to_radians().tan() / factor).atan();
        let number = spiral::stability_number(45.0_f64.to_radians(), phi).unwrap();
        assert!((number * 1e4 / factor / (2150.0 * GRAVITY * 5.0) - 1.0).abs() < 1e-4);
    }
}
