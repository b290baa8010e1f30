//! The picture of the hydrostatic column: who creeps.

use crate::cases::pictures::is_shown;
use crate::draw::style::history;
use crate::draw::{Chart, Scale, draw_charts};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};

/// A chart per basis of the longest runs at the coarsest level: how far particles are from rest, over the steps.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let mut charts = Vec::new();
    for basis in [BasisName::Gimp, BasisName::Bspline2] {
        let of_basis = |r: &&Record| r.basis() == basis && is_shown(r);
        let runs = || gallery.records.iter().filter(of_basis);
        let longest = runs().map(|r| r.work.steps).max().unwrap_or(0);
        let mut curves = Vec::new();
        for record in runs().filter(|r| r.work.steps == longest) {
            let table = gallery.table(record, "series.csv")?;
            let steps = |t: f64| t / record.discretisation.dt / 1e5;
            let points = table.points("time", "displacement_l2").into_iter();
            // The start itself has no logarithm.
            let points = points.filter(|(t, u)| *t > 0.0 && *u > 0.0);
            let points = points.map(|(t, u)| (steps(t), u)).collect();
            curves.push(history(record.scheme(), points));
        }
        if !curves.is_empty() {
            let labels = ["steps (10⁵)", "rms distance from rest (m)"];
            charts.push(Chart {
                y_scale: Scale::Log10,
                ..Chart::new("", labels, curves)
            });
        }
    }
    if charts.is_empty() {
        return Ok(());
    }
    draw_charts(&gallery.place("creep.png"), &charts, 2)?;
    let creeps = RemedyName::FbarRecursive;
    gallery.hang(
        "creep.png",
        format!("Distance of the particles from their places at rest: {creeps} creeps; with GIMP a mode that no average sees grows from rounding with every F̄."),
    );
    Ok(())
}
