//! The picture of motions that lock.

use super::COMPARED;
use crate::cases::prelude::*;

/// Mean stress at the end of runs of one level in the plane, on a scale of ± `most` (Pa): standard, by rates, and ours.
pub(in crate::cases) fn mean_stress(gallery: &mut Gallery, level: &str, most: f64) -> Result<(), Error> {
    let mut panels = Vec::new();
    for scheme in pairs(&SMOOTH, &COMPARED) {
        let run = gallery
            .records
            .iter()
            .find(|r| r.level == level && r.is_default() && r.scheme() == scheme && r.status == Status::Ok);
        let Some(run) = run else { continue };
        panels.push(field_panel(run, &gallery.table(run, "particles.csv")?, scheme.title(), "mean_stress"));
    }
    let caption = format!("Mean stress of the particles at the end, at level {level}.");
    Fields::new(panels, "mean stress (Pa)", (-most, most)).columns(3).draw(gallery, "mean-stress", caption)
}
