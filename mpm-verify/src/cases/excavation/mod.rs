//! A slope whose toe is cut away: the geotechnical case of the implicit paper.
//!
//! Section 3.3 of Wang, Vardon, Hicks & Chen (2016).

mod run;
mod scene;

use crate::cases::prelude::*;
use RuleName::{Midpoint, Newmark, QuasiStatic};
use scene::{Ground, HEIGHT};

const LEVELS: [Level; 3] = [Level::new("h0.1", 0.1), Level::new("h0.05", 0.05), Level::new("h0.025", 0.025)];
/// Newton's tolerance times the root of the number of nodes that its norm is of.
const EQUILIBRIUM: f64 = 1e-8;
/// Newton's tolerance times the number of steps and the forces that swing over those that drive.
const BALANCED: f64 = 1e-6;
/// Excess of arcs over the collapse load: the gap to finite-element limit analysis.
const ARCS: f64 = 0.012;
/// Run-outs of two levels that differ by less are the same.
const SAME: f64 = 0.01;

choices! {
    enum Base { Rough = "rough", Frictional = "friction" }
    enum Raising { Ramp = "ramp", Step = "step" }
    enum LawName { Hencky = "hencky-j2", Jaumann = "jaumann-j2" }
}

parameters! {
    struct Excavation {
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("2e5").within(number(1e3, 1e9, false));
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.33");
        peak: f64 = real("Pa", "5e3", 1.0, 1e9), "peak of the strength c in plane-strain shear; κ = √2 c";
        residual: f64 = real("Pa", "1e3", 1.0, 1e9), "residual strength c, at most the peak; the peak: no softening";
        softening: f64 = real("Pa", "5e4", 1.0, 9e4).below(), "−H = −dc/dε of the equivalent plastic strain";
        unit_weight: f64 = real("N/m³", "2e4", 1.0, 1e6), "unit weight γ";
        crest: f64 = real("m", "1.5", 1.0, 10.0), "length of the crest, up to the rollers";
        cut: f64 = real("m", "0.2", 0.0, 0.9), "height of the vertical cut at the toe";
        base: Base = Base::Rough.by_default(), "rough: the nodes of the base are held; friction: Coulomb's law beneath the particles";
        friction: f64 = real("-", "0.5", 0.0, 10.0), "base=friction: the coefficient μ";
        gravity: Raising = Raising::Ramp.by_default(), "ramp: in load_steps equal steps, each cut into parts if it has to; step: at once, and never cut";
        load_steps: i32 = whole("-", "20", 1, 1000), "gravity=ramp: steps";
        law: LawName = LawName::Hencky.by_default(), "hyperelastic, or the paper's small strains in rate form";
        cfl: f64 = real("-", "2", 0.01, 1000.0), "after the excavation: CFL number c Δt / h of pressure waves";
        duration: f64 = real("s", "3", 0.01, 60.0), "time after the excavation";
        ghost: f64 = common::GHOST;
        // By β the eigenvalues of M_l⁻¹ M_β lie within β and 1: 500 iterations of conjugate gradients, which are all that a mass
        // gets, come to 10⁻¹⁰ for certain if β ≥ (ln(2·10¹⁰)/1000)² = 0.0006. Ground that flows has nodes that are nearly empty.
        lumped: f64 = common::LUMPED.within(number(1e-3, 1.0, false));
        alpha: f64 = common::ALPHA;
        delta: f64 = common::DELTA;
        tolerance: f64 = common::TOLERANCE;
        wall: common::Wall = common::WALL;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
    }
}

