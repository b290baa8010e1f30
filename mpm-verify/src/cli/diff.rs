//! The command `diff`: two reports compared.

use super::*;
use mpm_verify::report::diff::Difference;

#[derive(Args)]
pub(crate) struct Diff {
    /// Folder of the old report
    old: PathBuf,
    /// Folder of the new report
    new: PathBuf,
    /// Output folder of the comparison with its pictures (old | new | difference)
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    told: Told,
}

impl Diff {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let difference = Difference::between(&self.old, &self.new)?;
        if let Some(out) = self.out {
            let _held = hold(&out)?;
            difference.write(&out)?;
        }
        match self.told {
            Told { json: true, .. } => say_json(&difference.json())?,
            Told { quiet: true, .. } => say(difference.counts() + "\n")?,
            _ => say(difference.text())?,
        }
        Ok(difference.exit_code())
    }
}
