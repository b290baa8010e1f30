//! Solid and water at finite strain whose motion and pressure are known: the solver of both against an exact solution.

mod checks;
mod run;

use super::poro::spaces;
use crate::cases::prelude::*;
use crate::exact::common as solutions;
use run::Moving;

const LEVELS: [(&str, f64); 4] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)];
/// Particles cross cells, and hardly any water flows.
const CROSSING: &str = "amplitude=0.04";
const TIGHT: &str = "conductivity=1e-6";
/// Steps that err in time.
const TIMES: [&str; 3] = ["source=rates", "source=rates steps=8", "source=rates steps=16"];

choices! {
    enum Law { KozenyCarman = "kozeny-carman", Constant = "constant" }
    enum Source { Steps = "steps", Rates = "rates" }
    enum Start { Particles = "particles", Zero = "zero" }
}

parameters! {
    struct Motion {
        dimension: i32 = whole("-", "2", 1, 2), "dimension: 1 uniaxial strain, 2 plane strain";
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e5");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.25");
        porosity: f64 = real("-", "0.4", 0.05, 0.95), "porosity of the undeformed body";
        conductivity: f64 = real("m/s", "1e-4", 1e-12, 1.0), "hydraulic conductivity k of the undeformed body, of water of 9810 N/m³";
        conductivity_law: Law = Law::KozenyCarman.by_default(), "how it depends on the porosity";
        gravity: f64 = solutions::GRAVITY;
        amplitude: f64 = solutions::AMPLITUDE.with_default("0.005"), "amplitude A of u: particles cross cells where it exceeds h/4; F needs A < 0.07 m to keep its pores open";
        pressure: f64 = real("Pa", "1e4", 0.0, 1e6), "amplitude P of the pressure beside that of the water's weight";
        angular_frequency: f64 = solutions::ANGULAR_FREQUENCY.with_default("0.015707963267948967"), "angular frequency ω: the default duration is a quarter of a period";
        duration: f64 = real("s", "100", 1e-3, 1e6), "time to run";
        steps: i32 = whole("-", "4", 1, 10_000), "equal steps";
        source: Source = Source::Steps.by_default(),
            "steps: the water that backward Euler needs to be exact, so that only the error of space is left; rates: that of the rates at a step's end";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        predictor: Start = Start::Particles.by_default(), "where Newton's method begins to look for pressures: at the volume average of the particles', or at zero";
        projection: f64 = real("-", "1", 0.01, 100.0), "ppp: its strength times 2G";
        tolerance: f64 = real("-", "1e-10", 1e-13, 1e-8), "residual of a converged step over what it balances";
    }
}

metrics! { ALL:
    DISPLACEMENT_L2 = "displacement_l2", "m", "rms over the particles of |u − exact u| at the end";
    DISPLACEMENT_LINF = "displacement_linf", "m", "largest |u − exact u| at the end";
    DISPLACEMENT_SCALE = "displacement_scale", "m", "rms over the particles of the exact u at the end";
    PRESSURE_L2 = "pressure_l2", "-", "rms over the particles of p less the exact one at the end, over that of the exact p";
    PRESSURE_LINF = "pressure_linf", "-", "largest error of p at a particle at the end, over the rms of the exact p";
    PRESSURE_SCALE = "pressure_scale", "Pa", "rms over the particles of the exact p at the end";
    STRESS_L2 = "stress_l2", "Pa", "rms of the Frobenius norm of the error of the effective Cauchy stress";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}

/// Loads over Young's modulus that Newton's method may not carry.
const HEAVY: f64 = 5.0;

