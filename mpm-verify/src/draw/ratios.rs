//! Ratios of named things on a logarithmic axis, one row a thing: which side of one they lie on is seen at a glance.

use super::colour::{INK, PALETTE, Rgb};
use super::marker::Marker;
use super::page::{Drawn, Medium, Page, Picture, Point, area, corners, stroke};
use super::text::{HEADING, SMALL, TITLE, write};
use super::{EDGE, PlotError, largest, nothing};
use std::path::Path;

/// A ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ratio {
    /// Known.
    Of(f64),
    /// Only the first of the two is there: the ratio is less than any.
    Least,
    /// Only the second is.
    Most,
}

/// A picture of ratios.
#[derive(Debug, Clone, PartialEq)]
pub struct Ratios {
    /// Title.
    pub title: String,
    /// What a ratio below one and above one means.
    pub sides: [String; 2],
    /// What [`Ratio::Least`] and [`Ratio::Most`] mean.
    pub ends: [String; 2],
    /// What is compared: a marker each.
    pub kinds: Vec<String>,
    /// Name and, kind by kind, ratio.
    pub rows: Vec<(String, Vec<Option<Ratio>>)>,
}

const ROW: f64 = 50.0;
const WIDTH: f64 = 1000.0;
/// Width of the strips at the ends.
const STRIP: f64 = 110.0;
const HALVES: [Rgb; 2] = [0x009E73, 0x7F7F7F];
const MARKERS: [Marker; 2] = [Marker::Circle, Marker::Square];

/// Draws ratios as PNG, and as SVG beside it.
///
/// # Errors
/// There are none, or the picture can't be written.
pub fn draw_ratios(path: &Path, ratios: &Ratios) -> Result<(), PlotError> {
    if ratios.rows.is_empty() {
        return Err(nothing(path, &ratios.title));
    }
    ratios.save(path)?;
    ratios.save_svg(path)
}

impl Ratios {
    /// Upper left corner of the rows.
    fn corner(&self) -> Point {
        let names = largest(self.rows.iter().map(|(name, _)| SMALL.width(name)));
        (EDGE + names + 24.0, EDGE + 150.0)
    }

    /// The logarithm (base two) of the largest ratio, as a whole power of four.
    fn reach(&self) -> f64 {
        let known = self.rows.iter().flat_map(|(_, row)| row).flatten();
        let reach = largest(known.filter_map(|ratio| match ratio {
            Ratio::Of(ratio) => Some(ratio.log2().abs()),
            _ => None,
        }));
        2.0 * (reach / 2.0).ceil().max(1.0)
    }
}

impl Picture for Ratios {
    fn size(&self) -> Point {
        let (left, top) = self.corner();
        let height = top + ROW * self.rows.len() as f64 + 75.0;
        (left + WIDTH + EDGE, height)
    }

    fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B> {
        let ((left, top), reach) = (self.corner(), self.reach());
        let (right, bottom) = (left + WIDTH, top + ROW * self.rows.len() as f64);
        let middle = f64::midpoint(left, right);
        let place = |ratio: Ratio| match ratio {
            Ratio::Of(ratio) => middle + (WIDTH / 2.0 - STRIP) * ratio.log2() / reach,
            Ratio::Least => left + STRIP / 2.0,
            Ratio::Most => right - STRIP / 2.0,
        };
        let text = |text: &str, at, font, anchor| write(page, text, at, font, anchor, false);
        text(&self.title, (EDGE, EDGE), HEADING, (0.0, 0.0))?;
        let mut x = EDGE;
        for (k, kind) in self.kinds.iter().enumerate() {
            MARKERS[k % 2].draw(page, (x + 12.0, EDGE + 62.0), PALETTE[k], false)?;
            text(kind, (x + 34.0, EDGE + 62.0), SMALL, (0.0, 0.5))?;
            x += 80.0 + SMALL.width(kind);
        }
        let halves = [
            (left, middle, left, left + STRIP, 0.0),
            (middle, right, right - STRIP, right, 1.0),
        ];
        for (k, (from, to, begin, end, side)) in halves.into_iter().enumerate() {
            area(page, &corners([from, top, to, bottom]), HALVES[k], 0.12)?;
            area(page, &corners([begin, top, end, bottom]), HALVES[k], 0.15)?;
            let outer = [left, right][k];
            text(&self.sides[k], (outer, top - 30.0), TITLE, (side, 0.5))?;
            text(&self.ends[k], (outer, bottom + 56.0), SMALL, (side, 0.5))?;
        }
        for exponent in (-(reach as i32)..=reach as i32).filter(|e| e % 2 == 0) {
            let x = place(Ratio::Of(2f64.powi(exponent)));
            let width = if exponent == 0 { 3.0 } else { 1.0 };
            stroke(page, &[(x, top), (x, bottom)], width, INK, &[])?;
            let size = 2u64.pow(exponent.unsigned_abs());
            let label = match exponent < 0 {
                true => format!("1/{size}"),
                false => size.to_string(),
            };
            text(&label, (x, bottom + 22.0), SMALL, (0.5, 0.5))?;
        }
        for (k, (name, row)) in self.rows.iter().enumerate() {
            let y = top + (k as f64 + 0.5) * ROW;
            stroke(page, &[(left, y), (right, y)], 0.5, INK, &[])?;
            text(name, (left - 24.0, y), SMALL, (1.0, 0.5))?;
            for (kind, ratio) in row.iter().enumerate() {
                if let Some(ratio) = ratio {
                    // Two at the same place are both seen.
                    let y = y + 9.0 * (2.0 * kind as f64 - 1.0);
                    MARKERS[kind % 2].draw(page, (place(*ratio), y), PALETTE[kind], false)?;
                }
            }
        }
        Ok(())
    }
}
