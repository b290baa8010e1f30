//! Pictures of the report: grids of line charts and panels of particle fields, as PNG files.
//!
//! Everything is laid out in pixels around axes boxes of fixed size, so that no label can be
//! clipped and no legend can hide data, and is drawn by a small antialiasing rasteriser: each
//! shape is given by its signed distance. The plotting library supplies the glyphs of the embedded
//! fonts and the PNG encoder. The same input gives the same bytes.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::style::{FontDesc, FontFamily, FontStyle, register_font};

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// A chart or field figure has nothing to draw.
    #[error("{}: \"{title}\" has no finite data", path.display())]
    NoFiniteData {
        /// The picture's file.
        path: PathBuf,
        /// Title of the chart or figure.
        title: String,
    },
    /// A value cannot be drawn on a logarithmic axis.
    #[error("{}: \"{title}\" has the non-positive value {value} on its log axis \"{axis}\"", path.display())]
    NonPositive {
        /// The picture's file.
        path: PathBuf,
        /// Title of the chart.
        title: String,
        /// Label of the axis.
        axis: String,
        /// The value.
        value: f64,
    },
    /// A field panel's points and values differ in number.
    #[error("{}: panel \"{title}\" has {points} points but {values} values", path.display())]
    Lengths {
        /// The picture's file.
        path: PathBuf,
        /// Title of the panel.
        title: String,
        /// Number of points.
        points: usize,
        /// Number of values.
        values: usize,
    },
    /// An embedded font could not be used, or the PNG could not be encoded or written.
    #[error("{}: {cause}", path.display())]
    Write {
        /// The picture's file.
        path: PathBuf,
        /// What failed.
        cause: String,
    },
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic, base ten.
    Log10,
}

/// Marker of a series: filled with a solid line or none, hollow with a dashed or dotted line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// No marker.
    None,
    /// Circle.
    Circle,
    /// Square.
    Square,
    /// Upward triangle.
    Triangle,
    /// Diamond.
    Diamond,
    /// Diagonal cross.
    Cross,
}

/// Line of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Solid line.
    Solid,
    /// Dashed line.
    Dashed,
    /// Dotted line.
    Dotted,
    /// No line: markers only.
    None,
}

/// One curve. A point that is not finite interrupts the line. Where a line has more than 40 points
/// its markers are thinned out.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Points in data coordinates.
    pub points: Vec<(f64, f64)>,
    /// Index into the palette of eight colours (taken modulo eight).
    pub colour: usize,
    /// Marker.
    pub marker: Marker,
    /// Line.
    pub dash: Dash,
}

/// A horizontal line, such as an exact value, drawn dash-dotted in black.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLine {
    /// Name in the legend.
    pub name: String,
    /// Ordinate.
    pub value: f64,
    /// Half-width of a lightly shaded band around the line.
    pub band: Option<f64>,
}

/// A slope triangle; it is drawn only when both axes are logarithmic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeTriangle {
    /// Slope, the order of convergence.
    pub slope: f64,
    /// Left end of the horizontal leg in data coordinates (for a positive slope, the triangle's
    /// lower-left corner).
    pub at: (f64, f64),
    /// Length of the horizontal leg in decades.
    pub decades: f64,
}

/// One pair of axes with its curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title above the axes; may be empty.
    pub title: String,
    /// Label of the abscissa.
    pub x_label: String,
    /// Label of the ordinate.
    pub y_label: String,
    /// Scale of the abscissa.
    pub x_scale: Scale,
    /// Scale of the ordinate.
    pub y_scale: Scale,
    /// Curves, the last one on top.
    pub series: Vec<Series>,
    /// Horizontal reference lines, beneath the curves.
    pub reference_lines: Vec<ReferenceLine>,
    /// Slope triangle.
    pub slope_triangle: Option<SlopeTriangle>,
    /// Range of the abscissa; without it, the data with a margin.
    pub x_range: Option<(f64, f64)>,
    /// Range of the ordinate; without it, the data with a margin.
    pub y_range: Option<(f64, f64)>,
}

/// One snapshot of a particle field.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldPanel {
    /// Title above the panel; may be empty.
    pub title: String,
    /// Particle positions.
    pub points: Vec<(f64, f64)>,
    /// Particle values; one that is not a number is drawn grey.
    pub values: Vec<f64>,
    /// Side of a particle's square in data units.
    pub size: f64,
    /// Polygon drawn thin over the particles; may be empty.
    pub outline: Vec<(f64, f64)>,
}

/// Field panels on the same axes with one colour scale.
///
/// The colours diverge from a neutral zero when both signs take a good part of the range (the
/// smaller end at least a fifth of the larger), otherwise they are sequential.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldFigure {
    /// Title above the panels; may be empty.
    pub title: String,
    /// Panels, row by row.
    pub panels: Vec<FieldPanel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Values at the ends of the colour scale.
    pub range: (f64, f64),
    /// Label of the colour bar, with unit.
    pub label: String,
    /// Label of the abscissa.
    pub x_label: String,
    /// Label of the ordinate.
    pub y_label: String,
}

type Rgb = u32;
type Point = (f64, f64);

/// Okabe–Ito, with grey for its yellow, which is too faint for lines on white.
const PALETTE: [Rgb; 8] = [
    0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x000000, 0x7F7F7F,
];
const INK: Rgb = 0x222222;
const GRID: Rgb = 0xE2E2E2;
const MINOR_GRID: Rgb = 0xF1F1F1;
const WHITE: Rgb = 0xFFFFFF;
const NO_VALUE: Rgb = 0xB0B0B0;
/// Viridis at steps of a tenth.
const SEQUENTIAL: [Rgb; 11] = [
    0x440154, 0x482475, 0x414487, 0x355F8D, 0x2A788E, 0x21918C, 0x22A884, 0x44BF70, 0x7AD151,
    0xBDDF26, 0xFDE725,
];
/// Blue to red through grey, of CIE lightness 22, 38, 54, 69, 83, 94 and back.
const DIVERGING: [Rgb; 11] = [
    0x133463, 0x0F5AA3, 0x2D86CD, 0x6AAFE4, 0xAFD4EE, 0xEEEEEE, 0xF2C6AD, 0xEA926F, 0xD25D43,
    0xA52E28, 0x661819,
];

/// A font: pixels per em, and whether it is bold.
#[derive(Clone, Copy)]
struct Font(f64, bool);
const SMALL: Font = Font(25.0, false);
const LABEL: Font = Font(28.0, false);
const TITLE: Font = Font(29.0, true);
const HEADING: Font = Font(32.0, true);
/// Distance of text lines in ems.
const LEADING: f64 = 1.35;
/// Height of a capital or digit in ems.
const CAPITAL: f64 = 0.73;
/// Margin of a picture, and length of a major tick with its gap to the label, in pixels.
const EDGE: f64 = 28.0;
const TICK: f64 = 20.0;
/// Distance from an axis to its label below, and of the charts in a grid.
const LABEL_DROP: f64 = TICK + 33.0;
const CELL_GAP: f64 = 30.0;
/// Width of the colour bar, height of its triangular ends, and distance of rows of panels.
const BAR: f64 = 36.0;
const BAR_TIP: f64 = 32.0;
const ROW_GAP: f64 = 24.0;
/// Width of a curve.
const LINE: f64 = 3.6;

static FONTS: [&[u8]; 2] = [
    include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf"),
];
/// Ascent plus descent of the fonts in ems: the plotting library's font size is this height.
const FONT_HEIGHT: f64 = (1901.0 + 483.0) / 2048.0;

