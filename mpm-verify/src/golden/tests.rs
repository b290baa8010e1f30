//! Goldens of runs that were never computed.

mod fields;

use super::*;
use crate::draw::write_small_png;
use crate::files::read_picture;
use crate::record::fixture::record;
use crate::record::{Measured, Status};
use crate::table::Table;
use image::Rgb;
use std::fs;

/// A run of Cook's membrane, its files, and the folder of its goldens.
struct Made {
    folder: tempfile::TempDir,
    record: Record,
}

impl Made {
    /// The case's first run, which its pictures show, or another; blessed.
    fn of(which: usize) -> Self {
        let spec = cases::find("cook").unwrap().runs(TIER).remove(which);
        let mut record = record(spec.level.name, Vec::new());
        record.scheme = spec.scheme;
        record.set = spec.set;
        for (name, value) in [("tip_uy", 10.0), ("mass", -2.0)] {
            record.metrics.insert(name.to_owned(), Measured::of(value, "m"));
        }
        let made = Self { folder: tempfile::tempdir().unwrap(), record };
        fs::create_dir(made.goldens()).unwrap();
        made.write("series.csv", &made.series());
        made.write("particles.csv", &Self::particles());
        made.bless();
        made
    }

    fn goldens(&self) -> PathBuf {
        self.folder.path().join("golden")
    }

    fn write(&self, file: &str, columns: &[(&str, Vec<f64>)]) {
        Table::of_columns(columns.iter().cloned()).write(&self.folder.path().join(file)).unwrap();
    }

