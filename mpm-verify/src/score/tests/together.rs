//! Several runs in one manifest: each by itself, and those of one method together, as ours are.

use super::*;
use crate::error::ExitCode;
use crate::report::scored::{beside, json, text, verdict, write};
use crate::score::gate::Gate;
use crate::study::judge::judge;

/// Cells (m) of the levels of the beam.
const LEVELS: [&str; 3] = ["h0.1", "h0.05", "h0.025"];

/// Particles of the beam whose corner is off its reference by this share, in the form that a code gives.
fn beam(level: &str, error: f64) -> (Answer, String) {
    let result = Answer::exported("cantilever", level, &[]);
    let start = Table::read(&result.path("start.csv")).unwrap();
    let record = |value: f64| {
        let columns = [("reference_x (m)", 0.0), ("reference_y (m)", 0.0), ("ux (m)", 0.0), ("uy (m)", value)];
        let columns = columns.map(|(head, value)| {
            let own = start.get(head).map_or_else(|| vec![value; start.rows()], <[f64]>::to_vec);
            (head, own)
        });
        Table::of_columns(columns).write(&result.path("particles.csv")).unwrap();
        result.score().unwrap().record
    };
    // The deflection of all particles is that of the corner.
    let corner = record(-0.1).verdicts.iter().find(|v| v.check == "corner").and_then(|v| v.reference).unwrap();
    record(corner * (1.0 + error));
    let table = result.text("particles.csv");
    (result, table)
}

/// A manifest of the beam at three levels, with errors of the corner as shares of its deflection, and `change` of its text.
pub(super) fn levels(errors: [f64; 3], change: impl Fn(&mut Value)) -> Answer {
    let result = Answer::exported("cantilever", "h0.1", &[]);
    let runs = LEVELS.iter().zip(errors).map(|(level, error)| {
        fs::create_dir(result.path(level)).unwrap();
        let particles = format!("{level}/particles.csv");
        fs::write(result.path(&particles), beam(level, error).1).unwrap();
        json!({"level": level, "particles": particles})
    });
    result.list(runs);
    result.edit(change);
    result
}

/// Outcomes of a check on runs together.
fn outcomes_of(scores: &Scores, check: &str) -> Vec<(String, Outcome)> {
    let all = scores.together.iter().flat_map(|(_, study)| &study.verdicts);
    all.filter(|v| v.check == check).map(|v| (v.metric.clone(), v.outcome)).collect()
}

#[test]
fn runs_at_several_levels_show_an_order_and_are_judged_as_ours() {
    let result = levels([4e-3, 1e-3, 2.5e-4], |_| ());
    let scores = result.scores().unwrap();
    assert_eq!(
        scores.runs.iter().map(Scored::name).collect::<Vec<_>>(),
        ["run 1 (h0.1)", "run 2 (h0.05)", "run 3 (h0.025)"]
    );
    let (names, study) = &scores.together[0];
    assert_eq!((scores.together.len(), &**names), (1, "run 1 (h0.1), run 2 (h0.05), run 3 (h0.025)"));
    let falls = outcomes_of(&scores, "falls");
    // The errors of the stress are not given.
    for (error, outcome) in [("corner_error", Outcome::Right), ("stress_error", Outcome::NotJudged)] {
        let own = falls.iter().filter(|(metric, _)| metric.contains(error));
        assert_eq!(own.map(|(_, outcome)| *outcome).collect::<Vec<_>>(), [outcome; 2]);
    }
    let missing = study.verdicts.iter().find(|v| v.outcome == Outcome::NotJudged).unwrap();
    assert!(missing.source.contains("missing: stress_xx (Pa) of the particles"), "{}", missing.source);
    let order = study.convergence.iter().find(|c| c.metric == "corner_error").unwrap();
    assert!((order.order.as_ref().unwrap().order - 2.0).abs() < 1e-6, "{order:?}");
    // Through the same functions as records of our own.
    let case = scores.case;
    let mut ours: Vec<Record> = scores.runs.iter().map(|run| run.record.clone()).collect();
    ours.iter_mut().for_each(|record| record.verdicts = judge(case, record));
    for verdict in study.verdicts.iter().filter(|v| v.outcome == Outcome::Right) {
        assert!(case.judge_study(&ours).contains(verdict), "{verdict:?}");
    }
    assert_eq!(gate::gate(false, &[]).exit_code(&scores), ExitCode::Good);
}

