//! A report brought up to date case by case.

use super::{code, copy_tree, files, golden, json, mpm_verify, quick, stderr, stdout, text};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

/// The case that is run again: its quick tier takes no time.
const CASE: &str = "vibrating-bar";
/// The program that seems to have made the runs of that case.
const OTHER: &str = "000000000000";

/// A report of the first night of 2026 without the runs it was made of, and new runs of one case.
struct Scene {
    _folder: tempfile::TempDir,
    report: PathBuf,
    runs: PathBuf,
}

impl Scene {
    fn new() -> Self {
        static MADE: OnceLock<tempfile::TempDir> = OnceLock::new();
        let made = MADE.get_or_init(|| {
            let folder = tempfile::tempdir().unwrap();
            let [report, runs] = ["report", "runs"].map(|name| folder.path().join(name));
            let night = ["--night", "2026-01-01", "--commit", "first"];
            let begin = ["report", text(quick().0), "--out", text(&report)];
            sound(&[&begin[..], &night].concat());
            sound(&["verify", CASE, "--tier", "quick", "--out", text(&runs)]);
            for record in records(&runs) {
                edit(&record, "/version/source", |_| json!(OTHER));
            }
            folder
        });
        let folder = tempfile::tempdir().unwrap();
        copy_tree(made.path(), folder.path());
        Self {
            report: folder.path().join("report"),
            runs: folder.path().join("runs"),
            _folder: folder,
        }
    }

    fn summary(&self) -> PathBuf {
        self.report.join("summary.json")
    }

    fn update(&self, golden: &Path, commit: &str) -> Output {
        mpm_verify(&[
            "report",
            text(&self.runs),
            "--out",
            text(&self.report),
            "--update",
            "--golden",
            text(golden),
            "--night",
            "2026-01-02",
            "--commit",
            commit,
        ])
    }
}

fn sound(arguments: &[&str]) {
    let golden = golden();
    let output = mpm_verify(&[arguments, &["--golden", text(&golden)]].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
}

fn records(runs: &Path) -> Vec<PathBuf> {
    let all = files(runs)
        .into_keys()
        .filter(|f| f.ends_with("record.json"));
    all.map(|file| runs.join(file)).collect()
}

/// Changes a value of a JSON document.
fn edit(path: &Path, pointer: &str, change: impl Fn(&Value) -> Value) {
    let mut document = json(path);
    let place = document.pointer_mut(pointer).unwrap();
    *place = change(place);
    fs::write(path, document.to_string()).unwrap();
}

fn case_of<'a>(summary: &'a Value, name: &str) -> &'a Value {
    let cases = summary["cases"].as_array().unwrap();
    let found = cases.iter().find(|c| c["case"] == name);
    found.unwrap_or_else(|| panic!("{name} is not in the summary"))
}

