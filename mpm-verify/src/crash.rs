//! Runs, verifications and reports on machines that fail at every step by which they change a file.

mod bless;

use crate::case::Case;
use crate::cases;
use crate::error::Error;
use crate::files::fault::{Fault, Step, on_machine};
use crate::files::{make_folder, read, read_versioned, write_whole};
use crate::golden::Goldens;
use crate::night::Night;
use crate::record::{Record, fixture};
use crate::report::keep::keep;
use crate::report::{Files, write_report};
use crate::run::checkpoint::Saving;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::RunSpec;
use crate::study::gather::Gathered;
use crate::study::judge::judged_run;
use crate::study::plan::{Plan, PlannedRun, Shard};
use crate::study::schedule::{Listener, make_runs};
use crate::study::summary::{SCHEMA, Summary};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A run of a few rows.
fn spec() -> (&'static Case, RunSpec) {
    let case = cases::find("cook").unwrap();
    let set = ["max_periods=0.01", "rest_window=0.005", "load_ramp=0.005"];
    (case, fixture::spec(Scheme::flip(BasisName::Gimp, RemedyName::FbarTotal), case.levels[0], &set))
}

fn saving() -> Saving {
    let (every, resume) = (Duration::ZERO, true);
    Saving { every, resume }
}

fn make(folder: &Path) -> Result<Record, Error> {
    let (case, spec) = spec();
    judged_run(case, &spec, Some((folder, saving())), 1, &|_| {})
}

/// Every file below a folder with its content.
fn walk(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn below(root: &Path, folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                below(root, &path, found);
                continue;
            }
            let name = path.strip_prefix(root).unwrap().to_path_buf();
            found.insert(name, fs::read(&path).unwrap());
        }
    }
    let mut found = BTreeMap::new();
    below(root, root, &mut found);
    found
}

/// [`walk`], of records without the time and the machine.
fn content(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = walk(folder);
    let records = found.iter_mut();
    for (_, bytes) in records.filter(|(name, _)| name.ends_with("record.json")) {
        let mut record: serde_json::Value = serde_json::from_slice(bytes).unwrap();
        for varying in ["time", "machine"] {
            record.as_object_mut().unwrap().remove(varying).unwrap();
        }
        *bytes = record.to_string().into_bytes();
    }
    found
}

/// Two folders have the same files.
fn require_same(a: &Path, b: &Path, about: &str) {
    let (a, b) = (content(a), content(b));
    let differs = |name: &&PathBuf| a.get(*name) != b.get(*name);
    let different: Vec<&PathBuf> = a.keys().chain(b.keys()).filter(differs).collect();
    assert!(different.is_empty(), "{about}: {different:?}");
}

/// Checks that every file is on the disk before it gets its name: written, synced, renamed, and then the folder synced.
/// Returns the number of files that got their names.
fn require_safe_names(log: &[(Step, PathBuf)]) -> usize {
    let mut renamed = 0;
    for (k, (step, path)) in log.iter().enumerate() {
        if *step != Step::Rename {
            continue;
        }
        renamed += 1;
        let name = path.file_name().unwrap().to_str().unwrap();
        let draft = path.with_file_name(format!(".{name}.part"));
        assert_eq!(log[k - 1], (Step::Sync, draft.clone()));
        let begun = log[..k].iter().rposition(|s| *s == (Step::Create, draft.clone())).unwrap();
        assert!(log[begun + 1..k - 1].iter().all(|s| *s == (Step::Write, draft.clone())));
        assert_eq!(log[k + 1], (Step::SyncFolder, path.clone()));
    }
    renamed
}

/// Whatever is written whole is old or new: records, pages, goldens, rows of nights.
#[test]
fn a_file_is_the_old_or_the_new_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    for fault in [Fault::Kill, Fault::Full] {
        for at in 0..5 {
            fs::write(&path, "old").unwrap();
            let write = || write_whole(&path, b"the new one");
            let (written, log) = on_machine(folder.path(), fault, at, write);
            let now = read(&path, 100).unwrap();
            assert!(now == b"old" || now == b"the new one", "{fault:?} at {at}");
            assert!(written.is_err() || now == b"the new one");
            assert!(log.len() <= 5);
            write_whole(&path, b"the new one").unwrap();
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no draft is left");
        }
    }
}

struct Deaf;

impl Listener for Deaf {
    fn begins_again(&self, _: usize, _: &Error) {}
    fn ended(&self, _: usize, _: &Record) {}
}

/// Makes a run and reports it.
fn verify(root: &Path) -> Result<(), Error> {
    one_run(root)?;
    report(root, &["runs"], "runs", None)
}

/// A whole report has its summary at its end or not at all.
fn require_whole_report(folder: &Path) {
    let summary = folder.join("summary.json");
    assert!(!summary.exists() || read_versioned::<Summary>(&summary, SCHEMA).is_ok());
}

/// Times differ, and pages show them: the report's files are compared by name, those of the run by content.
#[test]
fn a_verification_and_its_report_survive_failures() {
    let straight = tempfile::tempdir().unwrap();
    let (made, log) = on_machine(straight.path(), Fault::Kill, usize::MAX, || verify(straight.path()));
    made.unwrap();
    let names = |folder: &Path| content(folder).into_keys().collect::<Vec<_>>();
    let run = Path::new("runs/cook").join(spec().1.folder());
    assert!(straight.path().join(&run).is_dir());
    let faults = [Fault::Kill, Fault::Full].into_iter().cycle();
    for (k, fault) in faults.enumerate().take(8) {
        let at = (2 * k + 1) * log.len() / 16;
        let folder = tempfile::tempdir().unwrap();
        let (failed, _) = on_machine(folder.path(), fault, at, || verify(folder.path()));
        assert!(failed.is_err(), "{fault:?} at {at}");
        require_whole_report(&folder.path().join("runs"));
        verify(folder.path()).unwrap();
        assert_eq!(names(folder.path()), names(straight.path()));
        require_same(&folder.path().join(&run), &straight.path().join(&run), "the run");
    }
}

