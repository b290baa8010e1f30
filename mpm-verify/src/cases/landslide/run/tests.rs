//! Ground, and strengths that fall at once or by rows.

use super::*;
use crate::problem::Driver;
use mpm_core::Memory;

fn setup(level: Level, set: &[&str]) -> Setup<Landslide> {
    crate::record::fixture::setup(Scheme::flip(Gimp, FbarConsistent), level, set)
}

fn level(name: &str) -> Level {
    *LEVELS_3D.iter().find(|l| l.name == name).unwrap()
}

#[test]
fn the_ground_has_the_papers_particles_and_time_step() {
    let slide = Slide::<3>::new(setup(level("h0.2"), &[])).unwrap();
    let (ground, places) = (&slide.ground, slide.ground.seed());
    assert_eq!((places.len(), ground.across), (311_250, 50));
    assert!((ground.dt - 5e-5).abs() < 1e-18);
    assert_eq!(ground.steps_per_row, 200);
    // Those of one place of the section follow one another.
    let (first, last) = (places[0], places[49]);
    assert_eq!(first[..2], last[..2]);
    assert!((first[2] - 0.05).abs() < 1e-12 && (last[2] - 4.95).abs() < 1e-12);
}

#[test]
fn a_slice_is_four_cells_wide_and_a_width_is_whole_cells() {
    let wide = |name: &str, set: &[&str]| setup(level(name), set).whole_width();
    let known = [("slice-h0.4", None, 1.6), ("h0.5", None, 5.0), ("h0.5", Some("width=2"), 2.0)];
    for (name, set, width) in known {
        let found = wide(name, set.as_slice()).unwrap();
        assert!((found - width).abs() < 1e-12, "{name} {set:?}: {found}");
    }
    for width in ["width=1.5", "width=2.2"] {
        let refused = wide("h0.5", &[width]).unwrap_err().to_string();
        assert!(refused.contains("parameter width"), "{refused}");
    }
}

#[test]
fn only_the_peak_is_reduced() {
    let setup = setup(LEVELS_2D[0], &[]);
    // A peak reduced below the residual strength takes that with it.
    let known = [
        (1.0, 0.0, 40.82e3),
        (1.65, 0.0, 40.82e3 / 1.65),
        (1.0, 100.0, 2.45e3),
        (1.65, 100.0, 2.45e3),
        (100.0, 100.0, 408.2),
    ];
    for (reduction, strain, strength) in known {
        let found = setup.strength(reduction).unwrap().at(strain).0;
        assert!((found - strength).abs() < 1e-6, "{reduction}: {found}");
    }
}

#[test]
fn the_reduced_slope_is_at_its_limit() {
    let slope = setup(LEVELS_2D[0], &[]).slope();
    let factor = |strength| slope.factor_of_safety(strength, crate::cases::slope::ground::STABILITY.0);
    assert!((factor(40.82e3) - 1.653).abs() < 5e-4);
    assert!((factor(40.82e3 / 1.65) - 1.002).abs() < 5e-4);
    assert!((slope.longest_period() - 0.321).abs() < 5e-4);
}

/// A small slope with a factor of safety of eight, whose strength is divided by twelve: it flows at once.
fn small(release: &str) -> Driver<2, Slide<2>> {
    let slope = ["height=1", "crest=2", "floor=2", "duration=0.1", "reduction=12", release];
    Driver::new(Slide::new(setup(LEVELS_2D[0], &slope)).unwrap()).unwrap()
}

/// The factor in force after every row from the end of the gravity stage on.
fn reductions(job: &mut Driver<2, Slide<2>>) -> Vec<f64> {
    let mut reductions = Vec::new();
    while !job.finished() {
        job.advance().unwrap();
        reductions.extend(job.seen().reduction);
    }
    reductions
}

#[test]
fn the_strength_falls_at_once_or_by_rows() {
    let mut at_once = small("release=0");
    assert_eq!(reductions(&mut at_once), [12.0; 11]);
    let mut gradual = small("release=0.05");
    let found = reductions(&mut gradual);
    assert_eq!(found.len(), 11);
    for (k, factor) in found.into_iter().enumerate() {
        let share = f64::min(1.0, 0.2 * (k + 1) as f64);
        assert!((factor - (1.0 + 11.0 * share)).abs() < 1e-9, "{factor}");
    }
    for job in [&mut at_once, &mut gradual] {
        let steps_per_row = (ROW / job.discretisation().dt).round() as u64;
        // A second of gravity and a tenth after it.
        assert_eq!(job.work().steps, 110 * steps_per_row);
        let rows = &job.seen().series.rows;
        assert!((rows[9].time - 0.1).abs() < 1e-9 && rows.len() == 10);
        assert!(rows[9].dissipated > 0.0);
        let grows = |pair: &[State]| pair[1].dissipated >= pair[0].dissipated;
        assert!(rows.windows(2).all(grows));
        let metrics = job.metrics();
        for of in [ENERGY_GAIN, UNACCOUNTED_ENERGY] {
            let value = metrics[of.name].value.unwrap();
            assert!(value <= 1e-9, "{}: {value}", of.name);
        }
    }
}

#[test]
fn nothing_jumps_when_the_strength_falls() {
    let mut job = small("release=0.05");
    for _ in 0..104 {
        job.advance().unwrap();
    }
    let (slide, seen, phase) = job.parts();
    let before = slide.observe(seen, phase.run.as_mut()).unwrap();
    assert!(before.dissipated > 0.0 && before.stress_work != 0.0);
    slide.reduce(seen, phase).unwrap();
    let after = slide.observe(seen, phase.run.as_mut()).unwrap();
    for (a, b) in [
        (before.time, after.time),
        (before.dissipated, after.dissipated),
        (before.stress_work, after.stress_work),
        (before.stored, after.stored),
        (before.kinetic, after.kinetic),
    ] {
        assert!((a - b).abs() <= 1e-12 * a.abs(), "{a} became {b}");
    }
}

#[test]
fn a_slope_that_is_being_weakened_goes_on_from_its_memory() {
    let mut straight = small("release=0.05");
    for _ in 0..103 {
        straight.advance().unwrap();
    }
    let saved = straight.save().unwrap();
    let mut resumed = small("release=0.05");
    resumed.restore(&saved).unwrap();
    while !straight.finished() {
        assert_eq!(straight.advance().unwrap(), resumed.advance().unwrap());
    }
    assert_eq!(straight.metrics(), resumed.metrics());
}
