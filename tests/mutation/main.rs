//! Seeded faults: the solver is broken on purpose, and a named check must go red.
//!
//! The sources are copied, every fault is written into the copy behind a switch, the copy is built once, and
//! run with one fault at a time. Slow (a build from scratch), so it is not part of a plain `cargo test`: run
//! it with `--test mutation`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod faults;
#[allow(dead_code, reason = "tests of the workspace read what is left here")]
mod kills;
mod runs;

use faults::{DRIFT, Fault, faults};
use kills::{Kills, Seer};
use mpm_verify::cases;
use mpm_verify::files::read_versioned;
use mpm_verify::record::{self, Record};
use mpm_verify::verdict::Verdict;
use rayon::prelude::*;
use runs::{DEAR, Runs};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names the fault that is on.
const SWITCH: &str = "MPM_SEEDED_FAULT";

/// Names the file in which a run writes what faults it could have had.
const REACHED: &str = "MPM_SEEDED_REACHED";

/// Stand-in for a check where the program ends without a record.
const NO_RECORD: &str = "(no record)";

/// Code added to the copy of the core besides the faults. A line that is reached reports it once.
const SWITCHED: &str = r#"
pub(crate) fn seeded(fault: &str, told: &std::sync::atomic::AtomicBool) -> bool {
    use std::io::Write as _;
    use std::sync::atomic::Ordering::Relaxed;
    static ON: std::sync::LazyLock<Option<String>> =
        std::sync::LazyLock::new(|| std::env::var("MPM_SEEDED_FAULT").ok());
    if !told.load(Relaxed) && !told.swap(true, Relaxed) {
        if let Ok(path) = std::env::var("MPM_SEEDED_REACHED") {
            let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
            let _ = file.and_then(|mut file| file.write_all(format!("{fault}\n").as_bytes()));
        }
    }
    ON.as_deref() == Some(fault)
}
"#;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().unwrap()
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
    let Fault { name, sound, broken, .. } = fault;
    let path = copy.join("mpm-core/src").join(fault.file);
    let source = fs::read_to_string(&path).unwrap();
    let places = source.matches(sound).count();
    assert_eq!(places, 1, "{name}: the line has changed");
    let told = "static TOLD: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);";
    let seeded = format!("{{ {told} crate::seeded({name:?}, &TOLD) }}");
    let switched = format!("(if {seeded} {{ {broken} }} else {{ {sound} }})");
    fs::write(&path, source.replace(sound, &switched)).unwrap();
}

