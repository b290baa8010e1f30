//! Consolidation of a slab between rigid plates at small strain: nodes that move as one, water and solid in two dimensions,
//! and the pressure that rises before it falls.
//!
//! Mandel 1953, doi:10.1680/geot.1953.3.7.287.

mod run;

use super::poro::{self, spaces};
use crate::cases::prelude::*;
use run::{END, HEIGHT, WIDTH};

const LEVELS: [(&str, f64); 3] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)];
const RATIOS: [&str; 2] = ["poisson_ratio=0", "poisson_ratio=0.4"];

parameters! {
    struct Mandel {
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e7");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.25");
        porosity: f64 = real("-", "0.4", 0.01, 0.99), "porosity of the undeformed slab";
        conductivity: f64 = poro::CONDUCTIVITY;
        load: f64 = real("N/m", "10", 1e-3, 1e6), "force F on half a plate: small, so that what is finite of the strain, F/(G a), is below all errors";
        steps: i32 = whole("-", "240", 30, 100_000), "equal steps to T = 0.3";
        projection: f64 = poro::PROJECTION;
        tolerance: f64 = poro::TOLERANCE;
    }
}

metrics! { ALL:
    CENTRE_PRESSURE_ERROR = "centre_pressure_error", "-", "largest distance, from T = 0.01 on, of the pressure in the middle from Mandel's, over the undrained one F/(2a)";
    CENTRE_PRESSURE_ERROR_SPACE = "centre_pressure_error_space", "-",
        "largest distance of the pressure in the middle from the exact solution in space of the same backward Euler steps: the error of space alone";
    CENTRE_PRESSURE_ERROR_TIME = "centre_pressure_error_time", "-",
        "largest distance of the pressure in the middle from the exact solution in time of the difference equations of the same cells: the error of time alone";
    EQUATIONS_DISTANCE = "equations_distance", "-", "largest distance of that pressure, the settlement and the bulge from the solution of the difference equations, over all steps";
    PEAK = "peak", "-", "largest pressure in the middle over F/(2a)";
    PEAK_TIME = "peak_time", "-", "T of it";
    SETTLEMENT_ERROR = "settlement_error", "-", "largest distance, from T = 0.01 on, of a plate's path from Mandel's, over F b/(G a)";
    BULGE_ERROR = "bulge_error", "-", "largest distance, from T = 0.01 on, of a side's mean path outwards from Mandel's, by the change of the volume, over F/G";
    SUPPORT_ERROR = "support_error", "-", "largest distance of the force on the plane of symmetry below from that on the plate, over the latter; 10⁻⁹ if less";
    MASS_ERROR = "mass_error", "-", "change of the volume and outflow together, over the outflow; 10⁻⁹ if it is less, which no golden should hold";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    ENTRIES = "matrix_entries", "-", "entries of a matrix";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Consolidation>("mandel", "Consolidation of a slab between plates", ALL)
        .planned(plan())
        .described("A slab full of water is pressed together by rigid plates and drains at its sides, at small strain: the pressure \
            in its middle rises before it falls. Exact solutions are series: of the slab, of its steps, and of the \
            difference equations of its cells.")
        .reference("Mandel's series, derived on its page, tested against its equations and an independent integration in time.")
        .reference("The difference equations by elimination, whose closed form in modes is tested against that.")
        .limit("Small strain on a fixed grid, and an answer that does not depend on the height.")
        .limit("Two particles a cell and axis: with more the difference equations are others.")
        .wanted("pressure", "pressure in the middle over time", "centre-pressure peak")
        .wanted("motion", "paths of plate and side", "settlement bulge")
        .checks(checks())
        .headline(CENTRE_PRESSURE_ERROR, "error of p in the middle (% of F/2a)", 100.0, 3)
        .headline(CENTRE_PRESSURE_ERROR_SPACE, "of space alone (%)", 100.0, 3)
        .headline(PEAK, "peak (F/2a)", 1.0, 4)
        .headline(PEAK_TIME, "its T", 1.0, 4)
        .headline(SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 4)
        .headline(EQUATIONS_DISTANCE, "from the difference equations (–)", 1.0, 7)
        .headline(MASS_ERROR, "water made (–)", 1.0, 10)
        .headline(ENTRIES, "entries of a matrix", 1.0, 0)
        .quantity(error(CENTRE_PRESSURE_ERROR_SPACE, "error of p in the middle, of space"))
        .quantity(error(CENTRE_PRESSURE_ERROR, "error of p in the middle"))
        .watched(&["centre_pressure", "settlement"])
        .sketch(Sketch::block("A quarter of a slab between rigid plates, drained at its side.", [1.0, 0.25])
            .held([0.0, 0.0], [1.0, 0.0])
            .held([0.0, 0.0], [0.0, 0.25])
            .length([0.0, -0.12], [1.0, -0.12], "a = 1 m")
            .note([1.12, 0.12], "drained")
            .note([0.5, 0.5], "plate, F")
            .loads((0..5).map(|k| 0.1 + 0.2 * f64::from(k)), [0.42, 0.27]))
        .cost(|spec| 1e-6 * spec.level.h.powi(-3))
        .pictures(pictures)
        .tables(tables())
}

