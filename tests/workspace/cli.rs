//! The command line: what it offers and what it refuses.

use super::{code, json, mpm_verify, stderr, stdout, text};
use mpm_verify::parameter::Parameters;
use mpm_verify::spec::RunSpec;

/// Refused: exit code 2, one line on stderr that names what is wrong and allowed, and no trace in the output folder.
pub(super) fn refused(arguments: &[&str], needles: &[&str]) {
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
    assert!(text.starts_with("error: ") && stdout(&output).is_empty(), "{text}");
    for needle in needles {
        assert!(text.contains(needle), "\"{needle}\" is missing in: {text}");
    }
    assert!(!out.exists(), "{arguments:?} left something behind");
}

#[test]
fn a_quasi_static_run_says_what_it_does_not_solve() {
    let beam = |set: &[&str], needles: &[&str]| {
        let set = set.iter().flat_map(|s| ["--set", s]);
        refused(&["run", "cantilever"].into_iter().chain(set).collect::<Vec<_>>(), needles);
    };
    let on = |basis: &str, set: &str, needles: &[&str]| {
        refused(&["run", "cantilever", "--basis", basis, "--set", set], needles);
    };
    beam(&["load_steps=0"], &["load_steps", "1 to 10000"]);
    beam(&["tolerance=1"], &["tolerance", "1e-8"]);
    beam(&["stabilisation=glue"], &["glue", "none, soft, ghost"]);
    on("q8", "stabilisation=ghost", &["ghost penalty", "none or soft"]);
    on("gimp", "stabilisation=soft", &["soft stiffness", "none or ghost"]);
    refused(
        &["run", "cook", "--solver", "quasi-static", "--remedy", "fbar-rate"],
        &["quasi-static-gimp-fbar-rate", "quasi-static-gimp-fbar-consistent"],
    );
    refused(&["run", "cook", "--solver", "quasi-static", "--set", "cfl=0.1"], &["cfl", "quasi-static"]);
    refused(&["run", "cook", "--set", "ghost=0.1"], &["ghost", "explicit"]);
    refused(&["run", "mms-static", "--set", "dimension=3", "--set", "pressure=1"], &["pressure", "allowed: 0"]);
}

#[test]
fn unknown_names_are_refused_with_those_that_exist() {
    refused(&["run", "cok"], &["CASE", "cok", "similar value exists: 'cook'"]);
    refused(&["explain", "bridge"], &["CASE", "cook"]);
    refused(&["verify", "bridge"], &["CASE", "cook"]);
    refused(&["run", "cook", "--basis", "cubic"], &["basis", "gimp", "bspline2", "bspline3"]);
    refused(&["run", "cook", "--remedy", "fbar"], &["remedy", "fbar-rate", "fbar-total"]);
    refused(&["run", "cook", "--transfer", "pic"], &["transfer", "flip", "apic"]);
    refused(
        &["run", "cook", "--remedy", "fbar-rate", "--transfer", "apic"],
        &["scheme", "gimp-fbar-rate-apic", "gimp-none-flip"],
    );
    refused(&["run", "cook", "--scheme", "gimp-none"], &["gimp-none", "basis-remedy-transfer"]);
    refused(&["run", "cook", "--solver", "fem"], &["solver", "explicit", "quasi-static", "poro"]);
    refused(&["run", "cook", "--solver", "poro"], &["poro-gimp-two-grid", "quasi-static-gimp-none"]);
    refused(&["run", "cook", "--solver", "newmark"], &["newmark-gimp-fbar-consistent", "quasi-static-gimp-none"]);
    refused(&["run", "cook", "--scheme", "gimp-none-flip", "--basis", "gimp"], &["--scheme", "--basis"]);
    refused(&["run", "cook", "--basis", "linear"], &["scheme", "gimp-none-flip"]);
    refused(&["run", "cook", "--level", "h3"], &["level", "h2", "h0.25"]);
    refused(&["run", "cook", "--set", "nu=0.3"], &["parameter", "nu", "poisson_ratio"]);
    refused(&["verify", "--tier", "weekly"], &["tier", "quick, pr, nightly, long"]);
    refused(&["list", "--tier", "weekly"], &["tier"]);
    refused(&["verify", "--tier", "nigh"], &["'nigh' for '--tier <TIER>' tip: a similar value exists: 'nightly'"]);
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
        ("ppc_per_direction=2.5", "whole number from 2 to 4"),
        ("load", "name=value"),
        ("young_modulus=1e20", "0.001 to 1e12"),
    ] {
        let name = assignment.split('=').next().unwrap();
        refused(&["run", "cook", "--set", assignment], &[name, needle]);
    }
    refused(&["run", "cook", "--threads", "0"], &["threads", "1..="]);
    refused(&["verify", "--threads", "100000"], &["threads", "1..="]);
    refused(&["run", "cook", "--threads", "many"], &["threads"]);
    refused(&["bench", "--rounds", "0"], &["rounds", "1..=1000"]);
    refused(&["bench", "--peers", "numpy"], &["peers", "numpy", "taichi"]);
}

