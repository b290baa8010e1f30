//! A flexible strip on soil full of water: the solver of solid and water where the ground sinks out of its cells, and
//! where clay yields.
//!
//! G. Pretti et al., section 5.3.

mod checks;
mod figures;
mod reference;
mod run;

use super::poro::spaces;
use crate::cases::prelude::*;
use run::SIDE;

const LEVELS: [(&str, f64); 3] = [("b2", 2.0), ("b4", 4.0), ("b8", 8.0)];

/// Loads at which strain is small: the reference's steps, and no flow.
const SMALL: &str = "load=40";
const UNDRAINED: &str = "conductivity=1e-16 load=40 steps=1";
/// A square instead of a strip, at such loads and at the whole one.
const SQUARE: &str = "dimension=3 load=40";
const SQUARE_UNDRAINED: &str = "conductivity=1e-16 dimension=3 load=40 steps=1";
const SQUARE_LARGE: &str = "dimension=3";
/// Clay, until it bears no more.
const CLAY: &str = "law=cam-clay load=1e5";
/// Clay before that.
const CLAY_BELOW: &str = "law=cam-clay load=5.5e4";
/// Stiff undrained clay under a load, and under a settlement.
const LIMIT_LOAD: &str = "conductivity=1e-16 law=cam-clay load=7.2e4 steps=72 young_modulus=1e8";
const LIMIT_SETTLEMENT: &str = "conductivity=1e-16 control=settlement law=cam-clay young_modulus=1e8";
/// Clay under a load on its whole surface that water leaves freely.
const UNIFORM: &str = "duration=1e10 half_width=5 law=cam-clay load=1e5";

choices! {
    enum Soil { Elastic = "elastic", CamClay = "cam-clay" }
    enum Control { Load = "load", Settlement = "settlement" }
}

const LAW: Parameter = Soil::Elastic.by_default().named("law");
const CONTROL: Parameter = Control::Load.by_default().named("control");

parameters! {
    struct Strip {
        law: Soil = LAW, "improved Hencky, or modified Cam clay with that elasticity";
        dimension: i32 = whole("-", "2", 2, 3), "2: a strip, in plane strain; 3: a square whose half side is half_width, on a cube of elastic soil";
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e6"), "Young's modulus of the soil at rest";
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.25"), "Poisson's ratio of the soil at rest";
        porosity: f64 = real("-", "0.4", 0.01, 0.99), "porosity of the undeformed soil";
        conductivity: f64 = real("m/s", "1e-6", 1e-18, 1.0), "hydraulic conductivity k of the undeformed soil, of water of 9810 N/m³, after Kozeny and Carman";
        load: f64 = real("Pa", "4e5", 1.0, 1e8), "load q on the strip at the end";
        half_width: f64 = real("m", "1", 0.5, 5.0), "half the width of the strip; 5 m is the whole surface";
        duration: f64 = real("s", "2000", 1e-6, 1e12), "time in which the load, or the settlement, grows linearly";
        steps: i32 = whole("-", "20", 1, 10_000), "equal steps";
        control: Control = CONTROL, "what is given: a load on the flexible strip, or the settlement of a rigid smooth one";
        penetration: f64 = real("m", "0.01", 1e-9, 0.1), "settlement at which the limit load is reported; with control=settlement the settlement at the end";
        drain: f64 = real("-", "1e4", 1.0, 1e6), "what the drained surface lets through for its pressure, over κ₀/h";
        ghost_displacement: f64 = real("-", "0.1", 0.0, 10.0), "ghost penalty of the displacement over G";
        ghost_pressure: f64 = real("-", "0.01", 0.0, 10.0), "ghost penalty of the pressure over κ₀ Δt";
        projection: f64 = real("-", "1", 0.01, 100.0), "ppp: its strength times 2G";
        initial_pressure: f64 = real("Pa", "2e4", 0.0, 1e7), "cam-clay: isotropic effective pressure at the start, which a load on the whole surface balances";
        preconsolidation: f64 = real("Pa", "4e4", 0.0, 1e8), "cam-clay: preconsolidation p_c at the start";
        critical_ratio: f64 = real("-", "1", 0.0, 3.0), "cam-clay: q/p of the critical state";
        plastic_compressibility: f64 = real("-", "0.05", 0.0, 1.0), "cam-clay: λ − κ";
        shape_alpha: f64 = real("-", "1", 0.0, 1.0), "cam-clay: α of Collins and Hilder, 1 the ellipse";
        shape_gamma: f64 = real("-", "1", 0.0, 1.0), "cam-clay: γ of Collins and Hilder, 1 the ellipse";
        tolerance: f64 = real("-", "1e-9", 1e-13, 1e-8), "residual of a converged step over what it balances";
    }
}

