//! Ground: stresses of a half-space under a strip or a pad, earth pressure on smooth and rough walls, factors of bearing
//! capacity.

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

/// Horizontal part of Coulomb's active and passive coefficient (1776): a plane wedge behind a vertical wall with an angle of
/// friction δ, an upper bound of limit analysis, below the active and above the passive one.
#[must_use]
pub fn coulomb(phi: f64, delta: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|side| {
        let root = ((phi + delta).sin() * phi.sin() / delta.cos()).sqrt();
        (phi.cos() / (1.0 - side * root)).powi(2)
    })
}

/// Horizontal part of Lancellotta's active and passive coefficient (2002, doi:10.1680/geot.2002.52.8.617): a stress that is
/// admissible everywhere, the other bound.
#[must_use]
pub fn lancellotta(phi: f64, delta: f64) -> [f64; 2] {
    let turn = (delta.sin() / phi.sin()).asin();
    let root = (phi.sin().powi(2) - delta.sin().powi(2)).sqrt();
    [-1.0, 1.0].map(|side| {
        let fan = (side * (turn + side * delta) * phi.tan()).exp();
        delta.cos() * (delta.cos() + side * root) / (1.0 - side * phi.sin()) * fan
    })
}

/// Steps over the turn of the stress between wall and Rankine's zone, and bisections of the stress at the wall.
const TURNS: u32 = 1000;
const BISECTIONS: u32 = 50;

/// Horizontal part of the active and passive coefficient of a vertical wall with the angle of friction 0 < δ < φ, from
/// ground without cohesion (rad).
///
/// With the mean stress γ r s(θ), the angle ψ of the greatest pressure from the radius, θ from the wall and k = sin φ,
/// equilibrium along and across the radius is
///
/// s′ k sin 2ψ + 2 k s ψ′ cos 2ψ = cos θ − s − 3 k s cos 2ψ, s′ (1 − k cos 2ψ) + 2 k s ψ′ sin 2ψ = −sin θ − 3 k s sin 2ψ.
///
/// ψ runs from its value at the wall to that of the ray on which Rankine's zone ends, at θ = π/4 ± φ/2 (Sokolovskii 1965,
/// *Statics of Granular Media*); the bounds hold s at the wall.
#[must_use]
pub fn rough_wall(phi: f64, delta: f64) -> [f64; 2] {
    let (k, turn) = (phi.sin(), (delta.sin() / phi.sin()).asin());
    let bounds = [coulomb(phi, delta), lancellotta(phi, delta)];
    [0, 1].map(|which| {
        let side = if which == 1 { 1.0 } else { -1.0 };
        let first = 0.5 * if which == 1 { PI - turn - delta } else { delta - turn };
        let step = (side * (FRAC_PI_4 - 0.5 * phi) - first) / f64::from(TURNS);
        let slopes = |psi: f64, [theta, s]: [f64; 2]| {
            let (sin, cos) = (2.0 * psi).sin_cos();
            let [along, across] = [theta.cos() - s - 3.0 * k * s * cos, -theta.sin() - 3.0 * k * s * sin];
            let turned = k * sin * across - along * (1.0 - k * cos);
            [2.0 * k * s * (k - cos) / turned, 2.0 * k * s * (along * sin - cos * across) / turned]
        };
        // Where ψ ends, by Runge and Kutta's scheme.
        let ends = |s: f64| {
            let start = [0.0, s];
            (0..TURNS).fold(start, |at, i| {
                let psi = first + f64::from(i) * step;
                let to = |slope: [f64; 2], share: f64| [0, 1].map(|c| at[c] + share * step * slope[c]);
                let a = slopes(psi, at);
                let b = slopes(psi + 0.5 * step, to(a, 0.5));
                let c = slopes(psi + 0.5 * step, to(b, 0.5));
                let d = slopes(psi + step, to(c, 1.0));
                [0, 1].map(|i| at[i] + step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
            })[0]
        };
        let normal = 1.0 - k * (2.0 * first).cos();
        let mut range = bounds.map(|bound| bound[which] / normal);
        range.sort_by(f64::total_cmp);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (range[0] + range[1]);
            let short = (ends(middle) < FRAC_PI_4 + 0.5 * side * phi) == (which == 1);
            range[usize::from(!short)] = middle;
        }
        range[0] * normal
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
        // Rough walls: tables of Sokolovskii, and of Caquot and Kerisel (active), have total coefficients of two digits. An
        // angle that is hardly there is Rankine's wall.
        for (phi, delta, active, passive) in
            [(30.0_f64, 15.0_f64, 0.30, 4.62), (40.0, 20.0, 0.20, 9.69), (30.0, 1e-3, 0.333, 3.0)]
        {
            let found = rough_wall(phi.to_radians(), delta.to_radians()).map(|k| k / delta.to_radians().cos());
            assert!(
                (found[0] - active).abs() < 0.005 && (found[1] / passive - 1.0).abs() < 0.005,
                "{phi} {delta}: {found:?}"
            );
        }
        let [low, high] = [coulomb(0.5, 0.2), lancellotta(0.5, 0.2)];
        assert!(low[0] < high[0] && low[1] > high[1]);
        let [nq, nc] = prandtl_reissner(30.0_f64.to_radians());
        assert!((nq - 18.401).abs() < 1e-3 && (nc - 30.140).abs() < 1e-3);
        // Without friction a quarter circle between two wedges of 45 degrees.
        let [end, depth] = prandtl_extent(0.0, 2.0);
        assert!((end - 3.0).abs() < 1e-12 && (depth - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!((prandtl_extent(30.0_f64.to_radians(), 1.0)[0] - 4.79).abs() < 0.005);
    }
}
