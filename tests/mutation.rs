//! Seeded faults: the solver is broken on purpose, and a named check must go red.
//!
//! The sources are copied, every fault is written into the copy behind a switch, the copy is built once, and
//! run with one fault at a time. Slow (a build from scratch), so it is not part of a plain `cargo test`: run
//! it with `--test mutation`.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use mpm_verify::cases;
use mpm_verify::files::read_versioned;
use mpm_verify::record::{self, Record};
use mpm_verify::verdict::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A fault: where, which expression becomes which, the runs that must notice, and the check that must
/// go red.
struct Fault {
    name: &'static str,
    file: &'static str,
    sound: &'static str,
    broken: &'static str,
    seen_by: &'static [(Runs, &'static str)],
}

/// Runs of one case, judged together: what follows `mpm-verify run`.
type Runs = &'static [&'static str];

const RATE: Runs = &["cook --basis bspline2 --remedy fbar-rate"];
const RECURSIVE: Runs = &["cook --remedy fbar-recursive"];
/// Large enough to tell where a body force is evaluated, too small for particles to cross cells.
const AXIS: Runs = &[
    "mms-axis --remedy none --set amplitude=0.005 --level n8",
    "mms-axis --remedy none --set amplitude=0.005 --level n16",
    "mms-axis --remedy none --set amplitude=0.005 --level n32",
];
const AXIS_SPLINES: Runs = &[
    "mms-axis --basis bspline2 --remedy none --level n8",
    "mms-axis --basis bspline2 --remedy none --level n16",
    "mms-axis --basis bspline2 --remedy none --level n32",
];
const WALL: Runs = &[
    "mms-wall-pressure --remedy none --level n8",
    "mms-wall-pressure --remedy none --level n16",
    "mms-wall-pressure --remedy none --level n32",
];
const WALL_SPLINES: Runs = &[
    "mms-wall-pressure --basis bspline2 --remedy none --level n8",
    "mms-wall-pressure --basis bspline2 --remedy none --level n16",
    "mms-wall-pressure --basis bspline2 --remedy none --level n32",
];
const VORTEX: Runs = &[
    "mms-vortex-box --remedy fbar-rate --level n8",
    "mms-vortex-box --remedy fbar-rate --level n8 --set poisson_ratio=0.3",
];
const BAR: Runs = &[
    "vibrating-bar --remedy none --level n8",
    "vibrating-bar --remedy fbar-rate --level n8",
];
const BAR_CONSISTENT: Runs = &[
    "vibrating-bar --remedy none --level n8",
    "vibrating-bar --remedy fbar-consistent --level n8",
];

const FOOTING: Runs = &[
    "footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025",
];
const BARRIER: Runs = &[
    "footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025 --set contact=barrier",
];

/// Until the front is at the wall.
const DAM: Runs =
    &["dam-break --remedy fbar-recursive --level h0.5 --set duration=0.45 --set cfl=0.3"];

/// Water behind the gate, and hardly longer.
const RESTING: Runs = &["dam-break --remedy none --level h0.5 --set duration=0.1 --set cfl=0.3"];

/// A slide far beyond its limit.
const SLIDE: Runs =
    &["landslide-2d --remedy fbar-consistent --level h0.4 --set reduction=2 --set duration=1.5"];

/// A beam in equilibrium, and one whose stress turns.
const BEAM: Runs = &["cantilever --level h0.1"];
const TURNED_BEAM: Runs = &["cantilever --level h0.1 --set law=jaumann"];

