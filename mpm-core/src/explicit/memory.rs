//! What a solver remembers: particles and their states, what the stages remember, and the sums so far.
//! Nodal arrays are no memory; constraints declare theirs anew.

use super::{Held, Solver};
use crate::basis::Basis;
use crate::explicit::transfer::Transfer;
use crate::grid::Grid;
use crate::material::Law;
use crate::memory::{Memory, MemoryError, Saved, restore_all, save_all};
use crate::monitor::{Accumulated, Residual};
use crate::parallel::SLAB;
use crate::particles::Particles;
use crate::work::Work;
use std::ops::Range;

/// Sums and forces: what is neither of a particle nor of a stage.
type Sums = (f64, Accumulated, Residual, Work, Vec<Held>);

impl<const D: usize, const S: usize, B: Basis<S>, M: Law, T: Transfer<D>> Memory
    for Solver<D, S, B, M, T>
{
    fn save(&self) -> Result<Saved, MemoryError> {
        let (scene, settings) = (&self.scene, &self.settings);
        let sums = (
            self.time,
            self.accumulated,
            self.residual,
            self.work,
            &self.held,
        );
        let stages = (
            save_all(&scene.loads)?,
            save_all(&settings.force_filters)?,
            save_all(&scene.constraints)?,
            save_all(&settings.particle_filters)?,
        );
        let contacts: Result<Vec<Saved>, _> = scene.contacts.iter().map(Memory::save).collect();
        Saved::of(&(
            self.save_body()?,
            sums,
            settings.transfer.save()?,
            settings.remedy.save()?,
            stages,
            contacts?,
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type Stages = (Vec<Saved>, Vec<Saved>, Vec<Saved>, Vec<Saved>);
        type All = (Saved, Sums, Saved, Saved, Stages, Vec<Saved>);
        let (body, sums, transfer, remedy, stages, contacts): All = saved.read("a solver")?;
        let (time, accumulated, residual, work, held) = sums;
        MemoryError::unless_equal("constraints", held.len(), self.held.len())?;
        MemoryError::unless_equal("nodes", work.nodes as usize, self.nodes.len())?;
        self.restore_body(&body)?;
        let (scene, settings) = (&mut self.scene, &mut self.settings);
        restore_all("loads", &mut scene.loads, &stages.0)?;
        restore_all("force filters", &mut settings.force_filters, &stages.1)?;
        restore_all("constraints", &mut scene.constraints, &stages.2)?;
        restore_all(
            "particle filters",
            &mut settings.particle_filters,
            &stages.3,
        )?;
        MemoryError::unless_equal("contacts", contacts.len(), scene.contacts.len())?;
        for (contact, saved) in scene.contacts.iter_mut().zip(&contacts) {
            contact.restore(saved)?;
        }
        settings.transfer.restore(&transfer)?;
        settings.remedy.restore(&remedy)?;
        self.time = time;
        self.accumulated = accumulated;
        self.residual = residual;
        self.work = work;
        self.held = held;
        Ok(())
    }
}

impl<const D: usize, const S: usize, B: Basis<S>, M: Law, T: Transfer<D>> Solver<D, S, B, M, T> {
    /// The body and how it is sorted.
    pub(super) fn save_body(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.scene.body.save()?, &self.slabs, self.drift))
    }

    /// Replaces the body by one that was saved.
    pub(super) fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (body, slabs, drift): (Saved, Vec<Range<usize>>, f64) = saved.read("a body")?;
        let (scene, expected) = (&mut self.scene, self.slabs.len());
        let grid = scene.grid;
        scene.body.restore(&body, |particles| {
            check_places(&grid, particles, &slabs, expected)
        })?;
        self.slabs = slabs;
        self.drift = drift;
        self.wave_modulus = self.scene.body.wave_modulus();
        self.find_reach();
        Ok(())
    }
}

/// Checks that `slabs` divide the particles as the grid does, up to the cell that each may have moved since
/// they were sorted, and that no particle is off the grid: what scatters and gathers rely on.
fn check_places<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    slabs: &[Range<usize>],
    expected: usize,
) -> Result<(), MemoryError> {
    MemoryError::unless_equal("slabs", slabs.len(), expected)?;
    for l in particles.half_size {
        let fits = l > 0.0 && l <= 0.5 * grid.h;
        require(fits, "half_size", l, "positive, at most half a cell (m)")?;
    }
    let mut end = 0;
    for (k, slab) in slabs.iter().enumerate() {
        MemoryError::unless_equal("first particle of a slab", slab.start, end)?;
        end = slab.end;
        let Some(positions) = particles.position.get(slab.clone()) else {
            let count = particles.len();
            return MemoryError::unless_equal("last particle of a slab", slab.end, count);
        };
        let cells = (k * SLAB).saturating_sub(1)..=(k + 1) * SLAB;
        for x in positions {
            for (axis, (x, ends)) in x.iter().zip(&grid.axes).enumerate() {
                let inside = (ends.lo..=ends.hi(grid.h)).contains(x);
                let near = axis > 0 || cells.contains(&grid.cell(axis, *x));
                require(
                    inside && near,
                    "position",
                    *x,
                    "on the grid, near its slab (m)",
                )?;
            }
        }
    }
    MemoryError::unless_equal("particles in slabs", end, particles.len())
}

fn require(
    ok: bool,
    what: &'static str,
    value: f64,
    allowed: &'static str,
) -> Result<(), MemoryError> {
    if ok {
        return Ok(());
    }
    Err(MemoryError::Value {
        what,
        value,
        allowed,
    })
}
