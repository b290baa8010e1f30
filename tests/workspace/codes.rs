//! Worked examples of other codes: a result that one has left, and one that is run where it is there.

use super::score::{of, read};
use super::{code, mpm_verify, stderr, text, workspace};
use mpm_verify::verdict::Outcome;
use std::path::PathBuf;

/// MPM3D-F90's own result, as `codes/mpm3d-f90/convert.py` has made it of its output: its GIMP locks as ours does.
#[test]
fn a_public_code_that_locks_fails_where_it_locks() {
    let folder = workspace().join("mpm-verify/codes/mpm3d-f90");
    let scored = read(&folder);
    assert_eq!(scored.record.work.particles, 5776);
    let tip = scored.record.value("tip_uy_nearest");
    assert!((tip - 0.2512).abs() < 5e-5, "{tip}");
    for check in ["mid-edge", "edge-mean", "tip", "mean-stress-rms"] {
        assert_eq!(of(&scored, check)[0].outcome, Outcome::Failed, "{check}");
    }
    assert_eq!(of(&scored, "reaction")[0].outcome, Outcome::NotJudged);
    assert_eq!(code(&mpm_verify(&["score", text(&folder), "--quiet"])), 1);
}

/// The Python with the peers' packages, if it is named by MPM_PYTHON or installed.
fn taichi() -> Option<PathBuf> {
    let python = std::env::var_os("MPM_PYTHON").map_or("python3".into(), PathBuf::from);
    let mut import = std::process::Command::new(&python);
    let found = import.args(["-c", "import taichi, numpy"]).output().ok()?;
    found.status.success().then_some(python)
}

/// Where Taichi is there: both cases from what is exported to a verdict.
#[test]
#[expect(clippy::print_stderr, reason = "says in a test's output what it could not try")]
fn another_code_solves_what_is_exported() {
    let Some(python) = taichi() else {
        eprintln!("no Taichi: the worked example is not tried (MPM_PYTHON names a Python that has it)");
        return;
    };
    let root = tempfile::tempdir().unwrap();
    for (case, level, set, right) in [
        ("cook", "h2", None, ["mid-edge", "reaction"]),
        ("dam-break", "h0.5", Some("cfl=0.3"), ["front", "motion-not-gained"]),
    ] {
        let [problem, result] = ["problem", "result"].map(|n| root.path().join(case).join(n));
        let mut arguments = vec!["export", case, "--level", level, "--out", text(&problem)];
        arguments.extend(set.iter().flat_map(|set| ["--set", set]));
        assert_eq!(code(&mpm_verify(&arguments)), 0);
        let script = workspace().join("mpm-verify/codes/taichi/solve.py");
        let solved = std::process::Command::new(&python).args([&script, &problem, &result]).output().unwrap();
        assert!(solved.status.success(), "{}", stderr(&solved));
        let scored = read(&result);
        for check in right {
            assert_eq!(of(&scored, check)[0].outcome, Outcome::Right, "{case}: {check}");
        }
    }
}
