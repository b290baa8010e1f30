//! The limit load of undrained clay without weight.

use super::parameters::{
    COMPRESSIBILITY, CRITICAL_RATIO, GAMMA, INITIAL_PRESSURE, POROSITY, PRECONSOLIDATION,
};
use super::scene::moduli;
use crate::parameter::Parameters;
use std::f64::consts::PI;

/// Halvings of a bracket: until no number is left between its ends.
const HALVINGS: u32 = 200;

/// The root of what falls between two ends.
fn root(ends: (f64, f64), of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = ends;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if of(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    0.5 * (low + high)
}

/// Effective pressure (Pa) at an elastic volume strain `v`, compression positive, of the improved Hencky law with this
/// bulk modulus (Pa) at rest.
pub(super) fn pressure(bulk: f64, porosity: f64, v: f64) -> f64 {
    let n = 1.0 - (1.0 - porosity) * v.exp();
    bulk * porosity * (v / n + v * v * (1.0 - n) / (2.0 * n * n))
}

/// The volume strain at an effective pressure (Pa).
pub(super) fn volume(bulk: f64, porosity: f64, p: f64) -> f64 {
    let closed = -(1.0 - porosity).ln();
    root((0.0, closed), |v| p - pressure(bulk, porosity, v))
}

/// Undrained shear strength (Pa) of the clay in plane strain: M p/√3 at the critical state. There flow alone shears, so
/// that the stress across the plane is the mean one and q = √3 s_u. With a constant volume the elastic strain v and the
/// plastic one add up to nothing, hence p_c = p_c0 e^((v(p₀) − v(p))/ψ), compression positive, where p_c = 2p/γ.
pub(super) fn strength(parameters: &Parameters) -> f64 {
    let number = |p| parameters.number(p);
    let ([bulk, _], porosity) = (moduli(parameters), number(POROSITY));
    let start = volume(bulk, porosity, number(INITIAL_PRESSURE));
    let lacks = |v: f64| {
        let hardened = ((start - v) / number(COMPRESSIBILITY)).exp() * number(PRECONSOLIDATION);
        hardened - 2.0 * pressure(bulk, porosity, v) / number(GAMMA)
    };
    let closed = -(1.0 - porosity).ln();
    number(CRITICAL_RATIO) * pressure(bulk, porosity, root((0.0, closed), lacks)) / 3.0_f64.sqrt()
}

/// Prandtl's limit load of a strip on it (Pa), (2 + π) s_u beside what rests on the whole surface.
pub(super) fn prandtl(parameters: &Parameters) -> f64 {
    (2.0 + PI) * strength(parameters)
}

#[cfg(test)]
mod tests {
    use super::super::parameters::ALL;
    use super::super::scene::clay;
    use super::*;
    use mpm_core::Law;
    use nalgebra::Matrix3;

    /// The law itself, sheared at a constant volume until nothing changes.
    #[test]
    fn strength_is_what_the_law_comes_to() {
        for set in [
            &["initial_pressure=1e4"][..],
            &[],
            &["preconsolidation=1e5", "young_modulus=1e7"],
        ] {
            let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
            let parameters = Parameters::new(&ALL, &set).unwrap();
            let law = clay(&parameters).unwrap();
            let mut state = law.initial_state();
            let mut shear = 0.0;
            let stretch = |k: f64| Matrix3::from_diagonal(&[k.exp(), (-k).exp(), 1.0].into());
            for _ in 0..4000 {
                let (stress, after) = law.update(&stretch(5e-4), 1.0, &state);
                (state, shear) = (after, 0.5 * (stress.xx - stress.yy));
            }
            let exact = strength(&parameters);
            assert!((shear / exact - 1.0).abs() < 1e-3, "{shear} {exact}");
        }
    }
}
