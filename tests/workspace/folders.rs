//! Folders that hold more, less or other than what this program wrote.

use super::scene::{Scene, one_case};
use super::{code, copy_tree, files, json, mpm_verify, stderr, stdout, text};
use mpm_verify::files::lock::hold;
use serde_json::{Value, json};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output};

const RUN: &str = "cook/gimp-fbar-consistent-flip/h2";
/// A run of part of a second, too short to come to rest.
const SHORT: [&str; 6] = ["run", "cook", "--remedy", "fbar-total", "--set", "max_periods=0.06"];
const REST: [&str; 4] = ["--set", "rest_window=0.05", "--set", "load_ramp=0.03"];

fn short(more: &[&str]) -> Output {
    mpm_verify(&[&SHORT[..], &REST, more].concat())
}

/// A plan with a scene that memory can't hold is refused before it begins.
#[test]
fn a_verification_that_memory_cannot_hold_leaves_nothing() {
    let root = tempfile::tempdir().unwrap();
    let verify = ["verify", "terzaghi", "--tier", "quick", "--memory", "1e-6", "--out"];
    let output = mpm_verify(&[&verify[..], &[text(&root.path().join("out"))]].concat());
    refused(&output, "terzaghi/poro-gimp-two-grid/n10: the scene is larger than", root.path(), &Files::new());
}

/// Refused by one line that says why, and nothing has changed below `root`.
fn refused(output: &Output, needle: &str, root: &Path, before: &impl PartialEq<Files>) {
    let said = stderr(output);
    assert_eq!(code(output), 2, "{needle}: {said}{}", stdout(output));
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains(needle), "{needle} is missing in: {said}");
    assert!(*before == files(root), "{needle}: something has changed");
}

type Files = std::collections::BTreeMap<std::path::PathBuf, Vec<u8>>;

fn change(path: &Path, pointer: &str, value: Value) {
    let mut document = json(path);
    *document.pointer_mut(pointer).unwrap() = value;
    fs::write(path, document.to_string()).unwrap();
}

/// A name in a file is never taken for a path.
#[test]
fn names_in_files_lead_nowhere() {
    let scene = Scene::new();
    let root = scene.report.parent().unwrap();
    copy_tree(&scene.report.join(RUN), &root.join("victim/gimp-fbar-consistent-flip/h2"));
    for file in ["data.csv", "fig.png", "study.json", "notes.txt", "drift/x/a.png"] {
        fs::create_dir_all(root.join("victim/drift/x")).unwrap();
        fs::write(root.join("victim").join(file), "mine").unwrap();
    }
    let (plan, record) = (scene.report.join("plan.json"), scene.report.join(RUN).join("record.json"));
    let absolute = root.join("victim").display().to_string();
    for (file, pointer, value) in [
        (&plan, "/runs/0/case", "../victim"),
        (&plan, "/runs/0/case", &*absolute),
        (&plan, "/runs/0/level", "../../../victim"),
        (&plan, "/runs/0/set", "[\"x/../../victim=1\"]"),
        (&plan, "/tier", "<b>&\"x"),
        (&record, "/case", "../victim"),
        (&record, "/level", "../../victim"),
    ] {
        let sound = fs::read(file).unwrap();
        let value = serde_json::from_str(value).unwrap_or_else(|_| json!(value));
        change(file, pointer, value);
        let before = files(root);
        let bless = ["bless", "cook", "--reason", "x", "--from", text(&scene.report)];
        let golden = ["--golden", text(&scene.golden)];
        for output in [scene.report(), mpm_verify(&[&bless[..], &golden].concat())] {
            assert_eq!(code(&output), 2, "{pointer}: {}", stdout(&output));
            // A report that can't be told removes its former pages, and no more.
            let after = files(root);
            let left = |name: &&std::path::PathBuf| !after.contains_key(*name);
            let gone: Vec<_> = before.keys().filter(left).collect();
            assert!(gone.iter().all(|name| name.starts_with("report")), "{gone:?}");
            assert!(after.keys().all(|name| before.contains_key(name)), "{pointer}");
        }
        fs::write(file, sound).unwrap();
    }
    assert_eq!(code(&scene.report()), 0);
    // By itself, too, a record says what it is of.
    let alone = scene.report.join(RUN);
    change(&alone.join("record.json"), "/level", json!("../../../victim"));
    let output = mpm_verify(&["report", text(&alone), "--golden", text(&scene.golden)]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("record.json: unknown level"), "{}", stderr(&output));
}

