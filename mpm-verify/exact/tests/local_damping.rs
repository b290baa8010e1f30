//! Local damping in an implicit step, for a mass on a spring: why the implicit solver has none.

/// A unit mass at a unit spring, pulled by a unit force at once, with damping −α |F| sign(v) of the out-of-balance
/// force F, by Newmark's rule (α = ¼, δ = ½) with steps of `dt` (ω Δt).
struct Swing {
    damping: f64,
    dt: f64,
    /// Place, velocity and acceleration.
    now: [f64; 3],
    /// Steps whose equations nothing solves.
    unsolved: u32,
}

impl Swing {
    fn new(damping: f64, dt: f64) -> Self {
        let (now, unsolved) = ([0.0, 0.0, 1.0], 0);
        Self { damping, dt, now, unsolved }
    }

    /// F at the end of an increment.
    fn force(&self, x: f64) -> f64 {
        1.0 - self.now[0] - x
    }

    /// Takes an increment.
    fn take(&mut self, x: f64) {
        let [u, v, a] = self.now;
        let next = 4.0 * x / self.dt.powi(2) - 4.0 * v / self.dt - a;
        self.now = [u + x, v + 0.5 * self.dt * (a + next), next];
    }

    /// With damping by the force and velocity at the end of the step: on each of the four pairs of their signs the
    /// equations are linear, and a solution with other signs is invalid. In a step without solution the mass stops.
    fn inside(&mut self) {
        let [_, v, a] = self.now;
        let (stiffness, push) = (4.0 / self.dt.powi(2), 4.0 * v / self.dt + a);
        let solution =
            [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].into_iter().find_map(|(forward, pulled)| {
                let share = 1.0 - self.damping * forward * pulled;
                let x = (share * self.force(0.0) + push) / (stiffness + share);
                let velocity = 2.0 * x / self.dt - v;
                (velocity * forward > 0.0 && self.force(x) * pulled >= 0.0).then_some(x)
            });
        self.unsolved += u32::from(solution.is_none());
        self.take(solution.unwrap_or(0.5 * v * self.dt));
    }

    /// With damping by the force and velocity at the start of the step.
    fn lagged(&mut self) {
        let [_, v, a] = self.now;
        let direction = if v == 0.0 { 0.0 } else { v.signum() };
        let damped = self.force(0.0) - self.damping * self.force(0.0).abs() * direction;
        let (stiffness, push) = (4.0 / self.dt.powi(2), 4.0 * v / self.dt + a);
        self.take((damped + push) / (stiffness + 1.0));
    }
}

/// In sixty steps, of one, ten and a hundred times the explicit one: steps without a solution, and |F| at the end.
fn sixty(dt: f64, step: fn(&mut Swing)) -> (u32, f64) {
    let mut swing = Swing::new(0.7, dt);
    for _ in 0..60 {
        step(&mut swing);
    }
    (swing.unsolved, swing.force(0.0).abs())
}

/// Where a mass would stop within a step, the residual jumps past zero by 2α |F|: there is no solution. With long steps
/// the damping that has one hardly acts.
#[test]
fn damping_inside_a_step_leaves_steps_without_a_solution() {
    let [short, middle, long] = [1.0, 10.0, 100.0].map(|dt| sixty(dt, Swing::inside));
    assert_eq!([short.0, middle.0, long.0], [9, 5, 0]);
    assert!(short.1 < 1e-3 && middle.1 < 1e-3 && long.1 > 0.8);
}

/// A force of the last step pushes a mass across its place of rest, the farther the longer the step.
#[test]
fn damping_by_the_step_before_does_not_come_to_rest() {
    let [short, middle, long] = [1.0, 10.0, 100.0].map(|dt| sixty(dt, Swing::lagged).1);
    assert!(short < 1e-2 && middle > 100.0 && long > 1.0, "{short} {middle} {long}");
}
