//! The geometry of a problem, for a reader: shapes in the problem's own coordinates (m).

use std::f64::consts::{PI, TAU};

/// A point (m).
pub(crate) type Point = [f64; 2];

/// A shape of a sketch.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    Body(Vec<Point>),
    /// A side that is held, hatched on its left, seen from the first point to the second.
    Held(Point, Point),
    /// A load, with the arrow's tip at the second point.
    Load(Point, Point),
    /// A length, measured along a line beside the body between two points, with its text.
    Length(Point, Point, String),
    /// A place where something is measured, with its name.
    Probe(Point, String),
    /// Text with its middle at a point.
    Note(Point, String),
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sketch {
    /// Shapes, the last on top.
    pub shapes: Vec<Shape>,
    /// In words, for those who can't see it.
    pub description: &'static str,
}

impl Sketch {
    /// Without shapes yet.
    pub(crate) fn of(description: &'static str) -> Self {
        Self { shapes: Vec::new(), description }
    }

    /// A sketch of a body of a width and a height, whose lower left corner is the origin.
    pub(crate) fn block(description: &'static str, [width, height]: [f64; 2]) -> Self {
        Self::of(description).body([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
    }

    fn with(mut self, shape: Shape) -> Self {
        self.shapes.push(shape);
        self
    }

    pub(crate) fn body(self, corners: impl IntoIterator<Item = Point>) -> Self {
        self.with(Shape::Body(corners.into_iter().collect()))
    }

    pub(crate) fn disc(self, [x, y]: Point, radius: f64) -> Self {
        let angles = (0..48).map(|k| f64::from(k) / 48.0 * TAU);
        self.body(angles.map(|angle| [x + radius * angle.cos(), y + radius * angle.sin()]))
    }

    /// Adds the upper half of an ellipse, by the middle of its straight side and half axes.
    pub(crate) fn half_ellipse(self, middle: f64, [a, b]: [f64; 2]) -> Self {
        let angles = (0..=24).map(|k| PI * f64::from(k) / 24.0);
        self.body(angles.map(|angle| [middle + a * angle.cos(), b * angle.sin()]))
    }

    /// Adds a side that is held: see [`Shape::Held`].
    pub(crate) fn held(self, from: Point, to: Point) -> Self {
        self.with(Shape::Held(from, to))
    }

    /// Adds the sides that are held between these points, one after another.
    pub(crate) fn held_along(self, points: &[Point]) -> Self {
        points.windows(2).fold(self, |sketch, side| sketch.held(side[0], side[1]))
    }

    /// Adds a load, with the arrow's tip at `to`.
    pub(crate) fn load(self, from: Point, to: Point) -> Self {
        self.with(Shape::Load(from, to))
    }

    /// Adds upright loads at abscissae `at`, each from the first of two heights to the second.
    pub(crate) fn loads(self, at: impl Iterator<Item = f64>, [from, to]: [f64; 2]) -> Self {
        at.fold(self, |sketch, x| sketch.load([x, from], [x, to]))
    }

    pub(crate) fn length(self, from: Point, to: Point, label: &str) -> Self {
        self.with(Shape::Length(from, to, label.to_owned()))
    }

    /// Adds a place where something is measured.
    pub(crate) fn probe(self, at: Point, label: &str) -> Self {
        self.with(Shape::Probe(at, label.to_owned()))
    }

    pub(crate) fn note(self, at: Point, text: &str) -> Self {
        self.with(Shape::Note(at, text.to_owned()))
    }
}
