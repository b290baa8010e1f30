//! Tables of its results.

use super::super::manufactured::metrics::{
    BASE_PRESSURE, DISPLACEMENT_L2, J_DRIFT_PER_1E5_STEPS, KINETIC_ENERGY_PEAK, KINETIC_GROWTH,
    TRUE_J_DRIFT_PER_1E5_STEPS,
};
use super::LONG;
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, fixed};

pub(super) fn all() -> Vec<ResultTable> {
    let shows = |r: &Record| r.set == LONG;
    let columns = [
        ("drift of J̄ per 10⁵ steps", J_DRIFT_PER_1E5_STEPS, SHORT),
        ("of J", TRUE_J_DRIFT_PER_1E5_STEPS, SHORT),
        ("largest kinetic energy (J/m)", KINETIC_ENERGY_PEAK, SHORT),
        ("last/middle third", KINETIC_GROWTH, SHORT),
        (
            "pressure at the floor (kPa; exact 19.57)",
            BASE_PRESSURE,
            fixed(2).times(1e-3),
        ),
        ("rms error of u (m)", DISPLACEMENT_L2, SHORT),
    ];
    let columns = columns.map(|(title, metric, format)| Column::metric(title, metric, format));
    vec![ResultTable::new("column", shows, &[SCHEME], columns)]
}
