//! Turns: things that are timed, a slice a round each.

use crate::measured::{Measured, Sample};
use std::collections::BTreeMap;
use std::time::Instant;

/// Reason why something cannot be measured.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// Something that is run slice by slice.
pub(crate) trait Timed {
    /// Runs the next slice.
    fn slice(&mut self) -> Result<Sample, Error>;
    /// Its outcome, compared with that of another with the same work; `None` if there is nothing to compare.
    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(None)
    }
    /// Ends it and returns the memory (bytes) that it held; `None` for another program.
    fn held(self: Box<Self>) -> Option<u64> {
        None
    }
}

/// Outcome of work, by which two programs are compared.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Outcome {
    /// A checksum of all that it remembers.
    pub(crate) bits: Option<u32>,
    /// Sums over the body, by name.
    pub(crate) sums: BTreeMap<String, f64>,
}

/// One of those that take turns.
pub(crate) struct Turn {
    pub(crate) group: &'static str,
    pub(crate) name: String,
    pub(crate) threads: usize,
    pub(crate) particles: u64,
    pub(crate) timed: Box<dyn Timed>,
    /// The place of the one whose outcome this one's must be.
    pub(crate) like: Option<usize>,
}

/// The same on each number of threads, which must all come to what the first of them comes to.
pub(crate) fn on_threads(
    threads: &[usize],
    turns: &mut Vec<Turn>,
    turn: impl Fn(usize) -> Result<Turn, Error>,
) -> Result<(), Error> {
    let first = turns.len();
    for &threads in threads {
        let like = (turns.len() > first).then_some(first);
        let turn = turn(threads)?;
        turns.push(Turn { like, ..turn });
    }
    Ok(())
}

/// Rounds of slices, after one that isn't measured.
pub(crate) fn take_turns(mut turns: Vec<Turn>, rounds: usize, progress: &dyn Fn(f64)) -> Result<Vec<Measured>, Error> {
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
    pub(crate) fn is(&self, other: &Self) -> bool {
        if let (Some(a), Some(b)) = (self.bits, other.bits) {
            return a == b;
        }
        let close = |a: f64, b: f64| (a - b).abs() <= SAME_SUMS * a.abs().max(b.abs());
        self.sums.keys().eq(other.sums.keys())
            && self.sums.values().zip(other.sums.values()).all(|(a, b)| close(*a, *b))
    }
}

/// A slice: `work`, which tells its updates, by the clocks.
pub(crate) fn timed(work: impl FnOnce() -> Result<u64, Error>) -> Result<Sample, Error> {
    let (wall, cpu) = (Instant::now(), cpu_time::ProcessTime::now());
    let updates = work()?;
    Ok(Sample { updates, wall_s: wall.elapsed().as_secs_f64(), cpu_s: cpu.elapsed().as_secs_f64() })
}
