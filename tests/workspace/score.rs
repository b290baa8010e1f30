//! Results of other codes: our own runs told as such are judged as they are, and nothing else passes for one.

use super::{code, copy_tree, json, mpm_verify, stderr, stdout, text};
use mpm_verify::cases;
use mpm_verify::score::{Scored, Scores};
use mpm_verify::verdict::{Outcome, Verdict};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A run of every case that scores: scheme as which a code is judged, level, parameters that are changed.
const RUNS: [Case; 11] = [
    ("cook", "bspline2-fbar-consistent-flip", "h2", &[]),
    ("footing", "bspline2-fbar-consistent-flip", "b10", &["domain_width=3", "domain_depth=3", "penetration=0.0025"]),
    ("dam-break", "bspline2-fbar-consistent-flip", "h0.5", &["cfl=0.3"]),
    ("cantilever", "quasi-static-bspline2-none", "h0.1", &[]),
    ("consolidation", "poro-gimp-two-grid", "n8", &[]),
    ("column", OURS, "h0.25", &["duration=0.02"]),
    ("terzaghi", "poro-gimp-two-grid", "n10", &[]),
    ("vibrating-bar", OURS, "n8", &["duration=0.05"]),
    ("slope-stability", OURS, "h0.4", &["young_modulus=6.25e6", "poisson_ratio=0.49", "most=2", "trials=1"]),
    ("landslide-2d", OURS, "h0.4", &["reduction=1", "duration=0.02", "poisson_ratio=0.49", "cfl=0.6"]),
    ("landslide", OURS, "h0.5", &["reduction=1", "duration=0.02", "poisson_ratio=0.49", "width=2", "floor=3"]),
];
/// Runs that miss what is wanted as their schemes are known to, and a check that sees it.
const MISSES: [(Case, &str); 3] = [
    (("cook", "bspline2-none-flip", "h2", &[]), "mean-stress-rms"),
    (("dam-break", "gimp-none-flip", "h0.5", &["cfl=0.3", "duration=0.6"]), "front"),
    (("vibrating-bar", "bspline2-none-flip", "n8", &[]), "keeps-energy"),
];
const OURS: &str = "bspline2-fbar-consistent-flip";

/// Case, scheme, level, parameters that are changed.
type Case = (&'static str, &'static str, &'static str, &'static [&'static str]);

fn write(folder: &Path, manifest: &Value) {
    fs::write(folder.join("score.json"), manifest.to_string()).unwrap();
}

/// Manifest of another code for a run.
fn manifest(case: &str, level: &str, set: &[&str]) -> Value {
    let parameters = set.iter().map(|set| {
        let (name, value) = set.split_once('=').unwrap();
        (name.to_owned(), serde_json::from_str(value).unwrap())
    });
    json!({
        "schema": 1,
        "code": {"name": "another"},
        "scheme": "ours, told as another's",
        "case": case,
        "level": level,
        "parameters": parameters.collect::<serde_json::Map<_, _>>(),
        "particles": "particles.csv",
        "series": "series.csv",
    })
}

/// The runs, each in the folder of its case, with what another code would say of it.
fn made() -> &'static Path {
    static MADE: OnceLock<tempfile::TempDir> = OnceLock::new();
    MADE.get_or_init(|| {
        let root = tempfile::tempdir().unwrap();
        let _ = RUNS.map(|run| make(run, &root.path().join(run.0)));
        root
    })
    .path()
}

/// Makes a run, with what another code would say of it: the record of ours.
fn make((case, scheme, level, set): Case, out: &Path) -> Value {
    let mut arguments = vec!["run", case, "--scheme", scheme, "--level", level];
    arguments.extend(["--out", text(out), "--threads", "1"]);
    arguments.extend(set.iter().flat_map(|set| ["--set", set]));
    let output = mpm_verify(&arguments);
    assert!(code(&output) < 2, "{}{}", stdout(&output), stderr(&output));
    let (mut said, record) = (manifest(case, level, set), json(&out.join("record.json")));
    said["time_step_s"] = record["discretisation"]["dt"].clone();
    said["cost"] = json!({"steps": record["work"]["steps"]});
    write(out, &said);
    record
}

/// A copy of a run that may be damaged.
struct Copy {
    _root: tempfile::TempDir,
    folder: PathBuf,
}

impl Copy {
    fn of(case: &str) -> Self {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join(case);
        copy_tree(&made().join(case), &folder);
        Self { _root: root, folder }
    }

    /// Changes the cells of a column; without, it is taken away.
    fn change(&self, table: &str, column: &str, change: Option<fn(f64) -> f64>) {
        let path = self.folder.join(table);
        let before = fs::read_to_string(&path).unwrap();
        let mut lines = before.lines();
        let head: Vec<&str> = lines.next().unwrap().split(',').collect();
        let place = head.iter().position(|h| *h == column).unwrap();
        let row = |cells: Vec<String>| {
            let kept = cells.into_iter().enumerate();
            let kept = kept.filter(|(k, _)| change.is_some() || *k != place);
            kept.map(|(_, c)| c).collect::<Vec<_>>().join(",") + "\n"
        };
        let mut after = row(head.iter().map(|h| (*h).to_owned()).collect());
        for line in lines {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if let Some(change) = change {
                cells[place] = change(cells[place].parse().unwrap()).to_string();
            }
            after += &row(cells);
        }
        fs::write(path, after).unwrap();
    }

    fn score(&self) -> Scored {
        read(&self.folder)
    }
}

/// The only run of a result.
pub(super) fn read(folder: &Path) -> Scored {
    Scores::read(folder).unwrap().runs.remove(0)
}

pub(super) fn of<'a>(scored: &'a Scored, check: &str) -> Vec<&'a Verdict> {
    let all = scored.record.verdicts.iter();
    all.filter(|v| v.check == check).collect()
}