const FAULTS: [Fault; 29] = [
    Fault {
        name: "the tangent is a tenth too soft",
        file: "implicit/response.rs",
        sound: "whole.slope[k]",
        broken: "0.9 * whole.slope[k]",
        seen_by: &[(BEAM, "newton")],
    },
    Fault {
        name: "the ghost penalty vanishes",
        file: "implicit/ghost.rs",
        sound: "factor * moduli.young()",
        broken: "0.0 * moduli.young()",
        seen_by: &[(BEAM, "completes")],
    },
    Fault {
        name: "Jaumann's stress turns by half of the rotation",
        file: "material/hypoelastic.rs",
        sound: "stress.push_forward(&cayley(0.5))",
        broken: "stress.push_forward(&cayley(0.25))",
        seen_by: &[(TURNED_BEAM, "corner")],
    },
    Fault {
        name: "P2G drops the stress along the last axis",
        file: "explicit/transfer/kernel.rs",
        sound: "along.mul_add(slope[k], nodes[k].change)",
        broken: "(along * 0.0).mul_add(slope[k], nodes[k].change)",
        seen_by: &[(RATE, "completes")],
    },
    Fault {
        name: "P2G halves the mass",
        file: "explicit/transfer/kernel.rs",
        sound: "momentum.as_mut_array()[3] = self.mass[l]",
        broken: "momentum.as_mut_array()[3] = 0.5 * self.mass[l]",
        seen_by: &[(RATE, "mid-edge")],
    },
    Fault {
        name: "F-bar takes the cubic root in plane strain",
        file: "space.rs",
        sound: "x.sqrt()",
        broken: "cube_root(x)",
        seen_by: &[(RATE, "mean-stress-rms")],
    },
    Fault {
        name: "F-bar is skipped",
        file: "explicit/remedy/mod.rs",
        sound: "entry * stretch",
        broken: "entry + stretch * Eight::ZERO",
        seen_by: &[(RATE, "mean-stress-rms"), (VORTEX, "no-locking")],
    },
    Fault {
        name: "the gradient has the wrong sign",
        file: "basis/bspline.rs",
        sound: "*d *= T::splat(self.inverse_h)",
        broken: "*d *= T::splat(-self.inverse_h)",
        // In force and strain the two signs cancel: displacements stay right, stresses turn over.
        seen_by: &[(RATE, "mean-stress-probe")],
    },
    Fault {
        name: "the wall does not hold",
        file: "stage/wall.rs",
        sound: "(behind && held)",
        broken: "(behind && held && grid.h < 0.0)",
        seen_by: &[(RATE, "completes")],
    },
    Fault {
        name: "the printed algorithm no longer creeps",
        file: "explicit/remedy/fbar_recursive.rs",
        sound: "fill_with_products(&mut self.next, &particles.j_bar, change)",
        broken: "self.next.clone_from(if change.is_empty() { change } else { &particles.jacobian })",
        seen_by: &[(RECURSIVE, "never-at-rest")],
    },
    Fault {
        name: "the body force is that of the current position",
        file: "stage/load.rs",
        sound: "particles
            .external_force
            .iter_mut()
            .zip(&particles.reference)
            .zip(&particles.mass)",
        broken: "particles
            .external_force
            .iter_mut()
            .zip(&particles.position)
            .zip(&particles.mass)",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the gradient is a hundredth too large",
        file: "basis/bspline.rs",
        sound: "*d *= T::splat(self.inverse_h)",
        broken: "*d *= T::splat(1.01 * self.inverse_h)",
        seen_by: &[(AXIS_SPLINES, "order-displacement")],
    },
    Fault {
        name: "the increment of the volume is averaged twice",
        file: "explicit/remedy/fbar_rate.rs",
        sound: "average.average(particles, &mut self.averaged)",
        broken: "for _ in 0..2 { average.average(particles, &mut self.averaged) }",
        seen_by: &[(BAR, "averaging-softens")],
    },
    Fault {
        name: "the consistent average lacks its second term",
        file: "explicit/remedy/fbar_consistent.rs",
        sound: "*field += (1.0 - UNSEEN) * *seen",
        broken: "*field += 0.0 * *seen",
        seen_by: &[(BAR_CONSISTENT, "averaging-softens")],
    },
    Fault {
        name: "splines are not interpolatory at walls",
        file: "explicit/start.rs",
        sound: "Lattice::new(scene.grid, settings.wall)",
        broken: "Lattice::new(scene.grid, crate::basis::WallTreatment::WallLine)",
        seen_by: &[(WALL_SPLINES, "order-displacement")],
    },
    Fault {
        name: "a wall holds the node before it too",
        file: "stage/wall.rs",
        sound: "x <= ends.lo + ON_WALL * grid.h",
        broken: "x <= ends.lo + grid.h",
        seen_by: &[(WALL, "order-displacement")],
    },
    Fault {
        name: "the strength is taken for that of the norm √(3/2)‖s‖",
        file: "material/hencky_j2.rs",
        sound: "std::f64::consts::SQRT_2 * shear_strength",
        broken: "3.0_f64.sqrt() * shear_strength",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "the strength in tension is taken for Tresca's",
        file: "material/hencky_j2.rs",
        sound: "std::f64::consts::SQRT_2 * shear_strength",
        broken: "(8.0_f64 / 3.0).sqrt() * shear_strength",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "the flow doesn't keep the volume",
        file: "material/hencky_j2.rs",
        sound: "direction.scale_add_identity(-share, T::default())",
        broken: "direction.scale_add_identity(-share, T::splat(-0.1) * flow)",
        seen_by: &[(FOOTING, "completes")],
    },
    Fault {
        name: "the law holds √(3/2) ‖s‖ against the strength of ‖s‖",
        file: "material/hencky_j2.rs",
        sound: "self.flow(shear * norm, plastic_strain)",
        broken: "self.flow(shear * norm * T::splat(1.5_f64.sqrt()), plastic_strain)",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "softening is forgotten",
        file: "material/hencky_j2.rs",
        sound: "(T::splat(-self.softening) * plastic_strain).exp()",
        broken: "(T::splat(0.0 * self.softening) * plastic_strain).exp()",
        seen_by: &[(SLIDE, "energy-closure")],
    },
    Fault {
        name: "the barrier presses back with half the force",
        file: "contact/mod.rs",
        sound: "self.reaction.force[a] -= force[a]",
        broken: "self.reaction.force[a] -= 0.5 * force[a]",
        seen_by: &[(BARRIER, "quasi-static")],
    },
    Fault {
        name: "a separable wall lets through and does not let go",
        file: "stage/wall.rs",
        sound: "Bound::AtLeast",
        broken: "Bound::AtMost",
        seen_by: &[(DAM, "completes")],
    },
    Fault {
        name: "a wall throws back twice what it stops",
        file: "explicit/stages.rs",
        sound: "*change += held - free",
        broken: "*change += 3.0 * (held - free)",
        seen_by: &[(DAM, "energy-not-gained")],
    },
    Fault {
        name: "the water's pressure is a tenth too low",
        file: "material/newtonian_fluid.rs",
        sound: "T::splat(self.bulk_modulus) * (j - T::splat(1.0))",
        broken: "T::splat(0.9 * self.bulk_modulus) * (j - T::splat(1.0))",
        seen_by: &[(RESTING, "pressure-profile")],
    },
    Fault {
        name: "one of eight stencils is its neighbour's",
        file: "lattice/stencils.rs",
        sound: "self.of.rows[slow][fast][a][self.l]",
        broken: "self.of.rows[slow][fast][a][self.l.max(1)]",
        seen_by: &[(RATE, "no-energy-gain")],
    },
    Fault {
        name: "the last of eight particles receives what that of the eight before did",
        file: "explicit/stages.rs",
        sound: "0..EIGHT",
        broken: "0..EIGHT - 1",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the place of a particle is that before the step",
        file: "explicit/rest.rs",
        sound: "x[a] += increment[a]",
        broken: "x[a] += Eight::ZERO * increment[a]",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the water is as viscous as tar",
        file: "material/newtonian_fluid.rs",
        sound: "2.0 * self.viscosity",
        broken: "2e7 * self.viscosity",
        seen_by: &[(DAM, "front")],
    },
];

