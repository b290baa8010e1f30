//! Rigid faces: gaps, and what is near.

use mpm_core::Particles;
use mpm_core::contact::RigidFace;
use mpm_core::stage::{Amplitude, End};

#[test]
fn gaps_are_those_before_the_face() {
    let floor = RigidFace::<2>::half_space(1, End::Lo, 1.0).unwrap();
    assert_eq!(floor.gap(&[7.0, 1.5]), Some(0.5));
    assert_eq!(floor.gap(&[7.0, 0.5]), Some(-0.5));
    let press = RigidFace::half_space(1, End::Hi, 1.0).unwrap().within([[0.0, 2.0], [5.0, 6.0]]);
    assert_eq!(press.gap(&[2.0, 0.75]), Some(0.25));
    assert_eq!(press.gap(&[2.1, 0.75]), None);
    let seen = press.seen_at(&[2.0, 0.75], 0.0).unwrap();
    assert_eq!((seen.normal, seen.bend), ([0.0, -1.0].into(), Default::default()));
}

#[test]
fn what_is_near_is_within_a_distance_along_every_axis() {
    let press = RigidFace::half_space(1, End::Hi, 1.0).unwrap().within([[0.0, 2.0], [5.0, 6.0]]);
    let far_within = [1.0, 9.0];
    for near in [[1.0, 0.6], [1.0, 1.0], [-0.4, 1.0], [2.4, 1.0], far_within] {
        assert!(press.is_near(&near, 0.5), "{near:?}");
    }
    for far in [[1.0, 0.4], [-0.6, 1.0], [2.6, 1.0]] {
        assert!(!press.is_near(&far, 0.5), "{far:?}");
    }
}

/// Central differences of step s of a cubic's integral: truncation s²/6 of the second derivative of the rise,
/// at most 6/ramp².
#[test]
fn its_place_is_the_integral_of_its_velocity() {
    let face = RigidFace::<2>::half_space(1, End::Hi, 0.0).unwrap().moving([2.0, -3.0], Amplitude::Rise(0.5)).unwrap();
    let s = 1e-4;
    for k in 1..100 {
        let t = 0.01 * f64::from(k);
        let (before, after) = (face.displacement(t - s), face.displacement(t + s));
        for a in 0..2 {
            let slope = (after[a] - before[a]) / (2.0 * s);
            assert!((slope - face.velocity(t)[a]).abs() < 3.0 * s * s / 0.25 + 1e-11);
        }
    }
    assert_eq!(face.displacement(-1.0), [0.0; 2]);
    assert_eq!(face.displacement(1.5), [2.0 * 1.25, -3.0 * 1.25]);
    let at_once = face.moving([1.0; 2], Amplitude::Rise(0.0)).unwrap();
    assert_eq!(at_once.displacement(-1.0), [0.0; 2]);
    assert_eq!(at_once.displacement(2.0), [2.0; 2]);
}

#[test]
fn it_is_put_on_the_nearest_particle_before_it() {
    let particles = Particles::new(vec![[0.5, 1.0], [1.5, 2.0], [5.0, 3.0]], 1.0, 1.0, [0.5; 2]).unwrap();
    for (end, nearest) in [(End::Hi, 2.0), (End::Lo, 1.0)] {
        let face =
            RigidFace::half_space(1, end, 17.0).unwrap().within([[0.0, 2.0], [0.0; 2]]).touching(&particles, 0.25);
        assert_eq!(face.gap(&[1.0, nearest]), Some(0.25));
    }
    let beside = RigidFace::half_space(1, End::Hi, 17.0).unwrap().within([[9.0, 10.0], [0.0; 2]]);
    assert_eq!(beside.clone().touching(&particles, 0.25), beside);
}

#[test]
fn bad_input_is_refused() {
    assert!(RigidFace::<2>::half_space(2, End::Lo, 0.0).is_err());
    assert!(RigidFace::<2>::half_space(1, End::Lo, f64::INFINITY).is_err());
    let face = RigidFace::<2>::half_space(1, End::Lo, 0.0).unwrap();
    assert!(face.moving([0.0, f64::NAN], Amplitude::Rise(1.0)).is_err());
}
