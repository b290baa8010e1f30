//! A particle's answer against the balances of the present configuration, at a deformation without symmetry.

use super::*;
use crate::poro::response::Particle;
use nalgebra::{Matrix3, Vector3};

/// With F⁻¹ and J: stress V J (σ′ − p I) F⁻ᵀ, flow V J F⁻¹ κ (F⁻ᵀ ∇p − ρ_w g) at the present porosity, V (J − 1), and
/// the mass of grains and water in V J.
#[test]
fn an_answer_is_pulled_back_to_the_start() {
    let f = Matrix3::new(1.05, 0.1, -0.04, 0.02, 0.93, 0.06, -0.08, 0.03, 1.1);
    let (grains, density, g) = (2600.0, 1000.0, [0.3, 0.2, -10.0]);
    let water = water::<3>().gravity(Gravity { water: density, grains, acceleration: g });
    let (volume, jacobian, p, slope) = (0.3, 1.02, 2e3, [5e4, -8e4, 3e4]);
    let law = porous();
    let state = law.initial_state();
    let row = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let particle = Particle {
        law: &law.into(),
        state: &row,
        medium: water.media[0],
        gravity: water.gravity.as_ref(),
        rate: VolumeRate::Exact,
        dt: 1.0,
        volume,
        jacobian,
    };
    let answer = particle.respond(&f, p, &slope);

    let (j, inverse) = (f.determinant(), f.try_inverse().unwrap());
    let solid = (1.0 - POROSITY) / (jacobian * j);
    let pores = 1.0 - solid;
    let at_rest = (1.0 - POROSITY).powi(2) / POROSITY.powi(3);
    let kappa = KAPPA * at_rest * pores.powi(3) / (solid * solid);
    let total = law.response(&f, 1.0, &state).0.to_matrix() - Matrix3::identity() * p;
    let stress = total * inverse.transpose() * (j * volume);
    let mobility = inverse * inverse.transpose() * (j * volume * kappa);
    let head = inverse.transpose() * Vector3::from(slope) - Vector3::from(g) * density;
    let flow = inverse * head * (j * volume * kappa);
    for (i, k) in (0..9).map(|n| (n / 3, n % 3)) {
        let at = 3 * i + k;
        assert!((answer.stress[at] - stress[(i, k)]).abs() < 1e-13 * stress.norm());
        assert!((answer.mobility[at] - mobility[(i, k)]).abs() < 1e-13 * mobility.norm());
        assert!((answer.flow[i] - flow[i]).abs() < 1e-13 * flow.norm());
    }
    assert!((answer.rate - volume * (j - 1.0)).abs() < 1e-15);
    let mass = volume * j * (solid * grains + pores * density);
    assert!((answer.mass / mass - 1.0).abs() < 1e-14);
}
