//! The checks turn red when they should.

use super::*;
use crate::cases::dam_break::{self, parameters};
use crate::metric::Metric;
use crate::record::fixture::{self, outcomes};
use crate::scheme::Scheme;
use crate::verdict::Verdict;

const OURS: (BasisName, RemedyName) = (BasisName::Gimp, RemedyName::FbarConsistent);
const STANDARD: (BasisName, RemedyName) = (BasisName::Gimp, RemedyName::None);
const PRINTED: (BasisName, RemedyName) = (BasisName::Gimp, RemedyName::FbarRecursive);

/// A run of a scheme on cells of size `h` (m), with metrics.
fn run(scheme: (BasisName, RemedyName), h: f64, set: &[&str], metrics: &[(Metric, f64)]) -> Record {
    let level = format!("h{h}");
    let metrics: Vec<_> = metrics.iter().map(|(m, value)| (m.name, *value)).collect();
    fixture::run(&parameters::ALL, scheme, (&level, h), set, &metrics)
}

fn judge(record: &Record) -> Vec<Verdict> {
    dam_break::case().judge(record)
}

fn judge_study(records: &[Record]) -> Vec<Verdict> {
    dam_break::case().judge_study(records)
}

fn judged(
    scheme: (BasisName, RemedyName),
    set: &[&str],
    (metric, value): (Metric, f64),
    check: &str,
) -> Vec<Option<bool>> {
    outcomes(&judge(&run(scheme, 0.25, set, &[(metric, value)])), check)
}

#[test]
fn the_water_weighs_what_it_weighs() {
    let ratio = |scheme, set: &[&str], value| {
        judged(
            scheme,
            set,
            (m::BASE_REACTION_RATIO, value),
            "base-reaction",
        )
    };
    let staged = ["start=gravity-stage"];
    assert_eq!(ratio(OURS, &[], 1.0009), [Some(true)]);
    assert_eq!(ratio(OURS, &[], 0.9989), [Some(false)]);
    assert_eq!(ratio(OURS, &staged, 0.9960), [Some(true)]);
    assert_eq!(ratio(OURS, &staged, 0.9940), [Some(false)]);
    // The printed algorithm sinks: a known limit, red when it vanishes.
    assert_eq!(ratio(PRINTED, &[], 0.95), [None]);
    let creeps = |value| judged(PRINTED, &[], (m::BASE_REACTION_RATIO, value), "creeps");
    assert_eq!(
        (creeps(0.95), creeps(1.0)),
        (vec![Some(true)], vec![Some(false)])
    );
    let force = |value| judged(OURS, &[], (m::GATE_FORCE, value), "gate-force");
    assert_eq!(
        (force(19_571.0), force(9_785.0)),
        (vec![Some(true)], vec![Some(false)])
    );
}

#[test]
fn the_front_is_judged_by_a_cell_where_nothing_dissipates() {
    let front = |scheme, set: &[&str], error| {
        let metrics = [(m::FRONT_RMS_ERROR, error), (m::ARRIVAL_ERROR, error / 6.0)];
        judge(&run(scheme, 0.25, set, &metrics))
    };
    let of = |verdicts: &[Verdict], check| outcomes(verdicts, check);
    assert_eq!(of(&front(OURS, &[], 0.2), "front"), [Some(true)]);
    assert_eq!(of(&front(OURS, &[], 0.26), "front"), [Some(false)]);
    assert_eq!(of(&front(OURS, &[], 0.2), "arrival"), [Some(true)]);
    assert_eq!(of(&front(OURS, &[], 0.3), "arrival"), [Some(false)]);
    assert_eq!(of(&front(OURS, &["pic_rate=1"], 0.6), "front"), [None]);
    assert_eq!(of(&front(STANDARD, &[], 0.6), "locked"), [Some(true)]);
    assert_eq!(of(&front(STANDARD, &[], 0.1), "locked"), [Some(false)]);
}

