//! Undrained slope: the circle along which it slides first, an upper bound of limit analysis.
//!
//! Plane strain. Homogeneous soil of undrained shear strength c (φ = 0) and unit weight γ = ρ g, a face of
//! height H and angle β, a level crest, and a firm, rough base D·H below the crest. The toe is the origin,
//! x points into the soil and y up:
//!
//! ```text
//!                       (H cot β, H) ________ crest
//!                           /
//!                     face / β
//!      floor ____________ /
//!                      (0, 0)
//!      ======================================= base, y = −(D − 1) H
//! ```
//!
//! **Mechanism.** The mass between the ground and an arc turns rigidly about the centre of the arc. The jump in
//! velocity is tangential, as φ = 0 demands, so the mechanism is kinematically admissible, and the load
//! at which the work of gravity equals the dissipation bounds the collapse load from above (Chen 1975,
//! *Limit Analysis and Soil Plasticity*). Per unit of angular velocity and breadth
//!
//! work = γ A (x̄ − x_c), dissipation = c R² θ, so γH/c = H R² θ/(A (x̄ − x_c))
//!
//! for a mass of area A and centroid x̄ and an arc of radius R, centre x_c and central angle θ. The stability
//! number is the least γH/c of all circles; Taylor's (1937) is its inverse. The true collapse load is a little
//! lower: for β = 45°, D = 1 circles give 6.078, and finite-element limit analysis bounds it by 6.015 from
//! below (`references/slope_bounds.py`).
//!
//! **Exact integrals.** The chord splits the mass into a polygon and a circular segment. The segment has the
//! area R² (θ − sin θ)/2 and the first moment s³/12 about the centre, along the bisector, for a chord s.
//!
//! **Circles.** A circle enters at the crest and leaves on the face, at the toe or on the floor. It may touch
//! the base but not pass below it: a mass cut off by the base could not turn rigidly. Two families suffice.
//!
//! - *Face and toe*: a chord from the height e on the face, inclined at ω, under an arc of half angle α ≤ π/2.
//!   An arc of α > ω dips by s (1 − cos(α − ω))/(2 sin α) below its exit. This grows with α, so
//!   the base sets a greatest α, and with q = 2 (e + (D − 1) H)/s and t = tan((α − ω)/2) it is the root
//!   of (2 + q sin ω) t² − 2q cos ω t − q sin ω = 0.
//! - *Floor*: for given R and y_c the work is ½ γ ∫₀ᴴ (R² − (y − y_c)² − (y cot β − x_c)²) dy, greatest at
//!   x_c = ½ H cot β: the best circles are Taylor's midpoint circles. With the dip p below the floor and
//!   k = cot(½ exit angle), R = ½ p (k² + 1) and y_c = ½ p (k² − 1). The centre is not below the floor
//!   (k ≥ 1), the toe is inside (p k ≥ ½ H cot β), and the entry is not on the face
//!   (p (1 + p) k² ≥ 1 + p + (½ cot β)², with p in units of H).
//!
//! Deep midpoint circles tend to γH/c = 4α/sin² α with tan α = 2α, which is 5.52 whatever β: see [`DEEP`].
//!
//! **Search.** Nested, per parameter samples and then golden sections between the neighbours of the best;
//! deterministic. The sampling is what finds the global minimum; refined, it changes γH/c by less than 1e-9 of it.
//!
//! Taylor (1937), "Stability of earth slopes", J. Boston Soc. Civ. Eng. 24(3), 197–246; Taylor (1948),
//! *Fundamentals of Soil Mechanics*.

use crate::error::Error;
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, PI};

/// Limit of γH/c of midpoint circles as their dip grows, 4α/sin² α at tan α = 2α. It is the stability number of
/// a slope without a firm base, unless the slope is steeper than about 53° and fails through its toe.
pub const DEEP: f64 = 5.520_200_558_757_204;

/// A slope of cohesive soil over a firm base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    height: f64,
    angle: f64,
    depth_factor: f64,
}

