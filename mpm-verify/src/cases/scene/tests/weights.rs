//! A scene is weighed before it is built: by about as much as it takes.

use super::*;

/// Bytes at most that a scene of `cells` along each axis takes, over those that it was weighed by.
fn taken(dimension: usize, law: (&str, &str), scheme: &str, cells: u32, phases: u32) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let more = "[[phases]]\nname = \"again\"\nduration_s = 2e-3\n[output]";
    let mut text = pairs::text(dimension, law, scheme);
    for (from, to) in [
        ("8", (cells + 6).to_string()),
        ("to_m = [2", format!("to_m = [{cells}")),
        (", 2", format!(", {cells}")),
        (", 8", format!(", {}", cells + 6)),
        ("y_m = [1.7", format!("y_m = [{cells}")),
    ] {
        text = text.replace(from, &to);
    }
    if phases > 1 {
        text = text.replace("[output]", more).replace(", rise_s = 1", "");
    }
    std::fs::write(&path, &text).unwrap();
    let none = Parameters::new(&[], &[]).unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut weighed = 0.0;
    let counted = pool.install(|| {
        allocation_counter::measure(|| {
            let scene = SceneFile::read(&path, 1.0, None).unwrap_or_else(|e| panic!("{e}\n{text}"));
            weighed = scene.case.size.unwrap().bytes;
            let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
            for _ in 0..phases {
                let _ = job.advance();
            }
        })
    });
    counted.bytes_max as f64 / weighed
}

#[test]
fn a_scene_takes_about_as_much_as_it_is_weighed_by() {
    for (dimension, law, scheme, cells, phases) in [
        (1, 0, "gimp-none-flip", 5000, 1),
        (2, 0, "gimp-none-flip", 120, 1),
        (2, 3, "gimp-none-flip", 120, 1),
        (2, 3, "bspline2-fbar-consistent-flip", 120, 1),
        (2, 3, "bspline2-fbar-consistent-apic", 120, 1),
        (2, 3, "bspline2-fbar-consistent-flip", 120, 2),
        (3, 0, "gimp-none-flip", 16, 1),
        (3, 3, "gimp-fbar-consistent-flip", 16, 1),
        (3, 3, "bspline2-fbar-consistent-flip", 16, 2),
        (2, 0, "quasi-static-gimp-none", 40, 1),
        (2, 0, "quasi-static-bspline2-fbar-consistent", 40, 1),
        (2, 0, "newmark-gimp-none", 40, 1),
        (3, 0, "quasi-static-gimp-none", 8, 1),
        (2, 1, "poro-gimp-two-grid", 40, 1),
        (2, 1, "poro-gimp-equal", 40, 2),
    ] {
        let ratio = taken(dimension, pairs::LAWS[law], scheme, cells, phases);
        assert!((0.3..0.95).contains(&ratio), "{dimension}D {} {scheme} {cells} {phases}: {ratio}", pairs::LAWS[law].0);
    }
}
