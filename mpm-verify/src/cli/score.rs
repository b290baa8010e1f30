//! The commands `score` and `export`: other codes.

use super::{Told, say, say_json};
use mpm_verify::case::find_level;
use mpm_verify::cases::find_scored;
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::files::lock::hold;
use mpm_verify::report::{describe, scored};
use mpm_verify::scheme::BasisName;
use mpm_verify::score::{Scored, export::export};
use mpm_verify::spec::RunSpec;
use mpm_verify::study::judge::exit_code;
use std::path::Path;

/// Judges the result in a folder and says what was found; with `out`, writes it there as well.
///
/// # Errors
/// The result can't be read, or nothing can be written.
pub(crate) fn score(folder: &Path, out: Option<&Path>, told: Told) -> Result<ExitCode, Error> {
    let found = Scored::read(folder)?;
    let ours = scored::Ours::beside(&found)?;
    if let Some(out) = out {
        let _held = hold(out)?;
        scored::write(&found, &ours, out)?;
    }
    match told {
        Told { json: true, .. } => say_json(&scored::json(&found, &ours))?,
        Told { quiet: true, .. } => say(describe::run_line(&found.record))?,
        _ => say(scored::text(&found, &ours))?,
    }
    Ok(exit_code(&found.record))
}

/// Writes what another code needs to solve a case.
///
/// # Errors
/// The case scores no codes, has no such level or parameters, or nothing can be written.
pub(crate) fn write_export(
    case: &str,
    level: Option<&str>,
    set: Vec<String>,
    out: &Path,
) -> Result<ExitCode, Error> {
    let (case, foreign) = find_scored(case)?;
    let level = match level {
        Some(name) => find_level(case, name)?,
        None => case.levels[0],
    };
    let spec = RunSpec {
        scheme: (foreign.judged_as)(BasisName::Bspline2),
        level,
        set,
        perturbed: false,
    };
    let _held = hold(out)?;
    let files = export(case, foreign, &spec, out)?;
    let lines = files
        .iter()
        .map(|name| format!("{}\n", out.join(name).display()));
    say(lines.collect::<String>())?;
    Ok(ExitCode::Good)
}
