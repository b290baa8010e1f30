//! Text for the terminal: lists, explanations, verdicts.

use crate::accuracy::Order;
use crate::case::{Case, Tier};
use crate::metric::Headline;
use crate::record::{Record, Status};
use crate::results::fixed;
use crate::study::convergence::Convergence;
use crate::study::summary::{CaseStudy, Summary};
use crate::verdict::{Kind, Outcome, Verdict};
use serde_json::{Value, json};
use std::fmt::Write;

/// What made the runs of a case: the program, the night and the commit, as far as they are known.
#[must_use]
pub fn made_by(study: &CaseStudy) -> [String; 3] {
    let program = study
        .program()
        .map(|v| format!("mpm-verify {}, source {}", v.mpm_verify, v.source));
    let night = study.night.as_ref();
    [
        program,
        night.map(|n| n.date.to_string()),
        night.map(|n| n.commit.clone()),
    ]
    .map(|known| known.unwrap_or_else(|| "–".to_owned()))
}

/// The cases as text, with the runs of a tier if one is given.
#[must_use]
pub fn list_text(cases: &[Case], tier: Option<Tier>) -> String {
    let mut text = String::new();
    for case in cases {
        let levels: Vec<&str> = case.levels.iter().map(|l| l.name).collect();
        let _ = writeln!(text, "{}  {}", case.name, case.title);
        let _ = writeln!(text, "  levels: {}", levels.join(" "));
        match tier {
            None => {
                let _ = writeln!(text, "  schemes:");
                for scheme in case.schemes() {
                    let _ = writeln!(text, "    {scheme}");
                }
            }
            Some(tier) => {
                let _ = writeln!(text, "  runs of tier {tier}:");
                for spec in case.runs(tier) {
                    let _ = writeln!(text, "    {}", spec.folder());
                }
            }
        }
    }
    text
}

/// The same as JSON.
#[must_use]
pub fn list_json(cases: &[Case], tier: Option<Tier>) -> String {
    let cases: Vec<Value> = cases
        .iter()
        .map(|case| {
            let mut entry = json!({
                "case": case.name,
                "title": case.title,
                "levels": case.levels.iter().map(|l| l.name).collect::<Vec<_>>(),
                "schemes": case.schemes(),
            });
            if let Some(tier) = tier {
                entry["tier"] = json!(tier.to_string());
                entry["runs"] = case
                    .runs(tier)
                    .iter()
                    .map(|s| json!({"scheme": s.scheme, "level": s.level.name, "set": s.set}))
                    .collect();
            }
            entry
        })
        .collect();
    format!("{:#}\n", Value::Array(cases))
}

/// Everything about a case.
#[must_use]
pub fn explain(case: &Case) -> String {
    let mut t = format!("{}: {}\n\n{}\n", case.name, case.title, case.description);
    let _ = writeln!(t, "\nParameters (--set name=value)");
    for p in &case.parameters {
        let _ = writeln!(
            t,
            "  {} ({})  default {}, allowed {}\n      {}",
            p.name, p.unit, p.default, p.domain, p.meaning
        );
    }
    let _ = writeln!(
        t,
        "\nSchemes (--solver S --basis B --remedy R --transfer T)"
    );
    for s in case.schemes() {
        let _ = writeln!(
            t,
            "  --solver {} --basis {} --remedy {} --transfer {}",
            s.solver(),
            s.basis(),
            s.remedy(),
            s.transfer()
        );
    }
    let _ = writeln!(t, "\nLevels (--level L)");
    for l in &case.levels {
        let _ = writeln!(t, "  {}  cells of {} m", l.name, l.h);
    }
    let _ = writeln!(t, "\nMetrics");
    for m in &case.metrics {
        let _ = writeln!(t, "  {} ({})  {}", m.name, m.unit, m.meaning);
    }
    let _ = writeln!(t, "\nChecks");
    for c in &case.checks {
        let _ = writeln!(t, "  {} [{}]  {}", c.name, kind(c.kind), c.statement);
    }
    let _ = writeln!(t, "\nReferences");
    for r in &case.references {
        let _ = writeln!(t, "  {r}");
    }
    let _ = writeln!(t, "\nLimits");
    for l in case.limits {
        let _ = writeln!(t, "  {l}");
    }
    t
}

/// Name of a kind of check.
#[must_use]
pub fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Truth => "TRUTH",
        Kind::KnownLimit => "known limit",
        Kind::Drift => "DRIFT",
        Kind::Bookkeeping => "bookkeeping",
    }
}

/// Outcome of a verdict in a word or two.
#[must_use]
pub fn outcome(verdict: &Verdict) -> &'static str {
    match verdict.outcome {
        Outcome::Right => "right",
        Outcome::WrongAsKnown => "wrong as known",
        Outcome::NotJudged => "not judged",
        Outcome::Failed => "FAILED",
    }
}

