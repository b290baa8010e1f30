//! Pictures: grids of line charts, as PNG and SVG files, panels of particle fields and bodies in space, as PNG files.
//!
//! Everything is laid out in pixels around axes boxes of fixed size, so that no label can be
//! clipped and no legend can hide data. The same input gives the same bytes.

mod axes;
mod chart;
mod colour;
mod domains;
mod field;
mod legend;
mod marker;
mod page;
mod plot;
mod png_file;
mod ratios;
mod sheet;
pub(crate) mod sketch;
mod solid;
pub(crate) mod style;
mod text;
pub(crate) mod triptych;

pub(crate) use chart::{Chart, Dash, ReferenceLine, Scale, Series, SlopeTriangle, share_ranges_of_columns};
pub(crate) use colour::signed;
pub(crate) use domains::domains;
pub(crate) use field::{FieldFigure, FieldPanel, Line, animate_fields, draw_fields};
pub(crate) use marker::Marker;
pub(crate) use plot::draw_charts;
pub(crate) use png_file::write_small_png;
pub(crate) use ratios::{Ratios, draw_ratios};
pub(crate) use solid::{SolidFigure, SolidPanel, animate_solids, draw_solids};

use page::Point;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Why a picture could not be drawn: it has nothing to show, a value that its axis can't, or text without its font; or
/// its file can't be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {cause}", path.display())]
pub struct PlotError {
    path: PathBuf,
    cause: String,
}

impl From<PlotError> for crate::error::Error {
    fn from(cause: PlotError) -> Self {
        Self::Picture(Box::new(cause))
    }
}

impl PlotError {
    fn new(path: &Path, cause: &dyn Display) -> Self {
        Self { path: path.into(), cause: cause.to_string() }
    }

    fn no_data(path: &Path, title: &str) -> Self {
        Self::new(path, &format!("\"{title}\" has no finite data"))
    }
}

/// Refuses a panel whose points and values differ in number.
fn same_length(path: &Path, title: &str, points: usize, values: usize) -> Result<(), PlotError> {
    if points == values {
        return Ok(());
    }
    let cause = format!("panel \"{title}\" has {points} points but {values} values");
    Err(PlotError::new(path, &cause))
}

/// Margin of a picture, in pixels.
const EDGE: f64 = 28.0;

