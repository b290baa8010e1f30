//! The geometry of a case as a vector picture, in the colour of the text around it.

use super::between;
use super::page::{Frame, clipped};
use crate::sketch::{Point, Shape, Sketch};
use quick_xml::escape::escape;
use std::fmt::Write;

/// Longest side of what is drawn, without labels (pixels, as all lengths here).
const SPAN: f64 = 440.0;
const MARGIN: f64 = 6.0;
const FONT: f64 = 14.0;
/// Width of a character, on the safe side.
const GLYPH: f64 = 0.6 * FONT;
/// Distance of hatch lines, which is their depth too.
const HATCH: f64 = 9.0;
/// Length and half the width of an arrow's head.
const HEAD: (f64, f64) = (9.0, 3.2);
/// Half the length of the ticks at the ends of a dimension line, and room between a witness line and its corner.
const TICK: f64 = 5.0;
const DOT: f64 = 2.6;
/// Widths of lines.
const BOLD: f64 = 2.4;
const PLAIN: f64 = 1.4;
const FINE: f64 = 0.7;

/// The sketch as an SVG element; y points up in the problem, down in the picture.
pub(crate) fn svg(sketch: &Sketch, title: &str) -> String {
    let corners = sketch.shapes.iter().flat_map(|shape| match shape {
        Shape::Body(corners) => corners.clone(),
        Shape::Held(from, to) | Shape::Load(from, to) | Shape::Length(from, to, _) => {
            vec![*from, *to]
        }
        Shape::Probe(at, _) | Shape::Note(at, _) => vec![*at],
    });
    let [left, bottom, right, top] = around(corners.map(|[x, y]| [x, y, x, y]));
    let scale = SPAN / (right - left).max(top - bottom);
    let place = |p: &Point| [p[0] * scale, -p[1] * scale];
    let body = sketch.shapes.iter().filter_map(|shape| match shape {
        Shape::Body(corners) => Some(corners.iter().map(place)),
        _ => None,
    });
    let mut drawing =
        Drawing { body: body.flatten().collect(), lines: Vec::new(), boxes: Vec::new(), elements: String::new() };
    for shape in &sketch.shapes {
        match shape {
            Shape::Body(corners) => drawing.body(&corners.iter().map(place).collect::<Vec<_>>()),
            Shape::Held(from, to) => drawing.held(place(from), place(to)),
            Shape::Load(from, to) => drawing.load(place(from), place(to)),
            Shape::Length(from, to, label) => drawing.length(place(from), place(to), label),
            Shape::Probe(at, _) => drawing.dot(place(at)),
            Shape::Note(at, text) => drawing.text(place(at), [0.0, 0.0], text),
        }
    }
    // The labels of probes come last: they go where nothing else is.
    for shape in &sketch.shapes {
        if let Shape::Probe(at, label) = shape {
            drawing.probe_label(place(at), label);
        }
    }
    drawing.finish(title, sketch.description)
}

fn along(a: Point, direction: Point, length: f64) -> Point {
    [a[0] + length * direction[0], a[1] + length * direction[1]]
}

