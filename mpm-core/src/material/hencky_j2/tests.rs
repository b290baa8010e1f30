//! The slope of plastic flow.

use super::*;
use crate::material::strength::ACCURACY;
use crate::number::Dual;

/// Young's modulus (Pa), Poisson's ratio and κ of a body that yields at an elastic strain of half a percent.
const YOUNG: f64 = 100.0;
const RATIO: f64 = 0.3;
const KAPPA: f64 = 0.4;

/// The flow's derivative is that of its equation, dγ (2μ + √(2/3) κ′) = dτ, however far from it Newton's last step
/// began. It would lag most where one step is enough, close to the surface: by some 10⁻⁶.
#[test]
fn the_slope_of_the_flow_does_not_lag() {
    // Almost as steep as the elastic slope, of which four hundredths are left.
    let eta = 240.0;
    let strength = Strength::softening(KAPPA, 0.06 * KAPPA, eta).unwrap();
    let law = HenckyJ2::new(YOUNG, RATIO, strength).unwrap();
    let slope = |plastic: f64| PER_FLOW * law.strength.at(plastic).1;
    let left = |plastic: f64| 2.0 * law.elasticity.shear_modulus + slope(plastic);
    // How far the flow may be from the equation's, times the relative curvature there: both are greatest at the
    // surface.
    let tolerance = ACCURACY * KAPPA / left(0.0) * (PER_FLOW * eta * slope(0.0) / left(0.0)).abs();
    // Excess from 25 times the strength down to what counts as none.
    for k in 0..350 {
        let trial = KAPPA * (1.0 + 25.0 * 0.9_f64.powi(k));
        let flow =
            law.strength.flow(Dual::<1>::variable(trial, 0), 2.0 * law.elasticity.shear_modulus, Dual::splat(0.0));
        assert_eq!(flow.value, law.strength.flow(trial, 2.0 * law.elasticity.shear_modulus, 0.0));
        let off = flow.slope[0] * left(PER_FLOW * flow.value) - 1.0;
        assert!(off.abs() < tolerance, "{trial}: {off}");
    }
}
