//! A small summary with every outcome, and texts that break what does not escape them.

use crate::check::Finding;
use crate::night::Night;
use crate::record::fixture::{changed, record};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::study::convergence::{Convergence, Point};
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
    failed.set = changed(&["cfl=0.1", NASTY]);
    let mut broken = record("h0.5", vec![broke]);
    broken.break_down("inverted", 1.0, NASTY);
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

/// A run's error, and the pairs that it costs, at a million a second.
pub(super) fn point((particle_node_pairs, value): (u64, f64)) -> Point {
    let cpu_s = 1e-6 * particle_node_pairs as f64;
    Point { level: String::new(), set: Vec::new(), h: 1.0, value, cpu_s, particle_node_pairs }
}

/// The errors `e` of a scheme with GIMP, and the pairs that they cost.
pub(super) fn curve(remedy: RemedyName, set: &[&str], runs: &[(u64, f64)]) -> Convergence {
    Convergence {
        set: changed(set),
        scheme: Scheme::flip(BasisName::Gimp, remedy),
        metric: "e".to_owned(),
        is_error: true,
        points: runs.iter().copied().map(point).collect(),
        order: None,
        extrapolation: None,
        remark: None,
    }
}
