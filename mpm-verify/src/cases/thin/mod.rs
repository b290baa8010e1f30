//! A beam one, two, four cells thick: the effect of cells and particles on its bending.

mod run;

use crate::cases::prelude::*;
use crate::exact::free_beam::{DEPTH, HALF, SLENDER};

/// Relative difference of a beam's frequency by how its sections shear.
const SECTIONS: f64 = 2e-3;
/// Rounding of a frequency that is read from zeros of a series.
const READ: f64 = 1e-3;
/// Least share of the amplitude at which the zeros are those of the first mode.
const FADED: f64 = 0.05;
/// Least frequency over the exact one of a locked beam, and greatest of one that is too soft.
const LOCKED: f64 = 1.5;
const SOFT: f64 = 0.9;
/// Three zeros in five periods of the exact frequency.
const SLOWEST: f64 = 0.3;
/// Poisson's ratio from which on a body is nearly incompressible.
const STIFF: f64 = 0.49;

const CFL: Parameter = common::CFL.with_default("0.3").within(number(1e-3, 100.0, false));

parameters! {
    struct Thin {
        shift: f64 = real("h", "0", 0.0, 1.0).below(), "how far the faces of the beam lie above the nearest grid lines, in cells";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0");
        cfl: f64 = CFL, "CFL number c Δt / h of pressure waves; explicit: below 1";
        lumped: f64 = common::LUMPED;
        alpha: f64 = common::ALPHA;
        delta: f64 = common::DELTA;
        tolerance: f64 = common::TOLERANCE;
    }
}

metrics! { ALL:
    FREQUENCY_RATIO = "frequency_ratio", "-", "first frequency over that of Timoshenko's beam";
    FREQUENCY_ERROR = "frequency_error", "-", "how far it is off one";
    PREDICTED_RATIO = "predicted_ratio", "-",
        "predicted frequency_ratio of a beam with the bending stiffness of its functions and particles, an upper bound with gimp and fbar-consistent; none where that stiffness is unknown";
    STIFFNESS_RATIO = "stiffness_ratio", "-", "that bending stiffness over the exact one; none where it is unknown";
    AMPLITUDE_RATIO = "amplitude_ratio", "-", "largest deflection in the last period over that in the first";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Swing>("thin", "A beam of few cells", ALL)
        .planned(plan())
        .described("A free beam, twenty times as long as it is deep, swings in its first mode, one, two or four cells over its depth: \
            its frequency against Timoshenko's, and against that of the stiffness that cells and particles leave.")
        .reference("Timoshenko's free beam in plane strain, first symmetric mode: solved in src/cases/thin/theory.rs.")
        .reference("The bending stiffness of cells and particles, docs/thin.md.")
        .limit("One slenderness, small deflection, no clamp: that of cantilever is a singular place of its own.")
        .limit("What F̄ leaves of the bending stiffness of linear functions is not foretold.")
        .wanted("frequency", "frequency of the first bending mode", "as-predicted")
        .missed_by("locks two-particles average-hollows")
        .checks(checks())
        .headline(FREQUENCY_RATIO, "frequency over exact (–)", 1.0, 4)
        .headline(PREDICTED_RATIO, "predicted (–)", 1.0, 4)
        .headline(STIFFNESS_RATIO, "bending stiffness over exact (–)", 1.0, 3)
        .headline(AMPLITUDE_RATIO, "amplitude kept (–)", 1.0, 3)
        .watched(&["deflection"])
        .sketch(Sketch::block("Half of a free beam of 2 m by 0.1 m, with a plane of symmetry in its middle.", [HALF, DEPTH])
            .held([0.0, 0.0], [0.0, DEPTH])
            .load([0.1, 0.25], [0.1, 0.15])
            .load([0.95, 0.15], [0.95, 0.25])
            .length([0.0, -0.08], [HALF, -0.08], "1 m, half of it")
            .length([1.1, 0.0], [1.1, DEPTH], "0.1 m"))
        .cost(|spec| 1e-6 * spec.level.h.powi(-3))
        .tables(tables())
        .breaks_down(|r| {
            let beam = Setup::<Thin>::of_record(r).ok()?;
            let is_singular = beam.rule() == Some(RuleName::Midpoint) && beam.basis() == Gimp && beam.lumped == 0.0;
            is_singular
                .then_some("domains at a face share too little of their outermost functions for a consistent mass")
        })
}

