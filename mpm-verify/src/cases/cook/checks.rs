//! Checks of Cook's membrane. The tolerances are derived in `docs/cook.md`.

mod own;
pub(super) mod rim;
mod studies;

use super::metrics::{self as m, MEAN_STRESSES};
use super::parameters::{COLUMN, LOAD, LOAD_AT, LOAD_STEPS, POISSON_RATIO, PPC_PER_DIRECTION};
use super::reference::{Field, LoadShift, Solution, load_shift, solution, stress_scale};
use super::watch::CREEP;
use crate::check::{Check, Finding, checks, judge, run, study};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};

pub(super) use own::own_runs;

/// Relative tolerance of mid-edge and edge mean at h ≤ 1 m, per metre of cell size.
const EDGE_TOLERANCE: f64 = 0.01;
/// Relative tolerance of the tip at h ≤ 1 m.
const TIP_TOLERANCE: f64 = 0.02;
/// Error of a locking-free bilinear element, per metre of cell size: mid-edge and tip (%/100).
const ELEMENT_ERROR: (f64, f64) = (0.0045, 0.0074);
/// Largest oscillation of a locking-free pressure, rms(σ_m − Πσ_m) / rms σ_m.
const SMOOTH: f64 = 0.2;
/// Least oscillation of a locked one.
const LOCKED: f64 = 0.5;
/// Coarsest cell (m) that resolves the field well enough for the two.
const RESOLVED: f64 = 1.0;
/// Least R² of linear growth.
const LINEAR: f64 = 0.95;
/// Largest relative gain of energy.
const GAIN: f64 = 1e-3;
/// Relative tolerance of the clamp's reaction.
const REACTION: f64 = 0.02;
/// Newton iterations of a load step that quadratic convergence takes at most.
const MOST_ITERATIONS: f64 = 7.0;
/// Coarsest cell (m), on which XPIC(2) creeps longest.
const COARSEST: f64 = 2.0;
/// Poisson's ratios for which F̄ is meant and its tolerances are stated.
const NEARLY_INCOMPRESSIBLE: (f64, f64) = (0.49, 0.499);
/// The probe (m) that is two cells of 1 m away from the free lower side.
const NEAR_FREE_SIDE: [f64; 2] = [24.0, 24.0];
/// Particles at two per direction, by cell size.
const COUNTS: [(f64, f64); 4] = [(2.0, 1448.0), (1.0, 5776.0), (0.5, 23_072.0), (0.25, 92_224.0)];

const DIFFUSES: &str = "Π is no projection: Eq. (26) averages the average and so diffuses J̄";
const COMPRESSIBLE: &str = "F̄ is meant for ν ≥ 0.49: see too-soft-when-compressible";

