//! The syntax of the command line and the output of its commands.

mod bench;
mod bless;
mod diff;
mod explain;
mod factor;
mod keep;
mod run;
mod score;
mod verify;

use crate::progress;
use clap::builder::{PossibleValue, PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use mpm_verify::case::{Case, Tier, find_level};
use mpm_verify::cases;
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::files::lock::hold;
use mpm_verify::golden::{self, Goldens};
use mpm_verify::record::{Record, Version};
use mpm_verify::report::{Files, describe, discard_report};
use mpm_verify::run::checkpoint::{self, Saving};
use mpm_verify::scheme::{BasisName, Scheme};
use mpm_verify::size::GIBIBYTE;
use mpm_verify::spec::RunSpec;
use mpm_verify::study::gather::Gathered;
use mpm_verify::study::judge::exit_code;
use mpm_verify::study::plan::{Plan, Shard};
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Verification bench of the locking-free material point method.
///
/// Start with `mpm-verify list`, `mpm-verify run cook --out out` or `mpm-verify verify --tier quick`. Exit codes: 0
/// success, 1 a check against the truth failed, 2 usage or input error, 3 drift from the goldens only, 4 unexpected
/// breakdown of a run.
#[derive(Parser)]
#[command(version, max_term_width = 100, arg_required_else_help = true, before_help = commands())]
#[command(help_template = "{about-with-newline}\n{usage-heading} {usage}\n\n{before-help}Options:\n{options}")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands by purpose.
const COMMANDS: [(&str, &str); 3] = [
    ("Run", "list explain run scene factor exact"),
    ("Judge", "verify report diff export score board"),
    ("Maintain", "bless keep tables pictures complete bench completions"),
];

fn commands() -> String {
    let all = Command::augment_subcommands(clap::Command::new(""));
    let line = |command: &clap::Command| {
        format!("  {:<11} {}\n", command.get_name(), command.get_about().map(ToString::to_string).unwrap_or_default())
    };
    let group = |(title, names): (&str, &str)| {
        let lines = names.split(' ').filter_map(|name| all.find_subcommand(name)).map(line);
        format!("{title}:\n{}", lines.collect::<String>())
    };
    COMMANDS.map(group).join("\n")
}

/// A positive number of gibibytes.
fn memory(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("a positive number of GiB is expected".to_owned()),
    }
}

/// Verbosity.
#[derive(Args, Clone, Copy)]
pub(crate) struct Told {
    /// Print the verdict only
    #[arg(long, short, conflicts_with = "json")]
    pub(crate) quiet: bool,
    /// Print JSON, without progress
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
    /// List the cases: titles, runs in each tier, cost
    List(explain::List),
    /// Print parameters, schemes, levels, metrics, checks, references and limits of a case
    Explain(explain::Explain),
    /// Run a case once, judge it and, with --out, draw it
    Run(run::Run),
    /// Run your own scene from a file and, with --out, draw it
    Scene(run::Scene),
    /// Divide the strength of your own scene until it fails: its factor of safety
    Factor(factor::Factor),
    /// Judge the result of another code and compare it with our runs
    Score(score::Score),
    /// Compare results of several codes and ours: error, cost and verdict by one rule
    Board(score::Board),
    /// Write the input of a case for another code, with a form for `score`
    Export(score::Export),
    /// Run a tier of cases, judge them and write the report
    Verify(verify::Verify),
    /// Judge the runs of `verify` or `run` again and rebuild the report, without simulating
    Report(verify::Report),
    /// Store one row per run of a night's report, and its trends
    Keep(keep::Keep),
    /// Fill the result tables in README and docs from reports/nightly/results.csv
    Tables(keep::Tables),
    /// Draw the pictures of README and docs from stored rows and finished runs
    ///
    /// Pictures that need other runs are listed and left unchanged.
    Pictures(keep::Pictures),
    /// List planned runs without a stored result and results of other programs (exit code 2)
    Complete(keep::Complete),
    /// Accept changed results as the new golden (refused while a TRUTH check fails)
    Bless(bless::Bless),
    /// Compare two report folders: numbers, verdicts, pictures
    Diff(diff::Diff),
    /// Evaluate an exact solution at a reference point, as JSON
    Exact(explain::Exact),
    /// Measure the speed of workloads, problems and laws; with --peers, of other programs too
    Bench(bench::Bench),
    /// Print a shell completion script
    Completions(explain::Completions),
}

impl Command {
    /// Requested number of threads of a command that runs simulations.
    pub(crate) fn threads(&self) -> Option<usize> {
        match self {
            Self::Run(command) => command.making.threads,
            Self::Scene(command) => command.making.threads,
            Self::Factor(command) => command.making.threads,
            Self::Verify(command) => command.threads,
            Self::Bless(command) => command.threads,
            _ => None,
        }
    }
}

macro_rules! execute {
    ($($command:ident)*) => {
        impl Command {
            pub(crate) fn execute(self) -> Result<ExitCode, Error> {
                match self { $(Self::$command(command) => command.execute()),* }
            }
        }
    };
}

execute! {
    List Explain Run Scene Factor Score Board Export Verify Report Keep Tables Pictures Complete Bless Diff Exact Bench
    Completions
}

/// Number of threads: all cores by default.
pub(crate) fn or_all_cores(threads: Option<usize>) -> usize {
    threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
}

fn saving(seconds: u64, resume: bool) -> Saving {
    Saving { every: Duration::from_secs(seconds), resume }
}

/// Parser of one of `names` into its value.
fn one_of<T, E>(names: &'static [&'static str], parse: fn(&str) -> Result<T, E>) -> impl TypedValueParser<Value = T>
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
    let names = cases::all().iter().map(|case| PossibleValue::new(case.name).help(case.title));
    PossibleValuesParser::new(names).try_map(|name| cases::find(&name))
}

fn scored_cases() -> PossibleValuesParser {
    PossibleValuesParser::new(cases::scored().map(|(case, _)| case.name))
}

/// Number of threads, at most four per core; more is almost certainly a typo.
fn threads() -> RangedU64ValueParser<usize> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    RangedU64ValueParser::new().range(1..=4 * cores as u64)
}

/// Parser of scheme names; shells complete the schemes of all cases.
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

/// An error of the command line's syntax, on one line: allowed values, of which there may be many, come last.
pub(crate) fn of_syntax(error: &clap::Error) -> String {
    let text = error.to_string();
    let mut lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage") && !line.starts_with("For more information"))
        .filter(|line| !line.is_empty())
        .collect();
    lines.sort_by_key(|line| line.starts_with("[possible values"));
    lines.join(" ").trim_start_matches("error: ").to_owned()
}

/// Writes to standard output, which may be closed; colours stay on a terminal that shows them.
pub(crate) fn say(text: impl Display) -> Result<(), Error> {
    match write!(anstream::stdout().lock(), "{text}") {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(Error::Input(format!("standard output: {e}"))),
        _ => Ok(()),
    }
}

/// Writes JSON to standard output.
pub(crate) fn say_json(value: &impl serde::Serialize) -> Result<(), Error> {
    let text = serde_json::to_string_pretty(value).map_err(|e| Error::Input(e.to_string()))?;
    say(text + "\n")
}
