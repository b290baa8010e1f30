//! Results of other codes.

use super::*;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group};
use crate::sampled::{Sampled, uncovered};

const TIME: Asked = Asked::series(
    "time_factor",
    "-",
    "T = c_v t/H², c_v = κ₀ M₀; at least four rows, about T = 0.1, 0.2, 0.3, 0.5, 0.75, 1, 1.5 and 2",
);
const SETTLEMENT: Asked = Asked::series("settlement", "-", "settlement of the top over H");
const BASE: Asked = Asked::series("base_pressure", "-", "pore pressure at the floor over the load");

pub(in crate::cases) fn foreign() -> Foreign {
    let of_settlement = [SETTLEMENT_ERROR, SETTLEMENT_ERROR_STEPS, SETTLEMENT_EARLY, SETTLEMENT_END];
    let groups = vec![
        Group::new(&[TIME, SETTLEMENT], of_settlement, |given| {
            Ok(given.setup::<Consolidation>()?.settlement_metrics(&rows(given)))
        }),
        Group::new(&[TIME, BASE], [BASE_PRESSURE_ERROR, BASE_PRESSURE_ERROR_STEPS], |given| {
            Ok(given.setup::<Consolidation>()?.base_pressure_metrics(&rows(given)))
        }),
    ];
    Foreign {
        judged_as: |_| Scheme::poro(Gimp, TwoGrid),
        abscissa: Some(TIME),
        own_checks: &["order-space", "richardson"],
        gaps,
        curves: |parameters| {
            let exact = Consolidation::read(parameters).map(|column| solution(column.load, None)).unwrap_or_default();
            let column = |of: fn(&At) -> f64| exact.iter().map(of).collect();
            let columns = vec![
                (TIME.header(), column(|at| at.t)),
                (SETTLEMENT.header(), column(|at| at.settlement)),
                (BASE.header(), column(|at| at.base)),
            ];
            vec![("reference-curve.csv", columns)]
        },
        ..Foreign::of::<1, Setup<Consolidation>>(groups)
    }
}

/// The times of the reference are to lie between rows, and those so close that the curve is known between them.
fn gaps(given: &Given) -> Gaps {
    let exact = solution(given.setup::<Consolidation>()?.load, None);
    let (time, Some(first), Some(last)) = (given.column(&TIME), exact.first(), exact.last()) else {
        return Ok(Vec::new());
    };
    let gap = |asked: &Asked, scale: fn(&At) -> f64| {
        if let Some(why) = uncovered(TIME.name, TIME.unit, time, [first.t, last.t], f64::INFINITY) {
            return Gap::Unknown(why);
        }
        let curve = Sampled::new(time, given.column(asked));
        // Rows that end just before the last time are extrapolated.
        let error = |at: &At| curve.at(at.t.min(time[time.len() - 1])).map(|b| b.error / scale(at));
        match exact.iter().map(error).collect::<Option<Vec<f64>>>() {
            Some(errors) => Gap::Error(errors.into_iter().fold(0.0, f64::max)),
            None => Gap::Unknown(format!("{} rows are too few to know the curve between them", time.len())),
        }
    };
    Ok(vec![(SETTLEMENT_ERROR, gap(&SETTLEMENT, |at| at.settlement)), (BASE_PRESSURE_ERROR, gap(&BASE, |_| 1.0))])
}

/// The rows that a code gives; missing values are zero, which no group takes.
fn rows(given: &Given) -> Vec<At> {
    let row =
        |(k, t): (usize, &f64)| At { t: *t, settlement: given.value(&SETTLEMENT, k), base: given.value(&BASE, k) };
    given.column(&TIME).iter().enumerate().map(row).collect()
}
