//! Axis-aligned displacement: compression and extension without shear, in one, two and three dimensions.
//!
//! Set-up, choices and tolerances: `docs/mms-axis.md`.

use super::family::{BASES, REMEDIES, family, implicit, more_particles, other_transfers, pairs};
use super::manufactured::checks::{
    Claim, Claims, STALLED, TRANSFER, Wave, is_other_transfer, is_sound, of_motion, order_in_time,
    stress_order,
};
use super::manufactured::metrics::DISPLACEMENT_L2;
use super::manufactured::{CFL, Manufactured, PPC_PER_DIRECTION, all_parameters, levels};
use super::parameters::{DYNAMIC, STEP_SCALING, WALL, WALL_LINE};
use crate::case::{Case, Family, Tier};
use crate::exact::axis_aligned::{ENTRY, HALF_WAVES};
use crate::exact::common::{AMPLITUDE, DIMENSION};
use crate::metric::{Metric, Sweep};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, TransferName};
use crate::spec::Level;
use std::f64::consts::PI;

use BasisName::{Bspline2, Bspline3, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};
use Tier::{Long, Nightly, Pr, Quick};

/// Displacements (m) beyond this cross cells that the levels have.
const CROSSING: f64 = 0.01;

/// The motion: half waves across the body, a wave by default.
const WAVE: Wave = Wave {
    number: |p| PI * p.number(HALF_WAVES),
    shear: false,
};

const ORDERS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, claim)];

pub(super) fn case() -> Case {
    let levels = levels();
    let names = [
        "mms-axis",
        "Axis-aligned displacement",
        "A neo-Hookean body between rollers is stretched and compressed along its axes by a body force that makes the motion known. Orders of accuracy in space and time for every basis, remedy and transfer; small displacements and forced crossing of cells.",
    ];
    let parameters = all_parameters(ENTRY.parameters, &[(AMPLITUDE, "0.001")], "0.013", &DYNAMIC);
    let mut checks = of_motion(ORDERS, WAVE);
    checks.push(stress_order(ORDERS));
    checks.extend(order_in_time());
    Case {
        references: vec![
            "Exact solution: Wallstedt & Guilkey 2008, doi:10.1016/j.jcp.2008.07.019, with a phase per axis; the balance of momentum is tested by eighth-order differences at random points.".to_owned(),
        ],
        limits: &[
            "∂J/∂n = 0 at the walls: mms-wall-pressure tests what this problem hides there.",
            "At ν = 0.3 nothing locks; what averaging costs shows, what it is for doesn't.",
            "Two particles per direction leave a floor once they cross cells, and cubic splines with F̄ and two per direction break the pattern at large strain.",
        ],
        plan: plan(&levels),
        levels,
        checks,
        sweeps: vec![
            Sweep {
                parameter: PPC_PER_DIRECTION,
                label: "particles per direction",
                abscissa: |n| n,
                logarithmic: false,
            },
            Sweep {
                parameter: CFL,
                label: "CFL number",
                abscissa: |c| c,
                logarithmic: true,
            },
        ],
        ..Manufactured::solid(ENTRY.build).case(names, parameters)
    }
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let none = RemedyName::None;
    let main = pairs(
        &[Gimp, Bspline2],
        &[none, FbarRecursive, FbarRate, FbarConsistent],
    );
    let sound = |bases: &[BasisName]| pairs(bases, &[none, FbarRate, FbarConsistent]);
    let all = pairs(&BASES, &REMEDIES);
    let pair = pairs(&[Gimp, Bspline2], &REMEDIES);
    // The step that the program offers: stable, and right.
    let offered = pairs(&BASES[1..], &[none, FbarConsistent]);
    let large = pairs(&[Gimp, Bspline2], &[none]);
    let rules = [RuleName::Midpoint, RuleName::Newmark];
    let moved = implicit(&rules, &BASES[..3], &[none]);
    let smooth = implicit(&rules[..1], &[Gimp, Bspline2], &[none]);
    let [three, four] = more_particles(Nightly, &levels[..3]);
    vec![
        family(Quick, &levels[..1], &pairs(&[Gimp], &[none]), &[]),
        family(Pr, &levels[..3], &main, &[]),
        family(
            Pr,
            &levels[..3],
            &pairs(&[Gimp], &[FbarRecursive, FbarConsistent]),
            &["step_scaling=h2"],
        ),
        // Only so large a motion tells where a body force is evaluated; no particle crosses yet.
        family(Pr, &levels[..3], &large, &["amplitude=0.005"]),
        family(Nightly, levels, &all, &[]),
        family(Pr, &levels[..1], &offered, &["time_step=auto"]),
        family(Nightly, levels, &other_transfers(), &[]),
        family(
            Nightly,
            levels,
            &[Scheme::explicit(Gimp, none, TransferName::Musl)],
            &[],
        ),
        family(Nightly, &levels[..4], &pair, &["step_scaling=h2"]),
        family(Nightly, &levels[..4], &sound(&BASES), &["amplitude=0.02"]),
        family(
            Nightly,
            &levels[..4],
            &sound(&BASES[1..]),
            &["amplitude=0.02", "ppc_per_direction=4"],
        ),
        family(Nightly, &levels[..4], &all, &["dimension=1"]),
        family(
            Nightly,
            &levels[..3],
            &sound(&[Gimp, Bspline2]),
            &["dimension=3"],
        ),
        family(Pr, &levels[..3], &smooth[1..], &["cfl=2"]),
        family(Nightly, &levels[..4], &moved, &["cfl=2"]),
        family(
            Nightly,
            &levels[..3],
            &moved[..3],
            &["amplitude=0.02", "cfl=2"],
        ),
        family(Nightly, &levels[1..3], &smooth, &["cfl=0.5"]),
        family(Nightly, &levels[1..4], &smooth, &["cfl=5"]),
        family(Nightly, &levels[3..4], &smooth, &["cfl=50"]),
        family(Long, &levels[4..], &moved, &["cfl=2"]),
        three,
        four,
        family(Nightly, &levels[1..2], &pair, &["cfl=0.15"]),
        family(Nightly, &levels[1..2], &pair, &["cfl=0.075"]),
        family(Nightly, &levels[1..2], &pair, &["cfl=0.0375"]),
        family(
            Nightly,
            &levels[2..3],
            &sound(&BASES),
            &["ppc_per_direction=1"],
        ),
        family(
            Nightly,
            &levels[2..3],
            &sound(&BASES),
            &["ppc_per_direction=3"],
        ),
        family(
            Nightly,
            &levels[2..3],
            &sound(&BASES),
            &["ppc_per_direction=4"],
        ),
    ]
}

