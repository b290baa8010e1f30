//! A slope that slides on its base: two blocks, an upper bound for a base with Coulomb's friction.
//!
//! On a base that can hold no more than μ times its pressure the foot of a slope may slide out, pushed by a wedge behind it:
//!
//! ```text
//!              ______________ crest
//!        W    |\
//!       \     | \
//!        \ θ  |  \   B → v
//!     ====\===|===\====== base
//!             d    toe
//! ```
//!
//! The foot B moves with v, the wedge W with (v, v tan θ down), so that both jumps, along the vertical face above d and
//! along the wedge's own base, are tangential. For a stress field in equilibrium within the strength c, virtual power
//! demands
//!
//! γ A_W tan θ ≤ c [h tan θ + s (1 + tan² θ)] + T, T ≤ μ N and T ≤ c L, N = γ A_B + V, V ≤ c h
//!
//! with the height h of the vertical face, the run s of the wedge's base, the length L of the foot's, its friction T, and
//! its pressure's resultant N, which equilibrium of the foot gives by the shear force V on its back. So the bound is
//! rigorous, although friction is not associated. Strength is divided by the factor, c and μ alike.

use super::{Ranked, Search, Slope};
use std::f64::consts::FRAC_PI_2;

/// A foot that slides out before a wedge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliding {
    /// Factor of safety.
    pub factor: f64,
    /// Distance d of the foot's back from the toe of the uncut slope (m).
    pub back: f64,
    /// Angle θ of the wedge's base (rad).
    pub angle: f64,
    /// Where the wedge ends on the ground, from there (m).
    pub entry: f64,
}

/// How far behind the edge of the crest the foot's back may be, over the height.
const BEHIND: f64 = 2.0;

impl Ranked for Sliding {
    fn number(&self) -> f64 {
        self.factor
    }
}

impl Slope {
    /// The foot that slides first on a base of the coefficient μ = `friction`, for the shear strength c = `cohesion` (Pa)
    /// and the unit weight γ (N/m³); of a slope on its base, D = 1.
    #[must_use]
    pub fn sliding(&self, friction: f64, cohesion: f64, unit_weight: f64) -> Sliding {
        let [least, most] = [self.on_ground(0.0).x, self.run() + BEHIND * self.height];
        let of = |back: f64, angle: f64| self.slides(back, angle, [friction, cohesion, unit_weight]);
        SEARCH.least([least, most], |back| SEARCH.least([0.0, FRAC_PI_2], |angle| of(back, angle)))
    }

    fn slides(&self, back: f64, angle: f64, [mu, c, gamma]: [f64; 3]) -> Sliding {
        let (tan, run) = (angle.tan(), self.run());
        let height = self.ground(back);
        // The wedge's base meets the face, if it is steeper, or the crest.
        let slope = self.height / run;
        let on_face = back / (tan / slope - 1.0);
        let width = if tan > slope && back + on_face < run { on_face } else { self.height / tan };
        let wedge = self.area(back + width) - self.area(back) - 0.5 * width * width * tan;
        let toe = self.on_ground(0.0).x;
        let foot = self.area(back) - self.area(toe);
        let inside = height * tan + width * (1.0 + tan * tan);
        let drives = gamma * wedge * tan;
        // Equation in 1/F: c `inside` f + μ (γ A_B + c h f) f = `drives`, or with c L f for the friction.
        let [a, b] = [mu * c * height, c * inside + mu * gamma * foot];
        let slips = 2.0 * drives / (b + (b * b + 4.0 * a * drives).sqrt());
        let shears = drives / (c * (inside + back - toe));
        let share = slips.max(shears);
        Sliding { factor: if share > 0.0 { 1.0 / share } else { f64::INFINITY }, back, angle, entry: back + width }
    }

    /// Height (m) of the uncut ground at a distance from its toe.
    fn ground(&self, x: f64) -> f64 {
        (x * self.height / self.run()).min(self.height)
    }

    /// Area (m²) below the uncut ground up to a distance from its toe.
    fn area(&self, x: f64) -> f64 {
        let on_face = x.min(self.run());
        0.5 * on_face * self.ground(on_face) + (x - on_face) * self.height
    }
}

