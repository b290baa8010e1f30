use super::*;
use crate::cases;
use crate::parameter::Parameters;
use std::path::PathBuf;

mod bodies;
mod exact;
mod filled;
mod fuzz;
mod loads;
mod moves;
mod pairs;
mod random;
mod soil;
mod surfaces;
mod told;
mod weights;

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

/// A run of a shipped file, and the same of a case, at their start.
fn both(file: &str, case: &str, level: &str, set: &[&str]) -> [Box<dyn Job>; 2] {
    let scene = SceneFile::read(&shipped(file), 1.0, None).unwrap();
    let case = cases::find(case).unwrap();
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    let parameters = Parameters::new(&case.parameters, &set).unwrap();
    let spec = RunSpec {
        scheme: scene.spec.scheme,
        level: crate::case::find_level(case, level).unwrap(),
        set,
        perturbed: false,
    };
    let none = Parameters::new(&[], &[]).unwrap();
    [(scene.case.begin)(&scene.spec, &none).unwrap(), (case.begin)(&spec, &parameters).unwrap()]
}

/// Places of all particles.
fn places(job: &mut dyn Job) -> Vec<Vec<f64>> {
    let columns = job.particles().into_iter();
    let places = columns.filter(|c| ["x", "y", "z"].contains(&c.name));
    places.map(|c| c.values).collect()
}

/// Checks that `rows` rows of the file's run end, step for step, bit-identical to those of the case.
fn same_bits(file: &str, case: &str, level: &str, set: &[&str], rows: usize) {
    let [mut ours, mut cases] = both(file, case, level, set);
    assert_eq!(ours.discretisation(), cases.discretisation(), "{file}");
    let start = places(ours.as_mut());
    for _ in 0..rows {
        ours.advance().unwrap();
        cases.advance().unwrap();
    }
    assert_eq!(ours.work(), cases.work(), "{file}");
    assert_ne!(places(ours.as_mut()), start, "{file}");
    assert_eq!(places(ours.as_mut()), places(cases.as_mut()), "{file}");
}

#[test]
fn shipped_scenes_are_the_cases_to_the_last_bit() {
    same_bits("cook.toml", "cook", "h2", &[], 3);
    same_bits("footing.toml", "footing", "b10", &[], 2);
    same_bits("footing-quasi-static.toml", "footing", "b10", &[], 2);
    same_bits("terzaghi.toml", "terzaghi", "n10", &[], 3);
    same_bits("landslide.toml", "landslide", "h0.5", &[], 1);
    // The gate is taken away after twelve rows.
    let staged = ["start=gravity-stage"];
    same_bits("dam-break.toml", "dam-break", "h0.5", &staged, 13);
}

/// Error message for `slope.toml` with `from` replaced by `to`.
fn refusal(from: &str, to: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = std::fs::read_to_string(shipped("slope.toml")).unwrap();
    assert!(text.contains(from), "{from}");
    std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
    match SceneFile::read(&path, 1.0, None) {
        Ok(_) => format!("{to}: nothing is wrong with it"),
        Err(e) => e.to_string(),
    }
}

/// A support of `slope.toml`.
const BACK: &str = "wall = { name = \"back\", axis = \"x\", end = \"lo\", kind = \"roller\" }";

#[test]
fn a_phase_lasts_as_long_as_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = std::fs::read_to_string(shipped("slope.toml")).unwrap();
    std::fs::write(&path, text.replace("duration_s = 1.0", "duration_s = 0.05").replace("cfl = 0.3", "cfl = 0.9"))
        .unwrap();
    let scene = SceneFile::read(&path, 1.0, None).unwrap();
    let none = Parameters::new(&[], &[]).unwrap();
    let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
    let times: Vec<f64> = (0..3).map(|_| job.advance().unwrap().0[0].1).collect();
    for (time, expected) in times.iter().zip([0.02, 0.04, 0.05]) {
        // Rows are the nearest number of steps, the phase is exact.
        let tolerance = if *time < 0.045 { 2e-3 } else { 1e-9 };
        assert!((time - expected).abs() < tolerance, "{times:?}");
    }
}

