//! The tables of its results.

use super::metrics as m;
use super::parameters::{CFL, END};
use crate::record::Record;
use crate::results::{Column, Label, ResultTable, SCHEME, fixed, share};

pub(super) fn all() -> Vec<ResultTable> {
    let pulled = [
        Column::metric("tears at", m::TEAR_STRETCH, fixed(2)),
        Column::metric("stops at", m::STOPPED_STRETCH, fixed(2)),
        Column::metric("holds at least to", m::UNSTABLE_STRETCH, fixed(2)),
        Column::metric("neighbours part at", m::PREDICTED_TEAR_STRETCH, fixed(2)),
        Column::metric("noise before", m::STRESS_NOISE, share(1)),
        Column::metric("predicted", m::PREDICTED_NOISE, share(1)),
    ];
    let crushed = || {
        [
            Column::metric("mean stress kept", m::STRESS_KEPT, share(1)),
            Column::metric("noise of the stress, most", m::STRESS_NOISE, share(1)),
            Column::metric("predicted", m::PREDICTED_NOISE, share(1)),
            Column::metric("stops at", m::STOPPED_STRETCH, fixed(2)),
        ]
    };
    let stops = [
        Column::metric("stops at", m::STOPPED_STRETCH, fixed(3)),
        Column::metric("predicted", m::PREDICTED_STOP_STRETCH, fixed(3)),
    ];
    let crush = |r: &Record| r.set == [format!("{}=0.05", END.name)];
    let plane = |r: &Record| r.set == ["dimension=2", "end=0.2236"];
    let long = |r: &Record| r.parameters.number(CFL) > 0.1;
    let set: Label = ("set", |r| r.set.join(", "));
    vec![
        ResultTable::new("stretch", Record::is_default, &[SCHEME], pulled),
        ResultTable::new("crush", crush, &[SCHEME], crushed()),
        ResultTable::new("crush-plane", plane, &[SCHEME], crushed()),
        ResultTable::new("stretch-steps", long, &[set, SCHEME], stops),
    ]
}
