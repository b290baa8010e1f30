//! Penalties on the increment of a step: constant symmetric matrices on a few nodes each.

use nalgebra::DMatrix;

/// A penalty ½ uᵀ K u on the increments u of some nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Penalty {
    /// The nodes.
    pub node: Vec<usize>,
    /// K (N/m), node by node and in each component by component.
    pub stiffness: DMatrix<f64>,
}

/// Moduli of undeformed material (Pa) that penalties scale with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    /// Lamé's first parameter λ.
    pub lambda: f64,
    /// Shear modulus μ.
    pub mu: f64,
}

impl Moduli {
    /// Young's modulus (Pa).
    pub fn young(&self) -> f64 {
        self.mu * (3.0 * self.lambda + 2.0 * self.mu) / (self.lambda + self.mu)
    }

    /// The stiffness ∫ Bᵀ C B of functions with gradients `dw` (1/m) times `weight` (m³), added to `stiffness`.
    pub fn add_stiffness<const D: usize>(&self, dw: &[[f64; D]], weight: f64, stiffness: &mut DMatrix<f64>) {
        for (j, g) in dw.iter().enumerate() {
            for (i, f) in dw.iter().enumerate() {
                let dot: f64 = (0..D).map(|a| f[a] * g[a]).sum();
                for b in 0..D {
                    for a in 0..D {
                        let mut k = self.lambda * f[a] * g[b] + self.mu * f[b] * g[a];
                        if a == b {
                            k += self.mu * dot;
                        }
                        stiffness[(i * D + a, j * D + b)] += weight * k;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// E = 10 and ν = ¼: λ = μ = 4.
    #[test]
    fn youngs_modulus_is_that_of_lames() {
        let moduli = Moduli { lambda: 4.0, mu: 4.0 };
        assert_eq!(moduli.young(), 10.0);
        let stiffer = Moduli { lambda: 6.0, mu: 2.0 };
        // ν = λ/2(λ + μ) = 3/8, E = 2 μ (1 + ν).
        assert_eq!(stiffer.young(), 5.5);
    }
}
