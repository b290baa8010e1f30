//! Seeded faults: faults of physics that were put into the code on purpose, and the checks that went red.

use std::collections::BTreeMap;

/// Fault, case and checks on a line, as the last run of all faults left them.
const SEEN: &str = include_str!("../../assets/kills.csv");

/// A fault.
#[derive(Default)]
pub(super) struct Fault {
    /// Name of the fault.
    pub(super) name: String,
    /// The checks that see it, case by case.
    pub(super) seen_by: BTreeMap<String, Vec<String>>,
}

impl Fault {
    /// Whether it hangs on one check of one case.
    pub(super) fn hangs_on_one(&self) -> bool {
        self.seen_by.values().map(Vec::len).sum::<usize>() == 1
    }
}

/// All faults, by name.
pub(super) fn faults() -> Vec<Fault> {
    let mut reader = csv::Reader::from_reader(SEEN.as_bytes());
    let mut faults: Vec<Fault> = Vec::new();
    for [name, case, checks] in reader.deserialize::<[String; 3]>().flatten() {
        if faults.last().is_none_or(|fault| fault.name != name) {
            faults.push(Fault { name, seen_by: BTreeMap::new() });
        }
        if let Some(fault) = faults.last_mut() {
            fault.seen_by.insert(case, checks.split(';').map(str::to_owned).collect());
        }
    }
    faults
}

/// How many of the faults a check of a case sees.
pub(super) fn seen(faults: &[Fault], case: &str, check: &str) -> usize {
    let own = faults.iter().filter_map(|fault| fault.seen_by.get(case));
    own.filter(|checks| checks.iter().any(|c| c == check)).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_line_is_a_case_that_sees_a_fault() {
        let faults = faults();
        let names: BTreeSet<&str> = faults.iter().map(|fault| &*fault.name).collect();
        assert!(names.len() == faults.len() && faults.len() >= 40);
        let lines = SEEN.lines().count() - 1;
        assert_eq!(faults.iter().map(|fault| fault.seen_by.len()).sum::<usize>(), lines);
        assert!(seen(&faults, "footing", "prandtl") > 0);
        assert_eq!(seen(&faults, "footing", "none"), 0);
        let alone = faults.iter().filter(|fault| fault.hangs_on_one()).count();
        assert!(alone > 0 && alone < faults.len());
    }
}
