//! Verdicts on the strip footing. The tolerances are derived in `docs/footing.md`.

use crate::case::CheckInfo;
use crate::check::Verdict;
use crate::record::Record;

pub(super) const CHECKS: &[CheckInfo] = &[];

pub(super) fn judge(_record: &Record) -> Vec<Verdict> {
    Vec::new()
}

pub(super) fn judge_study(_records: &[Record]) -> Vec<Verdict> {
    Vec::new()
}
