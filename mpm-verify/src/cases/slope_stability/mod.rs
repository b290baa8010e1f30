//! The factor by which the strength of a slope can be divided before it fails.
//!
//! The section and the elasticity of the landslide with perfect plasticity: no softening, so that limit analysis says what
//! is right. Set-up, choices and tolerances: `docs/slope-stability.md`.

pub(super) mod foreign;
mod run;

use super::slope::{self, REMEDIES, ground::STABILITY};
use crate::cases::prelude::*;
use run::Trials;

const LEVELS: [Level; 3] = [Level::new("h0.4", 0.4), Level::new("h0.2", 0.2), Level::new("h0.1", 0.1)];
/// Excess over its limit up to which a slope may be called standing.
const SLOW: f64 = 0.005;
/// Cells (m) up to which standard quadratic splines no longer lock beyond what a band of cells explains.
const FINE: f64 = 0.2;
/// Ground with friction, in which c = 10 kPa.
const FRICTION: &str = "friction=20 strength=14142 poisson_ratio=0.3";

parameters! {
    struct Stability {
        young_modulus: f64 = slope::YOUNG_MODULUS;
        poisson_ratio: f64 = slope::POISSON_RATIO;
        strength: f64 = real("Pa", "40.82e3", 1.0, 1e12), "strength κ = ‖s‖, √2 times the undrained shear strength";
        friction: f64 = real("deg", "0", 0.0, 45.0), "angle of friction φ, and of dilation: Mohr and Coulomb's ground with the cohesion κ/√2";
        density: f64 = slope::DENSITY;
        height: f64 = slope::HEIGHT;
        crest: f64 = slope::CREST;
        face_angle: f64 = slope::FACE_ANGLE;
        floor: f64 = slope::FLOOR.with_default("5");
        most: f64 = real("-", "3", 1.1, 100.0), "largest factor that is tried";
        trials: i32 = whole("-", "8", 1, 20), "trials: the largest factor, then bisection";
        cfl: f64 = slope::CFL;
        wall: common::Wall = slope::WALL;
        ppc_per_direction: usize = slope::PPC_PER_DIRECTION;
        load_steps: i32 = common::LOAD_STEPS, "quasi-static: equal steps in which the weight is raised";
        tolerance: f64 = common::TOLERANCE.with_default("1e-8");
    }
}

metrics! { ALL:
    STRENGTH_REDUCTION_FACTOR = "strength_reduction_factor", "-", "middle of the factors between which the slope first fails; the largest tried, if it stands";
    FACTOR_ERROR = "factor_error", "-",
        "relative distance of that from the factor of limit analysis, which is known to half a per cent; none where the slope stands at the largest factor or has another angle than 45°";
    STANDS_AT = "stands_at", "-", "largest factor at which the slope stands";
    FAILS_AT = "fails_at", "-", "least factor at which it fails";
    MOVED_STANDING = "moved_standing", "m", "largest displacement since the reduction at the largest factor at which it stands";
    MASS = "mass", "kg/m", "mass of the ground";
    NEWTON_ITERATIONS = "newton_iterations", "-", "quasi-static: Newton's iterations of all trials";
}

pub(super) fn case() -> Case {
    Case::of::<2, Trials>("slope-stability", "Stability of the slope", ALL)
        .planned(plan())
        .described("The slope of the landslide, without softening, under its weight. Its strength is divided by factors between which it first fails, \
            found by bisection; limit analysis gives the factor. Standard MPM locks and stands where it should fail.")
        .reference("Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base at the level of the toe")
        .limit("Failure is a displacement of H/50 within 4 s: a slope within half a per cent of its limit is called standing.")
        .limit("A shear band is as wide as the cells and can't come nearer to the fixed base: the slope is too strong by about h/H.")
        .wanted("factor-of-safety", "factor of safety against limit analysis", "limit-load")
        .missed_by("locked")
        .checks(checks())
        .headline(STRENGTH_REDUCTION_FACTOR, "factor (–)", 1.0, 3)
        .headline(STANDS_AT, "stands at", 1.0, 3)
        .headline(FAILS_AT, "fails at", 1.0, 3)
        .headline(MOVED_STANDING, "moved, standing (mm)", 1e3, 1)
        .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
        .quantity(error(FACTOR_ERROR, "relative error of the factor").known_to(
        (STABILITY.2 - STABILITY.1) / (2.0 * STABILITY.0),
    ))
        .watched(&["factor", "moved"])
        .sketch(slope::sketch("5 m"))
        .cost(|spec| {
            let solver = if spec.scheme.rule().is_some() { 0.05 } else { 1.0 };
            solver * spec.level.h.powi(-3)
        })
        .tables(tables())
}