#[test]
fn nodes_slide_along_a_region_without_ends_and_every_row_may_have_a_snapshot() {
    let along = "nodes = { name = \"n\", within = { y_m = [0, 0.5] }, velocity_m_s = { x = 0.1 } }";
    for (from, to) in [(BACK, along), ("snapshot_rows = 50", "snapshot_rows = 1")] {
        assert_eq!(refusal(from, to), format!("{to}: nothing is wrong with it"));
    }
}

#[test]
fn what_is_wrong_is_named_with_line_and_key() {
    // What is replaced, by what; what the error must say.
    let wrong: [(&str, &str, &[&str]); 35] = [
        ("rise_s = 0.4, phases = [\"weight\"]", "rise_s = 0.4", &["line 23", "rises in every phase anew"]),
        ("phases = [\"weight\"]", "phases = []", &["line 24", "no phase where one or more"]),
        ("row_s = 0.02\nsnapshot_rows = 50", "row_s = 5e-4\nsnapshot_rows = 1", &["[output]", "apart", "0.001 s"]),
        (
            "gravity = { acceleration_m_s2 = [0, -9.81], rise_s",
            "gravity = -9.81 #",
            &["line 24", "-9.81", "a table of keys"],
        ),
        ("cell_size_m", "cell_sise_m", &["line 7", "cell_sise_m", "is `cell_size_m` meant?"]),
        ("cell_size_m = 0.5", "cell_size_m = -0.5", &["line 7, cell_size_m", "-0.5", "positive"]),
        ("cell_size_m = 0.5", "cell_size_m = \"0.5\"", &["line 7, cell_size_m", "string"]),
        ("cells = [60, 14]", "cells = [60, 2]", &["line 9, cells", "2", "4 to 100000"]),
        ("lower_m = [0.0, 0.0]", "lower_m = [0.0]", &["line 6, [grid]", "lower_m", "2 axes"]),
        ("\"walls\", \"wall-open\"", "\"walls\", \"wal-open\"", &["line 10, ends", "is `wall-open` meant?"]),
        ("[law.hencky-j2]", "[law.hencky-j3]", &["hencky-j3", "hencky-j2"]),
        ("poisson_ratio = 0.49\n", "", &["poisson_ratio", "missing"]),
        ("poisson_ratio = 0.49", "poisson_ratio = 0.5", &["law", "Poisson's ratio", "0.5"]),
        (
            "[law.hencky-j2]",
            "[law.hencky]\nyoung_modulus_pa = 5e6\npoisson_ratio = 0.3\n[law.hencky-j2]",
            &["law", "one kind of it is allowed"],
        ),
        ("format = 1", "", &["own.toml: line 1: missing field `format`"]),
        ("cfl = 0.3", "cfl = 3", &["cfl: 3 where", "at most 1"]),
        ("[30, 0], [30, 1]", "[30, 1], [30, 0]", &["line 15", "side 1 crosses its side 3"]),
        ("[10, 5], [0, 5]", "[10, 9], [0, 9]", &["line 15", "a particle at y = ", "off the grid", "from 0 to 7 m"]),
        ("polygon = {", "polygone = {", &["line 16, polygone", "is `polygon` meant?"]),
        ("[10, 5], [0, 5]", "[10, 1e9], [0, 5]", &["line 15", "50000000"]),
        ("[0, -9.81], rise_s", "[0, -9.81, 0], rise_s", &["acceleration_m_s2 has 3 numbers", "2 axes"]),
        ("phases = [\"weight\"]", "phases = [\"wait\"]", &["\"wait\"", "weight, slide"]),
        ("axis = \"y\"", "axis = \"z\"", &["axis z"]),
        ("name = \"base\"", "name = \"=cmd()\"", &["=cmd()", "lower-case letters"]),
        ("bspline2-fbar-consistent-flip", "gimp-fbar-flip", &["[solver]", "fbar", "fbar-consistent"]),
        ("cfl = 0.3", "cfl = 0.3\ntolerance = 1e-9", &["tolerance has no meaning"]),
        ("duration_s = 1.0", "duration_s = inf", &["duration_s", "inf"]),
        ("cfl = 0.3", "time_step_s = 0.3", &["1 s in steps of 0.3 s", "whole steps"]),
        ("[30, 0], [30, 1]", "[30, 0, 7], [30, 1]", &["line 15", "a corner has 3 numbers", "2 axes"]),
        ("name = \"back\"", "name = \"base\"", &["line 33", "a second support, contact or body \"base\""]),
        ("end = \"lo\", kind = \"fixed\"", "end = \"hi\", kind = \"fixed\"", &["line 33", "a wall at an end"]),
        (
            BACK,
            "nodes = { name = \"n\", within = { x_m = [3, 2] }, velocity_m_s = { x = 0 } }",
            &["[3.0, 2.0]", "lower"],
        ),
        (
            BACK,
            "nodes = { name = \"n\", within = { x_m = [1, 2, 3] }, velocity_m_s = { x = 0 } }",
            &["[1.0, 2.0, 3.0]"],
        ),
        (
            BACK,
            "nodes = { name = \"n\", within = { x_m = [1.1, 1.2] }, velocity_m_s = { x = 0 } }",
            &["line 29", "holds no node"],
        ),
        (
            BACK,
            "nodes = { name = \"n\", within = { x_m = [0, 2] }, velocity_m_s = { x = 0.1 }, rise_s = 1 }",
            &["line 29", "0.3", "half a cell", "0.25 m"],
        ),
    ];
    for (from, to, parts) in wrong {
        let said = refusal(from, to);
        assert!(said.contains("own.toml: ") && !said.contains("Form"), "{said}");
        for part in parts {
            assert!(said.contains(part), "{part} in: {said}");
        }
    }
}

