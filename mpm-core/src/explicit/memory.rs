//! Memory of a solver: particles and their states, memories of the stages, and the ledger. Nodal arrays are not saved;
//! constraints declare theirs anew.

use super::Solver;
use crate::basis::Basis;
use crate::explicit::transfer::Transfer;
use crate::grid::Grid;
use crate::ledger::Ledger;
use crate::memory::{Memory, MemoryError, Saved, require, restore_all, save_all};
use crate::order::Slabs;
use crate::parallel::SLAB;
use crate::particles::Particles;
use crate::projection::Patches;
use crate::scene::SavedStages;
use std::ops::Range;

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Memory for Solver<D, S, B, T> {
    fn save(&self) -> Result<Saved, MemoryError> {
        let settings = &self.settings;
        let filters = (save_all(&settings.force_filters)?, save_all(&settings.particle_filters)?);
        Saved::of(&(
            self.save_body()?,
            &self.ledger,
            self.fields.iter().map(|field| field.transfer.save()).collect::<Result<Vec<_>, _>>()?,
            settings.remedy.save()?,
            self.scene.save_stages()?,
            filters,
        ))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (Saved, Ledger, Vec<Saved>, Saved, SavedStages, (Vec<Saved>, Vec<Saved>));
        let (body, ledger, transfers, remedy, stages, filters): All = saved.read("a solver")?;
        self.ledger.check(&ledger)?;
        self.restore_body(&body)?;
        self.scene.restore_stages(&stages)?;
        let settings = &mut self.settings;
        restore_all("force filters", &mut settings.force_filters, &filters.0)?;
        restore_all("particle filters", &mut settings.particle_filters, &filters.1)?;
        for (field, saved) in self.fields.iter_mut().zip(&transfers) {
            field.transfer.restore(saved)?;
        }
        settings.remedy.restore(&remedy)?;
        self.ledger.restore(ledger);
        Ok(())
    }
}

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// The bodies and how they are sorted.
    pub(super) fn save_body(&self) -> Result<Saved, MemoryError> {
        let slabs: Vec<_> = self.fields.iter().map(|field| &field.slabs).collect();
        let patches: Vec<_> = self.spaces.iter().map(|space| space.patches().map(Patches::ends)).collect();
        Saved::of(&(self.scene.bodies.save()?, slabs, patches, self.drift))
    }

    /// Replaces the bodies by those that were saved.
    pub(super) fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (Saved, Vec<Vec<Slabs>>, Vec<Option<Vec<usize>>>, f64);
        let (bodies, slabs, patches, drift): All = saved.read("bodies")?;
        let (grid, fields, each) = (self.scene.grid, &self.fields, &self.scene.bodies.each);
        MemoryError::unless_equal("bodies with averages", patches.len(), each.len())?;
        let patches = patches.into_iter().zip(&self.spaces).zip(each).map(|((ends, space), body)| {
            let ends = space.patches().map(|_| ends.unwrap_or_default());
            ends.map(|ends| Patches::saved(ends, body.range())).transpose()
        });
        let patches = patches.collect::<Result<Vec<_>, _>>()?;
        let mut checks = Vec::new();
        MemoryError::unless_equal("velocity fields", slabs.len(), fields.len())?;
        for (field, saved) in fields.iter().zip(&slabs) {
            MemoryError::unless_equal("bodies", saved.len(), field.bodies.len())?;
            for ((body, own), saved) in field.bodies.iter().zip(&field.slabs).zip(saved) {
                checks.push((each[*body].range(), saved, own.len()));
            }
        }
        self.scene.bodies.restore(&bodies, |particles| {
            let mut checks = checks.into_iter();
            checks.try_for_each(|(range, slabs, expected)| check_places(&grid, particles, range, slabs, expected))
        })?;
        for (field, slabs) in self.fields.iter_mut().zip(slabs) {
            field.slabs = slabs;
        }
        for (space, patches) in self.spaces.iter_mut().zip(patches) {
            if let (Some(own), Some(patches)) = (space.patches_mut(), patches) {
                *own = patches;
            }
        }
        self.drift = drift;
        self.wave_modulus = self.scene.bodies.wave_moduli();
        self.find_reach();
        Ok(())
    }
}

/// Checks that `slabs` divide the particles of a body, which stand in a `range`, as the grid does, up to the cell that each may have moved since
/// they were sorted, and that no particle is off the grid: what scatters and gathers rely on.
fn check_places<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    range: Range<usize>,
    slabs: &[Range<usize>],
    expected: usize,
) -> Result<(), MemoryError> {
    MemoryError::unless_equal("slabs", slabs.len(), expected)?;
    for l in particles.half_size {
        let fits = l > 0.0 && l <= 0.5 * grid.h;
        require(fits, "half_size", l, "positive, at most half a cell (m)")?;
    }
    let mut end = range.start;
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
                require(inside && near, "position", *x, "on the grid, near its slab (m)")?;
            }
        }
    }
    MemoryError::unless_equal("last particle in slabs", end, range.end)
}
