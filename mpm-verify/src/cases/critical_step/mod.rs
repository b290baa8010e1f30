//! The largest stable step of every explicit scheme, by bisection, beside linear analysis.
//!
//! Set-up, theory and tolerances: `docs/critical-step.md`.

mod checks;
mod metrics;
mod parameters;
mod tables;
mod theory;
mod watch;

use super::family::{BASES, REMEDIES, family, other_transfers, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics::{CRITICAL_CFL, FED_CFL, OFFERED_CFL, PREDICTED_CFL};
use mpm_core::material::Viscous;
use parameters::LINEAR_VISCOSITY;
use watch::{DENSITY, PERIOD, Trials};

use BasisName::{Bspline2, Gimp, Linear};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [Level; 1] = [Level {
    name: "n6",
    h: 1.0 / PERIOD as f64,
}];
/// One dimension: as it is, jittered, cut, and compressed and stretched.
const ALONG: &[&str] = &["dimension=1"];
const JITTERED: &[&str] = &["dimension=1", "layout=jittered"];
const CUT: &[&str] = &["dimension=1", "layout=cut"];
const SMALLER_CUT: &[&str] = &["cut=0.001", "dimension=1", "layout=cut"];
const COMPRESSED: &[&str] = &["dimension=1", "stretch=0.7"];
const STRETCHED: &[&str] = &["dimension=1", "stretch=1.4"];
const NUMBERS: [&[&str]; 3] = [
    &["dimension=1", "ppc_per_direction=1"],
    &["dimension=1", "ppc_per_direction=3"],
    &["dimension=1", "ppc_per_direction=4"],
];
const SPACE: &[&str] = &["dimension=3"];
/// With an artificial viscosity.
const VISCOUS: [&[&str]; 2] = [
    &["dimension=1", "linear_viscosity=0.5"],
    &["dimension=1", "linear_viscosity=1"],
];

pub(super) fn case() -> Case {
    Case {
        name: "critical-step",
        title: "Largest stable step",
        description: "A lattice of particles at rest with a little noise: ten halvings find the largest CFL number at which the noise \
                      does not grow, for every explicit scheme, in one to three dimensions, aligned, off the lattice, cut by the \
                      grid, compressed and stretched, and with an artificial viscosity.",
        references: vec![
            "Linear analysis, docs/modes.md: Jury's conditions of a wave's two by two matrix, here in every dimension and for every transfer.".to_owned(),
            "A bound for any arrangement of particles, docs/critical-step.md.".to_owned(),
        ],
        limits: &[
            "Particles at rest, which cross no cell; a wave that grows by less than a hundredfold within the steps counts as stable.",
            "CFL numbers of one and more are refused by the program and not tried.",
        ],
        parameters: parameters::ALL.to_vec(),
        levels: LEVELS.to_vec(),
        plan: plan(),
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(CRITICAL_CFL, "critical CFL (–)", 1.0, 3),
            headline(PREDICTED_CFL, "predicted (–)", 1.0, 3),
            headline(OFFERED_CFL, "offered (–)", 1.0, 3),
            headline(FED_CFL, "fed by a mean stress (–)", 1.0, 3),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["growth", "cfl"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|_| 0.1),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, p| {
            Ok(match p.number(parameters::DIMENSION) as u32 {
                1 if p.number(LINEAR_VISCOSITY) > 0.0 => {
                    let viscous = |law| {
                        let coefficients = [p.number(LINEAR_VISCOSITY), 0.0];
                        Viscous::new(law, DENSITY, spec.level.h, coefficients)
                    };
                    Box::new(Trials::<1, _>::drive(spec, p, viscous)?)
                }
                1 => Box::new(Trials::<1, _>::drive(spec, p, Ok)?),
                2 => Box::new(Trials::<2, _>::drive(spec, p, Ok)?),
                _ => Box::new(Trials::<3, _>::drive(spec, p, Ok)?),
            })
        }),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn plan() -> Vec<Family> {
    let flip = pairs(&BASES, &REMEDIES);
    let mut all = flip.clone();
    all.extend(other_transfers());
    all.extend([Linear, Gimp].map(|b| Scheme::explicit(b, RemedyName::None, TransferName::Musl)));
    let plain = pairs(&BASES, &[RemedyName::None]);
    let space = pairs(&[Gimp, Bspline2], &REMEDIES);
    let mut plan = vec![
        family(Quick, &LEVELS, &flip[..1], ALONG),
        family(Quick, &LEVELS, &plain[..1], CUT),
        family(Pr, &LEVELS, &all, &[]),
        family(Pr, &LEVELS, &flip, ALONG),
        family(Pr, &LEVELS, &flip, JITTERED),
        family(Pr, &LEVELS, &plain, CUT),
        family(Pr, &LEVELS, &plain, SMALLER_CUT),
        family(Pr, &LEVELS, &flip, COMPRESSED),
        family(Pr, &LEVELS, &flip, STRETCHED),
        family(Nightly, &LEVELS, &all, &["layout=jittered"]),
        family(Nightly, &LEVELS, &plain, &["layout=cut"]),
        family(Nightly, &LEVELS, &space, SPACE),
    ];
    plan.extend(VISCOUS.map(|set| family(Pr, &LEVELS, &plain, set)));
    plan.extend(NUMBERS.map(|set| family(Nightly, &LEVELS, &flip, set)));
    plan
}

fn sketch() -> Sketch {
    let side = 1.0;
    let dots = (0..4).map(|k| Shape::Probe {
        at: [0.125 + 0.25 * f64::from(k), 0.5],
        label: String::new(),
    });
    let mut shapes = vec![Shape::Body(vec![
        [0.0, 0.0],
        [side, 0.0],
        [side, side],
        [0.0, side],
    ])];
    shapes.extend(dots);
    shapes.push(Shape::note([0.5, 0.8], "noise"));
    shapes.push(Shape::length([0.0, -0.1], [side, -0.1], "6 h, periodic"));
    Sketch {
        shapes,
        description: "A periodic lattice of particles, six cells in a period, at rest but for noise.",
    }
}
