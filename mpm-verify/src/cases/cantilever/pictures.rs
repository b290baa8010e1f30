//! The pictures of the cantilever, beside those of the paper.

use super::metrics::CORNER_ERROR;
use super::parameters::LOAD_STEPS;
use super::reference::solution;
use super::scene::{DEPTH, LENGTH};
use crate::draw::style::series;
use crate::draw::{
    Chart, Dash, FieldFigure, FieldPanel, Marker, ReferenceLine, Scale, Series, draw_charts,
    draw_fields,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::BasisName;

/// σ_xx is drawn between plus and minus this (Pa).
const STRESS_RANGE: f64 = 4e4;
/// What the paper's figures are of.
const PAPER: [&str; 3] = ["law=jaumann-linear", "points=gauss", "stabilisation=soft"];

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    beams(gallery)?;
    convergence(gallery)?;
    paths(gallery)
}

/// The beam by quadratic splines and by serendipity elements: the paper's Figure 2.
fn beams(gallery: &mut Gallery) -> Result<(), Error> {
    let mut panels = Vec::new();
    let shown = [
        (
            BasisName::Bspline2,
            "quadratic splines, ghost penalty",
            "h0.05",
            &[][..],
        ),
        (
            BasisName::Q8,
            "serendipity elements, soft stiffness",
            "h0.05",
            &["stabilisation=soft"],
        ),
    ];
    for (basis, title, level, set) in shown {
        let of = |r: &&Record| {
            r.basis() == basis && r.level == level && r.set == set && r.status == Status::Ok
        };
        let Some(record) = gallery.records.iter().find(of) else {
            return Ok(());
        };
        let table = gallery.table(record, "particles.csv")?;
        panels.push(FieldPanel {
            title: title.to_owned(),
            points: table.points("x", "y"),
            values: table.column("stress_xx").to_vec(),
            size: record.discretisation.h / f64::from(record.discretisation.ppc).sqrt(),
            outline: vec![(0.0, 0.0), (LENGTH, 0.0), (LENGTH, DEPTH), (0.0, DEPTH)],
        });
    }
    let figure = FieldFigure {
        title: String::new(),
        panels,
        columns: 2,
        range: (-STRESS_RANGE, STRESS_RANGE),
        label: "σ_xx (Pa)".to_owned(),
        window: None,
    };
    draw_fields(&gallery.place("beams.png"), &figure)?;
    gallery.hang("beams.png", "The beam at 4 kN/m³ and where it began, h = 0.05 m, σ_xx; the paper's Figure 2 shows such serendipity elements at h = 0.1 m.");
    Ok(())
}

