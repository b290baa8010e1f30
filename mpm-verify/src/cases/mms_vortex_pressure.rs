//! Vortex in a box with a bounded pressure: an average must give back the right pressure, not a small one.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::vortex_pressure::ENTRY;

struct PressedVortex;

impl Known for PressedVortex {
    const SOLUTION: Solution = ENTRY.build;
    const PARAMETERS: Composed =
        (&[ENTRY.parameters], &[(POISSON_RATIO, "0.499")], "0.5", &[STEP_POISSON_RATIO.with_default("0.4999")]);
}

pub(super) fn case() -> Case {
    known_case::<2, PressedVortex>([
        "mms-vortex-pressure",
        "Vortex with a bounded pressure",
        "The vortex in a box, with a pressure that stays bounded as the body becomes incompressible: a remedy must not only remove the spurious pressure but leave the true one.",
    ])
    .planned(plan())
    .reference("Exact solution: the vortex in a box after a volume change whose pressure tends to p₀ sin ωt (cos 2πX + cos 2πY) as ν → ½; body force from the general formula, tested by eighth-order differences at random points.")
    .limit("The pressure is 100 Pa; at ν = 0.4999 an error of 10⁻⁴ in J is worth more.")
    .limit("As in mms-vortex-box, all runs take the steps of ν = 0.4999.")
    .checks(of_motion(of_vortex, VORTEX))
    .checks(locking())
    .sweep(LOCKING_CURVE)
    .table(tables::locking(
        "mms-vortex-pressure-locking",
        [
            ("n8, ν = 0.49", "n8", "poisson_ratio=0.49"),
            ("n8, 0.499", "n8", ""),
            ("n8, 0.4999", "n8", "poisson_ratio=0.4999"),
            ("n16, 0.49", "n16", "poisson_ratio=0.49"),
            ("n16, 0.499", "n16", ""),
            ("n16, 0.4999", "n16", "poisson_ratio=0.4999"),
        ],
    ))
    .table(tables::pressure("mms-vortex-pressure-pressure", ["n8", "n16", "n32", "n64"]))
}

fn plan() -> Plan {
    let all = pairs(&SMOOTH, &REMEDIES);
    let sound = pairs(&SMOOTH, &[FbarRate, FbarConsistent]);
    let ratios = ["poisson_ratio=0.3", "poisson_ratio=0.49", "poisson_ratio=0.4999"];
    Plan::of(metre_levels()[..4].to_vec())
        .runs(Quick, "n8", &sound[1..2], "")
        .runs(Pr, "n8 n16", &sound, "")
        .runs(Nightly, FOUR, &all, "")
        .runs(Nightly, THREE, &other_transfers(), "")
        .runs(Long, "n64", &other_transfers(), "")
        .each(Nightly, THREE, &main_pairs(), MORE)
        .each(Nightly, "n8 n16", &all, ratios)
}