metrics! { ALL:
    SETTLEMENT = "settlement", "-", "settlement at the end of the particle next to the axis at the surface, over the half width B";
    SETTLEMENT_RATIO = "settlement_ratio", "-", "settlement over that of finite elements at small strain; only for elastic soil under at most 1 kPa, in their steps or undrained";
    PRESSURE_ERROR = "pressure_error", "-", "rms over the particles at the end of the pressure's distance from that of the same elements, over the load";
    PRESSURE_ERROR_LARGEST = "pressure_error_largest", "-", "the largest of these distances farther than B/2 from the strip's edge";
    ROUGHNESS = "roughness", "-", "rms at the end of the pressure less the mean of the four particles beside it, over the load, farther than B/2 from the strip's edge";
    LEAST_PRESSURE = "least_pressure", "-", "least pressure of a particle at the end, over the load";
    MOST_PRESSURE = "largest_pressure", "-", "largest pressure of a particle at the end, over the load";
    LAST_LOAD = "last_load", "Pa", "load on the strip after the last step or part of one that has a solution: of Cam clay its limit, if it has not come to the whole";
    LIMITING_LOAD = "limit_load", "Pa", "load at the settlement `penetration`; none if it was not reached";
    GROWTH = "growth", "-", "control=settlement: what the load has grown by in the last quarter, over itself";
    UNIFORM_ERROR = "uniform_error", "-", "of Cam clay, α = γ = 1, under a load on its whole surface: relative error of the settlement of all of it, by its volume";
    PLASTIC_STRAIN = "plastic_strain", "-", "largest equivalent plastic strain";
    SUPPORT_ERROR = "support_error", "-", "distance of the force on the base from the loads, over these; 10⁻⁹ if less";
    MASS_ERROR = "mass_error", "-", "change of the volume and outflow together, over what the strip displaces; 10⁻⁹ if it is less, which no golden should hold";
    TURNOVER = "turnover", "-", "Σ V |J̃ − 1| of all particles and steps over what the strip displaces";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MOST_ITERATIONS = "newton_most", "-", "most iterations of a step that has a solution";
    ENTRIES = "matrix_entries", "-", "entries of a matrix, on average";
}

pub(super) fn case() -> Case {
    Case::of::<2, Setup<Strip>>("strip", "Flexible strip on soil full of water", ALL)
        .planned(plan())
        .described("A strip without stiffness presses on soil full of water in plane strain, elastic or Cam clay: the surface leaves the \
            grid's lines by half the strip's half width, and clay yields until it bears no more. Or a square on a cube of soil.")
        .reference("references/strip_fem.py: Taylor and Hood's finite elements at small strain, of the same steps and undrained, of a strip and of a square.")
        .reference("Prandtl's limit load (2 + π) s_u of undrained clay, with the strength of its critical state.")
        .limit("The paper's numbers were not to be read: size, moduli, load and times are ours.")
        .limit("At large strain nothing is known but balances, and that pressures are smooth.")
        .limit("A rigid strip is held nodes, for settlements that are small against a cell.")
        .wanted("settlement", "settlement of the finest of three levels", "taylor-hood square")
        .wanted("limit-load", "limit load of undrained clay", "prandtl")
        .where_referenced()
        .checks(checks::checks())
        .headline(SETTLEMENT, "settlement (% of B)", 100.0, 3)
        .headline(SETTLEMENT_RATIO, "over that of finite elements", 1.0, 4)
        .headline(PRESSURE_ERROR, "error of p (% of q)", 100.0, 3)
        .headline(ROUGHNESS, "roughness of p (% of q)", 100.0, 3)
        .headline(LEAST_PRESSURE, "least p (% of q)", 100.0, 2)
        .headline(LAST_LOAD, "last load (kPa)", 1e-3, 2)
        .headline(LIMITING_LOAD, "limit load (kPa)", 1e-3, 2)
        .headline(UNIFORM_ERROR, "of clay in uniaxial strain, error (%)", 100.0, 4)
        .headline(NEWTON_ITERATIONS, "Newton iterations", 1.0, 0)
        .headline(ENTRIES, "entries of a matrix", 1.0, 0)
        .quantity(value(SETTLEMENT, "settlement"))
        .watched(&["load", "settlement"])
        .sketch(Sketch::block("Half of a flexible strip on a square of soil whose surface is drained.", [5.0, 5.0])
            .held([0.0, 0.0], [5.0, 0.0])
            .held([0.0, 0.0], [0.0, 5.0])
            .length([0.0, -0.5], [5.0, -0.5], "5 B")
            .note([3.2, 5.3], "drained")
            .note([0.5, 6.0], "q")
            .loads((0..4).map(|k| 0.125 + 0.25 * f64::from(k)), [5.7, 5.05]))
        .cost(|spec| match spec.set.iter().any(|s| s == SQUARE_LARGE) {
            true => 0.1 * spec.level.h.powi(-6),
            false => 1e-3 * spec.level.h.powi(-3),
        })
        .begun(problem::begin_in::<2, 3, Loaded>)
        .pictures(figures::draw)
        .tables(tables())
        .breaks_down(|r| {
            let none = Loaded::holds(r, |s| s.ghost_displacement == 0.0);
            none.then_some("no ghost penalty on displacements: cells of which the body has hardly anything turn inside out")
        })
}

