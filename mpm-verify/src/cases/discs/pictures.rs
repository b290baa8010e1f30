//! The pictures of the discs, beside Figures 5 and 6 of the paper.

use super::parameters::STEP_FACTOR;
use super::scene::{CENTRES, RADIUS};
use super::watch::IN_CONTACT;
use crate::draw::style::history;
use crate::draw::{Chart, Dash, FieldFigure, FieldPanel, Series, draw_charts, draw_fields};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, TransferName};

/// Mean stress is drawn between plus and minus this (Pa).
const STRESS_RANGE: f64 = 100.0;
/// Time between rows at the paper's speed (s).
const ROW: f64 = 0.25;

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    energies(gallery)?;
    contact(gallery)
}

/// Energy over time: the paper's Figure 6, a chart a time step.
fn energies(gallery: &mut Gallery) -> Result<(), Error> {
    let mut charts = Vec::new();
    for factor in ["1", "10", "100"] {
        let own = |r: &&Record| {
            r.status == Status::Ok
                && r.level == "h0.05"
                && r.remedy() == RemedyName::None
                && r.parameters.is(STEP_FACTOR, factor)
                && r.changes_none_but(&[STEP_FACTOR.name])
                && is_drawn(r)
        };
        let mut curves = Vec::new();
        for record in gallery.records.iter().filter(own) {
            let table = gallery.table(record, "series.csv")?;
            let points = table.points("time", "energy_change").into_iter();
            let points = points.map(|(t, e)| (t, 100.0 * e)).collect();
            let scheme = record.scheme();
            curves.push(Series {
                name: format!("{} {}", scheme.solver(), scheme.basis()),
                colour: scheme.basis() as usize,
                dash: match scheme.solver() {
                    "midpoint" => Dash::Solid,
                    "newmark" => Dash::Dashed,
                    _ => Dash::Dotted,
                },
                ..history(scheme, points)
            });
        }
        if !curves.is_empty() {
            charts.push(Chart {
                title: format!("{factor} × 2.5 ms"),
                x_range: Some((20.0, 37.5)),
                ..Chart::new("", ["time (s)", "change of the energy (%)"], curves)
            });
        }
    }
    if charts.is_empty() {
        return Ok(());
    }
    gallery.write_curves("energy.csv", &charts)?;
    draw_charts(&gallery.place("energy.png"), &charts, charts.len().min(3))?;
    gallery.hang("energy.png", "Kinetic and stored energy over the start; the paper's Figure 6 shows its accumulated one. Newmark's rule gains while the discs touch.");
    Ok(())
}

/// Explicit runs are drawn by FLIP, and by MUSL where that breaks down.
fn is_drawn(r: &Record) -> bool {
    match r.transfer() {
        TransferName::Flip | TransferName::None => true,
        TransferName::Musl => r.basis() == BasisName::Linear,
        TransferName::Apic | TransferName::Xpic2 => false,
    }
}

/// The discs pressed together: the paper's Figure 5.
fn contact(gallery: &mut Gallery) -> Result<(), Error> {
    let mut panels = Vec::new();
    for basis in [BasisName::Linear, BasisName::Gimp, BasisName::Bspline2] {
        let own = |r: &&Record| {
            r.basis() == basis && r.scheme().solver() == "midpoint" && r.status == Status::Ok
        };
        let Some(record) = gallery.records.iter().find(own) else {
            continue;
        };
        let Some(table) = gallery.snapshot(record, IN_CONTACT as f64 * ROW)? else {
            continue;
        };
        panels.push(FieldPanel {
            title: basis.to_string(),
            points: table.points("x", "y"),
            values: table.column("mean_stress").to_vec(),
            size: record.discretisation.h / f64::from(record.discretisation.ppc).sqrt(),
            outline: Vec::new(),
        });
    }
    if panels.is_empty() {
        return Ok(());
    }
    let [[lo, _], [hi, _]] = CENTRES;
    let window = (lo - 1.05 * RADIUS, hi + 1.05 * RADIUS);
    let figure = FieldFigure {
        title: String::new(),
        columns: panels.len(),
        panels,
        range: (-STRESS_RANGE, STRESS_RANGE),
        label: "mean stress (Pa)".to_owned(),
        window: Some((window, window)),
    };
    draw_fields(&gallery.place("contact.png"), &figure)?;
    gallery.hang("contact.png", "The discs at 23.75 s, when they have come to rest against each other, with the midpoint rule; the paper's Figure 5.");
    Ok(())
}
