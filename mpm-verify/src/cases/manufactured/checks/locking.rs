//! Locking: runs that differ in Poisson's ratio alone.

use super::{Gate, is_beyond_unseen, is_sound};
use crate::cases::manufactured::metrics::DISPLACEMENT_L2;
use crate::cases::parameters::POISSON_RATIO;
use crate::cases::prelude::*;

/// Largest error at a Poisson's ratio over that at 0.3 that counts as free of locking, and the least
/// that counts as locked.
const LOCKING_FREE: f64 = 1.2;
const LOCKED: f64 = 1.5;
/// Poisson's ratio that locking is measured against.
const COMPRESSIBLE: f64 = 0.3;

/// Errors over the distance from incompressibility.
pub(in crate::cases) const LOCKING_CURVE: Sweep = Sweep::of(POISSON_RATIO, "0.5 − ν").over(|nu| 0.5 - nu).logarithmic();

pub(in crate::cases) fn locking() -> [Check; 2] {
    [
        Gate::truth("no-locking", "F̄ except fbar-recursive, not linear, up to 1 − 2ν = ε²: rms error of u at most 1.2 times that at ν = 0.3")
            .when(|r| r.number(POISSON_RATIO) != COMPRESSIBLE)
            .when(|r| is_sound(r.remedy()) && r.basis() != Linear && !is_beyond_unseen(r))
            .pairs(is_soft_twin, |r, _| about(r), factor)
            .at_most(|_| LOCKING_FREE)
            .because("the exact motion does not depend on ν; both runs take the same steps"),
        Gate::known_limit("locks", "none, linear functions and GIMP, ν ≥ 0.499, coarsest level: rms error of u above 1.5 times that at ν = 0.3")
            .study(|records| {
                let runs: Vec<Run<()>> = Run::all(records).collect();
                let coarsest = runs.iter().map(|r| r.h).fold(0.0, f64::max);
                let locks = |r: &&Run<()>| {
                    r.remedy() == RemedyName::None
                        && matches!(r.basis(), Linear | Gimp)
                        && r.number(POISSON_RATIO) >= 0.499
                        && r.h == coarsest
                };
                let found = runs.iter().filter(locks).filter_map(|r| {
                    let soft = runs.iter().find(|soft| is_soft_twin(r, soft))?;
                    let why = "more constraints on the volume than nodes to meet them";
                    Some(Finding::above(about(r), factor(r, soft), LOCKED, why))
                });
                found.collect()
            }),
    ]
}

/// Whether two runs differ in Poisson's ratio alone, the second at [`COMPRESSIBLE`].
fn is_soft_twin(stiff: &Run<()>, soft: &Run<()>) -> bool {
    soft.number(POISSON_RATIO) == COMPRESSIBLE && same_but(POISSON_RATIO.name, stiff, soft)
}

fn factor(stiff: &Run<()>, soft: &Run<()>) -> f64 {
    stiff.metric(DISPLACEMENT_L2) / soft.metric(DISPLACEMENT_L2)
}

fn about(r: &Run<()>) -> String {
    let (metric, scheme, level) = (DISPLACEMENT_L2.name, r.scheme, &r.level);
    format!("{metric} of {scheme} {level} at ν = {} over ν = 0.3", r.number(POISSON_RATIO))
}
