//! Results of other codes, which need not solve the discrete equations of ours.

use super::run::{beyond_rounding, settlement_error};
use super::*;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group};
use crate::sampled::SHORT;

const TIME: Asked = Asked::series("time_factor", "-", "T = c_v t/H² at the end of every step, c_v = k M/γ_w");
const SETTLEMENT: Asked = Asked::series("settlement", "-", "settlement of the top over the final one, q H/M");
const OVERSHOOT: Asked = Asked::series("overshoot", "-", "largest pore pressure at a node over q, less one");
/// Relative rounding of a table's times.
const ROUNDED: f64 = 1e-5;

pub(in crate::cases) fn foreign() -> Foreign {
    let groups = vec![
        Group::new(&[TIME, SETTLEMENT], [SETTLEMENT_ERROR], |given| {
            let end = given.setup::<Terzaghi>()?.end() * (1.0 + SHORT);
            let row = given.points([&TIME, &SETTLEMENT]).into_iter().rfind(|[t, _]| *t <= end);
            Ok(row.map(|[t, settlement]| (SETTLEMENT_ERROR, settlement_error(settlement, t))).into_iter().collect())
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
        ..Foreign::of::<1, Setup<Terzaghi>>(
            groups,
            &[
                "One dimension, H = 1 m, the floor at x = 0 rigid and sealed, the top drained. No gravity, no inertia, small strain.",
                "Linear elasticity with `young_modulus` and `poisson_ratio` in uniaxial strain, M = E (1 − ν)/((1 + ν)(1 − 2ν)); grains and water keep their volume; Darcy's law with `conductivity` k, water of γ_w = 9810 N/m³.",
                "The whole load q = `load` acts from T = 0 on. `steps` equal steps to T = `time_end`; with a `first_step` the first is that times h²/H² and each longer than the one before by a factor, of one step to its end.",
                "The first row is the end of the first step.",
            ],
        )
    }
}

/// The rows show the end of the first step and of the last.
fn gaps(given: &Given) -> Gaps {
    let setup = given.setup::<Terzaghi>()?;
    let (first, end) = (setup.first_and_growth().0, setup.end());
    let mut gaps = given.unseen(&TIME, [0.0, end], end, &[SETTLEMENT_ERROR]);
    let own = given.value(&TIME, 0);
    if (own - first).abs() > ROUNDED * first {
        let why = format!("the first row is at time_factor = {own:.4e}, not at the end of the first step, {first:.4e}");
        gaps.push((OVERSHOOT_FIRST_STEP, Gap::Unknown(why)));
    }
    Ok(gaps)
}
