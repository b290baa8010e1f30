//! Columns that another code supplies, and the metrics computed from them.

use super::curve::{Load, LoadCurve, WINDOW, bearing_factor, plateau};
use super::reference::limit_curve;
use super::*;
use crate::foreign::{Asked, Foreign, Gaps, Given, Group, MEAN_STRESS, Measured, START_X, START_Y};
use crate::sampled::SHORT;

const FLOW_X: Asked = Asked::particle("plateau_ux", "m", "displacement along x in the last quarter of penetration");
const FLOW_Y: Asked = Asked::particle("plateau_uy", "m", "displacement along y in the last quarter of penetration");
const PENETRATED: Asked = Asked::series("penetration", "-", "penetration over B");
const FORCE: Asked =
    Asked::series("footing_force", "N/m", "upward force of the ground on the half of the footing that is simulated");
const BASE: Asked = Asked::series("base_force", "N/m", "downward force of the ground on its base");

pub(in crate::cases) fn foreign() -> Foreign {
    let of_stress = [MEAN_STRESS_RMS, OSCILLATION_RATIO].into_iter().chain(names(MEAN_STRESSES));
    let of_load = [NC_B, NC_B_PLUS_H, NC_EFFECTIVE, PRANDTL_ERROR, NC_PEAK, PLATEAU_RISE, ELASTIC_SLOPE];
    let groups = vec![
        Group::new(&[PENETRATED, FORCE], of_load.into_iter().chain(names(CURVE)), |given| {
            of_rows(given, |c| c.metrics())
        }),
        Group::new(&[PENETRATED, FORCE, BASE], [FORCE_IMBALANCE], |given| {
            of_rows(given, |c| vec![(FORCE_IMBALANCE, c.imbalance())])
        }),
        Group::new(&[START_X, START_Y, FLOW_X, FLOW_Y], [MECHANISM_WIDTH, HEAVE], |given| {
            let [start, flow] = [[&START_X, &START_Y], [&FLOW_X, &FLOW_Y]].map(|columns| given.points(columns));
            Ok(given.setup::<Footing>()?.of_surface(&start, &flow))
        }),
        Group::new(&[START_X, START_Y, MEAN_STRESS], of_stress, |given| {
            let start = given.points([&START_X, &START_Y]);
            Ok(given.setup::<Footing>()?.of_stress(&start, given.column(&MEAN_STRESS)))
        }),
    ];
    Foreign {
        judged_as: |basis| Scheme::flip(basis, FbarConsistent),
        abscissa: Some(PENETRATED),
        gaps,
        curves: |_| {
            let (settlement, pressure) = limit_curve().into_iter().unzip();
            let columns = [(PENETRATED.header(), settlement), ("pressure_over_strength (-)".to_owned(), pressure)];
            vec![("reference-curve.csv", columns.into())]
        },
        ..Foreign::of::<2, Pressing>(groups)
    }
}

/// Metrics of the load that a code supplies; missing columns are zeros, whose metrics no group takes.
fn of_rows(given: &Given, of: fn(&LoadCurve<'_>) -> Vec<(Metric, f64)>) -> Measured {
    let [penetration, force, base] = [&PENETRATED, &FORCE, &BASE].map(|asked| move |k| given.value(asked, k));
    let row = |k| Load { penetration: penetration(k), force: force(k), base: base(k) };
    let setup = given.setup::<Footing>()?;
    let is_asked = |row: &Load| row.penetration <= setup.penetration * (1.0 + SHORT);
    let rows: Vec<Load> = (0..given.column(&PENETRATED).len()).map(row).filter(is_asked).collect();
    Ok(of(&setup.load_curve(&rows, setup.pace()?.begun(), WINDOW)))
}

/// The rows show the plateau in four intervals up to the end, the whole curve of an elastic ground in ten, and the curve.
fn gaps(given: &Given) -> Gaps {
    let setup = given.setup::<Footing>()?;
    let (from, end) = (plateau(setup.penetration), setup.penetration);
    let of_plateau = [NC_B, NC_B_PLUS_H, NC_EFFECTIVE, PRANDTL_ERROR, PLATEAU_RISE, FORCE_IMBALANCE];
    let mut gaps = given.unseen(&PENETRATED, [from, end], (end - from) / 4.0, &of_plateau);
    gaps.extend(given.unseen(&PENETRATED, [0.0, end], end / 10.0, &[ELASTIC_SLOPE]));
    let scale = bearing_factor(1.0, WIDTH, setup.undrained_strength);
    let of_curve = |(m, at): &(Metric, f64)| Some((*m, given.between([&PENETRATED, &FORCE], *at, WINDOW, scale)?));
    gaps.extend(CURVE.iter().filter_map(of_curve));
    Ok(gaps)
}
