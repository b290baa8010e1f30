//! The metrics of the dam break.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    BASE_REACTION_RATIO = "base_reaction_ratio", "-",
        "force on the floor over the weight of the water, behind the gate: mean over three of the water's longest periods from the exact start, over 0.005 s after a gravity stage";
    GATE_FORCE = "gate_force", "N/m", "force on the gate, likewise";
    BACK_FORCE = "back_force", "N/m", "force on the back wall, likewise";
    BASE_PRESSURE = "base_pressure", "Pa",
        "pressure at the floor behind the gate, one step from the exact start or after the gravity stage, by a line through the particles of the lower half";
    PRESSURE_PROFILE_ERROR = "pressure_profile_error", "-",
        "rms over the particles of the pressure less the hydrostatic one, over that at the floor, then";
    START_KINETIC_ENERGY = "start_kinetic_energy", "J/m",
        "kinetic energy behind the gate when the forces have been measured";
    FRONT_X_EARLY = "front_x_0.4s", "m", "outermost particle and half its spacing, 0.4 s after the removal";
    FRONT_RMS_ERROR = "front_rms_error", "m",
        "rms distance of the front from the inviscid one, t √(g/H) from 0.2 to 0.9";
    FRONT_SPEED_MAX = "front_speed_max", "m/s",
        "largest speed of the front until it is two cells off the wall";
    ARRIVAL_TIME = "arrival_time", "s", "when the front is two cells off the wall";
    ARRIVAL_ERROR = "arrival_error", "s", "distance of that time from the inviscid one";
    BACK_LEVEL_EARLY = "back_level_0.4s", "m",
        "highest particle within a cell of the back wall and half its spacing, at 0.4 s";
    ENERGY_RATIO = "energy_ratio", "-",
        "kinetic and potential energy and stress work at 0.4 s over those at the start";
    ENERGY_RATIO_2S = "energy_ratio_2s", "-", "likewise at 2 s";
    ENERGY_GAIN = "energy_gain", "-", "largest growth of that energy in 0.005 s, over its start";
    ENERGY_EXCESS = "energy_excess", "-", "largest excess of it over its start, relative";
    MOTION_RATIO_2S = "motion_ratio_2s", "-", "kinetic and potential energy at 2 s over those at the start";
    MOTION_EXCESS = "motion_excess", "-",
        "largest excess of kinetic and potential energy over their start, relative";
    MOTION_LOSS = "motion_loss", "-", "largest loss of them, over their start";
    PRESSURE_RMS = "pressure_rms", "Pa", "rms over the particles of the pressure at 0.4 s";
    CHECKERBOARD_RMS = "checkerboard_rms", "Pa", "rms over the particles of p − Πp at 0.4 s";
    TENSION_SHARE = "tension_share", "-", "share of the particles in tension at 0.4 s";
    COVERED_EARLY = "covered_0.4s", "m²",
        "area under the highest particles at 0.4 s, in strips two particles wide";
    CENTRE_X_EARLY = "centre_x_0.4s", "m", "centre of mass at 0.4 s";
    CENTRE_X_MEAN = "centre_x_mean", "m", "centre of mass, mean over 2 s";
    CENTRE_Y_MEAN = "centre_y_mean", "m", "its height, likewise";
    WALL_IMPULSE = "wall_impulse", "N s/m", "impulse on the front wall in 2 s";
    JACOBIAN_MIN = "jacobian_min", "-", "least J of a particle at any time";
    JACOBIAN_MAX = "jacobian_max", "-", "greatest J of a particle at any time";
    LOG_JACOBIAN_GAP = "log_jacobian_gap", "-", "rms ln(J/J̄) at 0.4 s";
    MASS = "mass", "kg/m", "mass of the water at the end";
}
