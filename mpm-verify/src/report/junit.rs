//! The verdicts in the format of JUnit, which continuous integration servers show.

use super::prelude::*;
use super::words::{demand, kind, outcome};
use crate::score::Scores;
use crate::score::gate::{Gate, INAPPLICABLE};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::time::Duration;

/// Writes `junit.xml` into `out`.
pub(super) fn write(summary: &Summary, out: &Path) -> Result<(), Error> {
    let path = out.join("junit.xml");
    write_whole(&path, text(summary).map_err(|e| Error::file(&path, e))?.as_bytes())
}

/// Writes the verdicts on results of another code. One that stands in the way of its gate is a failure.
///
/// # Errors
/// The file can't be written.
pub fn write_scored(scores: &Scores, gate: &Gate, file: &Path) -> Result<(), Error> {
    let mut suite = TestSuite::new(scores.case.name);
    for on in scores.judged() {
        let class = format!("{}.{}.{}", scores.case.name, scores.code, on.0);
        let judged = |verdict: &Verdict| match gate.stops(on.1, verdict) {
            true => test(&class, name(verdict), failure(outcome(verdict.outcome), &verdict.source)),
            false => test(&class, name(verdict), status(verdict)),
        };
        let lacking = |name: &str| test(&class, name.to_owned(), failure("not judged", INAPPLICABLE));
        suite.add_test_cases(on.1.iter().map(judged));
        suite.add_test_cases(gate.lacking(scores, &on).into_iter().map(lacking));
    }
    let mut report = Report::new("mpm-verify score");
    report.add_test_suite(suite);
    write_whole(file, report.to_string().map_err(|e| Error::file(file, e))?.as_bytes())
}

fn text(summary: &Summary) -> Result<String, quick_junit::SerializeError> {
    let mut report = Report::new("mpm-verify");
    report.add_test_suites(summary.cases.iter().map(suite));
    report.to_string()
}

fn suite(study: &CaseStudy) -> TestSuite {
    let mut suite = TestSuite::new(&*study.case);
    for record in &study.records {
        suite.add_test_cases(of_run(record));
    }
    let class = format!("{}.runs-together", study.case);
    suite.add_test_cases(study.verdicts.iter().map(|v| test(&class, name(v), status(v))));
    suite
}

/// The time of the run stands at its first test.
fn of_run(record: &Record) -> Vec<TestCase> {
    let mut class = format!("{}.{}.{}", record.case, record.scheme(), record.level);
    for assignment in &record.set {
        class.push('+');
        class.push_str(assignment);
    }
    let timed = |(k, verdict): (usize, &Verdict)| {
        let status = match record.error.as_ref().filter(|_| record.broke_down()) {
            Some(e) if verdict.failed() => told(NonSuccessKind::Error, &e.kind, &e.message),
            _ => status(verdict),
        };
        let mut test = test(&class, name(verdict), status);
        let seconds = if k == 0 { record.time.cpu_s } else { 0.0 };
        test.set_time(Duration::try_from_secs_f64(seconds).unwrap_or_default());
        test
    };
    record.verdicts.iter().enumerate().map(timed).collect()
}

/// A check may judge several metrics of a run.
fn name(verdict: &Verdict) -> String {
    format!("{} ({})", verdict.check, verdict.metric)
}

fn status(verdict: &Verdict) -> TestCaseStatus {
    let mut status = match verdict.outcome {
        Outcome::Right => return TestCaseStatus::success(),
        Outcome::Failed => TestCaseStatus::non_success(NonSuccessKind::Failure),
        // As other test runners tell of what is expected to fail.
        Outcome::WrongAsKnown | Outcome::NotJudged => TestCaseStatus::skipped(),
    };
    let (of, told) = match verdict.outcome {
        Outcome::NotJudged => (outcome(verdict.outcome), verdict.source.clone()),
        Outcome::WrongAsKnown => (outcome(verdict.outcome), format!("{}: {}", demand(verdict), verdict.source)),
        _ => (kind(verdict.kind), format!("{}: {}", demand(verdict), verdict.source)),
    };
    status.set_type(of).set_message(told);
    status
}

fn failure(of: &str, why: &str) -> TestCaseStatus {
    told(NonSuccessKind::Failure, of, why)
}

fn told(how: NonSuccessKind, of: &str, why: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(how);
    status.set_type(of).set_message(why);
    status
}

fn test(class: &str, name: String, status: TestCaseStatus) -> TestCase {
    let mut test = TestCase::new(name, status);
    test.set_classname(class);
    test
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{NASTY, summary};
    use quick_xml::escape::unescape;
    use quick_xml::events::Event;

    #[test]
    fn it_reads_back_with_every_verdict_and_its_outcome() {
        let summary = summary();
        let text = text(&summary).unwrap();
        let mut reader = quick_xml::Reader::from_str(&text);
        let (mut tests, mut failures, mut errors, mut skipped) = (0, 0, 0, 0);
        let mut messages = Vec::new();
        loop {
            match reader.read_event().unwrap() {
                Event::Start(e) | Event::Empty(e) => {
                    *match e.name().as_ref() {
                        "testcase" => &mut tests,
                        "failure" => &mut failures,
                        "error" => &mut errors,
                        "skipped" => &mut skipped,
                        _ => continue,
                    } += 1;
                    if let Some(message) = e.try_get_attribute("message").unwrap() {
                        messages.push(unescape(&message.value).unwrap().into_owned());
                    }
                }
                Event::Eof => break,
                _ => {}
            }
        }
        assert_eq!(tests, summary.verdicts().count());
        assert_eq!((failures, errors, skipped), (1, 1, 1));
        assert!(messages.iter().all(|m| m.contains(NASTY)), "{messages:?}");
    }

    #[test]
    fn the_same_summary_gives_the_same_text() {
        assert_eq!(text(&summary()).unwrap(), text(&summary()).unwrap());
    }
}
