//! The runs that stand for the case.

use crate::cases::parameters::CFL;
use crate::record::Record;
use crate::scheme::RemedyName;

/// One record for each scheme and level at the case's own parameters. A state of rest hardly depends on the time step:
/// where there is no such record, one with another time step stands in, but for schemes that never come to rest.
pub(in crate::cases::cook) fn own_runs(records: &[Record]) -> Vec<&Record> {
    let same = |a: &Record, b: &Record| a.scheme() == b.scheme() && a.level == b.level;
    let stands_in = |r: &Record| {
        r.changes_only(CFL.name)
            && r.remedy() != RemedyName::FbarRecursive
            && !records.iter().any(|d| d.is_default() && same(d, r))
    };
    let own = records.iter().filter(|r| r.is_default() || stands_in(r));
    own.collect()
}
