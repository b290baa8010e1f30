//! Matrices of the half ellipse at its places, and of the cantilever.

use super::*;
use crate::cases::forms::{Cloud, Field, Hats, Means, coarse, eigenvalues, log10_condition, scaled, singular};
use mpm_core::implicit::{Moduli, OfHats};

/// Particles a cell of the displacement and direction.
const PARTICLES: usize = 3;
/// Half axes of the ellipse, in cells.
pub(super) const HALF_AXES: [f64; 2] = [10.0, 6.0];
/// Cells of the grid, and those of them left of the ellipse's middle at its first place.
const CELLS: [usize; 2] = [28, 8];
const BEFORE: f64 = 12.0;
/// Cells of the cantilever, and of its grid.
const BEAM: [usize; 2] = [24, 8];
const BEAM_GRID: [usize; 2] = [26, 12];
const BEAM_FLOOR: f64 = 2.0;
/// Points along a cell at which held functions are zero.
const POINTS: usize = 4;
/// Moduli over G, of ν = ¼.
const MODULI: Moduli = Moduli { lambda: 1.0, mu: 1.0 };
/// The whole matrix is analysed in one of this number of places.
const OF_WHOLE: usize = 4;

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    /// log10 of the condition numbers of the matrices of displacement and pressure.
    own: [f64; 2],
    /// Their least eigenvalues.
    softest: [f64; 2],
    /// log10 of the condition numbers of the whole matrix, and of that scaled to a diagonal of ones, where it was analysed.
    whole: Option<[f64; 2]>,
}

/// Least, mean and greatest; NaN stays NaN.
fn spread(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let (mut least, mut sum, mut most, mut count) = (f64::INFINITY, 0.0, f64::NEG_INFINITY, 0.0);
    for value in values {
        (least, most) = (if value < least { value } else { least }, if value > most { value } else { most });
        (sum, count) = (sum + value, count + 1.0);
    }
    [least, sum / count, most]
}

impl Analysis for Setup<Ellipse> {
    type Parameters = Ellipse;
    type Found = Found;

    fn new(setup: Self) -> Result<Self, Error> {
        let basis = matches!(setup.basis(), Linear | Gimp);
        let space = matches!(setup.space(), Some(TwoGrid | Equal));
        if basis && space {
            return Ok(setup);
        }
        Err(Error::Input(format!("scheme = {}; allowed: poro with linear or gimp and two-grid or equal", setup.scheme)))
    }

    fn discretisation(&self) -> Discretisation {
        // Nothing moves: any step will do, and a record has one.
        self.discretisation(2, PARTICLES * PARTICLES, 1.0)
    }

    fn rows(&self) -> usize {
        self.positions
    }

    fn analyse(&self, k: usize) -> Result<Found, Fault> {
        match self.basis() {
            Gimp => self.with::<Means>(k),
            _ => self.with::<Hats>(k),
        }
    }

    fn row(&self, k: usize, found: &Found) -> Row {
        row! {
            "shift (h)": self.shift(k),
            "log10_cond_uu (-)": found.own[0],
            "log10_cond_pp (-)": found.own[1],
        }
    }

    fn places(&self) -> Vec<[f64; 2]> {
        self.cloud(0).places
    }

    fn metrics(&self, found: &[Found]) -> Vec<(Metric, f64)> {
        let of = |k: usize| spread(found.iter().map(|r| r.own[k]));
        let softest = |k: usize| spread(found.iter().map(|r| r.softest[k]))[0];
        let whole = |k: usize| spread(found.iter().filter_map(|r| Some(r.whole?[k])))[2];
        let apart = spread(found.iter().zip(found.iter().rev()).map(|(a, b)| (a.own[0] - b.own[0]).abs()));
        let ([u_least, u_mean, u], [p_least, p_mean, p]) = (of(0), of(1));
        let deflection = match self.basis() {
            Gimp => self.deflection_change::<Means>(),
            _ => self.deflection_change::<Hats>(),
        };
        vec![
            (COND_UU, u),
            (COND_UU_MEAN, u_mean),
            (COND_UU_LEAST, u_least),
            (COND_PP, p),
            (COND_PP_MEAN, p_mean),
            (COND_PP_LEAST, p_least),
            (COND, whole(0)),
            (COND_SCALED, whole(1)),
            (SOFTEST_UU, softest(0)),
            (SOFTEST_PP, softest(1)),
            (MIRROR_ERROR, apart[2]),
            (DEFLECTION_CHANGE, deflection.unwrap_or(f64::NAN)),
        ]
    }

    fn work(&self, found: &[Found]) -> WorkDone {
        let functions = if self.basis() == Gimp { 9 + 9 } else { 4 + 4 };
        let particles = self.cloud(0).places.len() as u64;
        visited(found.len(), [particles, particles * functions])
    }
}

