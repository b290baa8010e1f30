//! Panels of particle fields in the plane.

use super::axes::{Axes, Axis, THIN, extent};
use super::colour::{INK, Rgb, colour_of};
use super::page::{Frame, Page, Point, clipped, fine, ink, pixels};
use super::png_file::{save_animation, write_small_png};
use super::sheet::{Bar, Sheet};
use super::{PlotError, finite, same_length};
use image::RgbImage;
use plotters::element::Rectangle;
use plotters::style::Color;
use rayon::prelude::*;
use std::path::Path;

/// Width of a domain's edge in its own colour, so that rounding leaves no gap between neighbours, and of a support.
const SEAM: f64 = 0.7;
const THICK: f64 = 5.0;
/// Colour of bodies at the start.
const GREY: Rgb = 0x8C8C8C;

/// Half the sides of a domain, along two axes.
type Sides = [Point; 2];
/// A line through points, and whether it is a support's; a body's at the start is thin and grey.
pub(crate) type Line = (Vec<(f64, f64)>, bool);

/// One snapshot of a particle field.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FieldPanel {
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
    /// Keeps only particles at places where `shown` holds.
    pub(crate) fn showing(mut self, shown: impl Fn((f64, f64)) -> bool) -> Self {
        let particles = self.points.into_iter().zip(self.values);
        (self.points, self.values) = particles.filter(|(at, _)| shown(*at)).unzip();
        self
    }
}

/// Field panels on the same axes x and y (m) with one colour scale.
///
/// The colours diverge from a neutral zero when both signs take a good part of the range (the
/// smaller end at least a fifth of the larger), otherwise they are sequential.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct FieldFigure {
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
    /// Half the sides of the domains of a single panel's particles, along two axes; without, they are squares.
    pub domains: Vec<[(f64, f64); 2]>,
    /// Lines around the particles.
    pub around: Vec<Line>,
}

impl FieldFigure {
    /// One panel, by label and range of the colour scale; all of it is shown.
    pub(crate) fn single(panel: FieldPanel, label: String, range: (f64, f64)) -> Self {
        Self { panels: vec![panel], columns: 1, range, label, ..Self::default() }
    }
}

