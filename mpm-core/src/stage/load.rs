//! Body forces and dead forces.

use super::sides::{area, by_id, free_sides};
use super::{Amplitude, End, Load};
use crate::frame::Frame;
use crate::memory::Memoryless;
use crate::parallel::{CHUNK, for_each_piece};
use crate::particles::Particles;

/// A field of body force per unit mass (N/kg) as a function of the reference position (m) and time (s).
pub type ForceField<const D: usize> = Box<dyn Fn(&[f64; D], f64) -> [f64; D] + Send + Sync>;

/// A body force per unit mass, evaluated at the particles' reference positions.
pub struct BodyForce<const D: usize>(pub ForceField<D>);

impl<const D: usize> Memoryless for BodyForce<D> {}

impl<const D: usize> Load<D> for BodyForce<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let (n, p) = (particles.len(), particles);
        let columns = (&mut p.external_force[..], (&p.reference[..], &p.mass[..]));
        for_each_piece(columns, n, CHUNK, &|_, (forces, (reference, mass))| {
            for (force, (reference, mass)) in forces.iter_mut().zip(reference.iter().zip(mass)) {
                let b = (self.0)(reference, time);
                for (f, b) in force.iter_mut().zip(b) {
                    *f += mass * b;
                }
            }
        });
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        let frame = *frame;
        Box::new(Self(Box::new(move |reference, time| {
            let b = (self.0)(&frame.place_of_scene(reference), time);
            frame.vector(&b, frame.scale(0, 1))
        })))
    }
}

/// An acceleration (m/s²) of all material as a function of time (s).
pub struct Gravity<const D: usize>(pub Box<dyn Fn(f64) -> [f64; D] + Send + Sync>);

impl<const D: usize> Memoryless for Gravity<D> {}

impl<const D: usize> Load<D> for Gravity<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let acceleration = (self.0)(time);
        for (force, mass) in particles.external_force.iter_mut().zip(&particles.mass) {
            for (f, a) in force.iter_mut().zip(acceleration) {
                *f += mass * a;
            }
        }
    }

    fn acceleration(&self, time: f64) -> Option<[f64; D]> {
        Some((self.0)(time))
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        let frame = *frame;
        Box::new(Self(Box::new(move |time| frame.vector(&(self.0)(time), frame.scale(0, 1)))))
    }
}

/// A force on each of a set of particles that keeps its direction: a dead load.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadForce<const D: usize> {
    /// Factor of the force on every particle, by id.
    shares: Vec<f64>,
    force: [f64; D],
    amplitude: Amplitude,
}

impl<const D: usize> DeadForce<D> {
    /// Shares `total` (N) times the `amplitude` equally among the particles whose reference position satisfies `select`.
    pub fn shared(
        total: [f64; D],
        amplitude: Amplitude,
        particles: &Particles<D>,
        select: impl Fn(&[f64; D]) -> bool,
    ) -> Self {
        let shares = particles.seeded(|k| f64::from(select(&particles.reference[k])));
        let count = shares.iter().sum::<f64>().max(1.0);
        Self { shares, force: total.map(|f| f / count), amplitude }
    }

    /// A traction (Pa) times the `amplitude` on the undeformed free sides of the particles whose reference
    /// position satisfies `select`. Its particle takes 3/2 of a side's force and the one behind −1/2, if there is one,
    /// so that its moment is that of the side.
    pub fn traction(
        traction: [f64; D],
        amplitude: Amplitude,
        particles: &Particles<D>,
        side: (usize, End),
        select: impl Fn(&[f64; D]) -> bool,
    ) -> Self {
        let area = area(particles, side.0);
        let sides = free_sides(particles, side, select).into_iter();
        let shares = sides.flat_map(|(k, behind)| match behind {
            Some(behind) => vec![(k, 1.5 * area), (behind, -0.5 * area)],
            None => vec![(k, area)],
        });
        Self { shares: by_id(particles, 0.0, shares), force: traction, amplitude }
    }

    /// How many particles carry the load.
    pub fn count(&self) -> usize {
        self.shares.iter().filter(|share| **share != 0.0).count()
    }

    /// Its sum (N) where the amplitude is one.
    pub fn total(&self) -> [f64; D] {
        let sum: f64 = self.shares.iter().sum();
        self.force.map(|f| sum * f)
    }
}

impl<const D: usize> Memoryless for DeadForce<D> {}

impl<const D: usize> Load<D> for DeadForce<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let factor = self.amplitude.at(time);
        for (force, id) in particles.external_force.iter_mut().zip(&particles.id) {
            let share = self.shares[*id as usize];
            if share != 0.0 {
                for (f, add) in force.iter_mut().zip(self.force) {
                    *f += factor * share * add;
                }
            }
        }
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        Box::new(Self { force: frame.vector(&self.force, frame.force()), ..*self })
    }
}
