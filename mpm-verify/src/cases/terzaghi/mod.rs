//! Consolidation of a column of soil at small strain, against Terzaghi's series and the closed form of the first step.
//!
//! Section 5.1 of Pretti et al., doi:10.1002/nme.7630.

pub(super) mod foreign;
mod run;

use super::poro::{self, HEIGHT, column_sketch, spaces};
use crate::cases::prelude::*;
use crate::exact::terzaghi as exact;
use run::FINITE;

const LEVELS: [(&str, f64); 5] = [("n10", 10.0), ("n20", 20.0), ("n40", 40.0), ("n80", 80.0), ("n160", 160.0)];
/// First steps c_v Δt/h² that are run on their own.
const SHARES: [f64; 8] = [0.05, 0.1, 1.0 / 6.0, 0.25, 0.35, 2.0 / 3.0, 0.75, 1.0];

parameters! {
    struct Terzaghi {
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e7");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.25");
        porosity: f64 = real("-", "0.4", 0.01, 0.99), "porosity of the undeformed column";
        conductivity: f64 = poro::CONDUCTIVITY;
        load: f64 = real("Pa", "10", 1e-3, 1e6), "load q: small, so that what is finite of its strain, q/M, is below all errors";
        steps: i32 = whole("-", "40", 1, 10_000), "steps";
        time_end: f64 = real("-", "0.1", 1e-6, 10.0), "time at the end over H²/c_v; of a single step with a first_step, that";
        first_step: f64 = real("-", "0", 0.0, 1e4), "c_v Δt/h² of the first step, with h the cells of the displacement; the others grow by a factor. 0: all equal";
        projection: f64 = poro::PROJECTION;
        tolerance: f64 = poro::TOLERANCE;
    }
}

