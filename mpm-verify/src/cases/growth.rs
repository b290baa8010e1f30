//! Steps of time that grow by a factor.

/// The factor by which each of `count` durations grows over the one before, the first of which is `first`, so that
/// their sum is `whole`.
pub(super) fn factor(first: f64, count: i32, whole: f64) -> f64 {
    // The sum of a geometric series rises with its ratio: halved until nothing changes.
    let sum = |ratio: f64| (0..count).fold(0.0, |sum, _| 1.0 + ratio * sum) * first;
    let (mut lo, mut hi) = (0.0, 2.0);
    while sum(hi) < whole {
        hi *= 2.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (lo + hi);
        if sum(middle) < whole {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    0.5 * (lo + hi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_durations_add_up() {
        for (first, count, whole) in [(1.0, 2, 3.0), (0.3, 10, 3.0), (1e-3, 125, 2.0)] {
            let factor = factor(first, count, whole);
            let sum: f64 = (0..count).map(|k| first * factor.powi(k)).sum();
            assert!((sum / whole - 1.0).abs() < 1e-12, "{sum} {whole}");
        }
    }
}
