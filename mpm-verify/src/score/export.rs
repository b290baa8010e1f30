//! Input of a case for another code: particles, parameters, reference, and a form to fill in.

use super::manifest::SCHEMA;
use super::*;
use crate::files::{make_folder, write_csv, write_json, write_whole};
use crate::parameter::Parameter;
use crate::problem::measured;
use crate::run::vtu::write_vtu;
use crate::table::Sheet;
use serde_json::{Value, json};
use std::fmt::Write;

/// The problems in words, a section a case.
const PROBLEMS: &str = include_str!("../../assets/problems.md");
/// The same for programs, of some cases: grid, body, supports, law, loads. Texts in the place of numbers are parameters.
const DATA: &str = include_str!("../../assets/problems.json");
/// File of the particles before anything moves.
const START: &str = "start.csv";

/// Writes what another code needs to solve a case at a level, with parameters changed, and the names of the files.
///
/// # Errors
/// The parameters make no scene, the folder has a form, or a file can't be written.
pub fn export(case: &Case, foreign: &Foreign, spec: &RunSpec, folder: &Path) -> Result<Vec<String>, Error> {
    let parameters = Parameters::new(&case.parameters, &spec.set)?;
    let form_file = folder.join(FILE);
    if form_file.symlink_metadata().is_ok() {
        return Err(Error::file(&form_file, "it is there, and may be filled in; allowed: a folder without it"));
    }
    let start = (foreign.start)(spec, &parameters)?;
    make_folder(folder)?;
    write_vtu(&folder.join("start.vtu"), &start)?;
    let columns = start.into_iter().map(|c| (format!("{} ({})", c.name, c.unit), c.values));
    Table::of_columns(columns).write(&folder.join(START))?;
    let discretisation = (foreign.discretisation)(spec, &parameters)?;
    write_json(&folder.join("problem.json"), &described(case, spec, &parameters, discretisation.dim))?;
    let demands = demands(case, foreign, Record::blank(case.name, spec, &parameters, discretisation, 0));
    let header = ["check", "metric", "unit", "reference", "tolerance", "why"].map(str::to_owned);
    let number = |x: Option<f64>| x.map_or(String::new(), |x| x.to_string());
    let rows = demands.iter().map(|(v, group)| {
        let unit = group.metrics.iter().find(|m| m.name == v.metric);
        let unit = unit.map_or("", |m| m.unit).to_owned();
        let [reference, tolerance] = [v.reference, v.tolerance].map(number);
        let (check, metric, why) = (v.check.clone(), v.metric.clone(), v.source.clone());
        vec![check, metric, unit, reference, tolerance, why]
    });
    write_csv(&folder.join("reference.csv"), &header, rows)?;
    let curves = (foreign.curves)(&parameters);
    let mut files = vec![START, "start.vtu", "problem.json", "reference.csv"];
    for (name, columns) in curves {
        Table::of_columns(columns).write(&folder.join(name))?;
        files.push(name);
    }
    write_whole(&form_file, form(case, foreign, spec).as_bytes())?;
    let readme = readme((case, foreign), (spec, &parameters), &demands, &files);
    write_whole(&folder.join("README.md"), readme.as_bytes())?;
    files.extend([FILE, "README.md"]);
    Ok(files.into_iter().map(str::to_owned).collect())
}

/// A problem in words: body, supports, loads, end.
fn words(case: &str) -> Vec<&'static str> {
    let section = PROBLEMS.split("\n# ").find_map(|s| s.strip_prefix(case)?.strip_prefix('\n'));
    section.unwrap_or_default().lines().filter_map(|line| line.strip_prefix("- ")).collect()
}

/// The problem, as data.
fn described(case: &Case, spec: &RunSpec, parameters: &Parameters, dimension: usize) -> Value {
    let values = serde_json::to_value(parameters).unwrap_or_default();
    let told = case
        .parameters
        .iter()
        .map(|p| json!({"name": p.name, "value": values[p.name], "unit": p.unit, "meaning": p.meaning}));
    json!({
        "case": case.name,
        "title": case.title,
        "level": spec.level.name,
        "cell_size_m": spec.level.h,
        "dimension": dimension,
        "setup": words(case.name),
        "problem": serde_json::from_str::<Value>(DATA).map_or(Value::Null, |all| all[case.name].clone()),
        "parameters": told.collect::<Value>(),
    })
}

