//! A rigid strip footing on a cohesive, nearly incompressible ground.
//!
//! Section 4.2 of Zhao, Jiang & Choo (2023).

mod checks;
mod curve;
mod figures;
pub(super) mod foreign;
mod reference;
pub(super) mod run;

use crate::cases::prelude::*;
use crate::record::of_defaults;
use RuleName::QuasiStatic;
use reference::{EXACT, mean_stress_at, strength_ratio};
use run::{Pressing, WIDTH};

const COMPARED: [RemedyName; 4] = [RemedyName::None, FbarRecursive, FbarRate, FbarConsistent];

choices! {
    enum Contact { RigidNodes = "rigid-nodes", Barrier = "barrier" }
}

const PENETRATION_RATE: Parameter =
    real("m/s", "2e-3", 1e-6, 1.0).named("penetration_rate").meaning("speed of the footing after its start");

parameters! {
    struct Footing {
        young_modulus: f64 = common::YOUNG_MODULUS;
        poisson_ratio: f64 = common::POISSON_RATIO;
        density: f64 = common::DENSITY, "density ρ; it only matters for how slowly the footing must move";
        undrained_strength: f64 = real("Pa", "100", 1e-6, 1e12), "undrained shear strength s_u of plane strain: the ground yields at ‖s‖ = √2 s_u";
        domain_width: i32 = whole("B", "6", 2, 40), "width of the right half of the ground, in widths of the footing";
        domain_depth: i32 = whole("B", "6", 1, 40), "depth of the ground, in widths of the footing";
        penetration_rate: f64 = PENETRATION_RATE;
        penetration: f64 = real("B", "0.004", 1e-4, 0.1), "penetration at the end, in widths of the footing";
        ramp: f64 = real("s", "0.8", 1e-6, 1e3), "time over which the footing's speed rises from zero";
        damping: f64 = common::DAMPING.with_default("0.002");
        cfl: f64 = common::CFL;
        flip: f64 = common::FLIP;
        wall: common::Wall = common::WALL, "how B-splines meet the sides and the base";
        contact: Contact = Contact::RigidNodes.by_default(), "how the footing presses: nodes that move with it, or a barrier on particles that come near it";
        rough: bool = flag(true), "whether the ground sticks to the footing; if not, it slides freely";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        load_steps: i32 = common::LOAD_STEPS.with_default("16"), "quasi-static: equal steps of the penetration; one that finds no equilibrium is halved";
        tolerance: f64 = common::TOLERANCE.with_default("1e-8");
    }
}

metrics! { OWN:
    NC_B = "nc_b", "-", "bearing capacity factor q/s_u with the pressure q = F/(B/2), mean over the last quarter of the penetration";
    NC_B_PLUS_H = "nc_b_plus_h", "-", "bearing capacity factor with q = F/((B + h)/2): a footing of held nodes on grid lines ends between a held and a free node";
    NC_EFFECTIVE = "nc_effective", "-",
        "bearing capacity factor with the effective width of the held nodes: B for quadratic splines, whose nodes lie in the middle of cells, B + h for GIMP, B + h/2 for cubic ones";
    PRANDTL_ERROR = "prandtl_error", "-", "relative distance of nc_b from 2 + π: the error of the contact pressure";
    NC_PEAK = "nc_peak", "-", "largest q/s_u of the run, by B";
    PLATEAU_RISE = "plateau_rise", "-", "relative growth of the load per 10⁻³ of s/B over the last quarter of the penetration";
    ELASTIC_SLOPE = "elastic_slope", "-", "d(q/s_u)/d(s/B) by B, a straight line fitted to all rows after the start; elastic in runs of great strength";
    FORCE_IMBALANCE = "force_imbalance", "-", "force on the base over that on the footing, less one, mean over the last quarter: inertia";
    MECHANISM_WIDTH = "mechanism_width", "B",
        "half the width of the ground that rises while the footing sinks: where the surface rises by half of what it does in Prandtl's mechanism (Hill's, if smooth)";
    HEAVE = "heave", "-", "mean rise of the surface from 0.75 B to 1.25 B while the footing sinks by one: one half in Prandtl's mechanism";
    MEAN_STRESS_RMS = "mean_stress_rms", "Pa", "rms over all particles of the mean normal stress";
    CHECKERBOARD_RMS = "checkerboard_rms", "Pa", "rms over all particles of σ_m − Πσ_m";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-", "checkerboard_rms over mean_stress_rms";
    OSCILLATION_RATIO = "oscillation_ratio", "-", "rms of the mean normal stress less its plane of best fit in each square of 2h, over mean_stress_rms";
    PLASTIC_STRAIN_MAX = "plastic_strain_max", "-", "largest equivalent plastic strain of a particle";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    MASS = "mass", "kg/m", "mass of the particles";
    NEWTON_ITERATIONS = "newton_iterations", "-", "quasi-static: Newton's iterations";
    LINEAR_ITERATIONS = "linear_iterations", "-", "quasi-static: those of linear solutions";
}

