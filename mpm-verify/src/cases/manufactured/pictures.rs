//! The picture of motions that lock.

use super::{COMPARED, SMOOTH};
use crate::cases::prelude::*;

/// Mean stress at the end of runs of one level in the plane, on a scale of ± `most` (Pa): standard, by rates, and ours.
pub(in crate::cases) fn mean_stress(gallery: &mut Gallery, level: &str, most: f64) -> Result<(), Error> {
    let mut panels = Vec::new();
    for scheme in pairs(&SMOOTH, &COMPARED) {
        let run = gallery
            .records
            .iter()
            .find(|r| r.level == level && r.is_default() && r.scheme() == scheme && r.status == Status::Ok);
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
    gallery.hang("mean-stress.png", format!("Mean stress of the particles at the end, at level {level}."));
    Ok(())
}
