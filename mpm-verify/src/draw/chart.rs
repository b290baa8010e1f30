//! Line charts: their data, and the ranges of their axes.

use super::axes::{Axis, extent, tick_label, widen};
use super::marker::Marker;
use super::page::Point;
use super::{PlotError, finite};
use std::path::Path;

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    /// Logarithmic, base ten.
    Log10,
}

/// Line of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dash {
    Solid,
    Dashed,
    Dotted,
    /// Markers only.
    None,
}

/// One curve. A point that is not finite interrupts the line. Where a line has more than 40 points
/// its markers are thinned out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    /// Name in the legend; a series without one is not in it.
    pub name: String,
    /// Points in data coordinates.
    pub points: Vec<(f64, f64)>,
    /// Index into the palette of eight colours (taken modulo eight).
    pub colour: usize,
    pub marker: Marker,
    pub dash: Dash,
}

/// A horizontal line, such as an exact value, drawn dash-dotted in black.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ReferenceLine {
    /// Name in the legend.
    pub name: String,
    /// Ordinate.
    pub value: f64,
    /// Half-width of a lightly shaded band around the line.
    pub band: Option<f64>,
}

/// A slope triangle; it is drawn only when both axes are logarithmic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlopeTriangle {
    /// Slope, the order of convergence.
    pub slope: f64,
    /// Left end of the horizontal leg in data coordinates (for a positive slope, the triangle's
    /// lower-left corner).
    pub at: (f64, f64),
    /// Length of the horizontal leg in decades.
    pub decades: f64,
}

/// One pair of axes with its curves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    /// Title above the axes; may be empty.
    pub title: String,
    pub x_label: String,
    pub y_label: String,
    pub x_scale: Scale,
    pub y_scale: Scale,
    /// Curves, the last one on top.
    pub series: Vec<Series>,
    /// Horizontal reference lines, beneath the curves.
    pub reference_lines: Vec<ReferenceLine>,
    pub slope_triangle: Option<SlopeTriangle>,
    /// Range of the abscissa; without it, the data with a margin.
    pub x_range: Option<(f64, f64)>,
    /// Range of the ordinate; without it, the data with a margin.
    pub y_range: Option<(f64, f64)>,
}

/// Size of the axes' box where three charts or more stand in a row.
pub(super) const LEAST: Point = (560.0, 430.0);

impl Series {
    /// A solid line without markers, in a colour of the palette.
    pub(crate) fn line(name: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Self { name: name.into(), points, colour, marker: Marker::None, dash: Dash::Solid }
    }
}

impl ReferenceLine {
    /// A value that is known to an uncertainty: its band is hardly ever wide enough to be seen, so the name tells it.
    pub(crate) fn known_to(name: &str, value: f64, uncertainty: f64) -> Self {
        let tolerance = tick_label(uncertainty, uncertainty, uncertainty);
        Self { name: format!("{name} ± {tolerance}"), value, band: Some(uncertainty) }
    }
}

impl Chart {
    /// Curves over linear axes, whose labels are those of x and y, and nothing else.
    pub(crate) fn new(title: impl Into<String>, labels: [&str; 2], series: Vec<Series>) -> Self {
        let [x_label, y_label] = labels.map(str::to_owned);
        Self {
            title: title.into(),
            x_label,
            y_label,
            x_scale: Scale::Linear,
            y_scale: Scale::Linear,
            series,
            reference_lines: Vec::new(),
            slope_triangle: None,
            x_range: None,
            y_range: None,
        }
    }

    /// The slope triangle's horizontal leg and the end of its vertical leg.
    pub(super) fn triangle(&self) -> Option<[Point; 3]> {
        let log = self.x_scale == Scale::Log10 && self.y_scale == Scale::Log10;
        let SlopeTriangle { slope, at, decades } = self.slope_triangle.filter(|_| log)?;
        let end = (at.0 * 10f64.powf(decades), at.1);
        Some([at, end, (end.0, at.1 * 10f64.powf(slope * decades))])
    }

