//! What pictures are made of.

use super::SOLID;
use super::colour::{Rgb, WHITE};
use super::font::Font;
use image::RgbImage;
use std::f64::consts::TAU;

/// A position, rightwards and downwards in pixels or in data coordinates.
pub(super) type Point = (f64, f64);
/// Left, top, right and bottom.
pub(super) type Frame = [f64; 4];

/// Width of a curve.
pub(super) const LINE: f64 = 11.0 / 3.0;
/// Marker of a series: filled with a solid line or none, hollow with a dashed or dotted line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// No marker.
    None,
    /// Circle.
    Circle,
    /// Square.
    Square,
    /// Upward triangle.
    Triangle,
    /// Diamond.
    Diamond,
    /// Diagonal cross.
    Cross,
    /// Small circle, for what should not draw the eye.
    Dot,
    /// Ring about the marker of another series.
    Ring,
}

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
    /// An image of [`FINE`](super::raster::FINE) times the pixels along each side, which SVG leaves out.
    Image { image: RgbImage, at: Point },
    /// From here on shapes are seen only within a frame, or everywhere.
    Clip(Option<Frame>),
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