metrics! { ALL:
    FACTOR_UNCUT = "factor_uncut", "-", "factor of safety of the whole slope at the peak strength, by limit analysis: an upper bound";
    FACTOR_CUT = "factor_cut", "-", "factor of safety of the slope with its toe cut away, at the peak strength, by limit analysis: an upper bound";
    FACTOR_CUT_RESIDUAL = "factor_cut_residual", "-", "factor of safety of the cut slope at the residual strength, by limit analysis: an upper bound";
    GRAVITY_CARRIED = "gravity_carried", "-", "share of gravity under which the whole slope has its last equilibrium";
    STANDS_UNCUT = "stands_uncut", "-",
        "1 if the whole slope comes to rest under full gravity and no particle moves by a tenth of the height in the last phase; 0 if one does; none where it still moves";
    STANDS_CUT = "stands_cut", "-", "1 if the cut slope, quasi-static or moving, comes to rest by the criterion of the whole one; 0 if not; none if it fails uncut";
    FORCE_RATIO_UNCUT = "force_ratio_uncut", "-", "the paper's out-of-balance ratio, Eq. (37), of the equilibrium before the excavation";
    ENERGY_RATIO_UNCUT = "energy_ratio_uncut", "-", "in the place of its ratio of energies, Eq. (38), the residual's work on Newton's last correction over that of the load";
    REACTION_ERROR = "reaction_error", "-", "the base's vertical reaction to the whole slope over its weight, less one";
    SIDE_ERROR = "side_error", "-", "sum of the horizontal reactions of base and rollers to the whole slope, over the weight";
    FRICTION_RATIO = "friction_ratio", "-", "base=friction: largest ratio of the base's tangential reaction to its normal one, over all rows";
    PLASTIC_STRAIN_UNCUT = "plastic_strain_uncut", "-", "largest equivalent plastic strain before the excavation";
    PLASTIC_STRAIN_END = "plastic_strain_end", "-", "largest equivalent plastic strain at the end";
    SOFTENED_END = "softened_end", "m²", "area whose strength is residual at the end";
    BAND_WIDTH = "band_width", "m", "that area over the length of the arc of limit analysis";
    HANDED_OVER = "handed_over", "-", "largest change of a stress from one phase to the next, of what stays, over γH: none";
    FLOW_LEAST = "flow_least", "-", "least change of a particle's plastic strain from row to row: none is negative";
    YIELD_EXCESS = "yield_excess", "-", "hencky-j2: largest ‖J dev σ‖ of a particle over the strength √2 c that its plastic strain leaves it, less one, of all rows";
    MOVED_CUT = "moved_cut", "m", "largest displacement of a particle since the last phase began";
    RUNOUT_END = "runout_end", "m", "distance of the farthest particle's edge, at the end, from the foot of the cut face";
    CREST_DROP = "crest_drop", "m", "largest settlement of the crest since the last phase began";
    KINETIC_PEAK = "kinetic_peak", "J/m", "largest kinetic energy in the last phase";
    KINETIC_END = "kinetic_end", "-", "kinetic energy at the end over the work of the load since the last phase began: Eq. (38)";
    DISSIPATED = "dissipated", "J/m", "what flow has dissipated since the last phase began";
    LOAD_WORK = "load_work", "J/m", "work of gravity, and of a base with friction, since the last phase began";
    BALANCE_ERROR = "balance_error", "-",
        "midpoint: kinetic energy and work of the stresses since the last phase began, with what the lumped mass and the ghost penalty took, less the work of the load, over the larger of it and the stored energy: largest";
    MOMENTUM_ERROR = "momentum_error", "-", "vertical momentum in the last phase, with the impulse that the base took, less that of the weight, over it: largest";
    ENERGY_GAIN = "energy_gain", "-", "kinetic, stored and dissipated energy since the last phase began less the work of the load, over the larger of it and the stored energy: largest";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MASS = "mass", "kg/m", "mass of the whole slope";
}

