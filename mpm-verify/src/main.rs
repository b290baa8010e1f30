//! The program `mpm-verify`: from its command line to the library.

mod cli;
mod progress;

use clap::Parser;
use clap::error::ErrorKind;
use cli::{Cli, of_syntax, or_all_cores};
use mpm_core::number::FUSED;
use mpm_verify::error::{Error, ExitCode, one_line};
use std::io::{self, Write};

/// Note that a build without fused multiply-adds prints when it starts.
const SLOW: &str = "note: built without AVX2 and fused multiply-adds: steps take more than twice as long, and last digits \
    differ. Build with RUSTFLAGS=\"-C target-cpu=native\"; a checkout does so by itself.";

fn main() -> std::process::ExitCode {
    if !FUSED {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "{SLOW}");
    }
    let outcome = match Cli::try_parse() {
        Ok(cli) => bound_threads(cli.command.threads()).and_then(|()| cli.command.execute()),
        Err(help) if help.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            // Nothing more can be done if stderr is closed.
            let _ = help.print();
            Ok(ExitCode::Input)
        }
        Err(error) if error.use_stderr() => Err(Error::Input(of_syntax(&error))),
        // A reader that is gone has read enough.
        Err(help) => match help.print() {
            Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(Error::Input(e.to_string())),
            _ => Ok(ExitCode::Good),
        },
    };
    let code = outcome.unwrap_or_else(|error| {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "error: {}", one_line(&error.to_string()));
        ExitCode::Input
    });
    std::process::ExitCode::from(code as u8)
}

/// Bounds what starts besides the threads of a run, whatever the environment says.
fn bound_threads(asked: Option<usize>) -> Result<(), Error> {
    let threads = or_all_cores(asked).min(or_all_cores(None));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build_global().map_err(|e| Error::Input(format!("{threads} threads can't be started: {e}")))
}
