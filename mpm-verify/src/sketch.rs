//! The geometry of a problem, for a reader: shapes in the problem's own coordinates (m).

/// A point (m).
pub type Point = [f64; 2];

/// A shape of a sketch.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// The body.
    Body(Vec<Point>),
    /// A side that is held, hatched on its left, seen from the first point to the second.
    Held(Point, Point),
    /// A load, with the arrow's tip at the second point.
    Load(Point, Point),
    /// A length, measured along a line beside the body.
    Length {
        /// One end.
        from: Point,
        /// The other.
        to: Point,
        /// Text beside the line.
        label: String,
    },
    /// A place where something is measured.
    Probe {
        /// Where.
        at: Point,
        /// Text beside it.
        label: String,
    },
    /// Text.
    Note {
        /// Where its middle is.
        at: Point,
        /// The text.
        text: String,
    },
}

impl Shape {
    /// A length from one point to another.
    #[must_use]
    pub fn length(from: Point, to: Point, label: &str) -> Self {
        Self::Length { from, to, label: label.to_owned() }
    }

    /// Text about a point.
    #[must_use]
    pub fn note(at: Point, text: &str) -> Self {
        Self::Note { at, text: text.to_owned() }
    }
}

/// A sketch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sketch {
    /// Shapes, the last on top.
    pub shapes: Vec<Shape>,
    /// In words, for those who can't see it.
    pub description: &'static str,
}
