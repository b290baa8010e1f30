//! Vortex in a box with a bounded pressure: an average must give back the right pressure, not a small one.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-pressure.md`.

use super::manufactured::checks;
use super::manufactured::plan::{
    REMEDIES, ladder, levels, more_particles, other_transfers, pairs, union,
};
use super::manufactured::{Manufactured, numerical, parameters, step_poisson_ratio};
use super::mms_vortex_box::{LOCKING_CURVE, WAVE, claim, judge_study};
use crate::case::{RunSpec, Tier};
use crate::exact::vortex_pressure::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use std::sync::LazyLock;

use BasisName::{Bspline2, Gimp};
use RemedyName::{FbarConsistent, FbarRate};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: the vortex in a box after a volume change whose pressure tends to p₀ sin ωt (cos 2πX + cos 2πY) as ν → ½; body force from the general formula, tested by eighth-order differences at random points.",
    ],
    limits: &[
        "The pressure is 100 Pa; at ν = 0.4999 an error of 10⁻⁴ in J is worth more.",
        "As in mms-vortex-box, all runs take the steps of ν = 0.4999.",
    ],
    schemes: [pairs(&[Gimp, Bspline2], &REMEDIES), other_transfers()].concat(),
    levels: levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    ),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study,
    sweeps: LOCKING_CURVE,
    ..Manufactured::solid(
        [
            "mms-vortex-pressure",
            "Vortex with a bounded pressure",
            "The vortex in a box, with a pressure that stays bounded as the body becomes incompressible: a remedy must not only remove the spurious pressure but leave the true one.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[("poisson_ratio", "0.499")],
            numerical("0.5")
                .into_iter()
                .chain([step_poisson_ratio("0.4999")]),
        ),
    )
});

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    match tier {
        Tier::Quick => ladder(&levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        Tier::Pr => ladder(
            &levels[..2],
            &pairs(&[Gimp, Bspline2], &[FbarRate, FbarConsistent]),
            &[],
        ),
        Tier::Nightly => {
            let mut parts = vec![
                plan(case, Tier::Pr),
                ladder(levels, &case.schemes, &[]),
                more_particles(&levels[..3]),
            ];
            for ratio in [
                "poisson_ratio=0.3",
                "poisson_ratio=0.49",
                "poisson_ratio=0.4999",
            ] {
                parts.push(ladder(
                    &levels[..2],
                    &pairs(&[Gimp, Bspline2], &REMEDIES),
                    &[ratio],
                ));
            }
            union(parts)
        }
        Tier::Long => Vec::new(),
    }
}
