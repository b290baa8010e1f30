//! What is measured of the beam.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    FREQUENCY_RATIO = "frequency_ratio", "-", "first frequency over that of Timoshenko's beam";
    FREQUENCY_ERROR = "frequency_error", "-", "how far it is off one";
    PREDICTED_RATIO = "predicted_ratio", "-",
        "likewise, of a beam whose bending stiffness is what its functions and particles make of it, an upper bound with gimp and fbar-consistent; none where that is not known";
    STIFFNESS_RATIO = "stiffness_ratio", "-", "that bending stiffness over the exact one; likewise";
    AMPLITUDE_RATIO = "amplitude_ratio", "-", "largest deflection in the last period over that in the first";
}
