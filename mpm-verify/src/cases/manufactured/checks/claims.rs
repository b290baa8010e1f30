//! Claims on convergence that several motions share, and the known reasons why an order is lost.

use super::Wave;
use crate::cases::parameters::{POISSON_RATIO, PPC_PER_DIRECTION, STEP_SCALING, UNSEEN, WALL, WALL_LINE};
use crate::cases::prelude::*;
use crate::exact::common::{AMPLITUDE, DIMENSION};
use crate::exact::vortex_pressure::PRESSURE;

/// An order below this is not the formal one.
pub(in crate::cases) const STALLED: f64 = FORMAL - SLACK;
/// Displacements (m) beyond this cross cells that the levels have.
const CROSSING: f64 = 0.01;
/// Cell size (m) below which the vortex crosses enough cells that errors have a floor.
const FLOOR: f64 = 0.01;
/// Below this one (m) fbar-total and fbar-rate take enough steps to feed the null space.
const FED: f64 = 0.02;

/// Claim of a problem on the convergence of a run's scheme.
pub(in crate::cases) type Claims = fn(&Setup<()>) -> Claim;

/// Knowledge of the convergence of a scheme with some parameters.
pub(in crate::cases) enum Claim {
    /// Theory gives order two.
    Second,
    /// The order has been observed between two bounds; why theory gives none.
    Observed([f64; 2], &'static str),
    /// The order stays below a bound, at most [`STALLED`]; why.
    Stalls(f64, &'static str),
    /// Nothing is claimed; why.
    Open(&'static str),
}

pub(in crate::cases) const TRANSFER: &str =
    "what a transfer takes from the velocity per step is part of the error: docs/manufactured.md";
pub(in crate::cases) const HATS: &str =
    "displaced particles shift a linear basis's quadrature of mass and body force by u, a floor of about A² k";
pub(in crate::cases) const JUMPS: &str = "the gradient of a linear basis jumps where particles cross cells";
pub(in crate::cases) const NULL_SPACE: &str =
    "a pressure that Π can't see feeds the null space as particles pass each other (docs/remedy.md)";
pub(in crate::cases) const LOCKS: &str = "without a remedy the error is that of locking until the cells resolve it";
pub(in crate::cases) const OFF_NODE: &str =
    "the lumped mass of cubics next to a wall has its centre off the node: between first and second order";
const LITTLE_TO_DIFFUSE: &str = "Eq. (26) diffuses J; of an isochoric motion it has little to diffuse";

/// Whether a remedy neither locks nor creeps.
pub(in crate::cases) fn is_sound(remedy: RemedyName) -> bool {
    matches!(remedy, FbarTotal | FbarRate | FbarConsistent)
}

/// Whether what `fbar-consistent` can't see is as stiff as if the body had a Poisson's ratio above zero, so that it locks as
/// without a remedy: docs/mms-static.md.
pub(in crate::cases) fn is_beyond_unseen(r: &Setup<()>) -> bool {
    let compressible = 1.0 - 2.0 * r.number(POISSON_RATIO);
    r.remedy() == FbarConsistent && compressible < UNSEEN * UNSEEN
}

/// Whether a scheme feeds the null space for enough steps that it shows.
pub(in crate::cases) fn feeds_null_space(r: &Setup<()>) -> bool {
    matches!(r.remedy(), FbarTotal | FbarRate) && r.h < FED
}

/// Convergence between rollers, with or without a pressure gradient at the walls.
pub(in crate::cases) fn between_rollers(r: &Setup<()>) -> Claim {
    let crosses = r.number(AMPLITUDE) >= CROSSING;
    if r.number(PPC_PER_DIRECTION) == 1.0 {
        return Claim::Open("one particle per cell doesn't integrate what the basis can represent");
    }
    if r.values.is(WALL, WALL_LINE) {
        return Claim::Stalls(STALLED, "splines that are not interpolatory at a wall meet it with first order");
    }
    match r.remedy() {
        FbarRecursive if r.values.is(STEP_SCALING, "h2") => {
            return Claim::Stalls(0.5, "Eq. (26) diffuses J with D = ½ s² h²/Δt, which Δt ∝ h² keeps constant");
        }
        FbarRecursive if crosses => {
            return Claim::Open("crossing of cells adds to the diffusion of Eq. (26)");
        }
        FbarRecursive => {
            return Claim::Observed([0.6, 1.15], "Eq. (26) diffuses J with D = ½ s² h²/Δt ∝ h: first order");
        }
        _ => {}
    }
    if crosses {
        return match r.basis() {
            Linear => Claim::Stalls(0.5, JUMPS),
            _ => Claim::Open("the quadrature error of particles that left their lattice is a floor; see the page"),
        };
    }
    if matches!(r.transfer(), TransferName::Apic | TransferName::Xpic2) {
        return Claim::Open(TRANSFER);
    }
    let is_bar = r.number(DIMENSION) == 1.0;
    match (r.basis(), r.remedy()) {
        (Gimp, RemedyName::None) if is_bar => Claim::Observed(
            [1.4, 2.6],
            "within a cell GIMP's weights are hats: displaced particles shift its quadrature, a floor of about A² k",
        ),
        (Bspline3, remedy) if is_bar && is_sound(remedy) => {
            Claim::Open("in one dimension F̄ averages all of the stress, next to walls where cubics lack an order")
        }
        (Linear, _) if r.is_implicit() => Claim::Stalls(STALLED, HATS),
        (Linear, _) => Claim::Open(HATS),
        (Bspline3, _) => Claim::Observed([0.85, 2.3], OFF_NODE),
        _ => Claim::Second,
    }
}

/// The vortex in a box: its profile falls from one to a half over 0.16 m, a sixth of a wave.
pub(in crate::cases) const VORTEX: Wave = Wave::Shear(|_| 6.5);

pub(in crate::cases) fn of_vortex(r: &Setup<()>) -> Claim {
    if r.basis() == Linear {
        return Claim::Open(JUMPS);
    }
    if matches!(r.transfer(), TransferName::Apic | TransferName::Xpic2) {
        return Claim::Open(TRANSFER);
    }
    if r.h < FLOOR {
        return Claim::Open("particles cross ten cells: the quadrature error of two per direction is a floor");
    }
    if feeds_null_space(r) {
        let shears_only = r.number(PRESSURE).is_nan();
        let clear = shears_only && r.remedy() == FbarRate && matches!(r.basis(), Gimp | Bspline2);
        return if clear { Claim::Stalls(1.0, NULL_SPACE) } else { Claim::Open(NULL_SPACE) };
    }
    if r.is_implicit() && is_sound(r.remedy()) && r.h < FED {
        return Claim::Open(
            "without relaxation ln(J/J̄) no longer falls, and the error has a floor of a hundredth of the motion",
        );
    }
    of_isochoric(r, [0.8, 2.6])
}

/// Convergence of an isochoric motion whose order was observed between two bounds with a sound remedy.
pub(in crate::cases) fn of_isochoric(r: &Setup<()>, observed: [f64; 2]) -> Claim {
    match r.remedy() {
        remedy if is_sound(remedy) => {
            Claim::Observed(observed, "second order until the quadrature error of sheared particles shows")
        }
        RemedyName::None => Claim::Open(LOCKS),
        _ => Claim::Open(LITTLE_TO_DIFFUSE),
    }
}
