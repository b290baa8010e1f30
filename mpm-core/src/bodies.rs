//! Bodies: each one material, one set of particles, and the state of each.

use crate::eights::{block, entries, fetch, fetch_rows, matrix_entries, numbers};
use crate::error::{Error, Fault, positive, require};
use crate::frame::Frame;
use crate::material::{AnyLaw, SharedLaw, strain_under};
use crate::memory::{MemoryError, Saved};
use crate::monitor::{Accumulated, Totals};
use crate::number::{EIGHT, Eight};
use crate::parallel::{CHUNK, Front, Rows};
use crate::particles::{Particles, permute};
use crate::space;
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;
use std::ops::Range;

/// One of several bodies: its material, and how it meets the others.
pub struct Body {
    /// The law of the material.
    pub law: SharedLaw,
    /// Whether the remedy of the run averages over its particles. Averages never reach from one body into another.
    pub averages: bool,
    /// Coulomb's coefficient μ with which it slides on other bodies, of a body that has a velocity field of its own; a body
    /// that sticks to the others has none.
    pub slides: Option<f64>,
    /// Whether it begins under a stress that is not that of its deformation.
    stressed: bool,
    /// Its particles, by place in the columns.
    range: Range<usize>,
    /// The rows of their states.
    states: Vec<f64>,
}

/// Particles of one or several bodies with their states; those of a body stand side by side.
pub struct Bodies<const D: usize> {
    /// The particles of all bodies.
    pub particles: Particles<D>,
    /// The bodies, in the order of their particles.
    pub each: Vec<Body>,
}

impl Body {
    /// Its particles, by place in the columns.
    pub fn range(&self) -> Range<usize> {
        self.range.clone()
    }

    /// State of a particle, by its place in the columns.
    pub(crate) fn state(&self, p: usize) -> &[f64] {
        let (n, k) = (self.law.numbers(), p - self.range.start);
        &self.states[k * n..(k + 1) * n]
    }

    /// Gives its particles the states that their stresses are of.
    fn take_stress<const D: usize>(&mut self, particles: &Particles<D>) -> Result<(), Error> {
        self.stressed = true;
        for (p, row) in self.range.clone().zip(self.states.chunks_exact_mut(self.law.numbers())) {
            let (what, allowed) = ("stress σ_xx at the start", "one that the law has without flow (Pa)");
            let beyond = Error::Input { what, value: particles.stress[p].xx, allowed };
            self.law.at_rest(&strain_under(self.law.as_ref(), &particles.stress[p], row).ok_or(beyond)?, row);
        }
        Ok(())
    }

    /// Least density of the undeformed material (kg/m³).
    pub fn least_density<const D: usize>(&self, particles: &Particles<D>) -> f64 {
        let densities = self.range().map(|p| particles.mass[p] / particles.reference_volume[p]);
        densities.fold(f64::INFINITY, f64::min)
    }
}

impl<const D: usize> Bodies<D> {
    /// One body at the start: at the deformation gradients of the particles' `delta_f`, with the stress and state of
    /// rest there.
    ///
    /// # Errors
    /// [`Error::Breakdown`] of a particle whose J is not positive and finite.
    pub fn new(law: impl Into<SharedLaw>, particles: Particles<D>) -> Result<Self, Error> {
        let range = 0..particles.len();
        Self { particles, each: Vec::new() }.with(law.into(), range, Vec::new())
    }

    /// With another body, of the `particles`, which go after those that are there. It sticks to the others, and the
    /// remedy averages over it.
    ///
    /// # Errors
    /// As [`Self::new`]; particles of another size.
    pub fn and(mut self, law: impl Into<SharedLaw>, particles: Particles<D>) -> Result<Self, Error> {
        for (half, own) in particles.half_size.into_iter().zip(self.particles.half_size) {
            require(half == own, "half size of the particles of another body", half, "that of the first body (m)")?;
        }
        let begin = self.particles.len();
        self.particles.append(particles);
        let end = self.particles.len();
        self.with(law.into(), begin..end, Vec::new())
    }

    /// The same bodies, of which the last one slides on others with Coulomb's coefficient μ = `friction`.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite.
    pub fn sliding(mut self, friction: f64) -> Result<Self, Error> {
        require(friction >= 0.0, "friction between bodies", friction, "zero or positive")?;
        if let Some(body) = self.each.last_mut() {
            body.slides = Some(friction);
        }
        Ok(self)
    }

    /// The same bodies, of which the last one has no remedy.
    #[must_use]
    pub fn without_remedy(mut self) -> Self {
        if let Some(body) = self.each.last_mut() {
            body.averages = false;
        }
        self
    }

    /// The same bodies, of which particles of the last one have `share` times the strength of its law, a function of their
    /// numbers: clay that gets stronger with depth. It comes before [`Self::under`].
    ///
    /// # Errors
    /// A share that is not positive and finite; a law without a strength that particles can have.
    pub fn stronger(mut self, share: impl Fn(usize) -> f64) -> Result<Self, Error> {
        if let Some(Body { law, states, .. }) = self.each.last_mut() {
            for (number, row) in states.chunks_exact_mut(law.numbers()).enumerate() {
                let share = share(number);
                positive(share, "strength of a particle over that of its law", "positive")?;
                let allowed = "a law whose particles can have a strength: that of Mohr and Coulomb";
                require(law.stronger(row, share), "strength of a particle over that of its law", share, allowed)?;
            }
        }
        Ok(self)
    }

