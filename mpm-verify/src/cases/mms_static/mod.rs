//! A vortex in a box so slow that it is always in equilibrium: the quasi-static solver against an exact solution.

mod run;

use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact::vortex_pressure::PRESSURE;
use run::SlowVortex;

const LOAD_STEPS: Parameter = common::LOAD_STEPS.meaning("quasi-static: equal steps of time");
const SOFT: &str = "poisson_ratio=0.3";
const PRESSED: &str = "pressure=100";
/// Poisson's ratios of the tables.
const RATIOS: [f64; 7] = [0.3, 0.49, 0.499, 0.4999, 0.49999, 0.499999, 0.4999999];
/// Largest difference of a run from one that has the stiffness of the unseen everywhere.
const ALIKE: f64 = 0.1;

metrics! { STATIC:
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    LINEAR_ITERATIONS = "linear_iterations", "-", "solutions by factors, with F̄ iterations of conjugate gradients";
}

pub(super) fn case() -> Case {
    let shared = [
        DISPLACEMENT_L2,
        DISPLACEMENT_LINF,
        STRESS_L2,
        STRESS_LINF,
        MEAN_STRESS_L2,
        MEAN_STRESS_LINF,
        DISPLACEMENT_SCALE,
        LOG_JACOBIAN_GAP,
        MASS,
        BODY_MASS,
    ];
    let iterations_a_step = |r: &Record| r.metric(NEWTON_ITERATIONS) / r.work.steps as f64;
    known_case::<2, SlowVortex>([
        "mms-static",
        "Slow vortex in a box",
        "The middle of a square turns so slowly that the body is always in equilibrium, by the quasi-static solver: isochoric, or with a pressure that is known. Second order in u; with F̄ no locking.",
    ])
    .planned(plan())
    .limit("Quadrature by moved particles: of linear functions, whose gradients jump, it spoils convergence from the second step on.")
    .limit("In three dimensions one level: a direct factorisation fills up.")
    .sweep(LOCKING_CURVE)
    .reference("Exact solution: that of mms-vortex-pressure, in three dimensions of mms-swirl, at a frequency whose inertia is below 10⁻¹⁰ of the forces.")
    .checks(of_motion(claim, VORTEX))
    .checks([stress_order(claim)])
    .checks(locking())
    .checks([unseen_locks()])
    .metrics([&shared, STATIC].concat())
    .anew()
    .wanted("displacement", "rms error of u at the end", "error-bound")
    .missed_by("motion-lost beyond-bound")
    .headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 8)
    .headline(STRESS_L2, "σ rms error (Pa)", 1.0, 2)
    .headline(MEAN_STRESS_L2, "σ_m rms error (Pa)", 1.0, 2)
    .headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 6)
    .headline(DISPLACEMENT_SCALE, "u rms (m)", 1.0, 6)
    .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
    .quantity(error(DISPLACEMENT_L2, "rms error of u (m)").of_order(2.0))
    .quantity(error(STRESS_L2, "rms error of σ (Pa)").of_order(1.0))
    .quantity(error(MEAN_STRESS_L2, "rms error of σ_m (Pa)").of_order(1.0))
    .watched(&["displacement_l2", "newton_iterations"])
    .cost(|spec| 1e-4 * spec.level.h.powi(-3))
    .begun(run::begin)
    .table(over_cells("mms-static", ""))
    .table(over_cells("mms-static-soft", SOFT))
    .table(over_cells("mms-static-pressure", PRESSED))
    .table(over_ratios("mms-static-ratios", tables::relative_error, share(2)))
    .table(over_ratios("mms-static-iterations", iterations_a_step, fixed(1)))
}

