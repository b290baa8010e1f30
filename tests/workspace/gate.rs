//! The gate: drift, blessing, damaged goldens, the difference of two reports.

use super::{code, copy_tree, files, golden, json, mpm_verify, quick, stderr, stdout, text};
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

const RUN: &str = "cook/gimp-fbar-rate-flip/h2";
const OTHER: &str = "cook/gimp-none-flip/h2";

/// The report of two runs of the quick tier, made once. A report is drawn anew for every defect: few pictures are enough.
fn two_runs() -> &'static Path {
    static REPORT: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = REPORT.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let mut plan = json(&quick().0.join("plan.json"));
        let runs = plan["runs"].as_array_mut().unwrap();
        runs.retain(|run| {
            let remedy = &run["scheme"]["remedy"];
            run["case"] == "cook" && (remedy == "none" || remedy == "fbar-rate")
        });
        assert_eq!(runs.len(), 2);
        fs::write(folder.path().join("plan.json"), plan.to_string()).unwrap();
        for run in [RUN, OTHER] {
            copy_tree(&quick().0.join(run), &folder.path().join(run));
        }
        let made = mpm_verify(&["report", text(folder.path()), "--golden", text(&golden())]);
        assert_eq!(code(&made), 0, "{}{}", stdout(&made), stderr(&made));
        folder
    });
    folder.path()
}

/// Copies of the report and of its goldens.
struct Scene {
    _folder: tempfile::TempDir,
    report: PathBuf,
    golden: PathBuf,
}

impl Scene {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let scene = Self {
            report: folder.path().join("report"),
            golden: folder.path().join("golden"),
            _folder: folder,
        };
        copy_tree(two_runs(), &scene.report);
        for run in [RUN, OTHER] {
            copy_tree(&golden().join(run), &scene.golden.join(run));
        }
        scene
    }

    fn report(&self) -> std::process::Output {
        mpm_verify(&["report", text(&self.report), "--golden", text(&self.golden)])
    }

    fn bless(&self, reason: &str) -> std::process::Output {
        mpm_verify(&[
            "bless",
            "cook",
            "--reason",
            reason,
            "--from",
            text(&self.report),
            "--golden",
            text(&self.golden),
        ])
    }

    /// Changes a file of the golden of one run.
    fn edit(&self, file: &str, change: impl Fn(String) -> String) {
        let path = self.golden.join(RUN).join(file);
        let content = fs::read_to_string(&path).unwrap();
        let changed = change(content.clone());
        assert_ne!(content, changed, "{file}: nothing to change");
        fs::write(&path, changed).unwrap();
    }

    /// Multiplies a metric in a record, as if the solver had computed it.
    fn falsify(&self, metric: &str, factor: f64) {
        let path = self.report.join(RUN).join("record.json");
        let mut record = json(&path);
        let value = record["metrics"][metric]["value"].as_f64().unwrap();
        record["metrics"][metric]["value"] = json!(value * factor);
        fs::write(&path, record.to_string()).unwrap();
    }
}

fn without_last_line(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines[..lines.len() - 1].join("\n") + "\n"
}

/// The first cell of the second line replaced.
fn with_cell(text: &str, cell: &str) -> String {
    let (header, rest) = text.split_once('\n').unwrap();
    let (_, rest) = rest.split_once(',').unwrap();
    format!("{header}\n{cell},{rest}")
}

/// The tolerance of the tip replaced.
fn with_tolerance(text: &str, tolerance: &str) -> String {
    let line = |line: &str| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if cells[1] == "tip_uy (m)" {
            cells[3] = tolerance;
        }
        cells.join(",") + "\n"
    };
    text.lines().map(line).collect()
}

#[test]
fn a_sound_report_holds_against_its_goldens() {
    let scene = Scene::new();
    let output = scene.report();
    assert_eq!(code(&output), 0, "{}", stdout(&output));
}

