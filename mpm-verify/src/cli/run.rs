//! The command `run`: one run of a case, begun or gone on with.

use super::{Told, say, say_json};
use crate::progress::Teller;
use mpm_verify::case::Case;
use mpm_verify::error::{Error, ExitCode, one_line};
use mpm_verify::files::lock::hold;
use mpm_verify::parameter::Parameters;
use mpm_verify::record::Record;
use mpm_verify::report::{describe, discard_report, single};
use mpm_verify::run::checkpoint::{self, Identity, Saving};
use mpm_verify::run::size::Size;
use mpm_verify::run::{RECORD, require_tables};
use mpm_verify::scheme::Scheme;
use mpm_verify::spec::RunSpec;
use mpm_verify::study::found::own_record;
use mpm_verify::study::judge::{exit_code, judge, judged_run};
use std::path::Path;

/// Runs `spec` of `case` on so many threads, draws it into its folder, if it has one, and says what it takes, how far it
/// has come and what it found.
///
/// # Errors
/// The case does not offer the scheme, the scene takes more bytes of memory than it may, the folder holds another run, or
/// those of [`judged_run`].
pub(crate) fn run_one(
    case: &Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving)>,
    (threads, memory): (usize, Option<f64>),
    told: Told,
) -> Result<ExitCode, Error> {
    let offered = case.schemes();
    if !offered.contains(&spec.scheme) {
        let names: Vec<String> = offered.iter().map(Scheme::to_string).collect();
        return Err(Error::unknown(
            &format!("scheme of {}", case.name),
            &spec.scheme.to_string(),
            names.iter().map(String::as_str),
        ));
    }
    let held = place.map(|(folder, _)| hold(folder)).transpose()?;
    if let Some((folder, Saving { resume: true, .. })) = place {
        if let Some(record) = ended(case, spec, folder, told)? {
            checkpoint::discard(folder)?;
            // A run may have been killed between its record and its pictures.
            single::draw(case, &record, folder)?;
            if told.progress() {
                say("This run has ended before; there is nothing to resume.\n\n")?;
            }
            return tell(case, &record, told);
        }
        if !folder.join(checkpoint::FILE).exists() && told.progress() {
            say(format!(
                "{}: no checkpoint; the run begins.\n",
                folder.display()
            ))?;
        }
    }
    let size = Size::of(case, spec)?;
    size.require(memory, spec)?;
    if told.progress() {
        say(format!("{size}.\n"))?;
    }
    if let Some((folder, _)) = place {
        discard_report(folder)?;
    }
    let name = format!("{} {}", case.name, spec.folder());
    let teller = Teller::new(&name, told.progress());
    let record = judged_run(case, spec, place, threads, &|now| teller.hear(now))?;
    teller.finish();
    if let Some((folder, _)) = place {
        let pictures = single::draw(case, &record, folder)?;
        if told.progress() {
            let names = pictures
                .iter()
                .map(|p| folder.join(&p.file).display().to_string());
            say(names
                .map(|name| format!("Picture: {name}\n"))
                .collect::<String>())?;
        }
    } else if told.progress() {
        say("Nothing is kept or drawn: --out DIR does.\n")?;
    }
    drop(held);
    tell(case, &record, told)
}

fn tell(case: &Case, record: &Record, told: Told) -> Result<ExitCode, Error> {
    match told {
        Told { json: true, .. } => say_json(record)?,
        Told { quiet: true, .. } => say(describe::run_line(record))?,
        _ => say(describe::record(case, record))?,
    }
    Ok(exit_code(record))
}

/// The record of this very run in a folder, judged again, or `None` if it has not ended there. One whose tables are not
/// what the run wrote is told, and the run made again.
fn ended(case: &Case, spec: &RunSpec, folder: &Path, told: Told) -> Result<Option<Record>, Error> {
    let Some(mut record) = own_record(folder, case, spec)? else {
        return Ok(None);
    };
    let path = folder.join(RECORD);
    let asked = Identity::of(case, spec, &Parameters::new(&case.parameters, &spec.set)?);
    asked
        .require(&Identity::of_record(&record))
        .map_err(|refusal| refusal.of(&path))?;
    if let Err(damage) = require_tables(&record, folder) {
        if told.progress() {
            say(format!(
                "{}; the run is made again.\n",
                one_line(&damage.to_string())
            ))?;
        }
        return Ok(None);
    }
    record.verdicts = judge(case, &record);
    Ok(Some(record))
}
