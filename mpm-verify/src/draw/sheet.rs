//! Panels of one size in rows, with titles and room for labels, below a heading; and a colour bar beside them.

use super::axes::{Axis, RIGHT, THIN, TICK, widen};
use super::colour::{INK, Rgb};
use super::page::{Frame, Page, Point};
use super::text::{Block, HEADING, LABEL, TITLE};
use super::{EDGE, largest};

/// Distance of panels with their labels, and from a title to its panel.
const GAP: f64 = 30.0;
const TITLE_GAP: f64 = 12.0;
/// Distance of the colour bar from the panels, its width, the height of its triangular ends, and its length at least and
/// at most.
const BAR_GAP: f64 = 24.0;
const BAR: f64 = 36.0;
const TIP: f64 = 32.0;
const LENGTHS: Point = (230.0, 850.0);

/// Where panels lie.
pub(super) struct Sheet {
    heading: Block,
    titles: Vec<Block>,
    columns: usize,
    panel: Point,
    /// Left upper corner of the first panel, and distance of one from the next.
    start: Point,
    pitch: Point,
    /// Right and lower end of all, with their labels.
    pub(super) end: Point,
}

impl Sheet {
    /// With room for labels on the left, on the right and below every panel.
    pub(super) fn new(
        heading: &str,
        titles: Vec<&str>,
        columns: usize,
        panel: Point,
        [left, right, below]: [f64; 3],
    ) -> Self {
        let (rows, columns) = (titles.len().div_ceil(columns), columns as f64);
        let wrapped = |title| Block::new(title, TITLE, panel.0.max(260.0));
        let titles: Vec<Block> = titles.into_iter().map(wrapped).collect();
        let over = (largest(titles.iter().map(Block::width)) - panel.0) / 2.0;
        let (left, right) = (left.max(over).ceil(), right.max(over).ceil());
        let above = (TITLE_GAP + largest(titles.iter().map(Block::height))).ceil();
        let pitch = (left + panel.0.ceil() + right + GAP, above + (panel.1 + below).ceil() + GAP);
        let width = columns * pitch.0 - GAP;
        let heading = Block::new(heading, HEADING, width);
        let top = (EDGE + 1.2 * heading.height()).round();
        Self {
            heading,
            titles,
            columns: columns as usize,
            panel,
            start: (EDGE + left, top + above),
            pitch,
            end: (EDGE + width, top + rows as f64 * pitch.1 - GAP),
        }
    }

    pub(super) fn frame(&self, k: usize) -> Frame {
        let (row, column) = ((k / self.columns) as f64, (k % self.columns) as f64);
        let (left, top) = (self.start.0 + column * self.pitch.0, self.start.1 + row * self.pitch.1);
        [left, top, left + self.panel.0, top + self.panel.1]
    }

    /// Draws heading and titles.
    pub(super) fn draw(&self, page: &mut Page) {
        page.block(&self.heading, ((EDGE + self.end.0) / 2.0, EDGE), false);
        for (k, title) in self.titles.iter().enumerate() {
            let [left, top, right, _] = self.frame(k);
            let over = top - TITLE_GAP - title.height();
            page.block(title, ((left + right) / 2.0, over), false);
        }
    }
}

/// A colour bar, triangular at an end that values exceed.
pub(super) struct Bar {
    scale: Axis,
    label: Block,
    colouring: fn(f64, Point) -> Rgb,
    beyond: [bool; 2],
    /// Its lower left corner.
    corner: Point,
}

impl Bar {
    /// Beside the panels of a sheet.
    pub(super) fn new<'v>(
        sheet: &Sheet,
        (range, label): (Point, &str),
        colouring: fn(f64, Point) -> Rgb,
        values: impl Iterator<Item = &'v f64> + Clone,
    ) -> Self {
        let (range, top) = (widen(range, 0.0), sheet.start.1);
        let bottom = sheet.frame(sheet.titles.len().saturating_sub(1))[3];
        let length = (bottom - top - 2.0 * TIP).clamp(LENGTHS.0, LENGTHS.1).floor();
        let foot = ((top + bottom + length) / 2.0).max(top + TIP + length);
        Self {
            scale: Axis::new(range, false, length, true),
            label: Block::new(label, LABEL, length + 2.0 * TIP),
            colouring,
            beyond: [values.clone().any(|v| *v < range.0), values.clone().any(|v| *v > range.1)],
            corner: (sheet.end.0 + BAR_GAP, foot.round()),
        }
    }

    /// Values at the ends of its colours.
    pub(super) fn range(&self) -> Point {
        self.scale.range
    }

    /// The place of its label.
    fn beside(&self) -> f64 {
        self.corner.0 + BAR + TICK + self.scale.label_width() + 12.0
    }

    /// Size of the picture with it.
    pub(super) fn size(&self, sheet: &Sheet) -> Point {
        let height = sheet.end.1.max(self.corner.1 + TIP);
        (self.beside() + self.label.height() + EDGE, height + EDGE)
    }

    pub(super) fn draw(&self, page: &mut Page) {
        let (lo, hi) = self.scale.range;
        let ((x, bottom), length) = (self.corner, self.scale.length);
        let (top, tip, right) = (bottom - length, x + BAR / 2.0, x + BAR);
        let colour = |value| (self.colouring)(value, (lo, hi));
        for k in 0..length as u32 {
            let (y, part) = (bottom - f64::from(k), (f64::from(k) + 0.5) / length);
            page.rectangle([x, y - 1.0, right, y], colour(lo + part * (hi - lo)), 1.0);
        }
        let [below, above] = self.beyond.map(|beyond| if beyond { TIP } else { 0.0 });
        let lower = [(right, bottom), (tip, bottom + below), (x, bottom)];
        let upper = [(x, top), (tip, top - above), (right, top)];
        page.area(&lower, colour(lo), 1.0);
        page.area(&upper, colour(hi), 1.0);
        let outline = [&lower[..], &upper, &lower[..1]].concat();
        page.line(&outline, THIN, INK, &[]);
        let ends = [(right, bottom), (right, top)];
        self.scale.draw(page, ends, RIGHT, RIGHT);
        page.block(&self.label, (self.beside(), bottom - length / 2.0), true);
    }
}
