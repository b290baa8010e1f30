//! Response of one particle to a trial ΔF of the step, and its derivatives.
//!
//! All stresses here are first Piola–Kirchhoff stresses of the configuration at the step's start, times volume: a
//! node's force is Σ P ∇w. With F̄ a particle has a potential V⁰ W(F̄) of ΔF and of its averaged change of volume a = A
//! ΔJ, F̄ = (a/ΔJ)^(1/D) ΔF F̄ⁿ. Its derivatives are P = ∂/∂ΔF and q = ∂/∂a, Eqs. (8) and (9) of `docs/implicit.md`.

use crate::material::{Answers, AnyLaw, SharedLaw};
use crate::number::{Dual, Real};
use crate::tensor::{determinant, minor};
use nalgebra::{Matrix3, SMatrix};

/// Most components of a ΔF.
pub(crate) const MOST: usize = 9;

/// A particle at the start of a step.
pub(super) struct Particle<'a> {
    /// The law.
    pub(super) law: &'a SharedLaw,
    /// State of the law.
    pub(super) state: &'a [f64],
    /// Duration of the step (s).
    pub(super) dt: f64,
    /// V⁰ J, with F̄ V⁰ J̄ (m³), at the start.
    pub(super) volume: f64,
}

/// Its answer, made of numbers `T`. Components in place D i + j.
pub(super) struct Response<T> {
    /// P at fixed a (J).
    pub(super) stress: [T; MOST],
    /// q (J); zero without F̄.
    pub(super) pull: T,
    /// The cofactor of ΔF.
    pub(super) cofactor: [T; MOST],
}

/// A component for every pair of axes.
pub(crate) type Square<const D: usize> = [[f64; D]; D];

/// `f`, completed to three dimensions, of variables: the component in the place D i + j is the variable of that number.
pub(crate) fn variables<const D: usize, const N: usize>(f: &SMatrix<f64, D, D>) -> Matrix3<Dual<N>> {
    Matrix3::from_fn(|i, j| {
        if i < D && j < D { Dual::variable(f[(i, j)], D * i + j) } else { Dual::splat(if i == j { 1.0 } else { 0.0 }) }
    })
}

/// The derivatives of an answer by ΔF and by a.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tangent<const D: usize> {
    /// ∂P/∂ΔF, with that of the cofactor times its share of the averaged q.
    pub(super) stress_by_f: [[Square<D>; D]; D],
    /// ∂P/∂a.
    pub(super) stress_by_a: Square<D>,
    /// ∂q/∂ΔF.
    pub(super) pull_by_f: Square<D>,
    /// ∂q/∂a.
    pub(super) pull_by_a: f64,
    /// The cofactor of ΔF.
    pub(super) cofactor: Square<D>,
    /// Stiffness against the particle's displacement, of contacts (N/m).
    pub(super) held: SMatrix<f64, D, D>,
}

/// `x^(1/D)`.
fn stretch<T: Real, const D: usize>(x: T) -> T {
    match D {
        1 => x,
        2 => x.sqrt(),
        _ => (x.ln() / T::splat(3.0)).exp(),
    }
}

impl Particle<'_> {
    /// The answer to `f`, completed to three dimensions, and with F̄ to the averaged change of volume.
    #[inline]
    pub(super) fn respond<T: Real, const D: usize>(&self, f: &Matrix3<T>, averaged: Option<T>) -> Response<T>
    where
        dyn AnyLaw: Answers<T>,
    {
        let mut cofactor = [T::default(); MOST];
        for i in 0..D {
            for j in 0..D {
                cofactor[D * i + j] = minor(f, i, j);
            }
        }
        let mut answer = Response { stress: [T::default(); MOST], pull: T::default(), cofactor };
        let mut scale = T::splat(self.volume);
        let mut pressure = T::default();
        let cauchy = match averaged {
            None => self.law.stress(f, self.dt, self.state),
            Some(averaged) => {
                let ratio = averaged / determinant(f);
                let stretch = stretch::<T, D>(ratio);
                let in_plane = |i: usize, j: usize| i < D && j < D;
                let scaled = Matrix3::from_fn(|i, j| if in_plane(i, j) { stretch * f[(i, j)] } else { f[(i, j)] });
                let cauchy = self.law.stress(&scaled, self.dt, self.state);
                for a in 0..D {
                    pressure += cauchy.get(a, a);
                }
                pressure = pressure / T::splat(D as f64);
                answer.pull = scale * pressure;
                scale *= ratio;
                cauchy
            }
        };
        for i in 0..D {
            for j in 0..D {
                let mut sum = -pressure * answer.cofactor[D * i + j];
                for k in 0..D {
                    sum += cauchy.get(i, k) * answer.cofactor[D * k + j];
                }
                answer.stress[D * i + j] = scale * sum;
            }
        }
        answer
    }

    /// The derivatives of the answer to `f` and `averaged`, with `share` (J) of the averaged q on the cofactor.
    pub(super) fn tangent<const D: usize>(
        &self,
        f: &SMatrix<f64, D, D>,
        averaged: Option<f64>,
        share: f64,
    ) -> Tangent<D> {
        // Components of ΔF and one more: two instances serve all, as each takes its time to compile.
        if D < 3 { self.derive::<D, 5>(f, averaged, share) } else { self.derive::<D, 10>(f, averaged, share) }
    }

    fn derive<const D: usize, const N: usize>(
        &self,
        f: &SMatrix<f64, D, D>,
        averaged: Option<f64>,
        share: f64,
    ) -> Tangent<D>
    where
        dyn AnyLaw: Answers<Dual<N>>,
    {
        let averaged = averaged.map(|a| Dual::variable(a, D * D));
        let answer = self.respond::<_, D>(&variables::<D, N>(f), averaged);
        let mut tangent = Tangent {
            stress_by_f: [[[[0.0; D]; D]; D]; D],
            stress_by_a: [[0.0; D]; D],
            pull_by_f: [[0.0; D]; D],
            pull_by_a: 0.0,
            cofactor: [[0.0; D]; D],
            held: SMatrix::zeros(),
        };
        for i in 0..D {
            for j in 0..D {
                let place = D * i + j;
                let cofactor = answer.cofactor[place];
                let whole = answer.stress[place] + Dual::splat(share) * cofactor;
                tangent.cofactor[i][j] = cofactor.value;
                for k in 0..D {
                    for l in 0..D {
                        tangent.stress_by_f[i][j][k][l] = whole.slope[D * k + l];
                    }
                }
                if averaged.is_some() {
                    tangent.stress_by_a[i][j] = whole.slope[D * D];
                    tangent.pull_by_f[i][j] = answer.pull.slope[place];
                }
            }
        }
        if averaged.is_some() {
            tangent.pull_by_a = answer.pull.slope[D * D];
        }
        tangent
    }
}
