//! The exact column: uniaxial strain of a Hencky body under its own weight.

/// Intervals of the integrals.
const INTERVALS: usize = 2000;
/// Halvings of a bracket.
const HALVINGS: usize = 80;

/// A Hencky body in uniaxial strain: Kirchhoff's stress along it is M v up to the logarithmic strain of yield, and with J2
/// plasticity it rises by K beyond, as √(3/2) κ of it stays.
#[derive(Clone, Copy)]
pub struct Body {
    /// Logarithmic strain of yield; infinite of an elastic body.
    pub yields: f64,
    /// K/M.
    pub bulk: f64,
}

impl Body {
    /// The nominal stress over M at a stretch.
    fn stress(&self, stretch: f64) -> f64 {
        let v = stretch.ln();
        let elastic = v.clamp(-self.yields, self.yields);
        (elastic + self.bulk * (v - elastic)) / stretch
    }

    /// The stretch at which the nominal stress, over the modulus M, is `stress`: the one from which a greater stress takes on
    /// to a greater stretch, below e. None of a body beyond 1/e. A body that yields is pressed.
    pub fn stretch(&self, stress: f64) -> Option<f64> {
        let e = std::f64::consts::E;
        if stress > 1.0 / e {
            return None;
        }
        // ln λ/λ rises up to e.
        let (mut lo, mut hi) = (1e-3, e);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (lo + hi);
            if self.stress(middle) < stress {
                lo = middle;
            } else {
                hi = middle;
            }
        }
        Some(0.5 * (lo + hi))
    }
}

/// A column whose nominal stress over M grows from zero at its free end to `end` at the other, along its height of one.
pub struct Column {
    /// Displacements away from the held end, from the free end on.
    displacement: Vec<f64>,
    /// The greatest |dλ/dX|.
    pub curvature: f64,
}

impl Column {
    /// None if there is no equilibrium.
    pub fn new(of: Body, end: f64) -> Option<Self> {
        let step = 1.0 / INTERVALS as f64;
        let stretches: Option<Vec<f64>> = (0..=INTERVALS).map(|k| of.stretch(end * k as f64 * step)).collect();
        let stretches = stretches?;
        let mut displacement = vec![0.0; INTERVALS + 1];
        for k in (0..INTERVALS).rev() {
            let strain = 0.5 * (stretches[k] + stretches[k + 1]) - 1.0;
            displacement[k] = displacement[k + 1] + strain * step;
        }
        let slopes = stretches.windows(2).map(|pair| (pair[1] - pair[0]).abs() / step);
        Some(Self { curvature: slopes.fold(0.0, f64::max), displacement })
    }

    /// Displacement at a distance from the free end, away from the held one, over the height.
    pub fn at(&self, x: f64) -> f64 {
        let place = x.clamp(0.0, 1.0) * INTERVALS as f64;
        let k = (place as usize).min(INTERVALS - 1);
        let share = place - k as f64;
        (1.0 - share) * self.displacement[k] + share * self.displacement[k + 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ELASTIC: Body = Body { yields: f64::INFINITY, bulk: 0.6 };

    #[test]
    fn a_stretch_bears_its_stress_and_there_is_a_greatest() {
        for s in [-1.0, -0.1, 0.0, 0.2, 0.36] {
            let l = ELASTIC.stretch(s).unwrap();
            assert!((l.ln() / l - s).abs() < 1e-12 && l < std::f64::consts::E, "{s} {l}");
        }
        assert!(ELASTIC.stretch(0.368).is_none());
    }

    #[test]
    fn a_light_column_is_that_of_linear_theory() {
        let column = Column::new(ELASTIC, 1e-6).unwrap();
        for x in [0.0_f64, 0.3, 1.0] {
            let linear = 0.5e-6 * (1.0 - x * x);
            assert!((column.at(x) - linear).abs() < 1e-11, "{x}");
        }
    }

    #[test]
    fn a_body_that_yields_bears_the_rest_by_its_bulk_modulus() {
        let body = Body { yields: 0.1, bulk: 0.6 };
        let (weak, strong) = (body.stretch(-0.05).unwrap(), body.stretch(-0.3).unwrap());
        assert_eq!(Some(weak), ELASTIC.stretch(-0.05));
        assert!((0.1 + 0.6 * (-strong.ln() - 0.1) - 0.3 * strong).abs() < 1e-12);
    }
}
