//! Gates on errors whose exact value is known. The tolerances are derived in `docs/manufactured.md`.

mod claims;
mod locking;
mod time;

pub(in crate::cases) use claims::{
    Claim, Claims, HATS, JUMPS, LOCKS, NULL_SPACE, OFF_NODE, TRANSFER, VORTEX, between_rollers, feeds_null_space,
    is_beyond_unseen, is_sound, of_isochoric, of_vortex,
};
pub(in crate::cases) use locking::{LOCKING_CURVE, locking};
pub(in crate::cases) use time::{order_in_time, slowed};

use super::metrics::{BODY_MASS, DISPLACEMENT_L2, DISPLACEMENT_SCALE, MASS, STRESS_L2};
use crate::cases::parameters::{DENSITY, POISSON_RATIO, YOUNG_MODULUS};
use crate::cases::prelude::*;
use crate::exact::common::{AMPLITUDE, ANGULAR_FREQUENCY, GRAVITY};
use claims::STALLED;

/// A check of a run whose parameters are read by name.
pub(in crate::cases) type Gate = CheckOf<()>;

/// Roundings in the mass of a particle.
const ROUNDINGS: f64 = 10.0;

/// A motion as its bounds see it: how it travels, and its wave number k (1/m) by the parameters.
#[derive(Clone, Copy)]
pub(in crate::cases) enum Wave {
    Shear(fn(&Parameters) -> f64),
    Pressure(fn(&Parameters) -> f64),
}

impl Wave {
    /// k (1/m).
    pub(in crate::cases) fn number(&self, p: &Parameters) -> f64 {
        let (Self::Shear(number) | Self::Pressure(number)) = self;
        number(p)
    }

    /// kh.
    fn resolution(&self, r: &Run<()>) -> f64 {
        self.number(&r.values) * r.h
    }

    /// 1/|1 − (ω/kc)²|: what a forced vibration makes of a relative error of the stiffness.
    fn amplification(&self, r: &Run<()>) -> f64 {
        1.0 / (1.0 - self.ratio(r).powi(2)).abs()
    }

    /// Error by the steps of an implicit rule, over the motion: docs/manufactured.md.
    fn error_of_steps(&self, r: &Run<()>) -> f64 {
        if !r.is_implicit() {
            return 0.0;
        }
        // ωΔt.
        let phase = r.number(ANGULAR_FREQUENCY) * r.dt();
        let driven = self.ratio(r).powi(2) * self.amplification(r) / 6.0;
        2.0 * phase * phase * (1.0 / 8.0 + driven)
    }

    /// ω/kc.
    fn ratio(&self, r: &Run<()>) -> f64 {
        let number = |p| r.number(p);
        let Ok(law) = NeoHookean::new(number(YOUNG_MODULUS), number(POISSON_RATIO)) else { return f64::NAN };
        let density = number(DENSITY);
        let speed = match self {
            Self::Shear(_) => (law.mu / density).sqrt(),
            Self::Pressure(_) => law.wave_speed(density),
        };
        number(ANGULAR_FREQUENCY) / (self.number(&r.values) * speed)
    }

    /// Reason why no scheme has a bound on its error, if there is one.
    fn unposed(&self, r: &Run<()>) -> Option<&'static str> {
        // At rest for all time, a body errs by its motion.
        if self.bound(r) >= 1.0 {
            return Some("the bound is as large as the motion");
        }
        if self.error_of_steps(r) >= 1.0 {
            return Some("steps as long as these follow nothing of the motion");
        }
        // Error of central differences, beside that of the cells: θ²/12 of the driven motion.
        let (phase, kh) = (r.number(ANGULAR_FREQUENCY) * r.dt(), self.resolution(r));
        if kh >= PI {
            return Some("cells carry no wave that is shorter than two of them");
        }
        let of_steps = phase * phase / 12.0 * self.ratio(r).powi(2);
        if !r.is_implicit() && of_steps > DISPERSION * kh * kh {
            return Some("steps of this length err more than the cells: a soft or heavy body is driven");
        }
        None
    }

    /// Reason why a scheme is known not to keep the bound, if there is one.
    fn shortcoming(r: &Run<()>, claim: &Claim) -> Option<&'static str> {
        let nearly_incompressible = r.number(POISSON_RATIO) > 0.499;
        if nearly_incompressible && matches!(r.remedy(), FbarTotal | FbarRate) {
            return Some(NULL_SPACE);
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

    /// Largest error over the motion.
    fn bound(&self, r: &Run<()>) -> f64 {
        let kh = self.resolution(r);
        // A heavy body follows its force, which the transfer smooths by less than the stiffness.
        let of_cells = DISPERSION * kh * kh * self.amplification(r).max(1.0);
        of_cells + self.error_of_steps(r)
    }
}

