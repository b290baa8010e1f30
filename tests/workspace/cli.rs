//! The command line: what it offers and what it refuses.

use super::{code, json, mpm_verify, stderr, stdout, text};
use mpm_verify::parameter::Parameters;
use mpm_verify::spec::RunSpec;

/// Refused: exit code 2, one line on stderr that names what is wrong and what is allowed, and no
/// trace in the output folder.
fn refused(arguments: &[&str], needles: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut all = arguments.to_vec();
    if ["run", "verify"].contains(&arguments[0]) && !arguments.contains(&"--out") {
        all.extend(["--out", out.to_str().unwrap()]);
    }
    let output = mpm_verify(&all);
    let text = stderr(&output);
    assert_eq!(code(&output), 2, "{arguments:?}: {text}");
    assert_eq!(text.trim_end().lines().count(), 1, "{arguments:?}: {text}");
    assert!(text.starts_with("error: "), "{text}");
    for needle in needles {
        assert!(text.contains(needle), "\"{needle}\" is missing in: {text}");
    }
    assert!(!out.exists(), "{arguments:?} left something behind");
}

#[test]
fn unknown_names_are_refused_with_those_that_exist() {
    refused(&["run", "bridge"], &["case", "bridge", "cook"]);
    refused(&["explain", "bridge"], &["case", "cook"]);
    refused(&["verify", "bridge"], &["case", "cook"]);
    refused(
        &["run", "cook", "--basis", "cubic"],
        &["basis", "gimp", "bspline2", "bspline3"],
    );
    refused(
        &["run", "cook", "--remedy", "fbar"],
        &["remedy", "fbar-rate", "fbar-total"],
    );
    refused(
        &["run", "cook", "--transfer", "pic"],
        &["transfer", "flip", "apic"],
    );
    refused(
        &["run", "cook", "--remedy", "fbar-rate", "--transfer", "apic"],
        &["scheme", "gimp-fbar-rate-apic", "gimp-none-flip"],
    );
    refused(
        &["run", "cook", "--scheme", "gimp-none"],
        &["gimp-none", "basis-remedy-transfer"],
    );
    refused(
        &["run", "cook", "--solver", "newmark"],
        &["solver", "explicit"],
    );
    refused(
        &[
            "run",
            "cook",
            "--scheme",
            "gimp-none-flip",
            "--basis",
            "gimp",
        ],
        &["--scheme", "--basis"],
    );
    refused(
        &["run", "cook", "--basis", "linear"],
        &["scheme", "gimp-none-flip"],
    );
    refused(&["run", "cook", "--level", "h3"], &["level", "h2", "h0.25"]);
    refused(
        &["run", "cook", "--set", "nu=0.3"],
        &["parameter", "nu", "poisson_ratio"],
    );
    refused(
        &["verify", "--tier", "weekly"],
        &["tier", "quick, pr, nightly, long"],
    );
    refused(&["list", "--tier", "weekly"], &["tier"]);
    refused(&["list", "--format", "xml"], &["format", "text, json"]);
    refused(&["run", "cook", "--frobnicate"], &["--frobnicate"]);
    refused(&["solve"], &["solve"]);
}

#[test]
fn bad_values_are_refused_with_the_allowed_range() {
    for (assignment, needle) in [
        ("poisson_ratio=0.5", "0 to below 0.5"),
        ("poisson_ratio=nan", "not finite"),
        ("poisson_ratio=-0.1", "out of range"),
        ("load=1e400", "not finite"),
        ("load=", "not a number"),
        ("young_modulus=0", "out of range"),
        ("density=-1", "out of range"),
        ("damping=1", "0 to below 1"),
        ("cfl=0", "out of range"),
        ("flip=1.5", "0 to 1"),
        ("wall=glass", "open-knot, wall-line"),
        ("kinetic_damping=maybe", "true, false"),
        ("ppc_per_direction=2.5", "whole number from 1 to 4"),
        ("load", "name=value"),
    ] {
        let name = assignment.split('=').next().unwrap();
        refused(&["run", "cook", "--set", assignment], &[name, needle]);
    }
    refused(
        &["run", "cook", "--threads", "0"],
        &["threads", "1 to 1024"],
    );
    refused(
        &["verify", "--threads", "100000"],
        &["threads", "1 to 1024"],
    );
    refused(&["run", "cook", "--threads", "many"], &["threads"]);
    refused(&["bench", "--rounds", "0"], &["rounds", "1 to 1000"]);
    refused(&["bench", "--peers", "numpy"], &["peer", "numpy", "taichi"]);
}

#[test]
fn values_that_cannot_go_together_are_refused() {
    for (set, needles) in [
        (
            "young_modulus=1e12",
            ["load / young_modulus", "0.0000001 to 100"],
        ),
        ("rest_window=3", ["rest_window", "max_periods"]),
        ("max_periods=0.05", ["rest_window", "max_periods"]),
        ("load_ramp=5", ["load_ramp", "max_periods"]),
    ] {
        refused(&["run", "cook", "--set", set], &needles);
    }
    refused(
        &["verify", "--tier", "quick", "--shard", "1/90"],
        &["tier quick has 15 runs for 90 shards"],
    );
    refused(
        &["verify", "--tier", "quick", "--shard", "3/2"],
        &["--shard", "i/n"],
    );
}

