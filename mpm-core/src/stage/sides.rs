//! Free sides of the body: those of particles that no other particle covers.

use super::End;
use crate::particles::Particles;
use std::collections::BTreeMap;

/// Distance of two particles of a column, over their size, from which the one does not cover the other.
const APART: f64 = 1.5;

/// The particles, by place, whose undeformed side at an end of an axis no other one covers and whose reference position
/// satisfies `select`, each with the one behind it.
pub(super) fn free_sides<const D: usize>(
    particles: &Particles<D>,
    (axis, end): (usize, End),
    select: impl Fn(&[f64; D]) -> bool,
) -> Vec<(usize, Option<usize>)> {
    let (places, size) = (&particles.reference, particles.half_size.map(|half| 2.0 * half));
    let mut columns: BTreeMap<[i64; D], Vec<usize>> = BTreeMap::new();
    for (k, x) in places.iter().enumerate() {
        let mut column: [i64; D] = std::array::from_fn(|a| (x[a] / size[a]).floor() as i64);
        column[axis] = 0;
        columns.entry(column).or_default().push(k);
    }
    let inwards = |k: usize| match end {
        End::Lo => places[k][axis],
        End::Hi => -places[k][axis],
    };
    let covers = |j: usize, k: usize| (places[j][axis] - places[k][axis]).abs() < APART * size[axis];
    let mut free = Vec::new();
    for column in columns.values_mut() {
        column.sort_by(|j, k| inwards(*j).total_cmp(&inwards(*k)));
        for (place, &k) in column.iter().enumerate() {
            let covered = place > 0 && covers(column[place - 1], k);
            if !covered && select(&places[k]) {
                free.push((k, column.get(place + 1).copied().filter(|behind| covers(*behind, k))));
            }
        }
    }
    free
}

/// Area (m², m in the plane) of the undeformed side of a particle across an axis.
pub(super) fn area<const D: usize>(particles: &Particles<D>, axis: usize) -> f64 {
    (0..D).filter(|a| *a != axis).map(|a| 2.0 * particles.half_size[a]).product()
}

/// Values of particles, given with their places, in the order of ids; `zero` of all others.
pub(super) fn by_id<const D: usize, T: Clone>(
    particles: &Particles<D>,
    zero: T,
    values: impl Iterator<Item = (usize, T)>,
) -> Vec<T> {
    let mut all = vec![zero; particles.len()];
    for (k, value) in values {
        all[particles.id[k] as usize] = value;
    }
    all
}