fn plan() -> Plan {
    let statics = implicit(&[RuleName::QuasiStatic], &[Gimp, Bspline2], &[RemedyName::None, FbarConsistent]);
    let all = pairs(&[Gimp, Bspline2], &REMEDIES);
    Plan::of(LEVELS)
        // Three trials of softer ground, whose steps are longer. The limit load does not depend on stiffness.
        .runs(Pr, "h0.4", &pairs(&[Gimp], &REMEDIES), "young_modulus=6.25e6 most=2 trials=3")
        .runs(Nightly, "h0.4", &all, "")
        .runs(Nightly, "h0.4 h0.2 h0.1", &pairs(&[Gimp, Bspline2], &[RemedyName::None, FbarConsistent]), FRICTION)
        .runs(Long, "h0.2 h0.1", &all, "")
        .runs(Pr, "h0.4", &statics[1..2], "most=2 trials=3 load_steps=2")
        .runs(Nightly, "h0.4 h0.2", &statics, "")
        .runs(Long, "h0.1", &statics, "")
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Stability>;
    let bound = |place: usize| move |c: &Run<Stability>| c.bounds().map_or(f64::NAN, |bounds| bounds[place]);
    let (lower, upper) = (bound(0), bound(1));
    vec![
        Check::truth("lower-bound", "all: factor of safety above the lower bound of limit analysis less half the last bracket")
            .when(|c| c.bounds().is_some())
            .unless(move |c| (lower(c) < 1.0).then(|| "the last bracket is too wide: the factor of the unreduced slope meets this bound".to_owned()))
            .above(STRENGTH_REDUCTION_FACTOR, lower)
            .because("lower bound of limit analysis: docs/exact.md"),
        Check::truth("limit-load", "factor between the bounds of limit analysis, the upper raised by h/H, within half the last bracket and 0.5 %")
            .unless(|c| c.bounds().is_none().then(|| "the bounds of limit analysis are those for 45°".to_owned()))
            .within(STRENGTH_REDUCTION_FACTOR, move |c| 0.5 * (lower(c) + upper(c)), move |c| 0.5 * (upper(c) - lower(c)))
            .because("limit analysis: docs/exact.md"),
        Check::known_limit("locked", "none with GIMP, or quadratic splines at h > 0.2 m, quasi-static from 0.2 m on: the slope stands above the upper limit of limit-load")
            .when(|c| c.bounds().is_some() && c.locks())
            .above(STANDS_AT, move |c| upper(c) - c.resolution())
            .because("standard MPM locks: Zhao et al. 2023, Figure 14"),
        Check::truth("factor-converges", "fbar-consistent: the factor approaches that of limit analysis from level to level, or stays within the uncertainty of both")
            .study(converges),
        Check::truth("solvers-agree", "fbar-consistent: quasi-static and explicit factors agree within half of both brackets and 0.5 %")
            .study(agrees),
    ]
}

/// Runs of fbar-consistent with the default parameters, or with friction, that came to their end.
fn ours(records: &[Record]) -> Vec<Run<'_, Stability>> {
    let planned = |r: &Record| r.is_default() || r.changes(FRICTION);
    let ours = |r: &Run<Stability>| r.remedy() == FbarConsistent && r.record.status == Status::Ok && planned(r.record);
    Run::all(records).filter(ours).collect()
}

/// Trials of equilibrium against those of motion.
fn agrees(records: &[Record]) -> Vec<Finding> {
    let ours = ours(records);
    let found = |r: &Run<Stability>| {
        let moving = ours.iter().find(|moving| {
            let same = moving.basis() == r.basis() && moving.level == r.level && moving.friction == r.friction;
            same && !moving.is_implicit()
        })?;
        let expected = moving.metric(STRENGTH_REDUCTION_FACTOR);
        let tolerance = r.resolution() + moving.resolution() + SLOW * expected;
        let why = format!("{} {}: the explicit run", r.scheme, r.level);
        let value = r.metric(STRENGTH_REDUCTION_FACTOR);
        Some(Finding::within(STRENGTH_REDUCTION_FACTOR, value, expected, tolerance, why))
    };
    ours.iter().filter(|r| r.is_implicit()).filter_map(found).collect()
}

/// Each level against the coarser one.
fn converges(records: &[Record]) -> Vec<Finding> {
    let ours = ours(records);
    let mut found = Vec::new();
    for (scheme, set) in crate::distinct(ours.iter().map(|r| (r.scheme, &r.record.set))) {
        let mut runs: Vec<_> = ours.iter().filter(|r| r.scheme == scheme && r.record.set == *set).collect();
        runs.sort_by(|a, b| b.h.total_cmp(&a.h));
        for pair in runs.windows(2) {
            let (coarse, fine) = (pair[0], pair[1]);
            let off = |r: &Run<Stability>| (r.metric(STRENGTH_REDUCTION_FACTOR) - r.limit()).abs();
            let known_to = fine.resolution() + fine.limits().map_or(0.0, |limits| limits[2] - limits[1]);
            let levels = format!("{scheme}: {} against {}", fine.level, coarse.level);
            found.push(Finding::at_most(STRENGTH_REDUCTION_FACTOR, off(fine), off(coarse).max(known_to), levels));
        }
    }
    found
}

fn tables() -> Vec<ResultTable> {
    let bounds = |r: &Record| {
        let [stands, fails] = [STANDS_AT, FAILS_AT].map(|at| r.metric(at));
        if !fails.is_finite() {
            return format!("stands at {stands}");
        }
        let factor = r.metric(STRENGTH_REDUCTION_FACTOR);
        format!("{factor:.3} ({stands:.3} … {fails:.3})")
    };
    let levels = [("h0.4", "h = 0.4 m"), ("h0.2", "0.2 m"), ("h0.1", "0.1 m")];
    let of = |name, which: fn(&Record) -> bool| {
        let of_level = levels.map(|(level, title)| Column::text(title, bounds).at(level));
        let seconds = |title: &str| Column::value(format!("CPU (s), {title}"), |r| r.time.cpu_s, SHORT);
        let cpu = levels.map(|(level, title)| seconds(title).at(level));
        ResultTable::new(name, which, &[SCHEME], of_level.into_iter().chain(cpu))
    };
    let is_main = |r: &Record| r.is_default() && is_flip(r) && r.level == "h0.2";
    vec![
        ResultTable::by_remedy("slope", &REMEDIES, is_main, |r| fixed(2).text(r.metric(STRENGTH_REDUCTION_FACTOR))),
        of("slope-stability", Record::is_default),
        of("slope-friction", |r| r.changes(FRICTION)),
    ]
}
