//! Seeded faults: the solver is broken on purpose, and a named check must go red.
//!
//! The sources are copied, every fault is written into the copy behind a switch, the copy is built once, and
//! run with one fault at a time. Slow (a build from scratch), so it is not part of a plain `cargo test`: run
//! it with `--test mutation`.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod faults;
mod runs;

use faults::{DRIFT, FAULTS, Fault};
use mpm_verify::cases;
use mpm_verify::files::read_versioned;
use mpm_verify::record::{self, Record};
use mpm_verify::verdict::Verdict;
use rayon::prelude::*;
use runs::Runs;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names the fault that is on.
const SWITCH: &str = "MPM_SEEDED_FAULT";

/// What the copy of the core gets besides the faults.
const SWITCHED: &str = r#"
#[inline]
pub(crate) fn seeded(fault: &str) -> bool {
    static ON: std::sync::LazyLock<Option<String>> =
        std::sync::LazyLock::new(|| std::env::var("MPM_SEEDED_FAULT").ok());
    ON.as_deref() == Some(fault)
}
"#;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
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

/// Writes a fault into the copy, behind its switch.
fn seed(copy: &Path, fault: &Fault) {
    let Fault {
        name,
        sound,
        broken,
        ..
    } = fault;
    let path = copy.join("mpm-core/src").join(fault.file);
    let source = fs::read_to_string(&path).unwrap();
    let places = source.matches(sound).count();
    assert_eq!(places, 1, "{name}: the line has changed");
    let switched = format!("(if crate::seeded({name:?}) {{ {broken} }} else {{ {sound} }})");
    fs::write(&path, source.replace(sound, &switched)).unwrap();
}

/// The program of the copy.
struct Mutant<'a> {
    copy: &'a Path,
    program: PathBuf,
}

impl<'a> Mutant<'a> {
    fn build(copy: &'a Path) -> Self {
        let target = workspace().join("target/mutants");
        let build = Command::new(env!("CARGO"))
            .args([
                "build",
                "--profile",
                "mutant",
                "--bin",
                "mpm-verify",
                "--target-dir",
            ])
            .arg(&target)
            .current_dir(copy)
            .output()
            .unwrap();
        assert!(
            build.status.success(),
            "{}",
            String::from_utf8_lossy(&build.stderr)
        );
        Self {
            copy,
            program: target.join("mutant/mpm-verify"),
        }
    }

    /// Runs the program with a fault or none; returns the exit code and what it printed.
    fn call(&self, fault: Option<&Fault>, arguments: &[&str]) -> (i32, String) {
        let mut command = Command::new(&self.program);
        command
            .args(arguments)
            .current_dir(self.copy)
            .env_remove(SWITCH);
        if let Some(fault) = fault {
            command.env(SWITCH, fault.name);
        }
        let output = command.output().unwrap();
        (
            output.status.code().unwrap(),
            String::from_utf8_lossy(&output.stdout).into_owned(),
        )
    }

    /// All verdicts on some runs, one by one and together.
    fn judge(&self, fault: Option<&Fault>, runs: Runs) -> Vec<Verdict> {
        let records: Vec<Record> = runs
            .iter()
            .map(|run| {
                let folder = tempfile::tempdir_in(self.copy).unwrap();
                let mut arguments = vec!["run", "--threads", "1"];
                arguments.extend(run.split_whitespace());
                arguments.extend(["--out", folder.path().to_str().unwrap()]);
                let (code, text) = self.call(fault, &arguments);
                let record = folder.path().join("record.json");
                let record: Record = read_versioned(&record, record::SCHEMA).unwrap();
                let red = record.verdicts.iter().any(Verdict::failed);
                assert_eq!(code != 0, red, "{run}: exit code {code}: {text}");
                record
            })
            .collect();
        let case = cases::find(&records[0].case).unwrap();
        let mut verdicts = case.judge_study(&records);
        verdicts.extend(records.into_iter().flat_map(|r| r.verdicts));
        verdicts
    }

    /// What goes otherwise than it should. Runs are short and take one thread each: as many side by side as there are
    /// cores.
    fn complaints(&self) -> Vec<String> {
        let pairs: Vec<(&Fault, Runs, &str)> = FAULTS
            .iter()
            .flat_map(|f| {
                f.seen_by
                    .iter()
                    .map(move |(runs, check)| (f, *runs, *check))
            })
            .collect();
        let all: BTreeSet<Runs> = pairs.iter().map(|(_, runs, _)| *runs).collect();
        let sound: BTreeMap<Runs, Vec<Verdict>> = all
            .into_par_iter()
            .map(|runs| (runs, self.judge(None, runs)))
            .collect();
        let complaints = pairs.into_par_iter().flat_map(|(fault, runs, check)| {
            let mut complaints = Vec::new();
            let whole = &sound[runs];
            let held = |v: &Verdict| v.check == check && v.holds() == Some(true);
            if !whole.iter().any(held) || whole.iter().any(Verdict::failed) {
                complaints.push(format!("{check} of the sound program: {whole:#?}"));
            }
            let broken = self.judge(Some(fault), runs);
            let red = |v: &Verdict| v.check == check && v.failed();
            if !broken.iter().any(red) {
                complaints.push(format!("{} survives {check}: {broken:#?}", fault.name));
            }
            complaints
        });
        complaints.collect()
    }
}

#[test]
fn every_seeded_fault_turns_a_named_check_red() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path();
    let source = workspace();
    for part in ["Cargo.toml", "Cargo.lock"] {
        fs::copy(source.join(part), copy.join(part)).unwrap();
    }
    for part in [".cargo", "mpm-core", "mpm-verify", "tests"] {
        copy_tree(&source.join(part), &copy.join(part));
    }
    for fault in FAULTS.iter().chain([&DRIFT]) {
        seed(copy, fault);
    }
    let core = copy.join("mpm-core/src/lib.rs");
    let switched = fs::read_to_string(&core).unwrap() + SWITCHED;
    fs::write(core, switched).unwrap();
    let mutant = Mutant::build(copy);

    let mut complaints = mutant.complaints();
    fs::create_dir(copy.join("golden")).unwrap();
    let verify = [
        "verify", "cook", "--tier", "quick", "--golden", "golden", "--out", "report",
    ];
    let bless = [
        "bless", "cook", "--reason", "sound", "--golden", "golden", "--from", "report",
    ];
    for (arguments, expected) in [(&verify[..], 3), (&bless[..], 0), (&verify[..], 0)] {
        let (code, text) = mutant.call(None, arguments);
        if code != expected {
            complaints.push(format!(
                "the sound program, {arguments:?}: exit code {code}\n{text}"
            ));
        }
    }
    let (code, text) = mutant.call(Some(&DRIFT), &verify);
    if code != 3 || !text.contains("[DRIFT]") {
        complaints.push(format!("{} (exit code {code}, not 3):\n{text}", DRIFT.name));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
