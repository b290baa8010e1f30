//! Panels of particle fields in the plane.

use super::axes::{Axes, Axis, TICK, draw_box, extent, widen};
use super::backend::{Failure, Own, Sheet};
use super::bar::{BAR, BAR_TIP, draw_bar};
use super::canvas::Canvas;
use super::colour::{INK, channels, colour_of};
use super::font::{Block, HEADING, LABEL, TITLE};
use super::png_file::save_animation;
use super::raster::FINE;
use super::shape::Point;
use super::{EDGE, PlotError, SOLID, finite, largest, nothing};
use image::RgbImage;
use plotters::drawing::IntoDrawingArea;
use rayon::prelude::*;
use std::path::Path;

/// One snapshot of a particle field.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldPanel {
    /// Title above the panel; may be empty.
    pub title: String,
    /// Particle positions.
    pub points: Vec<(f64, f64)>,
    /// Particle values; one that is not a number is drawn grey.
    pub values: Vec<f64>,
    /// Side of a particle's square in data units.
    pub size: f64,
    /// Polygon drawn thin over the particles; may be empty.
    pub outline: Vec<(f64, f64)>,
}

impl FieldPanel {
    /// Of its particles those at places of which `shown` holds.
    #[must_use]
    pub fn showing(mut self, shown: impl Fn((f64, f64)) -> bool) -> Self {
        let particles = self.points.into_iter().zip(self.values);
        (self.points, self.values) = particles.filter(|(at, _)| shown(*at)).unzip();
        self
    }
}

/// Field panels on the same axes x and y (m) with one colour scale.
///
/// The colours diverge from a neutral zero when both signs take a good part of the range (the
/// smaller end at least a fifth of the larger), otherwise they are sequential.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldFigure {
    /// Title above the panels; may be empty.
    pub title: String,
    /// Panels, row by row.
    pub panels: Vec<FieldPanel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Values at the ends of the colour scale.
    pub range: (f64, f64),
    /// Label of the colour bar, with unit.
    pub label: String,
    /// Ranges of abscissa and ordinate that are shown; without, all particles and outlines are.
    pub window: Option<((f64, f64), (f64, f64))>,
}

/// Distance of rows of panels, in pixels.
const ROW_GAP: f64 = 24.0;

