//! A body: one material, one set of particles, and the state of each.

use crate::eights::{block, entries, fetch, fetch_rows, matrix_entries, numbers};
use crate::error::{Error, Fault};
use crate::material::{AnyLaw, SharedLaw};
use crate::memory::{MemoryError, Saved};
use crate::monitor::{Accumulated, Totals};
use crate::number::{EIGHT, Eight};
use crate::parallel::{Front, Rows};
use crate::particles::{Particles, permute};
use crate::space;
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;

/// Particles of one material with their states.
pub struct Body<const D: usize> {
    /// The law of the material.
    pub law: SharedLaw,
    /// The particles.
    pub particles: Particles<D>,
    /// The rows of the particles' states.
    states: Vec<f64>,
}

impl<const D: usize> Body<D> {
    /// The body at the start: at the deformation gradients of the particles' `delta_f`, with the stress and state of
    /// rest there.
    ///
    /// # Errors
    /// [`Error::Breakdown`] of a particle whose J is not positive and finite.
    pub fn new(law: impl Into<SharedLaw>, mut particles: Particles<D>) -> Result<Self, Error> {
        let law = law.into();
        let p = &mut particles;
        let mut states = vec![0.0; law.numbers() * p.len()];
        for (k, (f, row)) in p.delta_f.iter().zip(states.chunks_exact_mut(law.numbers())).enumerate() {
            let j = space::determinant(f);
            check_jacobian(j).map_err(|fault| Error::Breakdown { time: 0.0, step: 0, particle: p.id[k], fault })?;
            (p.jacobian[k], p.stress[k]) = (j, law.at_rest(&space::embed(f), row));
            p.volume[k] = j * p.reference_volume[k];
        }
        Ok(Self { law, particles, states })
    }

    /// State of a particle, by its place in the columns.
    pub(crate) fn state(&self, p: usize) -> &[f64] {
        let n = self.law.numbers();
        &self.states[p * n..(p + 1) * n]
    }

    /// Least density of the undeformed material (kg/m³).
    pub fn least_density(&self) -> f64 {
        let p = &self.particles;
        let densities = p.mass.iter().zip(&p.reference_volume).map(|(m, v)| m / v);
        densities.fold(f64::INFINITY, f64::min)
    }

    /// Greatest [`AnyLaw::wave_modulus`] of its particles (Pa).
    pub fn wave_modulus(&self) -> f64 {
        let p = &self.particles;
        let columns = p.jacobian.iter().zip(&p.stress).enumerate();
        let moduli = columns.map(|(k, (j, stress))| self.law.wave_modulus(*j, stress, self.state(k)));
        moduli.fold(0.0, f64::max)
    }

    /// Stress and state of the particles after the deformation ΔF̄ of their `delta_f` over `dt` (s), Eq. (22), and
    /// their volume, Eq. (15).
    pub fn update_stress(&mut self, dt: f64) {
        let (law, p, n) = (&self.law, &mut self.particles, self.law.numbers());
        for (k, rows) in self.states.chunks_mut(EIGHT * n).enumerate() {
            let delta_f = matrix_entries(block(&p.delta_f, k, &mut None));
            let stresses = &mut p.stress[k * EIGHT..];
            law.update_eight(delta_f.as_flattened(), dt, numbers(&p.jacobian, k), rows, stresses);
        }
        let columns = p.jacobian.iter().zip(&p.reference_volume);
        for (volume, (j, reference)) in p.volume.iter_mut().zip(columns) {
            *volume = j * reference;
        }
    }

    /// All particles, for threads to share in chunks.
    pub fn chunk(&mut self) -> Chunk<'_, D> {
        let p = &mut self.particles;
        Chunk {
            begin: 0,
            states: Rows { entries: &mut self.states, width: self.law.numbers() },
            law: self.law.as_ref(),
            position: &mut p.position,
            velocity: &mut p.velocity,
            affine: &mut p.affine,
            volume: &mut p.volume,
            jacobian: &mut p.jacobian,
            j_bar: &mut p.j_bar,
            stress: &mut p.stress,
            increment: &mut p.increment,
            reference_volume: &p.reference_volume,
            external_force: &p.external_force,
        }
    }

    /// Mass, momentum, energies and J, with what was `accumulated`.
    pub fn totals(&self, accumulated: Accumulated) -> Totals {
        let energy = |p| self.law.energy(self.state(p));
        Totals::of(&self.particles, energy, accumulated)
    }

    /// Equivalent plastic strain of every particle.
    pub fn plastic_strain(&self) -> Vec<f64> {
        (0..self.particles.len()).map(|p| self.law.plastic_strain(self.state(p))).collect()
    }

    /// Puts the particles in the order `order`: entry `k` becomes the former entry `order[k]`.
    pub fn permute(&mut self, order: &[u32]) {
        self.particles.permute(order);
        permute(&mut self.states, order, self.law.numbers());
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
        self.replace(saved.read("a body")?, check)
    }

    /// Goes on with the body of another run, of which it has the particles that were seeded first; `check` is asked
    /// before that. See [`Simulation::take_over`](crate::Simulation::take_over).
    pub(crate) fn go_on_with(
        &mut self,
        saved: &Saved,
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        let (mut particles, mut states): (Particles<D>, Vec<f64>) = saved.read("a body")?;
        MemoryError::unless_equal("numbers of states", states.len(), self.law.numbers() * particles.len())?;
        if particles.len() > self.particles.len() {
            particles.check_whole()?;
            let order = particles.first(self.particles.len());
            particles.permute(&order);
            permute(&mut states, &order, self.law.numbers());
        }
        particles.go_on_as(&self.particles);
        self.replace((particles, states), check)
    }

    fn replace(
        &mut self,
        (particles, states): (Particles<D>, Vec<f64>),
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        particles.check_against(&self.particles)?;
        MemoryError::unless_equal("numbers of states", states.len(), self.states.len())?;
        check(&particles)?;
        (self.particles, self.states) = (particles, states);
        Ok(())
    }
}

