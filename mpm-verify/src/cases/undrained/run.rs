//! The pairs of spaces of displacement and pressure, their matrices, and the motion of a body that keeps its volume.

use super::*;
use crate::cases::forms::{self, Cloud, Hats, Means, coarse, eigenvalues, singular};
use mpm_core::Lattice;
use mpm_core::basis::QuadraticBSpline;
use mpm_core::implicit::{Interpolation, OfHats};

type Splines = Lattice<2, 3, QuadraticBSpline>;

/// Smaller eigenvalues are rounding.
const ZERO: f64 = 1e-9;
/// Water that a pressure of one stores, over 1/G: it determines pressures that no motion sees.
const STORED: f64 = 1e-9;
/// Ghost penalty of the unfitted body.
const GHOST: f64 = 0.1;
/// Half axes and middle of the half ellipse's straight side (m): no grid line of a level is near its ends.
const HALF_AXES: [f64; 2] = [0.437, 0.611];
const MIDDLE: f64 = 0.513;
/// Points along the edge of a cell of the displacement at which held functions are zero.
const POINTS: usize = 4;

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Found {
    /// The least β that is not zero, and the number of zeros.
    inf_sup: f64,
    zero_modes: f64,
    /// Unknowns of displacement (both components) and pressure.
    unknowns: [f64; 2],
    /// Relative errors of displacement and pressure at the particles of the solution with k = 0, and the checkerboard's share;
    /// NaN of the ellipse, whose exact motion is not known.
    errors: [f64; 3],
}

/// The exact motion and pressure: u = curl of sin² πx sin² πy, p = cos πx cos πy, over G.
fn exact([x, y]: &[f64; 2]) -> [f64; 3] {
    let (sx, sy) = ((PI * x).sin(), (PI * y).sin());
    [PI * sx * sx * (2.0 * PI * y).sin(), -PI * (2.0 * PI * x).sin() * sy * sy, (PI * x).cos() * (PI * y).cos()]
}

/// The force per volume that balances it, −Δu + ∇p.
fn force([x, y]: &[f64; 2]) -> [f64; 2] {
    let of_shear = |x: f64, y: f64| -2.0 * PI.powi(3) * (2.0 * PI * y).sin() * (2.0 * (2.0 * PI * x).cos() - 1.0);
    [of_shear(*x, *y) - PI * (PI * x).sin() * (PI * y).cos(), -of_shear(*y, *x) - PI * (PI * x).cos() * (PI * y).sin()]
}

pub(super) struct Body {
    setup: Setup<Undrained>,
    grid: Grid<2>,
    pressure_grid: Grid<2>,
    cloud: Cloud,
    held: Vec<[f64; 2]>,
    fitted: bool,
}

impl Analysis for Body {
    type Parameters = Undrained;
    type Found = Found;

    fn new(setup: Setup<Undrained>) -> Result<Self, Error> {
        let refused = || {
            Error::Input(format!(
                "scheme = {}, domain = {}, pressure_functions = {}; allowed: two-grid or equal, in a square linear and \
                 gimp with the same pressure_functions and bspline2 with any, in an ellipse linear and gimp",
                setup.scheme,
                setup.values.text(DOMAIN),
                setup.values.text(PRESSURE_FUNCTIONS),
            ))
        };
        let fitted = setup.domain == Domain::Square;
        match (setup.basis(), setup.pressure_functions) {
            (Linear | Gimp, PressureFunctions::Same) => {}
            (Bspline2, _) if fitted => {}
            _ => return Err(refused()),
        }
        let n = (1.0 / setup.h).round() as usize;
        let grid = Grid::new(setup.h, [Axis::walls(0.0, n); 2])?;
        let pressure_grid = match setup.space() {
            Some(TwoGrid) => coarse(&grid)?,
            Some(Equal) => grid,
            _ => return Err(refused()),
        };
        // One more than fit the cells, and domains lie across grid lines in every possible way.
        let more = usize::from(setup.layout == Layout::Across);
        let count = n * setup.points_per_direction + more;
        let in_ellipse = |x: &[f64; 2]| ((x[0] - MIDDLE) / HALF_AXES[0]).powi(2) + (x[1] / HALF_AXES[1]).powi(2) < 1.0;
        let mut cloud = Cloud::new([0.0; 2], [count; 2], 1.0 / count as f64, |x| fitted || in_ellipse(x));
        cloud.places = setup.start_at(cloud.places);
        let held = (0..=n * POINTS).map(|k| k as f64 / (n * POINTS) as f64).flat_map(|s| match fitted {
            true => vec![[s, 0.0], [s, 1.0], [0.0, s], [1.0, s]],
            false => vec![[s, 0.0]],
        });
        Ok(Self { grid, pressure_grid, cloud, held: held.collect(), fitted, setup })
    }

