//! Gates on errors whose exact value is known. The tolerances are derived in `docs/manufactured.md`.

use crate::case::{CheckInfo, check};
use crate::order::{fit_order, richardson};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::verdict::{Kind, Verdict};
use mpm_core::Law;
use mpm_core::material::NeoHookean;
use std::collections::BTreeMap;

/// Order of a method that reproduces linear fields, and what an observed order may lack of it.
const FORMAL: f64 = 2.0;
const SLACK: f64 = 0.15;
/// An order below this is not the formal one.
pub(in crate::cases) const STALLED: f64 = FORMAL - SLACK;
/// Order in time of symplectic Euler with F updated by I + Δt ∇v.
const FORMAL_IN_TIME: f64 = 1.0;
/// Largest relative error of a squared frequency over (kh)², quadratic splines with fbar-rate where all of
/// the stress is averaged, rounded up: docs/modes.md.
const DISPERSION: f64 = 0.8;
/// Roundings in the mass of a particle.
const ROUNDINGS: f64 = 10.0;
/// Levels, the finest ones, that decide an order.
const DECIDING: usize = 3;
/// Largest error at a Poisson's ratio over that at 0.3 that counts as free of locking, and the least
/// that counts as locked.
const LOCKING_FREE: f64 = 1.2;
const LOCKED: f64 = 1.5;
/// Poisson's ratio that locking is measured against.
const COMPRESSIBLE: f64 = 0.3;

pub(in crate::cases) const ERROR_BOUND: CheckInfo = check(
    "error-bound",
    Kind::Truth,
    "rms error of u at most 0.8 (kh)²/|1 − (ω/kc)²| of the largest rms of the exact u, k the wave number of the motion and c the speed of its waves: the largest dispersion among bases and remedies, and what a forced vibration makes of it; left out where that is as large as the motion, and where known limits are judged instead",
);
pub(in crate::cases) const MASS: CheckInfo = check(
    "mass",
    Kind::Bookkeeping,
    "the particles have the mass of the body, to rounding",
);
pub(in crate::cases) const ORDER: CheckInfo = check(
    "order-displacement",
    Kind::Truth,
    "order of the rms error of u over the three finest levels at least 2 − 0.15, where theory gives 2",
);
pub(in crate::cases) const ORDER_STRESS: CheckInfo = check(
    "order-stress",
    Kind::Truth,
    "order of the rms error of σ at least 1 − 0.15, one less than that of u",
);
pub(in crate::cases) const FALLS: CheckInfo = check(
    "error-falls",
    Kind::Truth,
    "the rms error of u falls from level to level, where the order is judged",
);
pub(in crate::cases) const OBSERVED: CheckInfo = check(
    "observed-order",
    Kind::Truth,
    "where no theory gives the order: it lies in the band stated with the verdict",
);
pub(in crate::cases) const STALLS: CheckInfo = check(
    "stalls",
    Kind::KnownLimit,
    "order of the rms error of u below 2 − 0.15, or the one stated with the verdict, for the reason given there",
);
pub(in crate::cases) const ORDER_TIME: CheckInfo = check(
    "order-time",
    Kind::Truth,
    "order in Δt at fixed h, from successive differences of the displacement's share of the exact one, at least 1 − 0.15",
);
pub(in crate::cases) const LOCKING: CheckInfo = check(
    "no-locking",
    Kind::Truth,
    "fbar-total, fbar-rate, fbar-consistent, all but linear functions: rms error of u at any Poisson's ratio at most 1.2 times that at 0.3, same steps",
);
pub(in crate::cases) const LOCKS: CheckInfo = check(
    "locks",
    Kind::KnownLimit,
    "none with linear functions and GIMP at ν ≥ 0.499: rms error of u above 1.5 times that at ν = 0.3 at the coarsest level",
);

/// The gates of an isochoric or an axis-aligned motion.
pub(in crate::cases) const CHECKS: &[CheckInfo] = &[
    MASS,
    ERROR_BOUND,
    ORDER,
    ORDER_STRESS,
    FALLS,
    OBSERVED,
    STALLS,
    ORDER_TIME,
    LOCKING,
    LOCKS,
];

