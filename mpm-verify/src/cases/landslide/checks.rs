//! Verdicts on the landslide. The tolerances are derived in `docs/landslide.md`.

use super::ground::{RISE, STABILITY, factor_of_safety, longest_period};
use crate::case::{CheckInfo, check};
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, TransferName};
use crate::verdict::{Kind, Verdict};

/// Relative tolerance of the force on the base.
const WEIGHT: f64 = 5e-3;
/// Largest kinetic energy of the nodes at rest over the stored energy.
const AT_REST: f64 = 1e-6;
/// The coarsest level in three dimensions.
const COARSE: &str = "h0.5";
/// Rms error of the vertical stress over γ H, far from the face.
const OVERBURDEN: f64 = 0.02;
/// Rounding of sums over particles.
const ROUNDING: f64 = 1e-9;
/// What rounding may have grown to over the steps of the gravity stage, relative: a hundredth of what F̄ changes.
const GROWN_ROUNDING: f64 = 1e-4;
/// Relative difference of the settlement at rest from plane strain: of F̄, which scales three directions there and two here.
const OTHER_SCALING: f64 = 0.02;
/// Length of the crest over the height from which on the back wall feels little of the face.
const LONG_CREST: f64 = 2.0;
/// Up to this reduction, the paper's, no band has formed until this time (s).
const PAPERS_REDUCTION: f64 = 1.65;
const EARLY: f64 = 0.5;
/// Duration (s) of a run that ends while the slide is young.
const EARLY_SLIDE: f64 = 1.5;
/// Reduction, and cells (m), from which on `fbar-recursive` with GIMP throws a grain off the grid in plane strain, and when (s).
const THROWN: (f64, f64, f64) = (2.0, 0.2, 5.3);
const THROWS: &str = "a grain is thrown off, likely as averages of averages let the true volumes drift: docs/landslide.md";
/// Rms of σ_m − Πσ_m over γ H that locking exceeds.
const CHECKERBOARD: f64 = 0.05;

pub(super) const CHECKS: &[CheckInfo] = &[
    check(
        "particle-count",
        Kind::Bookkeeping,
        "as many particles as have their centres strictly inside of the face: the paper's 311,250 at h = 0.2 m",
    ),
    check(
        "mass",
        Kind::Bookkeeping,
        "all: the mass at the end is that of the particles, to rounding",
    ),
    check(
        "base-reaction",
        Kind::Truth,
        "all: after the gravity stage the force on the base is the weight within 0.5 %",
    ),
    check(
        "at-rest",
        Kind::Truth,
        "none, fbar-consistent, FLIP and APIC, but for that: after the gravity stage the kinetic energy of the nodes is below 10⁻⁶ of the stored energy",
    ),
    check(
        "breaks-down",
        Kind::KnownLimit,
        "fbar-recursive with GIMP in plane strain, h ≤ 0.2 m, reductions of 2 and more: a grain leaves the grid before 5.3 s",
    ),
    check(
        "creeps",
        Kind::KnownLimit,
        "fbar-recursive: it is above, because averages of averages diffuse the volume",
    ),
    check(
        "slow-motion",
        Kind::KnownLimit,
        "fbar-consistent with quadratic splines at h = 0.5 m, where the toe has yielded: it is above",
    ),
    check(
        "overburden",
        Kind::Truth,
        "all but none with GIMP: far from the face the vertical stress is the weight above, rms within 2 % of γ H",
    ),
    check(
        "locked-stress",
        Kind::KnownLimit,
        "none with GIMP: it is not, and the mean stress alternates from particle to particle by more than 5 % of γ H",
    ),
    check(
        "energy-not-gained",
        Kind::Truth,
        "all with FLIP: kinetic and potential energy and stress work never grow",
    ),
    check(
        "energy-closure",
        Kind::Truth,
        "all that fall, runs of 1.5 s and less: kinetic, potential and stored energy and dissipation are those at the reduction within h/H of the fallen energy",
    ),
    check(
        "energy-not-made",
        Kind::Truth,
        "fbar-consistent: at the end they are not more than those",
    ),
    check(
        "stands",
        Kind::Truth,
        "all, with a reduction below the lower bound of limit analysis by a tenth: less than a hundredth of the ground moves by H/20",
    ),
    check(
        "fails",
        Kind::Truth,
        "F̄, with a reduction beyond the upper bound of limit analysis and what a band of cells bears besides, h/H: it does",
    ),
    check(
        "locked",
        Kind::KnownLimit,
        "none with GIMP, likewise: it does not",
    ),
    check(
        "uniform",
        Kind::Truth,
        "in three dimensions: what was in one place of the section has moved alike over the width at rest and 0.5 s after the reduction, within 10⁻⁴",
    ),
    check(
        "plane-strain",
        Kind::Truth,
        "in three dimensions: at rest the crest has sunk as in plane strain, within 10⁻⁴ without F̄ and 2 % with fbar-consistent; without F̄ also 0.5 s after the reduction",
    ),
    check(
        "slice",
        Kind::Truth,
        "in three dimensions: at rest the crest of a slice has sunk as that of the full width, within 10⁻⁴",
    ),
    check(
        "time-step",
        Kind::Truth,
        "fbar-consistent: half the time step moves the toe at 2.5 s by less than a cell",
    ),
];

