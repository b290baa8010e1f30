//! Constants of patches: the particles that shared a cell when they were last sorted. They stand side by side, so that a
//! pass over particles can average as it goes, and Π² = Π.

use super::{Average, Space};
use crate::grid::Grid;
use crate::memory::MemoryError;
use crate::parallel::{CHUNK, in_pieces};
use crate::particles::Particles;
use std::ops::Range;

/// The patches of a body.
#[derive(Debug, Clone, Default)]
pub struct Patches {
    /// The place of its first particle in the columns.
    begin: usize,
    /// Where each patch ends, from there.
    ends: Vec<usize>,
}

impl Patches {
    /// Finds those of the particles in a `range`, which have just been sorted by cell.
    pub fn find<const D: usize>(&mut self, grid: &Grid<D>, particles: &Particles<D>, range: Range<usize>) {
        self.begin = range.start;
        self.ends.clear();
        let mut end = 0;
        for patch in particles.position[range].chunk_by(|a, b| grid.cell_of(a) == grid.cell_of(b)) {
            end += patch.len();
            self.ends.push(end);
        }
    }

    /// The particle of the body with which piece `k` of a pass begins: pieces are [`CHUNK`] particles and what the last
    /// patch has beyond.
    pub fn cut(&self, k: usize) -> usize {
        let end = self.ends.partition_point(|end| *end < k * CHUNK);
        if k == 0 { 0 } else { self.ends.get(end).or(self.ends.last()).copied().unwrap_or(0) }
    }

    /// Replaces a `field` of particles of the body, from the `first` on, by its mean over each patch by `volume`.
    #[inline(always)]
    pub fn average(&self, first: usize, volume: &[f64], field: &mut [f64]) {
        let patch = self.ends.partition_point(|end| *end <= first);
        let mut begin = 0;
        for end in self.ends[patch..].iter().map(|end| end - first).take_while(|end| *end <= volume.len()) {
            let (volume, field) = (&volume[begin..end], &mut field[begin..end]);
            let (mut total, mut sum) = (0.0, 0.0);
            for (volume, value) in volume.iter().zip(&*field) {
                total += volume;
                sum = volume.mul_add(*value, sum);
            }
            field.fill(sum / total);
            begin = end;
        }
    }

    /// Where they end, to be saved.
    pub fn ends(&self) -> &[usize] {
        &self.ends
    }

    /// Those that were saved, of the particles in a `range`.
    ///
    /// # Errors
    /// Patches of other particles.
    pub fn saved(ends: Vec<usize>, range: Range<usize>) -> Result<Self, MemoryError> {
        MemoryError::unless_equal("last particle in patches", ends.last().copied().unwrap_or(0), range.len())?;
        let unsorted = ends.windows(2).filter(|pair| pair[0] >= pair[1]).count();
        MemoryError::unless_equal("patches out of order", unsorted, 0)?;
        Ok(Self { begin: range.start, ends })
    }
}

impl<const D: usize> Average<D> for Patches {
    fn average(&mut self, particles: &Particles<D>, field: &mut [f64]) {
        let range = self.begin..self.begin + self.ends.last().copied().unwrap_or(0);
        let columns = (&mut field[range.clone()], &particles.volume[range.clone()]);
        let at = |k| self.cut(k);
        in_pieces(columns, 0..range.len().div_ceil(CHUNK), &at, &|first, (field, volume): (&mut [f64], &[f64])| {
            Self::average(self, first, volume, field);
        });
    }
}

impl<const D: usize> Space<D> for Patches {
    fn expire(&mut self) {}

    fn find_reach(&mut self, _particles: &Particles<D>, _slabs: &[Range<usize>]) {}

    fn pairs(&self) -> u64 {
        2 * self.ends.last().copied().unwrap_or(0) as u64
    }

    fn patches(&self) -> Option<&Patches> {
        Some(self)
    }

    fn patches_mut(&mut self) -> Option<&mut Patches> {
        Some(self)
    }
}
