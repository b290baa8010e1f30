//! Keys that a scene file leaves out are filled in, kept and told.

use super::*;
use crate::run::checkpoint::Saving;
use crate::study::judge::judged_run;
use std::collections::BTreeMap;

/// The reference of scene files.
const REFERENCE: &str = include_str!("../../../../../docs/reference/scene-files.md");

fn filled(path: &Path) -> String {
    SceneFile::read(path, 1.0, None).unwrap().case.scenery.unwrap().filled
}

/// Keys of `filled` that `given` lacks, with their values; tables and lists are looked into.
fn added(given: Option<&toml::Value>, filled: &toml::Value, found: &mut BTreeMap<String, String>) {
    match filled {
        toml::Value::Table(all) => {
            for (key, value) in all {
                let before = given.and_then(|given| given.get(key));
                if before.is_none() && !value.is_table() && !value.is_array() {
                    found.insert(key.clone(), value.to_string());
                }
                added(before, value, found);
            }
        }
        toml::Value::Array(all) => {
            for (k, value) in all.iter().enumerate() {
                added(given.and_then(|given| given.get(k)), value, found);
            }
        }
        _ => {}
    }
}

/// Shipped files, one of every kind of solver among them, and laws with defaults.
fn files(folder: &Path) -> Vec<PathBuf> {
    let own = [
        ("clay.toml", pairs::text(2, pairs::LAWS[6], "poro-gimp-two-grid")),
        ("sand.toml", pairs::text(2, pairs::LAWS[2], "midpoint-gimp-none")),
        ("nodes.toml", {
            let text = std::fs::read_to_string(shipped("slope.toml")).unwrap();
            let nodes = "nodes = { name = \"n\", within = { x_m = [0, 0.5] }, velocity_m_s = { x = 0 } }";
            text.replace(BACK, nodes)
        }),
    ];
    let own = own.map(|(name, text)| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path
    });
    let all = std::fs::read_dir(shipped("")).unwrap().map(|entry| entry.unwrap().path());
    all.chain(own).collect()
}

#[test]
fn a_filled_file_is_the_same_scene_and_lacks_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for path in files(folder.path()) {
        let (again, first) = (folder.path().join("again.toml"), filled(&path));
        std::fs::write(&again, &first).unwrap();
        assert_eq!(filled(&again), first, "{}", path.display());
        let [from, to] = [&path, &again].map(|path| SceneFile::read(path, 1.0, None).unwrap());
        assert_eq!((from.spec.scheme, from.made), (to.spec.scheme, to.made), "{}", path.display());
    }
    // Bit for bit.
    let again = folder.path().join("again.toml");
    std::fs::write(&again, filled(&shipped("slope.toml"))).unwrap();
    let none = Parameters::new(&[], &[]).unwrap();
    let [from, to] = [shipped("slope.toml"), again].map(|path| {
        let scene = SceneFile::read(&path, 1.0, None).unwrap();
        let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
        job.advance().unwrap();
        places(job.as_mut())
    });
    assert_eq!(from, to);
}

#[test]
fn the_reference_tells_every_default() {
    let folder = tempfile::tempdir().unwrap();
    let mut defaults = BTreeMap::new();
    for path in files(folder.path()) {
        let given: toml::Value = toml::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        added(Some(&given), &toml::from_str(&filled(&path)).unwrap(), &mut defaults);
    }
    assert!(defaults.len() >= 16, "{defaults:?}");
    let same = |told: &str, value: &str| match (told.parse::<f64>(), value.parse::<f64>()) {
        (Ok(told), Ok(value)) => told == value,
        _ => told.trim_matches('`') == value.trim_matches('"'),
    };
    let rows = REFERENCE.lines().filter_map(|line| match &line.split('|').map(str::trim).collect::<Vec<_>>()[..] {
        [_, _, key, told, ..] if key.starts_with('`') => Some((key.trim_matches('`'), *told)),
        _ => None,
    });
    let rows: Vec<(&str, &str)> = rows.collect();
    for (key, value) in &defaults {
        let in_row = rows.iter().any(|(row, told)| row == key && same(told, value));
        let head = format!("`{key}` (");
        let in_text: Vec<&str> = REFERENCE.split(&head).skip(1).filter_map(|rest| rest.split(')').next()).collect();
        let told = in_row || (!in_text.is_empty() && in_text.iter().all(|told| same(told, value)));
        assert!(told, "{key} = {value} is not told, but {in_text:?}");
    }
    // A number or a word of code that the table tells is that of the code.
    for (key, told) in rows.iter().filter(|(_, told)| told.starts_with('`') || told.parse::<f64>().is_ok()) {
        assert!(defaults.get(*key).is_some_and(|value| same(told, value)), "{key}: {told}");
    }
}

/// Its page tells warnings and input, and shows every picture, the motion among them.
#[test]
fn a_run_has_a_page_with_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = std::fs::read_to_string(shipped("slope.toml")).unwrap();
    let short =
        text.replace("duration_s = 3.0", "duration_s = 0.4").replace("snapshot_rows = 50", "snapshot_rows = 10");
    std::fs::write(&path, short).unwrap();
    let scene = SceneFile::read(&path, 1.0, None).unwrap();
    assert!(scene.moves);
    let out = folder.path().join("out");
    let saving = Saving { every: std::time::Duration::from_secs(60), resume: false };
    let record = judged_run(&scene.case, &scene.spec, Some((&out, saving)), 1, &|_| {}).unwrap();
    let pictures = crate::report::single::draw(&scene.case, &record, &out, true).unwrap();
    let names: Vec<&str> = pictures.iter().map(|p| p.file.trim_start_matches("scene/")).collect();
    let all = ["particles.png", "displacement.png", "mean-stress.png", "velocity.png", "history.png", "motion.png"];
    assert_eq!(names, all);
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    for picture in &pictures {
        assert!(page.contains(&picture.file) && out.join(&picture.file).exists(), "{}", picture.file);
    }
    for part in ["A bank of soft clay slides", "solver.kinetic_damping", "settlement", "base_y (N", "not judged"] {
        assert!(page.contains(part), "{part}");
    }
    let decoder = png::Decoder::new(std::fs::File::open(out.join("scene/motion.png")).unwrap());
    let frames = decoder.read_info().unwrap().info().animation_control.unwrap().num_frames;
    assert_eq!(frames as usize, std::fs::read_dir(out.join("snapshots")).unwrap().count() / 2);
}
