//! The elastic strain under which a law has a stress: what ground begins with that has always been there.

use super::AnyLaw;
use crate::number::Dual;
use crate::tensor::SymmetricTensor;
use nalgebra::{Matrix3, SMatrix, SVector};

/// Components of a symmetric tensor.
const COMPONENTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
/// Newton steps at most, and the residual over the modulus of pressure waves that is rounding.
const MOST_STEPS: u32 = 30;
const ROUNDING: f64 = 1e-14;
/// Sweeps at most that find the singular values.
const MOST_SWEEPS: usize = 1000;
/// Singular values of the tangent, over the greatest, that are none: those of shear in a fluid.
const SINGULAR: f64 = 1e-12;

/// The stretch V, symmetric, at which the particle in `row`, not deformed before, has the Cauchy stress `stress` (Pa), by
/// Newton's method; none where the law has it only with flow, or not at all.
pub(crate) fn strain_under(law: &dyn AnyLaw, stress: &SymmetricTensor, row: &[f64]) -> Option<Matrix3<f64>> {
    let mut row = row.to_vec();
    let at_zero = law.at_rest(&Matrix3::identity(), &mut row);
    let before = law.plastic_strain(&row);
    let modulus = law.wave_modulus(1.0, &at_zero, &row);
    let mut stretch = Matrix3::identity();
    for _ in 0..MOST_STEPS {
        let variables = Matrix3::from_fn(|i, j| Dual::<10>::variable(stretch[(i, j)], 3 * i + j));
        let answer = law.stress(&variables, 1.0, &row);
        let off = |(i, j): (usize, usize)| stress.get(i, j) - answer.get(i, j).value;
        let lacking = SVector::<f64, 6>::from(COMPONENTS.map(off));
        if lacking.norm() <= ROUNDING * modulus {
            law.at_rest(&stretch, &mut row);
            return (law.plastic_strain(&row) == before).then_some(stretch);
        }
        let slope = |row: usize, column: usize| {
            let (k, l) = COMPONENTS[column];
            let of = answer.get(COMPONENTS[row].0, COMPONENTS[row].1).slope;
            if k == l { of[3 * k + l] } else { of[3 * k + l] + of[3 * l + k] }
        };
        // Without a bound it goes on for ever where a law far too soft for the stress has left all numbers.
        let singular = SMatrix::<f64, 6, 6>::from_fn(slope).try_svd(true, true, 5.0 * f64::EPSILON, MOST_SWEEPS)?;
        let step = singular.solve(&lacking, SINGULAR * singular.singular_values.max()).ok()?;
        for ((i, j), step) in COMPONENTS.into_iter().zip(step.iter()) {
            stretch[(i, j)] += step;
            stretch[(j, i)] = stretch[(i, j)];
        }
    }
    None
}
