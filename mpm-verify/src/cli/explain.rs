//! The commands `list`, `explain`, `exact` and `completions`: what the program knows.

use super::*;
use clap::CommandFactory;
use clap_complete::Shell;
use mpm_verify::exact;

#[derive(Args)]
pub(crate) struct List {
    /// List the runs of this tier
    #[arg(long, value_parser = tier())]
    tier: Option<Tier>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl List {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        if self.json {
            return say_json(&describe::list_json(cases::all(), self.tier)).map(|()| ExitCode::Good);
        }
        let goldens = golden::place(None);
        say(describe::list_text(cases::all(), self.tier, |case| golden::pairs(&goldens, case).ok()))?;
        Ok(ExitCode::Good)
    }
}

#[derive(Args)]
pub(crate) struct Explain {
    /// Name of the case
    #[arg(value_parser = case(), hide_possible_values = true)]
    case: &'static Case,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Explain {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        match self.json {
            true => say_json(&describe::explain_json(self.case))?,
            false => say(describe::explain(self.case))?,
        }
        Ok(ExitCode::Good)
    }
}

#[derive(Args)]
pub(crate) struct Exact {
    /// Name of the solution
    name: String,
    /// Reference coordinates (m), one per dimension of the motion
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    at: String,
    /// Time (s)
    #[arg(long, allow_hyphen_values = true)]
    time: String,
    /// Value of a parameter, in place of its default
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
}

impl Exact {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        say(exact::State::ask(&self.name, &self.at, &self.time, &self.set)?.json()?).map(|()| ExitCode::Good)
    }
}

#[derive(Args)]
pub(crate) struct Completions {
    /// Name of the shell
    shell: Shell,
}

impl Completions {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "mpm-verify", &mut script);
        say(String::from_utf8_lossy(&script)).map(|()| ExitCode::Good)
    }
}
