//! A run: a row for every step that is tried.

use super::metrics as m;
use super::parameters::{
    CUT, CUT_WORD, JITTERED, LAYOUT, LINEAR_VISCOSITY, POISSON_RATIO, PPC_PER_DIRECTION, STEPS,
    STRETCH,
};
use super::theory::Setting;
use crate::cases::noise::noise;
use crate::cases::observe::{discretisation, position_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::{BasisName, Explicit, Scheme};
use crate::spec::RunSpec;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::NeoHookean;
use mpm_core::{Axis, Body, Error as Fault, Grid, Law, Particles, Scene, Simulation};
use mpm_solvers::{Solvable, solver};
use nalgebra::SMatrix;
use serde::{Deserialize, Serialize};

/// Cells of a period, or of the body where it has a free end; cells beside it there.
pub(super) const PERIOD: usize = 6;
const ROOM: usize = 3;
/// Young's modulus (Pa) and density (kg/m³).
const YOUNG_MODULUS: f64 = 1e6;
pub(super) const DENSITY: f64 = 1000.0;
/// Least and greatest CFL number of a trial, and how many there are: each halves the range of the logarithm.
const LEAST: f64 = 1e-3;
const MOST: f64 = 1.0;
pub(super) const TRIALS: usize = 10;
/// Speed of the noise over that of waves; its strain, for waves of the nodes that no particle's velocity feeds, but less
/// than a pressure that an average can't see may drive within a run; and growth of what is unstable.
const NOISE: f64 = 1e-6;
const STRAIN: f64 = 1e-8;
pub(super) const GROWN: f64 = 100.0;
/// The share of its part of the noise that a single wave has at least, but for three chances in a hundred.
const SHARE: f64 = 0.02;
/// Relative step of a derivative.
const STEP: f64 = 1e-5;
/// Jitter in shares of a particle.
const JITTER: f64 = 0.25;

/// What has been seen: whether noise grew, trial by trial.
#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Seen(Vec<bool>);

impl Seen {
    /// The logarithms of the CFL numbers between which the critical one is.
    fn range(&self) -> [f64; 2] {
        let whole = [LEAST.ln(), MOST.ln()];
        self.0.iter().fold(whole, |[lo, hi], grew| {
            let middle = 0.5 * (lo + hi);
            if *grew { [lo, middle] } else { [middle, hi] }
        })
    }

    /// The next CFL number.
    fn cfl(&self) -> f64 {
        let [lo, hi] = self.range();
        (0.5 * (lo + hi)).exp()
    }
}

/// A lattice of particles of the law `M` with noise.
pub(super) struct Trials<const D: usize, M> {
    spec: RunSpec,
    parameters: Parameters,
    scheme: Explicit,
    /// The law without a viscosity, and as the particles have it.
    law: NeoHookean,
    material: M,
    /// Speed of waves (m/s) of the state of the start along the axis.
    speed: f64,
    discretisation: Discretisation,
}

impl<const D: usize, M: Solvable<D> + Copy> Trials<D, M> {
    /// A run at its start, of particles of what `material` makes of their law.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
        material: impl FnOnce(NeoHookean) -> Result<M, Fault>,
    ) -> Result<Drive<D, Self>, Error> {
        let Scheme::Explicit(scheme) = spec.scheme else {
            let solver = spec.scheme.solver();
            return Err(Error::unknown(
                "solver with a largest step",
                solver,
                ["explicit"],
            ));
        };
        let stretch = parameters.number(STRETCH);
        let viscosity = parameters.number(LINEAR_VISCOSITY);
        let out_of_range = |name: &str, value: f64, place: &str, allowed: f64| {
            let why = format!("{name} = {value} is out of range {place}; allowed: {allowed}");
            Err(Error::Input(why))
        };
        if D > 1 && stretch != 1.0 {
            return out_of_range("stretch", stretch, "in two and three dimensions", 1.0);
        }
        if viscosity > 0.0 && (D > 1 || stretch != 1.0) {
            let place = "but in one dimension without a stretch";
            return out_of_range("linear_viscosity", viscosity, place, 0.0);
        }
        let law = NeoHookean::new(YOUNG_MODULUS, parameters.number(POISSON_RATIO))?;
        let (stress, state) = law.at_rest(&stretched::<3>(stretch));
        let speed = (law.wave_modulus(stretch, &stress, &state) / DENSITY).sqrt();
        let longest = courant_time_step(MOST, spec.level.h, speed);
        let trials = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            scheme,
            law,
            material: material(law)?,
            speed,
            discretisation: discretisation(D, spec, parameters, longest),
        };
        Ok(Drive::new(trials, Seen::default())?)
    }

    fn is_cut(&self) -> bool {
        self.parameters.is(LAYOUT, CUT_WORD)
    }

    /// Half the size of a particle, in cells.
    fn half_size(&self) -> f64 {
        0.5 / self.parameters.number(PPC_PER_DIRECTION)
    }

    /// Places of the particles of a cell along an axis, in cells.
    fn places(&self, axis: usize) -> Vec<f64> {
        let n = self.parameters.number(PPC_PER_DIRECTION) as usize;
        let jitter = if self.parameters.is(LAYOUT, JITTERED) {
            JITTER
        } else {
            0.0
        };
        let place = |k: usize| (k as f64 + 0.5 + jitter * noise(axis * n + k)) / n as f64;
        (0..n).map(place).collect()
    }

    /// How far the body is moved so that its outermost functions see the first particle over `cut` alone, in cells.
    fn shift(&self) -> f64 {
        // The functions of a point begin at a grid line, those of GIMP half a particle beside it.
        let first = self.half_size();
        let edge = if self.scheme.basis == BasisName::Gimp {
            0.0
        } else {
            first
        };
        ROOM as f64 - edge - self.parameters.number(CUT)
    }

    fn trial(&self, cfl: f64) -> Result<Box<dyn Simulation<D>>, Fault> {
        let h = self.spec.level.h;
        let stretch = self.parameters.number(STRETCH);
        let axes: Vec<Vec<f64>> = (0..D)
            .map(|axis| {
                let shift = if axis == 0 && self.is_cut() {
                    self.shift()
                } else {
                    0.0
                };
                let places = self.places(axis);
                let cell = |c: usize| places.iter().map(move |x| (x + c as f64 + shift) * h);
                (0..PERIOD).flat_map(cell).collect()
            })
            .collect();
        let counts = axes.iter().map(Vec::len);
        let places = (0..counts.product()).map(|mut k: usize| {
            std::array::from_fn(|a| {
                let n = axes[a].len();
                let x = axes[a][k % n];
                k /= n;
                x
            })
        });
        let size = 2.0 * self.half_size() * h;
        let volume = size.powi(D as i32) / stretch;
        let places = self.spec.start_at(places.collect());
        let mut particles = Particles::new(places, volume, DENSITY, [0.5 * size; D])?
            .deformed(|x| (*x, stretched(stretch)));
        for (k, v) in particles.velocity.iter_mut().flatten().enumerate() {
            *v = NOISE * self.speed * noise(k);
        }
        for (k, f) in particles.delta_f.iter_mut().enumerate() {
            *f *= 1.0 + STRAIN * noise(k);
        }
        let axis = |a: usize| match a {
            0 if self.is_cut() => Axis::open(0.0, PERIOD + 2 * ROOM),
            _ => Axis::periodic(0.0, PERIOD),
        };
        let grid = Grid::new(h, std::array::from_fn(axis))?;
        let scene = Scene::new(grid, Body::new(self.material, particles)?);
        let settings = Settings::new(courant_time_step(cfl, h, self.speed));
        solver(
            self.spec.scheme,
            scene,
            settings.remedy(self.scheme.remedy.build()),
        )
    }

    /// What linear analysis says.
    fn setting(&self) -> Setting {
        let (law, stretch) = (self.law, self.parameters.number(STRETCH));
        let modulus = DENSITY * self.speed * self.speed;
        // P = σ in uniaxial strain; the stiffness of what is deformed, F² dP/dF, is at most the law's modulus.
        let nominal = |stretch: f64| law.at_rest(&stretched::<3>(stretch)).0.get(0, 0);
        let rise = nominal(stretch * (1.0 + STEP)) - nominal(stretch * (1.0 - STEP));
        Setting {
            scheme: self.scheme,
            places: (0..D).map(|axis| self.places(axis)).collect(),
            half_size: self.half_size(),
            period: PERIOD,
            axial: stretch * rise / (2.0 * STEP) / modulus,
            shear: law.mu / modulus,
            mean_stress: stretch * nominal(stretch) / modulus,
            viscosity: self.parameters.number(LINEAR_VISCOSITY),
        }
    }
}

