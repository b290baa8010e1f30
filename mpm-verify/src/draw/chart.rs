//! Grids of line charts.

use super::axes::{Axes, Axis, extent, widen};
use super::canvas::Canvas;
use super::colour::{INK, PALETTE, Rgb};
use super::font::{Block, SMALL, TITLE};
use super::shape::{Frame, LINE, Marker, Point};
use super::{EDGE, PlotError, SOLID, between, finite, largest, nothing};
use std::path::Path;

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic, base ten.
    Log10,
}

/// Line of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Solid line.
    Solid,
    /// Dashed line.
    Dashed,
    /// Dotted line.
    Dotted,
    /// No line: markers only.
    None,
}

/// One curve. A point that is not finite interrupts the line. Where a line has more than 40 points
/// its markers are thinned out.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; a series without one is not in it.
    pub name: String,
    /// Points in data coordinates.
    pub points: Vec<(f64, f64)>,
    /// Index into the palette of eight colours (taken modulo eight).
    pub colour: usize,
    /// Marker.
    pub marker: Marker,
    /// Line.
    pub dash: Dash,
}

/// A horizontal line, such as an exact value, drawn dash-dotted in black.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLine {
    /// Name in the legend.
    pub name: String,
    /// Ordinate.
    pub value: f64,
    /// Half-width of a lightly shaded band around the line.
    pub band: Option<f64>,
}

/// A slope triangle; it is drawn only when both axes are logarithmic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeTriangle {
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
pub struct Chart {
    /// Title above the axes; may be empty.
    pub title: String,
    /// Label of the abscissa.
    pub x_label: String,
    /// Label of the ordinate.
    pub y_label: String,
    /// Scale of the abscissa.
    pub x_scale: Scale,
    /// Scale of the ordinate.
    pub y_scale: Scale,
    /// Curves, the last one on top.
    pub series: Vec<Series>,
    /// Horizontal reference lines, beneath the curves.
    pub reference_lines: Vec<ReferenceLine>,
    /// Slope triangle.
    pub slope_triangle: Option<SlopeTriangle>,
    /// Range of the abscissa; without it, the data with a margin.
    pub x_range: Option<(f64, f64)>,
    /// Range of the ordinate; without it, the data with a margin.
    pub y_range: Option<(f64, f64)>,
}

/// Distance of the charts in a grid, in pixels.
const CELL_GAP: f64 = 30.0;
/// Size of the axes' box where three charts or more stand in a row.
const LEAST: Point = (560.0, 430.0);
/// Length of a legend's line, height of its entries and gap of its columns.
const SAMPLE: f64 = 70.0;
const ENTRY_HEIGHT: f64 = 40.0;
const COLUMN_GAP: f64 = 40.0;
/// Lengths of dashes and gaps.
const DASHED: &[f64] = &[16.0, 10.0];
const DOTTED: &[f64] = &[1.0, 8.0];
const DASH_DOT: &[f64] = &[20.0, 9.0, 1.0, 9.0];

/// An entry of a legend, with all that shows how its curve is drawn.
#[derive(Clone, Copy, PartialEq)]
struct Entry<'a> {
    name: &'a str,
    colour: Rgb,
    marker: Marker,
    /// Lengths of dashes and gaps, if there is a line.
    pattern: Option<&'static [f64]>,
    hollow: bool,
    band: bool,
}

/// The entries that all charts have in common, if they differ in markers at most; those are left out.
fn common<'a>(plans: &[Plan<'a>]) -> Option<Vec<Entry<'a>>> {
    let mut entries = plans.first()?.entries.clone();
    for plan in &plans[1..] {
        if plan.entries.len() != entries.len() {
            return None;
        }
        for (entry, other) in entries.iter_mut().zip(&plan.entries) {
            if entry.marker != other.marker {
                entry.marker = Marker::None;
            }
            let marker = entry.marker;
            if *entry != (Entry { marker, ..*other }) {
                return None;
            }
        }
    }
    Some(entries)
}

fn entries(chart: &Chart) -> Vec<Entry<'_>> {
    let lines = chart.reference_lines.iter().map(|line| Entry {
        name: &line.name,
        colour: INK,
        marker: Marker::None,
        pattern: Some(DASH_DOT),
        hollow: false,
        band: line.band.is_some(),
    });
    let curves = chart.series.iter().map(|series| Entry {
        name: &series.name,
        colour: PALETTE[series.colour % PALETTE.len()],
        marker: series.marker,
        pattern: match series.dash {
            Dash::Solid => Some(SOLID),
            Dash::Dashed => Some(DASHED),
            Dash::Dotted => Some(DOTTED),
            Dash::None => None,
        },
        hollow: matches!(series.dash, Dash::Dashed | Dash::Dotted),
        band: false,
    });
    curves.chain(lines).collect()
}

