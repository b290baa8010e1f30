//! The load over the penetration and the motion of the surface, and what is measured of them, whoever computed them.

use super::*;

/// The part of the surface (m from the axis) that is well inside of what Prandtl's mechanism pushes up.
const BESIDE: (f64, f64) = (0.75 * WIDTH, 1.25 * WIDTH);
/// The last share of the penetration, over which the plateau and the mechanism are observed.
const PLATEAU: f64 = 0.25;
/// Half of the window of penetration over B in which the curve is averaged.
pub(super) const WINDOW: f64 = 5e-5;

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Load {
    /// Penetration over B; through a barrier, less how much that gives way in the mean.
    pub(super) penetration: f64,
    /// Force of the ground on the footing per metre of depth, upward (N/m).
    pub(super) force: f64,
    /// Force of the ground on its base, downward (N/m).
    pub(super) base: f64,
}

/// Pressure over the undrained strength (Pa) of a force (N/m) on half of a footing of `width` (m).
pub(super) fn bearing_factor(force: f64, width: f64, strength: f64) -> f64 {
    force / (0.5 * width) / strength
}

/// Distance (m) from the axis of a footing of [`WIDTH`] to which the ground rises at the limit load: Prandtl's mechanism under
/// a rough one, Hill's, half as large, under a smooth one.
pub(super) fn mechanism_extent(rough: bool) -> f64 {
    WIDTH * if rough { 1.5 } else { 1.0 }
}

/// Penetration over B from which on the plateau of a run to `end` is observed.
pub(super) fn plateau(end: f64) -> f64 {
    // A row at its beginning is on it, however that is rounded.
    (1.0 - PLATEAU - 1e-9) * end
}

/// The load of a footing on ground of a strength.
pub(super) struct LoadCurve<'a> {
    pub(super) rows: &'a [Load],
    /// Undrained strength (Pa).
    pub(super) strength: f64,
    /// Penetration over B at the end, and at the end of the start.
    pub(super) end: f64,
    pub(super) begun: f64,
    /// Cell size, and the width that the footing acts with (m).
    pub(super) h: f64,
    pub(super) effective: f64,
    /// Half of the window of penetration over B in which the load on the way is averaged.
    pub(super) window: f64,
}

impl LoadCurve<'_> {
    fn factor(&self, force: f64, width: f64) -> f64 {
        bearing_factor(force, width, self.strength)
    }

    /// Mean of a quantity of the rows of which `keep` holds; NaN if there are none.
    fn mean(&self, keep: impl Fn(&Load) -> bool, f: impl Fn(&Load) -> f64) -> f64 {
        mean(self.rows.iter().filter(|r| keep(r)).map(f))
    }

    fn on_plateau(&self, row: &Load) -> bool {
        row.penetration > plateau(self.end)
    }

    /// Relative growth of the load per 10⁻³ of penetration over B on the plateau.
    fn rise(&self, mean_force: f64) -> f64 {
        let on_plateau = self.rows.iter().filter(|r| self.on_plateau(r));
        let points: Vec<(f64, f64)> = on_plateau.map(|r| (r.penetration, r.force / mean_force)).collect();
        fit_line(&points).map_or(f64::NAN, |line| 1e-3 * line.slope)
    }

    /// d(q/s_u)/d(s/B), fitted after the start over all rows.
    fn slope(&self) -> f64 {
        let begun = 2.0 * self.begun;
        let points: Vec<(f64, f64)> = (self.rows.iter())
            .filter(|r| r.penetration > begun)
            .map(|r| (r.penetration, self.factor(r.force, WIDTH)))
            .collect();
        fit_line(&points).map_or(f64::NAN, |line| line.slope)
    }

    pub(super) fn metrics(&self) -> Vec<(Metric, f64)> {
        let force = self.mean(|r| self.on_plateau(r), |r| r.force);
        let most = self.rows.iter().map(|r| r.force).fold(0.0, f64::max);
        let by_width = self.factor(force, WIDTH);
        let mut values = vec![
            (NC_B, by_width),
            (NC_B_PLUS_H, self.factor(force, WIDTH + self.h)),
            (NC_EFFECTIVE, self.factor(force, self.effective)),
            (PRANDTL_ERROR, by_width / EXACT - 1.0),
            (NC_PEAK, self.factor(most, WIDTH)),
            (PLATEAU_RISE, self.rise(force)),
            (ELASTIC_SLOPE, self.slope()),
        ];
        for &(metric, penetration) in CURVE {
            let near = |r: &Load| (r.penetration - penetration).abs() <= self.window;
            let reached = penetration + self.window <= self.end * (1.0 + 1e-9);
            let force = if reached { self.mean(near, |r| r.force) } else { f64::NAN };
            values.push((metric, self.factor(force, WIDTH)));
        }
        values
    }

    /// Force on the base over that on the footing, less one.
    pub(super) fn imbalance(&self) -> f64 {
        let [force, base] = [|r: &Load| r.force, |r: &Load| r.base].map(|of| self.mean(|r| self.on_plateau(r), of));
        base / force - 1.0
    }
}

/// Places (m) from the axis and rises (m) over the plateau of the particles at the surface, from the axis outward.
pub(super) struct Surface(Vec<(f64, f64)>);

impl Surface {
    /// Surface of particles that start at `reference` (m), `spacing` (m) apart, and move by `flow` (m).
    pub(super) fn new(reference: &[[f64; 2]], flow: &[[f64; 2]], spacing: f64) -> Self {
        let on_surface = |x: &[f64; 2]| x[1] > -0.75 * spacing;
        let mut surface: Vec<(f64, f64)> =
            (reference.iter().zip(flow)).filter(|(x, _)| on_surface(x)).map(|(x, u)| (x[0], u[1])).collect();
        surface.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self(surface)
    }

    /// How far (m) it sinks at the axis.
    fn sinking(&self) -> f64 {
        self.0.first().map_or(f64::NAN, |(_, rise)| -rise)
    }

    /// Half the width (in B) of the ground that rises while the footing sinks over the plateau: the outermost
    /// place where the surface rises by half of what it does in the mechanism of the limit load.
    fn mechanism_width(&self, rough: bool) -> f64 {
        // The ground does not change its volume: as much rises beside the footing as sinks under it.
        let beside = mechanism_extent(rough) - 0.5 * WIDTH;
        let half = 0.5 * self.sinking() * 0.5 * WIDTH / beside;
        (self.0.windows(2).rev()).find(|pair| pair[0].1 >= half && pair[1].1 < half).map_or(f64::NAN, |pair| {
            let share = (pair[0].1 - half) / (pair[0].1 - pair[1].1);
            (pair[0].0 + share * (pair[1].0 - pair[0].0)) / WIDTH
        })
    }

    /// Mean rise within [`BESIDE`] over what the footing sinks.
    fn heave(&self) -> f64 {
        let beside = (self.0.iter()).filter(|(x, _)| (BESIDE.0..BESIDE.1).contains(x));
        mean(beside.map(|(_, rise)| *rise)) / self.sinking()
    }

    pub(super) fn metrics(&self, rough: bool) -> Vec<(Metric, f64)> {
        vec![(MECHANISM_WIDTH, self.mechanism_width(rough)), (HEAVE, self.heave())]
    }
}