/// Draws field panels as one PNG file, all with the same axes, equal scales and one colour bar.
///
/// # Errors
///
/// A figure without finite points or range, a panel whose points and values differ in number, or a
/// file that cannot be written.
pub(crate) fn draw_fields(path: &Path, figure: &FieldFigure) -> Result<(), PlotError> {
    write_small_png(path, &picture(path, figure, 1)?)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. Their panels should differ in the particles alone.
///
/// # Errors
/// As [`draw_fields`]; or there are no figures.
pub(crate) fn animate_fields(path: &Path, figures: &[FieldFigure], delay: u16) -> Result<(), PlotError> {
    let frames = figures.par_iter().map(|figure| picture(path, figure, 2));
    save_animation(path, &frames.collect::<Result<Vec<_>, _>>()?, delay)
}

fn picture(path: &Path, figure: &FieldFigure, coarser: u32) -> Result<RgbImage, PlotError> {
    let panels = &figure.panels;
    for panel in panels {
        same_length(path, &panel.title, panel.points.len(), panel.values.len())?;
    }
    let extents = |panel: &FieldPanel| {
        let half = panel.size / 2.0;
        let corners = |p: &Point| [(p.0 - half, p.1 - half), (p.0 + half, p.1 + half)];
        panel.points.iter().flat_map(corners).chain(panel.outline.iter().copied()).collect::<Vec<_>>()
    };
    let bodies = figure.around.iter().filter(|(_, is_support)| !is_support).flat_map(|(line, _)| line.iter().copied());
    let all: Vec<Point> = panels.iter().flat_map(extents).chain(bodies).filter(finite).collect();
    let range = |pick: fn(&Point) -> f64| extent(all.iter().map(pick)).filter(|r| r.1 > r.0);
    let values = extent([figure.range.0, figure.range.1].into_iter());
    let (Some(xs), Some(ys), Some(values)) = (range(|p| p.0), range(|p| p.1), values) else {
        return Err(PlotError::no_data(path, &figure.title));
    };
    let (xs, ys) = figure.window.unwrap_or((xs, ys));

    // The axes: one scale of pixels for both directions, and a margin about the particles.
    let columns = figure.columns.min(panels.len()).max(1);
    let most = [(1250.0, 850.0), (720.0, 640.0), (500.0, 520.0), (400.0, 440.0)][columns.min(4) - 1];
    let scale = f64::min(most.0 / (xs.1 - xs.0), most.1 / (ys.1 - ys.0));
    let axis = |(lo, hi): Point, upright: bool| {
        let length = (scale * (hi - lo)).ceil() + 40.0;
        let (middle, half) = ((lo + hi) / 2.0, length / scale / 2.0);
        Axis::new((middle - half, middle + half), false, length, upright)
    };
    let axes = Axes::new([axis(xs, false), axis(ys, true)], ["x (m)", "y (m)"], 200.0);
    let titles = panels.iter().map(|p| &*p.title).collect();
    let size = (axes.x.length, axes.y.length);
    let sheet = Sheet::new(&figure.title, titles, columns, size, axes.room());
    let shown = panels.iter().flat_map(|p| &p.values);
    let bar = Bar::new(&sheet, (values, &figure.label), colour_of, shown);
    pixels(path, bar.size(&sheet), coarser, |page| {
        for (k, panel) in panels.iter().enumerate() {
            let frame = sheet.frame(k);
            draw_particles(page, &axes, frame, panel, (&figure.domains, bar.range()));
            for (line, is_support) in &figure.around {
                let (width, colour) = if *is_support { (THICK, INK) } else { (THIN, GREY) };
                let line: Vec<Point> = line.iter().map(|point| axes.place(frame, *point)).collect();
                clipped(&line, frame).iter().for_each(|part| page.line(part, width, colour, &[]));
            }
            axes.draw(page, frame, false);
            let outline = panel.outline.iter().chain(panel.outline.first());
            let outline = outline.filter(|p| finite(p)).map(|p| axes.place(frame, *p));
            for part in clipped(&outline.collect::<Vec<_>>(), frame) {
                page.line(&part, THIN, INK, &[]);
            }
            page.outline(frame);
        }
        sheet.draw(page);
        bar.draw(page);
    })
}

/// Draws particles as far as they lie in the frame.
fn draw_particles(page: &mut Page, axes: &Axes, frame: Frame, panel: &FieldPanel, (domains, range): (&[Sides], Point)) {
    let (half, [left, top, right, bottom]) = (panel.size / 2.0, frame.map(fine));
    let particles = panel.points.iter().zip(&panel.values);
    for (k, (at, value)) in particles.enumerate().filter(|(_, (at, _))| finite(at)) {
        if let Some([u, v]) = domains.get(k) {
            let corner = |(i, j)| axes.place(frame, (at.0 + i * u.0 + j * v.0, at.1 + i * u.1 + j * v.1));
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)].map(corner);
            page.area(&corners, colour_of(*value, range), 1.0);
            page.line(&corners, SEAM, colour_of(*value, range), &[]);
            continue;
        }
        // A little larger, so that rounding leaves no gap between neighbours.
        let corner = |side: f64| {
            let (x, y) = axes.place(frame, (at.0 + side * half, at.1 - side * half));
            let (x, y) = (fine(x + 0.15 * side), fine(y + 0.15 * side));
            (x.clamp(left, right), y.clamp(top, bottom))
        };
        let [from, to] = [-1.0, 1.0].map(corner);
        if from.0 < to.0 && from.1 < to.1 {
            let style = ink(colour_of(*value, range), 1.0).filled();
            page.put(&Rectangle::new([from, to], style));
        }
    }
}
