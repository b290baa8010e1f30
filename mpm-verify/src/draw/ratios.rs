//! Ratios of named things on a logarithmic axis, one row a thing: which side of one they lie on is seen at a glance.

use super::canvas::Canvas;
use super::colour::{INK, PALETTE, Rgb};
use super::font::{HEADING, SMALL, TITLE};
use super::shape::Marker;
use super::{EDGE, PlotError, SOLID, largest, nothing};
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
    let known = ratios.rows.iter().flat_map(|(_, row)| row).flatten();
    let reach = largest(known.filter_map(|ratio| match ratio {
        Ratio::Of(ratio) => Some(ratio.log2().abs()),
        _ => None,
    }));
    // Whole powers of four.
    let reach = 2.0 * (reach / 2.0).ceil().max(1.0);
    let names = largest(ratios.rows.iter().map(|(name, _)| SMALL.width(name)));
    let (left, top) = (EDGE + names + 24.0, EDGE + 150.0);
    let (right, bottom) = (left + WIDTH, top + ROW * ratios.rows.len() as f64);
    let mut canvas = Canvas::new((right + EDGE, bottom + 75.0));
    let middle = f64::midpoint(left, right);
    let place = |ratio: Ratio| match ratio {
        Ratio::Of(ratio) => middle + (WIDTH / 2.0 - STRIP) * ratio.log2() / reach,
        Ratio::Least => left + STRIP / 2.0,
        Ratio::Most => right - STRIP / 2.0,
    };
    canvas.text(&ratios.title, (EDGE, EDGE), HEADING, (0.0, 0.0), false);
    let mut x = EDGE;
    for (k, kind) in ratios.kinds.iter().enumerate() {
        canvas.marker(MARKERS[k % 2], (x + 12.0, EDGE + 62.0), PALETTE[k], false);
        canvas.text(kind, (x + 34.0, EDGE + 62.0), SMALL, (0.0, 0.5), false);
        x += 80.0 + SMALL.width(kind);
    }
    for (k, [from, to]) in [[left, middle], [middle, right]].into_iter().enumerate() {
        canvas.rectangle([from, top, to, bottom], HALVES[k], 0.12);
        let (at, anchor) = [(from, 0.0), (to, 1.0)][k];
        canvas.text(
            &ratios.sides[k],
            (at, top - 30.0),
            TITLE,
            (anchor, 0.5),
            false,
        );
        let strip = [
            [from, top, from + STRIP, bottom],
            [to - STRIP, top, to, bottom],
        ][k];
        canvas.rectangle(strip, HALVES[k], 0.15);
        canvas.text(
            &ratios.ends[k],
            (at, bottom + 56.0),
            SMALL,
            (anchor, 0.5),
            false,
        );
    }
    let steps = (-(reach as i32)..=reach as i32).filter(|e| e % 2 == 0);
    for exponent in steps {
        let x = place(Ratio::Of(2f64.powi(exponent)));
        let width = if exponent == 0 { 3.0 } else { 1.0 };
        canvas.stroke(&[(x, top), (x, bottom)], width, INK, SOLID);
        let label = match exponent {
            e if e < 0 => format!("1/{}", 2u64.pow(e.unsigned_abs())),
            e => 2u64.pow(e.unsigned_abs()).to_string(),
        };
        canvas.text(&label, (x, bottom + 22.0), SMALL, (0.5, 0.5), false);
    }
    for (k, (name, row)) in ratios.rows.iter().enumerate() {
        let y = top + (k as f64 + 0.5) * ROW;
        canvas.stroke(&[(left, y), (right, y)], 0.5, INK, SOLID);
        canvas.text(name, (left - 24.0, y), SMALL, (1.0, 0.5), false);
        for (kind, ratio) in row.iter().enumerate() {
            if let Some(ratio) = ratio {
                // Two at the same place are both seen.
                let y = y + 9.0 * (2.0 * kind as f64 - 1.0);
                canvas.marker(MARKERS[kind % 2], (place(*ratio), y), PALETTE[kind], false);
            }
        }
    }
    canvas.save(path)?;
    canvas.save_svg(&path.with_extension("svg"))
}
