//! From the name of a scheme to a solver: every instance that the cases offer, compiled in this package and nowhere else.

pub mod scheme;

use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::transfer::{Apic, Xpic};
use mpm_core::explicit::{Settings, Solver, Transfer};
use mpm_core::implicit::{self, QuasiStatic, QuasiStaticRemedy, Serendipity};
use mpm_core::material::{Hencky, HenckyJ2, Hypoelastic, NeoHookean, NewtonianFluid};
use mpm_core::{Error, Lattice, Law, Scene, Simulation};
use scheme::{BasisName, Explicit, RemedyName, Scheme, TransferName};

type Built<const D: usize> = Result<Box<dyn Simulation<D>>, Error>;

/// A law with the solvers that are compiled for it.
pub trait Solvable<const D: usize>: Law + Sized {
    /// A solver of `scene` by `scheme`; the transfer of the settings stands for `flip`.
    ///
    /// # Errors
    /// The solver refuses the scene; the scheme is not compiled for this law in this dimension; a transfer other than
    /// `flip` beside a blend with PIC, which it would not see.
    fn solver(scheme: Scheme, scene: Scene<D, Self>, settings: Settings<D>) -> Built<D>;
}

/// A solver of `scene` by `scheme`.
///
/// # Errors
/// As [`Solvable::solver`].
pub fn solver<const D: usize, M: Solvable<D>>(
    scheme: Scheme,
    scene: Scene<D, M>,
    settings: Settings<D>,
) -> Built<D> {
    M::solver(scheme, scene, settings)
}

/// Compiles solvers for a law: bases with FLIP, and bases with APIC and XPIC too.
macro_rules! solvable {
    ($dimension:literal, $law:ty, flip: [$($flip:ident),*], others: [$($other:ident),*]) => {
        impl Solvable<$dimension> for $law {
            #[allow(unused_variables, reason = "a law without an instance has no use for a scene")]
            fn solver(
                scheme: Scheme,
                scene: Scene<$dimension, Self>,
                settings: Settings<$dimension>,
            ) -> Built<$dimension> {
                let Scheme::Explicit(Explicit { basis, transfer, .. }) = scheme else {
                    return Err(other_solver("explicit"));
                };
                refuse_blend(transfer, settings.transfer.share())?;
                match (transfer, basis) {
                    $((TransferName::Flip, BasisName::$flip) => $flip(scene, settings),)*
                    $((TransferName::Apic, BasisName::$other) => {
                          $other(scene, settings.transfer(Apic))
                      }
                      (TransferName::Xpic2, BasisName::$other) => {
                          $other(scene, settings.transfer(Xpic::new(2)?))
                      })*
                    (_, basis) => Err(not_compiled($dimension, basis, transfer)),
                }
            }
        }
    };
}

solvable!(1, NeoHookean, flip: [Linear, Gimp, Bspline2, Bspline3], others: []);
solvable!(2, NeoHookean, flip: [Linear, Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2]);
solvable!(2, HenckyJ2, flip: [Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2]);
solvable!(2, NewtonianFluid, flip: [Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2]);
// Fluids flow in the plane; code that is generic over the dimension asks all the same.
solvable!(1, NewtonianFluid, flip: [], others: []);
solvable!(3, NewtonianFluid, flip: [], others: []);
solvable!(3, NeoHookean, flip: [Gimp, Bspline2], others: []);
solvable!(3, HenckyJ2, flip: [Gimp, Bspline2], others: []);

/// One generic constructor per basis, by the basis' name.
macro_rules! with_basis {
    ($($name:ident: $nodes:literal, $basis:ty;)+) => {
        $(#[allow(non_snake_case, reason = "the name of the basis, as the macro above writes it")]
        fn $name<const D: usize, M: Law + 'static, T: Transfer<D> + 'static>(
            scene: Scene<D, M>,
            settings: Settings<D, T>,
        ) -> Built<D> {
            Ok(Box::new(Solver::<D, $nodes, $basis, M, T>::new(scene, settings)?))
        })+
    };
}

with_basis! {
    Linear: 2, Linear;
    Gimp: 3, Gimp;
    Bspline2: 3, QuadraticBSpline;
    Bspline3: 4, CubicBSpline;
}

