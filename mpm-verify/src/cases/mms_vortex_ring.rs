//! Generalised vortex in a ring: rotation and shear with a body force that jumps.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-ring.md`.

use super::family::{family, levels, main_pairs, more_particles, other_transfers, pairs};
use super::manufactured::checks::{Claim, Claims, TRANSFER, Wave, of_motion};
use super::manufactured::metrics::DISPLACEMENT_L2;
use super::manufactured::{Boundary, Manufactured, STEP_POISSON_RATIO, all_parameters};
use super::parameters::PPC_PER_DIRECTION;
use crate::case::{Case, Tier};
use crate::exact::vortex_ring::{ANGLE, ENTRY};
use crate::metric::Metric;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use mpm_core::stage::WallKind;
use std::f64::consts::TAU;

use BasisName::{Bspline2, Bspline3, Gimp};
use RemedyName::{FbarConsistent, FbarRate};

/// Angles (rad) beyond this shear the ring by more than its own thickness.
const LARGE: f64 = 0.1;

/// The motion: half a wave across the ring.
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
    let few = main_pairs();
    let all = pairs(
        &[Gimp, Bspline2, Bspline3],
        &[RemedyName::None, FbarRate, FbarConsistent],
    );
    let [three, four] = more_particles(Tier::Nightly, &levels[..3]);
    let motion = Manufactured {
        boundary: Boundary::Walls(WallKind::Fixed),
        ..Manufactured::solid(ENTRY.build)
    };
    let names = [
        "mms-vortex-ring",
        "Vortex in a ring",
        "A ring of a square block turns about its middle, most at half its thickness and not at all at its edges. Rotation, shear and a body force that jumps.",
    ];
    let defaults = [(ANGLE, "0.05")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.5", &[STEP_POISSON_RATIO]);
    Case {
        references: vec![
            "Exact solution: Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x; material at rest fills the square around the ring.".to_owned(),
        ],
        limits: &[
            "h″ and with it the body force jumps at the two circles: order two in L2 at best, less in L∞.",
            "At the angle of 45° of the literature the shear reaches 4.8: particles on fixed domains lose touch and nothing converges (set angle=0.7853981633974483).",
        ],
        plan: vec![
            family(Tier::Quick, &levels[..1], &few[..1], &[]),
            family(Tier::Pr, &levels[..2], &few, &[]),
            family(Tier::Nightly, &levels, &[all, other_transfers()].concat(), &[]),
            three,
            four,
            family(Tier::Nightly, &levels[..3], &few, &["angle=0.7853981633974483"]),
        ],
        levels,
        checks: of_motion(ORDERS, WAVE),
        ..motion.case(names, parameters)
    }
}

fn claim(r: &Record) -> Claim {
    if r.parameters.number(ANGLE) > LARGE {
        Claim::Stalls(1.0, "shear of 4.8 parts particles by five cells and more")
    } else if r.transfer() != TransferName::Flip {
        Claim::Open(TRANSFER)
    } else if r.parameters.number(PPC_PER_DIRECTION) > 2.0 {
        Claim::Open("runs with more particles end at n32; the band is that of n16 to n64")
    } else {
        Claim::Observed(
            [1.15, 2.15],
            "the body force jumps at the two circles: order two at best",
        )
    }
}
