//! One run goes on with the body of another: sticks go along.

use super::friction::{MIDPOINT, MU, NEWMARK, block, coulomb, has_rested, places, settle};
use super::*;

/// A block that stands on a slope at nine tenths of its angle is handed from rule to rule, and stays.
#[test]
fn a_block_that_rests_on_its_sticks_rests_in_the_next_run() {
    let mut first = block(0.9 * MU, coulomb, Settings::new(1.0));
    first.step().unwrap();
    settle(&mut first);
    let body = first.body().unwrap();
    for rule in [TimeRule::Static, MIDPOINT, NEWMARK] {
        let mut next = block(0.9 * MU, coulomb, Settings::new(0.02).rule(rule));
        next.ledger.time = first.ledger.time;
        next.take_over(&body).unwrap();
        assert_eq!(next.scene.contacts[0].sticks(), first.scene.contacts[0].sticks());
        next.advance(20).unwrap();
        has_rested(&next, &places(&first), 20);
    }
}
