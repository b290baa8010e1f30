//! Shipped scenes of ground against exact solutions (`docs/soils.md`).

use super::bodies::rows_of;
use super::*;
use crate::exact::ground;
use crate::exact::slope::spiral;
use std::f64::consts::PI;

/// A run of a shipped scene that some changes are made to, its strengths divided by a factor, to its end.
fn run(file: &str, changes: &[(&str, &str)], weaker: f64) -> Result<Box<dyn Job>, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let mut text = std::fs::read_to_string(shipped(file)).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    std::fs::write(&path, text).unwrap();
    let scene = SceneFile::read(&path, weaker, None)?;
    let mut job = (scene.case.begin)(&scene.spec, &Parameters::new(&[], &[]).unwrap())?;
    while !job.finished() {
        job.advance()?;
    }
    Ok(job)
}

/// Walls bear Rankine's pressures: to 10⁻³, as a stroke of 3·10⁻⁴ of the length makes the ground higher and denser.
#[test]
fn a_wall_that_moves_bears_rankines_pressures() {
    let (rows, _) = rows_of(&shipped("earth-pressure.toml"), 17);
    let exact = ground::rankine(1835.0 * 9.81, 1e3, 30.0_f64.to_radians(), 5.0);
    for (row, exact) in [&rows[9], &rows[16]].into_iter().zip(exact) {
        let force = row.0.iter().find(|(name, _)| *name == "wall_x (N/m)").unwrap().1;
        assert!((force / exact - 1.0).abs() < 1e-3, "{force} of {exact}");
    }
}

/// An infinite slope fails where the base slides, at the depth of its lowest particles, a quarter of a cell above it: with
/// Coulomb's strength there if ψ = φ, and without dilation with that of simple shear (Davis 1968).
#[test]
fn an_infinite_slope_stands_and_fails_by_its_factor() {
    let factor = |depth: f64, dilates: bool| {
        let (weight, beta) = (1835.0 * 9.81 * depth, 20.0_f64.to_radians());
        let over = |factor: f64| {
            let (c, slope) = (5e3 / factor, 25.0_f64.to_radians().tan() / factor);
            let share = if dilates { 1.0 } else { slope.atan().cos() };
            share * (c + weight * beta.cos() * slope) > weight * beta.sin()
        };
        let middle = |[lo, hi]: [f64; 2]| 0.5 * (lo + hi);
        middle((0..50).fold([1.0, 2.0], |[lo, hi], _| match middle([lo, hi]) {
            stands if over(stands) => [stands, hi],
            falls => [lo, falls],
        }))
    };
    for law in ["mohr-coulomb", "drucker-prager"] {
        for (dilation, dilates) in [("25", true), ("0", false)] {
            let dilation = format!("dilation_deg = {dilation}");
            let changes = [("law.mohr-coulomb", &*format!("law.{law}")), ("dilation_deg = 25", &dilation)];
            let [safe, lost] = [factor(5.0, dilates), 1.005 * factor(4.875, dilates)];
            assert!(run("infinite-slope.toml", &changes, safe).is_ok(), "{law} {dilation}: {safe}");
            let error = run("infinite-slope.toml", &changes, lost).err().map(|e| e.to_string()).unwrap_or_default();
            assert!(error.contains("gives way"), "{law} {dilation}: {lost}: {error}");
        }
    }
}

/// Water that flows along a slope, its level at the surface: F = (c + σ′ tan φ)/τ on the base with σ′ of the buoyant weight
/// and τ of the whole. The band of shear is two cells wide, so that its middle is a cell above the base at most.
#[test]
fn a_slope_with_water_stands_and_fails_by_its_factor() {
    let (beta, phi) = (20.0_f64.to_radians(), 25.0_f64.to_radians());
    let factor = |depth: f64, buoyancy: f64| {
        let normal = (2000.0 - buoyancy) * 9.81 * depth * beta.cos();
        (20e3 + normal * phi.tan()) / (2000.0 * 9.81 * depth * beta.sin())
    };
    assert!(run("wet-slope.toml", &[], factor(5.0, 1000.0)).is_ok());
    let error = run("wet-slope.toml", &[], factor(4.5, 1000.0)).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(error.contains("off the grid") || error.contains("half a cell"), "{error}");
    // By total stresses it would stand at far more, and does where the water is left out.
    let dry = std::fs::read_to_string(shipped("wet-slope.toml")).unwrap();
    let water = dry.split("[water]").nth(1).and_then(|rest| rest.split("[[loads]]").next()).unwrap();
    let changes = [(&*format!("[water]{water}"), ""), ("poro-gimp-two-grid", "quasi-static-gimp-none")];
    assert!(run("wet-slope.toml", &changes, factor(5.0, 0.0)).is_ok());
}

