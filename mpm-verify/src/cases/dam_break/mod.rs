//! The dam break: water behind a gate that is removed at once, and the wall that it meets.
//!
//! Section 4.3 of Zhao, Jiang & Choo (2023).

mod checks;
mod figures;
mod flow;
pub(super) mod foreign;
mod run;

use crate::cases::prelude::*;
use crate::exact::dam_break::{DEPTH, GRAVITY, LENGTH, TANK};

const LEVELS: [(&str, f64); 4] = [("h0.5", 0.5), ("h0.25", 0.25), ("h0.125", 0.125), ("h0.0625", 0.0625)];
/// Runs over the levels take larger steps than the case's own.
const LADDER: &str = "cfl=0.3";
/// Until the front has met the wall.
const SHORT: &str = "cfl=0.3 duration=0.6";

choices! {
    pub(super) enum Rest { Exact = "exact", GravityStage = "gravity-stage" }
    pub(super) enum Contact { Separable = "separable", Sticky = "sticky" }
}

const CFL: Parameter = common::CFL.with_default("0.0567").named("cfl");
const PIC_RATE: Parameter = real("1/s", "0", 0.0, 1e6).named("pic_rate");

parameters! {
    pub(super) struct DamBreak {
        bulk_modulus: f64 = real("Pa", "2e9", 1e5, 1e12), "bulk modulus K";
        density: f64 = real("kg/m³", "997.5", 1e-3, 1e5), "density ρ without pressure";
        viscosity: f64 = real("Pa s", "0.001", 0.0, 1e6), "dynamic viscosity μ";
        duration: f64 = real("s", "2", 0.01, 10.0), "time after the removal of the gate";
        start: Rest = Rest::Exact.by_default(), "how the water comes to rest behind the gate: exactly, or by gravity that rises from zero, with damping";
        wall_contact: Contact = Contact::Separable.by_default(), "whether water comes off the walls freely or they bear tension; it slides freely along either";
        cfl: f64 = CFL, "largest CFL number c Δt / h of pressure waves; Δt is a whole fraction of 0.005 s, 10⁻⁵ s at h = 0.25 m";
        pic_rate: f64 = PIC_RATE, "share of PIC per unit of time, r: η = exp(−r Δt); 0 is FLIP";
        wall: common::Wall = common::WALL, "how B-splines meet floor and walls";
        ppc_per_direction: usize = whole("-", "5", 2, 8), "particles per cell and direction";
        seed: i32 = whole("-", "0", 0, 1000), "which member of an ensemble whose starts differ in last bits; 0 is the undisturbed one";
    }
}

