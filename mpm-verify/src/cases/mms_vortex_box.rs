//! Isochoric vortex in a box: what locks, shows it here.
//!
//! Set-up, choices and tolerances: `docs/mms-vortex-box.md`.

use super::family::{BASES, REMEDIES, family, implicit, more_particles, other_transfers, pairs};
use super::manufactured::checks::{
    Claim, Claims, TRANSFER, Wave, is_other_transfer, is_sound, locking, of_motion,
};
use super::manufactured::metrics::DISPLACEMENT_L2;
use super::manufactured::pictures::mean_stress;
use super::manufactured::{Manufactured, STEP_POISSON_RATIO, all_parameters, levels};
use super::parameters::{DYNAMIC, POISSON_RATIO};
use crate::case::{Case, Family, Tier};
use crate::exact::vortex_box::ENTRY;
use crate::exact::vortex_pressure::PRESSURE;
use crate::metric::{Metric, Sweep};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::spec::Level;

use BasisName::{Bspline2, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate, FbarTotal};
use Tier::{Long, Nightly, Pr, Quick};

/// The vortex: its profile falls from one to a half over 0.16 m, a sixth of a wave.
pub(super) const WAVE: Wave = Wave {
    number: |_| 6.5,
    shear: true,
};
/// Below this cell size (m) the motion crosses so many cells that errors have a floor.
const FLOOR: f64 = 0.01;
/// Below this one (m) fbar-total and fbar-rate take enough steps to feed the null space.
const FED: f64 = 0.02;

pub(super) const ORDERS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, claim)];

/// Errors over the distance from incompressibility.
pub(super) const LOCKING_CURVE: Sweep = Sweep {
    parameter: POISSON_RATIO,
    label: "0.5 − ν",
    abscissa: |nu| 0.5 - nu,
    logarithmic: true,
};