fn between(a: Point, b: Point, t: f64) -> Point {
    (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

fn finite(point: &Point) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        let points = vec![(0.5, 0.2), (0.25, 0.06), (f64::NAN, 0.03), (0.125, 0.013)];
        let series = Series { marker: Marker::Circle, dash: Dash::Dashed, ..Series::line("scheme", points, 9) };
        Chart {
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            reference_lines: vec![ReferenceLine { name: "exact".into(), value: 0.05, band: Some(0.1) }],
            slope_triangle: Some(SlopeTriangle { slope: 2.0, at: (0.2, 0.01), decades: 0.3 }),
            ..Chart::new("Convergence", ["cell size h (m)", "relative error"], vec![series])
        }
    }

    fn field(values: Vec<f64>) -> FieldFigure {
        FieldFigure {
            title: "Field".into(),
            panels: vec![FieldPanel {
                title: "a".into(),
                points: vec![(0.25, 0.25), (0.75, 0.25)],
                values,
                size: 0.5,
                outline: vec![(0.0, 0.0), (1.0, 0.5)],
            }],
            columns: 3,
            range: (0.0, 1.0),
            label: "stress (Pa)".into(),
            ..FieldFigure::default()
        }
    }

    /// The SVG document of charts.
    fn svg(charts: &[Chart], columns: usize) -> String {
        let folder = tempfile::tempdir().unwrap();
        draw_charts(&folder.path().join("a.png"), charts, columns).unwrap();
        std::fs::read_to_string(folder.path().join("a.svg")).unwrap()
    }

    #[test]
    fn the_same_input_gives_the_same_bytes_with_any_number_of_threads() {
        let draw = |threads: usize| {
            let folder = tempfile::tempdir().unwrap();
            let file = |name: &str| folder.path().join(name);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let fields = [0.0, 0.5, 1.0].map(|value| field(vec![f64::NAN, value]));
            pool.build().unwrap().install(|| {
                draw_charts(&file("a.png"), &[chart(), chart(), chart()], 2).unwrap();
                draw_fields(&file("b.png"), &fields[0]).unwrap();
                animate_fields(&file("c.png"), &fields, 5).unwrap();
            });
            let files = ["a.png", "a.svg", "b.png", "c.png", "c.still.png"];
            files.map(|name| std::fs::read(file(name)).unwrap())
        };
        assert!(draw(1) == draw(3));
    }

    #[test]
    fn every_text_of_a_chart_is_in_its_document_which_is_well_formed() {
        let mut other = chart();
        other.series[0].name = "a < b & c".into();
        let document = svg(&[chart(), other], 2);
        let mut reader = quick_xml::Reader::from_str(&document);
        let mut texts = Vec::new();
        loop {
            match reader.read_event().unwrap() {
                quick_xml::events::Event::Text(text) => {
                    texts.push(text.trim().to_owned());
                }
                quick_xml::events::Event::Eof => break,
                _ => {}
            }
        }
        let all = ["Convergence", "cell size h (m)", "relative error", "scheme", "exact"];
        for text in all.into_iter().chain(["2", "1", "0.1", "0.2", "0.5"]) {
            assert!(texts.iter().any(|t| t == text), "{text}: {texts:?}");
        }
        assert!(document.contains("a &lt; b &amp; c"));
    }

    #[test]
    fn curves_go_straight_on_beyond_their_axes_and_gaps_stay_open() {
        let nan = (f64::NAN, 0.0);
        let points = vec![(0.0, 0.0), (2.0, 2.0), nan, (0.5, 0.0), (1.0, 0.5), nan, nan];
        let chart = Chart {
            x_range: Some((0.0, 1.0)),
            y_range: Some((0.0, 1.0)),
            ..Chart::new("", ["x", "y"], vec![Series::line("", points, 0)])
        };
        let document = svg(&[chart], 1);
        let curves = document.lines().find(|l| l.contains("#0072B2")).unwrap();
        let numbers = curves.split(|c: char| !c.is_ascii_digit());
        let numbers: Vec<i32> = numbers.filter_map(|n| n.parse().ok()).skip(3).collect();
        let [left, bottom, right, top, middle, b, r, half] = numbers[..] else { panic!("{curves}") };
        // The box is 1180 by 760 pixels.
        let fine = page::FINE as i32;
        assert_eq!([right - left, bottom - top], [1180 * fine, 760 * fine]);
        assert_eq!([middle - left, bottom - half], [590 * fine, 380 * fine]);
        assert_eq!((b, r), (bottom, right));
    }

    #[test]
    fn marks_lie_within_the_picture_and_those_beyond_the_axes_are_left_out() {
        let points = vec![(0.0, 0.5), (0.5, 1.0), (1.0, 0.0), (0.5, 3.0), (-1.0, 0.5)];
        let series = Series { marker: Marker::Circle, dash: Dash::None, ..Series::line("", points, 0) };
        let chart =
            Chart { x_range: Some((0.0, 1.0)), y_range: Some((0.0, 1.0)), ..Chart::new("", ["x", "y"], vec![series]) };
        let document = svg(&[chart], 1);
        let marks = document.lines().filter(|l| l.contains("<circle"));
        assert_eq!(marks.filter(|l| l.contains("#0072B2")).count(), 3);
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        let path = Path::new("no such folder/picture.png");
        let told = |drawn: Result<(), PlotError>| drawn.unwrap_err().to_string();
        let mut bad = chart();
        bad.series[0].points[1].1 = 0.0;
        let charts = |charts: &[Chart]| told(draw_charts(path, charts, 1));
        assert_eq!(
            charts(&[bad.clone()]),
            "no such folder/picture.png: \"Convergence\" has the non-positive value 0 on its log axis \"relative error\""
        );
        bad.series[0].points.clear();
        assert!(charts(&[bad]).contains("\"Convergence\" has no finite data"));
        assert!(charts(&[]).contains("no finite data"));
        let short = told(draw_fields(path, &field(vec![1.0])));
        assert!(short.contains("panel \"a\" has 2 points but 1 values"));
        let lost = draw_charts(Path::new("Cargo.toml/picture.png"), &[chart()], 1);
        assert!(told(lost).starts_with("Cargo.toml/picture"));
    }
}