metrics! { ALL:
    BASE_REACTION_RATIO = "base_reaction_ratio", "-",
        "force on the floor over the weight of the water, behind the gate: mean over three of the water's longest periods from the exact start, over 0.005 s after a gravity stage";
    GATE_FORCE = "gate_force", "N/m", "force on the gate, mean over the same time as base_reaction_ratio";
    BACK_FORCE = "back_force", "N/m", "force on the back wall, mean over the same time as base_reaction_ratio";
    BASE_PRESSURE = "base_pressure", "Pa",
        "pressure at the floor behind the gate, one step from the exact start or after the gravity stage, by a line through the particles of the lower half";
    PRESSURE_PROFILE_ERROR = "pressure_profile_error", "-", "rms over the particles of the pressure less the hydrostatic one, over that at the floor, then";
    START_KINETIC_ENERGY = "start_kinetic_energy", "J/m", "kinetic energy behind the gate when the forces have been measured";
    FRONT_X_EARLY = "front_x_0.4s", "m", "outermost particle and half its spacing, 0.4 s after the removal";
    FRONT_RMS_ERROR = "front_rms_error", "m", "rms distance of the front from the inviscid one, t √(g/H) from 0.2 to 0.9";
    FRONT_SPEED_MAX = "front_speed_max", "m/s", "largest speed of the front until it is two cells off the wall";
    ARRIVAL_TIME = "arrival_time", "s", "when the front is two cells off the wall";
    ARRIVAL_ERROR = "arrival_error", "s", "distance of that time from the inviscid one";
    BACK_LEVEL_EARLY = "back_level_0.4s", "m", "highest particle within a cell of the back wall and half its spacing, at 0.4 s";
    ENERGY_RATIO = "energy_ratio", "-", "kinetic and potential energy and stress work at 0.4 s over those at the start";
    ENERGY_RATIO_2S = "energy_ratio_2s", "-", "kinetic and potential energy and stress work at 2 s over those at the start";
    ENERGY_GAIN = "energy_gain", "-", "largest growth of that energy in 0.005 s, over its start";
    ENERGY_EXCESS = "energy_excess", "-", "largest excess of it over its start, relative";
    MOTION_RATIO_2S = "motion_ratio_2s", "-", "kinetic and potential energy at 2 s over those at the start";
    MOTION_EXCESS = "motion_excess", "-", "largest excess of kinetic and potential energy over their start, relative";
    MOTION_LOSS = "motion_loss", "-", "largest loss of them, over their start";
    PRESSURE_RMS = "pressure_rms", "Pa", "rms over the particles of the pressure at 0.4 s";
    CHECKERBOARD_RMS = "checkerboard_rms", "Pa", "rms over the particles of p − Πp at 0.4 s";
    TENSION_SHARE = "tension_share", "-", "share of the particles in tension at 0.4 s";
    COVERED_EARLY = "covered_0.4s", "m²", "area under the highest particles at 0.4 s, in strips two particles wide";
    CENTRE_X_EARLY = "centre_x_0.4s", "m", "centre of mass at 0.4 s";
    CENTRE_X_MEAN = "centre_x_mean", "m", "centre of mass, mean over 2 s";
    CENTRE_Y_MEAN = "centre_y_mean", "m", "height of the centre of mass, mean over 2 s";
    WALL_IMPULSE = "wall_impulse", "N s/m", "impulse on the front wall in 2 s";
    JACOBIAN_MIN = "jacobian_min", "-", "least J of a particle at any time";
    JACOBIAN_MAX = "jacobian_max", "-", "greatest J of a particle at any time";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at 0.4 s";
    MASS = "mass", "kg/m", "mass of the water at the end";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Dam>("dam-break", "Dam break", ALL)
        .planned(plan())
        .described("Water, nearly incompressible, 4 m × 2 m behind a gate that is removed at once; it runs along the floor of a \
            tank 6 m long and climbs the wall. The front is known from inviscid flow, energy may only be lost. \
            Standard MPM locks: it flows too slowly, with a pressure that is noise.")
        .references(crate::exact::dam_break::describe())
        .limit("Tension is allowed: water that is pulled apart holds together by cells.")
        .limit("After the front has met the wall single particles are chaotic; only sums over the water, compared over levels and ensembles, mean something.")
        .limit("There is no air and no surface tension: jets are not those of water.")
        .limit("Nothing damps sound: the pressure of fbar-consistent is noisier than that of fbar-recursive.")
        .wanted("front", "place of the front over time, and its arrival", "front arrival")
        .missed_by("locked makes-energy creeps")
        .wanted("pressure", "pressure behind the gate before the water flows", "pressure-profile")
        .missed_by("smoothed-start creeps")
        .checks(checks::checks())
        .headline(FRONT_X_EARLY, "front at 0.4 s (m)", 1.0, 3)
        .headline(FRONT_RMS_ERROR, "front, rms error (m)", 1.0, 3)
        .headline(ARRIVAL_ERROR, "arrival, error (ms)", 1e3, 1)
        .headline(ENERGY_RATIO, "energy at 0.4 s (–)", 1.0, 4)
        .headline(ENERGY_RATIO_2S, "energy at 2 s (–)", 1.0, 3)
        .headline(MOTION_RATIO_2S, "without stress work (–)", 1.0, 3)
        .headline(PRESSURE_RMS, "p rms at 0.4 s (kPa)", 1e-3, 1)
        .headline(CHECKERBOARD_RMS, "p − Πp rms (kPa)", 1e-3, 2)
        .headline(TENSION_SHARE, "in tension (%)", 100.0, 1)
        .headline(COVERED_EARLY, "covered at 0.4 s (m²)", 1.0, 2)
        .headline(WALL_IMPULSE, "wall impulse (kN s/m)", 1e-3, 2)
        .headline(LOG_JACOBIAN_GAP, "ln(J/J̄) at 0.4 s (–)", 1.0, 4)
        .quantity(error(FRONT_RMS_ERROR, "rms error of the front (m)"))
        .quantity(error(ARRIVAL_ERROR, "error of the arrival (s)"))
        .quantity(value(WALL_IMPULSE, "impulse on the wall (N s/m)"))
        .quantity(value(CENTRE_X_MEAN, "mean centre of mass (m)"))
        .sweep(Sweep::of(CFL, "CFL number (–)").logarithmic())
        .sweep(Sweep::of(PIC_RATE, "PIC share per unit of time (1/s)").logarithmic())
        .watched(&["front", "energy", "front_force", "pressure_rms"])
        .field(FieldView::at(0.3, ["pressure", "pressure after 0.3 s (Pa)"], (-1e5, 1e5), [(0.0, 5.0), (0.0, 2.0)]))
        .sketch(Sketch::block("Water four metres long and two metres deep stands between the left wall of a tank and a gate; the tank is six metres long, open above, its floor and walls smooth. The gate is removed at once.", [LENGTH, DEPTH])
            .held_along(&[[TANK, 0.0], [0.0, 0.0], [0.0, 3.0]])
            .held([TANK, 3.0], [TANK, 0.0])
            .length([0.0, -0.5], [LENGTH, -0.5], "4 m")
            .length([0.0, -1.0], [TANK, -1.0], "6 m")
            .length([-0.5, 0.0], [-0.5, DEPTH], "2 m")
            .note([0.5 * LENGTH, 0.5 * DEPTH], "water")
            .note([LENGTH + 0.4, DEPTH + 0.2], "gate"))
        .cost(|spec| remedy_cost(spec, [1.0, 1.4, 1.4, 1.4, 1.9]) / spec.level.h.powi(3))
        .ladder(&[LADDER])
        .pictures(figures::draw)
        .tables(tables())
        .breaks_down(checks::breaks_down)
}

