//! A body that no water leaves: whether pressures and motions of the two grids fit together.
//!
//! Sections 3 and 4.4 of Pretti et al., doi:10.1002/nme.7630.

mod run;

use super::checks;
use crate::cases::prelude::*;

const LEVELS: [(&str, f64); 3] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)];

choices! {
    enum Domain { Square = "square", Ellipse = "ellipse" }
    enum Layout { Aligned = "aligned", Across = "across" }
    enum PressureFunctions { Same = "same", Linear = "linear" }
}

const DOMAIN: Parameter = Domain::Square.by_default().named("domain");
const PRESSURE_FUNCTIONS: Parameter = PressureFunctions::Same.by_default().named("pressure_functions");

parameters! {
    struct Undrained {
        domain: Domain = DOMAIN, "square: held all around, on grid lines; ellipse: half of one, held at its straight side, that fits no grid";
        points_per_direction: usize = whole("-", "2", 2, 4), "particles per cell of the displacement and direction";
        layout: Layout = Layout::Aligned.by_default(), "aligned: domains fill cells; across: one more along each side, so that domains lie across grid lines";
        pressure_functions: PressureFunctions = PRESSURE_FUNCTIONS, "functions of the pressure: those of the displacement, or linear ones";
    }
}

metrics! { ALL:
    INF_SUP = "inf_sup", "-", "least number β > 0 that a pressure's norm times the norms of motions can fall to where it works on them, Chapelle and Bathe's";
    ZERO_MODES = "zero_modes", "-", "pressures that no motion sees: β² < 10⁻⁹";
    DISPLACEMENT_ERROR = "displacement_error", "-", "rms over the particles of the distance from the exact displacement, over its rms; none of the ellipse";
    PRESSURE_ERROR = "pressure_error", "-", "rms over the particles of the distance from the exact pressure, over its rms; none of the ellipse";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-", "rms over the cells of the pressure of a checkerboard's amplitude, over the rms of the exact pressure; none of the ellipse";
    UNKNOWNS = "displacements", "-", "unknown components of displacement";
    PRESSURES = "pressures", "-", "unknown pressures";
}

