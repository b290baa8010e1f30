//! Motions in fewer than three dimensions.

use mpm_core::space::{determinant, embed, embed_entries};
use nalgebra::{Matrix3, SMatrix};

fn is_completed_with_the_identity<const D: usize>() {
    let entries: [[f64; D]; D] = std::array::from_fn(|a| std::array::from_fn(|b| (2 + a + 3 * b) as f64));
    let matrix = SMatrix::<f64, D, D>::from_fn(|a, b| entries[a][b]);
    let expected = Matrix3::from_fn(|i, j| match i < D && j < D {
        true => (2 + i + 3 * j) as f64,
        false => f64::from(i == j),
    });
    assert_eq!(embed_entries(&entries), expected);
    assert_eq!(embed(&matrix), expected);
    let error = determinant(&matrix) - expected.determinant();
    assert!(error.abs() < 1e-12, "{error}");
}

#[test]
fn a_gradient_is_completed_with_the_identity() {
    is_completed_with_the_identity::<1>();
    is_completed_with_the_identity::<2>();
    is_completed_with_the_identity::<3>();
}
