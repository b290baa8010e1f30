//! Charts in a grid.

use super::axes::{Axes, draw_box};
use super::chart::{Chart, LEAST};
use super::colour::INK;
use super::legend::{Entry, Legend, SHADE};
use super::page::{Drawn, Frame, Medium, Page, Picture, Point, area, clipped, corners, stroke};
use super::text::{Block, SMALL, TITLE, write};
use super::{EDGE, PlotError, between, finite, largest, nothing};
use std::path::Path;

/// Distance of the charts in a grid, and of a legend from the axes' labels, in pixels.
const CELL_GAP: f64 = 30.0;
const LEGEND_GAP: f64 = 16.0;
/// Distance from a title to the box below.
const TITLE_GAP: f64 = 12.0;
/// A curve of more points than this has markers at this distance (pixels) or more.
const MANY: usize = 40;
const APART: f64 = 60.0;

/// A chart with its axes, title and curves' looks.
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
            entries: Entry::all(chart),
        })
    }

    /// Draws everything but the legend about the axes' box.
    fn draw<B: Medium>(&self, page: &Page<B>, frame: Frame) -> Drawn<B> {
        let [left, top, right, bottom] = frame;
        self.axes.draw(page, frame, [true; 2], true)?;
        let over = top - TITLE_GAP - self.title.height();
        self.title.draw(page, ((left + right) / 2.0, over), false)?;
        let down = |y: f64| bottom - self.axes.y.at(y);
        let place = |p: &Point| (left + self.axes.x.at(p.0), down(p.1));
        let chart = self.chart;
        let (curves, lines) = self.entries.split_at(chart.series.len());
        for (line, entry) in chart.reference_lines.iter().zip(lines) {
            if let Some(half) = line.band.filter(|half| half.is_finite()) {
                let [low, high] = [line.value - half, line.value + half].map(down);
                let band = [left, high.max(top), right, low.min(bottom)];
                area(page, &corners(band), INK, SHADE)?;
            }
            let y = down(line.value);
            for part in clipped(&[(left, y), (right, y)], frame) {
                entry.line(page, &part)?;
            }
        }
        let curves = || chart.series.iter().zip(curves);
        for (series, entry) in curves() {
            for part in series.points.split(|p| p.0.is_nan() || p.1.is_nan()) {
                let points: Vec<Point> = part.iter().map(place).collect();
                for part in clipped(&points, frame) {
                    entry.line(page, &part)?;
                }
            }
        }
        if let Some([a, b, c]) = chart.triangle() {
            let [a, b, c] = [a, b, c].map(|p| place(&p));
            for part in clipped(&[a, b, c, a], frame) {
                stroke(page, &part, 2.4, INK, &[])?;
            }
            let slope = chart.slope_triangle.map_or(0.0, |t| t.slope);
            let label = slope.to_string().replace('-', "−");
            let beside = (b.0 + 10.0, between(b, c, 0.5).1);
            write(page, &label, beside, SMALL, (0.0, 0.5), false)?;
            let (gap, anchor) = if c.1 < b.1 { (9.0, 0.0) } else { (-9.0, 1.0) };
            let below = (between(a, b, 0.5).0, a.1 + gap);
            write(page, "1", below, SMALL, (0.5, anchor), false)?;
        }
        draw_box(page, frame)?;
        for (series, entry) in curves() {
            let thin = entry.pattern.is_some() && series.points.len() > MANY;
            let mut drawn: Vec<Point> = Vec::new();
            for (x, y) in series.points.iter().filter(|p| finite(p)).map(place) {
                let across = (left - 1.0..=right + 1.0).contains(&x);
                let inside = across && (top - 1.0..=bottom + 1.0).contains(&y);
                let near = |d: &Point| (x - d.0).hypot(y - d.1) < APART;
                if inside && !(thin && drawn.iter().any(near)) {
                    drawn.push((x, y));
                    entry.mark(page, (x, y))?;
                }
            }
        }
        Ok(())
    }
}

/// Where everything of a grid of charts lies.
struct Grid<'a> {
    plans: Vec<Plan<'a>>,
    columns: usize,
    /// Axes' boxes, and distance of one chart from the next.
    size: Point,
    pitch: Point,
    /// Upper left corner of the first box.
    start: Point,
    /// Legends, with their upper left corners.
    legends: Vec<(Legend<'a>, Point)>,
    full: Point,
}

