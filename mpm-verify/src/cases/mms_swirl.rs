//! Isochoric swirl in three dimensions.
//!
//! Set-up, choices and tolerances: `docs/mms-swirl.md`.

use super::family::{family, levels, more_particles, pairs};
use super::manufactured::checks::{locking, of_motion};
use super::manufactured::{Boundary, Manufactured, STEP_POISSON_RATIO, all_parameters};
use super::mms_vortex_box::{ORDERS, WAVE};
use super::parameters::POISSON_RATIO;
use crate::case::{Case, Tier};
use crate::exact::swirl::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use mpm_core::stage::WallKind;

use BasisName::{Bspline2, Gimp};
use RemedyName::{FbarConsistent, FbarRate};
use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(1.0, [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)]);
    let names = [
        "mms-swirl",
        "Swirl in three dimensions",
        "The middle of a cube turns about the vertical by an angle that is largest in the centre and vanishes on all sides: isochoric, in three dimensions.",
    ];
    let motion = Manufactured {
        boundary: Boundary::Walls(WallKind::Fixed),
        ..Manufactured::solid(ENTRY.build)
    };
    let own = [STEP_POISSON_RATIO.with_default("0.499")];
    let defaults = [(POISSON_RATIO, "0.499")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.5", &own);
    let none = RemedyName::None;
    let few = pairs(&[Gimp, Bspline2], &[none, FbarRate, FbarConsistent]);
    let [three, four] = more_particles(Nightly, &levels[..2]);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.extend(locking());
    Case {
        references: vec![
            "Exact solution: the vortex in a box, its angle falling to zero at floor and ceiling; derived with the code, the balance of momentum is tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "Three levels, the coarsest with three cells across the radius of the vortex.",
            "The steps are those of ν = 0.499.",
        ],
        plan: vec![
            family(Quick, &levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
            family(Pr, &levels[..1], &few, &[]),
            family(Nightly, &levels, &few, &[]),
            family(Nightly, &levels[..2], &few, &["poisson_ratio=0.3"]),
            three,
            four,
        ],
        levels,
        checks,
        ..motion.case(names, parameters)
    }
}
