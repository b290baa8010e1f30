//! Ground with friction that begins under its weight.

use super::bodies::{last, rows_of};
use super::*;

/// Sand under a fill of clay, level, three metres each.
const LEVEL: &str = "format = 1
title = \"Level ground\"
[grid]
cell_size_m = 0.5
lower_m = [0, 0]
cells = [8, 16]
ends = [\"walls\", \"wall-open\"]
[body]
name = \"sand\"
density_kg_m3 = 2000
particles_per_direction = 2
k0 = 0.5
[[body.shapes]]
box = { from_m = [0, 0], to_m = [4, 3] }
[law.drucker-prager]
young_modulus_pa = 5e6
poisson_ratio = 0.3
cohesion_pa = 0
friction_deg = 30
[[bodies]]
name = \"clay\"
density_kg_m3 = 1600
k0 = 0.8
[[bodies.shapes]]
box = { from_m = [0, 3], to_m = [4, 6] }
[bodies.law.hencky-j2]
young_modulus_pa = 2e6
poisson_ratio = 0.3
strength.undrained = { shear_strength_pa = 20e3 }
[[loads]]
gravity = { acceleration_m_s2 = [0, -9.81] }
[[supports]]
wall = { name = \"base\", axis = \"y\", end = \"lo\", kind = \"roller\" }
[[supports]]
wall = { name = \"left\", axis = \"x\", end = \"lo\", kind = \"roller\" }
[[supports]]
wall = { name = \"right\", axis = \"x\", end = \"hi\", kind = \"roller\" }
[solver]
scheme = \"quasi-static-gimp-none\"
time_step_s = 1
[[phases]]
name = \"rest\"
duration_s = 2
[output]
row_s = 1
";
const EXPLICIT: &str = "scheme = \"gimp-none-flip\"\ncfl = 0.3";

#[test]
fn layers_begin_under_their_weight_and_rest() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let run = |text: &str| {
        std::fs::write(&path, text).unwrap();
        rows_of(&path, 2)
    };
    let (rows, particles) = run(LEVEL);
    assert_eq!(last(&rows, "displacement_max (m)"), 0.0);
    let column = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    let [y, xx, yy] = ["y", "stress_xx", "stress_yy"].map(column);
    for ((y, xx), yy) in y.iter().zip(xx).zip(yy) {
        let (weight, k0) = if *y > 3.0 { (1600.0 * (6.0 - y), 0.8) } else { (4800.0 + 2000.0 * (3.0 - y), 0.5) };
        let vertical = -9.81 * weight;
        assert!((yy / vertical - 1.0).abs() < 1e-9 && (xx / (k0 * vertical) - 1.0).abs() < 1e-9, "{y}: {xx} {yy}");
    }
    // A later phase goes on with what it finds, weaker ground as well, which could not begin so.
    let law =
        "law.drucker-prager = { young_modulus_pa = 5e6, poisson_ratio = 0.3, cohesion_pa = 0, friction_deg = 15 }";
    let weaker = format!("[[phases]]\nname = \"weaker\"\nduration_s = 1\n{law}\n[output]");
    std::fs::write(&path, LEVEL.replace("[output]", &weaker)).unwrap();
    assert!(SceneFile::read(&path, 1.0, None).is_ok());
    std::fs::write(&path, LEVEL.replace("friction_deg = 30", "friction_deg = 15")).unwrap();
    assert!(SceneFile::read(&path, 1.0, None).is_err());
    // In motion, by the imbalance of a cell at the surface and at the joint: (h/H)² of ρ g H²/(2 M).
    let text = LEVEL.replace("scheme = \"quasi-static-gimp-none\"\ntime_step_s = 1", EXPLICIT);
    let (rows, _) = run(&text);
    let settles = 2000.0 * 9.81 * 36.0 / (2.0 * 2e6 * 1.35);
    let moved = last(&rows, "displacement_max (m)");
    assert!(moved < settles / 144.0, "{moved} of {settles}");
}

#[test]
fn ground_that_cannot_begin_so_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let gravity = "[0, -9.81] }";
    for (from, to, parts) in [
        (gravity, "[0, -9.81], rise_s = 1 }", &["line 8", "k0 needs one gravity", "without rise_s"][..]),
        (gravity, "[1, -9.81] }", &["k0 needs one gravity", "down along the last axis"]),
        (gravity, "[0, 9.81] }", &["k0 needs one gravity"]),
        (
            gravity,
            "[0, -9.81], phases = [\"rest\"] }\n[[loads]]\ngravity = { acceleration_m_s2 = [0, -1] }",
            &["one gravity"],
        ),
        ("k0 = 0.5", "k0 = -0.5", &["k0", "-0.5"]),
        ("young_modulus_pa = 5e6", "young_modulus_pa = 0.1", &["stress", "without flow"]),
        ("friction_deg = 30", "friction_deg = 95", &["friction", "below π/2"]),
        ("friction_deg = 30", "friction_deg = 30\ndilation_deg = 31", &["dilation", "angle of friction"]),
        ("friction_deg = 30", "friction_deg = 30\nmatched = \"cone\"", &["cone", "plane-strain"]),
        ("cohesion_pa = 0\nfriction_deg = 30", "cohesion_pa = 0\nfriction_deg = 0", &["cohesion"]),
    ] {
        assert!(LEVEL.contains(from), "{from}");
        std::fs::write(&path, LEVEL.replacen(from, to, 1)).unwrap();
        let said = SceneFile::read(&path, 1.0, None).err().map(|e| e.to_string()).unwrap_or_default();
        for part in parts {
            assert!(said.contains(part), "{to}: {said:?} lacks {part:?}");
        }
    }
    // Rankine's active pressure of 30° is a third.
    std::fs::write(&path, LEVEL.replacen("k0 = 0.5", "k0 = 0.25", 1)).unwrap();
    let said = SceneFile::read(&path, 1.0, None).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(said.contains("at the start") && said.contains("without flow"), "{said}");
}

/// Weaker by 2: half the cohesion and half the tangent.
#[test]
fn strength_with_friction_is_divided() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    // The active pressure of the weaker sand is (1 − sin φ)/(1 + sin φ) = 0.565 of the vertical one.
    let half = (30_f64.to_radians().tan() / 2.0).atan().sin();
    let active = (1.0 - half) / (1.0 + half);
    for (k0, begins) in [(0.98 * active, false), (1.02 * active, true)] {
        let own = format!("k0 = {k0}\n");
        let text = LEVEL.replace("k0 = 0.5\n", &own).replace("k0 = 0.8\n", "k0 = 1\n");
        // Two equal stresses: the cone of triaxial compression, or the pyramid's edge.
        let cone = text.replace("friction_deg = 30\n", "friction_deg = 30\nmatched = \"compression\"\n");
        let pyramid = text.replace("[law.drucker-prager]", "[law.mohr-coulomb]");
        for ground in [cone, pyramid] {
            std::fs::write(&path, ground).unwrap();
            assert!(SceneFile::read(&path, 1.0, None).is_ok());
            assert_eq!(SceneFile::read(&path, 2.0, None).is_ok(), begins, "{k0}");
        }
    }
}

/// A table with the stress that `k0` gives makes the same scene; a part of it alone, or with `k0`, is refused.
#[test]
fn a_table_gives_the_stress_at_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let begin = LEVEL.find("[[bodies]]").unwrap();
    let end = LEVEL.find("[[loads]]").unwrap();
    let layer = format!("{}{}", &LEVEL[..begin], &LEVEL[end..]);
    std::fs::write(&path, &layer).unwrap();
    let (_, particles) = rows_of(&path, 1);
    let column = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    let names = ["x", "y", "stress_xx", "stress_yy", "stress_zz", "stress_xy"];
    let units = ["m", "m", "Pa", "Pa", "Pa", "Pa"];
    let write = |count: usize| {
        let head: Vec<String> = names.iter().zip(units).map(|(name, unit)| format!("{name} ({unit})")).collect();
        let row =
            |k: usize| names[..count].iter().map(|name| column(name)[k].to_string()).collect::<Vec<_>>().join(",");
        let rows: Vec<String> = (0..column("x").len()).map(row).collect();
        std::fs::write(folder.path().join("own.csv"), head[..count].join(",") + "\n" + &rows.join("\n") + "\n")
            .unwrap();
    };
    write(6);
    let shape = "box = { from_m = [0, 0], to_m = [4, 3] }";
    let tabled = layer.replace(shape, "particles = { file = \"own.csv\" }");
    let refused = |text: &str| {
        std::fs::write(&path, text).unwrap();
        SceneFile::read(&path, 1.0, None).err().unwrap().to_string()
    };
    assert!(refused(&tabled).contains("without k0"));
    let own = tabled.replace("k0 = 0.5\n", "");
    std::fs::write(&path, &own).unwrap();
    let (rows, _) = rows_of(&path, 2);
    assert_eq!(last(&rows, "displacement_max (m)"), 0.0);
    write(4);
    assert!(refused(&own).contains("no column \"stress_zz (Pa)\""));
    // Without any stress it settles.
    write(2);
    std::fs::write(&path, &own).unwrap();
    assert!(last(&rows_of(&path, 2).0, "displacement_max (m)") > 1e-3);
}

