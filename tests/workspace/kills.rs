//! Which check sees which seeded fault: the file and the page that the last run of the faults left are those of the
//! faults that there are.

use super::faults::faults;
use super::kill_matrix::{Kills, PAGE};
use super::workspace;
use mpm_verify::cases;
use std::collections::BTreeSet;
use std::fs;

#[test]
fn every_seeded_fault_is_seen_by_a_check_that_there_is() {
    let kills = Kills::read(&workspace());
    let seeded: BTreeSet<&str> = faults().map(|fault| fault.name).collect();
    let stored: BTreeSet<&str> = kills.0.keys().map(String::as_str).collect();
    assert_eq!(stored, seeded, "run `just mutants`");
    for fault in faults() {
        let source = fs::read_to_string(workspace().join("mpm-core/src").join(fault.file)).unwrap();
        assert_eq!(source.matches(fault.sound).count(), 1, "{}: what it breaks has changed", fault.name);
        let seers = &kills.0[fault.name];
        for (runs, check) in fault.seen_by {
            let named = (runs[0].split_whitespace().next().unwrap().to_owned(), (*check).to_owned());
            assert!(seers.contains(&named), "{}: {named:?}", fault.name);
        }
        for (case, check) in seers {
            let of = cases::find(case).unwrap();
            let there = of.checks.iter().any(|c| c.name == check);
            assert!(there || check == "completes" || check.starts_with('('), "{case}: {check}");
        }
    }
    let page = fs::read_to_string(workspace().join(PAGE)).unwrap();
    assert!(page == kills.page(), "{PAGE} is not made of the file: run `just mutants`");
}
