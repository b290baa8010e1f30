//! Marks in metres along three edges of the window about a body.

use super::super::SOLID;
use super::super::axes::{Axis, TICK};
use super::super::canvas::{Block, Canvas, INK, LABEL, Point, SMALL, between};
use super::camera::{Place, Up};
use super::surface::Screen;

/// Lengths of ticks, and distance of an axis' label from those of its ticks.
const MARK: f64 = 10.0;
const GAP: f64 = 8.0;
/// Heights of a tick's label and of a line of text.
const DIGITS: f64 = 24.0;
const LINE_HEIGHT: f64 = 40.0;
/// An axis shorter than this, in pixels, has no ticks.
const SHORT: f64 = 60.0;

/// An edge of the window.
pub(super) struct Ruler {
    /// Its axis, and its ends in the picture.
    pub(super) axis: usize,
    ends: [Point; 2],
    /// Direction away from the body, of unit length.
    away: Point,
    scale: Axis,
}

impl Ruler {
    /// Along x and the other horizontal axis on the sides near the eye, and up the edge on the left.
    pub(super) fn all(screen: &Screen, window: &[(f64, f64); 3], up: Up) -> [Self; 3] {
        let (rise, across) = (up.index(), up.across());
        let middle = window.map(|(lo, hi)| (lo + hi) / 2.0);
        let direction = |axis: usize| {
            let mut step = [0.0; 3];
            step[axis] = 1.0;
            screen.view.project(step)
        };
        let end = |axis: usize, sign: f64| {
            if sign >= 0.0 {
                window[axis].1
            } else {
                window[axis].0
            }
        };
        let near = |axis: usize| end(axis, direction(axis)[2] + 1e-9);
        let left = |axis: usize| end(axis, -direction(axis)[0] + 1e-9 * direction(axis)[2]);
        let edge = |axis: usize, fixed: [(usize, f64); 2]| {
            let mut from = middle;
            for (other, value) in fixed {
                from[other] = value;
            }
            let to = |value: f64| {
                let mut place = from;
                place[axis] = value;
                place
            };
            Self::new(
                screen,
                window[axis],
                axis,
                [window[axis].0, window[axis].1].map(to),
                middle,
            )
        };
        let low = (rise, window[rise].0);
        [
            edge(0, [(across, near(across)), low]),
            edge(across, [(0, near(0)), low]),
            edge(rise, [(0, left(0)), (across, left(across))]),
        ]
    }

    fn new(screen: &Screen, range: Point, axis: usize, ends: [Place; 2], middle: Place) -> Self {
        let flat = |at: Place| (screen.place(at)[0], screen.place(at)[1]);
        let ends = ends.map(flat);
        let along = (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1);
        let length = along.0.hypot(along.1);
        // Across the edge, to the side where the body is not.
        let across = (along.1 / length.max(1e-9), -along.0 / length.max(1e-9));
        let (edge, body) = (between(ends[0], ends[1], 0.5), flat(middle));
        let side = (edge.0 - body.0) * across.0 + (edge.1 - body.1) * across.1;
        let away = if side < 0.0 {
            (-across.0, -across.1)
        } else {
            across
        };
        let upright = along.1.abs() > along.0.abs();
        Self {
            axis,
            ends,
            away,
            scale: Axis::new(range, false, length.max(1.0), upright),
        }
    }

    /// Its ticks: part of the length, and label.
    fn marks(&self) -> Vec<(f64, String)> {
        let length = self.scale.length;
        let marks = self
            .scale
            .marks()
            .map(|(at, label)| (at / length, label.to_owned()));
        if length < SHORT {
            Vec::new()
        } else {
            marks.collect()
        }
    }

    /// Values of the ticks.
    pub(super) fn values(&self) -> Vec<f64> {
        let (lo, hi) = self.scale.range;
        self.marks()
            .into_iter()
            .map(|(part, _)| lo + part * (hi - lo))
            .collect()
    }

    /// Whether labels stand beside the edge; else below.
    fn beside(&self) -> bool {
        self.away.0.abs() > 0.45
    }

    /// The label with the range, where no tick tells it.
    fn label(&self, label: &str) -> String {
        let (lo, hi) = self.scale.range;
        match self.marks().is_empty() {
            true => format!("{label}: {lo} … {hi}"),
            false => label.to_owned(),
        }
    }

    /// Distance of the axis' label from the edge.
    fn beyond(&self) -> f64 {
        let ticks = match (self.marks().is_empty(), self.beside()) {
            (true, _) => 0.0,
            (_, true) => self.scale.label_width() + GAP,
            (_, false) => DIGITS + GAP,
        };
        TICK + ticks
    }

    /// Where the axis' label begins, from the corner of the panel: beside the far end of an edge that recedes.
    fn label_place(&self, label: &str) -> Point {
        let middle = between(self.ends[0], self.ends[1], 0.5);
        match (self.beside(), self.away.0 > 0.0) {
            (true, true) => (self.ends[0].0.max(self.ends[1].0) + self.beyond(), middle.1),
            (true, false) => (middle.0 - self.beyond(), middle.1),
            _ => {
                // Clear of the ticks' labels, which go down along a tilted edge.
                let tilt = (self.away.0 / self.away.1).abs();
                let clear = tilt * LABEL.width(&self.label(label)) / 2.0;
                (middle.0, middle.1 + self.beyond() + clear)
            }
        }
    }

    /// Room for its labels left of, right of and below a panel of a size.
    pub(super) fn room(&self, label: &str, (wide, high): Point) -> [f64; 3] {
        let place = self.label_place(label);
        let width = LABEL.width(&self.label(label));
        let [left, right, below] = match (self.beside(), self.away.0 > 0.0) {
            (true, true) => [0.0, place.0 + width, place.1 + LINE_HEIGHT / 2.0],
            (true, false) => [place.0 - LINE_HEIGHT, 0.0, place.1],
            _ => [0.0, place.0 + width / 2.0, place.1 + LINE_HEIGHT],
        };
        let lowest = self.ends[0].1.max(self.ends[1].1) + TICK + DIGITS;
        [-left, right - wide, below.max(lowest) - high].map(|room| room.max(0.0))
    }

    /// Draws it into a panel whose left upper corner is given, with labels if asked for.
    pub(super) fn draw(&self, canvas: &mut Canvas, corner: Point, label: Option<&str>) {
        let at = |p: Point| (corner.0 + p.0, corner.1 + p.1);
        let out = |p: Point, (x, y): Point, length: f64| (p.0 + length * x, p.1 + length * y);
        let [from, to] = self.ends.map(at);
        canvas.stroke(&[from, to], 2.0, INK, SOLID);
        let side = if self.beside() {
            (self.away.0.signum(), 0.0)
        } else {
            (0.0, self.away.1.signum())
        };
        let anchor = (0.5 - 0.5 * side.0, 0.5 - 0.5 * side.1);
        for (part, text) in self.marks() {
            let foot = between(from, to, part);
            canvas.stroke(&[foot, out(foot, self.away, MARK)], 2.0, INK, SOLID);
            if label.is_some() {
                canvas.text(&text, out(foot, side, TICK), SMALL, anchor, false);
            }
        }
        let Some(label) = label else {
            return;
        };
        let (place, label) = (at(self.label_place(label)), self.label(label));
        if side.0 < 0.0 {
            let block = Block::new(&label, LABEL, f64::INFINITY);
            canvas.block(&block, (place.0 - block.height(), place.1), true);
        } else {
            canvas.text(&label, place, LABEL, anchor, false);
        }
    }
}
