//! The page of a case: its verdict in a sentence, a picture, errors by scheme and level, what they cost; the rest is
//! folded.

use super::{badge, figures, pair, sheet, verdict};
use crate::case::Case;
use crate::distinct;
use crate::draw::sketch;
use crate::metric::Quantity;
use crate::record::Record;
use crate::report::faults::{self, Fault};
use crate::report::price::Prices;
use crate::report::words::{kind, local_orders, made_by, number, order};
use crate::study::convergence::Convergence;
use crate::study::judge::outcome_of_run;
use crate::study::summary::CaseStudy;
use crate::table::Sheet;
use crate::verdict::{Kind, Outcome, Verdict};
use minijinja::{Value, context};
use std::path::Path;

pub(super) fn page(
    case: &Case,
    study: &CaseStudy,
    tier: &str,
    seeded: &[Fault],
    out: &Path,
) -> Value {
    let parameters = case.parameters.iter().map(|p| {
        let allowed = p.domain.to_string();
        [p.name, p.unit, p.default, &allowed, p.meaning]
            .map(str::to_owned)
            .into()
    });
    let parameters = Sheet::new(["name", "unit", "default", "allowed", "meaning"]).with(parameters);
    let metrics = case.metrics.iter();
    let metrics = metrics.map(|m| [m.name, m.unit, m.meaning].map(str::to_owned).into());
    let metrics = Sheet::new(["metric", "unit", "what it measures"]).with(metrics);
    let levels = case.levels.iter();
    let levels = levels.map(|l| context! { name => l.name, h => l.h.to_string() });
    let own = study.convergence.iter().filter(|c| c.set == case.ladder);
    let quantities = case.quantities.iter();
    let quantities = quantities.filter_map(|q| errors(case, q, own.clone()));
    let prices = Prices::of(study).into_iter().map(|prices| {
        context! { label => prices.label, target => prices.aim(), table => sheet(prices.table()) }
    });
    let failed = study
        .records
        .iter()
        .flat_map(|r| r.verdicts.iter().map(move |v| (Some(r), v)));
    let failed = failed.chain(study.verdicts.iter().map(|v| (None, v)));
    let failed = failed.filter(|(_, v)| v.failed()).map(|(r, v)| {
        let (href, name) = r.map_or_else(
            || ("#together".to_owned(), "runs together".to_owned()),
            |r| pair(study, r),
        );
        context! { href, name, verdict => verdict(v) }
    });
    let headings = case.headlines.iter().map(|h| h.title.clone());
    context! {
        tier,
        name => case.name,
        title => case.title,
        description => case.description,
        docs => super::docs(case.name, study),
        sentence => sentence(study),
        best => super::best(case, study),
        sketch => Value::from_safe_string(sketch::svg(&case.sketch, case.title)),
        sketch_caption => case.sketch.description,
        parameters => sheet(parameters),
        schemes => case.schemes().iter().map(ToString::to_string).collect::<Vec<_>>(),
        levels => levels.collect::<Vec<_>>(),
        references => case.references.clone(),
        made_by => made_by(study).to_vec(),
        pictures => figures(study, out),
        ladder => case.ladder.join(" "),
        errors => quantities.collect::<Vec<_>>(),
        prices => prices.collect::<Vec<_>>(),
        failed => failed.collect::<Vec<_>>(),
        headings => headings.collect::<Vec<_>>(),
        runs => study.records.iter().map(|r| run(case, study, r)).collect::<Vec<_>>(),
        checks => checks(case, study, seeded),
        faults => seeded.len(),
        together => study.verdicts.iter().map(verdict).collect::<Vec<_>>(),
        limits => case.limits.to_vec(),
        metrics => sheet(metrics),
    }
}