fn register_fonts(path: &Path) -> Result<(), PlotError> {
    static READY: OnceLock<bool> = OnceLock::new();
    let ready = *READY.get_or_init(|| {
        register_font("sans-serif", FontStyle::Normal, FONTS[0]).is_ok()
            && register_font("sans-serif", FontStyle::Bold, FONTS[1]).is_ok()
    });
    let cause = "an embedded font is unreadable".to_string();
    ready.then_some(()).ok_or(PlotError::Write {
        path: path.into(),
        cause,
    })
}

/// Advance and left bearing of a character in ems, from the font's cmap and hmtx tables: the
/// plotting library rounds the one and ignores the other, which spaces letters unevenly.
fn glyph_metrics(font: &[u8], c: char) -> Option<(f64, f64)> {
    let byte = |i: usize| font.get(i).map(|&b| usize::from(b));
    let u16_at = |i: usize| Some((byte(i)? << 8) + byte(i + 1)?);
    let u32_at = |i: usize| Some((u16_at(i)? << 16) + u16_at(i + 2)?);
    let table = |tag: &[u8; 4]| {
        let mut records = (0..u16_at(4)?).map(|k| 12 + 16 * k);
        u32_at(records.find(|&o| font.get(o..o + 4) == Some(tag))? + 8)
    };
    let (cmap, hmtx) = (table(b"cmap")?, table(b"hmtx")?);
    let mut maps = (0..u16_at(cmap + 2)?).map(|k| cmap + 4 + 8 * k);
    let map = cmap + u32_at(maps.find(|&o| u32_at(o) == Some(0x0003_0001))? + 4)?;
    let (c, doubled) = (c as usize, u16_at(map + 6)?);
    let mut ends = (0..doubled / 2).map(|k| map + 14 + 2 * k);
    let start = ends.find(|&o| u16_at(o).is_some_and(|end| end >= c))? + 2 + doubled;
    let (delta, offset_at) = (u16_at(start + doubled)?, start + 2 * doubled);
    let glyph = match u16_at(offset_at)? {
        _ if c < u16_at(start)? => return None,
        0 => c + delta,
        offset => u16_at(offset_at + offset + 2 * (c - u16_at(start)?))? + delta,
    } & 0xFFFF;
    let entry = hmtx + 4 * glyph.min(u16_at(table(b"hhea")? + 34)? - 1);
    let bearing = u16_at(entry + 2)? as u16 as i16;
    Some((u16_at(entry)? as f64 / 2048.0, f64::from(bearing) / 2048.0))
}

fn text_width(text: &str, font: Font) -> f64 {
    let advance = |c| glyph_metrics(FONTS[usize::from(font.1)], c).map_or(0.6, |m| m.0);
    text.chars().map(advance).sum::<f64>() * font.0
}

/// Breaks a text at its spaces into lines no wider than `width` where that is possible.
fn wrap(text: &str, font: Font, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), font) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

fn block_height(lines: &[String], font: Font) -> f64 {
    lines.len() as f64 * font.0 * LEADING
}

/// A picture in memory. Shapes collect their coverage of the pixels, [`Canvas::paint`] blends it.
struct Canvas {
    size: (usize, usize),
    rgb: Vec<u8>,
    cover: Vec<f32>,
    touched: Vec<usize>,
    /// Pixels outside this rectangle (left, top, right, bottom) are left alone.
    clip: [f64; 4],
}

impl Canvas {
    fn new(width: f64, height: f64) -> Self {
        let (w, h) = (width.ceil() as usize, height.ceil() as usize);
        let clip = [0.0, 0.0, w as f64, h as f64];
        Self {
            size: (w, h),
            rgb: vec![255; 3 * w * h],
            cover: vec![0.0; w * h],
            touched: Vec::new(),
            clip,
        }
    }

    /// Combines a pixel's coverage with a new one.
    fn touch(&mut self, x: i64, y: i64, combine: impl Fn(f32) -> f32) {
        let [left, top, right, bottom] = self.clip;
        if (x as f64) < left || (y as f64) < top || x as f64 >= right || y as f64 >= bottom {
            return;
        }
        let index = y as usize * self.size.0 + x as usize;
        self.touched.push(index);
        self.cover[index] = combine(self.cover[index]);
    }

    fn paint(&mut self, colour: Rgb, opacity: f32) {
        for index in std::mem::take(&mut self.touched) {
            let alpha = std::mem::take(&mut self.cover[index]).min(1.0) * opacity;
            for (channel, shift) in [16, 8, 0].into_iter().enumerate() {
                let pixel = &mut self.rgb[3 * index + channel];
                let ink = (colour >> shift & 255) as f32;
                *pixel = (f32::from(*pixel) + alpha * (ink - f32::from(*pixel))).round() as u8;
            }
        }
    }

    /// Covers the pixels of a box (left, top, right, bottom) where the signed distance is negative.
    fn shape(&mut self, bounds: [f64; 4], distance: impl Fn(f64, f64) -> f64) {
        let [left, top, right, bottom] = self.clip;
        let [x0, y0] = [bounds[0].max(left), bounds[1].max(top)].map(|v| v.floor() as i64);
        let [x1, y1] = [bounds[2].min(right), bounds[3].min(bottom)].map(|v| v.ceil() as i64);
        for y in y0..y1 {
            for x in x0..x1 {
                let cover = (0.5 - distance(x as f64 + 0.5, y as f64 + 0.5)).min(1.0) as f32;
                if cover > 0.0 {
                    self.touch(x, y, |old| old.max(cover));
                }
            }
        }
    }

    /// Covers a round-ended stroke.
    fn segment(&mut self, (ax, ay): Point, (bx, by): Point, width: f64) {
        let (dx, dy, r) = (bx - ax, by - ay, width / 2.0);
        let bounds = around(&[(ax, ay), (bx, by)], r + 1.0);
        let squared = (dx * dx + dy * dy).max(1e-12);
        self.shape(bounds, |x, y| {
            let t = (((x - ax) * dx + (y - ay) * dy) / squared).clamp(0.0, 1.0);
            (x - ax - t * dx).hypot(y - ay - t * dy) - r
        });
    }

    /// Covers a polyline; the pattern gives the lengths of dashes and gaps in turn.
    fn stroke(&mut self, points: &[Point], width: f64, pattern: &[f64]) {
        let (mut piece, mut used) = (0, 0.0);
        for pair in points.windows(2) {
            let Some((a, b)) = clip_segment(pair[0], pair[1], self.clip) else {
                continue;
            };
            if pattern.is_empty() {
                self.segment(a, b, width);
                continue;
            }
            let (length, mut done) = ((b.0 - a.0).hypot(b.1 - a.1), 0.0);
            let at = |s: f64| between(a, b, s / length);
            while done < length {
                let end = length.min(done + pattern[piece] - used);
                if piece % 2 == 0 {
                    self.segment(at(done), at(end), width);
                }
                used += end - done;
                done = end;
                if used >= pattern[piece] - 1e-9 {
                    (piece, used) = ((piece + 1) % pattern.len(), 0.0);
                }
            }
        }
    }

    /// Fills a rectangle with edges on whole pixels.
    fn rectangle(&mut self, [left, top, right, bottom]: [f64; 4], colour: Rgb, opacity: f32) {
        let bounds = [left.round(), top.round(), right.round(), bottom.round()];
        self.shape(bounds, |_, _| -1.0);
        self.paint(colour, opacity);
    }

