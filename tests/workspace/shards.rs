//! Shards, resumption, and folders that are not what they should be.

use super::{code, copy_tree, files, golden, json, mpm_verify, quick, stderr, text};
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};

fn verify(out: &Path, more: &[&str]) -> std::process::Output {
    let golden = golden();
    let start = ["verify", "--tier", "quick", "--out", text(out), "--golden", text(&golden)];
    mpm_verify(&[&start[..], more].concat())
}

fn report(folders: &[&Path], out: &Path) -> std::process::Output {
    let golden = golden();
    let mut arguments = vec!["report"];
    arguments.extend(folders.iter().map(|f| text(f)));
    arguments.extend(["--out", text(out), "--golden", text(&golden)]);
    mpm_verify(&arguments)
}

/// A JSON document with one value replaced.
fn changed(path: &Path, pointer: &str, value: serde_json::Value) -> String {
    let mut document = json(path);
    *document.pointer_mut(pointer).unwrap() = value;
    document.to_string()
}

/// Every record below a folder of runs.
fn records(folder: &Path) -> Vec<PathBuf> {
    files(folder).into_keys().filter(|name| name.ends_with("record.json")).collect()
}

#[test]
fn merged_shards_give_the_byte_same_report_as_one_run() {
    let (whole, _) = quick();
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["1", "2"].map(|k| folder.path().join(k));
    for (out, shard) in [(&a, "1/2"), (&b, "2/2")] {
        let output = verify(out, &["--shard", shard]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
    assert_eq!(records(&a).len() + records(&b).len(), records(whole).len());

    // The time that runs take is the one thing that no two runs share.
    for shard in [&a, &b] {
        for name in records(shard) {
            let mut record = json(&shard.join(&name));
            record["time"] = json(&whole.join(&name))["time"].clone();
            fs::write(shard.join(&name), record.to_string()).unwrap();
        }
    }
    let [one, two] = ["one", "two"].map(|k| folder.path().join(k));
    assert_eq!(code(&report(&[whole], &one)), 0);
    // In any order.
    assert_eq!(code(&report(&[&b, &a], &two)), 0);
    let (one, two) = (files(&one), files(&two));
    assert!(one.len() > 5);
    assert!(one.keys().eq(two.keys()));
    for (name, content) in &one {
        assert!(content == &two[name], "{} differs", name.display());
    }

    // A shard that is missing or there twice, or shards of two plans, make no report.
    for (folders, needle) in [
        (vec![a.as_path()], "of 2 shards these are missing: 2"),
        (vec![&a, &a, &b], "shard 1/2 is there twice"),
        (vec![&a, whole], "not shards of one plan"),
    ] {
        let out = folder.path().join("none");
        let output = report(&folders, &out);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(needle), "{}", stderr(&output));
        assert!(!out.exists());
    }
    let nowhere = mpm_verify(&["report", text(&a), text(&b)]);
    assert_eq!(code(&nowhere), 2);
    assert!(stderr(&nowhere).contains("--out"));
}

#[test]
fn what_is_half_written_is_no_report_until_it_is_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    copy_tree(quick().0, &out);
    let lost = out.join("cook/gimp-fbar-total-flip/h2/record.json");
    let records = files(&out).keys().filter(|f| f.ends_with("record.json")).count();
    fs::remove_file(&lost).unwrap();
    let kept = out.join("cook/gimp-none-flip/h2/record.json");
    let before = fs::read(&kept).unwrap();

    let output = report(&[&out], &out);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(said.contains(&format!("1 of {records} runs have no record")) && said.contains("--resume"), "{said}");
    assert!(said.contains("cook/gimp-fbar-total-flip/h2"), "{said}");

    // Nothing of the old report is left to be taken for the new one.
    for file in ["summary.json", "index.html", "junit.xml", "cook/rest.png"] {
        assert!(!out.join(file).exists(), "{file}");
    }

    let resumed = verify(&out, &["--resume"]);
    assert_eq!(code(&resumed), 0, "{}", stderr(&resumed));
    assert!(lost.exists());
    assert_eq!(fs::read(&kept).unwrap(), before, "what was there is kept");

    let another = verify(&out, &["--resume", "--shard", "1/2"]);
    assert_eq!(code(&another), 2);
    assert!(stderr(&another).contains("another plan"), "{}", stderr(&another));
}

#[test]
fn a_record_of_another_program_is_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    copy_tree(quick().0, &out);
    let stale = out.join("cook/gimp-none-flip/h2/record.json");
    let mut record = json(&stale);
    record["version"]["source"] = "000000000000".into();
    fs::write(&stale, record.to_string()).unwrap();

    let output = report(&[&out], &out);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("records of two programs"), "{}", stderr(&output));

    assert_eq!(code(&verify(&out, &["--resume"])), 0);
    assert_ne!(json(&stale)["version"]["source"], "000000000000");
}

#[test]
fn damaged_records_and_plans_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    copy_tree(quick().0, &out);
    let record = out.join("cook/gimp-none-flip/h2/record.json");
    let other = out.join("cook/gimp-fbar-rate-flip/h2/record.json");
    let plan = out.join("plan.json");
    for (path, content, needle) in [
        (&record, "{\"schema\": 2, \"case\"".to_owned(), "record.json: damaged"),
        (&record, "{\"schema\": 1}".to_owned(), "schema 1 where 2 is expected"),
        (&record, "{\"schema\": 2}".to_owned(), "record.json: damaged"),
        (&record, fs::read_to_string(&other).unwrap(), "of another run"),
        (&plan, "{".to_owned(), "plan.json: damaged"),
        (&plan, "{\"schema\": 9}".to_owned(), "schema 9 where 1 is expected"),
        (&plan, changed(&plan, "/runs", json!([])), "no runs"),
        (&plan, changed(&plan, "/runs/1/shard", json!(2)), "shard 2; allowed: 1 to 1"),
        (&plan, changed(&plan, "/shard/count", json!(0)), "shard 1/0; allowed"),
        (&record, changed(&record, "/perturbed", json!(true)), "of another run"),
        (&record, changed(&record, "/version", json!({"mpm_verify": "0.1.0"})), "missing field `source`"),
    ] {
        let sound = fs::read(path).unwrap();
        fs::write(path, content).unwrap();
        let output = report(&[&out], &out);
        fs::write(path, sound).unwrap();
        assert_eq!(code(&output), 2, "{needle}");
        let said = stderr(&output);
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains(needle), "{said}");
    }
    fs::remove_file(&plan).unwrap();
    let output = report(&[&out], &out);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("no plan.json"));
    assert_eq!(code(&report(&[Path::new("/nonexistent")], &out)), 2);
}