/// An arc of slip, from its exit (the lower end) counterclockwise to its entry on the crest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Centre (m).
    pub centre: Vector2<f64>,
    /// Radius R (m).
    pub radius: f64,
    /// Where it leaves the soil: on the face, at the toe or on the floor (m).
    pub exit: Vector2<f64>,
    /// Where it enters, on the crest (m).
    pub entry: Vector2<f64>,
}

/// A mass that turns about the centre of its arc, per unit of breadth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// The arc.
    pub circle: Circle,
    /// Area A of the mass (m²).
    pub area: f64,
    /// Centroid of the mass (m).
    pub centroid: Vector2<f64>,
}

impl Circle {
    /// Central angle θ of the arc (rad).
    #[must_use]
    pub fn angle(&self) -> f64 {
        let chord = self.entry - self.exit;
        let to_centre = self.centre - self.exit;
        let distance = chord.perp(&to_centre) / chord.norm();
        2.0 * (0.5 * chord.norm()).atan2(distance)
    }

    /// Lowest point of the arc (m).
    #[must_use]
    pub fn lowest(&self) -> Vector2<f64> {
        if self.exit.x < self.centre.x {
            self.centre - Vector2::new(0.0, self.radius)
        } else {
            self.exit
        }
    }

    /// The point at the fraction 0 (exit) to 1 (entry) of the arc (m).
    #[must_use]
    pub fn point(&self, fraction: f64) -> Vector2<f64> {
        let (sin, cos) = (fraction * self.angle()).sin_cos();
        let from = self.exit - self.centre;
        self.centre + Vector2::new(cos * from.x - sin * from.y, sin * from.x + cos * from.y)
    }
}

impl Mechanism {
    /// Rate of work of gravity γ A (x̄ − x_c) per unit of angular velocity (N), for the unit weight γ (N/m³).
    #[must_use]
    pub fn work(&self, unit_weight: f64) -> f64 {
        unit_weight * self.area * (self.centroid.x - self.circle.centre.x)
    }

    /// Rate of dissipation c R² θ per unit of angular velocity (N), for the shear strength c (Pa).
    #[must_use]
    pub fn dissipation(&self, cohesion: f64) -> f64 {
        cohesion * self.circle.radius.powi(2) * self.circle.angle()
    }

    /// Factor of safety of this mechanism, dissipation over work, for c (Pa) and γ (N/m³).
    #[must_use]
    pub fn factor_of_safety(&self, cohesion: f64, unit_weight: f64) -> f64 {
        self.dissipation(cohesion) / self.work(unit_weight)
    }
}

impl Slope {
    /// The slope of the height H (m), the angle β of the face (rad) and the depth factor D, the depth of the
    /// base below the crest over H.
    ///
    /// # Errors
    /// A height that is not positive, an angle beyond 1° to 90°, a depth factor beyond 1 to 100.
    pub fn new(height: f64, angle: f64, depth_factor: f64) -> Result<Self, Error> {
        positive(["height", "m"], height)?;
        within(["angle", "rad"], angle, [PI / 180.0, FRAC_PI_2])?;
        within(["depth_factor", "-"], depth_factor, [1.0, 100.0])?;
        Ok(Self {
            height,
            angle,
            depth_factor,
        })
    }

    /// The mechanism of the least γH/c.
    #[must_use]
    pub fn critical(&self) -> Mechanism {
        self.least(SEARCH)
    }

    /// Stability number γH/c at failure, the least over all admissible circles.
    #[must_use]
    pub fn stability_number(&self) -> f64 {
        self.number(&self.critical().circle)
    }

    /// Factor of safety against sliding, N c/(γH) with the stability number N, for the undrained shear
    /// strength c (Pa) and the unit weight γ (N/m³).
    ///
    /// # Errors
    /// A strength or weight that is not positive.
    pub fn factor_of_safety(&self, cohesion: f64, unit_weight: f64) -> Result<f64, Error> {
        positive(["cohesion", "Pa"], cohesion)?;
        positive(["unit_weight", "N/m³"], unit_weight)?;
        Ok(self.stability_number() * cohesion / (unit_weight * self.height))
    }

