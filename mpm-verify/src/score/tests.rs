//! Results that were never computed: a reference in the form of a code's own result, and its faults.

mod board;
mod coverage;
mod gate;
mod schema;
mod together;

use super::*;
use crate::cases::find_scored;
use crate::error::Error;
use crate::record::fixture::spec;
use crate::run::vtu::write_vtu;
use crate::scheme::BasisName;
use serde_json::{Value, json};
use std::fs;

/// A folder with what `export` writes of a case.
struct Answer {
    folder: tempfile::TempDir,
    files: Vec<String>,
}

const CURVE: &str = "reference-curve.csv";
const SETTLED: &str = "settlement (-)";

impl Answer {
    fn exported(case: &str, level: &str, set: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (case, foreign) = find_scored(case).unwrap();
        let spec = spec((foreign.judged_as)(BasisName::Bspline2), find_level(case, level).unwrap(), set);
        let files = export::export(case, foreign, &spec, &folder.path().join("out")).unwrap();
        Self { folder, files }
    }

    /// Result for the column: the reference for the series.
    fn of_column() -> Self {
        let result = Self::exported("consolidation", "n8", &["load=0.3"]);
        fs::copy(result.path(CURVE), result.path("series.csv")).unwrap();
        result
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join("out").join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.text(name)).unwrap()
    }

    /// Changes the manifest.
    fn edit(&self, change: impl FnOnce(&mut Value)) {
        let mut manifest = self.json(FILE);
        change(&mut manifest);
        fs::write(self.path(FILE), manifest.to_string()).unwrap();
    }

    fn say(&self, key: &str, value: Value) {
        self.edit(|manifest| manifest[key] = value);
    }

    /// Makes the manifest one of several runs.
    fn list(&self, runs: impl IntoIterator<Item = Value>) {
        self.edit(|manifest| {
            let own = ["schema", "code", "case", "scheme", "parameters"];
            manifest.as_object_mut().unwrap().retain(|key, _| own.contains(&&**key));
            manifest["runs"] = runs.into_iter().collect();
        });
    }

    fn scores(&self) -> Result<Scores, Error> {
        Scores::read(&self.folder.path().join("out"))
    }

    fn refusal(&self) -> String {
        self.scores().map(|_| ()).unwrap_err().to_string()
    }

    /// The only run.
    fn score(&self) -> Result<Scored, Error> {
        self.scores().map(|mut scores| scores.runs.remove(0))
    }

    /// Changes the numbers of a column of the series; without, it is taken away.
    fn change(&self, column: &str, change: Option<fn(f64) -> f64>) {
        let table = Table::read(&self.path("series.csv")).unwrap();
        let columns = table.iter().filter_map(|(name, values)| {
            let values = match (name == column, change) {
                (false, _) => values.to_vec(),
                (true, Some(change)) => values.iter().map(|v| change(*v)).collect(),
                (true, None) => return None,
            };
            Some((name, values))
        });
        Table::of_columns(columns).write(&self.path("series.csv")).unwrap();
    }
}

/// Outcomes of the checks, those of wanted quantities apart.
fn outcomes(scored: &Scored) -> Vec<(&str, Outcome)> {
    let verdicts = scored.record.verdicts.iter().filter(|v| !v.is_wanted());
    verdicts.map(|v| (&*v.check, v.outcome)).collect()
}

#[test]
fn the_reference_told_as_a_result_is_right() {
    let result = Answer::of_column();
    result.say("cost", json!({"cpu_s": 2.5, "wall_s": 3.5, "steps": 4}));
    result.say("time_step_s", json!(0.25));
    let scored = result.score().unwrap();
    let right = ["settlement", "base-pressure"].map(|check| (check, Outcome::Right));
    assert_eq!(outcomes(&scored), right);
    assert!(scored.missing.is_empty() && scored.unknown.is_empty());
    let record = &scored.record;
    for off in ["settlement_error", "base_pressure_error"] {
        let measured = &record.metrics[off];
        assert_eq!(measured.value, Some(0.0), "{off}");
    }
    assert_eq!((record.time.cpu_s, record.time.wall_s), (2.5, 3.5));
    assert_eq!((record.work.steps, record.work.particles), (4, 0));
    assert_eq!((record.discretisation.dt, record.discretisation.h), (0.25, 0.125));
    assert_eq!(record.set, ["load=0.3"]);
    assert_eq!((&*record.case, &*record.level), ("consolidation", "n8"));
    assert_eq!(scored.manifest.code.name.0, "my code");
    // Missing statements stay missing.
    let silent = Answer::of_column().score().unwrap().record;
    assert!(silent.time.cpu_s.is_nan() && silent.time.wall_s.is_nan());
    assert!(silent.discretisation.dt.is_nan() && silent.work.steps == 0);
}