#[test]
fn errors_that_do_not_fall_fail_with_all_runs_right() {
    let scores = levels([1e-3, 2e-3, 4e-4], |_| ()).scores().unwrap();
    let falls = outcomes_of(&scores, "falls");
    assert_eq!([falls[0].1, falls[2].1], [Outcome::Failed, Outcome::Right], "{falls:?}");
    let right = |run: &Scored| outcomes(run).iter().all(|(_, outcome)| *outcome != Outcome::Failed);
    assert!(scores.runs.iter().all(right));
    assert_eq!(gate::gate(false, &[]).exit_code(&scores), ExitCode::TruthFailed);
    let said = verdict(&scores);
    assert!(said.contains("cantilever runs together\n") && said.contains("FAILED: 0 of 3 runs, 1 checks"), "{said}");
}

#[test]
fn the_worst_run_counts_and_is_named() {
    let result = levels([4e-3, 1e-3, 0.5], |_| ());
    let scores = result.scores().unwrap();
    let gate = gate::gate(false, &[]);
    assert_eq!(gate.exit_code(&scores), ExitCode::TruthFailed);
    let said = verdict(&scores);
    assert!(said.contains("FAILED: 1 of 3 runs") && said.contains("run 3 (h0.025): FAILED: corner"), "{said}");
    let ours = beside(&scores).unwrap();
    let told = text(&scores, &ours);
    for part in ["cantilever run 1 (h0.1): my code", "run 3 (h0.025) together", "corner_error", "between", "falls"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    write(&scores, &ours, &gate, &result.path("")).unwrap();
    let page = result.text("score.md");
    for part in [
        "## cantilever run 1 (h0.1): my code",
        "## cantilever run 2 (h0.05): my code",
        "| quantity | h0.1 | h0.05 | h0.025 | order |",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    let all = json(&scores, &ours, &gate);
    assert_eq!((&all["exit_code"], &all["counts"]["failed_runs"]), (&json!(1), &json!(1)));
    assert_eq!((all["runs"].as_array().unwrap().len(), all["runs"][2]["outcome"].clone()), (3, json!("failed")));
    assert_eq!(all["together"][0]["convergence"][0]["points"].as_array().unwrap().len(), 3);
    let file = result.path("junit.xml");
    crate::report::junit::write_scored(&scores, &gate, &file).unwrap();
    let junit = fs::read_to_string(file).unwrap();
    assert!(
        junit.contains("classname=\"cantilever.my code.run 3 (h0.025)\"") && junit.contains("together\""),
        "{junit}"
    );
}

#[test]
fn a_gate_may_ask_for_checks_on_runs_together() {
    let require = |name: &str| gate::gate(false, &[name]);
    let refused = |gate: &Gate, scores: &Scores| gate.refusal(scores).unwrap_or_default();
    let scores = levels([4e-3, 1e-3, 2.5e-4], |_| ()).scores().unwrap();
    assert!(require("falls").known_to(scores.case).is_ok());
    let said = refused(&require("falls"), &scores);
    assert!(said.contains("together: falls, stress_error at h0.05 over that at h0.1 (the runs do not give all that it compares (missing: stress_xx"), "{said}");
    // That each run is asked for by itself.
    assert_eq!(refused(&require("corner"), &scores), "");
    let said = refused(&require("stress"), &scores);
    assert!(said.contains("run 1 (h0.1): stress (") && said.contains("run 3 (h0.025): stress ("), "{said}");
    // A run by itself shows no order.
    let alone = beam("h0.1", 0.0).0.scores().unwrap();
    assert_eq!(refused(&require("falls"), &alone), "Not passed: not judged: falls (it does not apply to this result)");
}

#[test]
fn runs_of_other_schemes_and_repeats_are_judged_apart() {
    for (key, values) in [
        ("scheme", ["a", "b", "b"]),
        ("repeat", ["first", "second", "second"]),
        ("basis", ["gimp", "linear", "linear"]),
    ] {
        let change = |manifest: &mut Value| {
            for (run, value) in manifest["runs"].as_array_mut().unwrap().iter_mut().zip(values) {
                run[key] = json!(value);
            }
        };
        let scores = levels([1e-3, 2e-3, 5e-4], change).scores().unwrap();
        let names: Vec<&str> = scores.together.iter().map(|(names, _)| &**names).collect();
        assert_eq!(names, ["run 1 (h0.1)", "run 2 (h0.05), run 3 (h0.025)"], "{key}");
        assert_eq!(gate::gate(false, &[]).exit_code(&scores), ExitCode::Good, "{key}");
    }
}

#[test]
fn the_form_of_a_list_is_checked() {
    let base = || levels([0.0; 3], |_| ());
    let result = base();
    std::os::unix::fs::symlink("h0.1", result.path("link")).unwrap();
    let sound = result.json(FILE);
    let said = |change: &dyn Fn(&mut Value)| {
        let mut changed = sound.clone();
        change(&mut changed);
        fs::write(result.path(FILE), changed.to_string()).unwrap();
        result.refusal()
    };
    let of = |key: &'static str, value: Value| said(&move |m| m["runs"][1][key] = value.clone());
    for (said, named) in [
        (of("levle", json!("h0.1")), "score.json: run 2: unknown field `levle`"),
        (of("levle", json!("h0.1")), "is `level` meant?"),
        (of("case", json!("cook")), "run 2: duplicate field `case`"),
        (of("code", json!({"name": "a"})), "run 2: duplicate field `code`"),
        (of("schema", json!(1)), "run 2: duplicate field `schema`"),
        (of("runs", json!([])), "run 2: duplicate field `runs`"),
        (of("level", json!("h9")), "score.json: run 2: level: unknown level \"h9\""),
        (of("parameters", json!({"lod": 1})), "run 2: parameters: unknown parameter"),
        (of("parameters", json!({"weight": [1]})), "run 2: weight: a number, boolean or word is allowed"),
        (of("particles", json!("h0.1/particles.csv")), "run 2: tables: run 1 (h0.1) names one of them too"),
        (
            of("particles", json!("h0.1/../particles.csv")),
            "run 2: file \"h0.1/../particles.csv\" where the name of a file beside",
        ),
        (of("particles", json!("link/particles.csv")), "a link, which is not followed"),
        (said(&|m| m["runs"] = json!([])), "runs: 0 where 1 to 100 are allowed"),
        (said(&|m| m["runs"] = json!(vec![json!({}); 101])), "runs: 101 where 1 to 100 are allowed"),
        (said(&|m| m["runs"] = json!(1)), "expected a sequence"),
        (said(&|m| m["runs"][1] = json!(1)), "names with values"),
        (said(&|m| m["runs"][2] = json!({"particles": "a.csv"})), "run 3: missing field `level`"),
        (said(&|m| drop(m.as_object_mut().unwrap().remove("scheme"))), "run 1: missing field `scheme`"),
        (said(&|m| drop(m.as_object_mut().unwrap().remove("case"))), "run 1: missing field `case`"),
    ] {
        assert!(said.contains(named), "{said}\n{named}");
    }
    // A name that is there twice, in an entry too; and a run that is there twice, whatever its parameters are called.
    let text = sound.to_string();
    let twice = text.replace("\"level\":\"h0.05\"", "\"parameters\":{\"weight\":1,\"weight\":1},\"level\":\"h0.05\"");
    let double = text.replace("\"level\":\"h0.05\"", "\"level\":\"h0.05\",\"level\":\"h0.1\"");
    let again = text.replace("\"level\":\"h0.05\"", "\"level\":\"h0.1\"").replace("h0.05/particles.csv", "again.csv");
    fs::copy(result.path("h0.1/particles.csv"), result.path("again.csv")).unwrap();
    for (text, named) in [
        (twice, "run 2: parameters: parameter weight is set twice"),
        (double, "run 2: duplicate field `level`"),
        (again, "run 2: level: run 1 (h0.1) is the same run; allowed: another scheme or `repeat`"),
    ] {
        fs::write(result.path(FILE), text).unwrap();
        let said = result.refusal();
        assert!(said.contains(named), "{said}\n{named}");
    }
}

#[test]
fn values_above_the_list_are_those_of_every_run_that_has_none() {
    let change = |manifest: &mut Value| {
        manifest["basis"] = json!("gimp");
        manifest["cost"] = json!({"cpu_s": 2.0});
        manifest["parameters"] = json!({"load_steps": 10});
        manifest["runs"][1]["parameters"] = json!({});
        manifest["runs"][2]["cost"] = json!({"wall_s": 3.0});
    };
    let scores = levels([0.0; 3], change).scores().unwrap();
    let of = |run: &Scored| (run.manifest.basis, run.record.set.clone(), run.record.time.cpu_s);
    let [first, second, third] = [0, 1, 2].map(|k: usize| of(&scores.runs[k]));
    let steps = vec!["load_steps=10".to_owned()];
    assert_eq!(first, (crate::scheme::BasisName::Gimp, steps.clone(), 2.0));
    assert_eq!((second.1, second.2), (Vec::new(), 2.0));
    assert!(third.1 == steps && third.2.is_nan() && scores.runs[2].record.time.wall_s == 3.0);
}

/// The exact column at three levels, told with steps of its own: no order in space of our steps is demanded.
#[test]
fn orders_that_hang_on_our_steps_are_not_judged() {
    let result = Answer::of_column();
    let runs = ["n8", "n16", "n32"].map(|level| {
        let series = format!("{level}.csv");
        fs::copy(result.path(CURVE), result.path(&series)).unwrap();
        json!({"level": level, "series": series})
    });
    result.list(runs);
    let scores = result.scores().unwrap();
    let all = &scores.together[0].1.verdicts;
    assert!(all.iter().any(|v| v.check == "richardson"));
    for verdict in all {
        assert!(
            verdict.outcome == Outcome::NotJudged
                && verdict.source.contains("against the discrete equations of our scheme"),
            "{verdict:?}"
        );
    }
    let (case, foreign) = find_scored("consolidation").unwrap();
    let known = |name: &&&str| case.checks.iter().any(|c| c.name == **name && !c.is_of_run());
    assert!(foreign.own_checks.iter().all(|name| known(&name)));
    assert_eq!(gate::gate(false, &[]).exit_code(&scores), ExitCode::Good);
}

/// A front of which a level shows the beginning only is no bound for the next level.
#[test]
fn a_level_that_shows_too_little_bounds_no_other() {
    let result = Answer::exported("dam-break", "h0.5", &[]);
    let curve = Table::read(&result.path("reference-front.csv")).unwrap().points("time", "front");
    let runs = [("h0.5", 0.3), ("h0.25", 9.0)].map(|(level, end)| {
        let (time, front) = curve.iter().copied().filter(|(time, _)| *time < end).unzip();
        let series = format!("{level}.csv");
        Table::of_columns([("time (s)", time), ("front (m)", front)]).write(&result.path(&series)).unwrap();
        json!({"level": level, "series": series})
    });
    result.list(runs);
    let scores = result.scores().unwrap();
    assert!(scores.runs[0].record.value("front_rms_error").is_nan());
    assert!(scores.runs[1].record.value("front_rms_error").is_finite());
    let falls = outcomes_of(&scores, "front-converges");
    assert_eq!(falls, [("front_rms_error".to_owned(), Outcome::NotJudged)]);
    assert_eq!(gate::gate(false, &[]).exit_code(&scores), ExitCode::TruthFailed);
}