    /// The mass above an arc of this slope; that the arc is admissible is not checked.
    #[must_use]
    pub fn mechanism(&self, circle: Circle) -> Mechanism {
        let [mut area, mut x, mut y] = segment(&circle);
        for [a, b] in self.polygon(&circle) {
            let [p, q] = [a - circle.centre, b - circle.centre];
            let twice = p.perp(&q);
            area += twice / 2.0;
            x += twice * (p.x + q.x) / 6.0;
            y += twice * (p.y + q.y) / 6.0;
        }
        Mechanism {
            circle,
            area,
            centroid: circle.centre + Vector2::new(x, y) / area,
        }
    }

    /// Edges of the polygon on the chord, counterclockwise: the chord, then back along the ground.
    fn polygon(&self, circle: &Circle) -> [[Vector2<f64>; 2]; 4] {
        let edge = Vector2::new(self.run(), self.height);
        let toe = Vector2::zeros();
        let last = if circle.exit.x < 0.0 {
            toe
        } else {
            circle.exit
        };
        [
            [circle.exit, circle.entry],
            [circle.entry, edge],
            [edge, last],
            [last, circle.exit],
        ]
    }

    /// Horizontal length of the face H cot β (m).
    fn run(&self) -> f64 {
        self.height * self.angle.cos() / self.angle.sin()
    }

    /// Depth of the base below the toe (D − 1) H (m).
    fn depth(&self) -> f64 {
        (self.depth_factor - 1.0) * self.height
    }

    /// γH/c of a circle.
    fn number(&self, circle: &Circle) -> f64 {
        self.height * self.mechanism(*circle).factor_of_safety(1.0, 1.0)
    }

    fn least(&self, search: Search) -> Mechanism {
        let (face, floor) = (self.on_face(search), self.on_floor(search));
        let best = if floor.number < face.number {
            floor
        } else {
            face
        };
        self.mechanism(best.circle)
    }

    /// The best circle that leaves on the face or at the toe.
    fn on_face(&self, search: Search) -> Candidate {
        search.least([0.0, self.height], |height| {
            search.least([0.0, self.angle], |inclination| {
                self.on_chord(search, height, inclination)
            })
        })
    }

    /// The best circle through the face at a height whose chord is inclined by ω.
    fn on_chord(&self, search: Search, height: f64, inclination: f64) -> Candidate {
        let (sin, cos) = inclination.sin_cos();
        let chord = (self.height - height) / sin;
        let direction = Vector2::new(cos, sin);
        let exit = Vector2::new(height * self.run() / self.height, height);
        let most = inclination + greatest_dive(2.0 * (height + self.depth()) / chord, inclination);
        search.least([0.0, most.min(FRAC_PI_2)], |half| {
            let radius = chord / (2.0 * half.sin());
            let normal = Vector2::new(-sin, cos) * (radius * half.cos());
            self.candidate(Circle {
                centre: exit + direction * (chord / 2.0) + normal,
                radius,
                exit,
                entry: exit + direction * chord,
            })
        })
    }

    /// The best circle that leaves on the floor; dips H (Dˢ − 1) are sampled evenly in s.
    fn on_floor(&self, search: Search) -> Candidate {
        search.least([0.0, 1.0], |s| {
            let (p, m) = (self.depth_factor.powf(s) - 1.0, 0.5 / self.angle.tan());
            let entry = ((1.0 + p + m * m) / (p * (1.0 + p))).sqrt();
            let least = entry.max(m / p).max(1.0);
            search.least([0.0, 1.0 / least], |tangent| {
                self.candidate(self.midpoint(p * self.height, 1.0 / tangent))
            })
        })
    }

