//! Axes: ranges, ticks and their labels, and the box that they make.

use super::colour::{INK, Rgb};
use super::page::{Frame, Page, Point, corners};
use super::text::{Block, LABEL, SMALL};
use super::{between, largest};

const GRID: Rgb = 0xE2E2E2;
const MINOR_GRID: Rgb = 0xF1F1F1;
/// Width of the lines of axes and grid.
pub(super) const THIN: f64 = 2.0;
/// Length of a major tick with its gap to the label.
pub(super) const TICK: f64 = 20.0;
/// Directions of ticks and labels.
pub(super) const BELOW: Point = (0.0, 1.0);
pub(super) const LEFT: Point = (-1.0, 0.0);
pub(super) const RIGHT: Point = (1.0, 0.0);
/// Distance from an axis to its label below.
const LABEL_DROP: f64 = TICK + 33.0;

/// Ticks as positions on the axis (log axes: of the logarithm) with labels; minor ones have none.
type Ticks = Vec<(f64, String)>;

/// The smallest 1-2-5 step that puts at most `most` ticks on a range, and these ticks.
fn nice_ticks(lo: f64, hi: f64, most: usize) -> (f64, Vec<f64>) {
    let decade = ((hi - lo) / most as f64).log10().floor() as i32;
    let steps = (0..4).flat_map(|e| [1.0, 2.0, 5.0].map(|d| d * 10f64.powi(decade + e)));
    let mut all = steps.map(|s| (s, (lo / s - 1e-9).ceil(), (hi / s + 1e-9).floor()));
    let fitting = all.find(|(_, first, last)| last - first < most as f64);
    let (step, first, last) = fitting.unwrap_or((hi - lo, 1.0, 0.0));
    let counts = 0..(last - first + 1.0) as usize;
    (step, counts.map(|k| (first + k as f64) * step).collect())
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    exponent.to_string().chars().map(digit).collect()
}

