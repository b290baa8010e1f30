//! What is checked of the cantilever.

use super::metrics::{
    CORNER_ERROR, CORNER_UY, FORCE_RATIO, FORCE_ROUNDING, LOG10_CONDITION, MASS, NEWTON_ITERATIONS,
    REACTION_ERROR, STRESS_ERROR, STRESSES,
};
use super::parameters::{
    EXTENSION, GHOST, JAUMANN_LINEAR, LAW, LOAD_STEPS, NONE, POINTS_PER_DIRECTION, STABILISATION,
    TOLERANCE,
};
use super::reference::{solution, stresses};
use super::watch::VOLUME;
use crate::check::{Check, Finding, run, study};
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::BasisName;

/// Largest relative error of the corner's u_y with quadratic splines, by level: the discretisation error that has been
/// asked for, half of it from one level to the next.
const ERRORS: [(&str, f64); 4] = [
    ("h0.1", 6e-3),
    ("h0.05", 2.5e-3),
    ("h0.025", 1e-3),
    ("h0.0125", 5e-4),
];
/// Condition at which a matrix in double precision says nothing any more.
const BOUND: f64 = 12.0;
/// Relative error that serendipity elements have at every level: more than three times what splines may have on the
/// coarsest cells.
const DIVERGED: f64 = 0.02;

/// What a converged step may leave, over the loads.
fn residual(r: &Record) -> f64 {
    let rounding = r.metric(FORCE_ROUNDING);
    r.parameters.number(TOLERANCE).max(rounding)
}

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::bookkeeping(
            "mass",
            "the mass of a metre of beam, 300 kg, to rounding",
            run(|r| {
                let exact = 1000.0 * VOLUME;
                let why = "density times the volume of the beam";
                vec![Finding::within(
                    MASS,
                    r.metric(MASS),
                    exact,
                    1e-9 * exact,
                    why,
                )]
            }),
        ),
        Check::truth(
            "reaction",
            "the clamp bears the weight, as far as the residual of Newton's method allows",
            run(|r| {
                // At a stabilised node on the clamp the penalty bears its share.
                let bound = 10.0 * residual(r);
                let why =
                    "equilibrium: the residual is at most the tolerance of the loads, or rounding";
                let metric = REACTION_ERROR;
                let unstable = r.parameters.is(STABILISATION, NONE);
                let found = Finding::at_most(metric, r.metric(metric), bound, why);
                (!unstable).then_some(found)
            }),
        ),
        Check::truth(
            "force-ratio",
            "the out-of-balance force ratio of every step, the paper's Eq. (37), is at most the tolerance, or what rounding of the stresses leaves",
            run(|r| {
                let bound = residual(r);
                let why = "the criterion of convergence";
                Some(Finding::at_most(
                    FORCE_RATIO,
                    r.metric(FORCE_RATIO),
                    bound,
                    why,
                ))
            }),
        ),
        Check::truth(
            "newton",
            "stabilised runs of ten steps or more: at most seven Newton iterations a step, as four squarings lead from a tenth to the tolerance, and three more lead there",
            run(|r| {
                let steps = r.parameters.number(LOAD_STEPS);
                let why = "quadratic convergence with the exact tangent";
                let found = Finding::at_most(
                    NEWTON_ITERATIONS,
                    r.metric(NEWTON_ITERATIONS),
                    7.0 * steps,
                    why,
                );
                (steps >= 10.0 && !r.parameters.is(STABILISATION, NONE)).then_some(found)
            }),
        ),
        Check::truth(
            "corner",
            "quadratic splines, ghost penalty or extension, 16 particles a cell: u_y of the corner within 0.6, 0.25, 0.1 and 0.05 % of the finite elements at h = 0.1, 0.05, 0.025 and 0.0125 m",
            run(|r| is_splines(r).then(|| corner(r))),
        ),
        Check::truth(
            "stress",
            "likewise: σ_xx at six points near the clamp within h |∇σ_xx| of the finite elements",
            run(|r| if is_splines(r) { stress(r) } else { Vec::new() }),
        ),
        Check::truth(
            "falls",
            "likewise: the errors of u_y and of these stresses fall from level to level",
            study(falls),
        ),
        Check::truth(
            "steps",
            "likewise at h = 0.05 m: 5 to 160 load steps change u_y of the corner by less than its error",
            study(steps),
        ),
        Check::known_limit(
            "q8-diverges",
            "serendipity elements: the error is above 2 % at every level and no smaller at the finest than at the coarsest",
            study(diverges),
        ),
        Check::known_limit(
            "no-stabilisation",
            "without stabilisation and run to its end: the condition of the scaled stiffness is beyond 10¹²",
            run(|r| {
                let why = "functions at the rim see fewer strains than they have unknowns";
                let metric = LOG10_CONDITION;
                let found = Finding::above(metric, r.metric(metric), BOUND, why);
                let unstable = r.parameters.is(STABILISATION, NONE);
                unstable.then_some(found)
            }),
        ),
        Check::known_limit(
            "linear-update",
            "jaumann-linear, quadratic splines: the error at 10 load steps is more than 1.5 times that at 20, which is more than 1.5 times that at 40: of first order",
            study(linear_update),
        ),
    ]
}

/// Quadratic splines with a ghost penalty or the extension and 16 particles a cell.
fn is_splines(r: &Record) -> bool {
    r.basis() == BasisName::Bspline2
        && [GHOST, EXTENSION]
            .iter()
            .any(|s| r.parameters.is(STABILISATION, s))
        && r.parameters.number(POINTS_PER_DIRECTION) == 4.0
        && !r.parameters.is(LAW, JAUMANN_LINEAR)
}

