//! Scene and observations of the disc, twenty times a turn.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use nalgebra::Vector2;

/// Radius (m).
pub(super) const RADIUS: f64 = 1.0;
/// Cells of room on every side.
const ROOM: f64 = 2.0;
/// Rows in a turn.
const ROWS: f64 = 20.0;

/// A disc that turns as one, at small strain: Timoshenko & Goodier, §32, with the constants of plane strain.
pub(super) struct Spin {
    setup: Setup<Disc>,
    law: NeoHookean,
    /// Angular velocity (rad/s), time step (s), steps.
    omega: f64,
    dt: f64,
    pub(super) steps: u64,
    /// u = k r ((3 − 2ν) R² − r²); k (1/m²).
    factor: f64,
}

impl Spin {
    /// Position (m) and deformation gradient of the material at `x` (m) before it turns, from the centre.
    fn state(&self, x: &[f64; 2]) -> ([f64; 2], Matrix2<f64>) {
        let x = Vector2::from(*x);
        let free = (3.0 - 2.0 * self.setup.poisson_ratio) * RADIUS * RADIUS;
        let stretch = 1.0 + self.factor * (free - x.norm_squared());
        let gradient = Matrix2::identity() * stretch - x * x.transpose() * (2.0 * self.factor);
        ((x * stretch).into(), gradient)
    }
}

impl Problem<2> for Spin {
    type Parameters = Disc;
    type Seen = Rows;

    fn new(setup: Setup<Disc>) -> Result<Self, Error> {
        let ratio = setup.poisson_ratio;
        let law = NeoHookean::new(YOUNG_MODULUS, ratio)?;
        let speed = law.wave_speed(DENSITY);
        let omega = setup.rim_speed * speed / RADIUS;
        let cfl = setup.cfl_number(2, 0.5 / setup.ppc_per_direction as f64)?;
        let dt = courant_time_step(cfl, setup.h, speed);
        let stiffness = 8.0 * YOUNG_MODULUS * (1.0 - ratio);
        Ok(Self {
            law,
            omega,
            dt,
            steps: (setup.turns * TAU / omega / dt).ceil() as u64,
            factor: DENSITY * omega * omega * (1.0 + ratio) * (1.0 - 2.0 * ratio) / stiffness,
            setup,
        })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    /// Velocities live half a step before positions.
    fn begin(&self, _: &Rows) -> Begun<2> {
        let h = self.setup.h;
        let reach = (RADIUS / h).ceil() + ROOM;
        let grid = Grid::new(h, [Axis::open(-reach * h, 2 * reach as usize); 2])?;
        let size = self.setup.pitch();
        let along = (2.0 * RADIUS / size).round() as usize;
        let places = by_columns([along; 2], size).map(|x| x.map(|x| x - RADIUS));
        let places = places.filter(|[x, y]| x.hypot(*y) <= RADIUS);
        let mut particles = self.setup.particles_at(places, size, DENSITY)?.deformed(|x| self.state(x));
        let (sin, cos) = (-0.5 * self.omega * self.dt).sin_cos();
        for (v, [x, y]) in particles.velocity.iter_mut().zip(&particles.position) {
            let earlier = [cos * x - sin * y, sin * x + cos * y];
            *v = [-self.omega * earlier[1], self.omega * earlier[0]];
        }
        self.setup.explicit(Scene::new(grid, Bodies::new(self.law, particles)?), self.dt, 0.0)
    }

    fn row(&self, seen: &mut Rows, phase: &mut Phase<2>) -> Result<Row, Fault> {
        seen.sample(phase, [self.steps, (ROWS * self.setup.turns).ceil() as u64], observe)
    }

    fn progress(&self, _: &Rows, phase: &Phase<2>) -> f64 {
        phase.share_of(self.steps)
    }

    fn particles<'a>(&self, _: &Rows, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.velocities().each("mean_stress", "Pa", |p, k| p.stress[k].mean()).jacobian()
    }

