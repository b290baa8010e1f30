//! From the name of a scheme to a solver: every instance that the cases offer, compiled in this package and nowhere else.

pub mod scheme;
pub mod trial;

use mpm_core::basis::{Basis, CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::remedy::Form;
use mpm_core::explicit::transfer::{Apic, Musl, Xpic};
use mpm_core::explicit::{Settings, Solver, Transfer};
use mpm_core::implicit::{self, Interpolation, OfHats, Serendipity};
use mpm_core::poro::{self, Water};
use mpm_core::{Error, Lattice, Scene, Simulation};
use scheme::{BasisName, Explicit, RemedyName, Scheme, TransferName};
use std::any::Any;

type Built<const D: usize> = Result<Box<dyn Simulation<D>>, Error>;

/// A scene with the solvers that are compiled for its dimension, one for every basis and transfer.
trait Solvable<const D: usize>: Sized {
    /// An explicit solver; the transfer of the settings stands for `flip`.
    fn explicit(self, scheme: Scheme, settings: Settings<D>) -> Built<D>;

    /// An implicit solver. The remedy of the scheme stands for that of the settings; the rule of time is theirs.
    fn implicit(self, scheme: Scheme, settings: implicit::Settings) -> Built<D>;

    /// A solver of a body whose pores are full of water; the space of the pressure is that of the settings.
    fn poro(self, scheme: Scheme, water: Water<D>, settings: poro::Settings) -> Built<D>;
}

/// `value` as the type that it has.
fn cast<A: 'static, B: 'static>(value: A) -> Result<B, Error> {
    let value: Box<dyn Any> = Box::new(value);
    value.downcast().map(|value| *value).map_err(|_| other_solver("one in 1, 2 or 3 dimensions"))
}

/// A solver of a scene in its dimension, one of the three that are compiled.
macro_rules! in_its_dimension {
    ($scene:expr, $d:ident, |$own:ident| $build:expr) => {
        match $d {
            1 => cast($scene).and_then(|$own: Scene<1>| $build).and_then(cast),
            2 => cast($scene).and_then(|$own: Scene<2>| $build).and_then(cast),
            _ => cast($scene).and_then(|$own: Scene<3>| $build).and_then(cast),
        }
    };
}

/// A solver of `scene` by `scheme`.
///
/// # Errors
/// The solver refuses the scene; the scheme is of another kind; a transfer other than `flip` beside a blend with PIC,
/// which it would not see, or outside the plane; the remedy `own` is not set for these dimensions.
pub fn solver<const D: usize>(scheme: Scheme, scene: Scene<D>, settings: Settings<D>) -> Built<D> {
    if scheme.remedy() == RemedyName::Own && RemedyName::Own.own::<D>().is_none() {
        let what = "dimension of a run with the remedy own";
        return Err(Error::Input { what, value: D as f64, allowed: "the one that set_own_remedy was called for" });
    }
    trial::built(scene, |scene, _| in_its_dimension!(scene, D, |own| own.explicit(scheme, cast(settings)?)))
}

/// An implicit solver of `scene` by `scheme`.
///
/// # Errors
/// The solver refuses the scene; the scheme is of another kind, or its basis not of this dimension.
pub fn implicit<const D: usize>(scheme: Scheme, scene: Scene<D>, settings: implicit::Settings) -> Built<D> {
    trial::built(scene, |scene, _| in_its_dimension!(scene, D, |own| own.implicit(scheme, settings)))
}

/// A solver of solid and water.
///
/// # Errors
/// The solver refuses the scene; the scheme is of another kind, or its functions are neither hats nor means of hats.
pub fn poro<const D: usize>(scheme: Scheme, scene: Scene<D>, water: Water<D>, settings: poro::Settings) -> Built<D> {
    let grid = scene.grid;
    trial::built(scene, |scene, frame| {
        let (water, settings) = match frame {
            None => (water, settings),
            Some(frame) => (water.seen_from(frame, &grid), settings.in_units(frame.scale(1, 0))),
        };
        in_its_dimension!(scene, D, |own| own.poro(scheme, cast(water)?, settings))
    })
}

/// Compiles the solvers of a dimension, with the elements of eight nodes where there are any.
macro_rules! solvable {
    ($dimension:literal, [$($transfer:ident: $made:expr),*] $(, $elements:ident)?) => {
        impl Solvable<$dimension> for Scene<$dimension> {
            fn explicit(self, scheme: Scheme, settings: Settings<$dimension>) -> Built<$dimension> {
                let Scheme::Explicit(Explicit { basis, transfer, .. }) = scheme else {
                    return Err(other_solver("explicit"));
                };
                refuse_blend(transfer, settings.transfer.share())?;
                match transfer {
                    TransferName::Flip => moved(basis, self, settings),
                    $(TransferName::$transfer => moved(basis, self, settings.transfer($made)),)*
                    #[allow(unreachable_patterns, reason = "of a dimension that has them all")]
                    _ => Err(in_the_plane($dimension)),
                }
            }

            fn implicit(self, scheme: Scheme, settings: implicit::Settings) -> Built<$dimension> {
                let Scheme::Implicit(parts) = scheme else {
                    return Err(other_solver("an implicit one"));
                };
                let settings = averaged(settings, parts.remedy)?;
                match parts.basis {
                    BasisName::Linear => balanced::<$dimension, Lattice<$dimension, 2, Linear>>(self, settings),
                    BasisName::Gimp => balanced::<$dimension, Lattice<$dimension, 3, Gimp>>(self, settings),
                    BasisName::Bspline2 => balanced::<$dimension, Lattice<$dimension, 3, QuadraticBSpline>>(self, settings),
                    BasisName::Bspline3 => balanced::<$dimension, Lattice<$dimension, 4, CubicBSpline>>(self, settings),
                    $(BasisName::Q8 => balanced::<$dimension, $elements>(self, settings),)?
                    #[allow(unreachable_patterns, reason = "of a dimension that has them all")]
                    basis => Err(no_such_basis(basis)),
                }
            }

            fn poro(self, scheme: Scheme, water: Water<$dimension>, settings: poro::Settings) -> Built<$dimension> {
                let Scheme::Poro(parts) = scheme else {
                    return Err(other_solver("poro"));
                };
                match parts.basis {
                    BasisName::Linear => soaked::<$dimension, Lattice<$dimension, 2, Linear>>(self, water, settings),
                    BasisName::Gimp => soaked::<$dimension, Lattice<$dimension, 3, Gimp>>(self, water, settings),
                    basis => Err(no_such_basis(basis)),
                }
            }
        }
    };
}

solvable!(1, []);
solvable!(2, [Apic: Apic, Xpic2: Xpic::new(2)?, Musl: Musl::default()], Serendipity);
solvable!(3, []);

/// An explicit solver on a basis.
fn moved<const D: usize, T: Transfer<D> + 'static>(
    basis: BasisName,
    scene: Scene<D>,
    settings: Settings<D, T>,
) -> Built<D> {
    fn on<const D: usize, const S: usize, B: Basis<S> + 'static, T: Transfer<D> + 'static>(
        scene: Scene<D>,
        settings: Settings<D, T>,
    ) -> Built<D> {
        Ok(Box::new(Solver::<D, S, B, T>::new(scene, settings)?))
    }
    match basis {
        BasisName::Linear => on::<D, 2, Linear, T>(scene, settings),
        BasisName::Gimp => on::<D, 3, Gimp, T>(scene, settings),
        BasisName::Bspline2 => on::<D, 3, QuadraticBSpline, T>(scene, settings),
        BasisName::Bspline3 => on::<D, 4, CubicBSpline, T>(scene, settings),
        BasisName::Q8 => Err(no_such_basis(basis)),
    }
}