    /// The same bodies, of which the last one begins under a Cauchy stress (Pa), a function of its particle's number and
    /// place (m): ground under its weight. Places and volumes stay those of its particles; its states are those of the elastic strain that the law
    /// has this stress at.
    ///
    /// # Errors
    /// A stress that the law has at no strain without flow.
    pub fn under(mut self, stress: impl Fn(usize, &[f64; D]) -> SymmetricTensor) -> Result<Self, Error> {
        if let Some(body) = self.each.last_mut() {
            for (number, k) in body.range().enumerate() {
                self.particles.stress[k] = stress(number, &self.particles.position[k]);
            }
            body.take_stress(&self.particles)?;
        }
        Ok(self)
    }

    /// With a body of `law` whose particles stand in a `range`, and keep what was given to them in `states`.
    fn with(mut self, law: SharedLaw, range: Range<usize>, mut states: Vec<f64>) -> Result<Self, Error> {
        let (p, n) = (&mut self.particles, law.numbers());
        states.resize(n * range.len(), 0.0);
        for (k, row) in range.clone().zip(states.chunks_exact_mut(n)) {
            let f = &p.delta_f[k];
            let j = space::determinant(f);
            check_jacobian(j).map_err(|fault| Error::Breakdown { time: 0.0, step: 0, particle: p.id[k], fault })?;
            (p.jacobian[k], p.stress[k]) = (j, law.at_rest(&space::embed(f), row));
            p.volume[k] = j * p.reference_volume[k];
        }
        self.each.push(Body { law, averages: true, slides: None, stressed: false, range, states });
        Ok(self)
    }

    /// The body of a particle, by its place in the columns.
    pub(crate) fn of(&self, p: usize) -> &Body {
        &self.each[self.place_of(p)]
    }

    /// The place of that body in the list.
    pub fn place_of(&self, p: usize) -> usize {
        self.each.partition_point(|body| body.range.end <= p)
    }

    /// Greatest [`AnyLaw::wave_modulus`] of the particles of every body (Pa).
    pub fn wave_moduli(&self) -> Vec<f64> {
        let p = &self.particles;
        let greatest = |body: &Body| {
            let of = |k| body.law.wave_modulus(p.jacobian[k], &p.stress[k], body.state(k));
            body.range().map(of).fold(0.0, f64::max)
        };
        self.each.iter().map(greatest).collect()
    }

