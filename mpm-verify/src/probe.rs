//! Probes: particle fields at points.

use nalgebra::{Matrix3, Vector3};

/// The value at a point of the plane as a fixed linear combination of particle values: the linear
/// least-squares fit over the particles within a radius, in the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointProbe {
    terms: Vec<(usize, f64)>,
}

impl PointProbe {
    /// A probe at `at` (m) over the particles whose reference position lies within `radius` (m); the
    /// positions are in seeding order. `None` if the particles there don't determine a plane.
    pub(crate) fn new(references: &[[f64; 2]], at: [f64; 2], radius: f64) -> Option<Self> {
        let near: Vec<(usize, Vector3<f64>)> = references
            .iter()
            .enumerate()
            .map(|(id, x)| (id, Vector3::new(1.0, (x[0] - at[0]) / radius, (x[1] - at[1]) / radius)))
            .filter(|(_, q)| q.y.hypot(q.z) <= 1.0 + 1e-9)
            .collect();
        let normal: Matrix3<f64> = near.iter().map(|(_, q)| q * q.transpose()).sum();
        // The fit's value at the point is its constant term: the first row of the inverse applies.
        let row = normal.try_inverse()?.row(0).transpose();
        Some(Self { terms: near.iter().map(|(id, q)| (*id, row.dot(q))).collect() })
    }

    /// The value of a field given in seeding order.
    pub(crate) fn value(&self, field: &[f64]) -> f64 {
        self.terms.iter().map(|(id, c)| c * field[*id]).sum()
    }
}

/// The particle nearest to `at` (m), by its place in seeding order; zero where there are none.
pub(crate) fn nearest(references: &[[f64; 2]], at: [f64; 2]) -> usize {
    let distance = |x: &[f64; 2]| (x[0] - at[0]).hypot(x[1] - at[1]);
    references.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b))).map_or(0, |(id, _)| id)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Vec<[f64; 2]> {
        (0..100).map(|k| [f64::from(k % 10) * 0.5, f64::from(k / 10) * 0.5]).collect()
    }

    #[test]
    fn a_probe_is_exact_on_a_linear_field_even_at_a_corner() {
        let x = lattice();
        let field: Vec<f64> = x.iter().map(|x| 1.0 + 2.0 * x[0] - 3.0 * x[1]).collect();
        for at in [[2.2, 1.7], [-0.25, -0.25], [4.75, 0.0]] {
            let probe = PointProbe::new(&x, at, 2.0).unwrap();
            let exact = 1.0 + 2.0 * at[0] - 3.0 * at[1];
            assert!((probe.value(&field) - exact).abs() < 1e-12);
        }
    }

    #[test]
    fn too_few_particles_give_no_probe() {
        assert_eq!(PointProbe::new(&lattice(), [50.0, 50.0], 1.0), None);
        assert_eq!(PointProbe::new(&[[0.0, 0.0], [1.0, 1.0]], [0.0, 0.0], 2.0), None);
    }

    #[test]
    fn the_nearest_particle_is_found() {
        assert_eq!(nearest(&lattice(), [4.6, 4.6]), 99);
    }
}