/// A number of a verdict, or a dash.
#[must_use]
pub fn number(value: Option<f64>) -> String {
    match value {
        None => "–".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(x) if (1e-3..1e5).contains(&x.abs()) => {
            let text = format!("{x:.6}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        Some(x) => format!("{x:.3e}"),
    }
}

/// The observed order, of an error with its uncertainty (95 %), or a dash.
#[must_use]
pub fn order(c: &Convergence) -> String {
    match (&c.order, &c.extrapolation) {
        (Some(o), _) => o.to_string(),
        (None, Some(r)) => format!("{:.2}", r.order),
        (None, None) => number(None),
    }
}

/// The orders of an error between successive levels, or a dash.
#[must_use]
pub fn local_orders(c: &Convergence) -> String {
    c.order
        .as_ref()
        .map_or_else(|| number(None), Order::between)
}

/// A cell of the table of results, or a dash.
#[must_use]
pub fn headline(record: &Record, headline: &Headline) -> String {
    let format = fixed(headline.decimals).times(headline.factor);
    format.text(record.metric(headline.metric))
}

/// One verdict on a line.
#[must_use]
pub fn verdict_line(v: &Verdict) -> String {
    format!(
        "{:14} [{}] {}: {} = {} (reference {}, tolerance {}) {}",
        outcome(v),
        kind(v.kind),
        v.check,
        v.metric,
        number(v.value),
        number(v.reference),
        number(v.tolerance),
        v.source
    )
}

/// A run: metrics and verdicts.
#[must_use]
pub fn record(r: &Record) -> String {
    let mut t = format!(
        "{} {} {} {}\n",
        r.case,
        r.scheme(),
        r.level,
        r.set.join(" ")
    );
    if let Some(e) = &r.error {
        let _ = writeln!(t, "FAILED ({}): {}", e.kind, e.message);
    }
    for (name, metric) in &r.metrics {
        let _ = writeln!(t, "  {name} = {} {}", number(metric.value), metric.unit);
    }
    let _ = writeln!(
        t,
        "  {} particles, {} steps, {:.1} s, {:.0} ns per particle and step",
        r.work.particles,
        r.work.steps,
        r.time.wall_s,
        1e9 * r.time.wall_s / r.work.particle_steps.max(1) as f64
    );
    for v in &r.verdicts {
        let _ = writeln!(t, "{}", verdict_line(v));
    }
    t
}

/// How far a result is from its golden, relative to it; infinite where there is nothing to compare.
fn relative_difference(verdict: &Verdict) -> f64 {
    match (verdict.value, verdict.reference) {
        (Some(now), Some(golden)) => (now - golden).abs() / golden.abs().max(f64::MIN_POSITIVE),
        _ => f64::INFINITY,
    }
}

/// A verdict on drift: what was, what is, and by how much it differs.
#[must_use]
pub fn drift_line(v: &Verdict) -> String {
    match (v.value, v.reference) {
        (Some(now), Some(golden)) => format!(
            "{}: golden {golden}, now {now}, difference {:.3e} where {} is allowed",
            v.metric,
            now - golden,
            number(v.tolerance)
        ),
        _ => format!("{}: {}", v.metric, v.source),
    }
}

/// What a verification found: failures first, then counts.
#[must_use]
pub fn verdict_summary(summary: &Summary) -> String {
    let mut t = String::new();
    for (study, record, verdict) in summary.verdicts().filter(|(_, _, v)| v.misses_the_truth()) {
        let run = record.map_or_else(String::new, |r| {
            format!("{} {} {} ", r.scheme(), r.level, r.set.join(" "))
        });
        let _ = writeln!(t, "{} {run}{}", study.case, verdict_line(verdict));
    }
    for record in summary.cases.iter().flat_map(|c| &c.records) {
        let drifting: Vec<&Verdict> = record.verdicts.iter().filter(|v| v.drifts()).collect();
        let worst = drifting
            .iter()
            .max_by(|a, b| relative_difference(a).total_cmp(&relative_difference(b)));
        if let Some(worst) = worst {
            let _ = writeln!(
                t,
                "FAIL [DRIFT] {} {}: {} compared with the golden differ, the most {}",
                record.case,
                record.folder(),
                drifting.len(),
                drift_line(worst)
            );
        }
        if let (Status::Failed, Some(e)) = (record.status, &record.error) {
            let _ = writeln!(
                t,
                "{} {} {}: {}",
                record.case,
                record.scheme(),
                record.level,
                e.message
            );
        }
    }
    let _ = writeln!(t, "{}", summary.counts);
    for command in bless_commands(summary) {
        let _ = writeln!(t, "If the drift is meant: {command}");
    }
    t
}

/// The commands that accept the drift of each case that has drifted and misses no truth.
#[must_use]
pub fn bless_commands(summary: &Summary) -> Vec<String> {
    let meets = |name: &str, test: fn(&Verdict) -> bool| {
        summary
            .verdicts()
            .any(|(study, _, v)| study.case == name && test(v))
    };
    let cases = summary.cases.iter().map(|study| study.case.as_str());
    cases
        .filter(|case| meets(case, Verdict::drifts) && !meets(case, Verdict::misses_the_truth))
        .map(|case| format!("mpm-verify bless {case} --reason \"why the results have changed\""))
        .collect()
}