/// A constant that is off by a millionth: no check against the truth can see it, the goldens do.
const DRIFT: Fault = Fault {
    name: "the neo-Hookean pressure is a millionth too large",
    file: "material/neo_hookean.rs",
    sound: "T::splat(0.5 * self.lambda) * squared_jacobian.ln()",
    broken: "T::splat(0.500_000_5 * self.lambda) * squared_jacobian.ln()",
    seen_by: &[],
};

/// Names the fault that is on.
const SWITCH: &str = "MPM_SEEDED_FAULT";

/// What the copy of the core gets besides the faults.
const SWITCHED: &str = r#"
#[inline]
pub(crate) fn seeded(fault: &str) -> bool {
    static ON: std::sync::LazyLock<Option<String>> =
        std::sync::LazyLock::new(|| std::env::var("MPM_SEEDED_FAULT").ok());
    ON.as_deref() == Some(fault)
}
"#;

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

/// Writes a fault into the copy, behind its switch.
fn seed(copy: &Path, fault: &Fault) {
    let Fault {
        name,
        sound,
        broken,
        ..
    } = fault;
    let path = copy.join("mpm-core/src").join(fault.file);
    let source = fs::read_to_string(&path).unwrap();
    let places = source.matches(sound).count();
    assert_eq!(places, 1, "{name}: the line has changed");
    let switched = format!("(if crate::seeded({name:?}) {{ {broken} }} else {{ {sound} }})");
    fs::write(&path, source.replace(sound, &switched)).unwrap();
}

