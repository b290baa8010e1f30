//! A picture as a list of shapes, which is written as pixels ([`raster`]) or as SVG
//! ([`svg`]).

use super::colour::Rgb;
use super::font::{Block, CAPITAL, Font, LEADING};
use super::shape::{Frame, Marker, Point, Shape};
use super::{PlotError, png_file, raster, svg};
use crate::files::write_whole;
use image::RgbImage;
use std::path::Path;

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

    /// Draws a polyline.
    pub(super) fn stroke(
        &mut self,
        points: &[Point],
        width: f64,
        colour: Rgb,
        pattern: &'static [f64],
    ) {
        self.shapes.push(Shape::Line {
            points: points.to_vec(),
            width,
            colour,
            pattern,
        });
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

    /// Draws lines of text; `anchor` is the fraction of each one's width, and of the height from the first one's
    /// capitals to the last baseline, that lies at the point. Turned text reads upwards, with `anchor` turned along.
    pub(super) fn text(&mut self, text: &str, at: Point, font: Font, anchor: Point, turned: bool) {
        let above = anchor.1 * font.height(text);
        for (k, line) in text.lines().enumerate() {
            let back = anchor.0 * font.width(line);
            let down = (k as f64 * LEADING + CAPITAL) * font.size - above;
            let at = match turned {
                true => (at.0 + down, at.1 + back),
                false => (at.0 - back, at.1 + down),
            };
            self.shapes.push(Shape::Text {
                text: line.to_owned(),
                at,
                font,
                turned,
            });
        }
    }

    /// Draws centred lines of text downwards from `at` (turned: rightwards).
    pub(super) fn block(&mut self, block: &Block, (x, y): Point, turned: bool) {
        let margin = block.font.margin();
        let at = if turned {
            (x + margin, y)
        } else {
            (x, y + margin)
        };
        self.text(&block.text, at, block.font, (0.5, 0.0), turned);
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
