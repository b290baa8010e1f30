//! The references: hydrostatics, bounds of energy and speed, and an inviscid solution of the front.

use serde::Deserialize;
use std::sync::OnceLock;

const SOLUTION: &str = include_str!("../references/dam-break.json");

/// Acceleration of gravity g (m/s²).
pub const GRAVITY: f64 = 9.81;
/// Depth H (m) of the reservoir.
pub const DEPTH: f64 = 2.0;
/// Length (m) of the reservoir.
pub const LENGTH: f64 = 4.0;
/// Length (m) of the tank.
pub const TANK: f64 = 6.0;

/// Times t√(g/H) over which the front is held against the inviscid one: before them it has moved by less than 0.07 H,
/// after them the tank's end is near.
pub const COMPARED: (f64, f64) = (0.2, 0.9);

#[derive(Debug, Deserialize)]
struct Solution {
    method: String,
    uncertainty: f64,
    time: Vec<f64>,
    front: Vec<f64>,
    speed: Vec<f64>,
}

fn solution() -> &'static Solution {
    static SOLUTION_READ: OnceLock<Solution> = OnceLock::new();
    SOLUTION_READ.get_or_init(|| {
        serde_json::from_str(SOLUTION).unwrap_or_else(|_| Solution {
            method: String::new(),
            uncertainty: f64::NAN,
            time: Vec::new(),
            front: Vec::new(),
            speed: Vec::new(),
        })
    })
}

/// The references in words.
#[must_use]
pub fn describe() -> Vec<String> {
    let s = solution();
    vec![
        "Hydrostatics: base pressure ρ g H, force on the gate ½ ρ g H² per metre, weight of the water.".to_owned(),
        format!("{} Uncertainty of x/H: ± {}.", s.method, s.uncertainty),
        "Bounds: the front is slower than 2 √(g H) (Ritter 1892); energy is never gained; at rest in the tank the water has lost one third of its energy.".to_owned(),
    ]
}

/// The time H/√(gH) (s).
pub fn time_scale() -> f64 {
    (DEPTH / GRAVITY).sqrt()
}

/// Twice the speed (m/s) of long waves: that of Ritter's front.
pub fn greatest_speed() -> f64 {
    2.0 * (GRAVITY * DEPTH).sqrt()
}

/// Energy (J/m, about the floor) of water of a density at the start, and of the same at rest in the tank.
pub fn energies(density: f64) -> (f64, f64) {
    let weight = density * GRAVITY * LENGTH * DEPTH;
    (0.5 * weight * DEPTH, 0.5 * weight * DEPTH * LENGTH / TANK)
}

/// Elastic energy (J/m) of water at rest behind the gate: p²/(2K) summed over it.
pub fn elastic_energy(density: f64, bulk_modulus: f64) -> f64 {
    let base = density * GRAVITY * DEPTH;
    base * base / (6.0 * bulk_modulus) * LENGTH * DEPTH
}

/// Uncertainty (m) of [`front`].
pub fn uncertainty() -> f64 {
    DEPTH * solution().uncertainty
}

/// Place (m) of the inviscid front at `time` (s); `None` outside of the solution's times.
pub fn front(time: f64) -> Option<f64> {
    let s = solution();
    let advance = interpolate(&s.time, &s.front, time / time_scale())?;
    Some(LENGTH + DEPTH * advance)
}

/// When (s) the inviscid front passes `x` (m), and its speed (m/s) then.
pub fn passage(x: f64) -> Option<(f64, f64)> {
    let s = solution();
    let time = interpolate(&s.front, &s.time, (x - LENGTH) / DEPTH)?;
    let speed = interpolate(&s.time, &s.speed, time)?;
    Some((time * time_scale(), speed * (GRAVITY * DEPTH).sqrt()))
}

/// The straight line between the two nearest of increasing `xs`.
fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> Option<f64> {
    let above = xs.iter().position(|&known| known >= x)?;
    let below = above.checked_sub(1)?;
    let share = (x - xs[below]) / (xs[above] - xs[below]);
    Some(ys[below] + share * (ys[above] - ys[below]))
}

/// The inviscid front as points t (s), x (m).
pub fn front_curve() -> Vec<(f64, f64)> {
    let s = solution();
    let columns = s.time.iter().zip(&s.front);
    columns.map(|(t, x)| (t * time_scale(), LENGTH + DEPTH * x)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_accelerates_and_stays_below_ritters() {
        let s = solution();
        assert_eq!((s.time.len(), s.front.len(), s.speed.len()), (24, 24, 24));
        // The speed of the table is the slope of its front, within the uncertainty at either end.
        for k in 1..24 {
            let step = s.time[k] - s.time[k - 1];
            let slope = (s.front[k] - s.front[k - 1]) / step;
            let mean = 0.5 * (s.speed[k] + s.speed[k - 1]);
            assert!((slope - mean).abs() < 2.0 * s.uncertainty / step, "{k}");
        }
        assert!(s.speed.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(s.speed[23] * (GRAVITY * DEPTH).sqrt() < greatest_speed());
    }

    #[test]
    fn the_front_reaches_the_wall_when_the_text_says() {
        // 0.4655 s ± 0.001 s from the same solution, by its own interpolation.
        let (time, speed) = passage(TANK).unwrap();
        assert!((time - 0.4655).abs() < 1e-3, "{time}");
        assert!((front(time).unwrap() - TANK).abs() < 1e-9);
        // The table has 1.478 and 1.511 √(g H) about it.
        let tabulated = [1.478, 1.511].map(|u| u * (GRAVITY * DEPTH).sqrt());
        assert!((tabulated[0]..tabulated[1]).contains(&speed), "{speed}");
        assert_eq!((passage(3.0), front(10.0)), (None, None));
    }

    #[test]
    fn energies_are_those_of_blocks_of_water() {
        let (start, rest) = energies(997.5);
        assert!((start - 78_283.8).abs() < 0.1 && (start - rest - 26_094.6).abs() < 0.1);
        // The mean of p² over the depth is a third of that at the floor.
        assert!((elastic_energy(997.5, 2e9) - 0.255_35).abs() < 1e-5);
    }
}
