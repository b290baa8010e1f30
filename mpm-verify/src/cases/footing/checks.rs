//! Checks of the strip footing. The tolerances are derived in `docs/footing.md`.

mod studies;

use super::geometry::{WIDTH, effective_width, mechanism_extent};
use super::metrics::{self as m, CURVE, MEAN_STRESSES};
use super::parameters::{
    BARRIER, CONTACT, DENSITY, DOMAIN_DEPTH, DOMAIN_WIDTH, PENETRATION, PENETRATION_RATE, RAMP,
    ROUGH, UNDRAINED_STRENGTH, YOUNG_MODULUS,
};
use super::reference::{EXACT, curve, elastic_slope, has_the_curve_of, mean_stress_at};
use crate::check::{Check, Finding, checks, judge, run, study};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};

/// Relative tolerance of the limit load against Prandtl's at h ≤ B/20, by the width that the footing acts with.
const PRANDTL: f64 = 0.01;
/// Relative tolerance against finite elements at h ≤ B/20.
const FEM: f64 = 0.02;
/// d ln slope / d ln width of an elastic footing: the elements' 10,430 at B/10, where they act 1.1 B wide, over the
/// 10,290 of vanishing ones.
const WIDTH_TO_SLOPE: f64 = 0.142;
/// The cell size (m) that resolves the footing: on coarser cells both grow with h.
const RESOLVED: f64 = 0.05;
/// Largest fall (relative) of a limit load per 10⁻³ of s/B, and largest growth; what grows faster is none.
const FLAT: (f64, f64) = (0.01, 0.005);
/// Largest relative difference of the forces on base and footing.
const INERTIA: f64 = 0.005;
/// Least relative excess of a locked load over Prandtl's, over the tolerance of one that isn't.
const LOCKED: f64 = 2.0;
/// Largest oscillation of a locking-free pressure, rms(σ_m − Πσ_m) / rms σ_m; least one of a locked pressure.
const BOARD: (f64, f64) = (0.2, 0.5);
/// Largest gradient of the mean normal stress (s_u/B) between the points where it is known: from 4.14 s_u under the
/// footing to 1.02 s_u beside it, half a width away.
const GRADIENT: f64 = 6.24;
/// Cells within which the end of the mechanism is seen.
const SMEARED: f64 = 2.0;
/// Penetration over B, over s_u/E, from which on the load of the finite elements is within ½ % of its limit on a
/// ground of 6B × 6B; a smaller one is stiffer and gets there sooner.
const PLASTIC: f64 = 18.5;
/// Largest penetration over B at which the ground has kept its shape.
const SMALL: f64 = 0.01;
/// The fastest rate (m/s) that halving proves slow enough, and Young's modulus over the density (m²/s²) of the ground that it
/// does so of: where waves are slower, so must the footing be.
const SLOW: f64 = 2e-3;
const STIFF: f64 = 1000.0;
/// Strength over Young's modulus and penetration beyond which nothing yields.
const ELASTIC: f64 = 10.0;

const UNKNOWN_WIDTH: &str =
    "how wide a footing acts through a barrier is not known beforehand: see contacts-agree";

