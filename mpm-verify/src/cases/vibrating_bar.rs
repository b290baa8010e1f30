//! A bar that vibrates for a hundred periods: frequency, damping and what averaging does to stiffness.
//!
//! Set-up, choices and tolerances: `docs/vibrating-bar.md`.

use super::family::{BASES, REMEDIES, family, implicit, levels, pairs};
use super::manufactured::checks::{
    Claim, Claims, is_sound, mass, motion_lost, moves, orders, rests, slowed,
};
use super::manufactured::metrics::{
    AMPLITUDE_RATIO, DAMPING, ENERGY_END, ENERGY_GAIN, ENERGY_LOSS, FREQUENCY_ERROR,
    FREQUENCY_RATIO, LUMPING_LOSS,
};
use super::manufactured::{CFL, DURATION, Manufactured, all_parameters};
use super::mms_vortex_box::{NULL_SPACE, feeds_null_space};
use super::parameters::{DYNAMIC, LUMPED};
use crate::case::{Case, Tier};
use crate::check::{Check, Finding, judge, run, study};
use crate::exact::common::AMPLITUDE;
use crate::exact::vibrating_bar::{ENDS, ENTRY, VibratingBar};
use crate::exact::{self, Exact};
use crate::metric::{Metric, error};
use crate::parameter::Parameters;
use crate::record::Record;
use crate::results::{
    Column, Label, ResultTable, SCHEME, fixed, headline, is_flip, order, scientific,
};
use crate::scheme::{BasisName, RemedyName, RuleName};
use std::f64::consts::{PI, TAU};

use Tier::{Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 4] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)];
const ORDERS: &[(Metric, Claims)] = &[
    (FREQUENCY_ERROR, claim_of_frequency),
    (DAMPING, claim_of_damping),
];

pub(super) fn case() -> Case {
    let levels = levels(1.0, LEVELS);
    let names = [
        "vibrating-bar",
        "Vibrating bar",
        "A bar between rigid ends vibrates in its first mode over a hundred periods without any load: the frequency tells the stiffness that a basis and an average leave, the amplitude what a transfer takes.",
    ];
    let motion = Manufactured {
        frequency: Some(frequency),
        ..Manufactured::solid(between_walls)
    };
    // A hundred periods of 2L/c, c = √((λ + 2μ)/ρ₀), and a little more.
    let parameters = all_parameters(ENTRY.parameters, &[], "1.73", &DYNAMIC);
    let all = pairs(&BASES, &REMEDIES);
    let rules = [RuleName::Midpoint, RuleName::Newmark];
    let moved = implicit(&rules, &BASES[..3], &[RemedyName::None]);
    Case {
        references: vec![
            "Exact frequency: ω = k c of uniaxial strain (Achenbach 1973); of the amplitude kA = 3·10⁻⁴ the frequency of the neo-Hookean bar depends by 10⁻⁷.".to_owned(),
            "What averaging does: the symbol of Π, docs/modes.md.".to_owned(),
        ],
        limits: &[
            "One mode of small amplitude: no particle crosses a cell.",
            "FLIP with lumped masses damps even at η = 1, by ¼ s² (kh)² (ωΔt)² a step; the amplitude falls accordingly.",
        ],
        plan: vec![
            family(Quick, &levels[..1], &all[..1], &[]),
            family(Pr, &levels[..3], &all, &[]),
            family(Nightly, &levels, &all, &[]),
            family(Pr, &levels[..2], &moved, &["cfl=4"]),
            family(Pr, &levels[..2], &moved, &["cfl=16"]),
            family(Nightly, &levels, &moved, &["cfl=1"]),
            family(Nightly, &levels, &moved, &["cfl=4"]),
            family(Nightly, &levels[..1], &moved[..3], &["cfl=4", "lumped=0"]),
            family(Nightly, &levels[..1], &moved[..3], &["cfl=4", "lumped=1"]),
        ],
        levels,
        checks: checks(),
        headlines: vec![
            headline(FREQUENCY_RATIO, "frequency / exact (–)", 1.0, 6),
            headline(AMPLITUDE_RATIO, "amplitude, last / first period (–)", 1.0, 4),
            headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5),
            headline(ENERGY_END, "energy at the end (–)", 1.0, 4),
            headline(LUMPING_LOSS, "lumped mass took (–)", 1.0, 4),
        ],
        quantities: vec![
            error(FREQUENCY_ERROR, "relative error of the frequency"),
            error(DAMPING, "−ln of the amplitude's ratio"),
        ],
        tables: vec![results(), softenings(), over_rules()],
        ..motion.case(names, parameters)
    }
}

