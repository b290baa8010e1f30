//! Matrices of the half ellipse at a place, and of the cantilever.

use super::parameters::{GHOST, MOBILITY, POSITIONS, PRESSURE_GHOST};
use crate::cases::forms::{Cloud, Field, coarse, eigenvalues, log10_condition, scaled};
use crate::error::Error;
use crate::parameter::Parameters;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::basis::{Gimp, Linear};
use mpm_core::implicit::{Moduli, OfHats};
use mpm_core::{Axis, Grid, Lattice};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Particles a cell of the displacement and direction.
pub(super) const PARTICLES: usize = 3;
/// Half axes of the ellipse, in cells.
pub(super) const HALF_AXES: [f64; 2] = [10.0, 6.0];
/// Cells of the grid, and of them those left of the ellipse's middle at its first place.
const CELLS: [usize; 2] = [28, 8];
const BEFORE: f64 = 12.0;
/// Cells of the cantilever, and of its grid.
const BEAM: [usize; 2] = [24, 8];
const BEAM_GRID: [usize; 2] = [26, 12];
const BEAM_FLOOR: f64 = 2.0;
/// Points along a cell at which what is held is zero.
const POINTS: usize = 4;
/// Moduli over G, of ν = ¼.
const MODULI: Moduli = Moduli {
    lambda: 1.0,
    mu: 1.0,
};
/// The whole matrix is looked at in every place of so many.
const OF_WHOLE: usize = 4;

/// What was found at a place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    /// log10 of the condition numbers of the matrices of displacement and pressure.
    pub(super) own: [f64; 2],
    /// Their least eigenvalues.
    pub(super) softest: [f64; 2],
    /// Of the whole matrix, and of that scaled to a diagonal of ones, where it was looked at.
    pub(super) whole: Option<[f64; 2]>,
}

/// A run.
pub(super) struct Setting {
    means: bool,
    equal: bool,
    h: f64,
    alpha: f64,
    positions: usize,
    mobility: f64,
    storage: bool,
    spec: RunSpec,
}