pub(super) fn checks() -> Vec<Check> {
    checks! {
        bookkeeping "particle-count":
            "57,600 · (h/(B/20))⁻² particles at two per direction, four times as many at four: the paper's 230,400 at B/20"
            => run(|r| vec![particle_count(r)]);
        truth "elastic-slope":
            "all, of a strength beyond reach: d(q/s_u)/d(s/B) is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10"
            => run(|r| vec![slope(r)]);
        truth "quasi-static":
            "all with FLIP or in equilibrium, as all that follows but elastic-slope: the force on the base is that on the footing within 0.5 %, mean over the last quarter of the penetration (linear momentum)"
            => run(|r| {
                let metric = m::FORCE_IMBALANCE;
                vec![match why_shown_only(r) {
                    Some(why) => Finding::not_applicable(metric, why),
                    None => {
                        let why = "linear momentum of a body that is pressed slowly";
                        Finding::at_most(metric, r.metric(metric).abs(), INERTIA, why)
                    }
                }]
            });
        truth "prandtl":
            "fbar-rate, fbar-consistent: the limit load by the width that the footing acts with is 2 + π within 1 % at h ≤ B/20, within 2 % at B/10"
            => run(|r| match why_shown_only(r) {
                Some(why) => vec![Finding::not_applicable(m::NC_EFFECTIVE, why)],
                None => limit(r, m::NC_EFFECTIVE, prandtl),
            });
        truth "limit-load":
            "fbar-rate, fbar-consistent: the load grows by less than 0.5 % and falls by less than 1 % per 10⁻³ of s/B over the last quarter of the penetration"
            => run(|r| limit(r, m::PLATEAU_RISE, flatness));
        truth "smooth-pressure":
            "fbar-rate, fbar-consistent at h ≤ B/20: rms(σ_m − Πσ_m) below 0.2 rms σ_m"
            => run(|r| limit_alone(r, m::CHECKERBOARD_RATIO, smoothness));
        truth "mechanism":
            "fbar-rate, fbar-consistent: the surface rises out to 1.5 times the width that the footing acts with, once the width if it is smooth, within 2h"
            => run(|r| limit(r, m::MECHANISM_WIDTH, mechanism));
        truth "mean-stress":
            "fbar-rate, fbar-consistent: σ_m at five points is that of the finite elements of vanishing size within h |∇σ_m|"
            => run(|r| limit_alone(r, MEAN_STRESSES[0].0, mean_stress));
        truth "fem-plateau":
            "fbar-rate, fbar-consistent: the limit load by B is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10"
            => run(|r| limit(r, m::NC_B, plateau));
        truth "curve":
            "fbar-rate, fbar-consistent: q/s_u at the tabulated s/B is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10"
            => run(|r| limit_alone(r, CURVE[2].0, load_curve));
        known_limit "no-limit-load":
            "none: the load still grows by more than 0.5 % per 10⁻³ of s/B at the end"
            => run(|r| locked(r, Locks::Load, m::PLATEAU_RISE, FLAT.1));
        known_limit "locked":
            "none: the load by the width that the footing acts with exceeds 2 + π by twice the tolerance of prandtl"
            => run(|r| {
                let bound = (1.0 + LOCKED * PRANDTL * coarseness(r)) * EXACT;
                locked(r, Locks::Bearing, m::NC_EFFECTIVE, bound)
            });
        known_limit "checkerboard":
            "none with GIMP: rms(σ_m − Πσ_m) above 0.5 rms σ_m"
            => run(|r| match r.basis() {
                BasisName::Gimp => locked(r, Locks::Load, m::CHECKERBOARD_RATIO, BOARD.1),
                _ => Vec::new(),
            });
        truth "rate-independent":
            "fbar-consistent: the limit load changes by less than 0.5 % when the rate is halved"
            => study(studies::rate_independence);
        known_limit "rate-dependent":
            "fbar-recursive: the load changes by more than 0.5 % when the rate is halved"
            => study(studies::rate_dependence);
        truth "contacts-agree":
            "all: the load through the barrier is that of held nodes within 2h/B"
            => study(studies::contacts);
        truth "pressure-order":
            "fbar-rate, fbar-consistent with nodes on grid lines, over three levels: the error of the contact pressure by B falls with an order of 0.85 to 1.1 (the paper's Figure 9: slightly below one)"
            => study(studies::orders);
    }
}

/// By how much tolerances grow on coarse cells, whose errors are of first order.
fn coarseness(record: &Record) -> f64 {
    (record.discretisation.h / RESOLVED).max(1.0)
}

fn is_free_of_locking(record: &Record) -> bool {
    matches!(
        record.remedy(),
        RemedyName::FbarRate | RemedyName::FbarConsistent
    )
}

/// Why there is no limit load to compare with, if there is none.
fn why_no_limit(record: &Record) -> Option<String> {
    let number = |p| record.parameters.number(p);
    let ratio = number(UNDRAINED_STRENGTH) / number(YOUNG_MODULUS);
    let penetration = number(PENETRATION);
    if 0.75 * penetration < PLASTIC * ratio {
        Some(format!(
            "the ground is fully plastic from s/B = {PLASTIC} s_u/E = {} on only",
            PLASTIC * ratio
        ))
    } else if penetration > SMALL {
        Some(format!("beyond s/B = {SMALL} the ground changes its shape"))
    } else {
        None
    }
}

/// Why nothing is said of a run but that it is one: it is there to show how it rings, or resists.
fn why_shown_only(record: &Record) -> Option<String> {
    let number = |p| record.parameters.number(p);
    let (rate, moves) = (number(PENETRATION_RATE), record.scheme().rule().is_none());
    if rate > SLOW {
        Some(format!("pressed faster than {SLOW} m/s, the ground rings"))
    } else if let Some(why) = rings(record) {
        Some(why)
    } else if moves && number(PENETRATION) * WIDTH <= 0.5 * rate * number(RAMP) {
        Some("the footing still gets under way".to_owned())
    } else if ![TransferName::Flip, TransferName::None].contains(&record.transfer()) {
        Some("what this transfer takes from the motion every step resists the footing as a viscosity does".to_owned())
    } else {
        None
    }
}

