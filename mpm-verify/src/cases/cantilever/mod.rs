//! A cantilever under its weight: the quasi-static case of the implicit paper.
//!
//! Section 3.1 of Wang, Vardon, Hicks & Chen (2016).

mod checks;
mod edge;
mod figures;
pub(super) mod foreign;
mod run;

use crate::cases::prelude::*;
use BasisName::Q8;
use run::{DEPTH, LENGTH};

const LEVELS: [(&str, &str); 4] =
    [("h0.1", "h = 0.1 m"), ("h0.05", "0.05"), ("h0.025", "0.025"), ("h0.0125", "0.0125")];
/// The paper's choices.
const PAPER: [&str; 3] = ["law=jaumann-linear", "points=gauss", "stabilisation=soft"];

choices! {
    pub(super) enum LawName {
        Hencky = "hencky", NeoHookean = "neo-hookean", Jaumann = "jaumann", JaumannLinear = "jaumann-linear",
    }
    /// Initial positions of the particles in a cell.
    pub(super) enum Points { Uniform = "uniform", Gauss = "gauss" }
    /// Stabilisation of functions that see hardly any material.
    pub(super) enum Stabilised { None = "none", Soft = "soft", Ghost = "ghost" }
}

parameters! {
    pub(super) struct Cantilever {
        law: LawName = LawName::Hencky.by_default(), "elastic law; jaumann is integrated to second order, jaumann-linear as the paper does";
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e5");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0");
        weight: f64 = real("N/m³", "4000", 1.0, 1e6), "weight of the initial volume at the end";
        load_steps: i32 = common::LOAD_STEPS.with_default("20"), "equal steps of the weight";
        points_per_direction: usize = whole("-", "4", 2, 8), "particles per cell and direction; of one, in the middle, what alternates from node to node has no strain";
        points: Points = Points::Uniform.by_default(),
            "where particles start: in the middle of equal parts of a cell, or, the paper's subdivision, two Gauss points in each half of their number";
        stabilisation: Stabilised = Stabilised::Ghost.by_default(), "what holds functions that see hardly any material";
        ghost: f64 = common::GHOST, "of ghost: its share of Young's modulus; 0: none";
        stabilisation_factor: f64 = real("-", "0.01", 1e-8, 1.0), "of soft: its share of the stiffness of the mesh";
        tolerance: f64 = real("-", "1e-9", 1e-13, 1e-8), "residual of a converged step over the loads";
    }
}

metrics! { OWN:
    CORNER_UX = "corner_ux", "m", "u_x of the lower right corner, (1, 0) m, extrapolated linearly from the nearest particles";
    CORNER_UY = "corner_uy", "m", "u_y of the lower right corner, by the same extrapolation";
    EDGE_MEAN_UX = "edge_mean_ux", "m", "u_x averaged over the right side, extrapolated from the last two columns of particles";
    EDGE_MEAN_UY = "edge_mean_uy", "m", "u_y averaged over the right side, by the same extrapolation";
    CORNER_ERROR = "corner_error", "-", "distance of corner_uy from the reference over the reference";
    EDGE_MEAN_ERROR = "edge_mean_error", "-", "distance of edge_mean_uy from the reference over the reference";
    STRESS_MIN = "stress_min", "Pa", "least σ_xx at a particle: compression";
    STRESS_MAX = "stress_max", "Pa", "greatest σ_xx at a particle: tension";
    STRESS_ERROR = "stress_error", "-", "rms distance of σ_xx from the reference at six points near the clamp, over the rms of the reference";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    NEWTON_RATE = "newton_rate", "-", "largest over the steps of the least contraction of the residual in an iteration, over √(τ/r) from a residual r to the tolerance τ";
    CUTS = "cut_steps", "-", "load steps that were taken in parts";
    LOG10_CONDITION = "log10_condition", "-", "log₁₀ of the estimated condition, in the 1-norm, of the stiffness at the end, scaled to a diagonal of ones";
    FORCE_RATIO = "force_ratio", "-", "largest out-of-balance force ratio of a step, the paper's Eq. (37); the tolerance, if it is less";
    FORCE_ROUNDING = "force_rounding", "-", "largest such ratio that rounding of the stresses by four last bits may leave: Newton's method asks for no less";
    ENERGY_RATIO = "energy_ratio", "-", "largest work of a step's residual on its last correction over that of the loads, for the paper's Eq. (38); the tolerance, if it is less";
    REACTION_ERROR = "reaction_error", "-", "distance of the clamp's reaction from the weight over the weight; the tolerance, if it is less";
    MASS = "mass", "kg/m", "mass of the beam";
}

