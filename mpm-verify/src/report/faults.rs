//! Seeded faults: faults of physics that were put into the code on purpose, and the checks that went red.

use std::collections::{BTreeMap, BTreeSet};

/// Fault, case and check on a line, as the last run of all faults left them.
const SEEN: &str = include_str!("../../assets/kills.csv");

/// What the checks of a case see.
pub(super) struct Faults {
    /// How many of them each check sees.
    seen: BTreeMap<String, usize>,
    /// How many faults there are.
    pub(super) all: usize,
}

impl Faults {
    pub(super) fn of(case: &str) -> Self {
        let mut reader = csv::Reader::from_reader(SEEN.as_bytes());
        let lines = reader.deserialize::<[String; 3]>().flatten();
        let (mut all, mut seen) = (BTreeSet::new(), BTreeMap::new());
        for [fault, seer, check] in lines {
            all.insert(fault);
            if seer == case {
                *seen.entry(check).or_default() += 1;
            }
        }
        let all = all.len();
        Self { seen, all }
    }

    pub(super) fn seen_by(&self, check: &str) -> usize {
        self.seen.get(check).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_counts_for_a_check_of_its_case() {
        let lines = SEEN.lines().count() - 1;
        let cases = crate::cases::all().iter().map(|case| Faults::of(case.name));
        let pairs = cases.map(|f| f.seen.values().sum::<usize>());
        assert_eq!(pairs.sum::<usize>(), lines);
        let footing = Faults::of("footing");
        assert!(footing.seen_by("prandtl") > 0 && footing.seen_by("none") == 0);
        assert!(footing.all >= 40);
    }
}
