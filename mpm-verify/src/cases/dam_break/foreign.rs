//! Columns that another code supplies, and the metrics computed from them.

use super::flow::{Flow, State};
use super::run::Dam;
use super::*;
use crate::exact::dam_break::{COMPARED, front_curve, passage, time_scale};
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group, KINETIC, Measured, POTENTIAL, START_Y, STRESS_WORK};
use crate::sampled::Sampled;

const TIME: Asked = Asked::series("time", "s", "time since the gate was removed, a row every 0.005 s");
const FRONT: Asked = Asked::series("front", "m", "x of the outermost particle and half its spacing");
const COVERED: Asked = Asked::series(
    "covered",
    "m²",
    "area under the highest particles, in strips two particles wide, with half a spacing on top",
);

const START_PRESSURE: Asked =
    Asked::particle("start_pressure", "Pa", "pressure behind the gate just before it is gone: one step from start.csv");

/// Time (s) at which the area is measured.
const EARLY: f64 = 0.4;
/// Largest time (s) between rows that show the energies over the whole flow, a ninth of √(H/g).
const MOVING: f64 = 0.05;
/// Least number of intervals between rows in which the front is compared.
const INTERVALS: f64 = 5.0;

pub(in crate::cases) fn foreign() -> Foreign {
    let front = [FRONT_X_EARLY, FRONT_RMS_ERROR, FRONT_SPEED_MAX, ARRIVAL_TIME, ARRIVAL_ERROR];
    let energy = [ENERGY_RATIO, ENERGY_RATIO_2S, ENERGY_EXCESS];
    let groups = vec![
        Group::new(&[TIME, FRONT], front, of_flow),
        Group::new(&[TIME, KINETIC, POTENTIAL], [MOTION_RATIO_2S, MOTION_EXCESS, MOTION_LOSS], of_flow),
        Group::new(&[TIME, KINETIC, POTENTIAL, STRESS_WORK], energy, of_flow),
        Group::new(&[TIME, COVERED], [COVERED_EARLY], of_flow),
        Group::new(&[START_Y, START_PRESSURE], [PRESSURE_PROFILE_ERROR, BASE_PRESSURE], |given| {
            let dam = Dam::new(given.setup()?)?;
            let [heights, pressures] = [&START_Y, &START_PRESSURE].map(|asked| given.column(asked));
            Ok(dam.pressure_metrics(heights, pressures))
        }),
    ];
    Foreign {
        abscissa: Some(TIME),
        gaps,
        curves: |_| {
            let (time, front) = front_curve().into_iter().unzip();
            vec![("reference-front.csv", vec![("time (s)".to_owned(), time), ("front (m)".to_owned(), front)])]
        },
        ..Foreign::of::<2, Dam>(groups)
    }
}

/// Metrics of a flow; missing columns are zeros, whose metrics no group takes.
fn of_flow(given: &Given) -> Measured {
    let row = |k: usize| State {
        time: given.value(&TIME, k),
        front: given.value(&FRONT, k),
        kinetic: given.value(&KINETIC, k),
        potential: given.value(&POTENTIAL, k),
        stress_work: given.value(&STRESS_WORK, k),
        covered: given.value(&COVERED, k),
        ..State::default()
    };
    let rows = (0..given.column(&TIME).len()).map(row).collect();
    Ok(Flow { rows }.metrics(given.setup::<DamBreak>()?.density, given.spec.level.h))
}

/// The rows are to show the front while it is compared, the area at its time, and the energies over the whole flow.
fn gaps(given: &Given) -> Gaps {
    let time = given.column(&TIME);
    let setup = given.setup::<DamBreak>()?;
    let [from, to] = [COMPARED.0, COMPARED.1].map(|t| t * time_scale());
    let of_front = [FRONT_RMS_ERROR, ARRIVAL_TIME, ARRIVAL_ERROR, FRONT_SPEED_MAX];
    let mut gaps = given.unseen(&TIME, [from, to], (to - from) / INTERVALS, &of_front);
    if gaps.is_empty() {
        let error = Sampled::new(time, given.column(&FRONT)).error(from, to).unwrap_or(f64::INFINITY);
        let speed = passage(TANK - 2.0 * given.spec.level.h).map_or(f64::NAN, |(_, speed)| speed);
        gaps.extend([(FRONT_RMS_ERROR, Gap::Error(error)), (ARRIVAL_ERROR, Gap::Error(error / speed))]);
    }
    let over_all = [ENERGY_EXCESS, MOTION_EXCESS, MOTION_LOSS, FRONT_SPEED_MAX];
    gaps.extend(given.unseen(&TIME, [0.0, setup.duration], MOVING, &over_all));
    for (metric, column) in [(COVERED_EARLY, COVERED), (FRONT_X_EARLY, FRONT)] {
        gaps.extend(given.unseen(&TIME, [EARLY; 2], MOVING, &[metric]));
        let between = Sampled::new(time, given.column(&column)).at(EARLY);
        gaps.extend(between.map(|between| (metric, Gap::Between(between))));
    }
    // A front that has not arrived may do so after the end.
    let arrives = given.column(&FRONT).iter().any(|x| *x >= TANK - 2.0 * given.spec.level.h);
    let ends = time.last().is_some_and(|last| *last < setup.duration * (1.0 - 1e-6));
    if ends && !arrives {
        let why = "the series ends before the front arrives";
        gaps.extend([ARRIVAL_TIME, ARRIVAL_ERROR].map(|metric| (metric, Gap::Unknown(why.to_owned()))));
    }
    Ok(gaps)
}
