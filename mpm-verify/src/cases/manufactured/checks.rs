//! Gates on errors whose exact value is known. The tolerances are derived in `docs/manufactured.md`.

mod time;

pub(in crate::cases) use time::{order_in_time, slowed};

use super::metrics::{BODY_MASS, DISPLACEMENT_L2, DISPLACEMENT_SCALE, MASS, STRESS_L2};
use crate::accuracy::fit_order;
use crate::cases::parameters::{DENSITY, POISSON_RATIO, UNSEEN, YOUNG_MODULUS};
use crate::check::{Check, Finding, On, judge, run, study};
use crate::exact::common::{AMPLITUDE, ANGULAR_FREQUENCY, GRAVITY};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use mpm_core::Law;
use mpm_core::material::NeoHookean;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Order of a method that reproduces linear fields, and what an observed order may lack of it.
const FORMAL: f64 = 2.0;
const SLACK: f64 = 0.15;
/// An order below this is not the formal one.
pub(in crate::cases) const STALLED: f64 = FORMAL - SLACK;
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

/// What a problem claims of the convergence of a run's scheme.
pub(in crate::cases) type Claims = fn(&Record) -> Claim;

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

/// Whether what `fbar-consistent` can't see is as stiff as if the body had a Poisson's ratio above zero, so that it locks as
/// without a remedy: docs/mms-static.md.
pub(in crate::cases) fn is_beyond_unseen(r: &Record) -> bool {
    let compressible = 1.0 - 2.0 * r.parameters.number(POISSON_RATIO);
    r.remedy() == RemedyName::FbarConsistent && compressible < UNSEEN * UNSEEN
}

/// Whether what a run's transfer takes from the velocity is part of its error.
pub(in crate::cases) fn is_other_transfer(r: &Record) -> bool {
    matches!(r.transfer(), TransferName::Apic | TransferName::Xpic2)
}

/// A motion as its bounds see it.
#[derive(Clone, Copy)]
pub(in crate::cases) struct Wave {
    /// Wave number k (1/m) by the parameters.
    pub(in crate::cases) number: fn(&Parameters) -> f64,
    /// Whether it travels by shear, or by pressure.
    pub(in crate::cases) shear: bool,
}

impl Wave {
    /// 1/|1 − (ω/kc)²|: what a forced vibration makes of a relative error of the stiffness.
    fn amplification(&self, r: &Record) -> f64 {
        1.0 / (1.0 - self.ratio(r).powi(2)).abs()
    }

    /// What an implicit rule's steps make of the motion: docs/manufactured.md.
    fn error_of_steps(&self, r: &Record) -> f64 {
        if r.scheme().rule().is_none() {
            return 0.0;
        }
        let phase = r.parameters.number(ANGULAR_FREQUENCY) * r.discretisation.dt;
        let driven = self.ratio(r).powi(2) * self.amplification(r) / 6.0;
        2.0 * phase * phase * (1.0 / 8.0 + driven)
    }

    /// ω/kc.
    fn ratio(&self, r: &Record) -> f64 {
        let number = |p| r.parameters.number(p);
        let Ok(law) = NeoHookean::new(number(YOUNG_MODULUS), number(POISSON_RATIO)) else {
            return f64::NAN;
        };
        let density = number(DENSITY);
        let speed = if self.shear {
            (law.mu / density).sqrt()
        } else {
            law.wave_speed(density)
        };
        number(ANGULAR_FREQUENCY) / ((self.number)(&r.parameters) * speed)
    }
}

/// The checks of a motion that is a wave: mass, the bound on its error, and the order of its displacement.
pub(in crate::cases) fn of_motion(of: &'static [(Metric, Claims)], wave: Wave) -> Vec<Check> {
    let mut checks = vec![mass()];
    for &(_, claims) in of {
        checks.push(error_bound(claims, wave));
        checks.push(motion_lost(move |r| unbounded(r, &claims(r), &wave)));
    }
    checks.extend(orders(of));
    checks
}

