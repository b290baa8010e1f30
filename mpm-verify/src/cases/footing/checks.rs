//! Verdicts on the strip footing. The tolerances are derived in `docs/footing.md`.

use super::reference::{CURVE, EXACT, curve, elastic_slope, has_the_curve_of, mean_stresses};
use super::simulation::{WIDTH, effective_width, mechanism_extent};
use crate::case::{CheckInfo, check};
use crate::order::fit_order;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use crate::verdict::{Kind, Verdict};

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
/// Largest relative change of the limit load when the rate is halved.
const RATE: f64 = 0.005;
/// Least relative excess of a locked load over Prandtl's, over the tolerance of one that isn't.
const LOCKED: f64 = 2.0;
/// Largest oscillation of a locking-free pressure, rms(σ_m − Πσ_m) / rms σ_m; least one of a locked pressure.
const BOARD: (f64, f64) = (0.2, 0.5);
/// Largest gradient of the mean normal stress (s_u/B) between the points where it is known: from 4.14 s_u under the
/// footing to 1.02 s_u beside it, half a width away.
const GRADIENT: f64 = 6.24;
/// Cells within which the end of the mechanism is seen.
const SMEARED: f64 = 2.0;
/// The order of the contact pressure's error: of its leading part, the width of the footing, less how the
/// elements' own error lowers it.
const ORDER: (f64, f64) = (0.85, 1.1);
/// Penetration over B, over s_u/E, from which on the load of the finite elements is within ½ % of its limit on a
/// ground of 6B × 6B; a smaller one is stiffer and gets there sooner.
const PLASTIC: f64 = 18.5;
/// Largest penetration over B at which the ground has kept its shape.
const SMALL: f64 = 0.01;
/// The fastest rate (m/s) that halving proves slow enough.
const SLOW: f64 = 2e-3;
/// Strength over Young's modulus and penetration beyond which nothing yields.
const ELASTIC: f64 = 10.0;

const UNKNOWN_WIDTH: &str =
    "how wide a footing acts through a barrier is not known beforehand: see contacts-agree";

pub(super) const CHECKS: &[CheckInfo] = &[
    check(
        "particle-count",
        Kind::Bookkeeping,
        "57,600 · (h/(B/20))⁻² particles at two per direction, four times as many at four: the paper's 230,400 at B/20",
    ),
    check(
        "quasi-static",
        Kind::Truth,
        "all with FLIP, as all that follows but elastic-slope: the force on the base is that on the footing within 0.5 %, mean over the last quarter of the penetration (linear momentum)",
    ),
    check(
        "prandtl",
        Kind::Truth,
        "fbar-rate, fbar-consistent: the limit load by the width that the footing acts with is 2 + π within 1 % at h ≤ B/20, within 2 % at B/10",
    ),
    check(
        "fem-plateau",
        Kind::Truth,
        "fbar-rate, fbar-consistent: the limit load by B is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10",
    ),
    check(
        "curve",
        Kind::Truth,
        "fbar-rate, fbar-consistent: q/s_u at the tabulated s/B is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10",
    ),
    check(
        "limit-load",
        Kind::Truth,
        "fbar-rate, fbar-consistent: the load grows by less than 0.5 % and falls by less than 1 % per 10⁻³ of s/B over the last quarter of the penetration",
    ),
    check(
        "mechanism",
        Kind::Truth,
        "fbar-rate, fbar-consistent: the surface rises out to 1.5 times the width that the footing acts with, once the width if it is smooth, within 2h",
    ),
    check(
        "mean-stress",
        Kind::Truth,
        "fbar-rate, fbar-consistent: σ_m at five points is that of the finite elements of vanishing size within h |∇σ_m|",
    ),
    check(
        "smooth-pressure",
        Kind::Truth,
        "fbar-rate, fbar-consistent at h ≤ B/20: rms(σ_m − Πσ_m) below 0.2 rms σ_m",
    ),
    check(
        "elastic-slope",
        Kind::Truth,
        "all, of a strength beyond reach: d(q/s_u)/d(s/B) is that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10",
    ),
    check(
        "no-limit-load",
        Kind::KnownLimit,
        "none: the load still grows by more than 0.5 % per 10⁻³ of s/B at the end",
    ),
    check(
        "locked",
        Kind::KnownLimit,
        "none: the load by the width that the footing acts with exceeds 2 + π by twice the tolerance of prandtl",
    ),
    check(
        "checkerboard",
        Kind::KnownLimit,
        "none with GIMP: rms(σ_m − Πσ_m) above 0.5 rms σ_m",
    ),
    check(
        "rate-independent",
        Kind::Truth,
        "fbar-consistent: the limit load changes by less than 0.5 % when the rate is halved",
    ),
    check(
        "rate-dependent",
        Kind::KnownLimit,
        "fbar-recursive: the load changes by more than 0.5 % when the rate is halved",
    ),
    check(
        "contacts-agree",
        Kind::Truth,
        "all: the load through the barrier is that of held nodes within 2h/B",
    ),
    check(
        "pressure-order",
        Kind::Truth,
        "fbar-rate, fbar-consistent with nodes on grid lines, over three levels: the error of the contact pressure by B falls with an order of 0.85 to 1.1 (the paper's Figure 9: slightly below one)",
    ),
];

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
    let number = |name| record.parameters.number(name);
    let ratio = number("undrained_strength") / number("young_modulus");
    let penetration = number("penetration");
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
    let rate = record.parameters.number("penetration_rate");
    if rate > SLOW {
        Some(format!("pressed faster than {SLOW} m/s, the ground rings"))
    } else if record.transfer() != TransferName::Flip {
        Some("what this transfer takes from the motion every step resists the footing as a viscosity does".to_owned())
    } else {
        None
    }
}

