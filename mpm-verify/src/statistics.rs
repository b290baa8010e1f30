//! Small statistics, and a geometric series.

use crate::exact::root;

/// A straight line fitted by least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub slope: f64,
    /// Standard error of the slope.
    pub slope_error: f64,
    pub intercept: f64,
    /// Coefficient of determination R².
    pub r_squared: f64,
}

/// The least-squares line through `points`; `None` for fewer than three or no spread in x.
pub(crate) fn fit_line(points: &[(f64, f64)]) -> Option<Line> {
    let n = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let (mut sxx, mut sxy, mut syy) = (0.0, 0.0, 0.0);
    for (x, y) in points {
        sxx += (x - mx) * (x - mx);
        sxy += (x - mx) * (y - my);
        syy += (y - my) * (y - my);
    }
    if sxx <= 0.0 {
        return None;
    }
    let slope = sxy / sxx;
    let residual = (syy - slope * sxy).max(0.0);
    Some(Line {
        slope,
        slope_error: (residual / (n - 2.0) / sxx).sqrt(),
        intercept: my - slope * mx,
        r_squared: if syy > 0.0 { sxy * sxy / (sxx * syy) } else { 1.0 },
    })
}

/// Half the period of what swings, given as points over time, by a straight line through its zeros between them.
pub(crate) fn half_period(points: &[(f64, f64)]) -> Option<f64> {
    let zeros = points.windows(2).filter_map(|pair| {
        let [(t, u), (after, then)] = [pair[0], pair[1]];
        (u * then < 0.0).then(|| t + (after - t) * u / (u - then))
    });
    let zeros: Vec<(f64, f64)> = zeros.enumerate().map(|(k, t)| (k as f64, t)).collect();
    Some(fit_line(&zeros)?.slope)
}

/// The mean; NaN of nothing.
pub(crate) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut count = 0usize;
    let sum: f64 = values.into_iter().inspect(|_| count += 1).sum();
    sum / count as f64
}

/// Root mean square; NaN of nothing, which no check passes.
pub(crate) fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    mean(values.into_iter().map(|v| v * v)).sqrt()
}

/// Rms of a field less its plane of best fit in each square of a `size` (m): an oscillation from particle to particle or
/// from cell to cell, whoever computed it. A square of three particles or less has its mean.
pub(crate) fn oscillation(places: &[[f64; 2]], field: &[f64], size: f64) -> f64 {
    let mut squares = std::collections::BTreeMap::<[i64; 2], Vec<Valued>>::new();
    for (x, value) in places.iter().zip(field) {
        squares.entry(x.map(|x| (x / size).floor() as i64)).or_default().push((*x, *value));
    }
    rms(squares.into_values().flat_map(off_plane))
}

/// A point (m) and a value.
type Valued = ([f64; 2], f64);

/// Values of points less their plane of best fit.
fn off_plane(points: Vec<Valued>) -> Vec<f64> {
    let mean = |of: &dyn Fn(&Valued) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let centre = [0, 1].map(|axis| mean(&|p| p.0[axis]));
    let middle = mean(&|p| p.1);
    let moment = |of: &dyn Fn([f64; 2], f64) -> f64| {
        mean(&|(x, value)| of([x[0] - centre[0], x[1] - centre[1]], value - middle))
    };
    let [xx, xy, yy] = [moment(&|d, _| d[0] * d[0]), moment(&|d, _| d[0] * d[1]), moment(&|d, _| d[1] * d[1])];
    let [xv, yv] = [0, 1].map(|axis| moment(&move |d, v| d[axis] * v));
    let determinant = xx * yy - xy * xy;
    let slope = match points.len() > 3 && determinant > 1e-9 * xx * yy {
        true => [(xv * yy - yv * xy) / determinant, (yv * xx - xv * xy) / determinant],
        false => [0.0; 2],
    };
    let off =
        |(x, value): &([f64; 2], f64)| value - middle - slope[0] * (x[0] - centre[0]) - slope[1] * (x[1] - centre[1]);
    points.iter().map(off).collect()
}

/// Rms of what Π takes from a field: the oscillation from particle to particle.
pub(crate) fn checkerboard(field: &[f64], averaged: &[f64]) -> f64 {
    rms(field.iter().zip(averaged).map(|(f, a)| f - a))
}

/// The factor by which each of `count` durations grows over the one before, the first of which is `first`, so that
/// their sum is `whole`.
pub(crate) fn growth(first: f64, count: i32, whole: f64) -> f64 {
    // The sum of a geometric series rises with its ratio.
    let sum = |ratio: f64| (0..count).fold(0.0, |sum, _| 1.0 + ratio * sum) * first;
    let mut hi = 2.0;
    while sum(hi) < whole {
        hi *= 2.0;
    }
    root((0.0, hi), |ratio| whole - sum(ratio))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rms_of_nothing_is_not_a_number() {
        assert_eq!(rms([3.0, -4.0]), 12.5_f64.sqrt());
        assert!(rms([]).is_nan());
    }

    #[test]
    fn a_line_is_recovered_and_scatter_lowers_r_squared() {
        let exact = fit_line(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]).unwrap();
        assert_eq!((exact.slope, exact.intercept, exact.r_squared), (2.0, 1.0, 1.0));
        // Anscombe's first set: slope 0.5001 ± 0.1179, intercept 3.0001, R² 0.6665.
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68];
        let points: Vec<_> = x.into_iter().zip(y).collect();
        let line = fit_line(&points).unwrap();
        assert!((line.slope - 0.5001).abs() < 1e-4);
        assert!((line.slope_error - 0.1179).abs() < 1e-4);
        assert!((line.intercept - 3.0001).abs() < 1e-4);
        assert!((line.r_squared - 0.6665).abs() < 1e-4);
        assert_eq!(fit_line(&points[..2]), None);
    }

    #[test]
    fn what_is_its_own_average_does_not_oscillate_and_a_checkerboard_does() {
        assert_eq!(checkerboard(&[3.0, -1.0], &[3.0, -1.0]), 0.0);
        assert_eq!(checkerboard(&[3.0, -1.0], &[1.0, 1.0]), 2.0);
    }

    #[test]
    fn a_plane_does_not_oscillate_and_a_checkerboard_on_it_does() {
        let places: Vec<[f64; 2]> =
            (0..64).map(|k| [0.25 + 0.5 * f64::from(k % 8), 0.5 * f64::from(k / 8) - 3.9]).collect();
        let plane = |x: &[f64; 2]| 3.0 - 2.0 * x[0] + 5.0 * x[1];
        let board = |k: usize| if (k % 8 + k / 8).is_multiple_of(2) { 1.0 } else { -1.0 };
        let fields = [0.0, 7.0].map(|amplitude| {
            let value = |(k, x): (usize, &[f64; 2])| plane(x) + amplitude * board(k);
            oscillation(&places, &places.iter().enumerate().map(value).collect::<Vec<f64>>(), 2.0)
        });
        assert!(fields[0] < 1e-12 && (fields[1] - 7.0).abs() < 1e-9, "{fields:?}");
        // Two points have a mean and no plane.
        assert_eq!(oscillation(&[[0.0, 0.0], [0.1, 0.0]], &[1.0, -1.0], 1.0), 1.0);
    }

    #[test]
    fn the_durations_add_up() {
        for (first, count, whole) in [(1.0, 2, 3.0), (0.3, 10, 3.0), (1e-3, 125, 2.0)] {
            let factor = growth(first, count, whole);
            let sum: f64 = (0..count).map(|k| first * factor.powi(k)).sum();
            assert!((sum / whole - 1.0).abs() < 1e-12, "{sum} {whole}");
        }
    }
}