/// A run whose error is larger than what it measures is wrong, whatever else of it is right, where a reason is known.
pub(in crate::cases) fn motion_lost(
    why: impl Fn(&Record) -> Option<&'static str> + Send + Sync + 'static,
) -> Check {
    Check::known_limit(
        "motion-lost",
        "wherever the rms error of u at the end is larger than the largest rms of the exact u, and no bound on it is judged: nothing is left of the motion",
        run(move |r| {
            let scale = r.metric(DISPLACEMENT_SCALE);
            let lost = r.metric(DISPLACEMENT_L2) > scale && moves(&r.parameters);
            let why = why(r).filter(|_| lost);
            why.map(|why| judge(r, DISPLACEMENT_L2).above(scale, why))
        }),
    )
}

/// Whether a standing wave has an amplitude, and gravity where that drives it; a problem without these moves.
pub(in crate::cases) fn moves(p: &Parameters) -> bool {
    [AMPLITUDE, GRAVITY].iter().all(|of| p.number(*of) != 0.0)
}

/// A wave without an amplitude, or without what drives it, is a state of rest; so far (m) may particles be off it.
pub(in crate::cases) fn rests(
    statement: &'static str,
    bound: impl Fn(&Record) -> f64 + Send + Sync + 'static,
) -> Check {
    Check::truth(
        "rests",
        statement,
        run(move |r| {
            let why = "the exact solution is a state of rest";
            let found = judge(r, DISPLACEMENT_L2).at_most(bound(r), why);
            (!moves(&r.parameters)).then_some(found)
        }),
    )
}

/// The particles have the mass of the body.
pub(in crate::cases) fn mass() -> Check {
    let statement = "the particles have the mass of the body, to rounding";
    Check::bookkeeping(
        "mass",
        statement,
        run(|r| {
            let expected = r.metric(BODY_MASS);
            vec![judge(r, MASS).within(
                expected,
                (r.work.particles as f64 + ROUNDINGS) * f64::EPSILON * expected,
                "ρ₀ times the volume of the body; each of n sums rounds once",
            )]
        }),
    )
}

fn error_bound(claims: Claims, wave: Wave) -> Check {
    Check::truth(
        "error-bound",
        "rms error of u at most 0.8 (kh)²/|1 − (ω/kc)²| of the largest rms of the exact u, k the wave number of the motion and c the speed of its waves: the largest dispersion among bases and remedies, and what a forced vibration makes of it; of implicit steps 2θ² (⅛ + ⅙ r²/|1 − r²|) more, θ = ωΔt and r that of ω and the free vibration; never more than the motion; left out where known limits are judged instead",
        run(move |r| vec![bound(r, &claims(r), &wave)]),
    )
}

/// Why no bound on the error of a run is claimed, if none is.
fn unbounded(r: &Record, claim: &Claim, wave: &Wave) -> Option<&'static str> {
    if wave.error_of_steps(r) >= 1.0 {
        return Some("steps as long as these follow nothing of the motion");
    }
    // Of central differences, beside that of the cells: θ²/12 of the driven motion.
    let phase = r.parameters.number(ANGULAR_FREQUENCY) * r.discretisation.dt;
    let kh = (wave.number)(&r.parameters) * r.discretisation.h;
    if kh >= PI {
        return Some("cells carry no wave that is shorter than two of them");
    }
    let of_steps = phase * phase / 12.0 * wave.ratio(r).powi(2);
    if r.scheme().rule().is_none() && of_steps > DISPERSION * kh * kh {
        return Some(
            "steps of this length err more than the cells: a soft or heavy body is driven",
        );
    }
    if is_beyond_unseen(r) {
        return Some("what the average can't see is stiff enough to lock: docs/mms-static.md");
    }
    match claim {
        Claim::Second | Claim::Observed(..) => {
            let sound = r.remedy() == RemedyName::None || is_sound(r.remedy());
            (!sound).then_some("Eq. (26) is of first order")
        }
        Claim::Stalls(_, why) | Claim::Open(why) => Some(why),
    }
}

