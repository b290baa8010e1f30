//! Response of one particle of solid and water to a trial of the step, and its derivatives.
//!
//! The reference configuration is that of the step's start: P is a first Piola–Kirchhoff stress there, times volume, and
//! the flux goes through its areas. C is the cofactor J̃ F̃⁻ᵀ of the relative deformation. Equations are those of
//! `docs/poromechanics.md`.

use super::settings::VolumeRate;
use super::water::{Gravity, Medium};
use crate::implicit::response::{MOST, Square, variables};
use crate::material::{Answers, AnyLaw, SharedLaw};
use crate::number::{Dual, Real};
use crate::tensor::{determinant, minor};
use nalgebra::{Matrix3, SMatrix};
use std::array::from_fn;

/// A particle at the start of a step.
pub(super) struct Particle<'a, const D: usize> {
    pub(super) law: &'a SharedLaw,
    pub(super) state: &'a [f64],
    pub(super) medium: Medium,
    pub(super) gravity: Option<&'a Gravity<D>>,
    pub(super) rate: VolumeRate,
    /// Duration of the step (s).
    pub(super) dt: f64,
    /// V (m³) and J at the start.
    pub(super) volume: f64,
    pub(super) jacobian: f64,
}

/// Its answer, made of numbers `T`. Components in place D i + j.
pub(super) struct Answer<T> {
    /// V (σ′ − p I) C (J), Eq. (3).
    pub(super) stress: [T; MOST],
    /// V v, the change of volume (m³), Eq. (7).
    pub(super) rate: T,
    /// −V times the flux of the water (m⁴/s), Eq. (6), which enters the equations as ∇M · flow.
    pub(super) flow: [T; 3],
    /// V κ Cᵀ C/J̃ (m⁵/(Pa s)): the derivative of the flow by ∇p.
    pub(super) mobility: [T; MOST],
    /// Mass of grains and water (kg), Eq. (4); zero without gravity.
    pub(super) mass: T,
}

/// The derivatives of an answer by F̃ and p.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes<const D: usize> {
    pub(super) stress_by_f: [[Square<D>; D]; D],
    pub(super) stress_by_p: Square<D>,
    pub(super) rate_by_f: Square<D>,
    pub(super) flow_by_f: [Square<D>; D],
    pub(super) mobility: Square<D>,
    pub(super) mass_by_f: Square<D>,
}

impl<const D: usize> Particle<'_, D> {
    /// The answer to `f`, completed to three dimensions, at the pressure `p` (Pa) with the gradient `slope` (Pa/m).
    #[inline]
    pub(super) fn respond<T: Real>(&self, f: &Matrix3<T>, p: T, slope: &[f64; D]) -> Answer<T>
    where
        dyn AnyLaw: Answers<T>,
    {
        let number = T::splat;
        let mut cofactor = [[T::default(); D]; D];
        for (i, row) in cofactor.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = minor(f, i, j);
            }
        }
        let effective = self.law.stress(f, self.dt, self.state);
        let volume = number(self.volume);
        let change = determinant(f);
        let solid = number((1.0 - self.medium.porosity) / self.jacobian) / change;
        let conductivity = volume * self.medium.conductivity.at(number(1.0) - solid);
        let mut answer = Answer {
            stress: [T::default(); MOST],
            rate: volume
                * match self.rate {
                    VolumeRate::Exact => change - number(1.0),
                    VolumeRate::Logarithmic => change * change.ln(),
                },
            flow: [T::default(); 3],
            mobility: [T::default(); MOST],
            mass: T::default(),
        };
        for i in 0..D {
            for j in 0..D {
                let mut sum = -p * cofactor[i][j];
                let mut square = T::default();
                for (k, row) in cofactor.iter().enumerate() {
                    sum += effective.get(i, k) * row[j];
                    square += row[i] * row[j];
                }
                answer.stress[D * i + j] = volume * sum;
                answer.mobility[D * i + j] = conductivity * square / change;
                answer.flow[i] += answer.mobility[D * i + j] * number(slope[j]);
            }
        }
        if let Some(gravity) = self.gravity {
            for i in 0..D {
                for (row, g) in cofactor.iter().zip(gravity.acceleration) {
                    answer.flow[i] += -(number(gravity.water * g) * conductivity * row[i]);
                }
            }
            let grains = (1.0 - self.medium.porosity) / self.jacobian;
            let solid = number(self.medium.grains.unwrap_or(gravity.grains) * grains);
            answer.mass = volume * (solid + number(gravity.water) * (change - number(grains)));
        }
        answer
    }

    /// The derivatives of the answer.
    pub(super) fn slopes(&self, f: &SMatrix<f64, D, D>, p: f64, slope: &[f64; D]) -> Slopes<D> {
        // Components of F̃ and p: two instances serve all, as each takes its time to compile.
        if D < 3 { self.derive::<5>(f, p, slope) } else { self.derive::<10>(f, p, slope) }
    }

    fn derive<const N: usize>(&self, f: &SMatrix<f64, D, D>, p: f64, slope: &[f64; D]) -> Slopes<D>
    where
        dyn AnyLaw: Answers<Dual<N>>,
    {
        let answer = self.respond(&variables::<D, N>(f), Dual::variable(p, D * D), slope);
        let by_f = |of: &Dual<N>| -> Square<D> { from_fn(|k| from_fn(|l| of.slope[D * k + l])) };
        let each = |i: usize, j: usize| &answer.stress[D * i + j];
        Slopes {
            stress_by_f: from_fn(|i| from_fn(|j| by_f(each(i, j)))),
            stress_by_p: from_fn(|i| from_fn(|j| each(i, j).slope[D * D])),
            rate_by_f: by_f(&answer.rate),
            flow_by_f: from_fn(|i| by_f(&answer.flow[i])),
            mobility: from_fn(|i| from_fn(|j| answer.mobility[D * i + j].value)),
            mass_by_f: by_f(&answer.mass),
        }
    }
}
