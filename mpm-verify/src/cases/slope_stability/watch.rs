//! Trials of a slope with reduced strength.

use super::{
    FACTOR_ERROR, FAILS_AT, LOAD_STEPS, MASS, MOST, MOVED_STANDING, NEWTON_ITERATIONS, OF_EXPLICIT,
    OF_QUASI_STATIC, PARAMETERS, STANDS_AT, STRENGTH, STRENGTH_REDUCTION_FACTOR, TRIALS,
};
use crate::cases::landslide::parameters::{DENSITY, FACE_ANGLE, HEIGHT, YOUNG_MODULUS};
use crate::cases::landslide::{
    GRAVITY, Ground, RISE, STABILITY, STAGE, STAGE_DAMPING, factor_of_safety,
};
use crate::cases::observe::{
    column, discretisation, finds_equilibrium, forbid, implicit_settings, position_columns,
};
use crate::cases::parameters::require_quotient;
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::implicit::Stabilisation;
use mpm_core::material::Strength;
use mpm_core::memory::Saved;
use mpm_core::{Field, Simulation};
use mpm_solvers::{implicit, solver};
use serde::{Deserialize, Serialize};

/// A slope that moves by this share of its height in a trial fails.
const FAILS: f64 = 0.02;
/// One that moves by less than this share of its height between two looks has come to rest.
const RESTS: f64 = 1e-5;
/// Time (s) between two looks, and how many a trial takes at most.
const LOOK: f64 = 0.5;
const LOOKS: usize = 8;
/// How many steps of equilibrium a trial takes at most: each moves the particles among the functions, so that they are
/// not at rest at once.
const STATIC_LOOKS: usize = 40;
/// Local damping of a trial.
const TRIAL_DAMPING: f64 = 0.5;
/// Ghost penalty of a quasi-static run, on the increments, which vanish at rest: functions of the rim hardly see
/// material. With a tenth of it the factors are the same; with a hundredth Newton's method stalls on splines below the limit.
const RIM: f64 = 1e-3;

/// A trial.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Trial {
    /// Factor by which the strength is divided.
    factor: f64,
    /// Whether the slope fails.
    fails: bool,
    /// Largest displacement (m) of a particle.
    moved: f64,
    /// Duration (s).
    time: f64,
}

/// What the trials have shown.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// What trials begin from, when gravity acts: the ground at rest with its full strength, or in equilibrium with the
    /// least strength with which it stood.
    ground: Option<Saved>,
    /// Places (m) in it at rest with its full strength, in seeding order.
    rest: Vec<[f64; 2]>,
    trials: Vec<Trial>,
    /// The factor of the last trial, from where it began on; none under rising gravity.
    factor: Option<f64>,
}

impl Seen {
    /// Largest factor at which it stands and least at which it fails, of those tried.
    fn bracket(&self) -> (f64, f64) {
        let of = |fails| {
            self.trials
                .iter()
                .filter(move |t| t.fails == fails)
                .map(|t| t.factor)
        };
        let stands = of(false).fold(1.0, f64::max);
        (stands, of(true).fold(f64::INFINITY, f64::min))
    }
}

/// Trials.
pub(super) struct Trials {
    ground: Ground<2>,
    spec: RunSpec,
    parameters: Parameters,
}

