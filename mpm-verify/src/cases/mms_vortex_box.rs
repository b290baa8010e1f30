//! Isochoric vortex in a box: what locks, shows it here.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-box.md`.

use super::manufactured::checks::{self, Claim, Wave, is_sound};
use super::manufactured::plan::{
    BASES, REMEDIES, ladder, more_particles, other_transfers, pairs, union,
};
use super::manufactured::{Manufactured, numerical, parameters, step_poisson_ratio};
use crate::case::{RunSpec, Sweep, Tier};
use crate::exact::vortex_box::ENTRY;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use std::sync::LazyLock;

use BasisName::{Bspline2, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate, FbarTotal};

/// Poisson's ratios of the curve of locking, besides the case's own.
const RATIOS: [&str; 3] = [
    "poisson_ratio=0.3",
    "poisson_ratio=0.49",
    "poisson_ratio=0.499",
];
/// The vortex: its profile falls from one to a half over 0.16 m, a sixth of a wave.
pub(super) const WAVE: Wave = Wave {
    number: 6.5,
    shear: true,
};
/// Below this cell size (m) the motion crosses so many cells that errors have a floor.
const FLOOR: f64 = 0.01;
/// Below this one (m) fbar-total and fbar-rate take enough steps to feed the null space.
const FED: f64 = 0.02;
/// How errors are drawn over Poisson's ratio.
pub(super) const LOCKING_CURVE: &[Sweep] = &[Sweep {
    parameter: "poisson_ratio",
    label: "0.5 − ν",
    abscissa: |nu| 0.5 - nu,
    logarithmic: true,
}];

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: a vortex after Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x, with a profile that is smooth and ends within the box; the balance of momentum is tested by eighth-order differences at random points.",
    ],
    limits: &[
        "Rotation by up to one radian with F updated by I + Δt ∇v: the error in time is first order. All runs take the steps of ν = 0.4999, so that it is small and alike.",
        "fbar-total and fbar-rate lose convergence, and some runs their life, at n64 and beyond.",
        "The spurious pressure at ν = 0.4999 is λ ln J of errors in J of 10⁻⁴ and doesn't fall over these levels.",
    ],
    schemes: [pairs(&BASES, &REMEDIES), other_transfers()].concat(),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study,
    sweeps: LOCKING_CURVE,
    breaks_down: |r| {
        let known = [(Bspline2, FbarRate, "n128"), (Linear, FbarTotal, "n64")];
        let breaks = r.is_default()
            && known
                .iter()
                .any(|k| *k == (r.basis(), r.remedy(), &r.level));
        breaks.then_some(NULL_SPACE)
    },
    ..Manufactured::solid(
        [
            "mms-vortex-box",
            "Vortex in a box",
            "The middle of a square turns by a radian while its sides stay: no volume changes, so the exact motion doesn't depend on Poisson's ratio, and the error at ν = 0.4999 over that at 0.3 is locking and nothing else.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[("poisson_ratio", "0.4999")],
            numerical("0.5")
                .into_iter()
                .chain([step_poisson_ratio("0.4999")]),
        ),
    )
});

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    let few = pairs(
        &[Gimp, Bspline2],
        &[RemedyName::None, FbarRate, FbarConsistent],
    );
    match tier {
        Tier::Quick => ladder(&levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        Tier::Pr => union([
            ladder(&levels[..3], &few, &[]),
            ladder(&levels[..2], &few, &RATIOS[..1]),
        ]),
        Tier::Nightly => {
            let mut parts = vec![
                plan(case, Tier::Pr),
                ladder(&levels[..4], &case.schemes, &[]),
                ladder(&levels[4..], &few[3..], &[]),
                more_particles(&levels[..3]),
            ];
            for ratio in RATIOS {
                parts.push(ladder(&levels[..3], &pairs(&BASES, &REMEDIES), &[ratio]));
            }
            union(parts)
        }
        Tier::Long => ladder(&levels[4..], &case.schemes, &[]),
    }
}

/// Why fbar-total and fbar-rate stop converging.
pub(super) const NULL_SPACE: &str =
    "a pressure that Π can't see feeds the null space as particles pass each other (docs/modes.md)";

/// Whether a scheme feeds the null space for so many steps that it shows.
pub(super) fn feeds_null_space(r: &Record) -> bool {
    matches!(r.remedy(), FbarTotal | FbarRate) && r.discretisation.h < FED
}

/// What is known of convergence of an isochoric motion.
pub(super) fn claim(r: &Record) -> Claim {
    if r.basis() == Linear {
        return Claim::Open("the gradient of a linear basis jumps where particles cross cells");
    }
    if r.transfer() != TransferName::Flip {
        return Claim::Open(checks::TRANSFER);
    }
    if r.discretisation.h < FLOOR {
        return Claim::Open(
            "particles cross ten cells: the quadrature error of two per direction is a floor",
        );
    }
    if feeds_null_space(r) {
        let shears_only = r.parameters.number("pressure").is_nan();
        let clear = shears_only && r.remedy() == FbarRate && matches!(r.basis(), Gimp | Bspline2);
        return if clear {
            Claim::Stalls(1.0, NULL_SPACE)
        } else {
            Claim::Open(NULL_SPACE)
        };
    }
    if is_sound(r.remedy()) {
        Claim::Observed(
            [0.8, 2.6],
            "second order until the quadrature error of sheared particles shows",
        )
    } else if r.remedy() == RemedyName::None {
        Claim::Open("without a remedy the error is that of locking until the cells resolve it")
    } else {
        Claim::Open("Eq. (26) diffuses J; of an isochoric motion it has little to diffuse")
    }
}

/// The gates on refinement and on locking.
pub(super) fn judge_study(records: &[Record]) -> Vec<crate::verdict::Verdict> {
    let mut verdicts = checks::orders_of(records, "displacement_l2", claim);
    verdicts.extend(checks::locking(records));
    verdicts
}
