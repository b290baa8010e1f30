//! Velocities and accelerations after a step, by its time rule.

use super::equilibrium::Step;
use super::failure::Failure;
use super::settings::TimeRule;
use super::system::Solution;
use super::{Setting, Solver};
use nalgebra::SVector;

/// Share of the heaviest node's mass below which a node's is rounding.
const WEIGHTLESS: f64 = 1e-12;

/// A field on the nodes.
type Field<const D: usize> = Vec<SVector<f64, D>>;

impl<const D: usize> Solver<D> {
    /// Gives the particles the velocities at the end of a step of `dt` (s), under the `external` forces (N) where the
    /// equations hold.
    ///
    /// # Errors
    /// The mass is singular; the velocities are then as they were.
    pub(super) fn accelerate(
        &mut self,
        setting: &Setting<D>,
        solution: &Solution<D>,
        external: &[SVector<f64, D>],
        dt: f64,
    ) -> Result<(), Failure> {
        match self.settings.rule {
            TimeRule::Static => {}
            TimeRule::Midpoint { .. } => self.by_force(setting, solution, external, dt)?,
            TimeRule::Newmark { delta, .. } => self.by_acceleration(setting, solution, delta, dt),
        }
        Ok(())
    }

    /// Kinetic energy (J) of the velocities that the particles have on the nodes of a step, with the lumped mass.
    pub(super) fn nodal_kinetic_energy(&self, setting: &Setting<D>) -> f64 {
        let Some(inertia) = &setting.inertia else {
            return 0.0;
        };
        let velocity = &self.scene.bodies.particles.velocity;
        let momentum = inertia.mass.scatter(&setting.elements, |p| SVector::from(velocity[p]));
        let pairs = momentum.iter().zip(&inertia.mass.node);
        pairs.filter(|(_, m)| **m > 0.0).map(|(p, m)| 0.5 * p.norm_squared() / m).sum()
    }

    /// Gives the particles the accelerations of the start, M_l a = F_ext − F_int, by a rule that keeps them.
    pub(super) fn start_accelerations(&mut self) -> Result<(), Failure> {
        if !matches!(self.settings.rule, TimeRule::Newmark { .. }) {
            return Ok(());
        }
        self.sort();
        let dt = self.settings.dt;
        let setting = self.setting(dt);
        let Some(inertia) = &setting.inertia else {
            return Ok(());
        };
        let external = self.external(self.ledger.time, &setting.elements);
        let step = setting.step(&self.scene.bodies, dt);
        let rest = vec![0.0; setting.unknowns.len()];
        let internal = step.trial(&rest, external.len())?.internal;
        let forces: Field<D> = external.iter().zip(&internal).map(|(e, f)| e - f).collect();
        let elements = &setting.elements;
        let held = |node: usize, axis: usize| self.held_change(node, axis, dt).map(|v| v / dt);
        let (acceleration, _) = inertia.mass.solve(elements, &forces, held)?;
        let particles = &mut self.scene.bodies.particles;
        for (p, a) in particles.acceleration.iter_mut().enumerate() {
            *a = elements.value(p, &acceleration).into();
        }
        Ok(())
    }

    /// Change over a step of `dt` (s) of the velocity (m/s) at which a component of a node is held.
    fn held_change(&self, node: usize, axis: usize, dt: f64) -> Option<f64> {
        let held = self.held[node][axis]?;
        let constraint = &self.scene.constraints[held.by];
        let [before, after] = [self.ledger.time, self.ledger.time + dt].map(|time| constraint.amplitude(time));
        Some(held.velocity * (after - before))
    }

    /// The midpoint rule: M_β Δv = Δt (F_ext − F_int), which keeps momentum whatever Newton's method leaves.
    fn by_force(
        &mut self,
        setting: &Setting<D>,
        solution: &Solution<D>,
        external: &[SVector<f64, D>],
        dt: f64,
    ) -> Result<(), Failure> {
        let Some(inertia) = &setting.inertia else {
            return Ok(());
        };
        let (elements, mass) = (&setting.elements, &inertia.mass);
        let step: Step<D> = setting.step(&self.scene.bodies, dt);
        let penalty = step.penalty_forces(&solution.trial.u);
        let forces = solution.trial.internal.iter().zip(&penalty).zip(external);
        let impulse: Field<D> = forces.map(|((f, g), e)| (e - f - g) * dt).collect();
        let (change, iterations) = mass.solve(elements, &impulse, |node, axis| self.held_change(node, axis, dt))?;
        // Particles take ½ Δvᵀ M_c Δv where the nodes gave ½ Δvᵀ M_β Δv.
        let shared = mass.scatter(elements, |p| elements.value(p, &change));
        // Nodes without a share worth the name have no particles that could miss it.
        let least = WEIGHTLESS * mass.heaviest();
        let pairs = change.iter().zip(&shared).zip(&mass.node);
        let lost = pairs.filter(|(_, m)| **m > least).map(|((v, shared), m)| v.norm_squared() * m - v.dot(shared));
        self.ledger.accumulated.lumping_loss += 0.5 * mass.lumped * lost.sum::<f64>();
        self.ledger.work.linear_iterations += iterations;
        let particles = &mut self.scene.bodies.particles;
        for (p, velocity) in particles.velocity.iter_mut().enumerate() {
            *velocity = (SVector::from(*velocity) + elements.value(p, &change)).into();
        }
        Ok(())
    }

    /// Newmark's rule: nodal accelerations by Eq. (30), and the particles' by Eqs. (31) and (32) of Wang et al. 2016.
    fn by_acceleration(&mut self, setting: &Setting<D>, solution: &Solution<D>, delta: f64, dt: f64) {
        let Some(inertia) = &setting.inertia else {
            return;
        };
        let (elements, mass) = (&setting.elements, &inertia.mass);
        // The nodes' history, (v/(α Δt) + (1/(2α) − 1) a), is the push over their mass.
        let u = solution.trial.u.iter().map(|u| SVector::from(*u));
        let columns = u.zip(&inertia.push).zip(&mass.node);
        let mut acceleration: Field<D> = columns
            .map(|((u, push), m)| {
                let had = if *m > 0.0 { push / *m } else { SVector::zeros() };
                u * inertia.factor - had
            })
            .collect();
        for (node, acceleration) in acceleration.iter_mut().enumerate() {
            for axis in 0..D {
                if let Some(change) = self.held_change(node, axis, dt) {
                    acceleration[axis] = change / dt;
                }
            }
        }
        let particles = &mut self.scene.bodies.particles;
        let velocities = particles.velocity.iter_mut();
        let columns = velocities.zip(&mut particles.acceleration);
        for (p, (velocity, before)) in columns.enumerate() {
            let after = elements.value(p, &acceleration);
            let mean = SVector::from(*before) * (1.0 - delta) + after * delta;
            *velocity = (SVector::from(*velocity) + mean * dt).into();
            *before = after.into();
        }
    }
}
