//! Solid and water at finite strain whose motion and pressure are known: the solver of both against an exact solution.
//!
//! Set-up, choices and tolerances: `docs/mms-poro.md`.

mod checks;
mod metrics;
mod parameters;
mod scene;
mod tables;
mod watch;

use super::family::{family, levels};
use crate::case::{Case, Family, Tier};
use crate::metric::error;
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics::{DISPLACEMENT_L2, ENTRIES, NEWTON_ITERATIONS, PRESSURE_L2, STRESS_L2};
use parameters::DIMENSION;
use watch::Motion;

use BasisName::{Gimp, Linear};
use SpaceName::{Equal, Ppp, TwoGrid};
use Tier::{Nightly, Pr, Quick};

/// Particles cross cells, and hardly any water flows.
const CROSSING: &[&str] = &["amplitude=0.04"];
const TIGHT: &[&str] = &["conductivity=1e-6"];
/// Steps that err in time.
const TIMES: [&[&str]; 3] = [
    &["source=rates"],
    &["source=rates", "steps=8"],
    &["source=rates", "steps=16"],
];

const LEVELS: [(&str, f64); 4] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0), ("n64", 64.0)];

pub(super) fn case() -> Case {
    let levels = levels(1.0, LEVELS);
    Case {
        name: "mms-poro",
        title: "Manufactured motion of solid and water",
        description: "A body full of water between rollers, drained at its top, is deformed by a body force and a source of water \
                      that make motion and pressure known, at finite strain and with gravity. Orders in space and time of the \
                      displacement and the pressure, for each space of the pressure, with and without crossing of cells.",
        references: vec![
            "Exact solution: derived on dual numbers; its balances are tested by eighth-order differences of a stress and a flux \
             that are written otherwise.".to_owned(),
        ],
        limits: &[
            "The body fills its grid: no cell is cut, and no surface moves.",
            "Linear functions stall once particles have moved, as elsewhere.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(DISPLACEMENT_L2, "u rms error (m)", 1.0, 7),
            headline(PRESSURE_L2, "error of p (%)", 100.0, 3),
            headline(STRESS_L2, "σ′ rms error (Pa)", 1.0, 1),
            headline(NEWTON_ITERATIONS, "iterations", 1.0, 0),
            headline(ENTRIES, "entries of a matrix", 1.0, 0),
        ],
        quantities: vec![
            error(DISPLACEMENT_L2, "rms error of u (m)").of_order(2.0),
            error(PRESSURE_L2, "rms error of p").of_order(2.0),
            error(STRESS_L2, "rms error of σ′ (Pa)").of_order(1.0),
        ],
        sweeps: Vec::new(),
        watched: &["displacement_l2", "pressure_l2"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-4 * spec.level.h.powi(-3)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, p| {
            Ok(match p.number(DIMENSION) as usize {
                1 => Box::new(Motion::<1>::drive(spec, p)?),
                _ => Box::new(Motion::<2>::drive(spec, p)?),
            })
        }),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn schemes(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |basis: &BasisName| [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(*basis, space));
    bases.iter().flat_map(of).collect()
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let (gimp, linear) = (schemes(&[Gimp]), schemes(&[Linear]));
    let (two, three, fine) = (&levels[..2], &levels[..3], &levels[1..]);
    let (n16, n32) = (&levels[1..2], &levels[2..3]);
    let mut all = vec![
        family(Quick, &levels[..1], &gimp[..1], &[]),
        family(Pr, three, &gimp, &[]),
        family(Pr, three, &linear[..1], &[]),
        family(Pr, three, &linear, &["steps=1"]),
        family(Pr, three, &gimp[..1], CROSSING),
        family(Pr, n16, &gimp[..1], &["predictor=zero"]),
        family(Nightly, &levels[3..], &linear, &["steps=1"]),
        family(Nightly, fine, &gimp, CROSSING),
        family(Nightly, three, &linear, &[]),
        family(Nightly, three, &linear, CROSSING),
        family(Nightly, three, &gimp, TIGHT),
        family(Nightly, three, &gimp, &["conductivity_law=constant"]),
        family(Nightly, two, &gimp, &["dimension=1"]),
        family(Nightly, n16, &gimp, &["predictor=zero"]),
        family(Nightly, n16, &gimp, &["amplitude=0.04", "predictor=zero"]),
    ];
    all.extend(TIMES.map(|set| family(Pr, n16, &gimp[1..2], set)));
    all.extend(TIMES.map(|set| family(Nightly, n32, &gimp, set)));
    all
}

fn sketch() -> Sketch {
    Sketch {
        shapes: vec![
            Shape::Body(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
            Shape::Held([1.0, 0.0], [0.0, 0.0]),
            Shape::Held([0.0, 0.0], [0.0, 1.0]),
            Shape::Held([0.0, 1.0], [1.0, 1.0]),
            Shape::Held([1.0, 1.0], [1.0, 0.0]),
            Shape::length([0.0, -0.15], [1.0, -0.15], "1 m"),
            Shape::note([0.5, 1.12], "p = 0"),
        ],
        description: "A body full of water that slides along its sides but doesn't leave them, drained at its top.",
    }
}
