//! Contact of the particles with rigid bodies: barrier, friction, and the stable time step.
//!
//! Formulas, choices and limits: `docs/contact.md`.

mod barrier;
mod face;
mod friction;
mod surface;

pub use barrier::Barrier;
pub use face::RigidFace;
pub use friction::Friction;
pub use surface::{Gap, Surface};

use crate::error::Fault;
use crate::frame::Frame;
use crate::memory::{Memory, MemoryError, Saved};
use crate::monitor::Reaction;
use crate::particles::Particles;
use nalgebra::SVector;

/// The contact of all particles with one rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidContact<const D: usize> {
    face: RigidFace<D>,
    barrier: Barrier,
    friction: Option<Friction>,
    /// Stretch of the stick of every particle (m), by id; empty without friction.
    stretch: Vec<[f64; D]>,
    /// The same at the end of the step that was tried last.
    tried: Vec<[f64; D]>,
    /// The particles that may touch the body before they are sorted again, by place.
    near: Vec<u32>,
    /// Reaction of the body.
    reaction: Reaction,
}

/// The particle with the greatest ratio of contact stiffness to mass.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stiffest {
    /// Its place among the particles.
    pub(crate) particle: usize,
    /// Stiffness over mass (1/s²).
    pub(crate) ratio: f64,
}

impl<const D: usize> RigidContact<D> {
    /// The smooth contact with `face` through `barrier`.
    #[must_use]
    pub fn new(face: RigidFace<D>, barrier: Barrier) -> Self {
        Self {
            face,
            barrier,
            friction: None,
            stretch: Vec::new(),
            tried: Vec::new(),
            near: Vec::new(),
            reaction: Reaction::default(),
        }
    }

    /// The contact with `friction`.
    #[must_use]
    pub fn with_friction(self, friction: Friction) -> Self {
        Self { friction: Some(friction), ..self }
    }

    /// The same contact, before its first step, seen from `frame`.
    #[must_use]
    pub fn seen_from(&self, frame: &Frame<D>) -> Self {
        Self {
            friction: self.friction.map(|f| f.in_units(frame.stiffness())),
            ..Self::new(self.face.seen_from(frame), self.barrier.in_units(frame.scale(0, 1), frame.stiffness()))
        }
    }

    /// The face.
    pub fn face(&self) -> &RigidFace<D> {
        &self.face
    }

    /// The barrier.
    pub fn barrier(&self) -> Barrier {
        self.barrier
    }

    /// The friction, if there is any.
    pub fn friction(&self) -> Option<Friction> {
        self.friction
    }

    /// Stretch of the stick of every particle (m) as the last step left it, by id; empty without friction.
    pub(crate) fn sticks(&self) -> &[[f64; D]] {
        &self.stretch
    }

    /// Takes these stretches (m), with ids, for those of the sticks; all others are forgotten.
    pub(crate) fn stick(&mut self, stretches: impl Iterator<Item = (u32, [f64; D])>) {
        self.stretch.fill([0.0; D]);
        for (id, stretch) in stretches {
            if let Some(stick) = self.stretch.get_mut(id as usize) {
                *stick = stretch;
            }
        }
    }

    /// Notes the `force` (N) of the particles on the body in a step of `dt` (s).
    pub(crate) fn react(&mut self, force: [f64; D], dt: f64) {
        self.reaction.force[..D].copy_from_slice(&force);
        for (impulse, force) in self.reaction.impulse.iter_mut().zip(force) {
            *impulse += dt * force;
        }
    }

    /// Reaction of the rigid body.
    pub fn reaction(&self) -> Reaction {
        self.reaction
    }

    /// Makes room for the sticks of `particles` particles.
    pub(crate) fn attach(&mut self, particles: usize) {
        if self.friction.is_some() {
            self.stretch.resize(particles, [0.0; D]);
            self.tried.resize(particles, [0.0; D]);
        }
    }

