//! Memory of a solver: particles and their states, memories of the stages, the ledger, and the pattern of its matrices,
//! so that a new one is counted as such.

use super::linear::Direct;
use super::unknowns::Pattern;
use super::{Interpolation, Solver, contact};
use crate::ledger::Ledger;
use crate::memory::{Memory, MemoryError, Saved, require};
use crate::particles::Particles;
use crate::room::Room;
use crate::scene::SavedStages;

impl<const D: usize> Memory for Solver<D> {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(
            self.scene.bodies.save()?,
            &self.ledger,
            self.scene.save_stages()?,
            &self.direct.pattern,
            &self.advance.concat(),
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (Saved, Ledger, SavedStages, Pattern, Vec<f64>);
        let (body, ledger, stages, pattern, advance): All = saved.read("a quasi-static solver")?;
        self.ledger.check(&ledger)?;
        let steps = usize::from(!advance.is_empty()) * self.functions.len() * D;
        MemoryError::unless_equal("increments of nodes", advance.len(), steps)?;
        self.restore_body(&body)?;
        self.scene.restore_stages(&stages)?;
        self.ledger.restore(ledger);
        self.direct = Direct::new(contact::is_symmetric(&self.scene));
        self.direct.pattern = pattern;
        self.advance = advance.as_chunks().0.to_vec();
        Ok(())
    }
}

impl<const D: usize> Solver<D> {
    /// Replaces the body by one that was saved, all of whose particles must be on the grid.
    fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let functions = self.functions.as_ref();
        let body = &mut self.scene.bodies;
        body.restore(saved, |particles| check(functions, particles))
    }

    /// Goes on with the body and the sticks of another run.
    pub(super) fn go_on_with(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (body, sticks): (Saved, Vec<Vec<f64>>) = saved.read("a body with its sticks")?;
        let (functions, scene) = (self.functions.as_ref(), &mut self.scene);
        scene.bodies.go_on_with(&body, |particles| check(functions, particles))?;
        scene.take_sticks(&sticks);
        Ok(())
    }
}

/// That all particles are on the grid and no larger than a cell.
fn check<const D: usize>(functions: &dyn Interpolation<D>, particles: &Particles<D>) -> Result<(), MemoryError> {
    let grid = functions.grid();
    let room = Room::new(grid, particles.half_size.map(|l| functions.beyond_wall(l)));
    for l in particles.half_size {
        let fits = l > 0.0 && l <= 0.5 * grid.h;
        require(fits, "half_size", l, "positive, at most half a cell (m)")?;
    }
    for x in &particles.position {
        let inside = room.place(&mut x.clone()).is_ok();
        require(inside, "position", x[0], "on the grid (m)")?;
    }
    Ok(())
}
