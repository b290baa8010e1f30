//! Load steps far too large, a softening body, a floor that is hardly touched: the implicit solver finds the exact
//! equilibrium, or reports that it finds none.

mod run;

use crate::cases::prelude::*;

/// The tolerance of Newton's method, with a share for rounding.
const CONVERGED: f64 = 1e-7;
/// Relative excess of the load that a column of cells may bear over that of the exact column.
const STIFFER: f64 = 0.02;
/// Least error of an equilibrium of moved particles, in bounds.
const MOVED: f64 = 3.0;
/// Largest load, over the greatest, that any number of steps must carry; the stretch is 1.48 at most.
const STEADY: f64 = 0.7;
/// Share of the load that is all of it, to rounding of the steps' sum.
const WHOLE: f64 = 1.0 - 1e-9;

choices! {
    enum Support { Hangs = "hangs", Stands = "stands" }
}

parameters! {
    struct Newton {
        support: Support = Support::Hangs.by_default(), "the column hangs from its upper end and softens, or stands on a barrier";
        load: f64 = real("-", "0.7", 0.01, 100.0), "weight of the column over the greatest that it bears hanging, M/e of its area";
        load_steps: i32 = common::LOAD_STEPS.with_default("1");
        gap: f64 = real("-", "0.9", 0.01, 3.0), "standing: gap of the lowest particles at the start over the distance at which the barrier begins";
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        yield_strain: f64 = real("-", "0", 0.0, 1.0), "standing: logarithmic strain of uniaxial strain at which the column yields by J2, without hardening; 0: never";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
    }
}

metrics! { ALL:
    CARRIED = "carried", "-", "share of the load at the last equilibrium that was found";
    BEARABLE = "bearable", "-", "share of the load up to which there is one";
    EQUILIBRIUM_ERROR = "equilibrium_error", "-", "rms error of the displacements at the last equilibrium over the height; none if there was none";
    BOUND = "equilibrium_bound", "-", "bound of it: what cells of this size leave";
    REACTION_ERROR = "reaction_error", "-", "force on the floor, or on what holds the upper end, over the weight that is carried, less one";
    GAP_ERROR = "gap_error", "-", "standing: mean gap of the lowest particles less the exact one, over the distance at which the barrier begins";
    FLOW_ERROR = "flow_error", "-", "yielding, more than a cell deeper than the exact column yields: largest error of J (σ_xx − σ_yy) and J (σ_zz − σ_yy), over what flow leaves of them";
    NEWTON_RATE = "newton_rate", "-", "largest over the steps of the least contraction of the residual in an iteration, over √(τ/r) from a residual r to the tolerance τ";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps that were taken";
    PARTS = "parts", "-", "most parts that a load step was cut into";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Loaded>("newton", "Load steps that are far too large", ALL)
        .planned(plan())
        .described("A column under its own weight, which softens where it hangs and touches a barrier where it stands, in a thousand \
            load steps or in one: the implicit solver finds the exact equilibrium, cuts the step, or says that it finds none.")
        .reference("Exact: uniaxial strain of a Hencky body under its own weight, elastic or yielding, src/cases/newton/exact.rs.")
        .limit("Uniaxial strain, one law, no stabilisation of cut cells.")
        .wanted("equilibrium", "last equilibrium that was found", "never-wrong no-more-than-there-is any-steps")
        .missed_by("moved-quadrature few-particles")
        .checks(checks())
        .headline(CARRIED, "load carried (%)", 100.0, 1)
        .headline(BEARABLE, "that there is (%)", 100.0, 1)
        .headline(EQUILIBRIUM_ERROR, "error (–)", 1.0, 5)
        .headline(BOUND, "bound (–)", 1.0, 5)
        .headline(NEWTON_ITERATIONS, "iterations", 1.0, 0)
        .headline(PARTS, "most parts of a step", 1.0, 0)
        .watched(&["equilibrium_error", "newton_iterations"])
        .sketch(sketch())
        .cost(|_| 0.05)
        .tables(tables())
}

fn plan() -> Plan {
    let all = implicit(&[RuleName::QuasiStatic], &[Gimp, Linear, Bspline2], &[RemedyName::None, FbarConsistent]);
    let smooth: Vec<Scheme> = all.iter().copied().filter(|s| s.basis() != Linear).collect();
    // Loads in one step, and standing columns: iterations that rounding hardly changes.
    let sure = ["load=0.97", "support=stands", "load=2 support=stands", "load=2 poisson_ratio=0.4999 support=stands"];
    // Numbers of load steps, loads beyond the greatest, a floor that is not touched: steps that are cut.
    let cut = [
        "load_steps=10",
        "load=0.97 load_steps=10",
        "load=1.1",
        "load=1.1 load_steps=10",
        "load=10",
        "load_steps=10 support=stands",
        "gap=1 support=stands",
        "gap=1.5 support=stands",
    ];
    let small = [
        "load_steps=100",
        "load_steps=1000",
        "load=1.1 load_steps=100",
        "load_steps=100 support=stands",
        "load_steps=1000 support=stands",
        "load=20 support=stands",
        "gap=0.99 support=stands",
    ];
    Plan::of(levels(1.0, [("n8", 8.0), ("n16", 16.0)]))
        .runs(Quick, "n8", &all[..1], "")
        .runs(Pr, "n8", &all, "")
        .each(Pr, "n8", &all, sure)
        .runs(Pr, "n8", &all[..1], "support=stands yield_strain=0.05")
        .each(Pr, "n8", &all[4..], [cut[0], cut[2], cut[5]])
        .each(Nightly, "n8 n16", &all, cut)
        .each(Nightly, "n8", &all, small)
        .each(Nightly, "n8", &smooth, ["load_steps=100 ppc_per_direction=3", "load_steps=1000 ppc_per_direction=3"])
        .runs(Nightly, "n16", &all, "")
        .each(Nightly, "n16", &all, sure)
}

