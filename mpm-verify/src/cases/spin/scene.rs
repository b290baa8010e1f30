//! Where the disc begins, and the exact rotating disc.

use super::parameters::{FLIP, POISSON_RATIO, PPC_PER_DIRECTION, RIM_SPEED, TURNS};
use crate::cases::observe::settings;
use crate::cases::parameters::cfl;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::explicit::courant_time_step;
use mpm_core::explicit::transfer::Flip;
use mpm_core::material::NeoHookean;
use mpm_core::{Axis, Body, Grid, Law, Particles, Scene, Simulation};
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::TAU;

/// Radius (m), density (kg/m³), Young's modulus (Pa).
pub(super) const RADIUS: f64 = 1.0;
const DENSITY: f64 = 1000.0;
const YOUNG_MODULUS: f64 = 1e6;
/// Cells of room on every side.
const ROOM: f64 = 2.0;

/// A disc that turns as one, at small strain: Timoshenko & Goodier, §32, with the constants of plane strain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disc {
    pub(super) law: NeoHookean,
    /// Angular velocity (rad/s), time step (s), steps.
    pub(super) omega: f64,
    pub(super) dt: f64,
    pub(super) steps: u64,
    /// u = k r ((3 − 2ν) R² − r²); k (1/m²).
    factor: f64,
    ratio: f64,
}

impl Disc {
    /// The disc of these parameters on the cells of a run.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let number = |p| parameters.number(p);
        let ratio = number(POISSON_RATIO);
        let law = NeoHookean::new(YOUNG_MODULUS, ratio)?;
        let speed = law.wave_speed(DENSITY);
        let omega = number(RIM_SPEED) * speed / RADIUS;
        let cfl = cfl(spec, parameters, 2, 0.5 / number(PPC_PER_DIRECTION))?;
        let dt = courant_time_step(cfl, spec.level.h, speed);
        let stiffness = 8.0 * YOUNG_MODULUS * (1.0 - ratio);
        Ok(Self {
            law,
            omega,
            dt,
            steps: (number(TURNS) * TAU / omega / dt).ceil() as u64,
            factor: DENSITY * omega * omega * (1.0 + ratio) * (1.0 - 2.0 * ratio) / stiffness,
            ratio,
        })
    }

    /// Place (m) and deformation gradient of the material at `x` (m) before it turns, from the centre.
    pub(super) fn state(&self, x: &[f64; 2]) -> ([f64; 2], Matrix2<f64>) {
        let x = Vector2::from(*x);
        let free = (3.0 - 2.0 * self.ratio) * RADIUS * RADIUS;
        let stretch = 1.0 + self.factor * (free - x.norm_squared());
        let gradient = Matrix2::identity() * stretch - x * x.transpose() * (2.0 * self.factor);
        ((x * stretch).into(), gradient)
    }

    /// The simulation at its start; velocities live half a step before places.
    ///
    /// # Errors
    /// The parameters don't make a scene, or the scheme doesn't solve it.
    pub(super) fn begin(
        &self,
        spec: &RunSpec,
        parameters: &Parameters,
    ) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        let h = spec.level.h;
        let reach = (RADIUS / h).ceil() + ROOM;
        let grid = Grid::new(h, [Axis::open(-reach * h, 2 * reach as usize); 2])?;
        let size = h / parameters.number(PPC_PER_DIRECTION);
        let along = (2.0 * RADIUS / size).round() as usize;
        let place = |k: usize| (k as f64 + 0.5) * size - RADIUS;
        let places = (0..along * along).map(|k| [place(k / along), place(k % along)]);
        let places = places.filter(|[x, y]| x.hypot(*y) <= RADIUS).collect();
        let mut particles =
            Particles::new(spec.start_at(places), size * size, DENSITY, [0.5 * size; 2])?
                .deformed(|x| self.state(x));
        let (sin, cos) = (-0.5 * self.omega * self.dt).sin_cos();
        for (v, [x, y]) in particles.velocity.iter_mut().zip(&particles.position) {
            let earlier = [cos * x - sin * y, sin * x + cos * y];
            *v = [-self.omega * earlier[1], self.omega * earlier[0]];
        }
        let scene = Scene::new(grid, Body::new(self.law, particles)?);
        let settings = settings(spec, parameters, self.dt, 0.0)?;
        let settings = settings.transfer(Flip::new(parameters.number(FLIP))?);
        mpm_solvers::solver(spec.scheme, scene, settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::{BasisName, RemedyName, Scheme};

    fn spec(basis: BasisName) -> RunSpec {
        RunSpec {
            scheme: Scheme::flip(basis, RemedyName::None),
            level: super::super::LEVELS[0],
            set: Vec::new(),
            perturbed: false,
        }
    }

    #[test]
    fn the_step_by_rule_is_that_of_the_steepest_functions() {
        let p = Parameters::new(&super::super::parameters::ALL, &["time_step=auto".into()]);
        let p = p.unwrap();
        let dt =
            |basis| Disc::new(&spec(basis), &p).map(|disc| disc.dt * disc.law.wave_speed(DENSITY));
        let h = super::super::LEVELS[0].h;
        // √(2/(D s)) with s = 6.
        assert!((dt(BasisName::Bspline2).unwrap() / h - 6f64.sqrt().recip()).abs() < 1e-9);
        let refusal = dt(BasisName::Linear).unwrap_err().to_string();
        assert!(refusal.contains("time_step = auto"), "{refusal}");
    }

    /// Equilibrium in a turning frame, and no traction at the rim, to second order in the strain.
    #[test]
    fn the_disc_is_in_equilibrium() {
        let p =
            Parameters::new(&super::super::parameters::ALL, &["rim_speed=0.01".into()]).unwrap();
        let spec = spec(BasisName::Gimp);
        let disc = Disc::new(&spec, &p).unwrap();
        let stress = |r: f64| {
            let (_, f) = disc.state(&[r, 0.0]);
            let mut three = nalgebra::Matrix3::identity();
            three.fixed_view_mut::<2, 2>(0, 0).copy_from(&f);
            let (s, _) = disc.law.at_rest(&three);
            [s.get(0, 0), s.get(1, 1)]
        };
        let load = DENSITY * disc.omega.powi(2);
        assert!(
            stress(RADIUS)[0].abs() < 1e-3 * load,
            "{:?} {load}",
            stress(RADIUS)
        );
        for r in [0.2, 0.5, 0.9] {
            let d = 1e-4;
            let [radial, hoop] = stress(r);
            let slope = (stress(r + d)[0] - stress(r - d)[0]) / (2.0 * d);
            let left = slope + (radial - hoop) / r + load * r;
            assert!(left.abs() < 1e-3 * load, "{r}: {left} {load}");
        }
    }
}