/// The checks of a motion that is a wave: mass, the bound on its error, and the order of its displacement.
pub(in crate::cases) fn of_motion(claims: Claims, wave: Wave) -> Vec<Check> {
    let mut checks = vec![
        mass(),
        Gate::truth("error-bound", "rms error of u at most 0.8 (kh)² max(1, 1/|1 − (ω/kc)²|) of its largest rms; implicit 2θ² (⅛ + ⅙ r²/|1 − r²|) more, θ = ωΔt, r = ω/ω₀")
            .unless(move |r| wave.unposed(r).map(str::to_owned))
            .at_most(DISPLACEMENT_L2, move |r| wave.bound(r) * r.metric(DISPLACEMENT_SCALE))
            .because_of(move |r| format!("{:.3} times displacement_scale", wave.bound(r))),
        Gate::known_limit("beyond-bound", "schemes with a known shortcoming: rms error of u beyond the bound of error-bound, where it is")
            .when(move |r| wave.unposed(r).is_none() && Wave::shortcoming(r, &claims(r)).is_some())
            .when(move |r| r.metric(DISPLACEMENT_L2) > wave.bound(r) * r.metric(DISPLACEMENT_SCALE))
            .above(DISPLACEMENT_L2, move |r| wave.bound(r) * r.metric(DISPLACEMENT_SCALE))
            .because_of(move |r| Wave::shortcoming(r, &claims(r)).unwrap_or_default().to_owned()),
        motion_lost(move |r| wave.unposed(r).or_else(|| Wave::shortcoming(r, &claims(r)))),
    ];
    checks.extend(orders(&[(DISPLACEMENT_L2, claims)]));
    checks
}

/// A run whose error is larger than what it measures is wrong, whatever else of it is right, where a reason is known.
pub(in crate::cases) fn motion_lost(why: impl Fn(&Run<()>) -> Option<&'static str> + Clone + Held) -> Check {
    let known = why.clone();
    Gate::known_limit(
        "motion-lost",
        "where no error bound is judged: final rms error of u larger than the largest rms of the exact u",
    )
    .when(|r| r.metric(DISPLACEMENT_L2) > r.metric(DISPLACEMENT_SCALE) && moves(&r.values))
    .when(move |r| known(r).is_some())
    .above(DISPLACEMENT_L2, |r| r.metric(DISPLACEMENT_SCALE))
    .because_of(move |r| why(r).unwrap_or_default().to_owned())
}

/// Whether a standing wave has an amplitude, and gravity where that drives it; a problem without these moves.
pub(in crate::cases) fn moves(p: &Parameters) -> bool {
    [AMPLITUDE, GRAVITY].iter().all(|of| p.number(*of) != 0.0)
}

/// A wave without an amplitude, or without what drives it, is a state of rest, from which particles are at most a `bound` (m).
pub(in crate::cases) fn rests(statement: &'static str, bound: impl Fn(&Run<()>) -> f64 + Held) -> Check {
    Gate::truth("rests", statement)
        .when(|r| !moves(&r.values))
        .except(|r| r.remedy() == FbarRecursive, "Eq. (26) diffuses J̄: a pressure that varies relaxes")
        .at_most(DISPLACEMENT_L2, bound)
        .because("the exact solution is a state of rest")
}

pub(in crate::cases) fn mass() -> Check {
    let statement = "the particles have the mass of the body, to rounding";
    let rounding = |r: &Run<()>| {
        let sums = r.record.work.particles as f64 + ROUNDINGS;
        sums * f64::EPSILON * r.metric(BODY_MASS)
    };
    Gate::bookkeeping("mass", statement)
        .within(MASS, |r| r.metric(BODY_MASS), rounding)
        .because("ρ₀ times the volume of the body; each of n sums rounds once")
}

/// The records of each scheme with the same parameters, coarsest first.
pub(in crate::cases) fn ladders(records: &[Record]) -> Vec<(Scheme, Vec<&Record>)> {
    let ladders = ladders_by(records.iter(), |r| (&r.set, r.scheme()));
    ladders.into_iter().map(|((_, scheme), ladder)| (scheme, ladder)).collect()
}

