//! Slope with friction: the logarithmic spiral through its toe along which it slides first, an upper bound of limit
//! analysis for associated flow.
//!
//! Ground of cohesion c, angle of friction φ and unit weight γ, a face of height H and angle β below a level crest. The
//! mass above a spiral r = r₀ e^((θ − θ₀) tan φ) turns rigidly about its pole, so that the velocity opens the spiral at
//! the angle φ everywhere, as flow with ψ = φ demands. With θ from the horizontal downward, per unit of angular velocity,
//!
//! work = γ ∫ x dA, dissipation = c r₀² (e^(2 (θ_h − θ₀) tan φ) − 1)/(2 tan φ),
//!
//! and the least γH/c of all spirals from the crest (θ₀) to the toe (θ_h) is the stability number (W. F. Chen 1975, *Limit
//! Analysis and Soil Plasticity*, chapter 9). Spirals that leave below the toe are not tried: they are lower for flat
//! slopes with little friction only.

use crate::Error;

/// Samples along each angle, searches around the best of them, and how much closer each looks.
const SAMPLES: u32 = 40;
const SEARCHES: u32 = 14;
const CLOSER: f64 = 4.0;
/// Least opening of a spiral, rad: work is of third order in it, and below this mostly rounding. γH/c grows as it closes.
const LEAST_OPENING: f64 = 0.01;
/// Bisections of a factor of safety, and the greatest one.
const BISECTIONS: u32 = 50;
const GREATEST: f64 = 100.0;

/// γH/c of the mechanism from θ₀ to θ_h; none where the two are no slope.
fn number(beta: f64, tan_phi: f64, [first, last]: [f64; 2]) -> Option<f64> {
    let radius = ((last - first) * tan_phi).exp();
    let (entry, toe) = ([first.cos(), -first.sin()], [radius * last.cos(), -radius * last.sin()]);
    let height = entry[1] - toe[1];
    let crest = [toe[0] + height / beta.tan(), entry[1]];
    if last - first < LEAST_OPENING || height <= 0.0 || crest[0] >= entry[0] {
        return None;
    }
    // ∫ x dA of the sector between pole and spiral, less that of the triangles between pole and ground.
    let sector = |angle: f64| {
        let cube = (3.0 * (angle - first) * tan_phi).exp();
        cube * (3.0 * tan_phi * angle.cos() + angle.sin()) / (3.0 * (1.0 + 9.0 * tan_phi * tan_phi))
    };
    let triangle = |p: [f64; 2], q: [f64; 2]| (q[0] * p[1] - p[0] * q[1]) * (p[0] + q[0]) / 6.0;
    let work = sector(last) - sector(first) - triangle(entry, crest) - triangle(crest, toe);
    let dissipation = (radius * radius - 1.0) / (2.0 * tan_phi);
    (work > 0.0).then(|| height * dissipation / work)
}

/// γH/c of a slope of the angle `beta` (rad) and the angle of friction `phi` (rad).
///
/// # Errors
/// An angle that is not between 0 and π/2, or a slope that stands at any height.
pub fn stability_number(beta: f64, phi: f64) -> Result<f64, Error> {
    let right = std::f64::consts::FRAC_PI_2;
    for (name, angle, most) in [("beta", beta, right), ("phi", phi, right)] {
        if !(angle > 0.0 && angle <= most) {
            return Err(Error(format!("parameter {name}: {angle}; allowed: above 0 and up to π/2 (rad)")));
        }
    }
    if phi >= beta {
        return Err(Error(format!("parameter phi: {phi}; allowed: below the slope's angle {beta} (rad)")));
    }
    let mut best = (f64::INFINITY, [0.5 * right, right]);
    let mut width = [right, right];
    for _ in 0..SEARCHES {
        let middle = best.1;
        for sample in 0..(SAMPLES + 1) * (SAMPLES + 1) {
            let place = [sample % (SAMPLES + 1), sample / (SAMPLES + 1)];
            let at = |k: usize| middle[k] + width[k] * (2.0 * f64::from(place[k]) / f64::from(SAMPLES) - 1.0);
            let angles = [at(0), at(1)];
            if let Some(found) = number(beta, phi.tan(), angles).filter(|found| *found < best.0) {
                best = (found, angles);
            }
        }
        width = width.map(|width| width / CLOSER);
    }
    Ok(best.0)
}

/// The factor by which c and tan φ of a slope can be divided before it slides; `load` is its γH/c.
///
/// # Errors
/// As of [`stability_number`].
pub fn factor_of_safety(beta: f64, phi: f64, load: f64) -> Result<f64, Error> {
    let least = (phi.tan() / beta.tan()).max(0.0) * (1.0 + 1e-9);
    let (mut low, mut high) = (least, GREATEST);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let stands = stability_number(beta, (phi.tan() / middle).atan())? > load * middle;
        *(if stands { &mut low } else { &mut high }) = middle;
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chen's numbers, by the angles of slope and friction in degrees.
    #[test]
    fn stability_numbers_are_those_of_the_table() {
        for (beta, phi, expected) in [
            (90.0_f64, 20.0_f64, 5.50),
            (45.0, 20.0, 16.16),
            (30.0, 20.0, 41.22),
            (60.0, 10.0, 7.26),
            (45.0, 10.0, 9.31),
            (45.0, 5.0, 7.35),
        ] {
            let found = stability_number(beta.to_radians(), phi.to_radians()).unwrap();
            assert!((found - expected).abs() < 0.006, "{beta} {phi}: {found}");
        }
        // Without friction the spiral is a circle, which does not dip below the toe of so steep a slope.
        let circle = crate::slope::Slope::new(1.0, 75.0_f64.to_radians(), 1.0).unwrap();
        let found = stability_number(75.0_f64.to_radians(), 1e-5).unwrap();
        assert!((found - circle.stability_number()).abs() < 1e-3, "{found}");
    }

    /// Bishop and Morgenstern's charts have 1.380 for this slope.
    #[test]
    fn a_factor_of_safety_is_that_of_the_number() {
        let (beta, phi) = (0.5_f64.atan(), 20.0_f64.to_radians());
        let factor = factor_of_safety(beta, phi, 20.0).unwrap();
        assert!((factor - 1.368).abs() < 5e-4, "{factor}");
        let number = stability_number(beta, (phi.tan() / factor).atan()).unwrap();
        assert!((number / (20.0 * factor) - 1.0).abs() < 1e-9);
        assert!(stability_number(0.0, phi).is_err() && stability_number(beta, beta).is_err());
    }
}