/// An implicit solver on functions.
fn balanced<const D: usize, I: Interpolation<D>>(scene: Scene<D>, settings: implicit::Settings) -> Built<D> {
    Ok(Box::new(implicit::Solver::new::<I>(scene, settings)?))
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

/// A solver of solid and water on functions.
fn soaked<const D: usize, I: OfHats<D>>(scene: Scene<D>, water: Water<D>, settings: poro::Settings) -> Built<D> {
    Ok(Box::new(poro::Solver::new::<I>(scene, water, settings)?))
}

/// Settings with a remedy, and the functions that it averages with.
fn averaged(settings: implicit::Settings, remedy: RemedyName) -> Result<implicit::Settings, Error> {
    match remedy {
        RemedyName::None => Ok(settings.remedy(implicit::Remedy::None)),
        RemedyName::FbarConsistent => Ok(settings.remedy(implicit::Remedy::FbarConsistent)),
        RemedyName::Other(Form::Consistent, onto) => Ok(settings.remedy(implicit::Remedy::FbarConsistent).onto(onto)),
        RemedyName::Other(Form::Bbar, onto) => Ok(settings.remedy(implicit::Remedy::Bbar).onto(onto)),
        other => Err(Error::Input {
            what: "place in the list of remedies, of the one of an implicit run,",
            value: RemedyName::NAMES.iter().take_while(|name| **name != other.text()).count() as f64,
            allowed: "that of none, or of fbar-consistent or bbar onto the basis, hats or cells",
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

fn in_the_plane(dimension: usize) -> Error {
    let what = "dimension of a problem with another transfer than flip";
    Error::Input { what, value: dimension as f64, allowed: "2" }
}

fn no_such_basis(basis: BasisName) -> Error {
    let what = "degree of the basis of this kind of solver in this dimension";
    Error::Input { what, value: basis.degree() as f64, allowed: "that of a scheme that the case lists" }
}
