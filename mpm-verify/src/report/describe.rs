//! Text for the terminal: lists, explanations, verdicts. Lines fit 100 columns; colours are for whoever prints to keep or
//! to drop.

use super::document::terminal::{WIDTH, cut, painted, wrapped};
use super::document::{Document, Text};
use super::prelude::*;
use super::words::quantity;
use crate::study::judge::exit_code;

/// Columns of the meaning of a metric, beside its name and value.
const MEANING: usize = 47;
/// Particle–node pairs that a core visits in a second, roughly: 1.5·10⁸ to 1.5·10⁹, by dimension, basis and remedy.
const PAIRS_PER_SECOND: f64 = 8e8;

/// The cases, a line each: what they are, how many runs each tier has, and what the runs of tier pr cost as far as
/// `pairs` gives their particle–node pairs; with a tier, its runs.
#[must_use]
pub fn list_text(cases: &[Case], tier: Option<Tier>, pairs: impl Fn(&str) -> Option<u64>) -> String {
    if let Some(tier) = tier {
        let line = |case: &Case, spec: RunSpec| format!("{} {}\n", case.name, spec.folder());
        return cases.iter().flat_map(|case| case.runs(tier).into_iter().map(move |spec| line(case, spec))).collect();
    }
    let [quick, pr, nightly, long] = Tier::NAMES;
    let mut t = format!("{:20} {:38} {quick:>5} {pr:>4} {nightly:>7} {long:>5}  CPU of pr\n", "case", "what it is",);
    for case in cases {
        let [quick, pr, nightly, long] = Tier::ALL.map(|tier| case.runs(tier).len());
        let cost = pairs(case.name)
            .filter(|n| *n > 0)
            .map_or_else(|| number(None), |n| format!("{:>5.0} s", (n as f64 / PAIRS_PER_SECOND).ceil()));
        let title = cut(case.title, 38);
        let _ = writeln!(t, "{:20} {title:38} {quick:>5} {pr:>4} {nightly:>7} {long:>5}  {cost:>9}", case.name);
    }
    t + "\nRuns by tier; each has those of the tiers before it. CPU time is estimated from the goldens' counts.\n\
         `list --tier TIER` names its runs, `explain CASE` says all about a case, `run CASE` runs it.\n"
}

/// The same as JSON.
#[must_use]
pub fn list_json(cases: &[Case], tier: Option<Tier>) -> Value {
    let entry = |case: &Case| {
        let mut entry = json!({
            "case": case.name,
            "title": case.title,
            "levels": case.levels.iter().map(|l| l.name).collect::<Vec<_>>(),
            "schemes": case.schemes(),
        });
        if let Some(tier) = tier {
            let runs = case.runs(tier).into_iter();
            entry["tier"] = json!(tier.to_string());
            entry["runs"] = runs.map(|s| json!({"scheme": s.scheme, "level": s.level.name, "set": s.set})).collect();
        }
        entry
    };
    cases.iter().map(entry).collect()
}

/// Everything about a case.
#[must_use]
pub fn explain(case: &Case) -> String {
    let mut document = Document::new(format!("{}: {}", case.name, case.title));
    document.paragraph(case.description);
    let mut list = |title: &str, entries: Vec<Text>| {
        document.section("", title);
        document.list(entries);
    };
    let parameters = case.parameters.iter().map(|p| {
        let allowed = format!("default {}, allowed {}", p.default, p.domain);
        Text::from(format!("{} ({})  {allowed}", p.name, p.unit)).then_below(p.meaning)
    });
    list("Parameters (--set name=value)", parameters.collect());
    let names: Vec<String> = case.schemes().iter().map(ToString::to_string).collect();
    let lines = names.chunks(2).map(|pair| match pair {
        [first, second] => format!("{first:40}  {second}").into(),
        rest => rest.concat().into(),
    });
    list("Schemes (--scheme NAME, or its parts: --basis, --remedy, --transfer)", lines.collect());
    let levels = case.levels.iter().map(|l| format!("{}  cells of {} m", l.name, l.h).into());
    list("Levels (--level L)", levels.collect());
    let metrics = case.metrics.iter().map(|m| format!("{} ({})  {}", m.name, m.unit, m.meaning).into());
    list("Metrics", metrics.collect());
    let wanted = case.wanted.iter().map(|w| format!("{}  {}; judged by {}", w.name, w.statement, w.names()).into());
    list("Wanted (a run is right only if each is right)", wanted.collect());
    let checks = case.checks.iter().map(|c| format!("{} [{}]  {}", c.name, kind(c.kind), c.statement).into());
    list("Checks", checks.collect());
    list("References", case.references.iter().map(|reference| reference.as_str().into()).collect());
    list("Limits", case.limits.iter().map(|&limit| limit.into()).collect());
    document.terminal()
}

