//! The largest stable step of every explicit scheme, by bisection, against linear analysis.

mod run;

use crate::cases::prelude::*;
use crate::problem::begin;
use run::{PERIOD, Trials};

const LEVELS: [Level; 1] = [Level { name: "n6", h: 1.0 / PERIOD as f64 }];
/// Relative resolution of a critical CFL number, by bisection and by the growth that noise needs to be seen.
const SEEN: f64 = 0.02;

choices! {
    enum Layout { Aligned = "aligned", Jittered = "jittered", Cut = "cut" }
}

parameters! {
    struct Step {
        dimension: usize = whole("-", "2", 1, 3), "dimensions of the lattice";
        layout: Layout = Layout::Aligned.by_default(),
            "particles in the middle of their shares; off it by up to a quarter of them, in every cell alike; or aligned, with a free end that reaches over a grid line by `cut`";
        cut: f64 = real("-", "0.01", 1e-6, 0.2), "of the layout cut: how far, in cells, the outermost functions see the first particle";
        stretch: f64 = real("-", "1", 0.3, 3.0), "J of the body at the start, by a stretch along the axis; other than 1 in one dimension alone";
        linear_viscosity: f64 = common::LINEAR_VISCOSITY;
        steps: i32 = whole("-", "400", 100, 1_000_000), "steps of a trial";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION.within(Domain::Integer { least: 1, most: 4 });
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
    }
}

metrics! { ALL:
    CRITICAL_CFL = "critical_cfl", "-",
        "largest CFL number c Δt/h, c of the state of the start, at which noise does not grow a hundredfold within the steps; below one, which the program refuses to exceed";
    PREDICTED_CFL = "predicted_cfl", "-", "the same by linear analysis; zero where a mean stress feeds a wave whatever the step";
    FED_CFL = "fed_cfl", "-",
        "where a mean stress feeds a wave: the CFL number at which the fastest grows from a fiftieth of its share of the noise to a hundred times the noise within the steps";
    OFFERED_CFL = "offered_cfl", "-", "CFL number of the step that time_step=auto takes of a case that offers it";
}

