//! Axis-aligned displacement: compression and extension without shear, in one, two and three dimensions.
//!
//! Set-up, choices and tolerances: `docs/mms-axis.md`.

use super::manufactured::checks::{self, Claim, Wave};
use super::manufactured::plan::{
    BASES, REMEDIES, ladder, more_particles, other_transfers, pairs, union,
};
use super::manufactured::{Manufactured, numerical, parameters};
use crate::case::{RunSpec, Sweep, Tier};
use crate::exact::axis_aligned::ENTRY;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};
use std::f64::consts::TAU;
use std::sync::LazyLock;

use BasisName::{Bspline2, Bspline3, Gimp, Linear};
use RemedyName::{FbarConsistent, FbarRate, FbarRecursive};

/// Displacements (m) beyond this cross cells that the levels have.
const CROSSING: f64 = 0.01;

/// The motion: a wave across the body.
const WAVE: Wave = Wave {
    number: TAU,
    shear: false,
};

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact solution: Wallstedt & Guilkey 2008, doi:10.1016/j.jcp.2008.07.019, with a phase per axis; the balance of momentum is tested by eighth-order differences at random points.",
    ],
    limits: &[
        "∂J/∂n = 0 at the walls: mms-wall-pressure tests what this problem hides there.",
        "At ν = 0.3 nothing locks; what averaging costs shows, what it is for doesn't.",
        "Two particles per direction leave a floor once they cross cells, and cubic splines with F̄ and two per direction break the pattern at large strain.",
    ],
    schemes: [pairs(&BASES, &REMEDIES), other_transfers()].concat(),
    plan,
    checks: checks::CHECKS,
    judge: |record| checks::of_run(record, &claim(record), &WAVE),
    judge_study,
    sweeps: &[
        Sweep {
            parameter: "ppc_per_direction",
            label: "particles per direction",
            abscissa: |n| n,
            logarithmic: false,
        },
        Sweep {
            parameter: "cfl",
            label: "CFL number",
            abscissa: |c| c,
            logarithmic: true,
        },
    ],
    ..Manufactured::solid(
        [
            "mms-axis",
            "Axis-aligned displacement",
            "A neo-Hookean body between rollers is stretched and compressed along its axes by a body force that makes the motion known. Orders of accuracy in space and time for every basis, remedy and transfer; small displacements and forced crossing of cells.",
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
    let main = [RemedyName::None, FbarRecursive, FbarRate, FbarConsistent];
    let sound = pairs(
        &[Gimp, Bspline2],
        &[RemedyName::None, FbarRate, FbarConsistent],
    );
    match tier {
        Tier::Quick => ladder(&levels[..1], &pairs(&[Gimp], &[RemedyName::None]), &[]),
        Tier::Pr => union([
            ladder(&levels[..3], &pairs(&[Gimp, Bspline2], &main), &[]),
            ladder(
                &levels[..3],
                &pairs(&[Gimp], &[FbarRecursive, FbarConsistent]),
                &["step_scaling=h2"],
            ),
            // Only so large a motion tells where a body force is evaluated; no particle crosses yet.
            ladder(
                &levels[..3],
                &pairs(&[Gimp, Bspline2], &[RemedyName::None]),
                &["amplitude=0.005"],
            ),
        ]),
        Tier::Nightly => {
            let pair = pairs(&[Gimp, Bspline2], &REMEDIES);
            let crossing = pairs(&BASES, &[RemedyName::None, FbarRate, FbarConsistent]);
            let mut parts = vec![
                plan(case, Tier::Pr),
                ladder(levels, &case.schemes, &[]),
                ladder(&levels[..4], &pair, &["step_scaling=h2"]),
                ladder(&levels[..4], &crossing, &["amplitude=0.02"]),
                ladder(
                    &levels[..4],
                    &crossing[3..],
                    &["amplitude=0.02", "ppc_per_direction=4"],
                ),
                ladder(&levels[..4], &pairs(&BASES, &REMEDIES), &["dimension=1"]),
                ladder(&levels[..3], &sound, &["dimension=3"]),
                more_particles(&levels[..3]),
            ];
            for cfl in ["cfl=0.15", "cfl=0.075", "cfl=0.0375"] {
                parts.push(ladder(&levels[1..2], &pair, &[cfl]));
            }
            for ppc in [
                "ppc_per_direction=1",
                "ppc_per_direction=3",
                "ppc_per_direction=4",
            ] {
                parts.push(ladder(
                    &levels[2..3],
                    &pairs(&BASES, &[RemedyName::None, FbarRate, FbarConsistent]),
                    &[ppc],
                ));
            }
            union(parts)
        }
        Tier::Long => Vec::new(),
    }
}

/// What is known of convergence between rollers, with or without a pressure gradient at the walls.
pub(super) fn claim(r: &Record) -> Claim {
    let amplitude = r.parameters.number("amplitude");
    let ppc = r.parameters.number("ppc_per_direction");
    if ppc == 1.0 {
        return Claim::Open("one particle per cell doesn't integrate what the basis can represent");
    }
    if r.parameters.is("wall", "wall-line") {
        return Claim::Stalls(
            checks::STALLED,
            "splines that are not interpolatory at a wall meet it with first order",
        );
    }
    if r.remedy() == FbarRecursive {
        return if r.parameters.is("step_scaling", "h2") {
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
    if r.transfer() != TransferName::Flip {
        return Claim::Open(checks::TRANSFER);
    }
    if r.parameters.number("dimension") == 1.0 {
        match (r.basis(), r.remedy()) {
            (Gimp, RemedyName::None) => {
                return Claim::Observed(
                    [1.4, 2.6],
                    "within a cell GIMP's weights are hats: displaced particles shift its quadrature, a floor of about A² k",
                );
            }
            (Bspline3, remedy) if checks::is_sound(remedy) => {
                return Claim::Open(
                    "in one dimension F̄ averages all of the stress, next to walls where cubics lack an order",
                );
            }
            _ => {}
        }
    }
    match r.basis() {
        Linear => Claim::Open(
            "displaced particles shift a linear basis's quadrature of mass and body force by u, a floor of about A² k",
        ),
        Bspline3 => Claim::Observed(
            [0.85, 2.3],
            "the lumped mass of cubics next to a wall has its centre off the node: between first and second order",
        ),
        _ => Claim::Second,
    }
}

/// The gates on refinement in space and time.
pub(super) fn judge_study(records: &[Record]) -> Vec<crate::verdict::Verdict> {
    let mut verdicts = checks::orders_of(records, "displacement_l2", claim);
    verdicts.extend(checks::stress_orders(records, claim));
    verdicts.extend(checks::time_orders(records));
    verdicts
}
