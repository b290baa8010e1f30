//! The command `bench`: speed.

use super::*;
use crate::progress::Teller;
use clap::builder::{PossibleValuesParser, RangedU64ValueParser};
use mpm_verify::bench::{self, Peers};

#[derive(Args)]
pub(crate) struct Bench {
    /// Number of measured rounds, after one unmeasured
    #[arg(long, default_value_t = 7, value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
    rounds: usize,
    /// Numbers of threads, as 1,2 (default: one and all cores)
    #[arg(long, value_delimiter = ',', value_parser = threads())]
    threads: Vec<usize>,
    /// Groups to measure, as newton,laws (default: all); `scaling` is the cost over the number of particles
    #[arg(long, value_delimiter = ',', value_parser = PossibleValuesParser::new(bench::GROUPS))]
    only: Vec<String>,
    /// Other programs to compare with
    #[arg(long, value_parser = ["taichi"])]
    peers: Option<String>,
    /// Python interpreter with the peers' packages
    #[arg(long, default_value = "python3", requires = "peers")]
    python: PathBuf,
    /// Folder of the tables and pictures
    #[arg(long, default_value = "reports/bench")]
    out: PathBuf,
}

impl Bench {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let mut threads = if self.threads.is_empty() { vec![or_all_cores(None)] } else { self.threads };
        threads.push(1);
        threads.sort_unstable();
        threads.dedup();
        let options = bench::Options {
            rounds: self.rounds,
            threads,
            only: self.only,
            peers: self.peers.map(|_| Peers::taichi(self.python)),
        };
        let _held = hold(&self.out)?;
        let teller = Teller::new("bench", true);
        say(&bench::measure(&options, &self.out, &|share| teller.hear(|_| format!("{:.0} %", 100.0 * share)))?)?;
        Ok(ExitCode::Good)
    }
}
