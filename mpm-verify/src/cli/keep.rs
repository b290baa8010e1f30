//! The commands `keep`, `tables`, `pictures` and `complete`: rows of runs that are kept, and pages filled from them.

use super::*;
use mpm_verify::report::{keep::keep, shown, tables::Page};
use mpm_verify::study::complete::Completeness;

#[derive(Args)]
pub(crate) struct Keep {
    /// Folder of the report
    report: PathBuf,
    /// Folder of nightly/results.csv and history.csv
    #[arg(long, default_value = "reports")]
    into: PathBuf,
}

impl Keep {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let _held = hold(&self.into)?;
        let rows = keep(&self.report, &self.into)?;
        say(format!("{rows} runs are kept in {}\n", self.into.display())).map(|()| ExitCode::Good)
    }
}

#[derive(Args)]
pub(crate) struct Tables {
    /// List stale tables, change nothing, and fail if any is stale
    #[arg(long)]
    check: bool,
    /// Folder of README.md, docs and reports
    #[arg(long, default_value = ".")]
    root: PathBuf,
}

impl Tables {
    /// Fills the tables of the pages, or with `check` lists the stale ones.
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let mut code = ExitCode::Good;
        for page in Page::all(&self.root)? {
            for name in &page.stale {
                let what = if self.check { "stale" } else { "filled" };
                say(format!("{}: {name} {what}\n", page.file.display()))?;
            }
            if self.check && !page.stale.is_empty() {
                code = ExitCode::TruthFailed;
            } else {
                page.write()?;
            }
        }
        Ok(code)
    }
}

#[derive(Args)]
pub(crate) struct Pictures {
    /// Output folder of `verify`, or those of all shards
    #[arg(long, value_name = "FOLDER", num_args = 1..)]
    from: Vec<PathBuf>,
    /// Folder of docs and reports
    #[arg(long, default_value = ".")]
    root: PathBuf,
}

impl Pictures {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        say(shown::draw(&self.root, &self.from)?).map(|()| ExitCode::Good)
    }
}

#[derive(Args)]
pub(crate) struct Complete {
    /// Tier of the planned runs
    #[arg(long, default_value = "nightly", value_parser = tier())]
    tier: Tier,
    /// File of the rows stored by `keep`
    #[arg(long, default_value = "reports/nightly/results.csv")]
    rows: PathBuf,
}

impl Complete {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let plan = Plan::new(cases::all(), self.tier, Shard::WHOLE)?;
        let found = Completeness::of(&plan, &self.rows, &Version::current().source)?;
        say(&found)?;
        found.require().map(|()| ExitCode::Good)
    }
}
