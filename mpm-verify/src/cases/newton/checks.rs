//! What is checked of the column. The bounds are derived in `docs/newton.md`.

use super::metrics as m;
use super::parameters::{LOAD_STEPS, STANDS, SUPPORT};
use crate::check::{Check, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};

/// The tolerance of Newton's method, with a share for what rounds.
const CONVERGED: f64 = 1e-7;
/// What more than the exact column a column of cells may bear.
const STIFFER: f64 = 0.02;
/// Bounds by which an equilibrium of moved particles is off at least.
const MOVED: f64 = 3.0;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "never-wrong",
            "in one step that was not cut, and standing without a remedy but with linear functions: the last equilibrium that was found is the exact one, within h² times the greatest slope of the stretch",
            run(|r| {
                let why = "there is one below the greatest load that the law goes on from; another is far away";
                let smooth = r.basis() != BasisName::Linear && r.remedy() == RemedyName::None;
                let judged = is_whole(r) || stands(r) && smooth;
                (judged && has(r, m::EQUILIBRIUM_ERROR))
                    .then(|| judge(r, m::EQUILIBRIUM_ERROR).at_most(r.metric(m::BOUND), why))
            }),
        ),
        Check::truth(
            "no-more-than-there-is",
            "hanging beyond what can be borne: no equilibrium is found beyond it, within a fiftieth for the cells",
            run(|r| {
                let why = "ln λ/λ is at most 1/e";
                let bearable = r.metric(m::BEARABLE);
                (bearable < 1.0)
                    .then(|| judge(r, m::CARRIED).at_most(bearable * (1.0 + STIFFER), why))
            }),
        ),
        Check::truth(
            "weight",
            "what holds the column carries its weight, to what Newton's method leaves",
            run(|r| {
                let why = "equilibrium of the whole body";
                has(r, m::REACTION_ERROR).then(|| {
                    judge(r, m::REACTION_ERROR)
                        .within(0.0, CONVERGED, why)
                        .of_scale(1.0)
                })
            }),
        ),
        Check::truth(
            "gap",
            "standing: the lowest particles are at the gap at which the barrier carries the weight, to what Newton's method leaves",
            run(|r| {
                let why = "every column of particles is alike, and the barrier's force has one gap";
                has(r, m::GAP_ERROR).then(|| {
                    judge(r, m::GAP_ERROR)
                        .within(0.0, CONVERGED, why)
                        .of_scale(1.0)
                })
            }),
        ),
        Check::known_limit(
            "moved-quadrature",
            "linear functions, hanging, in more than one part: the equilibrium is one of the moved particles, off by more than three times the bound",
            run(|r| {
                let why = "slopes that jump where particles cross grid lines: whole cells lose their stress, and tear";
                let moved = !stands(r) && !is_whole(r) && r.basis() == BasisName::Linear;
                (moved && has(r, m::EQUILIBRIUM_ERROR))
                    .then(|| judge(r, m::EQUILIBRIUM_ERROR).above(MOVED * r.metric(m::BOUND), why))
            }),
        ),
        Check::known_limit(
            "hair-cut",
            "GIMP, hanging, a hundred steps and more: no equilibrium is found beyond half of the load",
            run(|r| {
                let why = "a node that sees a hair of the free end makes the stiffness singular; nothing is stabilised";
                let small = r.parameters.number(LOAD_STEPS) >= 100.0;
                let own = small && !stands(r) && r.basis() == BasisName::Gimp;
                own.then(|| judge(r, m::CARRIED).at_most(0.5, why))
            }),
        ),
    ]
}

/// Whether the load came in one step that was not cut, on functions that have not moved.
fn is_whole(r: &Record) -> bool {
    r.parameters.number(LOAD_STEPS) == 1.0 && r.metric(m::PARTS) == 1.0
}

fn stands(r: &Record) -> bool {
    r.parameters.is(SUPPORT, STANDS)
}

fn has(r: &Record, metric: crate::metric::Metric) -> bool {
    r.metric(metric).is_finite()
}
