//! A picture in memory: shapes and text drawn by the plotting library at three times the size, then
//! averaged down, which smooths them all alike.

use std::fmt::Display;
use std::io::Cursor;
use std::path::Path;
use std::sync::Once;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{RgbImage, imageops};
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::prelude::{Color, FontDesc, FontFamily, FontStyle, RGBColor, TextStyle};
use plotters::style::{FontTransform, register_font};

use super::chart::Marker;
use super::{PlotError, SOLID};
use crate::files::write_whole;

/// A position, rightwards and downwards in pixels or in data coordinates.
pub(super) type Point = (f64, f64);
/// Left, top, right and bottom.
pub(super) type Frame = [f64; 4];
pub(super) type Rgb = u32;

/// Okabe–Ito, with grey for its yellow, which is too faint for lines on white.
pub(super) const PALETTE: [Rgb; 8] = [
    0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x000000, 0x7F7F7F,
];
pub(super) const INK: Rgb = 0x222222;
const WHITE: Rgb = 0xFFFFFF;
/// Viridis at steps of a tenth.
const SEQUENTIAL: [Rgb; 11] = [
    0x440154, 0x482475, 0x414487, 0x355F8D, 0x2A788E, 0x21918C, 0x22A884, 0x44BF70, 0x7AD151,
    0xBDDF26, 0xFDE725,
];
/// Stone to purple through orange, of falling lightness: its light end shows the shadows of a body.
const STONE: [Rgb; 11] = [
    0xE8E2D4, 0xEFD9AE, 0xF4CB8A, 0xF4B86B, 0xF0A256, 0xE78A4A, 0xD97145, 0xC55846, 0xAB434B,
    0x8C3250, 0x692653,
];
/// Blue to red through grey, of CIE lightness 22, 38, 54, 69, 83, 94 and back.
const DIVERGING: [Rgb; 11] = [
    0x133463, 0x0F5AA3, 0x2D86CD, 0x6AAFE4, 0xAFD4EE, 0xEEEEEE, 0xF2C6AD, 0xEA926F, 0xD25D43,
    0xA52E28, 0x661819,
];

/// Pixels drawn for one of the picture, along each side.
pub(super) const FINE: f64 = 3.0;
/// Width of a curve.
pub(super) const LINE: f64 = 11.0 / 3.0;

/// A font: its height from ascent to descent in pixels, and whether it is bold.
#[derive(Clone, Copy)]
pub(super) struct Font(f64, bool);
pub(super) const SMALL: Font = Font(88.0 / 3.0, false);
pub(super) const LABEL: Font = Font(98.0 / 3.0, false);
pub(super) const TITLE: Font = Font(34.0, true);
pub(super) const HEADING: Font = Font(112.0 / 3.0, true);
/// Distance of text lines and height of a capital or digit, in heights of the font.
const LEADING: f64 = 1.16;
const CAPITAL: f64 = 0.627;

impl Font {
    fn face(self) -> FontDesc<'static> {
        static READY: Once = Once::new();
        let styles = [FontStyle::Normal, FontStyle::Bold];
        READY.call_once(|| {
            let fonts: [&[u8]; 2] = [
                include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
                include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf"),
            ];
            for (font, style) in fonts.into_iter().zip(styles) {
                // A font that could not be read is missing when a text is drawn: an error then.
                let _ = register_font("sans-serif", style, font);
            }
        });
        let style = styles[usize::from(self.1)];
        FontDesc::new(FontFamily::SansSerif, FINE * self.0, style)
    }

    /// Advance of a character, in the library's pixels.
    fn advance(self, glyph: &str) -> i32 {
        self.face().box_size(glyph).map_or(0, |size| size.0 as i32)
    }

    pub(super) fn width(self, text: &str) -> f64 {
        let glyphs = text.split("").map(|glyph| self.advance(glyph));
        f64::from(glyphs.sum::<i32>()) / FINE
    }
}

/// Lines of text.
pub(super) struct Block {
    lines: Vec<String>,
    font: Font,
}

