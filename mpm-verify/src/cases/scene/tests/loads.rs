//! Loads and motions over time, tractions, and waves that come and leave.

use super::bodies::last;
use super::*;

/// A layer of shear waves of 1 m/s, one metre deep and endless, on a base that moves.
const LAYER: &str = r#"format = 1
title = "A layer is shaken"
[grid]
cell_size_m = 0.025
lower_m = [0, 0]
cells = [4, 48]
ends = ["periodic", "wall-open"]
[body]
density_kg_m3 = 2
particles_per_direction = 2
[[body.shapes]]
box = { from_m = [0, 0], to_m = [0.1, 1] }
[law.hencky]
young_modulus_pa = 4
poisson_ratio = 0.0
[[amplitudes]]
name = "pulse"
file = "pulse.csv"
[[supports]]
nodes = { name = "base", within = { y_m = [-inf, 0] }, velocity_m_s = { x = 0.001, y = 0 }, amplitude = "pulse" }
[solver]
scheme = "gimp-none-flip"
cfl = 0.4
[[phases]]
name = "shake"
duration_s = 4.0
[output]
row_s = 0.1
"#;
const PULSE: &str = "time (s),factor (-)\n0,0\n0.5,1\n1,0\n";
/// Length of the pulse (m), and its displacement (m).
const LENGTH: f64 = 1.0;
const STROKE: f64 = 0.5e-3;

/// A column one metre wide and high between rollers under a traction.
const COLUMN: &str = r#"format = 1
title = "A column is pressed"
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
[[loads]]
traction = { traction_pa = [0, -200], axis = "y", end = "hi" }
[[supports]]
wall = { name = "b", axis = "y", end = "lo", kind = "roller" }
[[supports]]
wall = { name = "l", axis = "x", end = "lo", kind = "roller" }
[[supports]]
wall = { name = "r", axis = "x", end = "hi", kind = "roller" }
[solver]
scheme = "quasi-static-gimp-none"
time_step_s = 1
[[phases]]
name = "press"
duration_s = 1
[output]
row_s = 1
"#;

fn read(text: &str) -> Result<SceneFile, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    std::fs::write(folder.path().join("pulse.csv"), PULSE).unwrap();
    std::fs::write(&path, text).unwrap();
    SceneFile::read(&path, 1.0, None)
}

/// Time (s), and displacement along x (m) and greatest speed (m/s) of the uppermost particle, row by row; columns of the
/// particles, and rows.
fn run(scene: &SceneFile) -> (Vec<[f64; 3]>, Vec<crate::job::Column>, Vec<Row>) {
    let mut job = (scene.case.begin)(&scene.spec, &Parameters::new(&[], &[]).unwrap()).unwrap();
    let (mut moved, mut rows) = (Vec::new(), Vec::new());
    while !job.finished() {
        rows.push(job.advance().unwrap());
        let particles = job.particles();
        let of = |name: &str| particles.iter().find(|c| c.name == name).map_or(vec![0.0; 9], |c| c.values.clone());
        let (y, u, v) = (of("y"), of("displacement_x"), of("velocity_x"));
        let top = (0..y.len()).max_by(|j, k| y[*j].total_cmp(&y[*k])).unwrap();
        let fastest = v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        moved.push([rows.last().unwrap().0[0].1, u[top], fastest]);
    }
    (moved, job.particles(), rows)
}

/// Displacement (m) that the pulse of velocities makes.
fn pulse(time: f64) -> f64 {
    let t = time.clamp(0.0, 1.0);
    2.0 * STROKE * if t < 0.5 { t * t } else { 0.5 - (1.0 - t) * (1.0 - t) }
}

/// Share by which a wave is off after a path (m): (kh)²/24 of its phase by lumped masses, as much again by transfers.
fn dispersed(path: f64) -> f64 {
    let k = TAU / LENGTH;
    k * path * (k * 0.025_f64).powi(2) / 12.0
}

