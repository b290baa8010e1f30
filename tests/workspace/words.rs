//! Messages of the program, and input that it must refuse.

use super::scene::Scene;
use super::{code, files, json, mpm_verify, stderr, stdout, text};
use serde_json::json;
use std::fs;
use std::process::{Command, Stdio};

/// One line, short, without control characters.
fn is_line(said: &str) {
    let line = said.strip_suffix('\n').unwrap();
    let acts = |c: char| c.is_control() || "\u{200b}\u{202e}\u{fffe}".contains(c);
    assert!(!line.contains(acts), "{line:?}");
    assert!(line.chars().count() < 3100, "{} characters", line.chars().count());
}

#[test]
fn an_error_is_a_short_line_whatever_was_given() {
    let long = "x".repeat(100_000);
    for bad in ["a\nb", "\x1b]0;owned\x07", "a\u{202e}b", "\u{200b}", &*long, "a\r\nUsage: b"] {
        let set = format!("load={bad}");
        let name = format!("{bad}=1");
        for arguments in [
            &["run", bad][..],
            &["run", "cook", "--set", &set],
            &["run", "cook", "--set", &name],
            &["run", "cook", "--level", bad],
            &["run", "cook", "--scheme", bad],
            &["verify", "--shard", bad],
            &["report", bad],
            &["exact", bad, "--at", "0", "--time", "0"],
            &["exact", "axis", "--at", bad, "--time", bad],
            &["report", ".", "--night", bad, "--commit", "a"],
            &["report", ".", "--night", "2026-01-01", "--commit", bad],
        ] {
            let output = mpm_verify(arguments);
            assert_eq!(code(&output), 2, "{arguments:?}");
            is_line(&stderr(&output));
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let scene = Scene::new();
    let golden = files(&scene.golden);
    let [report, kept] = [&scene.report, &scene.golden].map(|p| text(p));
    let night = |date: &str, commit: &str| {
        let [date, commit] = [format!("--night={date}"), format!("--commit={commit}")];
        let night = [&*date, &*commit, "--golden", kept];
        mpm_verify(&[&["report", report][..], &night].concat())
    };
    for date in ["20260101", "2026-01-01T00:00", "+002026-01-01", "-009999-01-01"] {
        assert!(stderr(&night(date, "a")).contains("YYYY-MM-DD"), "{date}");
    }
    for commit in ["=cmd|' /C calc'!A0", "+1", "-1", "@a", "a b", "", "a,b", "<script>"] {
        let output = night("2026-01-01", commit);
        assert_eq!(code(&output), 2, "{commit}");
    }
    for reason in ["\u{200b}", "--", "a\x1b[31m", &"x".repeat(100_000)] {
        let bless = ["bless", "cook", "--from", report, "--golden", kept];
        let reason = format!("--reason={reason}");
        let output = mpm_verify(&[&bless[..], &[&reason]].concat());
        assert_eq!(code(&output), 2, "{reason}");
        is_line(&stderr(&output));
    }
    assert!(files(&scene.golden) == golden);
    let shard = mpm_verify(&["verify", "--tier", "quick", "--shard", "+1/4"]);
    assert!(stderr(&shard).contains("i/n"), "{}", stderr(&shard));
}

/// Nothing of a file is shown that could act on a terminal or a page.
#[test]
fn words_of_files_are_of_one_line_or_refused() {
    let scene = Scene::new();
    let record = scene.report.join("cook/gimp-fbar-rate-flip/h2/record.json");
    let sound = json(&record);
    for bad in ["\x1b[31m", "a\nb", "\u{1}", "\u{fffe}", "\u{202e}"] {
        let mut damaged = sound.clone();
        damaged["error"] = json!({"kind": "inverted", "time": 1.0, "step": 1, "particle": 0, "value": null,
            "message": bad});
        fs::write(&record, damaged.to_string()).unwrap();
        let output = scene.report();
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains("control characters"), "{}", stderr(&output));
        is_line(&stderr(&output));
    }
    let mut broken = sound.clone();
    broken["status"] = json!("failed");
    broken["error"] = json!({"kind": "inverted", "time": 1.0, "step": 1, "particle": 0, "value": null,
        "message": "<script>alert(1)</script> <img onerror=x>"});
    fs::write(&record, broken.to_string()).unwrap();
    assert_eq!(code(&scene.report()), 4);
    for page in ["summary.md", "index.html", "cook.html", "junit.xml"] {
        let page = fs::read_to_string(scene.report.join(page)).unwrap();
        assert!(!page.contains("<script>alert") && !page.contains("<img onerror"));
    }
}

/// One thread is one that computes and one that waits, whatever the environment says.
#[test]
fn threads_are_bounded() {
    let start = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
            .args(arguments)
            .env("RAYON_NUM_THREADS", "60")
            .stdout(Stdio::null())
            .spawn()
            .unwrap()
    };
    let scene = Scene::new();
    let [report, golden] = [&scene.report, &scene.golden].map(|p| text(p));
    let cores = std::thread::available_parallelism().unwrap().get();
    for (command, allowed) in
        [(&["run", "mms-swirl", "--threads", "1"][..], 4), (&["report", report, "--golden", golden], 2 + cores)]
    {
        let mut child = start(command);
        let tasks = format!("/proc/{}/task", child.id());
        let mut most = 0;
        while child.try_wait().unwrap().is_none() {
            most = most.max(fs::read_dir(&tasks).map_or(0, Iterator::count));
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        assert!((1..=allowed).contains(&most), "{command:?}: {most} threads");
    }
    let many = (4 * cores + 1).to_string();
    let output = mpm_verify(&["run", "cook", "--threads", &many]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains(&format!("1..={}", 4 * cores)), "{}", stderr(&output));
}

/// Doubts about a number are named before it is blessed.
#[test]
fn doubtful_numbers_are_blessed_by_name_alone() {
    let scene = Scene::new();
    let record = scene.report.join("cook/gimp-fbar-rate-flip/h2/record.json");
    let (sound, golden) = (json(&record), files(&scene.golden));
    let bless = |more: &[&str]| {
        let [from, kept] = [&scene.report, &scene.golden].map(|p| text(p));
        let bless = ["bless", "cook", "--reason", "edited", "--from", from, "--golden", kept];
        mpm_verify(&[&bless[..], more].concat())
    };
    for (pointer, value, name) in [
        ("/metrics/checkerboard_rms/value", json!(-1.0), "checkerboard_rms"),
        ("/metrics/checkerboard_rms/value", json!(1e6), "checkerboard_rms"),
        ("/metrics/checkerboard_rms/value", json!(null), "checkerboard_rms"),
        ("/work/particle_steps", json!(7), "particle_steps"),
        ("/work/sorts", json!(5_000_000), "sorts"),
    ] {
        let mut edited = sound.clone();
        *edited.pointer_mut(pointer).unwrap() = value;
        fs::write(&record, edited.to_string()).unwrap();
        let output = bless(&[]);
        assert_eq!(code(&output), 2, "{name}: {}{}", stdout(&output), stderr(&output));
        assert!(stdout(&output).contains(&format!("doubtful: {name} of ")), "{}", stdout(&output));
        assert!(files(&scene.golden) == golden);
    }
    let mut edited = sound.clone();
    edited["metrics"]["checkerboard_rms"]["value"] = json!(null);
    fs::write(&record, edited.to_string()).unwrap();
    let other = bless(&["--allow", "checkerboard_rms", "--allow", "tip_uy"]);
    assert!(stdout(&other).contains("--allow tip_uy: nothing of that name is doubtful"));
    assert!(files(&scene.golden) == golden);
    let named = bless(&["--allow", "checkerboard_rms"]);
    assert_eq!(code(&named), 0, "{}{}", stdout(&named), stderr(&named));
}

/// A reader that is gone has read enough.
#[test]
fn help_to_a_closed_stream_is_no_error() {
    let mut child =
        Command::new(env!("CARGO_BIN_EXE_mpm-verify")).arg("--help").stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}