    /// Finds the particles that may touch the body until they and the body have moved by `motion` (m). All others lose
    /// their stick.
    pub(crate) fn find_near(&mut self, time: f64, motion: f64, particles: &Particles<D>) {
        let moved = self.face.displacement(time);
        let distance = self.barrier.distance() + motion;
        self.near.clear();
        for (k, x) in particles.position.iter().enumerate() {
            if self.face.is_near(&difference(x, &moved), distance) {
                self.near.push(k as u32);
            } else if self.friction.is_some() {
                let id = particles.id[k] as usize;
                (self.stretch[id], self.tried[id]) = ([0.0; D], [0.0; D]);
            }
        }
    }

    /// The farthest that the body moves along an axis from `time` (s) in a step of `dt` (s) (m).
    pub(crate) fn motion(&self, time: f64, dt: f64) -> f64 {
        let ends = [time + dt, time].map(|time| self.face.displacement(time));
        let steps = difference(&ends[0], &ends[1]).map(f64::abs);
        steps.into_iter().fold(0.0, f64::max)
    }

    /// Adds the contact forces at `time` (s), the end of a step of `dt` (s), to the particles' external forces. The
    /// sticks start from where the last [`commit`](Self::commit) left them, however often a step is tried.
    pub(crate) fn try_step(&mut self, time: f64, dt: f64, particles: &mut Particles<D>) -> Stiffest {
        let moved = self.face.displacement(time);
        let carried = difference(&moved, &self.face.displacement(time - dt));
        let reach = self.barrier.distance();
        let mut stiffest = Stiffest::default();
        self.reaction.force = [0.0; 3];
        for &k in &self.near {
            let k = k as usize;
            let id = particles.id[k] as usize;
            let tried = self.tried.get_mut(id);
            let gap = self.face.seen_at(&difference(&particles.position[k], &moved), reach);
            let Some(Gap { size, normal: n, .. }) = gap.filter(|gap| gap.size < reach) else {
                tried.into_iter().for_each(|u| *u = [0.0; D]);
                continue;
            };
            let normal = self.barrier.force(size);
            let mut stiffness = self.barrier.stiffness(size);
            let mut force = [0.0; D];
            if let (Some(friction), Some(tried)) = (&self.friction, tried) {
                let slid = SVector::from(difference(&particles.increment[k], &carried));
                *tried = tangential(SVector::from(self.stretch[id]) + slid, &n).into();
                force = friction.force(tried, normal);
                stiffness = stiffness.max(friction.stiffness());
            }
            for a in 0..D {
                force[a] += n[a] * normal;
                particles.external_force[k][a] += force[a];
                self.reaction.force[a] -= force[a];
            }
            let ratio = stiffness / particles.mass[k];
            if ratio > stiffest.ratio {
                stiffest = Stiffest { particle: k, ratio };
            }
        }
        stiffest
    }

    /// Takes the step of `dt` (s) that was tried last.
    pub(crate) fn commit(&mut self, dt: f64) {
        std::mem::swap(&mut self.stretch, &mut self.tried);
        for (impulse, force) in self.reaction.impulse.iter_mut().zip(self.reaction.force) {
            *impulse += dt * force;
        }
    }

    /// The first particle whose gap the displacement of the present step would close, at its end at `time` (s).
    pub(crate) fn closed_gap(&self, time: f64, particles: &Particles<D>) -> Result<(), (usize, Fault)> {
        let moved = self.face.displacement(time);
        for &k in &self.near {
            let k = k as usize;
            let (x, increment) = (&particles.position[k], &particles.increment[k]);
            let next = std::array::from_fn(|a| x[a] + increment[a] - moved[a]);
            if let Some(gap) = self.face.gap(&next).filter(|&gap| gap <= 0.0) {
                return Err((k, Fault::GapClosed(gap)));
            }
        }
        Ok(())
    }
}

/// Moduli and place follow from the scene; what it remembers are the sticks, and the reaction as it can be read.
impl<const D: usize> Memory for RigidContact<D> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.stretch.as_flattened(), self.reaction))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (stretch, reaction): (Vec<f64>, Reaction) = saved.read("a contact")?;
        MemoryError::unless_equal("sticks", stretch.len(), D * self.stretch.len())?;
        let (rows, _) = stretch.as_chunks();
        self.stretch.copy_from_slice(rows);
        self.reaction = reaction;
        Ok(())
    }
}