pub(super) fn case() -> Case {
    case_of::<run::Body>("undrained", "Spaces of displacement and pressure where no water flows", ALL)
        .planned(plan())
        .described("Chapelle and Bathe's number of each pair of spaces on three meshes: of one that is stable it has a bound, of equal \
            order it falls with the cells. And the motion of a body that keeps its volume, against an exact one.")
        .reference("Theory: a stable pair has an inf–sup number above a bound that no mesh changes; bilinear functions of equal order have none.")
        .reference("Exact motion without change of volume, and its pressure, in closed form.")
        .limit("Matrices of an undeformed body at small strain, of the solver's functions and ghost penalties but assembled here: no step is taken.")
        .limit("Norms are sums over the particles, exact integrals of linear functions and GIMP on the square alone.")
        .wanted("pressure-modes", "number of pressures without an effect", "one-constant")
        .missed_by("equal-order-has-checkerboards equal-order-loses-the-pressure")
        .checks(checks())
        .headline(INF_SUP, "β", 1.0, 4)
        .headline(ZERO_MODES, "pressures without effect", 1.0, 0)
        .headline(DISPLACEMENT_ERROR, "error of u (%)", 100.0, 3)
        .headline(PRESSURE_ERROR, "error of p (%)", 100.0, 2)
        .headline(CHECKERBOARD_RATIO, "checkerboard (%)", 100.0, 2)
        .headline(PRESSURES, "pressures", 1.0, 0)
        .quantity(error(DISPLACEMENT_ERROR, "error of the displacement"))
        .quantity(error(PRESSURE_ERROR, "error of the pressure"))
        .watched(&["inf_sup"])
        .sketch(Sketch::block("A square of 1 m that is held all around, and half an ellipse that is held at its straight side.", [1.0, 1.0])
            .half_ellipse(1.763, [0.437, 0.611])
            .held_along(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
            .held([1.326, 0.0], [2.2, 0.0])
            .length([-0.12, 0.0], [-0.12, 1.0], "1 m")
            .note([0.5, 0.5], "square")
            .note([1.763, 0.25], "ellipse"))
        .cost(|spec| 1e-6 * spec.level.h.powi(-4))
        .tables(tables())
}

fn plan() -> Plan {
    const EVERY: &str = "n8 n16 n32";
    let stable = [Gimp, Linear, Bspline2].map(|basis| Scheme::poro(basis, TwoGrid));
    let equal = [Gimp, Linear].map(|basis| Scheme::poro(basis, Equal));
    let (gimp, equal_gimp) = (&stable[..1], &equal[..1]);
    Plan::of(levels(1.0, LEVELS))
        .runs(Quick, "n8", gimp, "")
        .runs(Pr, EVERY, &stable, "")
        .runs(Pr, "n8 n16", &equal, "")
        .runs(Pr, EVERY, gimp, "layout=across")
        .runs(Pr, "n8 n16", equal_gimp, "layout=across")
        .runs(Pr, EVERY, gimp, "domain=ellipse layout=across")
        .runs(Pr, EVERY, equal_gimp, "domain=ellipse layout=across")
        .runs(Pr, EVERY, &stable[1..2], "domain=ellipse")
        .runs(Pr, EVERY, &equal[1..], "domain=ellipse")
        .runs(Pr, EVERY, &stable[2..], "pressure_functions=linear")
        .runs(Nightly, EVERY, &equal, "")
        .runs(Nightly, EVERY, equal_gimp, "layout=across")
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Undrained>;
    type Of = Setup<Undrained>;
    let is_square = |space| move |b: &Run<Undrained>| b.domain == Domain::Square && b.space() == Some(space);
    vec![
        Check::truth("inf-sup-bounded", "two grids, three levels: β independent of h, of an order at most 0.15")
            .study(|records| {
                let why = "a stable pair has a bound that no mesh changes";
                let orders = orders(records, INF_SUP, |b: &Of| b.space() == Some(TwoGrid));
                orders.into_iter().map(|(name, order)| Finding::at_most(name, order, SLACK, why)).collect()
            }),
        Check::known_limit("equal-order-is-unstable", "equal order on the square, three levels: β falls with h by an order of at least 1 − 0.15")
            .study(|records| at_least(records, INF_SUP, Equal, (1.0, "bilinear pressures on the cells of the displacement are not stable"))),
        Check::truth("one-constant", "square: only the constant pressure has no effect")
            .when(|b| b.domain == Domain::Square)
            .except(|b| b.basis() == Linear && b.layout == Layout::Across, "sums over points that lie otherwise in every other cell are no exact integrals")
            .within(ZERO_MODES, |_| 1.0, |_| 0.0)
            .because("the particles' sums of ∂N/∂x are exact integrals, zero of what is held all around"),
        Check::known_limit("equal-order-has-checkerboards", "equal order on the square: pressures besides the constant one have no effect")
            .when(is_square(Equal))
            .above(ZERO_MODES, |_| 1.0)
            .because("checkerboards of bilinear functions"),
        Check::known_limit("equal-order-loses-the-pressure", "equal order on the square: error of the pressure larger than the pressure")
            .when(is_square(Equal))
            .above(PRESSURE_ERROR, |_| 1.0)
            .because("pressures of small β answer to hardly any motion"),
        Check::truth("no-locking", "two grids on the square, three levels: error of the displacement of order in h at least 2 − 0.15")
            .study(|records| at_least(records, DISPLACEMENT_ERROR, TwoGrid, (2.0, "a stable pair locks no motion: second order in the mean"))),
        Check::truth("smooth-pressure", "two grids on the square, three levels: error and checkerboard of the pressure of order in h at least 1 − 0.15")
            .study(|records| {
                let why = "a stable pair has the pressure's error of the gradient's, first order";
                let both = [PRESSURE_ERROR, CHECKERBOARD_RATIO];
                both.into_iter().flat_map(|metric| at_least(records, metric, TwoGrid, (1.0, why))).collect()
            }),
    ]
}

/// The order of a metric of the square with a pressure space is at least the formal one less the slack, by order and source.
fn at_least(records: &[Record], metric: Metric, space: SpaceName, (formal, why): (f64, &str)) -> Vec<Finding> {
    let orders = orders(records, metric, |b| b.domain == Domain::Square && b.space() == Some(space));
    checks::at_least(orders, formal, why)
}

/// The order of a metric over three levels, for every scheme and every body.
fn orders(records: &[Record], metric: Metric, own: impl Fn(&Setup<Undrained>) -> bool) -> Vec<(String, f64)> {
    let ladders = ladders_by(records.iter().filter(|r| Setup::holds(r, &own)), |r| (r.scheme(), &r.set));
    let of = |((scheme, set), runs): ((Scheme, &Vec<String>), Vec<&Record>)| {
        let order = observed_order(finest(&runs)?, |r| r.discretisation.h, metric);
        Some((format!("order of {} of {scheme} {}", metric.name, set.join(" ")).trim_end().to_owned(), order))
    };
    ladders.into_iter().filter_map(of).collect()
}

fn tables() -> Vec<ResultTable> {
    let by_level = |title: &str, metric, format| {
        Column::levels(LEVELS.map(|(level, n)| (level, format!("{title}, n = {n}"))), metric, format)
    };
    let numbers = |name: &str, shows: fn(&Record) -> bool| {
        ResultTable::of(name, shows)
            .by(&[SCHEME])
            .columns(by_level("β", INF_SUP, fixed(4)))
            .column(Column::order(INF_SUP).titled("order in h (between levels)"))
            .columns(Column::levels([("n16", "without effect, n = 16")], ZERO_MODES, fixed(0)))
    };
    let errors = [
        by_level("u", DISPLACEMENT_ERROR, share(2)),
        by_level("p", PRESSURE_ERROR, share(2)),
        by_level("checkerboard", CHECKERBOARD_RATIO, share(2)),
    ];
    vec![
        numbers("undrained-square", |r| r.is_default()),
        numbers("undrained-across", |r| r.set == ["layout=across"]),
        numbers("undrained-splines", |r| r.set == ["pressure_functions=linear"]),
        numbers("undrained-ellipse", |r| r.set.first().is_some_and(|s| s == "domain=ellipse")),
        ResultTable::new("undrained-errors", |r| r.is_default(), &[SCHEME], errors.into_iter().flatten()),
    ]
}