pub(super) fn checks() -> Vec<Check> {
    checks! {
        bookkeeping "particle-count":
            "1,448, 5,776, 23,072 and 92,224 particles at h = 2, 1, ½ and ¼ with two per direction; the second and third are the paper's"
            => run(|r| vec![particle_count(r)]);
        truth "no-energy-gain":
            "all: kinetic energy + stress work + losses exceeds the load's work by no more than 0.1 % of it (the oscillation of symplectic Euler at CFL 0.3)"
            => run(|r| {
                let why = "energy balance; symplectic Euler oscillates by ½ Δt times the power";
                is_explicit(r).then(|| judge(r, m::ENERGY_GAIN).at_most(GAIN, why))
            });
        known_limit "never-at-rest":
            "fbar-recursive: rest is not reached within a period, by which the others are there"
            => run(|r| {
                let found = judge(r, m::AT_REST).at_most(0.0, DIFFUSES);
                is_recursive(r).then_some(found)
            });
        known_limit "creep":
            "fbar-recursive: rms ln(J/J̄) grows by more than 1e-4 per period"
            => run(|r| creeps(r, m::CREEP_RATE, CREEP / r.metric(m::PERIOD)));
        known_limit "creep-is-linear":
            "fbar-recursive: that growth is a straight line in time, R² above 0.95"
            => run(|r| creeps(r, m::CREEP_LINEARITY, LINEAR));
        truth "at-rest":
            "none, fbar-total, fbar-rate, fbar-consistent: rest is reached in the time given"
            => run(|r| {
                let why = "a statically loaded elastic body has an equilibrium";
                let found = judge(r, m::AT_REST).within(1.0, 0.0, why);
                (is_explicit(r) && !is_recursive(r) && !rests_late(r)).then_some(found)
            });
        known_limit "rests-late":
            "none, fbar-consistent with XPIC(2) and quadratic splines at h = 2 m: rest is not reached within two periods (within three it is)"
            => run(|r| {
                let why = "what XPIC filters from the velocity in every step creeps";
                let found = judge(r, m::AT_REST).at_most(0.0, why);
                (!is_recursive(r) && rests_late(r))
                    .then_some(found)
            });
        truth "reaction":
            "none, fbar-total, fbar-rate, fbar-consistent: at rest the clamp's reaction balances the load within 2 % (linear momentum)"
            => run(|r| {
                let load = r.parameters.number(LOAD);
                let (metric, tolerance) = (m::REACTION_UY, REACTION * load.abs());
                let found = judge(r, metric).within(-load, tolerance, "linear momentum at rest");
                (!is_recursive(r)).then_some(found)
            });
        truth "static-reaction":
            "quasi-static: the clamp's reaction balances the load to a hundred times the tolerance of Newton's method"
            => run(|r| {
                let why = "equilibrium";
                (!is_explicit(r)).then(|| judge(r, m::REACTION_ERROR).at_most(1e-7, why))
            });
        truth "newton":
            "quasi-static: at most seven Newton iterations a step, as four squarings lead from a tenth to the tolerance, and three more lead there; left out where rim-stalls is judged"
            => run(|r| {
                let why = "quadratic convergence with the exact tangent";
                let judged = !is_explicit(r) && !rim::stalls(r);
                judged.then(|| judge(r, m::NEWTON_ITERATIONS).at_most(most_iterations(r), why))
            });
        known_limit "rim-stalls":
            "quasi-static fbar-consistent with quadratic splines and the rim left to itself, in four steps at h = ¼ m: more than seven Newton iterations a step"
            => run(|r| {
                let why = "of functions that see hardly any material the line search finds the equilibrium slowly; a ghost penalty of 10⁻⁶ is enough against it";
                let found = judge(r, m::NEWTON_ITERATIONS).above(most_iterations(r), why);
                rim::stalls(r).then_some(found)
            });
        known_limit "locked":
            "none with GIMP: rms(σ_m − Πσ_m) above 0.5 rms σ_m"
            => run(|r| {
                let (metric, why) = (
                    m::CHECKERBOARD_RATIO,
                    "standard MPM locks: Zhao et al. 2023, Figure 3",
                );
                let found = judge(r, metric).above(LOCKED, why);
                let gimp = r.remedy() == RemedyName::None && r.basis() == BasisName::Gimp;
                let locks = gimp && r.parameters.number(POISSON_RATIO) >= NEARLY_INCOMPRESSIBLE.0;
                locks.then_some(found)
            });
        truth "mid-edge":
            "fbar-total, fbar-rate, fbar-consistent: u_y at (48, 52) m within 1 % · h/(1 m) of the FEM reference; above h = 1 m, within what the place of the load explains plus the error of a locking-free element"
            => run(|r| displacement(r, Measure::MidEdge));
        truth "edge-mean":
            "fbar-total, fbar-rate, fbar-consistent: mean u_y of the right side, likewise"
            => run(|r| displacement(r, Measure::EdgeMean));
        truth "load-at-its-place":
            "quasi-static fbar-consistent with the functions of the rim held by a ghost penalty of 0.001 or more, or GIMP's one step on the lattice, at h ≤ 1 m: mid-edge and mean u_y of the right side within 1 % · h/(1 m), the tip within 2 %, of the FEM solution with the load on the same line of material"
            => run(rim::at_the_loads_place);
        known_limit "soft-rim":
            "quasi-static fbar-consistent with the rim left to itself, with GIMP in more than one step, at h = 1 m: mid-edge, mean and tip u_y of the right side exceed that FEM solution by more than the error of a locking-free element"
            => run(rim::too_soft);
        known_limit "short-by-the-loads-place":
            "quasi-static fbar-consistent with GIMP and a rim that is held, or in one step on the lattice, at h ≤ 1 m: mid-edge and mean u_y of the right side fall short of the FEM solution with the load on the side by more than the tolerance, where the load's place and the error of a locking-free element take more than that; mid-edge, edge-mean and tip are not judged there"
            => run(rim::short_by_the_loads_place);
        truth "large-loads":
            "quasi-static none, rim held, under 10 to 50 N at h = 1 m: mid-edge and mean u_y of the right side within 1 % of the FEM solution with the load on the same line of material"
            => run(rim::follows_large_loads);
        truth "tip":
            "fbar-total, fbar-rate, fbar-consistent: u_y at (48, 60) m within 2 % of the FEM reference; above h = 1 m as for mid-edge"
            => run(|r| displacement(r, Measure::Tip));
        known_limit "too-stiff-with-more-particles":
            "fbar-total, fbar-rate, fbar-consistent with GIMP and more than two particles per direction: mid-edge and mean u_y of the right side fall short by more than the tolerances of mid-edge and edge-mean; these and tip are not judged there"
            => run(|r| {
                let measures = [Measure::MidEdge, Measure::EdgeMean];
                let found = measures.into_iter().filter_map(|m| shortfall(r, m));
                found.collect::<Vec<_>>()
            });
        truth "mean-stress-probe":
            "fbar-total, fbar-rate, fbar-consistent: σ_m at seven points within h |∇σ_m| of the FEM reference"
            => run(|r| at_probes(r, false));
        known_limit "pressure-near-free-side":
            "fbar-total, fbar-rate, fbar-consistent with GIMP at ν > 0.499 and h = 1: σ_m at (24, 24) m, two cells from the free side, is off by more than h |∇σ_m|; mean-stress-probe is not judged there"
            => run(|r| at_probes(r, true));
        truth "mean-stress-rms":
            "fbar-total, fbar-rate, fbar-consistent: rms of σ_m − reference at most √((h rms|∇σ_m|)² + (0.2 rms σ_m)²)"
            => run(|r| {
                is_free_of_locking(r).then(|| mean_stress_rms(r))
            });
        truth "smooth-pressure":
            "fbar-total, fbar-rate, fbar-consistent at h ≤ 1: rms(σ_m − Πσ_m) below 0.2 rms σ_m"
            => run(|r| {
                let (metric, value) = (m::CHECKERBOARD_RATIO, r.metric(m::CHECKERBOARD_RATIO));
                if !is_free_of_locking(r) || (is_beyond(r) && is_established(r)) {
                    return Vec::new();
                }
                vec![if is_beyond(r) {
                    let why = "beyond ν = 0.499 only noisy-pressure is judged, at h = 1 m";
                    Finding::not_applicable(metric, why)
                } else if r.discretisation.h <= RESOLVED {
                    let why = "a locking-free pressure is smooth on the scale of a cell";
                    Finding::at_most(metric, value, SMOOTH, why)
                } else {
                    let why =
                        "cells above 1 m don't resolve the field: Π changes the exact field too";
                    Finding::not_applicable(metric, why)
                }]
            });
        known_limit "noisy-pressure":
            "fbar-total, fbar-rate, fbar-consistent at ν > 0.499 and h = 1: rms(σ_m − Πσ_m) above 0.2 rms σ_m; smooth-pressure is not judged there"
            => run(|r| {
                let why = "the oscillation that Π leaves grows with the bulk modulus";
                let value = r.metric(m::CHECKERBOARD_RATIO);
                let found = Finding::above(m::CHECKERBOARD_RATIO, value, SMOOTH, why);
                let noisy = is_free_of_locking(r) && is_beyond(r) && is_established(r);
                noisy.then_some(found)
            });
        known_limit "too-soft-when-compressible":
            "fbar-total, fbar-rate, fbar-consistent at ν < 0.49 and h = 1: mid-edge u_y exceeds the reference by more than 1 % · h/(1 m): averaging a pressure that needs none softens; mid-edge, edge-mean and no-creep are not judged there"
            => run(|r| {
                let (metric, bound) = (m::FEM_MID_EDGE_ERROR, EDGE_TOLERANCE * r.discretisation.h);
                let why = "averaging a pressure that needs none softens";
                let found = judge(r, metric).above(bound, why);
                let known = is_established(r) && solution(&r.parameters).is_ok();
                let soft = is_free_of_locking(r) && is_compressible(r) && known;
                soft.then_some(found)
            });
        truth "no-creep":
            "fbar-total, fbar-rate, fbar-consistent: rms ln(J/J̄) changes by less than 1e-4 per period"
            => run(|r| {
                if !is_explicit(r) || !is_free_of_locking(r) {
                    return Vec::new();
                }
                vec![if is_compressible(r) {
                    Finding::not_applicable(m::CREEP_RATE, COMPRESSIBLE)
                } else {
                    let (rate, bound) =
                        (r.metric(m::CREEP_RATE).abs(), CREEP / r.metric(m::PERIOD));
                    Finding::at_most(m::CREEP_RATE, rate, bound, "an equilibrium does not move")
                }]
            });
        known_limit "creep-grows-as-dt-falls":
            "fbar-recursive: with half the time step it is at least 1.3 times as fast (diffusion: 2 in the bulk, √2 from a boundary)"
            => study(studies::creep_over_steps);
        truth "error-falls":
            "none, fbar-total, fbar-rate, fbar-consistent: |error| of mid-edge u_y falls from level to level, or stays below 0.2 %, which rest does not resolve; of quasi-static F̄ against the FEM solution with the load where the particles carry it"
            => study(studies::error_falls);
    }
}