/// Entries laid out in columns, filled one by one.
struct Legend<'a> {
    entries: Vec<&'a Entry<'a>>,
    rows: usize,
    column: f64,
    width: f64,
    height: f64,
}

impl<'a> Legend<'a> {
    /// At most `room` pixels wide, if one column allows it.
    fn new(entries: &'a [Entry<'a>], room: f64) -> Self {
        let entries: Vec<_> = entries.iter().filter(|e| !e.name.is_empty()).collect();
        let widest = largest(entries.iter().map(|e| SMALL.width(e.name)));
        let column = SAMPLE + 14.0 + widest + COLUMN_GAP;
        let columns = (((room + COLUMN_GAP) / column) as usize).max(1);
        let rows = entries.len().div_ceil(columns).max(1);
        Self {
            width: entries.len().div_ceil(rows) as f64 * column - COLUMN_GAP,
            entries,
            rows,
            column,
            height: rows as f64 * ENTRY_HEIGHT,
        }
    }

    fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        for (k, entry) in self.entries.iter().enumerate() {
            let x = left + (k / self.rows) as f64 * self.column;
            let y = top + ((k % self.rows) as f64 + 0.5) * ENTRY_HEIGHT;
            let (middle, end) = (x + SAMPLE / 2.0, x + SAMPLE);
            if entry.band {
                canvas.rectangle([x, y - 13.0, end, y + 13.0], INK, 0.12);
            }
            let line = [(x + 2.0, y), (end - 2.0, y)];
            if let Some(pattern) = entry.pattern {
                canvas.stroke(&line, LINE, entry.colour, pattern);
            }
            canvas.marker(entry.marker, (middle, y), entry.colour, entry.hollow);
            canvas.text(entry.name, (end + 14.0, y), SMALL, (0.0, 0.5), false);
        }
    }
}

impl Series {
    /// A solid line without markers, in a colour of the palette.
    #[must_use]
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Self {
            name: name.into(),
            points,
            colour,
            marker: Marker::None,
            dash: Dash::Solid,
        }
    }
}