fn plan() -> Plan {
    let plain = [RemedyName::None];
    let both = [RemedyName::None, FbarConsistent];
    let of = |rule, bases: &[BasisName]| implicit(&[rule], bases, &plain);
    let (few, all) = (pairs(&[Linear, Gimp, Bspline2], &both), pairs(&BASES, &both));
    let linear = of(RuleName::Midpoint, &[Linear]);
    let splines = of(RuleName::Midpoint, &[Bspline2]);
    let consistent = "cfl=5 lumped=0";
    Plan::of(levels(DEPTH, [("t1", 1.0), ("t2", 2.0), ("t4", 4.0)]))
        .runs(Quick, "t1", &few[2..3], "")
        .runs(Pr, "t1 t2", &few, "")
        .runs(Pr, "t1", &few, "poisson_ratio=0.49")
        .runs(Pr, "t2", &pairs(&[Linear], &both), "poisson_ratio=0.49")
        .runs(Pr, "t1 t2 t4", &pairs(&[Bspline2], &plain), "")
        .runs(Pr, "t1 t2", &linear, consistent)
        // One cell of quadratic splines, and any of cubic ones, has more functions than particles to give them a mass.
        .runs(Pr, "t2", &splines, consistent)
        .runs(Pr, "t1 t2", &pairs(&[Linear, Gimp, Bspline2], &plain), "shift=0.5")
        .each(Nightly, "t1 t2 t4", &all, ["", "poisson_ratio=0.49"])
        .each(Nightly, "t1 t2", &all, ["ppc_per_direction=4", "shift=0.5"])
        .runs(Nightly, "t1 t2 t4", &linear, consistent)
        .runs(Nightly, "t2 t4", &splines, consistent)
        .runs(Nightly, "t1 t2 t4", &of(RuleName::Midpoint, &[Linear, Gimp, Bspline2]), "cfl=5")
        .runs(Nightly, "t1 t2 t4", &of(RuleName::Newmark, &[Linear, Gimp, Bspline2]), "cfl=5")
}

type Beam<'a> = Run<'a, Thin>;

impl Beam<'_> {
    /// Frequency over the exact one; of an average that leaves fewer than three zeros in five periods, the greatest that it may
    /// be.
    fn frequency(&self) -> f64 {
        let ratio = self.metric(FREQUENCY_RATIO);
        let slow = ratio.is_nan() && self.remedy() == FbarConsistent;
        if slow { SLOWEST } else { ratio }
    }

    /// Why the frequency is not one of the first mode, if it is not.
    fn fades(&self) -> Option<String> {
        let text = "less than a twentieth of the motion is left: other modes move its zeros";
        (self.metric(AMPLITUDE_RATIO) < FADED).then(|| text.to_owned())
    }

    /// Relative distance of a frequency from the predicted one.
    fn slack(&self) -> f64 {
        let angle = SLENDER * self.h;
        // A beam that locks in bending shears instead, evenly or by Cowper's 5/6.
        let sheared = 1.0 - self.metric(PREDICTED_RATIO).powi(2) / self.metric(STIFFNESS_RATIO);
        angle * angle / 6.0 + SECTIONS.max(0.095 * sheared)
    }

    fn is_spline(&self) -> bool {
        matches!(self.basis(), Bspline2 | Bspline3)
    }
}

