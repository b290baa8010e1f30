use super::*;
use crate::case::Tier;
use crate::record::BREAKS_DOWN;
use crate::record::fixture::record;
use crate::study::judge::{judge, judged_run};
use crate::verdict::{Kind, Outcome, Verdict};

fn verdict(check: &str, kind: Kind, outcome: Outcome) -> Verdict {
    let found = crate::check::Finding::within("tip_ux", 1.0, 1.0, 0.0, "");
    Verdict { outcome, ..found.verdict(check, kind) }
}

fn cells(records: &[Record]) -> Vec<(String, String)> {
    let cell = |c: &Cell| (c.mark.clone() + &c.share, c.words.clone());
    let panels = panels(records, &Speed::of([]));
    let lines = panels.iter().flat_map(|panel| &panel.lines);
    lines.flat_map(|line| line.cells.iter().flatten().map(cell)).collect()
}

#[test]
fn every_planned_scheme_has_a_cell_in_every_case() {
    let all = cases::all().iter();
    let planned = all.flat_map(|case| case.runs(Tier::Long).into_iter().map(move |s| (case, s)));
    let runs = planned.map(|(case, spec)| {
        let mut run = record(spec.level.name, Vec::new());
        (run.case, run.scheme, run.set) = (case.name.to_owned(), spec.scheme, spec.set);
        run
    });
    let runs: Vec<Record> = runs.collect();
    let panels = panels(&runs, &Speed::of([]));
    for run in &runs {
        let of_kind = panels.iter().find(|p| p.name == panel_of(run.scheme())).unwrap();
        let mut lines = of_kind.lines.iter().filter(|l| l.scheme == run.scheme().title());
        let (line, place) = (lines.next().unwrap(), of_kind.cases.iter().position(|c| *c == run.case));
        assert!(line.cells[place.unwrap()].is_some(), "{} {}", run.case, line.scheme);
        assert!(lines.next().is_none(), "{}", line.scheme);
    }
}

#[test]
fn a_cell_tells_the_worst_of_its_runs() {
    let right = || record("h1", vec![verdict("tip", Kind::Truth, Outcome::Right)]);
    let mut runs = vec![record("h4", Vec::new())];
    let mut add = |run: Record, text: &str| {
        runs.push(run);
        let [(found, words)] = &cells(&runs)[..] else { panic!("{text}") };
        assert_eq!(found, text);
        words.clone()
    };
    assert_eq!(add(right(), "✓ 1/2"), "1 right, 1 not judged");
    let mut noisy = right();
    noisy.measure(&[("checkerboard_ratio", 0.70)]);
    add(noisy.clone(), "✓ 2/3");
    add(record("h1", vec![verdict("locks", Kind::KnownLimit, Outcome::WrongAsKnown)]), "≈ 1/4");
    noisy.measure(&[("checkerboard_ratio", 0.71)]);
    add(noisy, "∿ 1/5");
    let mut broken = record("h1", vec![verdict(BREAKS_DOWN, Kind::KnownLimit, Outcome::WrongAsKnown)]);
    broken.break_down("off-grid", 1.0, "");
    let words = add(broken.clone(), "↯a 1/6");
    assert!(words.ends_with("1 breaks down as known, 1 not judged, off-grid"), "{words}");
    broken.verdicts.clear();
    add(broken, "✗a 1/7");
}

#[test]
fn what_a_broken_stage_measures_changes_the_cell() {
    let case = cases::find(CRITICAL_STEP.0).unwrap();
    let spec = case.runs(Tier::Quick).into_iter().find(|s| s.set == STEPS[0].0).unwrap();
    let mut run = judged_run(case, &spec, None, 1, &|_| ()).unwrap();
    let panel = |run: &Record| {
        let panels = panels([run], &Speed::of([]));
        let line = &panels[0].lines[0];
        (line.numbers[0].clone(), line.cells[0].as_ref().map_or(String::new(), |c| c.class.clone()))
    };
    assert_eq!(panel(&run), (fixed(2).text(run.value(CRITICAL_STEP.1)), "pass".to_owned()));
    let step = run.metrics.get_mut(CRITICAL_STEP.1).unwrap();
    step.value = step.value.map(|cfl| 0.9 * cfl);
    run.verdicts = judge(case, &run);
    assert_eq!(panel(&run).1, "fail");
}