    /// The midpoint circle that dips by `dip` (m) below the floor, with k the cotangent of half its exit angle.
    fn midpoint(&self, dip: f64, k: f64) -> Circle {
        let centre = Vector2::new(0.5 * self.run(), 0.5 * dip * (k * k - 1.0));
        let above = 2.0 * centre.y - self.height;
        let entry = centre.x + (dip * dip * k * k + self.height * above).sqrt();
        Circle {
            centre,
            radius: 0.5 * dip * (k * k + 1.0),
            exit: Vector2::new(centre.x - dip * k, 0.0),
            entry: Vector2::new(entry, self.height),
        }
    }

    fn candidate(&self, circle: Circle) -> Candidate {
        let number = self.number(&circle);
        Candidate {
            number: if number > 0.0 { number } else { f64::INFINITY },
            circle,
        }
    }
}

/// Area of the segment between chord and arc, and its first moments about the centre.
fn segment(circle: &Circle) -> [f64; 3] {
    let theta = circle.angle();
    let chord = circle.entry - circle.exit;
    let moment = chord.norm_squared() / 12.0;
    [
        0.5 * circle.radius.powi(2) * (theta - theta.sin()),
        moment * chord.y,
        -moment * chord.x,
    ]
}

/// Greatest α − ω, the angle below the horizontal at which an arc runs from its exit into the soil, if it may
/// dip by q/2 of its chord below the exit.
fn greatest_dive(q: f64, inclination: f64) -> f64 {
    let (sin, cos) = inclination.sin_cos();
    let a = 2.0 + q * sin;
    let root = (q * q * cos * cos + a * q * sin).sqrt();
    2.0 * ((q * cos + root) / a).atan()
}

/// A circle and its γH/c; infinite where gravity does no work.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    number: f64,
    circle: Circle,
}

/// How finely each parameter is searched.
#[derive(Debug, Clone, Copy)]
struct Search {
    /// Intervals between the samples of the whole range.
    samples: u32,
    /// Golden sections after that.
    sections: u32,
}

const SEARCH: Search = Search {
    samples: 16,
    sections: 40,
};

/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Search {
    /// The best of a one-parameter family, the ends of its range among them.
    fn least(self, [from, to]: [f64; 2], family: impl Fn(f64) -> Candidate) -> Candidate {
        let step = (to - from) / f64::from(self.samples);
        let at = |i: u32| from + f64::from(i) * step;
        let (mut best, mut place) = (family(to), self.samples);
        for i in 0..self.samples {
            let candidate = family(at(i));
            if candidate.number < best.number {
                (best, place) = (candidate, i);
            }
        }
        let bracket = [
            at(place.saturating_sub(1)),
            at((place + 1).min(self.samples)),
        ];
        better(best, self.sections(bracket, family))
    }

    /// Golden sections of a bracket.
    fn sections(self, [mut a, mut b]: [f64; 2], family: impl Fn(f64) -> Candidate) -> Candidate {
        let low = |a: f64, b: f64| b - GOLDEN * (b - a);
        let high = |a: f64, b: f64| a + GOLDEN * (b - a);
        let (mut left, mut right) = (family(low(a, b)), family(high(a, b)));
        for _ in 0..self.sections {
            if left.number < right.number {
                b = high(a, b);
                (left, right) = (family(low(a, b)), left);
            } else {
                a = low(a, b);
                (left, right) = (right, family(high(a, b)));
            }
        }
        better(left, right)
    }
}

fn better(a: Candidate, b: Candidate) -> Candidate {
    if b.number < a.number { b } else { a }
}

/// Refuses what is not positive and finite.
fn positive(what: [&str; 2], value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(refusal(what, value, "more than 0"))
}

/// Refuses what is not within a closed range.
fn within(what: [&str; 2], value: f64, [least, most]: [f64; 2]) -> Result<(), Error> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(refusal(what, value, &format!("{least:.4} to {most:.4}")))
}