/// The result in a folder, of whose run the record is `own`: the same columns through the same functions are the same numbers.
fn measured(folder: &Path, own: &Value) -> Scored {
    let scored = read(folder);
    assert!(scored.missing.is_empty() && !scored.record.metrics.is_empty(), "{:?}", scored.missing);
    for (name, measured) in &scored.record.metrics {
        assert_eq!(json!(measured.value), own["metrics"][name]["value"], "{} {name}", scored.case.name);
    }
    scored
}

#[test]
fn our_own_run_told_as_anothers_is_measured_and_judged_as_it_is() {
    for (case, scheme, ..) in RUNS {
        let folder = made().join(case);
        let own = json(&folder.join("record.json"));
        let scored = measured(&folder, &own);
        assert_eq!(scored.record.scheme().to_string(), scheme);
        let all = &scored.record.verdicts;
        for verdict in all {
            // A wanted quantity may be judged of ours by more checks, which a source names.
            let same = |v: &&Value| v["check"] == verdict.check && v["outcome"] == json!(verdict.outcome);
            let wanted = own["verdicts"].as_array().unwrap().iter().any(|v| verdict.is_wanted() && same(&v));
            assert!(wanted || own["verdicts"].as_array().unwrap().contains(&json!(verdict)), "{case}: {verdict:?}");
        }
        assert!(all.iter().any(|v| v.is_wanted() && v.outcome == Outcome::Right), "{case}: {all:?}");
    }
    let scored: BTreeSet<&str> = cases::scored().map(|(case, _)| case.name).collect();
    assert_eq!(scored, RUNS.map(|run| run.0).into(), "a case that scores is not among the runs");
}

/// A miss that a known limit explains of our scheme is FAILED of another code, check by check.
#[test]
fn what_is_wrong_as_known_of_ours_fails_of_another() {
    for (run, check) in MISSES {
        let root = tempfile::tempdir().unwrap();
        let own = make(run, &root.path().join("run"));
        let scored = json!(measured(&root.path().join("run"), &own).record.verdicts);
        let missed = |verdicts: &Value, outcome: &str| {
            let own = verdicts.as_array().unwrap().iter().filter(|v| v["kind"] == "truth" && v["outcome"] == outcome);
            own.map(|v| v["check"].to_string()).collect::<BTreeSet<_>>()
        };
        let known = missed(&own["verdicts"], "wrong-as-known");
        assert!(known.contains(&format!("{check:?}")), "{run:?}: {known:?}");
        assert_eq!((missed(&scored, "failed"), missed(&scored, "wrong-as-known").len()), (known, 0), "{run:?}");
    }
}