impl Block {
    /// Breaks a text at its spaces into lines no wider than `width` where that is possible.
    pub(super) fn new(text: &str, font: Font, width: f64) -> Self {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if font.width(&format!("{line} {word}")) <= width => {
                    *line = format!("{line} {word}");
                }
                _ => lines.push(word.to_string()),
            }
        }
        Self { lines, font }
    }

    pub(super) fn height(&self) -> f64 {
        self.lines.len() as f64 * self.font.0 * LEADING
    }

    pub(super) fn width(&self) -> f64 {
        largest(self.lines.iter().map(|line| self.font.width(line)))
    }
}

pub(super) struct Canvas {
    image: RgbImage,
    /// The first thing that could not be drawn.
    error: Option<String>,
}

impl Canvas {
    pub(super) fn new((width, height): Point) -> Self {
        let [width, height] = [width, height].map(|side| side.ceil() as u32 * FINE as u32);
        let image = RgbImage::from_pixel(width, height, image::Rgb([255; 3]));
        Self { image, error: None }
    }

    /// Copies a part out, on which nothing can be drawn beyond its frame.
    pub(super) fn cut(&self, [left, top, right, bottom]: Frame) -> Self {
        let sides = [left, top, right - left, bottom - top];
        let [x, y, w, h] = sides.map(|v| (FINE * v).round() as u32);
        let image = imageops::crop_imm(&self.image, x, y, w, h).to_image();
        Self { image, error: None }
    }

    pub(super) fn paste(&mut self, part: Self, (left, top): Point) {
        let (x, y) = fine((left, top));
        imageops::replace(&mut self.image, &part.image, x.into(), y.into());
        self.error = self.error.take().or(part.error);
    }

    /// Puts an image of the library's pixels, as many as [`FINE`] says, at a place.
    pub(super) fn picture(&mut self, image: &RgbImage, at: Point) {
        let (x, y) = fine(at);
        imageops::replace(&mut self.image, image, x.into(), y.into());
    }

    fn draw<E: Display>(&mut self, act: impl FnOnce(&mut BitMapBackend) -> Result<(), E>) {
        let size = self.image.dimensions();
        let drawn = act(&mut BitMapBackend::with_buffer(&mut self.image, size));
        self.record(drawn);
    }

    fn record<T, E: Display>(&mut self, drawn: Result<T, E>) {
        if let Err(error) = drawn {
            self.error.get_or_insert(error.to_string());
        }
    }

    pub(super) fn rectangle(&mut self, frame: Frame, colour: Rgb, opacity: f64) {
        let [left, top, right, bottom] = frame;
        let style = rgb(colour).mix(opacity);
        self.draw(|to| to.draw_rect(fine((left, top)), fine((right, bottom)), &style, true));
    }

    pub(super) fn polygon(&mut self, corners: &[Point], colour: Rgb) {
        self.draw(|to| to.fill_polygon(corners.iter().copied().map(fine), &rgb(colour)));
    }

    /// Draws a round-ended line.
    fn segment(&mut self, ends: [Point; 2], width: f64, colour: Rgb) {
        // The library's polygons and circles cover a pixel more than their width.
        let style = rgb(colour).stroke_width((FINE * width).round() as u32 - 1);
        self.draw(|to| to.draw_path(ends.map(fine), &style));
        let radius = (FINE * width / 2.0) as u32;
        for end in ends {
            self.draw(|to| to.draw_circle(fine(end), radius, &rgb(colour), true));
        }
    }

    /// Draws a polyline; the pattern gives the lengths of dashes and gaps in turn.
    pub(super) fn stroke(&mut self, points: &[Point], width: f64, colour: Rgb, pattern: &[f64]) {
        let (mut piece, mut used) = (0, 0.0);
        for pair in points.windows(2).filter(|_| !pattern.is_empty()) {
            let Some((a, b)) = self.inside(pair[0], pair[1], width) else {
                continue;
            };
            let (length, mut done) = ((b.0 - a.0).hypot(b.1 - a.1), 0.0);
            while done < length {
                let end = length.min(done + pattern[piece] - used);
                if piece % 2 == 0 {
                    let ends = [done, end].map(|s| between(a, b, s / length));
                    self.segment(ends, width, colour);
                }
                used += end - done;
                done = end;
                if used >= pattern[piece] - 1e-9 {
                    (piece, used) = ((piece + 1) % pattern.len(), 0.0);
                }
            }
        }
    }