pub(super) fn case() -> Case {
    Case::of::<2, Ground>("excavation", "Slope whose toe is cut away", ALL)
        .planned(plan())
        .breaks_down(|r| {
            let slope = Setup::<Excavation>::of_record(r).ok()?;
            (slope.unit_weight * HEIGHT > SPLASHING * slope.peak).then_some("ground of tens of times its strength splashes off the grid")
        })
        .described("A slope of clay that softens stands under its weight; a wedge at its toe is taken away at once. The geotechnical case \
            of the implicit paper. By limit analysis it stands at the peak strength, whole and cut, and at the residual \
            strength it can't: what fails is progressive, and depends on the cells.")
        .reference("Limit analysis (docs/exact.md): arcs, γH/c = 6.078 whole and 5.537 cut, at most 1.2 % above finite-element bounds; a foot that slides")
        .reference("Equilibrium, momentum and energy.")
        .limit("Softening without a length: shear bands are as wide as the cells allow, and the run-out differs from level to level.")
        .limit("The paper gives neither the friction of its base nor the length of its crest.")
        .limit("Local damping, by which the paper comes to rest, is refused in implicit steps; static steps take its place.")
        .wanted("stability", "whether the slope stands, whole and cut", "stands-below-the-limit falls-above-the-limit")
        .checks(checks())
        .headline(FACTOR_UNCUT, "factor, whole (–)", 1.0, 3)
        .headline(FACTOR_CUT, "cut (–)", 1.0, 3)
        .headline(GRAVITY_CARRIED, "gravity carried (–)", 1.0, 3)
        .headline(STANDS_UNCUT, "stands whole", 1.0, 0)
        .headline(STANDS_CUT, "cut", 1.0, 0)
        .headline(RUNOUT_END, "run-out (m)", 1.0, 3)
        .headline(CREST_DROP, "crest sinks (m)", 1.0, 3)
        .headline(BAND_WIDTH, "band (m)", 1.0, 3)
        .headline(KINETIC_END, "E_kin at the end (%)", 100.0, 2)
        .headline(FORCE_RATIO_UNCUT, "(37) before the cut (10⁻¹²)", 1e12, 1)
        .headline(BALANCE_ERROR, "energy off by (%)", 100.0, 2)
        .watched(&["moved", "front"])
        .sketch(Sketch::of(
            "A slope of clay one metre high with a face at 45° and a crest of 1.5 m, up to rollers that let it \
             move up and down. The wedge of the lowest 0.2 m at its toe is taken away.",
        )
        .body([[0.0, 0.0], [2.3, 0.0], [2.3, 0.2], [1.5, 1.0], [0.0, 1.0]])
        .body([[2.3, 0.0], [2.5, 0.0], [2.3, 0.2]])
        .held_along(&[[3.5, 0.0], [0.0, 0.0], [0.0, 1.0]])
        .length([0.0, 1.12], [1.5, 1.12], "1.5 m")
        .length([1.5, 1.12], [2.5, 1.12], "1 m")
        .length([-0.12, 0.0], [-0.12, 1.0], "1 m")
        .note([0.9, 0.5], "clay")
        .note([2.85, 0.2], "taken away"))
        // That of the steps and of a factorisation.
        .cost(|spec| if spec.scheme.rule() == Some(QuasiStatic) { 0.2 } else { 2.0 } * (0.1 / spec.level.h).powi(3))
        .pictures(pictures)
        .tables(tables())
}

