//! Charts in a grid, drawn by plotters.

use super::axes::{Axes, Plot, draw_box};
use super::backend::{Failure, Own, Sheet, lettering, line, pixel, placed, shade};
use super::canvas::Canvas;
use super::chart::{Chart, LEAST};
use super::colour::INK;
use super::font::{Block, SMALL, TITLE};
use super::legend::{Entry, Legend};
use super::shape::{Frame, Point};
use super::{EDGE, PlotError, between, finite, largest, nothing};
use plotters::drawing::IntoDrawingArea;
use plotters::element::{PathElement, Rectangle};
use plotters::style::text_anchor::{HPos, VPos};
use std::path::Path;

/// Distance of the charts in a grid, in pixels.
const CELL_GAP: f64 = 30.0;

/// A chart with its axes and title.
struct Plan<'a> {
    chart: &'a Chart,
    axes: Axes,
    title: Block,
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
        })
    }

    /// Draws everything but the legend about the axes' box.
    fn draw(&self, sheet: &Sheet, entries: &[Entry], frame: Frame) -> Result<(), Failure> {
        let mut plot = self.axes.draw(sheet, frame, &self.title, [true; 2], true)?;
        let clip = |frame: Option<Frame>| {
            sheet.draw(&Own::new(Vec::new(), move |canvas, _| canvas.clip(frame)))
        };
        clip(Some(frame))?;
        let (chart, across) = (self.chart, plot.x_range());
        let (curves, lines) = entries.split_at(chart.series.len());
        for (line, entry) in chart.reference_lines.iter().zip(lines) {
            let [low, high] = [-1.0, 1.0].map(|side| line.value + side * line.band.unwrap_or(0.0));
            if line.band.is_some() && high.is_finite() {
                let corners = [(across.start, low), (across.end, high)];
                plot.draw_series([Rectangle::new(corners, shade(INK))])?;
            }
            let ends = [across.start, across.end].map(|x| (x, line.value));
            plot.draw_series([entry.line(ends.into())])?;
        }
        let curves = || chart.series.iter().zip(curves);
        for (series, entry) in curves() {
            let parts = series.points.split(|p| p.0.is_nan() || p.1.is_nan());
            let parts = parts.filter(|part| part.len() > 1);
            plot.draw_series(parts.map(|part| entry.line(part.to_vec())))?;
        }
        self.draw_triangle(sheet, &mut plot)?;
        clip(None)?;
        draw_box(&plot)?;
        for (series, entry) in curves() {
            let thin = entry.pattern.is_some() && series.points.len() > 40;
            let mut drawn: Vec<Point> = Vec::new();
            let mut shown = |point: &&Point| {
                let (x, y) = pixel(plot.backend_coord(point));
                let across = (frame[0] - 1.0..=frame[2] + 1.0).contains(&x);
                let inside = across && (frame[1] - 1.0..=frame[3] + 1.0).contains(&y);
                let near = |d: &Point| (x - d.0).hypot(y - d.1) < 60.0;
                let shown = finite(point) && inside && !(thin && drawn.iter().any(near));
                drawn.extend(shown.then_some((x, y)));
                shown
            };
            let points: Vec<Point> = series.points.iter().filter(&mut shown).copied().collect();
            plot.draw_series(points.into_iter().map(|point| entry.mark(point)))?;
        }
        Ok(())
    }

    fn draw_triangle(&self, sheet: &Sheet, plot: &mut Plot) -> Result<(), Failure> {
        let Some([a, b, c]) = self.chart.triangle() else {
            return Ok(());
        };
        plot.draw_series([PathElement::new([a, b, c, a], line(INK, 2.4))])?;
        let [a, b, c] = [a, b, c].map(|p| pixel(plot.backend_coord(&p)));
        let slope = self.chart.slope_triangle.map_or(0.0, |t| t.slope);
        let (label, side) = (slope.to_string().replace('-', "−"), between(b, c, 0.5));
        let style = lettering(SMALL, HPos::Left, VPos::Center);
        sheet.draw_text(&label, &style, placed((b.0 + 10.0, side.1)))?;
        let (gap, edge) = match c.1 < b.1 {
            true => (9.0, VPos::Top),
            false => (-9.0, VPos::Bottom),
        };
        let below = (between(a, b, 0.5).0, a.1 + gap);
        sheet.draw_text("1", &lettering(SMALL, HPos::Center, edge), placed(below))
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
    let columns = columns.min(charts.len()).max(1);
    let size = [(1180.0, 760.0), (760.0, 560.0), LEAST][columns.min(3) - 1];
    let plans = charts.iter().map(|c| Plan::new(path, c, size));
    let plans = plans.collect::<Result<Vec<_>, _>>()?;
    if plans.is_empty() {
        return Err(nothing(path, "a figure without charts"));
    }

    // Every chart has the same margins, so that the axes of a grid are aligned.
    let most = |extent: &dyn Fn(&Plan) -> f64| largest(plans.iter().map(extent));
    let left = most(&|p| p.axes.left());
    let right = 16.0 + most(&|p| p.axes.x.label_width()) / 2.0;
    let top = 16.0 + most(&|p| p.title.height());
    let bottom = most(&|p| p.axes.below());
    let entries: Vec<_> = charts.iter().map(Entry::all).collect();
    let common = Entry::common(&entries);
    let shared = common.is_some();
    let named = entries[0].iter().filter(|e| !e.name.is_empty());
    let beside = shared && named.count() > 6 && columns < 3;

    let (rows, natural) = (charts.len().div_ceil(columns), left + size.0 + right);
    let grid_width = |cell: f64| columns as f64 * (cell + CELL_GAP) - CELL_GAP;
    let room = match (shared, beside) {
        (_, true) => 0.0,
        (true, _) => grid_width(natural),
        _ => natural,
    };
    let legend = |own| Legend::new(common.as_ref().unwrap_or(own), room);
    let legends: Vec<_> = entries.iter().map(legend).collect();
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
    let draw = |sheet: Sheet| -> Result<(), Failure> {
        for (k, (plan, legend)) in plans.iter().zip(&legends).enumerate() {
            let x = EDGE + (k % columns) as f64 * (cell + CELL_GAP);
            let y = EDGE + (k / columns) as f64 * (row + CELL_GAP);
            let frame = plan.axes.frame((x + left, y + top));
            plan.draw(&sheet, &entries[k], frame)?;
            let inset = |left: f64, right: f64, room: f64| {
                let centred = (left + right - legend.width) / 2.0;
                centred.min(room - legend.width).max(0.0)
            };
            if !shared {
                let inset = inset(left, left + size.0, cell);
                legend.draw(&sheet, (x + inset, frame[3] + bottom + 16.0))?;
            } else if beside && k == 0 {
                legend.draw(&sheet, (EDGE + width + 24.0, EDGE + top))?;
            } else if k == 0 {
                let inset = inset(left, width - right, full_width);
                legend.draw(&sheet, (EDGE + inset, EDGE + height + 16.0))?;
            }
        }
        Ok(())
    };
    draw((&mut canvas).into_drawing_area()).map_err(|e| PlotError::write(path, &e))?;
    canvas.save_svg(&path.with_extension("svg"))?;
    canvas.save(path)
}
