//! Pictures of what has drifted: golden | now | difference.

use super::prelude::*;
use crate::golden::Goldens;

/// Draws, for each run of a case that has drifted from its golden, its watched series beside the golden's.
pub(super) fn draw(
    study: &CaseStudy,
    gathered: &Gathered,
    goldens: &Goldens,
    out: &Path,
) -> Result<Vec<Picture>, Error> {
    let mut pictures = Vec::new();
    for record in study.records.iter().filter(|r| r.verdicts.iter().any(Verdict::drifts)) {
        // A golden that is missing or damaged, or a run without its rows, has nothing to show.
        let folder = gathered.folder(record)?;
        if let Ok([golden, now]) = goldens.pictures(record, folder) {
            let file = format!("{}/drift/{}.png", record.case, record.folder());
            write_small_png(&out.join(&file), &triptych(&golden, &now))?;
            pictures.push(Picture {
                file,
                caption: format!("Drift of {} {}: golden, now, difference.", record.case, record.folder()),
            });
        }
    }
    Ok(pictures)
}
