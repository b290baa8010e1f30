//! What the pages are made of: runs, verdicts, outcomes, prices and orders, as values that templates show.

use super::super::describe::{headline, kind, local_orders, number, order, outcome};
use super::super::price::Prices;
use super::file_of;
use crate::case::Case;
use crate::metric::Quantity;
use crate::record::Record;
use crate::study::convergence::Convergence;
use crate::study::summary::CaseStudy;
use crate::table::Sheet;
use crate::verdict::{Kind, Outcome, Verdict};
use minijinja::{Value, context};

pub(super) fn run(case: &Case, r: &Record) -> Value {
    let (d, w) = (&r.discretisation, &r.work);
    let facts = [
        ("cell size", format!("{} m", d.h)),
        ("particles per cell", d.ppc.to_string()),
        ("time step", format!("{} s", number(Some(d.dt)))),
        ("splines at walls", d.wall.clone()),
        ("particles", grouped(w.particles)),
        ("nodes", grouped(w.nodes)),
        ("steps", grouped(w.steps)),
        ("particle steps", grouped(w.particle_steps)),
        ("particle–node pairs", grouped(w.particle_node_pairs)),
        ("projections", grouped(w.projections)),
        ("sorts", grouped(w.sorts)),
        ("CPU time", format!("{:.1} s", r.time.cpu_s)),
        ("time by the clock", format!("{:.1} s", r.time.wall_s)),
    ];
    let shown = r
        .verdicts
        .iter()
        .filter(|v| v.kind != Kind::Drift || v.failed());
    let undrifted = r
        .verdicts
        .iter()
        .filter(|v| v.kind == Kind::Drift && v.holds() == Some(true));
    context! {
        id => anchor(r),
        name => name(r),
        scheme => r.scheme().to_string(),
        level => &r.level,
        set => r.set.join(" "),
        outcome => outcome_of_run(r),
        open => r.broke_down() || r.verdicts.iter().any(Verdict::failed),
        error => r.error.as_ref().map(|e| &*e.message),
        headlines => case.headlines.iter().map(|h| headline(r, h)).collect::<Vec<_>>(),
        cpu => format!("{:.1}", r.time.cpu_s),
        facts => facts.map(|(name, value)| vec![Value::from(name), Value::from(value)]).to_vec(),
        verdicts => shown.map(verdict).collect::<Vec<_>>(),
        undrifted => undrifted.count(),
    }
}

pub(super) fn verdict(v: &Verdict) -> Value {
    let (class, symbol) = match v.outcome {
        Outcome::Right => ("pass", "✓"),
        Outcome::WrongAsKnown => ("known", "≈"),
        Outcome::Failed if v.kind == Kind::Drift => ("drift", "≠"),
        Outcome::Failed => ("fail", "✗"),
        Outcome::NotJudged => ("none", "–"),
    };
    // A drift may lie beyond the digits that are shown elsewhere.
    let shown = |x: Option<f64>| match (v.kind, x) {
        (Kind::Drift, Some(x)) => x.to_string(),
        _ => number(x),
    };
    context! {
        outcome => context! { class, symbol, text => outcome(v) },
        kind => kind(v.kind),
        check => &v.check,
        metric => &v.metric,
        value => shown(v.value),
        reference => shown(v.reference),
        tolerance => number(v.tolerance),
        source => &v.source,
    }
}

/// What happened in some runs, counted.
pub(super) struct Tally {
    pub(super) broken: usize,
    pub(super) failed: usize,
    pub(super) drifted: usize,
    pub(super) known: usize,
    pub(super) right: usize,
    /// Bookkeeping and comparisons with goldens that hold.
    pub(super) held: usize,
}

