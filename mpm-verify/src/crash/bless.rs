//! Goldens that are blessed on machines that fail.

use super::{copy, require_safe_names, walk};
use crate::cases;
use crate::error::Error;
use crate::files::fault::{Fault, Step, on_machine};
use crate::golden::{Goldens, Run, TIER};
use crate::record::Record;
use crate::run::checkpoint::Saving;
use crate::run::series;
use crate::study::judge::judged_run;
use crate::table::Table;
use crate::verdict::Verdict;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Least number of steps of a blessing with an injected failure, as stated by the page.
const LEAST: usize = 20;

/// A run whose golden has all that there is: numbers, the picture of a series, a field and its picture.
fn run(folder: &Path) -> Record {
    let case = cases::find("cantilever").unwrap();
    let (every, resume) = (Duration::from_secs(3600), false);
    let saving = Saving { every, resume };
    let spec = &case.runs(TIER)[0];
    judged_run(case, spec, Some((folder, saving)), 1, &|_| {}).unwrap()
}

/// The run as another program might have made it: all its numbers a tenth larger.
fn changed(record: &Record, from: &Path, to: &Path) -> Record {
    let mut other = record.clone();
    for metric in other.metrics.values_mut() {
        metric.value = metric.value.map(|value| 1.1 * value);
    }
    for (file, fixed) in [(series::FILE, "time (-)"), ("particles.csv", "")] {
        let table = Table::read(&from.join(file)).unwrap();
        let larger = table.iter().map(|(name, values)| {
            let factor = if name == fixed { 1.0 } else { 1.1 };
            (name, values.iter().map(|value| factor * value).collect())
        });
        Table::of_columns(larger).write(&to.join(file)).unwrap();
    }
    other
}

fn bless(root: &Path, (record, folder): (&Record, &Path)) -> Result<(), Error> {
    let run = Run::of((record, folder), (record, folder))?;
    Goldens::open(root)?.bless(vec![(run, record, folder)], "it has changed")
}

/// Whether a run is as it was blessed.
fn holds(root: &Path, (record, folder): (&Record, &Path)) -> bool {
    let goldens = Goldens::open(root).unwrap();
    !(goldens.compare(record, folder).unwrap().iter()).any(Verdict::drifts)
}

/// Files with their final name in `folder`.
fn named(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = walk(folder);
    files.retain(|path, _| path.extension().is_none_or(|e| e != "part"));
    files
}

/// Wherever blessing fails, the old run still agrees with the old files or the new one with the new ones, and a mixture
/// is reported as drift of both. Blessing again ends with the files of an undisturbed one.
#[test]
fn a_blessing_survives_failures_at_every_step() {
    let [of_old, of_new, before] = [(); 3].map(|()| tempfile::tempdir().unwrap());
    let record = run(of_old.path());
    let other = changed(&record, of_old.path(), of_new.path());
    let (old, new) = ((&record, of_old.path()), (&other, of_new.path()));
    bless(before.path(), old).unwrap();
    assert!(holds(before.path(), old) && !holds(before.path(), new));

    let straight = copy(before.path());
    let work = || bless(straight.path(), new);
    let (made, log) = on_machine(straight.path(), Fault::Kill, usize::MAX, work);
    made.unwrap();
    assert!(log.len() >= LEAST, "{} steps", log.len());
    require_safe_names(&log);
    let [first, last] = [before.path(), straight.path()].map(named);
    let mut seen = BTreeSet::new();
    for (at, (step, _)) in log.iter().enumerate() {
        let faults: &[Fault] = match step {
            Step::Create => &[Fault::Kill, Fault::Full],
            // A full disk that has room for half of a file leaves what a kill leaves.
            _ => &[Fault::Kill],
        };
        for fault in faults {
            let folder = copy(before.path());
            let root = folder.path();
            let (failed, _) = on_machine(root, *fault, at, || bless(root, new));
            assert!(failed.is_err(), "{fault:?} at {at}");
            let now = named(root);
            if !seen.insert(now.clone()) {
                continue;
            }
            assert_eq!(holds(root, old), now == first, "{fault:?} at {at}");
            assert_eq!(holds(root, new), now == last, "{fault:?} at {at}");
            if !holds(root, new) {
                bless(root, new).unwrap();
            }
            assert!(named(root) == last, "{fault:?} at {at}");
        }
    }
    assert_eq!(seen.len(), 5, "four files, each the old or the new one");
}
