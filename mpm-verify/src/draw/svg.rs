//! Shapes as SVG.

use super::colour::{INK, Rgb, WHITE};
use super::font::SMALL;
use super::shape::{Marker, Point, Shape, layers};
use quick_xml::Writer as Xml;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};
use std::io;

/// A picture as an SVG document, in which text stays text.
///
/// # Errors
/// What the writer refuses.
pub(super) fn text((width, height): (u32, u32), shapes: &[Shape]) -> io::Result<Vec<u8>> {
    let mut writer = Writer {
        xml: Xml::new_with_indent(Vec::new(), b' ', 0),
        markers: Vec::new(),
        frames: 0,
        framed: false,
        areas: None,
    };
    let root = BytesStart::new("svg").with_attributes([
        ("xmlns", "http://www.w3.org/2000/svg"),
        ("width", &*width.to_string()),
        ("height", &height.to_string()),
        ("viewBox", &format!("0 0 {width} {height}")),
        ("font-family", "DejaVu Sans, Verdana, sans-serif"),
        ("font-size", &number(SMALL.size)),
        ("fill", &hexadecimal(INK)),
        ("stroke-linecap", "round"),
        ("stroke-linejoin", "round"),
    ]);
    writer.xml.write_event(Event::Start(root))?;
    let (width, height) = (f64::from(width), f64::from(height));
    let sheet = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    writer.area(&sheet, WHITE, 1.0)?;
    for shape in shapes {
        writer.shape(shape)?;
    }
    writer.unframe()?;
    writer.close("svg")?;
    Ok(writer.xml.into_inner())
}

struct Writer {
    xml: Xml<Vec<u8>>,
    /// Markers that have been drawn: the first time they are defined, then used by their place here.
    markers: Vec<(Marker, Rgb, bool)>,
    /// How many frames there have been, by whose number they are used.
    frames: usize,
    /// Whether what follows is seen only within the last.
    framed: bool,
    /// Areas that follow one another in one colour, which are one path, not written yet.
    areas: Option<(Rgb, f64, String)>,
}

impl Writer {
    fn shape(&mut self, shape: &Shape) -> io::Result<()> {
        match shape {
            Shape::Area {
                corners,
                colour,
                opacity,
            } => self.area(corners, *colour, *opacity),
            Shape::Line {
                points,
                width,
                colour,
                pattern,
            } => {
                let dashes: Vec<String> = pattern.iter().map(|v| number(*v)).collect();
                let (d, width, dashes) = (path(points), number(*width), dashes.join(" "));
                let stroke = hexadecimal(*colour);
                let mut attributes = vec![
                    ("d", &*d),
                    ("fill", "none"),
                    ("stroke-width", &width),
                    ("stroke", &stroke),
                ];
                if !pattern.is_empty() {
                    attributes.push(("stroke-dasharray", &dashes));
                }
                self.empty("path", attributes)
            }
            Shape::Mark {
                marker,
                at,
                colour,
                hollow,
            } => self.mark((*marker, *colour, *hollow), *at),
            Shape::Text {
                text,
                at: (x, y),
                font,
                turned,
            } => {
                let [x, y, size] = [*x, *y, font.size].map(number);
                let turn = format!("rotate(-90 {x} {y})");
                let mut attributes = vec![("x", &*x), ("y", &y)];
                if *font != SMALL {
                    attributes.push(("font-size", &size));
                }
                if font.bold {
                    attributes.push(("font-weight", "bold"));
                }
                if *turned {
                    attributes.push(("transform", &turn));
                }
                let element = self.xml()?.create_element("text");
                let element = element.with_attributes(attributes);
                element.write_text_content(BytesText::new(text))?;
                Ok(())
            }
            Shape::Image { .. } => Ok(()),
            Shape::Clip(frame) => {
                self.unframe()?;
                let Some([left, top, right, bottom]) = *frame else {
                    return Ok(());
                };
                self.frames += 1;
                let name = format!("f{}", self.frames);
                self.open("clipPath", &[("id", &name)])?;
                let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
                self.empty("path", [("d", &*closed(&corners))])?;
                self.close("clipPath")?;
                self.framed = true;
                self.open("g", &[("clip-path", &format!("url(#{name})"))])
            }
        }
    }

    /// Draws a marker at a point; the first time it is defined before.
    fn mark(&mut self, looks: (Marker, Rgb, bool), (x, y): Point) -> io::Result<()> {
        let known = self.markers.iter().position(|m| *m == looks);
        let place = known.unwrap_or(self.markers.len());
        let name = format!("m{place}");
        if known.is_none() {
            self.markers.push(looks);
            self.open("defs", &[])?;
            self.open("g", &[("id", &name)])?;
            let (marker, colour, hollow) = looks;
            for layer in layers(marker, colour, hollow) {
                self.shape(&layer)?;
            }
            self.close("g")?;
            self.close("defs")?;
        }
        let [x, y] = [x, y].map(number);
        let link = format!("#{name}");
        self.empty("use", [("href", &*link), ("x", &x), ("y", &y)])
    }

