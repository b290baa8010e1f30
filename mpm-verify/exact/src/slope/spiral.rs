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
//!
//! **With water** of the pressure u in pores, effective stresses do no work where the spiral opens, and u does ∫ u v_n ds =
//! tan φ ∫ u r² dθ, which is part of the work (Michalowski 1995, doi:10.1680/geot.1995.45.2.283).

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

/// Panels of the pressure's integral along a spiral.
const PANELS: u32 = 64;

/// Water's pressure over γH at a place over H, from the toe into the slope and upward.
pub type Water<'a> = &'a dyn Fn([f64; 2]) -> f64;

/// γH/c of the mechanism from θ₀ to θ_h; none where the two are no slope.
fn number(beta: f64, tan_phi: f64, [first, last]: [f64; 2], water: Option<Water<'_>>) -> Option<f64> {
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
    let weight = sector(last) - sector(first) - triangle(entry, crest) - triangle(crest, toe);
    let opening = |water: Water<'_>| {
        let panel = (last - first) / f64::from(PANELS);
        let at = |i: u32| {
            let angle = first + (f64::from(i) + 0.5) * panel;
            let r = ((angle - first) * tan_phi).exp();
            r * r * water([(r * angle.cos() - toe[0]) / height, (-r * angle.sin() - toe[1]) / height])
        };
        height * tan_phi * panel * (0..PANELS).map(at).sum::<f64>()
    };
    let work = weight + water.map_or(0.0, opening);
    let dissipation = (radius * radius - 1.0) / (2.0 * tan_phi);
    (work > 0.0).then(|| height * dissipation / work)
}

/// γH/c of a slope of the angle `beta` (rad) and the angle of friction `phi` (rad).
///
/// # Errors
/// An angle that is not between 0 and π/2, or a slope that stands at any height.
pub fn stability_number(beta: f64, phi: f64) -> Result<f64, Error> {
    least_number(beta, phi, None)
}

fn least_number(beta: f64, phi: f64, water: Option<Water<'_>>) -> Result<f64, Error> {
    let right = std::f64::consts::FRAC_PI_2;
    for (name, angle, most) in [("beta", beta, right), ("phi", phi, right)] {
        if !(angle > 0.0 && angle <= most) {
            return Err(Error(format!("parameter {name}: {angle}; allowed: above 0 and up to π/2 (rad)")));
        }
    }
    if phi >= beta && water.is_none() {
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
            if let Some(found) = number(beta, phi.tan(), angles, water).filter(|found| *found < best.0) {
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
    let flat = (phi.tan() / beta.tan()).max(0.0) * (1.0 + 1e-9);
    search([flat, GREATEST], |factor| Ok(least_number(beta, (phi.tan() / factor).atan(), None)? > load * factor))
}

/// That of a slope with water.
///
/// # Errors
/// An angle that is not between 0 and π/2.
pub fn factor_of_safety_with_water(beta: f64, phi: f64, load: f64, water: Water<'_>) -> Result<f64, Error> {
    let stands = |factor: f64| Ok(least_number(beta, (phi.tan() / factor).atan(), Some(water))? > load * factor);
    search([1.0 / GREATEST, GREATEST], stands)
}

fn search([mut low, mut high]: [f64; 2], stands: impl Fn(f64) -> Result<bool, Error>) -> Result<f64, Error> {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        *(if stands(middle)? { &mut low } else { &mut high }) = middle;
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
        let least = stability_number(beta, (phi.tan() / factor).atan()).unwrap();
        assert!((least / (20.0 * factor) - 1.0).abs() < 1e-9);
        // No water, and a slope under water, on whose surface it presses as well: by the whole of its buoyancy, ∮ u v_n ds.
        let none = factor_of_safety_with_water(beta, phi, 20.0, &|_| 0.0).unwrap();
        assert!((none / factor - 1.0).abs() < 1e-9, "{none}");
        let (beta, angles) = (45.0_f64.to_radians(), [0.6_f64, 1.7]);
        let [dry, wet] = [None, Some(&(|[_, y]: [f64; 2]| 0.5 * (1.0 - y)) as Water<'_>)];
        let [dry, wet] = [dry, wet].map(|water| number(beta, phi.tan(), angles, water).unwrap().recip());
        let radius = (1.1 * phi.tan()).exp();
        let (toe, height) =
            ([radius * angles[1].cos(), -radius * angles[1].sin()], radius * angles[1].sin() - angles[0].sin());
        let on_face: f64 = (0..1000)
            .map(|i| {
                // The face outward is (−sin β, cos β), the velocity there (y, −x) from the pole.
                let up = height * (f64::from(i) + 0.5) / 1000.0;
                let [x, y] = [toe[0] + up / beta.tan(), toe[1] + up];
                -0.5 * (height - up) * (beta.sin() * y + beta.cos() * x) * height / 1000.0 / beta.sin()
            })
            .sum();
        let dissipation = height * (radius * radius - 1.0) / (2.0 * phi.tan());
        let sum = (wet - dry) * dissipation - on_face;
        assert!((sum / (-0.5 * dry * dissipation) - 1.0).abs() < 1e-3, "{sum} {}", dry * dissipation);
        assert!(stability_number(0.0, phi).is_err() && stability_number(phi, phi).is_err());
    }
}