pub(super) fn case() -> Case {
    let levels = levels();
    let names = [
        "mms-vortex-box",
        "Vortex in a box",
        "The middle of a square turns by a radian while its sides stay: no volume changes, so the exact motion doesn't depend on Poisson's ratio, and the error at ν = 0.4999 over that at 0.3 is locking and nothing else.",
    ];
    let own = [&[STEP_POISSON_RATIO.with_default("0.4999")], &DYNAMIC[..]].concat();
    let defaults = [(POISSON_RATIO, "0.4999")];
    let parameters = all_parameters(ENTRY.parameters, &defaults, "0.5", &own);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.extend(locking());
    Case {
        references: vec![
            "Exact solution: a vortex after Kamojjala et al. 2015, doi:10.1007/s00366-013-0342-x, with a profile that is smooth and ends within the box; the balance of momentum is tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "Rotation by up to one radian with F updated by I + Δt ∇v: the error in time is first order. All runs take the steps of ν = 0.4999, so that it is small and alike.",
            "fbar-total and fbar-rate lose convergence, and some runs their life, at n64 and beyond.",
            "The spurious pressure at ν = 0.4999 is λ ln J of errors in J of 10⁻⁴ and doesn't fall over these levels.",
        ],
        plan: plan(&levels),
        levels,
        checks,
        sweeps: vec![LOCKING_CURVE],
        breaks_down: |r| {
            let known = [
                (Bspline2, FbarRate, "n128"),
                (Linear, FbarTotal, "n64"),
                (Gimp, FbarTotal, "n64"),
            ];
            let this = |k: &(_, _, &str)| *k == (r.basis(), r.remedy(), &r.level);
            (r.is_default() && known.iter().any(this)).then_some(NULL_SPACE)
        },
        pictures: |gallery| mean_stress(gallery, "n32", 600.0),
        ..Manufactured::solid(ENTRY.build).case(names, parameters)
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let few = pairs(
        &[Gimp, Bspline2],
        &[RemedyName::None, FbarRate, FbarConsistent],
    );
    let all = pairs(&BASES, &REMEDIES);
    let [midpoint, newmark] = [RuleName::Midpoint, RuleName::Newmark].map(|rule| {
        implicit(
            &[rule],
            &[Gimp, Bspline2],
            &[RemedyName::None, FbarConsistent],
        )
    });
    let [three, four] = more_particles(Nightly, &levels[..3]);
    let two = &levels[..2];
    let near = [RemedyName::None, RemedyName::FbarRecursive, FbarConsistent];
    let limit = pairs(&[Gimp, Bspline2], &near);
    vec![
        family(Quick, &levels[..1], &pairs(&[Gimp], &[FbarConsistent]), &[]),
        family(Pr, &levels[..3], &few, &[]),
        family(Pr, &levels[..2], &few, &["poisson_ratio=0.3"]),
        family(Nightly, &levels[..4], &all, &[]),
        family(Nightly, &levels[..4], &other_transfers(), &[]),
        family(Nightly, &levels[4..], &few[3..], &[]),
        family(Pr, &levels[..2], &midpoint[..2], &["cfl=50"]),
        family(
            Pr,
            &levels[..2],
            &midpoint[..2],
            &["cfl=50", "poisson_ratio=0.3"],
        ),
        family(Nightly, &levels[..4], &midpoint, &["cfl=50"]),
        family(
            Nightly,
            &levels[..2],
            &midpoint,
            &["cfl=50", "poisson_ratio=0.3"],
        ),
        family(
            Nightly,
            &levels[..3],
            &midpoint,
            &["cfl=50", "poisson_ratio=0.499"],
        ),
        family(Nightly, &levels[..4], &newmark, &["cfl=10"]),
        family(
            Nightly,
            &levels[..2],
            &newmark,
            &["cfl=10", "poisson_ratio=0.3"],
        ),
        family(Long, &levels[4..], &midpoint, &["cfl=50"]),
        family(Long, &levels[4..], &newmark, &["cfl=10"]),
        three,
        four,
        family(
            Nightly,
            two,
            &limit,
            &["poisson_ratio=0.49999", "step_poisson_ratio=0.49999"],
        ),
        family(
            Nightly,
            two,
            &limit,
            &["poisson_ratio=0.499999", "step_poisson_ratio=0.499999"],
        ),
        family(
            Nightly,
            two,
            &limit,
            &["poisson_ratio=0.4999999", "step_poisson_ratio=0.4999999"],
        ),
        family(
            Nightly,
            two,
            &midpoint,
            &["cfl=50", "poisson_ratio=0.49999"],
        ),
        family(
            Nightly,
            two,
            &midpoint,
            &["cfl=50", "poisson_ratio=0.499999"],
        ),
        family(
            Nightly,
            two,
            &midpoint,
            &["cfl=50", "poisson_ratio=0.4999999"],
        ),
        family(Nightly, &levels[..3], &all, &["poisson_ratio=0.3"]),
        family(Nightly, &levels[..3], &all, &["poisson_ratio=0.49"]),
        family(Nightly, &levels[..3], &all, &["poisson_ratio=0.499"]),
        family(Long, &levels[4..], &all, &[]),
        family(Long, &levels[4..], &other_transfers(), &[]),
    ]
}

/// Why fbar-total and fbar-rate stop converging.
pub(super) const NULL_SPACE: &str =
    "a pressure that Π can't see feeds the null space as particles pass each other (docs/modes.md)";

/// Whether a scheme feeds the null space for so many steps that it shows.
pub(super) fn feeds_null_space(r: &Record) -> bool {
    matches!(r.remedy(), FbarTotal | FbarRate) && r.discretisation.h < FED
}

/// What is known of convergence of an isochoric motion.
pub(super) fn claim(r: &Record) -> Claim {
    if r.basis() == Linear {
        return Claim::Open("the gradient of a linear basis jumps where particles cross cells");
    }
    if is_other_transfer(r) {
        return Claim::Open(TRANSFER);
    }
    if r.discretisation.h < FLOOR {
        return Claim::Open(
            "particles cross ten cells: the quadrature error of two per direction is a floor",
        );
    }
    if feeds_null_space(r) {
        let shears_only = r.parameters.number(PRESSURE).is_nan();
        let clear = shears_only && r.remedy() == FbarRate && matches!(r.basis(), Gimp | Bspline2);
        return if clear {
            Claim::Stalls(1.0, NULL_SPACE)
        } else {
            Claim::Open(NULL_SPACE)
        };
    }
    if r.scheme().rule().is_some() && is_sound(r.remedy()) && r.discretisation.h < FED {
        return Claim::Open(
            "without relaxation ln(J/J̄) no longer falls, and the error has a floor of a hundredth of the motion",
        );
    }
    if is_sound(r.remedy()) {
        Claim::Observed(
            [0.8, 2.6],
            "second order until the quadrature error of sheared particles shows",
        )
    } else if r.remedy() == RemedyName::None {
        Claim::Open("without a remedy the error is that of locking until the cells resolve it")
    } else {
        Claim::Open("Eq. (26) diffuses J; of an isochoric motion it has little to diffuse")
    }
}
