//! A curve of which rows are known: its values between them, and the error that its curvature leaves there.

use crate::foreign::{Asked, Between, Gap, Given};
use crate::metric::Metric;

/// Share of a span by which rows may end before its end.
pub(crate) const SHORT: f64 = 0.01;
/// Least number of rows in a window of which the mean is taken.
const DENSE: usize = 4;
/// Relative rounding of an abscissa.
const ROUNDING: f64 = 1e-9;

/// Rows with a rising abscissa.
pub(crate) struct Sampled<'a> {
    x: &'a [f64],
    y: &'a [f64],
}

impl<'a> Sampled<'a> {
    pub(crate) const fn new(x: &'a [f64], y: &'a [f64]) -> Self {
        Self { x, y }
    }

    /// Half the second derivative at three rows from `first` on: their second divided difference.
    fn curvature(&self, first: usize) -> Option<f64> {
        let three = |of: &[f64]| -> Option<[f64; 3]> { of.get(first..first + 3)?.try_into().ok() };
        let ([a, b, c], [u, v, w]) = (three(self.x)?, three(self.y)?);
        Some(((w - v) / (c - b) - (v - u) / (b - a)) / (c - a))
    }

    /// The value at `x`; nothing outside of the rows, or of fewer than three.
    pub(crate) fn at(&self, x: f64) -> Option<Between> {
        if let Some(row) = self.x.iter().position(|known| (known - x).abs() <= ROUNDING * x.abs()) {
            return Some(Between { value: *self.y.get(row)?, error: 0.0 });
        }
        let above = self.x.partition_point(|known| *known < x);
        let below = above.checked_sub(1)?;
        let ([a, b], [u, v]) = ([*self.x.get(below)?, *self.x.get(above)?], [*self.y.get(below)?, *self.y.get(above)?]);
        let around = [below.checked_sub(1), Some(below)].into_iter().flatten();
        let curvatures: Vec<f64> = around.filter_map(|first| self.curvature(first)).collect();
        let most = curvatures.iter().map(|c| c.abs()).reduce(f64::max)?;
        let mean = curvatures.iter().sum::<f64>() / curvatures.len() as f64;
        let (line, sag) = (u + (x - a) / (b - a) * (v - u), (x - a) * (b - x));
        Some(Between { value: line - mean * sag, error: most * sag })
    }

    /// The largest error between rows within a span; nothing if the rows do not reach over it.
    pub(crate) fn error(&self, from: f64, to: f64) -> Option<f64> {
        let within = self.x.windows(2).filter(|pair| pair[1] > from && pair[0] < to);
        let middles = within.map(|pair| self.at(0.5 * (pair[0] + pair[1])).map(|b| b.error));
        middles.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }
}

/// Why rows at the rising places `x` of an abscissa do not show a curve over a span, if they do not: they begin late, end
/// early, or two of them are farther apart than `widest`.
pub(crate) fn uncovered(name: &str, unit: &str, x: &[f64], [from, to]: [f64; 2], widest: f64) -> Option<String> {
    let place = |x: f64| match unit {
        "-" => format!("{name} = {x:.4e}"),
        _ => format!("{name} = {x:.4e} {unit}"),
    };
    let ([first, .., last] | [first @ last]) = x else { return Some("the series has no row".to_owned()) };
    let slack = ROUNDING * to.abs();
    let late = if widest.is_finite() { widest } else { 0.0 };
    if first - from > late + slack {
        return Some(format!("the series begins at {}, later than {}", place(*first), place(from)));
    }
    if *last < to - SHORT * (to - from) - slack {
        return Some(format!("the series ends at {}, before {}", place(*last), place(to)));
    }
    let wide = |pair: &&[f64]| pair[1] > from && pair[0] < to && pair[1] - pair[0] > widest * (1.0 + 1e-6);
    let pair = x.windows(2).find(wide)?;
    let apart = pair[1] - pair[0];
    Some(format!("rows {apart:.4e} apart after {}, where at most {widest:.4e} show the curve", place(pair[0])))
}

impl Given {
    /// Metrics of a curve over a span that the rows do not show, at most `widest` apart.
    pub(crate) fn unseen(&self, x: &Asked, span: [f64; 2], widest: f64, metrics: &[Metric]) -> Vec<(Metric, Gap)> {
        let why = uncovered(x.name, x.unit, self.column(x), span, widest);
        let gap = |why: String| metrics.iter().map(move |metric| (*metric, Gap::Unknown(why.clone())));
        why.into_iter().flat_map(gap).collect()
    }

    /// A column times `scale` at `place` between rows, from zero at zero on, and what it leaves open; nothing where at least
    /// [`DENSE`] rows lie within `window`, of which the mean is taken.
    pub(crate) fn between(&self, [x, y]: [&Asked; 2], place: f64, window: f64, scale: f64) -> Option<Gap> {
        let [places, values] = [x, y].map(|asked| self.column(asked));
        if places.iter().filter(|own| (*own - place).abs() <= window).count() >= DENSE {
            return None;
        }
        let start = places.first().is_some_and(|first| *first > 0.0).then_some(0.0);
        let from_zero = |rows: &[f64]| start.into_iter().chain(rows.iter().copied()).collect::<Vec<f64>>();
        let (places, values) = (from_zero(places), from_zero(values));
        Some(match Sampled::new(&places, &values).at(place) {
            Some(Between { value, error }) => Gap::Between(Between { value: scale * value, error: scale * error }),
            None => Gap::Unknown(format!("no rows around {} = {place}", x.name)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_exact_and_its_error_is_that_of_the_straight_line() {
        let x = [0.0, 1.0, 3.0, 4.0];
        let y = x.map(|x| 2.0 * x * x);
        let curve = Sampled::new(&x, &y);
        let between = curve.at(2.0).unwrap();
        assert!((between.value - 8.0).abs() < 1e-12 && (between.error - 2.0).abs() < 1e-12, "{between:?}");
        assert_eq!(curve.at(3.0), Some(Between { value: 18.0, error: 0.0 }));
        for outside in [-0.1, 4.1] {
            assert_eq!(curve.at(outside), None);
        }
        assert_eq!(Sampled::new(&x[..2], &y[..2]).at(0.5), None);
        assert!((curve.error(0.5, 3.5).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(curve.error(4.5, 5.0), None);
    }

    #[test]
    fn what_rows_do_not_show_is_named() {
        let told = |x: &[f64], span| uncovered("time", "s", x, span, 0.3).unwrap_or_default();
        assert_eq!(told(&[0.0, 0.25, 0.5], [0.0, 0.5]), "");
        assert_eq!(told(&[0.25, 0.5], [0.0, 0.5]), "");
        for (x, named) in [
            (&[][..], "no row"),
            (&[400.0, 500.0], "begins at time = 4.0000e2 s, later than time = 0.0000e0 s"),
            (&[0.0, 0.25], "ends at time = 2.5000e-1 s, before time = 5.0000e-1 s"),
            (&[0.0, 0.1, 0.5], "rows 4.0000e-1 apart after time = 1.0000e-1 s, where at most 3.0000e-1"),
        ] {
            assert!(told(x, [0.0, 0.5]).contains(named), "{}", told(x, [0.0, 0.5]));
        }
    }
}