    /// Fills a convex polygon with corners in clockwise order on the screen.
    fn polygon(&mut self, corners: &[Point], colour: Rgb) {
        let bounds = around(corners, 1.0);
        self.shape(bounds, |x, y| polygon_distance(corners, x, y));
        self.paint(colour, 1.0);
    }

    /// Draws a marker with a white rim, filled or hollow.
    fn marker(&mut self, marker: Marker, (cx, cy): Point, colour: Rgb, hollow: bool) {
        let about = |r: f64, corners: &[Point]| -> Vec<Point> {
            corners
                .iter()
                .map(|c| (cx + r * c.0, cy + r * c.1))
                .collect()
        };
        let corners = match marker {
            Marker::None => return,
            Marker::Cross => {
                for (width, ink) in [(LINE + 4.0, WHITE), (LINE + 0.8, colour)] {
                    self.segment((cx - 8.5, cy - 8.5), (cx + 8.5, cy + 8.5), width);
                    self.segment((cx - 8.5, cy + 8.5), (cx + 8.5, cy - 8.5), width);
                    self.paint(ink, 1.0);
                }
                return;
            }
            Marker::Circle => Vec::new(),
            Marker::Square => about(9.0, &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]),
            Marker::Triangle => about(12.5, &[(0.0, -1.0), (0.95, 0.7), (-0.95, 0.7)]),
            Marker::Diamond => about(13.0, &[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]),
        };
        let distance = |x: f64, y: f64| match marker {
            Marker::Circle => (x - cx).hypot(y - cy) - 10.0,
            _ => polygon_distance(&corners, x, y),
        };
        let bounds = [cx - 18.0, cy - 18.0, cx + 18.0, cy + 18.0];
        for (inset, ink) in [(-2.0, WHITE), (0.0, colour), (3.4, WHITE)] {
            if inset <= 0.0 || hollow {
                self.shape(bounds, |x, y| distance(x, y) + inset);
                self.paint(ink, 1.0);
            }
        }
    }

    /// Draws one line of text; `anchor` is the fraction of its width and of a capital's height (from
    /// the top) that lies at the point. Turned text reads upwards, with `anchor` turned along.
    fn text(&mut self, text: &str, at: Point, font: Font, anchor: (f64, f64), turned: bool) {
        const FINE: f64 = 4.0;
        let em = FINE * font.0;
        let style = [FontStyle::Normal, FontStyle::Bold][usize::from(font.1)];
        // An even size, because the library puts the baseline half the size below its origin.
        let size = 2.0 * (em * FONT_HEIGHT / 2.0).round();
        let face = FontDesc::new(FontFamily::SansSerif, size, style);
        let baseline = (em * CAPITAL * (1.0 - anchor.1) - size / 2.0).round() as i64;
        let mut pen = -anchor.0 * FINE * text_width(text, font);
        let origin = ((FINE * at.0).round() as i64, (FINE * at.1).round() as i64);
        for c in text.chars() {
            let (advance, bearing) =
                glyph_metrics(FONTS[usize::from(font.1)], c).unwrap_or((0.6, 0.0));
            let start = (pen + bearing * em).floor() as i64;
            // The fonts are known to be registered; a glyph that fails to draw leaves a gap.
            let _ = face.draw(c.encode_utf8(&mut [0; 4]), (0, 0), |x, y, cover| {
                let (u, v) = (start + i64::from(x), baseline + i64::from(y));
                let (dx, dy) = if turned { (v, -u) } else { (u, v) };
                let (x, y) = (origin.0 + dx, origin.1 + dy);
                self.touch(x.div_euclid(4), y.div_euclid(4), |old| old + cover / 16.0);
                Ok::<(), ()>(())
            });
            pen += advance * em;
        }
        self.paint(INK, 1.0);
    }

    /// Draws centred lines of text downwards from `at` (turned: rightwards).
    fn block(&mut self, lines: &[String], at: Point, font: Font, turned: bool) {
        for (k, line) in lines.iter().enumerate() {
            let down = (k as f64 * LEADING + (LEADING - CAPITAL) / 2.0) * font.0;
            let shift = if turned { (down, 0.0) } else { (0.0, down) };
            let at = (at.0 + shift.0, at.1 + shift.1);
            self.text(line, at, font, (0.5, 0.0), turned);
        }
    }

    /// Writes the picture beside its final place and then moves it there.
    fn save(&self, path: &Path) -> Result<(), PlotError> {
        let failed = |cause: String| PlotError::Write {
            path: path.into(),
            cause,
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let draft = path.with_file_name(format!(".{name}.{}.png", std::process::id()));
        let size = (self.size.0 as u32, self.size.1 as u32);
        let mut backend = BitMapBackend::new(&draft, size);
        let written = backend
            .blit_bitmap((0, 0), size, &self.rgb)
            .and_then(|()| backend.present())
            .map_err(|e| failed(e.to_string()));
        drop(backend);
        let moved =
            written.and_then(|()| std::fs::rename(&draft, path).map_err(|e| failed(e.to_string())));
        if moved.is_err() {
            let _ = std::fs::remove_file(&draft);
        }
        moved
    }
}

/// The box (left, top, right, bottom) about some points, with a margin.
fn around(points: &[Point], margin: f64) -> [f64; 4] {
    let none = [f64::MAX, f64::MAX, f64::MIN, f64::MIN];
    let [left, top, right, bottom] = points.iter().fold(none, |b, p| {
        [b[0].min(p.0), b[1].min(p.1), b[2].max(p.0), b[3].max(p.1)]
    });
    [left - margin, top - margin, right + margin, bottom + margin]
}

fn between(a: Point, b: Point, t: f64) -> Point {
    (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1))
}

fn polygon_distance(corners: &[Point], x: f64, y: f64) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).fold(f64::MIN, |most, (a, b)| {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        most.max((dy * (x - a.0) - dx * (y - a.1)) / dx.hypot(dy).max(1e-12))
    })
}

/// The part of a finite segment near a rectangle, so that no dash is laid far outside it.
fn clip_segment(
    a: Point,
    b: Point,
    [left, top, right, bottom]: [f64; 4],
) -> Option<(Point, Point)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for (step, room) in [
        (-dx, a.0 - left + LINE),
        (dx, right + LINE - a.0),
        (-dy, a.1 - top + LINE),
        (dy, bottom + LINE - a.1),
    ] {
        if !(step + room).is_finite() || (step == 0.0 && room < 0.0) {
            return None;
        } else if step < 0.0 {
            t0 = t0.max(room / step);
        } else if step > 0.0 {
            t1 = t1.min(room / step);
        }
    }
    (t0 <= t1).then(|| (between(a, b, t0), between(a, b, t1)))
}

/// Ticks as positions on the axis (log axes: of the logarithm) with labels; minor ones have none.
type Ticks = Vec<(f64, String)>;

/// The smallest 1-2-5 step that puts at most `most` ticks on a range, and these ticks.
fn nice_ticks(lo: f64, hi: f64, most: usize) -> (f64, Vec<f64>) {
    let decade = ((hi - lo) / most as f64).log10().floor() as i32;
    for (exponent, digit) in (0..4).flat_map(|e| [1, 2, 5].map(|d| (decade + e, d))) {
        let step = f64::from(digit) * 10f64.powi(exponent);
        let (first, last) = ((lo / step - 1e-9).ceil(), (hi / step + 1e-9).floor());
        if last - first < most as f64 {
            let count = (last - first + 1.0) as usize;
            return (
                step,
                (0..count).map(|k| (first + k as f64) * step).collect(),
            );
        }
    }
    (hi - lo, Vec::new())
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    exponent.to_string().chars().map(digit).collect()
}

