//! Sides that let waves out.

use super::sides::{area, by_id, free_sides};
use super::{Amplitude, End, Load};
use crate::frame::Frame;
use crate::memory::Memoryless;
use crate::particles::Particles;
use nalgebra::SVector;

/// Dashpots on free sides of the body: waves that come to them leave, all of a plane wave along the normal, and others in part
/// (Lysmer & Kuhlemeyer 1969, doi 10.1061/JMCEA3.0001144). The traction is ρ c (2 w − v) with the velocity v of the
/// particle and w of a wave that comes in from outside, c that of pressure waves along the normal, of shear waves across it.
#[derive(Debug, Clone, PartialEq)]
pub struct Dashpots<const D: usize> {
    /// ρ c A (N s/m) of every particle along every axis, by id.
    damping: Vec<SVector<f64, D>>,
    incoming: [f64; D],
    amplitude: Amplitude,
}

impl<const D: usize> Dashpots<D> {
    /// Dashpots of the `impedance` ρ c (Pa s/m) of pressure and of shear waves at a particle's place, on the free
    /// sides of the particles whose reference position satisfies `select`. The wave that comes in has the
    /// velocity `incoming` (m/s) times the `amplitude`.
    pub fn new(
        impedance: impl Fn(usize) -> [f64; 2],
        (incoming, amplitude): ([f64; D], Amplitude),
        particles: &Particles<D>,
        side: (usize, End),
        select: impl Fn(&[f64; D]) -> bool,
    ) -> Self {
        let area = area(particles, side.0);
        let sides = free_sides(particles, side, select).into_iter();
        let damping = sides.map(|(k, _)| {
            let [pressure, shear] = impedance(k).map(|impedance| impedance * area);
            (k, SVector::from_fn(|a, _| if a == side.0 { pressure } else { shear }))
        });
        Self { damping: by_id(particles, SVector::zeros(), damping), incoming, amplitude }
    }

    /// How many particles have a dashpot.
    pub fn count(&self) -> usize {
        self.damping.iter().filter(|damping| damping.norm_squared() > 0.0).count()
    }
}

impl<const D: usize> Memoryless for Dashpots<D> {}

impl<const D: usize> Load<D> for Dashpots<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let factor = 2.0 * self.amplitude.at(time);
        let columns = particles.external_force.iter_mut().zip(&particles.velocity).zip(&particles.id);
        for ((force, velocity), id) in columns {
            let damping = &self.damping[*id as usize];
            for a in 0..D {
                force[a] += damping[a] * (factor * self.incoming[a] - velocity[a]);
            }
        }
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        let mut seen = *self;
        seen.incoming = frame.vector(&seen.incoming, frame.scale(0, 1));
        for damping in &mut seen.damping {
            let own = *damping;
            for axis in 0..D {
                damping[frame.axis(axis).0] = frame.stiffness() * own[axis];
            }
        }
        Box::new(seen)
    }
}
