//! What is measured of the disc.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    ANGULAR_MOMENTUM_ERROR = "angular_momentum_error", "-",
        "largest change of the angular momentum, that of affine parts with it, over its start; 10⁻¹² if it is less";
    ANGULAR_MOMENTUM_END = "angular_momentum_end", "-", "angular momentum at the end over its start";
    MOMENTUM_ERROR = "momentum_error", "-",
        "largest linear momentum over the mass times the speed of the rim; 10⁻¹² if it is less";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy, over their start";
    ENERGY_LOSS = "energy_loss", "-", "largest fall, likewise";
    ENERGY_END = "energy_end", "-", "change at the end, likewise";
    STRETCH_ERROR = "stretch_error", "-",
        "largest distance of the rms radius from that of the exact disc that turns as fast as the particles do by their angular momentum, over what the turning adds to it at the start";
    STRETCH_MEAN_ERROR = "stretch_mean_error", "-", "mean of that distance over the last half of the run, with its sign";
    PHASE_ERROR = "phase_error", "-", "angle that the disc has turned by over the exact one, less one";
    STORED_SHARE = "stored_share", "-", "stored energy over kinetic and stored energy at the start";
    MASS = "mass", "kg/m", "mass of the disc";
}