/// Only what the folder's account names is removed.
#[test]
fn a_report_removes_what_it_wrote_and_refuses_what_is_in_its_way() {
    let scene = Scene::new();
    let mine = scene.report.join("cook/mine.csv");
    let below = scene.report.join(RUN).join("notes.csv");
    fs::write(&below, "mine").unwrap();
    assert_eq!(code(&scene.report()), 0);
    assert_eq!(fs::read_to_string(&below).unwrap(), "mine");
    fs::write(&mine, "mine").unwrap();
    let own = tempfile::tempdir().unwrap();
    fs::write(own.path().join("particles.csv"), "mine").unwrap();
    let before = files(own.path());
    refused(&short(&["--out", text(own.path())]), "particles.csv: in the way", own.path(), &before);
    let before = files(&scene.report);
    refused(&scene.report(), "mine.csv: in the way", &scene.report, &before);

    // One that was killed while it wrote claims all that has the place of a picture.
    let account = scene.report.join(".mpm-verify");
    let whole = fs::read_to_string(&account).unwrap();
    assert!(whole.contains("\ncook/displacement.png\n") && !whole.contains("record.json"));
    fs::write(&account, whole.lines().next().unwrap().to_owned() + "\n").unwrap();
    assert_eq!(code(&scene.report()), 0);
    assert_eq!(fs::read_to_string(&account).unwrap(), whole);

    // An account with a file of no report is refused.
    fs::write(&account, whole + "../victim.csv\nplan.json\ncook/../plan.json\n").unwrap();
    fs::write(scene.report.parent().unwrap().join("victim.csv"), "mine").unwrap();
    assert_eq!(code(&scene.report()), 0);
    assert!(scene.report.join("plan.json").exists());
    assert!(scene.report.parent().unwrap().join("victim.csv").exists());
}

#[test]
fn a_run_removes_what_a_run_writes_and_follows_no_link() {
    let folder = tempfile::tempdir().unwrap();
    let [out, elsewhere] = ["out", "elsewhere"].map(|name| folder.path().join(name));
    fs::create_dir_all(out.join("snapshots")).unwrap();
    fs::create_dir_all(&elsewhere).unwrap();
    let mine = ["notes.txt", "snapshots/mine.csv", "twin.csv"];
    for name in mine {
        fs::write(out.join(name), "mine").unwrap();
    }
    fs::write(out.join("snapshots/009.000.csv"), "").unwrap();
    fs::write(elsewhere.join("0.png"), "mine").unwrap();
    // A file that is a link is replaced, and what it leads to stays.
    symlink(elsewhere.join("0.png"), out.join("series.csv")).unwrap();
    let output = short(&["--out", text(&out)]);
    assert!([0, 1].contains(&code(&output)), "{}", stderr(&output));
    for name in mine {
        assert_eq!(fs::read_to_string(out.join(name)).unwrap(), "mine", "{name}");
    }
    assert!(!out.join("snapshots/009.000.csv").exists());
    assert!(!out.join("series.csv").is_symlink());
    assert_eq!(fs::read_to_string(elsewhere.join("0.png")).unwrap(), "mine");

    for link in ["cook", "snapshots"] {
        let _ = fs::remove_dir_all(out.join(link));
        symlink(&elsewhere, out.join(link)).unwrap();
        let before = files(folder.path());
        let output = short(&["--out", text(&out)]);
        refused(&output, &format!("{link}: a link"), folder.path(), &before);
        fs::remove_file(out.join(link)).unwrap();
    }
    let scene = Scene::new();
    let place = scene.report.join("cook/gimp-none-flip");
    fs::rename(&place, folder.path().join("moved")).unwrap();
    symlink(folder.path().join("moved"), &place).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("gimp-none-flip: a link"), "{}", stderr(&output));
}