#[test]
fn a_wrong_column_fails_and_without_it_nothing_is_judged() {
    let result = Answer::of_column();
    result.change(SETTLED, Some(|s| 1.3 * s));
    let wrong = result.score().unwrap();
    let of = |settlement| [("settlement", settlement), ("base-pressure", Outcome::Right)];
    assert_eq!(outcomes(&wrong), of(Outcome::Failed));
    result.change(SETTLED, None);
    let without = result.score().unwrap();
    assert_eq!(outcomes(&without), of(Outcome::NotJudged));
    let unjudged = without.record.verdicts.iter().find(|v| !v.is_wanted()).unwrap();
    assert_eq!(unjudged.source, "missing: settlement (-) of the series");
    assert_eq!(unjudged.value, None);
    let missing: Vec<String> = without.missing.iter().map(Asked::header).collect();
    assert_eq!(missing, [SETTLED]);
    assert!(!without.record.metrics.contains_key("settlement_error"));
}

#[test]
fn particles_may_be_a_grid_of_vtk_and_a_series_may_not() {
    let result = Answer::exported("cook", "h2", &[]);
    let asked = find_scored("cook").unwrap().1.columns();
    let start = Table::read(&result.path("start.csv")).unwrap();
    let of_particles = asked.iter().filter(|a| a.part == Part::Particles);
    let columns = of_particles.map(|a| {
        let zeros = || vec![0.0; start.rows()];
        let values = start.get(&a.header()).map_or_else(zeros, <[f64]>::to_vec);
        crate::job::Column { name: a.name, unit: a.unit, values }
    });
    let columns: Vec<_> = columns.collect();
    write_vtu(&result.path("particles.vtu"), &columns).unwrap();
    result.say("particles", json!("particles.vtu"));
    result.say("series", Value::Null);
    let scored = result.score().map_err(|e| e.to_string()).unwrap();
    assert_eq!(scored.record.work.particles, start.rows() as u64);
    assert!(scored.missing.iter().all(|a| a.part == Part::Series) && !scored.missing.is_empty());
    let refused = |key: &str, value: Value| {
        result.say(key, value);
        result.refusal()
    };
    let said = refused("series", json!("particles.vtu"));
    assert!(said.contains("series \"particles.vtu\"; allowed: a .csv file"), "{said}");
    let said = refused("particles", json!("particles.txt"));
    assert!(said.contains("particles \"particles.txt\"; allowed: a .csv, .vtu, .vtp or .vtk file"), "{said}");
    refused("series", Value::Null);
    let said = refused("particles", Value::Null);
    assert!(said.contains("no table; this case is scored by: particles, series"), "{said}");
}

#[test]
fn what_a_manifest_names_is_refused_by_its_key() {
    for (key, value, named) in [
        ("case", json!("cok"), "case: unknown case"),
        ("level", json!("n9"), "level: unknown level"),
        ("parameters", json!({"laod": 1}), "parameters: unknown parameter"),
        ("parameters", json!({"load": 3}), "parameter load: \"3\" is out of range"),
        ("parameters", json!({"load": [0.3]}), "a number, boolean or word is allowed"),
        ("schema", json!(2), "schema 2 where 1 is read"),
        ("partikles", json!("a.csv"), "is `particles` meant?"),
        ("code", json!({"name": "a", "vesion": "1"}), "is `version` meant?"),
        ("code", json!({"name": ""}), "a line of 1 to 200"),
        ("scheme", json!("a\u{1b}[31m"), "a line of 1 to 200"),
        ("basis", json!("fem"), "expected one of `linear`"),
        ("time_step_s", json!(0), "a positive, finite number"),
        ("cost", json!({"cpu": 1}), "is `cpu_s` meant?"),
        ("series", json!("none.csv"), "none.csv"),
    ] {
        let result = Answer::of_column();
        result.say(key, value);
        let said = result.refusal();
        assert!(said.contains(named), "{said}");
    }
    // A table that the case does not ask for is ignored.
    let result = Answer::of_column();
    result.say("particles", json!("none.csv"));
    assert!(result.score().is_ok());
}

