//! How fast the program is: what takes turns on one machine, compared as ratios of one run.
//!
//! Wall times of a shared machine are noise. What is compared here takes turns: every round runs a slice of each
//! `Timed` thing, ratios are formed within a round, and their median and range over the rounds are told.

mod aims;
mod laws;
mod local;
mod machine;
mod model;
mod newton;
mod peer;
mod problems;
mod summary;
mod workload;

pub use peer::Peers;

use crate::error::Error;
use crate::files::{make_folder, read_versioned, write_json};
use crate::record::{Machine, Version};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

/// Version of `bench.json`.
const SCHEMA: u32 = 1;

/// What is to be measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Rounds.
    pub rounds: usize,
    /// Numbers of threads to compare, one first.
    pub threads: Vec<usize>,
    /// Whether the cost over the number of particles is measured.
    pub scaling: bool,
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

/// All that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bench {
    /// Version of this file.
    pub schema: u32,
    /// The machine.
    pub machine: Machine,
    /// Its processor, where the system tells.
    pub processor: Option<String>,
    /// The program.
    pub version: Version,
    /// What was measured.
    pub measured: Vec<Measured>,
}

impl Bench {
    /// What was measured of one thing.
    fn find(&self, group: &str, name: &str, threads: usize) -> Option<&Measured> {
        let wanted = |m: &&Measured| m.group == group && m.name == name && m.threads == threads;
        self.measured.iter().find(wanted)
    }

