//! The command `bless`: drift becomes the golden.

use super::*;
use mpm_verify::bless::{Blessing, Candidates};
use mpm_verify::error::is_unfit;

#[derive(Args)]
pub(crate) struct Bless {
    /// Name of the case
    #[arg(value_parser = case(), hide_possible_values = true)]
    case: &'static Case,
    /// Reason for the change of the results
    #[arg(long)]
    reason: String,
    /// Output folder of `verify`, or those of all shards
    #[arg(long, default_value = "reports/latest", num_args = 1..)]
    from: Vec<PathBuf>,
    /// Folder of the goldens (default: ./golden, or that of the source checkout)
    #[arg(long)]
    golden: Option<PathBuf>,
    /// Accept this quantity despite doubts
    #[arg(long, value_name = "METRIC")]
    allow: Vec<String>,
    /// Number of runs side by side (default: number of cores)
    #[arg(long, value_parser = threads())]
    pub(super) threads: Option<usize>,
}

impl Bless {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let (reason, workers) = (&*self.reason, or_all_cores(self.threads));
        let root = golden::place(self.golden);
        let words = reason.split_whitespace().collect::<String>();
        if !words.contains(char::is_alphanumeric) || words.contains(is_unfit) || reason.len() > 500 {
            return Err(Error::Input(
                "--reason is empty, longer than 500 bytes or has control characters; say why the results have changed"
                    .to_owned(),
            ));
        }
        let goldens = Goldens::open(&root)?;
        let _held = hold(&root)?;
        let gathered = Gathered::read(&self.from)?;
        gathered.require_tier()?;
        let study = gathered.judge_case(self.case, |r| goldens.compare(r, gathered.folder(r)?))?;
        let candidates = Candidates::of(&study)?;
        say(candidates.table())?;
        if let Some(refusal) = candidates.refusal() {
            say(&refusal)?;
            return Ok(ExitCode::TruthFailed);
        }
        let listener = progress::Runs::new(candidates.twin_names(), true);
        let blessed = candidates.bless(&gathered, &goldens, (reason, &self.allow), workers, &listener)?;
        let (told, code) = match blessed {
            Blessing::Done(count) => (format!("{count} goldens blessed: {reason}\n"), ExitCode::Good),
            Blessing::Broken(told) => (told, ExitCode::RunFailed),
            Blessing::Doubtful(told) => (told, ExitCode::Input),
        };
        say(told)?;
        Ok(code)
    }
}
