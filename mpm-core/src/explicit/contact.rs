//! Contact in the step: forces before P2G, the time step that they allow, and gaps that stay open.

use super::{CFL_LIMIT, Solver};
use crate::basis::Basis;
use crate::contact::Stiffest;
use crate::error::{Error, Fault, require};
use crate::explicit::transfer::Transfer;

/// The CFL number of a contact whose stiffness over mass is `ratio` (1/s²) for the time step `dt` (s) of a body of
/// CFL number `cfl`: the greatest frequency of both together times Δt/2, at most.
pub fn contact_cfl(cfl: f64, ratio: f64, dt: f64) -> f64 {
    cfl.hypot(0.5 * dt * ratio.sqrt())
}

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// Readies the contacts for the particles.
    pub(super) fn attach_contacts(&mut self) -> Result<(), Error> {
        let scene = &mut self.scene;
        for contact in &mut scene.contacts {
            let periodic = contact.face().crosses(|axis| scene.grid.axes[axis].is_periodic());
            require(periodic.is_none(), "axis of a rigid face", periodic.unwrap_or(0) as f64, "not periodic")?;
            contact.attach(scene.bodies.particles.len());
            // All particles: later ones come from where they are near.
            contact.find_near(0.0, f64::INFINITY, &scene.bodies.particles);
        }
        self.keep_gaps_open(0.0)
    }

    /// Adds the contact forces to the external ones.
    pub(super) fn apply_contacts(&mut self) -> Result<(), Error> {
        let dt = self.settings.dt;
        let mut stiffest = Stiffest::default();
        let mut ratio = 0.0;
        for contact in &mut self.scene.contacts {
            let found = contact.try_step(self.ledger.time, dt, &mut self.scene.bodies.particles);
            contact.commit(dt);
            ratio += found.ratio;
            if found.ratio > stiffest.ratio {
                stiffest = found;
            }
        }
        let cfl = contact_cfl(self.wave_speed() * dt / self.scene.grid.h, ratio, dt);
        if ratio > 0.0 && cfl > CFL_LIMIT {
            let limit = CFL_LIMIT;
            let fault = Fault::UnstableTimeStep { cfl, limit };
            return Err(self.breakdown(stiffest.particle, fault));
        }
        Ok(())
    }

    /// Whether all gaps are open at `time` (s), after the displacement of the present step.
    pub(super) fn keep_gaps_open(&self, time: f64) -> Result<(), Error> {
        for contact in &self.scene.contacts {
            contact
                .closed_gap(time, &self.scene.bodies.particles)
                .map_err(|(index, fault)| self.breakdown(index, fault))?;
        }
        Ok(())
    }
}