/// The share of one shard of some of a plan of as many runs, each with a length of its own.
fn plan(index: usize, count: usize) -> Plan {
    let (case, spec) = spec();
    let run = |shard: usize| {
        let mut set = spec.set.clone();
        set[0] = format!("max_periods=0.0{shard}");
        PlannedRun { case: case.name.to_owned(), scheme: spec.scheme, level: spec.level.name.to_owned(), set, shard }
    };
    Plan { schema: 1, tier: "quick".to_owned(), shard: Shard { index, count }, runs: (1..=count).map(run).collect() }
}

/// Reports what lies in some folders below `root` in `out`.
fn report(root: &Path, from: &[&str], out: &str, night: Option<&Night>) -> Result<(), Error> {
    let from: Vec<PathBuf> = from.iter().map(|name| root.join(name)).collect();
    let gathered = Gathered::read(&from)?;
    let goldens = Goldens::open(&root.join("golden"))?;
    let judged = gathered.judge(|r| goldens.compare(r, gathered.folder(r)?))?;
    write_report(&gathered, judged, &goldens, night, (&root.join(out), Files::All)).map(drop)
}

/// A command that changes files below a folder.
struct Deed {
    /// Its steps, at least: the page says so.
    least: usize,
    /// Stride between the steps with an injected failure: no divisor of those of a file, so that steps of all kinds
    /// fail.
    of: usize,
    /// Prepares the folder before it.
    prepare: fn(&Path) -> Result<(), Error>,
    work: fn(&Path) -> Result<(), Error>,
}

/// One run, and an empty folder of goldens.
fn one_run(root: &Path) -> Result<(), Error> {
    make_folder(&root.join("golden"))?;
    make_runs(&plan(1, 1), &root.join("runs"), saving(), 1, &Deaf).map(drop)
}

/// Reports one run of the night of a day in January.
fn report_night(root: &Path, day: &str) -> Result<(), Error> {
    let night = Night::new(&format!("2026-01-{day}"), day)?;
    report(root, &["runs"], "runs", Some(&night))
}

fn copy(from: &Path) -> tempfile::TempDir {
    let to = tempfile::tempdir().unwrap();
    for (name, bytes) in walk(from) {
        let path = to.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    fs::create_dir_all(to.path().join("golden")).unwrap();
    to
}

/// A command that fails at any of its steps ends, when it is given again, with the files of one that has not failed.
/// Returns the number of files that got their names.
fn survives(deed: &Deed) -> usize {
    let before = tempfile::tempdir().unwrap();
    (deed.prepare)(before.path()).unwrap();
    let straight = copy(before.path());
    let work = || (deed.work)(straight.path());
    let (made, log) = on_machine(straight.path(), Fault::Kill, usize::MAX, work);
    made.unwrap();
    assert!(log.len() >= deed.least, "{} steps", log.len());
    for fault in [Fault::Kill, Fault::Full] {
        for at in (0..log.len()).step_by(deed.of) {
            let folder = copy(before.path());
            let work = || (deed.work)(folder.path());
            let (failed, steps) = on_machine(folder.path(), fault, at, work);
            let adds = |(step, _): &(Step, PathBuf)| matches!(step, Step::Create | Step::Write);
            let fails = fault == Fault::Kill || log[at..].iter().any(adds);
            assert_eq!(failed.is_err(), fails, "{fault:?} at {at}: {steps:?}");
            require_whole_report(&folder.path().join("runs"));
            require_whole_report(&folder.path().join("all"));
            (deed.work)(folder.path()).unwrap();
            let about = format!("{fault:?} at {at}: {:?}", steps.last());
            require_same(folder.path(), straight.path(), &about);
        }
    }
    require_safe_names(&log)
}

/// A run that is killed, or whose disk is full, at any step resumes bit for bit.
#[test]
fn a_run_survives_a_failure_at_every_step() {
    let work = |root: &Path| make(root).map(drop);
    let named = survives(&Deed { least: 40, of: 1, prepare: |_| Ok(()), work });
    assert!(named > 3);
}

#[test]
fn a_merge_survives_failures_at_every_step() {
    let prepare = |root: &Path| {
        make_folder(&root.join("golden"))?;
        let shards = [("a", plan(1, 2)), ("b", plan(2, 2))];
        shards.iter().try_for_each(|(to, plan)| make_runs(plan, &root.join(to), saving(), 1, &Deaf).map(drop))
    };
    survives(&Deed { least: 50, of: 1, prepare, work: |root| report(root, &["a", "b"], "all", None) });
}

#[test]
fn a_report_over_an_earlier_one_survives_failures() {
    let prepare = |root: &Path| {
        one_run(root)?;
        report_night(root, "02")
    };
    survives(&Deed { least: 80, of: 9, prepare, work: |root| report_night(root, "03") });
}

#[test]
fn keeping_survives_failures_at_every_step() {
    let work = |root: &Path| keep(&root.join("runs"), &root.join("kept")).map(drop);
    let prepare = |root: &Path| {
        one_run(root)?;
        report_night(root, "02")?;
        keep(&root.join("runs"), &root.join("kept"))?;
        report_night(root, "03")
    };
    survives(&Deed { least: 10, of: 1, prepare, work });
}