fn plan() -> Plan {
    const SLIPPERY: &str = "base=friction friction=0.05";
    const SLIPPERY_PERFECT: &str = "base=friction friction=0.05 residual=5e3";
    /// Ground that does not yield under its weight alone.
    const LATERAL: &str = "poisson_ratio=0.45";
    let none = [RemedyName::None];
    let moving = implicit(&[Midpoint, Newmark], &[Gimp], &none);
    let midpoint = &moving[..1];
    let resting = implicit(&[QuasiStatic], &[Gimp, Bspline2], &none);
    let means = &resting[..1];
    let bilinear = implicit(&[Midpoint, Newmark, QuasiStatic], &[Linear], &none);
    let two = "h0.1 h0.05";
    let three = "h0.1 h0.05 h0.025";
    Plan::of(LEVELS)
        .runs(Pr, "h0.1", midpoint, "")
        .runs(Quick, "h0.1", means, "")
        .runs(Pr, "h0.1", &moving[1..], "duration=0.5")
        .each(Pr, "h0.1", midpoint, ["duration=0.5 residual=5e3", "base=friction duration=0.25"])
        .each(Pr, "h0.1", means, ["residual=5e3", "peak=1e3 residual=1e3 gravity=step", SLIPPERY_PERFECT])
        .runs(Nightly, two, &moving, "")
        .each(Nightly, three, &resting, ["", "gravity=step"])
        .runs(Nightly, two, &resting, "residual=5e3")
        // The paper's bilinear elements.
        .runs(Nightly, two, &bilinear, "")
        .runs(Long, "h0.025", &bilinear, "")
        .each(Nightly, "h0.1", midpoint, ["residual=5e3", "gravity=step", "base=friction", LATERAL, "law=jaumann-j2"])
        .each(Long, "h0.05", midpoint, ["residual=5e3", "gravity=step", "base=friction", LATERAL, "law=jaumann-j2"])
        .runs(Long, "h0.05", &moving[1..], "base=friction")
        .each(Nightly, three, means, ["base=friction", LATERAL])
        .each(Nightly, "h0.1", means, ["peak=1e3 residual=1e3 load_steps=4", SLIPPERY])
        .runs(Nightly, "h0.05", means, SLIPPERY_PERFECT)
        .each(Nightly, "h0.1", midpoint, ["ghost=0.01", "cfl=1"])
        .runs(Long, "h0.025", &moving, "")
        .each(Nightly, two, means, [0.1, 0.2, 0.3, 1.0].map(|f| format!("base=friction friction={f}")))
}

/// Factors of limit analysis, each with whether the slope stands.
const LIMITS: [(Metric, Metric); 2] = [(FACTOR_UNCUT, STANDS_UNCUT), (FACTOR_CUT, STANDS_CUT)];

