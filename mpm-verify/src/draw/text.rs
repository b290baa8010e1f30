//! Text: two fonts that come with the program, widths, lines that are broken to a width.

use super::colour::INK;
use super::largest;
use super::page::{FAMILY, FINE, Page, Point, ink, spot};
use plotters::element::Text;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, FontTransform, TextStyle, register_font};
use std::sync::Once;

/// A font: its size (the em, in pixels), and whether it is bold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Font(f64, bool);

pub(super) const SMALL: Font = Font(25.0, false);
pub(super) const LABEL: Font = Font(28.0, false);
pub(super) const TITLE: Font = Font(29.0, true);
pub(super) const HEADING: Font = Font(32.0, true);
/// Distance of lines and height of a capital, in sizes of the font.
const LEADING: f64 = 1.35;
const CAPITAL: f64 = 0.73;
/// Plotters' size of a font: from ascent to descent, in sizes of the font.
const FULL: f64 = 1.164;
/// By how much plotters draws text too high, in sizes of the font: as pixels and as SVG.
const LIFT: [f64; 2] = [0.25, 0.09];
/// Bar over the letter before, which plotters would draw as pixels over the one behind.
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
        let style = [FontStyle::Normal, FontStyle::Bold][usize::from(self.1)];
        let size = FULL * f64::from(FINE) * self.0;
        FontDesc::new(FontFamily::Name(FAMILY), size, style)
    }

    /// Width of a line of text (pixels).
    pub(super) fn width(self, text: &str) -> f64 {
        let size = self.description().box_size(text);
        size.map_or(0.0, |(width, _)| f64::from(width) / f64::from(FINE))
    }
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
        self.text.lines().count() as f64 * self.font.0 * LEADING
    }

    pub(super) fn width(&self) -> f64 {
        largest(self.text.lines().map(|line| self.font.width(line)))
    }
}

impl Page<'_> {
    /// Draws lines of text, centred, downwards from a point (turned: rightwards).
    pub(super) fn block(&mut self, block: &Block, (x, y): Point, turned: bool) {
        for (k, line) in block.text.lines().enumerate() {
            let middle = (k as f64 + 0.5) * LEADING * block.font.0;
            let at = if turned { (x + middle, y) } else { (x, y + middle) };
            self.line_of_text(line, at, block.font, 0.5, turned);
        }
    }

    /// Draws text; `anchor` is the fraction of its width, and of the height of its capitals, that lies at the point.
    pub(super) fn text(&mut self, text: &str, at: Point, font: Font, anchor: Point) {
        let middle = at.1 + (0.5 - anchor.1) * CAPITAL * font.0;
        self.line_of_text(text, (at.0, middle), font, anchor.0, false);
    }

    /// Draws a line about its middle; turned, it reads upwards.
    fn line_of_text(&mut self, line: &str, at: Point, font: Font, anchor: f64, turned: bool) {
        let across = match anchor {
            a if a < 0.25 => HPos::Left,
            a if a > 0.75 => HPos::Right,
            _ => HPos::Center,
        };
        let mut style = TextStyle::from(font.description()).pos(Pos::new(across, VPos::Center));
        style.color = ink(INK, 1.0).to_backend_color();
        if turned {
            style = style.transform(FontTransform::Rotate270);
        }
        let place = |along: f64, down: f64| match turned {
            true => (at.0 + down * font.0, at.1 - along),
            false => (at.0 + along, at.1 + down * font.0),
        };
        let whole = !self.has_pixels();
        let plain = if whole { line.to_owned() } else { line.replace(BAR, "") };
        let start = -anchor * font.width(&plain);
        let foot = spot(place(0.0, LIFT[usize::from(whole)]));
        self.put(&Text::new(plain, foot, style));
        for (end, _) in line.match_indices(BAR).filter(|_| !whole) {
            let before = line[..end].replace(BAR, "");
            let letter = before.char_indices().next_back().map_or(0, |(k, _)| k);
            let ends = [&before[..letter], &before].map(|text| start + font.width(text));
            let bar = ends.map(|along| place(along + 0.04 * font.0, -0.5));
            self.line(&bar, 0.07 * font.0, INK, &[]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::pixels;
    use super::*;
    use std::path::Path;

    #[test]
    fn both_fonts_have_the_characters_of_labels() {
        let greek = "αβγδεζηθκλμνπρστφωΓΔΘΠΣΦΩ";
        let marks = "−–—…×·±≤≥≈≠∂∇∫√∞→°²³½¼′″⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂₃\u{2009}\u{a0}\u{202f}éäöü";
        let ascii: String = (' '..='~').collect();
        for font in [SMALL, TITLE] {
            let drawn = |text: &str| {
                let draw = |page: &mut Page| page.text(text, (20.0, 20.0), font, (0.5, 0.5));
                pixels(Path::new(""), (40.0, 40.0), 1, draw).unwrap()
            };
            // A character without a glyph is drawn as a blank.
            let blank = drawn("\u{4e2d}");
            for c in [greek, marks, &ascii].concat().chars() {
                let seen = c.is_whitespace() || drawn(&c.to_string()) != blank;
                assert!(seen, "no glyph of {c:?}");
            }
            assert!(drawn("F\u{304}") != drawn("F"));
        }
        let twice = SMALL.width("mm") - 2.0 * SMALL.width("m");
        assert!(twice.abs() < 0.5 && SMALL.width("m") > 15.0);
    }

    #[test]
    fn blocks_are_no_wider_than_asked_for() {
        let block = Block::new("a title of many words, most of them short", TITLE, 200.0);
        assert!(block.width() <= 200.0 && block.text.lines().count() > 2);
    }
}
