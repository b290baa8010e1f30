//! Text: the two fonts, the widths of their characters, and lines that are broken to a width.

use super::largest;
use ttf_parser::Face;

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
/// Distance of text lines and height of a capital or digit, in sizes of the font.
pub(super) const LEADING: f64 = 1.35;
pub(super) const CAPITAL: f64 = 0.73;

impl Font {
    /// The font's file, parsed.
    pub(super) fn face(self) -> Option<Face<'static>> {
        let file: &[u8] = match self.bold {
            false => include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
            true => include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf"),
        };
        Face::parse(file, 0).ok()
    }

    /// Width of a line of text (pixels); a character without a glyph has none.
    pub(super) fn width(self, text: &str) -> f64 {
        self.face().map_or(0.0, |face| {
            let unit = self.size / f64::from(face.units_per_em());
            let glyphs = text.chars().filter_map(|c| face.glyph_index(c));
            let advances = glyphs.filter_map(|glyph| face.glyph_hor_advance(glyph));
            advances.map(|advance| unit * f64::from(advance)).sum()
        })
    }

    /// From the first line's capitals to the last one's baseline (pixels).
    pub(super) fn height(self, text: &str) -> f64 {
        let more = text.lines().count().saturating_sub(1);
        (more as f64 * LEADING + CAPITAL) * self.size
    }

    /// What a block has above its first capitals and below its last baseline (pixels).
    pub(super) fn margin(self) -> f64 {
        (LEADING - CAPITAL) / 2.0 * self.size
    }
}

/// Lines of text.
pub(super) struct Block {
    pub(super) text: String,
    pub(super) font: Font,
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_fonts_have_the_characters_of_labels() {
        let greek = "αβγδεζηθκλμνπρστφωΓΔΘΠΣΦΩ";
        let marks = "−–—…×·±≤≥≈≠∂∇∫√∞→°²³½¼′″F̄J̄⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂₃\u{2009}\u{a0}\u{202f}éäöü";
        let ascii: String = (' '..='~').collect();
        for font in [SMALL, TITLE] {
            let face = font.face().unwrap();
            for c in [greek, marks, &ascii].concat().chars() {
                assert!(face.glyph_index(c).is_some(), "no glyph of {c:?}");
            }
        }
        assert!(SMALL.width("mm") == 2.0 * SMALL.width("m") && SMALL.width("m") > 15.0);
    }
}
