//! What is measured of the body.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    STRESS_NOISE = "stress_noise", "-",
        "largest rms over the particles of σ_xx minus its mean, over its exact value; 10⁻¹⁰ if it is less";
    STRESS_NOISE_MEAN = "stress_noise_mean", "-", "likewise, the mean over the rows of the last half of the run";
    STRESS_KEPT = "stress_kept", "-", "mean of σ_xx over the particles at the end, over its exact value";
    PREDICTED_NOISE = "predicted_noise", "-",
        "rms of the stress that answers the forces of a uniform stress on this lattice; flip without a remedy";
    VELOCITY_NOISE = "velocity_noise", "-",
        "largest rms of the velocity less that of the body, over its speed; 10⁻¹⁰ if it is less";
    MOMENTUM_ERROR = "momentum_error", "-",
        "largest change of the momentum over its start; 10⁻¹² if it is less";
    ENERGY_GAIN = "energy_gain", "-",
        "largest rise of kinetic and stored energy, over the kinetic energy at the start";
    ENERGY_LOSS = "energy_loss", "-", "largest fall, likewise";
    MASS = "mass", "kg/m", "mass of the body";
}
