//! Where the domains of particles are: all that functions ask of particles.

use crate::particles::Particles;

/// The share of a domain that is its own, and no rounding of its size.
const WITHIN: f64 = 1.0 - 1e-12;
/// Spacings of numbers as large as the farthest coordinate by which places are rounded at most.
const SPACINGS: f64 = 4.0;

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
    /// One size for all particles.
    OfAll([f64; D]),
    /// One size for each particle.
    OfEach(&'a [[f64; D]]),
}

impl<'a, const D: usize> Domains<'a, D> {
    /// Domains of particles that are all of one size.
    #[must_use]
    pub fn of(particles: &'a Particles<D>) -> Self {
        Self { centre: &particles.position, half_size: HalfSizes::OfAll(particles.half_size) }
    }

    /// Rounding of positions (m).
    pub fn rounding(&self) -> f64 {
        let coordinates = self.centre.as_flattened().iter();
        let farthest = coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
        SPACINGS * f64::EPSILON * farthest
    }

    /// The same domains without what they touch by rounding alone where they end on grid lines; `sizes` are to hold
    /// theirs.
    pub fn within<'b>(&self, sizes: &'b mut Vec<[f64; D]>) -> Domains<'b, D>
    where
        'a: 'b,
    {
        let rounding = self.rounding();
        let own = |(_, size): (_, [f64; D])| size.map(|half| half * WITHIN - rounding);
        *sizes = self.iter().map(own).collect();
        Domains { centre: self.centre, half_size: HalfSizes::OfEach(sizes) }
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