fn plan() -> Plan {
    let (gimp, linear) = (spaces(Gimp), spaces(Linear));
    let both = [gimp, linear].concat();
    // 60 steps at n8, 240 at n16 and 960 at n32 shrink as h².
    Plan::of(levels(WIDTH, LEVELS))
        .runs(Quick, "n8", &gimp[..1], "steps=60")
        .runs(Pr, "n8", &both, "")
        .each(Pr, "n8", &linear, ["steps=60", "steps=120"])
        .runs(Pr, "n16 n32", &linear, "")
        .each(Nightly, "n8", &gimp, ["steps=60", "steps=120"])
        .runs(Nightly, "n16 n32", &gimp, "")
        .runs(Nightly, "n32", &both, "steps=960")
        .each(Pr, "n8", &linear, RATIOS)
        .each(Nightly, "n16", &both, RATIOS)
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Mandel>;
    const SERIES_AND_EQUATIONS: &str = "Mandel's series, and what cells and steps make of it";
    const ORDERS: &str = "linear pressures, mean strains of cells, backward Euler's rule";
    vec![
        Check::truth("difference-equations", "central pressure and paths of plate and side agree in every step with the eliminated difference equations, within 10 F/(G a) and its rounding")
            .at_most(EQUATIONS_DISTANCE, |c| c.finite())
            .because("the equations of cells, nodes and plate at small strain, docs/mandel.md"),
        Check::truth("centre-pressure", "error of the pressure in the middle against Mandel's at most that of the difference equations, and 10 F/(G a)")
            .at_most(CENTRE_PRESSURE_ERROR, |c| c.errors_of_equations().centre + c.finite())
            .because(SERIES_AND_EQUATIONS),
        Check::truth("settlement", "error of a plate's path against Mandel's at most that of the difference equations, and 10 F/(G a)")
            .at_most(SETTLEMENT_ERROR, |c| c.errors_of_equations().settlement + c.finite())
            .because(SERIES_AND_EQUATIONS),
        Check::truth("bulge", "error of a side's path against Mandel's at most that of the difference equations, and 10 F/(G a)")
            .at_most(BULGE_ERROR, |c| c.errors_of_equations().bulge + c.finite())
            .because(SERIES_AND_EQUATIONS),
        Check::truth("peak", "peak pressure that of the series within the error of the pressure and the fall of the series between steps")
            .within(PEAK, |c| c.peak_between_steps().0, |c| {
                c.errors_of_equations().centre + c.peak_between_steps().1 + c.finite()
            })
            .because("Mandel's series"),
        Check::truth("peak-time", "series at the time of the peak below its own peak by at most that fall and twice that error")
            .at_most(
                Quantity::new(format!("series' peak less the series at {}", PEAK_TIME.name), |c: &Run<Mandel>| {
                    c.peak_between_steps().0 - c.exact().at(c.metric(PEAK_TIME)).centre
                }),
                |c| 2.0 * (c.errors_of_equations().centre + c.finite()) + c.peak_between_steps().1,
            )
            .because("both pressures at both times are apart by the error at most"),
        Check::truth("support", "the reaction of the symmetry plane below equals the force on the plate within Newton's residual and rounding of strains")
            .at_most(SUPPORT_ERROR, |c| {
                let unknowns = 2.0 * c.nodes();
                let left = 2.0 * unknowns.sqrt() * c.tolerance;
                ROUNDING + left + c.rounding()
            })
            .because("the equations of all nodes add up to the balance of forces"),
        Check::truth("water", "the changes of volume and outflow agree in every step within Newton's residual and rounding of J̃")
            .at_most(MASS_ERROR, |c| {
                let cells = WIDTH / c.h;
                // Each node stores and moves at most (1 + 2 n) times the outflow, over all of them.
                let left = c.nodes().sqrt() * (1.0 + 2.0 * cells) * c.tolerance;
                let end = c.exact().at(END);
                let outflow = HEIGHT * c.strain() * (end.settlement - end.bulge);
                let rounding = 4.0 * f64::EPSILON * f64::from(c.steps) * WIDTH * HEIGHT / (0.5 * outflow);
                left + rounding
            })
            .because("exact rate: the equations of all nodes add up to the balance of the slab"),
        Check::truth("order-space", "default parameters, three finest levels: error of space alone of order in h at least 2 − 0.15")
            .when(|c| c.is_default())
            .order(CENTRE_PRESSURE_ERROR_SPACE, Over::CellSize, 2.0)
            .named(|c| format!("order in h of {} of {}", CENTRE_PRESSURE_ERROR_SPACE.name, c.scheme))
            .because(ORDERS),
        Check::truth("order-time", "linear functions, n8, three finest steps: error of time alone of order in Δt at least 1 − 0.15")
            .when(|c| c.level == "n8" && c.basis() == Linear && c.record.changes_none_but(&["steps"]))
            .order(CENTRE_PRESSURE_ERROR_TIME, Over::TimeStep, 1.0)
            .because(ORDERS),
        Check::truth("order-together", "n8, n16, n32 with steps in proportion to h²: whole error of order in h at least 2 − 0.15")
            .when(|c| c.shrinks_together())
            .order(CENTRE_PRESSURE_ERROR, Over::CellSize, 2.0)
            .named(|c| format!("order in h and Δt of {} of {}", CENTRE_PRESSURE_ERROR.name, c.scheme))
            .because(ORDERS),
    ]
}

