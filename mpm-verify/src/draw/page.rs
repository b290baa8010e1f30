//! Pages that plotters draws on, their pixels and their SVG.

use super::colour::{Rgb, channels};
use super::png_file::write_small_png;
use super::{PlotError, between};
use crate::files::write_whole;
use image::RgbImage;
use plotters::coord::Shift;
use plotters::element::{Circle, Drawable, PathElement, PointCollection, Polygon};
use plotters::prelude::{BitMapBackend, DrawingArea, IntoDrawingArea, SVGBackend};
use plotters::style::{Color, RGBAColor, RGBColor, WHITE};
use std::path::Path;

/// A position: rightwards and downwards in pixels, or in data coordinates.
pub(super) type Point = (f64, f64);
/// Left, top, right and bottom.
pub(super) type Frame = [f64; 4];
/// A point in fine pixels, as plotters counts it.
pub(super) type Spot = (i32, i32);

/// Fine pixels of a pixel, along each side: plotters counts in whole ones and smooths no area.
pub(super) const FINE: u32 = 3;

/// The fonts' name here, and what a browser takes that lacks them.
pub(super) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// A white page. Its first failure is kept until it is finished.
pub(super) struct Page<'a> {
    medium: Medium<'a>,
    failure: Option<String>,
}

enum Medium<'a> {
    Pixels(DrawingArea<BitMapBackend<'a>, Shift>),
    Vector(DrawingArea<SVGBackend<'a>, Shift>),
}

/// The pixels over `coarser` of what is drawn on a page; `path` names it in errors.
pub(super) fn pixels(path: &Path, size: Point, coarser: u32, draw: impl Fn(&mut Page)) -> Result<RgbImage, PlotError> {
    let (width, height) = fine_size(size);
    let mut buffer = vec![255; 3 * (width * height) as usize];
    let backend = BitMapBackend::with_buffer(&mut buffer, (width, height));
    Page::draw(path, Medium::Pixels(backend.into_drawing_area()), draw)?;
    Ok(averaged(&buffer, width, FINE * coarser))
}

/// Writes what is drawn on a page as PNG, and as SVG beside it.
pub(super) fn save_both(path: &Path, size: Point, draw: impl Fn(&mut Page)) -> Result<(), PlotError> {
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, fine_size(size)).into_drawing_area();
    Page::draw(path, Medium::Vector(area), &draw)?;
    let svg = path.with_extension("svg");
    let document = compact(&text, fine_size(size));
    write_whole(&svg, document.as_bytes()).map_err(|e| PlotError::new(&svg, &e))?;
    write_small_png(path, &pixels(path, size, 1, draw)?)
}

fn fine_size((width, height): Point) -> (u32, u32) {
    let side = |length: f64| FINE * length.ceil() as u32;
    (side(width), side(height))
}

/// Fine pixels of a length; what is far outside a picture stays outside.
pub(super) fn fine(length: f64) -> i32 {
    (f64::from(FINE) * length.clamp(-1e5, 1e5)).round() as i32
}

/// Fine pixels of a point.
pub(super) fn spot((x, y): Point) -> Spot {
    (fine(x), fine(y))
}

/// A colour of plotters.
pub(super) fn ink(colour: Rgb, opacity: f64) -> RGBAColor {
    let [red, green, blue] = channels(colour);
    RGBColor(red, green, blue).mix(opacity)
}

impl<'a> Page<'a> {
    fn draw(path: &Path, medium: Medium<'a>, draw: impl Fn(&mut Self)) -> Result<(), PlotError> {
        let failure = None;
        let mut page = Self { medium, failure };
        let done = match &page.medium {
            Medium::Pixels(_) => Ok(()),
            Medium::Vector(area) => area.fill(&WHITE).map_err(|e| e.to_string()),
        };
        draw(&mut page);
        let done = done.and_then(|()| match &page.medium {
            Medium::Pixels(area) => area.present().map_err(|e| e.to_string()),
            Medium::Vector(area) => area.present().map_err(|e| e.to_string()),
        });
        let failure = page.failure.or(done.err());
        failure.map_or(Ok(()), |cause| Err(PlotError::new(path, &cause)))
    }

