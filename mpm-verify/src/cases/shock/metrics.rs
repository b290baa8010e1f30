//! What is measured of the bar.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    SHOCK_SPEED_ERROR = "shock_speed_error", "-",
        "speed of the front through the material, over the last half of the run, over the exact one, less one";
    STRESS_ERROR = "stress_error", "-",
        "mean stress of the particles from a tenth to eight tenths of the way to the front at the end, over the exact one, less one";
    VELOCITY_ERROR = "velocity_error", "-", "their mean velocity, over that of the bar: exactly zero";
    WALL_FORCE_ERROR = "wall_force_error", "-",
        "momentum that the wall took in the last half of the run, over the exact one, less one";
    OVERSHOOT = "overshoot", "-", "largest of their stresses over the exact one, less one";
    RINGING = "ringing", "-", "rms of their stresses about the mean, over the exact one";
    ENERGY_LOSS = "energy_loss", "-",
        "kinetic and stored energy that is lost at the end, over that of the start; 0 if there is more";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of it, likewise";
    ENERGY_LOSS_ERROR = "energy_loss_error", "-",
        "energy lost at the end over what the exact front has taken by then, less one";
    LOSS_RATE_ERROR = "loss_rate_error", "-",
        "with an artificial viscosity: rate at which energy is lost in the last half of the run, over that of the exact front, less one";
    JUMP_BOUND = "jump_bound", "-",
        "how far the mean stress can be off as the energy that should be lost rings, over the exact stress";
    FRONT_WIDTH = "front_width", "m",
        "with an artificial viscosity: how far apart in the undeformed bar a twentieth and nineteen twentieths of the jump are at the end";
    PREDICTED_WIDTH = "predicted_width", "m", "the same of the steady front that the viscosity makes";
    MASS = "mass", "kg/m²", "mass of the bar";
}