#[test]
fn what_is_exported_is_the_problem() {
    let result = Answer::of_column();
    let names = ["start.csv", "start.vtu", "problem.json", "reference.csv", CURVE, FILE, "README.md"];
    assert_eq!(result.files, names);
    let problem = result.json("problem.json");
    assert_eq!((&problem["case"], &problem["level"]), (&json!("consolidation"), &json!("n8")));
    assert_eq!((&problem["cell_size_m"], &problem["dimension"]), (&json!(0.125), &json!(1)));
    let load = problem["parameters"].as_array().unwrap();
    let load = load.iter().find(|p| p["name"] == "load").unwrap();
    assert_eq!(load["value"], json!(0.3));
    let manifest = result.json(FILE);
    assert_eq!(manifest["parameters"], json!({"load": 0.3}));
    assert_eq!((&manifest["series"], &manifest["particles"]), (&json!("series.csv"), &Value::Null));
    let reference = result.text("reference.csv");
    let rows: Vec<&str> = reference.lines().collect();
    assert_eq!(rows[0], "check,metric,unit,reference,tolerance,why");
    for (row, begin) in rows[1..].iter().zip(["settlement,settlement_error,-,", "base-pressure,"]) {
        assert!(row.starts_with(begin), "{row}");
    }
    assert_eq!(rows.len(), 3);
    let readme = result.text("README.md");
    for line in [
        "Cells of 0.125 m.",
        "| `load` | 0.3 |",
        "- `start.csv`: the particles of our runs before anything moves",
        "- `problem.json`: the problem as data, and parameters with values, units and meanings",
        "- `reference.csv`: what the checks demand",
        "- `reference-curve.csv`: the reference as a curve",
        "- `score.json`: a form to fill in",
        "## `series.csv`: a row a time",
        "| `settlement (-)` | settlement of the top over H |",
        "| settlement | settlement_error | `time_factor`, `settlement` |",
        "`mpm-verify explain consolidation` says",
    ] {
        assert!(readme.contains(line), "{line}: {readme}");
    }
    assert!(!readme.contains("particles.csv"), "{readme}");
    // Parameters that no line of the problem names are not among those that it shows.
    assert!(!readme.contains("| `refine` |"), "{readme}");
    let both = Answer::exported("cook", "h2", &[]).text("README.md");
    assert!(both.contains("## `particles.csv`: a row a particle, in any order"), "{both}");
    // The unit is that of the metric; of a load that has no reference nothing is demanded.
    let cook = Answer::exported("cook", "h2", &[]).text("reference.csv");
    assert!(cook.contains("\nmid-edge,mid_edge_uy,m,0.26"), "{cook}");
    let metrics = &find_scored("cook").unwrap().0.metrics;
    for row in cook.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let metric = metrics.iter().find(|m| m.name == cells[1]).unwrap();
        assert_eq!(cells[2], metric.unit, "{row}");
    }
    let none = Answer::exported("consolidation", "n8", &["load=0.2"]);
    assert_eq!(none.text("reference.csv").lines().count(), 1);
}

#[test]
fn a_form_is_not_overwritten() {
    let result = Answer::of_column();
    let before = result.text(FILE);
    let (case, foreign) = find_scored("cook").unwrap();
    let spec = spec((foreign.judged_as)(BasisName::Bspline2), find_level(case, "h2").unwrap(), &[]);
    let said = export::export(case, foreign, &spec, &result.path("")).unwrap_err().to_string();
    assert!(said.contains("score.json: it is there") && said.contains("allowed: a folder without it"), "{said}");
    assert_eq!((result.text(FILE), result.json("problem.json")["case"].clone()), (before, json!("consolidation")));
}

#[test]
fn words_of_a_result_are_words_on_the_page() {
    let result = Answer::of_column();
    result.say("code", json!({"name": "<script>|a", "version": "![p](http://a)"}));
    result.say("scheme", json!("[a](javascript:b) `<i>`"));
    result.change(SETTLED, None);
    let series = result.text("series.csv").replace("base_pressure (-)", "<img onerror=x>");
    fs::write(result.path("series.csv"), series).unwrap();
    let scores = result.scores().unwrap();
    let ours = crate::report::scored::beside(&scores).unwrap();
    crate::report::scored::write(&scores, &ours, &gate::gate(false, &[]), &result.path("")).unwrap();
    let page = result.text("score.md");
    for active in ["<script", "<img", "<i>", "[a](", "![p]("] {
        assert!(!page.contains(active), "{active}: {page}");
    }
    for shown in
        ["# consolidation n8, load=0.3: &lt;script>|a \\!\\[p\\](", "| &lt;script>\\|a |", "&lt;img onerror=x>"]
    {
        assert!(page.contains(shown), "{shown}: {page}");
    }
}
