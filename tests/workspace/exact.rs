//! The command `exact`: what it answers and what it refuses.

use super::{code, mpm_verify, stderr, stdout};
use mpm_verify::exact;

fn answer(arguments: &[&str]) -> serde_json::Value {
    let output = mpm_verify(&[&["exact"], arguments].concat());
    assert_eq!(code(&output), 0, "{arguments:?}: {}", stderr(&output));
    assert_eq!(stdout(&output).lines().count(), 1);
    serde_json::from_str(&stdout(&output)).unwrap()
}

fn refused(arguments: &[&str], needles: &[&str]) {
    super::cli::refused(&[&["exact"], arguments].concat(), needles);
}

#[test]
fn every_solution_answers_with_finite_numbers() {
    for entry in exact::all() {
        let dimension = ["--set", "dimension=2"];
        let set = if entry.parameters.iter().any(|p| p.name == "dimension") { &dimension[..] } else { &[] };
        let at = match entry.name {
            "mms-swirl" => "0.3,0.4,0.6",
            "vibrating-bar" => "0.3",
            _ => "0.3,0.4",
        };
        let state = answer(&[&[entry.name, "--at", at, "--time", "0.01"], set].concat());
        let components = at.split(',').count();
        for field in ["u", "v", "b"] {
            let vector = state[field].as_array().unwrap();
            assert_eq!(vector.len(), components, "{} {field}", entry.name);
            assert!(vector.iter().all(serde_json::Value::is_f64));
        }
        for field in ["F", "P"] {
            let rows = state[field].as_array().unwrap();
            assert_eq!(rows.len(), 3);
            assert!(rows.iter().flat_map(|r| r.as_array().unwrap()).all(|x| x.is_f64()));
        }
        assert!(state["J"].as_f64().unwrap() > 0.0);
        assert!(state["mean_stress"].is_f64());
    }
}

#[test]
fn the_answer_is_the_formulas() {
    let state = answer(&["free-fall", "--at", "0.5,0.5", "--time", "-2", "--set", "gravity=10"]);
    assert_eq!(state["u"], serde_json::json!([0.0, -20.0]));
    assert_eq!(state["v"], serde_json::json!([0.0, 20.0]));
    let state = answer(&["mms-vortex-ring", "--at", "-0.8,0.3", "--time", "0.5"]);
    assert_eq!(state["J"], 1.0);
}

#[test]
fn what_cannot_be_answered_is_refused_with_what_is_allowed() {
    let point = ["--at", "0.3,0.4", "--time", "0.1"];
    let with = |name: &'static str, set: &'static str| [&[name], &point[..], &["--set", set]].concat();
    refused(&[&["mms-vortex"], &point[..]].concat(), &["mms-vortex", "mms-swirl"]);
    refused(&["mms-swirl", "--at", "0.3,0.4", "--time", "0"], &["--at", "2 coordinates", "3"]);
    refused(&["patch", "--at", "0.3,0.4,0.5", "--time", "0"], &["--at", "3 coordinates", "2"]);
    refused(&["patch", "--at", "", "--time", "0"], &["--at", "1 coordinates"]);
    refused(&["patch", "--at", "0.3,1.5", "--time", "0"], &["--at y", "1.5", "0 to 1"]);
    refused(&["patch", "--at", "-0.1,0.5", "--time", "0"], &["--at x", "-0.1", "0 to 1"]);
    refused(&["patch", "--at", "0.3,nan", "--time", "0"], &["--at y", "not finite", "0 to 1"]);
    refused(&["patch", "--at", "0.3,inf", "--time", "0"], &["--at y", "not finite"]);
    refused(&["patch", "--at", "0.3,x", "--time", "0"], &["--at y", "not a number"]);
    refused(&["hydrostatic", "--at", "0.3,2.1", "--time", "0"], &["--at y", "0 to 2"]);
    refused(&["patch", "--at", "0.3,0.4", "--time", "inf"], &["--time", "not finite", "1e6"]);
    refused(&["patch", "--at", "0.3,0.4", "--time", "1e9"], &["--time", "out of range"]);
    refused(&["patch", "--at", "0.3,0.4"], &["--time"]);
    refused(&["patch", "--time", "0"], &["--at"]);
    refused(&with("patch", "stretch=1"), &["parameter", "stretch", "g_xx"]);
    refused(&with("patch", "g_xx=nan"), &["g_xx", "not finite"]);
    refused(&with("patch", "poisson_ratio=0.5"), &["poisson_ratio", "below 0.5"]);
    refused(&with("mms-axis", "dimension=4"), &["dimension", "from 1 to 3"]);
}

#[test]
fn an_amplitude_that_inverts_the_body_is_refused() {
    for (name, at, set, limit) in [
        ("mms-axis", "0.3,0.4", "amplitude=0.1", "below 0.085"),
        ("mms-wall-pressure", "0.3,0.4", "amplitude=0.25", "below 0.25"),
        ("mms-vortex-pressure", "0.3,0.4", "pressure=2e5", "below 166444"),
        ("hydrostatic", "0.3,0.4", "bulk_modulus=1e4", "below 1.02"),
        ("patch", "0.3,0.4", "g_xx=1.5", "above 0"),
        ("vibrating-bar", "0.3", "amplitude=0.01", "below 0.00318"),
        ("standing-wave", "0.3,0.4", "amplitude=0.05", "below 0.029"),
    ] {
        let (_, value) = set.split_once('=').unwrap();
        let value = if name == "hydrostatic" { "height: 2" } else { value.trim_end_matches("e5") };
        refused(&[name, "--at", at, "--time", "0", "--set", set], &[value, limit]);
    }
}
