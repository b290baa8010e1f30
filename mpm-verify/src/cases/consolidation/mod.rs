//! Consolidation of a column at finite strain: the solver of solid and water against an independent solution.

mod checks;
pub(super) mod foreign;
mod run;

use super::poro::{HEIGHT, column_sketch, spaces};
use crate::cases::prelude::*;
use crate::exact::consolidation::{At, solution};

const LEVELS: [(&str, f64); 6] =
    [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0), ("n128", 128.0), ("n256", 256.0)];
const VOLUME_RATE: Parameter = Rate::Exact.by_default().named("volume_rate");

choices! {
    enum Rate { Exact = "exact", Logarithmic = "logarithmic" }
}

parameters! {
    struct Consolidation {
        load: f64 = real("-", "0.3", 1e-4, 2.0), "load q over the oedometric modulus M₀ of the undeformed column; the reference has 0.003, 0.3 and 1";
        refine: i32 = whole("-", "4", 1, 64), "steps that each of the 125 is cut into; the reference of steps has 1, 2, 4 and 8";
        volume_rate: Rate = VOLUME_RATE, "what a step's volume changes by over its start: J̃ − 1, or J̃ ln J̃";
        drain: f64 = real("-", "1e4", 10.0, 1e6), "what the drained top lets through for its pressure, over κ₀/h";
        ghost_displacement: f64 = real("-", "0", 0.0, 10.0), "ghost penalty of the displacement over G";
        ghost_pressure: f64 = real("-", "0", 0.0, 10.0), "ghost penalty of the pressure over κ₀ Δt";
        projection: f64 = real("-", "1", 0.01, 100.0), "ppp: its strength times 2G";
        tolerance: f64 = real("-", "1e-10", 1e-13, 1e-8), "residual of a converged step over what it balances";
    }
}

metrics! { ALL:
    SETTLEMENT_ERROR = "settlement_error", "-", "largest relative error of the settlement at the tabulated T from 0.1 on; none at a load that has no reference";
    SETTLEMENT_ERROR_STEPS = "settlement_error_steps", "-",
        "largest relative error of the settlement against the exact solution in space of the same backward Euler steps: the error of space alone";
    BASE_PRESSURE_ERROR = "base_pressure_error", "-", "largest error there of the pressure at the base, over the load";
    BASE_PRESSURE_ERROR_STEPS = "base_pressure_error_steps", "-", "largest error of the pressure at the base, over the load, against the exact solution in space of the same steps";
    SETTLEMENT_EARLY = "settlement_0.1", "-", "settlement over H at T = 0.1";
    SETTLEMENT_END = "settlement_end", "-", "settlement over H at T = 2";
    MASS_ERROR = "mass_error", "-", "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    RATE_LOSS = "rate_loss", "-", "½ Σ V (J̃ − 1)² of all particles and steps over the outflow: what the logarithmic rate loses to leading order";
    VOLUME_STEP = "volume_step", "-", "largest |J̃ − 1| of a particle in a step";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix, on average";
}

