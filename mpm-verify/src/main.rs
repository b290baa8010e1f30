//! The command line: `mpm-verify list | explain | run | verify | report`.

mod progress;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use mpm_verify::case::{Case, RunSpec, Tier, find_level};
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::record::{Record, Status};
use mpm_verify::report::{describe, write_report};
use mpm_verify::scheme::{BasisName, RemedyName, Scheme, TransferName};
use mpm_verify::study::{has_truth, judge_again, verify};
use mpm_verify::{cases, run};
use std::io::{self, Write};
use std::path::PathBuf;

/// Verification bench of the locking-free material point method.
#[derive(Debug, Parser)]
#[command(version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the cases with their schemes and levels
    List {
        /// Only the runs of this tier: quick, pr, nightly, long
        #[arg(long)]
        tier: Option<String>,
        /// text or json
        #[arg(long, default_value = "text")]
        format: String,
    },
    /// Parameters, schemes, levels, metrics, checks, references and limits of a case
    Explain {
        /// The case
        case: String,
    },
    /// Run one case once
    Run {
        /// The case
        case: String,
        /// Basis functions
        #[arg(long, default_value = "gimp")]
        basis: String,
        /// Locking remedy
        #[arg(long, default_value = "fbar-rate")]
        remedy: String,
        /// Transfer
        #[arg(long, default_value = "flip")]
        transfer: String,
        /// Level of refinement (the coarsest if not given)
        #[arg(long)]
        level: Option<String>,
        /// Change a parameter
        #[arg(long = "set", value_name = "NAME=VALUE")]
        set: Vec<String>,
        /// Start every particle a last bit beside its place
        #[arg(long)]
        perturb: bool,
        /// Folder for record, series, particles and VTU
        #[arg(long)]
        out: Option<PathBuf>,
        /// Threads (all cores if not given)
        #[arg(long)]
        threads: Option<usize>,
    },
    /// Judge the records of a report folder again and rebuild its pictures, tables and summary
    Report {
        /// The folder, as `verify` left it
        folder: PathBuf,
    },
    /// Run a tier of cases, judge them and write the report
    Verify {
        /// The cases (all if none is given)
        cases: Vec<String>,
        /// quick, pr, nightly or long
        #[arg(long, default_value = "pr")]
        tier: String,
        /// Folder of the report
        #[arg(long, default_value = "reports/latest")]
        out: PathBuf,
        /// Runs side by side (as many as there are cores if not given)
        #[arg(long)]
        threads: Option<usize>,
    },
}

fn main() -> std::process::ExitCode {
    let outcome = match Cli::try_parse() {
        Ok(cli) => dispatch(cli.command),
        Err(error) if error.use_stderr() => Err(Error::Input(one_line(&error))),
        Err(help) => help
            .print()
            .map(|()| ExitCode::Good)
            .map_err(|e| Error::Input(e.to_string())),
    };
    let code = outcome.unwrap_or_else(|error| {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "error: {error}");
        ExitCode::Input
    });
    std::process::ExitCode::from(code as u8)
}

/// More threads than this are surely a slip.
const MAX_THREADS: usize = 1024;

/// The gist of an error of the command line's syntax.
fn one_line(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "a command is missing; allowed: list, explain, run, report, verify".to_owned();
    }
    let text = error.to_string();
    let lines: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage"))
        .filter(|line| !line.is_empty())
        .collect();
    lines.join(" ").trim_start_matches("error: ").to_owned()
}

fn say(text: &str) -> Result<(), Error> {
    match io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Input(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

fn parse_tier(name: &str) -> Result<Tier, Error> {
    let tiers = [Tier::Quick, Tier::Pr, Tier::Nightly, Tier::Long];
    tiers
        .into_iter()
        .find(|t| t.to_string() == name)
        .ok_or_else(|| Error::unknown("tier", name, ["quick", "pr", "nightly", "long"]))
}

fn parse_threads(threads: Option<usize>) -> Result<usize, Error> {
    match threads {
        Some(n) if !(1..=MAX_THREADS).contains(&n) => Err(Error::Input(format!(
            "--threads {n} is not allowed; allowed: 1 to {MAX_THREADS}"
        ))),
        Some(n) => Ok(n),
        None => Ok(std::thread::available_parallelism().map_or(1, usize::from)),
    }
}

fn dispatch(command: Command) -> Result<ExitCode, Error> {
    match command {
        Command::List { tier, format } => list(tier.as_deref(), &format),
        Command::Explain { case } => {
            say(&describe::explain(cases::find(&case)?))?;
            Ok(ExitCode::Good)
        }
        Command::Run {
            case,
            basis,
            remedy,
            transfer,
            level,
            set,
            perturb,
            out,
            threads,
        } => {
            let case = cases::find(&case)?;
            let scheme = Scheme {
                basis: BasisName::parse(&basis)?,
                remedy: RemedyName::parse(&remedy)?,
                transfer: TransferName::parse(&transfer)?,
            };
            let level = match level {
                Some(name) => find_level(case, &name)?,
                None => case.levels()[0],
            };
            let spec = RunSpec {
                scheme,
                level,
                set,
                perturbed: perturb,
            };
            run_one(case, &spec, out.as_deref(), parse_threads(threads)?)
        }
        Command::Report { folder } => {
            let summary = judge_again(&folder)?;
            write_report(&summary, &folder)?;
            say(&describe::verdict_summary(&summary))?;
            Ok(summary.exit_code())
        }
        Command::Verify {
            cases: names,
            tier,
            out,
            threads,
        } => {
            let chosen = if names.is_empty() {
                cases::all()
            } else {
                let mut names = names;
                names.sort();
                names.dedup();
                names
                    .iter()
                    .map(|name| cases::find(name))
                    .collect::<Result<_, _>>()?
            };
            let tier = parse_tier(&tier)?;
            verify_all(&chosen, tier, &out, parse_threads(threads)?)
        }
    }
}

fn list(tier: Option<&str>, format: &str) -> Result<ExitCode, Error> {
    let tier = tier.map(parse_tier).transpose()?;
    let text = match format {
        "text" => describe::list_text(&cases::all(), tier),
        "json" => describe::list_json(&cases::all(), tier),
        other => return Err(Error::unknown("format", other, ["text", "json"])),
    };
    say(&text)?;
    Ok(ExitCode::Good)
}

fn run_one(
    case: &'static dyn Case,
    spec: &RunSpec,
    out: Option<&std::path::Path>,
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
    let bar = progress::single(&format!("{} {}", case.name(), spec.folder()));
    let record = run::execute(case, spec, out, threads, &|share| {
        bar.set_position((share * progress::SCALE) as u64);
    })?;
    bar.finish_and_clear();
    say(&describe::record(&record))?;
    if !has_truth(&record) {
        say("No check against the truth applies to this run.\n")?;
    }
    Ok(exit_code(&record))
}

fn exit_code(record: &Record) -> ExitCode {
    if record.status == Status::Failed {
        ExitCode::RunFailed
    } else if record.verdicts.iter().any(|v| v.failed()) {
        ExitCode::TruthFailed
    } else {
        ExitCode::Good
    }
}

fn verify_all(
    chosen: &[&dyn Case],
    tier: Tier,
    out: &std::path::Path,
    workers: usize,
) -> Result<ExitCode, Error> {
    let listener = progress::Plan::new(chosen, tier);
    let summary = verify(chosen, tier, out, workers, &listener)?;
    listener.finish();
    write_report(&summary, out)?;
    say(&describe::verdict_summary(&summary))?;
    say(&format!("Report: {}\n", out.join("summary.md").display()))?;
    Ok(summary.exit_code())
}
