//! Double shear of a periodic body: no boundary at all.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::double_shear::ENTRY;

struct DoubleShear;

impl Known for DoubleShear {
    const SOLUTION: Solution = ENTRY.build;
    const BOUNDARY: Boundary = Boundary::Periodic;
    const PARAMETERS: Composed =
        (&[ENTRY.parameters], &[(POISSON_RATIO, "0.4999")], "0.5", &[STEP_POISSON_RATIO.with_default("0.4999")]);
}

pub(super) fn case() -> Case {
    known_case::<2, DoubleShear>([
        "mms-double-shear",
        "Double shear",
        "A periodic body is sheared along x and then along y at constant volume: nearly incompressible, with cells crossed and without any boundary.",
    ])
    .planned(plan())
    .reference("Exact solution: two shears in turn, x = X + A sin kY s, y = Y + A sin kx s; J = 1 exactly. The balance of momentum is tested by eighth-order differences at random points.")
    .limit("No boundary: mms-vortex-box has walls.")
    .limit("As in mms-vortex-box, all runs take the steps of ν = 0.4999.")
    // One wave across the body.
    .checks(of_motion(claim, Wave::Shear(|_| TAU)))
    .checks(locking())
    .sweep(LOCKING_CURVE)
    .breaks_down(|r| {
        let scheme = (r.basis(), r.remedy()) == (Gimp, FbarTotal);
        (r.is_default() && scheme && r.level == "n64").then_some(NULL_SPACE)
    })
    .pictures(|gallery| mean_stress(gallery, "n64", 100.0))
    .table(tables::locking(
        "mms-double-shear-locking",
        [("n8, 0.4999", "n8", ""), ("n16, 0.4999", "n16", ""), ("n32, 0.4999", "n32", "")],
    ))
    .table(tables::pressure("mms-double-shear-pressure", ["n8", "n16", "n32", "n64"]))
}

fn plan() -> Plan {
    let few = pairs(&SMOOTH, &COMPARED);
    let all = pairs(&BASES, &REMEDIES);
    Plan::of(metre_levels()[..4].to_vec())
        .runs(Quick, "n8", &few[2..3], "")
        .runs(Pr, THREE, &[few[1], few[2], few[5]], "")
        .runs(Nightly, FOUR, &all, "")
        .runs(Nightly, FOUR, &other_transfers(), "")
        .each(Nightly, THREE, &main_pairs(), MORE)
        .runs(Nightly, THREE, &all, "poisson_ratio=0.3")
        .each(Nightly, "n8 n16", &few, ["poisson_ratio=0.49", "poisson_ratio=0.499"])
}

fn claim(r: &Setup<()>) -> Claim {
    match r.basis() {
        Linear => Claim::Open(JUMPS),
        _ if r.transfer() != TransferName::Flip => Claim::Open(TRANSFER),
        Gimp if feeds_null_space(r) => Claim::Stalls(1.0, NULL_SPACE),
        _ if feeds_null_space(r) => Claim::Open(NULL_SPACE),
        _ => of_isochoric(r, [1.4, 2.6]),
    }
}
