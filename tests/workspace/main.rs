//! Tests of the whole workspace through its binary.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod architecture;
mod browser;
mod budget;
mod checkpoint;
mod cli;
mod codes;
mod completeness;
mod exact;
mod folders;
mod fuzz;
mod gate;
mod kills;
mod language;
mod metamorphic;
#[path = "../../mpm-verify/examples/own_remedy.rs"]
mod own_remedy;
mod ranges;
mod readme;
mod reports;
mod scene;
mod score;
mod shards;
mod siege;
mod sizes;
mod tables;
mod verify;
mod words;

#[path = "../../mpm-verify/src/cli/mod.rs"]
#[allow(dead_code, reason = "of the program its syntax alone is tried here")]
mod cli_syntax;
#[path = "../../mpm-verify/src/progress.rs"]
#[allow(dead_code, reason = "as above")]
mod progress;

#[path = "../mutation/faults/mod.rs"]
#[allow(dead_code, reason = "of the faults only their names and what sees them")]
mod faults;
#[path = "../mutation/kills.rs"]
#[allow(dead_code, reason = "a run of the faults writes it")]
mod kill_matrix;
#[path = "../mutation/runs.rs"]
#[allow(dead_code, reason = "names of runs")]
mod runs;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Runs the program.
fn mpm_verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mpm-verify")).args(arguments).output().expect("the program starts")
}

/// A path as an argument.
fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap()
}

/// Report of the quick tier, made once, the goldens that were blessed of it, and the output of verifying it against
/// them.
struct Quick {
    report: tempfile::TempDir,
    golden: tempfile::TempDir,
    output: Output,
}

fn made() -> &'static Quick {
    static QUICK: OnceLock<Quick> = OnceLock::new();
    QUICK.get_or_init(|| {
        let [report, golden] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let places = ["--out", text(report.path()), "--golden", text(golden.path())];
        let verify = [&["verify", "--tier", "quick"], &places[..]].concat();
        let new = mpm_verify(&verify);
        assert_eq!(code(&new), 3, "{}{}", stdout(&new), stderr(&new));
        let plan = json(&report.path().join("plan.json"));
        let runs = plan["runs"].as_array().unwrap().iter();
        let cases: BTreeSet<&str> = runs.map(|run| run["case"].as_str().unwrap()).collect();
        for case in cases {
            let places = ["--from", text(report.path()), "--golden", text(golden.path())];
            let bless = [&["bless", case, "--reason", "first"], &places[..]].concat();
            let blessed = mpm_verify(&bless);
            assert_eq!(code(&blessed), 0, "{}{}", stdout(&blessed), stderr(&blessed));
        }
        for twin in files(report.path()).keys().filter_map(|f| f.parent()) {
            if twin.ends_with("twin") {
                let _ = fs::remove_dir_all(report.path().join(twin));
            }
        }
        let output = mpm_verify(&[&verify[..], &["--resume"]].concat());
        Quick { report, golden, output }
    })
}

/// The goldens of the quick tier.
fn golden() -> PathBuf {
    made().golden.path().to_path_buf()
}

/// The report of the quick tier and the output of making it. Tests work on copies.
fn quick() -> (&'static Path, &'static Output) {
    (made().report.path(), &made().output)
}

fn copy_tree(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_tree(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// Every file below a folder, relative to it, with its content; but not that which says who writes there.
fn files(root: &Path) -> std::collections::BTreeMap<PathBuf, Vec<u8>> {
    let (mut found, mut folders) = (std::collections::BTreeMap::new(), vec![root.to_path_buf()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with(".mpm-verify.lock") {
                let name = path.strip_prefix(root).unwrap().to_path_buf();
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    found
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}