#[test]
fn every_defect_of_a_golden_is_a_clear_line_and_exit_code_three() {
    type Damage = (&'static str, fn(&Path), &'static str);
    let damages: [Damage; 20] = [
        ("missing", |p| fs::remove_dir_all(p).unwrap(), "no golden"),
        (
            "no metrics",
            |p| fs::remove_file(p.join("metrics.csv")).unwrap(),
            "metrics.csv",
        ),
        (
            "no picture",
            |p| fs::remove_file(p.join("series.png")).unwrap(),
            "series.png",
        ),
        (
            "no counts",
            |p| fs::remove_file(p.join("work.csv")).unwrap(),
            "work.csv",
        ),
        (
            "counts cut",
            |p| change(p, "work.csv", without_last_line),
            "no rows",
        ),
        (
            "no blessing",
            |p| fs::remove_file(p.join("blessed.json")).unwrap(),
            "blessed.json",
        ),
        (
            "rows cut",
            |p| change(p, "series.csv", without_last_line),
            "rows where",
        ),
        (
            "number cut",
            |p| change(p, "series.csv", |t| t[..t.len() - 9].to_owned()),
            "series",
        ),
        (
            "NaN",
            |p| change(p, "series.csv", |t| with_cell(t, "NaN")),
            "row 1: NaN",
        ),
        (
            "infinite",
            |p| change(p, "metrics.csv", |t| with_cell(t, "inf")),
            "row 1: inf",
        ),
        (
            "not a number",
            |p| change(p, "metrics.csv", |t| with_cell(t, "x")),
            "metrics.csv",
        ),
        (
            "empty",
            |p| change(p, "metrics.csv", |_| String::new()),
            "metrics.csv",
        ),
        (
            "column renamed",
            |p| {
                change(p, "metrics.csv", |t| {
                    t.replacen("tip_uy (m)", "tip_uy (mm)", 1)
                })
            },
            "tip_uy",
        ),
        (
            "no tolerances",
            |p| change(p, "tolerances.csv", without_last_line),
            "no tolerance for",
        ),
        (
            "too loose",
            |p| change(p, "tolerances.csv", |t| with_tolerance(t, "0.1")),
            "1 to 10 times the response",
        ),
        (
            "too tight",
            |p| change(p, "tolerances.csv", |t| with_tolerance(t, "1e-30")),
            "1 to 10 times the response",
        ),
        (
            "tolerance twice",
            |p| {
                change(p, "tolerances.csv", |t| {
                    t.to_owned() + t.lines().last().unwrap() + "\n"
                })
            },
            "is there twice",
        ),
        (
            "not UTF-8",
            |p| fs::write(p.join("metrics.csv"), b"a,\xff\n1,2\n").unwrap(),
            "UTF-8",
        ),
        (
            "other schema",
            |p| {
                change(p, "blessed.json", |t| {
                    t.replace("\"schema\": 1", "\"schema\": 7")
                })
            },
            "schema 7 where 1",
        ),
        (
            "damaged picture",
            |p| fs::write(p.join("series.png"), b"\x89PNG broken").unwrap(),
            "series.png",
        ),
    ];
    let scene = Scene::new();
    let home = scene.golden.join(RUN);
    for (name, damage, needle) in damages {
        damage(&home);
        let output = scene.report();
        let said = stdout(&output);
        assert_eq!(code(&output), 3, "{name}: {said}{}", stderr(&output));
        let line = said.lines().find(|l| l.starts_with("FAIL [DRIFT]"));
        let line = line.unwrap_or_else(|| panic!("{name}: {said}"));
        assert!(line.contains(needle), "{name}: {line}");
        let _ = fs::remove_dir_all(&home);
        copy_tree(&golden().join(RUN), &home);
    }
}

fn change(folder: &Path, file: &str, change: impl Fn(&str) -> String) {
    let path = folder.join(file);
    let old = fs::read_to_string(&path).unwrap();
    let new = change(&old);
    assert_ne!(old, new, "{file}: nothing to change");
    fs::write(path, new).unwrap();
}

