//! What a solver of solid and water remembers: particles, states and pores, what the stages remember, the sums so far,
//! and the pattern of its matrices, so that a new one is counted as one.

use super::pores::Pores;
use super::{OfHats, Solver, Tangent};
use crate::implicit::linear::Direct;
use crate::implicit::unknowns::Pattern;
use crate::material::Law;
use crate::memory::{Memory, MemoryError, Saved, restore_all, save_all};
use crate::monitor::{Accumulated, Convergence, Reaction, Residual, WaterBalance};
use crate::room::Room;
use crate::work::Work;

/// Sums and forces: what is neither of a particle nor of a stage.
type Sums = (
    f64,
    Accumulated,
    Residual,
    Convergence,
    Work,
    Vec<Reaction>,
    WaterBalance,
);

impl<const D: usize, I: OfHats<D>, M: Law> Memory for Solver<D, I, M> {
    fn save(&self) -> Result<Saved, MemoryError> {
        let sums = (
            self.time,
            self.accumulated,
            self.residual,
            &self.convergence,
            self.work,
            &self.reactions,
            self.balance,
        );
        let stages = (
            save_all(&self.scene.loads)?,
            save_all(&self.scene.constraints)?,
        );
        let of_grid = (&self.nodal_pressure, &self.direct.pattern);
        Saved::of(&(self.save_body()?, sums, stages, of_grid))
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        type All = (Saved, Sums, (Vec<Saved>, Vec<Saved>), (Vec<f64>, Pattern));
        let (body, sums, (loads, constraints), (nodal_pressure, pattern)): All =
            saved.read("a solver of solid and water")?;
        let (time, accumulated, residual, convergence, work, reactions, balance) = sums;
        MemoryError::unless_equal("constraints", reactions.len(), self.reactions.len())?;
        let nodes = self.nodal_pressure.len();
        MemoryError::unless_equal("nodes of the pressure", nodal_pressure.len(), nodes)?;
        self.restore_body(&body)?;
        restore_all("loads", &mut self.scene.loads, &loads)?;
        restore_all("constraints", &mut self.scene.constraints, &constraints)?;
        self.time = time;
        self.accumulated = accumulated;
        self.residual = residual;
        self.convergence = convergence;
        self.work = work;
        self.reactions = reactions;
        self.balance = balance;
        self.nodal_pressure = nodal_pressure;
        self.direct = Direct::new(self.settings.tangent == Tangent::Symmetric);
        self.direct.pattern = pattern;
        Ok(())
    }
}

impl<const D: usize, I: OfHats<D>, M: Law> Solver<D, I, M> {
    /// Body and pores as bytes.
    pub(super) fn save_body(&self) -> Result<Saved, MemoryError> {
        Saved::of(&(self.scene.body.save()?, &self.pores))
    }

    /// Replaces body and pores by those that were saved, all of whose particles must be on the grid.
    pub(super) fn restore_body(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        let (body, pores): (Saved, Pores<D>) = saved.read("a body with water")?;
        pores.check_against(&self.pores)?;
        let grid = *self.solid_space.functions.grid();
        let widest = if I::MEANS {
            0.5 * grid.h
        } else {
            f64::INFINITY
        };
        for l in pores.half_size.iter().flatten() {
            if !(*l > 0.0 && *l <= widest) {
                return Err(MemoryError::Value {
                    what: "half_size",
                    value: *l,
                    allowed: "positive, of means at most half a cell (m)",
                });
            }
        }
        let half_size = &pores.half_size;
        self.scene.body.restore(&body, |particles| {
            for (x, l) in particles.position.iter().zip(half_size) {
                let room = Room::new(&grid, l.map(I::beyond_wall));
                if room.place(&mut x.clone()).is_err() {
                    return Err(MemoryError::Value {
                        what: "position",
                        value: x[0],
                        allowed: "on the grid (m)",
                    });
                }
            }
            Ok(())
        })?;
        self.pores = pores;
        // The nodes' pressures are those of another run; what particles carry stands for them.
        self.nodal_pressure.fill(f64::NAN);
        Ok(())
    }
}
