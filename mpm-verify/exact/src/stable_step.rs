//! The largest step by linear analysis: `docs/remedy.md`, in one to three dimensions and for every transfer.

use crate::common::UNSEEN;
use mpm_core::Axis;
use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_solvers::scheme::{BasisName, Explicit, RemedyName, TransferName};
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// Cells of an axis on which functions are looked up, and the one in which; the cell is the unit of length.
const CELLS: usize = 12;
const CELL: f64 = 5.0;
/// Step of the second derivative, in cells.
const NEARBY: f64 = 1e-6;
/// Threshold below which a sum of a few weights counts as zero.
const ROUNDING: f64 = 1e-9;

/// A lattice of particles, the same in every cell.
pub struct Setting {
    /// Basis, remedy and transfer.
    pub scheme: Explicit,
    /// Positions of the particles of a cell along each axis (cells), from 0 to 1.
    pub places: Vec<Vec<f64>>,
    /// Half size of the particles (cells).
    pub half_size: f64,
    /// Cells of a period.
    pub period: usize,
    /// Stiffness along an axis over the modulus ρ₀ c² of the CFL number; other than 1 in one dimension alone.
    pub axial: f64,
    /// Shear modulus over ρ₀ c².
    pub shear: f64,
    /// J σ of a mean stress over ρ₀ c²; other than 0 in one dimension alone.
    pub mean_stress: f64,
    /// Coefficient of the linear artificial viscosity.
    pub viscosity: f64,
}

/// Values of a nodal wave at a particle, along an axis.
struct Seen {
    value: Complex<f64>,
    slope: Complex<f64>,
    curvature: Complex<f64>,
    /// Σ w (x_m − x) e^{iθm}, and Σ w (x_m − x)².
    arm: Complex<f64>,
    moment: f64,
}

fn see<const S: usize, B: Basis<S>>(place: f64, half_size: f64, theta: f64) -> Seen {
    let functions = B::new(&Axis::periodic(0.0, CELLS), 1.0, WallTreatment::OpenKnot);
    let nodes = functions.nodes().position;
    let x = CELL + place;
    let at = |x: f64| functions.weights(x, half_size);
    let sum = |x: f64, of: &dyn Fn(f64, f64, f64) -> f64| {
        let found = at(x);
        let each = (0..S).map(|s| {
            let arm = nodes.get(found.first + s).map_or(0.0, |node| node - x);
            Complex::cis(theta * (found.first + s) as f64) * of(found.w[s], found.dw[s], arm)
        });
        each.sum::<Complex<f64>>()
    };
    let slope = |x| sum(x, &|_, dw, _| dw);
    let still = at(x);
    let moments = (0..S).map(|s| {
        let arm = nodes.get(still.first + s).map_or(0.0, |node| node - x);
        still.w[s] * arm * arm
    });
    Seen {
        value: sum(x, &|w, _, _| w),
        slope: slope(x),
        curvature: (slope(x + NEARBY) - slope(x - NEARBY)) / (2.0 * NEARBY),
        arm: sum(x, &|w, _, arm| w * arm),
        moment: moments.sum(),
    }
}

/// Sums over the particles of a cell, for one wave vector: Π̂; what an affine part adds to it; stiffness over ρc²/h².
struct Symbol {
    kept: f64,
    affine: f64,
    stiffness: f64,
}

impl Setting {
    fn symbol(&self, wave: &[f64]) -> Symbol {
        let dimension = self.places.len();
        let axes: Vec<Vec<Seen>> = self
            .places
            .iter()
            .zip(wave)
            .map(|(places, theta)| {
                let (half, theta) = (self.half_size, *theta);
                let of = |place: &f64| match self.scheme.basis {
                    BasisName::Linear => see::<2, Linear>(*place, half, theta),
                    BasisName::Gimp | BasisName::Q8 => see::<3, Gimp>(*place, half, theta),
                    BasisName::Bspline2 => see::<3, QuadraticBSpline>(*place, half, theta),
                    BasisName::Bspline3 => see::<4, CubicBSpline>(*place, half, theta),
                };
                places.iter().map(of).collect()
            })
            .collect();
        let counts: Vec<usize> = axes.iter().map(Vec::len).collect();
        let all: usize = counts.iter().product();
        let share = 1.0 / all as f64;
        let zero = Complex::new(0.0, 0.0);
        let (mut kept, mut affine, mut curved) = (0.0, 0.0, 0.0);
        let mut volume = DVector::from_element(dimension, zero);
        let mut traces = DMatrix::from_element(dimension, dimension, zero);
        let mut strains = traces.clone();
        for mut k in 0..all {
            let at: Vec<&Seen> = axes
                .iter()
                .zip(&counts)
                .map(|(axis, n)| {
                    let seen = &axis[k % n];
                    k /= n;
                    seen
                })
                .collect();
            // The product over the axes, with something else in place of the value along one.
            let but = |axis: usize, of: &dyn Fn(&Seen) -> Complex<f64>| -> Complex<f64> {
                let factor = |(a, seen): (usize, &&Seen)| if a == axis { of(seen) } else { seen.value };
                at.iter().enumerate().map(factor).product()
            };
            let value = but(0, &|s| s.value);
            let slopes = DVector::from_fn(dimension, |a, _| but(a, &|s| s.slope));
            kept += share * value.norm_sqr();
            for (a, seen) in at.iter().enumerate() {
                let arm = but(a, &|s| s.arm).norm_sqr();
                affine += if seen.moment > 0.0 { share * arm / seen.moment } else { 0.0 };
            }
            curved += share * (but(0, &|s| s.curvature).conj() * value).re;
            volume += &slopes * (value.conj() * share);
            let conjugate = slopes.conjugate();
            traces += &conjugate * slopes.transpose() * Complex::from(share);
            let length: f64 = slopes.iter().map(Complex::norm_sqr).sum();
            let unit = DMatrix::identity(dimension, dimension) * Complex::from(length);
            strains += (unit + &slopes * conjugate.transpose()) * Complex::from(0.5 * share);
        }
        let seen = volume.conjugate() * volume.transpose();
        let filtered = if kept > ROUNDING { seen.clone() / Complex::from(kept) } else { seen.clone() * zero };
        let volumes = match self.scheme.remedy {
            RemedyName::None => traces.clone(),
            RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => seen,
            // Not predicted.
            RemedyName::Other(..) | RemedyName::Own => seen,
            RemedyName::FbarConsistent => {
                let sharp = 1.0 - (1.0 - UNSEEN) * (1.0 - kept).powi(2);
                let unseen = (&traces - &filtered) * Complex::from(UNSEEN * UNSEEN);
                filtered * Complex::from(sharp * sharp) + unseen
            }
        };
        // From λ + 2μ follows the modulus of a change of volume in D dimensions, λ + 2μ/D.
        let part = 1.0 / dimension as f64;
        let bulk = self.axial - 2.0 * self.shear * (1.0 - part);
        let deviators = strains - &traces * Complex::from(part);
        let matrix = volumes * Complex::from(bulk) + deviators * Complex::from(2.0 * self.shear);
        let greatest = matrix.symmetric_eigenvalues().max();
        let length: f64 = traces.diagonal().iter().map(|c| c.re).sum();
        Symbol { kept, affine, stiffness: greatest + self.mean_stress * (length + curved) }
    }