    /// The part of a line on the picture or near it, if any: coordinates of the library are bounded.
    fn inside(&self, a: Point, b: Point, near: f64) -> Option<(Point, Point)> {
        let (width, height) = self.image.dimensions();
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (from, to, side) in [(a.0, b.0, width), (a.1, b.1, height)] {
            let (step, far) = (to - from, f64::from(side) / FINE + near);
            let (low, high) = ((-near - from) / step, (far - from) / step);
            if !step.is_finite() || (step == 0.0 && !(-near..=far).contains(&from)) {
                return None;
            } else if step != 0.0 {
                first = first.max(low.min(high));
                last = last.min(low.max(high));
            }
        }
        (first <= last).then(|| (between(a, b, first), between(a, b, last)))
    }

    /// Draws a marker with a white rim, filled or hollow.
    pub(super) fn marker(&mut self, marker: Marker, at: Point, colour: Rgb, hollow: bool) {
        let about = |x: f64, y: f64| (at.0 + x, at.1 + y);
        let inner = if hollow { WHITE } else { colour };
        // A regular polygon: number of corners, angle of the first, and size.
        let (corners, turn, size) = match marker {
            Marker::None => return,
            Marker::Cross => {
                for (width, colour) in [(LINE + 4.0, WHITE), (LINE + 0.7, colour)] {
                    self.segment([about(-8.5, -8.5), about(8.5, 8.5)], width, colour);
                    self.segment([about(-8.5, 8.5), about(8.5, -8.5)], width, colour);
                }
                return;
            }
            Marker::Ring => {
                let point = |k| f64::from(k) * std::f64::consts::TAU / 48.0;
                let ring = (0..=48).map(|k| about(16.0 * point(k).cos(), 16.0 * point(k).sin()));
                self.stroke(&ring.collect::<Vec<_>>(), 2.4, colour, SOLID);
                return;
            }
            Marker::Dot => (24, 0.0, 5.0),
            Marker::Circle => (48, 0.0, 10.0),
            Marker::Square => (4, 45.0, 12.8),
            Marker::Triangle => (3, 90.0, 14.0),
            Marker::Diamond => (4, 90.0, 13.0),
        };
        let angle = |part: f64| part * std::f64::consts::TAU / f64::from(corners);
        for (outset, colour) in [(2.0, WHITE), (0.0, colour), (-3.4, inner)] {
            let radius = size + outset / angle(0.5).cos();
            let corner = |k| f64::to_radians(turn) + angle(f64::from(k));
            let corner = |k| about(radius * corner(k).cos(), -radius * corner(k).sin());
            self.polygon(&(0..corners).map(corner).collect::<Vec<_>>(), colour);
        }
    }

    /// Draws one line of text; `anchor` is the fraction of its width and of a capital's height (from
    /// the top) that lies at the point. Turned text reads upwards, with `anchor` turned along.
    pub(super) fn text(&mut self, text: &str, at: Point, font: Font, anchor: Point, turned: bool) {
        let turn = [FontTransform::None, FontTransform::Rotate270][usize::from(turned)].clone();
        let (face, colour) = (font.face().transform(turn), rgb(INK));
        let style = TextStyle::from(face.clone()).color(&colour);
        // The library puts the baseline half the font's height below its origin, and a character's
        // ink, which belongs about the middle of its advance, at its start.
        let down = font.0 * (CAPITAL * (1.0 - anchor.1) - 0.5);
        let (mut pen, down) = fine((-anchor.0 * font.width(text), down));
        let (x, y) = fine(at);
        for glyph in text.split("").filter(|glyph| !glyph.is_empty()) {
            let (advance, mut ink) = (font.advance(glyph), 0);
            let measure = |x: i32, _, _| {
                ink = ink.max(x + 1);
                Ok::<(), &str>(())
            };
            self.record(face.draw(glyph, (0, 0), measure));
            let along = pen + (advance - ink) / 2;
            let place = if turned {
                (x + down, y - along)
            } else {
                (x + along, y + down)
            };
            self.draw(|to| to.draw_text(glyph, &style, place));
            pen += advance;
        }
    }

