//! The same scene from elsewhere: along other axes, from another origin, in other units.
//!
//! No result may depend on that, except for the digits that positions far from the origin lose. Axes may change places
//! and point the other way; other angles would turn the grid against the body, which is another scene. The units of
//! length and stress are free. The second stays, so that the unit of mass follows: with millimetres and megapascals,
//! the tonne.

use crate::grid::{Axis, AxisKind, Grid};
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;

/// How a scene is described from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame<const D: usize> {
    /// Axis of the scene along which each axis of the frame lies, and 1, or −1 if it points the other way.
    axes: [(usize, f64); D],
    /// Where the scene's origin lies, in the frame's units.
    origin: [f64; D],
    /// A metre and a pascal in the frame's units.
    length: f64,
    stress: f64,
}

/// Nodes of all bases lie on these shares of a cell.
const SHARES: f64 = 6.0;

impl<const D: usize> Frame<D> {
    /// The frame whose axis `k` lies along the scene's axis `axes[k].0`, with the sign `axes[k].1`.
    #[must_use]
    pub fn along(axes: [(usize, f64); D]) -> Self {
        Self { axes, origin: [0.0; D], length: 1.0, stress: 1.0 }
    }

    /// The scene's own axes.
    #[must_use]
    pub fn own() -> Self {
        Self::along(std::array::from_fn(|axis| (axis, 1.0)))
    }

    /// Seen from where the scene's origin lies at `origin`, in the frame's units.
    #[must_use]
    pub fn shifted(self, origin: [f64; D]) -> Self {
        Self { origin, ..self }
    }

    /// In units of which a metre is `length` and a pascal `stress`.
    #[must_use]
    pub fn in_units(self, length: f64, stress: f64) -> Self {
        Self { length, stress, ..self }
    }

    /// Factor of a quantity of the unit Paᵃ mᵇ.
    pub fn scale(&self, stress: i32, length: i32) -> f64 {
        self.stress.powi(stress) * self.length.powi(length)
    }

    /// Factor of a force (Pa mᴰ⁻¹).
    pub fn force(&self) -> f64 {
        self.scale(1, D as i32 - 1)
    }

    /// Factor of a stiffness, a force over a length.
    pub fn stiffness(&self) -> f64 {
        self.scale(1, D as i32 - 2)
    }

    /// The axis of the frame along the scene's `axis`, and its sign.
    pub fn axis(&self, axis: usize) -> (usize, f64) {
        let found = self.axes.iter().position(|(own, _)| *own == axis);
        found.map_or((axis, 1.0), |k| (k, self.axes[k].1))
    }

    /// A vector of a unit that is multiplied by `scale`.
    pub fn vector(&self, of_scene: &[f64; D], scale: f64) -> [f64; D] {
        self.axes.map(|(axis, sign)| scale * sign * of_scene[axis])
    }

    /// A vector of the frame as the scene has it: the inverse of [`Self::vector`].
    pub fn vector_of_scene(&self, vector: &[f64; D], scale: f64) -> [f64; D] {
        let mut of_scene = [0.0; D];
        for ((axis, sign), v) in self.axes.iter().zip(vector) {
            of_scene[*axis] = sign * v / scale;
        }
        of_scene
    }

    /// A place.
    pub fn place(&self, of_scene: &[f64; D]) -> [f64; D] {
        let turned = self.vector(of_scene, self.length);
        std::array::from_fn(|k| turned[k] + self.origin[k])
    }

    /// A place of the frame as the scene has it: the inverse of [`Self::place`].
    pub fn place_of_scene(&self, place: &[f64; D]) -> [f64; D] {
        let from_origin = std::array::from_fn(|k| place[k] - self.origin[k]);
        self.vector_of_scene(&from_origin, self.length)
    }

    /// The place of a node of the frame as the scene, on `grid`, has it: without what the way there and back rounds
    /// off.
    pub fn node_of_scene(&self, grid: &Grid<D>, place: &[f64; D]) -> [f64; D] {
        let near = self.place_of_scene(place);
        std::array::from_fn(|a| {
            let lo = grid.axes[a].lo;
            let shares = (near[a] - lo) / grid.h * SHARES;
            lo + shares.round() / SHARES * grid.h
        })
    }

    /// Lower and upper ends along the axes.
    pub fn extent(&self, of_scene: &[[f64; 2]; D]) -> [[f64; 2]; D] {
        let [lo, hi] = [0, 1].map(|end| self.place(&of_scene.map(|ends| ends[end])));
        std::array::from_fn(|k| match self.axes[k].1 > 0.0 {
            true => [lo[k], hi[k]],
            false => [hi[k], lo[k]],
        })
    }

    /// A tensor of a unit that is multiplied by `scale`.
    pub fn matrix(&self, of_scene: &SMatrix<f64, D, D>, scale: f64) -> SMatrix<f64, D, D> {
        SMatrix::from_fn(|i, j| {
            let ((a, s), (b, t)) = (self.axes[i], self.axes[j]);
            scale * s * t * of_scene[(a, b)]
        })
    }

    /// A stress of the scene (Pa) as the frame has it. Axes beyond the dimension stay.
    pub fn stress(&self, of_scene: &SymmetricTensor) -> SymmetricTensor {
        let of = |i: usize, j: usize| {
            let [(a, s), (b, t)] = [i, j].map(|k| self.axes.get(k).copied().unwrap_or((k, 1.0)));
            s * t * self.stress * of_scene.get(a, b)
        };
        SymmetricTensor { xx: of(0, 0), yy: of(1, 1), zz: of(2, 2), xy: of(0, 1), yz: of(1, 2), xz: of(0, 2) }
    }

    /// A stress of the frame as the scene (Pa) has it. Axes beyond the dimension stay.
    pub fn stress_of_scene(&self, stress: &SymmetricTensor) -> SymmetricTensor {
        let of = |a: usize, b: usize| {
            let [(i, s), (j, t)] = [a, b].map(|axis| self.axis(axis));
            s * t * stress.get(i, j) / self.stress
        };
        SymmetricTensor { xx: of(0, 0), yy: of(1, 1), zz: of(2, 2), xy: of(0, 1), yz: of(1, 2), xz: of(0, 2) }
    }

    /// The grid.
    pub fn grid(&self, of_scene: &Grid<D>) -> Grid<D> {
        let ends = of_scene.axes.map(|a| [a.lo, a.hi(of_scene.h)]);
        let ends = self.extent(&ends);
        let axes = std::array::from_fn(|k| {
            let (axis, sign) = self.axes[k];
            let own = of_scene.axes[axis];
            let kind = match own.kind {
                AxisKind::Bounded { lo, hi } if sign < 0.0 => AxisKind::Bounded { lo: hi, hi: lo },
                kind => kind,
            };
            Axis { lo: ends[k][0], kind, ..own }
        });
        Grid { h: self.length * of_scene.h, axes }
    }
}
