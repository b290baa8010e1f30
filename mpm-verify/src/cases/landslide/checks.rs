//! Checks of the landslide. The tolerances are derived in `docs/landslide.md`.

use super::ground::{RISE, STABILITY, factor_of_safety, longest_period};
use super::metrics as m;
use super::parameters::{
    CFL, CREST, DENSITY, DURATION, FACE_ANGLE, HEIGHT, PEAK_STRENGTH, PPC_PER_DIRECTION, REDUCTION,
    RELEASE, WIDTH,
};
use crate::check::{Check, Finding, checks, judge, run, study};
use crate::metric::Metric;
use crate::parameter::Parameter;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, TransferName};

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
/// Share of the ground that has moved from which on the slope has failed.
const FAILED: f64 = 0.01;

/// Why a run is known to break down before its end, if it is.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    let number = |p| record.parameters.number(p);
    let (reduction, h, time) = THROWN;
    let printed = record.remedy() == RemedyName::FbarRecursive && record.basis() == BasisName::Gimp;
    let flat = record.discretisation.dim == 2 && record.discretisation.h <= h;
    let far = number(REDUCTION) >= reduction && number(DURATION) >= time;
    (printed && flat && far).then_some(THROWS)
}

/// The checks of both cases.
pub(super) fn checks() -> Vec<Check> {
    [
        of_ground(),
        of_rest(),
        of_energy(),
        of_slide(),
        of_width(),
        of_studies(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Particles of the section, where their number is known: row j from the base holds columns i with
/// i + j < columns + rows − 1.
fn in_section(record: &Record) -> Option<f64> {
    let number = |p| record.parameters.number(p);
    let spacing = record.discretisation.h / number(PPC_PER_DIRECTION);
    let (rows, columns) = (number(HEIGHT) / spacing, number(CREST) / spacing);
    let whole = |count: f64| (count - count.round()).abs() < 1e-6;
    let known = number(FACE_ANGLE) == 45.0 && whole(rows) && whole(columns);
    known.then_some(rows * (columns + rows - 1.0) - 0.5 * rows * (rows - 1.0))
}

fn of_ground() -> Vec<Check> {
    checks! {
        bookkeeping "particle-count":
            "as many particles as have their centres strictly inside of the face: the paper's 311,250 at h = 0.2 m"
            => run(|r| {
                in_section(r).map(|section| {
                    let count = (section * r.metric(m::PARTICLES_ACROSS)).round();
                    let why = "Zhao et al. 2023, section 4.4: 311,250 at h = 0.2 m";
                    judge(r, m::PARTICLES).within(count, 0.0, why)
                })
            });
        bookkeeping "mass":
            "all: the mass at the end is that of the particles, to rounding"
            => run(|r| {
                let spacing = r.discretisation.h / r.parameters.number(PPC_PER_DIRECTION);
                in_section(r).map(|section| {
                    let mass = r.parameters.number(DENSITY) * section * spacing * spacing;
                    let why = "conservation of mass";
                    judge(r, m::MASS).within(mass, ROUNDING * mass, why)
                })
            });
    }
}

fn of_rest() -> Vec<Check> {
    checks! {
        truth "base-reaction":
            "all: after the gravity stage the force on the base is the weight within 0.5 %"
            => run(|r| {
                let metric = m::BASE_REACTION_RATIO;
                let why = "weight of the ground";
                vec![judge(r, metric).within(1.0, WEIGHT, why)]
            });
        truth "at-rest":
            "none, fbar-consistent, FLIP and APIC, but for that: after the gravity stage the kinetic energy of the nodes is below 10⁻⁶ of the stored energy"
            => run(at_rest);
        known_limit "creeps":
            "fbar-recursive: it is above, because averages of averages diffuse the volume"
            => run(|r| moves_on(r, Moves::Creeps));
        known_limit "slow-motion":
            "fbar-consistent with quadratic splines at h = 0.5 m, where the toe has yielded: it is above"
            => run(|r| moves_on(r, Moves::Slowly));
        truth "overburden":
            "all but none with GIMP: far from the face the vertical stress is the weight above, rms within 2 % of γ H"
            => run(|r| {
                let metric = m::OVERBURDEN_ERROR;
                if feels_the_face(r) {
                    let why = "the face is felt at the back wall";
                    return Some(Finding::not_applicable(metric, why));
                }
                let found = judge(r, metric).at_most(OVERBURDEN, "level ground");
                (!is_locked(r)).then_some(found)
            });
        known_limit "locked-stress":
            "none with GIMP: it is not, and the mean stress alternates from particle to particle by more than 5 % of γ H"
            => run(|r| {
                if feels_the_face(r) || !is_locked(r) {
                    return Vec::new();
                }
                let above = |metric: Metric, bound| {
                    let why = "standard MPM locks: Zhao et al. 2023, Figure 15";
                    judge(r, metric).above(bound, why)
                };
                vec![
                    above(m::OVERBURDEN_ERROR, OVERBURDEN),
                    above(m::CHECKERBOARD_AT_REST, CHECKERBOARD),
                ]
            });
    }
}

/// Standard MPM with GIMP: every particle's volume is a constraint.
fn is_locked(r: &Record) -> bool {
    r.remedy() == RemedyName::None && r.basis() == BasisName::Gimp
}

fn feels_the_face(r: &Record) -> bool {
    r.parameters.number(CREST) < LONG_CREST * r.parameters.number(HEIGHT)
}

/// Why rest is not judged, if it isn't.
fn why_no_rest(r: &Record) -> Option<&'static str> {
    if longest_period(&r.parameters) > RISE {
        Some("the ground's longest period is longer than the rise of gravity")
    } else if r.transfer() == TransferName::Xpic2 {
        Some("what XPIC filters from the velocity every step can only creep: docs/cook.md")
    } else {
        None
    }
}

/// How a ground is known to keep moving under its weight.
#[derive(Clone, Copy, PartialEq)]
enum Moves {
    Creeps,
    Slowly,
}

fn keeps_moving(r: &Record) -> Option<Moves> {
    let coarse = r.level == COARSE && r.metric(m::YIELDED_AT_REST) > 0.0;
    match (r.remedy(), r.basis()) {
        (RemedyName::FbarRecursive, _) => Some(Moves::Creeps),
        (RemedyName::FbarConsistent, BasisName::Bspline2) if coarse => Some(Moves::Slowly),
        _ => None,
    }
}

fn at_rest(r: &Record) -> Option<Finding> {
    let metric = m::KINETIC_SHARE_AT_REST;
    if let Some(why) = why_no_rest(r) {
        return Some(Finding::not_applicable(metric, why));
    }
    let why = "velocities a thousandth of elastic ones";
    let found = judge(r, metric).at_most(AT_REST, why);
    keeps_moving(r).is_none().then_some(found)
}

fn moves_on(r: &Record, how: Moves) -> Vec<Finding> {
    if why_no_rest(r).is_some() || keeps_moving(r) != Some(how) {
        return Vec::new();
    }
    let metric = m::KINETIC_SHARE_AT_REST;
    let why = match how {
        Moves::Creeps => "averages of averages diffuse the volume: docs/column.md",
        Moves::Slowly => "seen where the toe has yielded",
    };
    vec![judge(r, metric).above(AT_REST, why)]
}

fn of_energy() -> Vec<Check> {
    checks! {
        truth "energy-not-gained":
            "all with FLIP: kinetic and potential energy and stress work never grow"
            => run(|r| {
                if r.transfer() != TransferName::Flip {
                    let why = "FLIP alone: APIC's affine motion holds energy that isn't counted, and XPIC moves particles by another velocity than the nodes'";
                    return vec![Finding::not_applicable(m::ENERGY_GAIN, why)];
                }
                let why = "explicit steps with lumped masses take energy from the motion, never give it: docs/dam-break.md";
                let gain = r.metric(m::ENERGY_GAIN);
                vec![Finding::at_most(m::ENERGY_GAIN, gain, ROUNDING, why)]
            });
        truth "energy-not-made":
            "fbar-consistent: at the end they are not more than those"
            => run(|r| {
                let made = r.metric(m::UNACCOUNTED_ENERGY);
                let why = "what is stored and dissipated has fallen before";
                let found = Finding::at_most(m::UNACCOUNTED_ENERGY, made, ROUNDING, why);
                let ours = r.remedy() == RemedyName::FbarConsistent;
                ours.then_some(found)
            });
        truth "energy-closure":
            "all that fall, runs of 1.5 s and less: kinetic, potential and stored energy and dissipation are those at the reduction within h/H of the fallen energy"
            => run(|r| {
                let metric = m::UNACCOUNTED_ENERGY;
                let why = if r.parameters.number(DURATION) > EARLY_SLIDE {
                    "the ground flows: steps lose on the grid, and the share is reported"
                } else if stands(r) {
                    "the slope stands: next to nothing falls"
                } else {
                    let share = r.metric(metric) / r.metric(m::FALLEN_ENERGY);
                    let band = r.discretisation.h / r.parameters.number(HEIGHT);
                    let why = "a band of cells smears what it shears over its width";
                    return vec![Finding::within(metric, share, 0.0, band, why).of_scale(1.0)];
                };
                vec![Finding::not_applicable(metric, why)]
            });
    }
}

/// Least and largest factor of safety of the unreduced slope, where limit analysis knows them.
fn bounds(record: &Record) -> Option<(f64, f64)> {
    let number = |p| record.parameters.number(p);
    if number(FACE_ANGLE) != 45.0 || number(CREST) < LONG_CREST * number(HEIGHT) {
        return None;
    }
    let (_, least, most) = STABILITY;
    let of = |stability| factor_of_safety(&record.parameters, number(PEAK_STRENGTH), stability);
    Some((of(least), of(most)))
}

/// Whether the reduction is a tenth and more below the lower bound.
fn stands(record: &Record) -> bool {
    bounds(record).is_some_and(|(least, _)| record.parameters.number(REDUCTION) < 0.9 * least)
}

/// Whether the slope must fail: the reduction is beyond the upper bound and what a band of cells bears besides, for
/// long enough.
fn must_fail(r: &Record) -> bool {
    let number = |p| r.parameters.number(p);
    let band = 1.0 + r.discretisation.h / number(HEIGHT);
    // Records of programs that knew no gradual release have none.
    let reduced_for = number(DURATION) - number(RELEASE).max(0.0);
    let beyond = bounds(r).is_some_and(|(_, most)| number(REDUCTION) > most * band);
    beyond && reduced_for >= 2.5
}

fn of_slide() -> Vec<Check> {
    const METRIC: Metric = m::FAILED_SHARE_END;
    const LIMIT: &str = "limit analysis: docs/exact.md";
    checks! {
        truth "stands":
            "all, with a reduction below the lower bound of limit analysis by a tenth: less than a hundredth of the ground moves by H/20"
            => run(|r| {
                if bounds(r).is_none() {
                    let why = "the bounds of limit analysis are those of a face at 45° under a long crest";
                    return Some(Finding::not_applicable(METRIC, why));
                }
                let found = judge(r, METRIC).at_most(FAILED, LIMIT);
                stands(r).then_some(found)
            });
        truth "fails":
            "F̄, with a reduction beyond the upper bound of limit analysis and what a band of cells bears besides, h/H: it does"
            => run(|r| {
                let found = judge(r, METRIC).above(FAILED, LIMIT);
                let judged = must_fail(r) && r.remedy() != RemedyName::None;
                judged.then_some(found)
            });
        known_limit "locked":
            "none with GIMP, likewise: it does not"
            => run(|r| {
                let why = "standard MPM locks: Zhao et al. 2023, Figure 14";
                let found = judge(r, METRIC).at_most(FAILED, why);
                let judged = must_fail(r) && is_locked(r);
                judged.then_some(found)
            });
    }
}

/// Whether no band has formed 0.5 s after the reduction.
fn is_unbroken(r: &Record) -> bool {
    let number = |p| r.parameters.number(p);
    number(DURATION) >= EARLY && number(REDUCTION) <= PAPERS_REDUCTION
}

/// What three dimensions must not change until shear bands are there.
fn of_width() -> Vec<Check> {
    let in_space = |r: &Record| r.discretisation.dim == 3;
    checks! {
        truth "uniform":
            "in three dimensions: what was in one place of the section has moved alike over the width at rest and 0.5 s after the reduction, within 10⁻⁴"
            => run(move |r| {
                let metrics = [m::WIDTH_SPREAD_AT_REST, m::WIDTH_SPREAD_0_5S];
                let known = match (in_space(r), is_unbroken(r)) {
                    (false, _) => 0,
                    (true, false) => 1,
                    (true, true) => 2,
                };
                let alike = |metric: &Metric| {
                    let why = "the problem is that of its section";
                    judge(r, *metric).at_most(GROWN_ROUNDING, why)
                };
                metrics[..known].iter().map(alike).collect::<Vec<_>>()
            });
        truth "plane-strain":
            "in three dimensions: at rest the crest has sunk as in plane strain, within 10⁻⁴ without F̄ and 2 % with fbar-consistent; without F̄ also 0.5 s after the reduction"
            => run(move |r| {
                if in_space(r) {
                    plane_strain(r)
                } else {
                    Vec::new()
                }
            });
    }
}

fn plane_strain(r: &Record) -> Vec<Finding> {
    let like = |metric: Metric, tolerance| {
        let why = "the same section in plane strain";
        judge(r, metric).within(0.0, tolerance, why).of_scale(1.0)
    };
    let metric = m::OFF_PLANE_STRAIN_AT_REST;
    let mut found = vec![match r.remedy() {
        RemedyName::None => like(metric, GROWN_ROUNDING),
        RemedyName::FbarRecursive => {
            let why = "it creeps, with either scaling at a pace of its own";
            Finding::not_applicable(metric, why)
        }
        _ => like(metric, OTHER_SCALING),
    }];
    if is_unbroken(r) && r.remedy() == RemedyName::None {
        found.push(like(m::OFF_PLANE_STRAIN_0_5S, GROWN_ROUNDING));
    }
    found
}

/// What the width and the time step change.
fn of_studies() -> Vec<Check> {
    vec![
        Check::truth(
            "slice",
            "in three dimensions: at rest the crest of a slice has sunk as that of the full width, within 10⁻⁴",
            study(|records| {
                let like = |(slice, whole): (&Record, &Record)| {
                    let expected = whole.metric(m::SETTLEMENT_AT_REST);
                    judge(slice, m::SETTLEMENT_AT_REST).within(
                        expected,
                        GROWN_ROUNDING * expected,
                        format!("{} {}: the full width", slice.scheme(), slice.folder()),
                    )
                };
                pairs(records, WIDTH).into_iter().map(like).collect()
            }),
        ),
        // Where the slope fails at once: at the paper's reduction the onset itself is at stake.
        Check::truth(
            "time-step",
            "fbar-consistent: half the time step moves the toe at 2.5 s by less than a cell",
            study(|records| {
                let halved = |(run, _): &(&Record, &Record)| {
                    let finer = run.parameters.number(CFL) < 0.2;
                    run.remedy() == RemedyName::FbarConsistent && finer
                };
                let like = |(run, own): (&Record, &Record)| {
                    judge(run, m::RUNOUT_2_5S).within(
                        own.metric(m::RUNOUT_2_5S),
                        run.discretisation.h,
                        format!("{} {}: twice the step", run.scheme(), run.folder()),
                    )
                };
                let runs = pairs(records, CFL).into_iter();
                runs.filter(halved).map(like).collect()
            }),
        ),
    ]
}

/// Runs that change a parameter, each with the run that differs in nothing else.
fn pairs<'a>(records: &'a [Record], parameter: Parameter) -> Vec<(&'a Record, &'a Record)> {
    let changes = |set: &&String| set.split('=').next() == Some(parameter.name);
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
