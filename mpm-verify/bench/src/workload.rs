//! Blocks that fly and deform, of one size with those that other programs are measured with: W2 and W3, with the published F̄
//! W2F and W3F, with averages over patches W2P and W3P; and the first four in many sizes.
//!
//! A square or cube of `cells` cells, two particles per cell and direction, neo-Hookean (E = 10⁵ Pa, ν = 0.3,
//! 1000 kg/m³), with a smooth velocity field; h = 1/280 m, Δt = 0.1 h/c; FLIP, quadratic B-splines. The room around it is
//! so wide that no particle reaches an end.

use crate::local::{Local, Steps};
use crate::turn::{Error, Turn, on_threads};
use mpm_core::explicit::remedy::{Form, Onto};
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::{Axis, Bodies, Grid, Particles, Scene, Simulation};
use mpm_solvers::scheme::{BasisName, RemedyName, Scheme};
use mpm_solvers::solver;
use std::f64::consts::TAU;

/// Cells on every side of the block.
const MARGIN: usize = 20;
/// Cell size (m).
const H: f64 = 1.0 / 280.0;
const DENSITY: f64 = 1000.0;
/// Steps of a slice.
pub(super) const STEPS: u64 = 10;
/// Particle updates of a slice of the scaling, at least.
const UPDATES: u64 = 2_000_000;

/// A block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Block<const D: usize> {
    /// Cells along each axis.
    pub(super) cells: usize,
    /// One of [`REMEDIES`].
    pub(super) remedy: RemedyName,
}

/// Those of blocks, the peers' first.
pub(super) const REMEDIES: [RemedyName; 3] =
    [RemedyName::None, RemedyName::FbarRecursive, RemedyName::Other(Form::Bbar, Onto::Patches)];

/// The block of 230,400 particles in two dimensions and that of 314,432 in three.
pub(super) const fn standard<const D: usize>(remedy: RemedyName) -> Block<D> {
    let cells = if D == 2 { 240 } else { 34 };
    Block { cells, remedy }
}

impl<const D: usize> Block<D> {
    pub(super) fn name(&self) -> String {
        let suffix = match self.remedy {
            RemedyName::None => "",
            RemedyName::FbarRecursive => "F",
            _ => "P",
        };
        format!("W{D}{suffix}")
    }

    pub(super) fn particles(&self) -> u64 {
        (2 * self.cells as u64).pow(D as u32)
    }
}

impl<const D: usize> Block<D> {
    fn positions(&self) -> Vec<[f64; D]> {
        let n = 2 * self.cells;
        let place = |k: usize| (MARGIN as f64 + (k as f64 + 0.5) / 2.0) * H;
        (0..n.pow(D as u32)).map(|k| std::array::from_fn(|a| place(k / n.pow((D - 1 - a) as u32) % n))).collect()
    }

    fn simulation(&self) -> Result<Box<dyn Simulation<D>>, Error> {
        // Quadratic splines have their nodes in the middle of cells; here, as elsewhere, they are at multiples of h.
        let axis = Axis::open(-0.5 * H, self.cells + 2 * MARGIN);
        let law = NeoHookean::new(1e5, 0.3)?;
        let dt = courant_time_step(0.1, H, law.wave_speed(DENSITY));
        let volume = (0.5 * H).powi(D as i32);
        let mut particles = Particles::new(self.positions(), volume, DENSITY, [0.25 * H; D])?;
        for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
            *v = velocity(x);
        }
        let scene = Scene::new(Grid::new(H, [axis; D])?, Bodies::new(law, particles)?);
        let scheme = Scheme::flip(BasisName::Bspline2, self.remedy);
        let settings = Settings::new(dt).remedy(self.remedy.build());
        Ok(solver(scheme, scene, settings)?)
    }

    fn turn(&self, group: &'static str, steps: u64, threads: usize) -> Result<Turn, Error> {
        let local = Local::new(threads, || {
            let simulation = self.simulation()?;
            Ok(Steps { simulation, steps })
        })?;
        Ok(Turn { group, name: self.name(), threads, particles: self.particles(), timed: Box::new(local), like: None })
    }

    /// The block on each number of threads.
    fn on_threads(
        &self,
        group: &'static str,
        steps: u64,
        threads: &[usize],
        turns: &mut Vec<Turn>,
    ) -> Result<(), Error> {
        on_threads(threads, turns, |threads| self.turn(group, steps, threads))
    }
}

