//! Isochoric vortex in a box: what locks, shows it here.

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::vortex_box::ENTRY;

struct Vortex;

impl Known for Vortex {
    const SOLUTION: Solution = ENTRY.build;
    const PARAMETERS: Composed = (
        &[ENTRY.parameters],
        &[(POISSON_RATIO, "0.4999")],
        "0.5",
        &[STEP_POISSON_RATIO.with_default("0.4999"), LUMPED, ALPHA, DELTA, common::TOLERANCE],
    );
}

pub(super) fn case() -> Case {
    known_case::<2, Vortex>([
        "mms-vortex-box",
        "Vortex in a box",
        "The middle of a square turns by a radian while its sides stay: no volume changes, so the exact motion doesn't depend on Poisson's ratio, and the error at ν = 0.4999 over that at 0.3 is locking and nothing else.",
    ])
    .planned(plan())
    .reference("Exact solution: a vortex after Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x, with a profile that is smooth and ends within the box; the balance of momentum is tested by eighth-order differences at random points.")
    .limit("Rotation by up to one radian with F updated by I + Δt ∇v: the error in time is first order. All runs take the steps of ν = 0.4999, so that it is small and alike.")
    .limit("fbar-total and fbar-rate lose convergence, and some runs their life, at n64 and beyond.")
    .limit("The spurious pressure at ν = 0.4999 is λ ln J of errors in J of 10⁻⁴ and doesn't fall over these levels.")
    .checks(of_motion(of_vortex, VORTEX))
    .checks(locking())
    .sweep(LOCKING_CURVE)
    .breaks_down(|r| {
        let scheme = (r.basis(), r.remedy(), &*r.level);
        let known = matches!(scheme, (Bspline2, FbarRate, "n128") | (Linear | Gimp, FbarTotal, "n64"));
        (r.is_default() && known).then_some(NULL_SPACE)
    })
    .pictures(|gallery| mean_stress(gallery, "n32", 600.0))
    .tables(tables())
}

fn plan() -> Plan {
    let few = pairs(&SMOOTH, &COMPARED);
    let all = pairs(&BASES, &REMEDIES);
    let limit = pairs(&SMOOTH, &[RemedyName::None, FbarRecursive, FbarConsistent]);
    let [midpoint, newmark] = [RuleName::Midpoint, RuleName::Newmark]
        .map(|rule| implicit(&[rule], &SMOOTH, &[RemedyName::None, FbarConsistent]));
    let near = ["0.49999", "0.499999", "0.4999999"];
    let explicit = near.map(|nu| format!("poisson_ratio={nu} step_poisson_ratio={nu}"));
    let implicit = near.map(|nu| format!("cfl=50 poisson_ratio={nu}"));
    let soft = ["poisson_ratio=0.3", "poisson_ratio=0.499"];
    Plan::of(metre_levels())
        .runs(Quick, "n8", &few[2..3], "")
        .runs(Pr, THREE, &few, "")
        .runs(Pr, "n8 n16", &few, "poisson_ratio=0.3")
        .runs(Nightly, FOUR, &all, "")
        .runs(Nightly, FOUR, &other_transfers(), "")
        .each(Pr, "n8 n16", &midpoint[..2], ["cfl=50", "cfl=50 poisson_ratio=0.3"])
        .runs(Nightly, FOUR, &midpoint, "cfl=50")
        .runs(Nightly, "n8 n16", &midpoint, "cfl=50 poisson_ratio=0.3")
        .runs(Nightly, THREE, &midpoint, "cfl=50 poisson_ratio=0.499")
        .runs(Nightly, THREE, &newmark, "cfl=10")
        .runs(Nightly, "n8 n16", &newmark, "cfl=10 poisson_ratio=0.3")
        .runs(Long, "n128", &midpoint, "cfl=50")
        .runs(Long, "n64 n128", &newmark, "cfl=10")
        .each(Nightly, THREE, &main_pairs(), MORE)
        .each(Nightly, "n8 n16", &limit, explicit)
        .each(Nightly, "n8 n16", &midpoint, implicit)
        .each(Nightly, THREE, &all, soft)
        .runs(Long, "n128", &all, "")
        .runs(Long, "n128", &other_transfers(), "")
}

fn tables() -> Vec<ResultTable> {
    vec![
        tables::locking(
            "mms-vortex-box-locking",
            [
                ("n8, ν = 0.499", "n8", "poisson_ratio=0.499"),
                ("n8, 0.4999", "n8", ""),
                ("n16, 0.499", "n16", "poisson_ratio=0.499"),
                ("n16, 0.4999", "n16", ""),
                ("n32, 0.499", "n32", "poisson_ratio=0.499"),
                ("n32, 0.4999", "n32", ""),
            ],
        ),
        tables::price("mms-vortex-box-price", ["n8", "n16", "n32"], "poisson_ratio=0.3"),
        tables::pressure("mms-vortex-box-pressure", ["n8", "n16", "n32", "n64", "n128"]),
        limit("mms-vortex-box-limit"),
        tables::cost("mms-vortex-box-cost", ["n8", "n16", "n32"], |r| {
            let compared = [RemedyName::None, FbarConsistent].contains(&r.remedy());
            compared && tables::is_smooth(r) && r.changes_none_but(&[CFL.name])
        }),
    ]
}

/// Error over the motion, steps and cost at n16 towards incompressibility, at the CFL numbers of the case.
fn limit(name: &str) -> ResultTable {
    let of_ratio = |ratio: f64| {
        let at = move |r: &Record| r.parameters.number(POISSON_RATIO) == ratio;
        [
            Column::metric(format!("ν = {ratio}"), DISPLACEMENT_L2, SHORT).of(at),
            Column::value("steps", |r| r.work.steps as f64, fixed(0)).of(at),
            Column::value("CPU (s)", |r| r.time.cpu_s, fixed(1)).of(at),
        ]
    };
    let shows = |r: &Record| {
        let set = [POISSON_RATIO.name, STEP_POISSON_RATIO.name, CFL.name];
        let remedies = [RemedyName::None, FbarRecursive, FbarConsistent];
        let own = is_flip(r) || r.set.iter().any(|s| s == "cfl=50");
        r.level == "n16" && r.changes_none_but(&set) && own && tables::is_smooth(r) && remedies.contains(&r.remedy())
    };
    let ratios = [0.4999, 0.49999, 0.499999, 0.4999999];
    ResultTable::new(name, shows, &[SCHEME], ratios.into_iter().flat_map(of_ratio))
}
