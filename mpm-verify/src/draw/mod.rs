//! Pictures: grids of line charts, as PNG and SVG files, panels of particle fields and bodies in space, as PNG files.
//!
//! Everything is laid out in pixels around axes boxes of fixed size, so that no label can be
//! clipped and no legend can hide data. The same input gives the same bytes.

mod axes;

mod chart;
mod colour;
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

pub use chart::{
    Chart, Dash, ReferenceLine, Scale, Series, SlopeTriangle, share_ranges, share_ranges_of_columns,
};
pub use colour::signed;
pub use field::{FieldFigure, FieldPanel, animate_fields, draw_fields};
pub use marker::Marker;
pub use plot::draw_charts;
pub use png_file::write_small_png;
pub use ratios::{Ratio, Ratios, draw_ratios};
pub use solid::{SolidFigure, SolidPanel, animate_solids, draw_solids};

use page::Point;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// A chart or field figure has nothing to draw.
    #[error("{}: \"{title}\" has no finite data", path.display())]
    NoFiniteData {
        /// The picture's file.
        path: PathBuf,
        /// Title of the chart or figure.
        title: String,
    },
    /// A value cannot be drawn on a logarithmic axis.
    #[error("{}: \"{title}\" has the non-positive value {value} on its log axis \"{axis}\"", path.display())]
    NonPositive {
        /// The picture's file.
        path: PathBuf,
        /// Title of the chart.
        title: String,
        /// Label of the axis.
        axis: String,
        /// The value.
        value: f64,
    },
    /// A field panel's points and values differ in number.
    #[error("{}: panel \"{title}\" has {points} points but {values} values", path.display())]
    Lengths {
        /// The picture's file.
        path: PathBuf,
        /// Title of the panel.
        title: String,
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// Something could not be drawn, such as text without its font, or the file could not be written.
    #[error("{}: {cause}", path.display())]
    Write {
        /// The picture's file.
        path: PathBuf,
        /// What failed.
        cause: String,
    },
}

impl From<PlotError> for crate::error::Error {
    fn from(cause: PlotError) -> Self {
        Self::Picture(Box::new(cause))
    }
}

impl PlotError {
    fn write(path: &Path, cause: &dyn Display) -> Self {
        Self::Write {
            path: path.into(),
            cause: cause.to_string(),
        }
    }
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

fn nothing(path: &Path, title: &str) -> PlotError {
    PlotError::NoFiniteData {
        path: path.into(),
        title: title.into(),
    }
}

/// Refuses a panel whose points and values differ in number.
fn lengths(path: &Path, title: &str, points: usize, values: usize) -> Result<(), PlotError> {
    if points == values {
        return Ok(());
    }
    Err(PlotError::Lengths {
        path: path.into(),
        title: title.into(),
        points,
        values,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        Chart {
            title: "Convergence".into(),
            x_label: "cell size h (m)".into(),
            y_label: "relative error".into(),
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            series: vec![Series {
                name: "scheme".into(),
                points: vec![(0.5, 0.2), (0.25, 0.06), (f64::NAN, 0.03), (0.125, 0.013)],
                colour: 9,
                marker: Marker::Circle,
                dash: Dash::Dashed,
            }],
            reference_lines: vec![ReferenceLine {
                name: "exact".into(),
                value: 0.05,
                band: Some(0.1),
            }],
            slope_triangle: Some(SlopeTriangle {
                slope: 2.0,
                at: (0.2, 0.01),
                decades: 0.3,
            }),
            x_range: None,
            y_range: None,
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
            window: None,
        }
    }

    #[test]
    fn the_same_input_gives_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let draw = |charts: &str, fields: &str| {
            let [a, b] = [charts, fields].map(|name| folder.path().join(name));
            draw_charts(&a, &[chart(), chart(), chart()], 2).unwrap();
            draw_fields(&b, &field(vec![f64::NAN, 2.0])).unwrap();
            (std::fs::read(a).unwrap(), std::fs::read(b).unwrap())
        };
        assert!(draw("a.png", "b.png") == draw("c.png", "d.png"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 6);
    }

    #[test]
    fn curves_go_straight_on_beyond_their_axes_and_gaps_stay_open() {
        let folder = tempfile::tempdir().unwrap();
        let nan = (f64::NAN, 0.0);
        let points = vec![
            (0.0, 0.0),
            (2.0, 2.0),
            nan,
            (0.5, 0.0),
            (1.0, 0.5),
            nan,
            nan,
        ];
        let chart = Chart {
            x_range: Some((0.0, 1.0)),
            y_range: Some((0.0, 1.0)),
            ..Chart::new("", ["x", "y"], vec![Series::line("", points, 0)])
        };
        draw_charts(&folder.path().join("a.png"), &[chart], 1).unwrap();
        let picture = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
        let curves: Vec<&str> = picture.lines().filter(|l| l.contains("#0072B2")).collect();
        // The box is 1180 by 760 pixels.
        let ends = ["l2360 -1520\"", "l590 -380\""];
        assert!(
            curves.len() == 2 && (0..2).all(|k| curves[k].contains(ends[k])),
            "{curves:?}"
        );
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        let path = Path::new("no such folder/picture.png");
        let mut bad = chart();
        bad.series[0].points[1].1 = 0.0;
        let error = draw_charts(path, &[bad.clone()], 1).unwrap_err();
        assert!(matches!(error, PlotError::NonPositive { value: 0.0, .. }));
        let text = error.to_string();
        assert!(text.contains("picture.png") && text.contains("relative error"));
        bad.series[0].points.clear();
        let none = draw_charts(path, &[bad], 1);
        assert!(matches!(none, Err(PlotError::NoFiniteData { .. })));
        let none = draw_charts(path, &[], 1);
        assert!(matches!(none, Err(PlotError::NoFiniteData { .. })));
        let short = draw_fields(path, &field(vec![1.0]));
        assert!(matches!(
            short,
            Err(PlotError::Lengths {
                points: 2,
                values: 1,
                ..
            })
        ));
        let lost = draw_charts(Path::new("Cargo.toml/picture.png"), &[chart()], 1);
        assert!(matches!(lost, Err(PlotError::Write { .. })));
    }
}
