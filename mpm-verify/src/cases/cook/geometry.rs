//! The membrane.

/// Corners: (0, 0), (48, 44), (48, 60), (0, 44) m.
pub(super) const LENGTH: f64 = 48.0;
pub(super) const LEFT_HEIGHT: f64 = 44.0;
pub(super) const RIGHT_HEIGHT: f64 = 16.0;
/// Particles on a side count as inside (m).
const ON_SIDE: f64 = 1e-9;
/// Excluded from the stress error: x below this (m), and this far around the clamped corners.
const SINGULAR: f64 = 3.0;

/// Particles of a lattice of the given spacing that lie inside the membrane or on its sides.
pub(super) fn seed(spacing: f64) -> Vec<[f64; 2]> {
    let lower = |x: f64| LEFT_HEIGHT * x / LENGTH;
    let upper = |x: f64| LEFT_HEIGHT + RIGHT_HEIGHT * x / LENGTH;
    let count = |length: f64| (length / spacing).round() as usize;
    let mut positions = Vec::new();
    for i in 0..count(LENGTH) {
        let x = (i as f64 + 0.5) * spacing;
        for j in 0..count(LEFT_HEIGHT + RIGHT_HEIGHT) {
            let y = (j as f64 + 0.5) * spacing;
            if y >= lower(x) - ON_SIDE && y <= upper(x) + ON_SIDE {
                positions.push([x, y]);
            }
        }
    }
    positions
}

/// Whether a material point counts in the stress error.
pub(super) fn away_from_singularities(x: &[f64; 2]) -> bool {
    x[0] > SINGULAR && x[0].hypot(x[1]) > SINGULAR && x[0].hypot(x[1] - LEFT_HEIGHT) > SINGULAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_particle_counts_are_met_exactly() {
        assert_eq!([2.0, 1.0, 0.5, 0.25].map(|h| seed(0.5 * h).len()), [1448, 5776, 23_072, 92_224]);
    }
}
