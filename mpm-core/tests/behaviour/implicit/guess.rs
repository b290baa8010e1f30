//! Where a step is looked for.

use super::*;
use mpm_core::stage::{Amplitude, RigidNodes};

/// The ground under a strip that sinks into it.
fn pressed() -> Solver<2> {
    let surface = 8.0 * H;
    let strip = RigidNodes {
        extent: [[f64::NEG_INFINITY, 2.0 * H], [surface - H, f64::INFINITY]],
        velocity: [Some(0.0), Some(-0.05)],
        amplitude: Amplitude::Rise(0.0),
    };
    in_two_steps(ground().constrain(strip), Remedy::FbarConsistent, Onto::Basis)
}

#[test]
fn a_body_that_is_pressed_on_is_looked_for_where_it_goes() {
    let residuals = |solver: &Solver<2>| solver.convergence().unwrap().residuals.clone();
    let mut straight = pressed();
    straight.step().unwrap();
    let first = residuals(&straight)[0];
    let saved = straight.save().unwrap();
    straight.step().unwrap();
    let second = residuals(&straight)[0];
    assert!(second < 0.25 * first, "{second} after {first}");
    let mut resumed = pressed();
    resumed.restore(&saved).unwrap();
    resumed.step().unwrap();
    assert_eq!(bits(&straight), bits(&resumed));
    assert_eq!(residuals(&straight), residuals(&resumed));
}