fn velocity<const D: usize>(x: &[f64; D]) -> [f64; D] {
    let wave = |a: usize| TAU * x[a];
    std::array::from_fn(|a| match a {
        0 => 0.3 + wave(0).sin() * wave(1).cos(),
        1 => 0.1 - 0.5 * wave(0).cos() * wave(1).sin(),
        _ => 0.2 + 0.4 * wave(2).sin() * wave(0).cos(),
    })
}

/// The standard blocks.
pub(super) fn turns(threads: &[usize], turns: &mut Vec<Turn>) -> Result<(), Error> {
    for remedy in REMEDIES {
        standard::<2>(remedy).on_threads("workload", STEPS, threads, turns)?;
        standard::<3>(remedy).on_threads("workload", STEPS, threads, turns)?;
    }
    Ok(())
}

/// Blocks of 10⁴ to 10⁶·⁵ particles, half a decade apart, on one thread.
pub(super) fn scaling<const D: usize>() -> Result<Vec<Turn>, Error> {
    let cells: [usize; 6] = match D {
        2 => [50, 89, 158, 281, 500, 889],
        _ => [11, 16, 23, 34, 50, 73],
    };
    let remedies = REMEDIES.into_iter().take(2);
    let blocks = cells.into_iter().flat_map(|cells| remedies.clone().map(move |remedy| Block::<D> { cells, remedy }));
    blocks
        .map(|block| {
            let steps = UPDATES.div_ceil(block.particles());
            block.turn("scaling", steps, 1)
        })
        .collect()
}

/// Blocks of 400 particles on each number of threads.
#[cfg(test)]
pub(super) fn small(threads: &[usize], turns: &mut Vec<Turn>) -> Result<(), Error> {
    for remedy in REMEDIES {
        let block = Block::<2> { cells: 10, remedy };
        block.on_threads("workload", STEPS, threads, turns)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::needed;
    use mpm_core::lattice::Weights;
    use mpm_core::nodes::NodalState;

    #[test]
    fn sums_are_told_along_every_axis() {
        let block = Block::<3> { cells: 2, remedy: REMEDIES[0] };
        let mut turn = block.turn("workload", STEPS, 1).unwrap();
        let sums = turn.timed.outcome().unwrap().unwrap().sums;
        let speeds = block.positions().into_iter().map(|x| velocity(&x)[2]);
        let mean = speeds.sum::<f64>() / block.particles() as f64;
        let centre = (MARGIN as f64 + 1.0) * H;
        assert!((sums["momentum_z"] / sums["mass"] - mean).abs() < 1e-12);
        assert!((sums["centre_z"] - centre).abs() < 1e-12);
    }

    #[test]
    fn what_a_block_holds_is_its_columns_its_weights_and_its_nodes() {
        for fbar in [false, true] {
            let block = Block::<2> { cells: 30, remedy: REMEDIES[usize::from(fbar)] };
            let mut turn = block.turn("scaling", 1, 1).unwrap();
            turn.timed.slice().unwrap();
            let held = turn.timed.held().unwrap() as f64;
            // With F̄ ΔF, displacement, ΔJ, the new J̄ and the weights of its stencil.
            let works_with = match fbar {
                true => size_of::<([f64; 4], [f64; 2], [f64; 2], Weights<2, 3>)>(),
                false => 0,
            };
            let of_particle = needed(2, fbar) + works_with as f64;
            // Its state, its volume and its value.
            let of_node = size_of::<NodalState>() + size_of::<[f64; 2]>();
            let nodes = (block.cells + 2 * MARGIN).pow(2);
            let least = block.particles() as f64 * of_particle + (nodes * of_node) as f64;
            assert!((least..1.1 * least).contains(&held), "{held} of {least}");
        }
    }
}
