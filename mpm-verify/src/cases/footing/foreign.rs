//! Columns that another code supplies, and the metrics computed from them.

use super::curve::{Load, LoadCurve, WINDOW, bearing_factor, plateau};
use super::reference::limit_curve;
use super::*;
use crate::cases::observe::{discretisation, start_columns};
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group, Measured};
use crate::sampled::{Between, Sampled, uncovered};

const START_X: Asked = Asked::particle("reference_x", "m", "x before anything moves");
const START_Y: Asked = Asked::particle("reference_y", "m", "y before anything moves");
const FLOW_X: Asked =
    Asked::particle("plateau_ux", "m", "displacement along x over the last quarter of the penetration");
const FLOW_Y: Asked =
    Asked::particle("plateau_uy", "m", "displacement along y over the last quarter of the penetration");
const MEAN_STRESS: Asked =
    Asked::particle("mean_stress", "Pa", "mean normal stress at the end, (σ_xx + σ_yy + σ_zz)/3, tension positive");
const PENETRATED: Asked = Asked::series("penetration", "-", "penetration over B");
const FORCE: Asked =
    Asked::series("footing_force", "N/m", "upward force of the ground on the half of the footing that is simulated");
const BASE: Asked = Asked::series("base_force", "N/m", "downward force of the ground on its base");

/// Share of the penetration by which rows may go beyond its end.
const BEYOND: f64 = 0.01;
/// Least number of rows in the window of a point of the curve of which the mean is taken; of fewer it is taken between rows.
const DENSE: usize = 4;
/// Least number of intervals between rows on the plateau, and on the whole curve of an elastic ground.
const INTERVALS: (f64, f64) = (4.0, 10.0);

pub(in crate::cases) fn foreign() -> Foreign {
    let curve = CURVE.iter().map(|(metric, _)| *metric);
    let stresses = MEAN_STRESSES.iter().map(|(metric, _)| *metric);
    let of_load = [NC_B, NC_B_PLUS_H, NC_EFFECTIVE, PRANDTL_ERROR, NC_PEAK, PLATEAU_RISE, ELASTIC_SLOPE];
    Foreign {
        judged_as: |basis| Scheme::flip(basis, FbarConsistent),
        discretisation: |spec, parameters, dt| discretisation(2, spec, parameters, dt),
        groups: vec![
            Group {
                columns: &[PENETRATED, FORCE],
                metrics: of_load.into_iter().chain(curve).collect(),
                measure: |given| of_rows(given, None, |c| c.metrics()),
            },
            Group {
                columns: &[PENETRATED, FORCE, BASE],
                metrics: vec![FORCE_IMBALANCE],
                measure: |given| {
                    let imbalance = |c: &LoadCurve| vec![(FORCE_IMBALANCE, c.imbalance())];
                    of_rows(given, Some(&BASE), imbalance)
                },
            },
            Group {
                columns: &[START_X, START_Y, FLOW_X, FLOW_Y],
                metrics: vec![MECHANISM_WIDTH, HEAVE],
                measure: |given| {
                    let start = given.points([&START_X, &START_Y]);
                    let flow = given.points([&FLOW_X, &FLOW_Y]);
                    Ok(setup(given)?.of_surface(&start, &flow))
                },
            },
            Group {
                columns: &[START_X, START_Y, MEAN_STRESS],
                metrics: std::iter::once(MEAN_STRESS_RMS).chain(stresses).collect(),
                measure: |given| {
                    let start = given.points([&START_X, &START_Y]);
                    Ok(setup(given)?.of_stress(&start, given.column(&MEAN_STRESS)))
                },
            },
        ],
        abscissa: Some(PENETRATED),
        gaps,
        start: |spec, parameters| {
            let pressing = Pressing::new(Setup::of_spec(spec, parameters)?)?;
            let run = pressing.begin(&pressing.unseen())?;
            Ok(start_columns(run.particles()))
        },
        setup: &[
            "Plane strain, right half: 0 ≤ x ≤ `domain_width` B, −`domain_depth` B ≤ y ≤ 0, B = 1 m. Base fixed, rollers at both sides.",
            "Hencky elasticity (W = μ ‖h‖² + λ/2 (tr h)², h = ½ ln b) with `young_modulus`, `poisson_ratio`; perfectly plastic at ‖s‖ = √2 `undrained_strength`. No gravity.",
            "A rigid footing on 0 ≤ x ≤ B/2, y = 0 goes down by `penetration` B; the ground sticks to it if `rough`.",
            "Slowly: the force on the base is to be that on the footing. Rows of the series 10⁻⁵ apart in penetration, or closer.",
            "`basis` of score.json says how wide the footing acts: B with `bspline2` and for any code whose footing ends at B/2, B + h with `linear` and `gimp`, whose last held node stands on B/2, B + h/2 with `bspline3`.",
        ],
        curves: |_| {
            let (settlement, pressure) = limit_curve().into_iter().unzip();
            let columns =
                vec![("penetration (-)".to_owned(), settlement), ("pressure_over_strength (-)".to_owned(), pressure)];
            vec![("reference-curve.csv", columns)]
        },
    }
}

