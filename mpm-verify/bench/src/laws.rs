//! The laws of the problems, with their particles side by side as in a step; those that flow do so in every update.

use crate::local::{Going, Local};
use crate::turn::{Error, Turn};
use mpm_core::material::{HenckyJ2, NeoHookean, NewtonianFluid, SharedLaw, Strength};
use mpm_core::{Bodies, Particles};

/// Particles, as many as stay in a cache.
const PARTICLES: usize = 4096;
/// Updates of each in a slice.
const UPDATES: u64 = 100;

struct Updates<const D: usize> {
    body: Bodies<D>,
}

impl<const D: usize> Going for Updates<D> {
    fn go_on(&mut self) -> Result<u64, Error> {
        for _ in 0..UPDATES {
            self.body.update_stress(1e-4);
        }
        Ok(UPDATES * PARTICLES as u64)
    }
}

/// A law in two and in three dimensions under small shear.
fn of(name: &str, law: impl Into<SharedLaw>, shear: f64, turns: &mut Vec<Turn>) -> Result<(), Error> {
    let law = law.into();
    turns.push(turn::<2>(name, law.clone(), shear)?);
    turns.push(turn::<3>(name, law, shear)?);
    Ok(())
}

fn turn<const D: usize>(name: &str, law: SharedLaw, shear: f64) -> Result<Turn, Error> {
    let local = Local::new(1, || {
        let particles = Particles::new(vec![[0.0; D]; PARTICLES], 1.0, 1.0, [0.5; D])?;
        let mut body = Bodies::new(law, particles)?;
        for f in &mut body.particles.delta_f {
            f[(0, 1)] = shear;
        }
        Ok(Updates { body })
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
