//! Checks of a scene's run: nothing is known of its answer, but that mass, momentum and energy are kept; and warnings.

use super::watch::{BOARD, ENERGY, MASS, MOMENTUM, VOLUME};
use crate::cases::prelude::*;
use crate::check::On;
use crate::verdict::Kind;

/// Relative tolerance of the mass: a sum of many terms rounds.
const ROUNDING: f64 = 1e-9;
/// |J − 1| of a nearly incompressible body that is warned about; and noise of the mean stress, over what the height of the
/// bodies weighs.
const VOLUME_WARNED: f64 = 0.1;
const NOISE_WARNED: f64 = 0.1;

/// Warnings that an engineer needs before reading stresses; `weight` (Pa) is that of the bodies' height.
fn warnings(r: &Record, weight: f64) -> Vec<Finding> {
    let (volume, noise) = (r.metric(VOLUME), r.metric(BOARD) / weight);
    let remedy = match r.remedy() {
        RemedyName::None => "a remedy such as fbar-consistent, or smaller cells",
        _ => "smaller cells, or a lower rate of loading",
    };
    let lock = if r.remedy() == RemedyName::None { "; without a remedy the body locks as well" } else { "" };
    let mut all = Vec::new();
    if volume > VOLUME_WARNED {
        all.push(Finding::not_applicable(
            VOLUME,
            format!(
                "WARNING: J of a nearly incompressible body is off one by up to {volume:.2}, and where it is the mean stress \
                 means nothing (jacobian of the particles); splashed and torn particles do that with cells of any size{lock}"
            ),
        ));
    }
    if noise > NOISE_WARNED && noise.is_finite() {
        all.push(Finding::not_applicable(
            BOARD,
            format!(
                "WARNING: the mean stress oscillates from cell to cell by {noise:.2} of what the height weighs: read \
                 mean_stress_averaged, and take {remedy}"
            ),
        ));
    }
    all
}

/// The checks of a run of bodies of a `mass` (kg), whose height weighs `weight` (Pa); why its momentum
/// and energy are not balanced, if they are not.
pub(super) fn checks(mass: f64, weight: f64, unbalanced: [Option<&'static str>; 2]) -> Vec<Check> {
    let watched = |name, statement, found: Box<dyn Fn(&Record) -> Finding + Send + Sync>| {
        let on = On::Run(Box::new(move |r: &Record| vec![found(r)]));
        Check { name, kind: Kind::Bookkeeping, statement, on }
    };
    let why = "particles carry their mass: a sum of it rounds";
    let kept = move |r: &Record| Finding::within(MASS, r.metric(MASS), mass, ROUNDING * mass, why);
    let at_most = |metric, unless, why| {
        move |r: &Record| match unless {
            None => Finding::at_most(metric, r.metric(metric), 1.0, why),
            Some(other) => Finding::not_applicable(metric, other),
        }
    };
    let [no_momentum, no_energy] = unbalanced;
    let momentum = at_most(MOMENTUM, no_momentum, "nodes hand on what they are given: sums round");
    let energy = at_most(ENERGY, no_energy, "a transfer with a lumped mass gives no energy");
    vec![
        watched("mass", "The mass stays what it was.", Box::new(kept)),
        watched("momentum", "Momentum is what loads gave and supports took.", Box::new(momentum)),
        watched("energy", "Kinetic energy is at most what loads gave and stresses and losses took.", Box::new(energy)),
        Check {
            name: "warning",
            kind: Kind::Truth,
            statement: "Nearly incompressible bodies keep their volume, and the mean stress does not oscillate: else a warning.",
            on: On::Run(Box::new(move |r: &Record| warnings(r, weight))),
        },
    ]
}
