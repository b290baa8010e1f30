//! The syntax of the command line, and what it says.

#[path = "cli/run.rs"]
pub(crate) mod run;
#[path = "cli/score.rs"]
pub(crate) mod score;

use clap::builder::{PossibleValue, PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use mpm_verify::bench;
use mpm_verify::case::{Case, Tier};
use mpm_verify::cases;
use mpm_verify::error::Error;
use mpm_verify::run::checkpoint;
use mpm_verify::scheme::{BasisName, RemedyName, Scheme, TransferName};
use mpm_verify::study::plan::Shard;
use std::fmt::Display;
use std::io::{self, Write};
use std::path::PathBuf;

/// Verification bench of the locking-free material point method.
///
/// Begin with `mpm-verify list`, `mpm-verify run cook --out out` or `mpm-verify verify --tier quick`. Exit codes: 0 all
/// good, 1 a check against the truth failed, 2 usage or input, 3 drift from the goldens only, 4 a run broke down and was
/// not known to.
#[derive(Parser)]
#[command(version, max_term_width = 100, arg_required_else_help = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// A positive number of gibibytes.
fn memory(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("a positive number of GiB is expected".to_owned()),
    }
}

/// How much is said.
#[derive(Args, Clone, Copy)]
pub(crate) struct Told {
    /// Say nothing but the verdict
    #[arg(long, short, conflicts_with = "json")]
    pub(crate) quiet: bool,
    /// Say it as JSON, without progress
    #[arg(long)]
    pub(crate) json: bool,
}