#[test]
fn energy_may_be_lost_down_to_water_at_rest_and_not_gained() {
    let at = |metric, value, check| judged(OURS, &[], (metric, value), check);
    assert_eq!(at(m::MOTION_LOSS, 0.3, "dissipation"), [Some(true)]);
    assert_eq!(at(m::MOTION_LOSS, 0.34, "dissipation"), [Some(false)]);
    assert_eq!(
        at(m::MOTION_EXCESS, 3e-6, "motion-not-gained"),
        [Some(true)]
    );
    assert_eq!(
        at(m::MOTION_EXCESS, 4e-6, "motion-not-gained"),
        [Some(false)]
    );
    let total = (BasisName::Gimp, RemedyName::FbarTotal);
    let made = |set: &[&str], value, check| judged(total, set, (m::MOTION_EXCESS, value), check);
    assert_eq!(made(&[], 1.0, "makes-energy"), [Some(true)]);
    assert_eq!(made(&[], 0.0, "makes-energy"), [Some(false)]);
    // Whatever is changed, energy that is made is seen, and none is demanded.
    for changed in ["duration=0.6", "pic_rate=1", "bulk_modulus=1e6"] {
        let set = [changed];
        assert_eq!(made(&set, 1.0, "makes-energy"), [Some(true)], "{changed}");
        assert_eq!(made(&set, 1.0, "motion-not-gained"), [], "{changed}");
        assert_eq!(made(&set, 0.0, "makes-energy"), [], "{changed}");
        assert_eq!(made(&set, 0.0, "motion-not-gained"), [Some(true)]);
    }
    // Only the remedies that are known for it may make any.
    for scheme in [OURS, STANDARD, PRINTED] {
        for set in [&[][..], &["pic_rate=1"], &["bulk_modulus=1e6"]] {
            let of = |check| judged(scheme, set, (m::MOTION_EXCESS, 436.0), check);
            assert_eq!(of("makes-energy"), []);
            assert_eq!(of("motion-not-gained"), [Some(false)]);
        }
    }
    assert!(breaks_down(&run(total, 0.25, &[], &[])).is_some());
    assert!(breaks_down(&run(total, 0.25, &["duration=0.6"], &[])).is_none());
    // On the coarsest cells it takes small steps to keep water that makes energy, and large ones to make none.
    let rate = (BasisName::Gimp, RemedyName::FbarRate);
    assert!(breaks_down(&run(rate, 0.5, &[], &[])).is_none());
    assert!(breaks_down(&run(rate, 0.5, &["cfl=0.3"], &[])).is_some());
    let splines = (BasisName::Bspline2, RemedyName::FbarRate);
    let still = |set: &[&str], check| {
        let verdicts = judge(&run(splines, 0.5, set, &[(m::MOTION_EXCESS, 0.0)]));
        outcomes(&verdicts, check)
    };
    assert_eq!(still(&[], "makes-energy"), [Some(false)]);
    assert_eq!(still(&["cfl=0.3"], "makes-energy"), []);
    assert_eq!(still(&["cfl=0.3"], "motion-not-gained"), [Some(true)]);
    let gained = at(m::ENERGY_EXCESS, 1e-6, "energy-not-gained");
    assert_eq!(gained[0], Some(false));
    let grown = at(m::ENERGY_GAIN, 1e-6, "energy-not-gained");
    assert_eq!(grown[1], Some(false));
    // Affine motion may come back as motion of the particles, but not above the start.
    let mut apic = run(
        OURS,
        0.25,
        &[],
        &[(m::ENERGY_EXCESS, 0.0), (m::ENERGY_GAIN, 1e-3)],
    );
    apic.scheme = Scheme::explicit(apic.basis(), apic.remedy(), TransferName::Apic);
    assert_eq!(outcomes(&judge(&apic), "energy-not-gained"), [Some(true)]);
}

#[test]
fn water_that_grows_or_shrinks_is_seen() {
    let at = |area| judged(OURS, &[], (m::COVERED_EARLY, area), "volume");
    // Strips of 0.1 m over a drop of 2 m, an edge known to 0.025 m over 6 m: 0.25 m².
    let record = run(OURS, 0.25, &[], &[]);
    let resolved = resolved_area(&record);
    assert!((resolved - 0.5 * (0.25 / 2.0) * 2.0 * 2.0 - 0.0625 * 6.0).abs() < 1e-12);
    assert_eq!(at(8.0 + 0.99 * resolved), [Some(true)]);
    assert_eq!(at(8.0 + 1.01 * resolved), [Some(false)]);
}

