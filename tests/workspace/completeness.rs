//! Nothing is forgotten: every case, scheme and level is planned, measured, judged and described. Judged by the plans;
//! that all has been run is what ends a night.

use super::workspace;
use mpm_verify::case::{Case, Tier};
use mpm_verify::cases;
use mpm_verify::parameter::Parameters;
use mpm_verify::spec::RunSpec;
use mpm_verify::verdict::Kind;
use std::collections::BTreeSet;

fn folders(case: &Case, tier: Tier) -> BTreeSet<String> {
    case.runs(tier).iter().map(RunSpec::folder).collect()
}

#[test]
fn every_scheme_and_level_belongs_to_a_tier() {
    for case in cases::all() {
        let plan = case.runs(Tier::Long);
        let once: BTreeSet<_> = case.schemes().into_iter().collect();
        assert_eq!(once.len(), case.schemes().len(), "{}", case.name);
        for scheme in case.schemes() {
            for level in &case.levels {
                let there = plan.iter().any(|s| s.scheme == scheme && s.level == *level);
                assert!(there, "{} {scheme} {} is in no tier", case.name, level.name);
            }
        }
        assert!(plan.iter().all(|s| case.levels.contains(&s.level)));
        for (less, more) in [(Tier::Quick, Tier::Pr), (Tier::Pr, Tier::Nightly)] {
            let (less, more) = (folders(case, less), folders(case, more));
            assert!(less.is_subset(&more), "{}", case.name);
        }
        assert!(!case.runs(Tier::Pr).is_empty(), "{}", case.name);
    }
}

#[test]
fn every_planned_run_has_parameters_that_are_allowed() {
    for case in cases::all() {
        for spec in case.runs(Tier::Long) {
            let parameters = Parameters::new(&case.parameters, &spec.set);
            assert!(parameters.is_ok(), "{} {}", case.name, spec.folder());
        }
    }
}

#[test]
fn every_case_is_described_measured_and_checked_against_the_truth() {
    for case in cases::all() {
        let name = case.name;
        assert!(!case.title.is_empty() && !case.description.is_empty());
        assert!(!case.references.is_empty() && !case.limits.is_empty());
        assert!(!case.metrics.is_empty() && !case.headlines.is_empty());
        assert!(!case.watched.is_empty(), "{name}");
        assert!(case.checks.iter().any(|c| c.kind == Kind::Truth), "{name}");
        assert!(!case.sketch.shapes.is_empty(), "{name}");
        let names: BTreeSet<&str> = case.metrics.iter().map(|m| m.name).collect();
        assert_eq!(names.len(), case.metrics.len(), "{name}: a metric twice");
        for headline in &case.headlines {
            let metric = headline.metric.unwrap();
            assert!(case.metrics.contains(&metric), "{name}");
        }
        for quantity in &case.quantities {
            assert!(case.metrics.contains(&quantity.metric), "{name}");
        }
        for sweep in &case.sweeps {
            let swept = sweep.parameter.name;
            let known = case.parameters.iter().any(|p| p.name == swept);
            assert!(known, "{name}: {swept}");
        }
        let checks: BTreeSet<&str> = case.checks.iter().map(|c| c.name).collect();
        assert_eq!(checks.len(), case.checks.len(), "{name}: a check twice");
        let parameters: BTreeSet<&str> = case.parameters.iter().map(|p| p.name).collect();
        assert_eq!(parameters.len(), case.parameters.len(), "{name}");
    }
}

#[test]
fn every_case_has_a_page() {
    for case in cases::all() {
        let page = workspace().join(format!("docs/{}.md", case.name));
        assert!(page.exists(), "{} is missing", page.display());
    }
}