    /// Draws centred lines of text downwards from `at` (turned: rightwards).
    pub(super) fn block(&mut self, block: &Block, at: Point, turned: bool) {
        for (k, line) in block.lines.iter().enumerate() {
            let down = (k as f64 * LEADING + (LEADING - CAPITAL) / 2.0) * block.font.0;
            let shift = if turned { (down, 0.0) } else { (0.0, down) };
            let at = (at.0 + shift.0, at.1 + shift.1);
            self.text(line, at, block.font, (0.5, 0.0), turned);
        }
    }

    /// Writes the picture beside its final place and then moves it there.
    pub(super) fn save(self, path: &Path) -> Result<(), PlotError> {
        let mut png = Cursor::new(Vec::new());
        let encoder =
            PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive);
        self.pixels(path, 1)?
            .write_with_encoder(encoder)
            .map_err(|e| failed(path, &e))?;
        write_whole(path, png.get_ref()).map_err(|e| failed(path, &e))
    }

    /// The picture, averaged down, and again by `coarser`; `path` names it in errors.
    pub(super) fn pixels(&self, path: &Path, coarser: u32) -> Result<RgbImage, PlotError> {
        if let Some(error) = &self.error {
            return Err(failed(path, error));
        }
        Ok(averaged(&self.image, FINE as u32 * coarser))
    }
}

/// The means of squares of `side` pixels; what is left over at the right and below is dropped. The library's `thumbnail`
/// gives the same and took half of the time of a report.
fn averaged(image: &RgbImage, side: u32) -> RgbImage {
    let mut means = RgbImage::new(image.width() / side, image.height() / side);
    if means.is_empty() {
        return means;
    }
    let (row, square) = (3 * image.width() as usize, 3 * side as usize);
    let mut sums = vec![0; 3 * means.width() as usize];
    let rows = image.chunks_exact(row * side as usize);
    for (mean, rows) in means.chunks_exact_mut(sums.len()).zip(rows) {
        sums.fill(side * side / 2);
        for line in rows.chunks_exact(row) {
            for (sums, pixels) in sums.chunks_exact_mut(3).zip(line.chunks_exact(square)) {
                for pixel in pixels.chunks_exact(3) {
                    for (sum, channel) in sums.iter_mut().zip(pixel) {
                        *sum += u32::from(*channel);
                    }
                }
            }
        }
        for (mean, sum) in mean.iter_mut().zip(&sums) {
            *mean = (sum / (side * side)) as u8;
        }
    }
    means
}

fn failed(path: &Path, cause: &dyn Display) -> PlotError {
    PlotError::Write {
        path: path.into(),
        cause: cause.to_string(),
    }
}

/// Writes pictures of one size as an animated PNG that repeats for ever, each shown for a `delay` of hundredths of a
/// second.
pub(super) fn save_animation(
    path: &Path,
    frames: &[RgbImage],
    delay: u16,
) -> Result<(), PlotError> {
    let Some(first) = frames.first() else {
        return Err(failed(path, &"no pictures"));
    };
    let mut bytes = Vec::new();
    let write = |bytes: &mut Vec<u8>| -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(bytes, first.width(), first.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::Adaptive);
        encoder.set_animated(frames.len() as u32, 0)?;
        encoder.set_frame_delay(delay, 100)?;
        let mut writer = encoder.write_header()?;
        for frame in frames {
            writer.write_image_data(frame)?;
        }
        writer.finish()
    };
    write(&mut bytes).map_err(|e| failed(path, &e))?;
    write_whole(path, &bytes).map_err(|e| failed(path, &e))
}