/// A ladder of at least three levels that decides an order, and what is claimed of it.
struct Ladder {
    claim: Claim,
    /// The metric, the scheme and the levels.
    about: String,
    /// Observed order over the finest levels; NaN if undefined.
    order: f64,
    /// Largest ratio of the error at a level to that at the one before; NaN if a run has none: one that broke down
    /// must not be lost among the others.
    worst_ratio: f64,
    /// A run broke down, which `completes` judges.
    broke: bool,
}

impl Ladder {
    fn new((metric, claims): (Metric, Claims), scheme: Scheme, runs: &[&Record]) -> Option<Self> {
        let order = observed_order(finest(runs)?, |r| r.discretisation.h, metric);
        let (first, last) = (runs.first()?, runs.last()?);
        let (name, set) = (metric.name, first.set.join(" "));
        let about = format!("{name} of {scheme} {} to {} {set}", first.level, last.level);
        let errors: Vec<f64> = runs.iter().map(|r| r.metric(metric)).collect();
        let ratios = errors.windows(2).map(|pair| pair[1] / pair[0]);
        Some(Self {
            claim: claims(&Setup::of_record(last).ok()?),
            about: about.trim_end().to_owned(),
            order,
            broke: runs.iter().any(|r| r.status == Status::Failed),
            worst_ratio: if errors.iter().any(|e| e.is_nan()) { f64::NAN } else { ratios.fold(0.0, f64::max) },
        })
    }
}

fn on_ladders(check: Gate, of: &[(Metric, Claims)], found: fn(&str, &Ladder) -> Option<Finding>) -> Check {
    let of = of.to_vec();
    let study = move |records: &[Record]| {
        let of_metric = |claimed: &_| {
            let all = ladders(records).into_iter();
            let deciding = all.filter_map(|(scheme, runs)| Ladder::new(*claimed, scheme, &runs));
            deciding.filter_map(|l| found(&format!("order_{}", l.about), &l)).collect::<Vec<_>>()
        };
        of.iter().flat_map(of_metric).collect()
    };
    check.study(study)
}

pub(in crate::cases) fn orders(of: &[(Metric, Claims)]) -> [Check; 4] {
    let second = "second-order theory: rms error of u over the three finest levels of order at least 2 − 0.15";
    let falls = "the rms error of u falls from level to level, where the order is judged";
    let observed = "no theoretical order: observed order within the band stated with the verdict";
    let stalls = "rms error of u of order below 2 − 0.15, or that stated with the verdict, for the reason given there";
    [
        on_ladders(Gate::truth("order-displacement", second), of, |about, l| match l.claim {
            Claim::Second => {
                let why = "second order: linear fields are reproduced, the lumped mass has its centre at the node";
                Some(Finding::above(about, l.order, FORMAL - SLACK, why))
            }
            Claim::Open(why) => Some(Finding::not_applicable(about, why)),
            _ => None,
        }),
        on_ladders(Gate::truth("error-falls", falls), of, |_, l| {
            let (about, why) = (format!("largest ratio of {}", l.about), "a consistent scheme converges");
            matches!(l.claim, Claim::Second).then_some(Finding::at_most(about, l.worst_ratio, 1.0, why))
        }),
        on_ladders(Gate::regression("observed-order", observed), of, |about, l| {
            let Claim::Observed([least, most], why) = l.claim else { return None };
            let (middle, half) = (0.5 * (least + most), 0.5 * (most - least));
            Some(Finding::within(about, l.order, middle, half, why))
        }),
        on_ladders(Gate::known_limit("stalls", stalls), of, |about, l| {
            let Claim::Stalls(below, why) = l.claim else { return None };
            (!l.broke).then(|| Finding::at_most(about, l.order, below, why))
        }),
    ]
}

/// The order of the stress where that of the displacement is claimed.
pub(in crate::cases) fn stress_order(claims: Claims) -> Check {
    let statement = "order of the rms error of σ at least 1 − 0.15, one less than that of u";
    on_ladders(Gate::truth("order-stress", statement), &[(STRESS_L2, claims)], |about, l| {
        let why = "gradients of a second-order displacement";
        matches!(l.claim, Claim::Second).then_some(Finding::above(about, l.order, FORMAL - 1.0 - SLACK, why))
    })
}

#[cfg(test)]
mod tests;