pub(super) fn case() -> Case {
    Case::of::<1, Trials<1>>("critical-step", "Largest stable step", ALL)
        .planned(plan())
        .described("A lattice of particles at rest with a little noise: ten halvings find the largest CFL number at which the noise \
            does not grow, for every explicit scheme, in one to three dimensions, aligned, off the lattice, cut by the \
            grid, compressed and stretched, and with an artificial viscosity.")
        .reference("Linear analysis, docs/remedy.md: Jury's conditions of a wave's two by two matrix, here in every dimension and for every transfer.")
        .reference("A bound for any arrangement of particles, docs/critical-step.md.")
        .limit("Particles at rest, which cross no cell; a wave that grows by less than a hundredfold within the steps counts as stable.")
        .limit("CFL numbers of one and more are refused by the program and not tried.")
        .wanted("largest-step", "largest stable step over that of linear analysis", "largest-step")
        .missed_by("small-cut fed-by-mean-stress")
        .checks(checks())
        .headline(CRITICAL_CFL, "critical CFL (–)", 1.0, 3)
        .headline(PREDICTED_CFL, "predicted (–)", 1.0, 3)
        .headline(OFFERED_CFL, "offered (–)", 1.0, 3)
        .headline(FED_CFL, "fed by a mean stress (–)", 1.0, 3)
        .watched(&["growth", "cfl"])
        .sketch(Sketch::block("A periodic lattice of particles, six cells in a period, at rest except for noise.", [1.0, 1.0])
            .probe([0.125, 0.5], "")
            .probe([0.375, 0.5], "")
            .probe([0.625, 0.5], "")
            .probe([0.875, 0.5], "")
            .note([0.5, 0.8], "noise")
            .length([0.0, -0.1], [1.0, -0.1], "6 h, periodic"))
        .cost(|_| 0.1)
        .begun(|spec, values| match Setup::<Step>::of_spec(spec, values)?.dimension {
            1 => begin::<1, Trials<1>>(spec, values),
            2 => begin::<2, Trials<2>>(spec, values),
            _ => begin::<3, Trials<3>>(spec, values),
        })
        .tables(tables())
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let flip = pairs(&BASES, &REMEDIES);
    let mut all = flip.clone();
    all.extend(other_transfers());
    all.extend([Linear, Gimp].map(|b| Scheme::explicit(b, none, TransferName::Musl)));
    let plain = pairs(&BASES, &[none]);
    let space = pairs(&[Gimp, Bspline2], &REMEDIES);
    Plan::of(LEVELS)
        .runs(Quick, "n6", &flip[..1], "dimension=1")
        .runs(Quick, "n6", &plain[..1], "dimension=1 layout=cut")
        .runs(Pr, "n6", &all, "")
        .each(Pr, "n6", &flip, ["dimension=1", "dimension=1 layout=jittered"])
        .each(Pr, "n6", &plain, ["dimension=1 layout=cut", "cut=0.001 dimension=1 layout=cut"])
        .each(Nightly, "n6", &flip, ["dimension=1 stretch=0.7", "dimension=1 stretch=1.4"])
        .runs(Nightly, "n6", &all, "layout=jittered")
        .runs(Nightly, "n6", &plain, "layout=cut")
        .runs(Nightly, "n6", &space, "dimension=3")
        .each(Pr, "n6", &plain, ["0.5", "1"].map(|c| format!("dimension=1 linear_viscosity={c}")))
        .each(Nightly, "n6", &flip, [1, 3, 4].map(|n| format!("dimension=1 ppc_per_direction={n}")))
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Step>;
    type Demand = crate::demand::Demand<Step>;
    let is_small_cut = |s: &Run<Step>| s.basis() == Linear && s.layout == Layout::Cut;
    vec![
        Check::truth("largest-step", "largest stable step that of linear analysis within 2 %, ten halvings and noise growth; above 0.98 where the program's limit is smaller")
            .when(move |s| s.metric(PREDICTED_CFL) > 0.0 && !is_small_cut(s))
            .each([
                Demand::above(CRITICAL_CFL, |_| 1.0 - SEEN).when(|s| s.metric(PREDICTED_CFL) > 1.0),
                Demand::within(CRITICAL_CFL, |s| s.metric(PREDICTED_CFL), |s| SEEN * s.metric(PREDICTED_CFL))
                    .when(|s| s.metric(PREDICTED_CFL) <= 1.0),
            ])
            .because("Jury's conditions of the matrices of docs/remedy.md, over the waves of the lattice"),
        Check::truth("offered-step", "aligned, jittered and cut, no stretch, no viscosity, all but linear functions: the step of time_step=auto is stable")
            .when(|s| s.stretch == 1.0 && s.linear_viscosity == 0.0 && s.metric(OFFERED_CFL).is_finite())
            .above(CRITICAL_CFL, |s| s.metric(OFFERED_CFL) * (1.0 - 0.5 * SEEN))
            .because("the stiffness of a particle over its share of the nodes' masses bounds that of all"),
        Check::known_limit("small-cut", "linear functions with FLIP, no remedy, cut: largest step that of an isolated node, √(4ε/(2 − ε)), within 2 % and ε")
            .when(move |s| is_small_cut(s) && s.transfer() == TransferName::Flip && s.remedy() == RemedyName::None)
            .within(CRITICAL_CFL, |s| s.metric(PREDICTED_CFL), |s| (SEEN + s.cut) * s.metric(PREDICTED_CFL))
            .because("the force on a node falls with the slope of its function, its mass with the function"),
        Check::known_limit("fed-by-mean-stress", "a wave with a negative stiffness by a mean stress grows at every step, at least as fast as by linear analysis")
            .when(|s| s.metric(FED_CFL).is_finite())
            .at_most(CRITICAL_CFL, |s| s.metric(FED_CFL) * (1.0 + SEEN))
            .because("docs/remedy.md: where Π sees no change of volume, a mean stress is all the stiffness there is"),
    ]
}

fn tables() -> Vec<ResultTable> {
    /// Title of a column, and the parameters changed.
    const SETTINGS: [(&str, &str); 9] = [
        ("1D", "dimension=1"),
        ("1D, jittered", "dimension=1 layout=jittered"),
        ("1D, cut", "dimension=1 layout=cut"),
        ("1D, J = 0.7", "dimension=1 stretch=0.7"),
        ("1D, J = 1.4", "dimension=1 stretch=1.4"),
        ("1D, c₁ = 0.5", "dimension=1 linear_viscosity=0.5"),
        ("1D, c₁ = 1", "dimension=1 linear_viscosity=1"),
        ("2D", ""),
        ("3D", "dimension=3"),
    ];
    let columns = SETTINGS.into_iter().flat_map(|(title, set)| {
        let at = move |r: &Record| r.changes(set);
        [
            Column::metric(title, CRITICAL_CFL, fixed(3)).of(at),
            Column::metric("predicted", PREDICTED_CFL, fixed(3)).of(at),
        ]
    });
    let shows = |r: &Record| SETTINGS.iter().any(|(_, set)| r.changes(set));
    vec![ResultTable::new("critical-step", shows, &[SCHEME], columns)]
}