fn is_elastic(record: &Record) -> bool {
    let number = |name| record.parameters.number(name);
    number("undrained_strength") > ELASTIC * number("penetration") * number("young_modulus")
}

pub(super) fn judge(record: &Record) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    count(record, &mut verdicts);
    slope(record, &mut verdicts);
    if let Some(why) = why_shown_only(record) {
        for (name, metric) in [
            ("quasi-static", "force_imbalance"),
            ("prandtl", "nc_effective"),
        ] {
            verdicts.push(Verdict::not_applicable(name, metric, why.clone()));
        }
        return verdicts;
    }
    let imbalance = record.metric("force_imbalance");
    verdicts.push(Verdict::at_most(
        "quasi-static",
        Kind::Truth,
        "force_imbalance",
        imbalance.abs(),
        INERTIA,
        "linear momentum of a body that is pressed slowly",
    ));
    match record.remedy() {
        RemedyName::None => locked(record, &mut verdicts),
        _ if is_free_of_locking(record) => limit(record, &mut verdicts),
        _ => {}
    }
    verdicts
}

fn count(record: &Record, verdicts: &mut Vec<Verdict>) {
    let number = |name| record.parameters.number(name);
    let own = number("domain_width") == 6.0 && number("domain_depth") == 6.0;
    let per_cell = f64::from(record.discretisation.ppc);
    let cells = 6.0 / record.discretisation.h;
    let counted = if own && [4.0, 16.0].contains(&per_cell) {
        Verdict::close(
            "particle-count",
            "particles",
            record.work.particles as f64,
            (per_cell * cells * cells).round(),
            0.0,
            "Zhao et al. 2022, section 4.2: 230,400 at B/20 with 4 × 4; 57,600 with 2 × 2",
        )
    } else {
        Verdict::not_applicable(
            "particle-count",
            "particles",
            "counted for two or four particles per direction in a domain of 6B × 6B only",
        )
    };
    verdicts.push(counted.bookkeeping());
}

fn slope(record: &Record, verdicts: &mut Vec<Verdict>) {
    let not_applicable =
        |why: String| Verdict::not_applicable("elastic-slope", "elastic_slope", why);
    verdicts.push(if !is_elastic(record) {
        not_applicable("the ground yields: see the runs of great strength".to_owned())
    } else {
        match elastic_slope(record) {
            Err(why) => not_applicable(why),
            Ok(slope) => {
                let number = |name| record.parameters.number(name);
                let expected = slope * number("young_modulus") / number("undrained_strength");
                Verdict::close(
                    "elastic-slope",
                    "elastic_slope",
                    record.metric("elastic_slope"),
                    expected,
                    (FEM * coarseness(record) + soft_edge(record)) * expected,
                    "finite elements that act as wide",
                )
            }
        }
    });
}

/// By how much (relative) an elastic footing may be softer than one of its width. Splines are exactly rigid up to a cell
/// inside of its edge only. To a plastic jump of velocity that matters little, but elastic pressures peak at the edge.
fn soft_edge(record: &Record) -> f64 {
    match record.basis() {
        BasisName::Linear | BasisName::Gimp => 0.0,
        BasisName::Bspline2 | BasisName::Bspline3 => {
            WIDTH_TO_SLOPE * 2.0 * record.discretisation.h / WIDTH
        }
    }
}

