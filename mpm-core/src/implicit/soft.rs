//! The paper's soft stiffness: a small share of the elastic stiffness of the whole mesh, as if it were full.

use super::functions::Functions;
use super::interpolation::Interpolation;
use super::penalty::{Moduli, Penalty};
use super::pieces::gauss;
use nalgebra::DMatrix;

/// Penalties of all cells of the grid.
pub(super) fn penalties<const D: usize, I: Interpolation<D>>(
    functions_of: &I,
    factor: f64,
    moduli: Moduli,
) -> Vec<Penalty> {
    let grid = functions_of.grid();
    let rule: Vec<(f64, f64)> = gauss(functions_of.points()).collect();
    let cells = grid.axes.map(|axis| axis.cells);
    let mut found = Vec::new();
    let mut functions = Functions::new();
    for k in 0..cells.iter().product() {
        let mut rest = k;
        let mut corner = [0.0; D];
        for a in (0..D).rev() {
            corner[a] = grid.axes[a].lo + grid.h * (rest % cells[a]) as f64;
            rest /= cells[a];
        }
        let size = functions_of.support() * D;
        let mut stiffness = DMatrix::zeros(size, size);
        for q in 0..rule.len().pow(D as u32) {
            let mut weight = factor * grid.h.powi(D as i32);
            let x: [f64; D] = std::array::from_fn(|a| {
                let (t, w) = rule[q / rule.len().pow(a as u32) % rule.len()];
                weight *= w;
                corner[a] + t * grid.h
            });
            functions_of.functions(&x, &[0.0; D], &mut functions);
            moduli.add_stiffness(&functions.dw, weight, &mut stiffness);
        }
        found.push(Penalty { node: functions.node.clone(), stiffness });
    }
    found
}
