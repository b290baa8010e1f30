//! The body of the waves: a fluid under a mean stress on a periodic grid.

use super::model::{CELLS, H, Kind};
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{NewtonianFluid, shared};
use mpm_core::number::Real;
use mpm_core::{Axis, Bodies, Grid, Law, Particles, Scene, SymmetricTensor};
use nalgebra::Matrix3;

pub(super) const DENSITY: f64 = 2.0;

/// A fluid under the stress `mean` (Pa, tension positive): σ = mean + K (J̄ − 1).
pub(super) struct Prestressed {
    bulk: NewtonianFluid,
    mean: f64,
}

impl Law for Prestressed {
    type State = f64;

    fn in_units(&self, stress: f64) -> Self {
        Self { bulk: self.bulk.in_units(stress), mean: stress * self.mean }
    }

    fn initial_state(&self) -> f64 {
        1.0
    }

    fn resting(&self, f: &Matrix3<f64>, undeformed: &f64) -> (SymmetricTensor, f64) {
        let (stress, state) = self.bulk.resting(f, undeformed);
        (stress.scale_add_identity(1.0, self.mean), state)
    }

    fn response<T: Real>(&self, delta_f: &Matrix3<T>, dt: f64, state: &T) -> (SymmetricTensor<T>, T) {
        let (stress, state) = self.bulk.response(delta_f, dt, state);
        let mean = T::splat(self.mean);
        (stress.scale_add_identity(T::splat(1.0), mean), state)
    }

    fn energy(&self, state: &f64) -> f64 {
        self.mean * (state - 1.0) + self.bulk.energy(state)
    }

    fn wave_modulus<T: Real>(&self, j: T, stress: &SymmetricTensor<T>, state: &T) -> T {
        self.bulk.wave_modulus(j, stress, state)
    }
}

pub(super) const FLUID: NewtonianFluid = NewtonianFluid { bulk_modulus: 50.0, viscosity: 0.0 };

/// Wave speed of [`FLUID`] (m/s).
pub(super) const C: f64 = 5.0;

/// `n` particles per cell and direction, at the middle of their shares, on a periodic grid.
pub(super) fn scene<const D: usize>(n: usize, kind: Kind, cfl: f64, mean: f64) -> (Scene<D>, Settings<D>) {
    let spacing = H / n as f64;
    let count = CELLS * n;
    let positions = (0..count.pow(D as u32))
        .map(|k| std::array::from_fn(|a| ((k / count.pow(a as u32) % count) as f64 + 0.5) * spacing))
        .collect();
    let mut particles = Particles::new(positions, spacing.powi(D as i32), DENSITY, [0.5 * spacing; D]).unwrap();
    particles.stress.fill(SymmetricTensor::identity().scale_add_identity(mean, 0.0));
    let grid = Grid::new(H, [Axis::periodic(0.0, CELLS); D]).unwrap();
    let law = Prestressed { bulk: FLUID, mean };
    let settings = Settings::new(courant_time_step(cfl, H, C)).remedy(kind.remedy());
    (Scene::new(grid, Bodies::new(shared(law), particles).unwrap()), settings)
}