fn bound(r: &Record, claim: &Claim, wave: &Wave) -> Finding {
    let metric = DISPLACEMENT_L2;
    if let Some(why) = unbounded(r, claim, wave) {
        return Finding::not_applicable(metric, why);
    }
    let kh = (wave.number)(&r.parameters) * r.discretisation.h;
    // At rest for all time, a body errs by its motion.
    let of_cells = DISPERSION * kh * kh * wave.amplification(r);
    let bound = (of_cells + wave.error_of_steps(r)).min(1.0);
    judge(r, metric).at_most(
        bound * r.metric(DISPLACEMENT_SCALE),
        format!("{bound:.3} times displacement_scale"),
    )
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
fn order(ladder: &[&Record], metric: Metric) -> f64 {
    let points: Vec<(f64, f64)> = ladder
        .iter()
        .map(|r| (r.discretisation.h, r.metric(metric)))
        .collect();
    let finest = &points[points.len().saturating_sub(DECIDING)..];
    fit_order(finest).map_or(f64::NAN, |o| o.order)
}

/// A ladder that decides an order, and what is claimed of it.
struct Ladder<'a> {
    metric: Metric,
    claim: Claim,
    scheme: Scheme,
    runs: Vec<&'a Record>,
}

impl Ladder<'_> {
    fn order(&self) -> f64 {
        order(&self.runs, self.metric)
    }

    fn about(&self, what: &str) -> String {
        let what = format!("{what}{}", self.metric.name);
        subject(&what, self.scheme, &self.runs)
    }

    /// Largest ratio of the error at a level to that at the one before; NaN if a run has none: one that broke down
    /// must not be lost among the others.
    fn worst_ratio(&self) -> f64 {
        let errors: Vec<f64> = self.runs.iter().map(|r| r.metric(self.metric)).collect();
        if errors.iter().any(|e| e.is_nan()) {
            return f64::NAN;
        }
        let ratios = errors.windows(2).map(|pair| pair[1] / pair[0]);
        ratios.fold(0.0, f64::max)
    }
}

/// A check on the ladders of some metrics, each with its claims.
fn on_ladders(of: &'static [(Metric, Claims)], found: fn(&Ladder) -> Option<Finding>) -> On {
    study(move |records| {
        let ladders = of.iter().flat_map(|&(metric, claims)| {
            let all = ladders(records).into_iter();
            let deciding = all.filter(|(_, runs)| runs.len() >= DECIDING);
            deciding.map(move |(scheme, runs)| Ladder {
                metric,
                claim: claims(runs[runs.len() - 1]),
                scheme,
                runs,
            })
        });
        ladders.filter_map(|l| found(&l)).collect()
    })
}

/// The checks on the order of errors, for every ladder of at least three levels.
pub(in crate::cases) fn orders(of: &'static [(Metric, Claims)]) -> [Check; 4] {
    [
        Check::truth(
            "order-displacement",
            "order of the rms error of u over the three finest levels at least 2 − 0.15, where theory gives 2",
            on_ladders(of, |l| match l.claim {
                Claim::Second => Some(Finding::above(
                    l.about("order_"),
                    l.order(),
                    FORMAL - SLACK,
                    "second order: linear fields are reproduced, the lumped mass has its centre at the node",
                )),
                Claim::Open(why) => Some(Finding::not_applicable(l.about("order_"), why)),
                _ => None,
            }),
        ),
        Check::truth(
            "error-falls",
            "the rms error of u falls from level to level, where the order is judged",
            on_ladders(of, |l| match l.claim {
                Claim::Second => Some(Finding::at_most(
                    l.about("largest ratio of "),
                    l.worst_ratio(),
                    1.0,
                    "a consistent scheme converges",
                )),
                _ => None,
            }),
        ),
        Check::regression(
            "observed-order",
            "where no theory gives the order: it lies in the band stated with the verdict",
            on_ladders(of, |l| match l.claim {
                Claim::Observed([least, most], why) => Some(Finding::within(
                    l.about("order_"),
                    l.order(),
                    0.5 * (least + most),
                    0.5 * (most - least),
                    why,
                )),
                _ => None,
            }),
        ),
        Check::known_limit(
            "stalls",
            "order of the rms error of u below 2 − 0.15, or the one stated with the verdict, for the reason given there",
            on_ladders(of, |l| match l.claim {
                Claim::Stalls(below, why) => {
                    Some(Finding::at_most(l.about("order_"), l.order(), below, why))
                }
                _ => None,
            }),
        ),
    ]
}

