//! Pages that plotters draws on, in fine pixels: their lines, areas and files.

use super::PlotError;
use super::colour::Rgb;
use super::png_file::write_small_png;
use super::text::FAMILY;
use crate::files::write_whole;
use image::RgbImage;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Polygon};
use plotters::prelude::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::{Color, RGBColor, WHITE};
use std::path::Path;

/// A position: rightwards and downwards in pixels, or in data coordinates.
pub(super) type Point = (f64, f64);
/// Left, top, right and bottom.
pub(super) type Frame = [f64; 4];
/// A page, or a part of it.
pub(super) type Page<B> = DrawingArea<B, Shift>;
/// Outcome of drawing on a page.
pub(super) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Fine pixels of a pixel, along each side. Plotters counts in whole ones and smooths no area.
pub(super) const FINE: u32 = 3;
/// Turn of a line (cosine) beyond which plotters' outline of it may overlap itself.
const TURN: f64 = 0.85;

/// A backend of plotters.
pub(super) trait Medium: DrawingBackend {
    /// Whether it makes pixels: these need help with corners of lines and with text.
    const PIXELS: bool;
}

impl Medium for BitMapBackend<'_> {
    const PIXELS: bool = true;
}

impl Medium for SVGBackend<'_> {
    const PIXELS: bool = false;
}

/// A picture of a known size.
pub(super) trait Picture {
    /// Width and height in pixels.
    fn size(&self) -> Point;
    /// Draws it on a white page.
    fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B>;

    /// The pixels of the picture at its size over `coarser`; `path` names it in errors.
    fn pixels(&self, path: &Path, coarser: u32) -> Result<RgbImage, PlotError> {
        let size = fine_size(self.size());
        let mut buffer = vec![255; 3 * (size.0 * size.1) as usize];
        let page = BitMapBackend::with_buffer(&mut buffer, size).into_drawing_area();
        let drawn = self.draw(&page).and_then(|()| page.present());
        drop(page);
        drawn.map_err(|e| PlotError::write(path, &e))?;
        Ok(averaged(&buffer, size.0, FINE * coarser))
    }

    /// Writes it as PNG.
    fn save(&self, path: &Path) -> Result<(), PlotError> {
        write_small_png(path, &self.pixels(path, 1)?)
    }

    /// Writes it as SVG beside a PNG file.
    fn save_svg(&self, path: &Path) -> Result<(), PlotError> {
        let (path, size) = (path.with_extension("svg"), fine_size(self.size()));
        let mut text = String::new();
        let page = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let drawn = page.fill(&WHITE).and_then(|()| self.draw(&page));
        let drawn = drawn.and_then(|()| page.present());
        drop(page);
        drawn.map_err(|e| PlotError::write(&path, &e))?;
        write_whole(&path, compact(&text, size).as_bytes()).map_err(|e| PlotError::write(&path, &e))
    }
}

/// Fine pixels of a length; what is far outside a picture stays outside.
pub(super) fn fine(length: f64) -> i32 {
    (f64::from(FINE) * length.clamp(-1e5, 1e5)).round() as i32
}

/// Fine pixels of a point.
pub(super) fn spot((x, y): Point) -> (i32, i32) {
    (fine(x), fine(y))
}

fn fine_size((width, height): Point) -> (u32, u32) {
    let side = |length: f64| FINE * (length.max(1.0).ceil() as u32);
    (side(width), side(height))
}

/// A colour of plotters.
pub(super) fn ink(colour: Rgb) -> RGBColor {
    let [_, red, green, blue] = colour.to_be_bytes();
    RGBColor(red, green, blue)
}

/// Draws a line through points; the pattern gives the lengths of dashes and gaps in turn, none of a solid line.
pub(super) fn stroke<B: Medium>(
    page: &Page<B>,
    points: &[Point],
    width: f64,
    colour: Rgb,
    pattern: &[f64],
) -> Drawn<B> {
    let style = ink(colour).stroke_width(fine(width).unsigned_abs());
    for dash in dashes(points, pattern) {
        let mut rest = &dash[..];
        while let Some(corner) = (B::PIXELS.then(|| corner(rest))).flatten() {
            let joint = Circle::new(spot(rest[corner]), fine(width / 2.0), style.filled());
            page.draw(&joint)?;
            draw_path(page, &rest[..=corner], style)?;
            rest = &rest[corner..];
        }
        draw_path(page, rest, style)?;
    }
    Ok(())
}

fn draw_path<B: Medium>(
    page: &Page<B>,
    points: &[Point],
    style: plotters::style::ShapeStyle,
) -> Drawn<B> {
    let mut points: Vec<_> = points.iter().copied().map(spot).collect();
    points.dedup();
    match points.len() {
        0 | 1 => Ok(()),
        _ => page.draw(&PathElement::new(points, style)),
    }
}

/// The first inner point at which a line turns sharply.
fn corner(points: &[Point]) -> Option<usize> {
    let sharp = |w: &[Point]| {
        let (a, b) = (
            (w[1].0 - w[0].0, w[1].1 - w[0].1),
            (w[2].0 - w[1].0, w[2].1 - w[1].1),
        );
        a.0 * b.0 + a.1 * b.1 < TURN * a.0.hypot(a.1) * b.0.hypot(b.1)
    };
    points.windows(3).position(sharp).map(|k| k + 1)
}

