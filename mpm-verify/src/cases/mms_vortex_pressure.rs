//! Vortex in a box with a bounded pressure: an average must give back the right pressure, not a small one.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-pressure.md`.

use super::family::{REMEDIES, family, levels, more_particles, other_transfers, pairs};
use super::manufactured::checks::{locking, of_motion};
use super::manufactured::{Manufactured, STEP_POISSON_RATIO, all_parameters};
use super::mms_vortex_box::{LOCKING_CURVE, ORDERS, WAVE};
use super::parameters::POISSON_RATIO;
use crate::case::{Case, Family, Tier};
use crate::exact::vortex_pressure::ENTRY;
use crate::scheme::{BasisName, RemedyName};
use crate::spec::Level;

use BasisName::{Bspline2, Gimp};
use RemedyName::{FbarConsistent, FbarRate};
use Tier::{Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels = levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    );
    let names = [
        "mms-vortex-pressure",
        "Vortex with a bounded pressure",
        "The vortex in a box, with a pressure that stays bounded as the body becomes incompressible: a remedy must not only remove the spurious pressure but leave the true one.",
    ];
    let own = [STEP_POISSON_RATIO.with_default("0.4999")];
    let defaults = [(POISSON_RATIO, "0.499")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.5", &own);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.extend(locking());
    Case {
        references: vec![
            "Exact solution: the vortex in a box after a volume change whose pressure tends to p₀ sin ωt (cos 2πX + cos 2πY) as ν → ½; body force from the general formula, tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "The pressure is 100 Pa; at ν = 0.4999 an error of 10⁻⁴ in J is worth more.",
            "As in mms-vortex-box, all runs take the steps of ν = 0.4999.",
        ],
        plan: plan(&levels),
        levels,
        checks,
        sweeps: vec![LOCKING_CURVE],
        ..Manufactured::solid(ENTRY.build).case(names, parameters)
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let two = [Gimp, Bspline2];
    let all = pairs(&two, &REMEDIES);
    let [three, four] = more_particles(Nightly, &levels[..3]);
    vec![
        family(Quick, &levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        family(
            Pr,
            &levels[..2],
            &pairs(&two, &[FbarRate, FbarConsistent]),
            &[],
        ),
        family(Nightly, levels, &all, &[]),
        family(Nightly, levels, &other_transfers(), &[]),
        three,
        four,
        family(Nightly, &levels[..2], &all, &["poisson_ratio=0.3"]),
        family(Nightly, &levels[..2], &all, &["poisson_ratio=0.49"]),
        family(Nightly, &levels[..2], &all, &["poisson_ratio=0.4999"]),
    ]
}
