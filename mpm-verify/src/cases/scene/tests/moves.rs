//! Supports whose nodes move with their region.

use super::*;

/// A bar one metre high between rollers, whose top goes down by 0.29 m: almost three cells.
const BAR: &str = r#"format = 1
title = "A bar is pressed"
[grid]
cell_size_m = 0.1
lower_m = [0, 0]
cells = [10, 12]
ends = ["walls", "wall-open"]
[body]
density_kg_m3 = 1
particles_per_direction = 2
[[body.shapes]]
box = { from_m = [0, 0], to_m = [1, 1] }
[law.neo-hookean]
young_modulus_pa = 1000
poisson_ratio = 0.0
[[supports]]
wall = { name = "b", axis = "y", end = "lo", kind = "roller" }
[[supports]]
wall = { name = "l", axis = "x", end = "lo", kind = "roller" }
[[supports]]
wall = { name = "r", axis = "x", end = "hi", kind = "roller" }
[[supports]]
nodes = { name = "top", within = { y_m = [0.999, inf] }, velocity_m_s = { y = -0.1 }, moves = true, rise_s = 0.2 }
[solver]
scheme = "gimp-none-flip"
cfl = 0.3
[[phases]]
name = "press"
duration_s = 3.0
local_damping = 0.3
[output]
row_s = 0.05
"#;

fn read(text: &str) -> Result<SceneFile, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.toml");
    std::fs::write(&path, text).unwrap();
    SceneFile::read(&path, 1.0, None)
}

/// Height of the highest particle (m), and force (N/m) on the top over the last fifth of a second.
fn pressed(text: &str) -> (f64, f64) {
    let scene = read(text).unwrap();
    let mut job = (scene.case.begin)(&scene.spec, &Parameters::new(&[], &[]).unwrap()).unwrap();
    let mut forces = Vec::new();
    while !job.finished() {
        let Row(row) = job.advance().unwrap();
        forces.push(row.iter().find(|(name, _)| *name == "top_y (N/m)").unwrap().1);
    }
    let (highest, last) = (places(job.as_mut())[1].iter().copied().fold(0.0, f64::max), &forces[forces.len() - 4..]);
    (highest, last.iter().sum::<f64>() / last.len() as f64)
}

/// At the end λ = 0.71, and the highest particle stands at 0.975 λ. Over the last fifth of a second λ is 0.72 in the mean,
/// and the force μ (1/λ − λ), μ = 500 Pa. Held nodes are half a cell off the region's end at most, λ then 0.05.
#[test]
fn a_region_that_moves_pushes_a_bar_all_the_way() {
    let two = BAR.replace(
        "duration_s = 3.0",
        "duration_s = 1.6\nlocal_damping = 0.3\n[[phases]]\nname = \"on\"\nduration_s = 1.5",
    );
    let slow = BAR.replace("gimp-none-flip", "quasi-static-gimp-none").replace("cfl = 0.3", "time_step_s = 0.05");
    let slow = slow.replace("local_damping = 0.3\n", "");
    for (what, text) in [("explicit", BAR), ("in two phases", &two), ("quasi-static", &slow)] {
        let (highest, force) = pressed(text);
        let of = |stretch: f64| 500.0 * (1.0 / stretch - stretch);
        assert!((highest - 0.975 * 0.71).abs() < 0.05, "{what}: {highest}");
        assert!((of(0.77)..of(0.67)).contains(&force), "{what}: {force}");
    }
}

#[test]
fn a_region_stays_or_has_a_velocity_to_move_with() {
    let refused = |from: &str, to: &str| read(&BAR.replace(from, to)).err().unwrap().to_string();
    let stays = refused("moves = true, ", "");
    for part in ["line 22, [[supports]]", "half a cell", "0.05 m", "moves = true"] {
        assert!(stays.contains(part), "{part} in: {stays}");
    }
    for velocity in ["{}", "{ y = 0 }"] {
        let still = refused("{ y = -0.1 }", velocity);
        assert!(still.contains("line 22, [[supports]]: moves = true with no velocity_m_s"), "{still}");
    }
}