/// Label of a tick among ticks `step` apart, whose largest magnitude is `largest`.
fn tick_label(value: f64, step: f64, largest: f64) -> String {
    if value.abs() < 1e-6 * step {
        return "0".to_string();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    let order = |v: f64| (v.abs().log10() + 1e-9).floor() as i32;
    let digits = |v: f64, exponent: i32| {
        let decimals = usize::try_from(exponent - order(step)).unwrap_or(0);
        format!("{:.decimals$}", v.abs())
    };
    if !(1e-3..1e6).contains(&largest) {
        let exponent = order(largest);
        let mantissa = digits(value / 10f64.powi(exponent), exponent);
        return format!("{sign}{mantissa}×10{}", superscript(exponent));
    }
    let plain = digits(value, 0);
    let whole = plain.find('.').unwrap_or(plain.len());
    let mut label = sign.to_string();
    for (k, c) in plain.chars().enumerate() {
        if whole > 4 && k > 0 && k < whole && (whole - k) % 3 == 0 {
            label.push('\u{2009}');
        }
        label.push(c);
    }
    label
}

fn linear_ticks(lo: f64, hi: f64, most: usize) -> Ticks {
    let (step, values) = nice_ticks(lo, hi, most);
    let largest = largest(values.iter().map(|v| v.abs()));
    values
        .into_iter()
        .map(|v| (v, tick_label(v, step, largest)))
        .collect()
}

/// Ticks of a log axis from 10^lo to 10^hi: decades; over about one decade or less, 1-2-5; where
/// these are too few, linear steps.
fn log_ticks(lo: f64, hi: f64, most: usize) -> Ticks {
    let inside = |v: f64| (lo - 1e-9..=hi + 1e-9).contains(&v);
    let decades = lo.floor() as i32..=hi.ceil() as i32;
    let whole: Vec<i32> = decades.clone().filter(|&e| inside(f64::from(e))).collect();
    let stride = (whole.len().max(1) - 1) / most + 1;
    // Every multiple of a power of ten as exponent, digit, logarithm and value.
    let multiple = |e: i32, d: i32| {
        (
            e,
            d,
            f64::from(e) + f64::from(d).log10(),
            f64::from(d) * 10f64.powi(e),
        )
    };
    let multiples = decades.flat_map(|e| (1..10).map(move |d| multiple(e, d)));
    let multiples: Vec<_> = multiples.filter(|m| inside(m.2)).collect();
    if hi - lo >= 1.5 && whole.len() > 1 {
        let shown = multiples.into_iter().filter(|m| stride == 1 || m.1 == 1);
        let label = |e: i32, d: i32| {
            if d == 1 && e.rem_euclid(stride as i32) == 0 {
                format!("10{}", superscript(e))
            } else {
                String::new()
            }
        };
        return shown.map(|(e, d, log, _)| (log, label(e, d))).collect();
    }
    let few = multiples
        .iter()
        .filter(|m| [1, 2, 5].contains(&m.1))
        .count();
    let chosen = (3..=most.max(3)).contains(&few);
    let label = |e: i32, d: i32, v: f64| {
        if chosen && [1, 2, 5].contains(&d) {
            tick_label(v, 10f64.powi(e), v)
        } else {
            String::new()
        }
    };
    let mut ticks: Ticks = multiples
        .iter()
        .map(|&(e, d, log, v)| (log, label(e, d, v)))
        .collect();
    if !chosen {
        let linear = linear_ticks(10f64.powf(lo), 10f64.powf(hi), most);
        ticks.extend(linear.into_iter().map(|(v, label)| (v.log10(), label)));
    }
    ticks
}

/// An axis: its range (log axes: of the logarithm), its length in pixels, and its ticks.
struct Axis {
    log: bool,
    range: (f64, f64),
    length: f64,
    ticks: Ticks,
}

impl Axis {
    /// Lays as many ticks as leave room between the labels along the axis.
    fn new(range: (f64, f64), log: bool, length: f64, upright: bool) -> Self {
        let mut axis = Self {
            log,
            range,
            length,
            ticks: Vec::new(),
        };
        let lay = if log { log_ticks } else { linear_ticks };
        let size = |label: &str| {
            if upright {
                SMALL.0
            } else {
                text_width(label, SMALL)
            }
        };
        for most in (1..=9).rev() {
            axis.ticks = lay(range.0, range.1, most);
            let labels: Vec<_> = axis.ticks.iter().filter(|t| !t.1.is_empty()).collect();
            if labels.windows(2).all(|w| {
                let room = axis.pixels(w[1].0) - axis.pixels(w[0].0);
                room >= (size(&w[0].1) + size(&w[1].1)) / 2.0 + 1.2 * SMALL.0
            }) {
                break;
            }
        }
        axis
    }

    /// Pixels from the start of the axis to a position on it (log axes: the logarithm).
    fn pixels(&self, position: f64) -> f64 {
        (position - self.range.0) / (self.range.1 - self.range.0) * self.length
    }

    /// Pixels from the start of the axis to a value.
    fn at(&self, value: f64) -> f64 {
        self.pixels(if self.log { value.log10() } else { value })
    }

    fn label_width(&self) -> f64 {
        largest(self.ticks.iter().map(|t| text_width(&t.1, SMALL)))
    }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// Widens a range by a fraction on both sides; an empty one, to a readable range about its value.
fn widen((lo, hi): (f64, f64), fraction: f64) -> (f64, f64) {
    let size = lo.abs().max(hi.abs());
    let half = if hi - lo > 1e-12 * size {
        fraction * (hi - lo)
    } else if size > 0.0 {
        0.1 * size
    } else {
        1.0
    };
    (lo - half, hi + half)
}

/// Smallest range that holds the finite values.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|v| v.is_finite()).fold(None, |range, v| {
        let (lo, hi) = range.unwrap_or((v, v));
        Some((v.min(lo), v.max(hi)))
    })
}

/// Draws ticks, their labels where asked for, and the grid of axes with lower left corner `origin`.
fn draw_ticks(canvas: &mut Canvas, axes: [&Axis; 2], origin: Point, labels: [bool; 2], grid: bool) {
    let ([x, y], (left, bottom)) = (axes, origin);
    let (right, top) = (left + x.length, bottom - y.length);
    for (major, colour) in [(false, MINOR_GRID), (true, GRID)] {
        let chosen = |t: &&(f64, String)| grid && t.1.is_empty() != major;
        for px in x
            .ticks
            .iter()
            .filter(chosen)
            .map(|t| (left + x.pixels(t.0)).round())
        {
            canvas.rectangle([px - 1.0, top, px + 1.0, bottom], colour, 1.0);
        }
        for py in y
            .ticks
            .iter()
            .filter(chosen)
            .map(|t| (bottom - y.pixels(t.0)).round())
        {
            canvas.rectangle([left, py - 1.0, right, py + 1.0], colour, 1.0);
        }
    }
    let length = |label: &str| if label.is_empty() { 5.0 } else { 10.0 };
    for (position, label) in &x.ticks {
        let px = (left + x.pixels(*position)).round();
        canvas.rectangle(
            [px - 1.0, bottom, px + 1.0, bottom + length(label)],
            INK,
            1.0,
        );
        if labels[0] {
            canvas.text(label, (px, bottom + TICK), SMALL, (0.5, 0.0), false);
        }
    }
    for (position, label) in &y.ticks {
        let py = (bottom - y.pixels(*position)).round();
        canvas.rectangle([left - length(label), py - 1.0, left, py + 1.0], INK, 1.0);
        if labels[1] {
            canvas.text(label, (left - TICK, py), SMALL, (1.0, 0.5), false);
        }
    }
}

