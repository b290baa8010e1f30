//! Matrices of solid and water on a grid that cuts a body, and the effect of ghost penalties on them.
//!
//! Section 5.2 of Pretti et al., doi:10.1002/nme.7630.

mod run;

use crate::cases::prelude::*;
use run::HALF_AXES;

const LEVELS: [Level; 1] = [Level { name: "h0.1", h: 0.1 }];
/// Unknowns of the displacement, at most.
const UNKNOWNS: f64 = 500.0;
/// Places from which on a spread is judged.
const PLACES: usize = 40;

choices! {
    /// Scale of the whole matrix's ghost penalty of the pressure.
    enum PressureGhost { Conductivity = "conductivity", Storage = "storage" }
}

const PRESSURE_GHOST: Parameter = PressureGhost::Conductivity.by_default().named("pressure_ghost");

parameters! {
    struct Ellipse {
        alpha: f64 = real("-", "0.1", 0.0, 10.0), "strength of both ghost penalties: of the displacement's over G, of the pressure's over its conductivity";
        positions: usize = whole("-", "40", 4, 400), "places of the body within one cell of the pressure";
        mobility: f64 = real("-", "1e-6", 1e-12, 1e3), "κ Δt G/h_p² of the whole matrix, h_p the pressure's cell: small where hardly any water flows";
        pressure_ghost: PressureGhost = PRESSURE_GHOST, "what the whole matrix's ghost penalty of the pressure is over: κ Δt, or κ Δt + h_p²/G";
    }
}

metrics! { ALL:
    COND_UU = "log10_cond_uu", "-", "log10 of the condition number of the displacement's matrix, largest over the places";
    COND_UU_MEAN = "log10_cond_uu_mean", "-", "log10 of the condition number of the displacement's matrix, mean over the places";
    COND_UU_LEAST = "log10_cond_uu_least", "-", "log10 of the condition number of the displacement's matrix, least over the places";
    COND_PP = "log10_cond_pp", "-", "log10 of the condition number of the pressure's matrix, largest over the places";
    COND_PP_MEAN = "log10_cond_pp_mean", "-", "log10 of the condition number of the pressure's matrix, mean over the places";
    COND_PP_LEAST = "log10_cond_pp_least", "-", "log10 of the condition number of the pressure's matrix, least over the places";
    COND = "log10_cond", "-", "log10 of the condition number of the whole matrix, largest over every fourth place";
    COND_SCALED = "log10_cond_scaled", "-", "log10 of the condition number of the whole matrix scaled to a diagonal of ones, largest over every fourth place";
    SOFTEST_UU = "softest_uu", "-", "least eigenvalue of the displacement's matrix over G, least over the places";
    SOFTEST_PP = "softest_pp", "-", "least eigenvalue of the pressure's matrix over its conductivity, least over the places";
    MIRROR_ERROR = "mirror_error", "-", "largest difference of log10 of the displacement's condition number between a place and its mirror image";
    DEFLECTION_CHANGE = "deflection_change", "-", "change by α of the mean deflection, under its weight, of a cantilever of eight cells that fits the grid";
}

pub(super) fn case() -> Case {
    case_of::<Setup<Ellipse>>("conditioning", "Condition numbers of a body that no grid line fits", ALL)
        .planned(plan())
        .described("Half an ellipse at forty places within one cell of the pressure: condition numbers of the matrices of displacement and \
            pressure and of the whole, for strengths of the ghost penalties, and what these cost a cantilever.")
        .reference("Theory: a penalty is positive semidefinite, so that it lowers no eigenvalue and no body bends more.")
        .reference("Figure 8 of Pretti et al., doi:10.1002/nme.7630, as its text tells: its numbers were not at hand.")
        .limit("Matrices of an undeformed body at small strain, of the solver's functions and facets but assembled here.")
        .limit("How flat condition numbers are with a penalty is observed, no theory of the material point method bounds it.")
        .wanted("bending", "deflection of the cantilever over that without a penalty", "no-body-bends-more")
        .checks(checks())
        .headline(COND_UU, "log₁₀ cond uu, most", 1.0, 2)
        .headline(COND_UU_MEAN, "mean", 1.0, 2)
        .headline(COND_PP, "log₁₀ cond pp, most", 1.0, 2)
        .headline(COND_PP_MEAN, "mean", 1.0, 2)
        .headline(DEFLECTION_CHANGE, "change of deflection (%)", 100.0, 2)
        .watched(&["log10_cond_uu", "log10_cond_pp"])
        .sketch(sketch())
        .tables(tables())
}

fn plan() -> Plan {
    let [two, equal] = [TwoGrid, Equal].map(|space| [Gimp, Linear].map(|basis| Scheme::poro(basis, space)));
    Plan::of(LEVELS)
        .runs(Quick, "h0.1", &two[..1], "positions=8")
        .each(Pr, "h0.1", &two, ["", "alpha=0"])
        .runs(Nightly, "h0.1", &equal, "")
        .each(Nightly, "h0.1", &two, ["pressure_ghost=storage", "mobility=1", "alpha=0 mobility=1"])
        .each(Nightly, "h0.1", &two, ["alpha=0.001", "alpha=0.01", "alpha=1", "alpha=10"])
}