metrics! {
    /// The load on the way, with the penetrations over B at which it is measured.
    CURVE at f64:
    3e-4 => "nc_0.0003", "-", "q/s_u by B at s/B = 0.0003";
    5e-4 => "nc_0.0005", "-", "q/s_u by B at s/B = 0.0005";
    1e-3 => "nc_0.001", "-", "q/s_u by B at s/B = 0.001";
    1.5e-3 => "nc_0.0015", "-", "q/s_u by B at s/B = 0.0015";
    2e-3 => "nc_0.002", "-", "q/s_u by B at s/B = 0.002";
    3e-3 => "nc_0.003", "-", "q/s_u by B at s/B = 0.003";
}

metrics! {
    /// The mean normal stress at material points (in B, the surface at zero).
    MEAN_STRESSES at [f64; 2]:
    [0.25, -0.25] => "mean_stress_0.25_0.25", "-",
        "mean normal stress over s_u at the end at the material point 0.25 B from the axis and 0.25 B deep, by a linear fit over the particles within 2h";
    [0.25, -0.5] => "mean_stress_0.25_0.5", "-", "mean normal stress over s_u at the end at the material point 0.25 B from the axis and 0.5 B deep";
    [0.75, -0.25] => "mean_stress_0.75_0.25", "-", "mean normal stress over s_u at the end at the material point 0.75 B from the axis and 0.25 B deep";
    [1.0, -0.25] => "mean_stress_1_0.25", "-", "mean normal stress over s_u at the end at the material point 1 B from the axis and 0.25 B deep";
    [0.25, -1.0] => "mean_stress_0.25_1", "-", "mean normal stress over s_u at the end at the material point 0.25 B from the axis and 1 B deep";
}

pub(super) fn case() -> Case {
    let metrics: Vec<Metric> = OWN.iter().copied().chain(names(CURVE)).chain(names(MEAN_STRESSES)).collect();
    Case::of::<2, Pressing>("footing", "Strip footing", &metrics)
        .planned(plan())
        .described("A rough rigid strip footing pressed slowly into weightless ground, a Hencky solid with J2 plasticity \
            (plane strain, ν = 0.49). Its bearing capacity is (2 + π) s_u (Prandtl). Standard MPM locks and finds \
            no limit load; the F̄ remedies do, the recursive one depends on the rate.")
        .references(reference::describe())
        .limit("A footing of held nodes acts as wide as up to the middle between its last node and the first free one: B + h, with quadratic splines B.")
        .limit("The footing's nodes stay where they are: strokes are small against a cell.")
        .limit("The inertia of the start shows below s/B = 0.0003; the elastic slope is measured in runs of great strength.")
        .limit("At B/80 three checks fail: the load swings, the mechanism ends a cell early, a mean stress is off by 5 % (docs/footing.md).")
        .wanted("limit-load", "load on the footing at the end", "prandtl fem-plateau limit-load mechanism")
        .missed_by("no-limit-load no-mechanism rises-near-one-half stiff-with-more-particles locked soft-by-diffusion")
        .wanted("pressure", "mean stress at five points at the end", "mean-stress smooth-pressure smooth-squares")
        .missed_by("no-limit-load rises-near-one-half locked checkerboard soft-by-diffusion")
        .checks(checks::checks())
        .headline(NC_B, "N_c by B (–)", 1.0, 3)
        .headline(NC_B_PLUS_H, "N_c by B + h (–)", 1.0, 3)
        .headline(NC_EFFECTIVE, "N_c by effective width (–)", 1.0, 3)
        .headline(PLATEAU_RISE, "rise (%/10⁻³)", 100.0, 2)
        .headline(ELASTIC_SLOPE, "slope (–)", 1.0, 0)
        .headline(FORCE_IMBALANCE, "imbalance (%)", 100.0, 2)
        .headline(MECHANISM_WIDTH, "mechanism (B)", 1.0, 2)
        .headline(CHECKERBOARD_RATIO, "checkerboard (–)", 1.0, 2)
        .headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (10⁻⁶)", 1e6, 2)
        .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
        .quantity(error(PRANDTL_ERROR, "relative error of the contact pressure"))
        .sweep(Sweep::of(PENETRATION_RATE, "penetration rate (m/s)").logarithmic())
        .watched(&["pressure_over_strength", "jacobian_max"])
        .field(FieldView::at_end(["plastic_strain", "plastic strain (-)"], (0.0, 0.004), [(0.0, 2.0), (-1.5, 0.0)]))
        .sketch(sketch([6, 6], "A square of ground six footing widths wide and deep, its base fixed, its sides on rollers, the left one the axis of symmetry; a rigid footing half a metre wide presses on the upper left corner."))
        .cost(cost)
        .own_runs(own_runs)
        .pictures(figures::draw)
        .tables(tables())
}