/// How the runs of a case came out, in a sentence.
fn sentence(study: &CaseStudy) -> String {
    let count = |outcome| {
        let runs = study.records.iter();
        runs.filter(|r| outcome_of_run(r) == outcome).count()
    };
    let all = study
        .records
        .iter()
        .flat_map(|r| &r.verdicts)
        .chain(&study.verdicts);
    let limits = all.filter(|v| v.outcome == Outcome::WrongAsKnown);
    let limits: Vec<&str> = distinct(limits.map(|v| &*v.check));
    let known = match limits.is_empty() {
        true => String::new(),
        false => format!(" Known limits seen: {}.", limits.join(", ")),
    };
    let all = match study.records.len() {
        1 => "Of one run,".to_owned(),
        several => format!("Of {several} runs,"),
    };
    format!(
        "{all} {} right, {} wrong as known, {} not judged, {} FAILED.{known}",
        count(Outcome::Right),
        count(Outcome::WrongAsKnown),
        count(Outcome::NotJudged),
        count(Outcome::Failed)
    )
}

/// A quantity, scheme by level, if there is any of it.
fn errors<'a>(
    case: &Case,
    quantity: &Quantity,
    own: impl Iterator<Item = &'a Convergence>,
) -> Option<Value> {
    let own: Vec<&Convergence> = own.filter(|c| c.metric == quantity.metric.name).collect();
    let mut levels = distinct(own.iter().flat_map(|c| &c.points).map(|p| &*p.level));
    levels.sort_by_key(|level| case.levels.iter().position(|l| l.name == *level));
    let row = |c: &&Convergence| {
        let value = |level: &&str| {
            let point = c.points.iter().find(|p| p.level == *level);
            point.map_or(String::new(), |p| number(Some(p.value)))
        };
        let cells = levels.iter().map(value);
        let scheme = std::iter::once(c.scheme.to_string());
        scheme
            .chain(cells)
            .chain([order(c), local_orders(c)])
            .collect()
    };
    let head = std::iter::once("scheme").chain(levels.iter().copied());
    let table = Sheet::new(head.chain(["order", "between levels"])).with(own.iter().map(row));
    (!own.is_empty()).then(|| context! { label => quantity.label, table => sheet(table) })
}

/// A run on a line: what decides its verdict, what the case shows of it, what it cost.
fn run(case: &Case, study: &CaseStudy, r: &Record) -> Value {
    let outcome = outcome_of_run(r);
    let deciding = r
        .verdicts
        .iter()
        .filter(|v| v.outcome == outcome && outcome != Outcome::Right);
    let deciding = deciding.filter(|v| v.judges() || v.failed());
    let why: Vec<&str> = distinct(deciding.map(|v| &*v.check));
    let why = match &r.error {
        Some(e) => format!("broke down at {} s", number(Some(e.time))),
        None => why.join(", "),
    };
    let (href, _) = pair(study, r);
    let values = case.headlines.iter().map(|h| h.of_run(r));
    context! {
        id => href.split('#').nth(1),
        scheme => r.scheme().to_string(),
        level => &r.level,
        set => r.set.join(" "),
        outcome => badge(outcome),
        why,
        values => values.collect::<Vec<_>>(),
        cpu => number(Some(r.time.cpu_s)),
    }
}

/// Every check with its outcomes and the number of seeded faults that it sees: those that the case declares, then those that every case has.
fn checks(case: &Case, study: &CaseStudy, seeded: &[Fault]) -> Vec<Value> {
    let all = || {
        study
            .records
            .iter()
            .flat_map(|r| &r.verdicts)
            .chain(&study.verdicts)
    };
    let undeclared =
        all().filter(|v| v.kind != Kind::Drift && !case.checks.iter().any(|c| c.name == v.check));
    let undeclared = distinct(undeclared.map(|v| (&*v.check, v.kind, &*v.source)));
    let declared = case.checks.iter().map(|c| (c.name, c.kind, c.statement));
    let row = |(name, of, statement): (&str, Kind, &str)| {
        let count = |outcome| {
            let own = |v: &&Verdict| v.check == name && v.outcome == outcome;
            all().filter(own).count()
        };
        let outcomes = [
            Outcome::Right,
            Outcome::WrongAsKnown,
            Outcome::NotJudged,
            Outcome::Failed,
        ];
        let counts = outcomes.map(count).to_vec();
        let faults = faults::seen(seeded, case.name, name);
        context! { name, kind => kind(of), statement, counts, faults }
    };
    declared.chain(undeclared).map(row).collect()
}
