//! What is measured of a motion that is known in closed form.

use crate::metric::{Headline, Metric, Quantity, error, headline, metric};

pub(in crate::cases) const DISPLACEMENT_L2: Metric = metric(
    "displacement_l2",
    "m",
    "rms over the particles of |u − exact u| at the end",
);
pub(in crate::cases) const DISPLACEMENT_LINF: Metric =
    metric("displacement_linf", "m", "largest |u − exact u| at the end");
pub(in crate::cases) const VELOCITY_L2: Metric = metric(
    "velocity_l2",
    "m/s",
    "rms of |v − exact v| half a step before the end, where velocities live",
);
pub(in crate::cases) const VELOCITY_LINF: Metric =
    metric("velocity_linf", "m/s", "largest such error");
pub(in crate::cases) const STRESS_L2: Metric = metric(
    "stress_l2",
    "Pa",
    "rms of the Frobenius norm of the error of the Cauchy stress, as it enters the forces",
);
pub(in crate::cases) const STRESS_LINF: Metric = metric("stress_linf", "Pa", "largest such error");
pub(in crate::cases) const MEAN_STRESS_L2: Metric = metric(
    "mean_stress_l2",
    "Pa",
    "rms error of the mean normal stress; of an isochoric motion, the spurious pressure",
);
pub(in crate::cases) const MEAN_STRESS_LINF: Metric =
    metric("mean_stress_linf", "Pa", "largest such error");
pub(in crate::cases) const DISPLACEMENT_SCALE: Metric = metric(
    "displacement_scale",
    "m",
    "largest rms over the particles of the exact u since the start",
);
pub(in crate::cases) const DISPLACEMENT_RATIO: Metric = metric(
    "displacement_ratio",
    "-",
    "projection of the displacement on the exact one, over it",
);
pub(in crate::cases) const VELOCITY_RATIO: Metric =
    metric("velocity_ratio", "-", "likewise of the velocity");
pub(in crate::cases) const ENERGY_GAIN: Metric = metric(
    "energy_gain",
    "-",
    "largest rise of kinetic + stored energy − work of the loads over its start, relative to the largest kinetic energy",
);
pub(in crate::cases) const ENERGY_LOSS: Metric =
    metric("energy_loss", "-", "largest fall, likewise");
pub(in crate::cases) const ENERGY_END: Metric =
    metric("energy_end", "-", "rise at the end, likewise");
pub(in crate::cases) const KINETIC_ENERGY_PEAK: Metric =
    metric("kinetic_energy_peak", "J", "largest kinetic energy");
pub(in crate::cases) const LOG_JACOBIAN_GAP: Metric =
    metric("log_jacobian_gap", "-", "rms ln(J/J̄) at the end");
pub(in crate::cases) const MASS: Metric = metric(
    "mass",
    "kg",
    "mass of the particles, per metre in plane strain and per square metre in uniaxial strain",
);
pub(in crate::cases) const BODY_MASS: Metric = metric(
    "body_mass",
    "kg",
    "ρ₀ times the volume of the body, likewise",
);
pub(in crate::cases) const DAMPING: Metric = metric("damping", "-", "−ln amplitude_ratio");
pub(in crate::cases) const FREQUENCY_RATIO: Metric = metric(
    "frequency_ratio",
    "-",
    "frequency of the standing wave, from the zeros of its displacement, over the exact one",
);
pub(in crate::cases) const FREQUENCY_ERROR: Metric =
    metric("frequency_error", "-", "|frequency_ratio − 1|");
pub(in crate::cases) const AMPLITUDE_RATIO: Metric = metric(
    "amplitude_ratio",
    "-",
    "largest displacement in the shape of the wave in the last period, over that in the first",
);
pub(in crate::cases) const J_DRIFT_PER_1E5_STEPS: Metric = metric(
    "j_drift_per_1e5_steps",
    "-",
    "largest change of a cell's mean J̄ (J without a remedy) per 10⁵ steps",
);
pub(in crate::cases) const TRUE_J_DRIFT_PER_1E5_STEPS: Metric = metric(
    "true_j_drift_per_1e5_steps",
    "-",
    "largest change of a cell's mean J per 10⁵ steps",
);
pub(in crate::cases) const KINETIC_GROWTH: Metric = metric(
    "kinetic_growth",
    "-",
    "largest kinetic energy in the last third of the run over that in the middle third",
);
pub(in crate::cases) const BASE_PRESSURE: Metric = metric(
    "base_pressure",
    "Pa",
    "pressure at the floor, by a straight line through the lower half",
);

pub(super) const METRICS: &[Metric] = &[
    DISPLACEMENT_L2,
    DISPLACEMENT_LINF,
    VELOCITY_L2,
    VELOCITY_LINF,
    STRESS_L2,
    STRESS_LINF,
    MEAN_STRESS_L2,
    MEAN_STRESS_LINF,
    DISPLACEMENT_SCALE,
    DISPLACEMENT_RATIO,
    VELOCITY_RATIO,
    ENERGY_GAIN,
    ENERGY_LOSS,
    ENERGY_END,
    KINETIC_ENERGY_PEAK,
    LOG_JACOBIAN_GAP,
    MASS,
    BODY_MASS,
    DAMPING,
    FREQUENCY_RATIO,
    FREQUENCY_ERROR,
    AMPLITUDE_RATIO,
    J_DRIFT_PER_1E5_STEPS,
    TRUE_J_DRIFT_PER_1E5_STEPS,
    KINETIC_GROWTH,
    BASE_PRESSURE,
];

/// What the table of results shows.
pub(super) const HEADLINES: &[Headline] = &[
    headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 8),
    headline(VELOCITY_L2, "v rms error (m/s)", 1.0, 6),
    headline(STRESS_L2, "σ rms error (Pa)", 1.0, 2),
    headline(MEAN_STRESS_L2, "σ_m rms error (Pa)", 1.0, 2),
    headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5),
    headline(ENERGY_LOSS, "energy loss (–)", 1.0, 5),
    headline(LOG_JACOBIAN_GAP, "ln(J/J̄) (–)", 1.0, 6),
];

/// The errors whose convergence is studied.
pub(super) const ERRORS: &[Quantity] = &[
    error(DISPLACEMENT_L2, "rms error of u (m)"),
    error(DISPLACEMENT_LINF, "largest error of u (m)"),
    error(VELOCITY_L2, "rms error of v (m/s)"),
    error(STRESS_L2, "rms error of σ (Pa)"),
    error(MEAN_STRESS_L2, "rms error of σ_m (Pa)"),
];
