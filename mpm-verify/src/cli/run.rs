//! The command `run`: one run of a case, begun or gone on with.

use super::say;
use crate::progress;
use mpm_verify::case::Case;
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::files::read_versioned;
use mpm_verify::parameter::Parameters;
use mpm_verify::record::{self, Record};
use mpm_verify::report::describe;
use mpm_verify::run::checkpoint::{self, Identity, Saving};
use mpm_verify::scheme::Scheme;
use mpm_verify::spec::RunSpec;
use mpm_verify::study::judge::{exit_code, has_truth, judged_run};
use std::path::Path;

/// Runs `spec` of `case`, and says what it found.
///
/// # Errors
/// The case does not offer the scheme, the folder holds another run, or those of [`judged_run`].
pub(crate) fn run_one(
    case: &'static Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving)>,
    threads: usize,
) -> Result<ExitCode, Error> {
    let offered = case.schemes();
    if !offered.contains(&spec.scheme) {
        let names: Vec<String> = offered.iter().map(Scheme::to_string).collect();
        return Err(Error::unknown(
            "scheme",
            &spec.scheme.to_string(),
            names.iter().map(String::as_str),
        ));
    }
    if let Some((folder, Saving { resume: true, .. })) = place {
        if let Some(record) = ended(case, spec, folder)? {
            checkpoint::discard(folder)?;
            say(&describe::record(&record))?;
            say("This run has ended before; there is nothing to resume.\n")?;
            return Ok(exit_code(&record));
        }
        if !folder.join(checkpoint::FILE).exists() {
            say(&format!(
                "{}: no checkpoint; the run begins.\n",
                folder.display()
            ))?;
        }
    }
    let bar = progress::single(&format!("{} {}", case.name, spec.folder()));
    let record = judged_run(case, spec, place, threads, &|share| {
        bar.set_position((share * progress::SCALE) as u64);
    })?;
    bar.finish_and_clear();
    say(&describe::record(&record))?;
    if !has_truth(&record) {
        say("No check against the truth applies to this run.\n")?;
    }
    Ok(exit_code(&record))
}

/// The record of this very run in a folder, or `None` if it has not ended there.
fn ended(case: &Case, spec: &RunSpec, folder: &Path) -> Result<Option<Record>, Error> {
    let path = folder.join("record.json");
    if !path.exists() {
        return Ok(None);
    }
    let record: Record = read_versioned(&path, record::SCHEMA)?;
    let asked = Identity::of(case, spec, &Parameters::new(&case.parameters, &spec.set)?);
    asked
        .require(&Identity::of_record(&record))
        .map_err(|refusal| refusal.of(&path))?;
    Ok(Some(record))
}