metrics! {
    /// σ_xx at material points (m).
    STRESSES at [f64; 2]:
    [0.1, 0.05] => "stress_xx_0.1_0.05", "Pa", "σ_xx at the material point (0.1, 0.05) m, by a linear fit over the particles within h";
    [0.1, 0.15] => "stress_xx_0.1_0.15", "Pa", "σ_xx at the material point (0.1, 0.15) m, by the same fit";
    [0.1, 0.25] => "stress_xx_0.1_0.25", "Pa", "σ_xx at the material point (0.1, 0.25) m, by the same fit";
    [0.2, 0.05] => "stress_xx_0.2_0.05", "Pa", "σ_xx at the material point (0.2, 0.05) m, by the same fit";
    [0.2, 0.15] => "stress_xx_0.2_0.15", "Pa", "σ_xx at the material point (0.2, 0.15) m, by the same fit";
    [0.2, 0.25] => "stress_xx_0.2_0.25", "Pa", "σ_xx at the material point (0.2, 0.25) m, by the same fit";
}

pub(super) fn case() -> Case {
    let metrics: Vec<Metric> = OWN.iter().copied().chain(names(STRESSES)).collect();
    Case::of::<2, run::Bending>("cantilever", "Cantilever under its weight", &metrics)
        .planned(plan())
        .described("An elastic beam in plane strain, clamped on the left, bends under its own weight by half its length, quasi-statically: \
            the case by which the implicit paper shows its method. Quadratic splines with a ghost penalty converge to the \
            finite elements; the paper's serendipity elements don't converge.")
        .references(crate::exact::cantilever::describe())
        .limit("The corners of the clamp are singular points: the greatest stresses grow without bound under refinement.")
        .limit("Serendipity elements are the paper's, h by 1.5 h, for this case alone.")
        .wanted("deflection", "u_y of the corner under the whole weight", "corner")
        .missed_by("coarse-bending no-stabilisation")
        .wanted("stress", "σ_xx at six points near the clamp", "stress")
        .missed_by("coarse-bending no-stabilisation")
        .checks(checks::checks())
        .headline(CORNER_UX, "corner u_x (m)", 1.0, 4)
        .headline(CORNER_UY, "corner u_y (m)", 1.0, 4)
        .headline(EDGE_MEAN_UY, "edge mean u_y (m)", 1.0, 4)
        .headline(STRESS_MIN, "σ_xx from (kPa)", 1e-3, 1)
        .headline(STRESS_MAX, "to (kPa)", 1e-3, 1)
        .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
        .headline(LOG10_CONDITION, "log₁₀ condition", 1.0, 1)
        .quantity(error(CORNER_ERROR, "relative error of the corner's u_y"))
        .quantity(error(STRESS_ERROR, "relative error of σ_xx near the clamp"))
        .watched(&["corner_uy", "newton_iterations"])
        .field(FieldView::at_end(["stress_xx", "σ_xx at 4 kN/m³ (Pa)"], (-4e4, 4e4), [(-0.05, 1.05), (-0.65, 0.35)]))
        .sketch(Sketch::block("A beam 1 m long and 0.3 m deep, clamped on its left side, under its own weight.", [LENGTH, DEPTH])
            .held([0.0, 0.0], [0.0, DEPTH])
            .length([0.0, -0.1], [LENGTH, -0.1], "1 m")
            .length([1.12, 0.0], [1.12, DEPTH], "0.3 m")
            .note([0.5, 0.24], "4 kN/m³")
            .probe([LENGTH, 0.0], "corner")
            .loads((0..4).map(|k| 0.2 + 0.2 * f64::from(k)), [0.19, 0.07]))
        .cost(|spec| 1e-3 * spec.level.h.powi(-3))
        .pictures(figures::draw)
        .tables(tables())
        .breaks_down(|r| {
            let c = Setup::<Cantilever>::of_record(r).ok()?;
            if c.stabilisation == Stabilised::None {
                return Some("without stabilisation functions at the rim see fewer strains than they have unknowns");
            }
            (c.basis() == Q8 && c.load_steps > 40).then_some("particles of serendipity elements leave the body")
        })
}

