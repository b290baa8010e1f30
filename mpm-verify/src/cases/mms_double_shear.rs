//! Double shear of a periodic body: no boundary at all.
//!
//! Set-up, choices and tolerances: `docs/mms-double-shear.md`.

use super::manufactured::checks::{self, Claim, Wave, is_sound};
use super::manufactured::plan::{
    BASES, REMEDIES, ladder, levels, more_particles, other_transfers, pairs, union,
};
use super::manufactured::{Boundary, Manufactured, numerical, parameters, step_poisson_ratio};
use super::mms_vortex_box::{LOCKING_CURVE, NULL_SPACE, feeds_null_space};
use crate::case::{RunSpec, Tier};
use crate::exact::double_shear::ENTRY;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use std::f64::consts::TAU;
use std::sync::LazyLock;

use BasisName::{Bspline2, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate};

/// The motion: a wave across the cell.
const WAVE: Wave = Wave {
    number: TAU,
    shear: true,
};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: two shears in turn, x = X + A sin kY s, y = Y + A sin kx s; J = 1 exactly. The balance of momentum is tested by eighth-order differences at random points.",
    ],
    limits: &[
        "No boundary: mms-vortex-box has walls.",
        "As in mms-vortex-box, all runs take the steps of ν = 0.4999.",
    ],
    boundary: Boundary::Periodic,
    schemes: [pairs(&BASES, &REMEDIES), other_transfers()].concat(),
    levels: levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    ),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study: |records| {
        let mut verdicts = checks::orders_of(records, "displacement_l2", claim);
        verdicts.extend(checks::locking(records));
        verdicts
    },
    sweeps: LOCKING_CURVE,
    ..Manufactured::solid(
        [
            "mms-double-shear",
            "Double shear",
            "A periodic body is sheared along x and then along y at constant volume: nearly incompressible, with cells crossed and without any boundary.",
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
        Tier::Pr => ladder(&levels[..3], &[few[1], few[2], few[5]], &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(levels, &case.schemes, &[]),
            more_particles(&levels[..3]),
            ladder(
                &levels[..3],
                &pairs(&BASES, &REMEDIES),
                &["poisson_ratio=0.3"],
            ),
            ladder(&levels[..2], &few, &["poisson_ratio=0.49"]),
            ladder(&levels[..2], &few, &["poisson_ratio=0.499"]),
        ]),
        Tier::Long => Vec::new(),
    }
}

fn claim(r: &Record) -> Claim {
    if r.basis() == Linear {
        return Claim::Open("the gradient of a linear basis jumps where particles cross cells");
    }
    if r.transfer() != TransferName::Flip {
        return Claim::Open(checks::TRANSFER);
    }
    if feeds_null_space(r) {
        return if r.basis() == Gimp {
            Claim::Stalls(1.0, NULL_SPACE)
        } else {
            Claim::Open(NULL_SPACE)
        };
    }
    if is_sound(r.remedy()) {
        Claim::Observed(
            [1.4, 2.6],
            "second order until the quadrature error of sheared particles shows",
        )
    } else if r.remedy() == RemedyName::None {
        Claim::Open("without a remedy the error is that of locking until the cells resolve it")
    } else {
        Claim::Open("Eq. (26) diffuses J; of an isochoric motion it has little to diffuse")
    }
}
