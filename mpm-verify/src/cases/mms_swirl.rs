//! Isochoric swirl in three dimensions.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::swirl::ENTRY;

struct Swirl;

impl Known for Swirl {
    const SOLUTION: Solution = ENTRY.build;
    const BOUNDARY: Boundary = Boundary::Walls(WallKind::Fixed);
    const PARAMETERS: Composed =
        (&[ENTRY.parameters], &[(POISSON_RATIO, "0.499")], "0.5", &[STEP_POISSON_RATIO.with_default("0.499")]);
}

pub(super) fn case() -> Case {
    let few = pairs(&SMOOTH, &COMPARED);
    let plan = Plan::of(metre_levels()[..3].to_vec())
        .runs(Quick, "n8", &few[2..3], "")
        .runs(Pr, "n8", &few, "")
        .runs(Nightly, THREE, &few, "")
        .runs(Nightly, "n8 n16", &few, "poisson_ratio=0.3")
        .each(Nightly, "n8", &main_pairs(), MORE)
        .each(Long, "n16", &main_pairs(), MORE);
    known_case::<3, Swirl>([
        "mms-swirl",
        "Swirl in three dimensions",
        "The middle of a cube turns about the vertical by an angle that is largest in the centre and vanishes on all sides: isochoric, in three dimensions.",
    ])
    .planned(plan)
    .reference("Exact solution: the vortex in a box, its angle falling to zero at floor and ceiling; derived with the code, the balance of momentum is tested by eighth-order differences at random points.")
    .limit("Three levels, the coarsest with three cells across the radius of the vortex.")
    .limit("The steps are those of ν = 0.499.")
    .checks(of_motion(of_vortex, VORTEX))
    .checks(locking())
    .table(tables::locking("mms-swirl-locking", [("n8", "n8", ""), ("n16", "n16", "")]))
    .table(tables::pressure("mms-swirl-pressure", ["n8", "n16", "n32"]))
}