impl<'a> Grid<'a> {
    fn new(path: &Path, charts: &'a [Chart], columns: usize) -> Result<Self, PlotError> {
        let columns = columns.min(charts.len()).max(1);
        let size = [(1180.0, 760.0), (760.0, 560.0), LEAST][columns.min(3) - 1];
        let plans = charts.iter().map(|c| Plan::new(path, c, size));
        let plans = plans.collect::<Result<Vec<_>, _>>()?;
        if plans.is_empty() {
            return Err(nothing(path, "a figure without charts"));
        }
        // Every chart has the same margins, so that the axes of a grid are aligned.
        let most = |extent: &dyn Fn(&Plan) -> f64| largest(plans.iter().map(extent));
        let left = most(&|p| p.axes.left()).ceil();
        let right = 16.0 + most(&|p| p.axes.x.label_width()) / 2.0;
        let top = (16.0 + most(&|p| p.title.height())).ceil();
        let bottom = most(&|p| p.axes.below());
        let entries: Vec<_> = plans.iter().map(|p| p.entries.clone()).collect();
        let common = Entry::common(&entries);
        let shared = common.is_some();
        let named = entries[0].iter().filter(|e| !e.name.is_empty());
        let beside = shared && named.count() > 6 && columns < 3;

        let (rows, natural) = (charts.len().div_ceil(columns), left + size.0 + right);
        let wide = |cell: f64| columns as f64 * (cell + CELL_GAP) - CELL_GAP;
        let room = match (shared, beside) {
            (_, true) => 0.0,
            (true, _) => wide(natural),
            _ => natural,
        };
        let shown = common.map_or(entries, |common| vec![common]);
        let legends: Vec<_> = shown.iter().map(|own| Legend::new(own, room)).collect();
        let widest = largest(legends.iter().map(|l| l.width));
        let highest = largest(legends.iter().map(|l| l.height)) + LEGEND_GAP;
        let cell = if shared { natural } else { natural.max(widest) }.ceil();
        let row = (top + size.1 + bottom + if shared { 0.0 } else { highest }).ceil();
        let (width, height) = (wide(cell), rows as f64 * (row + CELL_GAP) - CELL_GAP);
        let full = match (shared, beside) {
            (true, true) => (width + 24.0 + widest, height.max(top + highest)),
            (true, false) => (width.max(widest), height + highest),
            _ => (width, height),
        };
        let pitch = (cell + CELL_GAP, row + CELL_GAP);
        let corner = |(k, legend): (usize, &Legend)| {
            let inset = |left: f64, right: f64, room: f64| {
                let centred = (left + right - legend.width) / 2.0;
                EDGE + centred.min(room - legend.width).max(0.0)
            };
            let (column, row) = ((k % columns) as f64, (k / columns) as f64);
            match (shared, beside) {
                (true, true) => (EDGE + width + 24.0, EDGE + top),
                (true, false) => (
                    inset(left, width - right, full.0),
                    EDGE + height + LEGEND_GAP,
                ),
                _ => (
                    inset(left, left + size.0, cell) + column * pitch.0,
                    EDGE + row * pitch.1 + top + size.1 + bottom + LEGEND_GAP,
                ),
            }
        };
        let corners: Vec<_> = legends.iter().enumerate().map(corner).collect();
        Ok(Self {
            columns,
            size,
            pitch,
            start: (EDGE + left, EDGE + top),
            legends: legends.into_iter().zip(corners).collect(),
            full: (full.0 + 2.0 * EDGE, full.1 + 2.0 * EDGE),
            plans,
        })
    }
}

impl Picture for Grid<'_> {
    fn size(&self) -> Point {
        self.full
    }

    fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B> {
        for (k, plan) in self.plans.iter().enumerate() {
            let x = self.start.0 + (k % self.columns) as f64 * self.pitch.0;
            let y = self.start.1 + (k / self.columns) as f64 * self.pitch.1;
            plan.draw(page, [x, y, x + self.size.0, y + self.size.1])?;
        }
        for (legend, corner) in &self.legends {
            legend.draw(page, *corner)?;
        }
        Ok(())
    }
}

/// Draws a grid of charts, `columns` in a row, as one PNG file, and the same as SVG beside it.
///
/// Charts with the same series, be it with other markers, share one legend; otherwise each has its own. It lies below
/// the axes, or to the right of at most two columns if it is a single one of more than six entries.
///
/// # Errors
///
/// A chart without finite points or given ranges, a non-positive value on a log axis, or a file that cannot be
/// written.
pub fn draw_charts(path: &Path, charts: &[Chart], columns: usize) -> Result<(), PlotError> {
    let grid = Grid::new(path, charts, columns)?;
    grid.save_svg(path)?;
    grid.save(path)
}
