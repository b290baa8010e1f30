//! Seeded faults: faults of physics that were put into the code on purpose, and the checks that went red.

use std::collections::BTreeMap;

/// Fault, case and checks on a line, as the last run of all faults left them.
const SEEN: &str = include_str!("../../assets/kills.csv");

/// The checks that see a fault, case by case.
pub(super) type Seen = BTreeMap<String, Vec<String>>;

/// All faults, by name.
pub(super) fn faults() -> BTreeMap<String, Seen> {
    let mut reader = csv::Reader::from_reader(SEEN.as_bytes());
    let mut faults = BTreeMap::<String, Seen>::new();
    for [name, case, checks] in reader.deserialize::<[String; 3]>().flatten() {
        faults.entry(name).or_default().insert(case, checks.split(';').map(str::to_owned).collect());
    }
    faults
}

/// Whether a fault hangs on one check of one case.
pub(super) fn hangs_on_one(seen: &Seen) -> bool {
    seen.values().map(Vec::len).sum::<usize>() == 1
}

/// How many of the faults a check of a case sees.
pub(super) fn seen(faults: &BTreeMap<String, Seen>, case: &str, check: &str) -> usize {
    let own = faults.values().filter_map(|seen| seen.get(case));
    own.filter(|checks| checks.iter().any(|c| c == check)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_a_case_that_sees_a_fault() {
        let faults = faults();
        assert!(faults.len() >= 40);
        let lines = SEEN.lines().count() - 1;
        assert_eq!(faults.values().map(BTreeMap::len).sum::<usize>(), lines);
        assert!(seen(&faults, "footing", "prandtl") > 0);
        assert_eq!(seen(&faults, "footing", "none"), 0);
        let alone = faults.values().filter(|seen| hangs_on_one(seen)).count();
        assert!(alone > 0 && alone < faults.len());
    }
}