/// The order of the stress where that of the displacement is claimed.
pub(in crate::cases) fn stress_order(of: &'static [(Metric, Claims)]) -> Check {
    Check::truth(
        "order-stress",
        "order of the rms error of σ at least 1 − 0.15, one less than that of u",
        on_ladders(of, |l| match l.claim {
            Claim::Second => Some(Finding::above(
                subject("order_stress_l2", l.scheme, &l.runs),
                order(&l.runs, STRESS_L2),
                FORMAL - 1.0 - SLACK,
                "gradients of a second-order displacement",
            )),
            _ => None,
        }),
    )
}

/// Locking: runs that differ in Poisson's ratio alone.
pub(in crate::cases) fn locking() -> [Check; 2] {
    [
        Check::truth(
            "no-locking",
            "fbar-total, fbar-rate, fbar-consistent up to 1 − 2ν = ε², all but linear functions: rms error of u at any Poisson's ratio at most 1.2 times that at 0.3, same steps",
            study(|records| {
                let sound =
                    |p: &&Pair| is_sound(p.stiff.remedy()) && p.stiff.basis() != BasisName::Linear;
                let pairs = pairs_of_ratios(records);
                let judged = pairs.iter().filter(sound);
                let found = judged.filter(|p| !is_beyond_unseen(p.stiff)).map(|p| {
                    let why =
                        "the exact motion does not depend on ν; both runs take the same steps";
                    Finding::at_most(p.about(), p.factor(), LOCKING_FREE, why)
                });
                found.collect()
            }),
        ),
        Check::known_limit(
            "locks",
            "none with linear functions and GIMP at ν ≥ 0.499: rms error of u above 1.5 times that at ν = 0.3 at the coarsest level",
            study(|records| {
                let sizes = records.iter().map(|r| r.discretisation.h);
                let coarsest = sizes.fold(0.0, f64::max);
                let locks = |p: &&Pair| {
                    p.stiff.remedy() == RemedyName::None
                        && matches!(p.stiff.basis(), BasisName::Linear | BasisName::Gimp)
                        && p.ratio() >= 0.499
                        && p.stiff.discretisation.h == coarsest
                };
                let pairs = pairs_of_ratios(records);
                let found = pairs.iter().filter(locks).map(|p| {
                    let why = "more constraints on the volume than nodes to meet them";
                    Finding::above(p.about(), p.factor(), LOCKED, why)
                });
                found.collect()
            }),
        ),
    ]
}

/// Two runs that differ in Poisson's ratio alone, one of them at [`COMPRESSIBLE`].
struct Pair<'a> {
    stiff: &'a Record,
    soft: &'a Record,
}

impl Pair<'_> {
    fn ratio(&self) -> f64 {
        self.stiff.parameters.number(POISSON_RATIO)
    }

    fn factor(&self) -> f64 {
        self.stiff.metric(DISPLACEMENT_L2) / self.soft.metric(DISPLACEMENT_L2)
    }

    fn about(&self) -> String {
        let (metric, stiff) = (DISPLACEMENT_L2.name, self.stiff);
        let (scheme, level, ratio) = (stiff.scheme(), &stiff.level, self.ratio());
        format!("{metric} of {scheme} {level} at ν = {ratio} over ν = 0.3")
    }
}

fn pairs_of_ratios(records: &[Record]) -> Vec<Pair<'_>> {
    let others = |r: &Record| -> Vec<String> {
        let kept = r.set.iter().filter(|s| !s.starts_with("poisson_ratio="));
        kept.cloned().collect()
    };
    let ratio = |r: &Record| r.parameters.number(POISSON_RATIO);
    let pair = |stiff| {
        let same = |soft: &&Record| {
            ratio(soft) == COMPRESSIBLE
                && soft.scheme() == Record::scheme(stiff)
                && soft.level == stiff.level
                && others(soft) == others(stiff)
        };
        let soft = records.iter().find(same)?;
        Some(Pair { stiff, soft })
    };
    let stiff = records.iter().filter(|r| ratio(r) != COMPRESSIBLE);
    stiff.filter_map(pair).collect()
}

#[cfg(test)]
mod tests;
