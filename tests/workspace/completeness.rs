//! Nothing is forgotten: every case, scheme and level is run, measured, judged, blessed and described.

use super::{golden, workspace};
use mpm_verify::case::{Case, RunSpec, Tier};
use mpm_verify::cases;
use mpm_verify::check::Kind;
use mpm_verify::golden::{Golden, MARGIN, MOST_STEPS};
use mpm_verify::record::Record;
use std::collections::BTreeSet;
use std::path::PathBuf;

const TIERS: [Tier; 4] = [Tier::Quick, Tier::Pr, Tier::Nightly, Tier::Long];

fn planned(case: &dyn Case) -> Vec<RunSpec> {
    TIERS.iter().flat_map(|tier| case.plan(*tier)).collect()
}

/// Runs with a golden: neither of the tier that is run by hand, nor too long to be run twice.
fn gated(case: &dyn Case) -> BTreeSet<String> {
    let summary = super::json(&workspace().join("reports/nightly/summary.json"));
    let studies = summary["cases"].as_array().unwrap();
    let study = studies.iter().find(|s| s["case"] == case.name()).unwrap();
    let long: BTreeSet<String> = study["records"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| serde_json::from_value::<Record>(r.clone()).unwrap())
        .filter(|r| r.work.particle_steps > MOST_STEPS)
        .map(|r| r.folder())
        .collect();
    TIERS[..3]
        .iter()
        .flat_map(|tier| case.plan(*tier))
        .map(|spec| spec.folder())
        .filter(|folder| !long.contains(folder))
        .collect()
}

#[test]
fn every_scheme_and_level_belongs_to_a_tier() {
    for case in cases::all() {
        let plan = planned(case);
        for scheme in case.schemes() {
            for level in case.levels() {
                let there = plan.iter().any(|s| s.scheme == scheme && s.level == *level);
                assert!(
                    there,
                    "{} {scheme} {} is in no tier",
                    case.name(),
                    level.name
                );
            }
        }
        for spec in &plan {
            assert!(case.schemes().contains(&spec.scheme));
            assert!(case.levels().contains(&spec.level));
        }
        let pr: BTreeSet<String> = case.plan(Tier::Pr).iter().map(RunSpec::folder).collect();
        let nightly: BTreeSet<String> = case
            .plan(Tier::Nightly)
            .iter()
            .map(RunSpec::folder)
            .collect();
        assert!(
            pr.is_subset(&nightly),
            "what a change is judged by, a night is too"
        );
    }
}

#[test]
fn every_gated_run_has_a_golden_and_every_golden_a_run() {
    for case in cases::all() {
        let root = golden().join(case.name());
        let gated = gated(case);
        for run in &gated {
            let golden = Golden::read(&root.join(run)).unwrap_or_else(|e| panic!("{e}"));
            for t in golden.tolerances() {
                assert!(
                    t.tolerance >= t.response && t.tolerance <= MARGIN * t.response,
                    "{run} {} {}",
                    t.table,
                    t.column
                );
            }
        }
        let mut kept = BTreeSet::new();
        for scheme in std::fs::read_dir(&root).unwrap() {
            let scheme: PathBuf = scheme.unwrap().path();
            for level in std::fs::read_dir(&scheme).unwrap() {
                let level = level.unwrap().path();
                kept.insert(level.strip_prefix(&root).unwrap().display().to_string());
            }
        }
        let orphans: Vec<_> = kept.difference(&gated).collect();
        assert!(orphans.is_empty(), "goldens of no run: {orphans:?}");
    }
}

#[test]
fn every_run_is_measured_and_judged_against_the_truth() {
    let path = workspace().join("reports/nightly/summary.json");
    let summary = super::json(&path);
    for case in cases::all() {
        assert!(!case.metrics().is_empty());
        assert!(case.checks().iter().any(|c| c.kind == Kind::Truth));
        let known: Vec<&str> = case.metrics().iter().map(|m| m.name).collect();
        for name in case.headlines().iter().map(|h| h.metric) {
            assert!(known.contains(&name), "headline {name} is no metric");
        }
        for name in case.quantities().iter().map(|q| q.metric) {
            assert!(known.contains(&name), "quantity {name} is no metric");
        }
        let studies = summary["cases"].as_array().unwrap();
        let study = studies.iter().find(|s| s["case"] == case.name()).unwrap();
        let records = study["records"].as_array().unwrap();
        assert_eq!(
            records.len(),
            case.plan(Tier::Nightly).len(),
            "the committed nightly report is of another plan"
        );
        for record in records {
            let applied =
                record["verdicts"].as_array().unwrap().iter().any(|v| {
                    v["kind"] == "truth" && !v["pass"].is_null() && v["check"] != "completes"
                });
            assert!(
                applied,
                "no check against the truth: {} {}",
                record["level"], record["set"]
            );
            for name in record["metrics"].as_object().unwrap().keys() {
                assert!(known.contains(&name.as_str()), "{name} is not explained");
            }
        }
    }
}

#[test]
fn every_case_has_a_page_that_names_what_it_checks() {
    for case in cases::all() {
        let path = workspace().join(format!("docs/{}.md", case.name()));
        let page = std::fs::read_to_string(&path).unwrap();
        for part in [
            "## Set-up",
            "## Reference",
            "## Tolerances",
            "## Results",
            "## Limits",
        ] {
            assert!(page.contains(part), "{}: no {part}", path.display());
        }
        assert!(page.contains("!["), "{}: no picture", path.display());
        assert!(!case.limits().is_empty() && !case.references().is_empty());
        assert!(!case.sketch().shapes.is_empty());
    }
}

#[test]
fn the_nightly_report_is_small_and_holds_no_particles() {
    let all = super::files(&workspace().join("reports/nightly"));
    let bytes: usize = all.values().map(Vec::len).sum();
    assert!(bytes <= 20_000_000, "{bytes} bytes");
    assert!(
        all.keys()
            .all(|name| name.extension().is_none_or(|e| e != "vtu"))
    );
    assert!(all.contains_key(&PathBuf::from("summary.md")));
}
