//! A small summary with every outcome, and texts that break what does not escape them.

use crate::check::Finding;
use crate::night::Night;
use crate::record::fixture::record;
use crate::record::{Failure, Status};
use crate::study::summary::{CaseStudy, Counts, Summary};
use crate::verdict::Kind;

/// Markup, if it is not escaped.
pub(super) const NASTY: &str = "</td><script>\"'&amp;";

/// One run that passes, one with a failed check and changed parameters, one that broke down.
pub(super) fn summary() -> Summary {
    let pass = Finding::within("at_rest", 1.0, 1.0, 0.0, "").verdict("at-rest", Kind::Truth);
    let fail = Finding::at_most("mid_edge_uy", 2.0, 1.0, NASTY).verdict("mid-edge", Kind::Truth);
    let skipped = Finding::not_applicable("tip_uy", NASTY).verdict("tip", Kind::Truth);
    let broke = Finding::within("run", 0.0, 1.0, 0.0, NASTY).verdict("completes", Kind::Bookkeeping);
    let mut failed = record("h2", vec![pass.clone(), fail]);
    failed.set = vec!["cfl=0.1".to_owned(), NASTY.to_owned()];
    let mut broken = record("h0.5", vec![broke]);
    broken.status = Status::Failed;
    broken.error = Some(Failure {
        kind: "inverted".to_owned(),
        time: 1.0,
        step: 2,
        particle: 3,
        value: None,
        message: NASTY.to_owned(),
    });
    Summary {
        schema: 1,
        tier: NASTY.to_owned(),
        counts: Counts {
            runs: 3,
            broke_down: 1,
            right: 3,
            failed: 1,
            bookkeeping_failed: 1,
            not_judged: 1,
            ..Counts::default()
        },
        cases: vec![CaseStudy {
            verdicts: vec![pass.clone()],
            night: Some(Night { date: jiff::civil::date(2026, 1, 2), commit: NASTY.to_owned() }),
            ..CaseStudy::new("cook", vec![record("h1", vec![pass, skipped]), failed, broken])
        }],
    }
}
