//! Shapes as SVG, in the units of a picture's pixels.

use super::colour::INK;
use super::shape::{Point, Shape, layers};
use quick_xml::escape::escape;
use std::fmt::Write;

/// A picture as an SVG document. Text stays text: it takes the width that the picture's own font has in any other.
pub(super) fn text((width, height): (u32, u32), shapes: &[Shape]) -> String {
    let mut writer = Writer::default();
    for shape in shapes {
        writer.shape(shape);
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"none\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<rect width=\"{width}\" height=\"{height}\" \
         fill=\"#ffffff\"/>\n{}</svg>\n",
        writer.elements
    )
}

#[derive(Default)]
struct Writer {
    elements: String,
    /// The markers that are defined so far.
    markers: Vec<String>,
}

impl Writer {
    fn shape(&mut self, shape: &Shape) {
        let element = match shape {
            Shape::Area {
                corners,
                colour,
                opacity,
            } => {
                let opacity = match opacity {
                    1.0 => String::new(),
                    part => format!(" fill-opacity=\"{part}\""),
                };
                let points = places(corners);
                format!("<polygon points=\"{points}\" fill=\"#{colour:06x}\"{opacity}/>")
            }
            Shape::Line {
                points,
                width,
                colour,
                pattern,
            } => {
                let lengths: Vec<String> = pattern.iter().map(f64::to_string).collect();
                let dashes = match lengths.is_empty() {
                    true => String::new(),
                    false => format!(" stroke-dasharray=\"{}\"", lengths.join(" ")),
                };
                format!(
                    "<polyline points=\"{}\" stroke=\"#{colour:06x}\" stroke-width=\"{width:.1}\"{dashes}/>",
                    places(points)
                )
            }
            Shape::Mark {
                marker,
                at,
                colour,
                hollow,
            } => {
                let name = format!("{marker:?}-{colour:06x}-{hollow}");
                if !self.markers.contains(&name) {
                    let _ = writeln!(self.elements, "<defs><g id=\"{name}\">");
                    for layer in layers(*marker, *colour, *hollow) {
                        self.shape(&layer);
                    }
                    self.elements.push_str("</g></defs>\n");
                    self.markers.push(name.clone());
                }
                format!(
                    "<use href=\"#{name}\" x=\"{:.1}\" y=\"{:.1}\"/>",
                    at.0, at.1
                )
            }
            Shape::Text {
                text,
                at: (x, y),
                font,
                turned,
            } => {
                let weight = if font.bold {
                    " font-weight=\"bold\""
                } else {
                    ""
                };
                let turn = match turned {
                    true => format!(" transform=\"rotate(-90 {x:.1} {y:.1})\""),
                    false => String::new(),
                };
                format!(
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{}\"{weight}{turn} fill=\"#{INK:06x}\" \
                     textLength=\"{:.1}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>",
                    font.size,
                    font.width(text),
                    escape(text)
                )
            }
            Shape::Image { .. } => return,
            Shape::Clip(Some([left, top, right, bottom])) => {
                let (width, height) = (right - left, bottom - top);
                format!(
                    "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
                     viewBox=\"{left} {top} {width} {height}\">"
                )
            }
            Shape::Clip(None) => "</svg>".to_owned(),
        };
        self.elements.push_str(&element);
        self.elements.push('\n');
    }
}

fn places(points: &[Point]) -> String {
    let place = |p: &Point| format!("{},{}", tenths(p.0), tenths(p.1));
    points.iter().map(place).collect::<Vec<_>>().join(" ")
}

/// To a tenth of a pixel, without a final zero.
fn tenths(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::font::TITLE;
    use super::super::shape::Marker;
    use super::*;
    use quick_xml::events::Event;

    #[test]
    fn the_document_is_well_formed_and_defines_each_marker_once() {
        let mut canvas = Canvas::new((100.0, 50.0));
        canvas.text("a < b & \"c\"", (1.0, 2.0), TITLE, (0.0, 0.0), true);
        canvas.clip(Some([0.0, 0.0, 50.0, 50.0]));
        canvas.stroke(
            &[(0.0, 0.0), (f64::NAN, 1.0), (5.0, 5.0), (9.0, 1e300)],
            2.0,
            INK,
            &[3.0, 4.0],
        );
        canvas.clip(None);
        canvas.marker(Marker::Circle, (3.0, 4.0), INK, true);
        canvas.marker(Marker::Circle, (5.0, 6.0), INK, true);
        let document = text(canvas.size, &canvas.shapes);
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
        assert_eq!(
            ["g", "use", "text", "polyline", "svg"].map(count),
            [1, 2, 1, 1, 2]
        );
        assert!(document.contains("100000") && !document.contains("NaN"));
    }
}
