//! Shapes as SVG, in whole pixels of the picture.

use super::between;
use super::colour::{INK, Rgb, channels};
use super::font::Font;
use super::shape::{Frame, Point, Shape, layers};
use plotters::prelude::{
    DrawingBackend, FontFamily, FontStyle, FontTransform, IntoTextStyle, RGBAColor, SVGBackend,
    ShapeStyle, TextStyle,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::fmt::Display;

/// A picture as an SVG document, in which text stays text.
///
/// # Errors
/// What the writer refuses.
pub(super) fn text(size: (u32, u32), shapes: &[Shape]) -> Result<String, String> {
    let mut document = String::new();
    let mut writer = Writer {
        backend: SVGBackend::with_string(&mut document, size),
        origin: (0.0, 0.0),
        frame: None,
    };
    let (width, height) = (f64::from(size.0), f64::from(size.1));
    let sheet = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    writer.area(&sheet, 0xFF_FFFF, 1.0)?;
    for shape in shapes {
        writer.shape(shape)?;
    }
    writer.backend.present().map_err(cause)?;
    drop(writer);
    Ok(document)
}

struct Writer<'a> {
    backend: SVGBackend<'a>,
    /// Where the origin of the shapes lies.
    origin: Point,
    /// Lines are seen within it.
    frame: Option<Frame>,
}

impl Writer<'_> {
    fn shape(&mut self, shape: &Shape) -> Result<(), String> {
        match shape {
            Shape::Area {
                corners,
                colour,
                opacity,
            } => self.area(corners, *colour, *opacity)?,
            Shape::Line {
                points,
                width,
                colour,
                pattern,
            } => {
                let style = ShapeStyle {
                    color: rgba(*colour, 1.0),
                    filled: false,
                    stroke_width: width.round() as u32,
                };
                let parts = match self.frame {
                    Some(frame) => within(points, frame),
                    None => vec![points.clone()],
                };
                // Dashes end flat here; round ends make them longer by the line's width.
                let lengths = pattern.iter().zip([*width, -width].into_iter().cycle());
                let lengths: Vec<f64> = lengths.map(|(length, more)| length + more).collect();
                for dash in parts.iter().flat_map(|part| dashes(part, &lengths)) {
                    let path: Vec<_> = dash.iter().map(|p| self.pixel(*p)).collect();
                    self.backend.draw_path(path, &style).map_err(cause)?;
                }
            }
            Shape::Mark {
                marker,
                at,
                colour,
                hollow,
            } => {
                self.origin = *at;
                for layer in layers(*marker, *colour, *hollow) {
                    self.shape(&layer)?;
                }
                self.origin = (0.0, 0.0);
            }
            Shape::Text {
                text,
                at,
                font,
                turned,
            } => self.line(text, *at, *font, *turned)?,
            Shape::Image { .. } => {}
            Shape::Clip(frame) => self.frame = *frame,
        }
        Ok(())
    }

    fn area(&mut self, corners: &[Point], colour: Rgb, opacity: f64) -> Result<(), String> {
        let corners: Vec<_> = corners.iter().map(|p| self.pixel(*p)).collect();
        let colour = rgba(colour, opacity);
        self.backend.fill_polygon(corners, &colour).map_err(cause)
    }

    fn line(&mut self, text: &str, at: Point, font: Font, turned: bool) -> Result<(), String> {
        // The writer sets text with its middle, half an ex above the baseline, at a point; an ex of these fonts is
        // 0.55 em. It divides sizes by 1.24.
        const MIDDLE: f64 = 0.5 * 0.55;
        const DIVISOR: f64 = 1.24;
        let up = MIDDLE * font.size;
        let (at, transform) = match turned {
            true => ((at.0 - up, at.1), FontTransform::Rotate270),
            false => ((at.0, at.1 - up), FontTransform::None),
        };
        let weight = match font.bold {
            true => FontStyle::Bold,
            false => FontStyle::Normal,
        };
        let family = FontFamily::Name("DejaVu Sans, Verdana, sans-serif");
        let ink = rgba(INK, 1.0);
        let style: TextStyle =
            (family, DIVISOR * font.size, weight).into_text_style(&self.backend.get_size());
        let style = style
            .transform(transform)
            .pos(Pos::new(HPos::Left, VPos::Center))
            .color(&ink);
        let at = self.pixel(at);
        self.backend.draw_text(text, &style, at).map_err(cause)
    }

    fn pixel(&self, (x, y): Point) -> (i32, i32) {
        let nearest = |v: f64| v.round() as i32;
        (nearest(x + self.origin.0), nearest(y + self.origin.1))
    }
}

