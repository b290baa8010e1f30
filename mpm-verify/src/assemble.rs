//! From the names of a scheme to a solver.

use crate::scheme::{BasisName, Scheme, TransferName};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::transfer::{Apic, Flip, Xpic};
use mpm_core::{Error, Law, Scene, Simulation, Solver, Transfer};

/// A solver of `scene` with the basis and the transfer of `scheme`; `scene` brings the transfer that
/// stands for `flip`. Problems in the plane offer other transfers, so none is compiled for the rest.
///
/// # Errors
/// The solver refuses the scene; a transfer other than `flip` outside of the plane, or beside a blend with PIC, which it
/// would not see.
pub fn with_any_transfer<const D: usize, M: Law + 'static>(
    scheme: Scheme,
    scene: Scene<D, M, Flip>,
) -> Result<Box<dyn Simulation<D>>, Error> {
    let share = scene.transfer.share();
    if scheme.transfer != TransferName::Flip && share != 1.0 {
        return Err(Error::Input {
            what: "share of FLIP beside another transfer",
            value: share,
            allowed: "1: only the transfer flip blends with PIC",
        });
    }
    match scheme.transfer {
        TransferName::Flip => with_basis(scheme.basis, scene),
        TransferName::Apic if const { D == 2 } => {
            with_basis(scheme.basis, scene.with_transfer(Apic))
        }
        TransferName::Xpic2 if const { D == 2 } => {
            with_basis(scheme.basis, scene.with_transfer(Xpic::new(2)?))
        }
        TransferName::Xpic3 if const { D == 2 } => {
            with_basis(scheme.basis, scene.with_transfer(Xpic::new(3)?))
        }
        TransferName::Apic | TransferName::Xpic2 | TransferName::Xpic3 => Err(Error::Input {
            what: "dimension of a problem with another transfer than flip",
            value: D as f64,
            allowed: "2",
        }),
    }
}

/// A solver of `scene` with a basis. Problems in three dimensions offer bases with three nodes along an axis only, so
/// no other is compiled for them.
///
/// # Errors
/// The solver refuses the scene; a basis that isn't there in three dimensions.
pub fn with_basis<const D: usize, M: Law + 'static, T: Transfer<D> + 'static>(
    basis: BasisName,
    scene: Scene<D, M, T>,
) -> Result<Box<dyn Simulation<D>>, Error> {
    Ok(match basis {
        BasisName::Gimp => Box::new(Solver::<D, 3, Gimp, M, T>::new(scene)?),
        BasisName::Bspline2 => Box::new(Solver::<D, 3, QuadraticBSpline, M, T>::new(scene)?),
        BasisName::Linear if const { D < 3 } => Box::new(Solver::<D, 2, Linear, M, T>::new(scene)?),
        BasisName::Bspline3 if const { D < 3 } => {
            Box::new(Solver::<D, 4, CubicBSpline, M, T>::new(scene)?)
        }
        BasisName::Linear | BasisName::Bspline3 => {
            return Err(Error::Input {
                what: "dimension of a problem with this basis",
                value: D as f64,
                allowed: "1 or 2",
            });
        }
    })
}
