//! Domains of particles as they have deformed.

use super::page::Point;
use std::collections::HashMap;

/// Distance of neighbours, over that at the start, from which they have parted.
const APART: f64 = 2.5;

/// Half the sides, along both axes of the start, of the domains of particles that were at `from` and are at `at`. Where a
/// particle has neighbours in its `body`, at the distance `size` at the start, it is deformed as they have moved.
pub(crate) fn domains(from: &[Point], at: &[Point], body: &[f64], size: f64) -> Vec<[Point; 2]> {
    let key = |k: usize, (i, j): (i64, i64)| {
        let [x, y] = [from[k].0, from[k].1].map(|x| (x / size).floor() as i64);
        (x + i, y + j, body.get(k).map_or(0, |body| body.to_bits()))
    };
    let places: HashMap<_, usize> = (0..from.len()).map(|k| (key(k, (0, 0)), k)).collect();
    let half = |k: usize, (i, j): (i64, i64)| {
        let near = |x: &Point| (x.0 - at[k].0).hypot(x.1 - at[k].1) < APART * size;
        let beside = |step| places.get(&key(k, step)).map(|n| at[*n]).filter(near);
        let (before, after) = (beside((-i, -j)), beside((i, j)));
        let (a, b) = (before.unwrap_or(at[k]), after.unwrap_or(at[k]));
        match usize::from(before.is_some()) + usize::from(after.is_some()) {
            0 => (0.5 * size * i as f64, 0.5 * size * j as f64),
            sides => ((b.0 - a.0) / (2 * sides) as f64, (b.1 - a.1) / (2 * sides) as f64),
        }
    };
    // Where neighbours have parted along one axis alone, less than half a domain is left: a square stands for it.
    let whole = |[u, v]: &[Point; 2]| u.0 * v.1 - u.1 * v.0 > 0.125 * size * size;
    let square = [(0.5 * size, 0.0), (0.0, 0.5 * size)];
    (0..at.len()).map(|k| Some([half(k, (1, 0)), half(k, (0, 1))]).filter(whole).unwrap_or(square)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn domains_of_a_stretched_and_sheared_body_meet() {
        let from: Vec<Point> = (0..12).map(|k| (0.5 + f64::from(k % 4), 0.5 + f64::from(k / 4))).collect();
        let at: Vec<Point> = from.iter().map(|(x, y)| (1.8 * x + 0.5 * y + 3.0, 0.2 * x + 0.7 * y)).collect();
        for [u, v] in domains(&from, &at, &[], 1.0) {
            assert!((u.0 - 0.9).hypot(u.1 - 0.1) + (v.0 - 0.25).hypot(v.1 - 0.35) < 1e-12, "{u:?} {v:?}");
        }
        // Particles of two bodies, and those that have parted, know nothing of each other.
        let (two, square) = ([(0.5, 0.5), (1.5, 0.5)], [(0.5, 0.0), (0.0, 0.5)]);
        assert_eq!(domains(&two, &[two[0], (1.9, 0.5)], &[0.0, 1.0], 1.0)[0], square);
        assert_eq!(domains(&two, &[two[0], (9.5, 0.5)], &[], 1.0)[0], square);
        assert_eq!(domains(&two, &[two[0], (0.7, 0.5)], &[], 1.0)[0], square);
    }
}