#[test]
fn values_that_cannot_go_together_are_refused() {
    for (set, needles) in [
        ("young_modulus=1e12", ["load / young_modulus", "1.000e-7 to 1.000e2"]),
        ("rest_window=3", ["rest_window", "max_periods"]),
        ("max_periods=0.05", ["rest_window", "max_periods"]),
        ("load_ramp=5", ["load_ramp", "max_periods"]),
    ] {
        refused(&["run", "cook", "--set", set], &needles);
    }
    refused(&["verify", "--tier", "quick", "--shard", "1/90"], &["tier quick has", "runs for 90 shards"]);
    refused(&["verify", "--tier", "quick", "--shard", "3/2"], &["--shard", "i/n"]);
}

#[test]
fn without_a_command_the_help_is_shown() {
    let output = mpm_verify(&[]);
    assert_eq!(code(&output), 2);
    let help = stderr(&output);
    for command in ["list", "explain", "run", "verify", "report", "completions"] {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
    }
    assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
}

#[test]
fn a_parameter_is_set_once() {
    let twice = ["run", "cook", "--set", "load=1", "--set", "load=2"];
    refused(&twice, &["parameter load is set twice"]);
}

#[test]
fn a_shell_is_told_the_names() {
    let script = stdout(&mpm_verify(&["completions", "bash"]));
    for name in ["dam-break", "gimp-fbar-consistent-flip", "--checkpoint-every"] {
        assert!(script.contains(name), "{name}");
    }
}

/// A run ends with its verdict; colours and all text besides the verdict can be left out.
#[test]
fn a_run_ends_with_its_verdict_in_the_words_of_all_outcomes() {
    let run = |options: &[&str]| {
        let run = ["run", "cook", "--scheme", "gimp-none-flip"];
        mpm_verify(&[&run[..], options].concat())
    };
    let all = stdout(&run(&[]));
    let last = all.lines().last().unwrap();
    assert!(last.starts_with("Verdict: wrong as known: locked, locks; "), "{all}");
    assert!(all.lines().all(|line| line.chars().count() <= 100), "{all}");
    assert!(!all.contains('\x1b'));
    assert_eq!(stdout(&run(&["--quiet"])), format!("{last}\n"));
    let record: serde_json::Value = serde_json::from_str(&stdout(&run(&["--json"]))).unwrap();
    assert_eq!(record["scheme"], "gimp-none-flip");
    let coloured = std::process::Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
        .args(["run", "cook", "--quiet"])
        .env("CLICOLOR_FORCE", "1")
        .env_remove("NO_COLOR")
        .output();
    assert!(stdout(&coloured.unwrap()).contains('\x1b'));
}

#[test]
fn a_single_run_is_drawn_and_has_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let out = text(folder.path());
    let run = stdout(&mpm_verify(&["run", "cook", "--out", out]));
    for picture in ["cook/particles.png", "cook/history.png"] {
        assert!(folder.path().join(picture).exists() && run.contains(picture));
    }
    let report = mpm_verify(&["report", out, "--golden", text(&super::golden())]);
    assert_eq!(code(&report), 0, "{}{}", stdout(&report), stderr(&report));
    let page = std::fs::read_to_string(folder.path().join("cook.html")).unwrap();
    let page = page.replace("&#x2f;", "/");
    assert!(page.contains("cook/particles.png") && page.contains("gimp-fbar-consistent-flip"));
}

