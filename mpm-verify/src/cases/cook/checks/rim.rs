//! What a quasi-static body's rim does: functions that see hardly any material are soft where nothing holds them.
//!
//! The load stands a quarter of a cell from the side, and finite elements know what that takes off the deflection; a soft
//! rim adds about as much. Here each is judged by itself: `docs/cook.md`.

use super::super::parameters::{COLUMN, GHOST, LOAD_AT, LOAD_STEPS, PPC_PER_DIRECTION};
use super::super::reference::{LargeLoad, large_load, load_shift, solution};
use super::{EDGE_TOLERANCE, Measure, RESOLVED, is_established, is_explicit, is_free_of_locking, m};
use crate::check::Finding;
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};

/// Least ghost penalty, in shares of Young's modulus, that holds a rim: on smooth fields it errs by less than a thousandth
/// of itself, and a function needs less material than this share of a cell to be held more by it than by the material.
const HOLDS: f64 = 1e-3;
const MEASURES: [Measure; 3] = [Measure::MidEdge, Measure::EdgeMean, Measure::Tip];

/// Whether no function of the rim is soft: all are held, or GIMP takes its only step on the lattice, where domains end at
/// faces of cells and it is the method with linear functions.
fn is_held(r: &Record) -> bool {
    let on_lattice = r.basis() == BasisName::Gimp && r.parameters.number(LOAD_STEPS) == 1.0;
    on_lattice || r.parameters.number(GHOST) >= HOLDS
}

/// Whether the run is the one that is known to stall for its soft rim.
pub(super) fn stalls(r: &Record) -> bool {
    let splines = r.basis() == BasisName::Bspline2 && is_free_of_locking(r);
    splines && !is_explicit(r) && r.is_default() && r.level == "h0.25"
}

/// Whether the run is a quasi-static one whose place of the load finite elements know: two particles per direction.
fn is_judged_place(r: &Record) -> bool {
    let column = r.parameters.is(LOAD_AT, COLUMN);
    !is_explicit(r) && column && r.parameters.number(PPC_PER_DIRECTION) == 2.0
}

fn is_judged(r: &Record) -> bool {
    is_judged_place(r) && is_free_of_locking(r)
}

/// Whether a run falls short of the reference with the load on the side because its own load isn't there: what that takes
/// and the error of a locking-free element come to more than the tolerance.
pub(super) fn is_short(r: &Record, of: Measure) -> bool {
    let held = is_judged(r) && is_held(r) && r.basis() == BasisName::Gimp;
    let h = r.discretisation.h;
    let known = (load_shift(h), solution(&r.parameters));
    let (Some(shift), Ok(reference), true) = (known.0, known.1, held && h <= RESOLVED) else {
        return false;
    };
    of.shift(shift).abs() + of.element_error() * h * of.exact(reference) > of.tolerance(r, reference)
}

/// u_y (m) of the finite elements with the load on the particles' line, if it is known for the run.
fn in_place(r: &Record, of: Measure) -> Option<f64> {
    let reference = solution(&r.parameters).ok()?;
    // The shift is stored for one ratio.
    let shift = load_shift(r.discretisation.h).filter(|_| reference.poisson_ratio == 0.499)?;
    Some(of.exact(reference) + of.shift(shift))
}

/// The relative error of the mid-edge deflection; of a quasi-static run against the finite elements with the load where
/// its particles carry it, as far as they know it.
pub(in crate::cases::cook) fn mid_edge_error(r: &Record) -> f64 {
    let error = r.metric(m::FEM_MID_EDGE_ERROR);
    let known = (solution(&r.parameters), in_place(r, Measure::MidEdge));
    match known {
        (Ok(reference), Some(exact)) if is_judged_place(r) => {
            (1.0 + error) * Measure::MidEdge.exact(reference) / exact - 1.0
        }
        _ => error,
    }
}