/// The dashes of a line.
fn dashes(points: &[Point], pattern: &[f64]) -> Vec<Vec<Point>> {
    if pattern.is_empty() {
        return vec![points.to_vec()];
    }
    let mut parts = Vec::new();
    let mut dash: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut turn, mut left) = (0, pattern[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let length = (to.0 - from.0).hypot(to.1 - from.1);
            if length <= left {
                left -= length;
                dash.push(to);
                break;
            }
            from = super::between(from, to, left / length);
            dash.push(from);
            let done = std::mem::replace(&mut dash, vec![from]);
            parts.extend((turn % 2 == 0).then_some(done));
            turn += 1;
            left = pattern[turn % pattern.len()];
        }
    }
    parts.extend((turn % 2 == 0).then_some(dash));
    parts
}

/// Draws a filled polygon.
pub(super) fn area<B: Medium>(
    page: &Page<B>,
    corners: &[Point],
    colour: Rgb,
    opacity: f64,
) -> Drawn<B> {
    let corners: Vec<_> = corners.iter().copied().map(spot).collect();
    page.draw(&Polygon::new(corners, ink(colour).mix(opacity)))
}

/// The corners of a frame.
pub(super) fn corners([left, top, right, bottom]: Frame) -> [Point; 4] {
    [(left, top), (right, top), (right, bottom), (left, bottom)]
}

/// The parts of a line within a frame.
pub(super) fn clipped(points: &[Point], frame: Frame) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let (mut from, mut to) = (0.0, 1.0);
        let sides = [
            (a.0, b.0, frame[0], frame[2]),
            (a.1, b.1, frame[1], frame[3]),
        ];
        for (start, end, low, high) in sides {
            let at = |side: f64| (side - start) / (end - start);
            let (enter, leave) = match start.total_cmp(&end) {
                std::cmp::Ordering::Less => (at(low), at(high)),
                std::cmp::Ordering::Greater => (at(high), at(low)),
                std::cmp::Ordering::Equal if (low..=high).contains(&start) => continue,
                std::cmp::Ordering::Equal => (2.0, 0.0),
            };
            (from, to) = (enter.max(from), leave.min(to));
        }
        if from < to {
            let (start, end) = (super::between(a, b, from), super::between(a, b, to));
            match parts.last_mut() {
                Some(part) if from == 0.0 && part.last() == Some(&a) => part.push(end),
                _ => parts.push(vec![start, end]),
            }
        }
    }
    parts
}

/// The means of squares of `side` pixels of a picture so wide.
fn averaged(pixels: &[u8], width: u32, side: u32) -> RgbImage {
    let (row, square) = (3 * width as usize, 3 * side as usize);
    let (across, down) = (width / side, (pixels.len() / row) as u32 / side);
    let mut means = RgbImage::new(across, down);
    let rows = pixels.chunks_exact(row * side as usize);
    for (mean, rows) in means.chunks_exact_mut(3 * across as usize).zip(rows) {
        for (k, mean) in mean.chunks_exact_mut(3).enumerate() {
            let mut sum = [side * side / 2; 3];
            for line in rows.chunks_exact(row) {
                for pixel in line[k * square..(k + 1) * square].chunks_exact(3) {
                    (0..3).for_each(|c| sum[c] += u32::from(pixel[c]));
                }
            }
            (0..3).for_each(|c| mean[c] = (sum[c] / (side * side)) as u8);
        }
    }
    means
}

/// An SVG document at the size of its picture. Neighbouring lines of one look, such as dashes, become one path.
fn compact(text: &str, (width, height): (u32, u32)) -> String {
    const POINTS: &str = " points=\"";
    let [wide, high] = [width, height].map(|side| side / FINE);
    let head = format!("width=\"{width}\" height=\"{height}\"");
    let family = format!(" font-family=\"{FAMILY}\"");
    let root = format!("width=\"{wide}\" height=\"{high}\" stroke-linejoin=\"round\"{family}");
    let defaults = [
        &family,
        " opacity=\"1\"",
        " stroke=\"none\"",
        " stroke-width=\"1\"",
    ];
    let text = defaults
        .iter()
        .fold(text.to_owned(), |text, known| text.replace(*known, ""));
    let text = text.replacen(&head, &root, 1);
    let mut document = String::with_capacity(text.len());
    let mut open = None;
    for line in text.lines() {
        let polyline = line.strip_prefix("<polyline");
        let parts = polyline.and_then(|rest| rest.split_once(POINTS));
        let look = parts.map(|(look, _)| look);
        if open != look {
            document += if open.is_some() { "\"/>\n" } else { "" };
            document += &look
                .map(|look| format!("<path{look} d=\""))
                .unwrap_or_default();
        }
        match parts {
            Some((_, points)) => {
                document += &format!("M{}", points.trim_end_matches([' ', '"', '/', '>']))
            }
            None => document += &format!("{line}\n"),
        }
        open = look;
    }
    document
}
