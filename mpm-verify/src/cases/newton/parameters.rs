//! What may be changed of the column.

use crate::cases::parameters as common;
use crate::parameter::{Domain, Parameter, number, parameters};

pub(super) const POISSON_RATIO: Parameter = common::POISSON_RATIO.with_default("0.3");
pub(super) const PPC_PER_DIRECTION: Parameter = common::PPC_PER_DIRECTION;
pub(super) const LOAD_STEPS: Parameter = common::LOAD_STEPS.with_default("1");
/// Words of [`SUPPORT`].
pub(super) const HANGS: &str = "hangs";
pub(super) const STANDS: &str = "stands";
parameters! { pub(super) const:
    SUPPORT = "support", "-", HANGS, Domain::Choice(&[HANGS, STANDS]),
        "the column hangs from its upper end and softens, or stands on a barrier";
    LOAD = "load", "-", "0.7", number(0.01, 100.0, false),
        "weight of the column over the greatest that it bears hanging, M/e of its area";
    GAP = "gap", "-", "0.9", number(0.01, 3.0, false),
        "standing: gap of the lowest particles at the start over the distance at which the barrier begins";
}

/// All of them.
pub(super) const ALL: [Parameter; 6] = [
    SUPPORT,
    LOAD,
    LOAD_STEPS,
    GAP,
    POISSON_RATIO,
    PPC_PER_DIRECTION,
];