    fn of_group<'a>(&'a self, group: &'a str) -> impl Iterator<Item = &'a Measured> {
        self.measured.iter().filter(move |m| m.group == group)
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

/// Draws the pictures of what was measured, as `bench.json` of the folder `measured` has it, into `out`.
///
/// # Errors
/// The file is missing or damaged, or a picture can't be written.
pub fn draw(measured: &Path, out: &Path) -> Result<(), Error> {
    summary::draw_scaling(&read_versioned(&measured.join("bench.json"), SCHEMA)?, out)
}

/// Those that take turns with each other.
type Group = fn(&Options) -> Result<Vec<Turn>, Error>;

/// Measures what the options ask for, writes `bench.json`, the tables and the pictures into `out` and returns the
/// tables. `progress` hears the share that is done.
///
/// # Errors
/// A scene breaks down, a peer is not to be had, or a file can't be written.
pub fn measure(options: &Options, out: &Path, progress: &dyn Fn(f64)) -> Result<String, Error> {
    make_folder(out)?;
    let mut bench = Bench {
        schema: SCHEMA,
        machine: Machine::here(options.threads.iter().copied().max().unwrap_or(1)),
        processor: machine::processor(),
        version: Version::current(),
        measured: Vec::new(),
    };
    // Groups whose ratios matter take turns; one after the other, so that what waits doesn't fill the memory.
    let mut groups: Vec<Group> = vec![together, problems::turns, newton::turns, laws::turns];
    if options.scaling {
        groups.extend([workload::scaling::<2>, workload::scaling::<3>]);
    }
    let count = groups.len() as f64;
    for (k, group) in groups.iter().enumerate() {
        let share = |done: f64| progress((k as f64 + done) / count);
        bench
            .measured
            .extend(take_turns(group(options)?, options.rounds, &share)?);
    }
    write_json(&out.join("bench.json"), &bench)?;
    summary::write(&bench, out)
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
mod tests {
    use super::*;

    /// Takes a millisecond longer for every slice.
    struct Slow(f64);

    impl Timed for Slow {
        fn slice(&mut self) -> Result<Sample, Error> {
            self.0 += 1e-3;
            Ok(Sample {
                updates: 1000,
                wall_s: self.0,
                cpu_s: 2.0 * self.0,
            })
        }

        fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
            Ok(Some(sums(self.0)))
        }
    }

    fn sums(mass: f64) -> Outcome {
        Outcome {
            bits: None,
            sums: [("mass".to_owned(), mass)].into(),
        }
    }

    fn turn(begin: f64, like: Option<usize>) -> Turn {
        Turn {
            group: "workload",
            name: "slow".to_owned(),
            threads: 1,
            particles: 10,
            timed: Box::new(Slow(begin)),
            like,
        }
    }

    fn bench(measured: Vec<Measured>) -> Bench {
        Bench {
            schema: SCHEMA,
            machine: Machine::here(2),
            processor: None,
            version: Version::current(),
            measured,
        }
    }

    #[test]
    fn the_first_slice_is_not_measured_and_outcomes_are_compared() {
        let turns = vec![turn(0.0, None), turn(0.0, Some(0)), turn(1e-9, Some(0))];
        let measured = take_turns(turns, 3, &|_| ()).unwrap();
        let wall = measured[0].wall_ns().unwrap();
        assert!((wall.least - 2e3).abs() < 1e-6 && (wall.median - 3e3).abs() < 1e-6);
        assert!((measured[0].cpu_ns().unwrap().greatest - 8e3).abs() < 1e-6);
        let same: Vec<Option<bool>> = measured.iter().map(|m| m.same).collect();
        assert_eq!(same, [None, Some(true), Some(false)]);
        let ratio = ratio(&measured[0], &measured[1], |s| s.wall_s).unwrap();
        assert_eq!((ratio.least, ratio.greatest), (1.0, 1.0));
    }

    #[test]
    fn bits_are_compared_to_the_last_and_sums_to_nine_digits() {
        let bits = |bits| Outcome {
            bits: Some(bits),
            ..sums(1.0)
        };
        assert!(bits(1).is(&bits(1)) && !bits(1).is(&bits(2)));
        assert!(bits(1).is(&sums(1.0 + 1e-10)) && !bits(1).is(&sums(1.0 + 1e-8)));
        assert!(!sums(1.0).is(&Outcome::default()));
    }

    #[test]
    fn a_median_of_an_even_number_lies_between_two() {
        assert_eq!(Spread::of([3.0, 1.0, 2.0, 8.0]).unwrap().median, 2.5);
        assert!(Spread::of([]).is_none());
    }

    #[test]
    fn a_small_problem_must_lose_nothing_to_threads() {
        let on = |threads, particles, begin, like| Turn {
            group: "problem",
            name: format!("of {particles}"),
            threads,
            particles,
            ..turn(begin, like)
        };
        let turns = vec![
            on(1, 3200, 0.0, None),
            on(2, 3200, 0.0, Some(0)),
            on(3, 3200, 1.0, Some(0)),
            on(1, 20_000, 0.0, None),
            on(2, 20_000, 0.0, Some(3)),
        ];
        let aims = aims::of(&bench(take_turns(turns, 2, &|_| ()).unwrap()));
        let told: Vec<(&str, bool)> = aims.iter().map(|a| (a.what.as_str(), a.met)).collect();
        let what = "3. of 3200, 3200 particles: times as fast on";
        let two = format!("{what} 2 threads as on one, same bits");
        let three = format!("{what} 3 threads as on one, OTHER BITS");
        assert_eq!(told, [(two.as_str(), true), (three.as_str(), false)]);
    }

    #[test]
    fn assembly_factors_and_solution_of_an_iteration_are_added_up() {
        let parts = [
            "iteration",
            "forces",
            "assembly",
            "factorisation",
            "solution",
        ];
        let scheme = newton::schemes().next().unwrap().to_string();
        let part = |(k, part): (usize, &&str)| Turn {
            group: "newton",
            name: newton::name(&scheme, part),
            ..turn(0.05 * k as f64, None)
        };
        let turns = parts.iter().enumerate().map(part).collect();
        let mut bench = bench(take_turns(turns, 1, &|_| ()).unwrap());
        for m in &mut bench.measured {
            m.samples[0].updates = 1;
        }
        let aim = |bench: &Bench| {
            let aims = aims::of(bench);
            let aim = aims.iter().find(|a| a.what.starts_with('6')).unwrap();
            (aim.measured.median, aim.met)
        };
        let (seconds, met) = aim(&bench);
        assert!((seconds - 0.912).abs() < 1e-9 && met, "{seconds}");
        bench.measured[2].samples[0].cpu_s += 0.1;
        assert!(!aim(&bench).1);
    }

    #[test]
    fn two_threads_come_to_the_same_bits_and_the_aims_are_told() {
        let options = Options {
            rounds: 1,
            threads: vec![1, 2],
            scaling: false,
            peers: None,
        };
        let mut turns = Vec::new();
        workload::small(&options, &mut turns).unwrap();
        let mut bench = bench(take_turns(turns, options.rounds, &|_| ()).unwrap());
        assert!(bench.measured.iter().all(|m| m.same != Some(false)));
        let told: Vec<String> = aims::of(&bench).into_iter().map(|a| a.what).collect();
        assert!(
            told.iter().any(|w| w.starts_with("2. W2F over W2")),
            "{told:?}"
        );
        assert!(told.iter().any(|w| w.ends_with("same bits")), "{told:?}");
        // Bits that differ are told, and the aim is missed however fast it was.
        for m in &mut bench.measured {
            m.same = m.same.map(|_| false);
        }
        let threads = aims::of(&bench)
            .into_iter()
            .find(|a| a.what.starts_with('3'));
        assert!(threads.is_some_and(|a| !a.met && a.what.ends_with("OTHER BITS")));
    }
}