fn plan() -> Plan {
    let schemes = |bases: &[BasisName]| implicit(&[RuleName::QuasiStatic], bases, &[RemedyName::None]);
    let (splines, cubic, gimp, q8) = (schemes(&[Bspline2]), schemes(&[Bspline3]), schemes(&[Gimp]), schemes(&[Q8]));
    let low = schemes(&[Linear, Gimp]);
    let paper = PAPER.join(" ");
    let linear_gauss = "law=jaumann-linear points=gauss";
    let ghosts = ["0.0005", "0.005", "0.05", "0.5", "1"].map(|f| format!("ghost={f}"));
    let softer = ["0.1", "0.001", "0.0001", "0.00001"].map(|f| format!("{paper} stabilisation_factor={f}"));
    let points = [2, 6].map(|n| format!("{linear_gauss} points_per_direction={n} stabilisation=soft"));
    let sizes = [("h0.1", 0.1), ("h0.05", 0.05), ("h0.025", 0.025), ("h0.0125", 0.0125)];
    Plan::of(sizes.map(|(name, h)| Level { name, h }))
        .runs(Quick, "h0.1", &splines, "")
        .runs(Pr, "h0.1 h0.05 h0.025", &splines, "")
        .runs(Pr, "h0.1 h0.05", &low, "")
        .runs(Pr, "h0.1", &q8, "stabilisation=soft")
        .each(Pr, "h0.05", &splines, ["law=neo-hookean", "law=jaumann"])
        .runs(Nightly, "h0.0125", &splines, "")
        .runs(Nightly, "h0.025 h0.0125", &low, "")
        .runs(Nightly, "h0.1 h0.05", &cubic, "")
        .runs(Nightly, "h0.05 h0.025", &q8, "stabilisation=soft")
        .runs(Long, "h0.0125", &q8, "stabilisation=soft")
        .runs(Long, "h0.025 h0.0125", &cubic, "")
        .runs(Nightly, "h0.1", &schemes(&[Linear, Gimp, Bspline2, Bspline3, Q8]), "stabilisation=none")
        .each(Nightly, "h0.05", &splines, [5, 10, 40, 80, 160].map(|n| format!("load_steps={n}")))
        .each(Nightly, "h0.05", &splines, [10, 40].map(|n| format!("law=jaumann load_steps={n}")))
        .each(Nightly, "h0.05", &splines, [10, 20, 40, 80].map(|n| format!("law=jaumann-linear load_steps={n}")))
        .runs(Nightly, "h0.05", &splines, "points=gauss")
        .each(Nightly, "h0.05", &splines, [2, 3, 6].map(|n| format!("points_per_direction={n}")))
        .each(Nightly, "h0.05", &splines, ["0.1", "0.01"].map(|f| format!("ghost={f}")))
        .each(Nightly, "h0.05", &splines, ["stabilisation=soft stabilisation_factor=0.1", "stabilisation=soft"])
        .runs(Nightly, "h0.05", &splines, "stabilisation=soft stabilisation_factor=0.001")
        .runs(Nightly, "h0.05", &splines, "stabilisation=soft stabilisation_factor=0.0001")
        .runs(Nightly, "h0.05", &splines, "law=neo-hookean load_steps=10")
        .each(Nightly, "h0.05", &gimp, ["points_per_direction=2", "load_steps=5", "load_steps=80"])
        // Ghost penalties of GIMP, beside its own.
        .each(Nightly, "h0.1 h0.05 h0.025", &gimp, ghosts)
        // The paper's elements, points, law and stabilisation: Figures 2 to 4.
        .runs(Nightly, "h0.1", &q8, &paper)
        .runs(Nightly, "h0.1", &q8, &format!("{linear_gauss} stabilisation=none"))
        .each(Nightly, "h0.1", &q8, softer)
        .runs(Nightly, "h0.1", &q8, &format!("{paper} load_steps=40 stabilisation_factor=0.0001"))
        .each(Nightly, "h0.1", &q8, points)
}

