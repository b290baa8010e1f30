//! Double shear of a periodic body: no boundary at all.
//!
//! Set-up, choices and tolerances: `docs/mms-double-shear.md`.

use super::family::{BASES, REMEDIES, family, levels, more_particles, other_transfers, pairs};
use super::manufactured::checks::{Claim, Claims, TRANSFER, Wave, is_sound, locking, of_motion};
use super::manufactured::metrics::DISPLACEMENT_L2;
use super::manufactured::pictures::mean_stress;
use super::manufactured::{Boundary, Manufactured, STEP_POISSON_RATIO, all_parameters};
use super::mms_vortex_box::{LOCKING_CURVE, NULL_SPACE, feeds_null_space};
use super::parameters::POISSON_RATIO;
use crate::case::{Case, Family, Tier};
use crate::exact::double_shear::ENTRY;
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use crate::spec::Level;
use std::f64::consts::TAU;

use BasisName::{Bspline2, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate};
use Tier::{Nightly, Pr, Quick};

/// The motion: one wave across the body.
const WAVE: Wave = Wave {
    number: |_| TAU,
    shear: true,
};

const ORDERS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, claim)];

pub(super) fn case() -> Case {
    let levels = levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    );
    let names = [
        "mms-double-shear",
        "Double shear",
        "A periodic body is sheared along x and then along y at constant volume: nearly incompressible, with cells crossed and without any boundary.",
    ];
    let motion = Manufactured {
        boundary: Boundary::Periodic,
        ..Manufactured::solid(ENTRY.build)
    };
    let own = [STEP_POISSON_RATIO.with_default("0.4999")];
    let defaults = [(POISSON_RATIO, "0.4999")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.5", &own);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.extend(locking());
    Case {
        references: vec![
            "Exact solution: two shears in turn, x = X + A sin kY s, y = Y + A sin kx s; J = 1 exactly. The balance of momentum is tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "No boundary: mms-vortex-box has walls.",
            "As in mms-vortex-box, all runs take the steps of ν = 0.4999.",
        ],
        plan: plan(&levels),
        levels,
        checks,
        sweeps: vec![LOCKING_CURVE],
        breaks_down: |r| {
            let scheme = (r.basis(), r.remedy()) == (Gimp, RemedyName::FbarTotal);
            (r.is_default() && scheme && r.level == "n64").then_some(NULL_SPACE)
        },
        pictures: |gallery| mean_stress(gallery, "n64", 100.0),
        ..motion.case(names, parameters)
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let none = RemedyName::None;
    let few = pairs(&[Gimp, Bspline2], &[none, FbarRate, FbarConsistent]);
    let all = pairs(&BASES, &REMEDIES);
    let [three, four] = more_particles(Nightly, &levels[..3]);
    vec![
        family(Quick, &levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        family(Pr, &levels[..3], &[few[1], few[2], few[5]], &[]),
        family(Nightly, levels, &all, &[]),
        family(Nightly, levels, &other_transfers(), &[]),
        three,
        four,
        family(Nightly, &levels[..3], &all, &["poisson_ratio=0.3"]),
        family(Nightly, &levels[..2], &few, &["poisson_ratio=0.49"]),
        family(Nightly, &levels[..2], &few, &["poisson_ratio=0.499"]),
    ]
}

fn claim(r: &Record) -> Claim {
    if r.basis() == Linear {
        return Claim::Open("the gradient of a linear basis jumps where particles cross cells");
    }
    if r.transfer() != TransferName::Flip {
        return Claim::Open(TRANSFER);
    }
    if feeds_null_space(r) {
        return if r.basis() == Gimp {
            Claim::Stalls(1.0, NULL_SPACE)
        } else {
            Claim::Open(NULL_SPACE)
        };
    }
    if is_sound(r.remedy()) {
        Claim::Observed(
            [1.4, 2.6],
            "second order until the quadrature error of sheared particles shows",
        )
    } else if r.remedy() == RemedyName::None {
        Claim::Open("without a remedy the error is that of locking until the cells resolve it")
    } else {
        Claim::Open("Eq. (26) diffuses J; of an isochoric motion it has little to diffuse")
    }
}