fn is_free_of_locking(r: &Record) -> bool {
    matches!(r.remedy(), RemedyName::FbarTotal | RemedyName::FbarRate | RemedyName::FbarConsistent)
}

/// Whether a run has inertia, and comes to rest or doesn't.
fn is_explicit(r: &Record) -> bool {
    matches!(r.scheme(), Scheme::Explicit(_))
}

/// Newton iterations that quadratic convergence takes at most.
fn most_iterations(r: &Record) -> f64 {
    MOST_ITERATIONS * r.parameters.number(LOAD_STEPS)
}

fn is_recursive(r: &Record) -> bool {
    r.remedy() == RemedyName::FbarRecursive
}

/// Whether the body is too compressible for F̄.
fn is_compressible(r: &Record) -> bool {
    r.parameters.number(POISSON_RATIO) < NEARLY_INCOMPRESSIBLE.0
}

/// Whether the body is less compressible than F̄'s tolerances are stated for.
fn is_beyond(r: &Record) -> bool {
    r.parameters.number(POISSON_RATIO) > NEARLY_INCOMPRESSIBLE.1
}

/// Whether the cells are those on which the known limits were established; they are judged there only.
fn is_established(r: &Record) -> bool {
    r.discretisation.h == RESOLVED
}

/// Whether two periods are known not to be enough.
fn rests_late(r: &Record) -> bool {
    let filtered = r.transfer() == TransferName::Xpic2 && r.basis() == BasisName::Bspline2;
    filtered && r.discretisation.h == COARSEST
}

