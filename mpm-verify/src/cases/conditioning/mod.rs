//! What a grid that cuts a body does to the matrices of solid and water, and what ghost penalties do to that.
//!
//! Section 5.2 of Pretti et al., doi:10.1002/nme.7630. Set-up, choices and tolerances: `docs/conditioning.md`.

mod checks;
mod forms;
mod look;
mod metrics;
mod parameters;
mod tables;

use super::family::family;
use super::still::Still;
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use forms::HALF_AXES;
use look::Cuts;
use metrics::{COND_PP, COND_PP_MEAN, COND_UU, COND_UU_MEAN, DEFLECTION_CHANGE};

use BasisName::{Gimp, Linear};
use SpaceName::{Equal, TwoGrid};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [Level; 1] = [Level {
    name: "h0.1",
    h: 0.1,
}];
const WITHOUT: &[&str] = &["alpha=0"];
const FEW: &[&str] = &["positions=8"];
/// The other strengths.
const STRENGTHS: [&[&str]; 4] = [
    &["alpha=0.001"],
    &["alpha=0.01"],
    &["alpha=1"],
    &["alpha=10"],
];
/// Hardly any flow: with the paper's penalty of the pressure, and with one that stays.
const STORED: &[&str] = &["pressure_ghost=storage"];
const FLOWING: &[&str] = &["mobility=1"];
const FLOWING_WITHOUT: &[&str] = &["alpha=0", "mobility=1"];

pub(super) fn case() -> Case {
    Case {
        name: "conditioning",
        title: "Condition numbers of a body that no grid line fits",
        description: "Half an ellipse at forty places within one cell of the pressure: condition numbers of the matrices of displacement and \
                      pressure and of the whole, for strengths of the ghost penalties, and what these cost a cantilever.",
        references: vec![
            "Theory: a penalty is positive semidefinite, so that it lowers no eigenvalue and no body bends more.".to_owned(),
            "Figure 8 of Pretti et al., doi:10.1002/nme.7630, as its text tells: its numbers were not at hand.".to_owned(),
        ],
        limits: &[
            "Matrices of an undeformed body at small strain, of the solver's functions and facets but assembled here.",
            "How flat condition numbers are with a penalty is observed, no theory of the material point method bounds it.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(),
        levels: LEVELS.to_vec(),
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(COND_UU, "log₁₀ cond uu, most", 1.0, 2),
            headline(COND_UU_MEAN, "mean", 1.0, 2),
            headline(COND_PP, "log₁₀ cond pp, most", 1.0, 2),
            headline(COND_PP_MEAN, "mean", 1.0, 2),
            headline(DEFLECTION_CHANGE, "change of deflection (%)", 100.0, 2),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["log10_cond_uu", "log10_cond_pp"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|_| 1.0),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Still::new(Cuts::new(spec, parameters)?)))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn plan() -> Vec<Family> {
    let of = |space| [Gimp, Linear].map(|basis| Scheme::poro(basis, space));
    let (two, equal) = (of(TwoGrid), of(Equal));
    let mut all = vec![
        family(Quick, &LEVELS, &two[..1], FEW),
        family(Pr, &LEVELS, &two, &[]),
        family(Pr, &LEVELS, &two, WITHOUT),
        family(Nightly, &LEVELS, &equal, &[]),
        family(Nightly, &LEVELS, &two, STORED),
        family(Nightly, &LEVELS, &two, FLOWING),
        family(Nightly, &LEVELS, &two, FLOWING_WITHOUT),
    ];
    all.extend(STRENGTHS.map(|set| family(Nightly, &LEVELS, &two, set)));
    all
}

fn sketch() -> Sketch {
    let [a, b] = HALF_AXES.map(|a| 0.1 * a);
    let arc = (0..=24).map(|k| {
        let angle = std::f64::consts::PI * f64::from(k) / 24.0;
        [a * angle.cos(), b * angle.sin()]
    });
    Sketch {
        shapes: vec![
            Shape::Body(arc.collect()),
            Shape::Held([-a, 0.0], [a, 0.0]),
            Shape::length([-a, -0.2], [a, -0.2], "20 h"),
            Shape::length([a + 0.15, 0.0], [a + 0.15, b], "6 h"),
            Shape::note([0.0, 0.25], "moved through 2 h"),
        ],
        description: "Half an ellipse of 20 by 6 cells, held and drained at its straight side, which is moved along a grid line.",
    }
}