#[test]
fn a_folder_has_one_writer_and_the_second_is_told_who_it_is() {
    let scene = Scene::new();
    let out = tempfile::tempdir().unwrap();
    let held = [out.path(), &scene.report, &scene.golden].map(|folder| hold(folder).unwrap());
    let [o, report, golden] = [out.path(), &scene.report, &scene.golden].map(text);
    let me = format!("another process writes to this folder: process {}, `", std::process::id());
    let before = files(scene.report.parent().unwrap());
    for command in [
        &["run", "cook", "--out", o][..],
        &["run", "cook", "--resume", o],
        &["verify", "--tier", "quick", "--out", o, "--golden", golden],
        &["report", report, "--golden", golden],
        &["bless", "cook", "--reason", "x", "--from", report, "--golden", golden],
        &["keep", report, "--into", o],
        &["diff", report, report, "--out", o],
        &["bench", "--rounds", "1", "--out", o],
    ] {
        let output = mpm_verify(command);
        let root = scene.report.parent().unwrap();
        refused(&output, &me, root, &before);
    }
    drop(held);
    assert_eq!(code(&scene.report()), 0);
}

/// Two processes for the same folder at the same time: one makes the run whole, the other is refused.
#[test]
fn of_two_runs_at_once_one_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let start = || {
        Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
            .args(["run", "cook", "--quiet", "--out", text(folder.path())])
            .output()
    };
    let codes = std::thread::scope(|scope| {
        let two = [(); 2].map(|()| scope.spawn(|| code(&start().unwrap())));
        two.map(|one| one.join().unwrap())
    });
    assert!([[0, 2], [2, 0]].contains(&codes), "{codes:?}");
    let ended = mpm_verify(&["run", "cook", "--resume", text(folder.path())]);
    assert!(stdout(&ended).contains("is already complete"), "{}", stderr(&ended));
}

/// A record vouches for the tables beside it.
#[test]
fn a_table_that_is_not_what_the_run_wrote_passes_nowhere() {
    let scene = Scene::new();
    let run = scene.report.join(RUN);
    for name in ["series.csv", "particles.csv"] {
        let path = run.join(name);
        let sound = fs::read(&path).unwrap();
        let middle = sound.len() / 2;
        let digit = middle + sound[middle..].iter().position(u8::is_ascii_digit).unwrap();
        let mut digit_changed = sound.clone();
        digit_changed[digit] = b'0' + (sound[digit] - b'0' + 1) % 10;
        let crlf = String::from_utf8(sound.clone()).unwrap().replace('\n', "\r\n");
        for damaged in [
            digit_changed,
            crlf.into_bytes(),
            [b"\xef\xbb\xbf", &sound[..]].concat(),
            sound[..sound.len() - 1].to_vec(),
            [&sound[..], b"\n"].concat(),
            Vec::new(),
        ] {
            fs::write(&path, damaged).unwrap();
            let output = scene.report();
            assert_eq!(code(&output), 2, "{name}");
            let said = stderr(&output);
            assert!(said.contains(name) && said.contains("that the run has written"), "{said}");
        }
        // Two gigabytes without content.
        fs::File::create(&path).unwrap().set_len(2 << 30).unwrap();
        assert!(stderr(&scene.report()).contains("are allowed"));
        fs::remove_file(&path).unwrap();
        assert!(stderr(&scene.report()).contains("is nothing, not the"));
        fs::create_dir(&path).unwrap();
        assert!(stderr(&scene.report()).contains("not a plain file"));
        fs::remove_dir(&path).unwrap();
        fs::write(&path, sound).unwrap();
    }
    fs::create_dir(run.join("snapshots")).unwrap();
    fs::write(run.join("snapshots/000.100.csv"), "x (m)\n1\n").unwrap();
    assert!(stderr(&scene.report()).contains("snapshots/000.100.csv"));
    fs::remove_dir_all(run.join("snapshots")).unwrap();
    let record = run.join("record.json");
    let sound = fs::read(&record).unwrap();
    for (pointer, value, needle) in [
        ("/parameters/poisson_ratio", json!(0.3), "of other parameters"),
        ("/discretisation/dt", json!(-1.0), "that no run has"),
        ("/time/wall_s", json!(-5.0), "that no run has"),
        ("/machine/cores", json!(0), "that no run has"),
        ("/files", json!({}), "not the nothing that the run has written"),
        ("/level", json!("h1"), "of another run"),
    ] {
        change(&record, pointer, value);
        let output = scene.report();
        assert_eq!(code(&output), 2, "{pointer}");
        assert!(stderr(&output).contains(needle), "{pointer}: {}", stderr(&output));
        fs::write(&record, &sound).unwrap();
    }
    assert_eq!(code(&scene.report()), 0);
}

