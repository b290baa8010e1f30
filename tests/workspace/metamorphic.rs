//! Invariance of results: threads, the order of the particles, the place, axes and units of the scene, a stop on the
//! way, another simulation beside it. `docs/metamorphic.md` states the comparisons, and derives the bounds.

use mpm_core::Error;
use mpm_solvers::trial::{Column, Length, Outcome, Trial, View, run};
use mpm_verify::case::{Case, Tier};
use mpm_verify::cases;
use mpm_verify::parameter::Parameters;
use mpm_verify::scheme::BasisName;
use mpm_verify::spec::RunSpec;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Agreement demanded of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Agreement {
    /// Every bit, of its memory too.
    Memory,
    /// Every bit of the columns.
    Bits,
    /// Up to rounding, by the bound of `docs/metamorphic.md`.
    Rounding,
}
use Agreement::{Bits, Memory, Rounding};

/// A change that leaves the problem what it is.
struct Change {
    name: &'static str,
    agreement: Agreement,
    again: fn(&Run, u64) -> Option<Outcome>,
}

const fn change(name: &'static str, agreement: Agreement, again: fn(&Run, u64) -> Option<Outcome>) -> Change {
    Change { name, agreement, again }
}

/// Unit of length that is a power of two, and one of stress whose roots are.
const BINARY: View = View::Units(1024.0, 1.0 / 1_048_576.0);

const CHANGES: [Change; 14] = [
    change("twice", Memory, |run, n| run.seen(View::Own, n)),
    change("2 threads", Memory, |run, n| run.on_threads(2, n)),
    change("3 threads", Memory, |run, n| run.on_threads(3, n)),
    change("4 threads", Memory, |run, n| run.on_threads(4, n)),
    change("two at once", Memory, Run::beside_another),
    change("restart", Memory, Run::restarted),
    change("units of 2ⁿ", Bits, |run, n| run.seen(BINARY, n)),
    change("mm, t, s", Rounding, |run, n| run.seen(View::Units(1e3, 1e-6), n)),
    change("order", Rounding, |run, n| run.tried(View::Own, true, n)),
    change("mirror, x", Rounding, |run, n| run.seen(View::Mirrored(0), n)),
    change("mirror, y", Rounding, |run, n| run.seen(View::Mirrored(1), n)),
    change("turned", Rounding, |run, n| run.seen(View::Turned, n)),
    change("7 cells aside", Rounding, |run, n| run.seen(View::Cells(7.0), n)),
    change("10⁶ m away", Rounding, |run, n| run.seen(View::Far(1e6), n)),
];

/// A run of a case.
struct Run {
    case: &'static Case,
    spec: RunSpec,
    parameters: Parameters,
}

impl Run {
    fn name(&self) -> String {
        format!("{} {}", self.case.name, self.spec.folder())
    }

    /// Runs as far as a budget of `pairs` and `steps` goes, or until before the step in which it breaks down.
    fn base(&self, pairs: u64, steps: u64) -> Option<Outcome> {
        let trial = |length| Trial { view: View::Own, shuffled: false, shrunk: self.shrunk(), from: None, length };
        let begin = || (self.case.begin)(&self.spec, &self.parameters);
        match run(trial(Length::Until(pairs, steps)), begin)? {
            Err(Error::Breakdown { step, .. } | Error::NoConvergence { step, .. } | Error::Singular { step, .. })
                if step > 0 =>
            {
                self.of(trial(Length::Steps(step)))
            }
            outcome => Some(outcome.unwrap_or_else(|e| panic!("{}: {e}", self.name()))),
        }
    }

    /// Whether both views of a scene are of one problem. Particles of the case `translate` come to lie on grid lines, where
    /// linear functions have two slopes; that of the cell above is taken, which in a mirror is the one below. Serendipity
    /// elements are oblong.
    fn defines(&self, change: &Change) -> bool {
        let (basis, mirrored) = (self.spec.scheme.basis(), change.name.starts_with("mirror"));
        let on_lines = self.case.name == "translate" && basis == BasisName::Linear;
        !(on_lines && mirrored || basis == BasisName::Q8 && change.name == "turned")
    }

    /// A step with inertia on GIMP is not continuous where a domain begins to reach over a grid line.
    fn shrunk(&self) -> bool {
        ["explicit", "midpoint", "newmark"].contains(&self.spec.scheme.solver())
    }

