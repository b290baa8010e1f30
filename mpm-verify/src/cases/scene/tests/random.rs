//! Random scenes that are valid: each keeps mass, momentum and energy, or says why one of them is not judged.
//!
//! `MPM_SCENES` sets how many there are and `MPM_FUZZ_SEED` which.

use super::*;
use crate::study::judge::judged_run;
use crate::verdict::Outcome;

const SCENES: usize = 60;

/// One of several.
fn one<'a>(random: &mut fastrand::Rng, of: &[&'a str]) -> &'a str {
    of[random.usize(..of.len())]
}

/// A number between two, in steps that a file writes in few digits.
fn number(random: &mut fastrand::Rng, from: f64, to: f64) -> f64 {
    (100.0 * (from + (to - from) * random.f64())).round() / 100.0
}

/// A scene of one to three axes: one or two bodies above a floor, with or without gravity, a force, walls and damping.
fn scene(random: &mut fastrand::Rng) -> String {
    let dimension = [1, 2, 2, 2, 2, 3][random.usize(..6)];
    let all = |entry: &str| vec![entry.to_owned(); dimension];
    let basis = one(random, &["gimp", "bspline2", "bspline3"]);
    let transfers: &[&str] = if dimension == 2 { &["flip", "flip", "apic", "xpic2", "musl"] } else { &["flip"] };
    let (remedy, transfer) = (one(random, &["none", "fbar-consistent", "fbar-rate"]), one(random, transfers));
    let (wet, rule) = (random.usize(..10) == 0, random.usize(..8));
    let several = random.bool() && !wet;
    let explicit = !wet && rule > 0;
    let scheme = match (wet, explicit) {
        (true, _) => "poro-gimp-two-grid".to_owned(),
        (_, true) => format!("{basis}-{remedy}-{transfer}"),
        _ => format!("{}-{basis}-none", one(random, &["quasi-static", "newmark", "midpoint"])),
    };
    let mut laws = [&pairs::LAWS[..4], &pairs::LAWS[7..]].concat();
    if explicit {
        laws.push(pairs::LAWS[4]);
    }
    let laws: Vec<(&str, &str)> = (0..2).map(|_| laws[random.usize(..laws.len())]).collect();
    let height = number(random, 1.0, 3.0);
    let list = |values: &[String]| format!("[{}]", values.join(", "));
    let along = |base: &str, up: f64| {
        let mut values = all(base);
        values[dimension - 1] = up.to_string();
        list(&values)
    };
    let up = ["x", "y", "z"][dimension - 1];
    let mut text = format!(
        "format = 1\ntitle = \"Random\"\n[grid]\ncell_size_m = 0.5\nlower_m = {}\ncells = {}\nends = {}\n[body]\n\
         density_kg_m3 = {}\nparticles_per_direction = {}\n",
        list(&all("0")),
        list(&all("14")),
        list(&all("\"wall-open\"")),
        number(random, 500.0, 3000.0),
        random.u32(1..=3),
    );
    let velocity = |random: &mut fastrand::Rng| {
        let numbers: Vec<String> = (0..dimension).map(|_| number(random, -1.0, 1.0).to_string()).collect();
        format!("velocity_m_s = {}\n", list(&numbers))
    };
    let wall = one(random, if explicit { &["roller", "fixed", "separable"] } else { &["roller", "fixed"] });
    let wall = if transfer == "musl" { "roller" } else { wall };
    if explicit && random.bool() {
        text += &velocity(random);
    }
    let shape = |name: &str, from: f64, to: f64| {
        format!("[[{name}.shapes]]\nbox = {{ from_m = {}, to_m = {} }}\n", along("0.5", from), along("3", to))
    };
    text += &shape("body", 0.0, height);
    text += &format!("[law.{}]\n{}\n", laws[0].0, laws[0].1);
    if several {
        let slides = explicit && random.bool();
        let friction = if slides { format!("friction = {}\n", number(random, 0.0, 0.6)) } else { String::new() };
        text += &format!("[[bodies]]\nname = \"upper\"\ndensity_kg_m3 = 1800\n{friction}");
        text += &shape("bodies", height + 0.01 + number(random, 0.0, 0.5), height + 1.0);
        text += &format!("[bodies.law.{}]\n{}\n", laws[1].0, laws[1].1);
    }
    if wet {
        text += &format!(
            "[water]\nporosity = 0.4\nconductivity.constant = {{ m2_pa_s = 1e-9 }}\ndrained = {{ {up}_m = [{}, inf] }}\n",
            height - 0.5
        );
    }
    text += &format!("[[supports]]\nwall = {{ name = \"floor\", axis = \"{up}\", end = \"lo\", kind = \"{wall}\" }}\n");
    for axis in &["x", "y", "z"][..dimension - 1] {
        let within = format!("within = {{ {axis}_m = [0, 0.5] }}, velocity_m_s = {{ {axis} = 0 }}");
        text += &format!("[[supports]]\nnodes = {{ name = \"{axis}\", {within} }}\n");
    }
    let rise = number(random, 0.0, 0.05);
    let gravity = |more: &str| format!("[[loads]]\ngravity = {{ acceleration_m_s2 = {}, {more} }}\n", along("0", -2.0));
    text += &gravity(&format!("rise_s = {rise}, phases = [\"first\"]"));
    text += &gravity("phases = [\"second\"]");
    if random.bool() {
        let region = format!("on = {{ {up}_m = [0, {height}] }}");
        text += &format!("[[loads]]\nforce = {{ total_n = {}, {region}, rise_s = {rise} }}\n", along("20", -30.0));
    }
    if random.bool() {
        let table = "[[amplitudes]]\nname = \"turns\"\nknots = [[0, 0], [0.03, 1], [0.05, -0.5]]\n";
        let of = format!("axis = \"{up}\", end = \"hi\", amplitude = \"turns\"");
        text += &format!("{table}[[loads]]\ntraction = {{ traction_pa = {}, {of} }}\n", along("10", -20.0));
    }
    if explicit && random.usize(..6) == 0 {
        text += "[[loads]]\nabsorbing = { axis = \"x\", end = \"hi\" }\n";
    }
    text +=
        &format!("[solver]\nscheme = \"{scheme}\"\n{}", if explicit { "cfl = 0.4\n" } else { "time_step_s = 0.02\n" });
    let damping = if explicit && random.usize(..4) == 0 { "local_damping = 0.1\n" } else { "" };
    text + &format!(
        "[[phases]]\nname = \"first\"\nduration_s = 0.04\n{damping}[[phases]]\nname = \"second\"\nduration_s = 0.06\n\
         [output]\nrow_s = 0.02\n"
    )
}