/// What is known of the convergence of a scheme with some parameters.
pub(in crate::cases) enum Claim {
    /// Theory gives order two.
    Second,
    /// The order has been observed between two bounds; why theory gives none.
    Observed([f64; 2], &'static str),
    /// The order stays below a bound, at most [`STALLED`]; why.
    Stalls(f64, &'static str),
    /// Nothing is claimed; why.
    Open(&'static str),
}

/// Why no order is claimed of transfers but FLIP.
pub(in crate::cases) const TRANSFER: &str =
    "what a transfer takes from the velocity per step is part of the error: docs/manufactured.md";

/// The remedies that neither lock nor creep.
pub(in crate::cases) fn is_sound(remedy: RemedyName) -> bool {
    matches!(
        remedy,
        RemedyName::FbarTotal | RemedyName::FbarRate | RemedyName::FbarConsistent
    )
}

/// A motion as its bounds see it.
pub(in crate::cases) struct Wave {
    /// Wave number k (1/m).
    pub(in crate::cases) number: f64,
    /// Whether it travels by shear, or by pressure.
    pub(in crate::cases) shear: bool,
}

impl Wave {
    /// 1/|1 − (ω/kc)²|: what a forced vibration makes of a relative error of the stiffness.
    fn amplification(&self, r: &Record) -> f64 {
        let number = |name| r.parameters.number(name);
        let Ok(law) = NeoHookean::new(number("young_modulus"), number("poisson_ratio")) else {
            return f64::NAN;
        };
        let density = number("density");
        let speed = if self.shear {
            (law.mu / density).sqrt()
        } else {
            law.wave_speed(density)
        };
        let ratio = number("angular_frequency") / (self.number * speed);
        1.0 / (1.0 - ratio * ratio).abs()
    }
}

/// The verdicts on one run of a motion.
pub(in crate::cases) fn of_run(r: &Record, claim: &Claim, wave: &Wave) -> Vec<Verdict> {
    vec![mass(r), error_bound(r, claim, wave)]
}

/// Whether the particles have the mass of the body.
pub(in crate::cases) fn mass(r: &Record) -> Verdict {
    let expected = r.metric("body_mass");
    Verdict::close(
        MASS.name,
        "mass",
        r.metric("mass"),
        expected,
        (r.work.particles as f64 + ROUNDINGS) * f64::EPSILON * expected,
        "ρ₀ times the volume of the body; each of n sums rounds once",
    )
    .bookkeeping()
}

fn error_bound(r: &Record, claim: &Claim, wave: &Wave) -> Verdict {
    let metric = "displacement_l2";
    let sound = r.remedy() == RemedyName::None || is_sound(r.remedy());
    match claim {
        Claim::Second | Claim::Observed(..) if sound => {
            let kh = wave.number * r.discretisation.h;
            let bound = DISPERSION * kh * kh * wave.amplification(r);
            if bound >= 1.0 {
                let why = format!("the bound, {bound:.3} of the motion, bounds nothing");
                return Verdict::not_applicable(ERROR_BOUND.name, metric, why);
            }
            Verdict::at_most(
                ERROR_BOUND.name,
                Kind::Truth,
                metric,
                r.metric(metric),
                bound * r.metric("displacement_scale"),
                format!("{bound:.3} times displacement_scale"),
            )
        }
        Claim::Second | Claim::Observed(..) => {
            Verdict::not_applicable(ERROR_BOUND.name, metric, "Eq. (26) is of first order")
        }
        Claim::Stalls(_, why) | Claim::Open(why) => {
            Verdict::not_applicable(ERROR_BOUND.name, metric, *why)
        }
    }
}

/// The records of each scheme with the same parameters, coarsest first.
pub(in crate::cases) fn ladders(records: &[Record]) -> Vec<(Scheme, Vec<&Record>)> {
    let mut ladders: BTreeMap<(Vec<String>, Scheme), Vec<&Record>> = BTreeMap::new();
    for r in records {
        let key = (r.set.clone(), r.scheme());
        ladders.entry(key).or_default().push(r);
    }
    let sorted = ladders.into_iter().map(|((_, scheme), mut ladder)| {
        ladder.sort_by(|a, b| b.discretisation.h.total_cmp(&a.discretisation.h));
        (scheme, ladder)
    });
    sorted.collect()
}

/// What a verdict on a ladder is about.
fn subject(metric: &str, scheme: Scheme, ladder: &[&Record]) -> String {
    let ends = [ladder.first(), ladder.last()].map(|r| r.map_or("", |r| &r.level));
    let set = ladder.first().map_or(String::new(), |r| r.set.join(" "));
    format!("{metric} of {scheme} {} to {} {set}", ends[0], ends[1])
        .trim_end()
        .to_owned()
}

/// Observed order of a metric over the finest levels; NaN where there is none.
fn order(ladder: &[&Record], metric: &str) -> f64 {
    let points: Vec<(f64, f64)> = ladder
        .iter()
        .map(|r| (r.discretisation.h, r.metric(metric)))
        .collect();
    let finest = &points[points.len().saturating_sub(DECIDING)..];
    fit_order(finest).map_or(f64::NAN, |o| o.order)
}

/// The gates on the order of `metric` for every ladder of at least three levels.
pub(in crate::cases) fn orders_of(
    records: &[Record],
    metric: &str,
    claim: impl Fn(&Record) -> Claim,
) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for (scheme, ladder) in ladders(records) {
        if ladder.len() < DECIDING {
            continue;
        }
        let name = subject(&format!("order_{metric}"), scheme, &ladder);
        let found = order(&ladder, metric);
        match claim(ladder[ladder.len() - 1]) {
            Claim::Second => {
                verdicts.push(Verdict::above(
                    ORDER.name,
                    Kind::Truth,
                    &name,
                    found,
                    FORMAL - SLACK,
                    "second order: linear fields are reproduced, the lumped mass has its centre at the node",
                ));
                let errors = ladder.iter().map(|r| r.metric(metric));
                let errors: Vec<f64> = errors.collect();
                // A run that broke down has no error, and must not be lost among the others.
                let worst = if errors.iter().any(|e| e.is_nan()) {
                    f64::NAN
                } else {
                    let ratios = errors.windows(2).map(|pair| pair[1] / pair[0]);
                    ratios.fold(0.0, f64::max)
                };
                verdicts.push(Verdict::at_most(
                    FALLS.name,
                    Kind::Truth,
                    &subject(&format!("largest ratio of {metric}"), scheme, &ladder),
                    worst,
                    1.0,
                    "a consistent scheme converges",
                ));
            }
            Claim::Observed([least, most], why) => verdicts.push(Verdict::close(
                OBSERVED.name,
                &name,
                found,
                0.5 * (least + most),
                0.5 * (most - least),
                why,
            )),
            Claim::Stalls(below, why) => verdicts.push(Verdict::at_most(
                STALLS.name,
                Kind::KnownLimit,
                &name,
                found,
                below,
                why,
            )),
            Claim::Open(why) => verdicts.push(Verdict::not_applicable(ORDER.name, &name, why)),
        }
    }
    verdicts
}

/// The gates on the order of the stress where that of the displacement is claimed.
pub(in crate::cases) fn stress_orders(
    records: &[Record],
    claim: impl Fn(&Record) -> Claim,
) -> Vec<Verdict> {
    let deciding = ladders(records).into_iter().filter(|(_, ladder)| {
        ladder.len() >= DECIDING && matches!(claim(ladder[ladder.len() - 1]), Claim::Second)
    });
    let verdict = |(scheme, ladder): (Scheme, Vec<&Record>)| {
        Verdict::above(
            ORDER_STRESS.name,
            Kind::Truth,
            &subject("order_stress_l2", scheme, &ladder),
            order(&ladder, "stress_l2"),
            FORMAL - 1.0 - SLACK,
            "gradients of a second-order displacement",
        )
    };
    deciding.map(verdict).collect()
}

/// The gates on the order in time: runs of a scheme at a level that differ in the CFL number alone,
/// each half of the one before.
pub(in crate::cases) fn time_orders(records: &[Record]) -> Vec<Verdict> {
    let metric = "displacement_ratio";
    let mut families: BTreeMap<(&str, Scheme), Vec<(f64, f64)>> = BTreeMap::new();
    for r in records {
        let converges = r.remedy() != RemedyName::FbarRecursive;
        if converges && (r.is_default() || r.changes_only("cfl")) {
            let family = families.entry((&r.level, r.scheme())).or_default();
            family.push((r.discretisation.dt, r.metric(metric)));
        }
    }
    let mut verdicts = Vec::new();
    for ((level, scheme), mut family) in families {
        family.sort_by(|a, b| b.0.total_cmp(&a.0));
        let [.., a, b, c] = family[..] else { continue };
        let found = richardson([a, b, c]).map_or(f64::NAN, |r| r.order);
        verdicts.push(Verdict::above(
            ORDER_TIME.name,
            Kind::Truth,
            &format!("order in Δt of {metric} of {scheme} {level}"),
            found,
            FORMAL_IN_TIME - SLACK,
            "symplectic Euler, F updated by I + Δt ∇v: first order",
        ));
    }
    verdicts
}

/// The gates on locking: runs that differ in Poisson's ratio alone.
pub(in crate::cases) fn locking(records: &[Record]) -> Vec<Verdict> {
    let metric = "displacement_l2";
    let others = |r: &Record| -> Vec<String> {
        let kept = r.set.iter().filter(|s| !s.starts_with("poisson_ratio="));
        kept.cloned().collect()
    };
    let ratio = |r: &Record| r.parameters.number("poisson_ratio");
    let coarsest = records
        .iter()
        .map(|r| r.discretisation.h)
        .fold(0.0, f64::max);
    let mut verdicts = Vec::new();
    for stiff in records.iter().filter(|r| ratio(r) != COMPRESSIBLE) {
        let soft = records.iter().find(|r| {
            ratio(r) == COMPRESSIBLE
                && r.scheme() == stiff.scheme()
                && r.level == stiff.level
                && others(r) == others(stiff)
        });
        let Some(soft) = soft else { continue };
        let factor = stiff.metric(metric) / soft.metric(metric);
        let name = format!(
            "{metric} of {} {} at ν = {} over ν = 0.3",
            stiff.scheme(),
            stiff.level,
            ratio(stiff)
        );
        if is_sound(stiff.remedy()) && stiff.basis() != BasisName::Linear {
            verdicts.push(Verdict::at_most(
                LOCKING.name,
                Kind::Truth,
                &name,
                factor,
                LOCKING_FREE,
                "the exact motion does not depend on ν; both runs take the same steps",
            ));
        } else if stiff.remedy() == RemedyName::None
            && matches!(stiff.basis(), BasisName::Linear | BasisName::Gimp)
            && ratio(stiff) >= 0.499
            && stiff.discretisation.h == coarsest
        {
            verdicts.push(Verdict::above(
                LOCKS.name,
                Kind::KnownLimit,
                &name,
                factor,
                LOCKED,
                "more constraints on the volume than nodes to meet them",
            ));
        }
    }
    verdicts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::{Domain, Parameter, Parameters};
    use crate::record::Metric;
    use crate::report::fixture::record;

    /// A run at cell size 1/n with an error.
    fn run(n: f64, metric: &str, value: f64) -> Record {
        let mut r = record(&format!("n{n}"), Vec::new());
        r.discretisation.h = 1.0 / n;
        let unit = "m".to_owned();
        let value = value.is_finite().then_some(value);
        r.metrics.insert(metric.to_owned(), Metric { value, unit });
        r
    }

    /// Runs with errors h^p.
    fn of_order(p: f64) -> Vec<Record> {
        let error = |n: f64| run(n, "displacement_l2", n.powf(-p));
        [8.0, 16.0, 32.0, 64.0].map(error).to_vec()
    }

    fn outcomes(records: &[Record], claim: fn(&Record) -> Claim) -> Vec<(String, Option<bool>)> {
        let verdicts = orders_of(records, "displacement_l2", claim);
        verdicts
            .into_iter()
            .map(|v| (v.check.clone(), v.holds()))
            .collect()
    }

    #[test]
    fn an_order_below_the_formal_one_is_red_and_no_order_is_too() {
        let gate = |records: &[Record]| outcomes(records, |_| Claim::Second);
        let named = |pass, falls| {
            vec![
                (ORDER.name.to_owned(), Some(pass)),
                (FALLS.name.to_owned(), Some(falls)),
            ]
        };
        assert_eq!(gate(&of_order(1.9)), named(true, true));
        assert_eq!(gate(&of_order(1.8)), named(false, true));
        assert_eq!(gate(&of_order(-0.1)), named(false, false));
        let mut broken = of_order(2.0);
        broken[2] = run(32.0, "displacement_l2", f64::NAN);
        assert_eq!(gate(&broken), named(false, false));
        assert!(
            gate(&of_order(2.0)[..2]).is_empty(),
            "two levels have no order"
        );
    }

    #[test]
    fn a_known_stall_that_vanishes_is_red() {
        let stalls = |records: &[Record]| outcomes(records, |_| Claim::Stalls(0.5, ""));
        assert_eq!(stalls(&of_order(0.1))[0].1, Some(true));
        assert_eq!(stalls(&of_order(1.0))[0].1, Some(false));
        let band = |records: &[Record]| outcomes(records, |_| Claim::Observed([1.0, 1.5], ""));
        assert_eq!(band(&of_order(1.2))[0].1, Some(true));
        assert_eq!(band(&of_order(2.0))[0].1, Some(false));
        assert_eq!(outcomes(&of_order(0.0), |_| Claim::Open(""))[0].1, None);
    }

    /// A run with a Poisson's ratio.
    fn at_ratio(remedy: RemedyName, ratio: &str, error: f64) -> Record {
        const RATIO: Parameter = Parameter {
            name: "poisson_ratio",
            unit: "-",
            default: "0.3",
            domain: Domain::Number {
                least: 0.0,
                most: 0.5,
                below: true,
            },
            meaning: "",
        };
        let mut r = run(8.0, "displacement_l2", error);
        r.scheme = Scheme::flip(r.basis(), remedy);
        r.set = vec![format!("poisson_ratio={ratio}")];
        r.parameters = Parameters::new(&[RATIO], &r.set).unwrap();
        r
    }

    #[test]
    fn locking_is_the_error_over_that_of_the_compressible_body() {
        let judged = |remedy, factor| {
            let pair = [
                at_ratio(remedy, "0.3", 1.0),
                at_ratio(remedy, "0.4999", factor),
            ];
            let verdicts = locking(&pair);
            verdicts
                .into_iter()
                .map(|v| (v.check.clone(), v.holds()))
                .collect::<Vec<_>>()
        };
        let free = LOCKING.name.to_owned();
        let locks = LOCKS.name.to_owned();
        assert_eq!(
            judged(RemedyName::FbarConsistent, 1.1),
            [(free.clone(), Some(true))]
        );
        assert_eq!(
            judged(RemedyName::FbarConsistent, 1.3),
            [(free, Some(false))]
        );
        assert_eq!(judged(RemedyName::None, 8.0), [(locks.clone(), Some(true))]);
        assert_eq!(judged(RemedyName::None, 1.0), [(locks, Some(false))]);
    }

    #[test]
    fn the_order_in_time_comes_from_successive_differences() {
        let at = |cfl: f64, order: i32| {
            let mut r = run(16.0, "displacement_ratio", 1.0 + 0.1 * cfl.powi(order));
            r.discretisation.dt = cfl;
            r.set = vec![format!("cfl={cfl}")];
            r
        };
        for (order, pass) in [(1, true), (2, true)] {
            let verdicts = time_orders(&[0.4, 0.2, 0.1].map(|cfl| at(cfl, order)));
            assert_eq!(verdicts[0].holds(), Some(pass));
            assert!((verdicts[0].value.unwrap() - f64::from(order)).abs() < 1e-9);
        }
        let stuck = [0.4, 0.2, 0.1].map(|cfl| at(cfl, 0));
        assert!(time_orders(&stuck)[0].failed());
    }
}
