//! Markers of series.

use super::colour::{Rgb, WHITE};
use super::page::{Drawn, Medium, Page, Point, area, fine, ink, spot, stroke};
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

impl Marker {
    /// Draws it with a white rim, filled or hollow.
    pub(super) fn draw<B: Medium>(
        self,
        page: &Page<B>,
        at: Point,
        colour: Rgb,
        hollow: bool,
    ) -> Drawn<B> {
        // A regular polygon: number of corners, angle of the first, and radius; of a circle, no corners.
        let (corners, turn, size) = match self {
            Self::None => return Ok(()),
            Self::Cross => {
                for (width, colour) in [(LINE + 2.0 * RIM, WHITE), (LINE + 0.7, colour)] {
                    for side in [8.5, -8.5] {
                        let ends = [(at.0 - 8.5, at.1 - side), (at.0 + 8.5, at.1 + side)];
                        stroke(page, &ends, width, colour, &[])?;
                    }
                }
                return Ok(());
            }
            Self::Ring => {
                let style = ink(colour).stroke_width(fine(2.4).unsigned_abs());
                return page.draw(&Circle::new(spot(at), fine(16.0), style));
            }
            Self::Dot => (0, 0.0, 5.0),
            Self::Circle => (0, 0.0, 10.0),
            Self::Square => (4, 45.0, 12.8),
            Self::Triangle => (3, 90.0, 14.0),
            Self::Diamond => (4, 90.0, 13.0),
        };
        let layers = [(RIM, WHITE), (0.0, colour), (-OUTLINE, WHITE)];
        for (outset, colour) in layers.into_iter().take(if hollow { 3 } else { 2 }) {
            if corners == 0 {
                let disc = Circle::new(spot(at), fine(size + outset), ink(colour).filled());
                page.draw(&disc)?;
                continue;
            }
            let radius = size + outset / (0.5 * TAU / f64::from(corners)).cos();
            let angle = |k: i32| f64::to_radians(turn) + f64::from(k) / f64::from(corners) * TAU;
            let corner = |k| {
                (
                    at.0 + radius * angle(k).cos(),
                    at.1 - radius * angle(k).sin(),
                )
            };
            area(
                page,
                &(0..corners).map(corner).collect::<Vec<_>>(),
                colour,
                1.0,
            )?;
        }
        Ok(())
    }
}