/// A report replaces what this program wrote, and nothing else.
#[test]
fn what_a_user_has_in_a_folder_stays_there() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("index.html");
    std::fs::write(&page, "mine").unwrap();
    let made = folder.path().join("run");
    mpm_verify(&["run", "cook", "--out", text(&made)]);
    let golden = super::golden();
    let report = |from| mpm_verify(&["report", text(&made), "--golden", text(&golden), "--out", from]);
    let refused = report(text(folder.path()));
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("index.html"), "{}", stderr(&refused));
    assert_eq!(std::fs::read_to_string(&page).unwrap(), "mine");
    let own = folder.path().join("own");
    assert_eq!([code(&report(text(&own))), code(&report(text(&own)))], [0, 0]);
}

/// The goldens of the checkout serve in any working directory.
#[test]
fn goldens_are_found_from_any_folder() {
    let folder = tempfile::tempdir().unwrap();
    let listed = std::process::Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
        .arg("list")
        .current_dir(folder.path())
        .output()
        .unwrap();
    let cook = stdout(&listed).lines().find(|l| l.starts_with("cook ")).map(str::to_owned);
    assert!(cook.unwrap().ends_with(" s"));
}

/// Texts for users are reviewed as a difference in a snapshot.
#[test]
fn the_explanation_is_as_reviewed() {
    insta::assert_snapshot!("explain-cook", stdout(&mpm_verify(&["explain", "cook"])));
    insta::assert_snapshot!("list", stdout(&mpm_verify(&["list"])));
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_anything_runs() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let below_a_file = file.path().join("out");
    let below_a_file = below_a_file.to_str().unwrap();
    refused(&["run", "cook", "--out", below_a_file], &[below_a_file]);
    refused(
        &["verify", "--tier", "quick", "--out", below_a_file, "--golden", text(file.path().parent().unwrap())],
        &[below_a_file],
    );
}

#[test]
fn list_names_everything() {
    let runs = stdout(&mpm_verify(&["list", "--tier", "quick"]));
    assert!(runs.contains("cook gimp-none-flip/h2\n"), "{runs}");
    let listed = mpm_verify(&["list", "--json", "--tier", "pr"]);
    let cases: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
    assert_eq!(cases[0]["case"], "cook");
    assert_eq!(cases[0]["schemes"].as_array().unwrap().len(), 28);
    assert_eq!(cases[0]["tier"], "pr");
}

/// The parameters that `explain` lists for a case, with their defaults.
fn explained_parameters(case: &str) -> Vec<(String, String)> {
    let told = stdout(&mpm_verify(&["explain", case, "--json"]));
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    let text = |p: &serde_json::Value, key: &str| p[key].as_str().unwrap().to_owned();
    let parameters = told["parameters"].as_array().unwrap().iter();
    parameters.map(|p| (text(p, "name"), text(p, "default"))).collect()
}

/// Values that make a run short, so that the test is.
fn brief(name: &str) -> Option<&'static str> {
    match name {
        "max_periods" => Some("0.01"),
        "rest_window" | "load_ramp" => Some("0.005"),
        "duration" => Some("0.01"),
        "penetration" => Some("2e-4"),
        "trials" => Some("1"),
        // A slope with little ground around it.
        "floor" => Some("6"),
        "crest" => Some("1"),
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
            let spec = RunSpec { scheme, level, set: Vec::new(), perturbed: false };
            let mut job = (case.begin)(&spec, &parameters).unwrap();
            if k == 0 {
                let row = job.advance().unwrap();
                let names: std::collections::BTreeSet<_> = row.0.iter().map(|(name, _)| name).collect();
                assert_eq!(row.0.len(), names.len(), "{}", case.name);
            }
        }
    }
}

#[test]
fn help_and_version_go_to_stdout() {
    for output in ["--help", "--version"].map(|argument| mpm_verify(&[argument])) {
        assert!(code(&output) == 0 && !output.stdout.is_empty() && output.stderr.is_empty());
    }
}

#[test]
fn help_lists_every_command_on_a_line_of_its_own() {
    let [help, script] = [&["--help"][..], &["completions", "fish"]].map(|words| stdout(&mpm_verify(words)));
    let commands = script.lines().filter_map(|l| l.split("needs_command\" -f -a \"").nth(1)?.split('"').next());
    let lost: Vec<&str> = commands.clone().filter(|name| !help.contains(&format!("\n  {name} "))).collect();
    assert!(commands.count() > 15 && lost == ["help"] && help.lines().all(|l| l.len() <= 100), "{lost:?}");
}
