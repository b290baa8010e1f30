//! Two reports side by side, and nights in a row.

use super::scene::{Scene, one_case};
use super::{code, json, mpm_verify, stderr, stdout, text};
use serde_json::json;
use std::fs;
use std::path::Path;

#[test]
fn the_difference_of_two_reports_is_numbers_and_pictures() {
    let (report, scene) = (one_case(), Scene::new());
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
    assert!(stdout(&steps).contains("1 numbers, 0 verdicts"), "{}", stdout(&steps));

    let path = scene.report.join("cook/displacement.png");
    let mut picture = image::open(&path).unwrap().to_rgb8();
    picture.put_pixel(10, 10, image::Rgb([0; 3]));
    picture.save(&path).unwrap();
    let pixel = stdout(&diff(&scene.report));
    assert!(pixel.contains("cook/displacement.png: 1 pixels differ"), "{pixel}");
    let triptych = image::open(out.join("cook/displacement.png")).unwrap();
    assert!(triptych.width() > 3 * picture.width());

    scene.falsify("fem_mid_edge_error", 2.0);
    scene.falsify("mid_edge_uy", 1.05);
    scene.report();
    let other = diff(&scene.report);
    assert_eq!(code(&other), 3);
    let said = stdout(&other);
    assert!(said.contains("| right | FAILED |") && said.contains("mid_edge_uy (m) |"), "{said}");
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
    assert!(one.starts_with("night,commit,case,run,quantity,value\n"), "{one}");
    assert_eq!(code(&night("2026-01-01", "a")), 0);
    assert_eq!(code(&night("2026-01-02", "c")), 0);
    let all = fs::read_to_string(&path).unwrap();
    let nights = |start: &str| all.lines().filter(|l| l.starts_with(start)).count();
    assert_eq!(nights("2026-01-02,c"), one.lines().count() - 1);
    assert_eq!(nights("2026-01-01,a"), one.lines().count() - 1);
    assert_eq!(nights("2026-01-02,b"), 0);
    assert!(all.lines().nth(1).unwrap().starts_with("2026-01-01"), "in the order of time");

    assert_eq!(code(&night("2026-13-01", "a")), 2);
    fs::write(&path, "night,commit\n2026-01-01,a\n").unwrap();
    let damaged = night("2026-01-03", "a");
    assert_eq!(code(&damaged), 2);
    assert!(stderr(&damaged).contains("history.csv"), "{}", stderr(&damaged));
}

#[test]
fn of_a_night_stay_its_rows_and_trends() {
    let scene = Scene::new();
    let kept = scene.report.parent().unwrap().join("kept");
    let keep = || mpm_verify(&["keep", text(&scene.report), "--into", text(&kept)]);
    let night = |date: &str| {
        let golden = ["--golden", text(&scene.golden)];
        let night = ["--night", date, "--commit", "c"];
        let report = ["report", text(&scene.report)];
        assert_eq!(code(&mpm_verify(&[&report[..], &golden, &night].concat())), 0);
    };
    let none = keep();
    assert_eq!(code(&none), 2);
    assert!(stderr(&none).contains("of no night"), "{}", stderr(&none));
    assert!(!kept.exists());

    night("2026-01-02");
    assert_eq!(code(&keep()), 0);
    let rows = || fs::read_to_string(kept.join("nightly/results.csv")).unwrap();
    let trends = || fs::read_to_string(kept.join("history.csv")).unwrap();
    let (one, first) = (rows(), trends());
    let runs = json(&scene.report.join("summary.json"))["counts"]["runs"].as_u64().unwrap();
    assert_eq!(one.lines().count() as u64, runs + 1);
    assert!(one.starts_with("case,scheme,level,set,") && one.contains(",2026-01-02,"));

    // A row of another run stays as it was; the night is reported again, once.
    let other = one.lines().nth(1).unwrap().replace(",h2,", ",h9,");
    fs::write(kept.join("nightly/results.csv"), format!("{one}{other}\n")).unwrap();
    night("2026-01-03");
    assert_eq!([code(&keep()), code(&keep())], [0, 0]);
    assert_eq!(rows().lines().count() as u64, runs + 2);
    // All but its metrics, whose names an earlier row has.
    assert!(rows().contains(other.rsplit_once(',').unwrap().0));
    assert_eq!(rows().matches(",2026-01-02,").count(), 1);
    assert!(trends().starts_with(&first));
    assert_eq!(trends().lines().count(), 2 * first.lines().count() - 1);
}
