//! Panels in rows below a heading, with one colour bar beside them.

use super::axes::{Axis, THIN, TICK, widen};
use super::colour::{INK, Rgb};
use super::page::{Drawn, Frame, Medium, Page, Point, area, corners, stroke};
use super::text::{Block, HEADING, LABEL, SMALL, TITLE, write};
use super::{EDGE, largest};

/// Distance of rows, from a panel's title to it, and from the panels to the colour bar.
const ROW_GAP: f64 = 24.0;
const TITLE_GAP: f64 = 12.0;
const BAR_GAP: f64 = 44.0;
/// Width of the colour bar, height of its triangular ends, and its least and largest length.
const BAR: f64 = 36.0;
const TIP: f64 = 32.0;
const LENGTHS: Point = (230.0, 850.0);

/// Colour of a value on the scale of a range.
pub(super) type Colouring = fn(f64, Point) -> Rgb;

/// A colour bar, triangular at an end that values exceed.
pub(super) struct Bar {
    pub(super) range: Point,
    pub(super) label: String,
    pub(super) colouring: Colouring,
    pub(super) beyond: [bool; 2],
}

impl Bar {
    pub(super) fn new<'a>(
        range: Point,
        label: &str,
        colouring: Colouring,
        values: impl Iterator<Item = &'a f64> + Clone,
    ) -> Self {
        let range = widen(range, 0.0);
        let beyond = [
            values.clone().any(|v| *v < range.0),
            values.clone().any(|v| *v > range.1),
        ];
        Self {
            range,
            label: label.to_owned(),
            colouring,
            beyond,
        }
    }

    fn scale(&self, length: f64) -> (Axis, Block) {
        let label = Block::new(&self.label, LABEL, length + 2.0 * TIP);
        (Axis::new(self.range, false, length, true), label)
    }

    /// Width of a bar of a length, with its labels.
    fn width(&self, length: f64) -> f64 {
        let (scale, label) = self.scale(length);
        BAR + TICK + scale.label_width() + 12.0 + label.height()
    }

    fn draw<B: Medium>(&self, page: &Page<B>, (x, middle): Point, length: f64) -> Drawn<B> {
        let (scale, label) = self.scale(length);
        let (lo, hi) = self.range;
        let (top, bottom) = (middle - length / 2.0, middle + length / 2.0);
        let (tip, right) = (x + BAR / 2.0, x + BAR);
        for k in 0..length as u32 {
            let part = (f64::from(k) + 0.5) / length;
            let colour = (self.colouring)(lo + part * (hi - lo), self.range);
            let y = bottom - f64::from(k);
            area(page, &corners([x, y - 1.0, right, y]), colour, 1.0)?;
        }
        let [below, above] = self.beyond.map(|beyond| if beyond { TIP } else { 0.0 });
        let lower = [(right, bottom), (tip, bottom + below), (x, bottom)];
        let upper = [(x, top), (tip, top - above), (right, top)];
        for (end, peak, corners) in [(lo, below, lower), (hi, above, upper)] {
            if peak > 0.0 {
                area(page, &corners, (self.colouring)(end, self.range), 1.0)?;
            }
        }
        let outline = [&lower[..], &upper, &lower[..1]].concat();
        stroke(page, &outline, THIN, INK, &[])?;
        for (along, text) in scale.marks() {
            let y = bottom - along;
            stroke(page, &[(right, y), (right + TICK / 2.0, y)], THIN, INK, &[])?;
            write(page, text, (right + TICK, y), SMALL, (0.0, 0.5), false)?;
        }
        let beside = right + TICK + scale.label_width() + 12.0;
        label.draw(page, (beside, middle), true)
    }
}

/// Where panels of one size lie.
pub(super) struct Panels {
    heading: Block,
    titles: Vec<Block>,
    bar: Bar,
    pub(super) columns: usize,
    /// Size of a panel; room for labels on its left, right and below.
    panel: Point,
    room: [f64; 3],
    /// Width of the widest panel or title, and distance of columns.
    cell: f64,
    pitch: f64,
    /// Height of a title, and the bar's length.
    above: f64,
    length: f64,
}

