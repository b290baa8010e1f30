//! Axis-aligned displacement with a pressure gradient normal to the walls: what a basis or an average does
//! at a wall.
//!
//! Set-up, choices and tolerances: `docs/mms-wall-pressure.md`.

use super::manufactured::checks::{self, Wave};
use super::manufactured::plan::{
    BASES, REMEDIES, ladder, more_particles, other_transfers, pairs, union,
};
use super::manufactured::{Manufactured, numerical, parameters};
use super::mms_axis::{claim, judge_study};
use crate::case::{RunSpec, Tier};
use crate::exact::wall_pressure::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use std::f64::consts::PI;
use std::sync::LazyLock;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};

/// The motion: a parabola, nearly half a wave.
const WAVE: Wave = Wave {
    number: PI,
    shear: false,
};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution u_i = 4A X_i (1 − X_i) sin ωt, derived with the code; the balance of momentum is tested by eighth-order differences at random points.",
    ],
    limits: &[
        "Compression and extension without shear: mms-vortex-box has the shear.",
        "At ν = 0.3 nothing locks.",
    ],
    schemes: [pairs(&BASES, &REMEDIES), other_transfers()].concat(),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study,
    ..Manufactured::solid(
        [
            "mms-wall-pressure",
            "Pressure gradient at walls",
            "A neo-Hookean body between rollers is squeezed along its axes so that the pressure is steepest at the walls. Whether bases and averages keep their order there, with both treatments of splines at a wall.",
        ],
        ENTRY.build,
        parameters(
            ENTRY.parameters,
            &[("amplitude", "0.001")],
            numerical("0.013"),
        ),
    )
});

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    let levels = &case.levels;
    let few = [RemedyName::None, FbarRate, FbarConsistent];
    match tier {
        Tier::Quick => ladder(&levels[..1], &pairs(&[Gimp], &[RemedyName::None]), &[]),
        Tier::Pr => union([
            ladder(&levels[..3], &pairs(&[Gimp, Bspline2], &few), &[]),
            ladder(
                &levels[..3],
                &pairs(&[Bspline2], &few[..1]),
                &["wall=wall-line"],
            ),
        ]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(levels, &case.schemes, &[]),
            more_particles(&levels[..3]),
            ladder(
                &levels[..4],
                &pairs(&[Gimp, Bspline2], &REMEDIES),
                &["step_scaling=h2"],
            ),
            ladder(
                &levels[..4],
                &pairs(&[Bspline2, Bspline3], &few),
                &["wall=wall-line"],
            ),
            ladder(
                &levels[..4],
                &pairs(&BASES, &few),
                &["amplitude=0.05", "ppc_per_direction=4"],
            ),
            ladder(
                &levels[..3],
                &pairs(&[Gimp, Bspline2], &[FbarRecursive, FbarConsistent]),
                &["dimension=3"],
            ),
        ]),
        Tier::Long => Vec::new(),
    }
}