#[test]
fn an_ended_run_is_judged_again_and_made_again_where_something_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let first = short(&["--out", text(out)]);
    let before = files(out);
    let record = out.join("record.json");
    let sound = json(&record);
    let mut forged = sound.clone();
    for verdict in forged["verdicts"].as_array_mut().unwrap() {
        verdict["outcome"] = json!("right");
    }
    assert_ne!(forged, sound);
    fs::write(&record, forged.to_string()).unwrap();
    let again = short(&["--resume", text(out)]);
    assert!(stdout(&again).contains("is already complete"));
    assert_eq!(code(&again), code(&first), "{}", stdout(&again));
    fs::write(&record, sound.to_string()).unwrap();
    for name in ["series.csv", "particles.csv"] {
        fs::remove_file(out.join(name)).unwrap();
        let again = short(&["--resume", text(out)]);
        assert_eq!(code(&again), code(&first), "{}", stderr(&again));
        assert!(stdout(&again).contains("the run is made again"), "{}", stdout(&again));
        assert!(files(out)[Path::new(name)] == before[Path::new(name)]);
    }
}

/// A plan with fewer runs than its tier is shown and passes nothing.
#[test]
fn a_plan_that_is_cut_is_incomplete() {
    let scene = Scene::new();
    let plan = scene.report.join("plan.json");
    let mut cut = json(&plan);
    cut["runs"].as_array_mut().unwrap().pop();
    fs::write(&plan, cut.to_string()).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 2, "{}", stdout(&output));
    assert!(stderr(&output).contains("incomplete: of the "), "{}", stderr(&output));
    let golden = files(&scene.golden);
    let bless = ["bless", "cook", "--reason", "x", "--from", text(&scene.report)];
    let output = mpm_verify(&[&bless[..], &["--golden", text(&scene.golden)]].concat());
    refused(&output, "incomplete: of the ", &scene.golden, &golden);
    change(&plan, "/tier", json!("nightly"));
    assert_eq!(code(&scene.report()), 2);
}

#[test]
fn links_pipes_and_circles_end_a_reader() {
    let scene = Scene::new();
    let record = scene.report.join(RUN).join("record.json");
    let kept = record.with_file_name("kept.json");
    fs::rename(&record, &kept).unwrap();
    symlink(&kept, &record).unwrap();
    assert!(stderr(&scene.report()).contains("record.json: a link"));
    fs::remove_file(&record).unwrap();
    assert!(Command::new("mkfifo").arg(&record).status().unwrap().success());
    assert!(stderr(&scene.report()).contains("record.json: not a plain file"));
    for deep in ["{\"schema\": 2, \"a\": ".repeat(100_000), "[".repeat(10_000_000)] {
        fs::remove_file(&record).unwrap();
        fs::write(&record, deep).unwrap();
        assert!(stderr(&scene.report()).contains("record.json: damaged"));
    }
    let report = one_case();
    let circle = tempfile::tempdir().unwrap();
    copy_tree(report, circle.path());
    for name in ["a", "b"] {
        symlink(".", circle.path().join(name)).unwrap();
    }
    let output = mpm_verify(&["diff", text(circle.path()), text(report)]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}