fn checks() -> Vec<Check> {
    type Check = CheckOf<Excavation>;
    type Demand = crate::demand::Demand<Excavation>;
    vec![
        Check::truth("reaction", "equilibrium before the excavation: vertical reaction of the base equal to the weight, horizontal forces of base and rollers balanced")
            // The whole slope has an equilibrium under full gravity.
            .when(|c| c.metric(GRAVITY_CARRIED) > 1.0 - 1e-9 && c.metric(STANDS_UNCUT) == 1.0)
            .at_most(REACTION_ERROR, |_| EQUILIBRIUM)
            .at_most(SIDE_ERROR, |_| EQUILIBRIUM)
            .because("equilibrium, to Newton's tolerance"),
        Check::truth("taken-over", "stress of the remaining particles unchanged from phase to phase, bit for bit: the ground is at rest when cut")
            .when(|c| !c.metric(HANDED_OVER).is_nan())
            .at_most(HANDED_OVER, |_| 0.0)
            .because("a phase begins as the one before it ended"),
        Check::truth("stands-below-the-limit", "no softening, rough base, factor of safety above one by more than arcs exceed the collapse load: the slope stands, whole and cut")
            .when(|c| !c.softens() && !c.slides())
            .each(LIMITS.map(|(factor, stands)| {
                Demand::within(stands, |_| 1.0, |_| 0.0).when(move |c| c.metric(factor) > 1.0 + ARCS)
            }))
            .because("finite-element limit analysis: docs/excavation.md"),
        Check::truth("falls-above-the-limit", "a slope with a factor of safety below one at the peak strength does not stand, whole or cut")
            .each(LIMITS.map(|(factor, stands)| {
                Demand::within(stands, |_| 0.0, |_| 0.0)
                    .when(move |c| c.metric(factor) < 1.0 && !c.metric(stands).is_nan())
            }))
            .because("arcs and sliding feet are upper bounds: docs/excavation.md"),
        Check::truth("balance", "midpoint: kinetic energy, stress work and losses by lumped mass and ghost penalty add up to the work of the load")
            .when(moves_by_midpoint)
            .at_most(BALANCE_ERROR, |_| BALANCED)
            .because("Eq. (21) of docs/implicit.md, to Newton's tolerance"),
        Check::truth("no-energy-gain", "midpoint, hencky-j2: kinetic, stored and dissipated energy exceed the work of the load by at most 10⁻⁴ of it")
            .when(|c| c.law == LawName::Hencky && moves_by_midpoint(c))
            .at_most(ENERGY_GAIN, |_| NO_GAIN)
            .because("the rule gives none, flow takes: docs/implicit.md"),
        Check::truth("momentum", "midpoint, base=friction: vertical momentum equal to the impulse of the weight less that of the base")
            .when(|c| c.slides() && moves_by_midpoint(c))
            .at_most(MOMENTUM_ERROR, |_| ROUNDING)
            .because("internal forces sum to zero, as the functions sum to one"),
        Check::truth("flow", "plastic strain of every particle never falls")
            .above(FLOW_LEAST, |_| -f64::EPSILON)
            .because("flow dissipates"),
        Check::truth("yield", "hencky-j2: no particle bears more than the strength that its own plastic strain leaves, to rounding")
            .when(|c| !c.metric(YIELD_EXCESS).is_nan())
            .at_most(YIELD_EXCESS, |_| ROUNDING)
            .because("von Mises at the end of the step: what flow does there is what the strength dissipates"),
        Check::truth("coulomb", "base=friction: friction of the base at most μ times its pressure")
            .when(|c| c.slides())
            .at_most(FRICTION_RATIO, |c| c.friction * (1.0 + ROUNDING))
            .because("Coulomb's law, which holds of every particle"),
        Check::truth("peak-does-not-fail", "rough base: the cut slope stands at the peak strength without softening, and does not with it")
            .when(|c| c.record.status == Status::Ok && c.record.changes_none_but(&["residual"]) && !c.softens())
            .pairs(
                |perfect, own| {
                    let alike = own.record.status == Status::Ok && own.is_default() && own.scheme == perfect.scheme && own.level == perfect.level;
                    alike && !own.is_static() && !(own.metric(STANDS_CUT) + perfect.metric(STANDS_CUT)).is_nan()
                },
                |_, _| STANDS_CUT.name.to_owned(),
                |perfect, own| perfect.metric(STANDS_CUT) - own.metric(STANDS_CUT),
            )
            .within(|_| 1.0, |_| 0.0)
            .because_of(|c| format!("{} {}", c.scheme, c.level)),
        Check::known_limit("run-out-by-level", "rough base, softening: run-outs of two levels differ by more than a hundredth, as softening has no length scale")
            .study(differs_by_level),
    ]
}

/// Whether a run moved, after the excavation, by the midpoint rule.
fn moves_by_midpoint(run: &Run<Excavation>) -> bool {
    run.rule() == Some(Midpoint) && !run.metric(KINETIC_PEAK).is_nan()
}

/// Run-outs of all pairs of levels of a scheme.
fn differs_by_level(records: &[Record]) -> Vec<Finding> {
    let own = |r: &Run<Excavation>| r.record.status == Status::Ok && r.is_default() && moves_by_midpoint(r);
    let own: Vec<Run<Excavation>> = Run::all(records).filter(own).collect();
    let pairs = own.iter().enumerate().flat_map(|(k, coarse)| own[k + 1..].iter().map(move |fine| (coarse, fine)));
    let alike = pairs.filter(|(coarse, fine)| coarse.scheme == fine.scheme && coarse.level != fine.level);
    alike
        .map(|(coarse, fine)| {
            let ratio = coarse.metric(RUNOUT_END) / fine.metric(RUNOUT_END);
            let levels = format!("{}: {} against {}", coarse.scheme, coarse.level, fine.level);
            Finding::above(RUNOUT_END, (ratio - 1.0).abs(), SAME, levels)
        })
        .collect()
}

