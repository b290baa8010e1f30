//! Generalised vortex in a ring: rotation and shear with a body force that jumps.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-ring.md`.

use super::manufactured::checks::{self, Claim, Wave};
use super::manufactured::plan::{ladder, levels, more_particles, other_transfers, pairs, union};
use super::manufactured::{Boundary, Manufactured, numerical, parameters, step_poisson_ratio};
use crate::case::{RunSpec, Tier};
use crate::exact::vortex_ring::ENTRY;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use mpm_core::stage::WallKind;
use std::f64::consts::TAU;
use std::sync::LazyLock;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate};

/// Angles (rad) beyond this shear the ring by more than its own thickness.
const LARGE: f64 = 0.1;

/// The motion: half a wave across the ring.
const WAVE: Wave = Wave {
    number: TAU,
    shear: true,
};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x; material at rest fills the square around the ring.",
    ],
    limits: &[
        "h″ and with it the body force jumps at the two circles: order two in L2 at best, less in L∞.",
        "At the angle of 45° of the literature the shear reaches 4.8: particles on fixed domains lose touch and nothing converges (set angle=0.7853981633974483).",
    ],
    boundary: Boundary::Walls(WallKind::Fixed),
    schemes: [
        pairs(
            &[Gimp, Bspline2, Bspline3],
            &[RemedyName::None, FbarRate, FbarConsistent],
        ),
        other_transfers(),
    ]
    .concat(),
    levels: levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    ),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study: |records| checks::orders_of(records, "displacement_l2", claim),
    ..Manufactured::solid(
        [
            "mms-vortex-ring",
            "Vortex in a ring",
            "A ring of a square block turns about its middle, most at half its thickness and not at all at its edges. Rotation, shear and a body force that jumps.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[("angle", "0.05")],
            numerical("0.5")
                .into_iter()
                .chain([step_poisson_ratio("0.49")]),
        ),
    )
});

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    let few = pairs(&[Gimp, Bspline2], &[RemedyName::None, FbarConsistent]);
    match tier {
        Tier::Quick => ladder(&levels[..1], &few[..1], &[]),
        Tier::Pr => ladder(&levels[..2], &few, &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(levels, &case.schemes, &[]),
            more_particles(&levels[..3]),
            ladder(&levels[..3], &few, &["angle=0.7853981633974483"]),
        ]),
        Tier::Long => Vec::new(),
    }
}

fn claim(r: &Record) -> Claim {
    if r.parameters.number("angle") > LARGE {
        Claim::Stalls(1.0, "shear of 4.8 parts particles by five cells and more")
    } else if r.transfer() != TransferName::Flip {
        Claim::Open(checks::TRANSFER)
    } else if r.parameters.number("ppc_per_direction") > 2.0 {
        Claim::Open("runs with more particles end at n32; the band is that of n16 to n64")
    } else {
        Claim::Observed(
            [1.15, 2.15],
            "the body force jumps at the two circles: order two at best",
        )
    }
}
