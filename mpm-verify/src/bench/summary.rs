//! Tables and pictures of what was measured.

use super::*;
use crate::draw::{Chart, Marker, Scale, Series, draw_charts};
use crate::files::{write_csv, write_whole};
use crate::table::Sheet;
use mpm_bench::{Measured, Measurements, Spread, aims, model, newton};
use std::fmt::Write;

/// Writes the tables and pictures of a bench and returns the tables.
pub(super) fn write(bench: &Bench, out: &Path) -> Result<String, Error> {
    let mut text = String::from("# Speed\n\n");
    let machine = &bench.machine;
    let processor = bench.processor.as_deref();
    let processor = processor.map_or(String::new(), |name| format!(" ({name})"));
    let _ = writeln!(
        text,
        "{} {}, {} cores{}; {}. Medians over the rounds, in brackets least and greatest; CPU time unless said.",
        machine.os,
        machine.arch,
        machine.cores,
        processor,
        format_args!("mpm-verify {}, source {}", bench.version.mpm_verify, bench.version.source)
    );
    let measured = &bench.measured;
    for part in [
        aims_table(measured),
        workloads(measured),
        peers(measured),
        problems(measured),
        iterations(measured),
        sizes(measured),
    ] {
        text += &part;
    }
    write_whole(&out.join("summary.md"), text.as_bytes())?;
    write_rows(measured, out)?;
    draw_scaling(measured, out)?;
    Ok(text)
}

fn spread(spread: Option<Spread>, decimals: usize) -> String {
    spread.map_or("–".to_owned(), |s| {
        format!("{:.decimals$} [{:.decimals$}, {:.decimals$}]", s.median, s.least, s.greatest)
    })
}

/// A column of a table: its title and its cell of a row.
type Column<'a, T> = (&'a str, &'a dyn Fn(&T) -> String);