/// Some particles of a body: a slice of all columns; absent columns give empty slices.
pub struct Chunk<'a, const D: usize> {
    /// The law of the material.
    pub law: &'a dyn AnyLaw,
    /// The place of the first particle in the columns.
    pub begin: usize,
    /// The law's states.
    pub states: Rows<'a, f64>,
    /// Position x (m).
    pub position: &'a mut [[f64; D]],
    /// Velocity v (m/s).
    pub velocity: &'a mut [[f64; D]],
    /// Moment B (m²/s).
    pub affine: &'a mut [SMatrix<f64, D, D>],
    /// Volume V (m³).
    pub volume: &'a mut [f64],
    /// Jacobian J.
    pub jacobian: &'a mut [f64],
    /// Averaged Jacobian J̄.
    pub j_bar: &'a mut [f64],
    /// Cauchy stress (Pa).
    pub stress: &'a mut [SymmetricTensor],
    /// Displacement of the step (m).
    pub increment: &'a mut [[f64; D]],
    /// Reference volume V⁰ (m³).
    pub reference_volume: &'a [f64],
    /// External force (N).
    pub external_force: &'a [[f64; D]],
}

impl<const D: usize> Chunk<'_, D> {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Asks the processor for what the `k`-th eight needs to move.
    #[inline(always)]
    pub fn fetch_motion(&self, k: usize) {
        fetch(self.position, k);
        fetch(self.velocity, k);
        fetch(self.affine, k);
        fetch(self.volume, k);
        fetch(self.jacobian, k);
        fetch(self.stress, k);
        fetch(self.increment, k);
        fetch(self.external_force, k);
    }

    /// Prefetches what the law and the position of the `k`-th eight need.
    #[inline(always)]
    pub fn fetch_second_half(&self, k: usize) {
        fetch_rows(self.states.entries, k, self.states.width);
        fetch(self.position, k);
        fetch(self.volume, k);
        fetch(self.jacobian, k);
        fetch(self.j_bar, k);
        fetch(self.stress, k);
        fetch(self.reference_volume, k);
    }

    /// The numbers of the `k`-th eight; zero beyond the last particle.
    #[inline(always)]
    pub fn present(&self, k: usize, numbers: Eight) -> Eight {
        let entries = entries(self.len(), k);
        if entries == EIGHT {
            return numbers;
        }
        let mut numbers = numbers.to_array();
        numbers[entries..].fill(0.0);
        Eight::new(numbers)
    }
}

impl<const D: usize> Front for Chunk<'_, D> {
    fn front(&mut self, pieces: usize, size: usize) -> Self {
        let begin = self.begin;
        self.begin += self.len().min(pieces * size);
        Self {
            law: self.law,
            begin,
            states: self.states.front(pieces, size),
            position: self.position.front(pieces, size),
            velocity: self.velocity.front(pieces, size),
            affine: self.affine.front(pieces, size),
            volume: self.volume.front(pieces, size),
            jacobian: self.jacobian.front(pieces, size),
            j_bar: self.j_bar.front(pieces, size),
            stress: self.stress.front(pieces, size),
            increment: self.increment.front(pieces, size),
            reference_volume: self.reference_volume.front(pieces, size),
            external_force: self.external_force.front(pieces, size),
        }
    }
}

/// Checks that a Jacobian is positive and finite.
pub(crate) fn check_jacobian(j: f64) -> Result<(), Fault> {
    if j > 0.0 && j < f64::INFINITY {
        return Ok(());
    }
    if !j.is_finite() {
        return Err(Fault::NotFinite { quantity: "Jacobian J", value: j });
    }
    Err(Fault::NonPositiveJacobian(j))
}
