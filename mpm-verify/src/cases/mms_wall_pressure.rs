//! Axis-aligned displacement with a pressure gradient normal to the walls: what a basis or an average does
//! at a wall.
//!
//! Set-up, choices and tolerances: `docs/mms-wall-pressure.md`.

use super::family::{BASES, REMEDIES, family, implicit, more_particles, other_transfers, pairs};
use super::manufactured::checks::{Claim, Claims, Wave, of_motion, order_in_time, stress_order};
use super::manufactured::metrics::DISPLACEMENT_L2;
use super::manufactured::{Manufactured, all_parameters, levels};
use super::mms_axis;
use super::parameters::DYNAMIC;
use crate::case::{Case, Family, Tier};
use crate::exact::common::AMPLITUDE;
use crate::exact::wall_pressure::ENTRY;
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::spec::Level;
use std::f64::consts::PI;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};
use Tier::{Long, Nightly, Pr, Quick};

/// The motion: half a wave across the body.
const WAVE: Wave = Wave {
    number: |_| PI,
    shear: false,
};

const ORDERS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, claim)];

/// As without a pressure gradient at the walls, but that the floor of hats is half as high.
fn claim(r: &Record) -> Claim {
    if r.scheme().rule().is_some() && r.basis() == BasisName::Linear {
        return Claim::Open(mms_axis::HATS);
    }
    mms_axis::claim(r)
}

pub(super) fn case() -> Case {
    let levels = levels();
    let names = [
        "mms-wall-pressure",
        "Pressure gradient at walls",
        "A neo-Hookean body between rollers is squeezed along its axes so that the pressure is steepest at the walls. Whether bases and averages keep their order there, with both treatments of splines at a wall.",
    ];
    let parameters = all_parameters(ENTRY.parameters, &[(AMPLITUDE, "0.001")], "0.013", &DYNAMIC);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.push(stress_order(ORDERS));
    checks.extend(order_in_time());
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

/// Steps, each half as long as the one before.
const HALVED: [&[&str]; 3] = [&["cfl=0.4375"], &["cfl=0.21875"], &["cfl=0.109375"]];
/// The same with a consistent and a lumped mass.
const CONSISTENT: [&[&str]; 3] = [
    &["cfl=0.4375", "lumped=0"],
    &["cfl=0.21875", "lumped=0"],
    &["cfl=0.109375", "lumped=0"],
];
const LUMPED: [&[&str]; 3] = [
    &["cfl=0.4375", "lumped=1"],
    &["cfl=0.21875", "lumped=1"],
    &["cfl=0.109375", "lumped=1"],
];

fn plan(levels: &[Level]) -> Vec<Family> {
    let few = [RemedyName::None, FbarRate, FbarConsistent];
    let two = [Gimp, Bspline2];
    let rules = [RuleName::Midpoint, RuleName::Newmark];
    let moved = implicit(&rules, &BASES[..3], &few[..1]);
    let [three, four] = more_particles(Nightly, &levels[..3]);
    // GIMP's consistent mass is singular once particles have moved.
    let definite = [moved[0], moved[2]];
    let in_time = [
        CONSISTENT.map(|set| family(Pr, &levels[..1], &definite[1..], set)),
        CONSISTENT.map(|set| family(Nightly, &levels[1..2], &definite, set)),
        HALVED.map(|set| family(Nightly, &levels[1..2], &moved, set)),
        LUMPED.map(|set| family(Nightly, &levels[1..2], &moved[..3], set)),
    ];
    let in_space = [
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
        family(Nightly, &levels[..4], &moved, &["cfl=2"]),
        family(Long, &levels[4..], &moved, &["cfl=2"]),
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
    ];
    let in_time = in_time.into_iter().flatten();
    in_space.into_iter().chain(in_time).collect()
}