fn about(what: &str, run: &Beam) -> String {
    let set = run.set.join(" ");
    format!("{} {what} of {} {} {set}", FREQUENCY_RATIO.name, run.scheme, run.level).trim_end().to_owned()
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Thin>;
    // The frequency of each run with the average over that without.
    let averaged = |check: Check| {
        check.when(|b| b.remedy() == FbarConsistent).unless(|b| b.fades()).pairs(
            |b, plain| same_but_scheme(b, plain) && plain.scheme == Scheme::flip(b.basis(), RemedyName::None),
            |b, _| about("over none", b),
            |averaged, plain| averaged.frequency() / plain.frequency(),
        )
    };
    vec![
        Check::truth("as-predicted", "linear functions and splines, no remedy, midpoint with lumped=0: frequency that of the discrete bending stiffness within (βh)²/6 + 0.002, β the wave number")
            .when(|b| b.rule() == Some(RuleName::Midpoint) && b.lumped == 0.0 && b.basis() != Gimp && b.has(PREDICTED_RATIO))
            .unless(|b| b.fades())
            .within(FREQUENCY_RATIO, |b| b.metric(PREDICTED_RATIO), |b| b.slack() * b.metric(PREDICTED_RATIO))
            .because("mass of the particles, stiffness by docs/thin.md; along the beam cells err by (βh)²/12, sections shear by Cowper's coefficient or evenly"),
        Check::truth("no-stiffer", "frequency at most the predicted one, within the tolerance of as-predicted")
            .when(|b| b.has(PREDICTED_RATIO))
            .unless(|b| b.fades())
            .at_most(Quantity::new(FREQUENCY_RATIO.name, |b: &Beam| b.frequency()), |b| (1.0 + b.slack()) * b.metric(PREDICTED_RATIO))
            .because("lumping adds inertia; functions that see a hair of the beam and averages of the volume change take stiffness"),
        Check::truth("order", "splines without a remedy, faces on grid lines: error of the frequency from one to four cells of order at least 2 − 0.15")
            .study(orders),
        averaged(Check::truth("average-no-stiffer", "fbar-consistent: frequency at most that without a remedy on the same cells, within the error of reading it"))
            .at_most(|_| 1.0 + READ)
            .because("an average of the volume change stores no more energy than the volume change"),
        Check::known_limit("locks", "linear functions without a remedy at ν ≥ 0.49, one and two cells: frequency above 1.5 times the exact one")
            .when(|b| b.basis() == Linear && b.remedy() == RemedyName::None && b.level != "t4" && b.poisson_ratio >= STIFF)
            .above(FREQUENCY_RATIO, |_| LOCKED)
            .because("within a cell the depth can't change as it bends, at the price of M and not of E′"),
        Check::known_limit("two-particles", "splines without a remedy, one cell with two particles over the depth: frequency below 0.9 of the exact one")
            .when(|b| b.is_spline() && b.ppc_per_direction == 2 && b.level == "t1" && b.remedy() == RemedyName::None)
            .at_most(FREQUENCY_RATIO, |_| SOFT)
            .because("two particles have three quarters of the second moment of the section"),
        averaged(
            Check::known_limit("average-hollows", "fbar-consistent at ν = 0, one cell: frequency below 0.9 of that without a remedy")
                .when(|b| b.level == "t1" && b.poisson_ratio == 0.0),
        )
        .at_most(|_| SOFT)
        .because("over one cell the average of what is stretched above and pressed below is nothing"),
    ]
}

/// The order of each spline without a remedy whose faces lie on grid lines, over all levels.
fn orders(records: &[Record]) -> Vec<Finding> {
    let runs: Vec<Beam> = Run::all(records).collect();
    let judged = |b: &Beam| b.is_spline() && b.remedy() == RemedyName::None && b.shift == 0.0;
    let orders = orders_from(&runs, judged, "t1", FREQUENCY_ERROR);
    let orders = orders.filter_map(|(first, order)| Some((about("order", first), order?)));
    let why = "the second moment of the particles and the turning of the nodes' mass both err by h²";
    at_least(orders.collect(), FORMAL, why)
}

fn tables() -> Vec<ResultTable> {
    const LEVELS: [(&str, &str); 3] = [("t1", "one cell"), ("t2", "two"), ("t4", "four")];
    const RATIO: Label = ("ν", |r| Setup::<Thin>::number_of(r, |b| b.poisson_ratio).to_string());
    let of = |metric, title: &str| {
        Column::levels(LEVELS.map(|(level, cells)| (level, format!("{title}, {cells}"))), metric, fixed(3))
    };
    let columns = || [of(FREQUENCY_RATIO, "frequency"), of(PREDICTED_RATIO, "predicted")].into_iter().flatten();
    let shows = |r: &Record| r.scheme().rule().is_none() && r.changes_none_but(&["poisson_ratio"]);
    vec![
        ResultTable::new("thin", shows, &[SCHEME, RATIO], columns()),
        ResultTable::new("thin-others", move |r| !shows(r), &[SCHEME, SET], columns()),
    ]
}
