//! The schema for editors, and the words of the problems.

use super::*;
use crate::cases;
use std::collections::BTreeSet;

/// It has the keys that the reader takes, and demands those that it demands.
#[test]
fn the_schema_is_that_of_the_reader() {
    let schema: Value = serde_json::from_str(include_str!("../../../../docs/reference/score.schema.json")).unwrap();
    let result = Answer::of_column();
    let sound = || result.json(FILE);
    let refusal = |manifest: Value| {
        let other = Answer::of_column();
        fs::write(other.path(FILE), manifest.to_string()).unwrap();
        other.score().map(|_| ()).unwrap_err().to_string()
    };
    let known = |said: &str| {
        let names = said.split('`').skip(3).step_by(2).map(str::to_owned);
        names.collect::<BTreeSet<String>>()
    };
    for (key, place) in
        [(None, &schema), (Some("code"), &schema["properties"]["code"]), (Some("cost"), &schema["properties"]["cost"])]
    {
        let mut wrong = sound();
        match key {
            None => wrong["zzzzzzzzzz"] = json!(1),
            Some(key) => wrong[key]["zzzzzzzzzz"] = json!(1),
        }
        let keys: BTreeSet<String> = place["properties"].as_object().unwrap().keys().cloned().collect();
        assert_eq!(known(&refusal(wrong)), keys, "{key:?}");
        assert_eq!(place["additionalProperties"], false);
    }
    for key in schema["required"].as_array().unwrap() {
        let key = key.as_str().unwrap();
        let mut wrong = sound();
        wrong.as_object_mut().unwrap().remove(key);
        assert!(refusal(wrong).contains(&format!("missing field `{key}`")), "{key}");
    }
    let scored: Vec<&str> = cases::scored().map(|(case, _)| case.name).collect();
    assert_eq!(schema["properties"]["case"]["enum"], json!(scored));
}

/// Every case that scores has its problem in words, whose names in backquotes are parameters or columns, and measures what
/// is wanted of it.
#[test]
fn every_problem_has_its_words_and_measures_what_is_wanted() {
    for (case, foreign) in cases::scored() {
        let level = case.levels[0].name;
        let result = Answer::exported(case.name, level, &[]);
        let words = result.json("problem.json")["setup"].clone();
        assert!(words.as_array().unwrap().len() > 2, "{}", case.name);
        let start = Table::read(&result.path("start.csv")).unwrap();
        let known = |name: &str| {
            let parameter = case.parameters.iter().any(|p| p.name == name);
            let column = foreign.columns().iter().any(|c| c.name == name);
            let starts = start.iter().any(|(head, _)| head.split(" (").next() == Some(name));
            parameter
                || column
                || starts
                || ["basis", "linear", "gimp", "bspline2", "bspline3", "cost.steps"].contains(&name)
        };
        let reference = result.text("reference.csv");
        for wanted in case.wanted.iter().filter(|w| !w.only_where_referenced) {
            let is_measured = wanted.names().split(", ").any(|check| reference.contains(&format!("\n{check},")));
            assert!(is_measured, "{}: {}", case.name, wanted.name);
        }
        for line in words.as_array().unwrap() {
            for name in line.as_str().unwrap().split('`').skip(1).step_by(2) {
                assert!(known(name), "{}: {name}", case.name);
            }
        }
    }
}