/// The same as JSON.
#[must_use]
pub fn explain_json(case: &Case) -> Value {
    let parameters = case.parameters.iter().map(|p| {
        let allowed = p.domain.to_string();
        json!({"name": p.name, "unit": p.unit, "default": p.default, "allowed": allowed, "meaning": p.meaning})
    });
    json!({
        "case": case.name,
        "title": case.title,
        "description": case.description,
        "parameters": parameters.collect::<Value>(),
        "schemes": case.schemes(),
        "levels": case.levels,
        "metrics": case.metrics,
        "wanted": case.wanted,
        "checks": case.checks,
        "references": case.references,
        "limits": case.limits,
    })
}

/// One verdict: outcome, check, metric and demand; where it is not right, why.
pub(crate) fn verdict_line(v: &Verdict) -> String {
    let name = format!("{:14}", outcome(v.outcome));
    let told = match v.kind {
        Kind::Truth | Kind::KnownLimit => v.check.clone(),
        other => format!("{} [{}]", v.check, kind(other)),
    };
    let line = match v.outcome {
        Outcome::Failed if v.check == "completes" => told,
        _ if v.is_wanted() => format!("{told:24} {}", v.source),
        Outcome::NotJudged => format!("{told:24} {}", v.metric),
        _ => format!("{told:24} {} = {}", v.metric, demand(v)),
    };
    let line = wrapped(&line, &format!("{name}  "), &" ".repeat(18));
    let rest = line.strip_prefix(&name).unwrap_or(&line);
    let why = match v.outcome == Outcome::Right || v.is_wanted() {
        true => String::new(),
        false => wrapped(&v.source, &" ".repeat(18), &" ".repeat(18)),
    };
    format!("{}{rest}{why}", painted(v.outcome, &name))
}

/// The metrics of a run, in the order of its case, and the verdicts on it; of bookkeeping its failures, and what holds on
/// one line.
pub(super) fn found(case: &Case, r: &Record) -> String {
    let mut t = String::new();
    for m in &case.metrics {
        if let Some(measured) = r.metrics.get(m.name) {
            let value = quantity(measured.value, &measured.unit);
            let meaning = cut(m.meaning, MEANING);
            let line = format!("  {:26} {value:>20}   {meaning}", m.name);
            let _ = writeln!(t, "{}", line.trim_end());
        }
    }
    t += "\n";
    t.extend(r.verdicts.iter().filter(|v| v.kind != Kind::Bookkeeping || v.failed()).map(verdict_line));
    let counted = r.verdicts.iter().filter(|v| v.kind == Kind::Bookkeeping && !v.failed());
    let counted: Vec<&str> = counted.map(|v| &*v.check).collect();
    if !counted.is_empty() {
        let _ = writeln!(t, "{:14}  {} hold", "bookkeeping", counted.join(", "));
    }
    t
}

/// A run: its metrics in the order of its case, its verdicts, and the verdict on it in one line at the end.
#[must_use]
pub fn record(case: &Case, r: &Record) -> String {
    let set: String = r.set.iter().map(|assignment| format!("  {assignment}")).collect();
    let mut t = format!("{}  {}  {}{set}\n", r.case, r.scheme(), r.level);
    let _ = writeln!(
        t,
        "  {} particles, {} steps, {:.1} s, {:.0} ns per particle and step\n",
        r.work.particles,
        r.work.steps,
        r.time.wall_s,
        1e9 * r.time.wall_s / r.work.particle_steps.max(1) as f64
    );
    t += &found(case, r);
    if let Some(e) = &r.error {
        t += &wrapped(&e.message, "", "");
    }
    t + "\n" + &run_line(r)
}

/// The outcome of a run, in its colour.
#[must_use]
pub fn outcome_word(r: &Record) -> String {
    let of = outcome_of_run(r);
    painted(of, outcome(of))
}

