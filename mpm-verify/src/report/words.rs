//! The words for outcomes, kinds and numbers, the same on the terminal, the pages and in files.

use crate::accuracy::Order;
use crate::distinct;
use crate::record::Record;
use crate::study::convergence::Convergence;
use crate::study::judge::{broke_as_known, outcome_of_run};
use crate::study::summary::{CaseStudy, Summary};
use crate::verdict::{Kind, Outcome, Verdict};

/// Origin of the runs of a case: the program, the night and the commit, as far as they are known.
pub(super) fn made_by(study: &CaseStudy) -> [String; 3] {
    let program = study.program().map(|v| format!("mpm-verify {}, source {}", v.mpm_verify, v.source));
    let night = study.night.as_ref();
    [program, night.map(|n| n.date.to_string()), night.map(|n| n.commit.clone())]
        .map(|known| known.unwrap_or_else(|| "–".to_owned()))
}

pub(super) fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Truth => "TRUTH",
        Kind::KnownLimit => "known limit",
        Kind::Regression => "regression",
        Kind::Drift => "DRIFT",
        Kind::Bookkeeping => "bookkeeping",
        Kind::Wanted => "wanted",
    }
}

/// Symbol and words of an outcome, and the class that gives its colour.
pub(super) fn shown(outcome: Outcome) -> [&'static str; 3] {
    match outcome {
        Outcome::Right => ["✓", "right", "pass"],
        Outcome::WrongAsKnown => ["≈", "wrong as known", "known"],
        Outcome::NotJudged => ["–", "not judged", "none"],
        Outcome::Failed => ["✗", "FAILED", "fail"],
    }
}

pub(super) fn outcome(outcome: Outcome) -> &'static str {
    shown(outcome)[1]
}

/// All outcomes, in the order of counts.
pub(super) const OUTCOMES: [Outcome; 4] = [Outcome::Right, Outcome::WrongAsKnown, Outcome::NotJudged, Outcome::Failed];

pub(super) fn name(record: &Record) -> String {
    let set = record.set.iter().map(|assignment| format!(" {assignment}"));
    format!("{} {}{}", record.scheme(), record.level, set.collect::<String>())
}

/// Names in a sentence.
pub(super) fn list(names: impl IntoIterator<Item = impl Into<String>>) -> String {
    let names: Vec<String> = names.into_iter().map(Into::into).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// The verdict on a run in a sentence: its outcome, and the checks that decide it.
pub(super) fn sentence(record: &Record) -> String {
    let found = outcome_of_run(record);
    let checks = |outcome: Outcome| {
        let own = record.verdicts.iter().filter(move |v| v.outcome == outcome && !v.is_wanted());
        let told = |v: &&Verdict| v.kind == Kind::KnownLimit || outcome != Outcome::WrongAsKnown;
        distinct(own.filter(|v| told(v) && (v.judges() || v.failed())).map(|v| &*v.check))
    };
    let wanted = |outcome: Outcome| {
        let own = record.verdicts.iter().filter(|v| v.is_wanted() && v.outcome == outcome);
        let names: Vec<&str> = own.map(|v| &*v.check).collect();
        if names.is_empty() { String::new() } else { names.join(", ") + "; " }
    };
    let right = match checks(Outcome::Right).len() {
        0 => "no other check holds".to_owned(),
        1 => "1 check right".to_owned(),
        n => format!("{n} checks right"),
    };
    let why = match (found, &record.error) {
        (_, Some(e)) if record.broke_down() || broke_as_known(record) => match e.time.is_nan() {
            true => format!("it broke down: {}", e.message),
            false => format!("it broke down at {} s", number(Some(e.time))),
        },
        (Outcome::Right, _) => match checks(Outcome::NotJudged).len() {
            0 => wanted(found) + &right,
            n => format!("{}{right}, {n} not judged", wanted(found)),
        },
        (Outcome::NotJudged, _) => match checks(Outcome::Right).len() {
            0 => wanted(found) + "no check against the truth applies",
            _ => format!("{}laws hold, {right}", wanted(found)),
        },
        (found, _) => format!("{}; {right}", checks(found).join(", ")),
    };
    format!("{}: {why}", outcome(found))
}

/// Demand of a check on a value, and the value.
pub(super) fn demand(v: &Verdict) -> String {
    let value = number(v.value);
    match (v.value, v.reference, v.tolerance) {
        (_, Some(reference), Some(tolerance)) => {
            let [reference, tolerance] = [reference, tolerance].map(|x| number(Some(x)));
            format!("{value} against {reference} ± {tolerance}")
        }
        // A bound from above holds of what is below it; a bound from below fails of it.
        (Some(x), None, Some(bound)) => {
            let above = v.holds() == Some(x > bound);
            let sign = if above { ">" } else { "≤" };
            format!("{value}, demanded {sign} {}", number(Some(bound)))
        }
        _ => value,
    }
}

/// A number with five digits, very small and very large ones as powers of ten with three; a dash without a number.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        None => "–".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(x) if (1e-3..1e6).contains(&x.abs()) => {
            let decimals = (4 - x.abs().log10().floor() as i32).max(0) as usize;
            let text = format!("{x:.decimals$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
        Some(x) => format!("{x:.2e}"),
    }
}

