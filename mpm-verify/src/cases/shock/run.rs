//! Scene and observations of the bar.

use super::*;
use crate::cases::build::{DENSITY, YOUNG_MODULUS};
use crate::exact::shock::Jump;

/// Length (m) of the bar.
const LENGTH: f64 = 1.0;
/// Share of the bar that the front crosses, and shares of its way between which the state is taken.
pub(super) const WAY: f64 = 0.7;
pub(super) const BEHIND: [f64; 2] = [0.1, 0.8];
/// Shares of the jump that bound the width of a front.
const FRONT: [f64; 2] = [0.05, 0.95];
const ROWS: u64 = 100;
/// Cells beyond the bar.
const ROOM: usize = 2;

impl Setup<Shock> {
    fn viscosity(&self) -> [f64; 2] {
        [self.linear_viscosity, self.quadratic_viscosity]
    }

    pub(super) fn is_viscous(&self) -> bool {
        self.viscosity() != [0.0; 2]
    }

    /// Whether the linear viscosity lets a wave of four cells fall to e⁻² while the front goes five: ½ c₁ h c k² for 5 h/c.
    pub(super) fn takes_ringing(&self) -> bool {
        let k = 0.5 * std::f64::consts::PI;
        2.5 * self.linear_viscosity * k * k >= 2.0
    }

    /// Reach of a function (m).
    pub(super) fn support(&self) -> f64 {
        (self.basis().degree() as f64 + 1.0) * self.h
    }
}

pub(super) struct Bar {
    setup: Setup<Shock>,
    law: NeoHookean,
    /// Speed of the bar (m/s), time step (s), steps.
    speed: f64,
    dt: f64,
    steps: u64,
    jump: Jump,
}

impl Bar {
    /// Position in the undeformed bar (m) of a share of the jump: from the free end, where the straight line through the mean
    /// stretches of two cells first reaches it.
    fn front(&self, run: &dyn Simulation<1>, share: f64) -> f64 {
        let (h, p) = (self.setup.h, run.particles());
        let cells = (LENGTH / h).round() as usize;
        let mut sums = vec![[0.0; 2]; cells];
        for ([x], j) in p.reference.iter().zip(&p.jacobian) {
            if let Some(sum) = sums.get_mut((x / h) as usize) {
                *sum = [sum[0] + j, sum[1] + 1.0];
            }
        }
        let sought = 1.0 - share * (1.0 - self.jump.stretch);
        let mean = |k: usize| sums[k][0] / sums[k][1];
        (0..cells).rev().find(|k| mean(*k) < sought).map_or(0.0, |k| {
            let beyond = if k + 1 < cells { mean(k + 1) } else { 1.0 };
            (k as f64 + 0.5 + (sought - mean(k)) / (beyond - mean(k))) * h
        })
    }

    /// Stress (Pa) and velocity (m/s) of the particles behind the front, at the end.
    fn behind(&self, run: &mut dyn Simulation<1>) -> Vec<[f64; 2]> {
        let stress = run.force_stress();
        let p = run.particles();
        let front = self.jump.speed * run.time();
        let [from, to] = BEHIND.map(|share| share * front);
        let all = (0..p.len()).filter(|k| (from..to).contains(&p.reference[*k][0]));
        all.map(|k| [stress[k].get(0, 0), p.velocity[k][0]]).collect()
    }
}

impl Problem<1> for Bar {
    type Parameters = Shock;
    type Seen = Rows;

    fn new(setup: Setup<Shock>) -> Result<Self, Error> {
        let law = NeoHookean::new(YOUNG_MODULUS, setup.poisson_ratio)?;
        let waves = law.wave_speed(DENSITY);
        let speed = setup.mach * waves;
        let jump = Jump::new(&law, DENSITY, speed);
        // The jump in one cell is the fastest compression; damping shortens the step of the steepest wave by this much.
        let damping = setup.linear_viscosity + 2.0 * setup.quadratic_viscosity * setup.mach;
        let shorter = damping.hypot(1.0) + damping;
        let dt = courant_time_step(setup.cfl / shorter, setup.h, waves);
        // The slope at the first particle of the function at the wall, (1 − x/h)ᵏ.
        let (degree, first) = (setup.basis().degree() as i32, 0.5 / setup.ppc_per_direction as f64);
        let pressed = speed * dt / setup.h * f64::from(degree) * (1.0 - first).powi(degree - 1);
        let why = "the strain of the first step at the wall, which would turn a particle inside out";
        require_quotient("cfl times mach and the slope of the function at the wall", pressed, 0.0..=0.95, why)?;
        Ok(Self { setup, law, speed, dt, steps: (WAY * LENGTH / jump.speed / dt).ceil() as u64, jump })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(1, self.dt)
    }

