//! Panels of particle fields in the plane.

use super::axes::{Axes, Axis, THIN, draw_box, extent};
use super::colour::{INK, colour_of};
use super::page::{Drawn, Frame, Medium, Page, Picture, Point, clipped, fine, ink, stroke};
use super::panels::{Bar, Panels};
use super::png_file::save_animation;
use super::{PlotError, finite, lengths, nothing};
use plotters::element::Rectangle;
use plotters::style::Color;
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

/// Draws field panels as one PNG file, all with the same axes, equal scales and one colour bar.
///
/// # Errors
///
/// A figure without finite points or range, a panel whose points and values differ in number, or a
/// file that cannot be written.
pub fn draw_fields(path: &Path, figure: &FieldFigure) -> Result<(), PlotError> {
    Fields::new(path, figure)?.save(path)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. Their panels should be the same but for the particles.
///
/// # Errors
/// As [`draw_fields`]; or there are no figures.
pub fn animate_fields(path: &Path, figures: &[FieldFigure], delay: u16) -> Result<(), PlotError> {
    let frame = |figure: &FieldFigure| Fields::new(path, figure)?.pixels(path, 2);
    let frames: Result<Vec<_>, PlotError> = figures.par_iter().map(frame).collect();
    save_animation(path, &frames?, delay)
}

/// A figure, laid out.
struct Fields<'a> {
    figure: &'a FieldFigure,
    axes: Axes,
    panels: Panels,
    range: Point,
}

impl<'a> Fields<'a> {
    fn new(path: &Path, figure: &'a FieldFigure) -> Result<Self, PlotError> {
        let panels = &figure.panels;
        for panel in panels {
            lengths(path, &panel.title, panel.points.len(), panel.values.len())?;
        }
        let extents = |panel: &FieldPanel| {
            let half = panel.size / 2.0;
            let corners = |p: &Point| [(p.0 - half, p.1 - half), (p.0 + half, p.1 + half)];
            let squares = panel.points.iter().flat_map(corners);
            squares
                .chain(panel.outline.iter().copied())
                .collect::<Vec<_>>()
        };
        let all: Vec<Point> = panels.iter().flat_map(extents).filter(finite).collect();
        let range = |pick: fn(&Point) -> f64| extent(all.iter().map(pick)).filter(|r| r.1 > r.0);
        let values = extent([figure.range.0, figure.range.1].into_iter());
        let (Some(xs), Some(ys), Some(values)) = (range(|p| p.0), range(|p| p.1), values) else {
            return Err(nothing(path, &figure.title));
        };
        let (xs, ys) = figure.window.unwrap_or((xs, ys));

        // The axes: one scale of pixels for both directions, and a margin about the particles.
        let columns = figure.columns.min(panels.len()).max(1);
        let widths = [1250.0, 720.0, 500.0, 400.0];
        let heights = [850.0, 640.0, 520.0, 440.0];
        let most = (widths[columns.min(4) - 1], heights[columns.min(4) - 1]);
        let scale = f64::min(most.0 / (xs.1 - xs.0), most.1 / (ys.1 - ys.0));
        let axis = |(lo, hi): Point, upright: bool| {
            let length = (scale * (hi - lo)).ceil() + 40.0;
            let (middle, half) = ((lo + hi) / 2.0, length / scale / 2.0);
            Axis::new((middle - half, middle + half), false, length, upright)
        };
        let axes = Axes::new([axis(xs, false), axis(ys, true)], ["x (m)", "y (m)"], 200.0);
        let bar = Bar::new(
            values,
            &figure.label,
            colour_of,
            panels.iter().flat_map(|p| &p.values),
        );
        let gap = 36.0_f64.max(axes.x.label_width() / 2.0 + 12.0);
        let panels = Panels::new(
            &figure.title,
            panels.iter().map(|p| &*p.title).collect(),
            columns,
            (
                (axes.x.length, axes.y.length),
                [axes.left(), 0.0, axes.below()],
            ),
            gap,
            bar,
        );
        Ok(Self {
            figure,
            axes,
            panels,
            range: values,
        })
    }

    /// Draws a particle, as far as it lies in the frame.
    fn square<B: Medium>(
        &self,
        page: &Page<B>,
        frame: Frame,
        panel: &FieldPanel,
        (at, value): (&Point, &f64),
    ) -> Drawn<B> {
        let half = panel.size / 2.0;
        let [left, top, right, bottom] = frame.map(fine);
        // A little larger, so that rounding leaves no gap between neighbours.
        let x = |v: f64, more: f64| fine(frame[0] + self.axes.x.at(v) + more).clamp(left, right);
        let y = |v: f64, more: f64| fine(frame[3] - self.axes.y.at(v) + more).clamp(top, bottom);
        let corners = [
            (x(at.0 - half, -0.15), y(at.1 + half, -0.15)),
            (x(at.0 + half, 0.15), y(at.1 - half, 0.15)),
        ];
        if corners[0].0 == corners[1].0 || corners[0].1 == corners[1].1 {
            return Ok(());
        }
        let style = ink(colour_of(*value, self.range)).filled();
        page.draw(&Rectangle::new(corners, style))
    }
}

impl Picture for Fields<'_> {
    fn size(&self) -> Point {
        self.panels.size()
    }

    fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B> {
        for (k, panel) in self.figure.panels.iter().enumerate() {
            let (frame, labels) = (self.panels.frame(k), self.panels.labelled(k));
            let particles = panel.points.iter().zip(&panel.values);
            for particle in particles.filter(|(at, _)| finite(at)) {
                self.square(page, frame, panel, particle)?;
            }
            self.axes.draw(page, frame, labels, false)?;
            let outline = panel.outline.iter().chain(panel.outline.first());
            let place = |p: &Point| {
                (
                    frame[0] + self.axes.x.at(p.0),
                    frame[3] - self.axes.y.at(p.1),
                )
            };
            let outline: Vec<Point> = outline.filter(|p| finite(p)).map(place).collect();
            for part in clipped(&outline, frame) {
                stroke(page, &part, THIN, INK, &[])?;
            }
            draw_box(page, frame)?;
        }
        self.panels.draw(page)
    }
}