impl Setting {
    /// That of a run.
    ///
    /// # Errors
    /// A scheme that is not one of two grids or equal order with linear functions or GIMP.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let refused = || {
            Error::Input(format!(
                "scheme = {}; allowed: poro with linear or gimp and two-grid or equal",
                spec.scheme
            ))
        };
        let Scheme::Poro(parts) = spec.scheme else {
            return Err(refused());
        };
        let means = match parts.basis {
            BasisName::Linear => false,
            BasisName::Gimp => true,
            _ => return Err(refused()),
        };
        let equal = match parts.space {
            SpaceName::TwoGrid => false,
            SpaceName::Equal => true,
            SpaceName::Ppp => return Err(refused()),
        };
        Ok(Self {
            means,
            equal,
            h: spec.level.h,
            alpha: parameters.number(GHOST),
            positions: parameters.number(POSITIONS) as usize,
            mobility: parameters.number(MOBILITY),
            storage: parameters.is(PRESSURE_GHOST, "storage"),
            spec: spec.clone(),
        })
    }

    /// Places of the body.
    pub(super) fn positions(&self) -> usize {
        self.positions
    }

    /// How far the body is moved at its `k`-th place, in cells of the displacement: no particle is then on a grid line.
    pub(super) fn shift(&self, k: usize) -> f64 {
        2.0 * (k as f64 + 0.5) / self.positions as f64
    }

    /// The particles at the `k`-th place.
    pub(super) fn cloud(&self, k: usize) -> Cloud {
        let h = self.h;
        let half = HALF_AXES;
        let cells = half.map(|a| a.ceil() as usize);
        let inside =
            |x: &[f64; 2]| (x[0] / h / half[0]).powi(2) + (x[1] / h / half[1]).powi(2) < 1.0;
        let corner = [-(cells[0] as f64) * h, 0.0];
        let count = [2 * cells[0] * PARTICLES, cells[1] * PARTICLES];
        let mut cloud = Cloud::new(corner, count, h / PARTICLES as f64, inside);
        let middle = (BEFORE + self.shift(k)) * h;
        for x in &mut cloud.places {
            x[0] += middle;
        }
        cloud.places = self.spec.start_at(cloud.places);
        cloud
    }

    /// Pairs of particles and functions at a place.
    pub(super) fn pairs(&self) -> u64 {
        let functions = if self.means { 9 + 9 } else { 4 + 4 };
        self.cloud(0).places.len() as u64 * functions
    }

    /// What is found at the `k`-th place.
    ///
    /// # Errors
    /// A grid that functions don't live on.
    pub(super) fn find(&self, k: usize) -> Result<Found, mpm_core::Error> {
        match self.means {
            true => self.with::<Lattice<2, 3, Gimp>>(k),
            false => self.with::<Lattice<2, 2, Linear>>(k),
        }
    }

    /// By how much α changes the mean deflection of the cantilever.
    ///
    /// # Errors
    /// Its stiffness is not positive definite.
    pub(super) fn deflection_change(&self) -> Result<f64, mpm_core::Error> {
        match self.means {
            true => self.beam::<Lattice<2, 3, Gimp>>(),
            false => self.beam::<Lattice<2, 2, Linear>>(),
        }
    }

    fn with<I: OfHats<2>>(&self, k: usize) -> Result<Found, mpm_core::Error> {
        let h = self.h;
        let axes = [Axis::open(0.0, CELLS[0]), Axis::walls(0.0, CELLS[1])];
        let grid = Grid::new(h, axes)?;
        let of_pressure = if self.equal { grid } else { coarse(&grid)? };
        let (of_u, of_p) = (I::on(grid)?, I::on(of_pressure)?);
        let cloud = self.cloud(k);
        let points = CELLS[0] * POINTS;
        let held: Vec<[f64; 2]> = (0..=points)
            .map(|i| [i as f64 / POINTS as f64 * h, 0.0])
            .collect();
        let u = Field::new(&of_u, &cloud, &held);
        let p = Field::new(&of_p, &cloud, &held);
        let domains = || cloud.domains();
        let mut solid = u.stiffness(&cloud, MODULI);
        let mut water = p.laplacian(&cloud);
        let of_water = p.penalty(&of_p.ghost(1.0, 1, domains()), 1);
        solid += u.penalty(&of_u.ghost(self.alpha, 2, domains()), 2);
        let flow = water.clone();
        water += &of_water * self.alpha;
        let whole = k.is_multiple_of(OF_WHOLE).then(|| {
            let cell = of_pressure.h * of_pressure.h;
            let mobility = self.mobility * cell;
            let over = mobility + if self.storage { cell } else { 0.0 };
            let of_pressure = flow * mobility + of_water * (self.alpha * over);
            let whole = saddle(&solid, &of_pressure, &u.coupling(&p, &cloud));
            [log10_condition(&whole), log10_condition(&scaled(&whole))]
        });
        let both = [&solid, &water].map(eigenvalues);
        let ends = |of: &Vec<f64>| Some((*of.first()?, *of.last()?));
        let [of_solid, of_water] = both
            .each_ref()
            .map(|of| ends(of).unwrap_or((f64::NAN, f64::NAN)));
        Ok(Found {
            own: [of_solid, of_water].map(|(least, most)| (most / least).abs().log10()),
            softest: [of_solid.0, of_water.0],
            whole,
        })
    }

    fn beam<I: OfHats<2>>(&self) -> Result<f64, mpm_core::Error> {
        let h = self.h;
        let axes = [
            Axis::walls(0.0, BEAM_GRID[0]),
            Axis::open(0.0, BEAM_GRID[1]),
        ];
        let functions = I::on(Grid::new(h, axes)?)?;
        let count = BEAM.map(|cells| cells * PARTICLES);
        let spacing = h / PARTICLES as f64;
        let cloud = Cloud::new([0.0, BEAM_FLOOR * h], count, spacing, |_| true);
        let points = BEAM_GRID[1] * POINTS;
        let held: Vec<[f64; 2]> = (0..=points)
            .map(|i| [0.0, i as f64 / POINTS as f64 * h])
            .collect();
        let u = Field::new(&functions, &cloud, &held);
        let weight = u.load(&cloud, |_| 1.0);
        let mut force = nalgebra::DVector::zeros(2 * u.count);
        for i in 0..u.count {
            force[2 * i + 1] = -weight[i];
        }
        let stiffness = u.stiffness(&cloud, MODULI);
        let ghost = u.penalty(&functions.ghost(self.alpha, 2, cloud.domains()), 2);
        let work = |matrix: DMatrix<f64>| {
            let factors = matrix.cholesky().ok_or(mpm_core::Error::Singular {
                time: 0.0,
                step: 0,
                iteration: 0,
            })?;
            Ok::<f64, mpm_core::Error>(factors.solve(&force).dot(&force))
        };
        let plain = work(stiffness.clone())?;
        Ok(work(stiffness + ghost)? / plain - 1.0)
    }
}

/// [A, −B; −Bᵀ, −C], of couplings of each axis.
fn saddle(
    solid: &DMatrix<f64>,
    water: &DMatrix<f64>,
    coupling: &[DMatrix<f64>; 2],
) -> DMatrix<f64> {
    let (n, m) = (solid.nrows(), water.nrows());
    let mut whole = DMatrix::zeros(n + m, n + m);
    whole.view_mut((0, 0), (n, n)).copy_from(solid);
    whole.view_mut((n, n), (m, m)).copy_from(&-water);
    for (axis, of_axis) in coupling.iter().enumerate() {
        for i in 0..of_axis.nrows() {
            for b in 0..m {
                whole[(2 * i + axis, n + b)] = -of_axis[(i, b)];
                whole[(n + b, 2 * i + axis)] = -of_axis[(i, b)];
            }
        }
    }
    whole
}
