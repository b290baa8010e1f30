//! From the name of a scheme to a solver: every instance that the cases offer, compiled in this package and nowhere else.

pub mod scheme;
pub mod trial;

use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::remedy::{Form, Onto};
use mpm_core::explicit::transfer::{Apic, Musl, Xpic};
use mpm_core::explicit::{Settings, Solver, Transfer};
use mpm_core::implicit::{self, Serendipity};
use mpm_core::material::{
    CamClay, Hencky, HenckyJ2, Hypoelastic, HypoelasticJ2, ImprovedHencky, NeoHookean, NewtonianFluid, Viscous,
};
use mpm_core::poro::{self, Water};
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
pub fn solver<const D: usize, M: Solvable<D>>(scheme: Scheme, scene: Scene<D, M>, settings: Settings<D>) -> Built<D> {
    trial::built(scene, |scene, _| M::solver(scheme, scene, settings))
}

/// Compiles solvers for a law: bases with FLIP, bases with APIC and XPIC too, and bases with MUSL.
macro_rules! solvable {
    ($dimension:literal, $law:ty, flip: [$($flip:ident),*], others: [$($other:ident),*],
     musl: [$($musl:ident),*]) => {
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
                    $((TransferName::Musl, BasisName::$musl) => {
                          $musl(scene, settings.transfer(Musl::default()))
                      })*
                    (_, basis) => Err(not_compiled($dimension, basis, transfer)),
                }
            }
        }
    };
}

solvable!(1, NeoHookean, flip: [Linear, Gimp, Bspline2, Bspline3], others: [], musl: []);
solvable!(1, Viscous<NeoHookean>, flip: [Linear, Gimp, Bspline2, Bspline3], others: [], musl: []);
solvable!(2, NeoHookean, flip: [Linear, Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2], musl: [Linear, Gimp]);
solvable!(2, HenckyJ2, flip: [Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2], musl: []);
solvable!(2, NewtonianFluid, flip: [Gimp, Bspline2, Bspline3], others: [Gimp, Bspline2], musl: []);
// Fluids flow in the plane; code that is generic over the dimension asks all the same.
solvable!(1, NewtonianFluid, flip: [], others: [], musl: []);
solvable!(3, NewtonianFluid, flip: [], others: [], musl: []);
solvable!(3, NeoHookean, flip: [Gimp, Bspline2], others: [], musl: []);
solvable!(3, HenckyJ2, flip: [Gimp, Bspline2], others: [], musl: []);

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

/// The CFL number that [`mpm_core::explicit::stable_cfl`] gives for a basis, in `dimension` dimensions, with particles whose
/// half size is `half_size` cells; none of linear functions, on which no step is stable wherever particles lie.
#[must_use]
pub fn stable_cfl(basis: BasisName, dimension: usize, half_size: f64) -> Option<f64> {
    let steepness = match basis {
        BasisName::Linear | BasisName::Q8 => None,
        BasisName::Gimp => Gimp::steepness(half_size),
        BasisName::Bspline2 => QuadraticBSpline::steepness(half_size),
        BasisName::Bspline3 => CubicBSpline::steepness(half_size),
    };
    steepness.map(|s| mpm_core::explicit::stable_cfl(dimension, s))
}

/// A law with the implicit solvers that are compiled for it.
pub trait Solved<const D: usize>: Law + Sized {
    /// An implicit solver of `scene` by `scheme`, whose remedy stands for that of the settings; the rule of time is theirs.
    ///
    /// # Errors
    /// The solver refuses the scene; the scheme is not implicit, or not compiled for this law in this dimension.
    fn implicit(scheme: Scheme, scene: Scene<D, Self>, settings: implicit::Settings) -> Built<D>;
}

/// An implicit solver of `scene` by `scheme`.
///
/// # Errors
/// As [`Solved::implicit`].
pub fn implicit<const D: usize, M: Solved<D>>(
    scheme: Scheme,
    scene: Scene<D, M>,
    settings: implicit::Settings,
) -> Built<D> {
    trial::built(scene, |scene, _| M::implicit(scheme, scene, settings))
}