fn sketch() -> Sketch {
    let [a, b] = HALF_AXES.map(|a| 0.1 * a);
    Sketch::of(
        "Half an ellipse of 20 by 6 cells, held and drained at its straight side, which is moved along a grid line.",
    )
    .half_ellipse(0.0, [a, b])
    .held([-a, 0.0], [a, 0.0])
    .length([-a, -0.2], [a, -0.2], "20 h")
    .length([a + 0.15, 0.0], [a + 0.15, b], "6 h")
    .note([0.0, 0.25], "moved through 2 h")
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Ellipse>;
    const WORK: &str = "the work of a load falls as stiffness grows";
    let spread = |[most, least]: [Metric; 2], name: String| {
        Quantity::new(name, move |r: &Run<Ellipse>| r.metric(most) - r.metric(least))
    };
    let flat = |pair: [Metric; 2], bound: f64| {
        Demand::at_most(spread(pair, format!("spread of {}", pair[0].name)), move |_| bound)
    };
    vec![
        Check::truth(
            "mirror",
            "condition numbers of a place and its mirror image agree to rounding: n ε times the condition number",
        )
        .at_most(MIRROR_ERROR, |e| {
            let condition = 10.0_f64.powf(e.metric(COND_UU));
            UNKNOWNS * f64::EPSILON * condition
        })
        .because("ellipse, particles and both grids are symmetric, and so is the set of places"),
        Check::truth(
            "no-eigenvalue-falls",
            "least eigenvalues of displacement and pressure, over all places, never fall as α grows",
        )
        .study(|records| {
            let why = "a penalty is positive semidefinite";
            let pairs = [SOFTEST_UU, SOFTEST_PP].into_iter().flat_map(|metric| over_strength(records, metric));
            let found =
                |(name, [before, after]): (_, [f64; 2])| Finding::above(name, after / before, 1.0 - ROUNDING, why);
            pairs.map(found).collect()
        }),
        Check::truth(
            "no-body-bends-more",
            "change of the cantilever's deflection zero without a penalty and negative with one",
        )
        .at_most(DEFLECTION_CHANGE, |e| if e.alpha > 0.0 { -ROUNDING } else { ROUNDING })
        .because(WORK),
        Check::truth("deflection-falls-with-strength", "the cantilever's deflection falls as α grows").study(
            |records| {
                let pairs = over_strength(records, DEFLECTION_CHANGE).into_iter();
                pairs.map(|(name, [before, after])| Finding::at_most(name, after - before, ROUNDING, WORK)).collect()
            },
        ),
        Check::known_limit(
            "cuts-spoil-matrices",
            "GIMP without penalties, forty places: condition number of the displacement varies by more than a decade",
        )
        .when(|e| e.basis() == Gimp && e.alpha == 0.0 && e.positions >= PLACES)
        .above(spread([COND_UU, COND_UU_LEAST], "spread of log10_cond_uu".to_owned()), |_| 1.0)
        .because("a function that hardly sees the body has hardly a stiffness"),
        Check::regression(
            "flat",
            "α = 0.1, forty places: log10 of the condition numbers varies by at most 0.3 (uu) and 0.4 (pp)",
        )
        .when(|e| e.alpha == 0.1 && e.positions >= PLACES)
        .each([flat([COND_UU, COND_UU_LEAST], 0.3), flat([COND_PP, COND_PP_LEAST], 0.4)])
        .because("as observed"),
    ]
}

/// A metric at two strengths next to each other, by name, for every scheme and number of places.
fn over_strength(records: &[Record], metric: Metric) -> Vec<(String, [f64; 2])> {
    let mut ladders: BTreeMap<(String, usize), Vec<(f64, f64)>> = BTreeMap::new();
    for e in Run::<Ellipse>::all(records).filter(|e| e.record.changes_none_but(&["alpha", "positions"])) {
        ladders.entry((e.scheme.to_string(), e.positions)).or_default().push((e.alpha, e.metric(metric)));
    }
    let mut all = Vec::new();
    for ((scheme, places), mut points) in ladders {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in points.windows(2) {
            let name = format!("{} of {scheme} at {places} places, α from {} to {}", metric.name, pair[0].0, pair[1].0);
            all.push((name, [pair[0].1, pair[1].1]));
        }
    }
    all
}

fn tables() -> Vec<ResultTable> {
    const ALPHA: Label = ("α", |r| Setup::<Ellipse>::number_of(r, |e| e.alpha).to_string());
    const WATER: Label = ("κ Δt G/h_p²", |r| Setup::<Ellipse>::number_of(r, |e| e.mobility).to_string());
    const OVER: Label = ("ghost of p over", |r| r.parameters.text(PRESSURE_GHOST));
    let two = |title, metric| Column::metric(title, metric, fixed(2));
    vec![
        ResultTable::of("conditioning-alpha", |r| r.changes_none_but(&["alpha"]))
            .by(&[SCHEME, ALPHA])
            .column(two("uu least", COND_UU_LEAST))
            .column(two("mean", COND_UU_MEAN))
            .column(two("most", COND_UU))
            .column(two("pp least", COND_PP_LEAST))
            .column(two("mean", COND_PP_MEAN))
            .column(two("most", COND_PP))
            .metric("deflection", DEFLECTION_CHANGE, percent(2)),
        ResultTable::of("conditioning-whole", |r| r.changes_none_but(&["alpha", "mobility", "pressure_ghost"]))
            .by(&[SCHEME, WATER, ALPHA, OVER])
            .columns(
                [("raw", COND), ("scaled", COND_SCALED)].map(|(title, metric)| Column::metric(title, metric, fixed(1))),
            ),
    ]
}
