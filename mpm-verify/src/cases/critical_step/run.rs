//! Scene and observations of the lattice: a row for every step that is tried.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::stable_step::Setting;
use crate::scheme::Explicit;
use mpm_core::explicit::Settings;
use mpm_solvers::solver;

/// Cells of a period, or of the body where it has a free end; cells beside it there.
pub(super) const PERIOD: usize = 6;
const ROOM: usize = 3;
/// Least and greatest CFL number of a trial, and how many there are: each halves the range of the logarithm.
const LEAST: f64 = 1e-3;
const MOST: f64 = 1.0;
const TRIALS: usize = 10;
/// Speed of the noise over that of waves; its strain, for waves of the nodes that no particle's velocity feeds, but less
/// than a pressure that an average can't see may drive within a run; and growth of what is unstable.
const NOISE: f64 = 1e-6;
const STRAIN: f64 = 1e-8;
const GROWN: f64 = 100.0;
/// Least share of its part of the noise that a single wave has, with a probability of 97 %.
const SHARE: f64 = 0.02;
/// Relative step of a derivative.
const STEP: f64 = 1e-5;
/// Jitter in shares of a particle.
const JITTER: f64 = 0.25;

#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Grown(Vec<bool>);

impl Grown {
    /// The logarithms of the CFL numbers between which the critical one is.
    fn range(&self) -> [f64; 2] {
        self.0.iter().fold([LEAST.ln(), MOST.ln()], |[lo, hi], grew| {
            let middle = 0.5 * (lo + hi);
            if *grew { [lo, middle] } else { [middle, hi] }
        })
    }

    fn cfl(&self) -> f64 {
        let [lo, hi] = self.range();
        (0.5 * (lo + hi)).exp()
    }
}

pub(super) struct Trials<const D: usize> {
    setup: Setup<Step>,
    scheme: Explicit,
    /// The law without a viscosity.
    law: NeoHookean,
    /// Speed of waves (m/s) of the state of the start along the axis.
    speed: f64,
}

impl<const D: usize> Trials<D> {
    /// Half the size of a particle, in cells.
    fn half_size(&self) -> f64 {
        0.5 / self.setup.ppc_per_direction as f64
    }

    /// Places of the particles of a cell along an axis, in cells.
    fn places(&self, axis: usize) -> Vec<f64> {
        let n = self.setup.ppc_per_direction;
        let jitter = if self.setup.layout == Layout::Jittered { JITTER } else { 0.0 };
        (0..n).map(|k| (k as f64 + 0.5 + jitter * noise(axis * n + k)) / n as f64).collect()
    }

    /// How far the body is moved so that its outermost functions see the first particle over `cut` alone, in cells.
    fn shift(&self) -> f64 {
        // The functions of a point begin at a grid line, those of GIMP half a particle beside it.
        let first = self.half_size();
        let edge = if self.scheme.basis == Gimp { 0.0 } else { first };
        ROOM as f64 - edge - self.setup.cut
    }

    fn trial(&self, cfl: f64) -> Begun<D> {
        let h = self.setup.h;
        let stretch = self.setup.stretch;
        let along = |axis: usize| {
            let shift = if axis == 0 && self.setup.layout == Layout::Cut { self.shift() } else { 0.0 };
            let places = self.places(axis);
            (0..PERIOD).flat_map(|c| places.iter().map(move |x| (x + c as f64 + shift) * h)).collect()
        };
        let places = lattice(std::array::from_fn(along));
        let size = 2.0 * self.half_size() * h;
        let volume = size.powi(D as i32) / stretch;
        let places = self.setup.start_at(places);
        let mut particles =
            Particles::new(places, volume, DENSITY, [0.5 * size; D])?.deformed(|x| (*x, stretched(stretch)));
        for (k, v) in particles.velocity.iter_mut().flatten().enumerate() {
            *v = NOISE * self.speed * noise(k);
        }
        for (k, f) in particles.delta_f.iter_mut().enumerate() {
            *f *= 1.0 + STRAIN * noise(k);
        }
        let axis = |a: usize| match a {
            0 if self.setup.layout == Layout::Cut => Axis::open(0.0, PERIOD + 2 * ROOM),
            _ => Axis::periodic(0.0, PERIOD),
        };
        let grid = Grid::new(h, std::array::from_fn(axis))?;
        let viscosity = self.setup.linear_viscosity;
        let body = match viscosity > 0.0 {
            true => Bodies::new(Viscous::new(self.law, DENSITY, h, [viscosity, 0.0])?, particles)?,
            false => Bodies::new(self.law, particles)?,
        };
        let scene = Scene::new(grid, body);
        let settings = Settings::new(courant_time_step(cfl, h, self.speed));
        solver(self.setup.scheme, scene, settings.remedy(self.scheme.remedy.build()))
    }

