//! Runs and verifications: records, exit codes, files.

use super::{code, copy_tree, files, golden, json, mpm_verify, quick, stderr, stdout, text};
use serde_json::Value;
use std::path::Path;

fn verdict<'a>(record: &'a Value, check: &str) -> &'a Value {
    let all = record["verdicts"].as_array().unwrap();
    all.iter().find(|v| v["check"] == check).unwrap_or_else(|| panic!("no verdict {check}"))
}

#[test]
fn a_run_writes_a_complete_record_and_passes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let output = mpm_verify(&["run", "cook", "--remedy", "fbar-total", "--out", out]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));

    let record = json(&folder.path().join("record.json"));
    assert_eq!(record["schema"], 2);
    for (field, value) in [
        ("case", "cook"),
        ("scheme", "gimp-fbar-total-flip"),
        ("solver", "explicit"),
        ("level", "h2"),
        ("status", "ok"),
    ] {
        assert_eq!(record[field], value);
    }
    assert!(record["error"].is_null());
    assert_eq!(record["discretisation"]["dim"], 2);
    assert_eq!(record["discretisation"]["h"], 2.0);
    assert_eq!(record["discretisation"]["ppc"], 4);
    assert_eq!(record["discretisation"]["wall"], "open-knot");
    // 0.3 h / c; the paper prints 2.773e-3 s at h = 1, cut after the fourth digit.
    let dt = record["discretisation"]["dt"].as_f64().unwrap();
    assert!((dt - 2.0 * 2.7735e-3).abs() < 1e-6, "{dt}");
    assert_eq!(record["parameters"]["poisson_ratio"], 0.499);
    for metric in [
        "mid_edge_uy",
        "edge_mean_uy",
        "tip_uy",
        "tip_uy_nearest",
        "mean_stress_rms_error",
        "checkerboard_rms",
        "creep_rate",
    ] {
        assert!(record["metrics"][metric]["value"].is_number(), "{metric}");
        assert!(record["metrics"][metric]["unit"].is_string(), "{metric}");
    }
    let work = &record["work"];
    assert_eq!(work["particles"], 1448);
    let steps = work["steps"].as_u64().unwrap();
    assert_eq!(work["particle_steps"], 1448 * steps);
    assert_eq!(work["projections"], steps);
    assert!(work["nodes"].is_number());
    assert!(record["time"]["wall_s"].is_number() && record["time"]["cpu_s"].is_number());
    assert!(record["machine"].is_object() && record["version"].is_object());
    assert_eq!(verdict(&record, "mid-edge")["outcome"], "right");
    assert_eq!(verdict(&record, "mid-edge")["kind"], "truth");

    let series = std::fs::read_to_string(folder.path().join("series.csv")).unwrap();
    assert!(series.starts_with("time (s),tip_uy (m),"));
    assert!(series.lines().count() > 100);
    let particles = std::fs::read_to_string(folder.path().join("particles.csv")).unwrap();
    assert_eq!(particles.lines().count(), 1449);
    let vtu = std::fs::read(folder.path().join("particles.vtu")).unwrap();
    let vtu = String::from_utf8_lossy(&vtu);
    assert!(vtu.contains("NumberOfPoints=\"1448\"") && vtu.contains("\"mean_stress\""));
}

#[test]
fn a_breakdown_keeps_what_was_written_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    // A thousand times the load turns particles inside out; the record of an earlier run is no more.
    std::fs::write(folder.path().join("record.json"), "{}").unwrap();
    let output = mpm_verify(&["run", "cook", "--remedy", "none", "--out", out, "--set", "load=1000"]);
    assert_eq!(code(&output), 4, "{}{}", stdout(&output), stderr(&output));
    let record = json(&folder.path().join("record.json"));
    assert_eq!(record["status"], "failed");
    let error = &record["error"];
    for field in ["kind", "time", "step", "particle", "value", "message"] {
        assert!(!error[field].is_null(), "{field} of {error}");
    }
    assert_eq!(verdict(&record, "completes")["outcome"], "failed");
    let series = std::fs::read_to_string(folder.path().join("series.csv")).unwrap();
    assert!(series.lines().count() > 3, "the series up to the breakdown is kept");
}