fn locked(record: &Record, verdicts: &mut Vec<Verdict>) {
    if is_elastic(record) {
        return;
    }
    let why = "standard MPM locks: Zhao et al. 2022, Figure 8";
    let through_barrier = record.parameters.is("contact", "barrier");
    let through_barrier = through_barrier.then(|| UNKNOWN_WIDTH.to_owned());
    if let Some(why) = why_no_limit(record).or(through_barrier) {
        verdicts.push(Verdict::not_applicable("locked", "nc_effective", why));
        return;
    }
    let limit = |name, metric: &str, bound| {
        Verdict::above(
            name,
            Kind::KnownLimit,
            metric,
            record.metric(metric),
            bound,
            why,
        )
    };
    verdicts.push(limit("no-limit-load", "plateau_rise", FLAT.1));
    verdicts.push(limit(
        "locked",
        "nc_effective",
        (1.0 + LOCKED * PRANDTL * coarseness(record)) * EXACT,
    ));
    if record.basis() == BasisName::Gimp {
        verdicts.push(limit("checkerboard", "checkerboard_ratio", BOARD.1));
    }
}

fn limit(record: &Record, verdicts: &mut Vec<Verdict>) {
    if is_elastic(record) {
        return;
    }
    if let Some(why) = why_no_limit(record) {
        for (name, metric) in [
            ("prandtl", "nc_effective"),
            ("fem-plateau", "nc_b"),
            ("limit-load", "plateau_rise"),
            ("mechanism", "mechanism_width"),
        ] {
            verdicts.push(Verdict::not_applicable(name, metric, why.clone()));
        }
        return;
    }
    let (fall, growth) = FLAT;
    verdicts.push(Verdict::close(
        "limit-load",
        "plateau_rise",
        record.metric("plateau_rise"),
        0.5 * (growth - fall),
        0.5 * (growth + fall),
        "a perfectly plastic body has a limit load",
    ));
    verdicts.push(if coarseness(record) > 1.0 {
        Verdict::not_applicable(
            "smooth-pressure",
            "checkerboard_ratio",
            "five cells under half of the footing don't resolve the pressure's edge",
        )
    } else {
        Verdict::at_most(
            "smooth-pressure",
            Kind::Truth,
            "checkerboard_ratio",
            record.metric("checkerboard_ratio"),
            BOARD.0,
            "a pressure that is resolved is close to its average",
        )
    });
    prandtl(record, verdicts);
    mean_stress(record, verdicts);
    against_elements(record, verdicts);
}

/// Limit load and mechanism by the width that the footing acts with.
fn prandtl(record: &Record, verdicts: &mut Vec<Verdict>) {
    if record.parameters.is("contact", "barrier") {
        let why = UNKNOWN_WIDTH;
        verdicts.push(Verdict::not_applicable("prandtl", "nc_effective", why));
        verdicts.push(Verdict::not_applicable("mechanism", "mechanism_width", why));
        return;
    }
    let h = record.discretisation.h;
    let (width, uncertainty) = effective_width(record.basis(), h);
    verdicts.push(Verdict::close(
        "prandtl",
        "nc_effective",
        record.metric("nc_effective"),
        EXACT,
        (PRANDTL * coarseness(record) + uncertainty / width) * EXACT,
        "Prandtl 1920",
    ));
    let rough = record.parameters.boolean("rough");
    let extent = mechanism_extent(rough) / WIDTH;
    let whose = if rough { "Prandtl's" } else { "Hill's" };
    verdicts.push(Verdict::close(
        "mechanism",
        "mechanism_width",
        record.metric("mechanism_width"),
        extent * width,
        SMEARED * h + extent * uncertainty,
        format!("{whose} mechanism; a jump of velocity is smeared over a cell on either side"),
    ));
}

fn mean_stress(record: &Record, verdicts: &mut Vec<Verdict>) {
    let why = if !record.parameters.boolean("rough") {
        Some("the reference is that of a rough footing")
    } else if record.parameters.is("contact", "barrier") {
        Some(UNKNOWN_WIDTH)
    } else {
        None
    };
    if let Some(why) = why {
        verdicts.push(Verdict::not_applicable(
            "mean-stress",
            "mean_stress_0.25_0.25",
            why,
        ));
        return;
    }
    for point in mean_stresses() {
        let metric = point.metric();
        verdicts.push(Verdict::close(
            "mean-stress",
            &metric,
            record.metric(&metric),
            point.value,
            GRADIENT * record.discretisation.h + point.uncertainty,
            "finite elements of vanishing size",
        ));
    }
}