fn plan() -> Plan {
    const EVERY: &str = "b2 b4 b8";
    let all = spaces(Gimp);
    let two_grid = &all[..1];
    Plan::of(levels(1.0, LEVELS))
        .runs(Quick, "b2", two_grid, "")
        .runs(Pr, EVERY, &all, UNDRAINED)
        .runs(Pr, "b2 b4", two_grid, SMALL)
        .runs(Pr, "b4", two_grid, "")
        .runs(Pr, "b2", two_grid, CLAY_BELOW)
        .each(Nightly, EVERY, &all, ["", SMALL])
        .runs(Nightly, EVERY, two_grid, CLAY)
        .runs(Nightly, EVERY, &all, CLAY_BELOW)
        .each(Nightly, EVERY, two_grid, [LIMIT_LOAD, LIMIT_SETTLEMENT])
        .runs(Pr, "b2", two_grid, SQUARE_UNDRAINED)
        .runs(Nightly, "b2", &all, SQUARE_UNDRAINED)
        .runs(Long, "b4", &all, SQUARE_UNDRAINED)
        .runs(Nightly, "b2", two_grid, SQUARE)
        .each(Long, "b2 b4", two_grid, [SQUARE, SQUARE_LARGE])
        .each(Pr, "b2", two_grid, [10, 20, 40].map(|n| format!("{UNIFORM} steps={n}")))
        .each(Nightly, "b4", two_grid, [1, 2, 5, 10, 40].map(|n| format!("steps={n}")))
        .each(Nightly, "b4", two_grid, [10, 40].map(|n| format!("{CLAY} steps={n}")))
        .runs(Nightly, "b4", two_grid, "law=cam-clay load=1e5 shape_alpha=0.6 shape_gamma=0.9")
        .each(Nightly, "b4", two_grid, ["ghost_displacement=0 ghost_pressure=0", "ghost_displacement=0"])
        .each(Nightly, "b4", two_grid, ["ghost_pressure=0", "ghost_displacement=0.01", "ghost_displacement=1"])
}

type Loaded = Setup<Strip>;

fn is_of(r: &Record, space: SpaceName) -> bool {
    matches!(r.scheme(), Scheme::Poro(parts) if parts.space == space)
}

/// Whether a run changes the parameters of `set`, and beside these at most the number of steps.
fn is_set_but_steps(r: &Record, set: &str) -> bool {
    let is_other = |s: &&str| !s.starts_with("steps=");
    r.set.iter().map(String::as_str).filter(is_other).eq(set.split_whitespace().filter(is_other))
}

fn is_small(r: &Record) -> bool {
    r.changes(SMALL) || r.changes(UNDRAINED)
}

fn is_elastic_but_steps(r: &Record) -> bool {
    is_set_but_steps(r, "") && Loaded::holds(r, |s| !s.is_plastic())
}

fn is_limit(r: &Record) -> bool {
    is_set_but_steps(r, LIMIT_LOAD) || is_set_but_steps(r, LIMIT_SETTLEMENT)
}