#[test]
fn a_random_scene_keeps_mass_momentum_and_energy_or_says_why_not() {
    let set = |name: &str, or: usize| std::env::var(name).map_or(or, |n| n.parse().unwrap());
    let mut random = fastrand::Rng::with_seed(set("MPM_FUZZ_SEED", 1) as u64);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let mut judged = [0; 3];
    for k in 0..set("MPM_SCENES", SCENES) {
        let text = scene(&mut random);
        std::fs::write(&path, &text).unwrap();
        let scene = SceneFile::read(&path, 1.0, None).unwrap_or_else(|e| panic!("scene {k}: {e}\n{text}"));
        let record = judged_run(&scene.case, &scene.spec, None, 1, &|_| {}).unwrap();
        for (count, check) in judged.iter_mut().zip(["mass", "momentum", "energy"]) {
            let own = record.verdicts.iter().filter(|v| v.check == check);
            for verdict in own {
                let why = !verdict.source.is_empty();
                assert!(why && verdict.outcome != Outcome::Failed, "scene {k}: {verdict:?}\n{text}");
                *count += usize::from(verdict.outcome == Outcome::Right);
            }
        }
        let ended = record.error.as_ref().is_none_or(|e| !e.message.is_empty());
        assert!(ended, "scene {k}\n{text}");
    }
    assert!(judged.iter().all(|count| *count > SCENES / 3), "{judged:?}");
}
