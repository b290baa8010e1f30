//! What is measured of the block.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    ENERGY_GAIN = "energy_gain", "-",
        "largest rise of kinetic and stored energy over the kinetic energy at the start, the barrier's left out, which is not negative";
    ENERGY_END = "energy_end", "-", "kinetic and stored energy at the end, over the same";
    STORED_MOST = "stored_most", "-", "most of the stored energy, over the same";
    LEAST_GAP = "least_gap", "-",
        "least gap of a particle over the distance at which the barrier begins";
    COULOMB_EXCESS = "coulomb_excess", "-",
        "most by which the force along the floor exceeds μ times the one across it, over the greatest force across it";
    FRICTION_RATIO = "friction_ratio", "-", "impulse along the floor over that across it, over μ";
    MOMENTUM_ERROR = "momentum_error", "-",
        "largest change of the momentum of body and floor together, over that of the body at the start; 10⁻¹² if it is less";
    RESTITUTION = "restitution", "-", "speed at which the block leaves the floor at the end over that of its fall";
    SPIN = "spin", "-", "speed of turning at the end, of the middle of a side, over that of the fall";
    NEWTON_ITERATIONS = "newton_iterations", "-", "implicit: Newton iterations of all steps";
}