/// A stretch along the first axis.
fn stretched<const D: usize>(stretch: f64) -> SMatrix<f64, D, D> {
    let mut f = SMatrix::identity();
    f[(0, 0)] = stretch;
    f
}

impl<const D: usize, M: Solvable<D> + Copy> Watch<D> for Trials<D, M> {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, seen: &Seen) -> Result<Box<dyn Simulation<D>>, Fault> {
        self.trial(seen.cfl())
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["trial (-)", "cfl (-)", "growth (-)", "steps (-)"]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, Fault> {
        let cfl = seen.cfl();
        if !seen.0.is_empty() {
            stage.enter(self.trial(cfl)?, None)?;
        }
        // That of the nodes too: a wave that changes sign from node to node may leave the particles between alone.
        let energy = |stage: &Stage<D>| {
            stage.run.totals().kinetic_energy + stage.run.residual().kinetic_energy
        };
        let (start, begun) = (energy(stage), stage.work().steps);
        let steps = self.parameters.number(STEPS) as u64;
        let mut growth = 1.0;
        for _ in 0..steps {
            match stage.steps(1) {
                // Of no number `min` gives the other: it is infinite.
                Ok(()) => growth = (energy(stage) / start).sqrt().min(f64::INFINITY),
                // A trial that breaks down has told what it should: the step is too long.
                Err(Fault::Breakdown { .. }) => growth = f64::INFINITY,
                Err(other) => return Err(other),
            }
            if growth >= GROWN {
                break;
            }
        }
        let grew = growth >= GROWN;
        seen.0.push(grew);
        Ok(vec![
            seen.0.len() as f64,
            cfl,
            growth.min(GROWN),
            (stage.work().steps - begun) as f64,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<D>) -> f64 {
        seen.0.len() as f64 / TRIALS as f64
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        position_columns(stage.run.particles())
    }

    fn metrics(&self, seen: &Seen, _: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let [stable, _] = seen.range();
        let mut values = vec![(m::CRITICAL_CFL, stable.exp())];
        let setting = self.setting();
        if self.is_cut() {
            // A node of its own: one function sees one particle with the weight ε, so that g = τ²/ε and Π̂ = ε.
            let cut = self.parameters.number(CUT);
            if self.scheme.basis == BasisName::Linear {
                values.push((m::PREDICTED_CFL, (4.0 * cut / (2.0 - cut)).sqrt()));
            }
        } else if let Some([cfl, fed]) = setting.predicted() {
            values.push((m::PREDICTED_CFL, cfl));
            if fed > 0.0 {
                let modes = (PERIOD as f64 / (2.0 * self.half_size())).powi(D as i32) * D as f64;
                let growth = (GROWN * modes.sqrt() / SHARE).ln();
                values.push((m::FED_CFL, growth / (fed * self.parameters.number(STEPS))));
            }
        }
        let offered = mpm_solvers::stable_cfl(self.scheme.basis, D, self.half_size());
        values.extend(offered.map(|cfl| (m::OFFERED_CFL, cfl)));
        values
    }
}