impl Chart {
    /// Curves over linear axes, whose labels are those of x and y, and nothing else.
    #[must_use]
    pub fn new(title: impl Into<String>, labels: [&str; 2], series: Vec<Series>) -> Self {
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
    fn triangle(&self) -> Option<[Point; 3]> {
        let log = self.x_scale == Scale::Log10 && self.y_scale == Scale::Log10;
        let SlopeTriangle { slope, at, decades } = self.slope_triangle.filter(|_| log)?;
        let end = (at.0 * 10f64.powf(decades), at.1);
        Some([at, end, (end.0, at.1 * 10f64.powf(slope * decades))])
    }

    /// The axis, `length` pixels long, that shows everything or the given range.
    fn axis(&self, path: &Path, upright: bool, length: f64) -> Result<Axis, PlotError> {
        let scale = if upright { self.y_scale } else { self.x_scale };
        let range = self.range(path, upright, length)?;
        Ok(Axis::new(range, scale == Scale::Log10, length, upright))
    }

    /// The range of that axis; of its logarithm, if it is logarithmic.
    fn range(&self, path: &Path, upright: bool, length: f64) -> Result<Point, PlotError> {
        let (given, scale, label) = if upright {
            (self.y_range, self.y_scale, &self.y_label)
        } else {
            (self.x_range, self.x_scale, &self.x_label)
        };
        let log = scale == Scale::Log10;
        let pick = |p: &Point| if upright { p.1 } else { p.0 };
        let transform = |v: f64| if log { v.log10() } else { v };
        let all = self.series.iter().flat_map(|s| &s.points);
        let mut shown: Vec<f64> = all.filter(|p| finite(p)).map(pick).collect();
        if shown.is_empty() && given.is_none() {
            return Err(nothing(path, &self.title));
        }
        for line in self.reference_lines.iter().filter(|_| upright) {
            let half = line.band.unwrap_or(0.0);
            shown.extend([line.value, line.value + half]);
            shown.extend(Some(line.value - half).filter(|v| !log || *v > 0.0));
        }
        shown.extend(self.triangle().iter().flatten().map(pick));
        shown.extend(given.into_iter().flat_map(|(lo, hi)| [lo, hi]));
        if let Some(&value) = shown.iter().find(|v| log && **v <= 0.0) {
            return Err(PlotError::NonPositive {
                path: path.into(),
                title: self.title.clone(),
                axis: label.clone(),
                value,
            });
        }
        let (from, margin) = given.map_or((shown, 0.05), |(lo, hi)| (vec![lo, hi], 0.0));
        let ends = extent(from.into_iter().map(transform));
        let (mut lo, mut hi) = widen(ends.ok_or_else(|| nothing(path, &self.title))?, margin);
        if let (Some([a, b, c]), None) = (self.triangle(), given) {
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
    #[must_use]
    pub fn shows_something(&self) -> bool {
        self.series.iter().flat_map(|s| &s.points).any(finite)
    }
}

/// Gives charts of the same scales the same ranges, which show everything in each of them.
///
/// # Errors
///
/// A non-positive value on a log axis; `path` is that of the picture they are for.
pub fn share_ranges(path: &Path, charts: &mut [Chart]) -> Result<(), PlotError> {
    for upright in [false, true] {
        let length = if upright { LEAST.1 } else { LEAST.0 };
        let shown = charts.iter().filter(|c| c.shows_something());
        let ranges = shown.map(|c| c.range(path, upright, length));
        let ranges = ranges.collect::<Result<Vec<_>, _>>()?;
        let Some(all) = extent(ranges.into_iter().flat_map(|(lo, hi)| [lo, hi])) else {
            continue;
        };
        // The margin of a chart with a short range is little of the common one.
        let (lo, hi) = widen(all, 0.03);
        for chart in charts.iter_mut() {
            let (range, scale) = if upright {
                (&mut chart.y_range, chart.y_scale)
            } else {
                (&mut chart.x_range, chart.x_scale)
            };
            *range = Some(match scale {
                Scale::Linear => (lo, hi),
                Scale::Log10 => (10f64.powf(lo), 10f64.powf(hi)),
            });
        }
    }
    Ok(())
}

/// The same for each column of a grid of charts by itself.
///
/// # Errors
/// As [`share_ranges`].
pub fn share_ranges_of_columns(
    path: &Path,
    charts: &mut [Chart],
    columns: usize,
) -> Result<(), PlotError> {
    for k in 0..columns {
        let mut column: Vec<Chart> = charts.iter().skip(k).step_by(columns).cloned().collect();
        share_ranges(path, &mut column)?;
        for (chart, ranged) in charts.iter_mut().skip(k).step_by(columns).zip(column) {
            *chart = ranged;
        }
    }
    Ok(())
}

/// A chart with its axes, title and legend.
struct Plan<'a> {
    chart: &'a Chart,
    axes: Axes,
    title: Block,
    entries: Vec<Entry<'a>>,
}

impl<'a> Plan<'a> {
    fn new(path: &Path, chart: &'a Chart, (width, height): Point) -> Result<Self, PlotError> {
        let axes = [
            chart.axis(path, false, width)?,
            chart.axis(path, true, height)?,
        ];
        Ok(Self {
            chart,
            axes: Axes::new(axes, [&chart.x_label, &chart.y_label], 0.0),
            title: Block::new(&chart.title, TITLE, width),
            entries: entries(chart),
        })
    }

    /// Draws everything but the legend about the axes' box.
    fn draw(&self, canvas: &mut Canvas, frame: Frame) {
        let (left, top, x, y) = (frame[0], frame[1], &self.axes.x, &self.axes.y);
        self.axes.draw_grid(canvas, frame);
        canvas.clip(Some(frame));
        let bottom = frame[3];
        let place = |p: &Point| (left + x.at(p.0), bottom - y.at(p.1));
        for line in &self.chart.reference_lines {
            // The logarithm of a lower end that is not positive is none: the axis cuts it off.
            let down = |v: f64| bottom - y.at(v).max(0.0).min(y.length);
            if let Some(half) = line.band.filter(|half| (line.value + half).is_finite()) {
                let (upper, lower) = (down(line.value + half), down(line.value - half));
                canvas.rectangle([left, upper, frame[2], lower], INK, 0.12);
            }
            let down = bottom - y.at(line.value);
            canvas.stroke(&[(left, down), (frame[2], down)], LINE, INK, DASH_DOT);
        }
        let curves = || self.chart.series.iter().zip(&self.entries);
        for (series, entry) in curves() {
            let points: Vec<Point> = series.points.iter().map(place).collect();
            if let Some(pattern) = entry.pattern {
                canvas.stroke(&points, LINE, entry.colour, pattern);
            }
        }
        if let Some(corners) = self.chart.triangle() {
            let [a, b, c] = corners.map(|p| place(&p));
            canvas.stroke(&[a, b, c, a], 2.4, INK, SOLID);
            let slope = self.chart.slope_triangle.map_or(0.0, |t| t.slope);
            let (label, side) = (slope.to_string().replace('-', "−"), between(b, c, 0.5));
            canvas.text(&label, (b.0 + 10.0, side.1), SMALL, (0.0, 0.5), false);
            let (gap, anchor) = if c.1 < b.1 { (9.0, 0.0) } else { (-9.0, 1.0) };
            let below = (between(a, b, 0.5).0, a.1 + gap);
            canvas.text("1", below, SMALL, (0.5, anchor), false);
        }
        canvas.clip(None);
        self.axes.draw(canvas, frame, &self.title, [true, true]);
        for (series, entry) in curves() {
            let thin = entry.pattern.is_some() && series.points.len() > 40;
            let mut drawn: Vec<Point> = Vec::new();
            let inside = |(x, y): Point| {
                let across = (left - 1.0..=frame[2] + 1.0).contains(&x);
                across && (top - 1.0..=bottom + 1.0).contains(&y)
            };
            for p in series.points.iter().map(place) {
                let near = |d: &Point| (p.0 - d.0).hypot(p.1 - d.1) < 60.0;
                if inside(p) && !(thin && drawn.iter().any(near)) {
                    canvas.marker(entry.marker, p, entry.colour, entry.hollow);
                    drawn.push(p);
                }
            }
        }
    }
}

/// Draws a grid of charts, `columns` in a row, as one PNG file, and the same as SVG beside it.
///
/// Charts with the same series, be it with other markers, share one legend; otherwise each has its own. It lies below the axes,
/// or to the right of at most two columns if it is a single one of more than six entries.
///
/// # Errors
///
/// A chart without finite points or given ranges, a non-positive value on a log axis, or a file that cannot be
/// written.
pub fn draw_charts(path: &Path, charts: &[Chart], columns: usize) -> Result<(), PlotError> {
    let columns = columns.min(charts.len()).max(1);
    let size = [(1180.0, 760.0), (760.0, 560.0), LEAST][columns.min(3) - 1];
    let plans = charts.iter().map(|c| Plan::new(path, c, size));
    let plans = plans.collect::<Result<Vec<_>, _>>()?;
    let first = plans.first();
    let first = first.ok_or_else(|| nothing(path, "a figure without charts"))?;

    // Every chart has the same margins, so that the axes of a grid are aligned.
    let most = |extent: &dyn Fn(&Plan) -> f64| largest(plans.iter().map(extent));
    let left = most(&|p| p.axes.left());
    let right = 16.0 + most(&|p| p.axes.x.label_width()) / 2.0;
    let top = 16.0 + most(&|p| p.title.height());
    let bottom = most(&|p| p.axes.below());
    let common = common(&plans);
    let shared = common.is_some();
    let named = first.entries.iter().filter(|e| !e.name.is_empty());
    let beside = shared && named.count() > 6 && columns < 3;

    let (rows, natural) = (charts.len().div_ceil(columns), left + size.0 + right);
    let grid_width = |cell: f64| columns as f64 * (cell + CELL_GAP) - CELL_GAP;
    let room = match (shared, beside) {
        (_, true) => 0.0,
        (true, _) => grid_width(natural),
        _ => natural,
    };
    let legends = plans
        .iter()
        .map(|p| Legend::new(common.as_deref().unwrap_or(&p.entries), room));
    let legends: Vec<_> = legends.collect();
    let widest = largest(legends.iter().map(|l| l.width));
    let highest = largest(legends.iter().map(|l| l.height)) + 16.0;
    let cell = if shared { natural } else { natural.max(widest) };
    let row = top + size.1 + bottom + if shared { 0.0 } else { highest };
    let (width, height) = (grid_width(cell), rows as f64 * (row + CELL_GAP) - CELL_GAP);
    let (full_width, full_height) = match (shared, beside) {
        (true, true) => (width + 24.0 + widest, height.max(top + highest)),
        (true, false) => (width.max(widest), height + highest),
        _ => (width, height),
    };
    let mut canvas = Canvas::new((full_width + 2.0 * EDGE, full_height + 2.0 * EDGE));
    for (k, (plan, legend)) in plans.iter().zip(&legends).enumerate() {
        let x = EDGE + (k % columns) as f64 * (cell + CELL_GAP);
        let y = EDGE + (k / columns) as f64 * (row + CELL_GAP);
        let frame = plan.axes.frame((x + left, y + top));
        plan.draw(&mut canvas, frame);
        let inset = |left: f64, right: f64, room: f64| {
            let centred = (left + right - legend.width) / 2.0;
            centred.min(room - legend.width).max(0.0)
        };
        if !shared {
            let inset = inset(left, left + size.0, cell);
            legend.draw(&mut canvas, (x + inset, frame[3] + bottom + 16.0));
        } else if beside && k == 0 {
            legend.draw(&mut canvas, (EDGE + width + 24.0, EDGE + top));
        } else if k == 0 {
            let inset = inset(left, width - right, full_width);
            legend.draw(&mut canvas, (EDGE + inset, EDGE + height + 16.0));
        }
    }
    canvas.save_svg(&path.with_extension("svg"))?;
    canvas.save(path)
}