/// A law with the quasi-static solvers that are compiled for it.
pub trait Equilibrium<const D: usize>: Law + Sized {
    /// A quasi-static solver of `scene` by `scheme`, whose remedy stands for that of the settings.
    ///
    /// # Errors
    /// The solver refuses the scene; the scheme is not quasi-static, or not compiled for this law in this dimension.
    fn equilibrium(scheme: Scheme, scene: Scene<D, Self>, settings: QuasiStatic) -> Built<D>;
}

/// A quasi-static solver of `scene` by `scheme`.
///
/// # Errors
/// As [`Equilibrium::equilibrium`].
pub fn equilibrium<const D: usize, M: Equilibrium<D>>(
    scheme: Scheme,
    scene: Scene<D, M>,
    settings: QuasiStatic,
) -> Built<D> {
    M::equilibrium(scheme, scene, settings)
}

/// Compiles quasi-static solvers for a law.
macro_rules! static_solvers {
    ($dimension:literal, $law:ty, [$($basis:ident: $functions:ty),*]) => {
        impl Equilibrium<$dimension> for $law {
            fn equilibrium(
                scheme: Scheme,
                scene: Scene<$dimension, Self>,
                settings: QuasiStatic,
            ) -> Built<$dimension> {
                let Scheme::QuasiStatic(parts) = scheme else {
                    return Err(other_solver("quasi-static"));
                };
                let settings = settings.remedy(static_remedy(parts.remedy)?);
                match parts.basis {
                    $(BasisName::$basis => {
                        let solver =
                            implicit::Solver::<$dimension, $functions, Self>::new(scene, settings)?;
                        Ok(Box::new(solver))
                    })*
                    #[allow(unreachable_patterns, reason = "of a law that has them all")]
                    basis => Err(not_compiled($dimension, basis, TransferName::Flip)),
                }
            }
        }
    };
}

static_solvers!(2, Hencky, [
    Linear: Lattice<2, 2, Linear>,
    Gimp: Lattice<2, 3, Gimp>,
    Bspline2: Lattice<2, 3, QuadraticBSpline>,
    Bspline3: Lattice<2, 4, CubicBSpline>,
    Q8: Serendipity
]);
static_solvers!(2, NeoHookean, [
    Linear: Lattice<2, 2, Linear>,
    Gimp: Lattice<2, 3, Gimp>,
    Bspline2: Lattice<2, 3, QuadraticBSpline>,
    Bspline3: Lattice<2, 4, CubicBSpline>
]);
static_solvers!(3, NeoHookean, [Gimp: Lattice<3, 3, Gimp>, Bspline2: Lattice<3, 3, QuadraticBSpline>]);
static_solvers!(2, Hypoelastic, [Bspline2: Lattice<2, 3, QuadraticBSpline>, Q8: Serendipity]);

fn static_remedy(remedy: RemedyName) -> Result<QuasiStaticRemedy, Error> {
    match remedy {
        RemedyName::None => Ok(QuasiStaticRemedy::None),
        RemedyName::FbarConsistent => Ok(QuasiStaticRemedy::FbarConsistent),
        RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => {
            Err(Error::Input {
                what: "place of the remedy, of a quasi-static run, in the list none, fbar-recursive, fbar-total, fbar-rate, fbar-consistent,",
                value: f64::from(remedy as u8),
                allowed: "none or fbar-consistent: the others' forces follow from no energy",
            })
        }
    }
}

/// The case's scene is solved by another kind of solver.
fn other_solver(kind: &'static str) -> Error {
    Error::Input {
        what: "kinds of solver that this scene has for this scheme",
        value: 0.0,
        allowed: kind,
    }
}

fn refuse_blend(transfer: TransferName, share: f64) -> Result<(), Error> {
    if transfer == TransferName::Flip || share == 1.0 {
        return Ok(());
    }
    Err(Error::Input {
        what: "share of FLIP beside another transfer",
        value: share,
        allowed: "1: only the transfer flip blends with PIC",
    })
}

fn not_compiled(dimension: usize, basis: BasisName, transfer: TransferName) -> Error {
    let other = transfer != TransferName::Flip;
    let (value, what, allowed) = if other && dimension != 2 {
        let what = "dimension of a problem with another transfer than flip";
        (dimension, what, "2")
    } else if dimension == 3 {
        let what = "dimension of a problem with this basis";
        (dimension, what, "1 or 2")
    } else {
        let what = "degree of the basis beside this law and transfer";
        (basis.degree(), what, "that of a scheme that the case lists")
    };
    Error::Input {
        what,
        value: value as f64,
        allowed,
    }
}
