//! The commands `score`, `board` and `export`: other codes.

use super::*;
use mpm_verify::cases::find_scored;
use mpm_verify::report::{board, junit, scored};
use mpm_verify::score::{Scores, export::export, gate::Gate};

#[derive(Args)]
pub(crate) struct Score {
    /// Folder with score.json and its tables: docs/how-to/score.md
    folder: PathBuf,
    /// Output folder for the verdicts as a page and as JSON
    #[arg(long)]
    out: Option<PathBuf>,
    /// Fail also if a wanted quantity is not judged (default: only if none of them is)
    #[arg(long)]
    strict: bool,
    /// Checks or wanted quantities that must be judged and hold
    #[arg(long, value_name = "CHECK,…", value_delimiter = ',')]
    require: Vec<String>,
    /// Write the verdicts as JUnit to this file
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    #[command(flatten)]
    told: Told,
}

impl Score {
    /// Judges the runs in a folder; with `out`, writes it there as well.
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let found = Scores::read(&self.folder)?;
        let gate = Gate { strict: self.strict, require: self.require };
        gate.known_to(found.case)?;
        let ours = scored::beside(&found)?;
        if let Some(out) = &self.out {
            let _held = hold(out)?;
            scored::write(&found, &ours, &gate, out)?;
        }
        if let Some(file) = &self.junit {
            junit::write_scored(&found, &gate, file)?;
        }
        let refusal = gate.refusal(&found).map_or(String::new(), |why| why + "\n");
        match self.told {
            Told { json: true, .. } => say_json(&scored::json(&found, &ours, &gate))?,
            Told { quiet: true, .. } => say(scored::verdict(&found) + &refusal)?,
            _ => say(scored::text(&found, &ours) + &refusal)?,
        }
        Ok(gate.exit_code(&found))
    }
}

#[derive(Args)]
pub(crate) struct Board {
    /// Folders with score.json and its tables, or with such folders below: docs/board.md
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Output folder for page, JSON and picture
    #[arg(long)]
    out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Board {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let methods = board::gather(&self.folders)?;
        if let Some(out) = &self.out {
            let _held = hold(out)?;
            board::write(&methods, out)?;
        }
        match self.json {
            true => say_json(&methods)?,
            false => say(board::markdown(&methods))?,
        }
        Ok(ExitCode::Good)
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
        let level = self.level.as_deref().map_or(Ok(case.levels[0]), |name| find_level(case, name))?;
        let spec = RunSpec { scheme: (foreign.judged_as)(BasisName::Bspline2), level, set: self.set, perturbed: false };
        let _held = hold(&self.out)?;
        let files = export(case, foreign, &spec, &self.out)?;
        say(files.iter().map(|name| format!("{}\n", self.out.join(name).display())).collect::<String>())?;
        Ok(ExitCode::Good)
    }
}
