//! Results of other codes, which need not solve the discrete equations of ours.

use super::*;
use crate::cases::poro::beyond_rounding;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group};
use crate::sampled::SHORT;

const TIME: Asked = Asked::series("time_factor", "-", "T = c_v t/H² at the end of every step, c_v = k M/γ_w");
const SETTLEMENT: Asked = Asked::series("settlement", "-", "settlement of the top over the final one, q H/M");
const OVERSHOOT: Asked = Asked::series("overshoot", "-", "largest pore pressure at a node over q, less one");

pub(in crate::cases) fn foreign() -> Foreign {
    let groups = vec![
        Group::new(&[TIME, SETTLEMENT], [SETTLEMENT_ERROR], |given| {
            let end = given.setup::<Terzaghi>()?.end() * (1.0 + SHORT);
            let last = given.points([&TIME, &SETTLEMENT]).into_iter().rfind(|[t, _]| *t <= end);
            let [t, settlement] = last.unwrap_or([f64::NAN; 2]);
            Ok(vec![(SETTLEMENT_ERROR, (settlement - exact::settlement(t)).abs())])
        }),
        Group::new(&[TIME, OVERSHOOT], [OVERSHOOT_FIRST_STEP], |given| {
            Ok(vec![(OVERSHOOT_FIRST_STEP, beyond_rounding(given.value(&OVERSHOOT, 0)))])
        }),
    ];
    Foreign {
        judged_as: |_| Scheme::poro(Gimp, TwoGrid),
        abscissa: Some(TIME),
        gaps,
        own_checks: &["settlement", "overshoot"],
        ..Foreign::of::<1, Setup<Terzaghi>>(groups)
    }
}

/// The rows show the end of the first step, of which an overshoot changes by less than the time, and of the last.
fn gaps(given: &Given) -> Gaps {
    let setup = given.setup::<Terzaghi>()?;
    let (first, end) = (setup.first_and_growth().0, setup.end());
    let mut gaps = given.unseen(&TIME, [0.0, end], end, &[SETTLEMENT_ERROR]);
    let own = given.value(&TIME, 0);
    if (own - first).abs() > FINITE * first {
        let why = format!("the first row is at time_factor = {own:.4e}, not at the end of the first step, {first:.4e}");
        gaps.push((OVERSHOOT_FIRST_STEP, Gap::Unknown(why)));
    }
    Ok(gaps)
}
