//! A body: one material, one set of particles, and the state of each.

use crate::error::{Error, Fault};
use crate::material::Law;
use crate::memory::{MemoryError, Saved};
use crate::monitor::{Accumulated, Totals};
use crate::parallel::{AT_ONCE, CHUNK};
use crate::particles::{Particles, permute};
use crate::space;
use rayon::prelude::*;

/// Particles of one material with their states.
pub struct Body<const D: usize, M: Law> {
    /// The law of the material.
    pub law: M,
    /// The particles.
    pub particles: Particles<D>,
    /// What the law remembers of each.
    states: Vec<M::State>,
}

impl<const D: usize, M: Law> Body<D, M> {
    /// The body at the start: at the deformation gradients of the particles' `delta_f`, with the stress and state of rest
    /// there.
    ///
    /// # Errors
    /// [`Error::Breakdown`] of a particle whose J is not positive and finite.
    pub fn new(law: M, particles: Particles<D>) -> Result<Self, Error> {
        let mut body = Self {
            states: Vec::with_capacity(particles.len()),
            law,
            particles,
        };
        let p = &mut body.particles;
        for (k, f) in p.delta_f.iter().enumerate() {
            let j = space::determinant(f);
            check_jacobian(j).map_err(|fault| Error::Breakdown {
                time: 0.0,
                step: 0,
                particle: p.id[k],
                fault,
            })?;
            let (stress, state) = body.law.at_rest(&space::embed(f));
            body.states.push(state);
            (p.jacobian[k], p.stress[k]) = (j, stress);
            p.volume[k] = j * p.reference_volume[k];
        }
        Ok(body)
    }

    /// What the law remembers of each particle.
    #[must_use]
    pub(crate) fn states(&self) -> &[M::State] {
        &self.states
    }

    /// Speed of pressure waves (m/s) where the undeformed material is least dense.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        let p = &self.particles;
        let densities = p.mass.iter().zip(&p.reference_volume).map(|(m, v)| m / v);
        self.law.wave_speed(densities.fold(f64::INFINITY, f64::min))
    }

    /// Stress and state of the particles after the deformation ΔF̄ of their `delta_f` over `dt` (s), Eq. (22), and
    /// their volume, Eq. (15).
    pub fn update_stress(&mut self, dt: f64) {
        let (law, p) = (&self.law, &mut self.particles);
        (
            self.states.par_chunks_mut(CHUNK),
            p.stress.par_chunks_mut(CHUNK),
            p.volume.par_chunks_mut(CHUNK),
            p.delta_f.par_chunks(CHUNK),
            p.jacobian.par_chunks(CHUNK),
            p.reference_volume.par_chunks(CHUNK),
        )
            .into_par_iter()
            .with_max_len(AT_ONCE)
            .for_each(|(states, stress, volume, delta_f, j, reference_volume)| {
                law.update_all(|k| space::embed(&delta_f[k]), dt, states, stress);
                for (volume, (j, reference)) in
                    volume.iter_mut().zip(j.iter().zip(reference_volume))
                {
                    *volume = j * reference;
                }
            });
    }

    /// Mass, momentum, energies and J, with what was `accumulated`.
    #[must_use]
    pub fn totals(&self, accumulated: Accumulated) -> Totals {
        Totals::of(&self.law, &self.particles, &self.states, accumulated)
    }

    /// Equivalent plastic strain of every particle.
    #[must_use]
    pub fn plastic_strain(&self) -> Vec<f64> {
        let strain = |state| self.law.plastic_strain(state);
        self.states.iter().map(strain).collect()
    }

    /// Puts the particles in the order `order`: entry `k` becomes the former entry `order[k]`.
    pub fn permute(&mut self, order: &[u32]) {
        self.particles.permute(order);
        permute(&mut self.states, order);
    }

    /// Particles and states as bytes.
    ///
    /// # Errors
    /// A value that has no bytes.
    pub fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(&self.particles, &self.states))
    }

    /// Replaces particles and states by those that were saved, once `check` has passed the particles.
    ///
    /// # Errors
    /// The memory of another body, or what `check` finds; the body then stays as it was.
    pub fn restore(
        &mut self,
        saved: &Saved,
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        let (particles, states): (Particles<D>, Vec<M::State>) = saved.read("a body")?;
        particles.check_against(&self.particles)?;
        MemoryError::unless_equal("states", states.len(), self.states.len())?;
        check(&particles)?;
        (self.particles, self.states) = (particles, states);
        Ok(())
    }
}

/// Checks that a Jacobian is positive and finite.
pub(crate) fn check_jacobian(j: f64) -> Result<(), Fault> {
    if j > 0.0 && j < f64::INFINITY {
        return Ok(());
    }
    if !j.is_finite() {
        return Err(Fault::NotFinite {
            quantity: "Jacobian J",
            value: j,
        });
    }
    Err(Fault::NonPositiveJacobian(j))
}
