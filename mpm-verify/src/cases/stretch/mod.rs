//! A body that is stretched and crushed alike everywhere: where it tears, where its step becomes too long, and what says so.
//!
//! Set-up, choices and tolerances: `docs/stretch.md`.

mod checks;
mod metrics;
mod parameters;
mod tables;
mod theory;
mod watch;

use super::family::{BASES, REMEDIES, family, implicit, other_transfers, pairs};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, TransferName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics as m;
use theory::FREE;
use watch::Stretching;

use Tier::{Nightly, Pr, Quick};

const LEVELS: [Level; 1] = [Level {
    name: "n8",
    h: 0.5 / FREE as f64,
}];
const CRUSHED: &[&str] = &["end=0.05"];
/// Steps that the waves of the deformed body outrun.
const LONG_STEP: &[&str] = &["cfl=0.4"];
const LONG_STEP_CRUSHED: &[&str] = &["cfl=0.55", "end=0.05"];
/// The same J in the plane.
const PLANE: &[&str] = &["dimension=2", "end=0.2236"];
const PLANE_LONG_STEP: &[&str] = &["cfl=0.7", "dimension=2", "end=0.2236"];
const MORE: &[&str] = &["ppc_per_direction=4"];
const SLOWER: &[&str] = &["speed=0.005"];

pub(super) fn case() -> Case {
    Case {
        name: "stretch",
        title: "A body that is stretched eightfold",
        description: "The ends of a body move as if it were stretched alike everywhere, to eight times its length or a twentieth of it; \
                      the part between them is free. Where does it tear, where is its step too long, and what says so?",
        references: vec![
            "Exact: the homogeneous motion and the law's stress in it.".to_owned(),
            "Eigenvalues of the stiffness of the exact state, forces of its lattice: docs/stretch.md.".to_owned(),
        ],
        limits: &["One law, undeformed domains, one lattice of particles; in the plane crushed only."],
        parameters: parameters::ALL.to_vec(),
        plan: plan(),
        levels: LEVELS.to_vec(),
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::TEAR_STRETCH, "tears at (–)", 1.0, 2),
            headline(m::UNSTABLE_STRETCH, "holds at least to (–)", 1.0, 2),
            headline(m::PREDICTED_TEAR_STRETCH, "neighbours part at (–)", 1.0, 2),
            headline(m::STOPPED_STRETCH, "stops at (–)", 1.0, 2),
            headline(m::PREDICTED_STOP_STRETCH, "predicted to stop at (–)", 1.0, 2),
            headline(m::STRESS_NOISE, "noise of the stress (%)", 100.0, 1),
            headline(m::PREDICTED_NOISE, "predicted (%)", 100.0, 1),
            headline(m::STRESS_KEPT, "mean stress kept (%)", 100.0, 1),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["stress_kept", "stress_error"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| if spec.set == PLANE { 1.0 } else { 0.1 }),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(Stretching::begin),
        pictures: |_| Ok(()),
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn plan() -> Vec<Family> {
    let all = pairs(&BASES, &REMEDIES);
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let slow = implicit(&[RuleName::QuasiStatic], &BASES[..3], &remedies);
    // Torn pieces answer rounding.
    let sure = implicit(&[RuleName::QuasiStatic], &BASES[..3], &remedies[..1]);
    let plain = pairs(&BASES, &[RemedyName::None]);
    let consistent = pairs(&BASES[1..2], &[RemedyName::FbarConsistent]);
    // What the plane has beside FLIP.
    let mut transfers = other_transfers();
    let musl = |basis| Scheme::explicit(basis, RemedyName::None, TransferName::Musl);
    transfers.extend([BasisName::Linear, BasisName::Gimp].map(musl));
    vec![
        family(Quick, &LEVELS, &consistent, &[]),
        family(Pr, &LEVELS, &all, &[]),
        family(Pr, &LEVELS, &sure, &[]),
        family(Pr, &LEVELS, &all, CRUSHED),
        family(Pr, &LEVELS, &slow, CRUSHED),
        family(Pr, &LEVELS, &plain, LONG_STEP),
        family(Pr, &LEVELS, &plain, LONG_STEP_CRUSHED),
        family(Nightly, &LEVELS, &slow, &[]),
        family(Pr, &LEVELS, &plain[1..2], PLANE),
        family(Nightly, &LEVELS, &all, PLANE),
        family(Nightly, &LEVELS, &transfers, PLANE),
        family(Nightly, &LEVELS, &plain, PLANE_LONG_STEP),
        family(Nightly, &LEVELS, &plain, MORE),
        family(Nightly, &LEVELS, &plain, SLOWER),
    ]
}

fn sketch() -> Sketch {
    let (long, high) = (1.0, 0.12);
    let body =
        |from: f64, to: f64| Shape::Body(vec![[from, 0.0], [to, 0.0], [to, high], [from, high]]);
    Sketch {
        shapes: vec![
            body(0.0, long),
            body(-0.5, 0.0),
            body(long, long + 0.5),
            Shape::Load([long + 0.1, 0.5 * high], [long + 0.4, 0.5 * high]),
            Shape::Load([-0.1, 0.5 * high], [-0.4, 0.5 * high]),
            Shape::note([0.5 * long, 0.5 * high], "free"),
            Shape::length([0.0, -0.08], [long, -0.08], "8 h"),
        ],
        description: "A body that is longer than eight cells; beside these its nodes move as all would.",
    }
}
