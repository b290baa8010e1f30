//! The difference equations of cells, step by step and by elimination: without modes, and with particles at the side that
//! have a strain of their own.

use super::{Cells, Slab};
use nalgebra::{DMatrix, DVector};

/// The slab, of Poisson's ratio `ratio`, after each of `count` steps of duration `step` (T) of backward Euler's rule,
/// by the equations of `cells`: σ_xx = 0 for every particle, or for both of a cell together, the water balance of every
/// node, and the force of the plate. With `apart` the particles of the outermost cell have strains of their own after
/// the first step, as means of hats give them once the outer one's domain reaches into the cell beyond. NaN if there is
/// no solution.
#[must_use]
pub fn of_particles(ratio: f64, cells: Cells, apart: bool, step: f64, count: i32) -> Vec<Slab> {
    let n = cells.of_solid;
    let first = Equations::new(ratio, cells, n, step);
    let later = Equations::new(ratio, cells, if apart { n - 1 } else { n }, step);
    let mut x = DVector::zeros(first.matrix.nrows());
    let factors = [first, later].map(|equations| (equations.matrix.lu(), equations.storage));
    let mut slabs = Vec::new();
    for k in 0..count {
        let (matrix, storage) = &factors[usize::from(k > 0)];
        let mut right = DVector::zeros(x.len());
        right.rows_mut(2 * n, cells.of_water).copy_from(&(storage * &x));
        right[x.len() - 1] = -1.0;
        if !matrix.solve_mut(&mut right) {
            right.fill(f64::NAN);
        }
        x = right;
        slabs.push(Slab {
            // p over F/(2a) is twice that over F/a.
            centre: 2.0 * x[2 * n],
            settlement: -x[x.len() - 1],
            bulge: x.rows(0, 2 * n).sum() / (2 * n) as f64,
        });
    }
    slabs
}

/// Equations in the particles' strains ε_x, two a cell, the pressures of all nodes but the drained one, and ε_y; G = a
/// = F = 1.
struct Equations {
    matrix: DMatrix<f64>,
    /// Part of the nodes' equations that multiplies the previous step's values.
    storage: DMatrix<f64>,
}

impl Equations {
    /// With one strain in each of the first `together` cells.
    fn new(ratio: f64, cells: Cells, together: usize, step: f64) -> Self {
        let (n, nodes) = (cells.of_solid, cells.of_water);
        let theta = 1.0 - 2.0 * ratio;
        let [modulus, lame] = [(1.0 + theta) / theta, (1.0 - theta) / theta];
        let [h, size] = [n, nodes].map(|n| 1.0 / n as f64);
        let count = 2 * n + nodes + 1;
        let plate = count - 1;
        let hats = |x: f64| {
            let cell = ((x / size) as usize).min(nodes - 1);
            let s = x / size - cell as f64;
            let both = [(cell, 1.0 - s), (cell + 1, s)];
            both.into_iter().filter(move |(b, _)| *b < nodes)
        };
        let mut matrix = DMatrix::<f64>::zeros(count, count);
        let mut storage = DMatrix::<f64>::zeros(nodes, count);
        for p in 0..2 * n {
            let (cell, volume) = (p / 2, 0.5 * h);
            let x = h * (cell as f64 + [0.25, 0.75][p % 2]);
            // Both equations of a cell in the first of its rows, and in the other that its strains are one.
            let row = if cell < together { 2 * cell } else { p };
            if row < p {
                matrix[(p, row)] = 1.0;
                matrix[(p, p)] = -1.0;
            }
            matrix[(row, p)] += modulus;
            matrix[(row, plate)] += lame;
            matrix[(plate, p)] += volume * lame;
            matrix[(plate, plate)] += volume * modulus;
            for (b, w) in hats(x) {
                matrix[(row, 2 * n + b)] -= w;
                matrix[(plate, 2 * n + b)] -= volume * w;
                storage[(b, p)] += volume * w;
                storage[(b, plate)] += volume * w;
                for (a, v) in hats(x) {
                    // Hats less their means, and τ.
                    let shares = (w - 0.5) * (v - 0.5) * cells.projection / modulus;
                    storage[(b, 2 * n + a)] += volume * shares;
                }
            }
        }
        for b in 0..nodes {
            let row = 2 * n + b;
            for column in 0..count {
                matrix[(row, column)] += storage[(b, column)];
            }
            // κ t = T a²/M.
            let flow = step / modulus / size;
            matrix[(row, row)] += if b == 0 { flow } else { 2.0 * flow };
            if b > 0 {
                matrix[(row, row - 1)] -= flow;
            }
            if b + 1 < nodes {
                matrix[(row, row + 1)] -= flow;
            }
        }
        Self { matrix, storage }
    }
}