/// A table, or nothing without rows.
fn table<T>(title: &str, rows: impl IntoIterator<Item = T>, columns: &[Column<'_, T>]) -> String {
    let cells = |row: T| columns.iter().map(|(_, cell)| cell(&row)).collect();
    let sheet = Sheet::new(columns.iter().map(|(title, _)| *title)).with(rows.into_iter().map(cells));
    if sheet.rows.is_empty() { String::new() } else { format!("\n## {title}\n\n{}", sheet.markdown()) }
}

fn aims_table(bench: &Measurements) -> String {
    let met = |aim: &aims::Aim| if aim.met { "met" } else { "missed" };
    table(
        "Aims",
        aims::of(bench),
        &[
            ("what", &|aim| aim.what.clone()),
            ("aim", &|aim| aim.wanted.clone()),
            ("measured", &|aim| spread(Some(aim.measured), 2)),
            ("", &|aim| met(aim).to_owned()),
        ],
    )
}

/// Updates per second (10⁶) by wall time.
fn rate(measured: &Measured) -> Option<Spread> {
    Spread::of(measured.samples.iter().map(|s| 1e-6 * s.updates as f64 / s.wall_s))
}

fn workloads(bench: &Measurements) -> String {
    let kind = |m: &Measured| (if m.name.starts_with("W2") { 2 } else { 3 }, m.name.ends_with('F'));
    let bytes = |m: &Measured| model::bytes(kind(m).0, kind(m).1);
    let operations = |m: &Measured| model::operations(kind(m).0, kind(m).1);
    let bandwidth = |m: &Measured| bytes(m) / m.wall_ns().map_or(f64::NAN, |s| s.median);
    let triad = |m: &Measured| {
        bench.find("memory", "triad", m.threads).and_then(Measured::wall_ns).map_or(f64::NAN, |s| 1.0 / s.median)
    };
    table(
        "Workloads",
        bench.of_group("workload"),
        &[
            ("workload", &|m| m.name.clone()),
            ("threads", &|m| m.threads.to_string()),
            ("particles", &|m| m.particles.to_string()),
            ("CPU (ns/update)", &|m| spread(m.cpu_ns(), 1)),
            ("wall (ns/update)", &|m| spread(m.wall_ns(), 1)),
            ("10⁶ updates/s, wall", &|m| spread(rate(m), 1)),
            ("bytes/update", &|m| format!("{:.0}", bytes(m))),
            ("operations/update", &|m| format!("{:.0}", operations(m))),
            ("GB/s", &|m| format!("{:.1}", bandwidth(m))),
            ("triad GB/s", &|m| format!("{:.1}", triad(m))),
            ("of the bound", &|m| format!("{:.0} %", 100.0 * bandwidth(m) / triad(m))),
        ],
    )
}

fn peers(bench: &Measurements) -> String {
    let same = |m: &Measured| match m.same {
        Some(true) => "the same",
        _ => "OTHER: no ratio",
    };
    table(
        "Peers",
        bench.of_group("peer"),
        &[
            ("peer", &|m| m.name.clone()),
            ("threads", &|m| m.threads.to_string()),
            ("CPU (ns/update)", &|m| spread(m.cpu_ns(), 1)),
            ("10⁶ updates/s, wall", &|m| spread(rate(m), 1)),
            ("sums to 10⁻⁹", &|m| same(m).to_owned()),
        ],
    )
}

fn problems(bench: &Measurements) -> String {
    let rates = |one: &Measured| {
        let others = bench.of_group("problem").filter(|m| m.name == one.name);
        others.map(|m| format!("{} on {}", spread(rate(m), 2), m.threads)).collect::<Vec<String>>().join(", ")
    };
    table(
        "Problems",
        bench.of_group("problem").filter(|m| m.threads == 1),
        &[
            ("problem", &|m| m.name.clone()),
            ("particles", &|m| m.particles.to_string()),
            ("CPU (ns/update), one thread", &|m| spread(m.cpu_ns(), 1)),
            ("10⁶ updates/s, wall, threads", &|m| rates(m)),
        ],
    )
}

fn iterations(bench: &Measurements) -> String {
    let of = |steps: &newton::Steps, part: &str| bench.find("newton", &steps.name(part), 1);
    let milliseconds = |steps: &newton::Steps, part: &str| {
        let per = |m: &Measured| Spread::of(m.samples.iter().map(|s| 1e3 * s.cpu_s / s.updates as f64));
        spread(of(steps, part).and_then(per), 0)
    };
    let [forces, assembly, factors, solution] = newton::PARTS.map(|(part, _)| part);
    let measured = newton::all().into_iter().filter_map(|steps| Some((of(&steps, newton::WHOLE)?.particles, steps)));
    table(
        "Newton's iterations, one thread",
        measured,
        &[
            ("load steps of", &|(_, steps)| steps.case.to_owned()),
            ("scheme", &|(_, steps)| steps.scheme.to_string()),
            ("particles", &|(particles, _)| particles.to_string()),
            ("iteration (ms)", &|(_, steps)| milliseconds(steps, newton::WHOLE)),
            (forces, &|(_, steps)| milliseconds(steps, forces)),
            (assembly, &|(_, steps)| milliseconds(steps, assembly)),
            (factors, &|(_, steps)| milliseconds(steps, factors)),
            (solution, &|(_, steps)| milliseconds(steps, solution)),
        ],
    )
}

fn sizes(bench: &Measurements) -> String {
    let each = |m: &Measured, bytes| format!("{:.0}", bytes as f64 / m.particles as f64);
    let memory = |m: &Measured| m.memory.map_or_else(|| "–".to_owned(), |bytes| each(m, bytes));
    table(
        "Sizes, one thread",
        bench.of_group("scaling"),
        &[
            ("block", &|m| m.name.clone()),
            ("particles", &|m| m.particles.to_string()),
            ("CPU (ns/update)", &|m| spread(m.cpu_ns(), 1)),
            ("memory (bytes/particle)", &|m| memory(m)),
        ],
    )
}

fn write_rows(bench: &Measurements, out: &Path) -> Result<(), Error> {
    let header = ["group", "name", "threads", "particles", "round", "updates", "wall (s)", "CPU (s)"];
    let rows = bench.0.iter().flat_map(|m| {
        m.samples.iter().enumerate().map(move |(round, s)| {
            vec![
                m.group.clone(),
                m.name.clone(),
                m.threads.to_string(),
                m.particles.to_string(),
                round.to_string(),
                s.updates.to_string(),
                s.wall_s.to_string(),
                s.cpu_s.to_string(),
            ]
        })
    });
    write_csv(&out.join("bench.csv"), &header.map(str::to_owned), rows)
}

/// Draws the cost over the number of particles, if it was measured.
fn draw_scaling(bench: &Measurements, out: &Path) -> Result<(), Error> {
    let names = ["W2", "W2F", "W3", "W3F"];
    let markers = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];
    let series = names.into_iter().zip(markers).enumerate().map(|(k, (name, marker))| {
        let sizes = bench.of_group("scaling").filter(|m| m.name == name);
        let point = |m: &Measured| Some((m.particles as f64, m.cpu_ns()?.median));
        Series { marker, ..Series::line(name, sizes.filter_map(point).collect(), k) }
    });
    let series = series.filter(|s| !s.points.is_empty()).collect();
    let labels = ["particles", "CPU time per particle and step (ns)"];
    let chart =
        Chart { x_scale: Scale::Log10, ..Chart::new("Cost of a particle's step on one thread", labels, series) };
    if chart.shows_something() { Ok(draw_charts(&out.join("scaling.png"), &[chart], 1)?) } else { Ok(()) }
}