fn creeps(r: &Record, metric: Metric, bound: f64) -> Option<Finding> {
    let found = judge(r, metric).above(bound, DIFFUSES);
    is_recursive(r).then_some(found)
}

fn particle_count(r: &Record) -> Finding {
    let h = r.discretisation.h;
    match COUNTS.iter().find(|(size, _)| *size == h) {
        Some((_, count)) if r.discretisation.ppc == 4 => Finding::within(
            "particles",
            r.work.particles as f64,
            *count,
            0.0,
            "Zhao et al. 2023, section 4.1 (h = 1 and ½); the same rule elsewhere",
        ),
        _ => {
            let why = "counted for two particles per direction only";
            Finding::not_applicable("particles", why)
        }
    }
}

/// A displacement that the reference knows.
#[derive(Clone, Copy, PartialEq)]
enum Measure {
    MidEdge,
    EdgeMean,
    Tip,
}

impl Measure {
    fn metric(self) -> Metric {
        match self {
            Self::MidEdge => m::MID_EDGE_UY,
            Self::EdgeMean => m::EDGE_MEAN_UY,
            Self::Tip => m::TIP_UY,
        }
    }

    fn exact(self, reference: &Solution) -> f64 {
        match self {
            Self::MidEdge => reference.mid_edge.uy,
            Self::EdgeMean => reference.edge_mean_uy,
            Self::Tip => reference.tip.uy,
        }
    }