fn cause(error: impl Display) -> String {
    error.to_string()
}

fn rgba(colour: Rgb, opacity: f64) -> RGBAColor {
    let [red, green, blue] = channels(colour);
    RGBAColor(red, green, blue, opacity)
}

/// The parts of a polyline within a frame.
fn within(points: &[Point], [left, top, right, bottom]: Frame) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        // The stretch of the segment that lies on the inner side of all four edges.
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for (at_a, at_b) in [
            (a.0 - left, b.0 - left),
            (right - a.0, right - b.0),
            (a.1 - top, b.1 - top),
            (bottom - a.1, bottom - b.1),
        ] {
            match (at_a >= 0.0, at_b >= 0.0) {
                (true, true) => {}
                (false, true) => enter = enter.max(at_a / (at_a - at_b)),
                (true, false) => leave = leave.min(at_a / (at_a - at_b)),
                (false, false) => leave = -1.0,
            }
        }
        if enter > leave {
            continue;
        }
        match parts.last_mut() {
            Some(part) if enter == 0.0 && part.last() == Some(&a) => {
                part.push(between(a, b, leave));
            }
            _ => parts.push(vec![between(a, b, enter), between(a, b, leave)]),
        }
    }
    parts
}

/// The dashes of a polyline: lengths of dashes and gaps follow one another in turn.
fn dashes(points: &[Point], pattern: &[f64]) -> Vec<Vec<Point>> {
    if pattern.is_empty() {
        return vec![points.to_vec()];
    }
    let (mut turn, mut left) = (0, pattern[0]);
    let mut all = vec![points[..1].to_vec()];
    for pair in points.windows(2) {
        let length = (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let at = between(pair[0], pair[1], gone / length);
            match (turn % 2, all.last_mut()) {
                (0, Some(dash)) => dash.push(at),
                _ => all.push(vec![at]),
            }
            turn += 1;
            left = pattern[turn % pattern.len()];
        }
        left -= length - gone;
        if let (0, Some(dash)) = (turn % 2, all.last_mut()) {
            dash.push(pair[1]);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::font::TITLE;
    use super::super::shape::Marker;
    use super::*;
    use quick_xml::events::Event;

    #[test]
    fn the_document_is_well_formed_and_lines_stay_in_their_frame() {
        let mut canvas = Canvas::new((100.0, 50.0));
        canvas.text("a < b & \"c\"", (1.0, 2.0), TITLE, (0.0, 0.0), true);
        canvas.clip(Some([0.0, 0.0, 50.0, 50.0]));
        let points = [(0.0, 0.0), (f64::NAN, 1.0), (5.0, 5.0), (9.0, 1e300)];
        canvas.stroke(&points, 2.0, INK, &[]);
        canvas.clip(None);
        canvas.marker(Marker::Circle, (3.0, 4.0), INK, true);
        let document = text(canvas.size, &canvas.shapes).unwrap();
        let mut reader = quick_xml::Reader::from_str(&document);
        let mut names = Vec::new();
        loop {
            match reader.read_event().unwrap() {
                Event::Start(e) | Event::Empty(e) => names.push(e.name().as_ref().to_owned()),
                Event::Eof => break,
                _ => {}
            }
        }
        let count = |name: &str| names.iter().filter(|n| n == &name).count();
        let names = ["svg", "text", "polyline", "polygon"];
        assert_eq!(names.map(count), [1, 1, 1, 4]);
        assert!(document.contains("points=\"5,5 5,50 \""), "{document}");
    }

    #[test]
    fn a_line_is_cut_at_its_frame() {
        let zigzag = [
            (-5.0, 5.0),
            (5.0, 5.0),
            (5.0, 15.0),
            (8.0, 15.0),
            (8.0, 2.0),
        ];
        let parts = within(&zigzag, [0.0, 0.0, 10.0, 10.0]);
        let first = vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)];
        assert_eq!(parts, [first, vec![(8.0, 10.0), (8.0, 2.0)]]);
    }

    #[test]
    fn dashes_go_on_around_corners() {
        let corner = [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)];
        let found = dashes(&corner, &[4.0, 2.0, 1.0, 2.0]);
        let first = vec![(0.0, 0.0), (4.0, 0.0)];
        let (second, third) = (vec![(5.0, 1.0), (5.0, 2.0)], vec![(5.0, 4.0), (5.0, 5.0)]);
        assert_eq!(found, [first, second, third]);
    }
}