/// Label of a tick among ticks `step` apart, whose largest magnitude is `largest`.
pub(super) fn tick_label(value: f64, step: f64, largest: f64) -> String {
    if value.abs() < 1e-6 * step {
        return "0".to_string();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    let order = |v: f64| (v.log10() + 1e-9).floor() as i32;
    let digits = |exponent: i32| {
        let decimals = usize::try_from(exponent - order(step)).unwrap_or(0);
        format!("{:.decimals$}", value.abs() / 10f64.powi(exponent))
    };
    if !(1e-3..1e6).contains(&largest) {
        let exponent = order(largest);
        return format!("{sign}{}×10{}", digits(exponent), superscript(exponent));
    }
    let mut label = digits(0);
    let whole = label.find('.').unwrap_or(label.len());
    let groups = (1..whole).rev().filter(|p| whole > 4 && (whole - p) % 3 == 0);
    groups.for_each(|place| label.insert(place, '\u{2009}'));
    format!("{sign}{label}")
}

fn linear_ticks(lo: f64, hi: f64, most: usize) -> Ticks {
    let (step, values) = nice_ticks(lo, hi, most);
    let largest = largest(values.iter().map(|v| v.abs()));
    values.iter().map(|&v| (v, tick_label(v, step, largest))).collect()
}

/// Ticks of a log axis from 10^lo to 10^hi: decades; over about one decade or less, 1-2-5; where
/// these are too few, linear steps.
fn log_ticks(lo: f64, hi: f64, most: usize) -> Ticks {
    let digits = |e: i32| (1..10).map(move |d| (e, d, f64::from(e) + f64::from(d).log10()));
    let all = (lo.floor() as i32..=hi.ceil() as i32).flat_map(digits);
    let mut all: Vec<_> = all.filter(|m| (lo - 1e-9..=hi + 1e-9).contains(&m.2)).collect();
    let count = |digits: &[i32]| all.iter().filter(|m| digits.contains(&m.1)).count();
    let (whole, few) = (count(&[1]), count(&[1, 2, 5]));
    let stride = whole.div_ceil(most).max(1) as i32;
    let wide = hi - lo >= 1.5 && whole > 1;
    let chosen = !wide && (3..=most.max(3)).contains(&few);
    all.retain(|m| !wide || stride == 1 || m.1 == 1);
    let label = |e: i32, d: i32| match d {
        1 if wide && e.rem_euclid(stride) == 0 => format!("10{}", superscript(e)),
        1 | 2 | 5 if chosen => {
            let value = f64::from(d) * 10f64.powi(e);
            tick_label(value, 10f64.powi(e), value)
        }
        _ => String::new(),
    };
    let mut ticks: Ticks = all.iter().map(|&(e, d, log)| (log, label(e, d))).collect();
    if !wide && !chosen {
        let linear = linear_ticks(10f64.powf(lo), 10f64.powf(hi), most);
        ticks.extend(linear.into_iter().map(|(v, label)| (v.log10(), label)));
    }
    ticks
}

/// An axis: its range (log axes: of the logarithm), its length in pixels, and its ticks. Plotters' own logarithmic axis
/// has ticks at decades alone; its linear one has labels of one form, and fails below a range of 10⁻¹⁵.
pub(super) struct Axis {
    log: bool,
    pub(super) range: Point,
    pub(super) length: f64,
    ticks: Ticks,
}

impl Axis {
    /// Lays as many ticks as leave room between the labels along the axis.
    pub(super) fn new(range: Point, log: bool, length: f64, upright: bool) -> Self {
        let lay = if log { log_ticks } else { linear_ticks };
        let size = |label: &str| if upright { 24.0 } else { SMALL.width(label) };
        let axis = |most| Self { log, range, length, ticks: lay(range.0, range.1, most) };
        let fits = |axis: &Self| {
            let labels: Vec<_> = axis.ticks.iter().filter(|t| !t.1.is_empty()).collect();
            labels.windows(2).all(|w| {
                let room = axis.pixels(w[1].0) - axis.pixels(w[0].0);
                room >= (size(&w[0].1) + size(&w[1].1)) / 2.0 + 30.0
            })
        };
        let mut fitting = (2..=9).rev().map(axis).filter(fits);
        fitting.next().unwrap_or_else(|| axis(1))
    }

    /// Pixels from the start of the axis to a position on it (log axes: the logarithm).
    fn pixels(&self, position: f64) -> f64 {
        (position - self.range.0) / (self.range.1 - self.range.0) * self.length
    }

    /// Pixels from the start of the axis to a value; on a log axis, far before it to one that isn't positive.
    pub(super) fn at(&self, value: f64) -> f64 {
        let logarithm = || value.max(0.0).log10();
        self.pixels(if self.log { logarithm() } else { value }).clamp(-1e5, 1e5)
    }

    pub(super) fn label_width(&self) -> f64 {
        largest(self.ticks.iter().map(|t| SMALL.width(&t.1)))
    }

    /// The ticks along a line on the page.
    fn along(&self, [from, to]: [Point; 2]) -> impl Iterator<Item = (Point, &str)> {
        let part = |at: f64| self.pixels(at).round() / self.length;
        self.ticks.iter().map(move |(at, label)| (between(from, to, part(*at)), label.as_str()))
    }

    /// Draws the ticks that have labels along a line on the page, and the labels to a side.
    pub(super) fn draw(&self, page: &mut Page, ends: [Point; 2], tick: Point, side: Point) {
        let out = |p: Point, (x, y): Point, length: f64| (p.0 + length * x, p.1 + length * y);
        let anchor = (0.5 - 0.5 * side.0, 0.5 - 0.5 * side.1);
        for (foot, label) in self.along(ends).filter(|tick| !tick.1.is_empty()) {
            page.line(&[foot, out(foot, tick, TICK / 2.0)], THIN, INK, &[]);
            page.text(label, out(foot, side, TICK), SMALL, anchor);
        }
    }
}

/// Widens a range by a fraction on both sides; an empty one, to a readable range about its value.
pub(super) fn widen((lo, hi): (f64, f64), fraction: f64) -> (f64, f64) {
    let size = lo.abs().max(hi.abs());
    let half = if hi - lo > 1e-12 * size {
        fraction * (hi - lo)
    } else if size > 0.0 {
        0.1 * size
    } else {
        1.0
    };
    (lo - half, hi + half)
}

/// Smallest range that holds the finite values.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|v| v.is_finite()).map(|v| (v, v)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

/// The axes of a box, with their wrapped labels.
pub(super) struct Axes {
    pub(super) x: Axis,
    pub(super) y: Axis,
    x_label: Block,
    y_label: Block,
}

impl Axes {
    /// Labels are wrapped to the lengths of the axes, but not shorter than `least`.
    pub(super) fn new([x, y]: [Axis; 2], labels: [&str; 2], least: f64) -> Self {
        Self {
            x_label: Block::new(labels[0], LABEL, x.length.max(least)),
            y_label: Block::new(labels[1], LABEL, y.length.max(least)),
            x,
            y,
        }
    }

    /// Room for the labels on the left, on the right and below.
    pub(super) fn room(&self) -> [f64; 3] {
        [
            self.y_label.height() + 12.0 + self.y.label_width() + TICK,
            16.0 + self.x.label_width() / 2.0,
            LABEL_DROP + self.x_label.height(),
        ]
    }

    /// Pixels of a point within a box.
    pub(super) fn place(&self, [left, _, _, bottom]: Frame, (x, y): Point) -> Point {
        (left + self.x.at(x), bottom - self.y.at(y))
    }

    /// Draws ticks and labels about a box, with a grid if asked for; [`Page::outline`] draws the box itself.
    pub(super) fn draw(&self, page: &mut Page, [left, top, right, bottom]: Frame, grid: bool) {
        let corner = (left, bottom);
        let x = (&self.x, [corner, (right, bottom)], (0.0, top - bottom));
        let y = (&self.y, [corner, (left, top)], (right - left, 0.0));
        for (minor, colour) in [(true, MINOR_GRID), (false, GRID)] {
            for (axis, ends, across) in [x, y].into_iter().filter(|_| grid) {
                for (foot, _) in axis.along(ends).filter(|tick| tick.1.is_empty() == minor) {
                    let far = (foot.0 + across.0, foot.1 + across.1);
                    page.line(&[foot, far], THIN, colour, &[]);
                }
            }
        }
        self.x.draw(page, x.1, BELOW, BELOW);
        self.y.draw(page, y.1, LEFT, LEFT);
        let middle = ((left + right) / 2.0, (top + bottom) / 2.0);
        page.block(&self.x_label, (middle.0, bottom + LABEL_DROP), false);
        page.block(&self.y_label, (left - self.room()[0], middle.1), true);
    }
}

impl Page<'_> {
    /// Draws the box of axes, over what has been drawn within.
    pub(super) fn outline(&mut self, frame: Frame) {
        let corners = corners(frame);
        self.line(&[&corners[..], &corners[..1]].concat(), THIN, INK, &[]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: Ticks) -> Vec<String> {
        let labels = ticks.into_iter().map(|t| t.1);
        labels.filter(|label| !label.is_empty()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        for (lo, hi, most, expected) in [
            (0.257, 0.283, 4, "0.26 0.27 0.28"),
            (-1.0, 1.0, 5, "−1.0 −0.5 0 0.5 1.0"),
            (0.0, 45_000.0, 3, "0 20\u{2009}000 40\u{2009}000"),
            (-2.1e6, 0.0, 3, "−2×10⁶ −1×10⁶ 0"),
            (0.0, 4e-7, 3, "0 2×10⁻⁷ 4×10⁻⁷"),
        ] {
            assert_eq!(labels(linear_ticks(lo, hi, most)).join(" "), expected);
        }
        for (lo, hi) in [(0.1, 0.7), (-3e5, 12.0), (1e-9, 1.1e-9), (99.0, 101.0)] {
            for most in 2..10 {
                let (_, ticks) = nice_ticks(lo, hi, most);
                assert!((1..=most).contains(&ticks.len()), "{lo} {hi} {most}: {ticks:?}");
            }
        }
    }

    #[test]
    fn log_ticks_follow_the_span() {
        for (lo, hi, most, expected) in [
            (-3.2, 0.1, 9, "10⁻³ 10⁻² 10⁻¹ 10⁰"),
            (-12.0, 0.0, 5, "10⁻¹² 10⁻⁹ 10⁻⁶ 10⁻³ 10⁰"),
            (-1.0, 0.0, 9, "0.1 0.2 0.5 1"),
            (0.26_f64.log10(), 0.29_f64.log10(), 3, "0.26 0.28"),
        ] {
            assert_eq!(labels(log_ticks(lo, hi, most)).join(" "), expected);
        }
    }
}