fn draw_box(canvas: &mut Canvas, [left, top, right, bottom]: [f64; 4]) {
    let corners = [
        (left, top),
        (right, top),
        (right, bottom),
        (left, bottom),
        (left, top),
    ];
    for pair in corners.windows(2) {
        let [x0, y0, x1, y1] = around(pair, 1.0);
        canvas.rectangle([x0, y0, x1, y1], INK, 1.0);
    }
}

fn line_pattern(dash: Dash) -> Option<&'static [f64]> {
    match dash {
        Dash::Solid => Some(&[]),
        Dash::Dashed => Some(&[16.0, 10.0]),
        Dash::Dotted => Some(&[1.0, 8.0]),
        Dash::None => None,
    }
}
const DASH_DOT: &[f64] = &[20.0, 9.0, 1.0, 9.0];

/// An entry of a legend.
#[derive(PartialEq)]
struct Entry<'a> {
    name: &'a str,
    colour: Rgb,
    marker: Marker,
    pattern: Option<&'static [f64]>,
    hollow: bool,
    band: bool,
}

/// Length of a legend's line, height of its entries and gap of its columns, in pixels.
const SAMPLE: f64 = 70.0;
const ENTRY_HEIGHT: f64 = 40.0;
const COLUMN_GAP: f64 = 40.0;

fn entries(chart: &Chart) -> Vec<Entry<'_>> {
    let lines = chart.reference_lines.iter().map(|line| Entry {
        name: &line.name,
        colour: INK,
        marker: Marker::None,
        pattern: Some(DASH_DOT),
        hollow: false,
        band: line.band.is_some(),
    });
    let curves = chart.series.iter().map(|series| Entry {
        name: &series.name,
        colour: PALETTE[series.colour % PALETTE.len()],
        marker: series.marker,
        pattern: line_pattern(series.dash),
        hollow: matches!(series.dash, Dash::Dashed | Dash::Dotted),
        band: false,
    });
    curves.chain(lines).collect()
}

/// The entries laid out in columns, filled one by one.
struct Legend<'a> {
    entries: &'a [Entry<'a>],
    rows: usize,
    column: f64,
    width: f64,
    height: f64,
}

impl<'a> Legend<'a> {
    /// At most `room` pixels wide, if one column allows it.
    fn new(entries: &'a [Entry], room: f64) -> Self {
        let widest = largest(entries.iter().map(|e| text_width(e.name, SMALL)));
        let column = SAMPLE + 14.0 + widest + COLUMN_GAP;
        let columns = (((room + COLUMN_GAP) / column) as usize).max(1);
        let rows = entries.len().div_ceil(columns).max(1);
        let width = entries.len().div_ceil(rows) as f64 * column - COLUMN_GAP;
        Self {
            entries,
            rows,
            column,
            width,
            height: rows as f64 * ENTRY_HEIGHT,
        }
    }

    fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        for (k, entry) in self.entries.iter().enumerate() {
            let x = left + (k / self.rows) as f64 * self.column;
            let y = top + ((k % self.rows) as f64 + 0.5) * ENTRY_HEIGHT;
            if entry.band {
                canvas.rectangle([x, y - 13.0, x + SAMPLE, y + 13.0], INK, 0.12);
            }
            let line = [(x + 2.0, y), (x + SAMPLE - 2.0, y)];
            if let Some(pattern) = entry.pattern {
                canvas.stroke(&line, LINE, pattern);
                canvas.paint(entry.colour, 1.0);
            }
            canvas.marker(
                entry.marker,
                (x + SAMPLE / 2.0, y),
                entry.colour,
                entry.hollow,
            );
            canvas.text(entry.name, (x + SAMPLE + 14.0, y), SMALL, (0.0, 0.5), false);
        }
    }
}

impl Chart {
    /// The slope triangle's horizontal leg and the end of its vertical leg.
    fn triangle(&self) -> Option<[Point; 3]> {
        let log = self.x_scale == Scale::Log10 && self.y_scale == Scale::Log10;
        let SlopeTriangle { slope, at, decades } = self.slope_triangle.filter(|_| log)?;
        let right = at.0 * 10f64.powf(decades);
        Some([
            at,
            (right, at.1),
            (right, at.1 * 10f64.powf(slope * decades)),
        ])
    }

    /// The axis, `length` pixels long, that shows everything or the given range.
    fn axis(&self, path: &Path, upright: bool, length: f64) -> Result<Axis, PlotError> {
        let (given, scale, label) = if upright {
            (self.y_range, self.y_scale, &self.y_label)
        } else {
            (self.x_range, self.x_scale, &self.x_label)
        };
        let log = scale == Scale::Log10;
        let pick = |p: &Point| if upright { p.1 } else { p.0 };
        let transform = |v: f64| if log { v.log10() } else { v };
        let all = self.series.iter().flat_map(|s| &s.points);
        let mut shown: Vec<f64> = all.filter(|p| finite(p)).map(pick).collect();
        if shown.is_empty() {
            return Err(nothing(path, &self.title));
        }
        for line in self.reference_lines.iter().filter(|_| upright) {
            let half = line.band.unwrap_or(0.0);
            shown.extend([line.value, line.value + half]);
            shown.extend(Some(line.value - half).filter(|v| !log || *v > 0.0));
        }
        shown.extend(self.triangle().iter().flatten().map(pick));
        shown.extend(given.into_iter().flat_map(|(lo, hi)| [lo, hi]));
        if let Some(&value) = shown.iter().find(|v| log && **v <= 0.0) {
            let (path, title, axis) = (path.into(), self.title.clone(), label.clone());
            return Err(PlotError::NonPositive {
                path,
                title,
                axis,
                value,
            });
        }
        let (from, margin) = given.map_or((shown, 0.05), |(lo, hi)| (vec![lo, hi], 0.0));
        let ends = extent(from.into_iter().map(transform));
        let (mut lo, mut hi) = widen(ends.ok_or_else(|| nothing(path, &self.title))?, margin);
        if let (Some([a, b, c]), None) = (self.triangle(), given) {
            // Room for the triangle's labels: right of it, and below or above its horizontal leg.
            let (leg, room) = (transform(pick(&b)), if upright { 44.0 } else { 80.0 });
            if upright && c.1 > a.1 {
                lo = lo.min(hi - (hi - leg) / (1.0 - room / length))
            } else {
                hi = hi.max(lo + (leg - lo) / (1.0 - room / length))
            }
        }
        Ok(Axis::new((lo, hi), log, length, upright))
    }
}

fn finite(point: &Point) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

fn nothing(path: &Path, title: &str) -> PlotError {
    PlotError::NoFiniteData {
        path: path.into(),
        title: title.into(),
    }
}

/// A chart with its axes, wrapped labels and legend.
struct Plan<'a> {
    chart: &'a Chart,
    x: Axis,
    y: Axis,
    title: Vec<String>,
    x_label: Vec<String>,
    y_label: Vec<String>,
    entries: Vec<Entry<'a>>,
}

impl<'a> Plan<'a> {
    fn new(path: &Path, chart: &'a Chart, (width, height): Point) -> Result<Self, PlotError> {
        Ok(Self {
            chart,
            x: chart.axis(path, false, width)?,
            y: chart.axis(path, true, height)?,
            title: wrap(&chart.title, TITLE, width),
            x_label: wrap(&chart.x_label, LABEL, width),
            y_label: wrap(&chart.y_label, LABEL, height),
            entries: entries(chart),
        })
    }

