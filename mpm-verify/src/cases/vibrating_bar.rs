//! A bar that vibrates for a hundred periods: frequency, damping and what averaging does to stiffness.

use super::manufactured::foreign::{TIME, gaps_of_wave, of_wave};
use super::manufactured::*;
use crate::cases::prelude::*;
use crate::exact;
use crate::exact::vibrating_bar::{ENDS, ENTRY, VibratingBar};
use crate::foreign::Foreign;

const LEVELS: [(&str, &str); 4] = [("n8", "8"), ("n16", "16"), ("n32", "32"), ("n64", "64")];
const ORDERS: &[(Metric, Claims)] = &[(FREQUENCY_ERROR, claim_of_frequency), (DAMPING, claim_of_damping)];
/// Error of a frequency of a hundred periods by straight lines between the rows.
const READING: f64 = 1e-4;
/// Shares of the amplitude: half of it, and what counts as gone.
const HALF: f64 = 0.5;
const GONE: f64 = 0.05;

/// The wave of a bar whose ends are held.
struct Bar;

impl Known for Bar {
    const SOLUTION: Solution = between_walls;
    const FREQUENCY: Option<fn(&Parameters) -> f64> = Some(frequency);
    /// A hundred periods of 2L/c, c = √((λ + 2μ)/ρ₀), and a little more.
    const PARAMETERS: Composed = (&[ENTRY.parameters], &[], "1.73", &DYNAMIC);
}

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

/// k of the wave (1/m); NaN of parameters that make none.
fn wave_number(p: &Parameters) -> f64 {
    VibratingBar::new(p).map_or(f64::NAN, |bar| bar.wave_number)
}

/// kh of the wave.
fn resolution(r: &Setup<()>) -> f64 {
    wave_number(&r.values) * r.h
}

/// Largest strain kA: how far the bar is from a linear one.
fn strain(r: &Setup<()>) -> f64 {
    wave_number(&r.values) * r.number(AMPLITUDE)
}

/// (1 − square of the frequency over that without a remedy)/(kh)², to leading order, with two particles
/// per cell: from the dispersion of docs/remedy.md. None where a wall's functions spoil it.
fn softening(basis: BasisName, remedy: RemedyName) -> Option<f64> {
    let consistent = remedy == FbarConsistent;
    match basis {
        Linear | Gimp => Some(if consistent { 0.064 } else { 0.25 }),
        Bspline2 => Some(if consistent { 0.0 } else { 0.25 }),
        Bspline3 | BasisName::Q8 => None,
    }
}

/// Largest rise of the energy of leapfrog from a start at full speed, over the energy of the mode. With velocities half a step
/// behind, sin δ = ½ ωΔt = `half`, the energy is 1 − sin(2θ − δ) sin δ at the phase θ, at the start 1 − sin² δ.
fn offset(half: f64) -> f64 {
    half * (1.0 + half)
}

/// Whether walls damp a wave of cubic splines with F̄, which are judged by that.
fn is_cubic(r: &Setup<()>) -> bool {
    r.basis() == Bspline3 && is_sound(r.remedy())
}

