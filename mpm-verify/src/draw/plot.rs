//! Charts in a grid.

use super::axes::Axes;
use super::chart::{Chart, LEAST};
use super::colour::INK;
use super::legend::{Entry, Legend, SHADE};
use super::page::{Frame, Page, Point, clipped, save_both};
use super::sheet::Sheet;
use super::text::SMALL;
use super::{EDGE, PlotError, between, finite, largest};
use std::path::Path;

/// Distance of a legend from the charts, below or beside them.
const BELOW: f64 = 16.0;
const BESIDE: f64 = 24.0;
/// A curve of more points than this has markers at this distance (pixels) or more.
const MANY: usize = 40;
const APART: f64 = 60.0;

/// A chart with its axes and curves' looks.
struct Plan<'a> {
    chart: &'a Chart,
    axes: Axes,
    entries: Vec<Entry<'a>>,
}

impl<'a> Plan<'a> {
    fn new(path: &Path, chart: &'a Chart, (width, height): Point) -> Result<Self, PlotError> {
        let axes = [chart.axis(path, false, width)?, chart.axis(path, true, height)?];
        Ok(Self { chart, axes: Axes::new(axes, [&chart.x_label, &chart.y_label], 0.0), entries: Entry::all(chart) })
    }

    /// Draws axes, bands, curves and markers.
    fn draw(&self, page: &mut Page, frame: Frame) {
        self.axes.draw(page, frame, true);
        let [left, top, right, bottom] = frame;
        let down = |y: f64| bottom - self.axes.y.at(y);
        let place = |p: &Point| self.axes.place(frame, *p);
        let chart = self.chart;
        let (curves, lines) = self.entries.split_at(chart.series.len());
        for (line, entry) in chart.reference_lines.iter().zip(lines) {
            if let Some(half) = line.band.filter(|half| half.is_finite()) {
                let [low, high] = [line.value - half, line.value + half].map(down);
                page.rectangle([left, high.max(top), right, low.min(bottom)], INK, SHADE);
            }
            let y = down(line.value);
            for part in clipped(&[(left, y), (right, y)], frame) {
                entry.line(page, &part);
            }
        }
        let curves = || chart.series.iter().zip(curves);
        for (series, entry) in curves() {
            for part in series.points.split(|p| p.0.is_nan() || p.1.is_nan()) {
                for part in clipped(&part.iter().map(place).collect::<Vec<_>>(), frame) {
                    entry.line(page, &part);
                }
            }
        }
        if let Some([a, b, c]) = chart.triangle() {
            let [a, b, c] = [a, b, c].map(|p| place(&p));
            for part in clipped(&[a, b, c, a], frame) {
                page.line(&part, 2.4, INK, &[]);
            }
            let slope = chart.slope_triangle.map_or(0.0, |t| t.slope);
            let label = slope.to_string().replace('-', "−");
            page.text(&label, (b.0 + 10.0, between(b, c, 0.5).1), SMALL, (0.0, 0.5));
            let (gap, anchor) = if c.1 < b.1 { (9.0, 0.0) } else { (-9.0, 1.0) };
            page.text("1", (between(a, b, 0.5).0, a.1 + gap), SMALL, (0.5, anchor));
        }
        page.outline(frame);
        for (series, entry) in curves() {
            let thin = entry.pattern.is_some() && series.points.len() > MANY;
            let mut drawn: Vec<Point> = Vec::new();
            for (x, y) in series.points.iter().filter(|p| finite(p)).map(place) {
                let across = (left - 1.0..=right + 1.0).contains(&x);
                let inside = across && (top - 1.0..=bottom + 1.0).contains(&y);
                let near = |d: &Point| (x - d.0).hypot(y - d.1) < APART;
                if inside && !(thin && drawn.iter().any(near)) {
                    drawn.push((x, y));
                    entry.mark(page, (x, y));
                }
            }
        }
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
pub(crate) fn draw_charts(path: &Path, charts: &[Chart], columns: usize) -> Result<(), PlotError> {
    let columns = columns.min(charts.len()).max(1);
    let size = [(1180.0, 760.0), (760.0, 560.0), LEAST][columns.min(3) - 1];
    let plans = charts.iter().map(|c| Plan::new(path, c, size)).collect::<Result<Vec<_>, _>>()?;
    if plans.is_empty() {
        return Err(PlotError::no_data(path, "a figure without charts"));
    }
    // Every chart has the same margins, so that the axes of a grid are aligned.
    let [left, right, below] = [0, 1, 2].map(|side| largest(plans.iter().map(|p| p.axes.room()[side])));
    let titles = || charts.iter().map(|c| &*c.title).collect();
    let sheet = |room| Sheet::new("", titles(), columns, size, room);
    let common = Entry::common(plans.iter().map(|p| &p.entries[..]));
    let Some(common) = common else {
        let natural = left + size.0 + right;
        let legends: Vec<Legend> = plans.iter().map(|p| Legend::new(&p.entries, natural)).collect();
        let wider = largest(legends.iter().map(|l| l.width - natural));
        let under = below + BELOW + largest(legends.iter().map(|l| l.height));
        let sheet = sheet([left, right + wider, under]);
        return save_both(path, (sheet.end.0 + EDGE, sheet.end.1 + EDGE), |page| {
            sheet.draw(page);
            for ((k, plan), legend) in plans.iter().enumerate().zip(&legends) {
                let frame = sheet.frame(k);
                plan.draw(page, frame);
                let first = frame[0] - left;
                let centred = frame[0] + (size.0 - legend.width) / 2.0;
                let last = first + natural + wider - legend.width;
                let at = centred.min(last).max(first);
                legend.draw(page, (at, frame[3] + below + BELOW));
            }
        });
    };
    let sheet = sheet([left, right, below]);
    let (width, height) = sheet.end;
    let named = common.iter().filter(|e| !e.name.is_empty()).count();
    let beside = named > 6 && columns < 3;
    let legend = Legend::new(&common, if beside { 0.0 } else { width - EDGE });
    let first = sheet.frame(0);
    let (at, size) = match beside {
        true => ((width + BESIDE, first[1]), (width + BESIDE + legend.width, height.max(first[1] + legend.height))),
        false => {
            let centred = (first[0] + width - right - legend.width) / 2.0;
            let at = centred.min(width - legend.width).max(EDGE);
            let size = (width.max(EDGE + legend.width), height + BELOW + legend.height);
            ((at, height + BELOW), size)
        }
    };
    save_both(path, (size.0 + EDGE, size.1 + EDGE), |page| {
        sheet.draw(page);
        for (k, plan) in plans.iter().enumerate() {
            plan.draw(page, sheet.frame(k));
        }
        legend.draw(page, at);
    })
}
