//! What is checked of the slab. The bounds are derived in `docs/mandel.md`.

use super::metrics as m;
use super::parameters::{LOAD, STEPS, TOLERANCE};
use super::scene::{END, HEIGHT, WIDTH, first_measured, moduli, slab, slab_of_run, steps};
use crate::accuracy::fit_order;
use crate::check::{Check, Finding, judge, run, study};
use crate::exact::mandel::{Mandel, Slab};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, Scheme};
use std::collections::BTreeMap;

/// What orders may lack of the theory's, and levels or steps that decide them.
const SLACK: f64 = 0.15;
const DECIDING: usize = 3;
/// What is finite of the strain may add so many times F/(G a).
const FINITE: f64 = 10.0;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "difference-equations",
            "pressure in the middle and the paths of plate and side are in every step what elimination of the difference equations gives, but for 10 F/(G a) of finite strain and its rounding",
            run(|r| {
                let why = "the equations of cells, nodes and plate at small strain, docs/mandel.md";
                Some(judge(r, m::EQUATIONS_DISTANCE).at_most(finite(r), why))
            }),
        ),
        Check::truth(
            "centre-pressure",
            "no farther from Mandel's than the solution of the difference equations is, and 10 F/(G a)",
            run(|r| {
                let [pressure, ..] = errors_of_equations(r);
                let why = "Mandel's series, and what cells and steps make of it";
                Some(judge(r, m::CENTRE_PRESSURE_ERROR).at_most(pressure + finite(r), why))
            }),
        ),
        Check::truth(
            "settlement",
            "of a plate: likewise",
            run(|r| {
                let [_, settlement, _] = errors_of_equations(r);
                let why = "Mandel's series, and what cells and steps make of it";
                Some(judge(r, m::SETTLEMENT_ERROR).at_most(settlement + finite(r), why))
            }),
        ),
        Check::truth(
            "bulge",
            "of a side: likewise",
            run(|r| {
                let [.., bulge] = errors_of_equations(r);
                let why = "Mandel's series, and what cells and steps make of it";
                Some(judge(r, m::BULGE_ERROR).at_most(bulge + finite(r), why))
            }),
        ),
        Check::truth(
            "peak",
            "as high as the series' but for the error of the pressure and what the series falls by between steps",
            run(|r| {
                let (exact, lost) = peak_between_steps(r);
                let [error, ..] = errors_of_equations(r);
                let bound = error + lost + finite(r);
                Some(judge(r, m::PEAK).within(exact, bound, "Mandel's series"))
            }),
        ),
        Check::truth(
            "peak-time",
            "the series at the time of the peak lacks of its own peak at most that loss and twice that error",
            run(|r| {
                let (exact, lost) = peak_between_steps(r);
                let [error, ..] = errors_of_equations(r);
                let lacks = exact - slab(&r.parameters).at(r.metric(m::PEAK_TIME)).centre;
                let bound = 2.0 * (error + finite(r)) + lost;
                let metric = format!("series' peak less the series at {}", m::PEAK_TIME.name);
                let why = "both pressures at both times are apart by the error at most";
                Some(Finding::at_most(metric, lacks, bound, why))
            }),
        ),
        Check::truth(
            "support",
            "the plane of symmetry below bears the force on the plate, but for what Newton's method and rounding of strains leave",
            run(|r| {
                let unknowns = 2.0 * nodes(r);
                let left = 2.0 * unknowns.sqrt() * r.parameters.number(TOLERANCE);
                let bound = ROUNDING + left + rounding(r);
                let why = "the equations of all nodes add up to the balance of forces";
                Some(judge(r, m::SUPPORT_ERROR).at_most(bound, why))
            }),
        ),
        Check::truth(
            "water",
            "volume and outflow change together but for what Newton's method and rounding of J̃ leave in every step",
            run(|r| {
                let cells = WIDTH / r.discretisation.h;
                // Of every node what is stored and what moves, at most (1 + 2 n) times what leaves, over all of them.
                let left = nodes(r).sqrt() * (1.0 + 2.0 * cells) * r.parameters.number(TOLERANCE);
                let series = slab(&r.parameters);
                let outflow = HEIGHT * strain(r) * closing(series.at(END));
                let count = r.parameters.number(STEPS);
                let rounding = 4.0 * f64::EPSILON * count * WIDTH * HEIGHT / (0.5 * outflow);
                let why =
                    "exact rate: the equations of all nodes add up to the balance of the slab";
                Some(judge(r, m::MASS_ERROR).at_most(left + rounding, why))
            }),
        ),
        Check::truth(
            "order-space",
            "default parameters, three finest levels: order in h of the error of space alone at least 2 − 0.15",
            study(|records| {
                let own = records.iter().filter(|r| r.is_default());
                let over = |r: &Record| r.discretisation.h;
                orders(own, over, m::CENTRE_PRESSURE_ERROR_SPACE, "h", 2.0)
            }),
        ),
        Check::truth(
            "order-time",
            "linear functions, n8, three finest steps: order in Δt of the error of time alone at least 1 − 0.15",
            study(|records| {
                let own = records.iter().filter(|r| {
                    let stepped = r.is_default() || r.changes_only(STEPS.name);
                    r.level == "n8" && r.basis() == BasisName::Linear && stepped
                });
                let over = |r: &Record| r.discretisation.dt;
                orders(own, over, m::CENTRE_PRESSURE_ERROR_TIME, "Δt", 1.0)
            }),
        ),
        Check::truth(
            "order-together",
            "n8, n16, n32 with steps that shrink as h²: order in h of the whole error at least 2 − 0.15",
            study(|records| {
                let own = records.iter().filter(|r| is_together(r));
                let over = |r: &Record| r.discretisation.h;
                orders(own, over, m::CENTRE_PRESSURE_ERROR, "h and Δt", 2.0)
            }),
        ),
    ]
}