#[test]
fn particles_stand_where_shapes_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = std::fs::read_to_string(shipped("slope.toml")).unwrap();
    let shape = text.lines().find(|line| line.starts_with("polygon")).unwrap();
    let count = |by: &str| {
        std::fs::write(&path, text.replace(shape, by)).unwrap();
        SceneFile::read(&path, 1.0, None).map(|scene| {
            let none = Parameters::new(&[], &[]).unwrap();
            let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
            job.particles()[0].values.len()
        })
    };
    let square = "box = { from_m = [0, 4], to_m = [4, 0] }";
    assert_eq!(count(square).unwrap(), 256);
    // What two shapes cover is there once.
    let twice = format!("{square}\n[[body.shapes]]\nbox = {{ from_m = [2, 0], to_m = [6, 4] }}");
    assert_eq!(count(&twice).unwrap(), 384);
    let disc = count("disc = { centre_m = [10, 3], radius_m = 2.5 }").unwrap();
    assert!((disc as f64 / 16.0 - 2.5 * 2.5 * std::f64::consts::PI).abs() < 1.0, "{disc}");
    std::fs::write(folder.path().join("p.csv"), "x (m),y (m)\n1.1,1\n2.3,1\n").unwrap();
    assert_eq!(count("particles = { file = \"p.csv\" }").unwrap(), 2);
    let table = "particles = { file = \"p.csv\" }";
    std::fs::write(folder.path().join("p.csv"), "x (m),y (m),volume (m²),velocity_x (m/s)\n1.1,1,0.2,2\n2.3,1,0.1,0\n")
        .unwrap();
    assert_eq!(count(table).unwrap(), 2);
    let scene = SceneFile::read(&path, 1.0, None).unwrap();
    assert!(scene.made[0].contains("0.30 m²"), "{}", scene.made[0]);
    let none = Parameters::new(&[], &[]).unwrap();
    let start = (scene.case.begin)(&scene.spec, &none).unwrap().particles();
    let velocity = start.iter().find(|column| column.name == "velocity_x").unwrap();
    let mut found = velocity.values.clone();
    found.sort_by(f64::total_cmp);
    assert_eq!(found, [0.0, 2.0]);
    for (text, part) in [
        ("x (mm),y (m)\n1.1,1\n", "x (mm)"),
        ("x (m),y (m),mass (kg)\n1.1,1,3\n", "mass (kg)"),
        ("x (m),y (m)\n1.1,1\n1.15,1.1\n", "overlap"),
        ("x (m),y (m),volume (m²)\n1.1,1,0.3\n", "0.25"),
        ("x (m)\n1.1\n", "y (m)"),
    ] {
        std::fs::write(folder.path().join("p.csv"), text).unwrap();
        let said = count(table).unwrap_err().to_string();
        assert!(said.contains(part), "{part} in: {said}");
    }
    let twice = format!("{square}\n[[body.shapes]]\n{table}");
    std::fs::write(folder.path().join("p.csv"), "x (m),y (m)\n1.1,1\n").unwrap();
    assert!(count(&twice).unwrap_err().to_string().contains("overlap"));
    for (by, part) in [
        ("particles = { file = \"../p.csv\" }", "beside the scene"),
        ("particles = { file = \"q.csv\" }", "q.csv"),
        ("box = { from_m = [0, 0], to_m = [0.1, 0.1] }", "without a particle"),
    ] {
        let said = count(by).unwrap_err().to_string();
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn a_strength_is_divided_in_every_phase_where_there_is_one() {
    let weak = SceneFile::read(&shipped("slope.toml"), 2.0, None).unwrap();
    for (line, strength) in weak.made[1..].iter().zip(["10000 Pa", "4000 Pa"]) {
        assert!(line.contains(strength), "{line}");
    }
    assert_eq!(weak.height, 4.0);
    let refused = SceneFile::read(&shipped("cook.toml"), 2.0, None).err().unwrap().to_string();
    assert!(refused.contains("law") && refused.contains("no strength"), "{refused}");
}

#[test]
fn pictures_tell_title_phase_and_time_and_show_bodies_and_supports() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let pushes =
        "nodes = { name = \"n\", within = { x_m = [0, 1], y_m = [0, 5] }, velocity_m_s = { x = 0.2 }, moves = true }";
    std::fs::write(&path, std::fs::read_to_string(shipped("slope.toml")).unwrap().replace(BACK, pushes)).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let base = "end = \"lo\", kind = \"fixed\"";
    let own = folder.path().join("first.toml");
    std::fs::write(&own, text.replace(base, &format!("{base}, phases = [\"weight\"]"))).unwrap();
    let first = SceneFile::read(&own, 1.0, None).unwrap().case.scenery.unwrap();
    let held = |time: f64| (first.around)(time).iter().filter(|(_, is_support)| *is_support).count();
    assert_eq!([held(0.5), held(2.0)], [3, 2]);
    let scenery = SceneFile::read(&path, 1.0, None).unwrap().case.scenery.unwrap();
    let heading = |time: f64| (scenery.heading)(time);
    assert_eq!(heading(scenery.end), "A bank of soft clay slides: slide, t = 4 s");
    assert_eq!([heading(0.0), heading(1.0)].map(|h| h.contains("weight")), [true; 2]);
    for (time, x) in [(0.0, 0.0), (2.5, 0.5), (4.0, 0.8)] {
        let around = (scenery.around)(time);
        let (supports, bodies): (Vec<_>, Vec<_>) = around.iter().partition(|(_, is_support)| *is_support);
        assert_eq!((bodies[0].0.len(), supports.len()), (7, 3));
        let base = [(0.0, 0.0), (30.0, 0.0), (30.0, 0.0), (0.0, 0.0), (0.0, 0.0)];
        assert_eq!(supports[2].0[..], base[..]);
        assert!((supports[0].0[0].0 - x).abs() < 1e-9, "{time}: {supports:?}");
    }
}