fn plan() -> Plan {
    let flip = |remedies: &[RemedyName]| pairs(&SMOOTH, remedies);
    let none = RemedyName::None;
    let four = flip(&[none, FbarRecursive, FbarTotal, FbarConsistent]);
    let apic = four.iter().map(|s| Scheme::explicit(s.basis(), s.remedy(), TransferName::Apic)).collect();
    let mut all = [four.clone(), apic, flip(&[FbarRate])].concat();
    all.push(Scheme::flip(Bspline3, FbarConsistent));
    let ours = flip(&[FbarConsistent]);
    let finest = flip(&[FbarRecursive, FbarConsistent]);
    let three = flip(&[none, FbarRecursive, FbarConsistent]);
    let make_energy = pairs(&[Gimp], &[FbarTotal, FbarRate]);
    let rates = [0.1, 1.0, 10.0, 100.0].map(|rate| format!("pic_rate={rate}"));
    Plan::of(LEVELS.map(|(name, h)| Level { name, h }))
        .runs(Pr, "h0.5 h0.25", &three, SHORT)
        .runs(Pr, "h0.5", &make_energy, SHORT)
        .runs(Pr, "h0.5", &finest[..2], "duration=0.6")
        .runs(Nightly, "h0.5", &all, "")
        .runs(Nightly, "h0.25", &ours, "")
        .runs(Long, "h0.25", &all, "")
        .runs(Nightly, "h0.5 h0.25", &all, LADDER)
        .runs(Nightly, "h0.125", &four, LADDER)
        .runs(Nightly, "h0.5 h0.25 h0.125", &ours, "cfl=0.3 ppc_per_direction=3")
        .each(Nightly, "h0.25", &ours, ["cfl=0.15", "start=gravity-stage"])
        .each(Long, "h0.25", &ours, rates)
        .runs(Nightly, "h0.25", &ours, "wall_contact=sticky")
        .each(Long, "h0.25", &ours, ["seed=1", "seed=2", "seed=3"])
        .runs(Long, "h0.125 h0.0625", &all, LADDER)
}

const CHANGED: Label = ("changed", |r| r.set.join(", ").replace('_', " "));
/// Parameters of the runs whose state behind the gate is shown.
const AT_REST: [&str; 3] = ["", "start=gravity-stage", LADDER];

