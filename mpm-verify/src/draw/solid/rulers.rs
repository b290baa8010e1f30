//! Marks in metres along three edges of the window about a body.

use super::super::axes::{Axis, TICK};
use super::super::canvas::Canvas;
use super::super::colour::INK;
use super::super::font::{Block, LABEL, SMALL};
use super::super::shape::Point;
use super::super::{SOLID, between};
use super::surface::{Place, Screen};

/// Lengths of ticks, and distance of an axis' label from those of its ticks.
const MARK: f64 = 10.0;
const GAP: f64 = 10.0;
/// Heights of a tick's label and of a line of text.
const DIGITS: f64 = 24.0;
const LINE_HEIGHT: f64 = 40.0;
/// An axis shorter than this, in pixels, has its range in its label instead of ticks.
const SHORT: f64 = 60.0;

/// An edge of the window.
pub(super) struct Ruler {
    /// Its ends in the picture.
    ends: [Point; 2],
    /// Direction away from the body, of unit length, and where labels stand: beside the edge or below.
    away: Point,
    side: Point,
    scale: Axis,
    /// Parts of the length, with labels.
    ticks: Vec<(f64, String)>,
    label: String,
}

impl Ruler {
    /// Along x and z on the sides near the eye, and up the edge on the left; in the order of the axes.
    pub(super) fn all(screen: &Screen, window: &[(f64, f64); 3]) -> [Self; 3] {
        let direction =
            |axis: usize| screen.turn([0, 1, 2].map(|k| f64::from(u8::from(k == axis))));
        let end = |axis: usize, sign: f64| match sign >= 0.0 {
            true => window[axis].1,
            false => window[axis].0,
        };
        let near = |axis: usize| end(axis, direction(axis)[2] + 1e-9);
        let left = |axis: usize| end(axis, -direction(axis)[0] + 1e-9 * direction(axis)[2]);
        let low = window[1].0;
        let fixed = [
            [0.0, low, near(2)],
            [left(0), 0.0, left(2)],
            [near(0), low, 0.0],
        ];
        [0, 1, 2].map(|axis| {
            let at = |value: f64| {
                let mut place = fixed[axis];
                place[axis] = value;
                place
            };
            let ends = [at(window[axis].0), at(window[axis].1)];
            let middle = window.map(|(lo, hi)| (lo + hi) / 2.0);
            Self::new(
                screen,
                window[axis],
                ends,
                middle,
                ["x (m)", "y (m)", "z (m)"][axis],
            )
        })
    }

    fn new(screen: &Screen, range: Point, ends: [Place; 2], middle: Place, label: &str) -> Self {
        let flat = |at: Place| (screen.place(at)[0], screen.place(at)[1]);
        let (ends, body) = (ends.map(flat), flat(middle));
        let along = (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1);
        let length = along.0.hypot(along.1).max(1.0);
        // Across the edge, to the side where the body is not.
        let (across, edge) = (
            (along.1 / length, -along.0 / length),
            between(ends[0], ends[1], 0.5),
        );
        let outside = (edge.0 - body.0) * across.0 + (edge.1 - body.1) * across.1;
        let away = (across.0 * outside.signum(), across.1 * outside.signum());
        let upright = along.1.abs() > along.0.abs();
        let scale = Axis::new(range, false, length, upright);
        let marks = scale.marks().filter(|_| length >= SHORT);
        let ticks: Vec<_> = marks
            .map(|(at, text)| (at / length, text.to_owned()))
            .collect();
        Self {
            ends,
            away,
            side: match away.0.abs() > 0.45 {
                true => (away.0.signum(), 0.0),
                false => (0.0, away.1.signum()),
            },
            label: match ticks.is_empty() {
                true => format!("{label}: {} … {}", range.0, range.1),
                false => label.to_owned(),
            },
            scale,
            ticks,
        }
    }

    /// Where the label begins, from the corner of the panel.
    fn label_place(&self) -> Point {
        let middle = between(self.ends[0], self.ends[1], 0.5);
        let digits = match self.side.1 == 0.0 {
            true => self.scale.label_width(),
            false => DIGITS,
        };
        let ticks = if self.ticks.is_empty() {
            0.0
        } else {
            digits + GAP
        };
        if self.side.0 > 0.0 {
            // Beside the far end of an edge that recedes.
            let far = self.ends[0].0.max(self.ends[1].0);
            return (far + TICK + ticks, middle.1);
        }
        // Clear of the ticks' labels, which go down along a tilted edge.
        let clear = match self.side.1 == 0.0 {
            true => 0.0,
            false => {
                self.side.1 * (self.away.0 / self.away.1).abs() * LABEL.width(&self.label) / 2.0
            }
        };
        let out = TICK + ticks;
        (
            middle.0 + self.side.0 * out,
            middle.1 + self.side.1 * out + clear,
        )
    }

    /// Room for its labels left of, right of and below a panel of a size.
    pub(super) fn room(&self, (wide, high): Point) -> [f64; 3] {
        let (x, y) = self.label_place();
        let width = LABEL.width(&self.label);
        let (left, right, below) = match self.side {
            (side, _) if side > 0.0 => (0.0, x + width, y + LINE_HEIGHT / 2.0),
            (side, _) if side < 0.0 => (x - LINE_HEIGHT, 0.0, y),
            _ => (x - width / 2.0, x + width / 2.0, y + LINE_HEIGHT),
        };
        let lowest = self.ends[0].1.max(self.ends[1].1) + TICK + DIGITS;
        [-left, right - wide, below.max(lowest) - high].map(|room| room.max(0.0))
    }

    /// Draws it into a panel whose left upper corner is given, with labels if asked for.
    pub(super) fn draw(&self, canvas: &mut Canvas, corner: Point, labelled: bool) {
        let at = |p: Point| (corner.0 + p.0, corner.1 + p.1);
        let out = |p: Point, (x, y): Point, length: f64| (p.0 + length * x, p.1 + length * y);
        let [from, to] = self.ends.map(at);
        canvas.stroke(&[from, to], 2.0, INK, SOLID);
        let anchor = (0.5 - 0.5 * self.side.0, 0.5 - 0.5 * self.side.1);
        for (part, text) in &self.ticks {
            let foot = between(from, to, *part);
            canvas.stroke(&[foot, out(foot, self.away, MARK)], 2.0, INK, SOLID);
            if labelled {
                canvas.text(text, out(foot, self.side, TICK), SMALL, anchor, false);
            }
        }
        let place = at(self.label_place());
        if labelled && self.side.0 < 0.0 {
            let block = Block::new(&self.label, LABEL, f64::INFINITY);
            canvas.block(&block, (place.0 - block.height(), place.1), true);
        } else if labelled {
            canvas.text(&self.label, place, LABEL, anchor, false);
        }
    }
}
