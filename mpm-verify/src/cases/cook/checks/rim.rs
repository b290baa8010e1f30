//! What a quasi-static body's rim does: functions that see hardly any material are soft where nothing holds them.
//!
//! The load stands a quarter of a cell from the side, and finite elements know what that takes off the deflection; a soft
//! rim adds about as much. Here each is judged by itself: `docs/cook.md`.

use super::super::parameters::{COLUMN, GHOST, LOAD_AT, LOAD_STEPS, PPC_PER_DIRECTION};
use super::super::reference::{load_shift, solution};
use super::{
    EDGE_TOLERANCE, ELEMENT_ERROR, Measure, RESOLVED, is_established, is_explicit,
    is_free_of_locking,
};
use crate::check::Finding;
use crate::record::Record;
use crate::scheme::BasisName;

/// Least ghost penalty, in shares of Young's modulus, that holds a rim: on smooth fields it errs by less than a thousandth
/// of itself, and a function needs less material than this share of a cell to be held more by it than by the material.
const HOLDS: f64 = 1e-3;
const MEASURES: [Measure; 2] = [Measure::MidEdge, Measure::EdgeMean];

/// Whether no function of the rim is soft: all are held, or GIMP takes its only step on the lattice, where domains end at
/// faces of cells and it is the method with linear functions.
fn is_held(r: &Record) -> bool {
    let on_lattice = r.basis() == BasisName::Gimp && r.parameters.number(LOAD_STEPS) == 1.0;
    on_lattice || r.parameters.number(GHOST) >= HOLDS
}

/// Whether the case is the one of which finite elements know the load's place: two particles per direction.
fn is_judged(r: &Record) -> bool {
    let placed = r.parameters.is(LOAD_AT, COLUMN) && r.parameters.number(PPC_PER_DIRECTION) == 2.0;
    !is_explicit(r) && is_free_of_locking(r) && placed
}

/// Whether a run falls short of the reference with the load on the side because its own load isn't there.
pub(super) fn is_short(r: &Record) -> bool {
    is_judged(r) && is_held(r) && is_established(r) && r.basis() == BasisName::Gimp
}

/// u_y (m) of the finite elements with the load on the particles' line, if it is known for the run.
fn in_place(r: &Record, of: Measure) -> Option<f64> {
    let reference = solution(&r.parameters).ok()?;
    // The shift is stored for one ratio.
    let shift = load_shift(r.discretisation.h).filter(|_| reference.poisson_ratio == 0.499)?;
    Some(of.exact(reference) + of.shift(shift))
}

pub(super) fn at_the_loads_place(r: &Record) -> Vec<Finding> {
    let h = r.discretisation.h;
    if !(is_judged(r) && is_held(r) && h <= RESOLVED) {
        return Vec::new();
    }
    let found = MEASURES.map(|of| match in_place(r, of) {
        None => Finding::not_applicable(of.metric(), "no reference with the load at this place"),
        Some(exact) => {
            let tolerance = EDGE_TOLERANCE * h * exact.abs();
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
        let bound = ELEMENT_ERROR.0 * r.discretisation.h * exact;
        let what = format!("excess of {}", of.metric().name);
        let why = "functions of the rim that see hardly any material bear hardly any load; the explicit case has them too";
        Some(Finding::above(
            what,
            r.metric(of.metric()) - exact,
            bound,
            why,
        ))
    };
    MEASURES.into_iter().filter_map(excess).collect()
}

pub(super) fn short_by_the_loads_place(r: &Record) -> Vec<Finding> {
    if !is_short(r) {
        return Vec::new();
    }
    let shortfall = |of: Measure| {
        let reference = solution(&r.parameters).ok()?;
        let short = of.exact(reference) - r.metric(of.metric());
        let what = format!("shortfall of {}", of.metric().name);
        let why = "the load stands h/4 from the side, which by FEM takes off 1.1 % at h = 1 m; no soft rim makes up for it";
        Some(Finding::above(what, short, of.tolerance(r, reference), why))
    };
    MEASURES.into_iter().filter_map(shortfall).collect()
}