fn tables() -> Vec<ResultTable> {
    let cells = LEVELS.map(|(level, n)| (level, format!("n = {n}")));
    let together = LEVELS.map(|(level, n)| (level, format!("n = {n}, {} steps", 60.0 * (n / 8.0_f64).powi(2))));
    let of_ratios = [0.0, 0.25, 0.4].into_iter().flat_map(|ratio| {
        let own = move |r: &Record| Setup::<Mandel>::holds(r, |c| c.poisson_ratio == ratio);
        let column =
            |title: &str, metric, format| Column::metric(format!("{title}, ν = {ratio}"), metric, format).of(own);
        [
            column("error", CENTRE_PRESSURE_ERROR, scientific(2)),
            column("peak", PEAK, fixed(4)),
            column("T", PEAK_TIME, fixed(4)),
        ]
    });
    let is_of_ratios = |r: &Record| {
        let others = r.changes_none_but(&["poisson_ratio", "steps"]);
        r.level == "n16" && Setup::<Mandel>::holds(r, |c| c.steps == 240) && others
    };
    vec![
        ResultTable::of("mandel-cells", |r| r.is_default())
            .by(&[SCHEME])
            .columns(Column::levels(cells, CENTRE_PRESSURE_ERROR_SPACE, scientific(2)))
            .column(Column::order(CENTRE_PRESSURE_ERROR_SPACE))
            .column(
                Column::metric("from the difference equations, n = 32", EQUATIONS_DISTANCE, scientific(1)).at("n32"),
            )
            .columns(Column::levels([("n32", "entries, n = 32")], ENTRIES, fixed(0))),
        ResultTable::of("mandel-together", |r| Setup::<Mandel>::holds(r, |c| c.shrinks_together()))
            .by(&[SCHEME])
            .columns(Column::levels(together, CENTRE_PRESSURE_ERROR, scientific(2)))
            .column(Column::order(CENTRE_PRESSURE_ERROR)),
        ResultTable::new("mandel-ratios", is_of_ratios, &[SCHEME], of_ratios),
    ]
}

/// The pressure in the middle over time, of two grids on 16 cells, on Mandel's series, for every ratio.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    const POINTS: u32 = 300;
    let scheme = Scheme::poro(Gimp, TwoGrid);
    let own = |r: &&Record| {
        r.scheme() == scheme && r.level == "n16" && r.status == Status::Ok && r.changes_none_but(&["poisson_ratio"])
    };
    let runs = gallery.records.iter().filter(own);
    let mut runs: Vec<Run<Mandel>> = Run::all(runs).collect();
    runs.sort_by(|a, b| a.poisson_ratio.total_cmp(&b.poisson_ratio));
    let mut panel = Panel::new("", ["T", "p/(F/2a) in the middle"]);
    for (colour, run) in runs.iter().enumerate() {
        let (ratio, exact) = (run.poisson_ratio, run.exact());
        let points = (1..=POINTS).map(|k| {
            let t = END * f64::from(k) / f64::from(POINTS);
            (t, exact.at(t).centre)
        });
        panel = panel
            .curve(Series { name: format!("ν = {ratio}, exact"), colour, ..history(scheme, points.collect()) })
            .histories(gallery, [run.record], |_, table| {
                table.points("time_factor", "centre_pressure").into_iter().step_by(8).collect()
            })?
            .styled(|_, curve| Series {
                name: format!("ν = {ratio}"),
                colour,
                marker: Marker::Circle,
                dash: Dash::Dotted,
                ..curve
            });
    }
    let caption =
        "Pressure in the middle of the slab over the time, of two grids with GIMP on 16 cells, and Mandel's series.";
    Figure::new("centre-pressure", caption, [panel]).draw(gallery)
}