impl Told {
    /// Whether progress is shown.
    pub(crate) fn progress(self) -> bool {
        !self.quiet && !self.json
    }
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// List the cases: what they are, their runs in each tier, what they cost
    List {
        /// List the runs of this tier
        #[arg(long, value_parser = tier())]
        tier: Option<Tier>,
        /// As text or as JSON
        #[arg(long, default_value = "text", value_parser = ["text", "json"])]
        format: String,
    },
    /// Parameters, schemes, levels, metrics, checks, references and limits of a case
    Explain {
        /// The case
        #[arg(value_parser = case(), hide_possible_values = true)]
        case: &'static Case,
        /// Say it as JSON
        #[arg(long)]
        json: bool,
    },
    /// Run one case once, judge it and, with --out, draw it
    Run {
        /// The case
        #[arg(value_parser = case(), hide_possible_values = true)]
        case: &'static Case,
        /// Scheme by its name, as `explain` and records write it, in place of its parts
        #[arg(long, value_parser = Schemes, hide_possible_values = true,
            conflicts_with_all = ["solver", "basis", "remedy", "transfer"])]
        scheme: Option<Scheme>,
        /// Solver (explicit if the case has it)
        #[arg(long, value_parser = Scheme::SOLVERS.to_vec())]
        solver: Option<String>,
        /// Basis functions (gimp; of a quasi-static run those of its first in the case)
        #[arg(long, value_parser = one_of(BasisName::NAMES, BasisName::parse))]
        basis: Option<BasisName>,
        /// Locking remedy (fbar-consistent; likewise)
        #[arg(long, value_parser = one_of(RemedyName::NAMES, RemedyName::parse))]
        remedy: Option<RemedyName>,
        /// Transfer of an explicit run (flip)
        #[arg(long, value_parser = one_of(TransferName::NAMES, TransferName::parse))]
        transfer: Option<TransferName>,
        /// Level of refinement (the coarsest if not given)
        #[arg(long)]
        level: Option<String>,
        /// Change a parameter
        #[arg(long = "set", value_name = "NAME=VALUE")]
        set: Vec<String>,
        /// Perturb every initial coordinate by one unit in the last place
        #[arg(long)]
        perturb: bool,
        /// Folder for record, series, particles, VTU and pictures
        #[arg(long, group = "folder")]
        out: Option<PathBuf>,
        /// In place of --out: go on in this folder from the checkpoint that the same run has left there,
        /// with the same results to the last bit; begin if there is none
        #[arg(long, value_name = "DIR", group = "folder")]
        resume: Option<PathBuf>,
        /// Write a checkpoint so often, by the clock; 0: after every row of the series
        #[arg(long, value_name = "SECONDS", default_value_t = checkpoint::EVERY_S, requires = "folder")]
        checkpoint_every: u64,
        /// Threads (all cores if not given)
        #[arg(long, value_parser = threads())]
        threads: Option<usize>,
        /// Refuse a scene that takes more memory at its start (what the machine has to give if not said)
        #[arg(long, value_name = "GIB", value_parser = memory)]
        memory: Option<f64>,
        #[command(flatten)]
        told: Told,
    },
    /// Run a scene of one's own that a file describes and, with --out, draw it
    Scene {
        /// The scene file, in TOML: docs/reference/scene-files.md
        file: PathBuf,
        /// Folder for record, series, particles, VTU and pictures
        #[arg(long, group = "folder")]
        out: Option<PathBuf>,
        /// In place of --out: go on in this folder from the checkpoint that the same scene has left there
        #[arg(long, value_name = "DIR", group = "folder")]
        resume: Option<PathBuf>,
        /// Write a checkpoint so often, by the clock; 0: after every row of the series
        #[arg(long, value_name = "SECONDS", default_value_t = checkpoint::EVERY_S, requires = "folder")]
        checkpoint_every: u64,
        /// Refuse a scene that takes more memory at its start (what the machine has to give if not said)
        #[arg(long, value_name = "GIB", value_parser = memory)]
        memory: Option<f64>,
        /// Threads (all cores if not given)
        #[arg(long, value_parser = threads())]
        threads: Option<usize>,
        #[command(flatten)]
        told: Told,
    },
    /// Judge the result of another code, beside our runs
    Score {
        /// Folder with score.json and the tables that it names: docs/how-to/score.md
        folder: PathBuf,
        /// Folder for the verdicts as a page and as JSON
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        told: Told,
    },
    /// Write what another code needs to solve a case: particles, parameters, reference, a form for `score`
    Export {
        /// The case
        #[arg(value_parser = scored_cases())]
        case: String,
        /// Level of refinement (the coarsest if not given)
        #[arg(long)]
        level: Option<String>,
        /// Change a parameter
        #[arg(long = "set", value_name = "NAME=VALUE")]
        set: Vec<String>,
        /// Folder for it
        #[arg(long)]
        out: PathBuf,
    },
    /// Run a tier of cases, judge them and write the report
    Verify {
        /// The cases (all if none is given)
        #[arg(value_parser = case(), hide_possible_values = true)]
        cases: Vec<&'static Case>,
        /// Which runs
        #[arg(long, default_value = "pr", value_parser = tier())]
        tier: Tier,
        /// Make only the i-th of n shares of the runs; `report` puts the shares together
        #[arg(long, value_name = "I/N", value_parser = Shard::parse, default_value = "1/1", hide_default_value = true)]
        shard: Shard,
        /// Keep the runs that are there already, if this very program made them, and go on with those that
        /// it has left a checkpoint of
        #[arg(long)]
        resume: bool,
        /// Write a checkpoint of every run so often, by the clock; 0: after every row of its series
        #[arg(long, value_name = "SECONDS", default_value_t = checkpoint::EVERY_S)]
        checkpoint_every: u64,
        /// Folder of the report
        #[arg(long, default_value = "reports/latest")]
        out: PathBuf,
        /// Folder of the goldens (./golden, else that of the checkout that the program was built from)
        #[arg(long)]
        golden: Option<PathBuf>,
        /// Runs side by side (as many as there are cores if not given)
        #[arg(long, value_parser = threads())]
        threads: Option<usize>,
        /// Refuse scenes that take more memory at their start, side by side (not asked if not said)
        #[arg(long, value_name = "GIB", value_parser = memory)]
        memory: Option<f64>,
        #[command(flatten)]
        told: Told,
    },
    /// Judge again what `verify` or `run` has left and rebuild the report, without simulating
    Report {
        /// The folder, or those of all shards
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        /// Folder of the report (that of the runs if there is one only)
        #[arg(long)]
        out: Option<PathBuf>,
        /// Folder of the goldens (./golden, else that of the checkout that the program was built from)
        #[arg(long)]
        golden: Option<PathBuf>,
        /// Add this night (YYYY-MM-DD) to the report's history
        #[arg(long, value_name = "DATE", requires = "commit")]
        night: Option<String>,
        /// The commit of that night
        #[arg(long, requires = "night")]
        commit: Option<String>,
        #[command(flatten)]
        told: Told,
    },
    /// Keep a row of every run of a night's report, and its trends
    Keep {
        /// Folder of the report
        report: PathBuf,
        /// Folder that has nightly/results.csv and history.csv
        #[arg(long, default_value = "reports")]
        into: PathBuf,
    },
    /// Fill the tables of results in README and docs from reports/nightly/results.csv
    Tables {
        /// Change nothing; name the tables that are stale, and fail if there are any
        #[arg(long)]
        check: bool,
        /// Folder that has README.md, docs and reports
        #[arg(long, default_value = ".")]
        root: PathBuf,
    },
    /// Draw the pictures of README and docs from the rows that are kept and from finished runs
    ///
    /// What they do not suffice for is named and left.
    Pictures {
        /// The folder that `verify` has written, or those of all shards
        #[arg(long, value_name = "FOLDER", num_args = 1..)]
        from: Vec<PathBuf>,
        /// Folder that has docs and reports
        #[arg(long, default_value = ".")]
        root: PathBuf,
    },
    /// Name the runs of a tier that no kept row is of (exit code 2), and the rows that another program made
    Complete {
        /// Which runs
        #[arg(long, default_value = "nightly", value_parser = tier())]
        tier: Tier,
        /// The rows that `keep` has written
        #[arg(long, default_value = "reports/nightly/results.csv")]
        rows: PathBuf,
    },
    /// Accept drift: take what `verify` has left as the new golden (refused while the truth is missed)
    Bless {
        /// The case
        #[arg(value_parser = case(), hide_possible_values = true)]
        case: &'static Case,
        /// Why the results have changed
        #[arg(long)]
        reason: String,
        /// The folder that `verify` has written, or those of all shards
        #[arg(long, default_value = "reports/latest", num_args = 1..)]
        from: Vec<PathBuf>,
        /// Folder of the goldens (./golden, else that of the checkout that the program was built from)
        #[arg(long)]
        golden: Option<PathBuf>,
        /// Bless this quantity although it is doubtful
        #[arg(long, value_name = "METRIC")]
        allow: Vec<String>,
        /// Runs side by side (as many as there are cores if not given)
        #[arg(long, value_parser = threads())]
        threads: Option<usize>,
    },
    /// Compare two report folders: numbers, verdicts, pictures
    Diff {
        /// The old report
        old: PathBuf,
        /// The new report
        new: PathBuf,
        /// Folder for the comparison with its pictures (old | new | difference)
        #[arg(long)]
        out: Option<PathBuf>,
        #[command(flatten)]
        told: Told,
    },
    /// Evaluate an exact solution at a reference point, as JSON
    Exact {
        /// The solution
        name: String,
        /// Reference coordinates (m), as many as the motion has dimensions
        #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
        at: String,
        /// Time (s)
        #[arg(long, allow_hyphen_values = true)]
        time: String,
        /// Change a parameter
        #[arg(long = "set", value_name = "NAME=VALUE")]
        set: Vec<String>,
    },
    /// Measure speed: workloads, problems and laws take turns; with --peers, other programs with them
    Bench {
        /// Rounds, after one that isn't measured
        #[arg(long, default_value_t = 7, value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
        rounds: usize,
        /// Numbers of threads, as 1,2 (one and all cores if not given)
        #[arg(long, value_delimiter = ',', value_parser = threads())]
        threads: Vec<usize>,
        /// Measure these alone, as newton,laws (all if not given); `scaling` is the cost over the number of particles
        #[arg(long, value_delimiter = ',', value_parser = PossibleValuesParser::new(bench::GROUPS))]
        only: Vec<String>,
        /// Compare with other programs
        #[arg(long, value_parser = ["taichi"])]
        peers: Option<String>,
        /// The Python interpreter that has the peers' packages
        #[arg(long, default_value = "python3", requires = "peers")]
        python: PathBuf,
        /// Folder of the tables and pictures
        #[arg(long, default_value = "reports/bench")]
        out: PathBuf,
    },
    /// Print what makes a shell complete the program's commands, options and names
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// One of some names, as what it stands for.
fn one_of<T, E>(
    names: &'static [&'static str],
    parse: fn(&str) -> Result<T, E>,
) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
    E: std::error::Error + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).try_map(move |name| parse(&name))
}

