//! Axis-aligned displacement with a pressure gradient normal to the walls: what a basis or an average does
//! at a wall.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::wall_pressure::ENTRY;

struct WallPressure;

impl Known for WallPressure {
    const SOLUTION: Solution = ENTRY.build;
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[(AMPLITUDE, "0.001")], "0.013", &DYNAMIC);
}

const LARGE: &str = "amplitude=0.05 ppc_per_direction=4";

/// As without a pressure gradient at the walls, but that the floor of hats is half as high.
fn claim(r: &Setup<()>) -> Claim {
    if r.is_implicit() && r.basis() == Linear {
        return Claim::Open(HATS);
    }
    between_rollers(r)
}

pub(super) fn case() -> Case {
    let large = ["n8", "n16", "n32", "n64"].map(|n| (n, n, LARGE));
    known_case::<2, WallPressure>([
        "mms-wall-pressure",
        "Pressure gradient at walls",
        "A neo-Hookean body between rollers is squeezed along its axes so that the pressure is steepest at the walls. Whether bases and averages keep their order there, with both treatments of splines at a wall.",
    ])
    .planned(plan())
    .reference("Exact solution u_i = 4A X_i (1 − X_i) sin ωt, derived with the code; the balance of momentum is tested by eighth-order differences at random points.")
    .limit("Compression and extension without shear: mms-vortex-box has the shear.")
    .limit("At ν = 0.3 nothing locks.")
    // Half a wave across the body.
    .checks(of_motion(claim, Wave::Pressure(|_| PI)))
    .checks([stress_order(claim)])
    .checks(order_in_time())
    .begun(begin::<WallPressure>)
    .table(tables::orders("mms-wall-pressure-rules", tables::is_of_rule))
    .table(tables::orders("mms-wall-pressure-wall-line", |r| r.changes("wall=wall-line") && is_flip(r)))
    .table(tables::errors("mms-wall-pressure-large", large))
}

fn plan() -> Plan {
    let few = [RemedyName::None, FbarRate, FbarConsistent];
    let moved = implicit(&[RuleName::Midpoint, RuleName::Newmark], &BASES[..3], &few[..1]);
    // GIMP's consistent mass is singular once particles have moved.
    let definite = [moved[0], moved[2]];
    let own = pairs(&SMOOTH, &few);
    let splines = pairs(&[Bspline2, Bspline3], &few);
    let solid = pairs(&SMOOTH, &[FbarRecursive, FbarConsistent]);
    // Steps, each half as long as the one before; the same with a consistent and a lumped mass.
    let halved = ["cfl=0.4375", "cfl=0.21875", "cfl=0.109375"];
    let consistent = halved.map(|cfl| format!("{cfl} lumped=0"));
    let lumped = halved.map(|cfl| format!("{cfl} lumped=1"));
    Plan::of(metre_levels())
        .runs(Quick, "n8", &own[..1], "")
        .runs(Pr, THREE, &own, "")
        .runs(Pr, THREE, &splines[..1], "wall=wall-line")
        .runs(Nightly, FIVE, &pairs(&BASES, &REMEDIES), "")
        .runs(Nightly, FIVE, &other_transfers(), "")
        .runs(Nightly, FOUR, &moved, "cfl=2")
        .runs(Long, "n128", &moved, "cfl=2")
        .each(Nightly, THREE, &main_pairs(), MORE)
        .runs(Nightly, FOUR, &splines, "wall=wall-line")
        .runs(Nightly, FOUR, &pairs(&BASES, &few), LARGE)
        .runs(Nightly, THREE, &solid, "dimension=3")
        .each(Pr, "n8", &definite[1..], &consistent)
        .each(Nightly, "n16", &definite, &consistent)
        .each(Nightly, "n16", &moved, halved)
        .each(Nightly, "n16", &moved[..3], &lumped)
}