/// Why a soft or heavy ground rings, if it does.
fn rings(record: &Record) -> Option<String> {
    let number = |p| record.parameters.number(p);
    let slowness = (STIFF * number(DENSITY) / number(YOUNG_MODULUS)).sqrt();
    let rings = record.scheme().rule().is_none()
        && slowness > 1.0
        && number(PENETRATION_RATE) * slowness > SLOW * (1.0 + f64::EPSILON);
    rings.then(|| format!("waves are {slowness:.1} times slower than in the ground of which {SLOW} m/s is known to be slow"))
}

fn is_elastic(record: &Record) -> bool {
    let number = |p| record.parameters.number(p);
    number(UNDRAINED_STRENGTH) > ELASTIC * number(PENETRATION) * number(YOUNG_MODULUS)
}

fn particle_count(record: &Record) -> Finding {
    const METRIC: &str = "particles";
    let number = |p| record.parameters.number(p);
    let own = number(DOMAIN_WIDTH) == 6.0 && number(DOMAIN_DEPTH) == 6.0;
    let per_cell = f64::from(record.discretisation.ppc);
    if !own || ![4.0, 16.0].contains(&per_cell) {
        let why = "counted for two or four particles per direction in a domain of 6B × 6B only";
        return Finding::not_applicable(METRIC, why);
    }
    let cells = 6.0 / record.discretisation.h;
    let count = (per_cell * cells * cells).round();
    let why = "Zhao et al. 2023, section 4.2: 230,400 at B/20 with 4 × 4; 57,600 with 2 × 2";
    Finding::within(METRIC, record.work.particles as f64, count, 0.0, why)
}

fn slope(record: &Record) -> Finding {
    const METRIC: Metric = m::ELASTIC_SLOPE;
    if !is_elastic(record) {
        let why = "the ground yields: see the runs of great strength";
        return Finding::not_applicable(METRIC, why);
    }
    if let Some(why) = rings(record) {
        return Finding::not_applicable(METRIC, why);
    }
    match elastic_slope(record) {
        Err(why) => Finding::not_applicable(METRIC, why),
        Ok(slope) => {
            let number = |p| record.parameters.number(p);
            let expected = slope * number(YOUNG_MODULUS) / number(UNDRAINED_STRENGTH);
            let tolerance = (FEM * coarseness(record) + soft_edge(record)) * expected;
            let why = "finite elements that act as wide";
            judge(record, METRIC).within(expected, tolerance, why)
        }
    }
}

/// By how much (relative) an elastic footing may be softer than one of its width. Splines are exactly rigid up to a cell
/// inside of its edge only. To a plastic jump of velocity that matters little, but elastic pressures peak at the edge.
fn soft_edge(record: &Record) -> f64 {
    match record.basis() {
        BasisName::Linear | BasisName::Gimp | BasisName::Q8 => 0.0,
        BasisName::Bspline2 | BasisName::Bspline3 => {
            WIDTH_TO_SLOPE * 2.0 * record.discretisation.h / WIDTH
        }
    }
}

/// What is said of standard MPM.
#[derive(PartialEq)]
enum Locks {
    /// Of its load or stress.
    Load,
    /// Of its bearing capacity, for which the others stand back.
    Bearing,
}

/// A known limit of standard MPM: it locks.
fn locked(record: &Record, what: Locks, metric: Metric, bound: f64) -> Vec<Finding> {
    let standard = record.remedy() == RemedyName::None && !is_elastic(record);
    if !standard || why_shown_only(record).is_some() {
        return Vec::new();
    }
    let through_barrier = record.parameters.is(CONTACT, BARRIER);
    let through_barrier = through_barrier.then(|| UNKNOWN_WIDTH.to_owned());
    if let Some(why) = why_no_limit(record).or(through_barrier) {
        let found = Finding::not_applicable(metric, why);
        return (what == Locks::Bearing)
            .then_some(found)
            .into_iter()
            .collect();
    }
    let why = "standard MPM locks: Zhao et al. 2023, Figure 8";
    vec![judge(record, metric).above(bound, why)]
}

/// What is found of a run that is to have a limit load; why it has none, if it hasn't.
fn limit(record: &Record, metric: Metric, found: fn(&Record) -> Vec<Finding>) -> Vec<Finding> {
    let judged = is_free_of_locking(record) && !is_elastic(record);
    if !judged || why_shown_only(record).is_some() {
        return Vec::new();
    }
    match why_no_limit(record) {
        Some(why) => vec![Finding::not_applicable(metric, why)],
        None => found(record),
    }
}

/// Likewise, where another check says why there is none.
fn limit_alone(
    record: &Record,
    metric: Metric,
    found: fn(&Record) -> Vec<Finding>,
) -> Vec<Finding> {
    match why_no_limit(record) {
        Some(_) => Vec::new(),
        None => limit(record, metric, found),
    }
}

