//! Axis-aligned displacement: compression and extension without shear, in one, two and three dimensions.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::axis_aligned::{ENTRY, HALF_WAVES};

struct Axes;

impl Known for Axes {
    const SOLUTION: Solution = ENTRY.build;
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[(AMPLITUDE, "0.001")], "0.013", &DYNAMIC);
}

pub(super) fn case() -> Case {
    // Half waves across the body, a wave by default.
    let wave = Wave::Pressure(|p| PI * p.number(HALF_WAVES));
    known_case::<2, Axes>([
        "mms-axis",
        "Axis-aligned displacement",
        "A neo-Hookean body between rollers is stretched and compressed along its axes by a body force that makes the motion known. Orders of accuracy in space and time for every basis, remedy and transfer; small displacements and forced crossing of cells.",
    ])
    .planned(plan())
    .reference("Exact solution: Wallstedt & Guilkey 2008, doi:10.1016/j.jcp.2008.07.019, with a phase per axis; the balance of momentum is tested by eighth-order differences at random points.")
    .limit("∂J/∂n = 0 at the walls: mms-wall-pressure tests what this problem hides there.")
    .limit("At ν = 0.3 nothing locks; what averaging costs shows, what it is for doesn't.")
    .limit("Two particles per direction leave a floor once they cross cells, and cubic splines with F̄ and two per direction break the pattern at large strain.")
    .checks(of_motion(between_rollers, wave))
    .checks([stress_order(between_rollers)])
    .checks(order_in_time())
    .sweep(Sweep::of(PPC_PER_DIRECTION, "particles per direction"))
    .sweep(Sweep::of(CFL, "CFL number").logarithmic())
    .begun(begin::<Axes>)
    .tables(tables())
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let main = pairs(&SMOOTH, &[none, FbarRecursive, FbarRate, FbarConsistent]);
    let sound = |bases: &[BasisName]| pairs(bases, &[none, FbarRate, FbarConsistent]);
    let compared = pairs(&[Gimp], &[FbarRecursive, FbarConsistent]);
    let all = pairs(&BASES, &REMEDIES);
    let pair = pairs(&SMOOTH, &REMEDIES);
    // The step that the program offers: stable, and right.
    let offered = pairs(&BASES[1..], &[none, FbarConsistent]);
    let large = pairs(&SMOOTH, &[none]);
    let musl = [Scheme::explicit(Gimp, none, TransferName::Musl)];
    let rules = [RuleName::Midpoint, RuleName::Newmark];
    let moved = implicit(&rules, &BASES[..3], &[none]);
    let smooth = implicit(&rules[..1], &SMOOTH, &[none]);
    let shorter = ["cfl=0.15", "cfl=0.075", "cfl=0.0375"];
    let densities = ["ppc_per_direction=1", MORE[0], MORE[1]];
    Plan::of(metre_levels())
        .runs(Quick, "n8", &large[..1], "")
        .runs(Pr, THREE, &main, "")
        .runs(Pr, THREE, &compared, "step_scaling=h2")
        // Only so large a motion tells where a body force is evaluated; no particle crosses yet.
        .runs(Pr, THREE, &large, "amplitude=0.005")
        .runs(Nightly, FIVE, &all, "")
        .runs(Pr, "n8", &offered, "time_step=auto")
        .runs(Nightly, FOUR, &other_transfers(), "")
        .runs(Nightly, FOUR, &musl, "")
        .runs(Long, "n128", &[other_transfers(), musl.to_vec()].concat(), "")
        .runs(Nightly, FOUR, &pair, "step_scaling=h2")
        .runs(Nightly, FOUR, &sound(&BASES), "amplitude=0.02")
        .runs(Nightly, FOUR, &sound(&BASES[1..]), "amplitude=0.02 ppc_per_direction=4")
        .runs(Nightly, FOUR, &pair, "dimension=1")
        .runs(Nightly, THREE, &sound(&SMOOTH), "dimension=3")
        .runs(Pr, THREE, &smooth[1..], "cfl=2")
        .runs(Nightly, FOUR, &moved, "cfl=2")
        .runs(Nightly, THREE, &moved[..3], "amplitude=0.02 cfl=2")
        .runs(Nightly, "n16 n32", &smooth, "cfl=0.5")
        .runs(Nightly, "n16 n32 n64", &smooth, "cfl=5")
        .runs(Nightly, "n64", &smooth, "cfl=50")
        .runs(Long, "n128", &moved, "cfl=2")
        .each(Nightly, THREE, &main_pairs(), MORE)
        .each(Nightly, "n16", &pair, shorter)
        .each(Nightly, "n32", &sound(&BASES), densities)
}

fn tables() -> Vec<ResultTable> {
    const TWO: &str = "amplitude=0.02";
    vec![
        tables::orders("mms-axis-rules", tables::is_of_rule),
        tables::cost("mms-axis-cost", ["n16", "n32", "n64"], |r| {
            let own = r.changes_none_but(&[CFL.name]);
            r.remedy() == RemedyName::None && tables::is_smooth(r) && own
        }),
        tables::orders("mms-axis-transfers", |r| r.is_default() && !is_flip(r)),
        tables::price("mms-axis-price", ["n8", "n16", "n32", "n64", "n128"], ""),
        tables::errors("mms-axis-crossing", ["n8", "n16", "n32", "n64"].map(|n| (n, n, TWO))),
        tables::errors(
            "mms-axis-particles",
            [
                ("1 per direction", "n32", "ppc_per_direction=1"),
                ("2", "n32", ""),
                ("3", "n32", "ppc_per_direction=3"),
                ("4", "n32", "ppc_per_direction=4"),
            ],
        ),
    ]
}