fn sketch() -> Sketch {
    let column = |x: f64| [[x, 0.0], [x + 0.25, 0.0], [x + 0.25, 1.0], [x, 1.0]];
    Sketch::of("A column of 1 m that hangs under its weight, and one that stands on a floor; rollers at the sides.")
        .body(column(0.0))
        .load([0.125, 0.6], [0.125, 0.35])
        .held([0.0, 1.0], [0.25, 1.0])
        .body(column(0.6))
        .load([0.6 + 0.125, 0.6], [0.6 + 0.125, 0.35])
        .held([0.5, -0.03], [0.95, -0.03])
        .length([-0.1, 0.0], [-0.1, 1.0], "1 m")
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Newton>;
    // The load came in one step that was not cut, on functions that have not moved.
    let is_whole = |c: &Run<Newton>| c.load_steps == 1 && c.metric(PARTS) == 1.0;
    // A hanging column carries a moderate load in several steps, on smooth functions.
    let is_steady = move |c: &Run<Newton>| !c.stands() && !is_whole(c) && c.load <= STEADY && c.basis() != Linear;
    let vanishes = |check: Check, metric: Metric| {
        check.when(move |c| c.has(metric)).within(metric, |_| 0.0, |_| CONVERGED).of_scale(|_| 1.0)
    };
    vec![
        Check::truth("never-wrong", "a single uncut step, or standing without a remedy, except linear functions: last equilibrium exact within h² times the greatest slope of the stretch")
            .when(move |c| {
                let smooth = c.basis() != Linear && c.remedy() == RemedyName::None;
                (is_whole(c) || c.stands() && smooth) && c.has(EQUILIBRIUM_ERROR)
            })
            .at_most(EQUILIBRIUM_ERROR, |c| c.metric(BOUND))
            .because("there is one below the greatest load that the law goes on from; another is far away"),
        Check::truth("no-more-than-there-is", "hanging beyond the bearable load: no equilibrium beyond that load, within a fiftieth for the cells")
            .when(|c| c.metric(BEARABLE) < 1.0)
            .at_most(CARRIED, |c| c.metric(BEARABLE) * (1.0 + STIFFER))
            .because("ln λ/λ is at most 1/e"),
        Check::truth("any-steps", "hanging, at most 0.7 of the greatest load, GIMP and splines: any number of steps carries the whole load")
            .when(is_steady)
            .within(CARRIED, |_| 1.0, |_| 1.0 - WHOLE)
            .of_scale(|_| 1.0)
            .because("there is an equilibrium at every step, and its law is stable"),
        Check::known_limit("few-particles", "hanging, several steps, F̄ on splines, two particles a cell and direction: a part of the load is carried, as stretched cells are left with fewer")
            .when(move |c| is_steady(c) && c.basis() == Bspline2 && c.remedy() != RemedyName::None)
            .when(|c| c.ppc_per_direction < 3 && c.metric(CARRIED) < WHOLE)
            .at_most(CARRIED, |_| WHOLE)
            .because("three leave two in a cell: docs/newton.md"),
        vanishes(Check::truth("weight", "reaction on the column equal to its weight within Newton's residual"), REACTION_ERROR)
            .because("equilibrium of the whole body"),
        vanishes(Check::truth("gap", "standing: gap of the lowest particles that at which the barrier carries the weight, within Newton's residual"), GAP_ERROR)
            .because("every column of particles is alike, and the barrier's force has one gap"),
        vanishes(Check::truth("flow", "standing, yielding: where the exact column flows, vertical and both lateral stresses differ by √(3/2) κ, to what Newton's method leaves"), FLOW_ERROR)
            .because("uniaxial strain: the deviator's direction is fixed, and its norm, of all three components, is κ"),
        quadratic(NEWTON_RATE, |_| 1.0)
            .when(move |c: &Run<Newton>| is_whole(c) && c.remedy() == RemedyName::None)
            .because("the exact tangent, of one kind of motion: docs/newton.md"),
        Check::known_limit("moved-quadrature", "linear functions, hanging, more than one part: equilibrium of the moved particles, off by more than three times the bound of never-wrong")
            .when(move |c| !c.stands() && !is_whole(c) && c.basis() == Linear && c.has(EQUILIBRIUM_ERROR))
            .above(EQUILIBRIUM_ERROR, |c| MOVED * c.metric(BOUND))
            .because("slopes that jump where particles cross grid lines: whole cells lose their stress, and tear"),
    ]
}

fn tables() -> Vec<ResultTable> {
    let columns = || {
        [
            Column::metric("load carried", CARRIED, share(1)),
            Column::metric("that there is", BEARABLE, share(1)),
            Column::metric("error", EQUILIBRIUM_ERROR, SHORT),
            Column::metric("bound", BOUND, SHORT),
            Column::metric("iterations", NEWTON_ITERATIONS, fixed(0)),
            Column::metric("most parts of a step", PARTS, fixed(0)),
        ]
    };
    let plain = |r: &Record, stands: bool| {
        let setup = Setup::<Newton>::of_record(r);
        r.level == "n8" && r.remedy() == RemedyName::None && setup.is_ok_and(|c| c.stands() == stands)
    };
    vec![
        ResultTable::new("newton-hangs", move |r| plain(r, false), &[SCHEME, SET], columns()),
        ResultTable::new("newton-stands", move |r| plain(r, true), &[SCHEME, SET], columns()),
    ]
}