    fn shift(self, shift: &LoadShift) -> f64 {
        match self {
            Self::MidEdge => shift.mid_edge_uy_change,
            Self::EdgeMean => shift.edge_mean_uy_change,
            Self::Tip => shift.tip_uy_change,
        }
    }

    /// Relative tolerance on cells of at most a metre.
    fn fine_tolerance(self, h: f64) -> f64 {
        match self {
            Self::Tip => TIP_TOLERANCE,
            _ => EDGE_TOLERANCE * h,
        }
    }

    /// Relative error of a locking-free bilinear element, per metre of cell size.
    fn element_error(self) -> f64 {
        match self {
            Self::Tip => ELEMENT_ERROR.1,
            _ => ELEMENT_ERROR.0,
        }
    }

    /// How far (m) a run may be from the reference.
    fn tolerance(self, r: &Record, reference: &Solution) -> f64 {
        let h = r.discretisation.h;
        let exact = self.exact(reference);
        let relative = if h > RESOLVED {
            // The stored shift is for a load at h/4 from the side, two particles per direction.
            let inset =
                if r.parameters.is(LOAD_AT, COLUMN) { 2.0 / r.parameters.number(PPC_PER_DIRECTION) } else { 0.0 };
            let moved = load_shift(h).map_or(0.0, |s| inset * self.shift(s).abs());
            moved / exact + self.element_error() * h
        } else {
            self.fine_tolerance(h)
        };
        relative * exact.abs() + reference.uncertainty_displacement
    }
}

fn source(reference: &Solution) -> String {
    format!(
        "independent high-order FEM, this project, ν = {}, ± {:.0e} m",
        reference.poisson_ratio, reference.uncertainty_displacement
    )
}

/// A displacement against the reference.
fn displacement(r: &Record, of: Measure) -> Vec<Finding> {
    if !is_free_of_locking(r) {
        return Vec::new();
    }
    let metric = of.metric();
    if is_compressible(r) && of != Measure::Tip {
        return vec![Finding::not_applicable(metric, COMPRESSIBLE)];
    }
    let reference = match solution(&r.parameters) {
        Err(why) => return vec![Finding::not_applicable(metric, why)],
        Ok(reference) => reference,
    };
    if rim::is_short(r, of) {
        let why = "see short-by-the-loads-place";
        return vec![Finding::not_applicable(metric, why)];
    }
    if is_too_stiff(r) {
        let found = Finding::not_applicable(metric, "see too-stiff-with-more-particles");
        return (of == Measure::Tip).then_some(found).into_iter().collect();
    }
    let (exact, tolerance) = (of.exact(reference), of.tolerance(r, reference));
    let value = r.metric(metric);
    vec![Finding::within(metric, value, exact, tolerance, source(reference))]
}