impl Trials {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let foreign: &[&str] = match spec.scheme.rule() {
            Some(_) => &OF_EXPLICIT,
            None => &OF_QUASI_STATIC,
        };
        forbid(spec, parameters, &PARAMETERS, foreign)?;
        let number = |p| parameters.number(p);
        let strain = number(DENSITY) * GRAVITY * number(HEIGHT) / number(YOUNG_MODULUS);
        let why =
            "above which it sinks elastically, γ H²/(2 E), by what a slope that fails moves by";
        require_quotient(
            "density g height / young_modulus",
            strain,
            0.0..=2.0 * FAILS,
            why,
        )?;
        let trials = Self {
            ground: Ground::new(spec, parameters)?,
            spec: spec.clone(),
            parameters: parameters.clone(),
        };
        Ok(Drive::new(trials, Seen::default())?)
    }

    /// The factor of limit analysis; NaN of another angle than 45°.
    fn limit(&self) -> f64 {
        let number = |p| self.parameters.number(p);
        if number(FACE_ANGLE) == 45.0 {
            factor_of_safety(&self.parameters, number(STRENGTH), STABILITY.0)
        } else {
            f64::NAN
        }
    }

    /// The factor to try next: the largest, then the middle of the bracket.
    fn next_factor(&self, seen: &Seen) -> f64 {
        let (stands, fails) = seen.bracket();
        if seen.trials.is_empty() {
            self.parameters.number(MOST)
        } else {
            0.5 * (stands + fails)
        }
    }

    /// Whether no factor is left to try.
    fn is_known(&self, seen: &Seen) -> bool {
        let stands_always = seen.bracket().1.is_infinite() && !seen.trials.is_empty();
        stands_always || seen.trials.len() >= self.parameters.number(TRIALS) as usize
    }

    /// Steps of a duration (s).
    fn steps(&self, time: f64) -> u64 {
        (time / self.ground.dt).round() as u64
    }

    /// Whether a run is of equilibrium, without inertia.
    fn is_static(&self) -> bool {
        self.spec.scheme.rule().is_some()
    }

    /// Raises gravity.
    fn load(&self, stage: &mut Stage<2>) -> Result<(), mpm_core::Error> {
        stage.steps(match self.is_static() {
            true => self.parameters.number(LOAD_STEPS) as u64,
            false => self.steps(STAGE),
        })
    }

    /// Time (s) between two looks: of equilibrium a step.
    fn look(&self) -> f64 {
        match self.is_static() {
            true => 1.0 / self.parameters.number(LOAD_STEPS),
            false => LOOK,
        }
    }

    /// Goes on to the next look; false if there is no equilibrium to go to.
    fn goes_on(&self, stage: &mut Stage<2>) -> Result<bool, mpm_core::Error> {
        match self.is_static() {
            true => finds_equilibrium(stage.steps(1)),
            false => stage.steps(self.steps(LOOK)).map(|()| true),
        }
    }

    /// Lets ground that was at `rest` (m) go on with the strength that the stage has.
    fn try_factor(
        &self,
        factor: f64,
        rest: &[[f64; 2]],
        stage: &mut Stage<2>,
    ) -> Result<Trial, mpm_core::Error> {
        let height = self.ground.section.height;
        let (mut moved, mut time) = (0.0, 0.0);
        let mut fails = false;
        let looks = if self.is_static() {
            STATIC_LOOKS
        } else {
            LOOKS
        };
        for _ in 0..looks {
            let found = self.goes_on(stage)?;
            time += self.look();
            let before = moved;
            moved = farthest(rest, &positions(stage.run.as_ref()));
            fails = !found || moved > FAILS * height;
            if fails || (moved - before).abs() < RESTS * height {
                break;
            }
        }
        Ok(Trial {
            factor,
            fails,
            moved,
            time,
        })
    }

    /// The metrics of what the trials have shown, of a ground of this mass (kg/m).
    fn measure(&self, seen: &Seen, mass: f64) -> Vec<(Metric, f64)> {
        let (stands, fails) = seen.bracket();
        let standing = seen.trials.iter().find(|t| t.factor == stands);
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

/// Places (m) in seeding order.
fn positions(run: &dyn Simulation<2>) -> Vec<[f64; 2]> {
    let p = run.particles();
    p.seeded(|k| p.position[k])
}

/// Largest distance (m) between places and those before.
fn farthest(before: &[[f64; 2]], now: &[[f64; 2]]) -> f64 {
    let pairs = before.iter().zip(now);
    let distance = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    distance.fold(0.0, f64::max)
}

impl Watch<2> for Trials {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        let dt = match self.is_static() {
            true => self.look(),
            false => self.ground.dt,
        };
        discretisation(2, &self.spec, &self.parameters, dt)
    }

    fn scene(&self, seen: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        let strength = self.parameters.number(STRENGTH) / seen.factor.unwrap_or(1.0);
        let strength = Strength::perfect(strength)?;
        let (spec, parameters) = (&self.spec, &self.parameters);
        if let Some(settings) = implicit_settings(spec, parameters, self.look()) {
            let rise = if seen.factor.is_none() { 1.0 } else { 0.0 };
            let scene = self
                .ground
                .under_gravity(spec, parameters, strength, rise)?;
            let settings = settings.stabilised(Stabilisation::Ghost(RIM));
            return implicit(spec.scheme, scene, settings);
        }
        let stages = match seen.factor {
            None => (RISE, STAGE_DAMPING),
            Some(_) => (0.0, TRIAL_DAMPING),
        };
        let (scene, settings) = self.ground.scene(spec, parameters, strength, stages)?;
        solver(spec.scheme, scene, settings)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "trial (-)",
            "factor (-)",
            "fails (-)",
            "moved (m)",
            "time (s)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let ground = match seen.ground.take() {
            Some(body) => body,
            None => {
                self.load(stage)?;
                seen.rest = positions(stage.run.as_ref());
                stage.run.body()?
            }
        };
        let factor = self.next_factor(seen);
        seen.factor = Some(factor);
        stage.enter(self.scene(seen)?, Some(&ground))?;
        let trial = self.try_factor(factor, &seen.rest, stage)?;
        let goes_on = self.is_static() && !trial.fails;
        seen.ground = Some(if goes_on { stage.run.body()? } else { ground });
        seen.trials.push(trial);
        let fails = f64::from(u8::from(trial.fails));
        let count = seen.trials.len() as f64;
        Ok(vec![count, factor, fails, trial.moved, trial.time])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        if self.is_known(seen) {
            return 1.0;
        }
        seen.trials.len() as f64 / self.parameters.number(TRIALS)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let strain = stage.run.field(Field::PlasticStrain);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.push(column("plastic_strain", "-", p.seeded(|k| strain[k])));
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let mut values = self.measure(seen, stage.run.totals().mass);
        if self.is_static() {
            let iterations = stage.work().newton_iterations;
            values.push((NEWTON_ITERATIONS, iterations as f64));
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::super::{PARAMETERS, levels};
    use super::*;
    use crate::scheme::{BasisName, RemedyName, Scheme};

    fn slope(set: &[&str]) -> Trials {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        let spec = RunSpec {
            scheme: Scheme::flip(BasisName::Gimp, RemedyName::None),
            level: levels()[0],
            set: set.clone(),
            perturbed: false,
        };
        let parameters = Parameters::new(&PARAMETERS, &set).unwrap();
        Trials {
            ground: Ground::new(&spec, &parameters).unwrap(),
            spec,
            parameters,
        }
    }

    /// Tries factors until the answer is known, where the slope fails above `limit`.
    fn bisect(slope: &Trials, limit: f64) -> Seen {
        let mut seen = Seen::default();
        while !slope.is_known(&seen) {
            let factor = slope.next_factor(&seen);
            seen.trials.push(Trial {
                factor,
                fails: factor > limit,
                moved: 0.01 * factor,
                time: LOOK,
            });
        }
        seen
    }

    fn tried(seen: &Seen) -> Vec<f64> {
        seen.trials.iter().map(|t| t.factor).collect()
    }

    fn value(slope: &Trials, seen: &Seen, of: Metric) -> f64 {
        let values = slope.measure(seen, 1.0);
        values.into_iter().find(|(m, _)| *m == of).unwrap().1
    }

    #[test]
    fn bisection_closes_in_on_the_limit() {
        let slope = slope(&["trials=5"]);
        let seen = bisect(&slope, 1.65);
        assert_eq!(tried(&seen), [3.0, 2.0, 1.5, 1.75, 1.625]);
        assert_eq!(seen.bracket(), (1.625, 1.75));
        let value = |of| value(&slope, &seen, of);
        assert!((value(STRENGTH_REDUCTION_FACTOR) - 1.6875).abs() < 1e-12);
        assert!((value(MOVED_STANDING) - 0.01625).abs() < 1e-12);
        assert!((value(FACTOR_ERROR) - (1.6875 / 1.6532 - 1.0)).abs() < 1e-4);
    }

    #[test]
    fn a_slope_that_stands_at_the_largest_factor_is_tried_no_further() {
        let slope = slope(&["most=2"]);
        let seen = bisect(&slope, 5.0);
        assert_eq!(tried(&seen), [2.0]);
        let value = |of| value(&slope, &seen, of);
        assert_eq!(value(STRENGTH_REDUCTION_FACTOR), 2.0);
        assert!(value(FAILS_AT).is_infinite() && value(FACTOR_ERROR).is_infinite());
    }

    #[test]
    fn trials_are_told_by_the_particle_that_moved_farthest() {
        let moved = farthest(&[[0.0, 0.0], [1.0, 1.0]], &[[0.1, 0.0], [4.0, 5.0]]);
        assert!((moved - 5.0).abs() < 1e-12);
    }
}
