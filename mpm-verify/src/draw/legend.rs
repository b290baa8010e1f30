//! How the curves of a chart look, and the legends that tell.

use super::chart::{Chart, Dash};
use super::colour::{INK, PALETTE, Rgb};
use super::largest;
use super::marker::{LINE, Marker};
use super::page::{Page, Point};
use super::text::SMALL;

/// Length of a legend's line, height of its entries and gap of its columns.
const SAMPLE: f64 = 70.0;
const ENTRY_HEIGHT: f64 = 40.0;
const COLUMN_GAP: f64 = 40.0;
/// Opacity of a band about a line.
pub(super) const SHADE: f64 = 0.12;

/// An entry of a legend, with all that shows how its curve is drawn.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Entry<'a> {
    pub(super) name: &'a str,
    colour: Rgb,
    pub(super) marker: Marker,
    /// Lengths of dashes and gaps, if there is a line.
    pub(super) pattern: Option<&'static [f64]>,
    hollow: bool,
    band: bool,
}

impl<'a> Entry<'a> {
    /// Those of a chart's curves, then of its reference lines.
    pub(super) fn all(chart: &'a Chart) -> Vec<Self> {
        let curves = chart.series.iter().map(|series| Self {
            name: &series.name,
            colour: PALETTE[series.colour % PALETTE.len()],
            marker: series.marker,
            pattern: match series.dash {
                Dash::Solid => Some(&[]),
                Dash::Dashed => Some(&[18.0, 10.0]),
                Dash::Dotted => Some(&[4.0, 7.0]),
                Dash::None => None,
            },
            hollow: matches!(series.dash, Dash::Dashed | Dash::Dotted),
            band: false,
        });
        let lines = chart.reference_lines.iter().map(|line| Self {
            name: &line.name,
            colour: INK,
            marker: Marker::None,
            pattern: Some(&[22.0, 8.0, 4.0, 8.0]),
            hollow: false,
            band: line.band.is_some(),
        });
        curves.chain(lines).collect()
    }

    /// Those that all charts have in common, if they differ in markers at most; those are left out.
    pub(super) fn common<'e>(charts: impl Iterator<Item = &'e [Self]>) -> Option<Vec<Self>>
    where
        Self: 'e,
    {
        let bare = |entry: &Self| Self { marker: Marker::None, ..*entry };
        let mut common: Option<Vec<Self>> = None;
        for chart in charts {
            let first = common.get_or_insert_with(|| chart.to_vec());
            if !chart.iter().map(bare).eq(first.iter().map(bare)) {
                return None;
            }
            for (entry, other) in first.iter_mut().zip(chart) {
                *entry = if entry == other { *entry } else { bare(entry) };
            }
        }
        common
    }

    /// Draws the curve through points; none if there are only markers.
    pub(super) fn line(&self, page: &mut Page, points: &[Point]) {
        if let Some(pattern) = self.pattern {
            page.line(points, LINE, self.colour, pattern);
        }
    }

    /// Draws a marker at a point.
    pub(super) fn mark(&self, page: &mut Page, at: Point) {
        page.marker(self.marker, at, self.colour, self.hollow);
    }
}

/// Entries laid out in columns, filled one by one.
pub(super) struct Legend<'a> {
    entries: Vec<Entry<'a>>,
    rows: usize,
    column: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl<'a> Legend<'a> {
    /// At most `room` pixels wide, if one column allows it.
    pub(super) fn new(entries: &[Entry<'a>], room: f64) -> Self {
        let entries: Vec<_> = entries.iter().filter(|e| !e.name.is_empty()).copied().collect();
        let widest = largest(entries.iter().map(|e| SMALL.width(e.name)));
        let column = SAMPLE + 14.0 + widest + COLUMN_GAP;
        let columns = (((room + COLUMN_GAP) / column) as usize).max(1);
        let rows = entries.len().div_ceil(columns).max(1);
        Self {
            width: entries.len().div_ceil(rows) as f64 * column - COLUMN_GAP,
            entries,
            rows,
            column,
            height: rows as f64 * ENTRY_HEIGHT,
        }
    }

    pub(super) fn draw(&self, page: &mut Page, (left, top): Point) {
        for (k, entry) in self.entries.iter().enumerate() {
            let x = left + (k / self.rows) as f64 * self.column;
            let y = top + ((k % self.rows) as f64 + 0.5) * ENTRY_HEIGHT;
            if entry.band {
                page.rectangle([x, y - 13.0, x + SAMPLE, y + 13.0], INK, SHADE);
            }
            entry.line(page, &[(x + 2.0, y), (x + SAMPLE - 2.0, y)]);
            entry.mark(page, (x + SAMPLE / 2.0, y));
            page.text(entry.name, (x + SAMPLE + 14.0, y), SMALL, (0.0, 0.5));
        }
    }
}