/// Waves are thrown back by the surface, and by the base with their sign turned (d'Alembert): 2 Σ (−1)ᵏ u(t − (2k + 1) H/c).
#[test]
fn a_layer_answers_its_base_as_dalembert_says() {
    let (moved, ..) = run(&read(LAYER).unwrap());
    for [time, top, _] in moved {
        let exact: f64 = (0..2).map(|k| 2.0 * (-1.0_f64).powi(k) * pulse(time - f64::from(2 * k + 1))).sum();
        assert!((top - exact).abs() < dispersed(4.0) * 2.0 * STROKE, "{time}: {top} of {exact}");
    }
    let (knots, ..) = run(&read(&LAYER.replace("file = \"pulse.csv\"", "knots = [[0, 0], [0.5, 1], [1, 0]]")).unwrap());
    assert_eq!(knots, run(&read(LAYER).unwrap()).0);
}

/// Half a particle beyond the dashpots throws back the share k s/4 of a wave at most, s a particle's size; the surface doubles
/// it. The pulse has left after three seconds; dispersion leaves slow short waves behind.
#[test]
fn waves_come_in_and_leave_through_an_absorbing_side() {
    let supports = LAYER.find("[[supports]]").unwrap()..LAYER.find("[solver]").unwrap();
    let mut text = LAYER.to_owned();
    text.replace_range(
        supports,
        "[[loads]]\nabsorbing = { axis = \"y\", end = \"lo\", on = { y_m = [0, 0.5] }, incoming_m_s = [0.001, 0], \
         amplitude = \"pulse\" }\n[[supports]]\nwall = { name = \"base\", axis = \"y\", end = \"lo\", kind = \"roller\" }\n",
    );
    let (moved, ..) = run(&read(&text).unwrap());
    let thrown_back = 2.0 * TAU / LENGTH * 0.0125 / 4.0;
    for [time, top, fastest] in moved {
        let exact = 2.0 * pulse(time - 1.0);
        let most = (dispersed(2.0) + thrown_back) * 2.0 * STROKE;
        assert!((top - exact).abs() < most, "{time}: {top} of {exact}");
        let left = dispersed(4.0) + thrown_back;
        assert!(time < 3.2 || fastest < left * 1e-3, "{time}: {fastest}");
    }
}

/// Clay (1) on rock (2), whose impedances z = ρ c differ: the surface moves by 2 z₂/(z₁ + z₂) of twice the wave that comes,
/// and again with r = (z₁ − z₂)/(z₁ + z₂) after every way down and up. Its errors, each of the greatest motion: k s/4 = 0.2 %
/// that the base throws back, 0.2 % of dispersion, and the joint, which a cell smears: k₁h/8 = 0.8 %.
#[test]
fn a_soft_layer_on_rock_amplifies_as_its_impedance_says() {
    let text = std::fs::read_to_string(shipped("shaken-layers.toml")).unwrap();
    let form: super::super::form::Form = toml::from_str(&text).unwrap();
    let knots = form.amplitudes[0].get_ref().knots.clone().unwrap();
    let knots: Vec<[f64; 2]> = knots.iter().map(|[time, factor]| [time.0, factor.0]).collect();
    let wave = Amplitude::table(&knots).unwrap();
    let [clay, rock] = [[1700.0_f64, 120.0], [2200.0, 600.0]];
    let [z1, z2] = [clay, rock].map(|[density, speed]| density * speed);
    let (through, back) = (2.0 * z2 / (z1 + z2), (z1 - z2) / (z1 + z2));
    let (moved, ..) = run(&SceneFile::read(&shipped("shaken-layers.toml"), 1.0, None).unwrap());
    let exact = |time: f64| -> f64 {
        let came = |k: i32| back.powi(k) * wave.integral(time - 5.0 / rock[1] - f64::from(2 * k + 1) * 10.0 / clay[1]);
        2.0 * through * 0.1 * (0..10).map(came).sum::<f64>()
    };
    let greatest = moved.iter().map(|[time, ..]| exact(*time)).fold(0.0, f64::max);
    for [time, top, _] in moved {
        assert!((top - exact(time)).abs() < 0.012 * greatest, "{time}: {top} of {}", exact(time));
    }
}