metrics! { ALL:
    PRESSURE_L2 = "pressure_l2", "-", "rms over the particles, at the end, of the pressure less Terzaghi's, over the load";
    PRESSURE_L2_STEPS = "pressure_l2_steps", "-",
        "rms over the particles, at the end, of the pressure less the exact solution in space of the same backward Euler steps, over the load: the error of space alone";
    OVERSHOOT_FIRST_STEP = "overshoot_first_step", "-", "largest pressure at a node after the first step over the load, less one; zero where none exceeds it by 10⁻⁹";
    SETTLEMENT_ERROR = "settlement_error", "-", "distance at the end of the settlement from Terzaghi's, over the final one q H/M";
    MASS_ERROR = "mass_error", "-", "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}

pub(super) fn case() -> Case {
    Case::of::<1, Setup<Terzaghi>>("terzaghi", "Consolidation of a column", ALL)
        .planned(plan())
        .described("A column full of water is loaded at once and drains at its top, at small strain: the exact solution is a series. \
            Each space of the pressure has a shortest first step below which the pressure overshoots, and by how much \
            is known in closed form.")
        .reference("Terzaghi's series, derived in the source and tested against values with fifty digits.")
        .reference("The overshoot of the first step: closed form of the discrete equations, docs/poromechanics.md.")
        .limit("Small strain on a fixed grid: no particle crosses a cell, and linear functions and GIMP are one.")
        .limit("Two particles a cell: with more the projection's share of the bound is another one.")
        .wanted("settlement", "settlement at the end", "settlement near-terzaghi")
        .wanted("pressure", "largest nodal pressure after the first step", "overshoot bounded-overshoot")
        .missed_by("a-sixth-is-not-enough")
        .checks(checks())
        .headline(PRESSURE_L2, "error of p (% of q)", 100.0, 4)
        .headline(PRESSURE_L2_STEPS, "of space alone (%)", 100.0, 5)
        .headline(OVERSHOOT_FIRST_STEP, "overshoot (%)", 100.0, 3)
        .headline(SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 4)
        .headline(MASS_ERROR, "water made (–)", 1.0, 10)
        .headline(ENTRIES, "entries of a matrix", 1.0, 0)
        .quantity(error(PRESSURE_L2_STEPS, "rms error of p/q in space"))
        .quantity(error(PRESSURE_L2, "rms error of p/q"))
        .watched(&["base_pressure", "settlement"])
        .sketch(column_sketch("A column of 1 m on an impermeable floor, under a load q on its drained top."))
        .cost(|spec| 1e-6 * spec.level.h.powi(-2))
        .pictures(pictures)
        .tables(tables())
}

fn plan() -> Plan {
    let (gimp, linear) = (spaces(Gimp), spaces(Linear));
    let both = [gimp, linear].concat();
    Plan::of(levels(HEIGHT, LEVELS))
        .runs(Quick, "n10", &gimp[..1], "")
        .runs(Pr, "n10 n20 n40 n80 n160", &both, "")
        // A first step of T = 4·10⁻⁵ on 20 and on 160 cells, and eighty growing ones after it.
        .runs(Pr, "n20", &linear, "first_step=0.016 steps=1")
        .runs(Pr, "n160", &linear, "first_step=1.024 steps=1")
        .runs(Nightly, "n20", &linear, "first_step=0.016 steps=80 time_end=1")
        .runs(Nightly, "n160", &linear, "first_step=1.024 steps=80 time_end=1")
        .each(Nightly, "n20", &linear, SHARES.map(|r| format!("first_step={r} steps=1")))
        .each(Nightly, "n20", &linear[2..], SHARES.map(|r| format!("projection=0.1 first_step={r} steps=1")))
        .each(Nightly, "n20", &gimp, SHARES.map(|r| format!("first_step={r} steps=1")))
        .each(Pr, "n80", &linear, [5, 10, 20, 80].map(|n| format!("steps={n}")))
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Terzaghi>;
    vec![
        Check::truth("water", "the changes of volume and outflow agree in every step within Newton's residual and rounding of J̃")
            .at_most(MASS_ERROR, |c| {
                // Where the flux is linear in height: √(4/3) of the cell's balance, over all cells.
                let newton = 1.2 * (HEIGHT / c.h) * c.tolerance;
                // Backward Euler drains at least half of the exact outflow.
                let outflow = 0.5 * HEIGHT * c.strain() * exact::settlement(c.end());
                newton + 4.0 * f64::EPSILON * f64::from(c.steps) * HEIGHT / outflow
            })
            .because("exact rate: the equations of all nodes add up to the balance of the column"),
        Check::truth("overshoot", "excess of the largest nodal pressure of the first step over q that of the closed form of the discrete equations, zero where monotone")
            .within(OVERSHOOT_FIRST_STEP, |c| c.overshoot_by(c.space().unwrap_or(Equal), c.share()), |_| FINITE)
            .of_scale(|_| 1.0)
            .because("closed form, docs/poromechanics.md; q/M ≤ 10⁻⁶ is finite"),
        Check::truth("bounded-overshoot", "excess of the largest nodal pressure of the first step over q at most the largest of the three spaces' closed forms")
            .at_most(OVERSHOOT_FIRST_STEP, |c| c.largest(|space| c.overshoot_by(space, c.share())) + FINITE)
            .because("closed forms, docs/poromechanics.md: q is never exceeded, and what a step of this length adds is that of these cells"),
        Check::truth("settlement", "final distance from Terzaghi's degree of consolidation that of the discrete equations, solved node by node")
            .within(SETTLEMENT_ERROR, |c| c.settlement_distance(c.space().unwrap_or(Equal)), |c| c.resolution())
            .because("Terzaghi's series, and the equations of docs/poromechanics.md step by step; q/M ≤ 10⁻⁶ is finite, and J̃ rounded"),
        Check::truth("near-terzaghi", "final distance from Terzaghi's degree of consolidation at most the largest that the discrete equations of the three spaces have with these cells and steps")
            .within(SETTLEMENT_ERROR, |_| 0.0, |c| c.largest(|space| c.settlement_distance(space)) + c.resolution())
            .of_scale(|c| exact::settlement(c.end()))
            .because("Terzaghi's series; the error of backward Euler's steps and of linear pressures on h or 2h, docs/poromechanics.md"),
        Check::known_limit("a-sixth-is-not-enough", "two grids at c_v Δt/h² = 1/6, Vermeer and Verruijt's bound: p above q by more than a fifth")
            .when(|c| c.space() == Some(TwoGrid) && (c.share() - 1.0 / 6.0).abs() < 1e-9)
            .above(OVERSHOOT_FIRST_STEP, |_| 0.2)
            .because("the bound of these elements is 3/4"),
        Check::truth("order-space", "default parameters, three finest levels: error of space alone of order in h at least 2 − 0.15")
            .when(|c| c.is_default())
            .order(PRESSURE_L2_STEPS, Over::CellSize, 2.0)
            .because("pressures are linear, and strains averaged, in a cell"),
        Check::truth("order-time", "n80, three finest steps: error of p of order in Δt at least 1 − 0.15")
            .when(|c| c.level == "n80" && c.record.changes_none_but(&["steps"]))
            .order(PRESSURE_L2, Over::TimeStep, 1.0)
            .because("backward Euler's rule"),
        Check::truth("functions-agree", "linear functions and GIMP differ by at most 2 (q/M)/√(πT), the effect of domains sunk into the next cell by q H/M")
            .when(|c| c.basis() == Linear)
            .pairs(
                |c, other| same_but_scheme(c, other) && other.scheme == c.scheme.with(Gimp, c.remedy()),
                |c, _| format!("difference of {} of {} {} and gimp", PRESSURE_L2_STEPS.name, c.scheme, c.level),
                |c, other| (c.metric(PRESSURE_L2_STEPS) - other.metric(PRESSURE_L2_STEPS)).abs(),
            )
            // A domain of h/2 has the share 2 q H/(M h) in a cell whose strain differs by h ε′ ≤ h/(H √(πT)) of q/M.
            .at_most(|c| 2.0 * c.strain() / (std::f64::consts::PI * c.end()).sqrt())
            .because("a mean of a hat over a domain within its cell is the hat at the middle"),
        Check::bookkeeping("fewer-entries", "matrices of two grids with fewer entries than those of one")
            .when(|c| c.space() == Some(TwoGrid) && c.first_step == 0.0)
            .pairs(
                |c, other| same_but_scheme(c, other) && other.scheme == Scheme::poro(c.basis(), Equal),
                |c, _| format!("entries of {} {} over those of equal", c.scheme, c.level),
                |c, other| c.metric(ENTRIES) / other.metric(ENTRIES),
            )
            .at_most(|_| 1.0)
            .because("half as many pressures along every axis"),
    ]
}

fn tables() -> Vec<ResultTable> {
    let cells = LEVELS.map(|(level, n)| (level, format!("n = {n}")));
    let shares = SHARES.map(|share| (share, format!("r = {share:.3}")));
    let counts = [5.0, 10.0, 20.0, 40.0, 80.0].map(|n| (n, format!("{n} steps")));
    let share = |r: &Record| Setup::<Terzaghi>::number_of(r, |c| c.share());
    let steps = |r: &Record| Setup::<Terzaghi>::number_of(r, |c| f64::from(c.steps));
    vec![
        ResultTable::of("terzaghi-cells", |r| r.is_default())
            .by(&[SCHEME])
            .columns(Column::levels(cells, PRESSURE_L2_STEPS, scientific(2)))
            .column(Column::order(PRESSURE_L2_STEPS))
            .columns(Column::levels([("n160", "entries, n = 160")], ENTRIES, fixed(0))),
        ResultTable::of("terzaghi-first-step", move |r| {
            r.level == "n20" && steps(r) == 1.0 && r.changes_none_but(&["steps", "first_step"])
        })
        .by(&[SCHEME])
        .columns(Column::over(shares.clone(), share, OVERSHOOT_FIRST_STEP, percent(2))),
        ResultTable::of("terzaghi-projection", move |r| {
            let single = r.level == "n20" && steps(r) == 1.0;
            single && r.scheme() == Scheme::poro(Linear, Ppp)
        })
        .by(&[("τ / standard", |r| Setup::<Terzaghi>::number_of(r, |c| c.projection).to_string())])
        .columns(Column::over(shares, share, OVERSHOOT_FIRST_STEP, percent(2))),
        ResultTable::of("terzaghi-steps", |r| r.level == "n80" && r.changes_none_but(&["steps"]))
            .by(&[SCHEME])
            .columns(Column::over(counts, steps, PRESSURE_L2, scientific(2))),
    ]
}

/// Pressure after a short first step, how its overshoot fades, and the overshoot over the first step.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    let number = |r: &Record, of: fn(&Setup<Terzaghi>) -> f64| Setup::number_of(r, of);
    let is_linear = |r: &&Record| r.basis() == Linear && r.status == Status::Ok;
    let runs: Vec<&Record> = gallery.records.iter().filter(is_linear).collect();
    let single = |r: &Record| number(r, |c| f64::from(c.steps)) == 1.0;
    let profile = |level: &str, title: &str| {
        let own = |r: &&&Record| {
            single(r) && r.level == level && (number(r, |c| c.first_and_growth().0) - 4e-5).abs() < 1e-12
        };
        Panel::new(title, ["depth (m)", "p/q"])
            .x_range(0.0, 0.25)
            .profiles(gallery, runs.iter().filter(own).copied(), |r, t| {
                let load = number(r, |c| c.load);
                t.pairs(["reference_x", "pore_pressure"], |x, p| (HEIGHT - x, p / load))
            })
            .map(|panel| panel.exact("exact", 0.0..=0.25, |z| exact::pressure(z, 4e-5)))
    };
    let grows = |r: &&&Record| r.level == "n20" && number(r, |c| c.time_end) == 1.0;
    let fades = Panel::new("20 cells, growing steps", ["log₁₀ T", "largest p/q − 1 (%)"]).histories(
        gallery,
        runs.iter().filter(grows).copied(),
        |_, t| t.pairs(["time_factor", "overshoot"], |t, o| (t.log10(), 100.0 * o)),
    )?;
    let profiles = [profile("n20", "20 cells")?, profile("n160", "160 cells")?, fades];
    let mut first = Panel::new("", ["c_v Δt/h²", "largest p/q − 1 (%)"]);
    for space in [TwoGrid, Equal, Ppp] {
        let scheme = Scheme::poro(Linear, space);
        let own = |r: &&&Record| single(r) && r.level == "n20" && r.scheme() == scheme;
        let column = runs.iter().find(own).and_then(|r| Setup::<Terzaghi>::of_record(r).ok());
        let Some(column) = column else { continue };
        let closed = |share| 100.0 * column.overshoot_by(space, share);
        first = first
            .curve(Series { name: format!("{space}, closed form"), ..history(scheme, sampled(0.0..=1.0, closed)) })
            .points(runs.iter().filter(own).copied(), |r| {
                (number(r, |c| c.share()), 100.0 * r.metric(OVERSHOOT_FIRST_STEP))
            })
            .styled(|_, s| Series { name: space.to_string(), dash: Dash::Dotted, ..s });
    }
    let caption = "Pressure at the particles after one step of T = 4·10⁻⁵, c_v Δt/h² = 0.016 and 1.02, and how its overshoot fades in growing steps; the paper's Figures 5 and 6.";
    Figure::new("figures", caption, profiles).draw(gallery)?;
    Figure::new("overshoot", "Overshoot of the first step on 20 cells, and its closed form.", [first]).draw(gallery)
}