/// The verdict on a run, in one line.
#[must_use]
pub fn run_line(r: &Record) -> String {
    format!("Verdict: {}\n", painted(outcome_of_run(r), &cut(&sentence(r), WIDTH - 9)))
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

/// Failures of a verification: checks, drift, unknown breakdowns.
#[must_use]
pub fn failures(summary: &Summary) -> String {
    let mut t = String::new();
    for (study, record, verdict) in summary.verdicts().filter(|(_, _, v)| v.misses_the_truth()) {
        let run = record.map_or_else(|| "runs together".to_owned(), Record::folder);
        let _ = writeln!(t, "{} {run}", study.case);
        t += &verdict_line(verdict);
    }
    for record in summary.records() {
        let drifting: Vec<&Verdict> = record.verdicts.iter().filter(|v| v.drifts()).collect();
        let worst = drifting.iter().max_by(|a, b| relative_difference(a).total_cmp(&relative_difference(b)));
        let name = format!("{} {}", record.case, record.folder());
        if let Some(worst) = worst {
            let count = drifting.len();
            let differ = format!("{name}: {count} values differ from the golden, most of all {}", drift_line(worst));
            t += &painted(Outcome::Failed, "FAILED [DRIFT]");
            t += &wrapped(&differ, " ", "  ");
        }
        if let Some(e) = record.error.as_ref().filter(|_| record.broke_down()) {
            t += &painted(Outcome::Failed, "BROKE DOWN");
            t += &wrapped(&format!("{name}: {}", e.message), " ", "  ");
        }
    }
    t
}

/// Findings of a verification: failures first, then counts, at the end the verdict in one line.
#[must_use]
pub fn verification(summary: &Summary) -> String {
    let mut t = failures(summary);
    let _ = writeln!(t, "{}", summary.counts);
    for command in bless_commands(summary) {
        let _ = writeln!(t, "If the drift is meant: {command}");
    }
    t + &verification_line(summary)
}

/// The verdict on a verification, in one line.
#[must_use]
pub fn verification_line(summary: &Summary) -> String {
    let c = summary.counts;
    let (of, what) = match summary.exit_code() {
        ExitCode::Good => {
            (Outcome::Right, format!("nothing failed; {} of {} runs are wrong as known", c.wrong_as_known_runs, c.runs))
        }
        ExitCode::Drift => {
            (Outcome::Failed, format!("FAILED: {} values have drifted from the goldens; no check failed", c.drifted))
        }
        _ => (Outcome::Failed, format!("FAILED: {} of {} runs, {} checks", c.failed_runs, c.runs, summary.failures())),
    };
    format!("Verdict: {}\n", painted(of, &what))
}

/// Findings of a verification, as JSON: its counts, and each run that did not end well.
#[must_use]
pub fn verification_json(summary: &Summary) -> Value {
    let failed = summary.records().filter(|r| exit_code(r) as u8 != 0);
    let failed = failed.map(|r| json!({"case": r.case, "run": r.folder(), "verdict": sentence(r)}));
    json!({
        "tier": summary.tier,
        "exit_code": summary.exit_code() as u8,
        "counts": summary.counts,
        "failed_runs": failed.collect::<Value>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::check::Finding;
    use crate::problem::measured;
    use crate::record::fixture::record as run;
    use crate::report::fixture;

    /// Columns of a line, without its colours.
    fn columns(line: &str) -> usize {
        let mut plain = Vec::new();
        let mut stream = anstream::StripStream::new(&mut plain);
        std::io::Write::write_all(&mut stream, line.as_bytes()).unwrap();
        textwrap::core::display_width(&String::from_utf8(plain).unwrap())
    }

    #[test]
    fn lines_fit() {
        let mut texts = vec![list_text(cases::all(), None, |_| Some(10))];
        for case in cases::all() {
            texts.push(explain(case));
            let long = "a reason ".repeat(30);
            let checks = [Kind::Truth, Kind::KnownLimit, Kind::Regression].map(|kind| {
                let limit = Finding::above("log_jacobian_gap_rms", 2.0, 1.0, long.clone());
                limit.verdict("creep-grows-as-dt-falls", kind)
            });
            let mut own = run("h2", checks.to_vec());
            for m in &case.metrics {
                own.metrics.extend([measured((*m, -1.234_567e-9))]);
            }
            texts.push(record(case, &own));
        }
        texts.push(failures(&fixture::summary()));
        for line in texts.iter().flat_map(|text| text.lines()) {
            assert!(columns(line) <= WIDTH, "{line}");
        }
    }

    #[test]
    fn a_run_ends_with_its_verdict() {
        let limit = Finding::above("m", 2.0, 1.0, "it makes energy").verdict("makes-energy", Kind::KnownLimit);
        let exact = Finding::within("m", 1.0, 1.0, 0.0, "").verdict("exact", Kind::Truth);
        let cook = cases::find("cook").unwrap();
        let text = record(cook, &run("h2", vec![exact, limit]));
        assert!(text.contains("it makes energy"), "{text}");
        let last = text.lines().last().unwrap();
        assert!(last.contains("wrong as known: makes-energy; 1 check right"), "{last}");
    }
}
