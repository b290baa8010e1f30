//! The laws of the problems, with their particles side by side as in a step; those that flow do so in every update.

use crate::local::{Going, Local};
use crate::turn::{Error, Turn};
use mpm_core::material::{HenckyJ2, Law, NeoHookean, NewtonianFluid, Strength};
use mpm_core::{SymmetricTensor, space};
use nalgebra::SMatrix;

/// Particles, as many as stay in a cache.
const PARTICLES: usize = 4096;
/// Updates of each in a slice.
const UPDATES: u64 = 100;

struct Updates<M: Law, const D: usize> {
    law: M,
    delta_f: SMatrix<f64, D, D>,
    states: Vec<M::State>,
    stresses: Vec<SymmetricTensor>,
}

impl<M: Law, const D: usize> Going for Updates<M, D> {
    fn go_on(&mut self) -> Result<u64, Error> {
        for _ in 0..UPDATES {
            let delta_f = std::hint::black_box(&self.delta_f);
            let (states, stresses) = (&mut self.states, &mut self.stresses);
            (self.law).update_all(|_| space::embed(delta_f), 1e-4, states, stresses);
        }
        Ok(UPDATES * PARTICLES as u64)
    }
}

/// A law in two and in three dimensions under small shear.
fn of<M: Law + Copy + 'static>(name: &str, law: M, shear: f64, turns: &mut Vec<Turn>) -> Result<(), Error> {
    turns.push(turn::<M, 2>(name, law, shear)?);
    turns.push(turn::<M, 3>(name, law, shear)?);
    Ok(())
}

fn turn<M: Law + 'static, const D: usize>(name: &str, law: M, shear: f64) -> Result<Turn, Error> {
    let mut delta_f = SMatrix::<f64, D, D>::identity();
    delta_f[(0, 1)] = shear;
    let local = Local::new(1, || {
        Ok(Updates {
            states: vec![law.initial_state(); PARTICLES],
            stresses: vec![SymmetricTensor::default(); PARTICLES],
            law,
            delta_f,
        })
    })?;
    Ok(Turn {
        group: "law",
        name: format!("{D}D {name}"),
        threads: 1,
        particles: PARTICLES as u64,
        timed: Box::new(local),
        like: None,
    })
}

/// The laws of Cook's membrane, the footing, the slide and the dam break.
pub(super) fn turns() -> Result<Vec<Turn>, Error> {
    let mut turns = Vec::new();
    of("neo-Hookean", NeoHookean::new(1e5, 0.4999)?, 1e-6, &mut turns)?;
    let yields = HenckyJ2::new(1e6, 0.49, Strength::undrained(100.0)?)?;
    of("Hencky–J2, perfect", yields, 1e-5, &mut turns)?;
    let softens = HenckyJ2::new(25e6, 0.49, Strength::softening(40.82e3, 2.45e3, 5.0)?)?;
    of("Hencky–J2, softening", softens, 1e-4, &mut turns)?;
    of("fluid", NewtonianFluid::new(2e6, 1e-3)?, 1e-5, &mut turns)?;
    Ok(turns)
}