pub(super) fn case() -> Case {
    let all = pairs(&BASES, &REMEDIES);
    let moved = implicit(&[RuleName::Midpoint, RuleName::Newmark], &BASES[..3], &[RemedyName::None]);
    let plan = Plan::of(metre_levels()[..4].to_vec())
        .runs(Quick, "n8", &all[..1], "")
        .runs(Pr, "n8", &all, "")
        .runs(Pr, "n16", &pairs(&[Gimp, Bspline2], &[RemedyName::None, FbarConsistent]), "")
        .runs(Nightly, FOUR, &all, "")
        .each(Pr, "n8", &moved, ["cfl=4", "cfl=16"])
        .runs(Nightly, "n16", &moved, "cfl=16")
        .each(Nightly, FOUR, &moved, ["cfl=1", "cfl=4"])
        .each(Nightly, "n8", &moved[..3], ["cfl=4 lumped=0", "cfl=4 lumped=1"]);
    known_case::<1, Bar>([
        "vibrating-bar",
        "Vibrating bar",
        "A bar between rigid ends vibrates in its first mode over a hundred periods without any load: the frequency tells the stiffness that a basis and an average leave, the amplitude what a transfer takes.",
    ])
    .planned(plan)
    .reference("Exact frequency: ω = k c of uniaxial strain (Achenbach 1973); of the amplitude kA = 3·10⁻⁴ the frequency of the neo-Hookean bar depends by 10⁻⁷.")
    .reference("What averaging does: the symbol of Π, docs/remedy.md.")
    .limit("One mode of small amplitude: no particle crosses a cell.")
    .limit("FLIP with lumped masses damps even at η = 1, by ¼ s² (kh)² (ωΔt)² a step; the amplitude falls accordingly.")
    .anew()
    .wanted("frequency", "mean frequency of a hundred periods", "frequency")
    .missed_by("motion-lost fades cubic-walls-damp")
    .wanted("energy", "energy after a hundred periods over that of the start", "keeps-energy")
    .missed_by("damps fades cubic-walls-damp null-space-grows")
    .checks(checks())
    .headline(FREQUENCY_RATIO, "frequency / exact (–)", 1.0, 6)
    .headline(AMPLITUDE_RATIO, "amplitude, last / first period (–)", 1.0, 4)
    .headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5)
    .headline(ENERGY_END, "energy at the end (–)", 1.0, 4)
    .headline(LUMPING_LOSS, "lumped mass took (–)", 1.0, 4)
    .quantity(error(FREQUENCY_ERROR, "relative error of the frequency"))
    .quantity(error(DAMPING, "−ln of the amplitude's ratio"))
    .tables(vec![results(), softenings(), over_rules()])
}

pub(super) fn foreign() -> Foreign {
    Foreign { abscissa: Some(TIME), gaps: gaps_of_wave::<Bar>, ..Foreign::of::<1, Motion<1, Bar>>(of_wave::<Bar>()) }
}

fn results() -> ResultTable {
    let titled = |what: &'static str| LEVELS.map(|(level, n)| (level, format!("{what}, n = {n}")));
    ResultTable::of("vibrating-bar", |r| r.is_default() && is_flip(r))
        .by(&[SCHEME])
        .columns(Column::levels(titled("error of the frequency"), FREQUENCY_ERROR, scientific(2)))
        // What fades within the run has no frequency to converge.
        .column(Column::order_of(FREQUENCY_ERROR, |r| r.remedy() != FbarRecursive))
        .columns(Column::levels(titled("amplitude"), AMPLITUDE_RATIO, fixed(3)))
}

/// Frequency over a hundred periods with implicit rules, and the energy that is lost.
fn over_rules() -> ResultTable {
    let of_level = |(level, n): (&'static str, &str)| {
        let at = move |r: &Record| r.level == level;
        let lost = |r: &Record| -r.metric(ENERGY_END);
        [
            Column::metric(format!("frequency, n = {n}"), FREQUENCY_RATIO, fixed(4)).of(at),
            Column::value("energy lost", lost, fixed(4)).of(at),
            Column::metric("lumped mass took", LUMPING_LOSS, fixed(4)).of(at),
        ]
    };
    let labels: [Label; 3] = [SCHEME, ("CFL", |r| r.parameters.text(CFL)), ("β", |r| r.parameters.text(LUMPED))];
    let columns = LEVELS[..3].iter().copied().flat_map(of_level);
    ResultTable::new("vibrating-bar-rules", |r| r.scheme().rule().is_some(), &labels, columns)
}

