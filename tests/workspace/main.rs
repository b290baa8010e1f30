//! Tests of the whole workspace through its binary.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod browser;
mod checkpoint;
mod cli;
mod completeness;
mod exact;
mod gate;
mod readme;
mod shards;
mod update;
mod verify;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// Runs the program.
fn mpm_verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
        .args(arguments)
        .output()
        .expect("the program starts")
}

/// A path as an argument.
fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
}

/// The goldens of the repository.
fn golden() -> PathBuf {
    workspace().join("golden")
}

/// The report of the quick tier, made once, and the output of making it. Tests work on copies.
fn quick() -> (&'static Path, &'static Output) {
    static REPORT: OnceLock<(tempfile::TempDir, Output)> = OnceLock::new();
    let (folder, output) = REPORT.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let golden = golden();
        let output = mpm_verify(&[
            "verify",
            "--tier",
            "quick",
            "--out",
            text(folder.path()),
            "--golden",
            text(&golden),
        ]);
        (folder, output)
    });
    (folder.path(), output)
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

/// Every file below a folder, relative to it, with its content.
fn files(root: &Path) -> std::collections::BTreeMap<PathBuf, Vec<u8>> {
    fn walk(root: &Path, folder: &Path, found: &mut std::collections::BTreeMap<PathBuf, Vec<u8>>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(root, &path, found);
            } else {
                let name = path.strip_prefix(root).unwrap().to_path_buf();
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    let mut found = std::collections::BTreeMap::new();
    walk(root, root, &mut found);
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
    let text = std::fs::read_to_string(path).unwrap();
    serde_json::from_str(&text).unwrap()
}
