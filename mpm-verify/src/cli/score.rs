//! The commands `score` and `export`: other codes.

use super::{Told, say, say_json, scored_cases};
use clap::Args;
use mpm_verify::case::find_level;
use mpm_verify::cases::find_scored;
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::files::lock::hold;
use mpm_verify::report::{describe, scored};
use mpm_verify::scheme::BasisName;
use mpm_verify::score::{Scored, export::export};
use mpm_verify::spec::RunSpec;
use mpm_verify::study::judge::exit_code;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct Score {
    /// Folder with score.json and its tables: docs/how-to/score.md
    folder: PathBuf,
    /// Output folder for the verdicts as a page and as JSON
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    told: Told,
}

impl Score {
    /// Judges the result in a folder; with `out`, writes it there as well.
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let found = Scored::read(&self.folder)?;
        let ours = scored::Ours::beside(&found)?;
        if let Some(out) = &self.out {
            let _held = hold(out)?;
            scored::write(&found, &ours, out)?;
        }
        match self.told {
            Told { json: true, .. } => say_json(&scored::json(&found, &ours))?,
            Told { quiet: true, .. } => say(describe::run_line(&found.record))?,
            _ => say(scored::text(&found, &ours))?,
        }
        Ok(exit_code(&found.record))
    }
}

#[derive(Args)]
pub(crate) struct Export {
    /// Name of the case
    #[arg(value_parser = scored_cases())]
    case: String,
    /// Level of refinement (default: the coarsest)
    #[arg(long)]
    level: Option<String>,
    /// Value of a parameter, in place of its default
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Output folder
    #[arg(long)]
    out: PathBuf,
}

impl Export {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let (case, foreign) = find_scored(&self.case)?;
        let level = match &self.level {
            Some(name) => find_level(case, name)?,
            None => case.levels[0],
        };
        let spec = RunSpec { scheme: (foreign.judged_as)(BasisName::Bspline2), level, set: self.set, perturbed: false };
        let _held = hold(&self.out)?;
        let files = export(case, foreign, &spec, &self.out)?;
        let path = |name: &String| format!("{}\n", self.out.join(name).display());
        say(files.iter().map(path).collect::<String>())?;
        Ok(ExitCode::Good)
    }
}
