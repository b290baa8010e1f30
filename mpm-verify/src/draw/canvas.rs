//! A picture as a list of shapes, which is written as pixels ([`raster`](super::raster)) or as SVG
//! ([`svg`](super::svg)).

use super::chart::Marker;
use super::colour::{Rgb, WHITE};
use super::font::{Block, Font};
use super::{PlotError, SOLID, png_file, raster, svg};
use crate::files::write_whole;
use image::RgbImage;
use std::f64::consts::TAU;
use std::path::Path;

/// A position, rightwards and downwards in pixels or in data coordinates.
pub(super) type Point = (f64, f64);
/// Left, top, right and bottom.
pub(super) type Frame = [f64; 4];

/// Width of a curve.
pub(super) const LINE: f64 = 11.0 / 3.0;
/// Coordinates beyond this are moved to it: far outside any picture.
const FAR: f64 = 1e5;

/// What a picture is made of; later shapes lie over earlier ones.
pub(super) enum Shape {
    /// A filled polygon.
    Area {
        corners: Vec<Point>,
        colour: Rgb,
        opacity: f64,
    },
    /// A polyline with round ends and corners; the pattern gives the lengths of dashes and gaps in turn.
    Line {
        points: Vec<Point>,
        width: f64,
        colour: Rgb,
        pattern: &'static [f64],
    },
    /// A marker: see [`layers`].
    Mark {
        marker: Marker,
        at: Point,
        colour: Rgb,
        hollow: bool,
    },
    /// A line of text whose baseline starts at a point; turned, it reads upwards.
    Text {
        text: String,
        at: Point,
        font: Font,
        turned: bool,
    },
    /// An image of [`FINE`](raster::FINE) times the pixels along each side, which SVG leaves out.
    Image { image: RgbImage, at: Point },
    /// From here on shapes are seen only within a frame, or everywhere.
    Clip(Option<Frame>),
}

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
        write_whole(path, svg::text(self).as_bytes()).map_err(|e| PlotError::write(path, &e))
    }

    /// The picture at its size over `coarser`; `path` names it in errors.
    pub(super) fn pixels(&self, path: &Path, coarser: u32) -> Result<RgbImage, PlotError> {
        raster::pixels(self, coarser).map_err(|cause| PlotError::write(path, &cause))
    }
}

/// The shapes of a marker about the origin, from its white rim upwards.
pub(super) fn layers(marker: Marker, colour: Rgb, hollow: bool) -> Vec<Shape> {
    let line = |points: Vec<Point>, width: f64, colour: Rgb| Shape::Line {
        points,
        width,
        colour,
        pattern: SOLID,
    };
    let polygon = |corners: u32, turn: f64, radius: f64| -> Vec<Point> {
        let angle = |k: u32| turn.to_radians() + f64::from(k) / f64::from(corners) * TAU;
        let corner = |k| (radius * angle(k).cos(), -radius * angle(k).sin());
        (0..corners).map(corner).collect()
    };
    // A regular polygon: number of corners, angle of the first, and size.
    let (corners, turn, size) = match marker {
        Marker::None => return Vec::new(),
        Marker::Cross => {
            let strokes = |width, colour| {
                let stroke = |s: f64| line(vec![(-8.5, -s), (8.5, s)], width, colour);
                [8.5, -8.5].map(stroke)
            };
            let both = [strokes(LINE + 4.0, WHITE), strokes(LINE + 0.7, colour)];
            return both.into_iter().flatten().collect();
        }
        Marker::Ring => {
            let mut ring = polygon(48, 0.0, 16.0);
            ring.push(ring[0]);
            return vec![line(ring, 2.4, colour)];
        }
        Marker::Dot => (24, 0.0, 5.0),
        Marker::Circle => (48, 0.0, 10.0),
        Marker::Square => (4, 45.0, 12.8),
        Marker::Triangle => (3, 90.0, 14.0),
        Marker::Diamond => (4, 90.0, 13.0),
    };
    let inner = if hollow { WHITE } else { colour };
    let layer = |(outset, colour): (f64, Rgb)| {
        let radius = size + outset / (0.5 * TAU / f64::from(corners)).cos();
        Shape::Area {
            corners: polygon(corners, turn, radius),
            colour,
            opacity: 1.0,
        }
    };
    [(2.0, WHITE), (0.0, colour), (-3.4, inner)]
        .map(layer)
        .into()
}