/// [`LEVEL`] with water in its pores: 2000 and 1600 kg/m³ are those of saturated ground.
fn soaked() -> String {
    let water = "[water]\nporosity = 0.4\nconductivity.constant = { m2_pa_s = 1e-8 }\ndensity_kg_m3 = 1000
drained = { y_m = [5.9, inf] }\n[[supports]]\nwall = { name = \"base\"";
    LEVEL
        .replace("quasi-static-gimp-none", "poro-gimp-two-grid")
        .replacen("[[supports]]\nwall = { name = \"base\"", water, 1)
        .replacen("k0 = 0.8", "k0 = 0.8\nporosity = 0.5", 1)
}

/// Its water is hydrostatic from the top, and K₀ is the ratio of what the grains bear; a later load adds to both.
#[test]
fn layers_with_water_begin_under_their_weight_and_rest() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let text = soaked();
    let run = |text: &str| {
        std::fs::write(&path, text).unwrap();
        rows_of(&path, 2)
    };
    let (rows, particles) = run(&text);
    let size = 2000.0 * 9.81 * 36.0 / (2.0 * 2e6);
    assert!(last(&rows, "displacement_max (m)") < 1e-9 * size, "{}", last(&rows, "displacement_max (m)"));
    let column = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    let [y, xx, yy, p] = ["y", "stress_xx", "stress_yy", "pore_pressure"].map(column);
    for (((y, xx), yy), p) in y.iter().zip(xx).zip(yy).zip(p) {
        let (weight, k0) = if *y > 3.0 { (600.0 * (6.0 - y), 0.8) } else { (1800.0 + 1000.0 * (3.0 - y), 0.5) };
        let (vertical, pressure) = (-9.81 * weight, 9810.0 * (6.0 - y));
        assert!((yy / vertical - 1.0).abs() < 1e-6 && (xx / (k0 * vertical) - 1.0).abs() < 1e-6, "{y}: {xx} {yy}");
        assert!((p / pressure - 1.0).abs() < 1e-6, "{y}: {p}");
    }
    // Water that stands lower is under suction above: the grains bear as much more.
    let (_, lower) = run(&text.replace("drained = { y_m = [5.9, inf] }\n", "level_m = 4\n"));
    let more = lower.iter().find(|column| column.name == "stress_yy").unwrap();
    assert!(more.values.iter().zip(yy).all(|(low, high)| (low - high + 2.0 * 9810.0).abs() < 1e-2));
}

