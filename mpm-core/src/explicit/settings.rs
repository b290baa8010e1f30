//! Settings of the explicit solver.

use super::remedy::{Remedy, Standard};
use super::transfer::Flip;
use crate::basis::WallTreatment;
use crate::stage::{ForceFilter, ParticleFilter};

/// How the explicit solver solves a scene: by default with FLIP, without a remedy and without filters.
pub struct Settings<const D: usize, T = Flip> {
    /// Time step Δt (s).
    pub dt: f64,
    /// How B-splines meet walls.
    pub wall: WallTreatment,
    /// The particle–grid transfer.
    pub transfer: T,
    /// The locking remedy of the body.
    pub remedy: Box<dyn Remedy<D>>,
    /// Filters of nodal forces.
    pub force_filters: Vec<Box<dyn ForceFilter>>,
    /// Filters of particles.
    pub particle_filters: Vec<Box<dyn ParticleFilter<D>>>,
}

/// The time step (s) of CFL number `cfl` for waves of speed `c` (m/s) on cells of size `h` (m).
pub fn courant_time_step(cfl: f64, h: f64, c: f64) -> f64 {
    cfl * h / c
}

/// The CFL number c Δt/h, in `dimension` dimensions, up to which steps of particles at rest are stable however they
/// lie, on functions of a [`Basis::steepness`](crate::Basis::steepness) `steepness`: √(2/(D s)).
///
/// With nodal masses m_i = Σ m w and stiffness K, g = Δt² λ(M⁻¹K) ≤ 2 suffices: FLIP's two by two matrix has its
/// determinant between 1 − g and 1 and its trace 2 − g. K and M are sums over particles, of K_p and of M_p = m diag(w),
/// so that λ is at most the greatest λ(M_p⁻¹K_p) ≤ D c² s/h² (Irons & Treharne 1971, for finite elements).
pub fn stable_cfl(dimension: usize, steepness: f64) -> f64 {
    (2.0 / (dimension as f64 * steepness)).sqrt()
}

impl<const D: usize> Settings<D> {
    /// Steps of `dt` (s).
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self {
            dt,
            wall: WallTreatment::OpenKnot,
            transfer: Flip::default(),
            remedy: Box::new(Standard),
            force_filters: Vec::new(),
            particle_filters: Vec::new(),
        }
    }
}

impl<const D: usize, T> Settings<D, T> {
    /// With B-splines that meet walls in this way.
    #[must_use]
    pub fn wall(mut self, wall: WallTreatment) -> Self {
        self.wall = wall;
        self
    }

    /// With another transfer.
    pub fn transfer<U>(self, transfer: U) -> Settings<D, U> {
        Settings {
            dt: self.dt,
            wall: self.wall,
            transfer,
            remedy: self.remedy,
            force_filters: self.force_filters,
            particle_filters: self.particle_filters,
        }
    }

    /// With another remedy.
    #[must_use]
    pub fn remedy(mut self, remedy: Box<dyn Remedy<D>>) -> Self {
        self.remedy = remedy;
        self
    }

    /// With another filter of nodal forces.
    #[must_use]
    pub fn filter_forces(mut self, filter: impl ForceFilter + 'static) -> Self {
        self.force_filters.push(Box::new(filter));
        self
    }

    /// With another filter of particles.
    #[must_use]
    pub fn filter_particles(mut self, filter: impl ParticleFilter<D> + 'static) -> Self {
        self.particle_filters.push(Box::new(filter));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_a_share_of_the_time_over_a_cell() {
        assert_eq!(courant_time_step(0.5, 4.0, 8.0), 0.25);
        assert_eq!(stable_cfl(1, 2.0), 1.0);
        assert_eq!(stable_cfl(2, 4.0), 0.5);
    }
}