pub(super) fn case() -> Case {
    Case::of::<2, Moving>("mms-poro", "Manufactured motion of solid and water", ALL)
        .planned(plan())
        .breaks_down(|r| {
            (Setup::<Motion>::of_record(r).ok()?.load() > HEAVY)
                .then_some("loads of several times Young's modulus: equilibria out of reach of Newton's method")
        })
        .described("A body full of water between rollers, drained at its top, is deformed by a body force and a source of water \
            that make motion and pressure known, at finite strain and with gravity. Orders in space and time of the \
            displacement and the pressure, for each space of the pressure, with and without crossing of cells.")
        .reference("Exact solution: derived on dual numbers; its balances are tested by eighth-order differences of a stress and a flux \
         that are written otherwise.")
        .limit("The body fills its grid: no cell is cut, and no surface moves.")
        .limit("Linear functions stall once particles have moved, as elsewhere.")
        .wanted("fields", "rms errors of u and p at the end", "error-bound")
        .checks(checks::checks())
        .headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 7)
        .headline(PRESSURE_L2, "error of p (%)", 100.0, 3)
        .headline(STRESS_L2, "σ′ rms error (Pa)", 1.0, 1)
        .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
        .headline(ENTRIES, "entries of a matrix", 1.0, 0)
        .quantity(error(DISPLACEMENT_L2, "rms error of u (m)").of_order(2.0))
        .quantity(error(PRESSURE_L2, "rms error of p").of_order(2.0))
        .quantity(error(STRESS_L2, "rms error of σ′ (Pa)").of_order(1.0))
        .watched(&["displacement_l2", "pressure_l2"])
        .sketch(Sketch::block("A body full of water that slides along its sides but doesn't leave them, drained at its top.", [1.0, 1.0])
            .held_along(&[[1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]])
            .length([0.0, -0.15], [1.0, -0.15], "1 m")
            .note([0.5, 1.12], "p = 0"))
        .cost(|spec| 1e-4 * spec.level.h.powi(-3))
        .begun(problem::begin_in::<1, 2, Moving>)
        .tables(tables())
}

fn plan() -> Plan {
    const THREE: &str = "n8 n16 n32";
    let (gimp, linear) = (spaces(Gimp), spaces(Linear));
    Plan::of(levels(1.0, LEVELS))
        .runs(Quick, "n8", &gimp[..1], "")
        .runs(Pr, THREE, &gimp, "")
        .runs(Pr, THREE, &linear[..1], "")
        .runs(Pr, THREE, &linear, "steps=1")
        .runs(Pr, THREE, &gimp[..1], CROSSING)
        .runs(Pr, "n16", &gimp[..1], "predictor=zero")
        .runs(Nightly, "n64", &linear, "steps=1")
        .runs(Nightly, "n16 n32 n64", &gimp, CROSSING)
        .each(Nightly, THREE, &linear, ["", CROSSING])
        .each(Nightly, THREE, &gimp, [TIGHT, "conductivity_law=constant"])
        .runs(Nightly, "n8 n16", &gimp, "dimension=1")
        .each(Nightly, "n16", &gimp, ["predictor=zero", "amplitude=0.04 predictor=zero"])
        .each(Pr, "n16", &gimp[1..2], TIMES)
        .each(Nightly, "n32", &gimp, TIMES)
}

fn tables() -> Vec<ResultTable> {
    let errors = |metric: Metric, title: &'static str, levels: usize| {
        let titles = LEVELS[..levels].iter().map(|(level, n)| (*level, format!("{title}, n = {n}")));
        let order = Column::plain_order(format!("order of {title}"), metric);
        Column::levels(titles, metric, scientific(2)).into_iter().chain([order])
    };
    // Errors of u and p over the cells.
    let cells = |name: &str, set: &'static str, levels: usize| {
        let columns = [errors(DISPLACEMENT_L2, "u", levels), errors(PRESSURE_L2, "p", levels)];
        ResultTable::new(name, move |r| r.changes(set), &[SCHEME], columns.into_iter().flatten())
    };
    let counts = [4.0, 8.0, 16.0].map(|count| (count, format!("{count} steps")));
    let steps = |r: &Record| Setup::<Motion>::number_of(r, |m| f64::from(m.steps));
    let predictors = [0.005, 0.04].into_iter().flat_map(|amplitude| {
        [(Start::Particles, "particles"), (Start::Zero, "zero")].map(|(predictor, word)| {
            let at = move |m: &Setup<Motion>| m.amplitude == amplitude && m.predictor == predictor;
            let title = format!("A = {amplitude} m, from {word}");
            Column::metric(title, NEWTON_ITERATIONS, fixed(0)).of(move |r| Setup::holds(r, at))
        })
    });
    vec![
        cells("mms-poro", "", 3),
        cells("mms-poro-one-step", "steps=1", 4),
        cells("mms-poro-crossing", CROSSING, 4),
        cells("mms-poro-tight", TIGHT, 3),
        ResultTable::of("mms-poro-steps", |r| {
            let changed = r.set.iter().any(|s| s.starts_with("source"));
            r.level == "n32" && changed && r.changes_none_but(&["source", "steps"])
        })
        .by(&[SCHEME])
        .columns(Column::over(counts, steps, PRESSURE_L2, scientific(2))),
        // Small and large motions.
        ResultTable::of("mms-poro-predictor", |r| {
            let own = r.level == "n16" && r.basis() == Gimp;
            own && r.changes_none_but(&["predictor", "amplitude"])
        })
        .by(&[SCHEME])
        .columns(predictors),
    ]
}
