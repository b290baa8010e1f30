//! Properties of functions of tensors.

use mpm_core::SymmetricTensor;
use mpm_core::number::Eight;
use nalgebra::Matrix3;
use proptest::prelude::*;

fn tensors() -> impl Strategy<Value = SymmetricTensor> {
    prop::array::uniform9(-1.0..1.0_f64).prop_map(|a| SymmetricTensor::symmetric_part(&Matrix3::from_row_slice(&a)))
}

/// The tensor with its third axis made a principal one.
fn planar(a: SymmetricTensor) -> SymmetricTensor {
    SymmetricTensor { yz: 0.0, xz: 0.0, ..a }
}

/// The tensor with the same principal axes and mapped eigenvalues.
fn map_eigenvalues(a: &SymmetricTensor, f: fn(f64) -> f64) -> SymmetricTensor {
    let eigen = a.to_matrix().symmetric_eigen();
    let values = Matrix3::from_diagonal(&eigen.eigenvalues.map(f));
    let turned = eigen.eigenvectors * values * eigen.eigenvectors.transpose();
    SymmetricTensor::symmetric_part(&turned)
}

fn distance(a: &SymmetricTensor, b: &SymmetricTensor) -> f64 {
    (a.to_matrix() - b.to_matrix()).norm()
}

proptest! {
    /// On both sides of the switch, for strains from 10⁻⁶ to one third: series and eigenvalues agree to rounding of the
    /// identity that the strain is added to. Larger ones are left to the next test, as the exponential outgrows it.
    #[test]
    fn series_and_eigenvalues_agree(a in tensors(), digits in -6.0..-0.5_f64) {
        for a in [a, planar(a)] {
            let strain = a.scale_add_identity(10.0_f64.powf(digits), 0.0);
            let b = map_eigenvalues(&strain, f64::exp);
            prop_assert!(distance(&strain.exp(), &b) < 2e-14);
            prop_assert!(distance(&b.ln(), &map_eigenvalues(&b, f64::ln)) < 2e-14);
            prop_assert!(distance(&b.ln(), &strain) < 2e-14);
        }
    }

    /// As far as eigenvalues go: what the condition of b leaves of rounding.
    #[test]
    fn far_strains_have_the_logarithm_of_their_eigenvalues(a in tensors(), size in 0.1..2.0_f64) {
        for a in [a, planar(a)] {
            let strain = a.scale_add_identity(size, 0.0);
            let b = map_eigenvalues(&strain, f64::exp);
            let condition = b.to_matrix().norm() * map_eigenvalues(&strain, |e| (-e).exp()).to_matrix().norm();
            prop_assert!(distance(&strain.exp(), &b) < 3e-14 * b.norm());
            prop_assert!(distance(&b.ln(), &strain) < 3e-14 * condition);
        }
    }

    /// One that is far, or broken, beside a small strain takes none of its digits.
    #[test]
    fn neighbours_leave_digits_alone(a in tensors(), far in tensors()) {
        let small = a.scale_add_identity(1e-6, 0.0);
        let broken = SymmetricTensor { xx: f64::NAN, ..far };
        for neighbour in [far.scale_add_identity(2.0, 0.0), broken] {
            let beside = |small: SymmetricTensor, other: SymmetricTensor| {
                SymmetricTensor::<Eight>::pack(|k| if k == 3 { small } else { other })
            };
            let (b, far) = (small.exp(), map_eigenvalues(&neighbour, f64::exp));
            prop_assert!(distance(&beside(small, neighbour).exp().part(3), &b) < 1e-15);
            prop_assert!(distance(&beside(b, far).ln().part(3), &b.ln()) < 1e-20);
        }
    }

    /// The way through the plane gives the bits of the whole way, which a shear out of the plane takes that
    /// is lost in rounding.
    #[test]
    fn a_plane_is_pushed_forward_as_the_space_is(a in tensors(), f in prop::array::uniform5(-1.0..1.0_f64)) {
        let a = planar(a);
        let f = Matrix3::new(f[0], f[1], 0.0, f[2], f[3], 0.0, 0.0, 0.0, f[4]);
        let lost = SymmetricTensor { xz: 1e-300, ..a };
        let (plane, space) = (a.push_forward(&f), lost.push_forward(&f));
        prop_assert_eq!(plane, SymmetricTensor { xz: 0.0, yz: 0.0, ..space });
    }

    #[test]
    fn the_exponential_of_the_negative_logarithm_inverts(a in tensors()) {
        let b = a.scale_add_identity(0.3, 1.5);
        let one = b.times_commuting(&b.ln().scale_add_identity(-1.0, 0.0).exp());
        prop_assert!(distance(&one, &SymmetricTensor::identity()) < 1e-13);
    }
}

/// Along an axis the logarithm is the scalar one, to 10⁻¹⁵ of itself where the strain is small.
#[test]
fn small_strains_keep_their_digits() {
    for stretch in [1.0 + 1e-9, 1.0 + 1e-5, 0.999, 1.05] {
        let b = SymmetricTensor { xx: stretch, ..SymmetricTensor::identity() };
        let (found, exact) = (b.ln(), (stretch - 1.0_f64).ln_1p());
        assert!((found.xx / exact - 1.0).abs() < 2e-15, "{stretch}");
        assert!(found.yy.abs() < 1e-16 && found.xy == 0.0);
    }
}

#[test]
fn what_is_not_finite_stays_so() {
    let broken = SymmetricTensor { xy: f64::NAN, ..SymmetricTensor::identity() };
    assert!(broken.ln().trace().is_nan() && broken.exp().trace().is_nan());
}