    fn of(&self, trial: Trial) -> Option<Outcome> {
        let outcome = run(trial, || (self.case.begin)(&self.spec, &self.parameters));
        outcome.map(|o| o.unwrap_or_else(|e| panic!("{}: {e}", self.name())))
    }

    fn tried(&self, view: View, shuffled: bool, steps: u64) -> Option<Outcome> {
        self.of(Trial { view, shuffled, shrunk: self.shrunk(), from: None, length: Length::Steps(steps) })
    }

    fn seen(&self, view: View, steps: u64) -> Option<Outcome> {
        self.tried(view, false, steps)
    }

    fn on_threads(&self, threads: usize, steps: u64) -> Option<Outcome> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| self.seen(View::Own, steps))
    }

    /// On another thread, while this one does the same from elsewhere.
    fn beside_another(&self, steps: u64) -> Option<Outcome> {
        std::thread::scope(|scope| {
            let one = scope.spawn(|| self.seen(View::Own, steps));
            self.seen(View::Mirrored(0), steps);
            one.join().unwrap()
        })
    }

    /// Stopped after a step that depends on the name, and gone on with anew.
    fn restarted(&self, steps: u64) -> Option<Outcome> {
        if steps < 2 {
            return None;
        }
        let stop = 1 + u64::from(crc32fast::hash(self.name().as_bytes())) % (steps - 1);
        let from = self.seen(View::Own, stop)?.saved;
        self.of(Trial {
            view: View::Own,
            shuffled: false,
            shrunk: self.shrunk(),
            from: Some(from),
            length: Length::Steps(steps - stop),
        })
    }
}

/// The cheapest run of a case for each kind of solver, or for each scheme.
fn runs<K: Ord>(case: &'static Case, kind: fn(&RunSpec) -> K) -> Vec<Run> {
    let mut cheapest: BTreeMap<K, (f64, RunSpec)> = BTreeMap::new();
    for spec in case.runs(Tier::Long) {
        let cost = (case.cost)(&spec);
        match cheapest.get(&kind(&spec)) {
            Some((least, _)) if *least <= cost => {}
            _ => drop(cheapest.insert(kind(&spec), (cost, spec))),
        }
    }
    let run = |(_, spec): (f64, RunSpec)| Run {
        case,
        parameters: Parameters::new(&case.parameters, &spec.set).unwrap(),
        spec,
    };
    cheapest.into_values().map(run).collect()
}

/// Successive roundings of a number in a step, at most: the sum over the nodes that a particle sees, and that over the
/// particles that a node sees.
const ROUNDINGS: f64 = 64.0;

/// How far a value of each column may lie off after some steps: the bound of `docs/metamorphic.md`.
fn bounds(base: &Outcome, other: &Outcome, steps: u64) -> Vec<f64> {
    let scales = &base.scales;
    let elapsed = base.columns[0].values[0];
    let natural = |column: &Column| {
        let [stress, length, time] = column.unit;
        // Impulses, and the time itself, gather over all of it.
        let long = if time == 1 { elapsed.max(scales.time) } else { scales.time };
        let of_one = scales.stress.powi(stress) * scales.length.powi(length) * long.powi(time);
        of_one * if column.summed { scales.particles as f64 } else { 1.0 }
    };
    // Strains and speeds, in those measures.
    let strained = base.columns.iter().filter(|c| [[1, 0, 0], [0, 1, -1]].contains(&c.unit));
    let excited = strained.flat_map(|c| c.values.iter().map(|v| v.abs() / natural(c))).fold(0.0, f64::max).min(1.0);
    let condition = if base.condition.is_finite() { base.condition } else { 1.0 };
    let place = other.scales.place.max(scales.place);
    let unbalanced = other.unbalanced.max(base.unbalanced);
    let share = ROUNDINGS * (f64::EPSILON + excited * place / scales.finest) + excited * unbalanced;
    let many = steps as f64 * condition;
    let columns = base.columns.iter();
    columns
        .map(|column| {
            let of_place = if column.unit == [0, 1, 0] { ROUNDINGS * place } else { 0.0 };
            many * (share * natural(column) + of_place)
        })
        .collect()
}

