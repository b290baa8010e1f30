//! Generalised vortex in a ring: rotation and shear with a body force that jumps.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::vortex_ring::{ANGLE, ENTRY};

struct Ring;

impl Known for Ring {
    const SOLUTION: Solution = ENTRY.build;
    const BOUNDARY: Boundary = Boundary::Walls(WallKind::Fixed);
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[(ANGLE, "0.05")], "0.5", &[STEP_POISSON_RATIO]);
}

/// Angles (rad) beyond this shear the ring by more than its own thickness.
const LARGE: f64 = 0.1;
/// Beyond this one runs may break down, as the shear is six and more.
const PARTED: f64 = 1.0;
/// The angle of 45° of the literature.
const EIGHTH: &str = "angle=0.7853981633974483";

pub(super) fn case() -> Case {
    let few = main_pairs();
    let all = pairs(&[Gimp, Bspline2, Bspline3], &COMPARED);
    let all = [all, other_transfers()].concat();
    let plan = Plan::of(metre_levels()[..4].to_vec())
        .runs(Quick, "n8", &few[..1], "")
        .runs(Pr, "n8 n16", &few, "")
        .runs(Nightly, FOUR, &all, "")
        .each(Nightly, THREE, &few, MORE)
        .runs(Nightly, THREE, &few, EIGHTH);
    known_case::<2, Ring>([
        "mms-vortex-ring",
        "Vortex in a ring",
        "A ring of a square block turns about its middle, most at half its thickness and not at all at its edges. Rotation, shear and a body force that jumps.",
    ])
    .planned(plan)
    .breaks_down(|r| (r.parameters.number(ANGLE) > PARTED).then_some("shear of six and more parts particles by cells"))
    .reference("Exact solution: Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x; material at rest fills the square around the ring.")
    .limit("h″ and with it the body force jumps at the two circles: order two in L2 at best, less in L∞.")
    .limit("At the angle of 45° of the literature the shear reaches 4.8: particles on fixed domains lose touch and nothing converges (set angle=0.7853981633974483).")
    // Half a wave across the ring.
    .checks(of_motion(claim, Wave::Shear(|_| TAU)))
    .table(tables::errors("mms-vortex-ring-large", ["n8", "n16", "n32"].map(|n| (n, n, EIGHTH))))
}

fn claim(r: &Setup<()>) -> Claim {
    if r.number(ANGLE) > LARGE {
        Claim::Stalls(1.0, "shear of 4.8 parts particles by five cells and more")
    } else if r.transfer() != TransferName::Flip {
        Claim::Open(TRANSFER)
    } else if r.number(PPC_PER_DIRECTION) > 2.0 {
        Claim::Open("runs with more particles end at n32; the band is that of n16 to n64")
    } else {
        Claim::Observed([1.15, 2.15], "the body force jumps at the two circles: order two at best")
    }
}
