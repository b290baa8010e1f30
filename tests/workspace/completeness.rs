//! Nothing is forgotten: every case, scheme and level is run, measured, judged and described.

use super::workspace;
use mpm_verify::case::{Case, RunSpec, Tier};
use mpm_verify::cases;
use mpm_verify::files::read_versioned;
use mpm_verify::record::Record;
use mpm_verify::run::judge;
use mpm_verify::study::{SCHEMA, Summary, has_truth};
use mpm_verify::verdict::Kind;
use std::collections::BTreeSet;
use std::path::PathBuf;

const TIERS: [Tier; 4] = [Tier::Quick, Tier::Pr, Tier::Nightly, Tier::Long];

fn planned(case: &dyn Case) -> Vec<RunSpec> {
    TIERS.iter().flat_map(|tier| case.plan(*tier)).collect()
}

/// The records of the committed nightly report.
fn last_night(case: &dyn Case) -> Vec<Record> {
    let path = workspace().join("reports/nightly/summary.json");
    let summary: Summary = read_versioned(&path, SCHEMA).unwrap();
    let study = summary.cases.into_iter().find(|s| s.case == case.name());
    study.unwrap().records
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

/// By the checks as they are now, on the metrics of last night.
#[test]
fn every_run_is_measured_and_judged_against_the_truth() {
    for case in cases::all() {
        assert!(case.checks().iter().any(|c| c.kind == Kind::Truth));
        let known: Vec<&str> = case.metrics().iter().map(|m| m.name).collect();
        for name in case.headlines().iter().map(|h| h.metric) {
            assert!(known.contains(&name), "headline {name} is no metric");
        }
        for name in case.quantities().iter().map(|q| q.metric) {
            assert!(known.contains(&name), "quantity {name} is no metric");
        }
        let records = last_night(case);
        let ran: BTreeSet<String> = records.iter().map(Record::folder).collect();
        let plan = case.plan(Tier::Nightly);
        let planned: BTreeSet<String> = plan.iter().map(RunSpec::folder).collect();
        assert_eq!(ran, planned, "the committed report is of another plan");
        for mut record in records {
            record.verdicts = judge(case, &record);
            assert!(has_truth(&record), "no check: {}", record.folder());
            for name in record.metrics.keys() {
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

/// Of the long tier some runs have ended and the others are said not to have.
#[test]
fn the_report_of_long_runs_is_of_the_plan() {
    let path = workspace().join("reports/long/summary.json");
    let summary: Summary = read_versioned(&path, SCHEMA).unwrap();
    assert_eq!(summary.tier, "long");
    for study in &summary.cases {
        let case = cases::find(&study.case).unwrap();
        let ended = study.records.iter().map(Record::folder);
        let told: BTreeSet<String> = ended.chain(study.pending.iter().cloned()).collect();
        let plan = case.runs(Tier::Long);
        let planned: BTreeSet<String> = plan.iter().map(RunSpec::folder).collect();
        assert_eq!(told, planned, "{} is of another plan", study.case);
        let long: BTreeSet<String> = case.plan(Tier::Long).iter().map(RunSpec::folder).collect();
        let is_long = |r: &Record| long.contains(&r.folder());
        assert!(study.records.iter().any(is_long), "no long run has ended");
    }
}

#[test]
fn the_committed_reports_are_small_and_hold_no_particles() {
    for (report, most) in [("nightly", 100_000_000), ("long", 40_000_000)] {
        let all = super::files(&workspace().join("reports").join(report));
        let bytes: usize = all.values().map(Vec::len).sum();
        assert!(bytes <= most, "{report}: {bytes} bytes");
        let are_particles = |name: &PathBuf| name.extension().is_some_and(|e| e == "vtu");
        assert!(!all.keys().any(are_particles), "{report}");
        assert!(all.contains_key(&PathBuf::from("summary.md")), "{report}");
    }
}
