//! Figures as data: panels with the curves of runs, in one picture, with the points of all curves as CSV beside it.
//!
//! A panel takes the curves of selected runs, and what they are compared with. One in which no run has a point is left out; a
//! figure without panels is not drawn.

use crate::draw::style::{history, series};
use crate::draw::{
    Chart, Dash, Marker, ReferenceLine, Scale, Series, SlopeTriangle, draw_charts, share_ranges_of_columns,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::Record;
use crate::scheme::Scheme;
use crate::table::Table;
use std::ops::RangeInclusive;

/// Intervals of a sampled curve.
const SAMPLES: u32 = 100;
/// Colours of exact curves and of references.
const BLACK: usize = 6;
const GREY: usize = 7;
/// Ratio of the lowest error to the top of a slope triangle.
const CLEARANCE: f64 = 1.3;
/// Width of a slope triangle over that of the curves.
const SHARE: f64 = 0.22;

/// Points in data coordinates.
pub(crate) type Points = Vec<(f64, f64)>;

/// A pair of axes with its curves.
pub(crate) struct Panel<'a> {
    chart: Chart,
    /// The first run of each curve; none of references.
    runs: Vec<Option<&'a Record>>,
    /// Place of the first of the curves that were added last.
    last: usize,
}

impl<'a> Panel<'a> {
    /// Without curves, on linear axes with the labels of x and y.
    pub(crate) fn new(title: impl Into<String>, labels: [&str; 2]) -> Self {
        Self { chart: Chart::new(title, labels, Vec::new()), runs: Vec::new(), last: 0 }
    }

    pub(crate) fn log_x(mut self) -> Self {
        self.chart.x_scale = Scale::Log10;
        self
    }

    pub(crate) fn log_y(mut self) -> Self {
        self.chart.y_scale = Scale::Log10;
        self
    }

    pub(crate) fn x_range(mut self, from: f64, to: f64) -> Self {
        self.chart.x_range = Some((from, to));
        self
    }

    pub(crate) fn y_range(mut self, from: f64, to: f64) -> Self {
        self.chart.y_range = Some((from, to));
        self
    }

    fn begin(&mut self) {
        self.last = self.runs.len();
    }

    fn push(&mut self, run: Option<&'a Record>, curve: Series) {
        self.runs.push(run);
        self.chart.series.push(curve);
    }

    /// A curve for each run, of its `series.csv`: a line without markers in the style of its scheme.
    pub(crate) fn histories(
        self,
        gallery: &Gallery,
        runs: impl IntoIterator<Item = &'a Record>,
        points: impl Fn(&Record, &Table) -> Points,
    ) -> Result<Self, Error> {
        self.tables((gallery, "series.csv"), runs, history, points)
    }

    /// A curve for each run, of its `particles.csv`: a line with markers in the style of its scheme.
    pub(crate) fn profiles(
        self,
        gallery: &Gallery,
        runs: impl IntoIterator<Item = &'a Record>,
        points: impl Fn(&Record, &Table) -> Points,
    ) -> Result<Self, Error> {
        self.tables((gallery, "particles.csv"), runs, series, points)
    }

    fn tables(
        mut self,
        (gallery, file): (&Gallery, &str),
        runs: impl IntoIterator<Item = &'a Record>,
        style: fn(Scheme, Points) -> Series,
        points: impl Fn(&Record, &Table) -> Points,
    ) -> Result<Self, Error> {
        self.begin();
        for run in runs {
            let mut points = points(run, &gallery.table(run, file)?);
            points.retain(|p| self.shows(p));
            self.push(Some(run), style(run.scheme(), points));
        }
        Ok(self)
    }

    /// A curve for each scheme, with a point of each of its runs, by rising abscissa; points that are not finite are left out.
    pub(crate) fn points(
        self,
        runs: impl IntoIterator<Item = &'a Record>,
        point: impl Fn(&Record) -> (f64, f64),
    ) -> Self {
        self.points_by(runs, |r| r.scheme().title(), point)
    }

    /// The same for the runs of each name.
    pub(crate) fn points_by(
        mut self,
        runs: impl IntoIterator<Item = &'a Record>,
        name: impl Fn(&Record) -> String,
        point: impl Fn(&Record) -> (f64, f64),
    ) -> Self {
        self.begin();
        for run in runs {
            let name = name(run);
            let known = self.chart.series[self.last..].iter().position(|s| s.name == name);
            if known.is_none() {
                self.push(Some(run), Series { name, ..series(run.scheme(), Vec::new()) });
            }
            let place = known.map_or(self.runs.len() - 1, |k| self.last + k);
            self.chart.series[place].points.push(point(run));
        }
        for k in self.last..self.runs.len() {
            let points = std::mem::take(&mut self.chart.series[k].points);
            self.chart.series[k].points = self.in_order(points);
        }
        self
    }