impl Setup<Ellipse> {
    /// Displacement of the body at its `k`-th place, in cells of the displacement: no particle is then on a grid line.
    fn shift(&self, k: usize) -> f64 {
        2.0 * (k as f64 + 0.5) / self.positions as f64
    }

    fn cloud(&self, k: usize) -> Cloud {
        let h = self.h;
        let half = HALF_AXES;
        let cells = half.map(|a| a.ceil() as usize);
        let inside = |x: &[f64; 2]| (x[0] / h / half[0]).powi(2) + (x[1] / h / half[1]).powi(2) < 1.0;
        let corner = [-(cells[0] as f64) * h, 0.0];
        let count = [2 * cells[0] * PARTICLES, cells[1] * PARTICLES];
        let mut cloud = Cloud::new(corner, count, h / PARTICLES as f64, inside);
        let middle = (BEFORE + self.shift(k)) * h;
        for x in &mut cloud.places {
            x[0] += middle;
        }
        cloud.places = self.start_at(cloud.places);
        cloud
    }

    fn with<I: OfHats<2>>(&self, k: usize) -> Result<Found, Fault> {
        let h = self.h;
        let grid = Grid::new(h, [Axis::open(0.0, CELLS[0]), Axis::walls(0.0, CELLS[1])])?;
        let of_pressure = if self.space() == Some(Equal) { grid } else { coarse(&grid)? };
        let (of_u, of_p) = (I::on(grid)?, I::on(of_pressure)?);
        let cloud = self.cloud(k);
        let points = CELLS[0] * POINTS;
        let held: Vec<[f64; 2]> = (0..=points).map(|i| [i as f64 / POINTS as f64 * h, 0.0]).collect();
        let u = Field::new(&of_u, &cloud, &held);
        let p = Field::new(&of_p, &cloud, &held);
        let domains = || cloud.domains();
        let mut solid = u.stiffness(&cloud, MODULI);
        let mut water = p.laplacian(&cloud);
        let of_water = p.penalty(&of_p.ghost(1.0, &[], 1, domains()), 1);
        solid += u.penalty(&of_u.ghost(self.alpha, &[], 2, domains()), 2);
        let flow = water.clone();
        water += &of_water * self.alpha;
        let whole = k.is_multiple_of(OF_WHOLE).then(|| {
            let cell = of_pressure.h * of_pressure.h;
            let mobility = self.mobility * cell;
            let over = mobility + if self.pressure_ghost == PressureGhost::Storage { cell } else { 0.0 };
            let of_pressure = flow * mobility + of_water * (self.alpha * over);
            let whole = saddle(&solid, &of_pressure, &u.coupling(&p, &cloud));
            [log10_condition(&whole), log10_condition(&scaled(&whole))]
        });
        let both = [&solid, &water].map(eigenvalues);
        let ends = |of: &Vec<f64>| Some((*of.first()?, *of.last()?));
        let [of_solid, of_water] = both.each_ref().map(|of| ends(of).unwrap_or((f64::NAN, f64::NAN)));
        Ok(Found {
            own: [of_solid, of_water].map(|(least, most)| (most / least).abs().log10()),
            softest: [of_solid.0, of_water.0],
            whole,
        })
    }

    /// Change by α of the mean deflection of the cantilever with the functions `I`.
    fn deflection_change<I: OfHats<2>>(&self) -> Result<f64, Fault> {
        let h = self.h;
        let functions = I::on(Grid::new(h, [Axis::walls(0.0, BEAM_GRID[0]), Axis::open(0.0, BEAM_GRID[1])])?)?;
        let count = BEAM.map(|cells| cells * PARTICLES);
        let cloud = Cloud::new([0.0, BEAM_FLOOR * h], count, h / PARTICLES as f64, |_| true);
        let points = BEAM_GRID[1] * POINTS;
        let held: Vec<[f64; 2]> = (0..=points).map(|i| [0.0, i as f64 / POINTS as f64 * h]).collect();
        let u = Field::new(&functions, &cloud, &held);
        let weight = u.load(&cloud, |_| 1.0);
        let mut force = nalgebra::DVector::zeros(2 * u.count);
        for i in 0..u.count {
            force[2 * i + 1] = -weight[i];
        }
        let stiffness = u.stiffness(&cloud, MODULI);
        let ghost = u.penalty(&functions.ghost(self.alpha, &[], 2, cloud.domains()), 2);
        let work = |matrix: DMatrix<f64>| {
            let factors = matrix.cholesky().ok_or_else(singular)?;
            Ok::<f64, Fault>(factors.solve(&force).dot(&force))
        };
        let plain = work(stiffness.clone())?;
        Ok(work(stiffness + ghost)? / plain - 1.0)
    }
}

/// [A, −B; −Bᵀ, −C], of couplings of each axis.
fn saddle(solid: &DMatrix<f64>, water: &DMatrix<f64>, coupling: &[DMatrix<f64>; 2]) -> DMatrix<f64> {
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