    /// The axis, `length` pixels long, that shows everything or the given range.
    pub(super) fn axis(&self, path: &Path, upright: bool, length: f64) -> Result<Axis, PlotError> {
        let scale = if upright { self.y_scale } else { self.x_scale };
        let range = self.range(path, upright, length)?;
        Ok(Axis::new(range, scale == Scale::Log10, length, upright))
    }

    /// The range of that axis; of its logarithm, if it is logarithmic.
    fn range(&self, path: &Path, upright: bool, length: f64) -> Result<Point, PlotError> {
        let (given, scale, label) = match upright {
            true => (self.y_range, self.y_scale, &self.y_label),
            false => (self.x_range, self.x_scale, &self.x_label),
        };
        let log = scale == Scale::Log10;
        let pick = |p: &Point| if upright { p.1 } else { p.0 };
        let transform = |v: f64| if log { v.log10() } else { v };
        let all = self.series.iter().flat_map(|s| &s.points);
        let mut shown: Vec<f64> = all.filter(|p| finite(p)).map(pick).collect();
        if shown.is_empty() && given.is_none() {
            return Err(PlotError::no_data(path, &self.title));
        }
        for line in self.reference_lines.iter().filter(|_| upright) {
            let half = line.band.unwrap_or(0.0);
            shown.extend([line.value, line.value + half]);
            shown.extend(Some(line.value - half).filter(|v| !log || *v > 0.0));
        }
        shown.extend(self.triangle().iter().flatten().map(pick));
        shown.extend(given.into_iter().flat_map(|(lo, hi)| [lo, hi]));
        if let Some(&value) = shown.iter().find(|v| log && **v <= 0.0) {
            let cause = format!("\"{}\" has the non-positive value {value} on its log axis \"{label}\"", self.title);
            return Err(PlotError::new(path, &cause));
        }
        if let Some((lo, hi)) = given {
            return Ok(widen((transform(lo), transform(hi)), 0.0));
        }
        let ends = extent(shown.into_iter().map(transform));
        let (mut lo, mut hi) = widen(ends.ok_or_else(|| PlotError::no_data(path, &self.title))?, 0.05);
        if let Some([a, b, c]) = self.triangle() {
            // Room for the triangle's labels: right of it, and below or above its horizontal leg.
            let (leg, room) = (transform(pick(&b)), if upright { 44.0 } else { 80.0 });
            if upright && c.1 > a.1 {
                lo = lo.min(hi - (hi - leg) / (1.0 - room / length))
            } else {
                hi = hi.max(lo + (leg - lo) / (1.0 - room / length))
            }
        }
        Ok((lo, hi))
    }

    /// Whether there is a point to draw.
    pub(crate) fn shows_something(&self) -> bool {
        self.series.iter().flat_map(|s| &s.points).any(finite)
    }
}

/// Gives the charts of each column of a grid, which have the same scales, the same ranges: these show everything in each.
///
/// # Errors
/// A non-positive value on a log axis; `path` is that of the picture they are for.
pub(crate) fn share_ranges_of_columns(path: &Path, charts: &mut [Chart], columns: usize) -> Result<(), PlotError> {
    for (column, upright) in (0..columns).flat_map(|k| [(k, false), (k, true)]) {
        let length = if upright { LEAST.1 } else { LEAST.0 };
        let ranges = charts.iter().skip(column).step_by(columns).filter(|c| c.shows_something());
        let ranges = ranges.map(|c| c.range(path, upright, length)).collect::<Result<Vec<_>, _>>()?;
        let Some(all) = extent(ranges.into_iter().flat_map(|(lo, hi)| [lo, hi])) else { continue };
        // The margin of a chart with a short range is little of the common one.
        let (lo, hi) = widen(all, 0.03);
        for chart in charts.iter_mut().skip(column).step_by(columns) {
            let (range, scale) = match upright {
                true => (&mut chart.y_range, chart.y_scale),
                false => (&mut chart.x_range, chart.x_scale),
            };
            *range = Some(match scale {
                Scale::Linear => (lo, hi),
                Scale::Log10 => (10f64.powf(lo), 10f64.powf(hi)),
            });
        }
    }
    Ok(())
}
