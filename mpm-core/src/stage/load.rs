//! Body forces and dead forces.

use super::{Load, smooth_rise};
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

/// A constant force on each of a set of particles: a dead traction, lumped to the particles that
/// line the loaded side.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadForce<const D: usize> {
    loaded: Vec<bool>,
    force: [f64; D],
    ramp: f64,
}

impl<const D: usize> DeadForce<D> {
    /// Shares `total` (N) equally among the particles whose reference position satisfies `select`. It
    /// grows as a smooth step over the first `ramp` seconds (0: it is there at once).
    pub fn shared(total: [f64; D], ramp: f64, particles: &Particles<D>, select: impl Fn(&[f64; D]) -> bool) -> Self {
        let loaded = particles.seeded(|k| select(&particles.reference[k]));
        let count = loaded.iter().filter(|&&l| l).count().max(1) as f64;
        Self { loaded, force: total.map(|f| f / count), ramp }
    }

    /// How many particles carry the load.
    pub fn count(&self) -> usize {
        self.loaded.iter().filter(|&&l| l).count()
    }
}

impl<const D: usize> Memoryless for DeadForce<D> {}

impl<const D: usize> Load<D> for DeadForce<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let share = smooth_rise(time, self.ramp);
        for (force, id) in particles.external_force.iter_mut().zip(&particles.id) {
            if self.loaded[*id as usize] {
                for (f, add) in force.iter_mut().zip(self.force) {
                    *f += share * add;
                }
            }
        }
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        Box::new(Self { force: frame.vector(&self.force, frame.force()), ..*self })
    }
}