#[test]
fn water_whose_weight_acts_on_nothing_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let density = "density_kg_m3 = 1000\n";
    let later = "[[phases]]\nname = \"later\"\nduration_s = 1\n[output]";
    for (from, to, said) in [
        (density, "", "k0 needs a density_kg_m3 of [water]"),
        (density, "density_kg_m3 = 1000\nlevel_m = 6.1\n", "level_m above the bodies, at 6 m"),
        (density, "density_kg_m3 = 0\n", "0 where a positive"),
        ("density_kg_m3 = 1600", "density_kg_m3 = 500", "above that of its water, 500 kg/m³"),
        ("[0, -9.81] }", "[0, -9.81], rise_s = 1 }", "density_kg_m3 needs one gravity"),
        ("[0, -9.81] }", "[0, -9.81], phases = [\"rest\"] }", ""),
        ("[output]", later, ""),
    ] {
        let text = soaked();
        assert!(text.contains(from), "{from}");
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let found = SceneFile::read(&path, 1.0, None).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(found.contains(said) && found.is_empty() == said.is_empty(), "{to}: {found:?} lacks {said:?}");
    }
    let both = soaked().replace("[0, -9.81] }", "[0, -9.81], phases = [\"rest\"] }").replace("[output]", later);
    std::fs::write(&path, both).unwrap();
    let found = SceneFile::read(&path, 1.0, None).err().unwrap().to_string();
    assert!(found.contains("one gravity, in all phases"), "{found}");
    let twice = soaked().replace("[output]", later).replace(
        "[[loads]]\n",
        "[[loads]]\ngravity = { acceleration_m_s2 = [0, -9.81], phases = [\"later\"] }\n[[loads]]\n",
    );
    std::fs::write(&path, twice).unwrap();
    let found = SceneFile::read(&path, 1.0, None).err().unwrap().to_string();
    assert!(found.contains("one gravity, in all phases"), "{found}");
    let weightless = soaked().replace(density, "level_m = 6\n").replace("k0 = 0.5\n", "").replace("k0 = 0.8\n", "");
    std::fs::write(&path, weightless).unwrap();
    let found = SceneFile::read(&path, 1.0, None).err().unwrap().to_string();
    assert!(found.contains("level_m acts on nothing"), "{found}");
}