/// Whether a run is one of those whose steps shrink as h², 60 of them at n8.
pub(super) fn is_together(r: &Record) -> bool {
    let count = 60.0 * (WIDTH / r.discretisation.h / 8.0).powi(2);
    let own = (r.parameters.number(STEPS) - count).abs() < 1e-6;
    own && (r.is_default() || r.changes_only(STEPS.name))
}

/// What of a balance is rounding.
const ROUNDING: f64 = 1e-9;

/// F/(G a) of a run.
fn strain(r: &Record) -> f64 {
    let [_, shear] = moduli(&r.parameters);
    r.parameters.number(LOAD) / (shear * WIDTH)
}

/// What is finite of the strain, and what rounding of positions and J̃ in every step makes of it.
fn finite(r: &Record) -> f64 {
    FINITE * strain(r) + rounding(r)
}

/// The last bits of positions and J̃, which are of the order of one, in every step, over the strain.
fn rounding(r: &Record) -> f64 {
    4.0 * f64::EPSILON * r.parameters.number(STEPS) / strain(r)
}

/// Nodes of the displacement.
fn nodes(r: &Record) -> f64 {
    let h = r.discretisation.h;
    (WIDTH / h + 1.0) * (HEIGHT / h + 1.0)
}

/// Mean loss of volume over F/(G a).
fn closing(slab: Slab) -> f64 {
    slab.settlement - slab.bulge
}

/// Largest distances of the solution of a run's difference equations from the series, where errors are measured: of
/// the pressure in the middle, the settlement and the bulge.
fn errors_of_equations(r: &Record) -> [f64; 3] {
    let (count, step) = steps(&r.parameters);
    let exact = slab(&r.parameters);
    let of_run = slab_of_run(r.scheme(), r.discretisation.h, &r.parameters);
    let first = first_measured(&r.parameters);
    let mut most = [0.0_f64; 3];
    for (k, b) in (1..=count).zip(of_run).skip(first as usize - 1) {
        let a = exact.at(f64::from(k) * step);
        let apart = [
            a.centre - b.centre,
            a.settlement - b.settlement,
            a.bulge - b.bulge,
        ];
        for (most, apart) in most.iter_mut().zip(apart) {
            *most = most.max(apart.abs());
        }
    }
    most
}

/// The peak of the series, and what is lost of it between steps.
fn peak_between_steps(r: &Record) -> (f64, f64) {
    let (_, step) = steps(&r.parameters);
    let series: Mandel = slab(&r.parameters);
    let (t, peak) = series.peak();
    let at = |k: f64| series.at(k * step).centre;
    let best = at((t / step).floor()).max(at((t / step).ceil()));
    (peak, peak - best)
}

/// Of every scheme the order of a metric over what it depends on, of its three finest runs.
fn orders<'a>(
    runs: impl Iterator<Item = &'a Record>,
    over: impl Fn(&Record) -> f64,
    metric: Metric,
    name: &str,
    theory: f64,
) -> Vec<Finding> {
    let mut ladders: BTreeMap<Scheme, Vec<(f64, f64)>> = BTreeMap::new();
    for r in runs {
        let points = ladders.entry(r.scheme()).or_default();
        points.push((over(r), r.metric(metric)));
    }
    let found = |(scheme, mut points): (Scheme, Vec<(f64, f64)>)| {
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        let finest = points.get(points.len().checked_sub(DECIDING)?..)?;
        let order = fit_order(finest).map_or(f64::NAN, |o| o.order);
        let what = format!("order in {name} of {} of {scheme}", metric.name);
        let why = "linear pressures, mean strains of cells, backward Euler's rule";
        Some(Finding::above(what, order, theory - SLACK, why))
    };
    ladders.into_iter().filter_map(found).collect()
}