/// What straight lines between the rows make of a frequency of a hundred periods.
const READING: f64 = 1e-4;
/// Shares of the amplitude: half of it, and what counts as gone.
const HALF: f64 = 0.5;
const GONE: f64 = 0.05;

/// The wave of a bar whose ends are held.
fn between_walls(p: &Parameters) -> Result<Box<dyn Exact>, exact::Error> {
    match p.is(ENDS, "fixed-fixed") {
        true => (ENTRY.build)(p),
        false => Err(exact::Error(format!(
            "parameter ends: {} is that of the exact solution alone; allowed: fixed-fixed",
            p.text(ENDS)
        ))),
    }
}

/// ω of the wave (rad/s); NaN of parameters that make none.
fn frequency(p: &Parameters) -> f64 {
    VibratingBar::new(p).map_or(f64::NAN, |bar| bar.angular_frequency())
}

/// (1 − square of the frequency over that without a remedy)/(kh)², to leading order, with two particles
/// per cell: from the dispersion of docs/modes.md. None where a wall's functions spoil it.
fn softening(r: &Record) -> Option<f64> {
    let consistent = r.remedy() == RemedyName::FbarConsistent;
    match r.basis() {
        BasisName::Linear | BasisName::Gimp => Some(if consistent { 0.064 } else { 0.25 }),
        BasisName::Bspline2 => Some(if consistent { 0.0 } else { 0.25 }),
        BasisName::Bspline3 | BasisName::Q8 => None,
    }
}

/// k of the wave (1/m); NaN of parameters that make none.
fn wave_number(r: &Record) -> f64 {
    VibratingBar::new(&r.parameters).map_or(f64::NAN, |bar| bar.wave_number)
}

/// kh of the wave.
fn resolution(r: &Record) -> f64 {
    wave_number(r) * r.discretisation.h
}

/// Largest strain kA: how far the bar is from a linear one.
fn strain(r: &Record) -> f64 {
    wave_number(r) * r.parameters.number(AMPLITUDE)
}

/// Whether walls damp a wave of cubic splines with F̄, which are judged by that.
fn is_cubic(r: &Record) -> bool {
    r.basis() == BasisName::Bspline3 && is_sound(r.remedy())
}

fn results() -> ResultTable {
    let errors = LEVELS.map(|(level, n)| {
        let title = format!("error of the frequency, n = {n}");
        Column::metric(title, FREQUENCY_ERROR, scientific(2)).of(move |r| r.level == level)
    });
    let orders = Column::row("order ± (between levels)", |runs, _| {
        // What fades within the run has no frequency to converge.
        let lasting = runs.iter().copied();
        let lasting = lasting.filter(|r| r.remedy() != RemedyName::FbarRecursive);
        let found = order(lasting, FREQUENCY_ERROR.name);
        found.map_or_else(|| "–".to_owned(), |o| format!("{o} ({})", o.between()))
    });
    let amplitudes = LEVELS.map(|(level, n)| {
        let title = format!("amplitude, n = {n}");
        Column::metric(title, AMPLITUDE_RATIO, fixed(3)).of(move |r| r.level == level)
    });
    ResultTable::new(
        "vibrating-bar",
        |r| r.is_default() && is_flip(r),
        &[SCHEME],
        errors.into_iter().chain([orders]).chain(amplitudes),
    )
}

/// What implicit rules make of a hundred periods: the frequency, and what is lost and why.
fn over_rules() -> ResultTable {
    let of_level = |(level, n): (&'static str, f64)| {
        let at = move |r: &Record| r.level == level;
        let lost = |r: &Record| -r.metric(ENERGY_END);
        [
            Column::metric(format!("frequency, n = {n}"), FREQUENCY_RATIO, fixed(4)).of(at),
            Column::value("energy lost", lost, fixed(4)).of(at),
            Column::metric("lumped mass took", LUMPING_LOSS, fixed(4)).of(at),
        ]
    };
    let [cfl, lumped]: [Label; 2] = [
        ("CFL", |r| r.parameters.text(CFL)),
        ("β", |r| r.parameters.text(LUMPED)),
    ];
    let columns = LEVELS[..3].iter().copied().flat_map(of_level);
    let shows = |r: &Record| r.scheme().rule().is_some();
    ResultTable::new(
        "vibrating-bar-rules",
        shows,
        &[SCHEME, cfl, lumped],
        columns,
    )
}