    /// Draws everything but the legend about the axes' lower left corner.
    fn draw(&self, canvas: &mut Canvas, (left, bottom): Point) {
        let (right, top) = (left + self.x.length, bottom - self.y.length);
        let frame = [left, top, right, bottom];
        let place = |p: &Point| (left + self.x.at(p.0), bottom - self.y.at(p.1));
        draw_ticks(
            canvas,
            [&self.x, &self.y],
            (left, bottom),
            [true, true],
            true,
        );
        let all = std::mem::replace(&mut canvas.clip, frame);
        for line in &self.chart.reference_lines {
            if let Some(half) = line.band.filter(|half| (line.value + half).is_finite()) {
                // The logarithm of a lower end that is not positive is none: the axis cuts it off.
                let y = |v: f64| bottom - self.y.at(v).max(0.0).min(self.y.length);
                let (upper, lower) = (y(line.value + half), y(line.value - half));
                canvas.rectangle([left, upper, right, lower], INK, 0.12);
            }
            let y = bottom - self.y.at(line.value);
            canvas.stroke(&[(left, y), (right, y)], LINE, DASH_DOT);
            canvas.paint(INK, 1.0);
        }
        for (series, entry) in self.chart.series.iter().zip(&self.entries) {
            canvas.clip = frame;
            if let Some(pattern) = entry.pattern {
                let points: Vec<Point> = series.points.iter().map(place).collect();
                canvas.stroke(&points, LINE, pattern);
                canvas.paint(entry.colour, 1.0);
            }
            canvas.clip = all;
            let thin = entry.pattern.is_some() && series.points.len() > 40;
            let mut drawn: Vec<Point> = Vec::new();
            let [x0, y0, x1, y1] = around(&[(left, top), (right, bottom)], 1.0);
            for p in series.points.iter().map(place) {
                let inside = (x0..=x1).contains(&p.0) && (y0..=y1).contains(&p.1);
                let near = |d: &Point| (p.0 - d.0).hypot(p.1 - d.1) < 60.0;
                if inside && !(thin && drawn.iter().any(near)) {
                    canvas.marker(entry.marker, p, entry.colour, entry.hollow);
                    drawn.push(p);
                }
            }
        }
        canvas.clip = all;
        if let (Some(corners), Some(SlopeTriangle { slope, .. })) =
            (self.chart.triangle(), self.chart.slope_triangle)
        {
            let [a, b, c] = corners.map(|p| place(&p));
            canvas.stroke(&[a, b, c, a], 2.4, &[]);
            canvas.paint(INK, 1.0);
            let (label, middle) = (slope.to_string().replace('-', "−"), between(a, b, 0.5));
            canvas.text(
                &label,
                (b.0 + 10.0, between(b, c, 0.5).1),
                SMALL,
                (0.0, 0.5),
                false,
            );
            let (gap, anchor) = if slope > 0.0 { (9.0, 0.0) } else { (-9.0, 1.0) };
            canvas.text("1", (middle.0, middle.1 + gap), SMALL, (0.5, anchor), false);
        }
        draw_box(canvas, frame);
        let (middle, below) = ((left + right) / 2.0, bottom + LABEL_DROP);
        let above = top - 12.0 - block_height(&self.title, TITLE);
        canvas.block(&self.title, (middle, above), TITLE, false);
        canvas.block(&self.x_label, (middle, below), LABEL, false);
        canvas.block(
            &self.y_label,
            (left - self.left(), (top + bottom) / 2.0),
            LABEL,
            true,
        );
    }

    /// Width of the ordinate's label and tick labels.
    fn left(&self) -> f64 {
        block_height(&self.y_label, LABEL) + 12.0 + self.y.label_width() + TICK
    }
}

/// Draws a grid of charts, `columns` in a row, as one PNG file.
///
/// Charts with the same series share one legend; otherwise each has its own. It lies below the axes,
/// or to the right if it is a single one of more than six entries.
///
/// # Errors
///
/// A chart without finite points, a non-positive value on a log axis, or a file that cannot be
/// written.
pub fn draw_charts(path: &Path, charts: &[Chart], columns: usize) -> Result<(), PlotError> {
    register_fonts(path)?;
    let columns = columns.min(charts.len()).max(1);
    let size = [(1180.0, 760.0), (760.0, 560.0), (560.0, 430.0)][columns.min(3) - 1];
    let plans = charts.iter().map(|c| Plan::new(path, c, size));
    let plans = plans.collect::<Result<Vec<_>, _>>()?;
    let first = plans
        .first()
        .ok_or_else(|| nothing(path, "a figure without charts"))?;

    // Every chart has the same margins, so that the axes of a grid are aligned.
    let most = |extent: &dyn Fn(&Plan) -> f64| largest(plans.iter().map(extent));
    let left = most(&|p| p.left());
    let right = 16.0 + most(&|p| p.x.label_width()) / 2.0;
    let top = 16.0 + most(&|p| block_height(&p.title, TITLE));
    let bottom = LABEL_DROP + most(&|p| block_height(&p.x_label, LABEL));
    let shared = plans.iter().all(|p| p.entries == first.entries);
    let beside = shared && first.entries.len() > 6;

    let (rows, natural) = (charts.len().div_ceil(columns), left + size.0 + right);
    let grid_width = |cell: f64| columns as f64 * (cell + CELL_GAP) - CELL_GAP;
    let room = if shared { grid_width(natural) } else { natural };
    let room = if beside { 0.0 } else { room };
    let legends: Vec<_> = plans
        .iter()
        .map(|p| Legend::new(&p.entries, room))
        .collect();
    let widest = largest(legends.iter().map(|l| l.width));
    let highest = largest(legends.iter().map(|l| l.height)) + 16.0;
    let cell = if shared { natural } else { natural.max(widest) };
    let row = top + size.1 + bottom + if shared { 0.0 } else { highest };
    let (width, height) = (grid_width(cell), rows as f64 * (row + CELL_GAP) - CELL_GAP);
    let (full_width, full_height) = match (shared, beside) {
        (true, true) => (width + 24.0 + widest, height.max(top + highest)),
        (true, false) => (width.max(widest), height + highest),
        _ => (width, height),
    };
    let mut canvas = Canvas::new(full_width + 2.0 * EDGE, full_height + 2.0 * EDGE);
    for (k, (plan, legend)) in plans.iter().zip(&legends).enumerate() {
        let x = EDGE + (k % columns) as f64 * (cell + CELL_GAP);
        let y = EDGE + (k / columns) as f64 * (row + CELL_GAP);
        let origin = ((x + left).round(), (y + top + size.1).round());
        plan.draw(&mut canvas, origin);
        if !shared {
            let inset = (left + (size.0 - legend.width) / 2.0)
                .min(cell - legend.width)
                .max(0.0);
            legend.draw(&mut canvas, (x + inset, origin.1 + bottom + 16.0));
        }
    }
    for legend in legends.iter().take(usize::from(shared)) {
        let middle = if columns == 1 {
            left + size.0 / 2.0
        } else {
            width / 2.0
        };
        let inset = (middle - legend.width / 2.0)
            .min(full_width - legend.width)
            .max(0.0);
        let at = if beside {
            (width + 24.0, top)
        } else {
            (inset, height + 16.0)
        };
        legend.draw(&mut canvas, (EDGE + at.0, EDGE + at.1));
    }
    canvas.save(path)
}

