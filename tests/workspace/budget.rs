//! Budget of the repository and its pull requests.

use super::{files, workspace};
use mpm_verify::{cases, golden};

/// Particle–node pairs of the tier of pull requests, most of them explicit: 3.8 thousand millions of `spin`, 2.0 of `thin`,
/// 1.8 of twenty periods of `standing-wave`, 1.4 of `translate`, 1.1 of `critical-step`, 0.8 each of `stretch` and of
/// oblique, grazing and missing `discs`, 0.5 of `rest`.
const PAIRS: u64 = 142_516_000_000;

/// Entries of the matrices that it factorises, over all factorisations: some thirty seconds of a processor, assembly
/// and all; a ninth of it are the discs', 19.4 million the manufactured motion of solid and water's, 12.8
/// `consolidation`'s, 19.8 `mandel`'s, 14.7 `strip`'s, 37 `excavation`'s, 3.7 `footing`'s, 4.2 `slope-stability`'s, 8.3
/// `newton`'s, 1.2 `drop`'s, 0.4 `stretch`'s, 19.3 `sparse`'s, 11.7 `thin`'s.
const NONZEROS: u64 = 222_000_000;

#[test]
fn the_pr_tier_factorises_few_enough_entries() {
    let root = workspace().join("golden");
    let planned = cases::all().iter().filter(|case| !golden::runs(case).is_empty());
    let entries: u64 = planned.map(|case| golden::nonzeros(&root, case.name).unwrap_or_else(|e| panic!("{e}"))).sum();
    assert!(entries > 0 && entries <= NONZEROS, "{entries} entries");
}

#[test]
fn the_pr_tier_visits_few_enough_pairs() {
    let root = workspace().join("golden");
    let planned = cases::all().iter().filter(|case| !golden::runs(case).is_empty());
    let pairs: u64 =
        planned.map(|case| golden::pairs(&root, case.name).unwrap_or_else(|e| panic!("bless it first: {e}"))).sum();
    assert!(pairs <= PAIRS, "{pairs} pairs");
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
