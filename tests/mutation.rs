//! Seeded faults: the solver is broken on purpose, and a named check must go red.
//!
//! The sources are copied, one line is changed, the copy is built and run. Slow (a build per fault),
//! so it is not part of a plain `cargo test`: run it with `--test mutation`.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A fault: where, what becomes what, the run that must notice, and the check that must go red.
struct Fault {
    name: &'static str,
    file: &'static str,
    sound: &'static str,
    broken: &'static str,
    run: &'static [&'static str],
    check: &'static str,
}

const RATE: &[&str] = &[
    "run",
    "cook",
    "--basis",
    "bspline2",
    "--remedy",
    "fbar-rate",
];

const FAULTS: [Fault; 7] = [
    Fault {
        name: "P2G drops the stress along the last axis",
        file: "mpm-core/src/transfer/kernel.rs",
        sound: "across.mul_add(w, along.mul_add(dw, nodes[k].change))",
        broken: "across.mul_add(w, (along * 0.0).mul_add(dw, nodes[k].change))",
        run: RATE,
        check: "completes",
    },
    Fault {
        name: "P2G halves the mass",
        file: "mpm-core/src/transfer/kernel.rs",
        sound: "[0.0, 0.0, 0.0, self.mass]",
        broken: "[0.0, 0.0, 0.0, 0.5 * self.mass]",
        run: RATE,
        check: "mid-edge",
    },
    Fault {
        name: "F-bar takes the cubic root in plane strain",
        file: "mpm-core/src/space.rs",
        sound: "2 => x.sqrt(),",
        broken: "2 => x.cbrt(),",
        run: RATE,
        check: "mean-stress-rms",
    },
    Fault {
        name: "F-bar is skipped",
        file: "mpm-core/src/remedy/mod.rs",
        sound: "*delta_f *= stretch_of_volume::<D>(volume_ratio);",
        broken: "*delta_f *= stretch_of_volume::<D>(volume_ratio.powi(0));",
        run: RATE,
        check: "mean-stress-rms",
    },
    Fault {
        name: "the gradient has the wrong sign",
        file: "mpm-core/src/basis/bspline.rs",
        sound: "*d *= self.inverse_h;",
        broken: "*d *= -self.inverse_h;",
        // In force and strain the two signs cancel: displacements stay right, stresses turn over.
        run: RATE,
        check: "mean-stress-probe",
    },
    Fault {
        name: "the wall does not hold",
        file: "mpm-core/src/stage/wall.rs",
        sound: "(behind && held).then_some(0.0)",
        broken: "(behind && held && grid.h < 0.0).then_some(0.0)",
        run: RATE,
        check: "completes",
    },
    Fault {
        name: "the printed algorithm no longer creeps",
        file: "mpm-core/src/remedy/fbar_recursive.rs",
        sound: "particles.j_bar[p] * determinant(&particles.delta_f[p])",
        broken: "particles.jacobian[p]",
        run: &["run", "cook", "--remedy", "fbar-recursive"],
        check: "never-at-rest",
    },
];

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap()
}

fn copy_tree(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_tree(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// Builds the copy and runs it; returns the exit code and what it printed.
fn build_and_run(copy: &Path, arguments: &[&str]) -> (i32, String) {
    let target = workspace().join("target/mutants");
    let build = Command::new(env!("CARGO"))
        .args([
            "build",
            "--profile",
            "mutant",
            "--bin",
            "mpm-verify",
            "--target-dir",
        ])
        .arg(&target)
        .current_dir(copy)
        .output()
        .unwrap();
    assert!(
        build.status.success(),
        "{}",
        String::from_utf8_lossy(&build.stderr)
    );
    let output = Command::new(target.join("mutant/mpm-verify"))
        .args(arguments)
        .current_dir(copy)
        .output()
        .unwrap();
    (
        output.status.code().unwrap(),
        String::from_utf8_lossy(&output.stdout).into_owned(),
    )
}

/// A constant that is off by a millionth: no check against the truth can see it, the goldens do.
const DRIFT: Fault = Fault {
    name: "the neo-Hookean pressure is a millionth too large",
    file: "mpm-core/src/material/neo_hookean.rs",
    sound: "self.lambda * 0.5 * squared_jacobian.ln()",
    broken: "self.lambda * 0.500_000_5 * squared_jacobian.ln()",
    run: &[
        "verify", "--tier", "quick", "--golden", "golden", "--out", "report",
    ],
    check: "golden",
};

#[test]
fn every_seeded_fault_turns_a_named_check_red() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path();
    let source = workspace();
    for part in ["Cargo.toml", "Cargo.lock"] {
        fs::copy(source.join(part), copy.join(part)).unwrap();
    }
    for part in [".cargo", "mpm-core", "mpm-verify", "tests"] {
        copy_tree(&source.join(part), &copy.join(part));
    }
    let (code, text) = build_and_run(copy, RATE);
    assert_eq!(code, 0, "the sound program must pass: {text}");

    let mut survivors = Vec::new();
    for fault in &FAULTS {
        let path = copy.join(fault.file);
        let sound = fs::read_to_string(&path).unwrap();
        assert_eq!(
            sound.matches(fault.sound).count(),
            1,
            "{}: the line has changed",
            fault.name
        );
        fs::write(&path, sound.replace(fault.sound, fault.broken)).unwrap();
        let (code, text) = build_and_run(copy, fault.run);
        fs::write(&path, sound).unwrap();
        let red = text
            .lines()
            .any(|line| line.starts_with("FAIL") && line.contains(&format!("] {}:", fault.check)));
        if code == 0 || !red {
            survivors.push(format!(
                "{} (exit code {code}, not {}):\n{text}",
                fault.name, fault.check
            ));
        }
    }
    // A shift of rounding is no fault: what is sound holds against the goldens, in a build of its own.
    copy_tree(&source.join("golden"), &copy.join("golden"));
    let (code, text) = build_and_run(copy, DRIFT.run);
    assert_eq!(code, 0, "the sound program must hold: {text}");
    let path = copy.join(DRIFT.file);
    let sound = fs::read_to_string(&path).unwrap();
    fs::write(&path, sound.replace(DRIFT.sound, DRIFT.broken)).unwrap();
    let (code, text) = build_and_run(copy, DRIFT.run);
    if sound.matches(DRIFT.sound).count() != 1 || code != 3 || !text.contains("[DRIFT]") {
        survivors.push(format!("{} (exit code {code}, not 3):\n{text}", DRIFT.name));
    }
    assert!(survivors.is_empty(), "survived:\n{}", survivors.join("\n"));
}