/// Why a run is known to break down before its end, if it is.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    let number = |name| record.parameters.number(name);
    let (reduction, h, time) = THROWN;
    let printed = record.remedy() == RemedyName::FbarRecursive && record.basis() == BasisName::Gimp;
    let flat = record.discretisation.dim == 2 && record.discretisation.h <= h;
    let far = number("reduction") >= reduction && number("duration") >= time;
    (printed && flat && far).then_some(THROWS)
}

pub(super) fn judge(record: &Record) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    ground(record, &mut verdicts);
    rest(record, &mut verdicts);
    energy(record, &mut verdicts);
    slide(record, &mut verdicts);
    if record.discretisation.dim == 3 {
        across(record, &mut verdicts);
    }
    verdicts
}

fn ground(record: &Record, verdicts: &mut Vec<Verdict>) {
    let number = |name| record.parameters.number(name);
    let spacing = record.discretisation.h / number("ppc_per_direction");
    // Row j from the base holds columns i with i + j < columns + rows − 1.
    let (rows, columns) = (number("height") / spacing, number("crest") / spacing);
    let whole = |count: f64| (count - count.round()).abs() < 1e-6;
    if number("face_angle") == 45.0 && whole(rows) && whole(columns) {
        let section = rows * (columns + rows - 1.0) - 0.5 * rows * (rows - 1.0);
        let count = (section * record.metric("particles_across")).round();
        verdicts.push(
            Verdict::close(
                "particle-count",
                "particles",
                record.metric("particles"),
                count,
                0.0,
                "Zhao et al. 2022, section 4.4: 311,250 at h = 0.2 m",
            )
            .bookkeeping(),
        );
        let mass = number("density") * section * spacing * spacing;
        verdicts.push(
            Verdict::close(
                "mass",
                "mass",
                record.metric("mass"),
                mass,
                ROUNDING * mass,
                "conservation of mass",
            )
            .bookkeeping(),
        );
    }
}

fn rest(record: &Record, verdicts: &mut Vec<Verdict>) {
    verdicts.push(Verdict::close(
        "base-reaction",
        "base_reaction_ratio",
        record.metric("base_reaction_ratio"),
        1.0,
        WEIGHT,
        "weight of the ground",
    ));
    let kinetic = record.metric("kinetic_share_at_rest");
    verdicts.push(if longest_period(&record.parameters) > RISE {
        let why = "the ground's longest period is longer than the rise of gravity";
        Verdict::not_applicable("at-rest", "kinetic_share_at_rest", why)
    } else if record.transfer() == TransferName::Xpic2 {
        let why = "what XPIC filters from the velocity every step can only creep: docs/cook.md";
        Verdict::not_applicable("at-rest", "kinetic_share_at_rest", why)
    } else if let Some((check, why)) = keeps_moving(record) {
        Verdict::above(
            check,
            Kind::KnownLimit,
            "kinetic_share_at_rest",
            kinetic,
            AT_REST,
            why,
        )
    } else {
        Verdict::at_most(
            "at-rest",
            Kind::Truth,
            "kinetic_share_at_rest",
            kinetic,
            AT_REST,
            "velocities a thousandth of elastic ones",
        )
    });
    let overburden = record.metric("overburden_error");
    let long = LONG_CREST * record.parameters.number("height");
    if record.parameters.number("crest") < long {
        let why = "the face is felt at the back wall";
        verdicts.push(Verdict::not_applicable(
            "overburden",
            "overburden_error",
            why,
        ));
    } else if record.remedy() == RemedyName::None && record.basis() == BasisName::Gimp {
        for (metric, bound) in [
            ("overburden_error", OVERBURDEN),
            ("checkerboard_at_rest", CHECKERBOARD),
        ] {
            verdicts.push(Verdict::above(
                "locked-stress",
                Kind::KnownLimit,
                metric,
                record.metric(metric),
                bound,
                "standard MPM locks: Zhao et al. 2022, Figure 15",
            ));
        }
    } else {
        verdicts.push(Verdict::at_most(
            "overburden",
            Kind::Truth,
            "overburden_error",
            overburden,
            OVERBURDEN,
            "level ground",
        ));
    }
}

