//! Trials of a slope with reduced strength.

use super::{
    FACTOR_ERROR, FAILS_AT, MASS, MOST, MOVED_STANDING, STANDS_AT, STRENGTH,
    STRENGTH_REDUCTION_FACTOR, TRIALS,
};
use crate::cases::landslide::parameters::FACE_ANGLE;
use crate::cases::landslide::{Ground, RISE, STABILITY, STAGE, STAGE_DAMPING, factor_of_safety};
use crate::cases::observe::{column, discretisation, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::material::Strength;
use mpm_core::memory::Saved;
use mpm_core::{Field, Simulation};
use mpm_solvers::solver;
use serde::{Deserialize, Serialize};

/// A slope that moves by this share of its height in a trial fails.
const FAILS: f64 = 0.02;
/// One that moves by less than this share of its height between two looks has come to rest.
const RESTS: f64 = 1e-5;
/// Longest duration (s) of a trial, and time (s) between two looks.
const LONGEST: f64 = 4.0;
const LOOK: f64 = 0.5;
/// Local damping of a trial.
const TRIAL_DAMPING: f64 = 0.5;

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
    /// The ground at rest with its full strength, when it is.
    at_rest: Option<Saved>,
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

/// Trials, all from the same ground at rest with its full strength.
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

    fn try_factor(&self, factor: f64, stage: &mut Stage<2>) -> Result<Trial, mpm_core::Error> {
        let height = self.ground.section.height;
        let start = positions(stage.run.as_ref());
        let (mut moved, mut time) = (0.0, 0.0);
        let mut fails = false;
        while time < LONGEST - 0.5 * LOOK {
            stage.steps(self.steps(LOOK))?;
            time += LOOK;
            let before = moved;
            moved = farthest(&start, &positions(stage.run.as_ref()));
            fails = moved > FAILS * height;
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
        discretisation(2, &self.spec, &self.parameters, self.ground.dt)
    }

    fn scene(&self, seen: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        let stages = match seen.factor {
            None => (RISE, STAGE_DAMPING),
            Some(_) => (0.0, TRIAL_DAMPING),
        };
        let strength = self.parameters.number(STRENGTH) / seen.factor.unwrap_or(1.0);
        let strength = Strength::perfect(strength)?;
        let (scene, settings) =
            self.ground
                .scene(&self.spec, &self.parameters, strength, stages)?;
        solver(self.spec.scheme, scene, settings)
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
        let at_rest = match seen.at_rest.take() {
            Some(body) => body,
            None => {
                stage.steps(self.steps(STAGE))?;
                stage.run.body()?
            }
        };
        let factor = self.next_factor(seen);
        seen.factor = Some(factor);
        stage.enter(self.scene(seen)?, Some(&at_rest))?;
        seen.at_rest = Some(at_rest);
        let trial = self.try_factor(factor, stage)?;
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
        self.measure(seen, stage.run.totals().mass)
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