impl Panels {
    pub(super) fn new(
        heading: &str,
        titles: Vec<&str>,
        columns: usize,
        (panel, room): (Point, [f64; 3]),
        gap: f64,
        bar: Bar,
    ) -> Self {
        let width = panel.0.max(260.0);
        let titles: Vec<_> = titles
            .into_iter()
            .map(|t| Block::new(t, TITLE, width))
            .collect();
        let cell = largest(titles.iter().map(Block::width)).max(panel.0).ceil();
        let above = TITLE_GAP + largest(titles.iter().map(Block::height));
        let mut panels = Self {
            heading: Block::new("", HEADING, 0.0),
            columns: columns.min(titles.len()).max(1),
            titles,
            bar,
            panel,
            room,
            cell,
            pitch: cell + gap.ceil(),
            above: above.ceil(),
            length: 0.0,
        };
        let free = panels.height() - panels.above - 2.0 * TIP;
        panels.length = free.clamp(LENGTHS.0, LENGTHS.1).floor();
        panels.heading = Block::new(heading, HEADING, panels.size().0 - 2.0 * EDGE);
        panels
    }

    /// Whether the last row is not full: then the row above it has labels too.
    fn ragged(&self) -> f64 {
        let rows = self.titles.len().div_ceil(self.columns);
        let ragged = rows > 1 && self.titles.len() < rows * self.columns;
        if ragged { self.room[2] } else { 0.0 }
    }

    /// From the first title to the end of the last row.
    fn height(&self) -> f64 {
        let rows = self.titles.len().div_ceil(self.columns) as f64;
        rows * (self.above + self.panel.1 + ROW_GAP) - ROW_GAP + self.ragged()
    }

    fn head(&self) -> f64 {
        (EDGE + self.heading.height() * 1.2).round()
    }

    fn bar_left(&self) -> f64 {
        let panels = (self.columns - 1) as f64 * self.pitch + self.cell;
        (EDGE + self.room[0] + panels + self.room[1] + BAR_GAP).round()
    }

    /// Size of the picture.
    pub(super) fn size(&self) -> Point {
        let bar = self.above + self.length + 2.0 * TIP;
        let full = bar.max(self.height() + self.room[2]);
        let width = self.bar_left() + self.bar.width(self.length);
        (width + EDGE, self.head() + full + EDGE)
    }

    /// The box of a panel.
    pub(super) fn frame(&self, k: usize) -> Frame {
        let (row, column) = (k / self.columns, k % self.columns);
        let aside = (self.cell - self.panel.0) / 2.0;
        let left = EDGE + self.room[0] + column as f64 * self.pitch + aside;
        let down = row as f64 * (self.above + self.panel.1 + ROW_GAP);
        let last = row > 0 && (row + 1) * self.columns >= self.titles.len();
        let extra = if last { self.ragged() } else { 0.0 };
        let (left, top) = (
            left.round(),
            (self.head() + down + extra + self.above).round(),
        );
        [left, top, left + self.panel.0, top + self.panel.1]
    }

    /// Whether a panel has labels below, and on its left.
    pub(super) fn labelled(&self, k: usize) -> [bool; 2] {
        [k + self.columns >= self.titles.len(), k % self.columns == 0]
    }

    /// Draws all about the panels.
    pub(super) fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B> {
        self.heading
            .draw(page, (self.size().0 / 2.0, EDGE), false)?;
        for (k, title) in self.titles.iter().enumerate() {
            let [left, top, right, _] = self.frame(k);
            let over = top - TITLE_GAP - title.height();
            title.draw(page, ((left + right) / 2.0, over), false)?;
        }
        let panels = self.head() + self.above + (self.height() - self.above) / 2.0;
        let least = self.head() + self.above + self.length / 2.0 + TIP;
        let at = (self.bar_left(), panels.max(least).round());
        self.bar.draw(page, at, self.length)
    }
}
