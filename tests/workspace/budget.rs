//! Budget of the repository and its pull requests.

use super::{files, workspace};
use mpm_verify::{case::Tier, cases, golden, spec::RunSpec};
use std::collections::BTreeMap;

/// Particle–node pairs of the tier of pull requests, most of them explicit.
const PAIRS: u64 = 142_516_000_000;

/// Entries of the matrices that it factorises, over all factorisations: some thirty seconds of a processor, with assembly.
const NONZEROS: u64 = 222_000_000;

/// Pairs of a night by its kept rows: four hours of a processor at 1.5 ns a pair, with three quarters of an hour of matrices.
const PAIRS_OF_A_NIGHT: u64 = 7_800_000_000_000;

#[test]
fn the_pr_tier_factorises_few_enough_entries_and_visits_few_enough_pairs() {
    let root = workspace().join("golden");
    let planned = || cases::all().iter().filter(|case| !golden::runs(case).is_empty()).map(|case| case.name);
    let entries: u64 = planned().map(|name| golden::nonzeros(&root, name).unwrap_or_else(|e| panic!("{e}"))).sum();
    assert!(entries > 0 && entries <= NONZEROS, "{entries} entries");
    let pairs: u64 = planned().map(|name| golden::pairs(&root, name).unwrap_or_else(|e| panic!("{e}"))).sum();
    assert!(pairs <= PAIRS, "{pairs} pairs");
}

#[test]
fn a_night_visits_few_enough_pairs() {
    let rows = std::fs::read_to_string(workspace().join("reports/nightly/results.csv")).unwrap();
    let run = |row: &str| row.split(',').map(str::to_owned).collect::<Vec<_>>();
    let kept: BTreeMap<_, _> = rows.lines().skip(1).map(run).map(|row| (row[..4].to_vec(), row[13].clone())).collect();
    let pairs = |(case, spec): (&str, RunSpec)| {
        let key = [case.to_owned(), spec.scheme.to_string(), spec.level.name.to_owned(), spec.set.join(" ")];
        kept.get(&key[..]).and_then(|pairs| pairs.parse::<u64>().ok()).unwrap_or_default()
    };
    let night = cases::all().iter().flat_map(|case| case.runs(Tier::Nightly).into_iter().map(|spec| (case.name, spec)));
    let pairs: u64 = night.map(pairs).sum();
    assert!(pairs > PAIRS && pairs <= PAIRS_OF_A_NIGHT, "{pairs} pairs");
}

#[test]
fn what_is_kept_of_nights_is_small() {
    let most = [("nightly/results.csv", 1_000_000), ("nightly/summary.md", 100_000), ("history.csv", 1_000_000)];
    for (file, most) in most {
        let bytes = std::fs::metadata(workspace().join("reports").join(file)).unwrap().len();
        assert!(bytes <= most, "{file}: {bytes} bytes");
    }
}

/// Tests the files in git: only a checkout can tell.
#[test]
#[expect(clippy::print_stderr, reason = "says in a test's output what it could not measure")]
fn what_is_tracked_is_small() {
    let git = std::process::Command::new("git").args(["ls-files", "-z"]).current_dir(workspace()).output();
    let Some(listed) = git.ok().filter(|o| o.status.success()) else {
        eprintln!("no checkout of git: the weight is not measured");
        return;
    };
    let listed = String::from_utf8(listed.stdout).unwrap();
    let size = |name: &str| std::fs::metadata(workspace().join(name)).map_or(0, |m| m.len());
    let bytes = |start: &str| -> u64 {
        let under = listed.split('\0').filter(|name| name.starts_with(start));
        under.map(size).sum()
    };
    assert!(bytes("reports/") <= 2_000_000, "{} bytes of reports", bytes("reports/"));
    assert!(bytes("") <= 11_900_000, "{} bytes in all", bytes(""));
    let shown = |name: &&str| {
        let page = *name == "README.md" || name.starts_with("docs/");
        page && [".png", ".svg", ".jpg"].iter().any(|e| name.ends_with(e))
    };
    let pictures: Vec<&str> = listed.split('\0').filter(shown).collect();
    for name in &pictures {
        assert!(size(name) <= 150_000, "{name}: {} bytes", size(name));
    }
    let bytes: u64 = pictures.iter().map(|name| size(name)).sum();
    assert!(pictures.len() <= 25 && bytes <= 3_000_000, "{} pictures, {bytes} bytes", pictures.len());
}

#[test]
fn the_goldens_are_small() {
    let all = files(&workspace().join("golden"));
    let bytes: usize = all.values().map(Vec::len).sum();
    assert!(all.len() <= 100 && bytes <= 3_000_000, "{} files, {bytes} bytes", all.len());
    for (name, content) in all {
        let picture = name.extension().is_some_and(|e| e == "png");
        assert!(!picture || content.len() <= 25_000, "{}: {}", name.display(), content.len());
    }
}
