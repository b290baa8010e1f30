//! Text: two fonts that come with the program, widths, lines that are broken to a width.

use super::colour::INK;
use super::largest;
use super::page::{Drawn, FINE, Medium, Page, Point, ink, spot, stroke};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontFamily, FontStyle, FontTransform, TextStyle, register_font,
};
use std::sync::Once;

/// A font: its size (the em, in pixels), and whether it is bold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Font {
    pub(super) size: f64,
    pub(super) bold: bool,
}

const fn font(size: f64, bold: bool) -> Font {
    Font { size, bold }
}

pub(super) const SMALL: Font = font(25.0, false);
pub(super) const LABEL: Font = font(28.0, false);
pub(super) const TITLE: Font = font(29.0, true);
pub(super) const HEADING: Font = font(32.0, true);
/// Distance of lines and height of a capital, in sizes of the font.
pub(super) const LEADING: f64 = 1.35;
const CAPITAL: f64 = 0.73;
/// The fonts' name here, and what a browser takes that lacks them.
pub(super) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";
/// Plotters' size of a font: from ascent to descent, in sizes of the font.
const FULL: f64 = 1.164;
/// Bar over the letter before, which plotters would draw over the one behind.
const BAR: char = '\u{304}';

impl Font {
    fn description(self) -> FontDesc<'static> {
        static FONTS: Once = Once::new();
        FONTS.call_once(|| {
            let plain = include_bytes!("../../assets/fonts/DejaVuSans.ttf");
            let bold = include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf");
            // Without its font, drawing text fails.
            let _ = register_font(FAMILY, FontStyle::Normal, plain);
            let _ = register_font(FAMILY, FontStyle::Bold, bold);
        });
        let style = match self.bold {
            true => FontStyle::Bold,
            false => FontStyle::Normal,
        };
        let size = FULL * f64::from(FINE) * self.size;
        FontDesc::new(FontFamily::Name(FAMILY), size, style)
    }

    /// Plotters' style of text whose middle line lies where it is put.
    pub(super) fn style(self, across: HPos) -> TextStyle<'static> {
        let mut style = TextStyle::from(self.description());
        style.color = ink(INK).to_backend_color();
        style.pos(Pos::new(across, VPos::Center))
    }

    /// By how much plotters draws such text too high (pixels).
    pub(super) fn lift<B: Medium>(self) -> f64 {
        self.size * if B::PIXELS { 0.25 } else { 0.09 }
    }

    /// Width of a line of text (pixels).
    pub(super) fn width(self, text: &str) -> f64 {
        let size = self.description().box_size(text);
        size.map_or(0.0, |(width, _)| f64::from(width) / f64::from(FINE))
    }
}

/// Draws lines of text; `anchor` is the fraction of each one's width, and of the height from the first one's
/// capitals to the last baseline, that lies at the point. Turned text reads upwards, with `anchor` turned along.
pub(super) fn write<B: Medium>(
    page: &Page<B>,
    text: &str,
    at: Point,
    font: Font,
    anchor: Point,
    turned: bool,
) -> Drawn<B> {
    let across = match anchor.0 {
        a if a < 0.25 => HPos::Left,
        a if a > 0.75 => HPos::Right,
        _ => HPos::Center,
    };
    let mut style = font.style(across);
    if turned {
        style = style.transform(FontTransform::Rotate270);
    }
    let more = text.lines().count().saturating_sub(1) as f64;
    let above = anchor.1 * (more * LEADING + CAPITAL);
    for (k, line) in text.lines().enumerate() {
        let middle = (k as f64 * LEADING + CAPITAL / 2.0 - above) * font.size;
        let place = |along: f64, down: f64| match turned {
            true => (at.0 + middle + down, at.1 - along),
            false => (at.0 + along, at.1 + middle + down),
        };
        let lift = font.lift::<B>();
        if !B::PIXELS {
            page.draw_text(line, &style, spot(place(0.0, lift)))?;
            continue;
        }
        let plain = line.replace(BAR, "");
        page.draw_text(&plain, &style, spot(place(0.0, lift)))?;
        let start = -anchor.0 * font.width(&plain);
        for (end, _) in line.match_indices(BAR) {
            let before = line[..end].replace(BAR, "");
            let letter = before.char_indices().next_back().map_or(0, |(k, _)| k);
            let [from, to] = [&before[..letter], &before].map(|text| start + font.width(text));
            let bar = [from, to].map(|along| place(along + 0.04 * font.size, -0.5 * font.size));
            stroke(page, &bar, 0.07 * font.size, INK, &[])?;
        }
    }
    Ok(())
}

/// Lines of text.
pub(super) struct Block {
    text: String,
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
        let text = lines.join("\n");
        Self { text, font }
    }

    pub(super) fn height(&self) -> f64 {
        self.text.lines().count() as f64 * self.font.size * LEADING
    }

    pub(super) fn width(&self) -> f64 {
        largest(self.text.lines().map(|line| self.font.width(line)))
    }

    /// Draws the lines, centred, downwards from a point (turned: rightwards).
    pub(super) fn draw<B: Medium>(&self, page: &Page<B>, (x, y): Point, turned: bool) -> Drawn<B> {
        let margin = (LEADING - CAPITAL) / 2.0 * self.font.size;
        let at = match turned {
            true => (x + margin, y),
            false => (x, y + margin),
        };
        write(page, &self.text, at, self.font, (0.5, 0.0), turned)
    }
}
