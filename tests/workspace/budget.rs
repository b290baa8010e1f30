//! What the repository and its pull requests may cost.

use super::{files, workspace};
use mpm_verify::{cases, golden};

/// Particle–node pairs of the tier of pull requests.
const PAIRS: u64 = 130_000_000_000;

#[test]
fn the_pr_tier_visits_few_enough_pairs() {
    let root = workspace().join("golden");
    let planned = cases::all()
        .iter()
        .filter(|case| !golden::runs(case).is_empty());
    let pairs: u64 = planned
        .map(|case| {
            golden::pairs(&root, case.name).unwrap_or_else(|e| panic!("bless it first: {e}"))
        })
        .sum();
    assert!(pairs <= PAIRS, "{pairs} pairs");
}

#[test]
fn the_goldens_are_small() {
    let all = files(&workspace().join("golden"));
    let bytes: usize = all.values().map(Vec::len).sum();
    assert!(
        all.len() <= 100 && bytes <= 3_000_000,
        "{} files, {bytes} bytes",
        all.len()
    );
    for (name, content) in all {
        let picture = name.extension().is_some_and(|e| e == "png");
        assert!(
            !picture || content.len() <= 25_000,
            "{}: {}",
            name.display(),
            content.len()
        );
    }
}
