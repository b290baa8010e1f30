//! A bar that vibrates for a hundred periods: frequency, damping and what averaging does to stiffness.
//!
//! Set-up, choices and tolerances: `docs/vibrating-bar.md`.

use super::manufactured::checks::{self, Claim};
use super::manufactured::plan::{ladder, levels, union};
use super::manufactured::{Manufactured, numerical, parameters};
use super::mms_vortex_box::{NULL_SPACE, feeds_null_space};
use crate::case::{CheckInfo, Headline, Quantity, RunSpec, Tier, error};
use crate::exact::vibrating_bar::{ENTRY, VibratingBar};
use crate::parameter::Parameters;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};
use crate::verdict::{Kind, Verdict};
use std::f64::consts::PI;
use std::sync::LazyLock;

const QUANTITIES: &[Quantity] = &[
    error("frequency_error", "relative error of the frequency"),
    error("damping", "−ln of the amplitude's ratio"),
];

pub(super) static CASE: LazyLock<Manufactured> = LazyLock::new(|| Manufactured {
    references: &[
        "Exact frequency: ω = k c of uniaxial strain (Achenbach 1973); of the amplitude kA = 3·10⁻⁴ the frequency of the neo-Hookean bar depends by 10⁻⁷.",
        "What averaging does: the symbol of Π, docs/modes.md.",
    ],
    limits: &[
        "One mode of small amplitude: no particle crosses a cell.",
        "FLIP with lumped masses damps even at η = 1, by ¼ s² (kh)² (ωΔt)² a step; the amplitude falls accordingly.",
    ],
    frequency: Some(frequency),
    levels: levels(
        1.0,
        [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)],
    ),
    plan,
    checks: CHECKS,
    judge,
    judge_study,
    headlines: HEADLINES,
    quantities: QUANTITIES,
    ..Manufactured::solid(
        [
            "vibrating-bar",
            "Vibrating bar",
            "A bar between rigid ends vibrates in its first mode over a hundred periods without any load: the frequency tells the stiffness that a basis and an average leave, the amplitude what a transfer takes.",
        ],
        ENTRY.build,
        // A hundred periods of 2L/c, c = √((λ + 2μ)/ρ₀), and a little more.
        parameters(ENTRY.parameters, &[], numerical("1.73")),
    )
});

const HEADLINES: &[Headline] = &[
    Headline {
        metric: "frequency_ratio",
        heading: "frequency / exact (–)",
        factor: 1.0,
        decimals: 6,
    },
    Headline {
        metric: "amplitude_ratio",
        heading: "amplitude, last / first period (–)",
        factor: 1.0,
        decimals: 4,
    },
    Headline {
        metric: "energy_gain",
        heading: "energy gain (–)",
        factor: 1.0,
        decimals: 5,
    },
];

const CHECKS: &[CheckInfo] = &[
    checks::MASS,
    checks::ORDER,
    checks::FALLS,
    checks::OBSERVED,
    CheckInfo {
        name: "frequency",
        kind: Kind::Truth,
        statement: "relative error of the frequency at most ½ (kh)², but for fbar-recursive and for waves of cubic splines with F̄ of which less than a twentieth is left",
    },
    CheckInfo {
        name: "cubic-walls-damp",
        kind: Kind::KnownLimit,
        statement: "cubic splines with F̄ but fbar-recursive: less than half of the amplitude is left after a hundred periods",
    },
    CheckInfo {
        name: "no-energy-gain",
        kind: Kind::Truth,
        statement: "kinetic + stored energy never above its start by more than ½ ωΔt of the largest kinetic energy, the offset by half a step of velocities and positions; remedies that store what their force takes",
    },
    CheckInfo {
        name: "averaging-softens",
        kind: Kind::Truth,
        statement: "linear functions, GIMP and quadratic splines: the square of the frequency over that without a remedy is 1 − ¼ (kh)² with fbar-total and fbar-rate, 1 − 0.064 (kh)² (quadratic splines: 1) with fbar-consistent, within (kh)³/(2π): the average acts once, with the spread of the basis",
    },
    CheckInfo {
        name: "fades",
        kind: Kind::KnownLimit,
        statement: "fbar-recursive: nine tenths of the energy are gone after a hundred periods",
    },
];

/// Shares of the amplitude: half of it, and what counts as gone.
const HALF: f64 = 0.5;
const GONE: f64 = 0.05;

/// ω of the wave (rad/s); NaN of parameters that make none.
fn frequency(p: &Parameters) -> f64 {
    VibratingBar::new(p).map_or(f64::NAN, |bar| bar.angular_frequency())
}

fn plan(case: &Manufactured, tier: Tier) -> Vec<RunSpec> {
    match tier {
        Tier::Quick => ladder(&case.levels[..1], &case.schemes[..1], &[]),
        Tier::Pr => ladder(&case.levels[..3], &case.schemes, &[]),
        Tier::Nightly => union([
            plan(case, Tier::Pr),
            ladder(&case.levels, &case.schemes, &[]),
        ]),
        Tier::Long => Vec::new(),
    }
}

