//! Speed of the solvers: workloads, problems, laws and other programs take turns on one machine.
//!
//! Wall times of a shared machine are noise. So every round runs a slice of each `Timed` thing, ratios are formed within
//! a round, and their median and range over the rounds are the result.

pub mod aims;
mod laws;
mod local;
mod machine;
pub mod model;
pub mod newton;
mod peer;
mod problems;
mod workload;

pub use machine::processor;
pub use peer::Peers;

use mpm_core::{Memory, Spent};
use mpm_solvers::scheme::Scheme;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Instant;

/// Groups that can be measured by themselves.
pub const GROUPS: [&str; 5] = ["workloads", "problems", "newton", "laws", "scaling"];

/// Reason why something cannot be measured.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// A running simulation of a verification case.
pub trait Run: Send {
    /// Runs to the next time of observation.
    ///
    /// # Errors
    /// The computation broke down.
    fn advance(&mut self) -> Result<(), Error>;
    /// Whether the run is complete.
    fn finished(&self) -> bool;
    /// Number of particles.
    fn particles(&self) -> u64;
    /// Particle updates so far.
    fn particle_steps(&self) -> u64;
    /// Newton iterations so far.
    fn newton_iterations(&self) -> u64;
    /// Time that the parts of the Newton iterations took so far.
    fn spent(&self) -> Spent;
    /// State of the run.
    fn memory(&self) -> &dyn Memory;
}

/// Begins a run of a case at a level with a scheme and the case's own parameters.
pub type Begin = fn(&str, &str, Scheme) -> Result<Box<dyn Run>, Error>;

/// What is to be measured.
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

/// A slice of work.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sample {
    /// Particle updates; of Newton's method, iterations; of laws, particles; of memory, bytes.
    pub updates: u64,
    /// Wall time (s).
    pub wall_s: f64,
    /// Processor time of all threads (s).
    pub cpu_s: f64,
}

/// Something that is run slice by slice.
trait Timed {
    /// Runs the next slice.
    fn slice(&mut self) -> Result<Sample, Error>;
    /// What it has come to, to be compared with another that has done the same; `None` if there is nothing to compare.
    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(None)
    }
    /// Ends it and tells the memory (bytes) that it held; `None` of another program.
    fn held(self: Box<Self>) -> Option<u64> {
        None
    }
}

/// What something has come to.
#[derive(Debug, Clone, PartialEq, Default)]
struct Outcome {
    /// A checksum of all that it remembers.
    bits: Option<u32>,
    /// Sums over the body, by name.
    sums: BTreeMap<String, f64>,
}

/// What one thing on one number of threads has taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What it belongs to: `workload`, `problem`, `newton`, `law`, `scaling`, `memory`, `peer`.
    pub group: String,
    /// Its name.
    pub name: String,
    /// Threads.
    pub threads: usize,
    /// Particles; zero if it has none.
    pub particles: u64,
    /// One per round.
    pub samples: Vec<Sample>,
    /// Memory (bytes) that it held after its last slice, exactly; `None` of another program.
    pub memory: Option<u64>,
    /// Whether it came to what it is compared with: on more threads the same bits as on one, of a peer the same sums.
    pub same: Option<bool>,
    /// Sums over the body in the end, by name, of what is compared with peers.
    pub sums: BTreeMap<String, f64>,
}

/// Median and range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Least.
    pub least: f64,
    /// Median.
    pub median: f64,
    /// Greatest.
    pub greatest: f64,
}

impl Spread {
    /// Of some values; `None` of none.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        let (first, last) = (*values.first()?, *values.last()?);
        let n = values.len();
        Some(Self {
            least: first,
            median: 0.5 * (values[(n - 1) / 2] + values[n / 2]),
            greatest: last,
        })
    }
}

impl Measured {
    /// Processor time per update (ns).
    #[must_use]
    pub fn cpu_ns(&self) -> Option<Spread> {
        Spread::of(
            self.samples
                .iter()
                .map(|s| 1e9 * s.cpu_s / s.updates as f64),
        )
    }

    /// Wall time per update (ns).
    #[must_use]
    pub fn wall_ns(&self) -> Option<Spread> {
        Spread::of(
            self.samples
                .iter()
                .map(|s| 1e9 * s.wall_s / s.updates as f64),
        )
    }
}

/// How many times as long `slow` takes for an update as `fast`, by round.
fn ratio(slow: &Measured, fast: &Measured, time: fn(&Sample) -> f64) -> Option<Spread> {
    let per_update = |s: &Sample| time(s) / s.updates as f64;
    let rounds = slow.samples.iter().zip(&fast.samples);
    Spread::of(rounds.map(|(slow, fast)| per_update(slow) / per_update(fast)))
}

/// All measurements of a bench.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Measurements(pub Vec<Measured>);

impl Measurements {
    /// The measurement of one thing.
    #[must_use]
    pub fn find(&self, group: &str, name: &str, threads: usize) -> Option<&Measured> {
        let wanted = |m: &&Measured| m.group == group && m.name == name && m.threads == threads;
        self.0.iter().find(wanted)
    }