/// What keeps the ground moving under its weight, if it is known to; the check's name and the reason.
fn keeps_moving(record: &Record) -> Option<(&'static str, &'static str)> {
    let coarse = record.level == COARSE && record.metric("yielded_at_rest") > 0.0;
    match (record.remedy(), record.basis()) {
        (RemedyName::FbarRecursive, _) => Some((
            "creeps",
            "averages of averages diffuse the volume: docs/column.md",
        )),
        (RemedyName::FbarConsistent, BasisName::Bspline2) if coarse => {
            Some(("slow-motion", "seen where the toe has yielded"))
        }
        _ => None,
    }
}

fn energy(record: &Record, verdicts: &mut Vec<Verdict>) {
    verdicts.push(if record.transfer() != TransferName::Flip {
        let why = "FLIP alone: APIC's affine motion holds energy that isn't counted, and XPIC moves particles by another velocity than the nodes'";
        Verdict::not_applicable("energy-not-gained", "energy_gain", why)
    } else {
        Verdict::at_most(
            "energy-not-gained",
            Kind::Truth,
            "energy_gain",
            record.metric("energy_gain"),
            ROUNDING,
            "explicit steps with lumped masses take energy from the motion, never give it: docs/dam-break.md",
        )
    });
    let (metric, unaccounted) = ("unaccounted_energy", record.metric("unaccounted_energy"));
    if record.remedy() == RemedyName::FbarConsistent {
        verdicts.push(Verdict::at_most(
            "energy-not-made",
            Kind::Truth,
            metric,
            unaccounted,
            ROUNDING,
            "what is stored and dissipated has fallen before",
        ));
    }
    verdicts.push(if record.parameters.number("duration") > EARLY_SLIDE {
        let why = "the ground flows: steps lose on the grid, and the share is reported";
        Verdict::not_applicable("energy-closure", metric, why)
    } else if stands(record) {
        let why = "the slope stands: next to nothing falls";
        Verdict::not_applicable("energy-closure", metric, why)
    } else {
        Verdict::close(
            "energy-closure",
            metric,
            unaccounted / record.metric("fallen_energy"),
            0.0,
            record.discretisation.h / record.parameters.number("height"),
            "a band of cells smears what it shears over its width",
        )
    });
}

/// Least and largest factor of safety of the unreduced slope, where limit analysis knows them.
fn bounds(record: &Record) -> Option<(f64, f64)> {
    let number = |name| record.parameters.number(name);
    if number("face_angle") != 45.0 || number("crest") < LONG_CREST * number("height") {
        return None;
    }
    let (_, least, most) = STABILITY;
    let of = |stability| factor_of_safety(&record.parameters, number("peak_strength"), stability);
    Some((of(least), of(most)))
}

/// Whether the reduction is a tenth and more below the lower bound.
fn stands(record: &Record) -> bool {
    bounds(record).is_some_and(|(least, _)| record.parameters.number("reduction") < 0.9 * least)
}

