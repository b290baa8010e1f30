//! Where the domains of particles are: all that functions ask of particles.

use crate::particles::Particles;

/// The domains of a body's particles.
#[derive(Debug, Clone, Copy)]
pub struct Domains<'a, const D: usize> {
    /// Their centres (m).
    pub centre: &'a [[f64; D]],
    /// Half their sizes (m).
    pub half_size: HalfSizes<'a, D>,
}

/// Half the sizes (m) of domains along the axes.
#[derive(Debug, Clone, Copy)]
pub enum HalfSizes<'a, const D: usize> {
    /// Of all the same.
    OfAll([f64; D]),
    /// Of each its own.
    OfEach(&'a [[f64; D]]),
}

impl<'a, const D: usize> Domains<'a, D> {
    /// Of particles that are all of one size.
    #[must_use]
    pub fn of(particles: &'a Particles<D>) -> Self {
        Self {
            centre: &particles.position,
            half_size: HalfSizes::OfAll(particles.half_size),
        }
    }

    /// Centre and half size of every one (m).
    pub fn iter(&self) -> impl Iterator<Item = (&'a [f64; D], [f64; D])> {
        let half_size = self.half_size;
        let each = self.centre.iter().enumerate();
        each.map(move |(p, x)| match half_size {
            HalfSizes::OfAll(size) => (x, size),
            HalfSizes::OfEach(sizes) => (x, sizes[p]),
        })
    }
}