fn tier() -> impl TypedValueParser<Value = Tier> {
    one_of(&Tier::NAMES, Tier::parse)
}

fn case() -> impl TypedValueParser<Value = &'static Case> {
    let value = |case: &Case| PossibleValue::new(case.name).help(case.title);
    let names = cases::all().iter().map(value);
    PossibleValuesParser::new(names).try_map(|name| cases::find(&name))
}

/// The cases that score other codes.
fn scored_cases() -> PossibleValuesParser {
    PossibleValuesParser::new(cases::scored().map(|(case, _)| case.name))
}

/// More than four times as many threads as cores are surely a slip.
fn threads() -> RangedU64ValueParser<usize> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    RangedU64ValueParser::new().range(1..=4 * cores as u64)
}

/// Schemes by their names, of which shells complete those of all cases.
#[derive(Clone)]
struct Schemes;

impl TypedValueParser for Schemes {
    type Value = Scheme;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<Scheme, clap::Error> {
        let parse = |name: &str| Scheme::parse(name);
        parse.parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let schemes = cases::all().iter().flat_map(Case::schemes);
        let names: std::collections::BTreeSet<String> = schemes.map(|s| s.to_string()).collect();
        Some(Box::new(names.into_iter().map(PossibleValue::new)))
    }
}

/// An error of the command line's syntax, on one line.
pub(crate) fn of_syntax(error: &clap::Error) -> String {
    let text = error.to_string();
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage") && !line.starts_with("For more information"))
        .filter(|line| !line.is_empty())
        .collect();
    lines.join(" ").trim_start_matches("error: ").to_owned()
}

/// Writes to standard output, which may be closed; colours stay on a terminal that shows them.
pub(crate) fn say(text: impl Display) -> Result<(), Error> {
    match write!(anstream::stdout().lock(), "{text}") {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Input(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

/// Writes JSON to standard output.
pub(crate) fn say_json(value: &impl serde::Serialize) -> Result<(), Error> {
    let text = serde_json::to_string_pretty(value).map_err(|e| Error::Input(e.to_string()))?;
    say(text + "\n")
}
