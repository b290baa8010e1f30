//! Measurements: slices of work, their spread over the rounds, and ratios.

use serde::Serialize;
use std::collections::BTreeMap;

/// A slice of work.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Sample {
    /// Particle updates; of Newton's method, iterations; of laws, particles; of memory, bytes.
    pub updates: u64,
    /// Wall time (s).
    pub wall_s: f64,
    /// Processor time of all threads (s).
    pub cpu_s: f64,
}

/// Measurement of one thing on one number of threads.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measured {
    /// Its group: `workload`, `problem`, `newton`, `law`, `scaling`, `memory`, `peer`.
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
    /// Whether the outcome agrees: on more threads the same bits as on one, for a peer the same sums.
    pub same: Option<bool>,
    /// Sums over the body in the end, by name, of what is compared with peers.
    pub sums: BTreeMap<String, f64>,
}

/// Median and range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Least.
    pub least: f64,
    /// Median.
    pub median: f64,
    /// Greatest.
    pub greatest: f64,
}

impl Spread {
    /// Spread of some values; `None` without any.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        let (first, last) = (*values.first()?, *values.last()?);
        let n = values.len();
        Some(Self { least: first, median: 0.5 * (values[(n - 1) / 2] + values[n / 2]), greatest: last })
    }
}

impl Measured {
    /// Processor time per update (ns).
    #[must_use]
    pub fn cpu_ns(&self) -> Option<Spread> {
        Spread::of(self.samples.iter().map(|s| 1e9 * s.cpu_s / s.updates as f64))
    }

    /// Wall time per update (ns).
    #[must_use]
    pub fn wall_ns(&self) -> Option<Spread> {
        Spread::of(self.samples.iter().map(|s| 1e9 * s.wall_s / s.updates as f64))
    }
}

/// How many times as long `slow` takes for an update as `fast`, by round.
pub(crate) fn ratio(slow: &Measured, fast: &Measured, time: fn(&Sample) -> f64) -> Option<Spread> {
    let per_update = |s: &Sample| time(s) / s.updates as f64;
    let rounds = slow.samples.iter().zip(&fast.samples);
    Spread::of(rounds.map(|(slow, fast)| per_update(slow) / per_update(fast)))
}

/// All measurements of a bench.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
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
