//! Quantities that every run monitors.

use crate::particles::Particles;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Work done and energy moved since the start (J; per metre of depth in plane strain).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Accumulated {
    /// Stress work Σ V σ : ∇v Δt.
    pub stress_work: f64,
    /// Work of the loads on the particles, Σ f·v Δt.
    pub load_work: f64,
    /// Energy taken by force filters (damping).
    pub damping: f64,
    /// Energy removed by constraints: the kinetic energy that was mapped to the held nodes, less what
    /// the constraint puts in by moving against the forces there. In it is what contact between bodies removes.
    pub constraint_loss: f64,
    /// Kinetic energy removed by particle filters (kinetic damping).
    pub filter_loss: f64,
    /// Kinetic energy that the particles do not take from nodes with a lumped mass, ½ Δvᵀ (M_β − M_c) Δv of the
    /// midpoint rule.
    pub lumping_loss: f64,
}

/// The state of the last step on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Residual {
    /// Σ|f_i| over the components that no constraint holds, damping included (N).
    pub free_force: f64,
    /// Σ f_i over the components that constraints hold, before they act: minus the reaction (N).
    pub held_force: [f64; 3],
    /// Kinetic energy of the nodes after the update (J): without the particles' null space.
    pub kinetic_energy: f64,
}

/// How Newton's method came to the end of a step.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Convergence {
    /// The residual before every iteration and at the end, over that of the loads.
    pub residuals: Vec<f64>,
    /// The paper's out-of-balance force ratio, Eq. (37): ‖F_ext − F_int‖ / ‖F_ext‖ over all free components.
    pub force_ratio: f64,
    /// Share of that which rounding of the stresses may leave: the lower limit of what is asked for.
    pub force_rounding: f64,
    /// The analogue of the paper's energy ratio, Eq. (38), where nothing moves: the residual's work on the last
    /// correction over that of the external force on the increment.
    pub energy_ratio: f64,
    /// Parts that the load step was cut into; 1 if it was not.
    pub parts: u32,
}

/// The water of a body since time zero.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct WaterBalance {
    /// Volume that left (m³; m² in plane strain, m in 1D).
    pub outflow: f64,
    /// Volume that sources within the body gave (m³; m² in plane strain, m in 1D).
    pub inflow: f64,
    /// Change of the body's volume and outflow together, less inflow (m³): what the scheme creates.
    pub imbalance: f64,
}

/// Reaction of a part of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Reaction {
    /// Force (N) in the last step: on a constraint the nodal forces at the components that it holds.
    pub force: [f64; 3],
    /// Momentum (N s) that the part took since time zero. Beside the forces it has, on a constraint, what the particles
    /// brought to the held nodes.
    pub impulse: [f64; 3],
}

impl Reaction {
    /// Reaction of a part that does not exist.
    pub const NONE: Self = Self { force: [f64::NAN; 3], impulse: [f64::NAN; 3] };
}

/// Sums over particles. The potential energy of the loads is −`accumulated.load_work` where they are
/// conservative.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Mass (kg).
    pub mass: f64,
    /// Linear momentum (kg m/s).
    pub momentum: [f64; 3],
    /// Kinetic energy of the particles (J).
    pub kinetic_energy: f64,
    /// Stored energy Σ V⁰ W(F̄) (J). With F̄ it differs from the stress work: see `docs/method.md`.
    pub stored_energy: f64,
    /// Work and losses so far.
    pub accumulated: Accumulated,
    /// Least and greatest J.
    pub jacobian: (f64, f64),
    /// Root mean square of ln(J/J̄) (0 without a remedy): how far the averaged Jacobian has parted
    /// from the true one.
    pub log_jacobian_gap_rms: f64,
    /// Greatest |ln(J/J̄)|.
    pub log_jacobian_gap_max: f64,
}

impl Totals {
    /// The sums over `particles` in a range, in their order, with the stored energy of each per reference volume (J/m³).
    #[must_use]
    pub fn of<const D: usize>(particles: &Particles<D>, range: Range<usize>, energy: impl Fn(usize) -> f64) -> Self {
        let mut t = Self {
            kinetic_energy: particles.kinetic_energy_of(range.clone()),
            jacobian: (f64::INFINITY, f64::NEG_INFINITY),
            ..Self::default()
        };
        for p in range.clone() {
            let m = particles.mass[p];
            t.mass += m;
            if let Some(velocity) = particles.velocity.get(p) {
                for (sum, v) in t.momentum.iter_mut().zip(velocity) {
                    *sum += m * v;
                }
            }
            t.stored_energy += particles.reference_volume[p] * energy(p);
            let j = particles.jacobian[p];
            t.jacobian = (t.jacobian.0.min(j), t.jacobian.1.max(j));
        }
        let (mut squares, count) = (0.0, range.len());
        let averaged = particles.j_bar.get(range.clone()).unwrap_or_default();
        for (j, j_bar) in particles.jacobian[range].iter().zip(averaged) {
            let gap = (j / j_bar).ln();
            squares += gap * gap;
            t.log_jacobian_gap_max = t.log_jacobian_gap_max.max(gap.abs());
        }
        t.log_jacobian_gap_rms = (squares / count.max(1) as f64).sqrt();
        t
    }
}
