//! How the curves of a chart look, and the legends that tell.

use super::backend::{Failure, Own, Sheet, lettering, placed, shade};
use super::canvas::Canvas;
use super::chart::{Chart, Dash};
use super::colour::{INK, PALETTE, Rgb};
use super::font::SMALL;
use super::shape::{LINE, Marker, Point};
use super::{SOLID, largest};
use plotters::element::Rectangle;
use plotters::style::text_anchor::{HPos, VPos};

/// Length of a legend's line, height of its entries and gap of its columns.
const SAMPLE: f64 = 70.0;
const ENTRY_HEIGHT: f64 = 40.0;
const COLUMN_GAP: f64 = 40.0;
/// Lengths of dashes and gaps.
const DASHED: &[f64] = &[16.0, 10.0];
const DOTTED: &[f64] = &[1.0, 8.0];
const DASH_DOT: &[f64] = &[20.0, 9.0, 1.0, 9.0];

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
                Dash::Solid => Some(SOLID),
                Dash::Dashed => Some(DASHED),
                Dash::Dotted => Some(DOTTED),
                Dash::None => None,
            },
            hollow: matches!(series.dash, Dash::Dashed | Dash::Dotted),
            band: false,
        });
        let lines = chart.reference_lines.iter().map(|line| Self {
            name: &line.name,
            colour: INK,
            marker: Marker::None,
            pattern: Some(DASH_DOT),
            hollow: false,
            band: line.band.is_some(),
        });
        curves.chain(lines).collect()
    }

    /// Those that all charts have in common, if they differ in markers at most; those are left out.
    pub(super) fn common(charts: &[Vec<Self>]) -> Option<Vec<Self>> {
        let bare = |entry: &Self| Self {
            marker: Marker::None,
            ..*entry
        };
        let first = charts.first()?;
        let alike = |other: &Vec<Self>| other.iter().map(bare).eq(first.iter().map(bare));
        let same = |k: usize| charts.iter().all(|c| c[k].marker == first[k].marker);
        let entry = |(k, entry): (usize, &Self)| if same(k) { *entry } else { bare(entry) };
        let entries = || first.iter().enumerate().map(entry).collect();
        charts.iter().all(alike).then(entries)
    }

    /// The curve through points; none if there are only markers.
    pub(super) fn line<C>(
        &self,
        points: Vec<C>,
    ) -> Own<C, impl Fn(&mut Canvas, &[Point]) + use<C>> {
        let (colour, pattern) = (self.colour, self.pattern);
        Own::new(points, move |canvas, points| {
            if let Some(pattern) = pattern {
                canvas.stroke(points, LINE, colour, pattern);
            }
        })
    }

    /// A marker at a point.
    pub(super) fn mark<C>(&self, at: C) -> Own<C, impl Fn(&mut Canvas, &[Point]) + use<C>> {
        let (marker, colour, hollow) = (self.marker, self.colour, self.hollow);
        Own::new(vec![at], move |canvas, at| {
            canvas.marker(marker, at[0], colour, hollow)
        })
    }
}

/// Entries laid out in columns, filled one by one.
pub(super) struct Legend<'a> {
    entries: Vec<&'a Entry<'a>>,
    rows: usize,
    column: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl<'a> Legend<'a> {
    /// At most `room` pixels wide, if one column allows it.
    pub(super) fn new(entries: &'a [Entry<'a>], room: f64) -> Self {
        let entries: Vec<_> = entries.iter().filter(|e| !e.name.is_empty()).collect();
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

    pub(super) fn draw(&self, sheet: &Sheet, (left, top): Point) -> Result<(), Failure> {
        for (k, entry) in self.entries.iter().enumerate() {
            let x = left + (k / self.rows) as f64 * self.column;
            let y = top + ((k % self.rows) as f64 + 0.5) * ENTRY_HEIGHT;
            let at = |across: f64, down: f64| placed((x + across, y + down));
            if entry.band {
                sheet.draw(&Rectangle::new(
                    [at(0.0, -13.0), at(SAMPLE, 13.0)],
                    shade(INK),
                ))?;
            }
            sheet.draw(&entry.line(vec![at(2.0, 0.0), at(SAMPLE - 2.0, 0.0)]))?;
            sheet.draw(&entry.mark(at(SAMPLE / 2.0, 0.0)))?;
            let style = lettering(SMALL, HPos::Left, VPos::Center);
            sheet.draw_text(entry.name, &style, at(SAMPLE + 14.0, 0.0))?;
        }
        Ok(())
    }
}
