//! Results that lack columns, and gates that ask for them.

use super::*;
use crate::error::ExitCode;
use crate::report::junit::write_scored;
use crate::score::gate::Gate;

const BASE: &str = "base_pressure (-)";

/// A result for the column without some columns of its series.
fn without(lost: &[&str]) -> Scores {
    let result = Answer::of_column();
    lost.iter().for_each(|column| result.change(column, None));
    result.scores().unwrap()
}

pub(super) fn gate(strict: bool, require: &[&str]) -> Gate {
    Gate { strict, require: require.iter().map(|name| (*name).to_owned()).collect() }
}

#[test]
fn a_result_of_which_nothing_wanted_is_judged_does_not_pass() {
    let both = &[SETTLED, BASE][..];
    for (lost, strict, require, refusal) in [
        (&[][..], false, &[][..], None),
        (&[], true, &["settlement", "base-pressure"], None),
        (both, false, &[], Some("settlement (settlement: missing: settlement (-) of the series); pressure (base-p")),
        (&[BASE], false, &[], None),
        (&[BASE], false, &["settlement"], None),
        (&[BASE], true, &[], Some("pressure (base-pressure: missing: base_pressure (-) of the series)")),
        (&[BASE], false, &["base-pressure"], Some("base-pressure, base_pressure_error (missing: base_pressure (-) of")),
        (&[], false, &["water"], Some("water (it does not apply to this result)")),
    ] {
        let (gate, scored) = (gate(strict, require), without(lost));
        let found = gate.refusal(&scored);
        match refusal {
            None => assert_eq!(found, None, "{lost:?} {require:?}"),
            Some(why) => {
                let found = found.unwrap_or_default();
                assert!(found.contains(&format!("Not passed: not judged: {why}")), "{found}");
            }
        }
        let code = if refusal.is_some() { ExitCode::TruthFailed } else { ExitCode::Good };
        assert_eq!(gate.exit_code(&scored), code, "{lost:?} {require:?}");
    }
}

#[test]
fn names_of_checks_are_those_of_the_case() {
    let case = find_scored("consolidation").unwrap().0;
    assert!(gate(false, &["settlement", "pressure", "base-pressure"]).known_to(case).is_ok());
    // A known limit of our schemes is no demand on another code.
    for (unknown, nearest) in [("settelment", "settlement"), ("logarithm-loses-water", "")] {
        let said = gate(false, &[unknown]).known_to(case).unwrap_err().to_string();
        let begin = format!("--require: unknown check of consolidation \"{unknown}\"; allowed: settlement, pressure");
        assert!(said.starts_with(&begin) && said.contains(&format!("; the nearest is {nearest}")), "{said}");
    }
}

#[test]
fn junit_has_what_stands_in_the_way_as_a_failure() {
    let junit = |lost: &[&str], gate: &Gate| {
        let file = tempfile::NamedTempFile::new().unwrap();
        write_scored(&without(lost), gate, file.path()).unwrap();
        let text = fs::read_to_string(file.path()).unwrap();
        ["<testcase", "<failure", "<skipped"].map(|part| text.matches(part).count())
    };
    assert_eq!(junit(&[], &gate(false, &[])), [4, 0, 0]);
    assert_eq!(junit(&[], &gate(false, &["water"])), [5, 1, 0]);
    assert_eq!(junit(&[BASE], &gate(false, &[])), [4, 0, 2]);
    assert_eq!(junit(&[BASE], &gate(true, &[])), [4, 1, 1]);
    assert_eq!(junit(&[BASE], &gate(false, &["base-pressure"])), [4, 1, 1]);
}
