//! Metrics, warnings and errors of runs.

use super::*;
use crate::record::Measured;
use crate::record::fixture::record;
use crate::study::judge::judged_run;

/// A square of 0.5 m that flies at 5 m/s across and 1 m/s down, in three phases of 0.1 s.
const FLIGHT: &str = "format = 1
title = \"Flight\"
[grid]
cell_size_m = 0.1
lower_m = [0, 0]
cells = [20, 20]
ends = [\"walls\", \"walls\"]
[body]
density_kg_m3 = 1000
particles_per_direction = 2
velocity_m_s = [5, -1]
[[body.shapes]]
box = { from_m = [0.5, 1], to_m = [1, 1.5] }
[law.neo-hookean]
young_modulus_pa = 1e4
poisson_ratio = 0.3
[solver]
scheme = \"gimp-none-flip\"
cfl = 0.3
[[phases]]
name = \"one\"
duration_s = 0.1
[[phases]]
name = \"two\"
duration_s = 0.1
[[phases]]
name = \"three\"
duration_s = 0.1
[output]
row_s = 0.1
";

fn run(text: &str) -> Record {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(&path, text).unwrap();
    let scene = SceneFile::read(&path, 1.0, None).unwrap();
    judged_run(&scene.case, &scene.spec, None, 1, &|_| {}).unwrap()
}

#[test]
fn a_flight_has_its_run_out_settlement_and_speed() {
    let short = FLIGHT.split("[[phases]]\nname = \"two\"").next().unwrap().to_owned() + "[output]\nrow_s = 0.1\n";
    let record = run(&short);
    let exact = [("runout", 0.5), ("runout_bulk", 0.5), ("settlement", 0.1), ("speed_max", f64::hypot(5.0, 1.0))];
    for (name, value) in exact {
        assert!((record.value(name) / value - 1.0).abs() < 1e-9, "{name}: {}", record.value(name));
    }
}

#[test]
fn a_breakdown_names_its_phase_and_the_time_since_the_start() {
    let failure = run(FLIGHT).error.unwrap();
    assert!(
        failure.message.starts_with("phase three, which began at 0.2") && failure.kind == "off-grid",
        "{failure:?}"
    );
    // The right edge is 1 m from the end of the grid, which a domain may leave by half a cell.
    assert!((0.2 - 1e-9..0.22).contains(&failure.time), "{failure:?}");
}

#[test]
fn volume_and_noise_are_warned_about_beyond_a_tenth() {
    let checks = super::checks::checks(1.0, 100.0, [None; 2]);
    let warned = |volume: f64, noise: f64| {
        let mut run = record("h2", Vec::new());
        for (name, value) in [("volume_change_max", volume), ("mean_stress_oscillation", noise)] {
            run.metrics.insert(name.to_owned(), Measured { value: Some(value), unit: "-".to_owned() });
        }
        let told = checks.iter().filter(|check| check.name == "warning").flat_map(|check| check.of_run(&run));
        told.map(|verdict| verdict.metric).collect::<Vec<_>>()
    };
    assert_eq!(warned(0.09, 9.0), Vec::<String>::new());
    assert_eq!(warned(0.11, 9.0), ["volume_change_max"]);
    assert_eq!(warned(0.09, 11.0), ["mean_stress_oscillation"]);
}