/// By how much a displacement falls short of the reference, where a body is known to be too stiff.
fn shortfall(r: &Record, of: Measure) -> Option<Finding> {
    let known = is_free_of_locking(r) && is_too_stiff(r);
    let reference = solution(&r.parameters).ok().filter(|_| known)?;
    let metric = of.metric();
    Some(Finding::above(
        format!("shortfall of {}", metric.name),
        of.exact(reference) - r.metric(metric),
        of.tolerance(r, reference),
        "with two per direction the soft boundary of a GIMP body makes up for the load's place and its stiffness; with more it doesn't",
    ))
}

/// Whether the body has so many particles that it is known to be too stiff.
fn is_too_stiff(r: &Record) -> bool {
    r.basis() == BasisName::Gimp && r.parameters.number(PPC_PER_DIRECTION) > 2.0
}

/// The mean stress at the probes: at those where it is known to be off, or at all others.
fn at_probes(r: &Record, known_to_be_off: bool) -> Vec<Finding> {
    if !is_free_of_locking(r) {
        return Vec::new();
    }
    let reference = match solution(&r.parameters) {
        Err(why) => {
            let found = Finding::not_applicable(MEAN_STRESSES[0].0, why);
            return (!known_to_be_off).then_some(found).into_iter().collect();
        }
        Ok(reference) => reference,
    };
    let scale = stress_scale(&r.parameters);
    let found = MEAN_STRESSES.iter().filter_map(|&(metric, point)| {
        let known = reference.mean_stress_at(point)?;
        let gradient = Field::stored().gradient(point, 1.0).unwrap_or(0.0);
        let (value, exact) = (r.metric(metric), scale * known.value);
        let h = r.discretisation.h;
        let tolerance = scale * (h * gradient + reference.uncertainty_mean_stress);
        match (is_off_near_free_side(r, point), known_to_be_off) {
            (true, true) => Some(Finding::above(
                format!("|error| of {}", metric.name),
                (value - exact).abs(),
                tolerance,
                "the oscillation that Π leaves grows with the bulk modulus, most of all at a free side",
            )),
            (false, false) => {
                let why = format!("{}; tolerance: the point moved by a cell", source(reference));
                Some(Finding::within(metric, value, exact, tolerance, why))
            }
            _ => None,
        }
    });
    found.collect()
}

/// Where the pressure of GIMP with F̄ is known to be off by more than a cell would explain.
fn is_off_near_free_side(r: &Record, point: [f64; 2]) -> bool {
    let gimp = r.basis() == BasisName::Gimp;
    gimp && is_established(r) && is_beyond(r) && point == NEAR_FREE_SIDE
}

fn mean_stress_rms(r: &Record) -> Finding {
    const METRIC: Metric = m::MEAN_STRESS_RMS_ERROR;
    let reference = match solution(&r.parameters) {
        Err(why) => return Finding::not_applicable(METRIC, why),
        Ok(reference) => reference,
    };
    if reference.poisson_ratio != 0.499 {
        let why = "the reference field is stored for ν = 0.499";
        return Finding::not_applicable(METRIC, why);
    }
    let (gradient, stress) = Field::stored().rms_of_gradient_and_value();
    let moved = r.discretisation.h * gradient;
    let bound = stress_scale(&r.parameters) * moved.hypot(SMOOTH * stress);
    let what = "every point moved by a cell, and the oscillation that smooth-pressure admits";
    let why = format!("{}; {what}", source(reference));
    judge(r, METRIC).at_most(bound, why)
}