/// A strength beyond reach: the ground stays elastic.
const ELASTIC: &str = "undrained_strength=1e6";
/// Ground just large enough for the limit load, and a penetration just long enough.
const SMALL: [&str; 3] = ["domain_width=3", "domain_depth=3", "penetration=0.0025"];

/// The runs at the case's own parameters; where there are none, those on small ground, whose limit load is the same.
fn own_runs(records: &[Record]) -> Vec<&Record> {
    let own = of_defaults(records);
    if own.is_empty() { records.iter().filter(|r| r.set == SMALL).collect() } else { own }
}

/// Five times the penetration, through either contact.
const DEEP: [&str; 2] = [
    "domain_width=3 domain_depth=3 penetration=0.02",
    "domain_width=3 domain_depth=3 penetration=0.02 contact=barrier",
];

fn plan() -> Plan {
    let none = RemedyName::None;
    let both = |remedies: &[RemedyName]| pairs(&[Gimp, Bspline2], remedies);
    let three = both(&[none, FbarRecursive, FbarConsistent]);
    let (two, ours) = (both(&[none, FbarConsistent]), both(&[FbarConsistent]));
    let rates = both(&[FbarRecursive, FbarConsistent]);
    let cubic = pairs(&[Bspline3], &[FbarConsistent]);
    let smooth = pairs(&[Gimp], &[FbarRate, FbarConsistent]);
    let averaged = implicit(&[QuasiStatic], &[Gimp, Bspline2], &[FbarConsistent]);
    let statics = implicit(&[QuasiStatic], &[Gimp, Bspline2], &[none, FbarConsistent]);
    let small = &SMALL.join(" ");
    let near = |ratio: &str| format!("{small} poisson_ratio={ratio}");
    let dense = "ppc_per_direction=4";
    Plan::of(levels(WIDTH, [("b10", 10.0), ("b20", 20.0), ("b40", 40.0), ("b80", 80.0)]))
        .runs(Pr, "b10", &three, small)
        .runs(Pr, "b20", &pairs(&[Gimp], &[none, FbarConsistent]), small)
        .runs(Nightly, "b20", &two, small)
        .runs(Nightly, "b10 b20", &both(&COMPARED), "")
        .runs(Long, "b20", &both(&COMPARED), dense)
        .runs(Nightly, "b10", &three, "contact=barrier")
        .runs(Long, "b20 b40", &three, "contact=barrier")
        // Whether standard splines blow up, far beyond the limit load.
        .each(Nightly, "b10", &both(&[none])[1..], DEEP)
        .each(Nightly, "b10", &rates, ["penetration_rate=4e-3", "penetration_rate=1e-3"])
        .runs(Nightly, "b10", &both(&[none, FbarRate, FbarConsistent]), ELASTIC)
        .runs(Long, "b20", &ours, ELASTIC)
        .runs(Nightly, "b10", &smooth, "rough=false")
        .runs(Long, "b40", &ours, "ppc_per_direction=4 penetration=0.003")
        .runs(Long, "b80", &ours, "penetration=0.003")
        .runs(Long, "b40 b80", &both(&COMPARED), "")
        .runs(Long, "b10 b20 b40 b80", &cubic, "")
        .runs(Long, "b10 b20 b40 b80", &other_transfers(), "")
        .runs(Long, "b10", &two, dense)
        .runs(Pr, "b10", &averaged[1..], small)
        .runs(Pr, "b10", &averaged, &near("0.4995"))
        .runs(Nightly, "b10", &averaged, &near("0.499"))
        .runs(Nightly, "b10 b20", &statics, "")
        // Steps of equilibrium at which the finite elements are tabulated, too.
        .runs(Nightly, "b10", &averaged, "load_steps=40")
        .runs(Long, "b20", &averaged, "contact=barrier")
        .runs(Nightly, "b10", &averaged, ELASTIC)
        .runs(Long, "b40 b80", &statics, "")
}

