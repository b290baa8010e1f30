//! Symmetric second-order tensors in three dimensions, stored without their mirror components.

mod function;

use crate::number::{Lanes, Real};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// The determinant of `m`.
#[inline]
pub fn determinant<T: Real>(m: &Matrix3<T>) -> T {
    let minor = |j: usize, k: usize| m[(1, j)] * m[(2, k)] - m[(2, j)] * m[(1, k)];
    m[(0, 0)] * minor(1, 2) - m[(0, 1)] * minor(0, 2) + m[(0, 2)] * minor(0, 1)
}

/// The minor of `f` without the row `i` and the column `j`, with its sign.
#[inline(always)]
pub(crate) fn minor<T: Real>(f: &Matrix3<T>, i: usize, j: usize) -> T {
    let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
    f[(a, c)] * f[(b, d)] - f[(a, d)] * f[(b, c)]
}

/// A symmetric 3×3 tensor (a stress in Pa, a left Cauchy–Green tensor), or eight of them, or one with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SymmetricTensor<T = f64> {
    /// Component 11.
    pub xx: T,
    /// Component 22.
    pub yy: T,
    /// Component 33.
    pub zz: T,
    /// Component 12.
    pub xy: T,
    /// Component 23.
    pub yz: T,
    /// Component 13.
    pub xz: T,
}

impl SymmetricTensor {
    /// As a full matrix.
    pub fn to_matrix(&self) -> Matrix3<f64> {
        Matrix3::new(self.xx, self.xy, self.xz, self.xy, self.yy, self.yz, self.xz, self.yz, self.zz)
    }
}

impl<T: Lanes> SymmetricTensor<T> {
    /// The `k`-th of the tensors.
    #[inline(always)]
    pub fn part(&self, k: usize) -> SymmetricTensor {
        SymmetricTensor {
            xx: self.xx.part(k),
            yy: self.yy.part(k),
            zz: self.zz.part(k),
            xy: self.xy.part(k),
            yz: self.yz.part(k),
            xz: self.xz.part(k),
        }
    }
}

impl<T: Real> SymmetricTensor<T> {
    /// The tensors `of(0)`, `of(1)`, ….
    #[inline(always)]
    #[must_use]
    pub fn pack(of: impl Fn(usize) -> SymmetricTensor) -> Self {
        Self {
            xx: T::pack(|k| of(k).xx),
            yy: T::pack(|k| of(k).yy),
            zz: T::pack(|k| of(k).zz),
            xy: T::pack(|k| of(k).xy),
            yz: T::pack(|k| of(k).yz),
            xz: T::pack(|k| of(k).xz),
        }
    }

    /// The symmetric part of `m`.
    #[must_use]
    #[inline]
    pub fn symmetric_part(m: &Matrix3<T>) -> Self {
        let half = T::splat(0.5);
        Self {
            xx: m[(0, 0)],
            yy: m[(1, 1)],
            zz: m[(2, 2)],
            xy: half * (m[(0, 1)] + m[(1, 0)]),
            yz: half * (m[(1, 2)] + m[(2, 1)]),
            xz: half * (m[(0, 2)] + m[(2, 0)]),
        }
    }

    /// The identity.
    #[must_use]
    pub fn identity() -> Self {
        Self { xx: T::splat(1.0), yy: T::splat(1.0), zz: T::splat(1.0), ..Self::default() }
    }

    /// Component (`i`, `j`), counted from zero and below three.
    #[inline]
    pub fn get(&self, i: usize, j: usize) -> T {
        match (i.min(j), i.max(j)) {
            (0, 0) => self.xx,
            (1, 1) => self.yy,
            (0, 1) => self.xy,
            (1, 2) => self.yz,
            (0, 2) => self.xz,
            _ => self.zz,
        }
    }

    /// Trace.
    #[inline]
    pub fn trace(&self) -> T {
        self.xx + self.yy + self.zz
    }

