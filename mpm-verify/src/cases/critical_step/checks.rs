//! What is checked of the largest step. The bounds are derived in `docs/critical-step.md`.

use super::metrics::{CRITICAL_CFL, FED_CFL, OFFERED_CFL, PREDICTED_CFL};
use super::parameters::{CUT_WORD, LAYOUT, LINEAR_VISCOSITY, STRETCH};
use crate::check::{Check, judge, run};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};

/// What bisection and the growth that noise needs to be seen make of a CFL number, relative to it.
const SEEN: f64 = 0.02;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "largest-step",
            "the largest stable step is that of linear analysis within 2 %, what ten halvings and the growth of noise over the steps leave open; above 0.98 where that is beyond what the program takes",
            run(|r| {
                let predicted = r.metric(PREDICTED_CFL);
                let judged = predicted > 0.0 && !is_small_cut(r);
                judged.then(|| {
                    let why = "Jury's conditions of the matrices of docs/modes.md, over the waves of the lattice";
                    let found = judge(r, CRITICAL_CFL);
                    if predicted > 1.0 {
                        found.above(1.0 - SEEN, why)
                    } else {
                        found.within(predicted, SEEN * predicted, why)
                    }
                })
            }),
        ),
        Check::truth(
            "offered-step",
            "aligned, jittered and cut, without a stretch and a viscosity, all but linear functions: the step that time_step=auto takes is stable",
            run(|r| {
                let offered = r.metric(OFFERED_CFL);
                let p = &r.parameters;
                let at_rest = p.number(STRETCH) == 1.0 && p.number(LINEAR_VISCOSITY) == 0.0;
                let why = "the stiffness of a particle over its share of the nodes' masses bounds that of all";
                (at_rest && offered.is_finite())
                    .then(|| judge(r, CRITICAL_CFL).above(offered * (1.0 - 0.5 * SEEN), why))
            }),
        ),
        Check::known_limit(
            "small-cut",
            "linear functions with FLIP and no remedy, cut: the largest step is that of a node of its own, √(4ε/(2 − ε)), within 2 % and ε, and vanishes with ε",
            run(|r| {
                let predicted = r.metric(PREDICTED_CFL);
                let cut = r.parameters.number(super::parameters::CUT);
                let own = r.transfer() == TransferName::Flip && r.remedy() == RemedyName::None;
                let why = "the force on a node falls with the slope of its function, its mass with the function";
                (is_small_cut(r) && own).then(|| {
                    judge(r, CRITICAL_CFL).within(predicted, (SEEN + cut) * predicted, why)
                })
            }),
        ),
        Check::known_limit(
            "fed-by-mean-stress",
            "where a mean stress gives a wave a negative stiffness it grows whatever the step, as fast as linear analysis says or faster",
            run(|r| {
                let fed = r.metric(FED_CFL);
                let why = "docs/modes.md: where Π sees no change of volume, a mean stress is all the stiffness there is";
                fed.is_finite()
                    .then(|| judge(r, CRITICAL_CFL).at_most(fed * (1.0 + SEEN), why))
            }),
        ),
    ]
}

fn is_small_cut(r: &Record) -> bool {
    r.basis() == BasisName::Linear && r.parameters.is(LAYOUT, CUT_WORD)
}
