//! The paper's soft stiffness: a small share of the elastic stiffness of the whole mesh, as if it were full.

use super::functions::Functions;
use super::ghost::indices;
use super::interpolation::Interpolation;
use super::penalty::{Moduli, Penalty};
use super::pieces::gauss;
use nalgebra::DMatrix;

/// Penalties of all elements.
pub(super) fn penalties<const D: usize>(
    functions_of: &dyn Interpolation<D>,
    factor: f64,
    moduli: Moduli,
) -> Vec<Penalty> {
    let grid = functions_of.grid();
    let rule: Vec<(f64, f64)> = gauss(functions_of.points()).collect();
    let elements: [usize; D] = std::array::from_fn(|a| grid.axes[a].cells / functions_of.span()[a]);
    let lengths = functions_of.span().map(|cells| cells as f64 * grid.h);
    let mut found = Vec::new();
    let mut functions = Functions::new();
    for k in 0..elements.iter().product() {
        let element = indices(k, elements);
        let corner: [f64; D] = std::array::from_fn(|a| grid.axes[a].lo + lengths[a] * element[a] as f64);
        let size = functions_of.support() * D;
        let mut stiffness = DMatrix::zeros(size, size);
        for q in 0..rule.len().pow(D as u32) {
            let mut weight = factor * lengths.iter().product::<f64>();
            let x: [f64; D] = std::array::from_fn(|a| {
                let (t, w) = rule[q / rule.len().pow(a as u32) % rule.len()];
                weight *= w;
                corner[a] + t * lengths[a]
            });
            functions_of.functions(&x, &[0.0; D], &mut functions);
            moduli.add_stiffness(&functions.dw, weight, &mut stiffness);
        }
        found.push(Penalty { node: functions.node.clone(), stiffness });
    }
    found
}
