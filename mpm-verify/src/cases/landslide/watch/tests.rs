//! Strengths that fall at once or by rows.

use super::super::levels_2d;
use super::super::parameters::PARAMETERS;
use super::*;
use crate::job::Job;
use crate::scheme::{BasisName, RemedyName, Scheme};
use mpm_core::Memory;

/// A small slope with a factor of safety of eight, whose strength is divided by twelve: it flows at once.
fn small(release: &str) -> Drive<2, Slide<2>> {
    let slope = ["height=1", "crest=2", "floor=2", "duration=0.1"];
    let set: Vec<String> = (slope.iter().chain(&["reduction=12", release]))
        .map(|s| (*s).to_owned())
        .collect();
    let spec = RunSpec {
        scheme: Scheme::flip(BasisName::Gimp, RemedyName::FbarConsistent),
        level: levels_2d()[0],
        set: set.clone(),
        perturbed: false,
    };
    Slide::drive(&spec, &Parameters::new(&PARAMETERS, &set).unwrap()).unwrap()
}

/// The factor in force after every row from the end of the gravity stage on.
fn reductions(job: &mut Drive<2, Slide<2>>) -> Vec<f64> {
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
        let grows = |pair: &[Row]| pair[1].dissipated >= pair[0].dissipated;
        assert!(rows.windows(2).all(grows));
        let metrics = job.metrics();
        for of in [m::ENERGY_GAIN, m::UNACCOUNTED_ENERGY] {
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
    let (slide, seen, stage) = job.parts();
    let before = slide.observe(seen, stage.run.as_mut()).unwrap();
    assert!(before.dissipated > 0.0 && before.stress_work != 0.0);
    slide.reduce(seen, stage).unwrap();
    let after = slide.observe(seen, stage.run.as_mut()).unwrap();
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