#[test]
fn without_a_command_the_commands_are_named() {
    let output = mpm_verify(&[]);
    assert_eq!(code(&output), 2);
    assert_eq!(stderr(&output).lines().count(), 1);
    assert!(stderr(&output).contains(
        "list, explain, run, verify, report, keep, tables, pictures, complete, bless, diff"
    ));
}

/// What users read is reviewed as a difference in a snapshot.
#[test]
fn the_explanation_is_as_reviewed() {
    insta::assert_snapshot!("explain-cook", stdout(&mpm_verify(&["explain", "cook"])));
    insta::assert_snapshot!("list-pr", stdout(&mpm_verify(&["list", "--tier", "pr"])));
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_anything_runs() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let below_a_file = file.path().join("out");
    let below_a_file = below_a_file.to_str().unwrap();
    refused(&["run", "cook", "--out", below_a_file], &[below_a_file]);
    refused(
        &[
            "verify",
            "--tier",
            "quick",
            "--out",
            below_a_file,
            "--golden",
            text(file.path().parent().unwrap()),
        ],
        &[below_a_file],
    );
}

#[test]
fn list_and_explain_name_everything() {
    let text = stdout(&mpm_verify(&["list"]));
    assert!(text.contains("cook") && text.contains("bspline3-fbar-total-flip"));
    let listed = mpm_verify(&["list", "--format", "json", "--tier", "pr"]);
    let cases: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
    assert_eq!(cases[0]["case"], "cook");
    assert_eq!(cases[0]["schemes"].as_array().unwrap().len(), 27);
    assert_eq!(cases[0]["tier"], "pr");

    let text = stdout(&mpm_verify(&["explain", "cook"]));
    for part in [
        "poisson_ratio",
        "0 to below 0.5",
        "--remedy fbar-recursive",
        "h0.25",
        "mid_edge_uy",
        "creep_rate",
        "known limit",
        "0.276467",
        "Limits",
    ] {
        assert!(text.contains(part), "{part} is missing in explain");
    }
}

/// The parameters that `explain` lists for a case, with their defaults.
fn explained_parameters(case: &str) -> Vec<(String, String)> {
    let text = stdout(&mpm_verify(&["explain", case]));
    text.lines()
        .skip_while(|line| !line.starts_with("Parameters"))
        .take_while(|line| !line.starts_with("Schemes"))
        .filter(|line| line.contains("  default "))
        .filter_map(|line| {
            let (name, rest) = line.trim().split_once(" (")?;
            let default = rest.split_once("default ")?.1.split(", allowed").next()?;
            Some((name.to_owned(), default.to_owned()))
        })
        .collect()
}

/// Values that make a run short, so that the test is.
fn brief(name: &str) -> Option<&'static str> {
    match name {
        "max_periods" => Some("0.01"),
        "rest_window" | "load_ramp" => Some("0.005"),
        "duration" => Some("0.01"),
        "penetration" => Some("2e-4"),
        "trials" => Some("1"),
        _ => None,
    }
}

#[test]
fn every_explained_parameter_is_accepted_and_recorded() {
    for case in mpm_verify::cases::all() {
        let parameters = explained_parameters(case.name);
        assert_eq!(parameters.len(), case.parameters.len(), "{parameters:?}");
        let folder = tempfile::tempdir().unwrap();
        let scheme = case.schemes()[0].to_string();
        let run = ["run", case.name, "--scheme", &scheme];
        let mut arguments: Vec<String> = run.map(str::to_owned).to_vec();
        arguments.extend(["--out".to_owned(), text(folder.path()).to_owned()]);
        for (name, default) in &parameters {
            let value = brief(name).unwrap_or(default);
            arguments.extend(["--set".to_owned(), format!("{name}={value}")]);
        }
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = mpm_verify(&arguments);
        // Too short to come to rest.
        assert!([0, 1].contains(&code(&output)), "{}", stderr(&output));
        let record = json(&folder.path().join("record.json"));
        for (name, _) in &parameters {
            let recorded = &record["parameters"][name];
            assert!(!recorded.is_null(), "{name} is not recorded");
        }
    }
}

/// `run CASE` with nothing else: the scheme is there at every level, and the coarsest begins to run.
#[test]
fn every_case_runs_with_nothing_but_its_name() {
    for case in mpm_verify::cases::all() {
        let scheme = case.default_scheme(None);
        assert!(case.schemes().contains(&scheme), "{}", case.name);
        let parameters = Parameters::new(&case.parameters, &[]).unwrap();
        for (k, &level) in case.levels.iter().enumerate() {
            let spec = RunSpec {
                scheme,
                level,
                set: Vec::new(),
                perturbed: false,
            };
            let mut job = (case.begin)(&spec, &parameters).unwrap();
            if k == 0 {
                let row = job.advance().unwrap();
                assert_eq!(row.len(), job.series_columns().len(), "{}", case.name);
            }
        }
    }
}

#[test]
fn help_and_version_go_to_stdout() {
    for argument in ["--help", "--version"] {
        let output = mpm_verify(&[argument]);
        assert_eq!(code(&output), 0);
        assert!(!output.stdout.is_empty() && output.stderr.is_empty());
    }
}