/// Compiles implicit solvers for a law.
macro_rules! implicit_solvers {
    ($dimension:literal, $law:ty, [$($basis:ident: $functions:ty),*]) => {
        impl Solved<$dimension> for $law {
            #[allow(unused_variables, reason = "a law without an instance has no use for a scene")]
            fn implicit(
                scheme: Scheme,
                scene: Scene<$dimension, Self>,
                settings: implicit::Settings,
            ) -> Built<$dimension> {
                let Scheme::Implicit(parts) = scheme else {
                    return Err(other_solver("an implicit one"));
                };
                let settings = settings.remedy(implicit_remedy(parts.remedy)?);
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

implicit_solvers!(2, Hencky, [
    Linear: Lattice<2, 2, Linear>,
    Gimp: Lattice<2, 3, Gimp>,
    Bspline2: Lattice<2, 3, QuadraticBSpline>,
    Bspline3: Lattice<2, 4, CubicBSpline>,
    Q8: Serendipity
]);
implicit_solvers!(2, NeoHookean, [
    Linear: Lattice<2, 2, Linear>,
    Gimp: Lattice<2, 3, Gimp>,
    Bspline2: Lattice<2, 3, QuadraticBSpline>,
    Bspline3: Lattice<2, 4, CubicBSpline>
]);
implicit_solvers!(1, NeoHookean, [
    Linear: Lattice<1, 2, Linear>,
    Gimp: Lattice<1, 3, Gimp>,
    Bspline2: Lattice<1, 3, QuadraticBSpline>
]);
implicit_solvers!(2, NewtonianFluid, [Gimp: Lattice<2, 3, Gimp>, Bspline2: Lattice<2, 3, QuadraticBSpline>]);
implicit_solvers!(1, NewtonianFluid, []);
implicit_solvers!(3, NewtonianFluid, []);
implicit_solvers!(3, NeoHookean, [Gimp: Lattice<3, 3, Gimp>, Bspline2: Lattice<3, 3, QuadraticBSpline>]);
implicit_solvers!(2, HenckyJ2, [
    Linear: Lattice<2, 2, Linear>,
    Gimp: Lattice<2, 3, Gimp>,
    Bspline2: Lattice<2, 3, QuadraticBSpline>
]);
implicit_solvers!(2, HypoelasticJ2, [Gimp: Lattice<2, 3, Gimp>]);
implicit_solvers!(2, Hypoelastic, [Bspline2: Lattice<2, 3, QuadraticBSpline>, Q8: Serendipity]);

/// A law with the solvers of solid and water that are compiled for it.
pub trait Soaked<const D: usize>: Law + Sized {
    /// A solver of `scene`, whose pores are full of `water`, on the functions of `scheme`; the space of the pressure is
    /// that of the settings.
    ///
    /// # Errors
    /// The solver refuses the scene; the scheme is of another kind, or not compiled for this law in this dimension.
    fn poro(scheme: Scheme, scene: Scene<D, Self>, water: Water<D>, settings: poro::Settings) -> Built<D>;
}

/// A solver of solid and water.
///
/// # Errors
/// As [`Soaked::poro`].
pub fn poro<const D: usize, M: Soaked<D>>(
    scheme: Scheme,
    scene: Scene<D, M>,
    water: Water<D>,
    settings: poro::Settings,
) -> Built<D> {
    let grid = scene.grid;
    trial::built(scene, |scene, frame| match frame {
        None => M::poro(scheme, scene, water, settings),
        Some(frame) => {
            let settings = settings.in_units(frame.scale(1, 0));
            M::poro(scheme, scene, water.seen_from(frame, &grid), settings)
        }
    })
}

/// Compiles solvers of solid and water for a law.
macro_rules! soaked {
    ($dimension:literal, $law:ty, [$($basis:ident: $functions:ty),*]) => {
        impl Soaked<$dimension> for $law {
            fn poro(
                scheme: Scheme,
                scene: Scene<$dimension, Self>,
                water: Water<$dimension>,
                settings: poro::Settings,
            ) -> Built<$dimension> {
                let Scheme::Poro(parts) = scheme else {
                    return Err(other_solver("poro"));
                };
                match parts.basis {
                    $(BasisName::$basis => {
                        let solver =
                            poro::Solver::<$dimension, $functions, Self>::new(scene, water, settings)?;
                        Ok(Box::new(solver))
                    })*
                    basis => Err(not_compiled($dimension, basis, TransferName::Flip)),
                }
            }
        }
    };
}

soaked!(1, Hencky, [Linear: Lattice<1, 2, Linear>, Gimp: Lattice<1, 3, Gimp>]);
soaked!(2, Hencky, [Linear: Lattice<2, 2, Linear>, Gimp: Lattice<2, 3, Gimp>]);
soaked!(1, ImprovedHencky, [Linear: Lattice<1, 2, Linear>, Gimp: Lattice<1, 3, Gimp>]);
soaked!(2, ImprovedHencky, [Linear: Lattice<2, 2, Linear>, Gimp: Lattice<2, 3, Gimp>]);
soaked!(3, ImprovedHencky, [Gimp: Lattice<3, 3, Gimp>]);
soaked!(2, CamClay, [Linear: Lattice<2, 2, Linear>, Gimp: Lattice<2, 3, Gimp>]);

fn implicit_remedy(remedy: RemedyName) -> Result<implicit::Remedy, Error> {
    match remedy {
        RemedyName::None => Ok(implicit::Remedy::None),
        RemedyName::FbarConsistent => Ok(implicit::Remedy::FbarConsistent),
        RemedyName::Other(Form::Bbar, Onto::Basis) => Ok(implicit::Remedy::Bbar),
        other => Err(Error::Input {
            what: "place in the list of remedies, of the one of an implicit run,",
            value: RemedyName::NAMES.iter().take_while(|name| **name != other.text()).count() as f64,
            allowed: "0, 4 or 5, none, fbar-consistent or bbar: implicit solvers have no other",
        }),
    }
}

/// The case's scene is solved by another kind of solver.
fn other_solver(kind: &'static str) -> Error {
    Error::Input { what: "kinds of solver that this scene has for this scheme", value: 0.0, allowed: kind }
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
    Error::Input { what, value: value as f64, allowed }
}
