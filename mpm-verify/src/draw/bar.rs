//! The colour bar of a figure.

use super::SOLID;
use super::axes::{Axis, TICK};
use super::canvas::Canvas;
use super::colour::{INK, Rgb};
use super::font::SMALL;
use super::shape::Point;

/// Width of the colour bar and height of its triangular ends, in pixels.
pub(super) const BAR: f64 = 36.0;
pub(super) const BAR_TIP: f64 = 32.0;

/// Colour of a value on the scale of a range.
pub(super) type Colouring = fn(f64, Point) -> Rgb;

/// Draws the colour bar, triangular at an end that values exceed, with its ticks.
pub(super) fn draw_bar(
    canvas: &mut Canvas,
    (scale, colouring): (&Axis, Colouring),
    beyond: [bool; 2],
    (x, bottom): Point,
) {
    let (lo, hi) = scale.range;
    let (top, tip, right) = (bottom - scale.length, x + BAR / 2.0, x + BAR);
    for k in 0..scale.length as usize {
        let (y, part) = (bottom - k as f64, (k as f64 + 0.5) / scale.length);
        let colour = colouring(lo + part * (hi - lo), scale.range);
        canvas.rectangle([x, y - 1.0, right, y], colour, 1.0);
    }
    let peak = |end: usize| if beyond[end] { BAR_TIP } else { 0.0 };
    let lower = [(right, bottom), (tip, bottom + peak(0)), (x, bottom)];
    let upper = [(x, top), (tip, top - peak(1)), (right, top)];
    for (end, corners) in [(lo, lower), (hi, upper)] {
        canvas.polygon(&corners, colouring(end, scale.range));
    }
    let outline = [lower, upper].concat();
    canvas.stroke(&[&outline[..], &outline[..1]].concat(), 2.0, INK, SOLID);
    for (y, label) in scale.marks().map(|m| (bottom - m.0, m.1)) {
        canvas.rectangle([right, y - 1.0, right + 10.0, y + 1.0], INK, 1.0);
        canvas.text(label, (right + TICK, y), SMALL, (0.0, 0.5), false);
    }
}
