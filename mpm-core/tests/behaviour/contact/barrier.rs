//! The barrier: its derivatives and its bounds.

use mpm_core::contact::Barrier;

const DISTANCE: f64 = 0.0125;

fn barrier() -> Barrier {
    Barrier::new(900.0, DISTANCE).unwrap()
}

/// Central differences of step s: truncation s²/6 times the third derivative, here below 3e-7 of the value for
/// gaps from a tenth of d̂; rounding ε/s is less.
#[test]
fn force_and_stiffness_are_derivatives_of_the_energy() {
    let (b, s) = (barrier(), 1e-5 * DISTANCE);
    for k in 1..100 {
        let d = DISTANCE * (0.1 + 0.009 * f64::from(k));
        let slope = |f: &dyn Fn(f64) -> f64| (f(d + s) - f(d - s)) / (2.0 * s);
        let (force, stiffness) = (-slope(&|d| b.energy(d)), -slope(&|d| b.force(d)));
        assert!((force / b.force(d) - 1.0).abs() < 1e-6, "{d}");
        assert!((stiffness / b.stiffness(d) - 1.0).abs() < 1e-6, "{d}");
    }
}

/// Near d̂, with c = 1 − d/d̂: B ≈ κ d̂² c³, −B′ ≈ 3 κ d̂ c², B″ ≈ 6 κ c.
#[test]
fn it_begins_smoothly_at_its_distance() {
    let b = barrier();
    for d in [DISTANCE, 1.1 * DISTANCE, f64::INFINITY] {
        assert_eq!((b.energy(d), b.force(d), b.stiffness(d)), (0.0, 0.0, 0.0));
    }
    let closed = 1e-6;
    let d = DISTANCE * (1.0 - closed);
    let near = |value: f64, limit: f64| (value / limit - 1.0).abs() < 1e-5;
    assert!(near(b.energy(d), 900.0 * DISTANCE.powi(2) * closed.powi(3)));
    assert!(near(b.force(d), 2700.0 * DISTANCE * closed.powi(2)));
    assert!(near(b.stiffness(d), 5400.0 * closed));
}

#[test]
fn it_has_no_bound_at_a_closed_gap() {
    let b = barrier();
    for d in [0.0, -1.0] {
        assert_eq!(b.energy(d), f64::INFINITY);
        assert_eq!(b.force(d), f64::INFINITY);
        assert_eq!(b.stiffness(d), f64::INFINITY);
    }
    assert!(b.force(1e-300) > 1e290);
}

/// The gap is found to a rounding of itself, so the force to that times its logarithmic slope d B″/(−B′),
/// 2/c near d̂.
#[test]
fn the_gap_is_where_the_force_is_carried() {
    let b = barrier();
    assert_eq!(b.gap(0.0), DISTANCE);
    for k in -12..12 {
        let force = 10.0_f64.powi(k);
        let d = b.gap(force);
        let slope = d * b.stiffness(d) / b.force(d);
        let error = (b.force(d) / force - 1.0).abs();
        assert!(error < 8.0 * f64::EPSILON * (1.0 + slope), "{force}: {error}");
    }
    for share in [0.1, 0.5, 0.99] {
        let b = Barrier::carrying_at(14.0, share * DISTANCE, DISTANCE).unwrap();
        assert!((b.force(share * DISTANCE) / 14.0 - 1.0).abs() < 1e-14);
    }
    let half = Barrier::carrying(14.0, DISTANCE).unwrap();
    assert!((half.gap(14.0) / (0.5 * DISTANCE) - 1.0).abs() < 1e-14);
}

#[test]
fn bad_input_is_refused() {
    assert!(Barrier::new(0.0, 1.0).is_err());
    assert!(Barrier::new(1.0, f64::NAN).is_err());
    assert!(Barrier::carrying(-1.0, 1.0).is_err());
    assert!(Barrier::carrying_at(1.0, 1.0, 1.0).is_err());
    assert!(Barrier::carrying_at(1.0, 0.0, 1.0).is_err());
}
