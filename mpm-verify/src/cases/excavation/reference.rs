//! Limit analysis of the slope, whole and cut, on its base.

use super::parameters::{BASE, CUT, FRICTION, FRICTIONAL, PEAK, RESIDUAL, UNIT_WEIGHT};
use super::scene::HEIGHT;
use crate::exact::slope::Slope;
use crate::parameter::Parameters;
use std::f64::consts::FRAC_PI_4;

/// The least factor of safety of a slope and the length (m) of the arc or path along which it slides.
pub(super) type Factor = (f64, f64);

/// Factors of the whole slope and of the cut one at the peak strength, and of the cut one at the residual.
pub(super) fn factors(parameters: &Parameters) -> [Factor; 3] {
    let number = |p| parameters.number(p);
    [(0.0, PEAK), (number(CUT), PEAK), (number(CUT), RESIDUAL)]
        .map(|(cut, strength)| factor(parameters, cut, number(strength)))
}

/// The lesser of the factors of arcs, which a rough base allows, and of a foot that slides on its base.
fn factor(parameters: &Parameters, cut: f64, cohesion: f64) -> Factor {
    let number = |p| parameters.number(p);
    let slope = Slope::new(HEIGHT, FRAC_PI_4, 1.0).and_then(|s| s.cut(cut));
    let Ok(slope) = slope else {
        return (f64::NAN, f64::NAN);
    };
    let weight = number(UNIT_WEIGHT);
    let arc = slope.critical();
    let length = arc.circle.radius * arc.circle.angle();
    let turning = arc.factor_of_safety(cohesion, weight);
    if !parameters.is(BASE, FRICTIONAL) {
        return (turning, length);
    }
    let sliding = slope.sliding(number(FRICTION), cohesion, weight);
    if sliding.factor < turning {
        let height = HEIGHT / sliding.angle.sin();
        return (sliding.factor, height);
    }
    (turning, length)
}
