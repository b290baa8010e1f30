//! Columns that another code supplies of a slide in plane strain or in three dimensions, and the metrics computed from them.

use super::look::{Series as Rows, State};
use super::*;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group, KINETIC, Measured, POTENTIAL, Part, START_X, START_Y};
use crate::sampled::SHORT;

const TIME: Asked =
    Asked::series("time", "s", "time since the reduction; the row at 0 is the ground at rest before it");
const TOE: Asked = Asked::series("toe", "m", "x of the outermost particle and half its spacing");
const SETTLEMENT: Asked = Asked::series("settlement", "m", "how far the edge of the crest has sunk since gravity rose");
const FAILED: Asked =
    Asked::series("failed_share", "-", "share of the ground that has moved by more than H/20 since the reduction");
const BASE: Asked = Asked::series("base_force", "N/m", "downward force of the ground on its base, at rest");
const STORED: Asked = Asked::series("stored_energy", "J/m", "elastic energy");
const DISSIPATED: Asked = Asked::series("plastic_dissipation", "J/m", "energy that plastic flow has dissipated");
const REST_STRESS: Asked =
    Asked::particle("rest_stress_yy", "Pa", "vertical stress at rest before the reduction, tension positive");

/// Time (s) from the reduction within which a row is that of the ground at rest.
const AT_ONCE: f64 = 0.005;

pub(in crate::cases) fn foreign<const D: usize>() -> Foreign {
    let groups = vec![
        Group::new(&[START_X, START_Y, REST_STRESS], [OVERBURDEN_ERROR], |given| {
            let (references, stress) = (given.points([&START_X, &START_Y]), given.column(&REST_STRESS));
            let slide = Slide::<D>::new(given.setup()?)?;
            Ok(vec![(OVERBURDEN_ERROR, slide.overburden_error(&references, stress))])
        }),
        Group::new(&[TIME, BASE], [BASE_REACTION_RATIO], |given| {
            let slide = Slide::<D>::new(given.setup()?)?;
            let mass = slide.begin(&slide.unseen())?.totals().mass;
            let rest = rows(given, f64::INFINITY).0.unwrap_or_default();
            Ok(vec![slide.base_reaction(&rest, mass)])
        }),
        Group::new(&[TIME, TOE], [RUNOUT_2_5S, RUNOUT_END], of_slide),
        Group::new(&[TIME, SETTLEMENT], [SETTLEMENT_AT_REST, SETTLEMENT_END], of_slide),
        Group::new(&[TIME, FAILED], [FAILED_SHARE_END, FAILURE_TIME], of_slide),
        Group::new(&[TIME, KINETIC, POTENTIAL, STORED, DISSIPATED], [UNACCOUNTED_ENERGY, FALLEN_ENERGY], of_slide),
    ];
    Foreign { abscissa: Some(TIME), gaps, ..Foreign::of::<D, Slide<D>>(groups) }
}

/// The ground at rest, and the rows of the slide; missing columns are zeros, whose metrics no group takes.
fn rows(given: &Given, duration: f64) -> (Option<State>, Vec<State>) {
    let row = |k: usize| State {
        time: given.value(&TIME, k),
        toe: given.value(&TOE, k),
        settlement: given.value(&SETTLEMENT, k),
        failed: given.value(&FAILED, k),
        base_force: given.value(&BASE, k),
        kinetic: given.value(&KINETIC, k),
        potential: given.value(&POTENTIAL, k),
        stored: given.value(&STORED, k),
        dissipated: given.value(&DISSIPATED, k),
        ..State::default()
    };
    let all = || (0..given.rows(Part::Series)).map(row);
    let slides = |row: &State| row.time > AT_ONCE && row.time <= duration * (1.0 + SHORT);
    (all().rfind(|row| row.time.abs() <= AT_ONCE), all().filter(slides).collect())
}

fn of_slide(given: &Given) -> Measured {
    let setup = given.setup::<Landslide>()?;
    let (rest, rows) = rows(given, setup.duration);
    Ok(Rows { rows }.metrics(&setup.slope().section, &rest.unwrap_or_default()))
}

/// The rows show the ground at rest, and the slide to its end.
fn gaps(given: &Given) -> Gaps {
    let duration = given.setup::<Landslide>()?.duration;
    let of_end = [RUNOUT_END, SETTLEMENT_END, FAILED_SHARE_END, UNACCOUNTED_ENERGY, FALLEN_ENERGY];
    let mut gaps = given.unseen(&TIME, [0.0, duration], duration, &of_end);
    if given.has(&TIME) && rows(given, duration).0.is_none() {
        let why = format!("no row within {AT_ONCE} s of time = 0, when the ground is at rest");
        let of_rest = [BASE_REACTION_RATIO, SETTLEMENT_AT_REST, UNACCOUNTED_ENERGY, FALLEN_ENERGY];
        gaps.extend(of_rest.map(|metric| (metric, Gap::Unknown(why.clone()))));
    }
    Ok(gaps)
}