fn tables() -> Vec<ResultTable> {
    vec![
        overview(),
        ResultTable::of("dam-break-flow", |r| r.set == [LADDER])
            .by(&[SCHEME, CELLS])
            .metric("front at 0.4 s (m)", FRONT_X_EARLY, fixed(2))
            .metric("rms error (m)", FRONT_RMS_ERROR, fixed(2))
            .metric("arrival off by (ms)", ARRIVAL_ERROR, fixed(0).times(1e3))
            .metric("p rms (kPa)", PRESSURE_RMS, fixed(1).times(1e-3))
            .metric("p − Πp (kPa)", CHECKERBOARD_RMS, fixed(1).times(1e-3))
            .metric("in tension", TENSION_SHARE, share(0))
            .metric("K + P at 2 s", MOTION_RATIO_2S, fixed(3))
            .metric("with stress work", ENERGY_RATIO_2S, fixed(3))
            .text("J", |r| range(r, [JACOBIAN_MIN, JACOBIAN_MAX]))
            .cpu(),
        at_rest(),
        // Shares of PIC, walls, start, last bits: at h = 0.25 m.
        ResultTable::of("dam-break-studies", |r| {
            let ours = r.remedy() == FbarConsistent && SMOOTH.contains(&r.basis());
            let flow = r.set.iter().all(|set| !set.starts_with("cfl=") && !set.starts_with("duration="));
            ours && flow && is_flip(r) && r.level == "h0.25"
        })
        .by(&[SCHEME, CHANGED])
        .metric("front at 0.4 s (m)", FRONT_X_EARLY, fixed(3))
        .metric("rms error (m)", FRONT_RMS_ERROR, fixed(3))
        .metric("K + P at 2 s", MOTION_RATIO_2S, fixed(3))
        .metric("p − Πp (kPa)", CHECKERBOARD_RMS, fixed(1).times(1e-3))
        .metric("impulse on the wall (kN s/m)", WALL_IMPULSE, fixed(2).times(1e-3)),
        ResultTable::of("dam-break-sums", |r| {
            let shown = !r.is_default() || r.remedy() == FbarConsistent;
            let short = [SHORT, "duration=0.6"].contains(&&*r.set.join(" "));
            r.status == Status::Ok && shown && !short
        })
        .by(&[SCHEME, CELLS, CHANGED])
        .metric("impulse on the wall (kN s/m)", WALL_IMPULSE, fixed(2).times(1e-3))
        .metric("mean x (m)", CENTRE_X_MEAN, fixed(3))
        .metric("mean y (m)", CENTRE_Y_MEAN, fixed(3))
        .metric("K + P at 2 s", MOTION_RATIO_2S, fixed(3)),
    ]
}

/// The front's error, and the kinetic and potential energy that is left.
fn overview() -> ResultTable {
    const RUNS: [(RemedyName, &str); 6] = [
        (RemedyName::None, "h0.125"),
        (FbarRecursive, "h0.125"),
        (FbarConsistent, "h0.5"),
        (FbarConsistent, "h0.25"),
        (FbarConsistent, "h0.125"),
        (FbarConsistent, "h0.0625"),
    ];
    let text = |r: &Record| {
        let front = fixed(2).unit(" m").text(r.metric(FRONT_RMS_ERROR));
        format!("{front}, {}", share(0).text(r.metric(MOTION_RATIO_2S)))
    };
    let column = |(remedy, level): (RemedyName, &'static str)| {
        Column::text(format!("{remedy}, {} m", &level[1..]), text).of(move |r| r.remedy() == remedy && r.level == level)
    };
    ResultTable::of("dam-break", |r| SMOOTH.contains(&r.basis()) && is_flip(r) && r.set == [LADDER])
        .by(&[BASIS])
        .columns(RUNS.map(column))
}

fn at_rest() -> ResultTable {
    const START: Label = ("start", |r| word(r, "start", "exact").replace('-', " "));
    const NUMBER: Label = ("CFL", |r| word(r, "cfl", "0.0567"));
    /// ρ g H (Pa); on the gate ½ H times that.
    fn pressure(r: &Record) -> f64 {
        Setup::<DamBreak>::number_of(r, |d| d.density) * GRAVITY * DEPTH
    }
    let gate = |r: &Record| r.metric(GATE_FORCE) / (0.5 * DEPTH * pressure(r)) - 1.0;
    let floor = |r: &Record| r.metric(BASE_PRESSURE) / pressure(r) - 1.0;
    let force = |r: &Record| r.metric(BASE_REACTION_RATIO) - 1.0;
    ResultTable::of("dam-break-start", |r| {
        r.status == Status::Ok && is_flip(r) && AT_REST.iter().any(|set| r.changes(set))
    })
    .by(&[SCHEME, CELLS, START, NUMBER])
    .value("force on the floor", force, percent(2))
    .value("on the gate", gate, percent(2))
    .value("pressure at the floor", floor, percent(2))
    .metric("profile rms", PRESSURE_PROFILE_ERROR, percent(2))
}
