//! Pictures of motions: the mean stress of one that locks, the energy of one that lasts.

use super::super::family::REMEDIES;
use crate::draw::style::history;
use crate::draw::{
    Chart, Dash, FieldFigure, FieldPanel, Marker, Scale, Series, draw_charts, draw_fields,
    share_ranges,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme};

/// Mean stress at the end of runs of one level in the plane, on a scale of ± `most` (Pa): standard, by rates, and ours.
pub(crate) fn mean_stress(gallery: &mut Gallery, level: &str, most: f64) -> Result<(), Error> {
    let mut panels = Vec::new();
    for basis in [BasisName::Gimp, BasisName::Bspline2] {
        for remedy in [
            RemedyName::None,
            RemedyName::FbarRate,
            RemedyName::FbarConsistent,
        ] {
            let scheme = Scheme::flip(basis, remedy);
            let run = gallery.records.iter().find(|r| {
                r.level == level && r.is_default() && r.scheme() == scheme && r.status == Status::Ok
            });
            let Some(run) = run else {
                continue;
            };
            let table = gallery.table(run, "particles.csv")?;
            panels.push(FieldPanel {
                title: scheme.title(),
                points: table.points("x", "y"),
                values: table.column("mean_stress").to_vec(),
                size: run.discretisation.h / f64::from(run.discretisation.ppc).sqrt(),
                outline: Vec::new(),
            });
        }
    }
    if panels.is_empty() {
        return Ok(());
    }
    let figure = FieldFigure {
        title: String::new(),
        panels,
        columns: 3,
        range: (-most, most),
        label: "mean stress (Pa)".to_owned(),
        window: None,
    };
    draw_fields(&gallery.place("mean-stress.png"), &figure)?;
    gallery.hang(
        "mean-stress.png",
        format!("Mean stress of the particles at the end, at level {level}."),
    );
    Ok(())
}

/// Kinetic energy over time of the runs at the two coarsest levels in which `set` was changed, with FLIP: a chart per
/// basis and level. A cross marks a breakdown.
pub(crate) fn kinetic_energy(gallery: &mut Gallery, set: &[&str]) -> Result<(), Error> {
    let mut charts = Vec::new();
    for basis in [BasisName::Gimp, BasisName::Bspline2] {
        for level in ["n8", "n16"] {
            let mut curves = Vec::new();
            for remedy in REMEDIES {
                let scheme = Scheme::flip(basis, remedy);
                let is_of = |r: &&Record| r.level == level && r.set == set && r.scheme() == scheme;
                let run = gallery.records.iter().find(is_of);
                let points = match run {
                    Some(run) => gallery
                        .table(run, "series.csv")?
                        .points("time", "kinetic_energy"),
                    None => Vec::new(),
                };
                let broke = run.is_some_and(|r| r.status == Status::Failed);
                let end = points.last().copied().filter(|_| broke);
                let mut curve = history(scheme, points);
                curve.name = remedy.to_string();
                let cross = Series {
                    name: String::new(),
                    points: end.into_iter().collect(),
                    marker: Marker::Cross,
                    dash: Dash::None,
                    ..curve.clone()
                };
                curves.extend([curve, cross]);
            }
            charts.push(Chart {
                title: format!("{basis}, {level}"),
                x_label: "time (s)".to_owned(),
                y_label: "kinetic energy (J/m)".to_owned(),
                x_scale: Scale::Linear,
                y_scale: Scale::Log10,
                series: curves,
                reference_lines: Vec::new(),
                slope_triangle: None,
                x_range: None,
                y_range: None,
            });
        }
    }
    if !charts.iter().any(Chart::shows_something) {
        return Ok(());
    }
    let (file, path) = ("energy.png", gallery.place("energy.png"));
    share_ranges(&path, &mut charts)?;
    draw_charts(&path, &charts, 2)?;
    let changed = set.join(", ");
    gallery.hang(
        file,
        format!("Kinetic energy with {changed}; a cross marks a breakdown."),
    );
    Ok(())
}
