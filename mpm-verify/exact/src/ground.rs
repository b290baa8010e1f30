//! Ground: stresses of a half-space under a strip or a pad, Rankine's earth pressure, factors of bearing capacity.

use std::f64::consts::{FRAC_PI_4, PI};

/// σ_v and τ over the load q at a `depth` below a strip of the half width b under q, a way x beside its middle, tension
/// positive (Flamant's solution, integrated).
#[must_use]
pub fn strip(x: f64, depth: f64, half_width: f64) -> [f64; 2] {
    let [left, right] = [x + half_width, x - half_width].map(|x| x.atan2(depth));
    let (angle, turn) = (left - right, left + right);
    [-(angle + angle.sin() * turn.cos()) / PI, angle.sin() * turn.sin() / PI]
}

/// σ_v/q below a corner of a rectangle, of the sides m and n over the depth (Love 1929, doi:10.1098/rsta.1929.0009).
fn corner(m: f64, n: f64) -> f64 {
    let (square, product) = (m * m + n * n + 1.0, 2.0 * m * n * (m * m + n * n + 1.0).sqrt());
    let angle = product.atan2(square - (m * n).powi(2));
    (product / (square + (m * n).powi(2)) * (square + 1.0) / square + angle) / (4.0 * PI)
}

/// σ_v over the load at a `depth` below a square pad of the half width b, a way x and y beside its middle, tension positive.
#[must_use]
pub fn pad([x, y]: [f64; 2], depth: f64, half_width: f64) -> f64 {
    let quarters = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(a, b)| {
        let [m, n] = [half_width + a * x, half_width + b * y].map(|side| side / depth);
        m.signum() * n.signum() * corner(m.abs(), n.abs())
    });
    -quarters.iter().sum::<f64>()
}

/// Active and passive force (N/m) on a smooth wall of the height H: ½ K γ H² ∓ 2c √K H with K = tan²(π/4 ∓ φ/2) (Rankine
/// 1857), of a unit weight (N/m³), a cohesion (Pa) and an angle of friction (rad).
#[must_use]
pub fn rankine(unit_weight: f64, cohesion: f64, phi: f64, height: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|side| {
        let root = (FRAC_PI_4 + 0.5 * side * phi).tan();
        0.5 * root * root * unit_weight * height * height + side * 2.0 * cohesion * root * height
    })
}

/// N_q = e^(π tan φ) tan²(π/4 + φ/2) (Reissner 1924) and N_c = (N_q − 1) cot φ (Prandtl 1920).
#[must_use]
pub fn prandtl_reissner(phi: f64) -> [f64; 2] {
    let nq = (PI * phi.tan()).exp() * (FRAC_PI_4 + 0.5 * phi).tan().powi(2);
    [nq, (nq - 1.0) / phi.tan()]
}

/// Where the mechanism of a rough footing of a width (m) ends, from its middle, and its greatest depth (m): a wedge under
/// π/4 + φ/2, a fan between it and Rankine's passive wedge (Prandtl 1920).
#[must_use]
pub fn prandtl_extent(phi: f64, width: f64) -> [f64; 2] {
    let side = FRAC_PI_4 + 0.5 * phi;
    let depth = 0.5 * width / side.cos() * (side * phi.tan()).exp() * phi.cos();
    [0.5 * width + width * side.tan() * (0.5 * PI * phi.tan()).exp(), depth]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At the surface, far below, and where a point load does as well.
    #[test]
    fn stresses_have_their_limits() {
        assert!((strip(0.0, 1e-9, 1.0)[0] + 1.0).abs() < 1e-8 && strip(2.0, 1e-9, 1.0)[0].abs() < 1e-8);
        assert!((pad([0.0; 2], 1e-6, 1.0) + 1.0).abs() < 1e-5 && pad([2.0, 0.0], 1e-6, 1.0).abs() < 1e-5);
        // Line and point loads of the same force: 2q b·2/(π z) and 3·4 b² q/(2π z²).
        assert!((strip(0.0, 100.0, 1.0)[0] * 100.0 * PI / 4.0 + 1.0).abs() < 1e-3);
        assert!((pad([0.0; 2], 100.0, 1.0) * 1e4 * PI / 6.0 + 1.0).abs() < 1e-3);
        // A strip is a row of pads.
        let row: f64 = (-200..=200).map(|k| pad([0.3, 2.0 * f64::from(k)], 1.5, 1.0)).sum();
        assert!((row / strip(0.3, 1.5, 1.0)[0] - 1.0).abs() < 1e-5);
        assert!((strip(0.3, 1.5, 1.0)[1] + strip(-0.3, 1.5, 1.0)[1]).abs() < 1e-15);
    }

    #[test]
    fn factors_are_those_of_the_tables() {
        let [active, passive] = rankine(20e3, 0.0, 30.0_f64.to_radians(), 3.0);
        assert!((active - 30e3).abs() < 1e-6 && (passive - 270e3).abs() < 1e-6);
        let [active, _] = rankine(20e3, 10e3, 30.0_f64.to_radians(), 3.0);
        assert!((active - (30e3 - 60e3 / 3.0_f64.sqrt())).abs() < 1e-6);
        let [nq, nc] = prandtl_reissner(30.0_f64.to_radians());
        assert!((nq - 18.401).abs() < 1e-3 && (nc - 30.140).abs() < 1e-3);
        // Without friction a quarter circle between two wedges of 45 degrees.
        let [end, depth] = prandtl_extent(0.0, 2.0);
        assert!((end - 3.0).abs() < 1e-12 && (depth - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((prandtl_extent(30.0_f64.to_radians(), 1.0)[0] - 4.79).abs() < 0.005);
    }
}