    /// The measurements of a group.
    pub fn of_group<'a>(&'a self, group: &'a str) -> impl Iterator<Item = &'a Measured> {
        self.0.iter().filter(move |m| m.group == group)
    }
}

/// One of those that take turns.
struct Turn {
    group: &'static str,
    name: String,
    threads: usize,
    particles: u64,
    timed: Box<dyn Timed>,
    /// The place of the one whose outcome this one's must be.
    like: Option<usize>,
}

/// The same on each number of threads, which must all come to what the first of them comes to.
fn on_threads(
    options: &Options,
    turns: &mut Vec<Turn>,
    turn: impl Fn(usize) -> Result<Turn, Error>,
) -> Result<(), Error> {
    let first = turns.len();
    for &threads in &options.threads {
        let like = (turns.len() > first).then_some(first);
        let turn = turn(threads)?;
        turns.push(Turn { like, ..turn });
    }
    Ok(())
}

/// Those that take turns with each other.
type Group = fn(&Options, Begin) -> Result<Vec<Turn>, Error>;

/// Measures what the options ask for. `progress` gets the share that is done.
///
/// # Errors
/// A scene breaks down, or a peer can't be started.
pub fn measure(
    options: &Options,
    begin: Begin,
    progress: &dyn Fn(f64),
) -> Result<Measurements, Error> {
    // Groups whose ratios matter take turns; one after the other, so that what waits doesn't fill the memory.
    let groups: [&[Group]; 5] = [
        &[|options, _| together(options)],
        &[problems::turns],
        &[|_, begin| newton::turns(begin)],
        &[|_, _| laws::turns()],
        &[
            |_, _| workload::scaling::<2>(),
            |_, _| workload::scaling::<3>(),
        ],
    ];
    let only = &options.only;
    let wanted = |name: &str| only.is_empty() || only.iter().any(|o| o == name);
    let named = GROUPS.into_iter().zip(groups);
    let groups: Vec<&Group> = named
        .filter(|(name, _)| wanted(name))
        .flat_map(|(_, groups)| groups)
        .collect();
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
    let mut turns = machine::turns(options)?;
    workload::turns(options, &mut turns)?;
    if let Some(peers) = &options.peers {
        peers.turns(options, &mut turns)?;
    }
    Ok(turns)
}

/// Rounds of slices, after one that isn't measured.
fn take_turns(
    mut turns: Vec<Turn>,
    rounds: usize,
    progress: &dyn Fn(f64),
) -> Result<Vec<Measured>, Error> {
    let mut samples = vec![Vec::with_capacity(rounds); turns.len()];
    for round in 0..=rounds {
        for (turn, samples) in turns.iter_mut().zip(&mut samples) {
            let sample = turn.timed.slice()?;
            if round > 0 {
                samples.push(sample);
            }
        }
        progress((round + 1) as f64 / (rounds + 1) as f64);
    }
    let mut outcomes = Vec::with_capacity(turns.len());
    for turn in &mut turns {
        outcomes.push(turn.timed.outcome()?);
    }
    let same = |k: usize| {
        let other = outcomes[turns[k].like?].as_ref()?;
        Some(outcomes[k].as_ref()?.is(other))
    };
    let same: Vec<Option<bool>> = (0..turns.len()).map(same).collect();
    let ends = outcomes.into_iter().zip(same);
    let measured = turns.into_iter().zip(samples).zip(ends);
    Ok(measured
        .map(|((turn, samples), (outcome, same))| Measured {
            group: turn.group.to_owned(),
            name: turn.name,
            threads: turn.threads,
            particles: turn.particles,
            samples,
            memory: turn.timed.held(),
            same,
            sums: outcome.map(|o| o.sums).unwrap_or_default(),
        })
        .collect())
}

/// How far sums of programs that do the same may differ, relatively.
const SAME_SUMS: f64 = 1e-9;

impl Outcome {
    /// Whether it is that of another: to the last bit of this program's, by its sums of another's.
    fn is(&self, other: &Self) -> bool {
        if let (Some(a), Some(b)) = (self.bits, other.bits) {
            return a == b;
        }
        let close = |a: f64, b: f64| (a - b).abs() <= SAME_SUMS * a.abs().max(b.abs());
        self.sums.keys().eq(other.sums.keys())
            && self
                .sums
                .values()
                .zip(other.sums.values())
                .all(|(a, b)| close(*a, *b))
    }
}

/// A slice: `work`, which tells its updates, by the clocks.
fn timed(work: impl FnOnce() -> Result<u64, Error>) -> Result<Sample, Error> {
    let (wall, cpu) = (Instant::now(), cpu_time::ProcessTime::now());
    let updates = work()?;
    Ok(Sample {
        updates,
        wall_s: wall.elapsed().as_secs_f64(),
        cpu_s: cpu.elapsed().as_secs_f64(),
    })
}

#[cfg(test)]
mod tests;
