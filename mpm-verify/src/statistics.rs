//! Small statistics.

/// A straight line fitted by least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Slope.
    pub slope: f64,
    /// Standard error of the slope.
    pub slope_error: f64,
    /// Value at zero.
    pub intercept: f64,
    /// Coefficient of determination R².
    pub r_squared: f64,
}

/// The least-squares line through `points`; `None` for fewer than three or no spread in x.
#[must_use]
pub fn fit_line(points: &[(f64, f64)]) -> Option<Line> {
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

/// Root mean square; NaN of nothing, which no check passes.
#[must_use]
pub fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for v in values {
        sum += v * v;
        count += 1;
    }
    (sum / count as f64).sqrt()
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
}
