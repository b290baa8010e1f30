//! Columns that another code supplies, and the factor of safety that follows from them.

use super::run::{Trial, bracket};
use super::*;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group, Part};

const FACTOR: Asked = Asked::series("factor", "-", "factor by which the strength is divided in a trial");
const OUTCOME: Asked = Asked::series(
    "fails",
    "-",
    "1 if a particle moves by more than H/50 in the trial, 0 if the slope comes to rest before",
);

pub(in crate::cases) fn foreign() -> Foreign {
    let factors = [STRENGTH_REDUCTION_FACTOR, FACTOR_ERROR, STANDS_AT, FAILS_AT];
    let groups = vec![Group::new(&[FACTOR, OUTCOME], factors, |given| {
        Ok(given.setup::<Stability>()?.measure(&trials(given), f64::NAN))
    })];
    Foreign { gaps, ..Foreign::of::<2, Trials>(groups) }
}

fn trials(given: &Given) -> Vec<Trial> {
    let trial = |k| {
        let (factor, fails) = (given.value(&FACTOR, k), given.value(&OUTCOME, k) > 0.5);
        Trial { factor, fails, ..Trial::default() }
    };
    (0..given.rows(Part::Series)).map(trial).collect()
}

/// The factor is known to half of the bracket that its trials leave.
fn gaps(given: &Given) -> Gaps {
    let setup = given.setup::<Stability>()?;
    let (stands, fails) = bracket(&trials(given));
    let (width, allowed) = (fails - stands, 2.0 * setup.resolution() * (1.0 + 1e-9));
    let is_known = width > 0.0 && width <= allowed || fails.is_infinite() && stands >= setup.most;
    let why = format!(
        "it stands at {stands} and fails at {fails}: the factor is known where these are up to {allowed:.3} apart"
    );
    let gap = |metric| (!is_known).then(|| (metric, Gap::Unknown(why.clone())));
    Ok([STRENGTH_REDUCTION_FACTOR, FACTOR_ERROR].into_iter().filter_map(gap).collect())
}