/// A manifest to fill in. The lines of tables may be taken out: others stand behind them.
fn form(case: &Case, foreign: &Foreign, spec: &RunSpec) -> String {
    let changed = spec.set.iter().filter_map(|set| set.split_once('='));
    let changed = changed.map(|(name, text)| (name.to_owned(), serde_json::from_str(text).unwrap_or(json!(text))));
    let parts = foreign.parts().into_iter().map(Part::name);
    let tables: String = parts.map(|part| format!("  \"{part}\": \"{part}.csv\",\n")).collect();
    format!(
        "{{\n  \"schema\": {SCHEMA},\n  \"code\": {{ \"name\": \"my code\" }},\n  \"case\": \"{}\",\n  \"level\": \"{}\",\n  \
         \"parameters\": {},\n{tables}  \"scheme\": \"what it does, in your words\"\n}}\n",
        case.name,
        spec.level.name,
        Value::Object(changed.collect())
    )
}

/// Demands of the case's checks on another code: those on a record of any number of steps whose metrics are all zero, of
/// which only the demand is used.
fn demands<'a>(case: &Case, foreign: &'a Foreign, mut record: Record) -> Vec<(Verdict, &'a Group)> {
    record.work.steps = u64::MAX;
    let metrics = foreign.groups.iter().flat_map(|g| &g.metrics);
    record.metrics = metrics.map(|m| measured((*m, 0.0))).collect();
    let verdicts = case.judge(&record).into_iter();
    let demanded = verdicts.filter(|v| v.kind == Kind::Truth && v.tolerance.is_some() && foreign.asks(&v.check));
    let of_group = |v: Verdict| {
        let mut groups = foreign.groups.iter();
        let group = groups.find(|g| g.metrics.iter().any(|m| m.name == v.metric))?;
        Some((v, group))
    };
    demanded.filter_map(of_group).collect()
}

fn readme(
    (case, foreign): (&Case, &Foreign),
    (spec, parameters): (&RunSpec, &Parameters),
    demands: &[(Verdict, &Group)],
    files: &[&str],
) -> String {
    let mut t = format!("# {}, level {}\n\n", case.title, spec.level.name);
    let setup = words(case.name);
    for line in &setup {
        let _ = writeln!(t, "- {line}");
    }
    let _ = write!(
        t,
        "\nCells of {} m. All numbers are in SI units; forces and masses are per metre of depth, of section in one dimension. \
         Values of the parameters named above:\n\n",
        spec.level.h
    );
    let named = |p: &&Parameter| setup.iter().any(|s| s.contains(&format!("`{}`", p.name)));
    let rows = case.parameters.iter().filter(named);
    let rows = rows.map(|p| vec![format!("`{}`", p.name), parameters.text(*p), p.unit.to_owned()]);
    t += &Sheet::new(["parameter", "value", "unit"]).with(rows).markdown();
    t += "\n## Files\n\n";
    for file in files {
        let what = match *file {
            START => {
                "the particles of our runs before anything moves; yours may start elsewhere unless it is said above"
            }
            "start.vtu" => "the same for ParaView, in single precision",
            "problem.json" => "the problem as data, and parameters with values, units and meanings",
            "reference.csv" => "what the checks demand: reference ± tolerance, or a bound",
            _ => "the reference as a curve",
        };
        let _ = writeln!(t, "- `{file}`: {what}");
    }
    let _ = writeln!(t, "- `{FILE}`: a form to fill in");
    for part in foreign.parts() {
        let what = match part {
            Part::Particles => "a row a particle, in any order",
            Part::Series => "a row a time",
        };
        let _ = write!(t, "\n## `{}.csv`: {what}\n\n", part.name());
        let columns = foreign.columns().into_iter().filter(|c| c.part == part);
        let rows = columns.map(|c| vec![format!("`{}`", c.header()), c.meaning.to_owned()]);
        t += &Sheet::new(["column", "what it is"]).with(rows).markdown();
    }
    t += "\nA column that is missing is not judged. Others may stand beside these.\n\n## What is judged\n\n";
    let rows = demands.iter().map(|(v, group)| {
        let columns: Vec<String> = (group.columns.iter()).map(|c| format!("`{}`", c.name)).collect();
        vec![v.check.clone(), v.metric.clone(), columns.join(", ")]
    });
    t += &Sheet::new(["check", "of", "from"]).with(rows).markdown();
    let _ = write!(
        t,
        "\n`mpm-verify explain {}` says what every check demands and why. Fill in `{FILE}`, put your tables beside it, and\n\n\
         ```sh\nmpm-verify score .\n```\n",
        case.name
    );
    t
}