    fn discretisation(&self) -> Discretisation {
        // Nothing moves: any step will do, and a record has one.
        self.setup.discretisation(2, self.setup.points_per_direction.pow(2), 1.0)
    }

    fn rows(&self) -> usize {
        1
    }

    fn analyse(&self, _: usize) -> Result<Found, Fault> {
        match (self.setup.basis(), self.setup.pressure_functions) {
            (Linear, _) => self.ghosted::<Hats>(),
            (Gimp, _) => self.ghosted::<Means>(),
            (_, PressureFunctions::Same) => self.plain::<Splines, Splines>(),
            (_, PressureFunctions::Linear) => self.plain::<Splines, Hats>(),
        }
    }

    fn row(&self, _: usize, found: &Found) -> Row {
        let [displacement, pressure, checkerboard] = if self.fitted { found.errors } else { [0.0; 3] };
        row! {
            "h (m)": self.setup.h,
            "inf_sup (-)": found.inf_sup,
            "zero_modes (-)": found.zero_modes,
            "displacement_error (-)": displacement,
            "pressure_error (-)": pressure,
            "checkerboard_ratio (-)": checkerboard,
        }
    }

    fn places(&self) -> Vec<[f64; 2]> {
        self.cloud.places.clone()
    }

    fn metrics(&self, found: &[Found]) -> Vec<(Metric, f64)> {
        let Some(found) = found.first() else { return Vec::new() };
        let mut all = vec![
            (INF_SUP, found.inf_sup),
            (ZERO_MODES, found.zero_modes),
            (UNKNOWNS, found.unknowns[0]),
            (PRESSURES, found.unknowns[1]),
        ];
        if self.fitted {
            all.extend([DISPLACEMENT_ERROR, PRESSURE_ERROR, CHECKERBOARD_RATIO].into_iter().zip(found.errors));
        }
        all
    }

    fn work(&self, found: &[Found]) -> WorkDone {
        let functions = match (self.setup.basis(), self.setup.pressure_functions) {
            (Linear, _) => 4 + 4,
            (_, PressureFunctions::Same) => 9 + 9,
            (_, PressureFunctions::Linear) => 9 + 4,
        };
        let particles = self.cloud.places.len() as u64;
        visited(found.len(), [particles, particles * functions])
    }
}

impl Body {
    fn fields<I: Interpolation<2>, J: Interpolation<2>>(&self, u: &I) -> Result<[forms::Field; 2], Fault> {
        let p = J::on(self.pressure_grid)?;
        Ok([forms::Field::new(u, &self.cloud, &self.held), forms::Field::new(&p, &self.cloud, &[])])
    }

    /// With the ghost penalty of the displacement, of a body that fits no grid.
    fn ghosted<I: OfHats<2>>(&self) -> Result<Found, Fault> {
        if self.fitted {
            return self.plain::<I, I>();
        }
        let functions = I::on(self.grid)?;
        let fields = self.fields::<I, I>(&functions)?;
        let ghost = functions.ghost(GHOST, &[], 1, self.cloud.domains());
        let norm = fields[0].laplacian(&self.cloud) + fields[0].penalty(&ghost, 1);
        self.found(&fields, norm)
    }

    fn plain<I: Interpolation<2>, J: Interpolation<2>>(&self) -> Result<Found, Fault> {
        let fields = self.fields::<I, J>(&I::on(self.grid)?)?;
        let norm = fields[0].laplacian(&self.cloud);
        self.found(&fields, norm)
    }

    fn found(&self, [u, p]: &[forms::Field; 2], norm: DMatrix<f64>) -> Result<Found, Fault> {
        let cloud = &self.cloud;
        let norm = norm.cholesky().ok_or_else(singular)?;
        let coupling = u.coupling(p, cloud);
        // Bᵀ A⁻¹ B of both components, whose norms are apart.
        let mut schur = DMatrix::zeros(p.count, p.count);
        for of_axis in &coupling {
            let mut half = of_axis.clone();
            norm.l_dirty().solve_lower_triangular_mut(&mut half);
            schur += half.tr_mul(&half);
        }
        let mass = p.mass(cloud);
        let root = mass.clone().cholesky().ok_or_else(singular)?;
        let mut own = schur.clone();
        root.l_dirty().solve_lower_triangular_mut(&mut own);
        own.transpose_mut();
        root.l_dirty().solve_lower_triangular_mut(&mut own);
        let squares = eigenvalues(&own);
        let zero_modes = squares.iter().filter(|b| **b < ZERO).count();
        let inf_sup = squares.get(zero_modes).map_or(f64::NAN, |b| b.sqrt());
        let errors = if self.fitted {
            let solved = solution(cloud, [u, p], &norm, &coupling, &(schur + mass * STORED));
            let (motion, pressure) = solved.ok_or_else(singular)?;
            self.errors([u, p], &motion, &pressure)
        } else {
            [f64::NAN; 3]
        };
        Ok(Found { inf_sup, zero_modes: zero_modes as f64, unknowns: [2.0 * u.count as f64, p.count as f64], errors })
    }