#[test]
fn drift_is_shown_named_and_accepted_with_a_reason() {
    let scene = Scene::new();
    // A golden of other numbers, as if the solver had changed since; another whose picture was drawn otherwise.
    scene.edit("metrics.csv", |t| {
        let (header, row) = t.split_once('\n').unwrap();
        let place = header.split(',').position(|h| h == "tip_uy (m)").unwrap();
        let mut cells: Vec<String> = row.trim().split(',').map(str::to_owned).collect();
        cells[place] = "0.27".to_owned();
        format!("{header}\n{}\n", cells.join(","))
    });
    let other = scene.golden.join(OTHER).join("series.png");
    image::RgbImage::new(30, 20).save(&other).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 3);
    let said = stdout(&output);
    assert!(said.contains("tip_uy (m): golden 0.27, now "), "{said}");
    assert!(said.contains("different pixels of the picture"), "{said}");
    assert!(said.contains("bless cook --reason"), "{said}");
    let summary = fs::read_to_string(scene.report.join("summary.md")).unwrap();
    assert!(summary.contains("## Drift") && summary.contains("bless cook --reason"));
    let shown = scene.report.join("cook/drift/gimp-fbar-rate-flip/h2.png");
    let picture = image::open(&shown).unwrap().to_rgb8();
    assert!(
        picture.width() > 3000,
        "old, new and difference side by side"
    );

    assert_eq!(code(&scene.bless("  ")), 2);
    let before = files(&scene.golden);
    let output = scene.bless("the load's place has changed");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(
        stdout(&output).contains("golden 0.27"),
        "{}",
        stdout(&output)
    );
    assert!(stdout(&output).contains("2 goldens blessed"));
    let blessed = json(&scene.golden.join(RUN).join("blessed.json"));
    assert_eq!(blessed["reason"], "the load's place has changed");
    assert_eq!(blessed["date"].as_str().unwrap().len(), 10);
    let after = files(&scene.golden);
    let changed: Vec<_> = after
        .iter()
        .filter(|(k, v)| before.get(*k) != Some(v))
        .collect();
    assert!(
        changed
            .iter()
            .all(|(k, _)| k.starts_with(RUN) || k.starts_with(OTHER))
    );
    assert_eq!(code(&scene.report()), 0);
    assert!(!shown.exists(), "what no longer drifts is no longer shown");
    assert!(stdout(&scene.bless("again")).contains("0 goldens blessed"));
}

/// One step more is drift of the counts alone, which is blessed without a twin.
#[test]
fn work_is_compared_exactly() {
    let scene = Scene::new();
    let path = scene.report.join(RUN).join("record.json");
    let mut record = json(&path);
    let steps = record["work"]["steps"].as_u64().unwrap();
    record["work"]["steps"] = json!(steps + 1);
    fs::write(&path, record.to_string()).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 3);
    let said = stdout(&output);
    assert!(said.contains("count of steps"), "{said}");
    let before = files(&scene.golden);
    let output = scene.bless("a step more");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let after = files(&scene.golden);
    let changed = after.iter().filter(|(k, v)| before.get(*k) != Some(v));
    let changed: Vec<_> = changed.map(|(k, _)| k.file_name().unwrap()).collect();
    assert_eq!(changed, ["blessed.json", "work.csv"]);
    assert_eq!(code(&scene.report()), 0);
}

/// A run that is too long for a golden has none; but a golden that is there is held against it.
#[test]
fn more_steps_do_not_hide_drift() {
    let scene = Scene::new();
    let path = scene.report.join(RUN).join("record.json");
    let mut record = json(&path);
    record["work"]["particle_steps"] = json!(3_000_000_000_u64);
    record["metrics"]["tip_uy"]["value"] = json!(0.27);
    fs::write(&path, record.to_string()).unwrap();
    assert_eq!(code(&scene.report()), 3);
    fs::remove_dir_all(scene.golden.join(RUN)).unwrap();
    assert_eq!(code(&scene.report()), 0);
    let summary = json(&scene.report.join("summary.json"));
    let verdicts = summary["cases"][0]["records"][1]["verdicts"]
        .as_array()
        .unwrap();
    let drift: Vec<_> = verdicts.iter().filter(|v| v["kind"] == "drift").collect();
    assert_eq!(drift.len(), 1);
    assert!(drift[0]["outcome"] == "not-judged");
}

#[test]
fn a_result_that_misses_the_truth_cannot_be_blessed() {
    let scene = Scene::new();
    scene.falsify("mid_edge_uy", 1.05);
    let before = files(&scene.golden);
    let output = scene.bless("it is what the code gives");
    assert_eq!(code(&output), 1);
    let said = stdout(&output);
    assert!(
        said.contains("refused") && said.contains("mid-edge"),
        "{said}"
    );
    assert!(files(&scene.golden) == before);
    // Both are red: the truth decides.
    assert_eq!(code(&scene.report()), 1);
}