    fn metrics(&self, seen: &Rows, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let (totals, p) = (run.totals(), run.particles());
        let column = |name| seen.column(name);
        let [spun, own, angle] = ["angular_momentum", "own_angular_momentum", "angle"].map(column);
        let [momentum, kinetic, stored, radius] =
            ["momentum", "kinetic_energy", "stored_energy", "rms_radius"].map(column);
        let rows = 0..spun.len();
        let largest = |of: &dyn Fn(usize) -> f64| rows.clone().map(of).fold(f64::NEG_INFINITY, f64::max);
        let end = spun.len() - 1;
        let energy = |k: usize| kinetic[k] + stored[k];
        let gain = |k: usize| energy(k) / energy(0) - 1.0;
        let share = |k: usize| spun[k] / spun[0];
        // The rms radius of these particles at rest.
        let squares = p.mass.iter().zip(&p.reference).map(|(m, [x, y])| m * (x * x + y * y));
        let rest = (squares.sum::<f64>() / totals.mass).sqrt();
        let exact = |k: usize| (own[k] / own[0]).powi(2);
        let stretch = |k: usize| (radius[k] - rest) / (radius[0] - rest) - exact(k);
        let mean = mean((spun.len() / 2..spun.len()).map(stretch));
        // Between rows the disc turns by less than half a turn.
        let steps = angle.windows(2).map(|pair| {
            let turned = pair[1] - pair[0];
            turned - TAU * (turned / TAU).round()
        });
        let rim = totals.mass * self.omega * RADIUS;
        vec![
            (ANGULAR_MOMENTUM_ERROR, largest(&|k| (share(k) - 1.0).abs()).max(LEAST_ERROR)),
            (ANGULAR_MOMENTUM_END, share(end)),
            (MOMENTUM_ERROR, largest(&|k| momentum[k] / rim).max(LEAST_ERROR)),
            (ENERGY_GAIN, largest(&gain)),
            (ENERGY_LOSS, largest(&|k| -gain(k))),
            (ENERGY_END, gain(end)),
            (STRETCH_ERROR, largest(&|k| stretch(k).abs())),
            (STRETCH_MEAN_ERROR, mean),
            (PHASE_ERROR, steps.sum::<f64>() / (self.omega * run.time()) - 1.0),
            (STORED_SHARE, stored[0] / energy(0)),
            (MASS, totals.mass),
        ]
    }
}

fn observe(run: &mut dyn Simulation<2>) -> Row {
    let (totals, p) = (run.totals(), run.particles());
    let (mut own, mut affine, mut squares) = (0.0, 0.0, 0.0);
    let mut turned = [0.0; 2];
    for (k, mass) in p.mass.iter().enumerate() {
        let ([x, y], [u, v], [a, b]) = (p.position[k], p.velocity[k], p.reference[k]);
        own += mass * (x * v - y * u);
        if let Some(b) = p.affine.get(k) {
            affine += mass * (b[(1, 0)] - b[(0, 1)]);
        }
        squares += mass * (x * x + y * y);
        turned[0] += mass * (a * x + b * y);
        turned[1] += mass * (a * y - b * x);
    }
    let [px, py, _] = totals.momentum;
    row! {
        "time (s)": run.time(),
        "angular_momentum (kg m/s)": own + affine,
        "momentum (kg/s)": px.hypot(py),
        "kinetic_energy (J/m)": totals.kinetic_energy,
        "stored_energy (J/m)": totals.stored_energy,
        "rms_radius (m)": (squares / totals.mass).sqrt(),
        "angle (rad)": turned[1].atan2(turned[0]),
        "own_angular_momentum (kg m/s)": own,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::setup;

    fn spin(basis: BasisName, set: &str) -> Result<Spin, Error> {
        Spin::new(setup(Scheme::flip(basis, RemedyName::None), LEVELS[0], &[set]))
    }

    #[test]
    fn the_step_by_rule_is_that_of_the_steepest_functions() {
        let spun = spin(Bspline2, "time_step=auto").unwrap();
        // √(2/(D s)) with s = 6.
        let cfl = spun.dt * spun.law.wave_speed(DENSITY) / LEVELS[0].h;
        assert!((cfl - 6f64.sqrt().recip()).abs() < 1e-9);
        let refusal = spin(Linear, "time_step=auto").err().unwrap().to_string();
        assert!(refusal.contains("time_step = auto"), "{refusal}");
    }

    /// Equilibrium in a turning frame, and no traction at the rim, to second order in the strain.
    #[test]
    fn the_disc_is_in_equilibrium() {
        let disc = spin(Gimp, "rim_speed=0.01").unwrap();
        let stress = |r: f64| {
            let (_, f) = disc.state(&[r, 0.0]);
            let mut three = nalgebra::Matrix3::identity();
            three.fixed_view_mut::<2, 2>(0, 0).copy_from(&f);
            let (s, _) = disc.law.at_rest(&three);
            [s.get(0, 0), s.get(1, 1)]
        };
        let load = DENSITY * disc.omega.powi(2);
        assert!(stress(RADIUS)[0].abs() < 1e-3 * load, "{:?} {load}", stress(RADIUS));
        for r in [0.2, 0.5, 0.9] {
            let d = 1e-4;
            let [radial, hoop] = stress(r);
            let slope = (stress(r + d)[0] - stress(r - d)[0]) / (2.0 * d);
            let left = slope + (radial - hoop) / r + load * r;
            assert!(left.abs() < 1e-3 * load, "{r}: {left} {load}");
        }
    }
}