/// The part of a vector in the plane across the normal `n`.
pub(crate) fn tangential<const D: usize>(v: SVector<f64, D>, n: &SVector<f64, D>) -> SVector<f64, D> {
    v - n * n.dot(&v)
}

fn difference<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::End;

    /// Two particles at gaps of 0.5 and 0.9 from a floor of reach 1, which have moved along it by 0.1 and 0.2.
    fn touching() -> (RigidContact<2>, Particles<2>) {
        let face = RigidFace::half_space(1, End::Lo, 0.0).unwrap();
        let barrier = Barrier::new(7.0, 1.0).unwrap();
        let mut contact = RigidContact::new(face, barrier).with_friction(Friction::rough(10.0).unwrap());
        let positions = vec![[0.0, 0.5], [1.0, 0.9]];
        let mut particles = Particles::new(positions, 1.0, 1.0, [0.1; 2]).unwrap();
        particles.increment = vec![[0.1, 9.0], [0.2, 9.0]];
        contact.attach(2);
        (contact, particles)
    }

    fn committed(contact: &mut RigidContact<2>, particles: &mut Particles<2>) -> Vec<[f64; 2]> {
        let tried = forces(contact, particles);
        contact.commit(0.1);
        tried
    }

    fn forces(contact: &mut RigidContact<2>, particles: &mut Particles<2>) -> Vec<[f64; 2]> {
        contact.find_near(0.0, 1.0, particles);
        particles.external_force.fill([0.0; 2]);
        contact.try_step(0.0, 0.1, particles);
        particles.external_force.clone()
    }

    #[test]
    fn sticks_remember_their_particle_when_particles_are_sorted() {
        let (mut contact, mut particles) = touching();
        let before = committed(&mut contact, &mut particles);
        assert_eq!((before[0][0], before[1][0]), (-1.0, -2.0));
        particles.permute(&[1, 0]);
        particles.increment.fill([0.0; 2]);
        let after = committed(&mut contact, &mut particles);
        assert_eq!((after[0], after[1]), (before[1], before[0]));
    }

    #[test]
    fn an_open_gap_forgets_the_stick() {
        let (mut contact, mut particles) = touching();
        committed(&mut contact, &mut particles);
        particles.position[0][1] = 1.0;
        assert_eq!(committed(&mut contact, &mut particles)[0], [0.0; 2]);
        particles.position[0][1] = 0.5;
        particles.increment.fill([0.0; 2]);
        let after = committed(&mut contact, &mut particles);
        assert_eq!((after[0][0], after[1][0]), (0.0, -4.0));
    }

    #[test]
    fn a_step_can_be_tried_again_until_it_is_taken() {
        let (mut contact, mut particles) = touching();
        let first = forces(&mut contact, &mut particles);
        assert_eq!(forces(&mut contact, &mut particles), first);
        assert_eq!(contact.reaction().impulse, [0.0; 3]);
        contact.commit(0.1);
        assert_eq!(contact.reaction().impulse[0], 0.1 * 3.0);
        let next = forces(&mut contact, &mut particles);
        assert_eq!((next[0][0], next[1][0]), (-2.0, -4.0));
    }

    #[test]
    fn the_stiffest_is_named_with_what_it_feels() {
        let (mut contact, mut particles) = touching();
        contact.find_near(0.0, 1.0, &particles);
        let stiffest = contact.try_step(0.0, 0.1, &mut particles);
        assert_eq!(stiffest.particle, 0);
        assert_eq!(stiffest.ratio, contact.barrier.stiffness(0.5));
        particles.mass[1] = 1e-3;
        let stiffest = contact.try_step(0.0, 0.1, &mut particles);
        assert_eq!(stiffest.particle, 1);
        assert_eq!(stiffest.ratio, 10.0 / 1e-3);
    }
}
