//! The body that particles make: how full space is of it, in which direction its surface looks, and how much of the sky
//! it hides from there.

use super::camera::{Place, sum, unit};
use rayon::prelude::*;

/// Most cells of the lattice; a larger one is coarser than the particles.
const MOST: f64 = 8e6;
/// Cells of air about the particles.
const MARGIN: f64 = 14.0;
/// Share of the particles' own density at which space counts as full.
const FULL: f32 = 0.6;
/// Times that the density is smoothed, before and after it is cut off where space is full.
const SMOOTHING: [usize; 2] = [1, 3];
/// Cells on either side over which the share of hidden sky is averaged, three times over, and how far from the surface
/// that is looked up.
const WIDE: usize = 4;
const REACH: f64 = 5.0;
/// What a plane has there, and by how much light falls with what is more than that.
const PLANE: f64 = 0.17;
const SHADE: f64 = 0.75;

/// Values on a lattice of cells, the last axis contiguous.
#[derive(Clone)]
struct Lattice {
    origin: Place,
    step: f64,
    count: [usize; 3],
    values: Vec<f32>,
}

impl Lattice {
    fn new(points: &[Place], size: f64) -> Self {
        let end = |pick: fn(f64, f64) -> f64, from: f64| {
            points
                .iter()
                .fold([from; 3], |end, p| [0, 1, 2].map(|k| pick(end[k], p[k])))
        };
        let (low, high) = (
            end(f64::min, f64::INFINITY),
            end(f64::max, f64::NEG_INFINITY),
        );
        let cells = |step: f64| [0, 1, 2].map(|k| (high[k] - low[k]) / step + 2.0 * MARGIN + 2.0);
        let mut step = size;
        while cells(step).iter().product::<f64>() > MOST {
            step *= 1.1;
        }
        let count = cells(step).map(|n| n as usize);
        Self {
            origin: low.map(|v| v - MARGIN * step),
            step,
            count,
            values: vec![0.0; count.iter().product()],
        }
    }

    /// The cell at or below a place, moved inside, and how far into it the place lies, in cells.
    fn cell(&self, at: Place) -> ([usize; 3], [f32; 3]) {
        let mut cell = [0; 3];
        let mut part = [0.0; 3];
        for k in 0..3 {
            let most = (self.count[k] - 2) as f64;
            let along = ((at[k] - self.origin[k]) / self.step).clamp(0.0, most + 1.0);
            cell[k] = along.min(most) as usize;
            part[k] = (along - cell[k] as f64) as f32;
        }
        (cell, part)
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.count[1] + j) * self.count[2] + k
    }

    /// Adds a particle to the eight cells about it.
    fn add(&mut self, at: Place, value: f32) {
        let (cell, part) = self.cell(at);
        for corner in 0..8 {
            let bit = [corner >> 2, corner >> 1 & 1, corner & 1];
            let share = |k: usize| if bit[k] == 1 { part[k] } else { 1.0 - part[k] };
            let index = self.index([0, 1, 2].map(|k| cell[k] + bit[k]));
            self.values[index] += value * share(0) * share(1) * share(2);
        }
    }

    /// Makes space below a height full, along with a share of the cell that it cuts.
    fn fill_below(&mut self, axis: usize, height: f64) {
        let cells = (height - self.origin[axis]) / self.step + 0.5;
        let [_, rows, columns] = self.count;
        let place = |n: usize| [n / (rows * columns), n / columns % rows, n % columns][axis];
        let full = |n: usize| (cells - place(n) as f64).clamp(0.0, 1.0) as f32;
        let values = self.values.par_iter_mut().enumerate();
        values.for_each(|(n, value)| *value = value.max(full(n)));
    }

    /// The value at a place, linear between cells.
    fn at(&self, place: Place) -> f32 {
        let (cell, [u, v, w]) = self.cell(place);
        let (row, slab) = (self.count[2], self.count[1] * self.count[2]);
        let first = self.index(cell);
        let pair = |from: usize| (1.0 - w) * self.values[from] + w * self.values[from + 1];
        let face = |from: usize| (1.0 - v) * pair(from) + v * pair(from + row);
        (1.0 - u) * face(first) + u * face(first + slab)
    }

    /// Replaces every line of cells along each axis by what `act` makes of it.
    fn sweep(&mut self, act: impl Fn(&[f32], &mut [f32]) + Sync) {
        let [_, rows, columns] = self.count;
        let slab = rows * columns;
        self.values.par_chunks_mut(slab).for_each(|plane| {
            let mut old = vec![0.0; columns];
            for row in plane.chunks_mut(columns) {
                old.copy_from_slice(row);
                act(&old, row);
            }
            sweep_columns(plane, columns, &act);
        });
        // The first axis, turned to be the last: every column of a plane of the other two is a line of it.
        let lines: Vec<Vec<f32>> = (0..rows)
            .into_par_iter()
            .map(|j| {
                let of_row = |plane: &[f32]| plane[j * columns..][..columns].to_vec();
                let mut plane = self
                    .values
                    .chunks(slab)
                    .map(of_row)
                    .collect::<Vec<_>>()
                    .concat();
                sweep_columns(&mut plane, columns, &act);
                plane
            })
            .collect();
        self.values
            .par_chunks_mut(slab)
            .enumerate()
            .for_each(|(i, plane)| {
                for (row, line) in plane.chunks_mut(columns).zip(&lines) {
                    row.copy_from_slice(&line[i * columns..][..columns]);
                }
            });
    }

    fn smooth(&mut self, times: usize) {
        for _ in 0..times {
            self.sweep(|old, new| {
                let last = old.len() - 1;
                for k in 0..=last {
                    let beside = old[k.saturating_sub(1)] + old[last.min(k + 1)];
                    new[k] = 0.5 * old[k] + 0.25 * beside;
                }
            });
        }
    }

    /// The average over `half` cells on either side, beyond an end as at the end.
    fn average(&mut self, half: usize) {
        self.sweep(|old, new| {
            let last = old.len() - 1;
            let inside = |k: usize| old[last.min(k)];
            // The window of the first cell, but for its last one.
            let mut sum = old[0] * half as f32 + (0..half).map(inside).sum::<f32>();
            for k in 0..=last {
                sum += inside(k + half);
                new[k] = sum / (2 * half + 1) as f32;
                sum -= old[k.saturating_sub(half)];
            }
        });
    }
}

