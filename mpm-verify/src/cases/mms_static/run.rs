//! Solution and simulation of the slow vortex, load step by load step.

use super::*;
use crate::exact::twist::ANGLE;
use crate::exact::{self, swirl, vortex_pressure};
use mpm_core::implicit::Settings;

parameters! { const:
    DIMENSION = "dimension", "-", "2", Domain::Integer { least: 2, most: 3 },
        "2: plane strain; 3: the swirl in a cube, whose pressure is zero";
}

/// The motion, whose angle grows to its amplitude over a quarter of the period.
pub(super) struct SlowVortex;

impl Known for SlowVortex {
    const SOLUTION: Solution = solution;

    fn parameters() -> Vec<Parameter> {
        let mut all = vortex_pressure::ENTRY.parameters.to_vec();
        let defaults =
            [(POISSON_RATIO, "0.4999"), (ANGLE, "0.1"), (PRESSURE, "0"), (ANGULAR_FREQUENCY, "1.570796326794897e-6")];
        set_defaults(&mut all, &defaults);
        for p in all.iter_mut().filter(|p| p.name == ANGULAR_FREQUENCY.name) {
            *p = p
                .within(number(1e-6, 1e-5, false))
                .meaning("angular frequency ω: so low that inertia, which the solver doesn't have, is nothing");
        }
        all.extend([
            DIMENSION,
            DURATION.with_default("1e6"),
            LOAD_STEPS,
            // In the middle of a cell what alternates from node to node has no strain, and nothing holds it in equilibrium.
            PPC_PER_DIRECTION.within(Domain::Integer { least: 2, most: 4 }),
        ]);
        all
    }
}

fn solution(p: &Parameters) -> Result<Box<dyn Exact>, exact::Error> {
    if p.number(DIMENSION) == 2.0 {
        return (vortex_pressure::ENTRY.build)(p);
    }
    if p.number(PRESSURE) != 0.0 {
        let given = p.number(PRESSURE);
        return Err(exact::Error(format!("pressure = {given} with dimension = 3; allowed: 0")));
    }
    (swirl::ENTRY.build)(p)
}

struct Slow<const D: usize>(Scenario<SlowVortex>);

pub(super) fn begin(spec: &RunSpec, p: &Parameters) -> Result<Box<dyn Job>, Error> {
    match solution(p)?.dimension() {
        3 => problem::begin::<3, Slow<3>>(spec, p),
        _ => problem::begin::<2, Slow<2>>(spec, p),
    }
}

impl<const D: usize> Slow<D> {
    /// Duration of a load step (s).
    fn dt(&self) -> f64 {
        self.0.setup.number(DURATION) / self.0.setup.number(LOAD_STEPS)
    }
}

impl<const D: usize> Problem<D> for Slow<D> {
    type Parameters = Own<SlowVortex>;
    type Seen = u64;

    fn new(setup: Setup<Own<SlowVortex>>) -> Result<Self, Error> {
        Ok(Self(Scenario::new(setup)?))
    }

    fn discretisation(&self) -> Discretisation {
        self.0.setup.regular(D, self.dt())
    }

    fn begin(&self, _: &u64) -> Begun<D> {
        let Material { mu, lambda, .. } = self.0.solution.material();
        let scene = self.0.scene(NeoHookean { mu, lambda }, self.dt())?;
        mpm_solvers::implicit(self.0.setup.scheme, scene, Settings::new(self.dt()))
    }

    fn row(&self, steps: &mut u64, phase: &mut Phase<D>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        *steps += 1;
        let run = phase.run.as_ref();
        let errors = errors::of_displacements(self.0.solution.as_ref(), run);
        let totals = run.totals();
        Ok(row! {
            "time (s)": run.time(),
            "displacement_l2 (m)": rms(errors.into_iter()),
            "stored_energy (J)": totals.stored_energy,
            "stress_work (J)": totals.accumulated.stress_work,
            "load_work (J)": totals.accumulated.load_work,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
            "log_jacobian_gap_rms (-)": totals.log_jacobian_gap_rms,
            "newton_iterations (-)": iterations as f64,
            "parts (-)": f64::from(run.convergence().map_or(0, |c| c.parts)),
        })
    }

    fn progress(&self, steps: &u64, _: &Phase<D>) -> f64 {
        *steps as f64 / self.0.setup.number(LOAD_STEPS)
    }

    fn particles<'a>(&self, _: &u64, mut columns: Columns<'a, D>) -> Columns<'a, D> {
        let (run, solution) = (columns.run(), self.0.solution.as_ref());
        let [stress, mean_stress] = errors::of_stresses(solution, run);
        let displacement = errors::of_displacements(solution, run);
        let force_stress = run.force_stress();
        columns
            .references()
            .each("displacement_error", "m", |_, k| displacement[k])
            .each("stress_error", "Pa", |_, k| stress[k])
            .each("mean_stress", "Pa", |_, k| force_stress[k].mean())
            .each("mean_stress_error", "Pa", |_, k| mean_stress[k])
            .jacobian()
    }

    fn metrics(&self, _: &u64, phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let (run, solution) = (phase.run.as_mut(), self.0.solution.as_ref());
        let mut values = errors::at_end(solution, run);
        let references = run.particles().reference.iter().map(vector);
        values.extend([
            (DISPLACEMENT_SCALE, rms(references.map(|x| solution.displacement(&x, run.time()).norm()))),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (LINEAR_ITERATIONS, run.work().linear_iterations as f64),
        ]);
        values
    }
}
