//! What is measured of the excavation.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    FACTOR_UNCUT = "factor_uncut", "-",
        "factor of safety of the whole slope at the peak strength, by limit analysis: an upper bound";
    FACTOR_CUT = "factor_cut", "-", "likewise of the slope whose toe is cut away";
    FACTOR_CUT_RESIDUAL = "factor_cut_residual", "-", "likewise at the residual strength";
    GRAVITY_CARRIED = "gravity_carried", "-",
        "share of gravity under which the whole slope has its last equilibrium";
    STANDS_UNCUT = "stands_uncut", "-",
        "1 if the whole slope comes to rest under full gravity and no particle moves by a tenth of the height in the last phase; 0 if one does; none where it still moves";
    STANDS_CUT = "stands_cut", "-",
        "likewise of the cut slope, quasi-static or moving; none if it fails uncut";
    FORCE_RATIO_UNCUT = "force_ratio_uncut", "-",
        "the paper's out-of-balance ratio, Eq. (37), of the equilibrium before the excavation";
    ENERGY_RATIO_UNCUT = "energy_ratio_uncut", "-",
        "in the place of its ratio of energies, Eq. (38), the residual's work on Newton's last correction over that of the load";
    REACTION_ERROR = "reaction_error", "-",
        "the base's vertical reaction to the whole slope over its weight, less one";
    SIDE_ERROR = "side_error", "-",
        "sum of the horizontal reactions of base and rollers to the whole slope, over the weight";
    FRICTION_RATIO = "friction_ratio", "-",
        "base=friction: largest ratio of the base's tangential reaction to its normal one, over all rows";
    PLASTIC_STRAIN_UNCUT = "plastic_strain_uncut", "-",
        "largest equivalent plastic strain before the excavation";
    PLASTIC_STRAIN_END = "plastic_strain_end", "-", "likewise at the end";
    SOFTENED_END = "softened_end", "m²", "area whose strength is residual at the end";
    BAND_WIDTH = "band_width", "m", "that area over the length of the arc of limit analysis";
    HANDED_OVER = "handed_over", "-",
        "largest change of a stress from one phase to the next, of what stays, over γH: none";
    FLOW_LEAST = "flow_least", "-",
        "least change of a particle's plastic strain from row to row: none is negative";
    MOVED_CUT = "moved_cut", "m", "largest displacement of a particle since the last phase began";
    RUNOUT_END = "runout_end", "m",
        "distance of the farthest particle's edge, at the end, from the foot of the cut face";
    CREST_DROP = "crest_drop", "m", "largest settlement of the crest since the last phase began";
    KINETIC_PEAK = "kinetic_peak", "J/m", "largest kinetic energy in the last phase";
    KINETIC_END = "kinetic_end", "-", "kinetic energy at the end over the work of the load since the last phase began: Eq. (38)";
    DISSIPATED = "dissipated", "J/m", "what flow has dissipated since the last phase began";
    LOAD_WORK = "load_work", "J/m", "work of gravity, and of a base with friction, since the last phase began";
    BALANCE_ERROR = "balance_error", "-",
        "midpoint: kinetic energy and work of the stresses since the last phase began, with what the lumped mass and the ghost penalty took, less the work of the load, over its magnitude: largest";
    MOMENTUM_ERROR = "momentum_error", "-",
        "vertical momentum in the last phase, with the impulse that the base took, less that of the weight, over it: largest";
    ENERGY_GAIN = "energy_gain", "-",
        "kinetic, stored and dissipated energy since the last phase began less the work of the load, over its magnitude: largest";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MASS = "mass", "kg/m", "mass of the whole slope";
}