    /// Whether it is made of pixels.
    pub(super) fn has_pixels(&self) -> bool {
        matches!(self.medium, Medium::Pixels(_))
    }

    /// Draws an element of plotters.
    pub(super) fn put<E>(&mut self, element: &E)
    where
        for<'e> &'e E: PointCollection<'e, Spot>,
        E: Drawable<BitMapBackend<'a>> + Drawable<SVGBackend<'a>>,
    {
        let drawn = match &self.medium {
            Medium::Pixels(area) => area.draw(element).map_err(|e| e.to_string()),
            Medium::Vector(area) => area.draw(element).map_err(|e| e.to_string()),
        };
        self.failure = self.failure.take().or(drawn.err());
    }

    /// Draws a line through points; the pattern gives the lengths of dashes and gaps in turn, none of a solid line.
    pub(super) fn line(&mut self, points: &[Point], width: f64, colour: Rgb, pattern: &[f64]) {
        let style = ink(colour, 1.0).stroke_width(fine(width).unsigned_abs());
        for dash in dashes(points, pattern) {
            let mut dash: Vec<Spot> = dash.into_iter().map(spot).collect();
            dash.dedup();
            if !self.has_pixels() {
                self.put(&PathElement::new(dash, style));
                continue;
            }
            // Plotters fills the outline of a line, which may overlap itself.
            for (k, pair) in dash.windows(2).enumerate() {
                self.put(&PathElement::new([pair[0], pair[1]], style));
                if k > 0 {
                    self.put(&Circle::new(pair[0], fine(width / 2.0), style.filled()));
                }
            }
        }
    }

    /// Draws a filled polygon.
    pub(super) fn area(&mut self, corners: &[Point], colour: Rgb, opacity: f64) {
        let corners: Vec<Spot> = corners.iter().copied().map(spot).collect();
        self.put(&Polygon::new(corners, ink(colour, opacity)));
    }

    /// Draws a filled rectangle.
    pub(super) fn rectangle(&mut self, frame: Frame, colour: Rgb, opacity: f64) {
        self.area(&corners(frame), colour, opacity);
    }
}

pub(super) fn corners([left, top, right, bottom]: Frame) -> [Point; 4] {
    [(left, top), (right, top), (right, bottom), (left, bottom)]
}

/// The dashes of a line.
fn dashes(points: &[Point], pattern: &[f64]) -> Vec<Vec<Point>> {
    if pattern.is_empty() {
        return vec![points.to_vec()];
    }
    let mut parts = vec![points.iter().take(1).copied().collect::<Vec<_>>()];
    let mut left = pattern[0];
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let length = |from: Point| (to.0 - from.0).hypot(to.1 - from.1);
        while length(from) > left {
            from = between(from, to, left / length(from));
            parts.last_mut().into_iter().for_each(|part| part.push(from));
            left = pattern[parts.len() % pattern.len()];
            parts.push(vec![from]);
        }
        left -= length(from);
        parts.last_mut().into_iter().for_each(|part| part.push(to));
    }
    parts.into_iter().step_by(2).collect()
}

/// The parts of a line within a frame.
pub(super) fn clipped(points: &[Point], [left, top, right, bottom]: Frame) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (start, end, low, high) in [(a.0, b.0, left, right), (a.1, b.1, top, bottom)] {
            let [first, last] = [low, high].map(|side| (side - start) / (end - start));
            if start != end {
                (from, to) = (from.max(first.min(last)), to.min(first.max(last)));
            } else if !(low..=high).contains(&start) {
                to = -1.0;
            }
        }
        if from < to {
            let (start, end) = (between(a, b, from), between(a, b, to));
            match parts.last_mut().filter(|part| part.last() == Some(&start)) {
                Some(part) => part.push(end),
                None => parts.push(vec![start, end]),
            }
        }
    }
    parts
}