fn setup(given: &Given) -> Result<Setup<Footing>, Error> {
    Setup::of_spec(&given.spec, &given.parameters)
}

/// Metrics of the load that a code supplies.
fn of_rows(given: &Given, base: Option<&Asked>, of: fn(&LoadCurve<'_>) -> Vec<(Metric, f64)>) -> Measured {
    let (forces, bases) = (given.column(&FORCE), base.map(|b| given.column(b)));
    let penetrations = given.column(&PENETRATED).iter().enumerate();
    let row = |(k, penetration): (usize, &f64)| Load {
        penetration: *penetration,
        force: forces[k],
        base: bases.map_or(f64::NAN, |base| base[k]),
    };
    let setup = setup(given)?;
    let end = setup.penetration * (1.0 + BEYOND);
    let rows: Vec<Load> = penetrations.map(row).filter(|row| row.penetration <= end).collect();
    let mut metrics = of(&setup.load_curve(&rows, setup.pace()?.begun(), WINDOW));
    for (metric, value) in &mut metrics {
        let point = CURVE.iter().find(|(of, _)| of == metric);
        if let Some(between) = point.and_then(|(_, point)| between(given, &setup, *point)) {
            *value = between.map_or(f64::NAN, |b| b.value);
        }
    }
    Ok(metrics)
}

/// The load over B between rows that are too far apart for a mean around `point`; nothing where they are not.
fn between(given: &Given, setup: &Setup<Footing>, point: f64) -> Option<Option<Between>> {
    let penetrations = given.column(&PENETRATED);
    let near = penetrations.iter().filter(|x| (*x - point).abs() <= WINDOW).count();
    if near >= DENSE {
        return None;
    }
    // Without penetration there is no load.
    let start = penetrations.first().is_some_and(|x| *x > 0.0).then_some(0.0);
    let x: Vec<f64> = start.into_iter().chain(penetrations.iter().copied()).collect();
    let loads = given.column(&FORCE).iter().map(|force| bearing_factor(*force, WIDTH, setup.undrained_strength));
    let y: Vec<f64> = start.into_iter().chain(loads).collect();
    Some(Sampled::new(&x, &y).at(point))
}

/// The rows are to show the plateau up to the end, and of an elastic ground the whole curve; points of the curve may lie
/// between them.
fn gaps(given: &Given) -> Gaps {
    let setup = setup(given)?;
    let (x, end) = (given.column(&PENETRATED), setup.penetration);
    let shown = |from: f64, intervals: f64| {
        uncovered(PENETRATED.name, PENETRATED.unit, x, [from, end], (end - from) / intervals)
    };
    let mut gaps = Vec::new();
    if let Some(why) = shown(plateau(end), INTERVALS.0) {
        let of_plateau = [NC_B, NC_B_PLUS_H, NC_EFFECTIVE, PRANDTL_ERROR, PLATEAU_RISE, FORCE_IMBALANCE];
        gaps.extend(of_plateau.map(|metric| (metric, Gap::Unknown(why.clone()))));
    }
    if let Some(why) = shown(0.0, INTERVALS.1) {
        gaps.push((ELASTIC_SLOPE, Gap::Unknown(why)));
    }
    for &(metric, point) in CURVE {
        match between(given, &setup, point) {
            Some(Some(between)) => gaps.push((metric, Gap::Error(between.error))),
            Some(None) => {
                let why = format!("no rows around penetration = {point}");
                gaps.push((metric, Gap::Unknown(why)));
            }
            None => {}
        }
    }
    Ok(gaps)
}
