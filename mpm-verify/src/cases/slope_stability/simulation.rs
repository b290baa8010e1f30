//! Trials of a slope with reduced strength.

use super::METRICS;
use crate::case::{Column, Job, RunSpec, observed};
use crate::cases::landslide::{DAMPING, Ground, RISE, STABILITY, STAGE, factor_of_safety};
use crate::error::Error;
use crate::parameter::Parameters;
use crate::record::{Discretisation, Metric, WorkDone};
use mpm_core::material::Strength;
use mpm_core::memory::{Memory, MemoryError, Saved};
use mpm_core::{Field, Simulation};
use mpm_solvers::solver;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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

/// Trials, all from the same ground at rest with its full strength.
pub(super) struct Simulated {
    /// Under rising gravity; then the last trial.
    simulation: Box<dyn Simulation<2>>,
    /// The ground at rest, when it is.
    at_rest: Option<Saved>,
    trials: Vec<Trial>,
    done: WorkDone,
    ground: Ground<2>,
    spec: RunSpec,
    parameters: Parameters,
}

impl Simulated {
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let ground = Ground::new(spec, parameters)?;
        let strength = Strength::perfect(parameters.number("strength"))?;
        let (scene, settings) = ground.scene(spec, parameters, strength, (RISE, DAMPING))?;
        Ok(Self {
            simulation: solver(spec.scheme, scene, settings)?,
            at_rest: None,
            trials: Vec::new(),
            done: WorkDone::default(),
            ground,
            spec: spec.clone(),
            parameters: parameters.clone(),
        })
    }

    /// Largest factor at which it stands and least at which it fails, of those tried.
    fn bracket(&self) -> (f64, f64) {
        let of = |fails| {
            self.trials
                .iter()
                .filter(move |t| t.fails == fails)
                .map(|t| t.factor)
        };
        (
            of(false).fold(1.0, f64::max),
            of(true).fold(f64::INFINITY, f64::min),
        )
    }

    /// The factor of limit analysis; NaN of another angle than 45°.
    fn limit(&self) -> f64 {
        let number = |name| self.parameters.number(name);
        if number("face_angle") == 45.0 {
            factor_of_safety(&self.parameters, number("strength"), STABILITY.0)
        } else {
            f64::NAN
        }
    }

    /// The factor to try next: the largest, then the middle of the bracket.
    fn next_factor(&self) -> f64 {
        let (stands, fails) = self.bracket();
        if self.trials.is_empty() {
            self.parameters.number("most")
        } else {
            0.5 * (stands + fails)
        }
    }

    /// Whether no factor is left to try.
    fn is_known(&self) -> bool {
        let stands_always = self.bracket().1.is_infinite() && !self.trials.is_empty();
        stands_always || self.trials.len() >= self.parameters.number("trials") as usize
    }

    fn step_for(&mut self, time: f64) -> Result<(), mpm_core::Error> {
        for _ in 0..(time / self.ground.dt).round() as u64 {
            self.simulation.step()?;
        }
        Ok(())
    }

    fn scene_of(&self, factor: f64) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        let strength = Strength::perfect(self.parameters.number("strength") / factor)?;
        let stages = (0.0, TRIAL_DAMPING);
        let (scene, settings) =
            self.ground
                .scene(&self.spec, &self.parameters, strength, stages)?;
        solver(self.spec.scheme, scene, settings)
    }

    fn positions(&self) -> Vec<[f64; 2]> {
        let p = self.simulation.particles();
        p.seeded(|k| p.position[k])
    }

    fn try_factor(&mut self, factor: f64) -> Result<Trial, mpm_core::Error> {
        let height = self.ground.section.height;
        let start = self.positions();
        let (mut moved, mut time) = (0.0, 0.0);
        let mut fails = false;
        while time < LONGEST - 0.5 * LOOK {
            self.step_for(LOOK)?;
            time += LOOK;
            let before = moved;
            moved = farthest(&start, &self.positions());
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
}

/// Largest distance (m) between places and those before.
fn farthest(before: &[[f64; 2]], now: &[[f64; 2]]) -> f64 {
    let pairs = before.iter().zip(now);
    let distance = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    distance.fold(0.0, f64::max)
}

impl Memory for Simulated {
    fn save(&self) -> Result<Saved, MemoryError> {
        let simulation = self.simulation.save()?;
        Saved::of(&(simulation, &self.at_rest, &self.trials, self.done))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let simulation: Saved;
        (simulation, self.at_rest, self.trials, self.done) = saved.read("the slope")?;
        self.simulation.restore(&simulation)
    }
}

impl Job for Simulated {
    fn discretisation(&self) -> Discretisation {
        let per_direction = self.parameters.number("ppc_per_direction");
        Discretisation {
            dim: 2,
            h: self.spec.level.h,
            ppc: (per_direction * per_direction) as u32,
            dt: self.ground.dt,
            wall: self.parameters.text("wall"),
        }
    }

    fn series_columns(&self) -> Vec<&'static str> {
        vec![
            "trial (-)",
            "factor (-)",
            "fails (-)",
            "moved (m)",
            "time (s)",
        ]
    }

    fn advance(&mut self) -> Result<Vec<f64>, mpm_core::Error> {
        let at_rest = match &self.at_rest {
            Some(body) => body.clone(),
            None => {
                self.step_for(STAGE)?;
                let body = self.simulation.body()?;
                self.at_rest = Some(body.clone());
                body
            }
        };
        let factor = self.next_factor();
        let mut trial = self.scene_of(factor)?;
        trial.take_over(&at_rest)?;
        self.done = self.work();
        self.simulation = trial;
        let trial = self.try_factor(factor)?;
        self.trials.push(trial);
        let fails = f64::from(u8::from(trial.fails));
        let count = self.trials.len() as f64;
        Ok(vec![count, factor, fails, trial.moved, trial.time])
    }

    fn finished(&self) -> bool {
        self.is_known()
    }

    fn progress(&self) -> f64 {
        self.trials.len() as f64 / self.parameters.number("trials")
    }

    fn particles(&mut self) -> Vec<Column> {
        let column = |name, unit, values| Column { name, unit, values };
        let strain = self.simulation.field(Field::PlasticStrain);
        let p = self.simulation.particles();
        vec![
            column("x", "m", p.seeded(|k| p.position[k][0])),
            column("y", "m", p.seeded(|k| p.position[k][1])),
            column("plastic_strain", "-", p.seeded(|k| strain[k])),
        ]
    }

    fn metrics(&mut self) -> BTreeMap<String, Metric> {
        let (stands, fails) = self.bracket();
        let standing = self.trials.iter().find(|t| t.factor == stands);
        let factor = if fails.is_finite() {
            0.5 * (stands + fails)
        } else {
            stands
        };
        let values = vec![
            ("strength_reduction_factor", factor),
            (
                "factor_error",
                (0.5 * (stands + fails) / self.limit() - 1.0).abs(),
            ),
            ("stands_at", stands),
            ("fails_at", fails),
            ("moved_standing", standing.map_or(f64::NAN, |t| t.moved)),
            ("mass", self.simulation.totals().mass),
        ];
        observed(METRICS, values)
    }

    fn work(&self) -> WorkDone {
        let now: WorkDone = self.simulation.work().into();
        now.after(self.done)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{LEVELS, PARAMETERS};
    use super::*;
    use crate::scheme::{BasisName, RemedyName, Scheme};

    fn slope(set: &[&str]) -> Simulated {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        let spec = RunSpec {
            scheme: Scheme::flip(BasisName::Gimp, RemedyName::None),
            level: LEVELS[0],
            set: set.clone(),
            perturbed: false,
        };
        Simulated::new(&spec, &Parameters::new(&PARAMETERS, &set).unwrap()).unwrap()
    }

    /// Tries factors until the answer is known, where the slope fails above `limit`.
    fn bisect(slope: &mut Simulated, limit: f64) -> Vec<f64> {
        while !slope.is_known() {
            let factor = slope.next_factor();
            slope.trials.push(Trial {
                factor,
                fails: factor > limit,
                moved: 0.01 * factor,
                time: LOOK,
            });
        }
        slope.trials.iter().map(|t| t.factor).collect()
    }

    #[test]
    fn bisection_closes_in_on_the_limit() {
        let mut slope = slope(&["trials=5"]);
        let tried = bisect(&mut slope, 1.65);
        assert_eq!(tried, [3.0, 2.0, 1.5, 1.75, 1.625]);
        assert_eq!(slope.bracket(), (1.625, 1.75));
        let metrics = slope.metrics();
        let value = |name: &str| metrics[name].value.unwrap();
        assert!((value("strength_reduction_factor") - 1.6875).abs() < 1e-12);
        assert!((value("moved_standing") - 0.01625).abs() < 1e-12);
        assert!((value("factor_error") - (1.6875 / 1.6532 - 1.0)).abs() < 1e-4);
    }

    #[test]
    fn a_slope_that_stands_at_the_largest_factor_is_tried_no_further() {
        let mut slope = slope(&["most=2"]);
        assert_eq!(bisect(&mut slope, 5.0), [2.0]);
        let metrics = slope.metrics();
        assert_eq!(metrics["strength_reduction_factor"].value, Some(2.0));
        assert_eq!(metrics["fails_at"].value, None);
        assert_eq!(metrics["factor_error"].value, None);
    }

    #[test]
    fn trials_are_told_by_the_particle_that_moved_farthest() {
        let moved = farthest(&[[0.0, 0.0], [1.0, 1.0]], &[[0.1, 0.0], [4.0, 5.0]]);
        assert!((moved - 5.0).abs() < 1e-12);
    }
}