/// Means of the squares of `side` pixels of a picture that is `width` wide: sums of columns first, for speed.
fn averaged(pixels: &[u8], width: u32, side: u32) -> RgbImage {
    let (row, square) = (3 * width as usize, 3 * side as usize);
    let (across, down) = (width / side, (pixels.len() / row) as u32 / side);
    let mut means = RgbImage::new(across, down);
    let rows = pixels.chunks_exact(row * side as usize);
    for (mean, rows) in means.chunks_exact_mut(3 * across as usize).zip(rows) {
        let mut columns = vec![0_u16; row];
        for line in rows.chunks_exact(row) {
            for (sum, channel) in columns.iter_mut().zip(line) {
                *sum += u16::from(*channel);
            }
        }
        for (mean, columns) in mean.chunks_exact_mut(3).zip(columns.chunks_exact(square)) {
            let mut sum = [side * side / 2; 3];
            for pixel in columns.chunks_exact(3) {
                sum[0] += u32::from(pixel[0]);
                sum[1] += u32::from(pixel[1]);
                sum[2] += u32::from(pixel[2]);
            }
            mean.copy_from_slice(&sum.map(|sum| (sum / (side * side)) as u8));
        }
    }
    means
}

/// An SVG document at the size of its picture. Neighbouring lines of one look, such as dashes, become one path.
fn compact(text: &str, (width, height): (u32, u32)) -> String {
    let [wide, high] = [width, height].map(|side| side / FINE);
    let head = format!("width=\"{width}\" height=\"{height}\"");
    let family = format!(" font-family=\"{FAMILY}\"");
    let root = format!("width=\"{wide}\" height=\"{high}\" stroke-linejoin=\"round\"{family}");
    let defaults = [&family, " opacity=\"1\"", " stroke=\"none\"", " stroke-width=\"1\""];
    let text = defaults.iter().fold(text.to_owned(), |text, known| text.replace(*known, ""));
    let text = text.replacen(&head, &root, 1);
    let (mut document, mut open) = (String::with_capacity(text.len()), None);
    for line in text.lines() {
        let polyline = line.strip_prefix("<polyline");
        let parts = polyline.and_then(|rest| rest.split_once(" points=\""));
        let look = parts.map(|(look, _)| look);
        if open != look {
            document += open.map_or("", |_| "\"/>\n");
            document += &look.map_or_else(String::new, |look| format!("<path{look} d=\""));
        }
        document += &match parts {
            Some((_, points)) => format!("M{}", points.trim_end_matches(" \"/>")),
            None => format!("{line}\n"),
        };
        open = look;
    }
    document
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_follow_a_line_around_its_corners() {
        let line = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)];
        let parts = dashes(&line, &[2.0, 2.5]);
        let expected = [vec![(0.0, 0.0), (2.0, 0.0)], vec![(3.0, 1.5), (3.0, 3.5)]];
        assert_eq!(parts, expected);
    }

    #[test]
    fn lines_are_seen_within_a_frame() {
        let frame = [0.0, 0.0, 10.0, 10.0];
        let line = [(-5.0, 5.0), (5.0, 5.0), (5.0, 20.0), (20.0, 5.0), (8.0, 5.0)];
        let parts = [vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)], vec![(10.0, 5.0), (8.0, 5.0)]];
        assert_eq!(clipped(&line, frame), parts);
        assert!(clipped(&[(-5.0, 11.0), (15.0, 11.0)], frame).is_empty());
    }

    #[test]
    fn fine_pixels_are_averaged() {
        let draw = |page: &mut Page| page.rectangle([2.0, 1.0, 5.0, 4.5], 0x0072B2, 1.0);
        let image = pixels(Path::new(""), (8.0, 6.0), 1, draw).unwrap();
        let at = |x, y| image.get_pixel(x, y).0;
        assert_eq!((image.dimensions(), at(3, 2)), ((8, 6), [0, 0x72, 0xB2]));
        assert_eq!((at(0, 0), at(7, 3)), ([255; 3], [255; 3]));
        assert!((1..250).contains(&at(3, 4)[0]));
    }
}
