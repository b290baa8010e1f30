//! What is measured of the clouds.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    ERROR_MEDIAN = "error_median", "-",
        "median over the clouds of the rms error of the displacement over the rms of the exact one; a cloud that breaks down counts as the worst";
    ERROR_HIGH = "error_high", "-", "likewise, what nine clouds in ten stay below; none if more than that break down";
    STRESS_MEDIAN = "stress_error_median", "-", "likewise, the median for the stress";
    SOFTENING = "softening", "-",
        "median over the clouds of the displacement along the exact one, over it, less one: more than exact is soft";
    BROKEN = "broken", "-", "share of the clouds that break down";
}
