//! Where a lattice that is stretched loses its stiffness, where neighbours part, and how its stress is noisy until then.

use crate::lattice::{force, nodes, symbol, transform};
use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::material::NeoHookean;
use mpm_core::{Axis, Law};
use mpm_solvers::scheme::BasisName;
use nalgebra::{DMatrix, Matrix3};
use std::f64::consts::TAU;

/// Cells of the free part on each side of the middle.
pub const FREE: usize = 4;
/// Waves of the lattice whose forces are summed.
const WAVES: i32 = 3;
/// Step of the second derivative, in cells.
const NEARBY: f64 = 1e-6;
/// Cells beside the free part in which particles and nodes are looked at.
const BESIDE: usize = 4;
/// The least mass of a node that counts, in that of a particle's volume.
const SEEN: f64 = 1e-9;
/// Steps of the stretch in which a prediction is looked for.
const SCAN: f64 = 1e-3;
const LOOK: f64 = 0.01;
/// Relative step of a derivative.
const STEP: f64 = 1e-5;
/// Stiffness over mass below which it counts as negative.
const ROUNDING: f64 = 1e-9;

/// A basis and the half size of the particles (cells).
#[derive(Clone, Copy)]
pub struct Lattice {
    /// Basis.
    pub basis: BasisName,
    /// Half size of the particles (cells).
    pub half_size: f64,
}

impl Lattice {
    /// Whether neighbours have no common node somewhere in the free part; places in cells.
    pub fn parted(&self, mut places: Vec<f64>) -> bool {
        places.sort_by(f64::total_cmp);
        let free = |x: f64| x.abs() < FREE as f64;
        let apart = |pair: &[f64]| {
            let seen = |x| nodes(self.basis, self.half_size, x);
            let ([_, last], [first, _]) = (seen(pair[0]), seen(pair[1]));
            first > last && (free(pair[0]) || free(pair[1]))
        };
        places.windows(2).any(apart)
    }

    /// Least stiffness over mass of the free nodes: of the stiffness `axial` of a particle at these places (cells), and
    /// of a stress that moves with it. Only its sign has a meaning.
    pub fn least_stiffness(&self, places: &[f64], axial: f64, stress: f64) -> f64 {
        let matrix = match self.basis {
            BasisName::Linear => self.tangent::<2, Linear>(places, axial, stress),
            BasisName::Gimp | BasisName::Q8 => self.tangent::<3, Gimp>(places, axial, stress),
            BasisName::Bspline2 => self.tangent::<3, QuadraticBSpline>(places, axial, stress),
            BasisName::Bspline3 => self.tangent::<4, CubicBSpline>(places, axial, stress),
        };
        let values = matrix.complex_eigenvalues();
        values.iter().map(|v| v.re).fold(f64::INFINITY, f64::min)
    }

    /// Whether the least stiffness is below zero.
    pub fn is_unstable(&self, places: &[f64], axial: f64, stress: f64) -> bool {
        self.least_stiffness(places, axial, stress) < -ROUNDING * axial
    }

    fn tangent<const S: usize, B: Basis<S>>(&self, places: &[f64], axial: f64, stress: f64) -> DMatrix<f64> {
        let cells = FREE + BESIDE;
        let axis = Axis::open(-(cells as f64), 2 * cells);
        let functions = B::new(&axis, 1.0, WallTreatment::OpenKnot);
        let nodes = functions.nodes().position;
        let free: Vec<usize> = (0..nodes.len()).filter(|i| nodes[*i].abs() < FREE as f64 - NEARBY).collect();
        let near = places.iter().filter(|x| x.abs() < (FREE + BESIDE / 2) as f64);
        let mut stiffness = DMatrix::zeros(free.len(), free.len());
        let mut mass = vec![0.0; free.len()];
        for x in near {
            let [here, behind, ahead] = [*x, x - NEARBY, x + NEARBY].map(|x| functions.weights(x, self.half_size));
            let of = |found: &mpm_core::basis::AxisWeights<S>, node: usize| {
                let k = node.checked_sub(found.first).filter(|k| *k < S);
                k.map_or([0.0; 2], |k| [found.w[k], found.dw[k]])
            };
            for (row, i) in free.iter().enumerate() {
                let [w, slope] = of(&here, *i);
                mass[row] += w;
                let curvature = (of(&ahead, *i)[1] - of(&behind, *i)[1]) / (2.0 * NEARBY);
                for (column, j) in free.iter().enumerate() {
                    let [value, other] = of(&here, *j);
                    stiffness[(row, column)] += axial * slope * other + stress * curvature * value;
                }
            }
        }
        for (row, mass) in mass.iter().enumerate() {
            let share = 1.0 / mass.max(SEEN);
            stiffness.row_mut(row).scale_mut(share);
        }
        stiffness
    }

