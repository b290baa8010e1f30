//! What is measured of the body.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    TEAR_STRETCH = "tear_stretch", "-",
        "first stretch at which the mean stress of the free part is less than half of the exact one, if it comes to that";
    PARTED_STRETCH = "parted_stretch", "-",
        "first stretch at which neighbours have no common node, if it comes to that";
    PREDICTED_TEAR_STRETCH = "predicted_tear_stretch", "-",
        "the same of particles at their exact places: where gap and support of the functions tear the body at the latest";
    UNSTABLE_STRETCH = "unstable_stretch", "-",
        "first stretch at which some motion of the free nodes, in the exact state without a remedy, has a negative stiffness, less the share by which the noise that is foretold may stretch some place more; none of linear functions";
    STOPPED_STRETCH = "stopped_stretch", "-", "stretch at which the program says that it can't go on, if it does";
    PREDICTED_STOP_STRETCH = "predicted_stop_stretch", "-",
        "explicit: stretch at which the fastest particle and waves of the exact state pass a cell in a step";
    STRESS_NOISE = "stress_noise", "-",
        "largest rms over the free part of what the stress differs from the exact one by, over it, up to unstable_stretch; of linear functions to predicted_tear_stretch";
    PREDICTED_NOISE = "predicted_noise", "-",
        "largest rms of the stress that answers the forces of a uniform stress on the lattice, likewise";
    STRESS_KEPT = "stress_kept", "-", "mean stress of the free part at the end, over the exact one";
}
