//! Axis-aligned displacement with a pressure gradient normal to the walls: what a basis or an average does
//! at a wall.
//!
//! Set-up, choices and tolerances: `docs/mms-wall-pressure.md`.

use super::family::{BASES, REMEDIES, family, more_particles, other_transfers, pairs};
use super::manufactured::checks::{Wave, of_motion, order_in_time, stress_order};
use super::manufactured::{Manufactured, all_parameters, levels};
use super::mms_axis::ORDERS;
use crate::case::{Case, Family, Tier};
use crate::exact::parameters::AMPLITUDE;
use crate::exact::wall_pressure::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use crate::spec::Level;
use std::f64::consts::PI;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};
use Tier::{Nightly, Pr, Quick};

/// The motion: half a wave across the body.
const WAVE: Wave = Wave {
    number: PI,
    shear: false,
};

pub(super) fn case() -> Case {
    let levels = levels();
    let names = [
        "mms-wall-pressure",
        "Pressure gradient at walls",
        "A neo-Hookean body between rollers is squeezed along its axes so that the pressure is steepest at the walls. Whether bases and averages keep their order there, with both treatments of splines at a wall.",
    ];
    let parameters = all_parameters(ENTRY.parameters, &[(AMPLITUDE, "0.001")], "0.013", &[]);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.extend([stress_order(ORDERS), order_in_time()]);
    Case {
        references: vec![
            "Exact solution u_i = 4A X_i (1 − X_i) sin ωt, derived with the code; the balance of momentum is tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "Compression and extension without shear: mms-vortex-box has the shear.",
            "At ν = 0.3 nothing locks.",
        ],
        plan: plan(&levels),
        levels,
        checks,
        ..Manufactured::solid(ENTRY.build).case(names, parameters)
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let few = [RemedyName::None, FbarRate, FbarConsistent];
    let two = [Gimp, Bspline2];
    let [three, four] = more_particles(Nightly, &levels[..3]);
    vec![
        family(Quick, &levels[..1], &pairs(&[Gimp], &few[..1]), &[]),
        family(Pr, &levels[..3], &pairs(&two, &few), &[]),
        family(
            Pr,
            &levels[..3],
            &pairs(&[Bspline2], &few[..1]),
            &["wall=wall-line"],
        ),
        family(Nightly, levels, &pairs(&BASES, &REMEDIES), &[]),
        family(Nightly, levels, &other_transfers(), &[]),
        three,
        four,
        family(
            Nightly,
            &levels[..4],
            &pairs(&two, &REMEDIES),
            &["step_scaling=h2"],
        ),
        family(
            Nightly,
            &levels[..4],
            &pairs(&[Bspline2, Bspline3], &few),
            &["wall=wall-line"],
        ),
        family(
            Nightly,
            &levels[..4],
            &pairs(&BASES, &few),
            &["amplitude=0.05", "ppc_per_direction=4"],
        ),
        family(
            Nightly,
            &levels[..3],
            &pairs(&two, &[FbarRecursive, FbarConsistent]),
            &["dimension=3"],
        ),
    ]
}