/// A slope that suction holds stands at the factor of the log spiral, where it would slide if it were dry, and pressures are
/// hydrostatic. It slides at half as much again: GIMP's bands of shear are strong (`docs/soils.md`).
#[test]
fn a_slope_above_its_water_table_stands_by_suction() {
    let [beta, phi] = [45.0_f64, 25.0].map(f64::to_radians);
    let load = 2000.0 * 9.81 * 5.0 / 5e3;
    let exact = spiral::factor_of_safety_with_water(beta, phi, load, &|[_, y]| -0.5 * y).unwrap();
    assert!((exact - 1.600).abs() < 5e-4, "{exact}");
    let particles = run("slope-with-water.toml", &[], exact).unwrap().particles();
    let of = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    for (y, pressure) in of("y").iter().zip(of("pore_pressure")) {
        assert!((pressure + 9810.0 * y).abs() < 1.0, "{pressure} at {y}");
    }
    assert!(run("slope-with-water.toml", &[], 1.5 * exact).is_err());
    let text = std::fs::read_to_string(shipped("slope-with-water.toml")).unwrap();
    let water = text.split("[water]").nth(1).and_then(|rest| rest.split("[[loads]]").next()).unwrap();
    let dry = [(&*format!("[water]{water}"), ""), ("poro-gimp-two-grid", "quasi-static-gimp-none")];
    assert!(run("slope-with-water.toml", &dry, exact).is_err());
    let dry_exact = spiral::factor_of_safety(beta, phi, load).unwrap();
    assert!((dry_exact - 1.061).abs() < 5e-4 && run("slope-with-water.toml", &dry, dry_exact).is_ok(), "{dry_exact}");
}

/// Clay whose strength grows with depth, s_u = 10 kPa + 3 kPa/m z, on a slope: F = s_u/(ρ g z sin β) at the base. A cut-off
/// of tension changes nothing, and softening brings it down.
#[test]
fn clay_that_gets_stronger_with_depth_fails_at_its_base() {
    let law = "cohesion_pa = 10000\nfriction_deg = 0";
    let clay = [
        ("cohesion_pa = 5000\nfriction_deg = 25\ndilation_deg = 25", law),
        ("particles_per_direction = 2", "particles_per_direction = 2\ncohesion_gradient_pa_m = 3000"),
    ];
    let factor = |depth: f64| (10e3 + 3e3 * depth) / (1835.0 * 9.81 * depth * 20.0_f64.to_radians().sin());
    let error = |changes: &[(&str, &str)], factor: f64| {
        run("infinite-slope.toml", changes, factor).err().map(|e| e.to_string()).unwrap_or_default()
    };
    assert_eq!(error(&clay, factor(5.0)), "");
    assert!(error(&clay, 1.005 * factor(4.875)).contains("gives way"));
    assert!(error(&clay[..1], factor(5.0)).contains("gives way"));
    // No stress is a tension. Ground whose σ_xx and σ_yy differ flows before it fails, and what this takes away is missed.
    let law = format!("{law}\ntension_pa = 1000");
    assert_eq!(error(&[(clay[0].0, &law), clay[1]], factor(5.0)), "");
    let law = format!("{law}\nresidual = {{ cohesion_pa = 5000, friction_deg = 0, plastic_strain = 0.01 }}");
    assert!(error(&[(clay[0].0, &law), clay[1]], factor(5.0)).contains("gives way"));
}

/// Stresses of a strip load below the depth b, by Flamant's solution: particles have those of the cell's middle, h²/(8 b²)
/// of the load off at most.
#[test]
fn a_strip_load_spreads_as_in_a_half_space() {
    let mut job = run("strip-load.toml", &[], 1.0).unwrap();
    let particles = job.particles();
    let of = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
    let (places, stresses) = (["x", "y"].map(of), ["stress_yy", "stress_xy"].map(of));
    let mut count = 0;
    for k in 0..places[0].len() {
        let (x, depth) = (places[0][k], 16.0 - places[1][k]);
        if !(1.0..4.0).contains(&depth) || x > 3.0 {
            continue;
        }
        for (stress, exact) in stresses.iter().zip(ground::strip(x, depth, 1.0)) {
            let error = stress[k] / 1000.0 - exact;
            assert!(error.abs() < 0.25 * 0.25 / 8.0, "{x} {depth}: {error}");
        }
        count += 1;
    }
    assert!(count > 500, "{count}");
}

/// Stresses of a pad load in space, below the depth b, as those of the strip in `docs/soils.md`: h/(π b) of the load. Every
/// row of particles bears the whole load.
#[test]
fn a_pad_load_spreads_as_in_a_half_space() {
    for scheme in ["bspline2", "gimp"] {
        let scheme = format!("quasi-static-{scheme}-none");
        let mut job = run("pad-load.toml", &[("quasi-static-bspline2-none", &scheme)], 1.0).unwrap();
        let particles = job.particles();
        let of = |name: &str| &particles.iter().find(|column| column.name == name).unwrap().values;
        let (places, stress) = (["x", "y", "z"].map(of), of("stress_zz"));
        let (mut count, mut borne) = (0, [0.0; 2]);
        for k in 0..stress.len() {
            let [x, y, depth] = [places[0][k], places[1][k], 6.0 - places[2][k]];
            // Half of the force is borne by either row of a cell.
            let row = (depth / 0.25) as usize;
            if (10..12).contains(&row) {
                borne[row - 10] += stress[k] * 0.25 * 0.25;
            }
            if !(1.0..3.0).contains(&depth) || x > 2.0 || y > 2.0 {
                continue;
            }
            let error = stress[k] / 1000.0 - ground::pad([x, y], depth, 1.0);
            assert!(error.abs() < 0.5 / PI, "{scheme} {x} {y} {depth}: {error}");
            count += 1;
        }
        assert!(count > 500, "{count}");
        // Two points a cell leave less than a hundredth of what splines vary by.
        let mean = 0.5 * (borne[0] + borne[1]);
        assert!((mean / -1000.0 - 1.0).abs() < 1e-2, "{scheme}: {borne:?}");
    }
}