/// The growth of the load, within its bounds.
fn flatness(record: &Record) -> Vec<Finding> {
    let (fall, growth) = FLAT;
    let (middle, half) = (0.5 * (growth - fall), 0.5 * (growth + fall));
    let why = "a perfectly plastic body has a limit load";
    // That of a load which is in proportion to the penetration.
    let elastic = 1e-3 / record.parameters.number(PENETRATION);
    let found = judge(record, m::PLATEAU_RISE).within(middle, half, why);
    vec![found.of_scale(elastic)]
}

/// How much of the pressure alternates from particle to particle.
fn smoothness(record: &Record) -> Vec<Finding> {
    const METRIC: Metric = m::CHECKERBOARD_RATIO;
    vec![if coarseness(record) > 1.0 {
        let why = "five cells under half of the footing don't resolve the pressure's edge";
        Finding::not_applicable(METRIC, why)
    } else {
        let why = "a pressure that is resolved is close to its average";
        judge(record, METRIC).at_most(BOARD.0, why)
    }]
}

/// The limit load by the width that the footing acts with.
fn prandtl(record: &Record) -> Vec<Finding> {
    const METRIC: Metric = m::NC_EFFECTIVE;
    if record.parameters.is(CONTACT, BARRIER) {
        return vec![Finding::not_applicable(METRIC, UNKNOWN_WIDTH)];
    }
    let (width, uncertainty) = effective_width(record.basis(), record.discretisation.h);
    let tolerance = (PRANDTL * coarseness(record) + uncertainty / width) * EXACT;
    vec![judge(record, METRIC).within(EXACT, tolerance, "Prandtl 1920")]
}

/// The mechanism by the width that the footing acts with.
fn mechanism(record: &Record) -> Vec<Finding> {
    const METRIC: Metric = m::MECHANISM_WIDTH;
    if record.parameters.is(CONTACT, BARRIER) {
        return vec![Finding::not_applicable(METRIC, UNKNOWN_WIDTH)];
    }
    let h = record.discretisation.h;
    let (width, uncertainty) = effective_width(record.basis(), h);
    let rough = record.parameters.boolean(ROUGH);
    let extent = mechanism_extent(rough) / WIDTH;
    let whose = if rough { "Prandtl's" } else { "Hill's" };
    vec![judge(record, METRIC).within(
        extent * width,
        SMEARED * h + extent * uncertainty,
        format!("{whose} mechanism; a jump of velocity is smeared over a cell on either side"),
    )]
}

fn mean_stress(record: &Record) -> Vec<Finding> {
    let why = if !record.parameters.boolean(ROUGH) {
        "the reference is that of a rough footing"
    } else if record.parameters.is(CONTACT, BARRIER) {
        UNKNOWN_WIDTH
    } else {
        let depth = record.parameters.number(DOMAIN_DEPTH);
        let found = MEAN_STRESSES.iter().filter_map(|(metric, point)| {
            if point[1] >= depth {
                let why = "this point lies on the base of so shallow a ground";
                return Some(Finding::not_applicable(*metric, why));
            }
            let known = mean_stress_at(*point)?;
            let tolerance = GRADIENT * record.discretisation.h + known.uncertainty;
            let why = "finite elements of vanishing size";
            let value = record.metric(*metric);
            Some(Finding::within(*metric, value, known.value, tolerance, why))
        });
        return found.collect();
    };
    vec![Finding::not_applicable(MEAN_STRESSES[0].0, why)]
}

/// The limit load against finite elements that act as wide.
fn plateau(record: &Record) -> Vec<Finding> {
    const METRIC: Metric = m::NC_B;
    vec![match curve(record) {
        Err(why) => Finding::not_applicable(METRIC, why),
        Ok(reference) => {
            let tolerance = FEM * coarseness(record) * reference.limit;
            let value = record.metric(METRIC);
            Finding::within(METRIC, value, reference.limit, tolerance, reference.name)
        }
    }]
}

/// The load on the way against finite elements that act as wide.
fn load_curve(record: &Record) -> Vec<Finding> {
    let known = curve(record).and_then(|c| has_the_curve_of(&record.parameters).map(|()| c));
    let reference = match known {
        Err(why) => return vec![Finding::not_applicable(CURVE[2].0, why)],
        Ok(reference) => reference,
    };
    let found = CURVE.iter().filter_map(|&(metric, penetration)| {
        let expected = reference.at(penetration)?;
        let value = record.metric(metric);
        if value.is_nan() {
            return Some(Finding::not_applicable(
                metric,
                "no row of the series is there",
            ));
        }
        let tolerance = FEM * coarseness(record) * expected;
        let name = reference.name.clone();
        Some(Finding::within(metric, value, expected, tolerance, name))
    });
    found.collect()
}

#[cfg(test)]
mod tests;
