//! A free disc that turns, beside the exact one: what transfers take of angular momentum and energy.
//!
//! Set-up, choices and tolerances: `docs/spin.md`.

mod checks;
mod metrics;
mod parameters;
mod scene;
mod tables;
mod watch;

use super::family::{BASES, family, other_transfers, pairs};
use crate::case::{Case, Family, Tier};
use crate::parameter::Parameters;
use crate::record::Record;
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::{Level, RunSpec};
use metrics as m;
use scene::{Disc, RADIUS};
use watch::Spin;

use BasisName::{Bspline2, Gimp, Linear};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [Level; 2] = [
    Level {
        name: "r4",
        h: 0.25,
    },
    Level {
        name: "r8",
        h: 0.125,
    },
];
const TWO: &[&str] = &["turns=2"];
const HUNDRED: &[&str] = &["turns=100"];
/// Two, with the step that is stable however particles lie.
const BY_RULE: &[&str] = &["time_step=auto", "turns=2"];
/// Shares of PIC: a hundredth, and all.
const BLENDS: [&[&str]; 2] = [&["flip=0.99"], &["flip=0"]];

pub(super) fn case() -> Case {
    Case {
        name: "spin",
        title: "A disc that turns",
        description: "A free elastic disc starts in the exact state of one that turns, and turns ten or a hundred times: angular momentum, \
                      energy and radius of every basis and transfer.",
        references: vec![
            "The rotating disc in plane strain at small strain (Timoshenko & Goodier 1951, §32)."
                .to_owned(),
            "Conservation of momentum, angular momentum and energy.".to_owned(),
        ],
        limits: &[
            "The exact disc is that of small strains: its stretch is off by the strain, a hundredth of it.",
            "What FLIP takes of the angular momentum follows from no theory here: it is in the table.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(),
        levels: LEVELS.to_vec(),
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(
                m::ANGULAR_MOMENTUM_ERROR,
                "angular momentum off by (–)",
                1.0,
                6,
            ),
            headline(m::ENERGY_END, "energy at the end (%)", 100.0, 2),
            headline(m::ENERGY_GAIN, "gain (%)", 100.0, 3),
            headline(m::STRETCH_MEAN_ERROR, "stretch off by (%)", 100.0, 1),
            headline(m::PHASE_ERROR, "angle off by (%)", 100.0, 2),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["angular_momentum", "rms_radius"],
        field: None,
        sketch: sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Spin::drive(spec, parameters)?))),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: known_breakdown,
    }
}

/// Why a disc is known to break down.
fn known_breakdown(r: &Record) -> Option<&'static str> {
    const SWELLS: &str =
        "the disc swells until it leaves the grid: see musl-swells and gimp-swells";
    let hundred = r.parameters.number(parameters::TURNS) >= 100.0;
    match (r.transfer(), r.basis(), r.remedy()) {
        (TransferName::Flip, Linear, _) => Some(
            "a rim that reaches over a grid line by a little has nodes of hardly any mass: docs/critical-step.md",
        ),
        (TransferName::Musl, _, _) if hundred => Some(SWELLS),
        (TransferName::Musl, Linear, _) if r.is_default() && r.level == "r8" => Some(SWELLS),
        (TransferName::Apic, Gimp, RemedyName::FbarConsistent) if hundred => Some(SWELLS),
        _ => None,
    }
}

fn cost(spec: &RunSpec) -> f64 {
    let disc = Parameters::new(&parameters::ALL, &spec.set).map(|p| Disc::new(spec, &p));
    let steps = disc.map_or(0, |disc| disc.map_or(0, |disc| disc.steps));
    1e-6 * steps as f64 * (RADIUS / spec.level.h).powi(2)
}

fn plan() -> Vec<Family> {
    let mut all = pairs(&BASES, &[RemedyName::None]);
    all.extend(pairs(&[Gimp, Bspline2], &[RemedyName::FbarConsistent]));
    all.extend(other_transfers());
    all.extend([Linear, Gimp].map(|b| Scheme::explicit(b, RemedyName::None, TransferName::Musl)));
    let blended = pairs(&[Gimp, Bspline2], &[RemedyName::None]);
    // What breaks down at once is left to the night.
    let lives = |scheme: &&Scheme| **scheme != Scheme::flip(Linear, RemedyName::None);
    let alive: Vec<Scheme> = all.iter().filter(lives).copied().collect();
    let smooth = all.iter().filter(|scheme| scheme.basis() != Linear);
    let smooth: Vec<Scheme> = smooth.copied().collect();
    let mut plan = vec![
        family(Quick, &LEVELS[..1], &blended[..1], &[]),
        family(Pr, &LEVELS[..1], &alive, &[]),
        family(Pr, &LEVELS, &alive, TWO),
        family(Nightly, &LEVELS, &all, TWO),
        family(Nightly, &LEVELS, &all, &[]),
        family(Nightly, &LEVELS[..1], &all, HUNDRED),
        family(Nightly, &LEVELS, &smooth, BY_RULE),
    ];
    plan.extend(BLENDS.map(|set| family(Pr, &LEVELS[..1], &blended, set)));
    plan
}

fn sketch() -> Sketch {
    let rim = (0..48).map(|k| {
        let (sin, cos) = (f64::from(k) / 48.0 * std::f64::consts::TAU).sin_cos();
        [RADIUS * cos, RADIUS * sin]
    });
    Sketch {
        shapes: vec![
            Shape::Body(rim.collect()),
            Shape::Load([RADIUS, 0.0], [RADIUS, 0.5]),
            Shape::Load([-RADIUS, 0.0], [-RADIUS, -0.5]),
            Shape::note([0.0, 0.0], "0.1 c at the rim"),
            Shape::length([-RADIUS, -1.15], [RADIUS, -1.15], "2 m"),
        ],
        description: "A disc of 2 m in diameter that turns about its centre and touches nothing.",
    }
}