/// (1 − square of the frequency over that without a remedy)/(kh)².
fn softenings() -> ResultTable {
    let of_level = LEVELS.map(|(level, n)| {
        Column::row(format!("n = {n}"), move |runs, all| {
            let found = |runs: &[&Record], remedy: Option<RemedyName>, basis: BasisName| {
                let mut at = runs
                    .iter()
                    .filter(|r| r.level == level && r.basis() == basis);
                at.find(|r| remedy.is_none_or(|own| own == r.remedy()))
                    .map(|r| (r.metric(FREQUENCY_RATIO), resolution(r)))
            };
            let averaged = runs.first().filter(|r| r.remedy() != RemedyName::None);
            let Some(basis) = averaged.map(|r| r.basis()) else {
                return String::new();
            };
            let soft = found(runs, None, basis);
            let hard = found(all, Some(RemedyName::None), basis);
            match (soft, hard) {
                (Some((soft, kh)), Some((hard, _))) => {
                    fixed(4).text((1.0 - (soft / hard).powi(2)) / (kh * kh))
                }
                _ => String::new(),
            }
        })
    });
    let predicted = Column::row("predicted", |runs, _| {
        let averaged = runs.first().filter(|r| r.remedy() != RemedyName::None);
        averaged.map_or_else(String::new, |r| {
            fixed(3).text(softening(r).unwrap_or(f64::NAN))
        })
    });
    ResultTable::new(
        "vibrating-bar-softening",
        |r| {
            let compared = [
                RemedyName::None,
                RemedyName::FbarRate,
                RemedyName::FbarConsistent,
            ];
            r.is_default() && is_flip(r) && compared.contains(&r.remedy())
        },
        &[SCHEME],
        of_level.into_iter().chain([predicted]),
    )
}

