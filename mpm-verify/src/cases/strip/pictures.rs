//! The pictures of the strip, beside Figures 10 and 11 of the paper.

use super::parameters::{DURATION, LOAD};
use super::scene::{SIDE, is_driven, is_plastic};
use crate::cases::pictures::spacing;
use crate::draw::{Chart, FieldFigure, FieldPanel, Marker, Series, draw_charts, draw_fields};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::SpaceName;
use crate::table::Table;

use super::checks::{is_of, is_own_clay, steps};
use super::metrics::LAST_LOAD;

/// Finest first.
const LEVELS: [&str; 3] = ["b8", "b4", "b2"];
/// Shares of the load at which particles are drawn.
const SHARES: [f64; 2] = [0.25, 0.5];
/// Pressures over the load, and decimal logarithms of plastic strains, that are drawn.
const PRESSURES: (f64, f64) = (0.0, 1.0);
const STRAINS: (f64, f64) = (-4.0, -1.0);

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    pressures(gallery)?;
    plastic_strain(gallery)?;
    settlements(gallery)
}

/// The finest of the runs of two grids that `own` takes.
fn finest<'g>(gallery: &Gallery<'g>, own: impl Fn(&Record) -> bool) -> Option<&'g Record> {
    let of_level = |level: &&str| {
        let like = |r: &&Record| {
            is_of(r, SpaceName::TwoGrid) && r.status == Status::Ok && r.level == **level && own(r)
        };
        gallery.records.iter().find(like)
    };
    LEVELS.iter().find_map(of_level)
}

fn panel(
    record: &Record,
    table: &Table,
    title: String,
    of: impl Fn(&Table, usize) -> f64,
) -> FieldPanel {
    let points = table.points("x", "y");
    FieldPanel {
        title,
        values: (0..points.len()).map(|k| of(table, k)).collect(),
        points,
        size: spacing(record),
        outline: vec![
            (0.0, SIDE),
            (1.0, SIDE),
            (1.0, SIDE + 0.1),
            (0.0, SIDE + 0.1),
        ],
    }
}

fn figure(panels: Vec<FieldPanel>, range: (f64, f64), label: &str) -> FieldFigure {
    FieldFigure {
        title: String::new(),
        columns: panels.len().min(2),
        panels,
        range,
        label: label.to_owned(),
        window: None,
    }
}

/// Pressure over the load of elastic soil at shares of the load, and of clay at its limit: Figures 10 and 11(b).
fn pressures(gallery: &mut Gallery) -> Result<(), Error> {
    let over = |load: f64| move |table: &Table, k: usize| table.column("pore_pressure")[k] / load;
    let mut panels = Vec::new();
    if let Some(record) = finest(gallery, Record::is_default) {
        let number = |p| record.parameters.number(p);
        for share in SHARES {
            if let Some(table) = gallery.snapshot(record, share * number(DURATION))? {
                let load = share * number(LOAD);
                panels.push(panel(
                    record,
                    &table,
                    format!("elastic, q = {} kPa", 1e-3 * load),
                    over(load),
                ));
            }
        }
        let table = gallery.table(record, "particles.csv")?;
        let title = format!("elastic, q = {} kPa", 1e-3 * number(LOAD));
        panels.push(panel(record, &table, title, over(number(LOAD))));
    }
    if let Some(record) = finest(gallery, is_own_clay) {
        let table = gallery.table(record, "particles.csv")?;
        let load = record.metric(LAST_LOAD);
        panels.push(panel(
            record,
            &table,
            format!("Cam clay, q = {:.1} kPa", 1e-3 * load),
            over(load),
        ));
    }
    if panels.is_empty() {
        return Ok(());
    }
    draw_fields(
        &gallery.place("pressure.png"),
        &figure(panels, PRESSURES, "p/q"),
    )?;
    gallery.hang(
        "pressure.png",
        "Pressure at the particles over the load, of two grids, of elastic soil as the load grows and of Cam clay at its limit. \
         The paper's Figures 10 and 11(b) (data: particles.csv and snapshots of the runs).",
    );
    Ok(())
}

/// Where clay has yielded: Figure 11(a).
fn plastic_strain(gallery: &mut Gallery) -> Result<(), Error> {
    let Some(record) = finest(gallery, is_own_clay) else {
        return Ok(());
    };
    let table = gallery.table(record, "particles.csv")?;
    let strain = |table: &Table, k: usize| table.column("plastic_strain")[k].log10();
    let panels = vec![panel(
        record,
        &table,
        "Cam clay at its limit".to_owned(),
        strain,
    )];
    let label = "log₁₀ of the equivalent plastic strain";
    draw_fields(
        &gallery.place("plastic-strain.png"),
        &figure(panels, STRAINS, label),
    )?;
    gallery.hang(
        "plastic-strain.png",
        "Equivalent plastic strain of Cam clay at its limit, of two grids. The paper's Figure 11(a) (data: particles.csv of the run).",
    );
    Ok(())
}

/// Load over settlement: of elastic soil and of clay in several steps, and of undrained clay under load and settlement.
fn settlements(gallery: &mut Gallery) -> Result<(), Error> {
    type Own = fn(&Record) -> bool;
    let kinds: [(&str, Own); 3] = [
        ("elastic", |r| steps(r, &[]) && !is_plastic(&r.parameters)),
        ("Cam clay", |r| {
            is_plastic(&r.parameters) && steps(r, super::CLAY)
        }),
        ("undrained, stiff Cam clay", |r| {
            let driven = is_driven(&r.parameters) && steps(r, super::LIMIT_SETTLEMENT);
            driven || steps(r, super::LIMIT_LOAD)
        }),
    ];
    let mut charts = Vec::new();
    for (title, own) in kinds {
        let runs = gallery.records.iter().filter(|r| {
            is_of(r, SpaceName::TwoGrid) && r.level == "b4" && r.status == Status::Ok && own(r)
        });
        let mut curves = Vec::new();
        for (colour, record) in runs.enumerate() {
            let table = gallery.table(record, "series.csv")?;
            let points = table.points("settlement", "load").into_iter();
            let driven = if is_driven(&record.parameters) {
                "settlement, "
            } else {
                ""
            };
            let name = format!(
                "{driven}{} steps",
                record.parameters.text(super::parameters::STEPS)
            );
            curves.push(Series {
                marker: Marker::Circle,
                ..Series::line(
                    name,
                    points.map(|(s, q)| (100.0 * s, 1e-3 * q)).collect(),
                    colour,
                )
            });
        }
        if !curves.is_empty() {
            charts.push(Chart::new(title, ["settlement/B (%)", "q (kPa)"], curves));
        }
    }
    if charts.is_empty() {
        return Ok(());
    }
    gallery.write_curves("load-settlement.csv", &charts)?;
    draw_charts(&gallery.place("load-settlement.png"), &charts, charts.len())?;
    gallery.hang(
        "load-settlement.png",
        "Load over settlement at h = B/4 in several steps.",
    );
    Ok(())
}
