//! The pictures of the cantilever, beside those of the paper.

use super::PAPER;
use super::metrics::{CORNER_ERROR, STRESS_MAX, STRESS_MIN};
use super::parameters::{LOAD_STEPS, POINTS_PER_DIRECTION, STABILISATION_FACTOR};
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
use crate::results::fixed;
use crate::scheme::BasisName;

/// σ_xx is drawn between plus and minus this (Pa).
const STRESS_RANGE: f64 = 4e4;
/// The paper's choices without its soft stiffness.
const UNSTABLE: [&str; 3] = ["law=jaumann-linear", "points=gauss", "stabilisation=none"];
/// Colour of what the paper prints.
const FROM_PAPER: usize = 7;
/// Where the paper's corner goes (m) at 4 kN/m³.
const CORNER_OF_PAPER: [f64; 2] = [-0.38, -0.61];

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    beams(gallery)?;
    charts(gallery)
}

/// The beam by quadratic splines, and by the paper's elements and choices: its Figure 2.
fn beams(gallery: &mut Gallery) -> Result<(), Error> {
    let shown: [(_, _, _, &[&str]); 2] = [
        (BasisName::Bspline2, "quadratic splines", "h0.05", &[]),
        (BasisName::Q8, "serendipity elements", "h0.1", &PAPER),
    ];
    let mut panels = Vec::new();
    for (basis, title, level, set) in shown {
        let of = |r: &&Record| {
            r.basis() == basis && r.level == level && r.set == set && r.status == Status::Ok
        };
        let Some(record) = gallery.records.iter().find(of) else {
            return Ok(());
        };
        let table = gallery.table(record, "particles.csv")?;
        let h = record.discretisation.h;
        let [from, to] = [STRESS_MIN, STRESS_MAX].map(|m| fixed(1).text(1e-3 * record.metric(m)));
        panels.push(FieldPanel {
            title: format!("{title}: {from}…{to} kPa"),
            points: table.points("x", "y"),
            values: table.column("stress_xx").to_vec(),
            size: h / f64::from(record.discretisation.ppc).sqrt(),
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
    gallery.hang("beams.png", "The beam at 4 kN/m³ and where it began, σ_xx: at h = 0.05 m, and at h = 0.1 m with the paper's elements, points, soft stiffness and linear update. Its Figure 2 tells of −40.8…27.6 kPa at the points and, extrapolated, −47.5…32.0 kPa at the nodes, where its finite elements have −47.4…32.6 kPa.");
    Ok(())
}

/// What of the paper's choices is changed in a run with serendipity elements at h = 0.1 m: nothing but the parameter
/// `name`, whose value is told, the `default` where it is not set.
fn of_paper<'a>(r: &'a Record, name: &str, default: &'a str) -> Option<&'a str> {
    let value = |s: &'a String| s.strip_prefix(name)?.strip_prefix('=');
    let changed = r.set.iter().find_map(value);
    let mut others = r.set.iter().filter(|s| value(s).is_none());
    let own = r.basis() == BasisName::Q8 && r.level == "h0.1";
    (own && others.by_ref().eq(PAPER.iter())).then(|| changed.unwrap_or(default))
}

/// A column of a run over its weight, from rest on.
fn path(gallery: &Gallery, record: &Record, column: &str) -> Result<Vec<(f64, f64)>, Error> {
    let table = gallery.table(record, "series.csv")?;
    let points = table.points("weight", column).into_iter();
    let points = points.map(|(weight, u)| (1e-3 * weight, u));
    Ok(std::iter::once((0.0, 0.0)).chain(points).collect())
}

/// Displacement over weight for shares of soft stiffness and for numbers of particles: the paper's Figures 3 and 4.
fn paths(gallery: &mut Gallery) -> Result<Vec<Chart>, Error> {
    let factor = |r: &Record| {
        let none = r.basis() == BasisName::Q8 && r.set == UNSTABLE;
        let value = of_paper(r, STABILISATION_FACTOR.name, "0.01");
        let soft = value.map(|value| format!("soft stiffness {value}"));
        soft.or_else(|| none.then(|| "none: stops".to_owned()))
    };
    let points = |r: &Record| {
        let number: u32 = of_paper(r, POINTS_PER_DIRECTION.name, "4")?.parse().ok()?;
        Some(format!("{} particles a cell", number * number))
    };
    let x = ("edge_mean_ux", "edge mean u_x (m)", 0);
    let y = ("edge_mean_uy", "edge mean u_y (m)", 1);
    type Name<'a> = &'a dyn Fn(&Record) -> Option<String>;
    let figures: [(&str, Name, _); 3] = [
        ("Figure 3", &factor, y),
        ("Figure 4a", &points, x),
        ("Figure 4b", &points, y),
    ];
    let mut charts = Vec::new();
    for (title, name_of, (column, label, axis)) in figures {
        let mut curves = Vec::new();
        for record in gallery.records {
            let Some(name) = name_of(record) else {
                continue;
            };
            let ends = record.status == Status::Ok;
            curves.push(Series {
                name,
                points: path(gallery, record, column)?,
                colour: curves.len(),
                marker: if ends { Marker::None } else { Marker::Cross },
                dash: Dash::Solid,
            });
        }
        if curves.is_empty() {
            continue;
        }
        let of_elements = |r: &Record| {
            let known = solution(&r.parameters).ok()?;
            let (name, value) = ("finite elements (Hencky)", known.right_edge_mean?[axis]);
            Some(ReferenceLine::known_to(name, value, known.uncertainty))
        };
        let default = gallery.records.iter().find(|r| r.is_default());
        let truth = default.and_then(of_elements);
        curves.push(Series {
            name: "corner, as the paper prints it".to_owned(),
            points: vec![(4.0, CORNER_OF_PAPER[axis])],
            colour: FROM_PAPER,
            marker: Marker::Diamond,
            dash: Dash::None,
        });
        charts.push(Chart {
            reference_lines: truth.into_iter().collect(),
            ..Chart::new(title, ["weight (kN/m³)", label], curves)
        });
    }
    Ok(charts)
}

/// The error of the corner's u_y (%) over `x`, a curve for every basis, of the runs of which `own` holds.
fn errors(
    gallery: &Gallery,
    (label, x): (&str, fn(&Record) -> f64),
    own: impl Fn(&Record) -> bool,
) -> Chart {
    let bases = [
        BasisName::Linear,
        BasisName::Gimp,
        BasisName::Bspline2,
        BasisName::Bspline3,
        BasisName::Q8,
    ];
    let curve = |basis: BasisName| {
        let mut runs = gallery
            .records
            .iter()
            .filter(|r| r.basis() == basis && r.status == Status::Ok && own(r));
        let scheme = runs.clone().next()?.scheme();
        let mut points: Vec<(f64, f64)> = runs
            .by_ref()
            .map(|r| (x(r), 100.0 * r.metric(CORNER_ERROR)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(Series {
            name: basis.to_string(),
            colour: basis as usize,
            ..series(scheme, points)
        })
    };
    let curves = bases.into_iter().filter_map(curve).collect();
    Chart {
        x_scale: Scale::Log10,
        y_scale: Scale::Log10,
        ..Chart::new("", [label, "error of the corner's u_y (%)"], curves)
    }
}

/// Whether a run has what every basis is held by: serendipity elements by the soft stiffness.
fn is_held(r: &Record) -> bool {
    let soft: &[&str] = match r.basis() {
        BasisName::Q8 => &["stabilisation=soft"],
        _ => &[],
    };
    r.set
        .iter()
        .filter(|s| !s.starts_with(LOAD_STEPS.name))
        .eq(soft)
}

/// The paper's Figures 3 and 4, the convergence that explains them, and that over load steps.
fn charts(gallery: &mut Gallery) -> Result<(), Error> {
    let mut charts = paths(gallery)?;
    let size = (
        "cell size (m)",
        (|r| r.discretisation.h) as fn(&Record) -> f64,
    );
    let steps = (
        "load steps",
        (|r| r.parameters.number(LOAD_STEPS)) as fn(&Record) -> f64,
    );
    let twenty = |r: &Record| is_held(r) && r.parameters.number(LOAD_STEPS) == 20.0;
    charts.push(errors(gallery, size, twenty));
    charts.push(errors(gallery, steps, |r| is_held(r) && r.level == "h0.05"));
    charts.retain(Chart::shows_something);
    if charts.is_empty() {
        return Ok(());
    }
    gallery.write_curves("figures.csv", &charts)?;
    draw_charts(&gallery.place("figures.png"), &charts, 2)?;
    gallery.hang("figures.png", "The paper's elements, points and linear update at h = 0.1 m, 20 load steps: mean displacement of the right side over the weight, for shares of soft stiffness (its Figure 3; without any the run stops) and numbers of particles (its Figure 4). It prints where the corner goes, (−0.38, −0.61) m. Below, what explains them: the error of the corner's u_y against the finite elements, over the cell size with 20 load steps, and over the load steps at h = 0.05 m. Serendipity elements do not converge.");
    Ok(())
}