fn checks() -> Vec<Check> {
    let mut checks = vec![
        mass(),
        rests(
            "without an amplitude nothing moves: every number stays zero",
            |_| 0.0,
        ),
        motion_lost(|_| {
            Some(
                "after N periods the phase is off by 2πN times the error of the frequency, which is judged",
            )
        }),
        Check::known_limit(
            "fades",
            "fbar-recursive: nine tenths of the energy are gone after a hundred periods",
            run(|r| {
                let why =
                    "Eq. (26) diffuses J with D = ½ s² h²/Δt: the strain fades at the rate D k²";
                let found = judge(r, ENERGY_LOSS).above(0.9, why);
                let fades = r.remedy() == RemedyName::FbarRecursive && moves(&r.parameters);
                fades.then_some(found)
            }),
        ),
        Check::known_limit(
            "cubic-walls-damp",
            "cubic splines with F̄ but fbar-recursive: less than half of the amplitude is left after a hundred periods",
            run(|r| {
                let why = "the lumped mass of cubics next to a wall has its centre off the node";
                let found = judge(r, AMPLITUDE_RATIO).at_most(HALF, why);
                let damps = is_cubic(r) && !feeds_null_space(r) && moves(&r.parameters);
                damps.then_some(found)
            }),
        ),
        Check::truth(
            "frequency",
            "relative error of the frequency at most ½ (kh)², but for fbar-recursive and for waves of cubic splines with F̄ of which less than a twentieth is left",
            run(|r| {
                let judged = r.remedy() != RemedyName::FbarRecursive && moves(&r.parameters);
                judged.then(|| of_frequency(r))
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "kinetic + stored energy never above its start by more than a share of the largest kinetic energy: explicit ½ ωΔt, the offset by half a step of velocities and positions, remedies that store what their force takes; midpoint the strain kA",
            run(|r| {
                let phase = frequency(&r.parameters) * r.discretisation.dt;
                let why = "velocities live half a step before positions: ½ ωΔt";
                let found = judge(r, ENERGY_GAIN).at_most(0.5 * phase, why);
                let keeps = matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent);
                match r.scheme().rule() {
                    None => keeps.then_some(found),
                    Some(RuleName::Midpoint) => {
                        let why = "the rule gives nothing to a linear body";
                        Some(judge(r, ENERGY_GAIN).at_most(strain(r), why))
                    }
                    Some(_) => None,
                }
            }),
        ),
        Check::truth(
            "lumped-mass-takes",
            "midpoint: the energy at the end is that of the start less what the lumped mass took, within the strain kA of the largest kinetic energy",
            run(|r| {
                let why =
                    "the rule gives and takes none of a linear body: docs/implicit.md, Eq. (21)";
                let found = judge(r, ENERGY_END).within(-r.metric(LUMPING_LOSS), strain(r), why);
                (r.scheme().rule() == Some(RuleName::Midpoint)).then_some(found)
            }),
        ),
        Check::truth(
            "steps-slow",
            "implicit: the frequency over that of the shortest steps is what 2 arctan(½ ωΔt)/ωΔt makes of it, within (kh)² of what it takes and 10⁻⁴",
            study(steps_slow),
        ),
        Check::truth(
            "averaging-softens",
            "linear functions, GIMP and quadratic splines: the square of the frequency over that without a remedy is 1 − ¼ (kh)² with fbar-total and fbar-rate, 1 − 0.064 (kh)² (quadratic splines: 1) with fbar-consistent, within (kh)³/(2π): the average acts once, with the spread of the basis",
            study(averaging_softens),
        ),
    ];
    checks.extend(orders(ORDERS));
    checks
}

fn of_frequency(r: &Record) -> Finding {
    if feeds_null_space(r) {
        return Finding::not_applicable(FREQUENCY_ERROR, NULL_SPACE);
    }
    if r.parameters.number(DURATION) * frequency(&r.parameters) < 2.0 * TAU {
        let why = "the run is shorter than two periods";
        return Finding::not_applicable(FREQUENCY_ERROR, why);
    }
    if is_cubic(r) && r.metric(AMPLITUDE_RATIO) < GONE {
        let why = "less than a twentieth of the wave is left: its late zeros are those of what rings beside it";
        return Finding::not_applicable(FREQUENCY_ERROR, why);
    }
    let bound = 0.5 * resolution(r).powi(2);
    let why = "½ (kh)² about what the steps of an implicit rule make of it, 2 arctan(½ ωΔt)/ωΔt";
    let reference = slowed(r, frequency(&r.parameters));
    judge(r, FREQUENCY_RATIO).within(reference, bound, why)
}

fn claim_of_frequency(r: &Record) -> Claim {
    match (r.remedy(), r.basis()) {
        (RemedyName::FbarRecursive, _) => Claim::Open("the strain fades within periods"),
        _ if feeds_null_space(r) => Claim::Open(NULL_SPACE),
        (remedy, BasisName::Bspline3) if is_sound(remedy) => {
            Claim::Open("too little of the wave is left: see cubic-walls-damp")
        }
        (_, BasisName::Bspline3) => Claim::Observed(
            [0.85, 2.6],
            "the lumped mass of cubics next to a wall has its centre off the node: between first and second order",
        ),
        _ => Claim::Second,
    }
}

fn claim_of_damping(r: &Record) -> Claim {
    match r.basis() {
        _ if r.scheme().rule().is_some() => {
            Claim::Open("with few steps in a period no row meets the peak: see lumped-mass-takes")
        }
        BasisName::Linear | BasisName::Gimp if r.remedy() == RemedyName::None => Claim::Second,
        _ => Claim::Open(
            "judged of linear functions and GIMP without a remedy; the others are in the table",
        ),
    }
}

/// Runs that differ in their steps alone; those of cells cancel.
fn steps_slow(records: &[Record]) -> Vec<Finding> {
    let implicit = |r: &&Record| r.scheme().rule().is_some() && r.changes_only(CFL.name);
    let found = records.iter().filter(implicit).filter_map(|r| {
        let same = |other: &&Record| other.scheme() == r.scheme() && other.level == r.level;
        let family = records.iter().filter(implicit).filter(same);
        let finest = family.min_by(|a, b| a.discretisation.dt.total_cmp(&b.discretisation.dt))?;
        let of_rule = |r| slowed(r, frequency(&r.parameters));
        let expected = of_rule(r) / of_rule(finest);
        let (scheme, level, set) = (r.scheme(), &r.level, r.set.join(" "));
        (r.discretisation.dt > finest.discretisation.dt).then(|| {
            Finding::within(
                format!("frequency of {scheme} {level} {set} over that of the shortest steps"),
                r.metric(FREQUENCY_RATIO) / finest.metric(FREQUENCY_RATIO),
                expected,
                resolution(r).powi(2) * (1.0 - expected) + READING,
                "cells change the frequency by ½ (kh)² at most, and its square slows",
            )
        })
    });
    found.collect()
}

fn averaging_softens(records: &[Record]) -> Vec<Finding> {
    let judged = |r: &&Record| is_sound(r.remedy()) && !feeds_null_space(r);
    let found = records.iter().filter(judged).filter_map(|soft| {
        let hard = records.iter().find(|r| {
            r.remedy() == RemedyName::None
                && r.basis() == soft.basis()
                && r.level == soft.level
                && r.set == soft.set
        })?;
        let kh = resolution(soft);
        let found = soft.metric(FREQUENCY_RATIO) / hard.metric(FREQUENCY_RATIO);
        let (scheme, level) = (soft.scheme(), &soft.level);
        Some(Finding::within(
            format!("(frequency of {scheme} over that of none)² at {level}"),
            found * found,
            1.0 - softening(soft)? * kh * kh,
            0.5 * kh.powi(3) / PI,
            "dispersion of the average, docs/modes.md; in the cells next to the walls, 2kh/π of the bar, it may be off by all of ¼ (kh)²",
        ))
    });
    found.collect()
}
