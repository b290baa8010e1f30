//! Memory of a solver of solid and water: particles, states, pores, memories of the stages, the ledger, and the pattern
//! of its matrices, so that a new one is counted as such.

use super::pores::Pores;
use super::{Solver, Tangent};
use crate::implicit::linear::Direct;
use crate::implicit::unknowns::Pattern;
use crate::ledger::Ledger;
use crate::memory::{Memory, MemoryError, Saved, require};
use crate::monitor::WaterBalance;
use crate::room::Room;
use crate::scene::SavedStages;

impl<const D: usize> Memory for Solver<D> {
    fn save(&self) -> Result<Saved, MemoryError> {
        let of_water = (self.balance, &self.nodal_pressure);
        Saved::of(&(self.save_body()?, &self.ledger, self.scene.save_stages()?, &self.direct.pattern, of_water))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (Saved, Ledger, SavedStages, Pattern, (WaterBalance, Vec<f64>));
        let (body, ledger, stages, pattern, (balance, nodal_pressure)): All =
            saved.read("a solver of solid and water")?;
        self.ledger.check(&ledger)?;
        let nodes = self.nodal_pressure.len();
        MemoryError::unless_equal("nodes of the pressure", nodal_pressure.len(), nodes)?;
        self.restore_body(&body)?;
        self.scene.restore_stages(&stages)?;
        self.ledger.restore(ledger);
        self.balance = balance;
        self.nodal_pressure = nodal_pressure;
        self.direct = Direct::new(self.settings.tangent == Tangent::Symmetric);
        self.direct.pattern = pattern;
        Ok(())
    }
}

impl<const D: usize> Solver<D> {
    /// Body and pores as bytes.
    pub(super) fn save_body(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.scene.bodies.save()?, &self.pores))
    }

    /// Replaces body and pores by those that were saved, all of whose particles must be on the grid.
    pub(super) fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (body, pores): (Saved, Pores<D>) = saved.read("a body with water")?;
        pores.check_against(&self.pores)?;
        let functions = self.solid_space.functions.as_ref();
        let grid = functions.grid();
        let widest = if functions.means() { 0.5 * grid.h } else { f64::INFINITY };
        for l in pores.half_size.iter().flatten() {
            let fits = *l > 0.0 && *l <= widest;
            require(fits, "half_size", *l, "positive, of means at most half a cell (m)")?;
        }
        let half_size = &pores.half_size;
        self.scene.bodies.restore(&body, |particles| {
            for (x, l) in particles.position.iter().zip(half_size) {
                let room = Room::new(grid, l.map(|l| functions.beyond_wall(l)));
                let inside = room.place(&mut x.clone()).is_ok();
                require(inside, "position", x[0], "on the grid (m)")?;
            }
            Ok(())
        })?;
        self.pores = pores;
        // The nodes' pressures are those of another run; what particles carry stands for them.
        self.nodal_pressure.fill(f64::NAN);
        Ok(())
    }
}