/// The program of the copy.
struct Mutant<'a> {
    copy: &'a Path,
    program: PathBuf,
}

impl<'a> Mutant<'a> {
    fn build(copy: &'a Path) -> Self {
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
        Self {
            copy,
            program: target.join("mutant/mpm-verify"),
        }
    }

    /// Runs the program with a fault or none; returns the exit code and what it printed.
    fn call(&self, fault: Option<&Fault>, arguments: &[&str]) -> (i32, String) {
        let mut command = Command::new(&self.program);
        command
            .args(arguments)
            .current_dir(self.copy)
            .env_remove(SWITCH);
        if let Some(fault) = fault {
            command.env(SWITCH, fault.name);
        }
        let output = command.output().unwrap();
        (
            output.status.code().unwrap(),
            String::from_utf8_lossy(&output.stdout).into_owned(),
        )
    }

    /// All verdicts on some runs, one by one and together.
    fn judge(&self, fault: Option<&Fault>, runs: Runs) -> Vec<Verdict> {
        let records: Vec<Record> = runs
            .iter()
            .map(|run| {
                let folder = tempfile::tempdir_in(self.copy).unwrap();
                let mut arguments = vec!["run", "--threads", "1"];
                arguments.extend(run.split_whitespace());
                arguments.extend(["--out", folder.path().to_str().unwrap()]);
                let (code, text) = self.call(fault, &arguments);
                let record = folder.path().join("record.json");
                let record: Record = read_versioned(&record, record::SCHEMA).unwrap();
                let red = record.verdicts.iter().any(Verdict::failed);
                assert_eq!(code != 0, red, "{run}: exit code {code}: {text}");
                record
            })
            .collect();
        let case = cases::find(&records[0].case).unwrap();
        let mut verdicts = case.judge_study(&records);
        verdicts.extend(records.into_iter().flat_map(|r| r.verdicts));
        verdicts
    }

    /// What goes otherwise than it should. Runs are short and take one thread each: as many side by side as there are
    /// cores.
    fn complaints(&self) -> Vec<String> {
        let pairs: Vec<(&Fault, Runs, &str)> = FAULTS
            .iter()
            .flat_map(|f| {
                f.seen_by
                    .iter()
                    .map(move |(runs, check)| (f, *runs, *check))
            })
            .collect();
        let all: BTreeSet<Runs> = pairs.iter().map(|(_, runs, _)| *runs).collect();
        let sound: BTreeMap<Runs, Vec<Verdict>> = all
            .into_par_iter()
            .map(|runs| (runs, self.judge(None, runs)))
            .collect();
        let complaints = pairs.into_par_iter().flat_map(|(fault, runs, check)| {
            let mut complaints = Vec::new();
            let whole = &sound[runs];
            let held = |v: &Verdict| v.check == check && v.holds() == Some(true);
            if !whole.iter().any(held) || whole.iter().any(Verdict::failed) {
                complaints.push(format!("{check} of the sound program: {whole:#?}"));
            }
            let broken = self.judge(Some(fault), runs);
            let red = |v: &Verdict| v.check == check && v.failed();
            if !broken.iter().any(red) {
                complaints.push(format!("{} survives {check}: {broken:#?}", fault.name));
            }
            complaints
        });
        complaints.collect()
    }
}

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
    for fault in FAULTS.iter().chain([&DRIFT]) {
        seed(copy, fault);
    }
    let core = copy.join("mpm-core/src/lib.rs");
    let switched = fs::read_to_string(&core).unwrap() + SWITCHED;
    fs::write(core, switched).unwrap();
    let mutant = Mutant::build(copy);

    let mut complaints = mutant.complaints();
    fs::create_dir(copy.join("golden")).unwrap();
    let verify = [
        "verify", "cook", "--tier", "quick", "--golden", "golden", "--out", "report",
    ];
    let bless = [
        "bless", "cook", "--reason", "sound", "--golden", "golden", "--from", "report",
    ];
    for (arguments, expected) in [(&verify[..], 3), (&bless[..], 0), (&verify[..], 0)] {
        let (code, text) = mutant.call(None, arguments);
        if code != expected {
            complaints.push(format!(
                "the sound program, {arguments:?}: exit code {code}\n{text}"
            ));
        }
    }
    let (code, text) = mutant.call(Some(&DRIFT), &verify);
    if code != 3 || !text.contains("[DRIFT]") {
        complaints.push(format!("{} (exit code {code}, not 3):\n{text}", DRIFT.name));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