fn against_elements(record: &Record, verdicts: &mut Vec<Verdict>) {
    match curve(record) {
        Err(why) => {
            verdicts.push(Verdict::not_applicable("fem-plateau", "nc_b", why.clone()));
            verdicts.push(Verdict::not_applicable("curve", "nc_0.001", why));
        }
        Ok(reference) => {
            verdicts.push(Verdict::close(
                "fem-plateau",
                "nc_b",
                record.metric("nc_b"),
                reference.limit,
                FEM * coarseness(record) * reference.limit,
                reference.name.clone(),
            ));
            if let Err(why) = has_the_curve_of(&record.parameters) {
                verdicts.push(Verdict::not_applicable("curve", "nc_0.001", why));
                return;
            }
            for (metric, penetration) in CURVE {
                let Some(expected) = reference.at(*penetration) else {
                    continue;
                };
                let value = record.metric(metric);
                verdicts.push(if value.is_nan() {
                    Verdict::not_applicable("curve", metric, "the run ends before")
                } else {
                    Verdict::close(
                        "curve",
                        metric,
                        value,
                        expected,
                        FEM * coarseness(record) * expected,
                        reference.name.clone(),
                    )
                });
            }
        }
    }
}

pub(super) fn judge_study(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = rates(records);
    verdicts.extend(contacts(records));
    verdicts.extend(orders(records));
    verdicts
}

/// The same run at half the rate.
fn halved<'a>(records: &'a [Record], run: &Record) -> Option<&'a Record> {
    let rate = |r: &Record| r.parameters.number("penetration_rate");
    records.iter().find(|r| {
        let others = |r: &Record| {
            let mut set = r.set.clone();
            set.retain(|s| !s.starts_with("penetration_rate="));
            set
        };
        r.scheme() == run.scheme()
            && r.level == run.level
            && others(r) == others(run)
            && (rate(r) / rate(run) - 0.5).abs() < 1e-9
    })
}

/// What halving the rate does to the limit load.
fn rates(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for run in records.iter().filter(|r| !is_elastic(r)) {
        let Some(slower) = halved(records, run) else {
            continue;
        };
        let change = (slower.metric("nc_b") / run.metric("nc_b") - 1.0).abs();
        let rate = run.parameters.number("penetration_rate");
        let what = format!(
            "{} {} from {rate} m/s to half of it",
            run.scheme(),
            run.level
        );
        match run.remedy() {
            // Faster ones ring: they are there to show it.
            RemedyName::FbarConsistent if run.is_default() => verdicts.push(Verdict::at_most(
                "rate-independent",
                Kind::Truth,
                "nc_b",
                change,
                RATE,
                format!("a rate-independent law, pressed slowly: {what}"),
            )),
            RemedyName::FbarRecursive if run.is_default() => verdicts.push(Verdict::above(
                "rate-dependent",
                Kind::KnownLimit,
                "nc_b",
                change,
                RATE,
                format!("Eq. (26) averages the average and so diffuses J̄ in time: {what}"),
            )),
            _ => {}
        }
    }
    verdicts
}

/// What the barrier changes against held nodes.
fn contacts(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for run in records.iter().filter(|r| r.changes_only("contact")) {
        let same =
            |r: &&Record| r.is_default() && r.scheme() == run.scheme() && r.level == run.level;
        let Some(held) = records.iter().find(same) else {
            continue;
        };
        verdicts.push(Verdict::close(
            "contacts-agree",
            "nc_b",
            run.metric("nc_b"),
            held.metric("nc_b"),
            2.0 * run.discretisation.h / WIDTH * held.metric("nc_b"),
            format!(
                "{} {}: a barrier on particles and held nodes; the edges of either are known to half a cell",
                run.scheme(),
                run.level
            ),
        ));
    }
    verdicts
}

/// The order of the contact pressure's error by B, over runs of the case's own parameters; when they end changes nothing.
fn orders(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    let schemes = crate::distinct(records.iter().map(Record::scheme));
    for scheme in schemes {
        let mut points: Vec<(f64, f64)> = records
            .iter()
            .filter(|r| r.scheme() == scheme && is_free_of_locking(r))
            .filter(|r| r.is_default() || r.changes_only("penetration"))
            .filter(|r| effective_width(r.basis(), r.discretisation.h).0 > WIDTH)
            .map(|r| (r.discretisation.h, r.metric("prandtl_error")))
            .collect();
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        if points.len() < 3 {
            continue;
        }
        let (least, most) = ORDER;
        let middle = 0.5 * (least + most);
        let order = fit_order(&points).map_or(f64::NAN, |o| o.order);
        verdicts.push(Verdict::close(
            "pressure-order",
            "prandtl_error",
            order,
            middle,
            0.5 * (most - least),
            format!("{scheme}: the error is the footing's excess width h/B, to first order"),
        ));
    }
    verdicts
}

#[cfg(test)]
mod tests;