pub(super) fn case() -> Case {
    Case::of::<1, Setup<Consolidation>>("consolidation", "Consolidation of a column at finite strain", ALL)
        .planned(plan())
        .described("A column full of water settles by a fifth or by a third of its height as it drains at its top: the surface leaves \
            the grid's lines, particles cross cells, pores close and let less water through.")
        .reference("references/consolidation.py: Chebyshev collocation, and finite volumes that agree with it to 10⁻⁸.")
        .reference("The same of backward Euler's steps: the error of space by itself.")
        .limit("One dimension; the improved Hencky law is our own, from its published description.")
        .limit("References at loads of 0.003, 0.3 and 1 M₀ alone.")
        .limit("Linear functions break down at large strain: what they would come to is not known.")
        .wanted("settlement", "settlement over time", "settlement")
        .missed_by("logarithm-loses-water")
        .wanted("pressure", "pressure at the base over time", "base-pressure")
        .missed_by("logarithm-loses-water")
        .checks(checks::checks())
        .headline(SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 3)
        .headline(SETTLEMENT_ERROR_STEPS, "of space alone (%)", 100.0, 3)
        .headline(BASE_PRESSURE_ERROR, "error of p at the base (% of q)", 100.0, 3)
        .headline(SETTLEMENT_END, "settlement (% of H)", 100.0, 3)
        .headline(MASS_ERROR, "water made (–)", 1.0, 10)
        .headline(RATE_LOSS, "½ Σ V (J̃ − 1)² over the outflow (–)", 1.0, 10)
        .headline(ENTRIES, "entries of a matrix", 1.0, 0)
        .quantity(error(SETTLEMENT_ERROR_STEPS, "relative error of the settlement in space"))
        .quantity(error(SETTLEMENT_ERROR, "relative error of the settlement"))
        .watched(&["base_pressure", "settlement"])
        .sketch(column_sketch("A column of 1 m on an impermeable floor, under a load q on its drained top that makes it settle."))
        .cost(|spec| 1e-3 * spec.level.h.powi(-1))
        .pictures(pictures)
        .tables(tables())
        .breaks_down(|r| {
            let large = Filled::holds(r, |c| c.load >= 0.3);
            (r.basis() == Linear && large)
                .then_some("linear functions: particles that cross cells leave the one above empty, and the top stands on a node that bears nothing")
        })
}

fn plan() -> Plan {
    const COARSE: &str = "n8 n16 n32";
    let (gimp, linear) = (spaces(Gimp), spaces(Linear));
    let (both, two_grid) = ([gimp, linear].concat(), &gimp[..1]);
    Plan::of(levels(HEIGHT, LEVELS))
        .runs(Quick, "n8", two_grid, "refine=1")
        .runs(Pr, "n8 n16 n32 n64", &gimp, "")
        .runs(Pr, "n16", &both, "load=0.003")
        .runs(Pr, COARSE, &gimp, "load=1")
        .runs(Pr, "n16", two_grid, "volume_rate=logarithmic")
        .runs(Nightly, "n64 n128", &both, "")
        .runs(Nightly, "n64 n128 n256", &both, "load=1")
        .each(Nightly, COARSE, &linear, ["", "load=1"])
        .runs(Nightly, COARSE, &both, "load=0.003")
        .each(Pr, "n16", two_grid, ["refine=1", "refine=2"])
        .each(Nightly, "n16", two_grid, ["", "load=1", "refine=1"].map(|set| format!("{set} volume_rate=logarithmic")))
        .each(Nightly, COARSE, two_grid, ["0.01", "0.1", "1", "10"].map(|of| format!("ghost_displacement={of}")))
        .each(Nightly, COARSE, two_grid, ["0.001", "0.01", "0.1", "1"].map(|of| format!("ghost_pressure={of}")))
        // As other cases have them.
        .runs(Nightly, COARSE, two_grid, "ghost_displacement=0.1 ghost_pressure=0.01")
        .each(Nightly, COARSE, &gimp, ["drain=100", "drain=1e3"])
}

type Filled = Setup<Consolidation>;

