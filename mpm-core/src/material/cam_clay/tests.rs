//! The return to the surface of clay, and its slopes.

use super::*;
use crate::number::Dual;

/// K, G (Pa) and porosity, of clay whose shear and bulk moduli are alike.
fn elasticity() -> ImprovedHencky {
    ImprovedHencky::new(2e6, 1.5e6, 0.5).unwrap()
}

const RATIO: f64 = 0.9;
/// λ − κ.
const PSI: f64 = 0.06;
const PRECONSOLIDATION: f64 = 100e3;

fn clay(initial_pressure: f64) -> CamClay {
    CamClay::new(elasticity(), RATIO, PSI, PRECONSOLIDATION, initial_pressure).unwrap()
}

/// Ellipse, drops, and surfaces whose critical state lies low.
fn shapes() -> [(f64, f64); 4] {
    [(1.0, 1.0), (0.5, 1.0), (1.0, 0.6), (0.3, 0.8)]
}

/// ((p − ρ)/A)² + (q/B)² − 1, with ρ, A and B.
fn surface(law: &CamClay, [p, q, pc]: [f64; 3]) -> (f64, [f64; 3]) {
    let (alpha, gamma) = (law.alpha, law.gamma);
    let rho = 0.5 * gamma * pc;
    let a = (1.0 - gamma) * p + 0.5 * gamma * pc;
    let b = law.critical_ratio * ((1.0 - alpha) * p + 0.5 * alpha * gamma * pc);
    let value = ((p - rho) / a).powi(2) + (q / b).powi(2) - 1.0;
    (value, [rho, a, b])
}

/// Steps that no solver should take, and what is left to rounding: all end on the surface.
#[test]
fn the_return_finds_its_end_from_anywhere() {
    for (alpha, gamma) in shapes() {
        for psi in [1e-3, 0.06, 0.5] {
            let law =
                CamClay::new(elasticity(), RATIO, psi, PRECONSOLIDATION, 30e3).unwrap().shaped(alpha, gamma).unwrap();
            for volume in [-0.6, -0.1, -1e-3, 0.0, 1e-3, 0.03] {
                for shear in [0.0, 1e-6, 1e-3, 0.1, 2.0] {
                    let trial = Trial {
                        volume: law.initial_volume + volume,
                        shear: 3.0 * law.elasticity.shear_modulus * shear,
                        preconsolidation: PRECONSOLIDATION,
                    };
                    let Some(end) = law.flow(&trial) else {
                        continue;
                    };
                    let pc = PRECONSOLIDATION * ((end.volume - trial.volume) / psi).exp();
                    let [_, mean, _] = law.elasticity.volumetric(end.volume);
                    let q = trial.shear * end.shear_remains;
                    let (off, _) = surface(&law, [-mean, q, pc]);
                    // p_c has the rounding of both strains over ψ.
                    let strains = end.volume.abs() + trial.volume.abs();
                    let allowed = 1e-12 + 4e-14 * strains / psi;
                    assert!(off.abs() < allowed, "{alpha} {gamma} {psi} {volume} {shear}: {off}");
                    assert!(end.shear_remains > 0.0 && end.shear_remains <= 1.0);
                }
            }
        }
    }
}

/// The derivatives by the trial state solve the equations of the return, however few steps it took: they would lag most
/// close to the surface, where one is enough.
#[test]
fn the_slopes_of_the_return_do_not_lag() {
    for (alpha, gamma) in shapes() {
        let law = clay(40e3).shaped(alpha, gamma).unwrap();
        // q of the surface at its pressure: it grows through the surface.
        let [_, mean, _] = law.elasticity.volumetric(law.initial_volume);
        let at_zero = surface(&law, [-mean, 0.0, PRECONSOLIDATION]);
        let yields = at_zero.1[2] * (-at_zero.0).sqrt();
        let mut flown = 0;
        for k in 0..300 {
            let one = Trial {
                volume: law.initial_volume,
                shear: yields * (1.0 + 3.0 * 0.9_f64.powi(k)),
                preconsolidation: PRECONSOLIDATION,
            };
            let variables = Trial {
                volume: Dual::<2>::variable(one.volume, 0),
                shear: Dual::variable(one.shear, 1),
                preconsolidation: Dual::splat(one.preconsolidation),
            };
            let Some(end) = law.flow(&variables) else {
                continue;
            };
            flown += 1;
            assert_eq!(end.volume.value, law.flow(&one).unwrap().volume);
            // The equations in numbers with derivatives: N² = 1, and the flow's direction.
            let number = Dual::<2>::splat;
            let [_, mean, _] = law.elasticity.volumetric(end.volume);
            let (p, q) = (-mean, variables.shear * end.shear_remains);
            let flow = end.volume - variables.volume;
            let rho = number(0.5 * gamma * PRECONSOLIDATION) * (flow * number(1.0 / PSI)).exp();
            let a = number(1.0 - gamma) * p + rho;
            let b = number(RATIO) * (number(1.0 - alpha) * p + number(alpha) * rho);
            let (x, y) = ((p - rho) / a, q / b);
            let sum = x * x + y * y;
            let shear = (variables.shear - q) / number(3.0 * law.elasticity.shear_modulus);
            let cross = flow * q / (b * b) - shear * (p - rho) / (a * a);
            // Over what they are made of: of strains some 10, of the flow's direction ε_s/A a strain.
            let scale = [PRECONSOLIDATION, 1.0 / PRECONSOLIDATION];
            for k in 0..2 {
                let unit = [1.0, 1.0 / PRECONSOLIDATION][k];
                let off = sum.slope[k] / unit / (law.elasticity.shear_modulus / scale[0]);
                assert!(off.abs() < 1e-9, "{alpha} {gamma}: {off}");
                let off = cross.slope[k] / unit / scale[1];
                assert!(off.abs() < 1e-9, "{alpha} {gamma}: {off}");
            }
        }
        assert!(flown > 250, "{flown}");
    }
}