#[test]
fn sums_have_to_converge_unless_an_ensemble_spreads_as_far() {
    let late = |values: [f64; 3], members: &[f64]| {
        let mut runs: Vec<Record> = [0.5, 0.25, 0.125]
            .into_iter()
            .zip(values)
            .map(|(h, value)| {
                run(
                    OURS,
                    h,
                    &[],
                    &[(m::WALL_IMPULSE, value), (m::CENTRE_X_MEAN, 3.0)],
                )
            })
            .collect();
        for (k, value) in members.iter().enumerate() {
            let seed = format!("seed={k}");
            runs.push(run(OURS, 0.25, &[&seed], &[(m::WALL_IMPULSE, *value)]));
        }
        outcomes(&judge_study(&runs), "late-converges")[0]
    };
    assert_eq!(late([20.0, 22.0, 23.0], &[]), Some(true));
    assert_eq!(late([20.0, 22.0, 25.0], &[]), Some(false));
    assert_eq!(late([20.0, 22.0, 25.0], &[21.0, 22.5]), Some(true));
}

#[test]
fn averages_have_to_smooth_and_errors_to_fall() {
    let smoother = |ours: f64| {
        let pressures = |p| [(m::PRESSURE_RMS, p), (m::CHECKERBOARD_RMS, p)];
        let runs = [
            run(STANDARD, 0.25, &[], &pressures(700.0)),
            run(OURS, 0.25, &[], &pressures(ours)),
        ];
        outcomes(&judge_study(&runs), "smoother")
    };
    assert_eq!(smoother(10.0), [Some(true), Some(true)]);
    assert_eq!(smoother(360.0), [Some(false), Some(false)]);
    let falls = |fine: f64| {
        let runs =
            [(0.5, 0.3), (0.25, fine)].map(|(h, e)| run(OURS, h, &[], &[(m::FRONT_RMS_ERROR, e)]));
        outcomes(&judge_study(&runs), "front-converges")
    };
    assert_eq!(
        (falls(0.2), falls(0.31)),
        (vec![Some(true)], vec![Some(false)])
    );
}

#[test]
fn short_runs_are_compared_with_their_like() {
    let short = ["cfl=0.3", "duration=0.6"];
    let front = |h, set: &[&str], x: f64| {
        let metrics = [(m::FRONT_RMS_ERROR, 6.0 - x), (m::FRONT_X_EARLY, x)];
        run(OURS, h, set, &metrics)
    };
    let runs = [
        front(0.5, &["duration=0.6"], 5.1),
        front(0.5, &short, 5.12),
        front(0.25, &short, 5.3),
        front(0.125, &short, 5.2),
    ];
    let verdicts = judge_study(&runs);
    let falls = outcomes(&verdicts, "front-converges");
    assert_eq!(falls, [Some(true), Some(false)]);
    assert_eq!(outcomes(&verdicts, "time-step"), [Some(true)]);
    assert_eq!(outcomes(&verdicts, "late-converges"), []);
}

#[test]
fn levels_with_different_time_steps_are_not_compared() {
    let front = |h, set: &[&str], error| run(OURS, h, set, &[(m::FRONT_RMS_ERROR, error)]);
    let runs = [
        front(0.5, &[], 0.3),
        front(0.25, &["cfl=0.3"], 0.31),
        front(0.125, &["cfl=0.3"], 0.2),
    ];
    let judged = outcomes(&judge_study(&runs), "front-converges");
    assert_eq!(judged, [Some(true)]);
}

#[test]
fn start_and_time_step_hardly_matter() {
    let moved = |set: &str, x: f64| {
        let runs = [
            run(OURS, 0.25, &[], &[(m::FRONT_X_EARLY, 5.4)]),
            run(OURS, 0.25, &[set], &[(m::FRONT_X_EARLY, x)]),
        ];
        judge_study(&runs)
    };
    let step = |x| outcomes(&moved("cfl=0.3", x), "time-step");
    assert_eq!(
        (step(5.42), step(5.43)),
        (vec![Some(true)], vec![Some(false)])
    );
    let start = |x| outcomes(&moved("start=gravity-stage", x), "starts-agree");
    assert_eq!(
        (start(5.403), start(5.404)),
        (vec![Some(true)], vec![Some(false)])
    );
}