/// Whether the slope stands or fails where limit analysis knows.
fn slide(record: &Record, verdicts: &mut Vec<Verdict>) {
    let number = |name| record.parameters.number(name);
    let reduction = number("reduction");
    let failed = record.metric("failed_share_end");
    let source = "limit analysis: docs/exact.md";
    let Some((_, most)) = bounds(record) else {
        let why = "the bounds of limit analysis are those of a face at 45° under a long crest";
        verdicts.push(Verdict::not_applicable("stands", "failed_share_end", why));
        return;
    };
    if stands(record) {
        verdicts.push(Verdict::at_most(
            "stands",
            Kind::Truth,
            "failed_share_end",
            failed,
            0.01,
            source,
        ));
    }
    let beyond = most * (1.0 + record.discretisation.h / number("height"));
    // Records of programs that knew no gradual release have none.
    let reduced_for = number("duration") - number("release").max(0.0);
    if reduction > beyond && reduced_for >= 2.5 {
        if record.remedy() != RemedyName::None {
            let metric = "failed_share_end";
            verdicts.push(Verdict::above(
                "fails",
                Kind::Truth,
                metric,
                failed,
                0.01,
                source,
            ));
        } else if record.basis() == BasisName::Gimp {
            verdicts.push(Verdict::at_most(
                "locked",
                Kind::KnownLimit,
                "failed_share_end",
                failed,
                0.01,
                "standard MPM locks: Zhao et al. 2022, Figure 14",
            ));
        }
    }
}

/// What three dimensions must not change until shear bands are there.
fn across(record: &Record, verdicts: &mut Vec<Verdict>) {
    let number = |name| record.parameters.number(name);
    let unbroken = number("duration") >= EARLY && number("reduction") <= PAPERS_REDUCTION;
    let metrics = ["width_spread_at_rest", "width_spread_0.5s"];
    for metric in &metrics[..if unbroken { 2 } else { 1 }] {
        verdicts.push(Verdict::at_most(
            "uniform",
            Kind::Truth,
            metric,
            record.metric(metric),
            GROWN_ROUNDING,
            "the problem is that of its section",
        ));
    }
    let plane_strain = |metric, tolerance| {
        let source = "the same section in plane strain";
        Verdict::close(
            "plane-strain",
            metric,
            record.metric(metric),
            0.0,
            tolerance,
            source,
        )
    };
    let metric = "off_plane_strain_at_rest";
    verdicts.push(match record.remedy() {
        RemedyName::None => plane_strain(metric, GROWN_ROUNDING),
        RemedyName::FbarRecursive => {
            let why = "it creeps, with either scaling at a pace of its own";
            Verdict::not_applicable("plane-strain", metric, why)
        }
        _ => plane_strain(metric, OTHER_SCALING),
    });
    if unbroken && record.remedy() == RemedyName::None {
        verdicts.push(plane_strain("off_plane_strain_0.5s", GROWN_ROUNDING));
    }
}

/// What the width and the time step change.
pub(super) fn judge_study(records: &[Record]) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for (slice, whole) in pairs(records, "width") {
        let metric = "settlement_at_rest";
        let expected = whole.metric(metric);
        verdicts.push(Verdict::close(
            "slice",
            metric,
            slice.metric(metric),
            expected,
            GROWN_ROUNDING * expected,
            format!("{} {}: the full width", slice.scheme(), slice.folder()),
        ));
    }
    // Where the slope fails at once: at the paper's reduction the onset itself is at stake.
    let halved = |(run, _): &(&Record, &Record)| {
        run.remedy() == RemedyName::FbarConsistent && run.parameters.number("cfl") < 0.2
    };
    for (run, own) in pairs(records, "cfl").into_iter().filter(halved) {
        let metric = "runout_2.5s";
        verdicts.push(Verdict::close(
            "time-step",
            metric,
            run.metric(metric),
            own.metric(metric),
            run.discretisation.h,
            format!("{} {}: twice the step", run.scheme(), run.folder()),
        ));
    }
    verdicts
}

/// Runs that change a parameter, each with the run that differs in nothing else.
fn pairs<'a>(records: &'a [Record], parameter: &str) -> Vec<(&'a Record, &'a Record)> {
    let changes = |set: &&String| set.split('=').next() == Some(parameter);
    let ended = || records.iter().filter(|r| r.status == Status::Ok);
    let own = |run: &&'a Record| {
        let others = || run.set.iter().filter(|set| !changes(set));
        let same = |r: &&Record| {
            r.scheme() == run.scheme() && r.level == run.level && r.set.iter().eq(others())
        };
        Some((*run, ended().find(same)?))
    };
    let changed = ended().filter(|run| run.set.iter().any(|set| changes(&set)));
    changed.filter_map(|run| own(&run)).collect()
}

#[cfg(test)]
mod tests;