    /// Rms of the stress that answers the forces of a uniform stress, over it, with `per_cell` particles a cell: see
    /// `docs/stretch.md`.
    pub fn noise(&self, per_cell: f64) -> f64 {
        let of_basis = |k: f64| transform(self.basis, 0.5 / self.half_size, k);
        let longest = TAU / (2 * FREE) as f64;
        let answers = (1..=WAVES).map(|k| {
            let waves = per_cell * f64::from(k);
            // Held ends leave no wave that is longer than the free part.
            let angle = (TAU * (waves - waves.round())).abs().max(longest);
            let [stiffness, _] = symbol(angle, &of_basis);
            force(waves, &of_basis) / (2.0 * stiffness).sqrt()
        });
        answers.map(|a| a * a).sum::<f64>().sqrt()
    }
}

/// A body of a lattice that is stretched alike everywhere, along as many axes as it has.
#[derive(Clone, Copy)]
pub struct Stretched {
    /// Its law.
    pub law: NeoHookean,
    /// Its density (kg/m³).
    pub density: f64,
    /// Its dimension.
    pub dimension: usize,
    /// Functions and particles.
    pub lattice: Lattice,
    /// Cells of the undeformed body on each side of the middle.
    pub half_length: f64,
    /// Stretch at the end.
    pub end: f64,
}

impl Stretched {
    /// The exact stress (Pa), and the speed of waves (m/s).
    pub fn state(&self, stretch: f64) -> [f64; 2] {
        let mut f = Matrix3::identity();
        for a in 0..self.dimension {
            f[(a, a)] = stretch;
        }
        let (stress, state) = self.law.at_rest(&f);
        let j = stretch.powi(self.dimension as i32);
        let modulus = self.law.wave_modulus(j, &stress, &state);
        [stress.get(0, 0), (modulus / self.density).sqrt()]
    }

    fn per_cell(&self) -> f64 {
        0.5 / self.lattice.half_size
    }

    /// Places in cells of the particles of the undeformed body.
    pub fn places(&self) -> Vec<f64> {
        let count = (self.half_length * self.per_cell()) as i64;
        (-count..count).map(|k| (k as f64 + 0.5) / self.per_cell()).collect()
    }

    fn places_at(&self, stretch: f64) -> Vec<f64> {
        self.places().iter().map(|x| x * stretch).collect()
    }

    fn stretches(&self, step: f64) -> impl Iterator<Item = f64> {
        let whole = self.end - 1.0;
        let count = (whole.abs() / step).ceil();
        (0..=count as u64).map(move |k| 1.0 + whole * k as f64 / count)
    }

    /// The first stretch at which a wave of the free nodes has a negative stiffness in the exact state.
    pub fn unstable(&self) -> Option<f64> {
        // Slopes that jump have a curvature somewhere, and none elsewhere; in the plane nothing is foretold.
        if self.lattice.basis == BasisName::Linear || self.dimension > 1 {
            return None;
        }
        let stress = |stretch: f64| self.state(stretch)[0];
        self.stretches(LOOK).find(|stretch| {
            let rise = stress(stretch * (1.0 + STEP)) - stress(stretch * (1.0 - STEP));
            let axial = stress(*stretch) + rise / (2.0 * STEP);
            self.lattice.is_unstable(&self.places_at(*stretch), axial, stress(*stretch))
        })
    }

    /// The first stretch at which the exact places leave neighbours without a common node.
    pub fn parting(&self) -> Option<f64> {
        self.stretches(SCAN).find(|stretch| self.lattice.parted(self.places_at(*stretch)))
    }

    /// The most of the noise that is foretold up to a stretch. In the plane there are waves along either axis, whose
    /// stress across is no more than that along.
    pub fn noise(&self, end: f64) -> f64 {
        let each = self.stretches(LOOK).take_while(|s| (s - 1.0).abs() <= (end - 1.0).abs());
        let most = each.map(|s| self.lattice.noise(self.per_cell() / s)).fold(0.0, f64::max);
        most * (self.dimension as f64).sqrt()
    }

    /// The first stretch at which the fastest particle and the waves of the exact state pass a cell of the size `h` (m) in a
    /// step of `dt` (s); the stretch has a `rate` (1/s).
    pub fn stop(&self, rate: f64, dt: f64, h: f64) -> Option<f64> {
        let ends = self.places().last().map_or(0.0, |x| x * h) * rate.abs();
        self.stretches(SCAN).find(|stretch| (self.state(*stretch)[1] + ends) * dt > h)
    }
}
