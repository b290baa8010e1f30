//! The verdicts in the format of JUnit, which continuous integration servers show.

use super::prelude::*;
use crate::score::Scores;
use crate::score::gate::{Gate, INAPPLICABLE};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::time::Duration;

/// Writes `junit.xml` into `out`.
pub(super) fn write(summary: &Summary, out: &Path) -> Result<(), Error> {
    write_suites("mpm-verify", summary.cases.iter().map(suite), &out.join("junit.xml"))
}

fn write_suites(name: &str, suites: impl IntoIterator<Item = TestSuite>, file: &Path) -> Result<(), Error> {
    let mut report = Report::new(name);
    report.add_test_suites(suites);
    write_whole(file, report.to_string().map_err(|e| Error::file(file, e))?.as_bytes())
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
    write_suites("mpm-verify score", [suite], file)
}

fn suite(study: &CaseStudy) -> TestSuite {
    let mut suite = TestSuite::new(&*study.case);
    suite.add_test_cases(study.records.iter().flat_map(of_run));
    let class = format!("{}.runs-together", study.case);
    suite.add_test_cases(study.verdicts.iter().map(|v| test(&class, name(v), status(v))));
    suite
}

/// The time of the run stands at its first test.
fn of_run(record: &Record) -> Vec<TestCase> {
    let class = format!("{}.{}", record.case, record.folder().replacen('/', ".", 1));
    let timed = |(k, verdict): (usize, &Verdict)| {
        let status = match record.error.as_ref().filter(|_| record.broke_down()) {
            Some(e) if verdict.failed() => {
                told(TestCaseStatus::non_success(NonSuccessKind::Error), &e.kind, &e.message)
            }
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
    let (of, why) = (outcome(verdict.outcome), format!("{}: {}", demand(verdict), verdict.source));
    match verdict.outcome {
        Outcome::Right => TestCaseStatus::success(),
        Outcome::Failed => failure(kind(verdict.kind), &why),
        // As other test runners tell of what is expected to fail.
        Outcome::WrongAsKnown => told(TestCaseStatus::skipped(), of, &why),
        Outcome::NotJudged => told(TestCaseStatus::skipped(), of, &verdict.source),
    }
}

fn failure(of: &str, why: &str) -> TestCaseStatus {
    told(TestCaseStatus::non_success(NonSuccessKind::Failure), of, why)
}

fn told(mut status: TestCaseStatus, of: &str, why: &str) -> TestCaseStatus {
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

    fn text(summary: &Summary) -> String {
        let folder = tempfile::tempdir().unwrap();
        write(summary, folder.path()).unwrap();
        std::fs::read_to_string(folder.path().join("junit.xml")).unwrap()
    }

    #[test]
    fn it_reads_back_with_every_verdict_and_its_outcome() {
        let summary = summary();
        let text = text(&summary);
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
        assert_eq!(text(&summary()), text(&summary()));
    }
}