fn plan() -> Plan {
    let remedies = [RemedyName::None, FbarConsistent];
    let [all, few] = [&BASES[..], &SMOOTH].map(|bases| implicit(&[RuleName::QuasiStatic], bases, &remedies));
    let averaged = &few[3..];
    let near = ["poisson_ratio=0.49999", "poisson_ratio=0.499999", "poisson_ratio=0.4999999"];
    Plan::of(metre_levels()[..3].to_vec())
        .runs(Quick, "n8", averaged, "")
        .runs(Pr, THREE, averaged, "")
        .runs(Pr, "n8 n16", &few, "")
        .runs(Pr, THREE, averaged, SOFT)
        .runs(Pr, "n8 n16", &few, SOFT)
        .runs(Pr, "n8", averaged, PRESSED)
        .each(Nightly, THREE, &all, ["", SOFT, "poisson_ratio=0.49", "poisson_ratio=0.499"])
        .each(Nightly, "n8 n16", &all, near)
        .runs(Nightly, THREE, &all, "load_steps=1")
        .runs(Nightly, THREE, &few, "load_steps=16")
        .runs(Nightly, THREE, &all, PRESSED)
        // Another pressure, as the body is softer: no pair for the check of locking, whose motion mustn't depend on ν.
        .runs(Nightly, THREE, &all, "poisson_ratio=0.3 pressure=20")
        .runs(Nightly, THREE, &few, "ppc_per_direction=4")
        .each(Nightly, "n8", &few, ["dimension=3", "dimension=3 poisson_ratio=0.3"])
}

/// Errors relative to the motion over the cells, and the error of the mean stress, of runs that change `set`.
fn over_cells(name: &str, set: &'static str) -> ResultTable {
    let levels = ["n8", "n16", "n32"];
    let error = |level| Column::value(format!("error of u, {level}"), tables::relative_error, share(2)).at(level);
    let titled = levels.map(|level| (level, format!("of σ_m (Pa), {level}")));
    let columns = levels.map(error).into_iter().chain(Column::levels(titled, MEAN_STRESS_L2, SHORT));
    ResultTable::new(name, move |r| r.changes(set), &[SCHEME], columns)
}

/// A number at n16 over Poisson's ratios.
fn over_ratios(name: &str, value: fn(&Record) -> f64, format: Format) -> ResultTable {
    let columns = RATIOS.map(|ratio| {
        Column::value(format!("ν = {ratio}"), value, format).of(move |r| r.parameters.number(POISSON_RATIO) == ratio)
    });
    ResultTable::new(name, |r| r.level == "n16" && r.changes_none_but(&[POISSON_RATIO.name]), &[SCHEME], columns)
}

/// Where the stiffness ε² K of what the average can't see is what locks.
fn unseen_locks() -> Check {
    let compressible = |r: &Run<()>| 1.0 - 2.0 * r.number(POISSON_RATIO);
    let own = |r: &Run<()>| r.basis() == Gimp && r.record.changes_none_but(&[POISSON_RATIO.name]);
    Gate::known_limit("unseen-locks", "GIMP, fbar-consistent beyond 1 − 2ν = ε²: rms error of u that of no remedy at 1 − 2ν′ = (1 − 2ν)/ε², within a tenth")
        .when(move |r| own(r) && is_beyond_unseen(r))
        .pairs(
            move |r, like| {
                let soft = compressible(r) / (UNSEEN * UNSEEN);
                own(like)
                    && like.remedy() == RemedyName::None
                    && like.level == r.level
                    && (compressible(like) / soft - 1.0).abs() < 1e-6
            },
            |r, like| {
                let (metric, level, set) = (DISPLACEMENT_L2.name, &r.level, like.set.join(" "));
                format!("{metric} of {level} over that of none at {set}")
            },
            |r, like| r.metric(DISPLACEMENT_L2) / like.metric(DISPLACEMENT_L2),
        )
        .within(|_| 1.0, |_| ALIKE)
        .because("strains that Π can't see are as stiff as without a remedy at that ratio, and more than nodes can avoid")
}

fn claim(r: &Setup<()>) -> Claim {
    let squeezed = r.number(PRESSURE) > 0.0;
    let stiff = r.number(POISSON_RATIO) > 0.3;
    match (r.basis(), r.remedy()) {
        (Linear, _) if r.number(LOAD_STEPS) > 1.0 => Claim::Open(JUMPS),
        (_, RemedyName::None) if stiff => Claim::Open(LOCKS),
        (Bspline3, _) if squeezed => {
            Claim::Open("two particles per direction don't integrate cubics at a wall that a pressure acts on")
        }
        (Gimp, _) if squeezed => {
            Claim::Observed([1.5, 3.1], "domains of fixed size part and overlap where the body is strained")
        }
        _ => Claim::Second,
    }
}