fn cost(spec: &RunSpec) -> f64 {
    let sweep = remedy_cost(spec, [1.0, 1.5, 1.5, 1.5, 2.5]);
    let dense = spec.set.iter().any(|s| s == "ppc_per_direction=4");
    let solver = if spec.scheme.rule().is_some() { 0.15 } else { 1.0 };
    solver * sweep * if dense { 4.0 } else { 1.0 } / spec.level.h.powi(3)
}

/// A footing on ground `across` and `down` of its widths wide and deep, in words.
pub(super) fn sketch([across, down]: [u32; 2], words: &'static str) -> Sketch {
    let ([width, depth], half) = ([across, down].map(|n| f64::from(n) * WIDTH), 0.5 * WIDTH);
    Sketch::of(words)
        .body([[0.0, -depth], [width, -depth], [width, 0.0], [0.0, 0.0]])
        .body([[0.0, 0.0], [half, 0.0], [half, 0.25], [0.0, 0.25]])
        .held([width, -depth], [0.0, -depth])
        .load([0.25 * WIDTH, 1.0], [0.25 * WIDTH, 0.3])
        .length([0.0, -depth - 0.7], [width, -depth - 0.7], &format!("{across}B"))
        .length([width + 0.5, -depth], [width + 0.5, 0.0], &format!("{down}B"))
        .note([1.6 * WIDTH, 0.45], "footing, B/2 = 0.5 m")
        .note([-0.6, -0.5 * depth], "symmetry")
        .note([width - 0.6, -0.5 * depth], "roller")
}

const OF_WIDTH: Label = ("h", |r| r.level.replace('b', "B/"));

fn changed(r: &Record) -> String {
    let word = |set: &String| {
        match &**set {
            "contact=barrier" => "barrier",
            "ppc_per_direction=4" => "4 × 4",
            "rough=false" => "smooth",
            "domain_width=3" => "3B × 3B",
            "domain_depth=3" => "",
            "penetration=0.0025" => "to 0.0025",
            "load_steps=40" => "40 steps",
            other => other,
        }
        .to_owned()
    };
    r.set.iter().map(word).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", ")
}

/// N_c by its own width, which a barrier does not let know.
fn own(r: &Record) -> f64 {
    let known = |c: &Setup<Footing>| if c.presses_by_barrier() { f64::NAN } else { r.metric(NC_EFFECTIVE) };
    Setup::number_of(r, known)
}

fn from_exact(r: &Record) -> f64 {
    own(r) / EXACT - 1.0
}

