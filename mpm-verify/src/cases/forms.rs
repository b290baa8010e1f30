//! Matrices of forms on the functions of the solver of solid and water, for cases that look at matrices and not at
//! motion.

use mpm_core::implicit::{Domains, Functions, HalfSizes, Interpolation, Moduli, Penalty};
use mpm_core::{Cause, Error, Grid, Lattice, basis};
use nalgebra::{DMatrix, DVector};

/// Least value of a function, or slope over a cell, that counts at a particle: less is rounding. The solver's own
/// limit.
const LEAST: f64 = 1e-12;

/// Half the size of a point, over a cell's: a mean over none has no meaning. A function that is zero at the point is
/// less than the other number there.
const POINT: f64 = 1e-9;
const HELD: f64 = 1e-6;

pub(super) type Hats = Lattice<2, 2, basis::Linear>;
pub(super) type Means = Lattice<2, 3, basis::Gimp>;

/// The fault of a matrix that has no factors.
pub(super) fn singular() -> Error {
    Error::Singular { time: 0.0, step: 0, iteration: 0, cause: Cause::Unknown }
}

pub(super) struct Cloud {
    /// Their places (m).
    pub(super) places: Vec<[f64; 2]>,
    /// Half their width and height (m).
    pub(super) half_size: f64,
}

impl Cloud {
    /// Cloud of the `inside` places of a lattice of `count` places along the axes from `corner` (m) at a `spacing` (m).
    pub(super) fn new(corner: [f64; 2], count: [usize; 2], spacing: f64, inside: impl Fn(&[f64; 2]) -> bool) -> Self {
        let at = |a: usize, k: usize| corner[a] + (k as f64 + 0.5) * spacing;
        let rows = (0..count[1]).flat_map(|j| (0..count[0]).map(move |i| (i, j)));
        let places = rows.map(|(i, j)| [at(0, i), at(1, j)]).filter(inside);
        Self { places: places.collect(), half_size: 0.5 * spacing }
    }

    pub(super) fn domains(&self) -> Domains<'_, 2> {
        Domains { centre: &self.places, half_size: HalfSizes::OfAll([self.half_size; 2]) }
    }

    /// Volume of one (m²).
    pub(super) fn volume(&self) -> f64 {
        4.0 * self.half_size * self.half_size
    }
}

/// A node's value.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Node {
    /// The unknown of this number.
    Free(usize),
    /// Zero.
    Held,
    /// No particle sees it.
    Unseen,
}

impl Node {
    fn number(self) -> Option<usize> {
        match self {
            Self::Free(number) => Some(number),
            Self::Held | Self::Unseen => None,
        }
    }
}

/// Functions on a grid at the particles of a cloud, and which of them are unknowns: those that see a particle and are
/// not held.
pub(super) struct Field {
    /// Functions at every particle.
    seen: Vec<Functions<2>>,
    /// Place (m) and value of every node.
    nodes: Vec<([f64; 2], Node)>,
    /// How many unknowns there are.
    pub(super) count: usize,
}

impl Field {
    /// Field of functions; a node whose function is not zero at one of the points `held` (m) is held.
    pub(super) fn new(functions: &dyn Interpolation<2>, cloud: &Cloud, held: &[[f64; 2]]) -> Self {
        let h = functions.grid().h;
        let mut used = vec![false; functions.len()];
        let mut seen = Vec::with_capacity(cloud.places.len());
        for x in &cloud.places {
            let mut of = Functions::new();
            functions.functions(x, &[cloud.half_size; 2], &mut of);
            for ((node, w), dw) in of.node.iter().zip(&of.w).zip(&of.dw) {
                used[*node] |= w + h * dw[0].abs().max(dw[1].abs()) > LEAST;
            }
            seen.push(of);
        }
        let mut nodes = vec![([f64::NAN; 2], Node::Unseen); functions.len()];
        let mut of = Functions::new();
        for x in held {
            functions.functions(x, &[POINT * h; 2], &mut of);
            for (node, w) in of.node.iter().zip(&of.w) {
                if *w > HELD {
                    nodes[*node].1 = Node::Held;
                }
            }
        }
        let mut count = 0;
        functions.for_each_node(&mut |node, place| {
            nodes[node].0 = place;
            if used[node] && nodes[node].1 == Node::Unseen {
                nodes[node].1 = Node::Free(count);
                count += 1;
            }
        });
        Self { seen, nodes, count }
    }

    /// The unknowns that see a particle, with values and gradients of their functions.
    fn at(&self, particle: usize) -> impl Iterator<Item = (usize, f64, [f64; 2])> {
        let of = &self.seen[particle];
        let all = of.node.iter().zip(&of.w).zip(&of.dw);
        all.filter_map(|((node, w), dw)| Some((self.nodes[*node].1.number()?, *w, *dw)))
    }

    /// Places (m) and unknowns.
    pub(super) fn places(&self) -> impl Iterator<Item = ([f64; 2], usize)> {
        self.nodes.iter().filter_map(|(x, node)| Some((*x, node.number()?)))
    }

    /// ∫ N_i N_j.
    pub(super) fn mass(&self, cloud: &Cloud) -> DMatrix<f64> {
        self.square(|(_, v, _), (_, w, _)| v * w, cloud)
    }

