//! A vortex in a box on few particles without order: the error of a cloud that is a matter of chance.

mod checks;
mod run;

use crate::cases::prelude::*;

choices! {
    enum Layout { Lattice = "lattice", Jittered = "jittered", Random = "random", Scattered = "scattered", Holes = "holes" }
}

parameters! {
    struct Sparse {
        layout: Layout = Layout::Random.by_default(),
            "lattice; jittered: anywhere in its own part of a cell; random: anywhere in its cell; scattered: anywhere in the body; holes: a lattice that lacks one particle of every cell";
        seeds: usize = whole("-", "20", 1, 1000), "clouds that are tried, of the same kind";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION.with_default("1").within(Domain::Integer { least: 1, most: 4 });
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        cfl: f64 = common::CFL.with_default("0.3");
    }
}

metrics! { ALL:
    ERROR_MEDIAN = "error_median", "-", "median over the clouds of the rms error of the displacement over the rms of the exact one; a cloud that breaks down counts as the worst";
    ERROR_HIGH = "error_high", "-", "ninth decile over the clouds of the same error; none if more than a tenth of the clouds break down";
    STRESS_MEDIAN = "stress_error_median", "-", "median over the clouds of the rms error of the stress over the rms of the exact one; a cloud that breaks down counts as the worst";
    SOFTENING = "softening", "-", "median over the clouds of the displacement along the exact one, over it, less one: more than exact is soft";
    BROKEN = "broken", "-", "share of the clouds that break down";
}

pub(super) fn case() -> Case {
    case_of::<run::Clouds>("sparse", "Few particles without order", ALL)
        .planned(plan())
        .described("A small turn in a box, whose exact solution is known, on twenty clouds each of one to sixteen particles a cell: \
            where particles lie anywhere, smaller cells hardly help; where one lies in each part of a cell, more particles do.")
        .reference("Exact: the vortex of mms-vortex-box, turned by a hundredth of a radian.")
        .reference("The error of random points and what it does to a stiffness, docs/sparse.md.")
        .limit("Particles of equal volume, which stay where they are: no cloud here is of a motion's own making.")
        .limit("The motion ends within the box: half-empty cells at a free face are in thin.")
        .wanted("displacement", "rms error of u", "error-bound")
        .missed_by("one-a-cell beyond-bound")
        .checks(checks::checks())
        .headline(ERROR_MEDIAN, "error of u, median (%)", 100.0, 2)
        .headline(ERROR_HIGH, "nine in ten below (%)", 100.0, 2)
        .headline(STRESS_MEDIAN, "error of σ (%)", 100.0, 1)
        .headline(SOFTENING, "softening (%)", 100.0, 2)
        .headline(BROKEN, "break down (%)", 100.0, 0)
        .watched(&["displacement_error"])
        .sketch(Sketch::block("A square of 1 m between slippery walls, whose middle turns.", [1.0, 1.0])
            .held_along(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
            .load([0.75, 0.4], [0.75, 0.6])
            .load([0.25, 0.6], [0.25, 0.4])
            .length([-0.12, 0.0], [-0.12, 1.0], "1 m"))
        .cost(|spec| 1e-3 * spec.level.h.powi(-2))
        .tables(tables())
}

fn plan() -> Plan {
    let remedies = [RemedyName::None, FbarConsistent];
    let of = |bases: &[BasisName]| implicit(&[RuleName::QuasiStatic], bases, &remedies);
    let all = of(&[Linear, Gimp, Bspline2, Bspline3]);
    let few = of(&[Linear, Gimp, Bspline2]);
    let splines = implicit(&[RuleName::QuasiStatic], &[Bspline2], &remedies[..1]);
    let moving = pairs(&[Linear, Gimp, Bspline2], &remedies);
    let [two, three, four] = [2, 3, 4].map(|n| format!("ppc_per_direction={n}"));
    let layout = |name: &str, number: &String| format!("layout={name} {number}");
    let lattice = [layout("lattice", &two), layout("lattice", &three)];
    let better = [layout("jittered", &two), layout("jittered", &three), layout("holes", &two), layout("holes", &three)];
    let sixteen = [layout("lattice", &four), four.clone(), layout("jittered", &four), layout("holes", &four)];
    Plan::of(levels(1.0, [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)]))
        .runs(Quick, "n8", &splines, &two)
        .each(Pr, "n8", &few, ["", &two])
        .each(Pr, "n8 n16 n32", &splines, [&lattice[0], &two])
        .each(Pr, "n16", &splines, [&lattice[1], &three])
        .runs(Nightly, "n8 n16", &few, "")
        .runs(Nightly, "n8", &all, "")
        .each(Nightly, "n8 n16 n32", &all, [&two, &lattice[0]])
        .runs(Nightly, "n16", &moving, "")
        .each(Nightly, "n8 n16 n32", &moving, [&two, &lattice[0]])
        .runs(Nightly, "n8 n16 n32", &splines, &layout("scattered", &two))
        .each(Pr, "n16", &splines, &better)
        .each(Nightly, "n16 n32", &splines, lattice.iter().chain([&two, &three]).chain(&better).chain(&sixteen))
}

fn tables() -> Vec<ResultTable> {
    const LAYOUTS: Label = ("layout", |r| word(r, "layout", "random"));
    const NUMBER: Label = ("a cell", |r| format!("{}", per_direction(r).powi(2)));
    fn per_direction(r: &Record) -> f64 {
        Setup::<Sparse>::number_of(r, |c| c.ppc_per_direction as f64)
    }
    let columns = || {
        [
            Column::metric("error of u, median", ERROR_MEDIAN, share(1)),
            Column::metric("nine in ten below", ERROR_HIGH, share(1)),
            Column::metric("error of σ, median", STRESS_MEDIAN, share(1)),
            Column::metric("softening", SOFTENING, share(1).signed()),
            Column::metric("break down", BROKEN, share(0)),
        ]
    };
    let splines = |r: &Record| r.level == "n16" && r.scheme().to_string() == "quasi-static-bspline2-none";
    let ones = |r: &Record| r.level == "n16" && r.is_default();
    let order = Column::levels(["n8", "n16", "n32"].map(|level| (level, level)), ERROR_MEDIAN, fixed(4));
    let four = |r: &Record| r.changes_none_but(&["layout", "ppc_per_direction"]) && per_direction(r) == 2.0;
    vec![
        ResultTable::new("sparse-layouts", splines, &[LAYOUTS, NUMBER], columns()),
        ResultTable::new("sparse-one", ones, &[SCHEME], columns()),
        ResultTable::new("sparse-levels", four, &[SCHEME, LAYOUTS], order).least(2),
    ]
}