/// The library's nearest coordinates.
fn fine((x, y): Point) -> (i32, i32) {
    ((FINE * x).round() as i32, (FINE * y).round() as i32)
}

fn rgb(colour: Rgb) -> RGBColor {
    let [_, red, green, blue] = colour.to_be_bytes();
    RGBColor(red, green, blue)
}

/// Colour of a value on the scale of a range; beyond its ends the colour of the end.
pub(super) fn colour_of(value: f64, range: (f64, f64)) -> Rgb {
    on_scale(value, range, &SEQUENTIAL)
}

/// The same for a surface in light.
pub(super) fn stone_of(value: f64, range: (f64, f64)) -> Rgb {
    on_scale(value, range, &STONE)
}

fn on_scale(value: f64, (lo, hi): (f64, f64), sequential: &[Rgb; 11]) -> Rgb {
    let (small, large) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    let (table, t) = if lo < 0.0 && hi > 0.0 && small >= 0.2 * large {
        (&DIVERGING, 0.5 + 0.5 * value.clamp(lo, hi) / large)
    } else {
        (sequential, (value.clamp(lo, hi) - lo) / (hi - lo))
    };
    let place = t * (table.len() - 1) as f64;
    let index = (place as usize).min(table.len() - 2);
    let [below, above] = [table[index], table[index + 1]].map(u32::to_be_bytes);
    let channel = |k: usize| {
        let (below, above) = (f64::from(below[k]), f64::from(above[k]));
        (below + (place - index as f64) * (above - below)).round() as u8
    };
    u32::from_be_bytes([0, 1, 2, 3].map(channel))
}

pub(super) fn between(a: Point, b: Point, t: f64) -> Point {
    (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1))
}

pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_the_library() {
        let value = |x: u32, y: u32, k: u32| ((x * 7919 + y * 104_729 + k * 31) % 256) as u8;
        let pixel = |x, y| image::Rgb([0, 1, 2].map(|k| value(x, y, k)));
        for side in [1, 3, 6] {
            let image = RgbImage::from_fn(5 * side, 4 * side, pixel);
            assert!(averaged(&image, side) == imageops::thumbnail(&image, 5, 4));
        }
        let over = RgbImage::from_fn(17, 13, pixel);
        let part = imageops::crop_imm(&over, 0, 0, 15, 12).to_image();
        assert!(averaged(&over, 3) == averaged(&part, 3));
    }

    #[test]
    fn colours_run_between_their_ends() {
        let lightness = |rgb: Rgb| {
            let linear = |shift: u32| (f64::from((rgb >> shift) & 255) / 255.0).powf(2.2);
            0.2126 * linear(16) + 0.7152 * linear(8) + 0.0722 * linear(0)
        };
        assert_eq!(colour_of(-1.0, (0.0, 2.0)), SEQUENTIAL[0]);
        assert_eq!(colour_of(3.0, (0.0, 2.0)), SEQUENTIAL[10]);
        let of = |k: i32, range| lightness(colour_of(f64::from(k) / 50.0, range));
        assert!((0..50).all(|k| of(k, (0.0, 1.0)) < of(k + 1, (0.0, 1.0))));
        let stone = |k: i32| lightness(stone_of(f64::from(k) / 50.0, (0.0, 1.0)));
        assert!((0..50).all(|k| stone(k) > stone(k + 1)));
        assert_eq!(stone_of(0.0, (-2.0, 2.0)), DIVERGING[5]);
        assert_eq!(colour_of(0.0, (-2.0, 2.0)), DIVERGING[5]);
        assert_eq!(colour_of(0.0, (-1.0, 3.0)), DIVERGING[5]);
        assert!((0..50).all(|k| of(k, (-1.0, 1.0)) > of(k + 1, (-1.0, 1.0))));
        assert!((0..50).all(|k| of(-k, (-1.0, 1.0)) > of(-k - 1, (-1.0, 1.0))));
    }
}
