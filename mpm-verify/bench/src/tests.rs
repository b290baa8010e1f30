//! Tests of what is measured and told.

use crate::measured::ratio;
use crate::turn::{Error, Outcome, Timed, Turn, take_turns};
use crate::{Measurements, Sample, Spread, aims, newton, workload};

/// Takes a millisecond longer for every slice.
struct Slow(f64);

impl Timed for Slow {
    fn slice(&mut self) -> Result<Sample, Error> {
        self.0 += 1e-3;
        Ok(Sample { updates: 1000, wall_s: self.0, cpu_s: 2.0 * self.0 })
    }

    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(Some(sums(self.0)))
    }
}

fn sums(mass: f64) -> Outcome {
    Outcome { bits: None, sums: [("mass".to_owned(), mass)].into() }
}

fn turn(begin: f64, like: Option<usize>) -> Turn {
    Turn { group: "workload", name: "slow".to_owned(), threads: 1, particles: 10, timed: Box::new(Slow(begin)), like }
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
    let bits = |bits| Outcome { bits: Some(bits), ..sums(1.0) };
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
    let aims = aims::of(&Measurements(take_turns(turns, 2, &|_| ()).unwrap()));
    let told: Vec<(&str, bool)> = aims.iter().map(|a| (a.what.as_str(), a.met)).collect();
    let what = "3. of 3200, 3200 particles: times as fast on";
    let two = format!("{what} 2 threads as on one, same bits");
    let three = format!("{what} 3 threads as on one, OTHER BITS");
    assert_eq!(told, [(two.as_str(), true), (three.as_str(), false)]);
}

#[test]
fn assembly_factors_and_solution_of_an_iteration_are_added_up() {
    let parts = ["iteration", "forces", "assembly", "factorisation", "solution"];
    let all = newton::all();
    let steps = all.first().unwrap();
    let part =
        |(k, part): (usize, &&str)| Turn { group: "newton", name: steps.name(part), ..turn(0.05 * k as f64, None) };
    let turns = parts.iter().enumerate().map(part).collect();
    let mut bench = Measurements(take_turns(turns, 1, &|_| ()).unwrap());
    for m in &mut bench.0 {
        m.samples[0].updates = 1;
    }
    let aim = |bench: &Measurements| {
        let aims = aims::of(bench);
        let aim = aims.iter().find(|a| a.what.starts_with('6')).unwrap();
        (aim.measured.median, aim.met)
    };
    let (seconds, met) = aim(&bench);
    assert!((seconds - 0.912).abs() < 1e-9 && met, "{seconds}");
    bench.0[2].samples[0].cpu_s += 0.1;
    assert!(!aim(&bench).1);
}

#[test]
fn two_threads_come_to_the_same_bits_and_the_aims_are_told() {
    let mut turns = Vec::new();
    workload::small(&[1, 2], &mut turns).unwrap();
    let mut bench = Measurements(take_turns(turns, 1, &|_| ()).unwrap());
    assert!(bench.0.iter().all(|m| m.same != Some(false)));
    let told: Vec<String> = aims::of(&bench).into_iter().map(|a| a.what).collect();
    for with in ["W2F", "W2P"] {
        assert!(told.iter().any(|w| w.starts_with(&format!("2. {with} over W2"))), "{told:?}");
    }
    assert!(told.iter().any(|w| w.ends_with("same bits")), "{told:?}");
    // Bits that differ are told, and the aim is missed however fast it was.
    for m in &mut bench.0 {
        m.same = m.same.map(|_| false);
    }
    let threads = aims::of(&bench).into_iter().find(|a| a.what.starts_with('3'));
    assert!(threads.is_some_and(|a| !a.met && a.what.ends_with("OTHER BITS")));
}
