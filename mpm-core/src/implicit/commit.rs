//! Commit of a solution: the end of its step, sums of forces and energies, and the new state.

use super::algebra::dot;
use super::contact;
use super::elements::Elements;
use super::equilibrium::{Step, Trial};
use super::failure::Failure;
use super::system::Solution;
use super::{Setting, Solver};
use crate::monitor::Residual;
use crate::room::Room;
use crate::space::{determinant, stretch_of_volume};
use nalgebra::SVector;

impl<const D: usize> Solver<D> {
    /// The trial at the end of a step, where the equations hold elsewhere.
    pub(super) fn end_of_step(
        &mut self,
        setting: &Setting<D>,
        solution: &Solution<D>,
        dt: f64,
    ) -> Result<Option<Trial<D>>, Failure> {
        let place = self.settings.rule.place();
        if place == 1.0 {
            return Ok(None);
        }
        self.ledger.work.particle_node_pairs += 2 * setting.elements.pairs() as u64;
        let whole: Vec<f64> = solution.u.iter().map(|u| u / place).collect();
        let obstacles = self.obstacles(self.ledger.time + dt);
        let step = Step { obstacles: &obstacles, ..setting.step(&self.scene.bodies, dt) };
        Ok(Some(step.trial(&whole, self.functions.len())?))
    }

    /// The places (m) to which a trial moves the particles.
    pub(super) fn places_after(&self, elements: &Elements<D>, trial: &Trial<D>) -> Result<Vec<[f64; D]>, Failure> {
        let particles = &self.scene.bodies.particles;
        let room = Room::new(self.functions.grid(), particles.half_size.map(|l| self.functions.beyond_wall(l)));
        let mut places = particles.position.clone();
        for (p, x) in places.iter_mut().enumerate() {
            let (nodes, w, _) = elements.seen(p);
            for (node, w) in nodes.iter().zip(w) {
                for (x, u) in x.iter_mut().zip(trial.u[*node]) {
                    *x += w * u;
                }
            }
            room.place(x).map_err(|fault| Failure::Particle(p, fault))?;
        }
        Ok(places)
    }

    /// Keeps what a solution says of forces and energies, before the particles move.
    pub(super) fn observe(
        &mut self,
        setting: &Setting<D>,
        solution: &Solution<D>,
        end: &Trial<D>,
        [earlier, external]: [&[SVector<f64, D>]; 2],
        dt: f64,
    ) {
        let trial = &solution.trial;
        let step = setting.step(&self.scene.bodies, dt);
        let mut out: Vec<SVector<f64, D>> =
            (trial.internal.iter().zip(&trial.resistance).zip(external)).map(|((f, g), e)| e - f - g).collect();
        for (out, push) in out.iter_mut().zip(setting.inertia.iter().flat_map(|i| &i.push)) {
            *out += push;
        }
        self.ledger.residual = Residual {
            free_force: step.free(&out).iter().map(|f| f.abs()).sum(),
            kinetic_energy: self.nodal_kinetic_energy(setting),
            ..Residual::default()
        };
        for reaction in &mut self.ledger.reactions {
            reaction.force = [0.0; 3];
        }
        let work_of = |forces: &[SVector<f64, D>]| -> f64 {
            let pairs = forces.iter().zip(&end.u);
            pairs.map(|(f, u)| dot(f.as_slice(), u)).sum()
        };
        let [first, last] = self.settings.rule.shares();
        let increments: Vec<SVector<f64, D>> = end.u.iter().map(|u| SVector::from(*u)).collect();
        let [pushed_before, pushed] = [&solution.before.pushes, &trial.pushes]
            .map(|pushes| contact::work(pushes, &setting.elements, &increments));
        let pushed = first * pushed_before + last * pushed;
        self.ledger.accumulated.stress_work +=
            first * work_of(&solution.before.internal) + last * work_of(&trial.internal) + pushed;
        self.ledger.accumulated.load_work += first * work_of(earlier) + last * work_of(external) + pushed;
        self.ledger.accumulated.damping += 0.5 * work_of(&step.penalty_forces(&end.u));
        let mut moved = 0.0;
        for node in &setting.unknowns.node {
            for a in 0..D {
                if let Some(held) = self.held[*node][a] {
                    let force = out[*node][a];
                    self.ledger.residual.held_force[a] += force;
                    let reaction = &mut self.ledger.reactions[held.by];
                    reaction.force[a] += force;
                    reaction.impulse[a] += force * dt;
                    let before = earlier[*node][a] - solution.before.internal[*node][a];
                    moved += (first * before + last * force) * end.u[*node][a];
                }
            }
        }
        self.ledger.accumulated.constraint_loss += moved;
        self.react(&trial.pushes, dt);
    }

    /// Makes a trial the state of the body.
    pub(super) fn commit(&mut self, trial: &Trial<D>, places: &[[f64; D]], dt: f64) {
        let particles = &mut self.scene.bodies.particles;
        particles.position.copy_from_slice(places);
        for (p, f) in trial.f.iter().enumerate() {
            let change = determinant(f);
            particles.jacobian[p] *= change;
            particles.delta_f[p] = *f;
            if let Some(averaged) = trial.averaged.get(p) {
                particles.j_bar[p] *= averaged;
                particles.delta_f[p] *= stretch_of_volume::<f64, D>(averaged / change);
            }
        }
        self.scene.bodies.update_stress(dt);
    }
}