    /// The same bodies, before their first step, seen from `frame`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn seen_from(&self, frame: &Frame<D>) -> Result<Self, Error> {
        let mut seen = Self { particles: self.particles.seen_from(frame), each: Vec::new() };
        for body in &self.each {
            seen = seen.with(body.law.in_units(frame.scale(1, 0)), body.range(), body.states.clone())?;
        }
        for (own, body) in seen.each.iter_mut().zip(&self.each) {
            (own.averages, own.slides) = (body.averages, body.slides);
            if body.stressed {
                for k in body.range() {
                    seen.particles.stress[k] = frame.stress(&self.particles.stress[k]);
                }
                own.take_stress(&seen.particles)?;
            }
        }
        Ok(seen)
    }

    /// Stress and state of the particles after the deformation ΔF̄ of their `delta_f` over `dt` (s), Eq. (22), and
    /// their volume, Eq. (15).
    pub fn update_stress(&mut self, dt: f64) {
        let p = &mut self.particles;
        for Body { law, range, states, .. } in &mut self.each {
            for (k, rows) in states.chunks_mut(EIGHT * law.numbers()).enumerate() {
                let delta_f = matrix_entries(block(&p.delta_f[range.clone()], k, &mut None));
                let j = numbers(&p.jacobian[range.clone()], k);
                law.update_eight(delta_f.as_flattened(), dt, j, rows, &mut p.stress[range.clone()][k * EIGHT..]);
            }
        }
        let columns = p.jacobian.iter().zip(&p.reference_volume);
        for (volume, (j, reference)) in p.volume.iter_mut().zip(columns) {
            *volume = j * reference;
        }
    }

    /// The particles of the body at a place in the list, for threads to share in chunks.
    pub fn chunk(&mut self, body: usize) -> Chunk<'_, D> {
        let p = &mut self.particles;
        let Body { law, range, states, .. } = &mut self.each[body];
        Chunk {
            begin: range.start,
            states: Rows { entries: states, width: law.numbers() },
            law: &**law,
            position: part(&mut p.position, range),
            velocity: part(&mut p.velocity, range),
            affine: part(&mut p.affine, range),
            volume: part(&mut p.volume, range),
            jacobian: part(&mut p.jacobian, range),
            j_bar: part(&mut p.j_bar, range),
            stress: part(&mut p.stress, range),
            increment: part(&mut p.increment, range),
            reference_volume: &p.reference_volume[range.clone()],
            external_force: p.external_force.get(range.clone()).unwrap_or_default(),
        }
    }

    /// The particles of a body, with the next of `other` columns and of the sums of chunks, which go from body to body.
    pub fn part<'a, P: Front, T>(
        &mut self,
        body: usize,
        other: &mut P,
        sums: &mut &'a mut [T],
    ) -> ((Chunk<'_, D>, P), &'a mut [T]) {
        let chunk = self.chunk(body);
        let pieces = chunk.len().div_ceil(CHUNK);
        let own = sums.split_off_mut(..pieces).unwrap_or_default();
        let other = other.front(pieces, chunk.len());
        ((chunk, other), own)
    }

    /// Mass, momentum, energies and J, with what was `accumulated`.
    pub fn totals(&self, accumulated: Accumulated) -> Totals {
        Totals { accumulated, ..self.totals_of(0..self.particles.len()) }
    }

    /// Mass, momentum, energies and J of some particles, by place in the columns.
    pub fn totals_of(&self, range: Range<usize>) -> Totals {
        Totals::of(&self.particles, range, |p| {
            let body = self.of(p);
            body.law.energy(body.state(p))
        })
    }

    /// Equivalent plastic strain of every particle.
    pub fn plastic_strain(&self) -> Vec<f64> {
        let each = self.each.iter();
        each.flat_map(|body| body.range().map(|p| body.law.plastic_strain(body.state(p)))).collect()
    }

    /// Puts the particles in the order `order`, which leaves every body where it is: entry `k` becomes the former entry
    /// `order[k]`.
    pub fn permute(&mut self, order: &[u32]) {
        self.particles.permute(order);
        for body in &mut self.each {
            let begin = body.range.start as u32;
            let own: Vec<u32> = order[body.range()].iter().map(|p| p - begin).collect();
            permute(&mut body.states, &own, body.law.numbers());
        }
    }

    /// Particles and states as bytes.
    ///
    /// # Errors
    /// A value that has no bytes.
    pub fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(&self.particles, self.each.iter().map(|body| &body.states).collect::<Vec<_>>()))
    }

    /// Replaces particles and states by those that were saved, once `check` has passed the particles.
    ///
    /// # Errors
    /// The memory of other bodies, or what `check` finds; these then stay as they were.
    pub fn restore(
        &mut self,
        saved: &Saved,
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        self.replace(saved.read("bodies")?, check)
    }

    /// Goes on with the bodies of another run; of a single body, with the particles that were seeded first. `check` is
    /// asked before that. See [`Simulation::take_over`](crate::Simulation::take_over).
    pub(crate) fn go_on_with(
        &mut self,
        saved: &Saved,
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        let (mut particles, mut states): (Particles<D>, Vec<Vec<f64>>) = saved.read("bodies")?;
        MemoryError::unless_equal("bodies", states.len(), self.each.len())?;
        if let ([states], [body]) = (&mut states[..], &self.each[..]) {
            let n = body.law.numbers();
            MemoryError::unless_equal("numbers of states", states.len(), n * particles.len())?;
            if particles.len() > self.particles.len() {
                particles.check_whole()?;
                let order = particles.first(self.particles.len());
                particles.permute(&order);
                permute(states, &order, n);
            }
        }
        particles.go_on_as(&self.particles);
        self.replace((particles, states), check)
    }

    fn replace(
        &mut self,
        (particles, states): (Particles<D>, Vec<Vec<f64>>),
        check: impl FnOnce(&Particles<D>) -> Result<(), MemoryError>,
    ) -> Result<(), MemoryError> {
        particles.check_against(&self.particles)?;
        MemoryError::unless_equal("bodies", states.len(), self.each.len())?;
        for (states, body) in states.iter().zip(&self.each) {
            MemoryError::unless_equal("numbers of states", states.len(), body.states.len())?;
        }
        check(&particles)?;
        self.particles = particles;
        for (body, states) in self.each.iter_mut().zip(states) {
            body.states = states;
        }
        Ok(())
    }
}

/// Part of a column; nothing of an absent one.
fn part<'a, T>(column: &'a mut [T], range: &Range<usize>) -> &'a mut [T] {
    column.get_mut(range.clone()).unwrap_or_default()
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
    fn front(&mut self, pieces: usize, entries: usize) -> Self {
        let begin = self.begin;
        self.begin += self.len().min(entries);
        Self {
            law: self.law,
            begin,
            states: self.states.front(pieces, entries),
            position: self.position.front(pieces, entries),
            velocity: self.velocity.front(pieces, entries),
            affine: self.affine.front(pieces, entries),
            volume: self.volume.front(pieces, entries),
            jacobian: self.jacobian.front(pieces, entries),
            j_bar: self.j_bar.front(pieces, entries),
            stress: self.stress.front(pieces, entries),
            increment: self.increment.front(pieces, entries),
            reference_volume: self.reference_volume.front(pieces, entries),
            external_force: self.external_force.front(pieces, entries),
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