impl Tally {
    /// The worst of it, in a word with a symbol and a class that gives its colour.
    pub(super) fn worst(&self) -> Value {
        let (class, symbol, text) = if self.broken > 0 {
            ("broke", "⚠", "broke down".to_owned())
        } else if self.failed > 0 {
            ("fail", "✗", format!("{} failed", self.failed))
        } else if self.drifted > 0 {
            ("drift", "≠", format!("{} drifted", self.drifted))
        } else if self.known > 0 {
            let also = match self.right {
                0 => String::new(),
                right => format!(", {right} right"),
            };
            ("known", "≈", format!("{} wrong as known{also}", self.known))
        } else if self.right > 0 {
            ("pass", "✓", "right".to_owned())
        } else if self.held > 0 {
            ("none", "–", "not judged".to_owned())
        } else {
            ("none", "–", "nothing applies".to_owned())
        };
        context! { class, symbol, text }
    }
}

pub(super) fn outcome_of(verdicts: &[Verdict], broken: usize) -> Value {
    let count = |which: fn(&Verdict) -> bool| verdicts.iter().filter(|v| which(v)).count();
    let judges = |v: &Verdict| matches!(v.kind, Kind::Truth | Kind::KnownLimit);
    let right = verdicts
        .iter()
        .filter(|v| judges(v) && v.outcome == Outcome::Right);
    let held = verdicts
        .iter()
        .filter(|v| !judges(v) && v.outcome == Outcome::Right);
    Tally {
        broken,
        failed: count(Verdict::misses_the_truth),
        drifted: count(Verdict::drifts),
        known: count(|v| v.outcome == Outcome::WrongAsKnown),
        right: right.count(),
        held: held.count(),
    }
    .worst()
}

pub(super) fn outcome_of_run(record: &Record) -> Value {
    outcome_of(&record.verdicts, usize::from(record.broke_down()))
}

/// A table for its template.
pub(super) fn sheet(sheet: Sheet) -> Value {
    context! { head => sheet.head, rows => sheet.rows }
}

pub(super) fn prices(prices: &Prices) -> Value {
    context! {
        label => prices.label,
        metric => &prices.metric,
        target => prices.aim(),
        table => sheet(prices.table()),
    }
}

/// The convergence of a quantity, scheme by scheme, if there is any.
pub(super) fn quantity<'a>(
    quantity: &Quantity,
    convergence: impl Iterator<Item = &'a Convergence>,
) -> Option<Value> {
    let of_quantity = convergence.filter(|c| c.metric == quantity.metric.name);
    let schemes: Vec<Value> = of_quantity.map(row_of_convergence).collect();
    let shown = !schemes.is_empty();
    shown.then(|| context! { label => quantity.label, metric => quantity.metric.name, schemes })
}

fn row_of_convergence(c: &Convergence) -> Value {
    let levels = c.points.iter().map(|p| match p.set == c.set {
        true => p.level.clone(),
        false => format!("{} ({})", p.level, p.set.join(" ")),
    });
    let extrapolation = c.extrapolation.as_ref();
    context! {
        scheme => c.scheme.to_string(),
        levels => levels.collect::<Vec<_>>().join(", "),
        order => order(c),
        local => local_orders(c),
        extrapolated => number(extrapolation.map(|r| r.extrapolated)),
        gci => extrapolation.map_or_else(|| number(None), |r| format!("{:.2} %", 100.0 * r.gci)),
        remark => c.remark.as_deref().unwrap_or_default(),
    }
}

pub(super) fn name(record: &Record) -> String {
    let set = record.set.iter().map(|assignment| format!(" {assignment}"));
    format!(
        "{} {}{}",
        record.scheme(),
        record.level,
        set.collect::<String>()
    )
}

/// The name of a run as the target of a link.
fn anchor(record: &Record) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() || ".=_".contains(c) {
            c
        } else {
            '-'
        }
    };
    format!(
        "run-{}",
        name(record).chars().map(plain).collect::<String>()
    )
}

pub(super) fn link(study: &CaseStudy, record: &Record) -> String {
    format!("{}#{}", file_of(study), anchor(record))
}

/// A count with its digits in groups of three.
fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_grouped() {
        assert_eq!(
            [0, 999, 1000, 1_234_567].map(grouped),
            ["0", "999", "1\u{2009}000", "1\u{2009}234\u{2009}567"]
        );
    }
}
