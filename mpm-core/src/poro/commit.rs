//! Commit of a solution: new positions, states, domains and pressures; sums of forces and water.

use super::Solver;
use super::pores::{check_width, grown, keep_before_walls};
use super::step::{Setting, Trial};
use super::unknowns::Place;
use crate::implicit::Functions;
use crate::implicit::algebra::dot;
use crate::implicit::failure::Failure;
use crate::monitor::Residual;
use crate::room::Room;
use crate::space::determinant;
use nalgebra::SVector;

impl<const D: usize> Solver<D> {
    /// Makes a trial the state of the body.
    ///
    /// # Errors
    /// A particle that would leave the grid, or whose domain would be too wide for its functions; the body then stays
    /// as it was.
    pub(super) fn commit(&mut self, setting: &Setting<D>, trial: Trial<D>, dt: f64) -> Result<(), Failure> {
        let places = self.places_after(setting, &trial)?;
        let mut domains = self.domains_after(&trial)?;
        for (x, half_size) in places.iter().zip(&mut domains) {
            keep_before_walls(self.solid_space.functions.grid(), x, half_size);
        }
        self.observe(setting, &trial, dt);
        let particles = &mut self.scene.bodies.particles;
        let before = std::mem::replace(&mut particles.position, places);
        if !self.pores.slope.is_empty() {
            self.pores.slope = trial.slope;
            self.pores.place = before;
        }
        for (p, f) in trial.f.iter().enumerate() {
            particles.jacobian[p] *= determinant(f);
            particles.delta_f[p] = *f;
        }
        self.pores.half_size = domains;
        self.pores.pressure = trial.pressure;
        let places = trial.p.iter().zip(&setting.unknowns.pressure);
        let seen = |(p, place): (&f64, &Place)| {
            if *place == Place::Unseen { f64::NAN } else { *p }
        };
        self.nodal_pressure = places.map(seen).collect();
        self.scene.bodies.update_stress(dt);
        Ok(())
    }

    /// The places (m) to which a trial moves the particles.
    fn places_after(&self, setting: &Setting<D>, trial: &Trial<D>) -> Result<Vec<[f64; D]>, Failure> {
        let mut places = self.scene.bodies.particles.position.clone();
        let functions = &self.solid_space.functions;
        for (p, x) in places.iter_mut().enumerate() {
            let (nodes, w, _) = setting.solid.seen(p);
            for (node, w) in nodes.iter().zip(w) {
                for (x, u) in x.iter_mut().zip(trial.u[*node]) {
                    *x += w * u;
                }
            }
            let room = Room::new(functions.grid(), self.pores.half_size[p].map(|l| functions.beyond_wall(l)));
            room.place(x).map_err(|fault| Failure::Particle(p, fault))?;
        }
        Ok(places)
    }

    /// Half the sizes (m) of the domains after a trial. Means of hats are taken over domains whose corners the hats
    /// move (Coombs et al. 2020, doi:10.1016/j.cma.2019.112622): the mean extents of what becomes of the box. Other
    /// functions know no domain, which then stretches as the particle does. Either is brought to the particle's volume.
    fn domains_after(&self, trial: &Trial<D>) -> Result<Vec<[f64; D]>, Failure> {
        let particles = &self.scene.bodies.particles;
        let space = &self.solid_space;
        let mut functions = Functions::new();
        let mut domains = self.pores.half_size.clone();
        for (p, half_size) in domains.iter_mut().enumerate() {
            let f = &trial.f[p];
            let before = *half_size;
            if space.functions.means() {
                let x = particles.position[p];
                for corner in 0..1_usize << D {
                    let side = |a: usize| if corner >> a & 1 == 1 { 1.0 } else { -1.0 };
                    let place = std::array::from_fn(|a| x[a] + side(a) * before[a]);
                    space.functions.hats(&place, &mut functions);
                    for (node, w) in functions.node.iter().zip(&functions.w) {
                        let u = trial.u[space.originals[*node]];
                        for a in 0..D {
                            half_size[a] += side(a) * w * u[a] / f64::from(1 << D);
                        }
                    }
                }
            } else {
                for (a, l) in half_size.iter_mut().enumerate() {
                    *l *= f[(a, a)];
                }
            }
            *half_size = grown(&before, half_size, determinant(f));
            check_width(space.functions.as_ref(), half_size).map_err(|fault| Failure::Particle(p, fault))?;
        }
        Ok(domains)
    }

    /// Keeps what a trial says of forces, work and water, before the particles move.
    fn observe(&mut self, setting: &Setting<D>, trial: &Trial<D>, dt: f64) {
        self.ledger.residual = Residual::default();
        for reaction in &mut self.ledger.reactions {
            reaction.force = [0.0; 3];
        }
        let work_of = |forces: &[SVector<f64, D>]| -> f64 {
            let pairs = forces.iter().zip(&trial.u);
            pairs.map(|(f, u)| dot(f.as_slice(), u)).sum()
        };
        self.ledger.accumulated.stress_work += work_of(&trial.internal);
        self.ledger.accumulated.load_work += work_of(&trial.external);
        let mut lacking = vec![0.0; setting.unknowns.displacements];
        for (node, places) in setting.unknowns.displacement.iter().enumerate() {
            for (a, place) in places.iter().enumerate() {
                let force = -trial.momentum[node][a];
                match (place, self.held[node][a]) {
                    (Place::Free(unknown), _) => lacking[*unknown] += force,
                    (Place::Held(_), Some(held)) => {
                        self.ledger.residual.held_force[a] += force;
                        let reaction = &mut self.ledger.reactions[held.by];
                        reaction.force[a] += force;
                        reaction.impulse[a] += force * dt;
                    }
                    _ => {}
                }
            }
        }
        self.ledger.residual.free_force = lacking.iter().map(|f: &f64| f.abs()).sum();
        // Water that a held pressure lets out is what its equation lacks.
        let mut outflow = trial.drained;
        for (place, lacking) in setting.unknowns.pressure.iter().zip(&trial.mass) {
            if let Place::Held(_) = place {
                outflow -= lacking;
            }
        }
        let volume = &self.scene.bodies.particles.volume;
        let changes = trial.f.iter().zip(volume);
        let change: f64 = changes.map(|(f, v)| v * (determinant(f) - 1.0)).sum();
        let inflow: f64 = setting.inflow.iter().sum();
        self.balance.inflow += inflow;
        self.balance.outflow += outflow;
        self.balance.imbalance += change + outflow - inflow;
    }
}