/// Colour of a value on the scale of a range; beyond its ends the colour of the end.
fn colour_of(value: f64, (lo, hi): (f64, f64)) -> Rgb {
    let (small, large) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    let (table, t) = if lo < 0.0 && hi > 0.0 && small >= 0.2 * large {
        (&DIVERGING, 0.5 + 0.5 * value.clamp(lo, hi) / large)
    } else {
        (&SEQUENTIAL, (value.clamp(lo, hi) - lo) / (hi - lo))
    };
    let place = t * (table.len() - 1) as f64;
    let index = (place as usize).min(table.len() - 2);
    let part = place - index as f64;
    [16, 8, 0].into_iter().fold(0, |colour, shift| {
        let channel = |k: usize| f64::from(table[k] >> shift & 255);
        let mixed = channel(index) + part * (channel(index + 1) - channel(index));
        colour << 8 | mixed.round() as Rgb
    })
}

/// Draws the colour bar, triangular at an end that values exceed, with its ticks.
fn draw_bar(canvas: &mut Canvas, scale: &Axis, beyond: (bool, bool), (x, bottom): Point) {
    let (top, tip, right) = (bottom - scale.length, x + BAR / 2.0, x + BAR);
    let colour = |px: f64| {
        let t = px / scale.length;
        colour_of(
            scale.range.0 + t * (scale.range.1 - scale.range.0),
            scale.range,
        )
    };
    for k in 0..scale.length as usize {
        let y = bottom - k as f64;
        canvas.rectangle([x, y - 1.0, right, y], colour(k as f64 + 0.5), 1.0);
    }
    let mut outline = vec![(right, top)];
    for (exceeded, ends, height, px) in [
        (beyond.0, [(right, bottom), (x, bottom)], BAR_TIP, 0.0),
        (beyond.1, [(x, top), (right, top)], -BAR_TIP, scale.length),
    ] {
        let peak = if exceeded { height } else { 0.0 };
        let corners = [ends[0], (tip, ends[0].1 + peak), ends[1]];
        if exceeded {
            canvas.polygon(&corners, colour(px));
        }
        outline.extend(corners);
    }
    canvas.stroke(&outline, 2.0, &[]);
    canvas.paint(INK, 1.0);
    for (v, label) in &scale.ticks {
        let y = (bottom - scale.at(*v)).round();
        canvas.rectangle([right, y - 1.0, right + 10.0, y + 1.0], INK, 1.0);
        canvas.text(label, (right + TICK, y), SMALL, (0.0, 0.5), false);
    }
}

