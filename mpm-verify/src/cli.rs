//! The syntax of the command line, and what it says.

pub(crate) mod run;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};
use mpm_verify::error::Error;
use mpm_verify::run::checkpoint;
use std::io::{self, Write};
use std::path::PathBuf;

/// Verification bench of the locking-free material point method.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
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
        /// Scheme by its name, as `list` and records write it, in place of its parts
        #[arg(long, conflicts_with_all = ["solver", "basis", "remedy", "transfer"])]
        scheme: Option<String>,
        /// Solver: explicit or quasi-static (explicit if the case has it)
        #[arg(long)]
        solver: Option<String>,
        /// Basis functions (gimp; of a quasi-static run those of its first in the case)
        #[arg(long)]
        basis: Option<String>,
        /// Locking remedy (fbar-consistent; likewise)
        #[arg(long)]
        remedy: Option<String>,
        /// Transfer of an explicit run (flip)
        #[arg(long)]
        transfer: Option<String>,
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
        #[arg(long)]
        threads: Option<usize>,
    },
    /// Run a tier of cases, judge them and write the report
    Verify {
        /// The cases (all if none is given)
        cases: Vec<String>,
        /// quick, pr, nightly or long
        #[arg(long, default_value = "pr")]
        tier: String,
        /// Make only the i-th of n shares of the runs; `report` puts the shares together
        #[arg(long, value_name = "I/N")]
        shard: Option<String>,
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
        /// Folder of the goldens
        #[arg(long, default_value = "golden")]
        golden: PathBuf,
        /// Runs side by side (as many as there are cores if not given)
        #[arg(long)]
        threads: Option<usize>,
    },
    /// Judge again what `verify` has left and rebuild the report, without simulating
    Report {
        /// The folder, or those of all shards
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        /// Folder of the report (that of the runs if there is one only)
        #[arg(long)]
        out: Option<PathBuf>,
        /// Folder of the goldens
        #[arg(long, default_value = "golden")]
        golden: PathBuf,
        /// Add this night (YYYY-MM-DD) to the report's history and draw the trends
        #[arg(long, value_name = "DATE", requires = "commit")]
        night: Option<String>,
        /// The commit of that night
        #[arg(long, requires = "night")]
        commit: Option<String>,
    },
    /// Keep of a night's report a row a run, trends and, of all cases, the gist of the summary
    Keep {
        /// Folder of the report
        report: PathBuf,
        /// Folder that has nightly/results.csv, nightly/summary.md and history.csv
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
    /// Draw the pictures of README and docs: errors over cell size and cost from the rows that are kept, and what finished
    /// runs suffice for; the others are named and left
    Pictures {
        /// The folder that `verify` has written, or those of all shards
        #[arg(long, value_name = "FOLDER", num_args = 1..)]
        from: Vec<PathBuf>,
        /// Folder that has docs and reports
        #[arg(long, default_value = ".")]
        root: PathBuf,
    },
    /// Tell which runs of a tier have no row in what is kept of nights (exit code 2), and which rows another program made
    Complete {
        /// quick, pr, nightly or long
        #[arg(long, default_value = "nightly")]
        tier: String,
        /// The rows that `keep` has written
        #[arg(long, default_value = "reports/nightly/results.csv")]
        rows: PathBuf,
    },
    /// Accept drift: take what `verify` has left as the new golden (refused while the truth is missed)
    Bless {
        /// The case
        case: String,
        /// Why the results have changed
        #[arg(long)]
        reason: String,
        /// The folder that `verify` has written, or those of all shards
        #[arg(long, default_value = "reports/latest", num_args = 1..)]
        from: Vec<PathBuf>,
        /// Folder of the goldens
        #[arg(long, default_value = "golden")]
        golden: PathBuf,
        /// Runs side by side (as many as there are cores if not given)
        #[arg(long)]
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
        #[arg(long, default_value_t = 7)]
        rounds: usize,
        /// Numbers of threads, as 1,2 (one and all cores if not given)
        #[arg(long, value_delimiter = ',')]
        threads: Vec<usize>,
        /// Leave out the cost over the number of particles
        #[arg(long)]
        no_scaling: bool,
        /// Compare with other programs: taichi
        #[arg(long)]
        peers: Option<String>,
        /// The Python interpreter that has the peers' packages
        #[arg(long, default_value = "python3", requires = "peers")]
        python: PathBuf,
        /// Folder of the tables and pictures
        #[arg(long, default_value = "reports/bench")]
        out: PathBuf,
    },
}

/// The gist of an error of the command line's syntax.
pub(crate) fn one_line(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        let command = Cli::command();
        let names: Vec<&str> = command.get_subcommands().map(|c| c.get_name()).collect();
        return format!("a command is missing; allowed: {}", names.join(", "));
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

/// Writes to standard output, which may be closed.
pub(crate) fn say(text: &str) -> Result<(), Error> {
    match io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Input(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}