fn tables() -> Vec<ResultTable> {
    const STEPS: Label = ("steps", |r| Loaded::number_of(r, |s| f64::from(s.steps)).to_string());
    const WATER: Label =
        ("water", |r| if Loaded::holds(r, |s| s.is_undrained()) { "none flows" } else { "flows" }.to_owned());
    const SOIL: Label = ("soil", |r| r.parameters.text(LAW));
    const GHOST_U: Label = ("α_u", |r| Loaded::number_of(r, |s| s.ghost_displacement).to_string());
    const GHOST_P: Label = ("α_p", |r| Loaded::number_of(r, |s| s.ghost_pressure).to_string());
    const GIVEN: Label = ("given", |r| r.parameters.text(CONTROL));
    const LOADED: Label = ("load (Pa)", |r| Loaded::number_of(r, |s| s.load).to_string());
    const SIZE: Label = ("B/h", |r| (1.0 / r.discretisation.h).round().to_string());
    let by_level = |metric, title: &str, format: Format| {
        Column::levels(LEVELS.map(|(level, n)| (level, format!("{title}, B/h = {n}"))), metric, format)
    };
    let of_limit = LEVELS.map(|(level, n)| {
        let over =
            |r: &Record| format!("{:.4}", r.metric(LIMITING_LOAD) / Loaded::number_of(r, |s| s.exact().prandtl()));
        Column::text(format!("q/Prandtl's, B/h = {n}"), over).at(level)
    });
    let uniform = ResultTable::of("strip-uniform", |r| is_set_but_steps(r, UNIFORM)).by(&[STEPS]);
    let is_large = |r: &Record| r.is_default() || r.changes(CLAY_BELOW);
    let is_b4 = |r: &Record| is_of(r, TwoGrid) && r.level == "b4";
    let is_of_steps = move |r: &Record| is_b4(r) && (is_elastic_but_steps(r) || is_set_but_steps(r, CLAY));
    let is_of_ghosts = move |r: &Record| is_b4(r) && r.changes_none_but(&["ghost_displacement", "ghost_pressure"]);
    vec![
        ResultTable::of("strip-small", is_small)
            .by(&[WATER, SCHEME])
            .columns(by_level(SETTLEMENT_RATIO, "settlement over theirs", fixed(4)))
            .columns(by_level(PRESSURE_ERROR, "error of p/q", share(2))),
        ResultTable::of("strip-large", is_large)
            .by(&[SOIL, SCHEME])
            .columns(by_level(SETTLEMENT, "settlement/B", fixed(4)))
            .columns(by_level(ROUGHNESS, "roughness", share(3)))
            .column(Column::plain_order("order of roughness", ROUGHNESS))
            .columns(Column::levels([("b4", "p/q least")], LEAST_PRESSURE, fixed(3)))
            .columns(Column::levels([("b4", "q (kPa)")], LAST_LOAD, fixed(2).times(1e-3))),
        ResultTable::of("strip-steps", is_of_steps)
            .by(&[SOIL, STEPS])
            .metric("settlement/B", SETTLEMENT, fixed(4))
            .metric("last load (kPa)", LAST_LOAD, fixed(2).times(1e-3))
            .metric("Newton iterations", NEWTON_ITERATIONS, fixed(0)),
        ResultTable::of("strip-ghosts", is_of_ghosts)
            .by(&[GHOST_U, GHOST_P])
            .metric("settlement/B", SETTLEMENT, fixed(4))
            .metric("roughness", ROUGHNESS, share(3))
            .metric("p/q least", LEAST_PRESSURE, fixed(3))
            .metric("Newton iterations", NEWTON_ITERATIONS, fixed(0)),
        ResultTable::new("strip-limit", is_limit, &[GIVEN, STEPS, SCHEME], of_limit),
        uniform.metric("error of settlement", UNIFORM_ERROR, share(3)),
        ResultTable::of("strip-square", |r| Loaded::holds(r, |s| s.dimension == 3))
            .by(&[LOADED, WATER, SCHEME, SIZE])
            .metric("settlement/B", SETTLEMENT, fixed(6))
            .metric("over that of finite elements", SETTLEMENT_RATIO, fixed(4))
            .metric("error of p/q", PRESSURE_ERROR, share(2))
            .metric("roughness", ROUGHNESS, share(3))
            .metric("Newton iterations", NEWTON_ITERATIONS, fixed(0))
            .metric("entries of a matrix (10⁶)", ENTRIES, fixed(2).times(1e-6))
            .cpu(),
    ]
}
