//! What a solver remembers: particles and their states, what the stages remember, the sums so far, and the pattern of
//! its matrices, so that a new one is counted as one.

use super::linear::Direct;
use super::unknowns::Pattern;
use super::{Interpolation, Solver, contact};
use crate::grid::Grid;
use crate::material::Law;
use crate::memory::{Memory, MemoryError, Saved, restore_all, save_all};
use crate::monitor::{Accumulated, Convergence, Reaction, Residual};
use crate::particles::Particles;
use crate::room::Room;
use crate::work::Work;

/// Sums and forces: what is neither of a particle nor of a stage.
type Sums = (f64, Accumulated, Residual, Convergence, Work, Vec<Reaction>);

impl<const D: usize, I: Interpolation<D>, M: Law> Memory for Solver<D, I, M> {
    fn save(&self) -> Result<Saved, MemoryError> {
        let sums = (
            self.time,
            self.accumulated,
            self.residual,
            &self.convergence,
            self.work,
            &self.reactions,
        );
        let stages = (
            save_all(&self.scene.loads)?,
            save_all(&self.scene.constraints)?,
        );
        let contacts: Result<Vec<Saved>, _> =
            self.scene.contacts.iter().map(Memory::save).collect();
        Saved::of(&(
            self.scene.body.save()?,
            sums,
            stages,
            contacts?,
            &self.direct.pattern,
            &self.advance.concat(),
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (
            Saved,
            Sums,
            (Vec<Saved>, Vec<Saved>),
            Vec<Saved>,
            Pattern,
            Vec<f64>,
        );
        let (body, sums, (loads, constraints), contacts, pattern, advance): All =
            saved.read("a quasi-static solver")?;
        let (time, accumulated, residual, convergence, work, reactions) = sums;
        MemoryError::unless_equal("constraints", reactions.len(), self.reactions.len())?;
        MemoryError::unless_equal("nodes", work.nodes as usize, self.functions.len())?;
        let steps = usize::from(!advance.is_empty()) * self.functions.len() * D;
        MemoryError::unless_equal("increments of nodes", advance.len(), steps)?;
        self.restore_body(&body)?;
        restore_all("loads", &mut self.scene.loads, &loads)?;
        restore_all("constraints", &mut self.scene.constraints, &constraints)?;
        MemoryError::unless_equal("contacts", contacts.len(), self.scene.contacts.len())?;
        for (contact, saved) in self.scene.contacts.iter_mut().zip(&contacts) {
            contact.restore(saved)?;
        }
        self.time = time;
        self.accumulated = accumulated;
        self.residual = residual;
        self.convergence = convergence;
        self.work = work;
        self.reactions = reactions;
        self.direct = Direct::new(contact::is_symmetric(&self.scene));
        self.direct.pattern = pattern;
        self.advance = advance.as_chunks().0.to_vec();
        Ok(())
    }
}

impl<const D: usize, I: Interpolation<D>, M: Law> Solver<D, I, M> {
    /// Replaces the body by one that was saved, all of whose particles must be on the grid.
    fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let grid = *self.functions.grid();
        let body = &mut self.scene.body;
        body.restore(saved, |particles| check::<D, I>(&grid, particles))
    }

    /// Goes on with the body and the sticks of another run.
    pub(super) fn go_on_with(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (body, sticks): (Saved, Vec<Vec<f64>>) = saved.read("a body with its sticks")?;
        let (grid, scene) = (*self.functions.grid(), &mut self.scene);
        scene
            .body
            .go_on_with(&body, |particles| check::<D, I>(&grid, particles))?;
        scene.take_sticks(&sticks);
        Ok(())
    }
}

/// That all particles are on the grid and no larger than a cell.
fn check<const D: usize, I: Interpolation<D>>(
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Result<(), MemoryError> {
    let room = Room::new(grid, particles.half_size.map(I::beyond_wall));
    for l in particles.half_size {
        if !(l > 0.0 && l <= 0.5 * grid.h) {
            return Err(MemoryError::Value {
                what: "half_size",
                value: l,
                allowed: "positive, at most half a cell (m)",
            });
        }
    }
    for x in &particles.position {
        if room.place(&mut x.clone()).is_err() {
            return Err(MemoryError::Value {
                what: "position",
                value: x[0],
                allowed: "on the grid (m)",
            });
        }
    }
    Ok(())
}