fn tables() -> Vec<ResultTable> {
    const LOADED: Label = ("load", |r| format!("{} M₀", Filled::number_of(r, |c| c.load)));
    const GHOST_U: Label = ("α_u", |r| Filled::number_of(r, |c| c.ghost_displacement).to_string());
    const GHOST_P: Label = ("α_p", |r| Filled::number_of(r, |c| c.ghost_pressure).to_string());
    const RATE: Label = ("rate", |r| r.parameters.text(VOLUME_RATE));
    const STEPS: Label = ("steps", |r| Filled::number_of(r, |c| c.count()).to_string());
    let errors = |levels: &[(&'static str, f64)], title: &str| {
        let levels = levels.iter().map(|(level, n)| (*level, format!("{title}n = {n}")));
        Column::levels(levels, SETTLEMENT_ERROR_STEPS, share(3))
    };
    let of_drains = [100.0, 1e3, 1e4].into_iter().flat_map(|drain| {
        LEVELS[..3].iter().map(move |(level, n)| {
            let at = move |r: &Record| r.level == *level && Filled::number_of(r, |c| c.drain) == drain;
            Column::metric(format!("β h/κ₀ = {drain}, n = {n}"), SETTLEMENT_ERROR_STEPS, share(3)).of(at)
        })
    });
    let is_two_grid = |r: &Record| r.scheme() == Scheme::poro(Gimp, TwoGrid);
    vec![
        ResultTable::of("consolidation-cells", |r| r.basis() == Gimp && r.changes_none_but(&["load"]))
            .by(&[LOADED, SCHEME])
            .columns(errors(&LEVELS, ""))
            .column(Column::order(SETTLEMENT_ERROR_STEPS))
            .columns(Column::levels([("n16", "with that of time, n = 16")], SETTLEMENT_ERROR, share(2))),
        // Linear functions, where they come to the end.
        ResultTable::of("consolidation-linear", |r| r.basis() == Linear && r.changes_none_but(&["load"]))
            .by(&[LOADED, SCHEME])
            .columns(errors(&LEVELS, "")),
        ResultTable::of("consolidation-drain", |r| r.basis() == Gimp && r.changes_none_but(&["drain"]))
            .by(&[SCHEME])
            .columns(of_drains)
            .across(),
        ResultTable::of("consolidation-ghosts", move |r| {
            is_two_grid(r) && r.changes_none_but(&["ghost_displacement", "ghost_pressure"])
        })
        .by(&[GHOST_U, GHOST_P])
        .columns(errors(&LEVELS[..3], "error of settlement, ")),
        ResultTable::of("consolidation-water", move |r| {
            is_two_grid(r) && r.level == "n16" && r.changes_none_but(&["load", "refine", "volume_rate"])
        })
        .by(&[LOADED, RATE, STEPS])
        .metric("water made", MASS_ERROR, scientific(2))
        .metric("½ Σ V (J̃ − 1)²", RATE_LOSS, scientific(2))
        .metric("error of settlement", SETTLEMENT_ERROR, share(2)),
    ]
}

/// Settlement and base pressure over time at both loads, on the coarsest level: differences of finer ones can't be seen.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    type Value = fn(&At) -> f64;
    let quantities: [(&str, &str, Value); 2] = [
        ("settlement", "settlement/H (%)", |at| at.settlement),
        ("base_pressure", "p/q at the base (%)", |at| at.base),
    ];
    let mut panels = Vec::new();
    for load in [0.3, 1.0] {
        let own = |r: &&Record| {
            let own = r.basis() == Gimp && r.status == Status::Ok && r.level == "n8";
            own && r.changes_none_but(&["load"]) && Filled::number_of(r, |c| c.load) == load
        };
        for (column, label, value) in quantities {
            let exact = solution(load, None).into_iter().map(|at| (at.t, 100.0 * value(&at)));
            let exact = Series {
                name: "independent solution".to_owned(),
                colour: 6,
                dash: Dash::None,
                ..series(Scheme::poro(Gimp, TwoGrid), exact.collect())
            };
            let panel = Panel::new(format!("q = {load} M₀"), ["T", label])
                .histories(gallery, gallery.records.iter().filter(own), |_, t| {
                    t.pairs(["time_factor", column], |t, y| (t, 100.0 * y))
                })?
                .curve(exact);
            panels.push(panel);
        }
    }
    let caption =
        "Settlement and pressure at the base on 8 cells, GIMP, at loads of 0.3 and 1 M₀, and the independent solution.";
    Figure::new("settlement", caption, panels).columns(2).draw(gallery)
}