/// Error over cell size and over load steps.
fn convergence(gallery: &mut Gallery) -> Result<(), Error> {
    let mut of_cells = Vec::new();
    let mut of_steps = Vec::new();
    for basis in [
        BasisName::Linear,
        BasisName::Gimp,
        BasisName::Bspline2,
        BasisName::Bspline3,
        BasisName::Q8,
    ] {
        let own = |r: &&Record| {
            let set: &[&str] = if basis == BasisName::Q8 {
                &["stabilisation=soft"]
            } else {
                &[]
            };
            r.basis() == basis && r.status == Status::Ok && r.set == set
        };
        let runs: Vec<&Record> = gallery.records.iter().filter(own).collect();
        let error = |r: &Record| 100.0 * r.metric(CORNER_ERROR);
        let points = runs.iter().map(|r| (r.discretisation.h, error(r)));
        let curve = |points: Vec<(f64, f64)>, scheme| Series {
            name: basis.to_string(),
            dash: Dash::Solid,
            colour: basis as usize,
            ..series(scheme, points)
        };
        if let Some(first) = runs.first() {
            of_cells.push(curve(points.collect(), first.scheme()));
        }
        let changed = |r: &&Record| {
            r.basis() == basis
                && r.status == Status::Ok
                && r.level == "h0.05"
                && r.changes_none_but(&[LOAD_STEPS.name])
        };
        let runs = gallery.records.iter().filter(changed);
        let mut points: Vec<(f64, f64)> = runs
            .clone()
            .map(|r| (r.parameters.number(LOAD_STEPS), error(r)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        if points.len() > 1 {
            let scheme = runs.clone().next().map(Record::scheme);
            of_steps.extend(scheme.map(|scheme| curve(points, scheme)));
        }
    }
    if of_cells.is_empty() {
        return Ok(());
    }
    let label = "error of the corner's u_y (%)";
    let logarithmic = |x: &str, curves| Chart {
        x_scale: Scale::Log10,
        y_scale: Scale::Log10,
        ..Chart::new("", [x, label], curves)
    };
    let mut charts = vec![logarithmic("cell size (m)", of_cells)];
    if !of_steps.is_empty() {
        charts.push(logarithmic("load steps", of_steps));
    }
    gallery.write_curves("convergence.csv", &charts)?;
    draw_charts(&gallery.place("convergence.png"), &charts, 2)?;
    gallery.hang("convergence.png", "Error of the corner's u_y against the finite elements, over the cell size with 20 load steps, and over the number of load steps at h = 0.05 m. Serendipity elements do not converge.");
    Ok(())
}

/// Displacement over weight for shares of soft stiffness and for numbers of particles: the paper's Figures 3 and 4.
fn paths(gallery: &mut Gallery) -> Result<(), Error> {
    let names = [
        ("edge_mean_ux", "edge mean u_x (m)", 0),
        ("edge_mean_uy", "edge mean u_y (m)", 1),
    ];
    let of_factor = |r: &Record| {
        let rest = r
            .set
            .iter()
            .find_map(|s| s.strip_prefix("stabilisation_factor="));
        let others = r
            .set
            .iter()
            .filter(|s| !s.starts_with("stabilisation_factor="));
        let own = others.eq(PAPER.iter());
        own.then(|| format!("soft stiffness {}", rest.unwrap_or("0.01")))
    };
    let of_points = |r: &Record| {
        let number = r
            .set
            .iter()
            .find_map(|s| s.strip_prefix("points_per_direction="));
        let others = r
            .set
            .iter()
            .filter(|s| !s.starts_with("points_per_direction="));
        let own = others.eq(PAPER.iter());
        let number: usize = number.unwrap_or("4").parse().unwrap_or(0);
        own.then(|| format!("{} particles a cell", number * number))
    };
    let mut charts = Vec::new();
    let names_of = |by_points: bool, r: &Record| {
        if by_points {
            of_points(r)
        } else {
            of_factor(r)
        }
    };
    for by_points in [false, true] {
        for (column, label, axis) in names {
            let mut curves = Vec::new();
            for record in gallery
                .records
                .iter()
                .filter(|r| r.basis() == BasisName::Q8)
            {
                let Some(name) = names_of(by_points, record) else {
                    continue;
                };
                let table = gallery.table(record, "series.csv")?;
                let points = table.points("weight", column).into_iter();
                curves.push(Series {
                    name,
                    points: points.map(|(w, u)| (1e-3 * w, u)).collect(),
                    colour: curves.len(),
                    marker: Marker::None,
                    dash: Dash::Solid,
                });
            }
            if curves.is_empty() {
                return Ok(());
            }
            let truth = gallery.records.iter().find(|r| r.is_default());
            let truth = truth.and_then(|r| solution(&r.parameters).ok()?.right_edge_mean);
            let lines = truth.map(|mean| ReferenceLine {
                name: "finite elements (Hencky)".to_owned(),
                value: mean[axis],
                band: None,
            });
            charts.push(Chart {
                reference_lines: lines.into_iter().collect(),
                ..Chart::new("", ["weight (kN/m³)", label], curves)
            });
        }
    }
    gallery.write_curves("paths.csv", &charts)?;
    draw_charts(&gallery.place("paths.png"), &charts, 2)?;
    gallery.hang("paths.png", "The paper's elements, points and linear update at h = 0.1 m, 20 load steps: mean displacement of the right side over the weight, for shares of soft stiffness (its Figure 3) and numbers of particles (its Figure 4).");
    Ok(())
}
