//! The picture of the excavation, beside Figure 9 of the paper.

use super::parameters::{CREST, CUT};
use super::scene::HEIGHT;
use crate::draw::{FieldFigure, FieldPanel, draw_fields};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::RuleName;

/// Plastic strain is drawn up to this: strength is residual from 0.08 on.
const STRAIN: f64 = 1.0;
/// Times after the excavation (s).
const TIMES: [f64; 2] = [0.5, 1.0];
/// What is shown of the plane beyond the foot of the cut (m).
const BEYOND: f64 = 3.5;

/// Draws the finest run of the midpoint rule, with its own parameters.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| {
        let midpoint = r.scheme().rule() == Some(RuleName::Midpoint);
        midpoint && r.is_default() && r.status == Status::Ok
    };
    let runs = gallery.records.iter().filter(own);
    let finest = runs.min_by(|a, b| a.discretisation.h.total_cmp(&b.discretisation.h));
    let Some(record) = finest else {
        return Ok(());
    };
    let [crest, cut] = [CREST, CUT].map(|p| record.parameters.number(p));
    let foot = crest + HEIGHT - cut;
    let outline = [
        [0.0, 0.0],
        [foot, 0.0],
        [foot, cut],
        [crest, HEIGHT],
        [0.0, HEIGHT],
    ];
    let mut panels = Vec::new();
    let mut add = |title: String, table: crate::table::Table| {
        panels.push(FieldPanel {
            title,
            points: table.points("x", "y"),
            values: table.column("plastic_strain").to_vec(),
            size: record.discretisation.h / f64::from(record.discretisation.ppc).sqrt(),
            outline: outline.iter().map(|[x, y]| (*x, *y)).collect(),
        });
    };
    for time in TIMES {
        if let Some(table) = gallery.snapshot(record, time)? {
            add(format!("{time} s after the excavation"), table);
        }
    }
    add(
        "at the end".to_owned(),
        gallery.table(record, "particles.csv")?,
    );
    let figure = FieldFigure {
        title: String::new(),
        columns: 1,
        panels,
        range: (0.0, STRAIN),
        label: "equivalent plastic strain (–)".to_owned(),
        window: Some(((0.0, foot + BEYOND), (-0.05, 1.1 * HEIGHT))),
    };
    draw_fields(&gallery.place("plastic-strain.png"), &figure)?;
    gallery.hang(
        "plastic-strain.png",
        "Equivalent plastic strain after the toe was taken away; the paper's Figure 9. The outline is that of the cut slope.",
    );
    Ok(())
}