    fn area(&mut self, corners: &[Point], colour: Rgb, opacity: f64) -> io::Result<()> {
        match &mut self.areas {
            // What is not opaque would show where areas overlap.
            Some((of, 1.0, d)) if *of == colour && opacity == 1.0 => *d += &closed(corners),
            _ => {
                self.xml()?;
                self.areas = Some((colour, opacity, closed(corners)));
            }
        }
        Ok(())
    }

    /// The writer, after the areas that wait.
    fn xml(&mut self) -> io::Result<&mut Xml<Vec<u8>>> {
        if let Some((colour, opacity, d)) = self.areas.take() {
            let (colour, opacity) = (hexadecimal(colour), opacity.to_string());
            let mut attributes = vec![("d", &*d), ("fill", &colour)];
            if opacity != "1" {
                attributes.push(("fill-opacity", &opacity));
            }
            let element = self.xml.create_element("path");
            element.with_attributes(attributes).write_empty()?;
        }
        Ok(&mut self.xml)
    }

    /// Ends the frame within which lines are seen, if there is one.
    fn unframe(&mut self) -> io::Result<()> {
        match std::mem::take(&mut self.framed) {
            true => self.close("g"),
            false => Ok(()),
        }
    }

    fn empty<'a>(
        &mut self,
        name: &str,
        attributes: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> io::Result<()> {
        let element = self.xml()?.create_element(name);
        element.with_attributes(attributes).write_empty()?;
        Ok(())
    }

    fn open(&mut self, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
        let start = BytesStart::new(name).with_attributes(attributes.iter().copied());
        self.xml()?.write_event(Event::Start(start))
    }

    fn close(&mut self, name: &str) -> io::Result<()> {
        self.xml()?.write_event(Event::End(BytesEnd::new(name)))
    }
}

/// Points joined by straight lines, each told from the last.
fn path(points: &[Point]) -> String {
    let (mut text, mut last) = (String::new(), (0.0, 0.0));
    for (k, (x, y)) in points.iter().enumerate() {
        let here = (rounded(*x), rounded(*y));
        text += ["M", "l", " "][k.min(2)];
        text += &format!("{} {}", number(here.0 - last.0), number(here.1 - last.1));
        last = here;
    }
    text
}

/// A polygon; most are upright rectangles.
fn closed(corners: &[Point]) -> String {
    match corners {
        [(x, y), (right, b), (c, down), (d, e)] if (y, right, x, down) == (b, c, d, e) => {
            let [x, y, right, down] = [*x, *y, *right, *down].map(number);
            format!("M{x} {y}H{right}V{down}H{x}z")
        }
        _ => path(corners) + "z",
    }
}

/// To a tenth of a pixel.
fn rounded(value: f64) -> f64 {
    (10.0 * value).round() / 10.0 + 0.0
}

/// The same, as short as it can be written.
fn number(value: f64) -> String {
    rounded(value).to_string()
}

fn hexadecimal(colour: Rgb) -> String {
    format!("#{colour:06X}")
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Canvas;
    use super::super::font::TITLE;
    use super::*;

    #[test]
    fn the_document_is_well_formed_and_lines_stay_in_their_frame() {
        let mut canvas = Canvas::new((100.0, 50.0));
        canvas.text("a < b & \"c\"", (1.0, 2.0), TITLE, (0.0, 0.0), true);
        for left in [0.0, 20.0] {
            canvas.rectangle([left, 0.0, left + 10.0, 10.0], INK, 1.0);
        }
        canvas.clip(Some([0.0, 0.0, 50.0, 50.0]));
        canvas.stroke(&[(5.0, 5.0), (9.0, 1e5)], 2.0, INK, &[4.0, 2.5]);
        canvas.clip(None);
        for x in [3.0, 30.125] {
            canvas.marker(Marker::Circle, (x, 4.0), INK, true);
        }
        let document = String::from_utf8(text(canvas.size, &canvas.shapes).unwrap()).unwrap();
        let mut reader = quick_xml::Reader::from_str(&document);
        let mut names = Vec::new();
        loop {
            match reader.read_event().unwrap() {
                Event::Start(e) | Event::Empty(e) => names.push(e.name().as_ref().to_owned()),
                Event::Eof => break,
                _ => {}
            }
        }
        let count = |name: &str| names.iter().filter(|n| *n == name).count();
        // The paper, two tiles that are one path, a frame, a line, and the three layers of a marker that is drawn twice.
        let names = ["svg", "text", "clipPath", "path", "use"];
        assert_eq!(names.map(count), [1, 1, 1, 7, 2]);
        for part in [
            "a &lt; b &amp;",
            "<clipPath id=\"f1\">\n<path d=\"M0 0H50V50H0z\"/>\n</clipPath>\n<g clip-path=\"url(#f1)\">",
            "<path d=\"M0 0H10V10H0zM20 0H30V10H20z\" fill=\"#222222\"/>",
            "<path d=\"M5 5l4 99995\" fill=\"none\" stroke-width=\"2\" stroke=\"#222222\" stroke-dasharray=\"4 2.5\"/>\n</g>",
            "<use href=\"#m0\" x=\"30.1\" y=\"4\"/>",
        ] {
            assert!(document.contains(part), "{part}\n{document}");
        }
    }
}
