//! What may be changed of the column.

use crate::parameter::{Domain, Parameter, number, parameters};

/// A word of [`VOLUME_RATE`].
pub(super) const LOGARITHMIC: &str = "logarithmic";

parameters! { pub(super) const:
    LOAD = "load", "-", "0.3", number(1e-4, 2.0, false),
        "load q over the oedometric modulus M₀ of the undeformed column; the reference has 0.003, 0.3 and 1";
    REFINE = "refine", "-", "4", Domain::Integer { least: 1, most: 64 },
        "steps that each of the 125 is cut into; the reference of steps has 1, 2, 4 and 8";
    VOLUME_RATE = "volume_rate", "-", "exact", Domain::Choice(&["exact", LOGARITHMIC]),
        "what a step's volume changes by over its start: J̃ − 1, or J̃ ln J̃";
    DRAIN = "drain", "-", "1e4", number(1.0, 1e6, false),
        "what the drained top lets through for its pressure, over κ₀/h";
    GHOST_DISPLACEMENT = "ghost_displacement", "-", "0", number(0.0, 10.0, false),
        "ghost penalty of the displacement over G";
    GHOST_PRESSURE = "ghost_pressure", "-", "0", number(0.0, 10.0, false),
        "ghost penalty of the pressure over κ₀ Δt";
    PROJECTION = "projection", "-", "1", number(0.01, 100.0, false), "ppp: its strength times 2G";
    TOLERANCE = "tolerance", "-", "1e-10", number(1e-13, 1e-2, false),
        "residual of a converged step over what it balances";
}

/// All of them.
pub(super) const ALL: [Parameter; 8] = [
    LOAD,
    REFINE,
    VOLUME_RATE,
    DRAIN,
    GHOST_DISPLACEMENT,
    GHOST_PRESSURE,
    PROJECTION,
    TOLERANCE,
];