fn names(summary: &Value) -> Vec<String> {
    let cases = summary["cases"].as_array().unwrap();
    cases
        .iter()
        .map(|c| c["case"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn the_case_given_is_drawn_anew_and_the_others_stay_byte_for_byte() {
    let scene = Scene::new();
    let stale = scene.report.join(CASE).join("stale.png");
    fs::write(&stale, "of another time").unwrap();
    let drawn = scene.report.join(CASE).join("convergence.png");
    fs::write(&drawn, "of another time").unwrap();
    let (before, said) = (files(&scene.report), json(&scene.summary()));

    let output = scene.update(&golden(), "second");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let (after, says) = (files(&scene.report), json(&scene.summary()));

    let of_all = [
        "history.csv",
        "index.html",
        "junit.xml",
        "summary.json",
        "summary.md",
    ];
    let touched = |file: &Path| {
        let mine = [
            CASE.to_owned(),
            format!("{CASE}.html"),
            format!("trends-{CASE}.png"),
        ];
        mine.iter().any(|m| file.starts_with(m)) || of_all.iter().any(|f| file == Path::new(f))
    };
    let untouched = before.iter().filter(|(file, _)| !touched(file));
    assert!(untouched.clone().count() > 50);
    for (file, content) in untouched {
        assert!(after.get(file) == Some(content), "{}", file.display());
    }
    assert!(
        after
            .keys()
            .all(|file| touched(file) || before.contains_key(file))
    );
    assert!(!stale.exists());
    assert!(image::open(&drawn).is_ok(), "drawn anew");

    assert_eq!(names(&says), names(&said));
    assert_eq!(says["counts"], said["counts"]);
    for name in names(&said).iter().filter(|n| *n != CASE) {
        assert_eq!(case_of(&says, name), case_of(&said, name), "{name}");
    }
    let case = case_of(&says, CASE);
    assert_eq!(case["records"][0]["version"]["source"], OTHER);
    assert_eq!(
        case["night"],
        json!({"date": "2026-01-02", "commit": "second"})
    );
    let shown = case["pictures"].as_array().unwrap();
    assert!(!shown.is_empty());
    for picture in shown {
        let file = Path::new(picture["file"].as_str().unwrap());
        assert!(after.contains_key(file), "{}", file.display());
    }

    // Every page tells what made it, and that of all cases tells of both programs.
    let page = |file: &str| String::from_utf8_lossy(&after[Path::new(file)]).into_owned();
    let own = case_of(&said, "cook")["records"][0]["version"]["source"]
        .as_str()
        .unwrap();
    for file in ["index.html", "summary.md"] {
        assert!(
            page(file).contains(OTHER) && page(file).contains(own),
            "{file}"
        );
    }
    let one = page(&format!("{CASE}.html"));
    assert!(one.contains(OTHER) && one.contains("second") && !one.contains(own));
    assert!(page("cook.html").contains(own) && page("cook.html").contains("first"));
}

#[test]
fn a_night_of_one_case_adds_that_case_alone_to_the_history() {
    let scene = Scene::new();
    let path = scene.report.join("history.csv");
    let before = fs::read_to_string(&path).unwrap();
    assert_eq!(code(&scene.update(&golden(), "second")), 0);
    assert_eq!(code(&scene.update(&golden(), "third")), 0);
    let after = fs::read_to_string(&path).unwrap();
    let added = after.strip_prefix(&before).unwrap();
    let own = before
        .lines()
        .filter(|l| l.contains(&format!(",first,{CASE},")));
    assert_eq!(added.lines().count(), own.count());
    let start = format!("2026-01-02,third,{CASE},");
    assert!(
        !added.is_empty() && added.lines().all(|l| l.starts_with(&start)),
        "{added}"
    );
}

/// Of what is kept, the truth is judged by the checks as they are; drift can't be judged without the runs.
#[test]
fn the_truth_of_what_is_kept_is_judged_again_and_its_drift_stays() {
    let scene = Scene::new();
    let drift = |summary: &Value, case: &str| {
        let records = case_of(summary, case)["records"].as_array().unwrap();
        let verdicts = records
            .iter()
            .flat_map(|r| r["verdicts"].as_array().unwrap());
        let drift = verdicts.filter(|v| v["kind"] == "drift" && v["outcome"] != "not-judged");
        drift.cloned().collect::<Vec<_>>()
    };
    let before = drift(&json(&scene.summary()), "cook");
    assert!(before.len() > 20 && before.iter().all(|v| v["outcome"] == "right"));
    let none = tempfile::tempdir().unwrap();
    assert_eq!(code(&scene.update(none.path(), "second")), 3);
    let after = json(&scene.summary());
    assert_eq!(drift(&after, "cook"), before);
    assert!(drift(&after, CASE).iter().all(|v| v["outcome"] == "failed"));

    let metric = "/cases/0/records/0/metrics/at_rest/value";
    edit(&scene.summary(), metric, |_| json!(0.0));
    let output = scene.update(&golden(), "third");
    assert_eq!(code(&output), 1, "{}", stdout(&output));
    let after = json(&scene.summary());
    assert!(after["counts"]["failed"].as_u64().unwrap() > 0);
    assert_eq!(after["counts"]["drifted"], 0);
}

#[test]
fn a_case_that_is_known_no_more_is_dropped() {
    let scene = Scene::new();
    let known = names(&json(&scene.summary()));
    edit(&scene.summary(), "/cases/1/case", |_| json!("bridge"));
    fs::create_dir(scene.report.join("bridge")).unwrap();
    let remains = [
        "bridge.html",
        "trends-bridge.png",
        "bridge/study.json",
        "bridge/a.png",
    ];
    for file in remains {
        fs::write(scene.report.join(file), "").unwrap();
    }
    assert_eq!(code(&scene.update(&golden(), "second")), 0);
    let kept = known.iter().filter(|name| **name != known[1]);
    assert!(names(&json(&scene.summary())).iter().eq(kept));
    for file in remains {
        assert!(!scene.report.join(file).exists(), "{file}");
    }
}

#[test]
fn a_case_that_is_new_finds_its_place() {
    let scene = Scene::new();
    let known = names(&json(&scene.summary()));
    edit(&scene.summary(), "/cases", |cases| {
        let others = cases
            .as_array()
            .unwrap()
            .iter()
            .filter(|c| c["case"] != CASE);
        // In no particular order.
        others.rev().cloned().collect()
    });
    assert_eq!(code(&scene.update(&golden(), "second")), 0);
    assert_eq!(names(&json(&scene.summary())), known);
}

#[test]
fn what_cannot_be_updated_is_refused_and_left_alone() {
    type Damage = (fn(&Scene), &'static str);
    let damages: [Damage; 7] = [
        (
            |s| fs::remove_file(s.summary()).unwrap(),
            "summary.json: missing: no report to update",
        ),
        (
            |s| fs::write(s.summary(), "{").unwrap(),
            "summary.json: damaged",
        ),
        (
            |s| edit(&s.summary(), "/schema", |_| json!(2)),
            "summary.json: schema 2 where 3 is expected",
        ),
        (
            |s| edit(&s.summary(), "/tier", |_| json!("pr")),
            "summary.json: of tier pr where quick is expected",
        ),
        (
            |s| {
                edit(&s.summary(), "/cases/0/records/1/version/source", |_| {
                    json!(OTHER)
                })
            },
            "summary.json: records of two programs: cook",
        ),
        // New runs of a case by two programs, or not all of them.
        (
            |s| {
                only_cook(s);
                edit(&records(&s.runs)[0], "/version/source", |_| json!(OTHER));
            },
            "records of two programs: cook",
        ),
        (
            |s| {
                only_cook(s);
                fs::remove_file(&records(&s.runs)[0]).unwrap();
            },
            "runs have no record",
        ),
    ];
    for (damage, needle) in damages {
        let scene = Scene::new();
        damage(&scene);
        let before = files(&scene.report);
        let output = scene.update(&golden(), "second");
        let said = stderr(&output);
        assert_eq!(code(&output), 2, "{needle}: {said}");
        assert!(said.contains(needle) && said.lines().count() == 1, "{said}");
        assert!(
            files(&scene.report) == before,
            "{needle}: something has changed"
        );
    }
    let nowhere = mpm_verify(&["report", text(quick().0), "--update"]);
    assert_eq!(code(&nowhere), 2);
    assert!(stderr(&nowhere).contains("--out"), "{}", stderr(&nowhere));
}

/// Makes the new runs those of Cook's membrane, of which there are several.
fn only_cook(scene: &Scene) {
    fs::remove_dir_all(&scene.runs).unwrap();
    copy_tree(&quick().0.join("cook"), &scene.runs.join("cook"));
    fs::copy(quick().0.join("plan.json"), scene.runs.join("plan.json")).unwrap();
    edit(&scene.runs.join("plan.json"), "/runs", |runs| {
        let runs = runs.as_array().unwrap().iter();
        runs.filter(|r| r["case"] == "cook").cloned().collect()
    });
}