    /// The lattice as linear analysis sees it.
    fn setting(&self) -> Setting {
        let (law, stretch) = (self.law, self.setup.stretch);
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
            viscosity: self.setup.linear_viscosity,
        }
    }
}

impl<const D: usize> Problem<D> for Trials<D> {
    type Parameters = Step;
    type Seen = Grown;

    fn new(setup: Setup<Step>) -> Result<Self, Error> {
        let Scheme::Explicit(scheme) = setup.scheme else {
            let solver = setup.scheme.solver();
            return Err(Error::unknown("solver with a largest step", solver, ["explicit"]));
        };
        let (stretch, viscosity) = (setup.stretch, setup.linear_viscosity);
        let out_of_range = |name: &str, value: f64, place: &str, allowed: f64| {
            Err(Error::Input(format!("{name} = {value} is out of range {place}; allowed: {allowed}")))
        };
        if D > 1 && stretch != 1.0 {
            return out_of_range("stretch", stretch, "in two and three dimensions", 1.0);
        }
        if viscosity > 0.0 && (D > 1 || stretch != 1.0) {
            return out_of_range("linear_viscosity", viscosity, "but in one dimension without a stretch", 0.0);
        }
        let law = NeoHookean::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let (stress, state) = law.at_rest(&stretched::<3>(stretch));
        let speed = (law.wave_modulus(stretch, &stress, &state) / DENSITY).sqrt();
        Ok(Self { scheme, law, speed, setup })
    }

    fn discretisation(&self) -> Discretisation {
        let longest = courant_time_step(MOST, self.setup.h, self.speed);
        // The lattice has no walls.
        Discretisation { wall: String::new(), ..self.setup.regular(D, longest) }
    }

    fn begin(&self, seen: &Grown) -> Begun<D> {
        self.trial(seen.cfl())
    }

    fn row(&self, seen: &mut Grown, phase: &mut Phase<D>) -> Result<Row, Fault> {
        let cfl = seen.cfl();
        if !seen.0.is_empty() {
            phase.enter(self.trial(cfl)?, None)?;
        }
        // Nodes count too: a wave that changes sign from node to node may leave the particles between alone.
        let energy = |phase: &Phase<D>| phase.run.totals().kinetic_energy + phase.run.residual().kinetic_energy;
        let (start, begun) = (energy(phase), phase.work().steps);
        let steps = self.setup.steps as u64;
        let mut growth = 1.0;
        for _ in 0..steps {
            match phase.steps(1) {
                // `min` turns NaN into infinity.
                Ok(()) => growth = (energy(phase) / start).sqrt().min(f64::INFINITY),
                // A trial that breaks down has a step that is too long.
                Err(Fault::Breakdown { .. }) => growth = f64::INFINITY,
                Err(other) => return Err(other),
            }
            if growth >= GROWN {
                break;
            }
        }
        seen.0.push(growth >= GROWN);
        Ok(row! {
            "trial (-)": seen.0.len() as f64,
            "cfl (-)": cfl,
            "growth (-)": growth.min(GROWN),
            "steps (-)": (phase.work().steps - begun) as f64,
        })
    }

    fn progress(&self, seen: &Grown, _: &Phase<D>) -> f64 {
        seen.0.len() as f64 / TRIALS as f64
    }

    fn metrics(&self, seen: &Grown, _: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let [stable, _] = seen.range();
        let mut values = vec![(CRITICAL_CFL, stable.exp())];
        let setting = self.setting();
        if self.setup.layout == Layout::Cut {
            // A node of its own: one function sees one particle with the weight ε, so that g = τ²/ε and Π̂ = ε.
            let cut = self.setup.cut;
            if self.scheme.basis == Linear {
                values.push((PREDICTED_CFL, (4.0 * cut / (2.0 - cut)).sqrt()));
            }
        } else if let Some([cfl, fed]) = setting.predicted() {
            values.push((PREDICTED_CFL, cfl));
            if fed > 0.0 {
                let modes = (PERIOD as f64 / (2.0 * self.half_size())).powi(D as i32) * D as f64;
                let growth = (GROWN * modes.sqrt() / SHARE).ln();
                values.push((FED_CFL, growth / (fed * f64::from(self.setup.steps))));
            }
        }
        let offered = mpm_solvers::stable_cfl(self.scheme.basis, D, self.half_size());
        values.extend(offered.map(|cfl| (OFFERED_CFL, cfl)));
        values
    }
}