/// The error that is to fall: with F̄ that of the load at its place. Without a remedy locking outweighs the rim on coarse cells
/// and the rim locking on fine ones, so that the error there passes through zero; it stays that of the load on the side.
pub(super) fn falling_error(r: &Record) -> f64 {
    if is_judged(r) { mid_edge_error(r) } else { r.metric(m::FEM_MID_EDGE_ERROR) }
}

pub(super) fn at_the_loads_place(r: &Record) -> Vec<Finding> {
    let h = r.discretisation.h;
    if !(is_judged(r) && is_held(r) && h <= RESOLVED) {
        return Vec::new();
    }
    let found = MEASURES.map(|of| match in_place(r, of) {
        None => Finding::not_applicable(of.metric(), "no reference with the load at this place"),
        Some(exact) => {
            let tolerance = of.fine_tolerance(h) * exact.abs();
            let why = "independent high-order FEM with the load on the same line of material";
            Finding::within(of.metric(), r.metric(of.metric()), exact, tolerance, why)
        }
    });
    found.to_vec()
}

pub(super) fn too_soft(r: &Record) -> Vec<Finding> {
    if !(is_judged(r) && is_established(r)) || is_held(r) {
        return Vec::new();
    }
    let excess = |of: Measure| {
        let exact = in_place(r, of)?;
        let bound = of.element_error() * r.discretisation.h * exact;
        let what = format!("excess of {}", of.metric().name);
        let why =
            "functions of the rim that see hardly any material bear hardly any load; the explicit case has them too";
        Some(Finding::above(what, r.metric(of.metric()) - exact, bound, why))
    };
    MEASURES.into_iter().filter_map(excess).collect()
}

pub(super) fn short_by_the_loads_place(r: &Record) -> Vec<Finding> {
    let shortfall = |of: Measure| {
        let reference = solution(&r.parameters).ok()?;
        let short = of.exact(reference) - r.metric(of.metric());
        let what = format!("shortfall of {}", of.metric().name);
        let why =
            "the load stands h/4 from the side, which by FEM takes off 1.1 % at h = 1 m; no soft rim makes up for it";
        Some(Finding::above(what, short, of.tolerance(r, reference), why))
    };
    // Of the tip the shortfall is the tolerance, more or less.
    let sides = [Measure::MidEdge, Measure::EdgeMean];
    let short = sides.into_iter().filter(|of| is_short(r, *of));
    short.filter_map(shortfall).collect()
}

/// The finite elements under the run's own large load, where its particles carry it.
fn under_large_load(r: &Record) -> Option<&'static LargeLoad> {
    let held = is_judged_place(r) && r.parameters.number(GHOST) >= HOLDS;
    large_load(&r.parameters, 0.25 * r.discretisation.h).filter(|_| held)
}

/// A deflection under a large load: the metric, the run's and the reference's (m), and the tolerance (m).
fn deflections(r: &Record) -> Vec<(Metric, f64, f64, f64)> {
    let Some(exact) = under_large_load(r) else {
        return Vec::new();
    };
    let both = [(m::MID_EDGE_UY, exact.mid_edge_uy), (m::EDGE_MEAN_UY, exact.edge_mean_uy)];
    let tolerance = |exact: f64| EDGE_TOLERANCE * r.discretisation.h * exact;
    let of = |(metric, exact): (Metric, f64)| (metric, r.metric(metric), exact, tolerance(exact));
    let with_uncertainty =
        |(metric, value, reference, tolerance)| (metric, value, reference, tolerance + exact.uncertainty);
    both.map(of).map(with_uncertainty).to_vec()
}

pub(super) fn follows_large_loads(r: &Record) -> Vec<Finding> {
    let found = deflections(r).into_iter().map(|(metric, value, exact, tolerance)| {
        if r.remedy() != RemedyName::None {
            let why = "F-bar is softer by about the tolerance: at some loads within it, at others not";
            return Finding::not_applicable(metric, why);
        }
        let why = "finite elements of degree 4 under the same load on the same line, this project";
        Finding::within(metric, value, exact, tolerance, why)
    });
    found.collect()
}
