//! The pictures of Cook's membrane.

use super::checks::own_runs;
use super::metrics::{FEM_MID_EDGE_ERROR, FEM_TIP_ERROR, MID_EDGE_UY, TIP_UY};
use super::reference::solution;
use crate::cases::pictures::{Exhibit, basis_title, remedy_title, spacing};
use crate::draw::style::series;
use crate::draw::{Chart, FieldFigure, FieldPanel, ReferenceLine, Scale, Series};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, Scheme};

/// The mean normal stress is drawn between plus and minus this (Pa); the reference reaches 0.127 Pa
/// away from the corners.
const STRESS_RANGE: f64 = 0.15;
const BASES: [BasisName; 3] = [BasisName::Gimp, BasisName::Bspline2, BasisName::Bspline3];
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0)];

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let records = own_runs(gallery.records);
    let mut runs = Exhibit::new(gallery, records);
    for basis in BASES {
        fields(&mut runs, basis)?;
    }
    displacement(&mut runs)?;
    rest(&mut runs)
}

/// One series per scheme over the levels, of records for which `measure` is finite.
fn over_levels(runs: &Exhibit, remedies: &[RemedyName], measure: impl Fn(&Record) -> (f64, f64)) -> Vec<Series> {
    let of_scheme = |(basis, remedy): (BasisName, RemedyName)| {
        let own = |r: &&&Record| r.basis() == basis && r.remedy() == remedy;
        let points = runs.records.iter().filter(own).map(|r| measure(r));
        let mut points: Vec<(f64, f64)> = points.filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let curve = || series(Scheme::flip(basis, remedy), points.clone());
        (!points.is_empty()).then(curve)
    };
    let pairs = BASES.into_iter().flat_map(|b| remedies.iter().map(move |&r| (b, r)));
    pairs.filter_map(of_scheme).collect()
}

fn charts(runs: &mut Exhibit, name: &str, charts: &[Chart], caption: &str) -> Result<(), Error> {
    match charts.iter().any(|c| c.series.is_empty()) {
        true => Ok(()),
        false => runs.charts(name, charts, 2, caption),
    }
}

fn fields(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let mut panels = Vec::new();
    let has = |level: &&str| runs.records.iter().any(|r| r.basis() == basis && r.level == **level);
    let levels: Vec<&str> = ["h0.5", "h1", "h2"].into_iter().filter(has).take(2).collect();
    for level in levels.into_iter().rev() {
        for remedy in [RemedyName::None, RemedyName::FbarConsistent] {
            let Some(record) = runs.find(basis, remedy, level) else {
                continue;
            };
            let table = runs.gallery.table(record, "particles.csv")?;
            panels.push(FieldPanel {
                title: format!("{}, h = {} m", remedy_title(remedy), record.discretisation.h),
                points: table.points("x", "y"),
                values: table.column("mean_stress").to_vec(),
                size: spacing(record),
                outline: OUTLINE.to_vec(),
            });
        }
    }
    if panels.is_empty() {
        return Ok(());
    }
    let title = basis_title(basis);
    let figure = FieldFigure {
        title: format!("Cook's membrane at rest, {title}"),
        panels,
        columns: 2,
        range: (-STRESS_RANGE, STRESS_RANGE),
        label: "mean normal stress (Pa)".to_owned(),
        window: None,
    };
    runs.fields(
        &format!("mean-stress-{basis}"),
        &figure,
        format!("Mean normal stress at rest with {title}: standard MPM against F̄ (data: particles.csv of each run)."),
    )
}

fn displacement(runs: &mut Exhibit) -> Result<(), Error> {
    let at_rest = [RemedyName::None, RemedyName::FbarTotal, RemedyName::FbarRate, RemedyName::FbarConsistent];
    let chart = |title: &str, metric: Metric, error: Metric| {
        let curves = over_levels(runs, &at_rest, |r| (r.discretisation.h, r.metric(metric)));
        let reference = runs.records.iter().find_map(|r| {
            let exact = r.metric(metric) / (1.0 + r.metric(error));
            let uncertainty = solution(&r.parameters).ok()?.uncertainty_displacement;
            let line = || ReferenceLine::known_to("FEM reference", exact, uncertainty);
            exact.is_finite().then(line)
        });
        Chart {
            x_scale: Scale::Log10,
            reference_lines: reference.into_iter().collect(),
            ..Chart::new(title, ["cell size h (m)", "u_y (m)"], curves)
        }
    };
    let both = [
        chart("Middle of the right side", MID_EDGE_UY, FEM_MID_EDGE_ERROR),
        chart("Upper right corner", TIP_UY, FEM_TIP_ERROR),
    ];
    charts(
        runs,
        "displacement",
        &both,
        "Vertical displacement at rest of the middle of the right side and of its upper corner, against the FEM reference.",
    )
}

/// Approach to rest at the finest level that all remedies have run with GIMP.
fn rest(runs: &mut Exhibit) -> Result<(), Error> {
    let remedies = [
        RemedyName::None,
        RemedyName::FbarRecursive,
        RemedyName::FbarTotal,
        RemedyName::FbarRate,
        RemedyName::FbarConsistent,
    ];
    let Some(level) = runs.level(BasisName::Gimp, &remedies, &["h1", "h2"]) else {
        return Ok(());
    };
    let against_time = |column, remedies: &[RemedyName]| {
        let at = (BasisName::Gimp, level);
        runs.by_remedy(at, remedies, |r| runs.history(r, ["time", column]))
    };
    let (tip, gap) = ("tip_uy", "log_jacobian_gap_rms");
    let both = [
        Chart::new("Tip", ["time (s)", "u_y (m)"], against_time(tip, &remedies)?),
        Chart::new(
            "True against averaged Jacobian",
            ["time (s)", "rms ln(J / averaged J)"],
            against_time(gap, &remedies[1..])?,
        ),
    ];
    charts(
        runs,
        "rest",
        &both,
        &format!("Approach to rest with GIMP at {level}: the recursive F̄ creeps and never rests, the others stop."),
    )
}