fn tables() -> Vec<ResultTable> {
    let is_main = |r: &Record| r.basis() != Bspline3 && is_flip(r) && r.is_default() && r.level == "b20";
    let found = |r: &Record| {
        // From q/s_u of a strength beyond reach to that of the reference.
        let scale = Setup::<Footing>::number_of(r, |c| c.strength_ratio() / strength_ratio());
        scale * r.metric(ELASTIC_SLOPE)
    };
    let expected = |r: &Record| {
        let slope = |c: &Setup<Footing>| c.reference_slope().map_or(f64::NAN, |s| s / strength_ratio());
        Setup::number_of(r, slope)
    };
    let gap = |r: &Record| if r.remedy() == RemedyName::None { f64::NAN } else { r.metric(LOG_JACOBIAN_GAP) };
    let mean_stress = |(metric, point): (_, [f64; 2])| {
        let elements = mean_stress_at(point).map_or(String::new(), |s| {
            let value = fixed(2).text(s.value);
            format!("; elements: {value} ± {:.2}", s.uncertainty)
        });
        Column::metric(format!("({}, {}) B{elements}", point[0], -point[1]), metric, fixed(2))
    };
    vec![
        ResultTable::by_remedy("footing", &COMPARED, is_main, |r| fixed(3).text(own(r))),
        ResultTable::of("footing-results", |r| r.set != [ELASTIC] && !r.changes_only("penetration_rate"))
            .by(&[SCHEME, OF_WIDTH, ("changed", changed)])
            .metric("N_c by B", NC_B, fixed(3))
            .metric("by B + h", NC_B_PLUS_H, fixed(3))
            .value("by its own width", own, fixed(3))
            .value("from 2 + π", from_exact, percent(1))
            .metric("rise per 10⁻³", PLATEAU_RISE, percent(1))
            .metric("mechanism (B)", MECHANISM_WIDTH, fixed(2))
            .metric("heave", HEAVE, fixed(2))
            .metric("checkerboard", CHECKERBOARD_RATIO, fixed(2))
            .value("ln(J/J̄) rms (10⁻⁴)", gap, fixed(1).times(1e4))
            .cpu(),
        ResultTable::of("footing-mean-stress", |r| is_flip(r) && r.is_default() && ["b20", "b40"].contains(&&*r.level))
            .by(&[PAIR, OF_WIDTH])
            .columns(MEAN_STRESSES.iter().copied().map(mean_stress)),
        table_of_rates(),
        ResultTable::of("footing-slopes", |r| r.set == [ELASTIC])
            .by(&[SCHEME, OF_WIDTH])
            .value("slope d(q/s_u)/d(s/B)", found, fixed(0))
            .value("finite elements that act as wide", expected, fixed(0))
            .value("difference", move |r| found(r) / expected(r) - 1.0, percent(1)),
        transfers("footing-transfers", &[PAIR, OF_WIDTH], &["4"], |r| percent(2).text(from_exact(r))),
        ResultTable::of("footing-orders", |r| {
            let main = r.basis() != Bspline3 && REMEDIES[1..].contains(&r.remedy());
            main && is_flip(r) && r.is_default()
        })
        .by(&[SCHEME])
        .columns(Column::levels([("b10", "B/10"), ("b20", "B/20"), ("b40", "B/40")], PRANDTL_ERROR, percent(1)))
        // Errors on splines with F̄ are too small to fall with an order.
        .column(Column::order_of(PRANDTL_ERROR, |r| r.basis() == Gimp).titled("order (between levels)")),
    ]
}

/// Half and twice the case's own rate beside it.
fn table_of_rates() -> ResultTable {
    let rates = [("4", 4e-3), ("2", 2e-3), ("1", 1e-3)];
    let rate = |r: &Record| Setup::<Footing>::number_of(r, |c| c.penetration_rate);
    let loads = rates.map(|(name, rate)| (rate, format!("{name}·10⁻³ m/s")));
    let imbalances = rates.map(|(name, rate)| (rate, format!("imbalance of forces at {name}")));
    ResultTable::of("footing-rates", |r| {
        let compared = [FbarRecursive, FbarConsistent];
        let own = r.is_default() || r.changes_only("penetration_rate");
        let main = r.basis() != Bspline3 && compared.contains(&r.remedy());
        own && main && is_flip(r) && r.level == "b10"
    })
    .by(&[("scheme, B/10", SCHEME.1)])
    .columns(Column::over(loads, rate, NC_B, fixed(3)))
    .columns(Column::over(imbalances, rate, FORCE_IMBALANCE, percent(1)))
}