/// Why hats have a floor.
pub(super) const HATS: &str = "displaced particles shift a linear basis's quadrature of mass and body force by u, a floor of about A² k";

/// What is known of convergence between rollers, with or without a pressure gradient at the walls.
pub(super) fn claim(r: &Record) -> Claim {
    let amplitude = r.parameters.number(AMPLITUDE);
    let ppc = r.parameters.number(PPC_PER_DIRECTION);
    if ppc == 1.0 {
        return Claim::Open("one particle per cell doesn't integrate what the basis can represent");
    }
    if r.parameters.is(WALL, WALL_LINE) {
        return Claim::Stalls(
            STALLED,
            "splines that are not interpolatory at a wall meet it with first order",
        );
    }
    if r.remedy() == FbarRecursive {
        return if r.parameters.is(STEP_SCALING, "h2") {
            Claim::Stalls(
                0.5,
                "Eq. (26) diffuses J with D = ½ s² h²/Δt, which Δt ∝ h² keeps constant",
            )
        } else if amplitude >= CROSSING {
            Claim::Open("crossing of cells adds to the diffusion of Eq. (26)")
        } else {
            Claim::Observed(
                [0.6, 1.15],
                "Eq. (26) diffuses J with D = ½ s² h²/Δt ∝ h: first order",
            )
        };
    }
    if amplitude >= CROSSING {
        return if r.basis() == Linear {
            Claim::Stalls(
                0.5,
                "the gradient of a linear basis jumps where particles cross cells",
            )
        } else {
            Claim::Open(
                "the quadrature error of particles that left their lattice is a floor; see the page",
            )
        };
    }
    if is_other_transfer(r) {
        return Claim::Open(TRANSFER);
    }
    if r.parameters.number(DIMENSION) == 1.0 {
        match (r.basis(), r.remedy()) {
            (Gimp, RemedyName::None) => {
                return Claim::Observed(
                    [1.4, 2.6],
                    "within a cell GIMP's weights are hats: displaced particles shift its quadrature, a floor of about A² k",
                );
            }
            (Bspline3, remedy) if is_sound(remedy) => {
                return Claim::Open(
                    "in one dimension F̄ averages all of the stress, next to walls where cubics lack an order",
                );
            }
            _ => {}
        }
    }
    match r.basis() {
        Linear if r.scheme().rule().is_some() => Claim::Stalls(STALLED, HATS),
        Linear => Claim::Open(HATS),
        Bspline3 => Claim::Observed(
            [0.85, 2.3],
            "the lumped mass of cubics next to a wall has its centre off the node: between first and second order",
        ),
        _ => Claim::Second,
    }
}