    fn errors(&self, [u, p]: [&forms::Field; 2], motion: &[DVector<f64>; 2], pressure: &DVector<f64>) -> [f64; 3] {
        let places = &self.cloud.places;
        let exact: Vec<[f64; 3]> = places.iter().map(exact).collect();
        let of_motion = |a: usize| {
            let values = u.values(&motion[a]);
            let exact = &exact;
            (0..places.len()).map(move |k| (values[k] - exact[k][a], exact[k][a]))
        };
        let both: Vec<(f64, f64)> = of_motion(0).chain(of_motion(1)).collect();
        // A constant pressure moves nothing where all of the edge is held.
        let values = p.values(pressure);
        let mean = mean(values.iter().copied());
        let of_pressure: Vec<(f64, f64)> = values.iter().zip(&exact).map(|(v, e)| (v - mean - e[2], e[2])).collect();
        let relative = |pairs: &[(f64, f64)]| rms(pairs.iter().map(|p| p.0)) / rms(pairs.iter().map(|p| p.1));
        let scale = rms(exact.iter().map(|e| e[2]));
        [relative(&both), relative(&of_pressure), self.checkerboard(p, pressure) / scale]
    }

    /// Rms over the cells of the pressure of (p₀₀ − p₁₀ − p₀₁ + p₁₁)/4: a checkerboard's amplitude.
    fn checkerboard(&self, p: &forms::Field, pressure: &DVector<f64>) -> f64 {
        let h = self.pressure_grid.h;
        let n = (1.0 / h).round() as usize;
        let mut grid = DMatrix::from_element(n + 1, n + 1, f64::NAN);
        for (x, i) in p.places() {
            let [a, b] = x.map(|x| (x / h).round() as usize);
            grid[(a, b)] = pressure[i];
        }
        let cell = |k: usize| {
            let (a, b) = (k / n, k % n);
            let (same, other) = (grid[(a, b)] + grid[(a + 1, b + 1)], grid[(a + 1, b)] + grid[(a, b + 1)]);
            0.25 * (same - other)
        };
        rms((0..n * n).map(cell))
    }
}

/// Motion and pressure where no water flows and hardly any is stored.
fn solution(
    cloud: &Cloud,
    [u, _]: [&forms::Field; 2],
    norm: &nalgebra::Cholesky<f64, nalgebra::Dyn>,
    coupling: &[DMatrix<f64>; 2],
    schur: &DMatrix<f64>,
) -> Option<([DVector<f64>; 2], DVector<f64>)> {
    let loads = [0, 1].map(|a| u.load(cloud, |x| force(x)[a]));
    let free = [0, 1].map(|a| norm.solve(&loads[a]));
    // A u − B p = f and Bᵀ u = 0.
    let right = -(coupling[0].tr_mul(&free[0]) + coupling[1].tr_mul(&free[1]));
    let pressure = schur.clone().cholesky()?.solve(&right);
    let motion = [0, 1].map(|a| norm.solve(&(&loads[a] + &coupling[a] * &pressure)));
    Some((motion, pressure))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// −Δu + ∇p by differences.
    #[test]
    fn the_force_balances_the_exact_motion() {
        let d = 1e-4;
        for x in [[0.2, 0.3], [0.71, 0.44], [0.5, 0.9]] {
            let at = |dx: f64, dy: f64, k: usize| exact(&[x[0] + dx, x[1] + dy])[k];
            let divergence = (at(d, 0.0, 0) - at(-d, 0.0, 0) + at(0.0, d, 1) - at(0.0, -d, 1)) / (2.0 * d);
            assert!(divergence.abs() < 1e-5);
            for a in 0..2 {
                let sum = at(d, 0.0, a) + at(-d, 0.0, a) + at(0.0, d, a) + at(0.0, -d, a);
                let laplacian = (sum - 4.0 * at(0.0, 0.0, a)) / (d * d);
                let [dx, dy] = [[d, 0.0], [0.0, d]][a];
                let slope = (at(dx, dy, 2) - at(-dx, -dy, 2)) / (2.0 * d);
                assert!((slope - laplacian - force(&x)[a]).abs() < 1e-4);
            }
        }
    }
}