fn refusal([name, unit]: [&str; 2], value: f64, allowed: &str) -> Error {
    Error::Input(format!(
        "{name}: {value} is out of range; allowed: {allowed} ({unit})"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slope(degrees: f64, depth_factor: f64) -> Slope {
        Slope::new(1.0, degrees.to_radians(), depth_factor).unwrap()
    }

    fn number(degrees: f64, depth_factor: f64) -> f64 {
        slope(degrees, depth_factor).stability_number()
    }

    fn near(found: f64, expected: f64, tolerance: f64) {
        let difference = (found - expected).abs();
        assert!(difference <= tolerance, "{found}, expected {expected}");
    }

    /// Angles and depth factors with critical circles of every kind.
    const SLOPES: [(f64, f64); 14] = [
        (90.0, 1.0),
        (53.0, 4.0),
        (30.0, 100.0),
        (75.0, 1.0),
        (60.0, 1.0),
        (60.0, 3.0),
        (45.0, 1.0),
        (45.0, 1.2),
        (45.0, 1.5),
        (30.0, 1.0),
        (30.0, 1.2),
        (15.0, 1.0),
        (15.0, 3.0),
        (5.0, 1.5),
    ];

    /// Taylor (1948), table 16.1: c/γH with three digits; his search by hand is good to one in the last.
    #[test]
    fn taylors_table_is_met() {
        for (degrees, expected) in [(90.0, 0.261), (75.0, 0.219), (60.0, 0.191), (53.0, 0.181)] {
            near(1.0 / number(degrees, 100.0), expected, 1e-3);
        }
        for degrees in [45.0, 30.0, 22.5, 15.0, 7.5] {
            near(1.0 / number(degrees, 100.0), 0.181, 5e-4);
        }
    }

    /// The same table for the best circle through the toe of a deep soil, in which a circle off the toe is more
    /// dangerous: c/γH and the depth factor that the circle touches.
    #[test]
    fn taylors_toe_circles_are_met() {
        for (degrees, expected, depth_factor) in [
            (45.0, 0.170, 1.062),
            (30.0, 0.156, 1.301),
            (15.0, 0.145, 2.117),
        ] {
            let toe = slope(degrees, 100.0).on_face(SEARCH);
            assert_eq!(toe.circle.exit, Vector2::zeros());
            near(1.0 / toe.number, expected, 1e-3);
            near(1.0 - toe.circle.lowest().y, depth_factor, 0.02);
        }
    }

    /// Read off the curves of Taylor's chart for β < 53°, to 0.003.
    #[test]
    fn taylors_chart_over_depth_is_met() {
        for (degrees, depth_factor, expected) in [
            (45.0, 1.0, 0.166),
            (30.0, 1.0, 0.132),
            (22.5, 1.0, 0.114),
            (15.0, 1.02, 0.090),
            (45.0, 2.0, 0.178),
            (30.0, 2.0, 0.172),
            (22.5, 2.0, 0.166),
            (15.0, 2.0, 0.150),
            (7.5, 2.0, 0.106),
            (15.0, 3.0, 0.168),
            (7.5, 3.0, 0.140),
        ] {
            near(1.0 / number(degrees, depth_factor), expected, 3e-3);
        }
    }

    /// Griffiths and Lane (1999), doi:10.1680/geot.1999.49.3.387: a slope of 2 to 1 over a base at D = 2 with
    /// c = 0.25 γH has the factor of safety 1.47 by Taylor's chart and by finite elements.
    #[test]
    fn the_slope_of_griffiths_and_lane_is_as_safe_as_published() {
        let s = Slope::new(10.0, 0.5_f64.atan(), 2.0).unwrap();
        near(s.factor_of_safety(50e3, 20e3).unwrap(), 1.47, 0.01);
    }

    /// 45° on a firm base at the level of the toe: the circle touches the base and leaves a little above the toe.
    /// The numbers are those of a random search over centres and radii with horizontal strips for the moment.
    #[test]
    fn the_critical_circle_of_45_degrees_is_that_of_an_independent_search() {
        let m = slope(45.0, 1.0).critical();
        near(number(45.0, 1.0), 6.077_867_020, 1e-8);
        near(m.circle.radius, 1.673_588_7, 1e-5);
        near(m.circle.centre.x, 0.261_950_3, 1e-5);
        near(m.circle.lowest().y, 0.0, 1e-9);
        near(m.circle.exit.y, 0.0179, 1e-4);
        near(m.circle.entry.x, 1.7940, 1e-4);
    }

    #[derive(serde::Deserialize)]
    struct Bounds {
        angle: f64,
        lower: f64,
        upper: f64,
    }

    /// Finite-element limit analysis, from `references/slope_bounds.py`, without a circle in it.
    #[test]
    fn the_number_is_between_the_bounds_of_finite_elements() {
        let text = include_str!("../../references/slope_bounds.json");
        let bounds: Vec<Bounds> = serde_json::from_str(text).unwrap();
        assert_eq!(bounds.len(), 3);
        for b in bounds {
            let n = number(b.angle, 1.0);
            assert!(b.lower < n && n < b.upper, "{} {n} {}", b.lower, b.upper);
            near(n, b.lower, 0.02 * n);
        }
    }

    /// Arcs of vanishing curvature are Culmann's planes, γH/c = 4 sin β/(1 − cos β): 4 for a vertical cut.
    #[test]
    fn flat_arcs_are_culmanns_planes_and_circles_are_worse() {
        near(number(90.0, 1.0), 3.83, 5e-3);
        for degrees in [90.0_f64, 60.0, 45.0] {
            let (s, beta) = (slope(degrees, 1.0), degrees.to_radians());
            let (sin, cos) = (0.5 * beta).sin_cos();
            let (exit, entry) = (Vector2::zeros(), Vector2::new(cos / sin, 1.0));
            let radius = 1e5;
            let away = (radius * radius - 0.25 * (entry - exit).norm_squared()).sqrt();
            let centre = entry / 2.0 + away * Vector2::new(-sin, cos);
            let arc = Circle {
                centre,
                radius,
                exit,
                entry,
            };
            let culmann = 4.0 * beta.sin() / (1.0 - beta.cos());
            near(s.number(&arc), culmann, 1e-3);
            assert!(s.stability_number() < culmann);
        }
    }

    #[test]
    fn deep_circles_tend_to_their_limit_from_above() {
        let alpha = (0..100).fold(1.2_f64, |alpha, _| (2.0 * alpha).atan());
        near(DEEP, 4.0 * alpha / alpha.sin().powi(2), 1e-14);
        for degrees in [15.0, 30.0, 50.0] {
            let [near_by, deep] = [10.0, 100.0].map(|d| slope(degrees, d).on_floor(SEARCH).number);
            assert!(DEEP < deep && deep < near_by, "{near_by} {deep}");
            near(deep, DEEP, 1e-3);
        }
    }

    #[test]
    fn only_the_ratio_of_weight_and_strength_matters() {
        let (small, large) = (slope(45.0, 1.5), Slope::new(12.0, 45_f64.to_radians(), 1.5));
        let large = large.unwrap();
        let n = small.stability_number();
        near(large.stability_number(), n, 1e-9);
        near(large.critical().area, 144.0 * small.critical().area, 1e-3);
        near(
            large.factor_of_safety(30e3, 18e3).unwrap(),
            n * 30.0 / 216.0,
            1e-9,
        );
    }

    /// At c = γH/N the work of gravity is dissipated.
    #[test]
    fn at_failure_work_and_dissipation_balance() {
        for (degrees, depth_factor) in SLOPES {
            let s = Slope::new(12.0, degrees.to_radians(), depth_factor).unwrap();
            let (m, gamma) = (s.critical(), 18e3);
            let c = gamma * 12.0 / s.stability_number();
            let work = m.work(gamma);
            assert!(work > 0.0);
            near(m.dissipation(c), work, 1e-12 * work);
            near(m.factor_of_safety(c, gamma), 1.0, 1e-12);
            near(s.factor_of_safety(2.0 * c, gamma).unwrap(), 2.0, 1e-12);
        }
    }

    /// Height of the ground.
    fn ground(s: &Slope, x: f64) -> f64 {
        (x * s.angle.tan()).clamp(0.0, s.height)
    }

    /// Area and first moments of the mass above an arc, by the midpoints of vertical slices.
    fn slices(s: &Slope, circle: &Circle, count: u32) -> [f64; 3] {
        let width = (circle.entry.x - circle.exit.x) / f64::from(count);
        let mut sum = [0.0; 3];
        for i in 0..count {
            let x = circle.exit.x + (f64::from(i) + 0.5) * width;
            let below = (circle.radius.powi(2) - (x - circle.centre.x).powi(2)).sqrt();
            let (top, bottom) = (ground(s, x), circle.centre.y - below);
            let area = (top - bottom) * width;
            sum[0] += area;
            sum[1] += area * x;
            sum[2] += area * (top + bottom) / 2.0;
        }
        sum
    }

    #[test]
    fn area_and_centroid_are_the_limit_of_fine_slices() {
        for (degrees, depth_factor) in SLOPES {
            let s = slope(degrees, depth_factor);
            let m = s.critical();
            let exact = [m.area, m.area * m.centroid.x, m.area * m.centroid.y];
            let error = |count| {
                let found = slices(&s, &m.circle, count);
                let errors = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
                errors.fold(0.0, f64::max)
            };
            let size = exact.iter().copied().fold(0.0, f64::max);
            let [coarse, fine] = [error(100), error(10_000)];
            assert!(
                fine < 1e-3 * coarse && fine < 1e-6 * size,
                "{coarse} {fine}"
            );
        }
    }

    #[test]
    fn critical_arcs_lie_in_the_soil_above_the_base() {
        for (degrees, depth_factor) in SLOPES {
            let s = slope(degrees, depth_factor);
            let c = s.critical().circle;
            near((c.point(1.0) - c.entry).norm(), 0.0, 1e-12 * c.radius);
            near(c.entry.y, s.height, 1e-12);
            near(c.exit.y, ground(&s, c.exit.x), 1e-12);
            for i in 0..=1000 {
                let x = c.point(f64::from(i) / 1000.0);
                near((x - c.centre).norm(), c.radius, 1e-12 * c.radius);
                assert!(
                    x.y >= c.lowest().y - 1e-12 && x.y >= -s.depth() - 1e-9,
                    "{x}"
                );
                assert!(x.y <= ground(&s, x.x) + 1e-9, "{x}");
            }
        }
    }

    /// A circle by centre and radius, if its lower arc cuts one mass off above the base, with ends anywhere.
    fn cut(s: &Slope, centre: Vector2<f64>, radius: f64) -> Option<Circle> {
        let bottom = |x: f64| centre.y - (radius.powi(2) - (x - centre.x).powi(2)).max(0.0).sqrt();
        let at = |i: u32| centre.x + radius * (f64::from(i) / 200.0 - 1.0);
        let inside = |x: f64| bottom(x) < ground(s, x);
        let within: Vec<u32> = (0..=400).filter(|i| inside(at(*i))).collect();
        let (first, last) = (*within.first()?, *within.last()?);
        let one = (last - first) as usize + 1 == within.len();
        if !one || first == 0 || last == 400 || centre.y - radius < -s.depth() {
            return None;
        }
        let crossing = |mut dry: f64, mut wet: f64| {
            for _ in 0..50 {
                let x = 0.5 * (dry + wet);
                *(if inside(x) { &mut wet } else { &mut dry }) = x;
            }
            Vector2::new(wet, ground(s, wet))
        };
        Some(Circle {
            centre,
            radius,
            exit: crossing(at(first - 1), at(first)),
            entry: crossing(at(last + 1), at(last)),
        })
    }

    /// Every circle of a grid, those that enter on the face too, by slices.
    #[test]
    fn no_circle_of_a_scan_is_worse_than_the_critical_one() {
        for (degrees, depth_factor) in [(60.0, 1.0), (45.0, 1.0), (45.0, 1.5), (15.0, 1.2)] {
            let s = slope(degrees, depth_factor);
            let n = s.stability_number();
            let c = s.critical().circle;
            let mut least = f64::INFINITY;
            for i in 0..32_000 {
                let [a, b, d] = [i % 40, i / 40 % 40, i / 1600].map(|i| f64::from(i) + 0.5);
                let centre = Vector2::new((a / 20.0 - 1.0) * 2.0, 0.1 + b / 20.0 * c.centre.y);
                let radius = (centre.y + s.depth()) * (1.0 - (1.0 - d / 20.0).powi(2));
                let centre = centre + Vector2::new(c.centre.x, 0.0);
                if let Some(circle) = cut(&s, centre, radius) {
                    let [area, moment, _] = slices(&s, &circle, 200);
                    let work = moment - area * centre.x;
                    if work > 1e-6 {
                        let found = radius.powi(2) * circle.angle() / work;
                        least = least.min(found);
                    }
                }
            }
            assert!(least > n * (1.0 - 1e-4), "{degrees}: {least} {n}");
            assert!(least < n * 1.03, "{degrees}: {least} {n}");
        }
    }

    #[test]
    fn a_finer_search_finds_the_same() {
        let fine = Search {
            samples: 29,
            sections: 50,
        };
        for (degrees, depth_factor) in SLOPES {
            let s = slope(degrees, depth_factor);
            let found = s.number(&s.least(fine).circle);
            near(s.stability_number() / found, 1.0, 1e-9);
        }
    }

    #[test]
    fn steeper_slopes_and_deeper_bases_are_less_stable() {
        let angles = [1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];
        let depth_factors = [1.0, 1.1, 1.5, 2.0, 4.0];
        let table = angles.map(|b| depth_factors.map(|d| number(b, d)));
        for row in &table {
            assert!(row.is_sorted_by(|a, b| *b <= a * (1.0 + 1e-9)), "{row:?}");
        }
        for rows in table.windows(2) {
            let steeper = rows[0].iter().zip(&rows[1]);
            assert!(steeper.clone().all(|(flat, steep)| steep < flat));
        }
    }

    /// A slope whose circle leaves on the face is the upper part of one that goes on down to the base.
    #[test]
    fn above_the_toe_only_the_depth_of_the_base_matters() {
        for depth_factor in [1.1, 1.2, 1.3] {
            let found = number(15.0, depth_factor);
            near(found * depth_factor, number(15.0, 1.0), 1e-7);
        }
    }

    #[test]
    fn what_is_out_of_range_is_refused_by_name() {
        let refusals = [
            ("height", Slope::new(0.0, 0.5, 1.0)),
            ("height", Slope::new(f64::NAN, 0.5, 1.0)),
            ("height", Slope::new(f64::INFINITY, 0.5, 1.0)),
            ("angle", Slope::new(1.0, 0.01, 1.0)),
            ("angle", Slope::new(1.0, 1.6, 1.0)),
            ("depth_factor", Slope::new(1.0, 0.5, 0.9)),
            ("depth_factor", Slope::new(1.0, 0.5, f64::INFINITY)),
        ];
        for (name, refusal) in refusals {
            let text = refusal.unwrap_err().to_string();
            assert!(
                text.starts_with(name) && text.contains("allowed: "),
                "{text}"
            );
        }
        let s = slope(45.0, 1.0);
        for (name, [c, gamma]) in [
            ("cohesion", [0.0, 1.0]),
            ("cohesion", [f64::NAN, 1.0]),
            ("unit_weight", [1.0, -1.0]),
        ] {
            let text = s.factor_of_safety(c, gamma).unwrap_err().to_string();
            assert!(text.starts_with(name), "{text}");
        }
    }
}