/// (1 − square of the frequency over that without a remedy)/(kh)².
fn softenings() -> ResultTable {
    let averaged = |runs: &[&Record]| {
        runs.first().copied().filter(|r| r.remedy() != RemedyName::None).map(|r| (r.basis(), r.remedy()))
    };
    let of_level = LEVELS.map(|(level, n)| {
        Column::row(format!("n = {n}"), move |runs, all| {
            let found = || {
                let (basis, _) = averaged(runs)?;
                let here = |r: &&&Record| r.level == level && r.basis() == basis;
                let soft = runs.iter().find(here)?;
                let none = |r: &&&Record| here(r) && r.remedy() == RemedyName::None;
                let hard = all.iter().find(none)?.metric(FREQUENCY_RATIO);
                let kh = Setup::number_of(soft, resolution);
                Some((1.0 - (soft.metric(FREQUENCY_RATIO) / hard).powi(2)) / (kh * kh))
            };
            found().map_or_else(String::new, |found| fixed(4).text(found))
        })
    });
    let predicted = Column::row("predicted", move |runs, _| {
        averaged(runs)
            .map_or_else(String::new, |(basis, remedy)| fixed(3).text(softening(basis, remedy).unwrap_or(f64::NAN)))
    });
    ResultTable::of("vibrating-bar-softening", |r| {
        let compared = [RemedyName::None, FbarRate, FbarConsistent];
        r.is_default() && is_flip(r) && compared.contains(&r.remedy())
    })
    .by(&[SCHEME])
    .columns(of_level)
    .column(predicted)
}

fn checks() -> Vec<Check> {
    let mut checks = vec![
        mass(),
        rests("without an amplitude nothing moves: every number stays zero", |_| 0.0),
        motion_lost(|_| Some("after N periods the phase is off by 2πN times the error of the frequency, which is judged")),
        Gate::known_limit("fades", "fbar-recursive: nine tenths or more of the energy lost after a hundred periods")
            .when(|r| r.remedy() == FbarRecursive && moves(&r.values))
            .above(ENERGY_LOSS, |_| 0.9)
            .because("Eq. (26) diffuses J with D = ½ s² h²/Δt: the strain fades at the rate D k²"),
        Gate::known_limit("cubic-walls-damp", "cubic splines with F̄ except fbar-recursive: less than half of the amplitude left after a hundred periods")
            .when(|r| is_cubic(r) && !feeds_null_space(r) && moves(&r.values))
            .at_most(AMPLITUDE_RATIO, |_| HALF)
            .because("the lumped mass of cubics next to a wall has its centre off the node"),
        Gate::truth("frequency", "relative error of the frequency at most ½ (kh)², except with fbar-recursive and waves of cubic splines with F̄ damped below a twentieth")
            .when(|r| r.remedy() != FbarRecursive && moves(&r.values))
            .own(|r| vec![of_frequency(r)]),
        Gate::truth("no-energy-gain", "energy above its start over the peak kinetic one: explicit with a storing remedy at most ½ ωΔt, midpoint at most the strain kA")
            .each([
                Demand::at_most(ENERGY_GAIN, |r: &Run<()>| offset(0.5 * frequency(&r.values) * r.dt()))
                    .when(|r| r.rule().is_none() && matches!(r.remedy(), RemedyName::None | FbarConsistent))
                    .because_of(|_| "velocities live half a step before positions: ½ ωΔt".to_owned()),
                Demand::at_most(ENERGY_GAIN, |r: &Run<()>| strain(r))
                    .when(|r| r.rule() == Some(RuleName::Midpoint)),
            ])
            .because("the rule gives nothing to a linear body"),
        Gate::truth("keeps-energy", "energy at the end that of the start within (kh)², twice the ½ (kh)² of an amplitude, and the half-step offset of explicit velocities there")
            .when(|r| moves(&r.values))
            .within(ENERGY_END, |_| 0.0, kept_within)
            .of_scale(|_| 1.0)
            .because("the exact bar is undamped; the tolerance is that of the frequency, for its amplitude"),
        Gate::known_limit("damps", "energy at the end short of that of the start by more than keeps-energy allows, where it is")
            .when(|r| moves(&r.values) && r.metric(ENERGY_END) < -kept_within(r))
            .at_most(ENERGY_END, |r| -kept_within(r))
            .because("a lumped mass takes of the motion in every step, and Newmark's rule with δ above ½: docs/vibrating-bar.md"),
        Gate::known_limit("null-space-grows", "fbar-total and fbar-rate on fine cells: energy at the end above that of the start by more than keeps-energy allows, where it is")
            .when(|r| feeds_null_space(r) && r.metric(ENERGY_END) > kept_within(r))
            .above(ENERGY_END, kept_within)
            .because(NULL_SPACE),
        Gate::truth("lumped-mass-takes", "midpoint: final energy equal to the initial one less the lumped-mass loss, within the strain kA of the largest kinetic energy")
            .when(|r| r.rule() == Some(RuleName::Midpoint))
            .within(ENERGY_END, |r| -r.metric(LUMPING_LOSS), |r| strain(r))
            .because("the rule gives and takes none of a linear body: docs/implicit.md, Eq. (21)"),
        Gate::truth("newmark-keeps", "newmark, linear functions and GIMP, no remedy: final energy that of the discrete mode within the strain kA, with GIMP also A/l")
            .when(|r| r.rule() == Some(RuleName::Newmark) && r.remedy() == RemedyName::None)
            .when(|r| matches!(r.basis(), Linear | Gimp) && moves(&r.values) && resolution(r) < PI)
            .within(ENERGY_END, |r| newmark_leaves(r) - 1.0, |r| {
                let half_size = 0.5 * r.h / r.number(PPC_PER_DIRECTION);
                let domains = if r.basis() == Gimp { r.number(AMPLITUDE) / half_size } else { 0.0 };
                strain(r) + domains
            })
            .because("the sine is a mode of the lattice of hats between walls: docs/vibrating-bar.md"),
        Gate::truth("steps-slow", "implicit: frequency over that of the shortest steps equal to 2 arctan(½ ωΔt)/ωΔt, within (kh)² of the deviation and 10⁻⁴")
            .study(steps_slow),
        Gate::truth("averaging-softens", "squared frequency over that without remedy: 1 − ¼ (kh)² (fbar-total, fbar-rate), 1 − 0.064 (kh)² (fbar-consistent; bspline2 1), within (kh)³/2π")
            .when(|r| is_sound(r.remedy()) && !feeds_null_space(r) && softening(r.basis(), r.remedy()).is_some())
            .pairs(
                |soft, hard| same_but_scheme(soft, hard) && hard.remedy() == RemedyName::None && hard.basis() == soft.basis(),
                |soft, _| format!("(frequency of {} over that of none)² at {}", soft.scheme, soft.level),
                |soft, hard| {
                    let found = soft.metric(FREQUENCY_RATIO) / hard.metric(FREQUENCY_RATIO);
                    found * found
                },
            )
            .within(
                |r| {
                    let (kh, softening) = (resolution(r), softening(r.basis(), r.remedy()));
                    1.0 - softening.unwrap_or(f64::NAN) * kh * kh
                },
                |r| 0.5 * resolution(r).powi(3) / PI,
            )
            .because("dispersion of the average, docs/remedy.md; in the cells next to the walls, 2kh/π of the bar, it may be off by all of ¼ (kh)²"),
    ];
    checks.extend(orders(ORDERS));
    checks
}