/// Whether a slope stands, in words.
fn stands(r: &Record) -> String {
    let carried = r.metric(GRAVITY_CARRIED);
    match [STANDS_UNCUT, STANDS_CUT].map(|metric| r.metric(metric)) {
        [0.0, _] if carried == 0.0 => "not in one step".to_owned(),
        [uncut, _] if uncut != 1.0 && carried < 1.0 => format!("up to {carried:.3} γ"),
        [0.0, _] => "falls whole".to_owned(),
        [1.0, 1.0] => "stands whole and cut".to_owned(),
        [1.0, 0.0] => "stands whole, falls cut".to_owned(),
        _ => "not told".to_owned(),
    }
}

fn tables() -> Vec<ResultTable> {
    let is_static = |r: &Record| r.scheme().rule() == Some(QuasiStatic);
    let columns = [("h0.1", "h = 0.1 m"), ("h0.05", "0.05 m"), ("h0.025", "0.025 m")]
        .map(|(level, title)| Column::text(title, stands).at(level));
    vec![
        // Which slope has an equilibrium.
        ResultTable::new("excavation-equilibria", is_static, &[SCHEME, CHANGED], columns),
        ResultTable::of("excavation-collapses", move |r| !is_static(r))
            .by(&[SCHEME, CHANGED, CELLS])
            .text("stands", stands)
            .metric("run-out (m)", RUNOUT_END, fixed(3))
            .metric("crest sinks (m)", CREST_DROP, fixed(3))
            .metric("band (m)", BAND_WIDTH, fixed(3))
            .metric("E_kin at the end", KINETIC_END, share(2))
            .cpu(),
        // Errors of what is conserved.
        ResultTable::of("excavation-balances", move |r| !is_static(r) && r.level == "h0.05")
            .by(&[SCHEME, CHANGED])
            .metric("(37) before the cut", FORCE_RATIO_UNCUT, SHORT)
            .metric("reaction off by", REACTION_ERROR, SHORT)
            .metric("energy off by", BALANCE_ERROR, SHORT)
            .metric("gained", ENERGY_GAIN, SHORT)
            .metric("momentum off by", MOMENTUM_ERROR, SHORT),
    ]
}

/// Plastic strain of the finest run of the midpoint rule with the default parameters, beside Figure 9 of the paper.
fn pictures(gallery: &mut Gallery) -> Result<(), Error> {
    /// Upper end of the scale of the plastic strain: strength is residual from 0.08 on.
    const STRAIN: f64 = 1.0;
    /// Times after the excavation (s).
    const TIMES: [f64; 2] = [0.5, 1.0];
    /// Length of the plane shown beyond the foot of the cut (m).
    const BEYOND: f64 = 3.5;
    let own = |r: &&Record| r.scheme().rule() == Some(Midpoint) && r.is_default() && r.status == Status::Ok;
    let runs = gallery.records.iter().filter(own);
    let finest = runs.min_by(|a, b| a.discretisation.h.total_cmp(&b.discretisation.h));
    let Some(record) = finest else { return Ok(()) };
    let slope = Setup::<Excavation>::of_record(record)?;
    let (crest, cut, foot) = (slope.crest, slope.cut, slope.foot());
    let mut tables = Vec::new();
    for time in TIMES {
        let kept = gallery.snapshot(record, time)?;
        tables.extend(kept.map(|table| (format!("{time} s after the excavation"), table)));
    }
    tables.push(("at the end".to_owned(), gallery.table(record, "particles.csv")?));
    let panel = |(title, table): (String, Table)| FieldPanel {
        outline: vec![(0.0, 0.0), (foot, 0.0), (foot, cut), (crest, HEIGHT), (0.0, HEIGHT)],
        ..field_panel(record, &table, title, "plastic_strain")
    };
    Fields::new(tables.into_iter().map(panel).collect(), "equivalent plastic strain (–)", (0.0, STRAIN))
        .columns(1)
        .within(((0.0, foot + BEYOND), (-0.05, 1.1 * HEIGHT)))
        .draw(gallery, "plastic-strain", "Equivalent plastic strain after the toe was taken away; the paper's Figure 9. The outline is that of the cut slope.")
}