/// The sound program's verdicts in some runs, and the faults whose lines these reach.
struct Sound {
    runs: Runs,
    verdicts: Vec<Verdict>,
    reached: BTreeSet<String>,
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
            .args(["build", "--profile", "mutant", "--bin", "mpm-verify", "--target-dir"])
            .arg(&target)
            .current_dir(copy)
            .output()
            .unwrap();
        assert!(build.status.success(), "{}", String::from_utf8_lossy(&build.stderr));
        Self { copy, program: target.join("mutant/mpm-verify") }
    }

    /// Runs the program with a fault or none; returns the exit code and what it printed.
    fn call(&self, fault: Option<&Fault>, arguments: &[&str]) -> (i32, String) {
        let mut command = Command::new(&self.program);
        command.args(arguments).current_dir(self.copy).env_remove(SWITCH).env_remove(REACHED);
        match fault {
            Some(fault) => command.env(SWITCH, fault.name),
            None => command.env(REACHED, self.copy.join(REACHED)),
        };
        let output = command.output().unwrap();
        (output.status.code().unwrap(), String::from_utf8_lossy(&output.stdout).into_owned())
    }

    /// All verdicts on some runs, one by one and together. A program that a fault makes end without a record has none.
    fn judge(&self, fault: Option<&Fault>, runs: Runs) -> Option<Vec<Verdict>> {
        let mut records = Vec::new();
        for run in runs {
            let folder = tempfile::tempdir_in(self.copy).unwrap();
            let mut arguments = vec!["run", "--threads", "1"];
            arguments.extend(run.split_whitespace());
            arguments.extend(["--out", folder.path().to_str().unwrap()]);
            let (code, text) = self.call(fault, &arguments);
            let record = folder.path().join("record.json");
            let record: Record = read_versioned(&record, record::SCHEMA).ok()?;
            let red = record.verdicts.iter().any(Verdict::failed);
            assert_eq!(code != 0, red, "{run}: exit code {code}: {text}");
            records.push(record);
        }
        let case = cases::find(&records[0].case).unwrap();
        let mut verdicts = case.judge_study(&records);
        verdicts.extend(records.into_iter().flat_map(|r| r.verdicts));
        Some(verdicts)
    }

    /// Results of the sound program in some runs, and the faults that could have acted there.
    fn sound(&self, runs: Runs) -> Sound {
        let copy = tempfile::tempdir_in(self.copy).unwrap();
        let own = Mutant { copy: copy.path(), program: self.program.clone() };
        let verdicts = own.judge(None, runs).unwrap();
        let names = fs::read_to_string(copy.path().join(REACHED)).unwrap();
        Sound { runs, verdicts, reached: names.lines().map(str::to_owned).collect() }
    }

    /// Deviations from the expected kills, and the checks that see each fault. Runs are short and take one thread each:
    /// as many side by side as there are cores.
    fn complaints(&self) -> (Vec<String>, Kills) {
        let all: BTreeSet<Runs> = faults().flat_map(|f| f.seen_by.iter().map(|(runs, _)| *runs)).collect();
        let sound: Vec<Sound> = all.into_par_iter().map(|runs| self.sound(runs)).collect();
        let named = |fault: &Fault, runs| fault.seen_by.iter().any(|(by, _)| *by == runs);
        let tasks: Vec<(&Fault, &Sound)> = faults()
            .flat_map(|fault| sound.iter().map(move |of| (fault, of)))
            .filter(|(fault, of)| {
                let others = of.reached.contains(fault.name) && !DEAR.contains(&of.runs);
                named(fault, of.runs) || others
            })
            .collect();
        let answers: Vec<(Vec<String>, &str, BTreeSet<Seer>)> = tasks
            .into_par_iter()
            .map(|(fault, of)| {
                let (runs, whole) = (of.runs, &of.verdicts);
                let mut complaints = Vec::new();
                let broken = self.judge(Some(fault), runs);
                let failed: BTreeSet<&str> = match &broken {
                    Some(broken) => {
                        let failed = broken.iter().filter(|v| v.failed() && !v.is_wanted());
                        failed.map(|v| v.check.as_str()).collect()
                    }
                    None => BTreeSet::from([NO_RECORD]),
                };
                for (_, check) in fault.seen_by.iter().filter(|(by, _)| *by == runs) {
                    let held = |v: &Verdict| v.check == *check && v.holds() == Some(true);
                    if !whole.iter().any(held) || whole.iter().any(Verdict::failed) {
                        complaints.push(format!("{check} of the sound program: {whole:#?}"));
                    }
                    if !failed.contains(check) {
                        let name = fault.name;
                        complaints.push(format!("{name} survives {check}: {broken:#?}"));
                    }
                }
                let case = runs[0].split_whitespace().next().unwrap();
                let seers = failed.iter().map(|c| (case.to_owned(), (*c).to_owned()));
                (complaints, fault.name, seers.collect())
            })
            .collect();
        let mut kills = Kills::default();
        let mut all = Vec::new();
        for (complaints, fault, seers) in answers {
            all.extend(complaints);
            kills.0.entry(fault.to_owned()).or_default().extend(seers);
        }
        (all, kills)
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
    for fault in faults().chain([&DRIFT]) {
        seed(copy, fault);
    }
    let core = copy.join("mpm-core/src/lib.rs");
    let switched = fs::read_to_string(&core).unwrap() + SWITCHED;
    fs::write(core, switched).unwrap();
    let mutant = Mutant::build(copy);

    let (mut complaints, kills) = mutant.complaints();
    kills.write(&source);
    fs::create_dir(copy.join("golden")).unwrap();
    let verify = ["verify", "cook", "--tier", "quick", "--golden", "golden", "--out", "report"];
    let bless = ["bless", "cook", "--reason", "sound", "--golden", "golden", "--from", "report"];
    for (arguments, expected) in [(&verify[..], 3), (&bless[..], 0), (&verify[..], 0)] {
        let (code, text) = mutant.call(None, arguments);
        if code != expected {
            complaints.push(format!("the sound program, {arguments:?}: exit code {code}\n{text}"));
        }
    }
    let (code, text) = mutant.call(Some(&DRIFT), &verify);
    if code != 3 || !text.contains("[DRIFT]") {
        complaints.push(format!("{} (exit code {code}, not 3):\n{text}", DRIFT.name));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