/// Energy at the end over that of the start, of Newmark's rule as it is printed and the mode of hats between rigid ends.
/// Particles carry sin kX v₀ + S(sin kx) d as velocity and S(sin kx) b as acceleration, with S from nodes to particles.
fn newmark_leaves(r: &Run<()>) -> f64 {
    let (theta, omega, dt) = (resolution(r), frequency(&r.values), r.dt());
    let [per_cell, alpha, delta] = [PPC_PER_DIRECTION, ALPHA, DELTA].map(|p| r.number(p));
    let places = (0..per_cell as u32).map(|k| (f64::from(k) + 0.5) / per_cell);
    let mean = |of: &dyn Fn(f64) -> f64| places.clone().map(of).sum::<f64>() / per_cell;
    // Shares that nodes see of sin kX, and of fields that come from nodes.
    let seen = mean(&|s| 2.0 * (1.0 - s) * (theta * s).cos());
    let kept = mean(&|s| 1.0 - 2.0 * s * (1.0 - s) * (1.0 - theta.cos()));
    let stiffness = (omega * 2.0 * (0.5 * theta).sin() / theta).powi(2);
    let inertia = 1.0 / (alpha * dt * dt);
    let (mut u, mut d, mut b) = (0.0, 0.0, 0.0);
    for _ in 0..r.record.work.steps {
        let had = (seen + kept * d) / (alpha * dt) + (0.5 / alpha - 1.0) * kept * b;
        let step = (had - stiffness * u) / (inertia + stiffness);
        let after = inertia * step - had;
        d += dt * ((1.0 - delta) * b + delta * after);
        (u, b) = (u + step, after);
    }
    1.0 + 2.0 * seen * d + kept * d * d + stiffness * u * u
}