/// Draws field panels as one PNG file, all with the same axes, equal scales and one colour bar.
///
/// # Errors
///
/// A figure without finite points or range, a panel whose points and values differ in number, or a
/// file that cannot be written.
pub fn draw_fields(path: &Path, figure: &FieldFigure) -> Result<(), PlotError> {
    compose_fields(path, figure)?.save(path)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. Their panels should be the same but for the particles.
///
/// # Errors
/// As [`draw_fields`]; or there are no figures.
pub fn animate_fields(path: &Path, figures: &[FieldFigure], delay: u16) -> Result<(), PlotError> {
    let frame = |figure: &FieldFigure| compose_fields(path, figure)?.pixels(path, 2);
    let frames: Result<Vec<_>, PlotError> = figures.par_iter().map(frame).collect();
    save_animation(path, &frames?, delay)
}

fn compose_fields(path: &Path, figure: &FieldFigure) -> Result<Canvas, PlotError> {
    let panels = &figure.panels;
    if let Some(panel) = panels.iter().find(|p| p.points.len() != p.values.len()) {
        return Err(PlotError::Lengths {
            path: path.into(),
            title: panel.title.clone(),
            points: panel.points.len(),
            values: panel.values.len(),
        });
    }
    let corners = |p: &Point, half: f64| [(p.0 - half, p.1 - half), (p.0 + half, p.1 + half)];
    let extents = |panel: &FieldPanel| {
        let squares = panel.points.iter().map(|p| corners(p, panel.size / 2.0));
        [squares.collect::<Vec<_>>().concat(), panel.outline.clone()].concat()
    };
    let all = panels.iter().flat_map(extents).filter(finite);
    let all: Vec<Point> = all.collect();
    let range = |pick: fn(&Point) -> f64| extent(all.iter().map(pick)).filter(|r| r.1 > r.0);
    let values = extent([figure.range.0, figure.range.1].into_iter());
    let (Some(xs), Some(ys), Some(values)) = (range(|p| p.0), range(|p| p.1), values) else {
        return Err(nothing(path, &figure.title));
    };
    let (xs, ys) = figure.window.unwrap_or((xs, ys));

    // The axes: one scale of pixels for both directions, and a margin about the particles.
    let columns = figure.columns.min(panels.len()).max(1);
    let rows = panels.len().div_ceil(columns);
    let widths = [1250.0, 720.0, 500.0, 400.0];
    let heights = [850.0, 640.0, 520.0, 440.0];
    let most = (widths[columns.min(4) - 1], heights[columns.min(4) - 1]);
    let scale = f64::min(most.0 / (xs.1 - xs.0), most.1 / (ys.1 - ys.0));
    let axis = |(lo, hi): Point, upright: bool| {
        let length = (scale * (hi - lo)).ceil() + 40.0;
        let (middle, half) = ((lo + hi) / 2.0, length / scale / 2.0);
        Axis::new((middle - half, middle + half), false, length, upright)
    };
    let labels = ["x (m)", "y (m)"];
    let axes = Axes::new([axis(xs, false), axis(ys, true)], labels, 200.0);
    let (x, y) = (&axes.x, &axes.y);

    let title = |p: &FieldPanel| Block::new(&p.title, TITLE, x.length.max(260.0));
    let titles: Vec<_> = panels.iter().map(title).collect();
    let cell = largest(titles.iter().map(Block::width)).max(axes.width());
    let pitch = cell + 36.0_f64.max(x.label_width() / 2.0 + 12.0);
    let (left, below) = (axes.left(), axes.below());
    let top = 12.0 + largest(titles.iter().map(Block::height));
    // Where the last row is not full, the row above it has labels too.
    let ragged = panels.len() < rows * columns && rows > 1;
    let extra = if ragged { below } else { 0.0 };
    let height = rows as f64 * (top + y.length) + (rows - 1) as f64 * ROW_GAP + extra;
    let bar_length = (height - top - 2.0 * BAR_TIP).clamp(230.0, 850.0).floor();
    let bar = Axis::new(widen(values, 0.0), false, bar_length, true);
    let bar_label = Block::new(&figure.label, LABEL, bar_length + 2.0 * BAR_TIP);
    let bar_left = EDGE + left + columns as f64 * pitch - (pitch - cell) + 44.0;
    let bar_label_left = bar_left + BAR + TICK + bar.label_width() + 12.0;
    let width = bar_label_left + bar_label.height() + EDGE;
    let heading = Block::new(&figure.title, HEADING, width - 2.0 * EDGE);
    let head = EDGE + heading.height() * 1.2;
    let full = f64::max(top + bar_length + 2.0 * BAR_TIP, height + below);
    let mut canvas = Canvas::new((width, head + full + EDGE));
    canvas.block(&heading, (width / 2.0, EDGE), false);

    let draw = |sheet: Sheet| -> Result<(), Failure> {
        for (k, (panel, title)) in panels.iter().zip(&titles).enumerate() {
            let (row, column) = (k / columns, k % columns);
            let middle = EDGE + left + column as f64 * pitch + cell / 2.0;
            let down = row as f64 * (top + y.length + ROW_GAP);
            let down = down + if row + 1 == rows { extra } else { 0.0 };
            let frame = axes.frame((middle - x.length / 2.0, head + down + top));
            sheet.draw(&Own::new(Vec::new(), |canvas, _| {
                canvas.image(squares(panel, &axes, bar.range), (frame[0], frame[1]))
            }))?;
            let labels = [k + columns >= panels.len(), column == 0];
            let mut plot = axes.draw(&sheet, frame, title, labels, false)?;
            let outline = panel.outline.iter().chain(panel.outline.first());
            let outline: Vec<Point> = outline.filter(|p| finite(p)).copied().collect();
            plot.draw_series([Own::new(outline, |canvas, points| {
                canvas.stroke(points, 2.0, INK, SOLID)
            })])?;
            draw_box(&plot)?;
        }
        Ok(())
    };
    draw((&mut canvas).into_drawing_area()).map_err(|e| PlotError::write(path, &e))?;
    let shown = || panels.iter().flat_map(|p| &p.values);
    let beyond = [
        shown().any(|v| *v < bar.range.0),
        shown().any(|v| *v > bar.range.1),
    ];
    let middle = head + top + ((height - top) / 2.0).max(bar_length / 2.0 + BAR_TIP);
    let corner = (bar_left.round(), (middle + bar_length / 2.0).round());
    draw_bar(&mut canvas, (&bar, colour_of), beyond, corner);
    canvas.block(&bar_label, (bar_label_left, middle), true);
    Ok(canvas)
}

/// The particles of a panel within its axes' box, in an image of [`FINE`] times the pixels.
fn squares(panel: &FieldPanel, axes: &Axes, range: Point) -> RgbImage {
    let fine = |v: f64| (f64::from(FINE) * v).round();
    let (width, height) = (fine(axes.x.length) as u32, fine(axes.y.length) as u32);
    let mut image = RgbImage::from_pixel(width, height, image::Rgb([255; 3]));
    let (row, half) = (3 * width as usize, panel.size / 2.0);
    for (at, value) in panel
        .points
        .iter()
        .zip(&panel.values)
        .filter(|p| finite(p.0))
    {
        let colour = channels(colour_of(*value, range));
        // A little larger, so that rounding leaves no gap between neighbours.
        let ends = |low: f64, high: f64, most: u32| {
            let end = |v: f64| fine(v).clamp(0.0, f64::from(most)) as usize;
            (end(low - 0.15), end(high + 0.15))
        };
        let (left, right) = ends(axes.x.at(at.0 - half), axes.x.at(at.0 + half), width);
        let down = |v: f64| axes.y.length - axes.y.at(v);
        let (top, bottom) = ends(down(at.1 + half), down(at.1 - half), height);
        for line in image.chunks_exact_mut(row).take(bottom).skip(top) {
            for pixel in line[3 * left..3 * right].chunks_exact_mut(3) {
                pixel.copy_from_slice(&colour);
            }
        }
    }
    image
}