    /// A curve for each of these schemes, be it without runs, so that panels share a legend.
    pub(crate) fn points_of(
        mut self,
        schemes: impl IntoIterator<Item = Scheme>,
        runs: &[&'a Record],
        point: impl Fn(&Record) -> (f64, f64),
    ) -> Self {
        self.begin();
        for scheme in schemes {
            let own = || runs.iter().copied().filter(|r| r.scheme() == scheme);
            self.push(own().next(), series(scheme, self.in_order(own().map(&point).collect())));
        }
        self
    }

    /// Changes the curves that were added last, each with its place among them.
    pub(crate) fn styled(mut self, style: impl Fn(usize, Series) -> Series) -> Self {
        for (k, curve) in self.chart.series[self.last..].iter_mut().enumerate() {
            *curve = style(k, curve.clone());
        }
        self
    }

    /// Changes the curves of runs that were added last, each with its first run.
    pub(crate) fn by_run(mut self, style: impl Fn(&Record, Series) -> Series) -> Self {
        for (curve, run) in self.chart.series.iter_mut().zip(&self.runs).skip(self.last) {
            if let Some(run) = run {
                *curve = style(run, curve.clone());
            }
        }
        self
    }

    /// Leaves out those of the curves that were added last which have fewer points.
    pub(crate) fn least(mut self, points: usize) -> Self {
        for k in (self.last..self.runs.len()).rev() {
            if self.chart.series[k].points.len() < points {
                self.chart.series.remove(k);
                self.runs.remove(k);
            }
        }
        self
    }

    /// A curve to compare with.
    pub(crate) fn curve(mut self, curve: Series) -> Self {
        self.begin();
        self.push(None, curve);
        self
    }

    /// An exact curve, sampled over a range of the abscissa: dotted and black.
    pub(crate) fn exact(self, name: &str, range: RangeInclusive<f64>, value: impl Fn(f64) -> f64) -> Self {
        self.curve(Series { dash: Dash::Dotted, ..Series::line(name, sampled(range, value), BLACK) })
    }

    /// A reference at some abscissae: dashed and grey, with markers.
    pub(crate) fn reference(self, name: impl Into<String>, points: Points) -> Self {
        self.curve(Series { marker: Marker::Circle, dash: Dash::Dashed, ..Series::line(name, points, GREY) })
    }

    /// The line of equal abscissa and ordinate over the curves so far, beneath them.
    pub(crate) fn identity(mut self, name: &str, colour: usize) -> Self {
        let all = self.chart.series.iter().flat_map(|s| &s.points);
        let ends = all.fold((f64::INFINITY, 0.0_f64), |(lo, hi), p| (lo.min(p.0), hi.max(p.0)));
        let line = vec![(ends.0, ends.0), (ends.1, ends.1)];
        self.chart.series.insert(0, Series::line(name, line, colour));
        self.runs.insert(0, None);
        self.last += 1;
        self
    }

    /// A value of the ordinate that the curves are compared with.
    pub(crate) fn level(mut self, line: ReferenceLine) -> Self {
        self.chart.reference_lines.push(line);
        self
    }

    /// A triangle that shows the slope of an order, below all curves so far.
    pub(crate) fn order(mut self, slope: f64) -> Self {
        self.chart.slope_triangle = below_the_curves(slope, self.chart.series.iter().map(|s| &s.points[..]));
        self
    }

    /// The same curves in another range of the ordinate.
    pub(crate) fn zoomed(&self, from: f64, to: f64) -> Self {
        Self { chart: self.chart.clone(), runs: self.runs.clone(), last: self.last }.y_range(from, to)
    }

    /// Whether the axes can show a point.
    fn shows(&self, point: &(f64, f64)) -> bool {
        let shown = |scale, value: f64| scale == Scale::Linear || value > 0.0 || value.is_nan();
        shown(self.chart.x_scale, point.0) && shown(self.chart.y_scale, point.1)
    }

    /// Points in the order of their abscissae, without those that are not finite.
    fn in_order(&self, mut points: Points) -> Points {
        points.retain(|p| p.0.is_finite() && p.1.is_finite() && self.shows(p));
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    /// The chart; none if no run has a point.
    pub(crate) fn chart(self) -> Option<Chart> {
        let curves = self.chart.series.iter().zip(&self.runs);
        let mut points = curves.filter(|(_, run)| run.is_some()).flat_map(|(s, _)| &s.points);
        points.any(|(x, y)| x.is_finite() && y.is_finite()).then_some(self.chart)
    }
}

/// Values of a function over a range.
pub(crate) fn sampled(range: RangeInclusive<f64>, value: impl Fn(f64) -> f64) -> Points {
    let (from, to) = range.into_inner();
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(SAMPLES);
    (0..=SAMPLES).map(|k| (at(k), value(at(k)))).collect()
}

/// Which panels of a figure have the same axes.
#[derive(Clone, Copy)]
enum Shared {
    Nothing,
    All,
    Columns,
}

pub(crate) struct Figure<'a> {
    name: String,
    caption: String,
    panels: Vec<Panel<'a>>,
    columns: usize,
    shared: Shared,
    whole: bool,
}

impl<'a> Figure<'a> {
    /// Panels in the picture `NAME.png`, at most three in a row.
    pub(crate) fn new(
        name: impl Into<String>,
        caption: impl Into<String>,
        panels: impl IntoIterator<Item = Panel<'a>>,
    ) -> Self {
        Self {
            name: name.into(),
            caption: caption.into(),
            panels: panels.into_iter().collect(),
            columns: 3,
            shared: Shared::Nothing,
            whole: false,
        }
    }