fn tables() -> Vec<ResultTable> {
    let number = |r: &Record, of: fn(&Setup<Cantilever>) -> f64| Setup::number_of(r, of);
    /// The error of the corner's u_y; of a run that broke down, that it did.
    fn error(r: &Record) -> String {
        if r.status == Status::Failed {
            return "breaks down".to_owned();
        }
        let setup = Setup::<Cantilever>::of_record(r).map_err(|e| e.to_string());
        let exact = setup.and_then(|c| c.solution()).map_or(f64::NAN, |s| s.bottom_right[1]);
        percent(2).text(r.metric(CORNER_UY) / exact - 1.0)
    }
    const STABILISATION: Label = ("stabilisation", |r| word(r, "stabilisation", "ghost"));
    const LAW: Label = ("law", |r| word(r, "law", "hencky"));
    const BESIDE_PAPER: Label = ("changed", |r| {
        let changed: Vec<&str> = r.set.iter().map(String::as_str).filter(|set| !PAPER.contains(set)).collect();
        if changed.is_empty() { "–".to_owned() } else { changed.join(", ") }
    });
    // The penalty as a share of G = E/2.
    const ALPHA: Label = ("α_u", |r| format!("{}", 2.0 * Setup::<Cantilever>::number_of(r, |c| c.ghost)));
    let errors = |title: fn(&str) -> String, levels: &[(&'static str, &'static str)]| -> Vec<Column> {
        let column = |&(level, name): &(&'static str, &'static str)| Column::text(title(name), error).at(level);
        levels.iter().map(column).collect()
    };
    let steps = [5.0, 10.0, 20.0, 40.0, 80.0, 160.0].map(|steps| {
        Column::text(format!("{steps} steps"), error).of(move |r| number(r, |c| f64::from(c.load_steps)) == steps)
    });
    let columns = || {
        let kilo = fixed(1).times(1e-3);
        [
            Column::text("error of u_y", error),
            Column::metric("σ_xx from (kPa)", STRESS_MIN, kilo),
            Column::metric("to (kPa)", STRESS_MAX, kilo),
            Column::metric("iterations", NEWTON_ITERATIONS, fixed(0)),
            Column::metric("log₁₀ condition", LOG10_CONDITION, fixed(1)),
        ]
    };
    let splines = |r: &Record| r.basis() == Bspline2 && r.level == "h0.05";
    let keeps_law_and_load = |r: &Record| r.set.iter().all(|s| !s.starts_with("law") && !s.starts_with("load"));
    vec![
        ResultTable::of("cantilever-cells", |r| r.changes_none_but(&["stabilisation"]))
            .by(&[BASIS, STABILISATION])
            .columns(errors(str::to_owned, &LEVELS)),
        ResultTable::of("cantilever-steps", move |r| splines(r) && r.changes_none_but(&["load_steps", "law"]))
            .by(&[LAW])
            .columns(steps),
        ResultTable::new("cantilever-choices", move |r| splines(r) && keeps_law_and_load(r), &[CHANGED], columns()),
        ResultTable::of("cantilever-ghosts", |r| r.basis() == Gimp && r.changes_none_but(&["ghost"]))
            .by(&[ALPHA])
            .columns(errors(|name| format!("error of u_y, {name}"), &LEVELS[..3]))
            .columns(Column::levels([("h0.05", "log₁₀ condition, 0.05")], LOG10_CONDITION, fixed(1))),
        ResultTable::of("cantilever-paper", |r| r.basis() == Q8 && r.level == "h0.1" && r.set.len() > 2)
            .by(&[BESIDE_PAPER])
            .metric("corner u_x (m)", CORNER_UX, fixed(3))
            .metric("corner u_y (m)", CORNER_UY, fixed(3))
            .metric("edge mean u_y (m)", EDGE_MEAN_UY, fixed(3))
            .columns(columns()),
    ]
}
