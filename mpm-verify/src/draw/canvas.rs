//! A picture as a list of shapes, which is written as pixels ([`raster`]) or as SVG
//! ([`svg`]).

use super::colour::Rgb;
use super::font::{Block, Font};
use super::shape::{Frame, Marker, Point, Shape};
use super::{PlotError, png_file, raster, svg};
use crate::files::write_whole;
use image::RgbImage;
use std::path::Path;

/// Coordinates beyond this are moved to it: far outside any picture.
const FAR: f64 = 1e5;

pub(super) struct Canvas {
    pub(super) size: (u32, u32),
    pub(super) shapes: Vec<Shape>,
}

impl Canvas {
    pub(super) fn new((width, height): Point) -> Self {
        Self {
            size: (width.ceil() as u32, height.ceil() as u32),
            shapes: Vec::new(),
        }
    }

    /// Lets shapes be seen only within a frame, or everywhere again.
    pub(super) fn clip(&mut self, frame: Option<Frame>) {
        self.shapes.push(Shape::Clip(frame));
    }

    /// Puts an image of [`FINE`](raster::FINE) times the pixels at a place.
    pub(super) fn image(&mut self, image: RgbImage, at: Point) {
        self.shapes.push(Shape::Image { image, at });
    }

    pub(super) fn rectangle(&mut self, frame: Frame, colour: Rgb, opacity: f64) {
        let [left, top, right, bottom] = frame;
        let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom)];
        self.shapes.push(Shape::Area {
            corners,
            colour,
            opacity,
        });
    }

    pub(super) fn polygon(&mut self, corners: &[Point], colour: Rgb) {
        self.shapes.push(Shape::Area {
            corners: corners.to_vec(),
            colour,
            opacity: 1.0,
        });
    }

    /// Draws a polyline, which a point that is not finite interrupts.
    pub(super) fn stroke(
        &mut self,
        points: &[Point],
        width: f64,
        colour: Rgb,
        pattern: &'static [f64],
    ) {
        let known = |p: &Point| !p.0.is_nan() && !p.1.is_nan();
        for points in points.split(|p| !known(p)).filter(|part| part.len() > 1) {
            let near = |v: f64| v.clamp(-FAR, FAR);
            self.shapes.push(Shape::Line {
                points: points.iter().map(|p| (near(p.0), near(p.1))).collect(),
                width,
                colour,
                pattern,
            });
        }
    }

    /// Draws a marker with a white rim, filled or hollow.
    pub(super) fn marker(&mut self, marker: Marker, at: Point, colour: Rgb, hollow: bool) {
        self.shapes.push(Shape::Mark {
            marker,
            at,
            colour,
            hollow,
        });
    }

    /// Draws one line of text; `anchor` is the fraction of its width and of a capital's height (from
    /// the top) that lies at the point. Turned text reads upwards, with `anchor` turned along.
    pub(super) fn text(&mut self, text: &str, at: Point, font: Font, anchor: Point, turned: bool) {
        let back = anchor.0 * font.width(text);
        let down = (1.0 - anchor.1) * super::font::CAPITAL * font.size;
        let at = match turned {
            true => (at.0 + down, at.1 + back),
            false => (at.0 - back, at.1 + down),
        };
        self.shapes.push(Shape::Text {
            text: text.to_owned(),
            at,
            font,
            turned,
        });
    }

    /// Draws centred lines of text downwards from `at` (turned: rightwards).
    pub(super) fn block(&mut self, block: &Block, at: Point, turned: bool) {
        for (down, line) in block.placed() {
            let shift = if turned { (down, 0.0) } else { (0.0, down) };
            let at = (at.0 + shift.0, at.1 + shift.1);
            self.text(line, at, block.font, (0.5, 0.0), turned);
        }
    }

    /// Writes the picture as PNG.
    pub(super) fn save(&self, path: &Path) -> Result<(), PlotError> {
        png_file::write_small_png(path, &self.pixels(path, 1)?)
    }

    /// Writes the picture as SVG.
    pub(super) fn save_svg(&self, path: &Path) -> Result<(), PlotError> {
        let document = svg::text(self.size, &self.shapes);
        let document = document.map_err(|e| PlotError::write(path, &e))?;
        write_whole(path, &document).map_err(|e| PlotError::write(path, &e))
    }

    /// The picture at its size over `coarser`; `path` names it in errors.
    pub(super) fn pixels(&self, path: &Path, coarser: u32) -> Result<RgbImage, PlotError> {
        raster::pixels(self.size, &self.shapes, coarser)
            .map_err(|cause| PlotError::write(path, &cause))
    }
}