    /// Sixteen rows, of which every second is kept.
    fn series(&self) -> [(&'static str, Vec<f64>); 4] {
        let times: Vec<f64> = (1..=16).map(|k| 0.5 * f64::from(k)).collect();
        let of = |f: fn(f64) -> f64| times.iter().map(|t| f(*t)).collect();
        [
            ("time (s)", times.clone()),
            ("tip_uy (m)", of(|t| t * t)),
            ("unwatched (m)", of(|t| -t)),
            ("log_jacobian_gap_rms (-)", of(|t| 1.0 / t)),
        ]
    }

    /// Four particles, the third of which is out of sight.
    fn particles() -> [(&'static str, Vec<f64>); 4] {
        [
            ("x (m)", vec![10.000_04, 20.0, 50.0, 0.0]),
            ("y (m)", vec![10.0, 30.0, 30.0, 60.0]),
            ("mass (kg)", vec![1.0; 4]),
            ("mean_stress (Pa)", vec![-1.0, 0.0, 0.5, 1.0]),
        ]
    }

    fn run(&self) -> Run {
        let now = (&self.record, self.folder.path());
        Run::of(now, now).unwrap()
    }

    fn bless(&self) {
        let goldens = Goldens::open(&self.goldens()).unwrap();
        let new = vec![(self.run(), &self.record, self.folder.path())];
        goldens.bless(new, "as it should be").unwrap();
    }

    fn compare(&self) -> Vec<Verdict> {
        let goldens = Goldens::open(&self.goldens()).unwrap();
        goldens.compare(&self.record, self.folder.path()).unwrap()
    }

    /// Drifted quantities, with their numbers.
    fn drift(&self) -> Vec<(String, Option<f64>, String)> {
        let drifts = self.compare().into_iter().filter(Verdict::drifts);
        drifts.map(|v| (v.metric, v.value, v.source)).collect()
    }

    fn drifting(&self) -> Vec<String> {
        self.drift().into_iter().map(|(metric, ..)| metric).collect()
    }
}

#[test]
fn a_run_is_that_which_was_blessed() {
    let made = Made::of(1);
    let run = made.run();
    // What was blessed before stays.
    let earlier = Golden {
        runs: vec![Run { name: Made::of(0).run().name, columns: run.columns.clone() }],
        blessings: vec!["2026-01-01: first".to_owned()],
    };
    let path = file(&made.goldens(), "cook");
    earlier.write(&path).unwrap();
    made.bless();
    let both = Golden::read(&path).unwrap();
    assert_eq!(both.runs, [earlier.runs[0].clone(), run.clone()]);
    assert_eq!((both.blessings.len(), &both.blessings[0]), (2, &earlier.blessings[0]));
    let names: Vec<&str> = run.columns.iter().map(|c| &*c.quantity).collect();
    let (numbers, counts) = names.split_at(4);
    let watched = ["series/tip_uy (m)", "series/log_jacobian_gap_rms (-)"];
    assert_eq!(numbers, ["metric/mass (m)", "metric/tip_uy (m)", watched[0], watched[1]]);
    assert!(counts.iter().all(|c| c.starts_with("work/")) && counts.len() == 7, "{counts:?}");
    let kept: Vec<_> = run.columns[2].points.iter().map(|p| (p.time, p.value)).collect();
    let every_second = (1..=8).map(f64::from).map(|t| (Some(t), t * t));
    assert_eq!(kept, every_second.collect::<Vec<_>>());

    let goldens = Goldens::open(&made.goldens()).unwrap();
    assert_eq!(goldens.kept(&made.record), Some(&run));
    let mut other = made.record.clone();
    other.set.push("load=2".to_owned());
    assert_eq!(goldens.kept(&other), None);

    let verdicts = made.compare();
    assert_eq!(verdicts.len(), run.columns.len());
    assert!(verdicts.iter().all(|v| v.outcome == Outcome::Right && v.check == CHECK));
    let of_series = verdicts.iter().find(|v| v.metric == "series tip_uy (m)").unwrap();
    assert_eq!((of_series.tolerance, of_series.kind), (Some(64e-7), Kind::Drift));
    assert!(of_series.source.contains("as it should be"), "{}", of_series.source);
}

/// Tolerances of a metric, of a row of a series by its column's scale, and of a count, which is exact.
#[test]
fn what_moves_by_more_than_its_tolerance_drifts() {
    let mut made = Made::of(1);
    let sound = made.record.clone();
    for (moved, drifts) in [(0.9e-6, false), (1.1e-6, true), (f64::NAN, true)] {
        made.record.metrics.get_mut("tip_uy").unwrap().value = Some(10.0 + moved);
        assert_eq!(made.drifting().len(), usize::from(drifts), "{moved}");
    }
    let drift = made.drift();
    assert_eq!((&*drift[0].0, drift[0].1.unwrap().is_nan()), ("tip_uy (m)", true));
    made.record = sound.clone();
    made.record.metrics.remove("tip_uy");
    let none = made.drift();
    assert!(none.len() == 1 && none[0].2.contains("the run has no such number"), "{none:?}");
    made.record = sound.clone();
    made.record.work.steps += 1;
    assert_eq!(made.drift(), [("count of steps".to_owned(), Some(4.0), made.drift()[0].2.clone())]);
    made.record = sound;
    // The row at 1 s is the second; of those that are not kept nothing is said.
    for (row, moved, drifts) in [(1, 6e-6, false), (1, 7e-6, true), (0, 1.0, false), (15, -7e-6, true)] {
        let mut series = made.series();
        series[1].1[row] += moved;
        made.write("series.csv", &series);
        let drift = made.drift();
        assert_eq!(drift.len(), usize::from(drifts), "{row} {moved} {drift:?}");
        if drifts {
            let time = 0.5 * (row as f64 + 1.0);
            assert_eq!((&*drift[0].0, drift[0].1), ("series tip_uy (m)", Some(series[1].1[row])));
            assert!(drift[0].2.starts_with(&format!("at time {time}; blessed ")), "{}", drift[0].2);
        }
    }
    // With two moved rows, the one that has moved further is reported.
    let mut series = made.series();
    (series[1].1[3], series[1].1[7]) = (4.1, 16.2);
    made.write("series.csv", &series);
    assert_eq!(made.drift()[0].1, Some(16.2));
    // A row at another time is reported as missing.
    let mut series = made.series();
    series[0].1[1] += 1e-8;
    made.write("series.csv", &series);
    let drift = made.drift();
    assert_eq!(drift.len(), 3, "both columns, and the picture");
    assert!(drift[0].2.contains("at time 1; the run has no such number"), "{drift:?}");
    series[0].1[1] = 1.0 + 7e-9;
    made.write("series.csv", &series);
    assert_eq!(made.drifting(), [""; 0]);
}

#[test]
fn without_a_golden_the_reason_is_told() {
    let mut made = Made::of(1);
    let sound = made.record.clone();
    made.record.status = Status::Failed;
    assert_eq!(made.drift()[0].2, "the run broke down: nothing to compare");
    made.record = sound;
    made.record.set.push("load=2".to_owned());
    let verdicts = made.compare();
    assert_eq!((verdicts.len(), verdicts[0].outcome), (1, Outcome::NotJudged));
    assert_eq!(verdicts[0].source, "goldens are kept of the runs of tier pr only");
    let made = Made::of(1);
    let file = file(&made.goldens(), "cook");
    fs::write(&file, "damaged").unwrap();
    assert!(made.drift()[0].2.contains("cook.json"));
    fs::remove_file(&file).unwrap();
    assert_eq!(made.drift()[0].2, "new: not yet blessed");
    let none = Goldens::open(&made.folder.path().join("none"));
    let said = none.map(|_| ()).unwrap_err().to_string();
    assert!(said.contains("no folder of goldens"), "{said}");
    let goldens = Goldens::open(&made.goldens()).unwrap();
    assert!(goldens.bless(Vec::new(), "nothing").is_ok() && !file.exists());
}

#[test]
fn the_picture_of_the_first_run_is_kept_and_compared() {
    let made = Made::of(0);
    let path = picture_file(&made.goldens(), "cook");
    assert_eq!(path, made.goldens().join("cook.png"));
    // One of other parameters doesn't change it, and is not judged by it.
    let other = runs(cases::find("cook").unwrap());
    let setting = |run: &str| run.split_once('/').unwrap().1.to_owned();
    let first = made.run().name;
    let other = other.iter().position(|run| setting(run) != setting(&first));
    let other = Made { folder: made.folder, record: Made::of(other.unwrap()).record };
    let before = fs::read(&path).unwrap();
    other.bless();
    assert_eq!(fs::read(&path).unwrap(), before);
    assert_eq!(other.compare().len(), other.run().columns.len());
    let made = Made { record: Made::of(0).record, ..other };
    assert_eq!(made.drifting(), [""; 0]);
    let columns = made.run().columns.len();
    assert_eq!(made.compare().len(), columns + 3, "the picture, the field and its picture");
    // Drawn from what was blessed where that holds, so that it shows no rounding.
    let mut series = made.series();
    series[1].1.fill(5.0);
    made.write("series.csv", &series);
    made.bless();
    series[1].1[5] += 4e-7;
    made.write("series.csv", &series);
    assert_eq!(made.drifting(), [""; 0]);
    series = made.series();
    made.write("series.csv", &series);
    made.bless();
    series[1].1[15] = 40.0;
    made.write("series.csv", &series);
    let drift = made.drift();
    assert_eq!((drift.len(), &*drift[1].0), (2, "different pixels of the picture"));
    assert!(drift[1].1 > Some(20.0), "{drift:?}");
    let goldens = Goldens::open(&made.goldens()).unwrap();
    let [old, new] = goldens.pictures(&made.record, made.folder.path()).unwrap();
    let kept = read_picture(&path).unwrap();
    assert!(old == kept && new != kept);
    let different = crate::draw::triptych::different_pixels(&old, &new);
    assert_eq!(drift[1].1, Some(different as f64));

    made.write("series.csv", &made.series());
    let mut other = kept.clone();
    other.put_pixel(5, 5, Rgb([9; 3]));
    write_small_png(&path, &other).unwrap();
    let drift = made.drift();
    assert_eq!((drift.len(), drift[0].1), (1, Some(1.0)));
    let cut = fs::read(&path).unwrap();
    fs::write(&path, &cut[..cut.len() - 1]).unwrap();
    assert!(made.drift()[0].2.contains("cook.png"));
}

#[test]
fn counts_are_summed_over_the_runs_of_a_case() {
    let case = cases::find("cook").unwrap();
    let root = tempfile::tempdir().unwrap();
    let path = file(root.path(), "cook");
    let counted = |(k, name): (usize, String)| {
        let count = |name: &str, value| Column::single(name.to_owned(), value, 0.0);
        let mut columns = vec![count(PAIRS, 10.0 * (k as f64 + 1.0))];
        if k == 1 {
            columns.push(count(NONZEROS, 7.0));
        }
        Run { name, columns }
    };
    let mut golden = Golden {
        blessings: vec!["2026-01-01: first".to_owned()],
        runs: runs(case).into_iter().enumerate().map(counted).collect(),
    };
    golden.write(&path).unwrap();
    let count = golden.runs.len() as u64;
    assert!(count > 2);
    assert_eq!(pairs(root.path(), "cook").unwrap(), 10 * count * (count + 1) / 2);
    assert_eq!(nonzeros(root.path(), "cook").unwrap(), 7);
    let gone = golden.runs.pop().unwrap();
    golden.write(&path).unwrap();
    let said = pairs(root.path(), "cook").unwrap_err().to_string();
    assert!(said.contains(&format!("cook.json: no golden of {}", gone.name)), "{said}");
    assert!(nonzeros(root.path(), "none").is_err());
}

#[test]
fn goldens_are_where_they_are_asked_for() {
    let asked = PathBuf::from("elsewhere");
    assert_eq!(place(Some(asked.clone())), asked);
    assert!(place(None).ends_with("golden") && place(None).is_dir());
    assert_eq!(bare("tip_uy (m)"), "tip_uy");
    assert_eq!(bare("tip_uy"), "tip_uy");
}
