//! The runs that stand for the case.

use crate::record::{Record, of_defaults};

/// Ground just large enough for the limit load, and a penetration just long enough.
pub(super) const SMALL: &[&str] = &["domain_width=3", "domain_depth=3", "penetration=0.0025"];

/// The runs at the case's own parameters; where there are none, those on small ground, whose limit load is the same.
pub(super) fn own_runs(records: &[Record]) -> Vec<&Record> {
    let own = of_defaults(records);
    let small = |r: &&Record| r.set == SMALL;
    match own.is_empty() {
        true => records.iter().filter(small).collect(),
        false => own,
    }
}
