//! Metrics of a motion that is known in closed form.

use crate::metric::{Quantity, error, metrics};
use crate::results::{Column, headline};

metrics! { pub(in crate::cases) METRICS:
    DISPLACEMENT_L2 = "displacement_l2", "m", "rms over the particles of |u − exact u| at the end";
    DISPLACEMENT_LINF = "displacement_linf", "m", "largest |u − exact u| at the end";
    VELOCITY_L2 = "velocity_l2", "m/s", "rms of |v − exact v| at the end; explicit: half a step before it, where velocities live";
    VELOCITY_LINF = "velocity_linf", "m/s", "largest such error";
    STRESS_L2 = "stress_l2", "Pa", "rms of the Frobenius norm of the error of the Cauchy stress, as it enters the forces";
    STRESS_LINF = "stress_linf", "Pa", "largest such error";
    MEAN_STRESS_L2 = "mean_stress_l2", "Pa", "rms error of the mean normal stress; of an isochoric motion, the spurious pressure";
    MEAN_STRESS_LINF = "mean_stress_linf", "Pa", "largest such error";
    DISPLACEMENT_SCALE = "displacement_scale", "m", "largest rms over the particles of the exact u since the start";
    DISPLACEMENT_RATIO = "displacement_ratio", "-", "projection of the displacement on the exact one, over it";
    VELOCITY_RATIO = "velocity_ratio", "-", "projection of the velocity on the exact one, over it";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic + stored energy − work of the loads over its start, relative to the largest kinetic energy";
    ENERGY_LOSS = "energy_loss", "-", "largest fall of that energy below its start, relative to the largest kinetic energy";
    ENERGY_END = "energy_end", "-", "rise of that energy at the end over its start, relative to the largest kinetic energy";
    LUMPING_LOSS = "lumping_loss", "-", "midpoint: energy that the lumped share of the mass took, relative to the largest kinetic energy";
    KINETIC_ENERGY_PEAK = "kinetic_energy_peak", "J", "largest kinetic energy";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at the end";
    MASS = "mass", "kg", "mass of the particles, per metre in plane strain and per square metre in uniaxial strain";
    BODY_MASS = "body_mass", "kg", "ρ₀ times the volume of the body, per metre in plane strain and per square metre in uniaxial strain";
    DAMPING = "damping", "-", "−ln amplitude_ratio";
    FREQUENCY_RATIO = "frequency_ratio", "-", "frequency of the standing wave, from the zeros of its displacement, over the exact one";
    FREQUENCY_ERROR = "frequency_error", "-", "|frequency_ratio − 1|";
    AMPLITUDE_RATIO = "amplitude_ratio", "-", "largest displacement in the shape of the wave in the last period, over that in the first";
    J_DRIFT_PER_1E5_STEPS = "j_drift_per_1e5_steps", "-", "largest change of a cell's mean J̄ (J without a remedy) per 10⁵ steps";
    TRUE_J_DRIFT_PER_1E5_STEPS = "true_j_drift_per_1e5_steps", "-", "largest change of a cell's mean J per 10⁵ steps";
    KINETIC_GROWTH = "kinetic_growth", "-", "largest kinetic energy in the last third of the run over that in the middle third";
    BASE_PRESSURE = "base_pressure", "Pa", "pressure at the floor, by a straight line through the lower half";
}

pub(super) fn headlines() -> Vec<Column> {
    vec![
        headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 8),
        headline(VELOCITY_L2, "v rms error (m/s)", 1.0, 6),
        headline(STRESS_L2, "σ rms error (Pa)", 1.0, 2),
        headline(MEAN_STRESS_L2, "σ_m rms error (Pa)", 1.0, 2),
        headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5),
        headline(ENERGY_LOSS, "energy loss (–)", 1.0, 5),
        headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 6),
    ]
}

/// The errors whose convergence is studied.
pub(super) const ERRORS: &[Quantity] = &[
    error(DISPLACEMENT_L2, "rms error of u (m)").of_order(2.0),
    error(DISPLACEMENT_LINF, "largest error of u (m)").of_order(2.0),
    error(VELOCITY_L2, "rms error of v (m/s)").of_order(2.0),
    error(STRESS_L2, "rms error of σ (Pa)").of_order(1.0),
    error(MEAN_STRESS_L2, "rms error of σ_m (Pa)").of_order(1.0),
];