    /// Largest g = τ² × stiffness by the Jury conditions of the two by two matrix of a wave.
    fn largest(&self, symbol: &Symbol) -> f64 {
        let kept = symbol.kept;
        match (self.scheme.transfer, self.scheme.remedy) {
            (TransferName::Apic, _) => 2.0 + 2.0 * (kept + symbol.affine),
            (TransferName::Xpic2, _) => {
                let stays = 1.0 - (1.0 - kept).powi(2);
                (2.0 + 2.0 * stays) / (1.0 + stays - kept)
            }
            (TransferName::Musl, _) => 4.0 / kept.max(ROUNDING),
            (_, RemedyName::FbarRecursive) => (2.0 + 2.0 * kept) / (2.0 - kept),
            (_, _) => 4.0 / (2.0 - kept),
        }
    }

    /// The largest CFL number (zero if every one is unstable) and the fastest growth per step and CFL number of a wave
    /// fed by a mean stress. `None` where the analysis is not made: `fbar-recursive` in more than one dimension,
    /// `fbar-recursive` and `fbar-consistent` under a mean stress, a remedy with a viscosity, other members of the family,
    /// a remedy of another program.
    pub fn predicted(&self) -> Option<[f64; 2]> {
        let dimension = self.places.len();
        match self.scheme.remedy {
            RemedyName::FbarRecursive if dimension > 1 || self.mean_stress != 0.0 => return None,
            RemedyName::FbarConsistent if self.mean_stress != 0.0 => return None,
            RemedyName::Other(..) | RemedyName::Own => return None,
            remedy if remedy != RemedyName::None && self.viscosity > 0.0 => return None,
            _ => {}
        }
        let (mut squared, mut fed) = (f64::INFINITY, 0.0_f64);
        for mut k in 1..self.period.pow(dimension as u32) {
            let wave: Vec<f64> = (0..dimension)
                .map(|_| {
                    let m = k % self.period;
                    k /= self.period;
                    TAU * m as f64 / self.period as f64
                })
                .collect();
            let symbol = self.symbol(&wave);
            if symbol.stiffness > ROUNDING {
                squared = squared.min(self.largest(&symbol) / symbol.stiffness);
            }
            // In the limit of small steps (z − 1)² = −g Π̂.
            fed = fed.max(-symbol.stiffness * symbol.kept);
        }
        let grows = fed > ROUNDING;
        // A wave that changes sign in every step: half of its particles are compressed at a time, the viscosity makes
        // their stress 1 + 2 c₁/τ times as large, that of all 1 + c₁/τ times.
        let half = 0.5 * self.viscosity;
        let damped = (half * half + squared).sqrt() - half;
        Some([if grows { 0.0 } else { damped }, if grows { fed.sqrt() } else { 0.0 }])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_solvers::scheme::RemedyName::{FbarConsistent, FbarRate, FbarRecursive, None};

    /// The table of `docs/remedy.md`, two particles a cell, within its two decimals and a period of 48 cells.
    #[test]
    fn in_one_dimension_it_is_the_table_of_modes() {
        let table = [
            (BasisName::Linear, [0.76, 1.69, 1.56, 1.49]),
            (BasisName::Gimp, [0.76, 1.69, 1.56, 1.49]),
            (BasisName::Bspline2, [1.35, 2.03, 1.88, 1.78]),
            (BasisName::Bspline3, [1.49, 2.27, 2.11, 1.98]),
        ];
        for (basis, expected) in table {
            for (remedy, cfl) in [None, FbarRate, FbarConsistent, FbarRecursive].into_iter().zip(expected) {
                let setting = Setting {
                    scheme: Explicit { basis, remedy, transfer: TransferName::Flip },
                    places: vec![vec![0.25, 0.75]],
                    half_size: 0.25,
                    period: 48,
                    axial: 1.0,
                    shear: 0.3,
                    mean_stress: 0.0,
                    viscosity: 0.0,
                };
                let [found, fed] = setting.predicted().unwrap();
                assert!((found - cfl).abs() < 0.01 && fed == 0.0, "{basis} {remedy}: {found} {cfl}");
            }
        }
    }
}
