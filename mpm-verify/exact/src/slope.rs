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
//! The toe may be cut away by a vertical face of height d, [`Slope::cut`], where the base is at its foot, D = 1: the ground
//! is then (d cot β, 0), (d cot β, d), (H cot β, H), crest.
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

mod sliding;
pub mod spiral;

pub use sliding::Sliding;

use crate::Error;
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
    cut: f64,
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
        if self.exit.x < self.centre.x { self.centre - Vector2::new(0.0, self.radius) } else { self.exit }
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
        Ok(Self { height, angle, depth_factor, cut: 0.0 })
    }

    /// The slope whose toe a vertical face of height d (m) cuts away.
    ///
    /// # Errors
    /// A height beyond 0 to H; a base below the toe.
    pub fn cut(self, height: f64) -> Result<Self, Error> {
        within(["cut", "m"], height, [0.0, self.height])?;
        within(["depth_factor of a cut slope", "-"], self.depth_factor, [1.0; 2])?;
        Ok(Self { cut: height, ..self })
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
        Mechanism { circle, area, centroid: circle.centre + Vector2::new(x, y) / area }
    }

    /// Edges of the polygon on the chord, counterclockwise: the chord, then back along the ground.
    fn polygon(&self, circle: &Circle) -> [[Vector2<f64>; 2]; 5] {
        let exit = circle.exit;
        let [toe, top_of_cut, edge] = [self.on_ground(0.0), self.on_ground(self.cut), self.edge()];
        let on_floor = exit.x < toe.x;
        let last = if on_floor { toe } else { exit };
        let next = if on_floor || exit.y < self.cut { top_of_cut } else { exit };
        [[exit, circle.entry], [circle.entry, edge], [edge, next], [next, last], [last, exit]]
    }

    /// The point of the face at a height (m).
    fn on_ground(&self, height: f64) -> Vector2<f64> {
        Vector2::new(height.max(self.cut) * self.run() / self.height, height)
    }

    /// Where the crest begins (m).
    fn edge(&self) -> Vector2<f64> {
        Vector2::new(self.run(), self.height)
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
        let best = if floor.number < face.number { floor } else { face };
        self.mechanism(best.circle)
    }

    /// The best circle that leaves on the face or at the toe.
    fn on_face(&self, search: Search) -> Candidate {
        search.least([0.0, self.height], |height| {
            let rise = self.edge() - self.on_ground(height);
            let steepest = if height < self.cut { rise.y.atan2(rise.x) } else { self.angle };
            search.least([0.0, steepest], |inclination| self.on_chord(search, height, inclination))
        })
    }

    /// The best circle through the face at a height whose chord is inclined by ω.
    fn on_chord(&self, search: Search, height: f64, inclination: f64) -> Candidate {
        let (sin, cos) = inclination.sin_cos();
        let chord = (self.height - height) / sin;
        let direction = Vector2::new(cos, sin);
        let exit = self.on_ground(height);
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
            search.least([0.0, 1.0 / least], |tangent| self.candidate(self.midpoint(p * self.height, 1.0 / tangent)))
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
        Candidate { number: if number > 0.0 { number } else { f64::INFINITY }, circle }
    }
}

/// Area of the segment between chord and arc, and its first moments about the centre.
fn segment(circle: &Circle) -> [f64; 3] {
    let theta = circle.angle();
    let chord = circle.entry - circle.exit;
    let moment = chord.norm_squared() / 12.0;
    [0.5 * circle.radius.powi(2) * (theta - theta.sin()), moment * chord.y, -moment * chord.x]
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

/// A mechanism of a family.
trait Ranked: Copy {
    /// Quantity that is least for the best mechanism.
    fn number(&self) -> f64;
}

impl Ranked for Candidate {
    fn number(&self) -> f64 {
        self.number
    }
}

/// How finely each parameter is searched.
#[derive(Debug, Clone, Copy)]
struct Search {
    /// Intervals between the samples of the whole range.
    samples: u32,
    /// Golden sections after that.
    sections: u32,
}

const SEARCH: Search = Search { samples: 16, sections: 40 };

/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Search {
    /// The best of a one-parameter family, the ends of its range among them.
    fn least<C: Ranked>(self, [from, to]: [f64; 2], family: impl Fn(f64) -> C) -> C {
        let step = (to - from) / f64::from(self.samples);
        let at = |i: u32| from + f64::from(i) * step;
        let (mut best, mut place) = (family(to), self.samples);
        for i in 0..self.samples {
            let candidate = family(at(i));
            if candidate.number() < best.number() {
                (best, place) = (candidate, i);
            }
        }
        let bracket = [at(place.saturating_sub(1)), at((place + 1).min(self.samples))];
        better(best, self.sections(bracket, family))
    }

    /// Golden sections of a bracket.
    fn sections<C: Ranked>(self, [mut a, mut b]: [f64; 2], family: impl Fn(f64) -> C) -> C {
        let low = |a: f64, b: f64| b - GOLDEN * (b - a);
        let high = |a: f64, b: f64| a + GOLDEN * (b - a);
        let (mut left, mut right) = (family(low(a, b)), family(high(a, b)));
        for _ in 0..self.sections {
            if left.number() < right.number() {
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

fn better<C: Ranked>(a: C, b: C) -> C {
    if b.number() < a.number() { b } else { a }
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
    Error(format!("{name}: {value} is out of range; allowed: {allowed} ({unit})"))
}

#[cfg(test)]
mod tests;