/// Draws field panels as one PNG file, all with the same axes, equal scales and one colour bar.
///
/// # Errors
///
/// A figure without finite points or range, a panel whose points and values differ in number, or a
/// file that cannot be written.
pub fn draw_fields(path: &Path, figure: &FieldFigure) -> Result<(), PlotError> {
    register_fonts(path)?;
    let panels = &figure.panels;
    let mut all: Vec<Point> = Vec::new();
    for panel in panels {
        let (points, values) = (panel.points.len(), panel.values.len());
        if points != values {
            let (path, title) = (path.into(), panel.title.clone());
            return Err(PlotError::Lengths {
                path,
                title,
                points,
                values,
            });
        }
        let half = panel.size / 2.0;
        all.extend(
            panel
                .points
                .iter()
                .flat_map(|p| [(p.0 - half, p.1 - half), (p.0 + half, p.1 + half)]),
        );
        all.extend(&panel.outline);
    }
    all.retain(finite);
    let range = |pick: fn(&Point) -> f64| extent(all.iter().map(pick)).filter(|r| r.1 > r.0);
    let (Some(xs), Some(ys), Some(values)) = (
        range(|p| p.0),
        range(|p| p.1),
        extent([figure.range.0, figure.range.1].into_iter()),
    ) else {
        return Err(nothing(path, &figure.title));
    };

    // The axes: one scale of pixels for both directions, and a margin about the particles.
    let columns = figure.columns.min(panels.len()).max(1);
    let rows = panels.len().div_ceil(columns);
    let most = [
        (1250.0, 850.0),
        (720.0, 640.0),
        (500.0, 520.0),
        (400.0, 440.0),
    ][columns.min(4) - 1];
    let scale = (most.0 / (xs.1 - xs.0)).min(most.1 / (ys.1 - ys.0));
    let axis = |(lo, hi): Point, upright: bool| {
        let length = (scale * (hi - lo)).ceil() + 40.0;
        let (middle, half) = ((lo + hi) / 2.0, length / scale / 2.0);
        Axis::new((middle - half, middle + half), false, length, upright)
    };
    let (x, y) = (axis(xs, false), axis(ys, true));

    let titles: Vec<_> = panels
        .iter()
        .map(|p| wrap(&p.title, TITLE, x.length.max(260.0)))
        .collect();
    let x_label = wrap(&figure.x_label, LABEL, x.length.max(260.0));
    let y_label = wrap(&figure.y_label, LABEL, y.length.max(160.0));
    let lines = || titles.iter().flatten().map(|t| text_width(t, TITLE));
    let cell = largest(lines().chain([
        x.length,
        largest(x_label.iter().map(|t| text_width(t, LABEL))),
    ]));
    let pitch = cell + 36.0_f64.max(x.label_width() / 2.0 + 12.0);
    let left = block_height(&y_label, LABEL) + 12.0 + y.label_width() + TICK;
    let top = 12.0 + largest(titles.iter().map(|t| block_height(t, TITLE)));
    let below = LABEL_DROP + block_height(&x_label, LABEL);
    // Where the last row is not full, the row above it has labels too.
    let extra = if panels.len() < rows * columns && rows > 1 {
        below
    } else {
        0.0
    };
    let height = rows as f64 * (top + y.length) + (rows - 1) as f64 * ROW_GAP + extra;
    let bar_length = (height - top - 2.0 * BAR_TIP).clamp(230.0, 850.0).floor();
    let bar = Axis::new(widen(values, 0.0), false, bar_length, true);
    let bar_label = wrap(&figure.label, LABEL, bar_length + 2.0 * BAR_TIP);
    let bar_left = EDGE + left + columns as f64 * pitch - (pitch - cell) + 44.0;
    let bar_label_left = bar_left + BAR + TICK + bar.label_width() + 12.0;
    let width = bar_label_left + block_height(&bar_label, LABEL) + EDGE;
    let heading = wrap(&figure.title, HEADING, width - 2.0 * EDGE);
    let head = EDGE
        + if heading.is_empty() {
            0.0
        } else {
            block_height(&heading, HEADING) + 10.0
        };
    let bar_high = (top + bar_length + 2.0 * BAR_TIP).max(height + below);
    let mut canvas = Canvas::new(width, head + bar_high + EDGE);
    canvas.block(&heading, (width / 2.0, EDGE), HEADING, false);

    for (k, (panel, title)) in panels.iter().zip(&titles).enumerate() {
        let (row, column) = (k / columns, k % columns);
        let middle = EDGE + left + column as f64 * pitch + cell / 2.0;
        let down =
            row as f64 * (top + y.length + ROW_GAP) + if row + 1 == rows { extra } else { 0.0 };
        let (x0, y0) = (
            (middle - x.length / 2.0).round(),
            (head + down + top + y.length).round(),
        );
        let place = |p: &Point| (x0 + x.at(p.0), y0 - y.at(p.1));
        for (point, value) in panel
            .points
            .iter()
            .zip(&panel.values)
            .filter(|(p, _)| finite(p))
        {
            let [x0, y0, x1, y1] = around(&[place(point)], panel.size * scale / 2.0);
            let colour = if value.is_nan() {
                NO_VALUE
            } else {
                colour_of(*value, bar.range)
            };
            canvas.rectangle([x0.floor(), y0.floor(), x1.ceil(), y1.ceil()], colour, 1.0);
        }
        let outline = panel.outline.iter().chain(panel.outline.first());
        canvas.stroke(&outline.map(place).collect::<Vec<_>>(), 2.0, &[]);
        canvas.paint(INK, 1.0);
        let labels = [k + columns >= panels.len(), column == 0];
        draw_ticks(&mut canvas, [&x, &y], (x0, y0), labels, false);
        draw_box(&mut canvas, [x0, y0 - y.length, x0 + x.length, y0]);
        let above = y0 - y.length - 10.0 - block_height(title, TITLE);
        canvas.block(title, (middle, above), TITLE, false);
        if labels[0] {
            canvas.block(&x_label, (middle, y0 + LABEL_DROP), LABEL, false);
        }
        if labels[1] {
            canvas.block(&y_label, (x0 - left, y0 - y.length / 2.0), LABEL, true);
        }
    }
    let shown = || panels.iter().flat_map(|p| &p.values);
    let beyond = (
        shown().any(|v| *v < bar.range.0),
        shown().any(|v| *v > bar.range.1),
    );
    let middle = head + top + ((height - top) / 2.0).max(bar_length / 2.0 + BAR_TIP);
    draw_bar(
        &mut canvas,
        &bar,
        beyond,
        (bar_left.round(), (middle + bar_length / 2.0).round()),
    );
    canvas.block(&bar_label, (bar_label_left, middle), LABEL, true);
    canvas.save(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: Ticks) -> Vec<String> {
        let labels = ticks.into_iter().map(|t| t.1);
        labels.filter(|label| !label.is_empty()).collect()
    }

    fn chart() -> Chart {
        let points = vec![(0.5, 0.2), (0.25, 0.06), (f64::NAN, 0.03), (0.125, 0.013)];
        let (marker, dash) = (Marker::Circle, Dash::Dashed);
        Chart {
            title: "Convergence".into(),
            x_label: "cell size h (m)".into(),
            y_label: "relative error".into(),
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            series: vec![Series {
                name: "scheme".into(),
                points,
                colour: 9,
                marker,
                dash,
            }],
            reference_lines: vec![ReferenceLine {
                name: "exact".into(),
                value: 0.05,
                band: Some(0.1),
            }],
            slope_triangle: Some(SlopeTriangle {
                slope: 2.0,
                at: (0.2, 0.01),
                decades: 0.3,
            }),
            x_range: None,
            y_range: None,
        }
    }

    fn field(values: Vec<f64>) -> FieldFigure {
        let (points, outline) = (
            vec![(0.25, 0.25), (0.75, 0.25)],
            vec![(0.0, 0.0), (1.0, 0.5)],
        );
        FieldFigure {
            title: "Field".into(),
            panels: vec![FieldPanel {
                title: "a".into(),
                points,
                values,
                size: 0.5,
                outline,
            }],
            columns: 3,
            range: (0.0, 1.0),
            label: "stress (Pa)".into(),
            x_label: "x (m)".into(),
            y_label: "y (m)".into(),
        }
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(
            labels(linear_ticks(0.257, 0.283, 4)),
            ["0.26", "0.27", "0.28"]
        );
        assert_eq!(
            labels(linear_ticks(-1.0, 1.0, 5)),
            ["−1.0", "−0.5", "0", "0.5", "1.0"]
        );
        assert_eq!(
            labels(linear_ticks(0.0, 45_000.0, 3)),
            ["0", "20\u{2009}000", "40\u{2009}000"]
        );
        assert_eq!(
            labels(linear_ticks(-2.1e6, 0.0, 3)),
            ["−2×10⁶", "−1×10⁶", "0"]
        );
        assert_eq!(
            labels(linear_ticks(0.0, 4e-7, 3)),
            ["0", "2×10⁻⁷", "4×10⁻⁷"]
        );
        for (lo, hi) in [(0.1, 0.7), (-3e5, 12.0), (1e-9, 1.1e-9), (99.0, 101.0)] {
            for most in 2..10 {
                let (_, ticks) = nice_ticks(lo, hi, most);
                assert!(
                    !ticks.is_empty() && ticks.len() <= most,
                    "{lo} {hi} {most}: {ticks:?}"
                );
            }
        }
    }

    #[test]
    fn log_ticks_follow_the_span() {
        assert_eq!(
            labels(log_ticks(-3.2, 0.1, 9)),
            ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]
        );
        assert_eq!(
            labels(log_ticks(-12.0, 0.0, 5)),
            ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]
        );
        assert_eq!(labels(log_ticks(-1.0, 0.0, 9)), ["0.1", "0.2", "0.5", "1"]);
        assert_eq!(
            labels(log_ticks(0.26_f64.log10(), 0.29_f64.log10(), 3)),
            ["0.26", "0.28"]
        );
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
        assert_eq!(colour_of(0.0, (-2.0, 2.0)), DIVERGING[5]);
        assert_eq!(colour_of(0.0, (-1.0, 3.0)), DIVERGING[5]);
        assert!((0..50).all(|k| of(k, (-1.0, 1.0)) > of(k + 1, (-1.0, 1.0))));
        assert!((0..50).all(|k| of(-k, (-1.0, 1.0)) > of(-k - 1, (-1.0, 1.0))));
    }

    #[test]
    fn glyphs_have_the_librarys_advances() {
        register_fonts(Path::new("")).unwrap();
        // At this size, one pixel is the 2048th part of an em.
        let face = FontDesc::new(
            FontFamily::SansSerif,
            2048.0 * FONT_HEIGHT,
            FontStyle::Normal,
        );
        for c in "Aaimt1−⁻⁶²×νΔ\u{2009}".chars() {
            let advance = glyph_metrics(FONTS[0], c).unwrap().0 * 2048.0;
            let (theirs, _) = face.box_size(&c.to_string()).unwrap();
            assert!(
                (advance - f64::from(theirs)).abs() <= 1.0,
                "{c}: {advance} {theirs}"
            );
        }
        assert!(glyph_metrics(FONTS[0], '\u{E123}').is_none());
    }

    #[test]
    fn the_same_input_gives_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let draw = |name: &str| {
            let (a, b) = (
                folder.path().join(name),
                folder.path().join(format!("f{name}")),
            );
            draw_charts(&a, &[chart(), chart(), chart()], 2).unwrap();
            draw_fields(&b, &field(vec![f64::NAN, 2.0])).unwrap();
            (std::fs::read(a).unwrap(), std::fs::read(b).unwrap())
        };
        assert!(draw("a.png") == draw("b.png"));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        let path = Path::new("no such folder/picture.png");
        let mut bad = chart();
        bad.series[0].points[1].1 = 0.0;
        let error = draw_charts(path, &[bad.clone()], 1).unwrap_err();
        assert!(matches!(error, PlotError::NonPositive { value: 0.0, .. }));
        assert!(
            error.to_string().contains("picture.png")
                && error.to_string().contains("relative error")
        );
        bad.series[0].points.clear();
        let none = draw_charts(path, &[bad], 1);
        assert!(matches!(none, Err(PlotError::NoFiniteData { .. })));
        assert!(matches!(
            draw_charts(path, &[], 1),
            Err(PlotError::NoFiniteData { .. })
        ));
        let short = draw_fields(path, &field(vec![1.0]));
        assert!(matches!(
            short,
            Err(PlotError::Lengths {
                points: 2,
                values: 1,
                ..
            })
        ));
        assert!(matches!(
            draw_charts(path, &[chart()], 1),
            Err(PlotError::Write { .. })
        ));
    }
}