#[test]
fn results_of_another_program_cannot_be_blessed() {
    let scene = Scene::new();
    let records = files(&scene.report).into_keys();
    for record in records.filter(|f| f.ends_with("record.json")) {
        let folder = scene.report.join(record);
        change(folder.parent().unwrap(), "record.json", |t| {
            t.replacen(
                "\"source\": \"",
                "\"source\": \"0",
                t.matches("\"source\": \"").count(),
            )
        });
    }
    let output = scene.bless("why not");
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("run `verify` first"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn the_difference_of_two_reports_is_numbers_and_pictures() {
    let (report, scene) = (two_runs(), Scene::new());
    let out = scene.report.parent().unwrap().join("diff");
    let count = |folder: &Path| {
        let mut summary = json(&folder.join("summary.json"));
        summary["cases"][0]["records"][0]["work"]["steps"] = json!(1);
        fs::write(folder.join("summary.json"), summary.to_string()).unwrap();
    };
    let diff = |new: &Path| mpm_verify(&["diff", text(report), text(new), "--out", text(&out)]);
    let same = diff(&scene.report);
    assert_eq!(code(&same), 0, "{}", stdout(&same));
    assert!(stdout(&same).contains("0 numbers, 0 verdicts and 0 pictures differ"));

    count(&scene.report);
    let steps = diff(&scene.report);
    assert_eq!(code(&steps), 3);
    assert!(
        stdout(&steps).contains("1 numbers, 0 verdicts"),
        "{}",
        stdout(&steps)
    );

    let path = scene.report.join("cook/displacement.png");
    let mut picture = image::open(&path).unwrap().to_rgb8();
    picture.put_pixel(10, 10, image::Rgb([0; 3]));
    picture.save(&path).unwrap();
    let pixel = stdout(&diff(&scene.report));
    assert!(
        pixel.contains("cook/displacement.png: 1 pixels differ"),
        "{pixel}"
    );
    let triptych = image::open(out.join("cook/displacement.png")).unwrap();
    assert!(triptych.width() > 3 * picture.width());

    scene.falsify("fem_mid_edge_error", 2.0);
    scene.falsify("mid_edge_uy", 1.05);
    scene.report();
    let other = diff(&scene.report);
    assert_eq!(code(&other), 3);
    let said = stdout(&other);
    assert!(
        said.contains("| right | FAILED |") && said.contains("mid_edge_uy (m) |"),
        "{said}"
    );
    assert_eq!(fs::read_to_string(out.join("diff.md")).unwrap(), said);

    fs::write(scene.report.join("summary.json"), "{\"schema\": 1,").unwrap();
    let damaged = diff(&scene.report);
    assert_eq!(code(&damaged), 2);
    assert!(stderr(&damaged).contains("summary.json: damaged"));
    assert_eq!(code(&diff(Path::new("/nonexistent"))), 2);
}

#[test]
fn nights_are_added_to_the_history_once() {
    let scene = Scene::new();
    let night = |date: &str, commit: &str| {
        mpm_verify(&[
            "report",
            text(&scene.report),
            "--golden",
            text(&scene.golden),
            "--night",
            date,
            "--commit",
            commit,
        ])
    };
    let path = scene.report.join("history.csv");
    assert_eq!(code(&night("2026-01-02", "b")), 0);
    let one = fs::read_to_string(&path).unwrap();
    assert!(
        one.starts_with("night,commit,case,run,quantity,value\n"),
        "{one}"
    );
    assert_eq!(code(&night("2026-01-01", "a")), 0);
    assert_eq!(code(&night("2026-01-02", "c")), 0);
    let all = fs::read_to_string(&path).unwrap();
    let nights = |start: &str| all.lines().filter(|l| l.starts_with(start)).count();
    assert_eq!(nights("2026-01-02,c"), one.lines().count() - 1);
    assert_eq!(nights("2026-01-01,a"), one.lines().count() - 1);
    assert_eq!(nights("2026-01-02,b"), 0);
    assert!(
        all.lines().nth(1).unwrap().starts_with("2026-01-01"),
        "in the order of time"
    );
    assert!(scene.report.join("trends-cook.png").exists());

    assert_eq!(code(&night("2026-13-01", "a")), 2);
    fs::write(&path, "night,commit\n2026-01-01,a\n").unwrap();
    let damaged = night("2026-01-03", "a");
    assert_eq!(code(&damaged), 2);
    assert!(
        stderr(&damaged).contains("history.csv"),
        "{}",
        stderr(&damaged)
    );
}