#[test]
fn every_kind_of_breakdown_ends_with_a_record() {
    let mut kinds = std::collections::BTreeSet::new();
    for (basis, remedy, set) in [
        ("gimp", "none", "cfl=0.95"),
        ("bspline2", "fbar-rate", "cfl=0.95"),
        ("bspline3", "none", "load=6900"),
        ("bspline2", "none", "load=70"),
        ("gimp", "fbar-total", "load=70"),
        ("gimp", "none", "load=6900"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().to_str().unwrap();
        let output = mpm_verify(&["run", "cook", "--basis", basis, "--remedy", remedy, "--out", out, "--set", set]);
        // Steps beyond stability are known to end so.
        let known = if set.starts_with("cfl") { 0 } else { 4 };
        assert_eq!(code(&output), known, "{basis} {remedy} {set}: {}", stderr(&output));
        let record = json(&folder.path().join("record.json"));
        assert_eq!(record["status"], "failed");
        kinds.insert(record["error"]["kind"].as_str().unwrap().to_owned());
        assert!(folder.path().join("particles.vtu").exists());
    }
    assert!(kinds.len() > 1, "{kinds:?}");
}

/// Parameters of a run that is too short to come to rest.
const SHORT: [&str; 6] = ["--set", "max_periods=0.05", "--set", "rest_window=0.01", "--set", "load_ramp=0"];

/// Exact work of a fixed number of steps: a change of algorithmic work is a readable difference.
#[test]
fn work_counters_are_as_reviewed() {
    let mut table = String::new();
    for basis in ["gimp", "bspline2", "bspline3"] {
        for remedy in "none fbar-recursive fbar-total fbar-rate fbar-consistent bbar-hats bbar-cells".split(' ') {
            let folder = tempfile::tempdir().unwrap();
            let out = folder.path().to_str().unwrap();
            let run = ["run", "cook", "--basis", basis, "--remedy", remedy, "--out", out];
            mpm_verify(&[&run[..], &SHORT].concat());
            let work = json(&folder.path().join("record.json"))["work"].to_string();
            table.push_str(&format!("{basis} {remedy} {work}\n"));
        }
    }
    insta::assert_snapshot!("work-counters", table);
}

#[test]
fn a_run_that_misses_the_truth_exits_with_one() {
    let output = mpm_verify(&[&["run", "cook"][..], &SHORT].concat());
    assert_eq!(code(&output), 1);
    let text = stdout(&output);
    assert!(text.contains("FAIL") && text.contains("at-rest") && text.contains("mid-edge"));
}

#[test]
fn a_reference_outside_its_validity_is_not_applicable() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let output = mpm_verify(&["run", "cook", "--out", out, "--set", "load=2", "--set", "poisson_ratio=0.45"]);
    assert_eq!(code(&output), 0, "{}", stdout(&output));
    let record = json(&folder.path().join("record.json"));
    for check in ["mid-edge", "edge-mean", "tip", "mean-stress-probe", "mean-stress-rms"] {
        assert!(verdict(&record, check)["outcome"] == "not-judged", "{check}");
    }
    assert_eq!(verdict(&record, "at-rest")["outcome"], "right");
    assert!(record["metrics"]["fem_tip_error"].is_null());
}

#[test]
fn displacement_depends_on_load_over_stiffness_alone() {
    // Units: ten times the load on ten times the stiffness, and another density, give the same state
    // of rest; the reference stays applicable.
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &str, set: &[&str]| {
        let out = folder.path().join(name);
        let mut arguments = vec!["run", "cook", "--out", out.to_str().unwrap()];
        for assignment in set {
            arguments.extend(["--set", assignment]);
        }
        assert_eq!(code(&mpm_verify(&arguments)), 0);
        json(&out.join("record.json"))["metrics"]["mid_edge_uy"]["value"].as_f64().unwrap()
    };
    let base = run("base", &[]);
    let scaled = run("scaled", &["load=10", "young_modulus=700", "density=4"]);
    assert!((scaled / base - 1.0).abs() < 1e-6, "{scaled} {base}");
}

#[test]
fn the_number_of_threads_changes_no_bit_of_a_record() {
    let folder = tempfile::tempdir().unwrap();
    let metrics = |threads: &str| {
        let out = folder.path().join(threads);
        let out_text = out.to_str().unwrap();
        let run = ["run", "cook", "--level", "h1", "--threads", threads, "--out", out_text];
        mpm_verify(&[&run[..], &SHORT].concat());
        let series = std::fs::read(out.join("series.csv")).unwrap();
        (json(&out.join("record.json"))["metrics"].clone(), series)
    };
    assert_eq!(metrics("1"), metrics("2"));
}

fn is_picture(path: &Path) {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let picture = image::load_from_memory(&bytes).unwrap().to_rgb8();
    assert!(picture.width() > 800 && picture.height() > 400);
    let first = picture.get_pixel(0, 0);
    let drawn = picture.pixels().filter(|p| *p != first).count();
    assert!(drawn > 5_000, "{} is nearly empty", path.display());
}

#[test]
fn the_quick_tier_verifies_and_reports() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let (made, output) = quick();
    assert_eq!(code(output), 0, "{}{}", stdout(output), stderr(output));
    copy_tree(made, out);
    let summary = json(&out.join("summary.json"));
    assert_eq!(summary["schema"], 4);
    assert_eq!(summary["tier"], "quick");
    assert_eq!(summary["counts"]["failed"], 0);
    assert_eq!(summary["counts"]["drifted"], 0);
    assert!(summary["counts"]["undrifted"].as_u64().unwrap() > 100);
    assert_eq!(summary["counts"]["broke_down"], 0);
    assert!(summary["counts"]["right"].as_u64().unwrap() > 30);
    assert!(summary["counts"]["wrong_as_known"].as_u64().unwrap() >= 4);
    let limits = |check: &str| {
        summary["cases"][0]["records"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|r| r["verdicts"].as_array().unwrap())
            .chain(summary["cases"][0]["verdicts"].as_array().unwrap())
            .filter(|v| v["check"] == check)
            .map(|v| v["outcome"].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(limits("locked"), ["wrong-as-known"]);
    assert_eq!(limits("creep-grows-as-dt-falls"), ["wrong-as-known"]);
    assert_eq!(limits("never-at-rest"), ["wrong-as-known", "wrong-as-known"]);
    let written = std::fs::read_to_string(out.join("summary.md")).unwrap();
    assert!(written.contains("| fem_edge_mean_error | gimp fbar-rate |"));
    is_picture(&out.join("cook/rest.png"));
    let data = std::fs::read_to_string(out.join("cook/rest.csv")).unwrap();
    assert!(data.starts_with("chart,quantity,series,"));
    for line in stderr(output).lines() {
        let plain = line.starts_with('[') && !line.contains('\x1b');
        assert!(plain, "plain progress lines only: {line:?}");
    }

    // The report is rebuilt from the files alone, byte for byte.
    let before = files(out);
    for name in before.keys().filter(|n| n.components().count() < 3) {
        if name != Path::new("plan.json") {
            std::fs::remove_file(out.join(name)).unwrap();
        }
    }
    let again = mpm_verify(&["report", text(out), "--golden", text(&golden())]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    assert!(files(out) == before);
}
