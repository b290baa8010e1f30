//! The table of its results.

use super::metrics as m;
use crate::record::Record;
use crate::results::{Column, ResultTable, SCHEME, SHORT, share};

pub(super) fn all() -> Vec<ResultTable> {
    let columns = [
        Column::metric("noise of the stress, most", m::STRESS_NOISE, share(3)),
        Column::metric("mean", m::STRESS_NOISE_MEAN, share(3)),
        Column::metric("predicted", m::PREDICTED_NOISE, share(3)),
        Column::metric("mean stress kept", m::STRESS_KEPT, share(1)),
        Column::metric("noise of the velocity", m::VELOCITY_NOISE, share(3)),
        Column::metric("energy gain", m::ENERGY_GAIN, SHORT),
    ];
    let shows = Record::is_default;
    vec![ResultTable::new("translate", shows, &[SCHEME], columns)]
}
