//! Scenes of several bodies.

use super::*;

/// Rows of a shipped scene by the names of its columns, and columns of its particles at their end.
fn rows(file: &str, rows: usize) -> (Vec<Row>, Vec<crate::job::Column>) {
    rows_of(&shipped(file), rows)
}

pub(super) fn rows_of(path: &Path, rows: usize) -> (Vec<Row>, Vec<crate::job::Column>) {
    let scene = SceneFile::read(path, 1.0, None).unwrap();
    let none = Parameters::new(&[], &[]).unwrap();
    let mut job = (scene.case.begin)(&scene.spec, &none).unwrap();
    let rows = (0..rows).map(|_| job.advance().unwrap()).collect();
    (rows, job.particles())
}

pub(super) fn last(rows: &[Row], name: &str) -> f64 {
    let row = &rows.last().unwrap().0;
    row.iter().find(|(known, _)| *known == name).unwrap_or_else(|| panic!("{name} in {row:?}")).1
}

/// A block of mass m that begins at v slides v²/(2 μ g) far, and v t₀/2 more where gravity rises over t₀.
#[test]
fn a_block_comes_to_rest_where_friction_says() {
    let (rows, particles) = rows("block-on-clay.toml", 150);
    let exact = 9.0 / (2.0 * 0.3 * 9.81) + 0.5 * 3.0 * 0.1;
    let slid = last(&rows, "block_moved_x (m)");
    assert!((slid / exact - 1.0).abs() < 0.02, "{slid} of {exact}");
    assert!(last(&rows, "clay_moved_x (m)").abs() < 0.01);
    // The mean of the last half second, in which the block sways on its bed.
    let mean = |name: &str| rows[100..].iter().map(|row| last(std::slice::from_ref(row), name)).sum::<f64>() / 50.0;
    let weight = 2400.0 * 1.5 * 9.81;
    let (up, down) = (mean("block_y (N/m)"), mean("clay_y (N/m)"));
    assert!((up / weight - 1.0).abs() < 0.05 && (up + down).abs() < 1e-9 * weight, "{up} of {weight}");
    let body = particles.iter().find(|column| column.name == "body").unwrap();
    assert_eq!(body.values.iter().filter(|body| **body == 1.0).count(), 12 * 8);
}

#[test]
fn layers_bear_what_lies_on_them() {
    let (rows, particles) = rows("layers.toml", 150);
    // The fill sinks, with the clay below it, and the gravel hardly.
    let [gravel, clay, fill] = ["gravel", "clay", "fill"].map(|name| last(&rows, &format!("{name}_moved_y (m)")));
    assert!(fill < 2.0 * clay && clay < 3.0 * gravel && gravel < 0.0, "{gravel} {clay} {fill}");
    // All that there is stands on the base.
    let weight = 9.81 * (2000.0 * 48.0 + 1600.0 * 96.0 + 1900.0 * 27.0);
    let base = last(&rows, "base_y (N/m)");
    assert!((-base / weight - 1.0).abs() < 0.05, "{base} of {weight}");
    assert!(particles.iter().any(|column| column.name == "body"));
}

#[test]
fn water_flows_over_a_bed() {
    let (rows, _) = rows("water-on-soil.toml", 10);
    assert!(last(&rows, "water_moved_x (m)") > 10.0 * last(&rows, "bed_moved_x (m)").abs());
}

#[test]
fn what_bodies_cannot_be_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = std::fs::read_to_string(shipped("block-on-clay.toml")).unwrap();
    let scheme = "bspline2-fbar-consistent-flip\"\ncfl = 0.3";
    for (from, to, parts) in [
        ("name = \"block\"\n", "", &["[[bodies]]", "a body without a name"][..]),
        ("name = \"block\"", "name = \"clay\"", &["a second support, contact or body \"clay\""]),
        ("name = \"block\"", "name = \"base\"", &["a second support, contact or body \"base\""]),
        ("[bodies.law.hencky]", "[law.hencky]", &["law"]),
        ("friction = 0.3", "friction = -0.3", &["friction", "-0.3", "zero or a positive"]),
        ("friction = 0.3", "particles_per_direction = 2", &["particles_per_direction is that of [body]"]),
        ("from_m = [2, 2]", "from_m = [2, 1]", &["a particle of two bodies at"]),
        ("[3, 0]\nfriction", "[3, 0, 0]\nfriction", &["velocity_m_s has 3 numbers"]),
        (scheme, "quasi-static-gimp-none\"\ntime_step_s = 0.01", &["slide need an explicit scheme"]),
        (scheme, "gimp-none-flip\"\ncfl = 0.3\n#", &["nothing is wrong"]),
        ("friction = 0.3", "porosity = 0.3", &["there is no [water]"]),
        ("particles_per_direction = 2\n", "", &["no particles_per_direction"]),
        ("particles_per_direction = 2", "particles_per_direction = 2\nremedy = false", &["nothing is wrong"]),
    ] {
        assert!(text.contains(from), "{from}");
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let said = match SceneFile::read(&path, 1.0, None) {
            Ok(_) => "nothing is wrong".to_owned(),
            Err(e) => e.to_string(),
        };
        for part in parts {
            assert!(said.contains(part), "{part} in: {said}");
        }
    }
    let sticking = text.replacen("friction = 0.3\n", "", 1);
    let implicit = sticking.replacen(scheme, "midpoint-gimp-fbar-consistent\"\ntime_step_s = 0.01", 1);
    let plain = sticking.replacen("bspline2-fbar-consistent-flip", "gimp-none-flip", 1);
    let lacking = plain.replacen("name = \"block\"", "name = \"block\"\nremedy = false", 1);
    for (text, part) in [(implicit, "average over one body"), (lacking, "no remedy that a body could be without")] {
        std::fs::write(&path, text).unwrap();
        let said = SceneFile::read(&path, 1.0, None).map(drop).unwrap_err().to_string();
        assert!(said.contains(part) && said.contains("own.toml: line"), "{part} in: {said}");
    }
}

/// Terzaghi's column in two halves, of which the upper one has other pores.
fn halves(upper: &str) -> String {
    let text = std::fs::read_to_string(shipped("terzaghi.toml")).unwrap();
    let lower = text.replace("to_m = [1] }", "to_m = [0.5] }");
    let more = format!(
        "[[bodies]]\nname = \"upper\"\ndensity_kg_m3 = 1000\n{upper}[[bodies.shapes]]\n\
         box = {{ from_m = [0.5], to_m = [1] }}\n[bodies.law.hencky]\nyoung_modulus_pa = 1e7\npoisson_ratio = 0.25\n"
    );
    assert!(lower != text);
    lower.replace("[water]", &format!("{more}[water]"))
}

#[test]
fn layers_have_pores_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let drained = |upper: &str| {
        let path = folder.path().join("own.toml");
        std::fs::write(&path, halves(upper)).unwrap();
        let rows = rows_of(&path, 32).0;
        last(&rows, "outflow (m³)")
    };
    let text = shipped("terzaghi.toml");
    let whole = last(&rows_of(&text, 32).0, "outflow (m³)");
    assert!((drained("") / whole - 1.0).abs() < 1e-9, "{} of {whole}", drained(""));
    // As long as the floor is not felt, 2 q √(κ t/(π M)) has gone out: half, if κ is a quarter. Pressure's cells are 0.2 m.
    let tight = drained("conductivity.constant = { m2_pa_s = 2.5484199796126405e-10 }\n");
    assert!((tight / whole - 0.5).abs() < 0.05, "{tight} of {whole}");
}