const SEARCH: Search = Search { samples: 64, sections: 40 };

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    const C: f64 = 5e3;
    const GAMMA: f64 = 2e4;

    fn slope(cut: f64) -> Slope {
        Slope::new(1.0, FRAC_PI_4, 1.0).unwrap().cut(cut).unwrap()
    }

    fn near(value: f64, exact: f64, to: f64) {
        assert!((value - exact).abs() <= to, "{value} against {exact}");
    }

    /// With the foot's back below the edge of the crest all areas are rectangles and triangles.
    #[test]
    fn a_foot_as_long_as_the_face_slides_by_a_quadratic() {
        let (mu, tan) = (0.3, 0.8_f64);
        let found = slope(0.0).slides(1.0, tan.atan(), [mu, C, GAMMA]);
        let f = 1.0 / found.factor;
        let inside = C * (2.0 * tan + 1.0 / tan) * f;
        let friction = mu * f * (0.5 * GAMMA + C * f);
        near(inside + friction, 0.5 * GAMMA, 1e-6);
        near(found.entry, 1.0 + 1.0 / tan, 1e-12);
        // The best angle on a smooth base, where only 2t + 1/t counts, has tan θ = 1/√2, with a back there.
        let smooth = |t: f64| slope(0.0).slides(1.0, t.atan(), [0.0, C, GAMMA]).factor;
        near(smooth(0.5_f64.sqrt()), 2.0 * 2.0_f64.sqrt() * C / (0.5 * GAMMA), 1e-9);
        assert!(smooth(0.5) > smooth(0.5_f64.sqrt()) && smooth(1.0) > smooth(0.5_f64.sqrt()));
    }

    /// Without friction enough nothing but the soil's own strength holds: no more than c L.
    #[test]
    fn friction_holds_no_more_than_the_soil() {
        let of = |mu| slope(0.2).slides(1.0, 0.7, [mu, C, GAMMA]).factor;
        assert!(of(0.1) < of(0.3));
        assert_eq!(of(5.0), of(50.0));
    }

    /// A vertical face without a foot is Culmann's plane, 4c/(γH).
    #[test]
    fn without_a_foot_it_is_culmanns_plane() {
        let face = Slope::new(1.0, FRAC_PI_2, 1.0).unwrap();
        near(face.sliding(0.7, C, GAMMA).factor, 1.0, 1e-6);
    }

    /// Areas of foot and wedge by strips, wherever the wedge ends.
    #[test]
    fn the_masses_are_those_of_strips() {
        let slope = slope(0.2);
        for (back, angle) in [(0.5, 1.2_f64), (0.5, 0.6), (1.4, 0.6)] {
            let found = slope.slides(back, angle, [0.0, C, GAMMA]);
            let strips = 200_000;
            let width = found.entry - back;
            let of = |k: usize| {
                let x = (k as f64 + 0.5) / f64::from(strips as u32) * width;
                (slope.ground(back + x) - x * angle.tan()) * width / strips as f64
            };
            let wedge: f64 = (0..strips).map(of).sum();
            let tan = angle.tan();
            let inside = C * (slope.ground(back) * tan + width * (1.0 + tan * tan));
            near(found.factor, inside / (GAMMA * wedge * tan), 1e-6);
            near(slope.ground(found.entry), width * tan, 1e-9);
        }
    }

    /// The best of all is no better than any on a lattice of its own, and its wedge fits behind a crest of 1.5 m.
    #[test]
    fn the_least_factor_is_found() {
        for (cut, mu) in [(0.0, 0.0), (0.0, 0.3), (0.2, 0.0), (0.2, 0.3), (0.2, 1.0)] {
            let slope = slope(cut);
            let best = slope.sliding(mu, C, GAMMA);
            assert!(best.entry < 2.5, "{best:?}");
            let mut least = f64::INFINITY;
            for k in 0..200 * 200 {
                let back = cut + (2.5 - cut) * f64::from(k / 200) / 199.0;
                let angle = FRAC_PI_2 * f64::from(k % 200 + 1) / 201.0;
                least = least.min(slope.slides(back, angle, [mu, C, GAMMA]).factor);
            }
            assert!(best.factor <= least && least < best.factor * 1.01, "{best:?} {least}");
        }
    }
}
