//! What may be changed of the half ellipse.

use crate::parameter::{Domain, Parameter, number, parameters};

parameters! { pub(super) const:
    GHOST = "alpha", "-", "0.1", number(0.0, 10.0, false),
        "strength of both ghost penalties: of the displacement's over G, of the pressure's over its conductivity";
    POSITIONS = "positions", "-", "40", Domain::Integer { least: 4, most: 400 },
        "places of the body within one cell of the pressure";
    MOBILITY = "mobility", "-", "1e-6", number(1e-12, 1e3, false),
        "κ Δt G/h_p² of the whole matrix, h_p the pressure's cell: small where hardly any water flows";
    PRESSURE_GHOST = "pressure_ghost", "-", "conductivity", Domain::Choice(&["conductivity", "storage"]),
        "what the whole matrix's ghost penalty of the pressure is over: κ Δt, or κ Δt + h_p²/G";
}

/// All of them.
pub(super) const ALL: [Parameter; 4] = [GHOST, POSITIONS, MOBILITY, PRESSURE_GHOST];
