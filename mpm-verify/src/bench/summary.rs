//! Tables and pictures of what was measured.

use super::{Bench, Measured, Spread, aims, model, newton};
use crate::draw::{Chart, Marker, Scale, Series, draw_charts};
use crate::error::Error;
use crate::files::{write_csv, write_whole};
use crate::table::Sheet;
use std::fmt::Write;
use std::path::Path;

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
        format_args!(
            "mpm-verify {}, source {}",
            bench.version.mpm_verify, bench.version.source
        )
    );
    for part in [
        aims_table(bench),
        workloads(bench),
        peers(bench),
        problems(bench),
        iterations(bench),
        sizes(bench),
    ] {
        text += &part;
    }
    write_whole(&out.join("summary.md"), text.as_bytes())?;
    write_rows(bench, out)?;
    draw_scaling(bench, out)?;
    Ok(text)
}

fn spread(spread: Option<Spread>, decimals: usize) -> String {
    spread.map_or("–".to_owned(), |s| {
        format!(
            "{:.decimals$} [{:.decimals$}, {:.decimals$}]",
            s.median, s.least, s.greatest
        )
    })
}

/// A table, or nothing without rows.
fn table<const N: usize>(
    title: &str,
    header: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> String {
    let sheet = Sheet::new(header).with(rows.map(Vec::from));
    match sheet.rows.is_empty() {
        true => String::new(),
        false => format!("\n## {title}\n\n{}", sheet.markdown()),
    }
}

fn aims_table(bench: &Bench) -> String {
    let row = |aim: aims::Aim| {
        let met = if aim.met { "met" } else { "missed" };
        [
            aim.what,
            aim.wanted,
            spread(Some(aim.measured), 2),
            met.to_owned(),
        ]
    };
    let rows = aims::of(bench).into_iter().map(row);
    table("Aims", ["what", "aim", "measured", ""], rows)
}

/// Updates per second (10⁶) by wall time.
fn rate(measured: &Measured) -> Option<Spread> {
    Spread::of(
        measured
            .samples
            .iter()
            .map(|s| 1e-6 * s.updates as f64 / s.wall_s),
    )
}

fn workloads(bench: &Bench) -> String {
    let row = |m: &Measured| {
        let dimension = if m.name.starts_with("W2") { 2 } else { 3 };
        let fbar = m.name.ends_with('F');
        let bytes = model::bytes(dimension, fbar);
        let operations = model::operations(dimension, fbar);
        let ours = m.wall_ns().map_or(f64::NAN, |s| s.median);
        let bandwidth = bytes / ours;
        let triad = bench.find("memory", "triad", m.threads);
        let triad = triad
            .and_then(Measured::wall_ns)
            .map_or(f64::NAN, |s| 1.0 / s.median);
        [
            m.name.clone(),
            m.threads.to_string(),
            m.particles.to_string(),
            spread(m.cpu_ns(), 1),
            spread(m.wall_ns(), 1),
            spread(rate(m), 1),
            format!("{bytes:.0}"),
            format!("{operations:.0}"),
            format!("{bandwidth:.1}"),
            format!("{triad:.1}"),
            format!("{:.0} %", 100.0 * bandwidth / triad),
        ]
    };
    let rows = bench.of_group("workload").map(row);
    let header = [
        "workload",
        "threads",
        "particles",
        "CPU (ns/update)",
        "wall (ns/update)",
        "10⁶ updates/s, wall",
        "bytes/update",
        "operations/update",
        "GB/s",
        "triad GB/s",
        "of the bound",
    ];
    table("Workloads", header, rows)
}

fn peers(bench: &Bench) -> String {
    let row = |m: &Measured| {
        let same = match m.same {
            Some(true) => "the same",
            _ => "OTHER: no ratio",
        };
        [
            m.name.clone(),
            m.threads.to_string(),
            spread(m.cpu_ns(), 1),
            spread(rate(m), 1),
            same.to_owned(),
        ]
    };
    let rows = bench.of_group("peer").map(row);
    let header = [
        "peer",
        "threads",
        "CPU (ns/update)",
        "10⁶ updates/s, wall",
        "sums to 10⁻⁹",
    ];
    table("Peers", header, rows)
}

fn problems(bench: &Bench) -> String {
    let row = |one: &Measured| {
        let others = bench.of_group("problem").filter(|m| m.name == one.name);
        let rates: Vec<String> = others
            .map(|m| format!("{} on {}", spread(rate(m), 2), m.threads))
            .collect();
        [
            one.name.clone(),
            one.particles.to_string(),
            spread(one.cpu_ns(), 1),
            rates.join(", "),
        ]
    };
    let ones = bench.of_group("problem").filter(|m| m.threads == 1);
    let header = [
        "problem",
        "particles",
        "CPU (ns/update), one thread",
        "10⁶ updates/s, wall, threads",
    ];
    table("Problems", header, ones.map(row))
}

fn iterations(bench: &Bench) -> String {
    let row = |steps: &newton::Steps| {
        let of = |part: &str| bench.find("newton", &steps.name(part), 1);
        let whole = of(newton::WHOLE)?;
        let milliseconds = |m: Option<&Measured>| {
            let per = |m: &Measured| {
                let each = m.samples.iter();
                Spread::of(each.map(|s| 1e3 * s.cpu_s / s.updates as f64))
            };
            spread(m.and_then(per), 0)
        };
        let [forces, assembly, factors, solution] =
            newton::PARTS.map(|(part, _)| milliseconds(of(part)));
        let particles = whole.particles.to_string();
        let all = milliseconds(Some(whole));
        Some([
            steps.case.to_owned(),
            steps.scheme.to_string(),
            particles,
            all,
            forces,
            assembly,
            factors,
            solution,
        ])
    };
    let header = [
        "load steps of",
        "scheme",
        "particles",
        "iteration (ms)",
        "forces",
        "assembly",
        "factorisation",
        "solution",
    ];
    let title = "Newton's iterations, one thread";
    table(title, header, newton::all().iter().filter_map(row))
}

fn sizes(bench: &Bench) -> String {
    let row = |m: &Measured| {
        let memory = m.memory.map(|bytes| bytes as f64 / m.particles as f64);
        [
            m.name.clone(),
            m.particles.to_string(),
            spread(m.cpu_ns(), 1),
            memory.map_or("–".to_owned(), |bytes| format!("{bytes:.0}")),
        ]
    };
    let rows = bench.of_group("scaling").map(row);
    let header = [
        "block",
        "particles",
        "CPU (ns/update)",
        "memory (bytes/particle)",
    ];
    table("Sizes, one thread", header, rows)
}

fn write_rows(bench: &Bench, out: &Path) -> Result<(), Error> {
    let header = [
        "group",
        "name",
        "threads",
        "particles",
        "round",
        "updates",
        "wall (s)",
        "CPU (s)",
    ];
    let rows = bench.measured.iter().flat_map(|m| {
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
pub(super) fn draw_scaling(bench: &Bench, out: &Path) -> Result<(), Error> {
    let names = ["W2", "W2F", "W3", "W3F"];
    let markers = [
        Marker::Circle,
        Marker::Square,
        Marker::Triangle,
        Marker::Diamond,
    ];
    let series = names.into_iter().zip(markers).enumerate();
    let series = series.map(|(k, (name, marker))| {
        let sizes = bench.of_group("scaling").filter(|m| m.name == name);
        let point = |m: &Measured| Some((m.particles as f64, m.cpu_ns()?.median));
        Series {
            marker,
            ..Series::line(name, sizes.filter_map(point).collect(), k)
        }
    });
    let series = series.filter(|s| !s.points.is_empty()).collect();
    let labels = ["particles", "CPU time per particle and step (ns)"];
    let chart = Chart {
        x_scale: Scale::Log10,
        ..Chart::new("Cost of a particle's step on one thread", labels, series)
    };
    match chart.shows_something() {
        true => Ok(draw_charts(&out.join("scaling.png"), &[chart], 1)?),
        false => Ok(()),
    }
}