/// Sweeps the columns of a plane whose rows have a length.
fn sweep_columns(plane: &mut [f32], columns: usize, act: &(impl Fn(&[f32], &mut [f32]) + Sync)) {
    let rows = plane.len() / columns;
    let (mut old, mut new) = (vec![0.0; rows], vec![0.0; rows]);
    for k in 0..columns {
        for (value, row) in old.iter_mut().zip(plane.chunks(columns)) {
            *value = row[k];
        }
        act(&old, &mut new);
        for (value, row) in new.iter().zip(plane.chunks_mut(columns)) {
            row[k] = *value;
        }
    }
}

/// How full space is of particles, from 0 to 1, near by and on a wide average with the ground.
pub(super) struct Bulk {
    near: Lattice,
    wide: Lattice,
}

impl Bulk {
    /// Of particles a distance of `size` (m) apart when they fill space; at least one; on a ground at a height (m) on an axis.
    pub(super) fn new(points: &[Place], size: f64, ground: Option<(usize, f64)>) -> Self {
        let mut near = Lattice::new(points, size);
        let one = (size / near.step).powi(3) as f32 / FULL;
        for point in points {
            near.add(*point, one);
        }
        near.smooth(SMOOTHING[0]);
        near.values.iter_mut().for_each(|v| *v = v.min(1.0));
        near.smooth(SMOOTHING[1]);
        let mut wide = near.clone();
        if let Some((axis, height)) = ground {
            wide.fill_below(axis, height);
        }
        for _ in 0..3 {
            wide.average(WIDE);
        }
        Self { near, wide }
    }

    /// How full space is at a place.
    pub(super) fn fullness(&self, at: Place) -> f64 {
        f64::from(self.near.at(at))
    }

    /// The outward direction at a place on the surface; none where nothing tells.
    pub(super) fn normal(&self, at: Place) -> Option<Place> {
        let step = self.near.step;
        let mut slope = [0.0; 3];
        for (k, slope) in slope.iter_mut().enumerate() {
            let (mut before, mut after) = (at, at);
            before[k] -= step;
            after[k] += step;
            *slope = f64::from(self.near.at(before) - self.near.at(after));
        }
        unit(slope)
    }

    /// Share of the light from all around that reaches a place on a surface with an outward direction: 1 on a plane.
    pub(super) fn openness(&self, at: Place, outward: Place) -> f64 {
        let out = sum([(1.0, at), (REACH * self.wide.step, outward)]);
        let hidden = f64::from(self.wide.at(out)) - PLANE;
        (1.0 - SHADE * hidden.max(0.0)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(count: [usize; 3]) -> Vec<Place> {
        let [nx, ny, nz] = count;
        let place = |n: usize| [n / (ny * nz), n / nz % ny, n % nz].map(|k| k as f64 + 0.5);
        (0..nx * ny * nz).map(place).collect()
    }

    #[test]
    fn an_average_keeps_what_is_the_same_everywhere_and_spreads_the_rest() {
        let mut lattice = Lattice::new(&block([3, 2, 4]), 1.0);
        lattice.values.fill(2.0);
        lattice.average(WIDE);
        lattice.smooth(2);
        assert!(lattice.values.iter().all(|v| (v - 2.0).abs() < 1e-5));
        lattice.values.fill(0.0);
        let middle = lattice.count.map(|n| n / 2);
        let index = lattice.index(middle);
        lattice.values[index] = 729.0;
        lattice.average(1);
        for (shift, expected) in [([0, 0, 0], 27.0), ([1, 1, 1], 27.0), ([2, 0, 0], 0.0)] {
            let at = [0, 1, 2].map(|k| middle[k] + shift[k]);
            assert!((lattice.values[lattice.index(at)] - expected).abs() < 1e-3);
        }
    }

    #[test]
    fn the_faces_of_a_block_look_outwards_and_see_the_sky_but_for_the_ground() {
        let points = block([40, 20, 30]);
        let bulk = Bulk::new(&points, 1.0, Some((1, 0.0)));
        for (at, outward) in [
            ([20.0, 20.0, 15.0], [0.0, 1.0, 0.0]),
            ([40.0, 12.0, 15.0], [1.0, 0.0, 0.0]),
            ([20.0, 12.0, 0.0], [0.0, 0.0, -1.0]),
        ] {
            let normal = bulk.normal(at).unwrap();
            assert!(
                (0..3).all(|k| (normal[k] - outward[k]).abs() < 1e-3),
                "{normal:?}"
            );
            assert!(bulk.openness(at, outward) > 0.95);
        }
        assert!(bulk.openness([20.0, 1.0, 0.0], [0.0, 0.0, -1.0]) < 0.85);
        assert!(bulk.openness([20.0, 0.0, -1.0], [0.0, 1.0, 0.0]) < 0.85);
        assert!(bulk.fullness([20.0, 10.0, 15.0]) > 0.99);
        assert!(bulk.normal([500.0; 3]).is_none());
    }
}