/// A dead traction t on a column: μ (1/λ − λ) = t, μ = 500 Pa, and the same stress everywhere. GIMP finds both to rounding.
#[test]
fn a_traction_is_the_stress_of_a_column() {
    let slope: f64 = 200.0 / 500.0;
    let stretch = 0.5 * ((slope * slope + 4.0).sqrt() - slope);
    let (_, particles, rows) = run(&read(COLUMN).unwrap());
    let of = |name: &str| particles.iter().find(|column| column.name == name).unwrap().values.clone();
    let highest = of("y").into_iter().fold(0.0, f64::max);
    assert!((highest / (0.975 * stretch) - 1.0).abs() < 1e-9, "{highest}");
    assert!(of("stress_yy").iter().all(|stress| (stress / -200.0 - 1.0).abs() < 1e-7));
    assert!((last(&rows, "b_y (N/m)") / -200.0 - 1.0).abs() < 1e-7, "{rows:?}");
    // Half of the side, by its region, carries half of it; a table takes it away again.
    let half = COLUMN.replace("end = \"hi\" }", "end = \"hi\", on = { x_m = [0, 0.5] } }");
    assert!((last(&run(&read(&half).unwrap()).2, "b_y (N/m)") / -100.0 - 1.0).abs() < 1e-7);
    let table = "[[amplitudes]]\nname = \"gone\"\nknots = [[0, 0], [1, 1], [2, 0]]\n[solver]";
    let gone = COLUMN.replace("end = \"hi\" }", "end = \"hi\", amplitude = \"gone\" }").replace("[solver]", table);
    let gone = gone.replace("duration_s = 1", "duration_s = 2");
    let (_, _, rows) = run(&read(&gone).unwrap());
    let [pressed, freed] = [&rows[..1], &rows[..]].map(|rows| last(rows, "displacement_max (m)"));
    assert!(pressed > 0.17 && freed < 0.01 * pressed && last(&rows, "b_y (N/m)").abs() < 1e-7, "{rows:?}");
}

#[test]
fn loads_that_say_too_little_or_too_much_are_named_with_their_line() {
    let base = "velocity_m_s = { x = 0.001, y = 0 }, amplitude = \"pulse\"";
    let loads = |load: &str| format!("[[loads]]\n{load}\n[[supports]]");
    let cases: &[(&str, &str, String, &[&str])] = &[
        (LAYER, "file = \"pulse.csv\"", String::new(), &["line 16", "either knots or file"]),
        (LAYER, "\"pulse.csv\"", "\"other.csv\"".into(), &["other.csv"]),
        (LAYER, "\"pulse.csv\"", "\"../pulse.csv\"".into(), &["line 16", "beside the scene"]),
        (
            LAYER,
            "file = \"pulse.csv\"",
            "knots = [[1, 0], [1, 1]]".into(),
            &["line 16", "time of an amplitude = 1", "rising"],
        ),
        (LAYER, base, base.replace("pulse", "quake"), &["line 19", "no amplitude \"quake\"", "has pulse"]),
        (LAYER, base, format!("{base}, rise_s = 1"), &["line 19", "either rise_s or amplitude"]),
        (LAYER, base, "velocity_m_s = { x = 0.001, y = 0 }".into(), &["line 16", "nothing names", "pulse"]),
        (LAYER, "x = 0.001, y = 0", "x = 0.1, y = -0.1".into(), &["line 19", "0.05 m along y", "half a cell"]),
        (COLUMN, "[0, -200]", "[-200]".into(), &["line 16", "traction_pa has 1 numbers"]),
        (COLUMN, "axis = \"y\"", "axis = \"z\"".into(), &["line 16", "axis z"]),
        (COLUMN, "end = \"hi\" }", "end = \"hi\", on = { y_m = [0, 0.5] } }".into(), &["press", "free side"]),
        (COLUMN, "[[supports]]", loads("absorbing = { axis = \"x\", end = \"lo\" }"), &["line 18", "explicit"]),
        (
            LAYER,
            "[[supports]]",
            loads("absorbing = { axis = \"y\", end = \"hi\", rise_s = 1 }"),
            &["line 19", "without incoming_m_s"],
        ),
    ];
    for (text, from, to, parts) in cases {
        assert!(text.contains(from), "{from}");
        let said = match read(&text.replacen(from, to, 1)) {
            Err(error) => error.to_string(),
            Ok(_) => "accepted".to_owned(),
        };
        assert!(parts.iter().all(|part| said.contains(part)), "{to}: {said}");
    }
}
