//! The metrics of the dam break.

use crate::metric::{Metric, metric};

pub(super) const BASE_REACTION_RATIO: Metric = metric(
    "base_reaction_ratio",
    "-",
    "force on the floor over the weight of the water, behind the gate: mean over three of the water's longest periods from the exact start, over 0.005 s after a gravity stage",
);
pub(super) const GATE_FORCE: Metric = metric("gate_force", "N/m", "force on the gate, likewise");
pub(super) const BACK_FORCE: Metric =
    metric("back_force", "N/m", "force on the back wall, likewise");
pub(super) const BASE_PRESSURE: Metric = metric(
    "base_pressure",
    "Pa",
    "pressure at the floor behind the gate, one step from the exact start or after the gravity stage, by a line through the particles of the lower half",
);
pub(super) const PRESSURE_PROFILE_ERROR: Metric = metric(
    "pressure_profile_error",
    "-",
    "rms over the particles of the pressure less the hydrostatic one, over that at the floor, then",
);
pub(super) const START_KINETIC_ENERGY: Metric = metric(
    "start_kinetic_energy",
    "J/m",
    "kinetic energy behind the gate when the forces have been measured",
);
pub(super) const FRONT_X_EARLY: Metric = metric(
    "front_x_0.4s",
    "m",
    "outermost particle and half its spacing, 0.4 s after the removal",
);
pub(super) const FRONT_RMS_ERROR: Metric = metric(
    "front_rms_error",
    "m",
    "rms distance of the front from the inviscid one, t √(g/H) from 0.2 to 0.9",
);
pub(super) const FRONT_SPEED_MAX: Metric = metric(
    "front_speed_max",
    "m/s",
    "largest speed of the front until it is two cells off the wall",
);
pub(super) const ARRIVAL_TIME: Metric = metric(
    "arrival_time",
    "s",
    "when the front is two cells off the wall",
);
pub(super) const ARRIVAL_ERROR: Metric = metric(
    "arrival_error",
    "s",
    "distance of that time from the inviscid one",
);
pub(super) const BACK_LEVEL_EARLY: Metric = metric(
    "back_level_0.4s",
    "m",
    "highest particle within a cell of the back wall and half its spacing, at 0.4 s",
);
pub(super) const ENERGY_RATIO: Metric = metric(
    "energy_ratio",
    "-",
    "kinetic and potential energy and stress work at 0.4 s over those at the start",
);
pub(super) const ENERGY_RATIO_2S: Metric = metric("energy_ratio_2s", "-", "likewise at 2 s");
pub(super) const ENERGY_GAIN: Metric = metric(
    "energy_gain",
    "-",
    "largest growth of that energy in 0.005 s, over its start",
);
pub(super) const ENERGY_EXCESS: Metric = metric(
    "energy_excess",
    "-",
    "largest excess of it over its start, relative",
);
pub(super) const MOTION_RATIO_2S: Metric = metric(
    "motion_ratio_2s",
    "-",
    "kinetic and potential energy at 2 s over those at the start",
);
pub(super) const MOTION_EXCESS: Metric = metric(
    "motion_excess",
    "-",
    "largest excess of kinetic and potential energy over their start, relative",
);
pub(super) const MOTION_LOSS: Metric =
    metric("motion_loss", "-", "largest loss of them, over their start");
pub(super) const PRESSURE_RMS: Metric = metric(
    "pressure_rms",
    "Pa",
    "rms over the particles of the pressure at 0.4 s",
);
pub(super) const CHECKERBOARD_RMS: Metric = metric(
    "checkerboard_rms",
    "Pa",
    "rms over the particles of p − Πp at 0.4 s",
);
pub(super) const TENSION_SHARE: Metric = metric(
    "tension_share",
    "-",
    "share of the particles in tension at 0.4 s",
);
pub(super) const COVERED_EARLY: Metric = metric(
    "covered_0.4s",
    "m²",
    "area under the highest particles at 0.4 s, in strips two particles wide",
);
pub(super) const CENTRE_X_EARLY: Metric = metric("centre_x_0.4s", "m", "centre of mass at 0.4 s");
pub(super) const CENTRE_X_MEAN: Metric =
    metric("centre_x_mean", "m", "centre of mass, mean over 2 s");
pub(super) const CENTRE_Y_MEAN: Metric = metric("centre_y_mean", "m", "its height, likewise");
pub(super) const WALL_IMPULSE: Metric =
    metric("wall_impulse", "N s/m", "impulse on the front wall in 2 s");
pub(super) const JACOBIAN_MIN: Metric =
    metric("jacobian_min", "-", "least J of a particle at any time");
pub(super) const JACOBIAN_MAX: Metric =
    metric("jacobian_max", "-", "greatest J of a particle at any time");
pub(super) const LOG_JACOBIAN_GAP: Metric = metric("log_jacobian_gap", "-", "rms ln(J/J̄) at 0.4 s");
pub(super) const MASS: Metric = metric("mass", "kg/m", "mass of the water at the end");

pub(super) const ALL: [Metric; 31] = [
    BASE_REACTION_RATIO,
    GATE_FORCE,
    BACK_FORCE,
    BASE_PRESSURE,
    PRESSURE_PROFILE_ERROR,
    START_KINETIC_ENERGY,
    FRONT_X_EARLY,
    FRONT_RMS_ERROR,
    FRONT_SPEED_MAX,
    ARRIVAL_TIME,
    ARRIVAL_ERROR,
    BACK_LEVEL_EARLY,
    ENERGY_RATIO,
    ENERGY_RATIO_2S,
    ENERGY_GAIN,
    ENERGY_EXCESS,
    MOTION_RATIO_2S,
    MOTION_EXCESS,
    MOTION_LOSS,
    PRESSURE_RMS,
    CHECKERBOARD_RMS,
    TENSION_SHARE,
    COVERED_EARLY,
    CENTRE_X_EARLY,
    CENTRE_X_MEAN,
    CENTRE_Y_MEAN,
    WALL_IMPULSE,
    JACOBIAN_MIN,
    JACOBIAN_MAX,
    LOG_JACOBIAN_GAP,
    MASS,
];
