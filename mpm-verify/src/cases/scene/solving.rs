//! Which solvers a scene file can ask for: those that are compiled, by dimension and law.

use super::law::Material;
use super::phase::Phase;
use super::setup::Setup;
use crate::scheme::Scheme;
use mpm_core::{Error, Simulation};
use mpm_solvers::{implicit, poro, solver};

/// A dimension with the solvers of its scenes.
pub(super) trait Solving<const D: usize> {
    /// The simulation of a phase at its start.
    fn solve(setup: &Setup<D>, phase: &Phase) -> Result<Box<dyn Simulation<D>>, Error>;
}

/// Whose solvers they are.
pub(super) struct Compiled;

macro_rules! solving {
    ($dimension:literal, explicit: [$($explicit:ident),*], implicit: [$($implicit:ident),*], poro: [$($poro:ident),*]) => {
        impl Solving<$dimension> for Compiled {
            fn solve(
                setup: &Setup<$dimension>,
                phase: &Phase,
            ) -> Result<Box<dyn Simulation<$dimension>>, Error> {
                let scheme = setup.scheme;
                match (scheme, phase.material) {
                    $((Scheme::Explicit(_), Material::$explicit(law)) => {
                        solver(scheme, setup.scene(law, phase)?, setup.explicit(phase)?)
                    })*
                    $((Scheme::Implicit(_), Material::$implicit(law)) => {
                        implicit(scheme, setup.scene(law, phase)?, setup.implicit(phase))
                    })*
                    $((Scheme::Poro(_), Material::$poro(law)) => {
                        let scene = setup.scene(law, phase)?;
                        let water = setup.water(&scene.body.particles)?;
                        poro(scheme, scene, water, setup.poro(phase))
                    })*
                    _ => Err(Error::Input {
                        what: "solvers for this scheme and law",
                        value: 0.0,
                        allowed: concat!(
                            "in this dimension, explicit: ", $(stringify!($explicit), " ",)*
                            "implicit: ", $(stringify!($implicit), " ",)*
                            "poro: ", $(stringify!($poro), " "),*
                        ),
                    }),
                }
            }
        }
    };
}

solving!(1, explicit: [NeoHookean], implicit: [NeoHookean], poro: [Hencky, ImprovedHencky]);
solving!(2, explicit: [NeoHookean, HenckyJ2, NewtonianFluid], implicit: [NeoHookean, Hencky, HenckyJ2],
    poro: [Hencky, ImprovedHencky, CamClay]);
solving!(3, explicit: [NeoHookean, HenckyJ2], implicit: [NeoHookean], poro: []);
