//! Markers of series.

use super::colour::{Rgb, WHITE};
use super::page::{Page, Point, fine, ink, spot};
use plotters::element::Circle;
use plotters::style::Color;
use std::f64::consts::TAU;

/// Width of a curve.
pub(super) const LINE: f64 = 11.0 / 3.0;
/// Width of a marker's white rim, and of the line of a hollow one.
const RIM: f64 = 2.0;
const OUTLINE: f64 = 3.4;

/// Marker of a series: filled with a solid line or none, hollow with a dashed or dotted line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    None,
    Circle,
    Square,
    /// Upward triangle.
    Triangle,
    Diamond,
    /// Diagonal cross.
    Cross,
    /// Small circle, for what should not draw the eye.
    Dot,
    /// Ring about the marker of another series.
    Ring,
}

impl Page<'_> {
    /// Draws a marker with a white rim, filled or hollow.
    pub(super) fn marker(&mut self, marker: Marker, at: Point, colour: Rgb, hollow: bool) {
        // A regular polygon: number of corners, angle of the first, and radius; of a circle, no corners.
        let (corners, turn, size) = match marker {
            Marker::None => return,
            Marker::Cross => {
                for (width, colour) in [(LINE + 2.0 * RIM, WHITE), (LINE + 0.7, colour)] {
                    for side in [8.5, -8.5] {
                        let ends = [(at.0 - 8.5, at.1 - side), (at.0 + 8.5, at.1 + side)];
                        self.line(&ends, width, colour, &[]);
                    }
                }
                return;
            }
            Marker::Ring => {
                let style = ink(colour, 1.0).stroke_width(fine(2.4).unsigned_abs());
                return self.put(&Circle::new(spot(at), fine(16.0), style));
            }
            Marker::Dot => (0, 0.0, 5.0),
            Marker::Circle => (0, 0.0, 10.0),
            Marker::Square => (4, 0.125, 12.8),
            Marker::Triangle => (3, 0.25, 14.0),
            Marker::Diamond => (4, 0.25, 13.0),
        };
        let layers = [(RIM, WHITE), (0.0, colour), (-OUTLINE, WHITE)];
        for (outset, colour) in layers.into_iter().take(if hollow { 3 } else { 2 }) {
            if corners == 0 {
                let style = ink(colour, 1.0).filled();
                self.put(&Circle::new(spot(at), fine(size + outset), style));
                continue;
            }
            let radius = size + outset / (0.5 * TAU / f64::from(corners)).cos();
            let angle = |k: i32| (turn + f64::from(k) / f64::from(corners)) * TAU;
            let corner = |k| (at.0 + radius * angle(k).cos(), at.1 - radius * angle(k).sin());
            self.area(&(0..corners).map(corner).collect::<Vec<_>>(), colour, 1.0);
        }
    }
}
