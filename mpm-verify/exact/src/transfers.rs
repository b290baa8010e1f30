//! Closed forms of transfers beside a wall with open knots: second moment of the functions, and the filter of XPIC(2) on a
//! line of particles; derived in `docs/patch.md`.

use mpm_solvers::scheme::BasisName;

/// Second moment of the functions of `basis` at a place on an axis (cells from the wall), over h².
#[must_use]
pub fn second_moment(basis: BasisName, place: f64) -> f64 {
    match basis {
        BasisName::Bspline2 if place < 1.0 => 0.25 * (1.0 - (1.0 - place).powi(2)),
        BasisName::Bspline2 => 0.25,
        _ => place.fract() * (1.0 - place.fract()),
    }
}

/// Functions of `basis` at a place on an axis (cells from the wall), from that of their first node on.
fn functions(basis: BasisName, place: f64) -> (usize, [f64; 3]) {
    let s = place.fract();
    let functions = match basis {
        BasisName::Bspline2 if place < 1.0 => [(1.0 - s).powi(2), s * (2.0 - 1.5 * s), 0.5 * s * s],
        BasisName::Bspline2 => [0.5 * (1.0 - s).powi(2), 0.5 + s - s * s, 0.5 * s * s],
        _ => [1.0 - s, s, 0.0],
    };
    (place as usize, functions)
}

/// Velocities after a number of `steps` of XPIC(2) of a line of particles from the wall on, which start with their
/// positions (m) as velocities: `cells` cells of the size `h` (m) with `per_cell` particles each.
#[must_use]
pub fn filtered(basis: BasisName, [cells, per_cell, h]: [f64; 3], steps: u64) -> Vec<f64> {
    let count = (cells * per_cell).round() as usize;
    let places: Vec<f64> = (0..count).map(|k| (k as f64 + 0.5) / per_cell).collect();
    let to_nodes = |values: &[f64]| {
        let mut sums = vec![[0.0; 2]; count + 3];
        for (place, value) in places.iter().zip(values) {
            let (first, functions) = functions(basis, *place);
            for (sum, w) in sums[first..].iter_mut().zip(functions) {
                *sum = [sum[0] + w, sum[1] + w * value];
            }
        }
        let mean = |[mass, sum]: [f64; 2]| if mass > 0.0 { sum / mass } else { 0.0 };
        sums.into_iter().map(mean).collect::<Vec<f64>>()
    };
    let from_nodes = |nodes: &[f64]| {
        let value = |place: &f64| {
            let (first, functions) = functions(basis, *place);
            nodes[first..].iter().zip(functions).map(|(v, w)| v * w).sum::<f64>()
        };
        places.iter().map(value).collect::<Vec<f64>>()
    };
    let mut values: Vec<f64> = places.iter().map(|place| place * h).collect();
    for _ in 0..steps {
        let once = to_nodes(&values);
        let twice = to_nodes(&from_nodes(&once));
        let corrected: Vec<f64> = once.iter().zip(&twice).map(|(once, twice)| 2.0 * once - twice).collect();
        values = from_nodes(&corrected);
    }
    values
}
