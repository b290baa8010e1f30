//! The section of the slope, and the particles in it.

use crate::cases::prelude::*;

/// Gravity (m/s²).
pub(in crate::cases) const GRAVITY: f64 = 9.81;

/// A slope with a level crest on a firm base; the toe is at (`crest` + `run`, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cases) struct Section {
    /// Height H (m).
    pub(in crate::cases) height: f64,
    /// Length of the crest (m), from the roller at x = 0.
    pub(in crate::cases) crest: f64,
    /// Horizontal extent of the face (m).
    pub(in crate::cases) run: f64,
}

impl Section {
    /// Coordinate of the toe (m).
    pub(in crate::cases) fn toe(&self) -> f64 {
        self.crest + self.run
    }

    /// Corners (m), counterclockwise from the origin.
    pub(in crate::cases) fn corners(&self) -> [[f64; 2]; 4] {
        [[0.0, 0.0], [self.toe(), 0.0], [self.crest, self.height], [0.0, self.height]]
    }

    /// Centres (m) of the particles, `spacing` (m) apart: columns from x = 0, each from the base up.
    pub(in crate::cases) fn seed(&self, spacing: f64) -> Vec<[f64; 2]> {
        let counts = [self.toe(), self.height].map(|length| (length / spacing).round() as usize);
        /// Share of the height that rounding may amount to.
        const ROUNDING: f64 = 1e-9;
        // Not on the face.
        let is_inside = |[x, y]: &[f64; 2]| *x < self.toe() - self.run * y / self.height - ROUNDING * self.height;
        by_columns(counts, spacing).filter(is_inside).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_section_has_the_papers_particles() {
        let section = Section { height: 5.0, crest: 10.0, run: 5.0 };
        // 50 of them across make 311,250.
        assert_eq!(section.seed(0.1).len(), 6225);
        let area = section.seed(0.025).len() as f64 * 0.025 * 0.025;
        assert!((area - 62.5).abs() < 0.1);
    }
}