/// Each column of a headline made wrong on purpose, the check that sees it, and what is judged when it is missing.
#[test]
fn a_wrong_column_fails_and_a_missing_one_is_not_judged() {
    type Wrong = (&'static str, &'static str, &'static str, fn(f64) -> f64, &'static str);
    let wrong: [Wrong; 19] = [
        ("cook", "particles.csv", "uy (m)", |u| 0.9 * u, "mid-edge"),
        ("cook", "particles.csv", "mean_stress (Pa)", |s| s + 0.5, "mean-stress-probe"),
        ("cook", "series.csv", "reaction_y (N/m)", |r| 0.9 * r, "reaction"),
        ("footing", "series.csv", "footing_force (N/m)", |f| 1.1 * f, "prandtl"),
        ("footing", "particles.csv", "mean_stress (Pa)", |s| 3.0 * s, "mean-stress"),
        ("dam-break", "series.csv", "front (m)", |x| x - 0.8, "front"),
        ("dam-break", "series.csv", "kinetic_energy (J/m)", |k| 2.0 * k, "motion-not-gained"),
        ("cantilever", "particles.csv", "uy (m)", |u| 0.95 * u, "corner"),
        ("consolidation", "series.csv", "settlement (-)", |s| 1.3 * s, "settlement"),
        ("consolidation", "series.csv", "base_pressure (-)", |p| p + 0.2, "base-pressure"),
        ("dam-break", "particles.csv", "start_pressure (Pa)", |p| 1.1 * p, "pressure-profile"),
        ("column", "particles.csv", "mean_stress (Pa)", |s| 1.2 * s, "base-pressure"),
        ("terzaghi", "series.csv", "settlement (-)", |s| 1.02 * s, "near-terzaghi"),
        ("terzaghi", "series.csv", "overshoot (-)", |o| o + 0.3, "bounded-overshoot"),
        ("vibrating-bar", "series.csv", "energy (J)", |e| 0.5 * e, "keeps-energy"),
        ("slope-stability", "series.csv", "factor (-)", |f| 0.6 * f, "limit-load"),
        ("landslide-2d", "particles.csv", "rest_stress_yy (Pa)", |s| 1.1 * s, "overburden"),
        ("landslide-2d", "series.csv", "failed_share (-)", |s| s + 0.02, "stands"),
        ("landslide", "series.csv", "base_force (N/m)", |f| 1.01 * f, "base-reaction"),
    ];
    for (case, table, column, change, check) in wrong {
        let copy = Copy::of(case);
        let outcomes = |scored: &Scored| {
            let found = of(scored, check);
            assert!(!found.is_empty(), "{case}: {check}");
            found.iter().map(|v| v.outcome).collect::<Vec<_>>()
        };
        assert!(!outcomes(&copy.score()).contains(&Outcome::Failed), "{case}: {check}");
        copy.change(table, column, Some(change));
        assert!(outcomes(&copy.score()).contains(&Outcome::Failed), "{case}: {check}");
        let output = mpm_verify(&["score", text(&copy.folder), "--quiet"]);
        assert_eq!(code(&output), 1, "{}{}", stdout(&output), stderr(&output));
        assert!(stdout(&output).contains(check), "{}", stdout(&output));
        copy.change(table, column, None);
        let scored = copy.score();
        let all = outcomes(&scored);
        let unjudged = all.iter().all(|of| *of == Outcome::NotJudged);
        assert!(unjudged, "{case}: {check} {all:?}");
        assert!(of(&scored, check)[0].source.contains(column), "{column}");
        assert!(scored.missing.iter().any(|c| c.header() == column));
    }
}

