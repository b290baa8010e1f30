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
    Foreign {
        gaps,
        ..Foreign::of::<2, Trials>(
            groups,
            &[
                "Plane strain. Clay below y = 0 … `height` H from a smooth wall at x = 0 to the crest at x = `crest`, from there down a face at `face_angle` to the toe at y = 0. The base y = 0 is fixed and runs on by `floor` before the toe.",
                "Hencky elasticity (W = μ ‖h‖² + λ/2 (tr h)², h = ½ ln b) with `young_modulus`, `poisson_ratio`; perfectly plastic at ‖s‖ = `strength`; `density`, g = 9.81 m/s².",
                "At rest under its weight with the full strength; each trial begins there, with the strength divided by a factor at once.",
                "A trial ends after 4 s with some damping, or in equilibrium or without one. A row a trial, in any order: factors as close to each other as `trials` steps of bisection from 1 to `most` leave them.",
            ],
        )
    }
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
    let why = if fails.is_infinite() && stands < setup.most {
        Some(format!("it fails at none of the factors up to {stands}: larger ones up to {} show where", setup.most))
    } else if stands >= fails {
        Some(format!("it stands at {stands} and fails at {fails}: no factor lies between"))
    } else if fails.is_finite() && 0.5 * (fails - stands) > setup.resolution() * (1.0 + 1e-9) {
        Some(format!(
            "{stands} and {fails} are {:.3} apart, where {:.3} are allowed",
            fails - stands,
            2.0 * setup.resolution()
        ))
    } else {
        None
    };
    let of_factor = [STRENGTH_REDUCTION_FACTOR, FACTOR_ERROR];
    Ok(why.into_iter().flat_map(|why| of_factor.map(|metric| (metric, Gap::Unknown(why.clone())))).collect())
}