/// A number with its unit, if it has one.
pub(super) fn quantity(value: Option<f64>, unit: &str) -> String {
    match unit {
        "-" => number(value),
        unit => format!("{} {unit}", number(value)),
    }
}

/// The observed order, of an error with its uncertainty (95 %), or a dash.
pub(super) fn order(c: &Convergence) -> String {
    match (&c.order, &c.extrapolation) {
        (Some(o), _) => o.to_string(),
        (None, Some(r)) => format!("{:.2}", r.order),
        (None, None) => number(None),
    }
}

/// The orders of an error between successive levels, or a dash.
pub(super) fn local_orders(c: &Convergence) -> String {
    c.order.as_ref().map_or_else(|| number(None), Order::between)
}

/// The commands that accept the drift of each case that has drifted and misses no truth.
pub(super) fn bless_commands(summary: &Summary) -> Vec<String> {
    let meets =
        |name: &str, test: fn(&Verdict) -> bool| summary.verdicts().any(|(study, _, v)| study.case == name && test(v));
    let cases = summary.cases.iter().map(|study| study.case.as_str());
    cases
        .filter(|case| meets(case, Verdict::drifts) && !meets(case, Verdict::misses_the_truth))
        .map(|case| format!("mpm-verify bless {case} --reason \"why the results have changed\""))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Finding;
    use crate::record::fixture::record;

    #[test]
    fn numbers_have_five_digits() {
        let shown = [19_291.447, 0.083_734_2, 1.742e-9, 100_000.0, -0.0, 1.0].map(|x| number(Some(x)));
        assert_eq!(shown, ["19291", "0.083734", "1.74e-9", "100000", "0", "1"]);
    }

    #[test]
    fn a_demand_says_on_which_side_of_its_bound_a_value_should_be() {
        let found = |finding: Finding| demand(&finding.verdict("c", Kind::Truth));
        assert_eq!(found(Finding::at_most("m", 1.0, 2.0, "")), "1, demanded ≤ 2");
        assert_eq!(found(Finding::at_most("m", 3.0, 2.0, "")), "3, demanded ≤ 2");
        assert_eq!(found(Finding::above("m", 3.0, 2.0, "")), "3, demanded > 2");
        assert_eq!(found(Finding::above("m", 1.0, 2.0, "")), "1, demanded > 2");
        assert_eq!(found(Finding::within("m", 1.0, 2.0, 0.5, "")), "1 against 2 ± 0.5");
    }

    /// A known limit is said even where everything else is right.
    #[test]
    fn the_sentence_on_a_run_names_what_decides() {
        let found = |holds, kind| Finding::at_most("m", if holds { 0.0 } else { 2.0 }, 1.0, "").verdict("c", kind);
        let right = found(true, Kind::Truth);
        let limit = Verdict { check: "locked".to_owned(), ..found(true, Kind::KnownLimit) };
        let mass = found(true, Kind::Bookkeeping);
        let said = |verdicts: &[&Verdict]| sentence(&record("h2", verdicts.iter().map(|v| (*v).clone()).collect()));
        assert_eq!(said(&[&right, &limit, &mass]), "wrong as known: locked; 1 check right");
        assert_eq!(said(&[&right, &mass]), "right: 1 check right");
        assert_eq!(said(&[&mass]), "not judged: no check against the truth applies");
        assert_eq!(said(&[&found(false, Kind::Truth), &limit]), "FAILED: c; no other check holds");
    }
}