#[test]
fn a_result_stands_beside_ours() {
    let copy = Copy::of("cook");
    let out = copy.folder.join("out");
    let output = mpm_verify(&["score", text(&copy.folder), "--out", text(&out)]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let said = stdout(&output);
    for named in ["another", "gimp none ", "(%)", "Verdict: right"] {
        assert!(said.contains(named), "{named}: {said}");
    }
    let page = fs::read_to_string(out.join("score.md")).unwrap();
    assert!(page.contains("| this program | gimp none |"), "{page}");
    let found = json(&out.join("verdicts.json"));
    assert_eq!(found["exit_code"], 0);
    assert!(!found["ours"].as_array().unwrap().is_empty());
    let told = mpm_verify(&["score", text(&copy.folder), "--json"]);
    assert_eq!(serde_json::from_str::<Value>(&stdout(&told)).unwrap(), found);
    for (case, ..) in RUNS {
        let said = stdout(&mpm_verify(&["score", text(&made().join(case))]));
        assert!(said.lines().all(|line| line.chars().count() <= 100), "{said}");
    }
}

/// The export describes every column and check, and is a result once the tables are there.
#[test]
fn what_is_exported_can_be_filled_in() {
    for (case, _, level, set) in RUNS {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("out");
        let mut arguments = vec!["export", case, "--level", level, "--out", text(&out)];
        arguments.extend(set.iter().flat_map(|set| ["--set", set]));
        let output = mpm_verify(&arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let readme = fs::read_to_string(out.join("README.md")).unwrap();
        let (_, foreign) = cases::find_scored(case).unwrap();
        for column in foreign.columns() {
            assert!(readme.contains(&column.header()), "{case}: {}", column.name);
        }
        let empty = mpm_verify(&["score", text(&out)]);
        assert_eq!(code(&empty), 2, "{case}");
        for part in foreign.parts() {
            let name = format!("{}.csv", part.name());
            fs::copy(made().join(case).join(&name), out.join(&name)).unwrap();
        }
        let scored = read(&out);
        let reference = fs::read_to_string(out.join("reference.csv")).unwrap();
        for verdict in scored.record.verdicts.iter().filter(|v| v.judges() && v.value.is_some()) {
            assert!(reference.contains(&verdict.metric), "{case}: {}", verdict.metric);
            assert!(readme.contains(&verdict.check), "{case}: {}", verdict.check);
        }
        let particles = fs::read_to_string(out.join("start.csv")).unwrap();
        let rows = json(&made().join(case).join("record.json"))["work"]["particles"].clone();
        assert_eq!(json!(particles.lines().count() - 1), rows, "{case}");
    }
    let other = mpm_verify(&["export", "mandel", "--out", "out"]);
    assert_eq!(code(&other), 2);
    assert!(stderr(&other).contains("dam-break"), "{}", stderr(&other));
}

#[test]
fn what_is_wrong_is_named() {
    let copy = Copy::of("cook");
    let sound = manifest("cook", "h2", &[]);
    let with = |key: &str, value: Value| {
        let mut changed = sound.clone();
        changed[key] = value;
        changed.to_string()
    };
    let twice = sound.to_string().replace("\"parameters\":{}", "\"parameters\":{\"load\":1,\"load\":1}");
    let series = "series";
    for (manifest, named) in [
        ("{".to_owned(), "line 1"),
        (with("case", json!("cok")), "case: unknown case that scores \"cok\"; allowed: cook"),
        (with("case", json!("mandel")), "allowed: cook"),
        (with("level", json!("h3")), "level: unknown level \"h3\"; allowed: h2"),
        (twice, "parameter load is set twice"),
        (with("particles", json!("../particles.csv")), "where the name of a file beside"),
        (with("particles", json!("/etc/passwd")), "where the name of a file beside"),
        (with("particles", json!("particles.txt")), "particles \"particles.txt\"; allowed: a .csv"),
        (with("particles", json!("none.csv")), "none.csv"),
        (with("particles", Value::Null).replace("series.csv", "folder.csv"), "not a plain file"),
        (with(series, json!("link.csv")), "a link, which is not followed"),
        (with(series, json!("pipe.csv")), "not a plain file"),
        (with(series, json!("units.csv")), "allowed: \"reaction_y (N/m)\""),
        (with(series, json!("nan.csv")), "line 2, column \"reaction_y (N/m)\": \"NaN\""),
        (with(series, json!("empty.csv")), "0 rows where 1 to"),
        (with(series, json!("short.csv")), "short.csv"),
    ] {
        let folder = &copy.folder;
        if !folder.join("link.csv").exists() {
            fs::create_dir(folder.join("folder.csv")).unwrap();
            std::os::unix::fs::symlink("series.csv", folder.join("link.csv")).unwrap();
            let pipe = std::process::Command::new("mkfifo").arg(folder.join("pipe.csv")).status();
            assert!(pipe.unwrap().success());
            fs::write(folder.join("units.csv"), "reaction_y (kN/m)\n1\n").unwrap();
            fs::write(folder.join("nan.csv"), "reaction_y (N/m)\nNaN\n").unwrap();
            fs::write(folder.join("empty.csv"), "reaction_y (N/m)\n").unwrap();
            fs::write(folder.join("short.csv"), "a,b\n1,2\n3\n").unwrap();
        }
        fs::write(folder.join("score.json"), &manifest).unwrap();
        let output = mpm_verify(&["score", text(folder)]);
        let said = stderr(&output);
        assert_eq!(code(&output), 2, "{manifest}: {said}");
        assert!(said.contains(named), "{manifest}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}

#[test]
fn a_gate_that_judged_nothing_does_not_pass_silently() {
    let copy = Copy::of("consolidation");
    let score = |more: &[&str]| {
        let output = mpm_verify(&[&["score", text(&copy.folder), "--quiet"], more].concat());
        (code(&output), stdout(&output) + &stderr(&output))
    };
    let refused = score(&["--require", "settelment"]);
    assert!(refused.0 == 2 && refused.1.contains("the nearest is settlement"), "{}", refused.1);
    copy.change("series.csv", "base_pressure (-)", None);
    let file = copy.folder.join("junit.xml");
    for (more, expected) in [("--quiet", 0), ("--strict", 1), ("--require=settlement,base-pressure", 1)] {
        let more = if more == "--quiet" { vec![] } else { vec![more] };
        let (found, said) = score(&[&more[..], &["--junit", text(&file)]].concat());
        assert_eq!((found, said.contains("Not passed: ")), (expected, expected == 1), "{more:?}: {said}");
        let failures = fs::read_to_string(&file).unwrap().matches("<failure").count();
        assert_eq!(failures, expected as usize, "{more:?}");
    }
    copy.change("series.csv", "settlement (-)", None);
    let (found, said) = score(&[]);
    assert!(found == 1 && said.contains("missing: settlement (-)"), "{said}");
}
