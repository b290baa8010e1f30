//! The commands `verify` and `report`: runs of a tier, judged and reported.

use super::*;
use mpm_verify::night::Night;
use mpm_verify::report::write_report;
use mpm_verify::study::schedule::{make_runs, require_memory};

#[derive(Args)]
pub(crate) struct Verify {
    /// Names of the cases (default: all)
    #[arg(value_parser = case(), hide_possible_values = true)]
    cases: Vec<&'static Case>,
    /// Tier of the runs
    #[arg(long, default_value = "pr", value_parser = tier())]
    tier: Tier,
    /// Make only the i-th of n shares of the runs; `report` merges the shares
    #[arg(long, value_name = "I/N", value_parser = Shard::parse, default_value = "1/1", hide_default_value = true)]
    shard: Shard,
    /// Keep finished runs made by this very program, and resume from its checkpoints
    #[arg(long)]
    resume: bool,
    /// Checkpoint interval of every run in wall-clock seconds (0: after every row of its series)
    #[arg(long, value_name = "SECONDS", default_value_t = checkpoint::EVERY_S)]
    checkpoint_every: u64,
    /// Keep all files of the runs (default: records, series, and particles and snapshots that a picture shows)
    #[arg(long)]
    all_files: bool,
    /// Folder of the report
    #[arg(long, default_value = "reports/latest")]
    out: PathBuf,
    /// Folder of the goldens (default: ./golden, or that of the source checkout)
    #[arg(long)]
    golden: Option<PathBuf>,
    /// Number of runs side by side (default: number of cores)
    #[arg(long, value_parser = threads())]
    pub(super) threads: Option<usize>,
    /// Memory limit of concurrent scenes at their start, in GiB (default: none)
    #[arg(long, value_name = "GIB", value_parser = memory)]
    memory: Option<f64>,
    #[command(flatten)]
    told: Told,
}

impl Verify {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let chosen = |c: &&Case| self.cases.is_empty() || self.cases.iter().any(|n| n.name == c.name);
        let plan = Plan::new(cases::all().iter().filter(chosen), self.tier, self.shard)?;
        if let Some(gib) = self.memory {
            require_memory(&plan, gib * GIBIBYTE, or_all_cores(self.threads))?;
        }
        let files = if self.all_files { Files::All } else { Files::Shown };
        let saving = saving(self.checkpoint_every, self.resume);
        make_and_report(&plan, (&self.out, files), saving, self.threads, &golden::place(self.golden), self.told)
    }
}

/// Makes the runs of a plan in `out` and reports them there, or prints those of a shard.
pub(super) fn make_and_report(
    plan: &Plan,
    (out, files): (&Path, Files),
    saving: Saving,
    threads: Option<usize>,
    goldens: &Path,
    told: Told,
) -> Result<ExitCode, Error> {
    let names = plan.own().map(|run| run.folder().display().to_string());
    let listener = progress::Runs::new(names.collect(), told.progress());
    // A missing folder of goldens is reported before hours of runs.
    let goldens = Goldens::open(goldens)?;
    let _held = hold(out)?;
    discard_report(out)?;
    let records = make_runs(plan, out, saving, or_all_cores(threads), &listener)?;
    if plan.shard == Shard::WHOLE {
        report_in(&[out.to_path_buf()], (out, files), &goldens, None, told)
    } else {
        tell_shard(plan, &records, told)
    }
}

/// Prints the records of a shard, or those that failed.
fn tell_shard(plan: &Plan, records: &[Record], told: Told) -> Result<ExitCode, Error> {
    let code = records.iter().map(exit_code).max();
    if told.json {
        say_json(&records)?;
        return Ok(code.unwrap_or(ExitCode::Good));
    }
    for record in records.iter().filter(|r| exit_code(r) != ExitCode::Good) {
        say(describe::record(cases::find(&record.case)?, record) + "\n")?;
    }
    say(format!(
        "shard {} of tier {}: {} runs; judge all {} shards together with `mpm-verify report FOLDERS`\n",
        plan.shard,
        plan.tier,
        records.len(),
        plan.shard.count
    ))?;
    Ok(code.unwrap_or(ExitCode::Good))
}

#[derive(Args)]
pub(crate) struct Report {
    /// Folder of the runs, those of all shards, or those of single runs
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Output folder (default: that of the runs, if it is a single one)
    #[arg(long)]
    out: Option<PathBuf>,
    /// Folder of the goldens (default: ./golden, or that of the source checkout)
    #[arg(long)]
    golden: Option<PathBuf>,
    /// Date of the night (YYYY-MM-DD) to add to the report's history
    #[arg(long, value_name = "DATE", requires = "commit")]
    night: Option<String>,
    /// Commit of that night
    #[arg(long, requires = "night")]
    commit: Option<String>,
    #[command(flatten)]
    told: Told,
}

impl Report {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let out = match (self.out, &self.folders[..]) {
            (Some(out), _) => out,
            (None, [folder]) => folder.clone(),
            (None, _) => {
                return Err(Error::Input("several folders need --out for the report".to_owned()));
            }
        };
        let night = self.night.zip(self.commit).map(|(date, commit)| Night::new(&date, &commit)).transpose()?;
        let goldens = Goldens::open(&golden::place(self.golden))?;
        let _held = hold(&out)?;
        report_in(&self.folders, (&out, Files::All), &goldens, night.as_ref(), self.told)
    }
}

/// Judges the runs of `folders` and reports them in `out`, which is held.
fn report_in(
    folders: &[PathBuf],
    (out, files): (&Path, Files),
    goldens: &Goldens,
    night: Option<&Night>,
    told: Told,
) -> Result<ExitCode, Error> {
    discard_report(out)?;
    let gathered = Gathered::read(folders)?;
    let judged = gathered.judge(|r| goldens.compare(r, gathered.folder(r)?))?;
    let summary = write_report(&gathered, judged, goldens, night, (out, files))?;
    match told {
        Told { json: true, .. } => say_json(&describe::verification_json(&summary))?,
        Told { quiet: true, .. } => say(describe::verification_line(&summary))?,
        _ => {
            say(format!("Report: {}\n", out.join("index.html").display()))?;
            say(describe::verification(&summary))?;
        }
    }
    match gathered.gap() {
        Some(gap) => Err(Error::Input(gap.to_owned())),
        None => Ok(summary.exit_code()),
    }
}