    /// A third of the trace: for a Cauchy stress the mean normal stress (Pa, tension positive).
    #[inline]
    pub fn mean(&self) -> T {
        self.trace() / T::splat(3.0)
    }

    /// A number that no eigenvalue exceeds, and the greatest one where the axes are principal: of Gershgorin's circles.
    #[inline]
    pub fn greatest_at_most(&self) -> T {
        let (xy, yz, xz) = (self.xy.abs(), self.yz.abs(), self.xz.abs());
        let greater = |a: T, b: T| (a - b).if_positive(a, b);
        greater(greater(self.xx + (xy + xz), self.yy + (xy + yz)), self.zz + (xz + yz))
    }

    /// A number that no eigenvalue falls below, and the least one where the axes are principal.
    #[inline]
    pub fn least_at_least(&self) -> T {
        -self.scale_add_identity(T::splat(-1.0), T::default()).greatest_at_most()
    }

    /// Determinant.
    #[inline]
    pub fn determinant(&self) -> T {
        self.xx * (self.yy * self.zz - self.yz * self.yz) - self.xy * (self.xy * self.zz - self.yz * self.xz)
            + self.xz * (self.xy * self.yz - self.yy * self.xz)
    }

    /// The deviator: without its mean.
    #[must_use]
    #[inline]
    pub fn deviator(&self) -> Self {
        self.scale_add_identity(T::splat(1.0), -self.mean())
    }

    /// Frobenius norm √(a : a).
    #[inline]
    pub fn norm(&self) -> T {
        let normal = self.xx * self.xx + self.yy * self.yy + self.zz * self.zz;
        let shear = self.xy * self.xy + self.yz * self.yz + self.xz * self.xz;
        (normal + (shear + shear)).sqrt()
    }

    /// `a self + b I`.
    #[must_use]
    #[inline]
    pub fn scale_add_identity(&self, a: T, b: T) -> Self {
        Self {
            xx: a * self.xx + b,
            yy: a * self.yy + b,
            zz: a * self.zz + b,
            xy: a * self.xy,
            yz: a * self.yz,
            xz: a * self.xz,
        }
    }

    /// `f self fᵀ`: the push-forward of a left Cauchy–Green tensor by a relative deformation gradient.
    #[must_use]
    #[inline]
    pub fn push_forward(&self, f: &Matrix3<T>) -> Self {
        let out_of_plane = [f[(0, 2)], f[(1, 2)], f[(2, 0)], f[(2, 1)]];
        if self.is_planar() && out_of_plane == [T::default(); 4] {
            return self.push_forward_in_plane(f);
        }
        let dot = |i: usize, b: [T; 3]| f[(i, 2)].mul_add(b[2], f[(i, 1)].mul_add(b[1], f[(i, 0)] * b[0]));
        let half = |i: usize| {
            [
                dot(i, [self.xx, self.xy, self.xz]),
                dot(i, [self.xy, self.yy, self.yz]),
                dot(i, [self.xz, self.yz, self.zz]),
            ]
        };
        let rows = [half(0), half(1), half(2)];
        let entry = |i: usize, j: usize| dot(j, rows[i]);
        Self { xx: entry(0, 0), yy: entry(1, 1), zz: entry(2, 2), xy: entry(0, 1), yz: entry(1, 2), xz: entry(0, 2) }
    }

    /// The same in plane strain, bit for bit.
    #[inline]
    fn push_forward_in_plane(&self, f: &Matrix3<T>) -> Self {
        let dot = |i: usize, b: [T; 2]| f[(i, 1)].mul_add(b[1], f[(i, 0)] * b[0]);
        let half = |i: usize| [dot(i, [self.xx, self.xy]), dot(i, [self.xy, self.yy])];
        let (first, second) = (half(0), half(1));
        Self {
            xx: dot(0, first),
            yy: dot(1, second),
            zz: f[(2, 2)] * (f[(2, 2)] * self.zz),
            xy: dot(1, first),
            ..Self::default()
        }
    }
}
