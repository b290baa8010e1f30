//! Seeded faults: faults of physics that were put into the code on purpose, and the checks that went red.

use crate::table::Sheet;
use std::collections::{BTreeMap, BTreeSet};

/// Fault, case and check on a line, as the last run of all faults left them.
const SEEN: &str = include_str!("../../assets/kills.csv");

/// What the checks of a case see.
pub(super) struct Faults {
    /// Faults, each with the checks that see it.
    of_case: BTreeMap<String, Vec<String>>,
    /// How many faults there are.
    pub(super) all: usize,
}

impl Faults {
    pub(super) fn of(case: &str) -> Self {
        let mut reader = csv::Reader::from_reader(SEEN.as_bytes());
        let lines = reader.deserialize::<[String; 3]>().flatten();
        let (mut all, mut of_case) = (BTreeSet::new(), BTreeMap::<String, Vec<String>>::new());
        for [fault, seer, check] in lines {
            all.insert(fault.clone());
            if seer == case {
                of_case.entry(fault).or_default().push(check);
            }
        }
        let all = all.len();
        Self { of_case, all }
    }

    /// How many of them a check sees.
    pub(super) fn seen_by(&self, check: &str) -> usize {
        let seers = self.of_case.values();
        seers
            .filter(|checks| checks.iter().any(|c| c == check))
            .count()
    }

    /// Fault by fault.
    pub(super) fn table(&self) -> Sheet {
        let row = |(fault, checks): (&String, &Vec<String>)| vec![fault.clone(), checks.join(", ")];
        Sheet::new(["seeded fault", "seen by"]).with(self.of_case.iter().map(row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_counts_for_a_check_of_its_case() {
        let lines = SEEN.lines().count() - 1;
        let cases = crate::cases::all().iter().map(|case| Faults::of(case.name));
        let pairs = cases.map(|f| f.of_case.values().map(Vec::len).sum::<usize>());
        assert_eq!(pairs.sum::<usize>(), lines);
        let footing = Faults::of("footing");
        assert!(footing.seen_by("prandtl") > 0 && footing.seen_by("none") == 0);
        assert_eq!(footing.table().rows.len(), footing.of_case.len());
        assert!(footing.all >= 40);
    }
}