#[test]
fn strengths_that_act_on_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let pyramid = LEVEL.replacen("law.drucker-prager", "law.mohr-coulomb", 1);
    let law = "friction_deg = 30\n";
    let residual = "residual = { cohesion_pa = 0, friction_deg = 25, plastic_strain = 0.1 }\n";
    let with = |more: &str| format!("{law}{more}");
    for (text, said) in [
        (pyramid.replacen("k0 = 0.5", "k0 = 0.5\ncohesion_gradient_pa_m = 1", 1), "cohesion_pa above zero"),
        (LEVEL.replacen("k0 = 0.8", "k0 = 0.8\ncohesion_gradient_pa_m = 1", 1), "of a law mohr-coulomb"),
        (pyramid.replacen(law, &with("tension_pa = 1\n"), 1), "tension cut-off"),
        (pyramid.replacen(law, &with(&residual.replace("25", "31")), 1), "residual sin φ"),
        (pyramid.replacen(law, &with(&residual.replace("0.1 }", "0 }")), 1), "0 where a positive"),
        (LEVEL.replacen(law, &with(residual), 1), "residual"),
        (pyramid.replacen(law, &with(residual), 1), ""),
    ] {
        std::fs::write(&path, text).unwrap();
        let found = SceneFile::read(&path, 1.0, None).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(found.contains(said) && found.is_empty() == said.is_empty(), "{found:?} lacks {said:?}");
    }
}

/// Only a separable wall of an explicit scheme has friction.
#[test]
fn friction_of_walls_is_refused_where_it_acts_on_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let explicit = LEVEL.replace("scheme = \"quasi-static-gimp-none\"\ntime_step_s = 1", EXPLICIT);
    let base = "end = \"lo\", kind = \"roller\" }\n[[supports]]\nwall = { name = \"left\"";
    let rough = |kind: &str| base.replacen("kind = \"roller\"", &format!("kind = \"{kind}\", friction = 0.3"), 1);
    for (text, said) in [
        (explicit.replacen(base, &rough("roller"), 1), "friction of a wall is of kind = \"separable\""),
        (explicit.replacen(base, &rough("fixed"), 1), "friction of a wall is of kind"),
        (explicit.replacen(base, &rough("separable"), 1).replace("gimp-none-flip", "gimp-none-xpic2"), "xpic"),
        (LEVEL.replacen(base, &rough("separable"), 1), "one-sided"),
        (explicit.replacen(base, &rough("separable"), 1), ""),
    ] {
        assert!(text.contains("friction = 0.3"));
        std::fs::write(&path, text).unwrap();
        let found = SceneFile::read(&path, 1.0, None).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(found.contains(said) && found.is_empty() == said.is_empty(), "{found:?} lacks {said:?}");
    }
}
