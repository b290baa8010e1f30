//! The first frequency of a free beam after Timoshenko, and the bending stiffness that cells and particles make of it.

use mpm_solvers::scheme::BasisName;

/// Half the length of the beam (m).
pub const HALF: f64 = 1.0;
/// Depth of the beam (m).
pub const DEPTH: f64 = 0.1;
/// Wave number of the mode of a slender beam (1/m): half of 4.730, its whole length being 2 m.
pub const SLENDER: f64 = 2.365;
/// Factor by which a frequency is raised until it is past the first one, and halvings then.
const FACTOR: f64 = 1.05;
const HALVINGS: usize = 100;

/// A beam of unit breadth in plane strain.
#[derive(Debug, Clone, Copy)]
pub struct Beam {
    /// E I (N m), κ G A (N), ρ A (kg/m), ρ I (kg m).
    bending: f64,
    shear: f64,
    mass: f64,
    inertia: f64,
}

/// The first symmetric mode: w = a cosh αx + b cos βx and the turn of the sections.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    /// Angular frequency (rad/s).
    pub frequency: f64,
    alpha: f64,
    beta: f64,
    /// Ω = ρ A ω²/(κ G A), and a over b.
    omega: f64,
    ratio: f64,
}

impl Beam {
    /// Beam of Young's modulus (Pa), Poisson's ratio and density (kg/m³), with its bending stiffness times `factor`.
    pub fn new(young: f64, ratio: f64, density: f64, factor: f64) -> Self {
        let plane = ratio / (1.0 - ratio);
        // Cowper's coefficient of a rectangle.
        let coefficient = 10.0 * (1.0 + plane) / (12.0 + 11.0 * plane);
        let second = DEPTH.powi(3) / 12.0;
        Self {
            bending: factor * plane_modulus(young, ratio) * second,
            shear: coefficient * DEPTH * young / (2.0 * (1.0 + ratio)),
            mass: density * DEPTH,
            inertia: density * second,
        }
    }

    /// α, β and Ω of a frequency (rad/s).
    fn waves(&self, frequency: f64) -> [f64; 3] {
        let square = frequency * frequency;
        let (stiff, slack) = (self.bending * self.shear, self.inertia * square - self.shear);
        let middle = square * (self.inertia * self.shear + self.mass * self.bending);
        let last = self.mass * square * slack;
        let root = (middle * middle - 4.0 * stiff * last).sqrt();
        let of = |sign: f64| ((root + sign * middle) / (2.0 * stiff)).max(0.0).sqrt();
        [of(-1.0), of(1.0), self.mass * square / self.shear]
    }

    /// Zero where both ends are free of moment and shear; positive below the first frequency.
    fn condition(&self, frequency: f64) -> f64 {
        let [a, b, omega] = self.waves(frequency);
        let (x, y) = (a * HALF, b * HALF);
        (a * a + omega) * y.sin() / b + (b * b - omega) * y.cos() * x.tanh() / a
    }

    /// The first mode that is symmetric about the middle.
    pub fn first(&self) -> Mode {
        let mut high = 0.1 * (self.bending / self.mass).sqrt() / (HALF * HALF);
        let mut low = 0.0;
        while self.condition(high) > 0.0 {
            (low, high) = (high, FACTOR * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.condition(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let [alpha, beta, omega] = self.waves(high);
        // No shear at the end.
        let ratio = -(beta * HALF).sin() / beta * alpha / (alpha * HALF).sinh();
        Mode { frequency: high, alpha, beta, omega, ratio }
    }
}

impl Mode {
    /// Deflection at `x` (m) from the middle.
    pub fn deflection(&self, x: f64) -> f64 {
        self.ratio * (self.alpha * x).cosh() + (self.beta * x).cos()
    }

    /// Turn of the section there (1/m).
    pub fn turn(&self, x: f64) -> f64 {
        let grown = (self.alpha + self.omega / self.alpha) * (self.alpha * x).sinh();
        self.ratio * grown + (self.omega / self.beta - self.beta) * (self.beta * x).sin()
    }
}

fn plane_modulus(young: f64, ratio: f64) -> f64 {
    young / (1.0 - ratio * ratio)
}

/// Bending stiffness over the exact one of `cells` over the depth with `per_cell` particles a direction, with GIMP a bound:
/// see `docs/thin.md`. None where it is not known.
pub fn stiffness(basis: BasisName, ratio: f64, cells: f64, per_cell: f64, shifted: bool) -> Option<f64> {
    let seen = 1.0 - 1.0 / (per_cell * per_cell);
    match basis {
        BasisName::Bspline2 | BasisName::Bspline3 => Some(1.0 - 1.0 / (cells * per_cell).powi(2)),
        BasisName::Linear | BasisName::Gimp if !shifted => {
            let shear = 0.5 / (1.0 + ratio);
            let side = (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
            let within = (side + shear) / plane_modulus(1.0, ratio) * seen;
            Some(1.0 + (within - 1.0) / (cells * cells))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slender_beam_has_eulers_frequency() {
        let beam = Beam { bending: 1.0, shear: 1e9, mass: 1.0, inertia: 1e-9 };
        let mode = beam.first();
        // βL of a free beam's first mode is 4.730041, its nodes at 0.2242 of the length from the ends.
        assert!((mode.frequency.sqrt() - 0.5 * 4.730_041).abs() < 1e-5);
        let node = HALF * (1.0 - 2.0 * 0.224_2);
        assert!(mode.deflection(node).abs() < 1e-3);
    }

    #[test]
    fn shear_and_rotation_slow_a_beam_by_what_the_expansion_says() {
        // First order in I/(A L²), with c₁ = 49.5 of a free beam: Goens.
        let beam = Beam::new(1e6, 0.0, 1000.0, 1.0);
        let slender = Beam { shear: 1e9 * beam.shear, inertia: 1e-9 * beam.inertia, ..beam };
        let slower = beam.first().frequency / slender.first().frequency;
        assert!((0.97..0.995).contains(&slower), "{slower}");
    }

    #[test]
    fn no_momentum_and_no_moment_at_the_end() {
        let mode = Beam::new(1e6, 0.3, 1000.0, 1.0).first();
        let n = 10_000;
        let place = |k: usize| (k as f64 + 0.5) / f64::from(n) * HALF;
        let sum: f64 = (0..n as usize).map(|k| mode.deflection(place(k))).sum();
        assert!((sum / f64::from(n)).abs() < 1e-6);
        let slope = (mode.turn(HALF) - mode.turn(HALF - 1e-6)) / 1e-6;
        assert!(slope.abs() < 1e-4, "{slope}");
    }
}