    /// ∫ ∇N_i · ∇N_j.
    pub(super) fn laplacian(&self, cloud: &Cloud) -> DMatrix<f64> {
        self.square(|(_, _, f), (_, _, g)| f[0] * g[0] + f[1] * g[1], cloud)
    }

    fn square(
        &self,
        of: impl Fn((usize, f64, [f64; 2]), (usize, f64, [f64; 2])) -> f64,
        cloud: &Cloud,
    ) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.count, self.count);
        for p in 0..self.seen.len() {
            for b in self.at(p) {
                for a in self.at(p) {
                    matrix[(a.0, b.0)] += cloud.volume() * of(a, b);
                }
            }
        }
        matrix
    }

    /// ∫ ∂N_i/∂x_a M_b of these functions N and others M, a matrix for each axis.
    pub(super) fn coupling(&self, other: &Self, cloud: &Cloud) -> [DMatrix<f64>; 2] {
        let mut matrices = [0, 1].map(|_| DMatrix::zeros(self.count, other.count));
        for p in 0..self.seen.len() {
            for (b, m, _) in other.at(p) {
                for (i, _, dw) in self.at(p) {
                    for (matrix, slope) in matrices.iter_mut().zip(dw) {
                        matrix[(i, b)] += cloud.volume() * slope * m;
                    }
                }
            }
        }
        matrices
    }

    /// Stiffness of an elastic solid that is not deformed, unknown by unknown and component by component.
    pub(super) fn stiffness(&self, cloud: &Cloud, moduli: Moduli) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(2 * self.count, 2 * self.count);
        for p in 0..self.seen.len() {
            let of: Vec<_> = self.at(p).collect();
            let slopes: Vec<[f64; 2]> = of.iter().map(|(_, _, dw)| *dw).collect();
            let mut own = DMatrix::zeros(2 * of.len(), 2 * of.len());
            moduli.add_stiffness(&slopes, cloud.volume(), &mut own);
            for (j, (b, ..)) in of.iter().enumerate() {
                for (i, (a, ..)) in of.iter().enumerate() {
                    for (c, d) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        matrix[(2 * a + c, 2 * b + d)] += own[(2 * i + c, 2 * j + d)];
                    }
                }
            }
        }
        matrix
    }

    /// Penalties of a field of `components` components. A facet that rounding alone makes one of the body has nodes
    /// outside every particle's functions; it is skipped.
    pub(super) fn penalty(&self, penalties: &[Penalty], components: usize) -> DMatrix<f64> {
        let size = components * self.count;
        let mut matrix = DMatrix::zeros(size, size);
        for penalty in penalties {
            let nodes: Vec<Node> = penalty.node.iter().map(|n| self.nodes[*n].1).collect();
            if nodes.contains(&Node::Unseen) {
                continue;
            }
            let components_of = |node: &Node| {
                let number = node.number();
                (0..components).map(move |c| Some(components * number? + c))
            };
            let unknowns: Vec<Option<usize>> = nodes.iter().flat_map(components_of).collect();
            for (j, b) in unknowns.iter().enumerate() {
                for (i, a) in unknowns.iter().enumerate() {
                    if let (Some(a), Some(b)) = (a, b) {
                        matrix[(*a, *b)] += penalty.stiffness[(i, j)];
                    }
                }
            }
        }
        matrix
    }

    /// ∫ N_i f.
    pub(super) fn load(&self, cloud: &Cloud, f: impl Fn(&[f64; 2]) -> f64) -> DVector<f64> {
        let mut load = DVector::zeros(self.count);
        for (p, x) in cloud.places.iter().enumerate() {
            let share = cloud.volume() * f(x);
            for (i, w, _) in self.at(p) {
                load[i] += share * w;
            }
        }
        load
    }

    /// Values at the particles.
    pub(super) fn values(&self, of: &DVector<f64>) -> Vec<f64> {
        (0..self.seen.len()).map(|p| self.at(p).map(|(i, w, _)| of[i] * w).sum()).collect()
    }
}

/// The grid of a pressure on two grids: of cells twice as large between the same ends.
pub(super) fn coarse(grid: &Grid<2>) -> Result<Grid<2>, Error> {
    Grid::new(2.0 * grid.h, grid.axes.map(|axis| mpm_core::Axis { cells: axis.cells / 2, ..axis }))
}

/// The eigenvalues of a symmetric matrix, smallest first.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Common logarithm of the condition number of a symmetric matrix: of its largest eigenvalue over the smallest, in
/// size.
pub(super) fn log10_condition(matrix: &DMatrix<f64>) -> f64 {
    let sizes = eigenvalues(matrix).into_iter().map(f64::abs);
    let (least, most) = sizes.fold((f64::INFINITY, 0.0_f64), |(l, m), v| (l.min(v), m.max(v)));
    (most / least).log10()
}

/// The same, scaled to a diagonal of ones.
pub(super) fn scaled(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let root: Vec<f64> = matrix.diagonal().iter().map(|d| d.abs().sqrt()).collect();
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / (root[i] * root[j]))
}
