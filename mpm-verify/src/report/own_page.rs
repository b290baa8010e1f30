//! The page of one run by itself: verdict, warnings, pictures, metrics, the last row of its series and its parameters.

use super::document::{Document, Shown, Text};
use super::prelude::*;
use crate::table;

/// The file.
const PAGE: &str = "index.html";

/// Tables of a scene file, in the order in which the page has them.
const TABLES: [&str; 11] =
    ["grid", "body", "law", "bodies", "water", "loads", "supports", "contacts", "solver", "phases", "output"];

/// Writes the page of the run in `folder`, which has the `pictures`.
pub(super) fn write(case: &Case, record: &Record, pictures: &[Picture], folder: &Path) -> Result<(), Error> {
    let mut page = Document::new(case.title);
    let lead = match (&case.scenery, &record.error) {
        (Some(_), None) => "Nothing is known of the answer, so that it is not judged.".to_owned(),
        _ => sentence(record),
    };
    page.classed("lead", lead);
    page.list(case.description.lines());
    if let Some(failure) = &record.error {
        page.classed("error", failure.message.as_str());
    }
    let told = |v: &&Verdict| v.outcome != Outcome::Right && !v.source.is_empty() && v.check != "completes";
    let warned = record.verdicts.iter().filter(told);
    let warned: Vec<Text> = warned.map(|v| format!("{}: {}", v.check, v.source).into()).collect();
    if !warned.is_empty() {
        page.list(warned);
    }
    for picture in pictures {
        page.picture(Shown::of(picture, folder));
    }
    page.section("results", "Results at the end");
    let measured = case.metrics.iter().filter_map(|m| Some((m, record.metrics.get(m.name)?)));
    let rows = measured.map(|(m, at)| [m.name, &number(at.value), &at.unit, m.meaning].map(str::to_owned).into());
    page.table("Metrics", Sheet::new(["metric", "value", "unit", "meaning"]).with(rows));
    let path = folder.join(series::FILE);
    if path.exists() {
        page.section("series", "Last row of the series");
        let last = table::Table::read(&path)?;
        let last = last.iter().map(|(name, values)| vec![name.to_owned(), number(values.last().copied())]);
        page.table("Last row", Sheet::new(["column", "value"]).with(last));
    }
    page.section("input", "Input, with the keys that the file leaves out");
    page.table("Input", Sheet::new(["key", "value"]).with(input(case, record)));
    let d = &record.discretisation;
    let made = [
        ("scheme", record.scheme().to_string()),
        ("cells (m)", number(Some(d.h))),
        ("particles", record.work.particles.to_string()),
        ("steps", record.work.steps.to_string()),
        ("threads", record.machine.threads.to_string()),
        ("program", format!("mpm-verify {}, source {}", record.version.mpm_verify, record.version.source)),
    ];
    let mut files: Vec<&str> = record.files.keys().map(String::as_str).filter(|name| !name.contains('/')).collect();
    files.extend(
        ["particles.vtu", "snapshots.pvd", "scene-filled.toml"].iter().filter(|name| folder.join(name).exists()),
    );
    page.section("files", "Files");
    page.paragraph(Text::joined(files.into_iter().map(|name| Text::link(name, name)), ", "));
    page.section("made", "What made it");
    page.facts(made);
    page.write_page(case.title, Vec::new(), &folder.join(PAGE))
}

/// Every key of the input with its value; those of a scene's file by their tables.
fn input(case: &Case, record: &Record) -> Vec<Vec<String>> {
    let Some(scene) = &case.scenery else {
        let named =
            case.parameters.iter().map(|p| vec![format!("{} ({})", p.name, p.unit), record.parameters.text(*p)]);
        return named.collect();
    };
    let mut rows = Vec::new();
    if let Ok(all) = toml::from_str::<toml::Table>(&scene.filled) {
        for (name, value) in TABLES.iter().filter_map(|name| all.get_key_value(*name)) {
            leaves(name, value, &mut rows);
        }
    }
    rows
}

/// The values below a key that are no tables.
fn leaves(key: &str, value: &toml::Value, rows: &mut Vec<Vec<String>>) {
    let below = |name: &str| format!("{key}.{name}");
    match value {
        toml::Value::Table(table) => table.iter().for_each(|(name, value)| leaves(&below(name), value, rows)),
        toml::Value::Array(all) if all.iter().all(toml::Value::is_table) => {
            all.iter().enumerate().for_each(|(k, value)| leaves(&below(&(k + 1).to_string()), value, rows));
        }
        _ => rows.push(vec![key.to_owned(), value.to_string()]),
    }
}