/// Unit vector from one point to another, and their distance.
fn towards(a: Point, b: Point) -> (Point, f64) {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = x.hypot(y);
    ([x / length, y / length], length)
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// To the left of a direction, for a viewer of the picture.
fn left([x, y]: Point) -> Point {
    [y, -x]
}

/// The frame around frames.
fn around(frames: impl Iterator<Item = Frame>) -> Frame {
    let both = |a: Frame, b: Frame| {
        let (low, high) = (f64::min, f64::max);
        [low(a[0], b[0]), low(a[1], b[1]), high(a[2], b[2]), high(a[3], b[3])]
    };
    frames.reduce(both).unwrap_or_default()
}

fn overlap(a: Frame, b: Frame) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Whether a line passes through a frame.
fn crosses(&[from, to]: &[Point; 2], frame: Frame) -> bool {
    !clipped(&[(from[0], from[1]), (to[0], to[1])], frame).is_empty()
}

/// The box of a text that touches a point from the side that `direction` shows, or lies about it.
fn beside(at: Point, direction: Point, text: &str) -> Frame {
    let (width, height) = (text.chars().count() as f64 * GLYPH, 1.2 * FONT);
    let shift = |side: f64, size: f64| match side {
        s if s.abs() > 0.5 => s.signum() * size / 2.0,
        s => s * size,
    };
    let (x, y) = (at[0] + shift(direction[0], width), at[1] + shift(direction[1], height));
    [x - width / 2.0, y - height / 2.0, x + width / 2.0, y + height / 2.0]
}

/// Text with the word after an underscore as a subscript.
fn subscripted(text: &str) -> String {
    let Some((head, tail)) = text.split_once('_') else { return escape(text).into_owned() };
    let end = tail.find(|c: char| !c.is_alphanumeric());
    let parts = tail.split_at(end.unwrap_or(tail.len()));
    let [head, index, rest] = [head, parts.0, parts.1].map(escape);
    format!("{head}<tspan dy=\"3\" font-size=\"75%\">{index}</tspan><tspan dy=\"-3\">{rest}</tspan>")
}

struct Drawing {
    /// Corners of all bodies.
    body: Vec<Point>,
    /// Things that labels must not lie on.
    lines: Vec<[Point; 2]>,
    boxes: Vec<Frame>,
    elements: String,
}

impl Drawing {
    fn line(&mut self, a: Point, b: Point, width: f64) {
        self.lines.push([a, b]);
        let _ = writeln!(
            self.elements,
            r#"<line x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}" stroke-width="{width}"/>"#,
            a[0], a[1], b[0], b[1]
        );
    }

    fn polygon(&mut self, corners: &[Point], style: &str) {
        let corner = |[x, y]: &Point| format!("{x:.1},{y:.1}");
        let corners: Vec<String> = corners.iter().map(corner).collect();
        let points = corners.join(" ");
        let _ = writeln!(self.elements, r#"<polygon points="{points}" fill="currentColor" {style}/>"#);
    }

    fn body(&mut self, corners: &[Point]) {
        let next = corners.iter().cycle().skip(1);
        self.lines.extend(corners.iter().zip(next).map(|(a, b)| [*a, *b]));
        let style = r#"fill-opacity="0.1" stroke-linejoin="round""#;
        self.polygon(corners, &format!(r#"{style} stroke-width="{PLAIN}""#));
    }

    /// A held side, with strokes on its left that start on it and lean back.
    fn held(&mut self, from: Point, to: Point) {
        self.line(from, to, BOLD);
        let (direction, length) = towards(from, to);
        let strokes = (length / HATCH).floor();
        for k in 1..=strokes as u32 {
            let start = along(from, direction, length * f64::from(k) / strokes);
            let end = along(along(start, direction, -HATCH), left(direction), HATCH);
            self.line(start, end, FINE);
        }
    }

    fn head(&mut self, from: Point, tip: Point) {
        let (direction, _) = towards(from, tip);
        let root = along(tip, direction, -HEAD.0);
        let side = |half: f64| along(root, left(direction), half);
        self.polygon(&[tip, side(HEAD.1), side(-HEAD.1)], r#"stroke="none""#);
    }

    fn load(&mut self, from: Point, tip: Point) {
        // The line ends within the head, whose tip it would blunt.
        let (direction, _) = towards(from, tip);
        self.line(from, along(tip, direction, -0.5 * HEAD.0), PLAIN);
        self.head(from, tip);
        let [x, y] = tip;
        let (half, reach) = (HEAD.1, HEAD.0 / 2.0);
        self.boxes.push([x - half, y - reach, x + half, y + reach]);
    }

    /// A dimension line, with witness lines to the corners of the body that it measures, and its label
    /// on the far side.
    fn length(&mut self, from: Point, to: Point, label: &str) {
        let (direction, length) = towards(from, to);
        let middle = along(from, direction, 0.5 * length);
        let mut outwards = left(direction);
        let body = self.body.iter().map(|p| dot(*p, outwards)).sum::<f64>();
        if body > dot(middle, outwards) * self.body.len() as f64 {
            outwards = outwards.map(|x| -x);
        }
        self.line(from, to, FINE);
        for (end, other) in [(from, to), (to, from)] {
            self.head(other, end);
            let distance = |p: &Point| dot([end[0] - p[0], end[1] - p[1]], outwards);
            let level = |p: &&Point| dot([end[0] - p[0], end[1] - p[1]], direction).abs() < 0.1;
            let nearest = self.body.iter().filter(level).map(distance);
            let reach = nearest.reduce(f64::min).map_or(TICK, |nearest| nearest - TICK);
            let (inner, outer) = (along(end, outwards, -reach), along(end, outwards, TICK));
            self.line(inner, outer, FINE);
        }
        self.text(along(middle, outwards, TICK), outwards, label);
    }

    fn dot(&mut self, [x, y]: Point) {
        let reach = DOT + 1.0;
        self.boxes.push([x - reach, y - reach, x + reach, y + reach]);
        let _ =
            writeln!(self.elements, r#"<circle cx="{x:.1}" cy="{y:.1}" r="{DOT}" fill="currentColor" stroke="none"/>"#);
    }

    /// Text beside a point, on the side that `towards` shows, or on it.
    fn text(&mut self, at: Point, towards: Point, text: &str) {
        let frame @ [left, top, right, bottom] = beside(at, towards, text);
        self.boxes.push(frame);
        let (x, y) = between((left, top), (right, bottom), 0.5);
        let _ = writeln!(
            self.elements,
            r#"<text x="{x:.1}" y="{:.1}" text-anchor="middle" fill="currentColor" stroke="none">{}</text>"#,
            y + 0.35 * FONT,
            subscripted(text)
        );
    }

    /// A label beside a probe, at the first of many places where it hides nothing.
    fn probe_label(&mut self, at: Point, label: &str) {
        let eighths = [7, 0, 6, 5, 4, 1, 2, 3].map(|k| f64::from(k) * std::f64::consts::FRAC_PI_4);
        let directions = eighths.map(|angle| [angle.cos(), angle.sin()]);
        let distances = [3.0, 7.0, 12.0, 20.0].into_iter();
        let places = distances.flat_map(|d| directions.map(|way| (along(at, way, DOT + d), way)));
        let hidden = |(place, direction): &(Point, Point)| {
            let frame = beside(*place, *direction, label);
            let lines = self.lines.iter().filter(|line| crosses(line, frame)).count();
            lines + self.boxes.iter().filter(|b| overlap(frame, **b)).count()
        };
        if let Some((place, direction)) = places.min_by_key(hidden) {
            self.text(place, direction, label);
        }
    }

    fn finish(self, title: &str, description: &str) -> String {
        let ends = self.lines.iter().flatten().map(|[x, y]| [*x, *y, *x, *y]);
        let [left, top, right, bottom] = around(ends.chain(self.boxes.iter().copied()));
        let (width, height) = (right - left + 2.0 * MARGIN, bottom - top + 2.0 * MARGIN);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"{:.0} {:.0} {width:.0} {height:.0}\" \
             width=\"{width:.0}\" height=\"{height:.0}\" fill=\"none\" stroke=\"currentColor\" font-size=\"{FONT}\">\n\
             <title>{}</title>\n<desc>{}</desc>\n{}</svg>\n",
            left - MARGIN,
            top - MARGIN,
            escape(title),
            escape(description),
            self.elements
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quick_xml::events::Event;

    /// A tapered membrane, clamped on its left.
    fn membrane() -> Sketch {
        Sketch::of("a \"<'&")
            .body([[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]])
            .held([0.0, 0.0], [0.0, 44.0])
            .load([51.0, 45.0], [51.0, 59.0])
            .length([-9.0, 0.0], [-9.0, 44.0], "44")
            .length([0.0, -6.0], [48.0, -6.0], "48")
            .note([20.0, 24.0], "a < b")
            .probe([48.0, 60.0], "u_A")
            .probe([24.0, 22.0], "<script>")
    }

    /// An attribute of an element.
    fn number(element: &str, name: &str) -> f64 {
        let after = element.split(&format!(" {name}=\"")).nth(1).unwrap();
        after.split('"').next().unwrap().parse().unwrap()
    }

    #[test]
    fn the_hatch_lies_on_the_left_seen_from_the_first_point() {
        let text = svg(&membrane(), "");
        let oblique = |l: &&str| {
            let runs = |from, to| number(l, from) != number(l, to);
            l.starts_with("<line") && runs("x1", "x2") && runs("y1", "y2")
        };
        let ends = text.lines().filter(oblique).map(|l| number(l, "x2"));
        let ends: Vec<f64> = ends.collect();
        assert!(ends.len() > 10 && ends.iter().all(|x| *x < 0.0), "{ends:?}");
    }

    #[test]
    fn labels_hide_no_other_label_and_no_line() {
        let text = svg(&membrane(), "");
        let frame = |l: &str| {
            let label: String = l.split(['<', '>']).skip(2).step_by(2).collect();
            let (x, y) = (number(l, "x"), number(l, "y") - 0.35 * FONT);
            beside([x, y], [0.0, 0.0], &label.replace("&lt;", "<").replace("&gt;", ">"))
        };
        let labels = text.lines().filter(|l| l.starts_with("<text"));
        let frames: Vec<Frame> = labels.map(frame).collect();
        assert_eq!(frames.len(), 5);
        let lines = text.lines().filter(|l| l.starts_with("<line"));
        let ends = |l: &str| ["x1", "y1", "x2", "y2"].map(|n| number(l, n));
        let lines: Vec<_> = lines.map(ends).map(|[a, b, c, d]| [[a, b], [c, d]]).collect();
        for (k, label) in frames.iter().enumerate() {
            assert!(!frames[..k].iter().any(|other| overlap(*label, *other)), "{k}");
            assert!(!lines.iter().any(|line| crosses(line, *label)), "{k}");
        }
    }

    #[test]
    fn labels_are_escaped_and_the_picture_is_well_formed() {
        let text = svg(&membrane(), "<script>\"&'</text>");
        let mut reader = quick_xml::Reader::from_str(&text);
        loop {
            match reader.read_event().unwrap() {
                Event::Start(e) => assert_ne!(e.name().as_ref(), "script"),
                Event::Eof => break,
                _ => {}
            }
        }
    }
}
