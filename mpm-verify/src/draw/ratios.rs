//! Ratios of named things on a logarithmic axis, one row a thing: which side of one they lie on is seen at a glance.

use super::colour::{INK, PALETTE, Rgb};
use super::marker::Marker;
use super::page::save_both;
use super::text::{HEADING, SMALL, TITLE};
use super::{EDGE, PlotError, largest};
use std::path::Path;

/// A picture of ratios.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ratios {
    pub title: String,
    /// Meaning of a ratio below one and of one above.
    pub sides: [String; 2],
    /// Meaning of zero, where only the first of the two is there, and of infinity, where only the second is.
    pub ends: [String; 2],
    /// Kinds that are compared: a marker each.
    pub kinds: Vec<String>,
    /// Name and, kind by kind, ratio.
    pub rows: Vec<(String, Vec<Option<f64>>)>,
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
pub(crate) fn draw_ratios(path: &Path, ratios: &Ratios) -> Result<(), PlotError> {
    if ratios.rows.is_empty() {
        return Err(PlotError::no_data(path, &ratios.title));
    }
    let known = ratios.rows.iter().flat_map(|(_, row)| row).flatten();
    let reach = largest(known.map(|ratio| ratio.log2().abs()).filter(|reach| reach.is_finite()));
    // Whole powers of four.
    let reach = 2.0 * (reach / 2.0).ceil().max(1.0);
    let names = largest(ratios.rows.iter().map(|(name, _)| SMALL.width(name)));
    let (left, top) = (EDGE + names + 24.0, EDGE + 150.0);
    let (right, bottom) = (left + WIDTH, top + ROW * ratios.rows.len() as f64);
    let middle = f64::midpoint(left, right);
    let place = |ratio: f64| match ratio {
        0.0 => left + STRIP / 2.0,
        f64::INFINITY => right - STRIP / 2.0,
        ratio => middle + (WIDTH / 2.0 - STRIP) * ratio.log2() / reach,
    };
    save_both(path, (right + EDGE, bottom + 75.0), |page| {
        page.text(&ratios.title, (EDGE, EDGE), HEADING, (0.0, 0.0));
        let mut x = EDGE;
        for (k, kind) in ratios.kinds.iter().enumerate() {
            page.marker(MARKERS[k % 2], (x + 12.0, EDGE + 62.0), PALETTE[k], false);
            page.text(kind, (x + 34.0, EDGE + 62.0), SMALL, (0.0, 0.5));
            x += 80.0 + SMALL.width(kind);
        }
        for (k, (outer, inwards)) in [(left, 1.0), (right, -1.0)].into_iter().enumerate() {
            for (width, opacity) in [(WIDTH / 2.0, 0.12), (STRIP, 0.15)] {
                let inner = outer + inwards * width;
                let frame = [outer.min(inner), top, outer.max(inner), bottom];
                page.rectangle(frame, HALVES[k], opacity);
            }
            page.text(&ratios.sides[k], (outer, top - 30.0), TITLE, (k as f64, 0.5));
            page.text(&ratios.ends[k], (outer, bottom + 56.0), SMALL, (k as f64, 0.5));
        }
        for exponent in (-(reach as i32)..=reach as i32).filter(|e| e % 2 == 0) {
            let x = place(2f64.powi(exponent));
            let width = if exponent == 0 { 3.0 } else { 1.0 };
            page.line(&[(x, top), (x, bottom)], width, INK, &[]);
            let part = if exponent < 0 { "1/" } else { "" };
            let label = format!("{part}{}", 2u64.pow(exponent.unsigned_abs()));
            page.text(&label, (x, bottom + 22.0), SMALL, (0.5, 0.5));
        }
        for (k, (name, row)) in ratios.rows.iter().enumerate() {
            let y = top + (k as f64 + 0.5) * ROW;
            page.line(&[(left, y), (right, y)], 0.5, INK, &[]);
            page.text(name, (left - 24.0, y), SMALL, (1.0, 0.5));
            for (kind, ratio) in row.iter().enumerate().filter_map(|(k, r)| Some((k, (*r)?))) {
                // Two at the same place are both seen.
                let at = (place(ratio), y + 9.0 * (2.0 * kind as f64 - 1.0));
                page.marker(MARKERS[kind % 2], at, PALETTE[kind], false);
            }
        }
    })
}
