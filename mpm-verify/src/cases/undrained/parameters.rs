//! What may be changed of the undrained body.

use crate::parameter::{Domain, Parameter, parameters};

parameters! { pub(super) const:
    DOMAIN = "domain", "-", "square", Domain::Choice(&["square", "ellipse"]),
        "square: held all around, on grid lines; ellipse: half of one, held at its straight side, that fits no grid";
    PARTICLES = "points_per_direction", "-", "2", Domain::Integer { least: 1, most: 4 },
        "particles per cell of the displacement and direction";
    LAYOUT = "layout", "-", "aligned", Domain::Choice(&["aligned", "across"]),
        "aligned: domains fill cells; across: one more along each side, so that domains lie across grid lines";
    PRESSURE_FUNCTIONS = "pressure_functions", "-", "same", Domain::Choice(&["same", "linear"]),
        "functions of the pressure: those of the displacement, or linear ones";
}

/// All of them.
pub(super) const ALL: [Parameter; 4] = [DOMAIN, PARTICLES, LAYOUT, PRESSURE_FUNCTIONS];