    fn begin(&self, _: &Rows) -> Begun<1> {
        let law: SharedLaw = match self.setup.is_viscous() {
            true => Viscous::new(self.law, DENSITY, self.setup.h, self.setup.viscosity())?.into(),
            false => self.law.into(),
        };
        let h = self.setup.h;
        let size = self.setup.pitch();
        let cells = (LENGTH / h).round() as usize;
        let axis = Axis::bounded(0.0, cells + ROOM, (Side::Wall, Side::Open));
        let count = (LENGTH / size).round() as usize;
        let mut particles = self.setup.particles_at(by_rows([count], size), size, DENSITY)?;
        particles.velocity.fill([-self.speed]);
        let scene = Scene::new(Grid::new(h, [axis])?, Bodies::new(law, particles)?).constrain(roller(0, End::Lo));
        self.setup.explicit(scene, self.dt, 0.0)
    }

    fn row(&self, seen: &mut Rows, phase: &mut Phase<1>) -> Result<Row, Fault> {
        seen.sample(phase, [self.steps, ROWS.min(self.steps)], |run| {
            let totals = run.totals();
            row! {
                "time (s)": run.time(),
                "front (m)": self.front(run, 0.5),
                "wall_impulse (N s/m²)": run.on(Part::Constraint(0)).impulse[0],
                "kinetic_energy (J/m²)": totals.kinetic_energy,
                "stored_energy (J/m²)": totals.stored_energy,
            }
        })
    }

    fn progress(&self, _: &Rows, phase: &Phase<1>) -> f64 {
        phase.share_of(self.steps)
    }

    fn particles<'a>(&self, _: &Rows, columns: Columns<'a, 1>) -> Columns<'a, 1> {
        columns.velocities().stress("stress_xx", [0, 0]).jacobian()
    }

    fn metrics(&self, seen: &Rows, phase: &mut Phase<1>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_mut();
        let behind = self.behind(run);
        let mean = |k: usize| behind.iter().map(|s| s[k]).sum::<f64>() / behind.len() as f64;
        let (stress, exact) = (mean(0), self.jump.stress);
        // Rate of change over the last half of the run.
        let rate = |points: &[(f64, f64)]| fit_line(&points[points.len() / 2..]).map_or(f64::NAN, |line| line.slope);
        let [kinetic, stored] = ["kinetic_energy", "stored_energy"].map(|name| seen.column(name));
        let energy: Vec<f64> = kinetic.iter().zip(stored).map(|(k, s)| k + s).collect();
        let start = energy[0];
        let rise = |energy: &f64| energy / start - 1.0;
        let lost = -energy.last().map_or(f64::NAN, rise);
        let taken = self.jump.lost * self.jump.speed * run.time() / start;
        let front_speed = rate(&seen.points(["time", "front"]));
        let wall_force = rate(&seen.points(["time", "wall_impulse"]));
        let largest = behind.iter().map(|s| s[0] / exact).fold(0.0, f64::max);
        let mut found = vec![
            (SHOCK_SPEED_ERROR, front_speed / self.jump.speed - 1.0),
            (STRESS_ERROR, stress / exact - 1.0),
            (VELOCITY_ERROR, mean(1) / self.speed),
            (WALL_FORCE_ERROR, (wall_force / exact).abs() - 1.0),
            (OVERSHOOT, largest - 1.0),
            (RINGING, rms(behind.iter().map(|s| (s[0] - stress) / exact))),
            (ENERGY_LOSS, lost.max(0.0)),
            (ENERGY_GAIN, energy.iter().map(rise).fold(0.0, f64::max)),
            (ENERGY_LOSS_ERROR, lost / taken - 1.0),
            (JUMP_BOUND, self.jump.bound),
            (MASS, run.totals().mass),
        ];
        if self.setup.is_viscous() {
            let [ahead, behind] = FRONT.map(|share| self.front(run, share));
            let whole: Vec<(f64, f64)> = seen.column("time").into_iter().zip(energy).collect();
            let exact = self.jump.lost * self.jump.speed;
            let predicted = self.jump.width(self.setup.viscosity(), self.setup.h, FRONT);
            found.push((LOSS_RATE_ERROR, -rate(&whole) / exact - 1.0));
            found.push((FRONT_WIDTH, ahead - behind));
            found.push((PREDICTED_WIDTH, predicted));
        }
        found
    }
}