fn corner(r: &Record) -> Finding {
    let truth = match solution(&r.parameters) {
        Ok(truth) => truth,
        Err(why) => return Finding::not_applicable(CORNER_UY, why),
    };
    let known = ERRORS.iter().find(|(level, _)| *level == r.level);
    let Some((_, error)) = known else {
        return Finding::not_applicable(CORNER_UY, "no error is asked for at this level");
    };
    let [_, exact] = truth.bottom_right;
    let tolerance = error * exact.abs() + truth.uncertainty;
    let why = "finite elements of high order; their uncertainty and the error asked for at this cell size";
    Finding::within(CORNER_UY, r.metric(CORNER_UY), exact, tolerance, why)
}

/// σ_xx at points near the clamp; the tolerance moves the point by a cell.
fn stress(r: &Record) -> Vec<Finding> {
    let known = match stresses(&r.parameters) {
        Ok(known) => known,
        Err(why) => return vec![Finding::not_applicable(STRESS_ERROR, why)],
    };
    let found = STRESSES.iter().filter_map(|&(metric, at)| {
        let exact = known.at(at)?;
        let tolerance = r.discretisation.h * exact.gradient + known.uncertainty_stress;
        let why = "finite elements of degree 5, this project; tolerance: the point moved by a cell";
        Some(Finding::within(
            metric,
            r.metric(metric),
            exact.value,
            tolerance,
            why,
        ))
    });
    found.collect()
}

/// Of runs that have ended, in the order of the plan.
fn ended(records: &[Record]) -> impl Iterator<Item = &Record> {
    records.iter().filter(|r| r.status == Status::Ok)
}

fn falls(records: &[Record]) -> Vec<Finding> {
    let stabilised = |by: &str| {
        let own = |r: &&Record| {
            is_splines(r)
                && r.parameters.is(STABILISATION, by)
                && r.changes_none_but(&[STABILISATION.name])
        };
        let mut own: Vec<&Record> = ended(records).filter(own).collect();
        own.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
        let fall = |metric: Metric, pair: &[&Record]| {
            let (coarse, fine) = (pair[0].metric(metric), pair[1].metric(metric));
            let what = format!(
                "{by}: {} at {} over that at {}",
                metric.name, pair[1].level, pair[0].level
            );
            Finding::at_most(what, fine / coarse, 1.0, "convergence under refinement")
        };
        let both = [CORNER_ERROR, STRESS_ERROR];
        let pairs = own.windows(2);
        let found = pairs.flat_map(|pair| both.map(|metric| fall(metric, pair)));
        found.collect::<Vec<_>>()
    };
    [GHOST, EXTENSION]
        .into_iter()
        .flat_map(stabilised)
        .collect()
}

fn steps(records: &[Record]) -> Vec<Finding> {
    let at = |steps: f64| {
        ended(records).find(|r| {
            let only = r.changes_none_but(&[LOAD_STEPS.name]);
            only && is_splines(r) && r.level == "h0.05" && r.parameters.number(LOAD_STEPS) == steps
        })
    };
    let (Some(few), Some(own), Some(many)) = (at(5.0), at(20.0), at(160.0)) else {
        return Vec::new();
    };
    let change = (few.metric(CORNER_UY) - many.metric(CORNER_UY)).abs();
    let error = own.metric(CORNER_ERROR) * own.metric(CORNER_UY).abs();
    let why = "the path doesn't matter to an elastic law; only the grid is reset more often";
    vec![Finding::at_most(
        "change of corner_uy (m) by 5 to 160 steps",
        change,
        error,
        why,
    )]
}

fn diverges(records: &[Record]) -> Vec<Finding> {
    let of_q8 = |r: &&Record| r.basis() == BasisName::Q8 && r.set == ["stabilisation=soft"];
    let mut own: Vec<&Record> = ended(records).filter(of_q8).collect();
    own.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
    let why = "functions of serendipity elements have kinks at all faces, which particles cross: integration errs by a share that cells don't lessen";
    let error = |r: &&Record| {
        let what = format!("corner_error at {}", r.level);
        Finding::above(what, r.metric(CORNER_ERROR), DIVERGED, why)
    };
    let mut found: Vec<Finding> = own.iter().map(error).collect();
    if let [coarsest, .., finest] = own[..] {
        let ratio = finest.metric(CORNER_ERROR) / coarsest.metric(CORNER_ERROR);
        found.push(Finding::above(
            "error at the finest over that at the coarsest",
            ratio,
            1.0,
            why,
        ));
    }
    found
}

fn linear_update(records: &[Record]) -> Vec<Finding> {
    let at = |steps: f64| {
        ended(records).find(|r| {
            r.parameters.is(LAW, JAUMANN_LINEAR)
                && r.basis() == BasisName::Bspline2
                && r.level == "h0.05"
                && r.parameters.number(LOAD_STEPS) == steps
        })
    };
    let errors = [10.0, 20.0, 40.0].map(|steps| at(steps).map(|r| r.metric(CORNER_ERROR)));
    let [Some(ten), Some(twenty), Some(forty)] = errors else {
        return Vec::new();
    };
    let why = "the paper's Eqs. (9) and (10) are linear in the step";
    vec![
        Finding::above("error at 10 steps over that at 20", ten / twenty, 1.5, why),
        Finding::above(
            "error at 20 steps over that at 40",
            twenty / forty,
            1.5,
            why,
        ),
    ]
}