/// Largest distance of the final energy from the first over it: (kh)², and what velocities half a step behind leave at that
/// phase ([`offset`]). Another code need not have a time step.
fn kept_within(r: &Run<()>) -> f64 {
    let [half, phase] = [0.5 * r.dt(), r.number(DURATION)].map(|t| frequency(&r.values) * t);
    let offset = if r.is_explicit() { half * ((2.0 * phase - half).sin() + half).abs() } else { 0.0 };
    resolution(r).powi(2) + offset.max(0.0)
}

fn of_frequency(r: &Run<()>) -> Finding {
    let why = if feeds_null_space(r) {
        NULL_SPACE
    } else if r.number(DURATION) * frequency(&r.values) < 2.0 * TAU {
        "the run is shorter than two periods"
    } else if is_cubic(r) && r.metric(AMPLITUDE_RATIO) < GONE {
        "less than a twentieth of the wave is left: its late zeros are those of what rings beside it"
    } else {
        let (found, bound) = (r.metric(FREQUENCY_RATIO), 0.5 * resolution(r).powi(2));
        let reference = slowed(r, frequency(&r.values));
        let why = "½ (kh)² about what the steps of an implicit rule make of it, 2 arctan(½ ωΔt)/ωΔt";
        if resolution(r) >= PI {
            return Finding::not_applicable(FREQUENCY_ERROR, "cells carry no wave that is shorter than two of them");
        }
        return Finding::within(FREQUENCY_RATIO, found, reference, bound, why);
    };
    Finding::not_applicable(FREQUENCY_ERROR, why)
}

fn claim_of_frequency(r: &Setup<()>) -> Claim {
    match (r.remedy(), r.basis()) {
        (FbarRecursive, _) => Claim::Open("the strain fades within periods"),
        _ if feeds_null_space(r) => Claim::Open(NULL_SPACE),
        (remedy, Bspline3) if is_sound(remedy) => Claim::Open("too little of the wave is left: see cubic-walls-damp"),
        (_, Bspline3) => Claim::Observed([0.85, 2.6], OFF_NODE),
        _ => Claim::Second,
    }
}

fn claim_of_damping(r: &Setup<()>) -> Claim {
    match r.basis() {
        _ if r.is_implicit() => Claim::Open("with few steps in a period no row meets the peak: see lumped-mass-takes"),
        Linear | Gimp if r.remedy() == RemedyName::None => Claim::Second,
        _ => Claim::Open("judged of linear functions and GIMP without a remedy; the others are in the table"),
    }
}

/// Runs that differ in their steps alone; those of cells cancel.
fn steps_slow(records: &[Record]) -> Vec<Finding> {
    let runs = Run::<()>::all(records);
    let runs: Vec<Run<()>> = runs.filter(|r| r.is_implicit() && r.record.changes_only(CFL.name)).collect();
    let found = runs.iter().filter_map(|r| {
        let same = |other: &&Run<()>| other.scheme == r.scheme && other.level == r.level;
        let finest = runs.iter().filter(same).min_by(|a, b| a.dt().total_cmp(&b.dt()))?;
        let of_rule = |r: &Run<()>| slowed(r, frequency(&r.values));
        let expected = of_rule(r) / of_rule(finest);
        let (scheme, level, set) = (r.scheme, &r.level, r.set.join(" "));
        let about = format!("frequency of {scheme} {level} {set} over that of the shortest steps");
        let ratio = r.metric(FREQUENCY_RATIO) / finest.metric(FREQUENCY_RATIO);
        let tolerance = resolution(r).powi(2) * (1.0 - expected) + READING;
        let why = "cells change the frequency by ½ (kh)² at most, and its square slows";
        (r.dt() > finest.dt()).then(|| Finding::within(about, ratio, expected, tolerance, why))
    });
    found.collect()
}