/// (1 − square of the frequency over that without a remedy)/(kh)², to leading order, with two particles
/// per cell: from the dispersion of docs/modes.md. None where a wall's functions spoil it.
fn softening(r: &Record) -> Option<f64> {
    let consistent = r.remedy() == RemedyName::FbarConsistent;
    match r.basis() {
        BasisName::Linear | BasisName::Gimp => Some(if consistent { 0.064 } else { 0.25 }),
        BasisName::Bspline2 => Some(if consistent { 0.0 } else { 0.25 }),
        BasisName::Bspline3 => None,
    }
}

/// kh of the first mode.
fn resolution(r: &Record) -> f64 {
    PI / r.parameters.number("length") * r.discretisation.h
}

fn judge(r: &Record) -> Vec<Verdict> {
    let kh = resolution(r);
    let omega = frequency(&r.parameters);
    let phase = omega * r.discretisation.dt;
    if r.remedy() == RemedyName::FbarRecursive {
        return vec![
            checks::mass(r),
            Verdict::above(
                "fades",
                Kind::KnownLimit,
                "energy_loss",
                r.metric("energy_loss"),
                0.9,
                "Eq. (26) diffuses J with D = ½ s² h²/Δt: the strain fades at the rate D k²",
            ),
        ];
    }
    let mut verdicts = vec![checks::mass(r)];
    let cubic = r.basis() == BasisName::Bspline3 && checks::is_sound(r.remedy());
    if cubic && !feeds_null_space(r) {
        verdicts.push(Verdict::at_most(
            "cubic-walls-damp",
            Kind::KnownLimit,
            "amplitude_ratio",
            r.metric("amplitude_ratio"),
            HALF,
            "the lumped mass of cubics next to a wall has its centre off the node",
        ));
    }
    verdicts.push(if feeds_null_space(r) {
        Verdict::not_applicable("frequency", "frequency_error", NULL_SPACE)
    } else if cubic && r.metric("amplitude_ratio") < GONE {
        let why = "less than a twentieth of the wave is left: its late zeros are those of what rings beside it";
        Verdict::not_applicable("frequency", "frequency_error", why)
    } else {
        Verdict::at_most(
            "frequency",
            Kind::Truth,
            "frequency_error",
            r.metric("frequency_error"),
            0.5 * kh * kh,
            "½ (kh)²",
        )
    });
    if matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent) {
        verdicts.push(Verdict::at_most(
            "no-energy-gain",
            Kind::Truth,
            "energy_gain",
            r.metric("energy_gain"),
            0.5 * phase,
            "velocities live half a step before positions: ½ ωΔt",
        ));
    }
    verdicts
}

fn judge_study(records: &[Record]) -> Vec<Verdict> {
    let claim = |r: &Record| match (r.remedy(), r.basis()) {
        (RemedyName::FbarRecursive, _) => Claim::Open("the strain fades within periods"),
        _ if feeds_null_space(r) => Claim::Open(NULL_SPACE),
        (remedy, BasisName::Bspline3) if checks::is_sound(remedy) => {
            Claim::Open("too little of the wave is left: see cubic-walls-damp")
        }
        (_, BasisName::Bspline3) => Claim::Observed(
            [0.85, 2.6],
            "the lumped mass of cubics next to a wall has its centre off the node: between first and second order",
        ),
        _ => Claim::Second,
    };
    let mut verdicts = checks::orders_of(records, "frequency_error", claim);
    verdicts.extend(checks::orders_of(records, "damping", |r| match r.basis() {
        BasisName::Linear | BasisName::Gimp if r.remedy() == RemedyName::None => Claim::Second,
        _ => Claim::Open(
            "judged of linear functions and GIMP without a remedy; the others are in the table",
        ),
    }));
    let judged = |r: &&Record| checks::is_sound(r.remedy()) && !feeds_null_space(r);
    for soft in records.iter().filter(judged) {
        let hard = records.iter().find(|r| {
            r.remedy() == RemedyName::None
                && r.basis() == soft.basis()
                && r.level == soft.level
                && r.set == soft.set
        });
        let (Some(hard), Some(softening)) = (hard, softening(soft)) else {
            continue;
        };
        let kh = resolution(soft);
        let found = soft.metric("frequency_ratio") / hard.metric("frequency_ratio");
        verdicts.push(Verdict::close(
            "averaging-softens",
            &format!("(frequency of {} over that of none)² at {}", soft.scheme(), soft.level),
            found * found,
            1.0 - softening * kh * kh,
            0.5 * kh.powi(3) / PI,
            "dispersion of the average, docs/modes.md; in the cells next to the walls, 2kh/π of the bar, it may be off by all of ¼ (kh)²",
        ));
    }
    verdicts
}
