//! Isochoric swirl in three dimensions.
//!
//! Set-up, choices and tolerances: `docs/mms-swirl.md`.

use super::manufactured::checks;
use super::manufactured::plan::{ladder, levels, more_particles, pairs, union};
use super::manufactured::{Boundary, Manufactured, numerical, parameters, step_poisson_ratio};
use super::mms_vortex_box::{WAVE, claim, judge_study};
use crate::case::{RunSpec, Tier};
use crate::exact::swirl::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use mpm_core::stage::WallKind;
use std::sync::LazyLock;

use BasisName::{Bspline2, Gimp};
use RemedyName::{FbarConsistent, FbarRate};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: the vortex in a box, its angle falling to zero at floor and ceiling; derived with the code, the balance of momentum is tested by eighth-order differences at random points.",
    ],
    limits: &[
        "Three levels, the coarsest with three cells across the radius of the vortex.",
        "The steps are those of ν = 0.499.",
    ],
    boundary: Boundary::Walls(WallKind::Fixed),
    schemes: pairs(
        &[Gimp, Bspline2],
        &[RemedyName::None, FbarRate, FbarConsistent],
    ),
    levels: levels(1.0, [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)]),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study,
    ..Manufactured::solid(
        [
            "mms-swirl",
            "Swirl in three dimensions",
            "The middle of a cube turns about the vertical by an angle that is largest in the centre and vanishes on all sides: isochoric, in three dimensions.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[("poisson_ratio", "0.499")],
            numerical("0.5")
                .into_iter()
                .chain([step_poisson_ratio("0.499")]),
        ),
    )
});

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    match tier {
        Tier::Quick => ladder(&levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        Tier::Pr => ladder(&levels[..1], &case.schemes, &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(&levels[..2], &case.schemes, &[]),
            ladder(&levels[2..], &case.schemes, &[]),
            ladder(&levels[..2], &case.schemes, &["poisson_ratio=0.3"]),
            more_particles(&levels[..2]),
        ]),
        Tier::Long => Vec::new(),
    }
}
