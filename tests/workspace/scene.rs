//! A report of one case with its goldens, for tests that damage it.

use super::{code, copy_tree, golden, json, mpm_verify, quick, stderr, stdout, text};
use mpm_verify::files::read_versioned;
use mpm_verify::golden::Goldens;
use mpm_verify::record::{Record, SCHEMA};
use mpm_verify::report::describe::drift_line;
use mpm_verify::verdict::Verdict;
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

pub(super) const RUN: &str = "gimp-fbar-rate-flip/h2";
/// The run of the case's picture.
pub(super) const SHOWN: &str = "gimp-none-flip/h2";

/// The report of the quick runs of one case, made once. A report is drawn anew for every defect: few pictures are enough.
pub(super) fn one_case() -> &'static Path {
    static REPORT: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = REPORT.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let mut plan = json(&quick().0.join("plan.json"));
        let runs = plan["runs"].as_array_mut().unwrap();
        runs.retain(|run| run["case"] == "cook");
        fs::write(folder.path().join("plan.json"), plan.to_string()).unwrap();
        copy_runs(&quick().0.join("cook"), &folder.path().join("cook"));
        let made = mpm_verify(&["report", text(folder.path()), "--golden", text(&golden())]);
        assert_eq!(code(&made), 0, "{}{}", stdout(&made), stderr(&made));
        folder
    });
    folder.path()
}

/// Copies the folders of a case's runs and not its pictures.
fn copy_runs(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_dir() {
            copy_tree(&entry.path(), &to.join(entry.file_name()));
        }
    }
}

/// Copies of the report and of its goldens.
pub(super) struct Scene {
    _folder: tempfile::TempDir,
    pub(super) report: PathBuf,
    pub(super) golden: PathBuf,
}

impl Scene {
    pub(super) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let scene =
            Self { report: folder.path().join("report"), golden: folder.path().join("golden"), _folder: folder };
        copy_tree(one_case(), &scene.report);
        copy_tree(&golden(), &scene.golden);
        scene
    }

    pub(super) fn report(&self) -> std::process::Output {
        mpm_verify(&["report", text(&self.report), "--golden", text(&self.golden)])
    }

    pub(super) fn bless(&self, reason: &str) -> std::process::Output {
        mpm_verify(&["bless", "cook", "--reason", reason, "--from", text(&self.report), "--golden", text(&self.golden)])
    }

    pub(super) fn record(&self) -> PathBuf {
        self.report.join("cook").join(RUN).join("record.json")
    }

    /// Multiplies a metric in a record, as if the solver had computed it.
    pub(super) fn falsify(&self, metric: &str, factor: f64) {
        let mut record = json(&self.record());
        let value = record["metrics"][metric]["value"].as_f64().unwrap();
        record["metrics"][metric]["value"] = json!(value * factor);
        fs::write(self.record(), record.to_string()).unwrap();
    }

    /// Drift of both runs, a line each.
    pub(super) fn drift(&self) -> Vec<String> {
        let goldens = Goldens::open(&self.golden).unwrap();
        let of_run = |run| {
            let folder = self.report.join("cook").join(run);
            let record: Record = read_versioned(&folder.join("record.json"), SCHEMA).unwrap();
            goldens.compare(&record, &folder).unwrap()
        };
        let all = [RUN, SHOWN].into_iter().flat_map(of_run);
        all.filter(Verdict::drifts).map(|v| format!("{} {}", drift_line(&v), v.source)).collect()
    }
}