/// Where `other` differs from `base` by more than it may, as text; and the greatest share of a bound that it takes.
fn compare(base: &Outcome, other: &Outcome, agreement: Agreement, steps: u64) -> (String, f64) {
    let (mut found, mut most) = (String::new(), 0.0_f64);
    if agreement == Memory && (base.work, &base.saved) != (other.work, &other.saved) {
        found += " work or memory";
    }
    if agreement == Rounding && base.parts != other.parts {
        let _ = write!(found, " {} parts of steps, not {}", other.parts, base.parts);
    }
    let bounds = bounds(base, other, steps);
    assert_eq!(base.columns.len(), other.columns.len());
    for ((column, twin), bound) in base.columns.iter().zip(&other.columns).zip(bounds) {
        let off = distance(column, twin);
        let bound = if agreement == Rounding { bound } else { 0.0 };
        if off > bound || off.is_nan() {
            let _ = write!(found, " {} by {off:.1e}, bound {bound:.1e};", column.name);
        }
        most = most.max(if off > 0.0 { off / bound } else { 0.0 });
    }
    (found, most)
}

/// The greatest difference of two values, of places on an axis without ends the shorter way; NaN where only one is a number.
fn distance(one: &Column, other: &Column) -> f64 {
    assert_eq!(one.values.len(), other.values.len(), "{}", one.name);
    let pairs = one.values.iter().zip(&other.values);
    let mut greatest = 0.0_f64;
    for (k, (a, b)) in pairs.enumerate() {
        if a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()) {
            continue;
        }
        let period = one.periods[k % one.periods.len()];
        let off = (a - b).abs();
        let off = if off > 0.5 * period { (off - period).abs() } else { off };
        greatest = if off.is_nan() { f64::NAN } else { greatest.max(off) };
    }
    greatest
}

/// Result of a gate.
struct Gate {
    /// Forbidden changes.
    found: String,
    /// Runs that were tried.
    runs: usize,
    /// Pairs of particles and nodes, and entries of factors, that all trials worked on.
    pairs: u64,
    /// The greatest share of a bound that a difference took.
    share: f64,
}

/// Pairs that a run of the first gate may take. The second leaves out the strip load of `soils`, a third of its budget.
const SMALL: u64 = 32_000;

/// Tries all changes of some runs, as far as a budget of `pairs` and `steps` goes.
fn gate(runs: impl Iterator<Item = Run>, pairs: u64, steps: u64) -> Gate {
    let mut gate = Gate { found: String::new(), runs: 0, pairs: 0, share: 0.0 };
    for run in runs {
        let Some(base) = run.base(pairs, steps) else {
            continue;
        };
        gate.runs += 1;
        let steps = base.work.steps;
        for change in CHANGES.iter().filter(|change| run.defines(change)) {
            let Some(other) = (change.again)(&run, steps) else {
                continue;
            };
            gate.pairs += other.work.particle_node_pairs + other.work.nonzeros;
            let (off, share) = compare(&base, &other, change.agreement, steps);
            gate.share = gate.share.max(share);
            if !off.is_empty() {
                let (run, change) = (run.name(), change.name);
                let _ = writeln!(gate.found, "{run}, {change}, {steps} steps:{off}");
            }
        }
    }
    gate
}

/// The cheapest run of every case and kind. The patch is left out: its own truths compare each motion with the exact one,
/// beside walls on two sides, and its runs would exceed the budget of pairs.
fn all<K: Ord>(kind: fn(&RunSpec) -> K) -> impl Iterator<Item = Run> {
    cases::all().iter().filter(|case| case.name != "patch").flat_map(move |case| runs(case, kind))
}

fn require(gate: &Gate, least_runs: usize, most_pairs: u64) {
    let Gate { found, runs, pairs, share } = gate;
    assert!(found.is_empty(), "{found}");
    let told = format!("{runs} runs, {pairs} pairs, {share} of a bound");
    assert!(*runs >= least_runs && *pairs <= most_pairs, "{told}");
}

#[test]
fn no_view_of_a_scene_changes_what_a_solver_finds() {
    let small = all(|spec| spec.scheme.solver());
    require(&gate(small, SMALL, 20), 53, 32_000_000);
}

#[test]
fn no_view_of_a_larger_scene_changes_it_in_a_step() {
    let large = all(|spec| spec.scheme.solver()).filter(|r| r.case.name != "soils" && r.base(SMALL, 1).is_none());
    require(&gate(large, 10 * SMALL, 1), 3, 51_000_000);
}

#[test]
fn no_view_of_a_scene_changes_what_a_scheme_finds() {
    let schemes = all(|spec| spec.scheme);
    require(&gate(schemes, 17_500, 20), 500, 230_000_000);
}