    /// At most this number of panels in a row.
    pub(crate) fn columns(self, columns: usize) -> Self {
        Self { columns, ..self }
    }

    /// Gives all panels the same axes, except for ranges of their own.
    pub(crate) fn share_axes(self) -> Self {
        Self { shared: Shared::All, ..self }
    }

    /// Gives the panels of each column the same axes.
    pub(crate) fn share_axes_of_columns(self) -> Self {
        Self { shared: Shared::Columns, ..self }
    }

    /// Draws nothing unless every panel has a run.
    pub(crate) fn whole(self) -> Self {
        Self { whole: true, ..self }
    }

    /// Draws the panels that have runs, writes their points and hangs the picture.
    pub(crate) fn draw(self, gallery: &mut Gallery) -> Result<(), Error> {
        let all = self.panels.len();
        let mut charts: Vec<Chart> = self.panels.into_iter().filter_map(Panel::chart).collect();
        if charts.is_empty() || (self.whole && charts.len() < all) {
            return Ok(());
        }
        let file = format!("{}.png", self.name);
        let place = gallery.place(&file);
        let columns = self.columns.min(charts.len());
        let own: Vec<_> = charts.iter().map(|c| (c.x_range, c.y_range)).collect();
        match self.shared {
            Shared::Nothing => {}
            Shared::All => share_ranges_of_columns(&place, &mut charts, 1)?,
            Shared::Columns => share_ranges_of_columns(&place, &mut charts, columns)?,
        }
        for (chart, (x, y)) in charts.iter_mut().zip(own) {
            (chart.x_range, chart.y_range) = (x.or(chart.x_range), y.or(chart.y_range));
        }
        // Those in another range are written once.
        let same = |a: &Chart, b: &Chart| a.title == b.title && a.series == b.series;
        let mut written: Vec<Chart> = Vec::new();
        for chart in &charts {
            if !written.iter().any(|other| same(other, chart)) {
                written.push(chart.clone());
            }
        }
        gallery.write_curves(&format!("{}.csv", self.name), &written)?;
        draw_charts(&place, &charts, columns)?;
        gallery.hang(&file, self.caption);
        Ok(())
    }
}

/// A triangle at the right end, below every curve that passes there.
pub(crate) fn below_the_curves<'a>(
    slope: f64,
    curves: impl Iterator<Item = &'a [(f64, f64)]> + Clone,
) -> Option<SlopeTriangle> {
    let xs = || curves.clone().flatten().map(|p| p.0);
    let (least, most) = (xs().fold(f64::INFINITY, f64::min), xs().fold(0.0, f64::max));
    let decades = SHARE * (most / least).log10();
    if !(decades > 0.0 && decades.is_finite()) {
        return None;
    }
    let left = most / 10f64.powf(decades);
    let at_left = |pair: &[(f64, f64)]| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let share = (left / x0).ln() / (x1 / x0).ln();
        (0.0..=1.0).contains(&share).then(|| y0 * (y1 / y0).powf(share))
    };
    let crossing = curves.clone().flat_map(|c| c.windows(2).filter_map(at_left));
    let right = curves.clone().flatten().filter(|p| p.0 >= left).map(|p| p.1);
    let lowest = crossing.chain(right).fold(f64::INFINITY, f64::min);
    Some(SlopeTriangle { slope, at: (left, lowest / CLEARANCE / 10f64.powf(slope * decades)), decades })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_triangle_lies_below_all_curves() {
        let steep = [(1.0, 0.1), (0.5, 0.025), (0.25, 0.006)];
        let flat = [(1.0, 0.04), (0.25, 0.03)];
        let triangle = below_the_curves(2.0, [&steep[..], &flat[..]].into_iter()).unwrap();
        let (left, bottom) = triangle.at;
        let right = left * 10f64.powf(triangle.decades);
        let top = bottom * (right / left).powi(2);
        assert!((right - 1.0).abs() < 1e-12 && top < 0.04 / 1.2, "{triangle:?}");
    }

    #[test]
    fn one_level_has_no_triangle() {
        assert_eq!(below_the_curves(1.0, [&[(1.0, 0.1)][..]].into_iter()), None);
    }
}
