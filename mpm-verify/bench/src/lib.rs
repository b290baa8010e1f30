//! Speed of the solvers: workloads, problems, laws and other programs take turns on one machine.
//!
//! Wall times of a shared machine are noise. So every round runs a slice of each thing, ratios are formed within a round,
//! and their median and range over the rounds are the result.

pub mod aims;
mod laws;
mod local;
mod machine;
mod measured;
pub mod model;
pub mod newton;
mod peer;
mod problems;
mod run;
mod turn;
mod workload;

pub use machine::processor;
pub use measured::{Measured, Measurements, Sample, Spread};
pub use peer::Peers;
pub use run::{Begin, Run};
pub use turn::Error;

use turn::{Turn, take_turns};

/// Groups that can be measured by themselves.
pub const GROUPS: [&str; 5] = ["workloads", "problems", "newton", "laws", "scaling"];

/// Options of a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Rounds.
    pub rounds: usize,
    /// Numbers of threads to compare, one first.
    pub threads: Vec<usize>,
    /// The [groups](GROUPS) that are measured, all if none is named.
    pub only: Vec<String>,
    /// Other programs to compare with.
    pub peers: Option<Peers>,
}

/// Those that take turns with each other.
type Group = fn(&Options, Begin) -> Result<Vec<Turn>, Error>;

/// Measures what the options ask for. `progress` gets the share that is done.
///
/// # Errors
/// A scene breaks down, or a peer can't be started.
pub fn measure(options: &Options, begin: Begin, progress: &dyn Fn(f64)) -> Result<Measurements, Error> {
    // Groups whose ratios matter take turns; one after the other, so that what waits doesn't fill the memory.
    let groups: [&[Group]; 5] = [
        &[|options, _| together(options)],
        &[|options, begin| problems::turns(&options.threads, begin)],
        &[|_, begin| newton::turns(begin)],
        &[|_, _| laws::turns()],
        &[|_, _| workload::scaling::<2>(), |_, _| workload::scaling::<3>()],
    ];
    let only = &options.only;
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    let named = GROUPS.into_iter().zip(groups);
    let groups: Vec<&Group> = named.filter(|(name, _)| wanted(name)).flat_map(|(_, groups)| groups).collect();
    let count = groups.len() as f64;
    let mut measured = Vec::new();
    for (k, group) in groups.iter().enumerate() {
        let share = |done: f64| progress((k as f64 + done) / count);
        let turns = group(options, begin)?;
        measured.extend(take_turns(turns, options.rounds, &share)?);
    }
    Ok(Measurements(measured))
}

/// Workloads, those of the peers and what memory gives.
fn together(options: &Options) -> Result<Vec<Turn>, Error> {
    let mut turns = machine::turns(&options.threads)?;
    workload::turns(&options.threads, &mut turns)?;
    if let Some(peers) = &options.peers {
        peers.turns(&options.threads, &mut turns)?;
    }
    Ok(turns)
}

#[cfg(test)]
mod tests;
