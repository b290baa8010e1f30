//! Two reports side by side, and nights in a row.

use super::gate::{Scene, two_runs};
use super::{code, json, mpm_verify, stderr, stdout, text};
use serde_json::json;
use std::fs;
use std::path::Path;

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
