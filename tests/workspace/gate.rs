//! The gate: drift and blessing. What a damaged golden says is tried beside its code.

use super::scene::{RUN, Scene};
use super::{code, files, json, stderr, stdout};
use serde_json::json;
use std::fs;

#[test]
fn a_sound_report_holds_against_its_goldens() {
    let scene = Scene::new();
    assert_eq!(code(&scene.report()), 0);
    assert_eq!(scene.drift(), [""; 0]);
}

/// For a case without goldens everything is new, and without their folder nothing is done.
#[test]
fn without_goldens_a_report_drifts_and_without_their_folder_it_is_refused() {
    let scene = Scene::new();
    fs::remove_file(scene.golden.join("cook.json")).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 3, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("FAILED [DRIFT] cook gimp-none-flip/h2"));
    fs::remove_dir_all(&scene.golden).unwrap();
    for output in [scene.report(), scene.bless("no folder")] {
        assert_eq!(code(&output), 2);
        let said = stderr(&output);
        assert!(said.contains("no folder of goldens"), "{said}");
    }
}

#[test]
fn drift_is_shown_named_and_accepted_with_a_reason() {
    let scene = Scene::new();
    // A golden of other numbers, as if the solver had changed since.
    let file = scene.golden.join("cook.json");
    let sound = fs::read_to_string(&file).unwrap();
    let run = sound.find(&format!("\"name\":\"{RUN}\"")).unwrap();
    let tip = "\"metric/tip_uy (m)\",\"points\":[[null,";
    let begin = run + sound[run..].find(tip).unwrap() + tip.len();
    let end = begin + sound[begin..].find(',').unwrap();
    let old = format!("{}0.27{}", &sound[..begin], &sound[end..]);
    fs::write(&file, old).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 3);
    let said = stdout(&output);
    let words: Vec<&str> = said.split_whitespace().collect();
    let line = words.join(" ");
    assert!(line.contains("tip_uy (m): golden 0.27, now "), "{said}");
    assert!(said.contains("bless cook --reason"), "{said}");
    let summary = fs::read_to_string(scene.report.join("summary.md")).unwrap();
    assert!(summary.contains("## Drift") && summary.contains("bless cook --reason"));
    let shown = scene.report.join(format!("cook/drift/{RUN}.png"));
    let picture = image::open(&shown).unwrap().to_rgb8();
    assert!(picture.width() > 3 * 480, "old, new and difference side by side");

    assert_eq!(code(&scene.bless("  ")), 2);
    let output = scene.bless("the load's place\nhas changed");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let said = stdout(&output);
    assert!(said.contains("golden 0.27") && said.contains("1 goldens blessed"), "{said}");
    // The numbers are what they were, to the last digit that is kept; the blessing has a line.
    let blessed = fs::read_to_string(&file).unwrap();
    let numbers = |text: &str| text.split_once("\"runs\"").unwrap().1.to_owned();
    assert_eq!(numbers(&blessed), numbers(&sound));
    let last = blessed.lines().nth(2).unwrap();
    assert!(last.starts_with("\"20") && last.contains(": the load's place has changed (source "), "{last}");
    assert_eq!(code(&scene.report()), 0);
    assert!(!shown.exists(), "what no longer drifts is no longer shown");
    assert!(stdout(&scene.bless("again")).contains("0 goldens blessed"));
    assert_eq!(fs::read_to_string(&file).unwrap(), blessed);
}

/// One step more is drift; the pairs of a case are the sum over its runs.
#[test]
fn work_is_compared_exactly_and_summed() {
    let scene = Scene::new();
    let mut record = json(&scene.record());
    let steps = record["work"]["steps"].as_u64().unwrap();
    record["work"]["steps"] = json!(steps + 1);
    fs::write(scene.record(), record.to_string()).unwrap();
    let drift = scene.drift();
    assert!(drift.len() == 1 && drift[0].contains("count of steps"), "{drift:?}");

    // Only the quick tier's runs of the pr tier are blessed here.
    let error = mpm_verify::golden::pairs(&scene.golden, "cook").unwrap_err().to_string();
    assert!(error.contains("cook.json: no golden of "), "{error}");
}

#[test]
fn a_result_that_misses_the_truth_cannot_be_blessed() {
    let scene = Scene::new();
    scene.falsify("mid_edge_uy", 1.05);
    let before = files(&scene.golden);
    let output = scene.bless("it is what the code gives");
    assert_eq!(code(&output), 1);
    let said = stdout(&output);
    assert!(said.contains("refused") && said.contains("mid-edge"), "{said}");
    assert!(files(&scene.golden) == before);
    // Both are red: the truth decides.
    assert_eq!(code(&scene.report()), 1);
}

#[test]
fn results_of_another_program_cannot_be_blessed() {
    let scene = Scene::new();
    let records = files(&scene.report).into_keys();
    for record in records.filter(|f| f.ends_with("record.json")) {
        let path = scene.report.join(record);
        let old = fs::read_to_string(&path).unwrap();
        let new = old.replace("\"source\": \"", "\"source\": \"0");
        assert_ne!(old, new);
        fs::write(path, new).unwrap();
    }
    let output = scene.bless("why not");
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("run `verify` first"), "{}", stderr(&output));
}
