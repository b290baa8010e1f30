//! What is measured of the discs.

use crate::metric::metrics;

metrics! { pub(super) ALL:
    ENERGY_GAIN = "energy_gain", "-",
        "largest rise of kinetic and stored energy over their start, relative to it";
    ENERGY_LOSS = "energy_loss", "-", "largest fall, likewise";
    ENERGY_END = "energy_end", "-", "rise at the end, likewise";
    ENERGY_ERROR_ACCUMULATED = "energy_error_accumulated", "-",
        "largest distance from the start of kinetic energy and accumulated stress work, the paper's Eqs. (34) to (36), relative to it";
    LUMPING_LOSS = "lumping_loss", "-",
        "midpoint: what particles don't take of the nodes' kinetic energy as part of the mass is lumped, over the energy at the start";
    NODE_ENERGY_GAP = "node_energy_gap", "-",
        "largest kinetic energy that particles have beyond their nodes, over the energy at the start";
    MOMENTUM_ERROR = "momentum_error", "-",
        "largest change of the linear momentum, over the sum of its magnitudes at the start; 10⁻¹² if it is less, which no golden should hold";
    ANGULAR_MOMENTUM_ERROR = "angular_momentum_error", "-",
        "largest change of the angular momentum about the centre, that of affine parts with it, over that sum times 0.4 m; likewise";
    ENERGY_EXCHANGED = "energy_exchanged", "-",
        "largest change of the stored energy in a step, over the energy at the start";
    RESTITUTION = "restitution", "-",
        "speed at which the discs' centres of mass move against each other at the end, over that at the start";
    DEFLECTION = "deflection", "-",
        "change of the velocity at which they do, over its start: 2 of discs that bounce back, 0 of discs that miss each other";
    FREE_UNTIL = "free_until", "s",
        "last time at which no node would see both discs if they flew freely, if one comes to";
    FLIGHT_ERROR = "flight_error", "-",
        "until then, or to the end, the largest change of a particle's velocity, over its speed; 10⁻¹² if it is less";
    FLIGHT_STRAIN = "flight_strain", "-", "likewise the largest |J − 1|";
    ASYMMETRY = "asymmetry", "-",
        "largest distance at the end of a particle from where its mirror image about the centre is, over the radius; 10⁻⁹ if it is less";
    CLOSEST = "closest", "m", "least distance of the discs' centres of mass";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MASS = "mass", "kg/m", "mass of both discs";
}
