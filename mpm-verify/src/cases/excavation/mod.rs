//! A slope whose toe is cut away: the geotechnical case of the implicit paper.
//!
//! Section 3.3 of Wang, Vardon, Hicks & Chen (2016). Set-up, choices and tolerances: `docs/excavation.md`.

mod checks;
mod look;
mod metrics;
mod parameters;
mod pictures;
mod reference;
mod scene;
mod sketch;
mod tables;
mod watch;

use super::family::{family, implicit};
use crate::case::{Case, Family, Tier};
use crate::results::headline;
use crate::scheme::{BasisName, RemedyName, RuleName};
use crate::spec::{Level, RunSpec};
use metrics as m;
use watch::Excavation;

use BasisName::{Bspline2, Gimp};
use RuleName::{Midpoint, Newmark, QuasiStatic};
use Tier::{Long, Nightly, Pr, Quick};

pub(super) fn case() -> Case {
    let levels =
        [("h0.1", 0.1), ("h0.05", 0.05), ("h0.025", 0.025)].map(|(name, h)| Level { name, h });
    Case {
        name: "excavation",
        title: "Slope whose toe is cut away",
        description: "A slope of clay that softens stands under its weight; a wedge at its toe is taken away at once. The geotechnical case \
                      of the implicit paper. By limit analysis it stands at the peak strength, whole and cut, and at the residual \
                      strength it can't: what fails is progressive, and depends on the cells.",
        references: vec![
            "Limit analysis (docs/exact.md): arcs, γH/c = 6.078 whole and 5.537 cut, at most 1.2 % above finite-element bounds; a foot that slides".to_owned(),
            "Equilibrium, momentum and energy.".to_owned(),
        ],
        limits: &[
            "Softening without a length: shear bands are as wide as the cells allow, and the run-out differs from level to level.",
            "The paper gives neither the friction of its base nor the length of its crest.",
            "Local damping, by which the paper comes to rest, is refused in implicit steps; static steps take its place.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(levels),
        levels: levels.to_vec(),
        metrics: m::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(m::FACTOR_UNCUT, "factor, whole (–)", 1.0, 3),
            headline(m::FACTOR_CUT, "cut (–)", 1.0, 3),
            headline(m::GRAVITY_CARRIED, "gravity carried (–)", 1.0, 3),
            headline(m::STANDS_UNCUT, "stands whole", 1.0, 0),
            headline(m::STANDS_CUT, "cut", 1.0, 0),
            headline(m::RUNOUT_END, "run-out (m)", 1.0, 3),
            headline(m::CREST_DROP, "crest sinks (m)", 1.0, 3),
            headline(m::BAND_WIDTH, "band (m)", 1.0, 3),
            headline(m::KINETIC_END, "E_kin at the end (%)", 100.0, 2),
            headline(m::FORCE_RATIO_UNCUT, "(37) before the cut (10⁻¹²)", 1e12, 1),
            headline(m::BALANCE_ERROR, "energy off by (%)", 100.0, 2),
        ],
        quantities: Vec::new(),
        sweeps: Vec::new(),
        watched: &["moved", "front"],
        field: None,
        sketch: sketch::sketch(),
        cost: Box::new(cost),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Excavation::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

/// Steps, and what a factorisation takes.
fn cost(spec: &RunSpec) -> f64 {
    let steps = match spec.scheme.rule() {
        Some(RuleName::QuasiStatic) => 0.1,
        _ => 1.0,
    };
    steps * 2.0 * (0.1 / spec.level.h).powi(3)
}

/// Without softening, at the peak and at the residual strength.
const PERFECT: &[&str] = &["residual=5e3"];
const WEAK: &[&str] = &["peak=1e3", "residual=1e3", "load_steps=4"];
const WEAK_AT_ONCE: &[&str] = &["peak=1e3", "residual=1e3", "gravity=step"];
const AT_ONCE: &[&str] = &["gravity=step"];
const SLIDING: &[&str] = &["base=friction"];
const SLIPPERY_PERFECT: &[&str] = &["base=friction", "friction=0.05", "residual=5e3"];
/// Of the pull request.
const BRIEF: &[&str] = &["duration=0.5"];
const BRIEF_PERFECT: &[&str] = &["duration=0.5", "residual=5e3"];
const BRIEF_SLIDING: &[&str] = &["base=friction", "duration=0.25"];
const SLIPPERY: &[&str] = &["base=friction", "friction=0.05"];
/// Ground whose weight alone lets none of it flow.
const LATERAL: &[&str] = &["poisson_ratio=0.45"];
/// Other bases of the same slope.
const FRICTIONS: [&[&str]; 4] = [
    &["base=friction", "friction=0.1"],
    &["base=friction", "friction=0.2"],
    &["base=friction", "friction=0.3"],
    &["base=friction", "friction=1"],
];

fn plan([h1, h2, h3]: [Level; 3]) -> Vec<Family> {
    let none = [RemedyName::None];
    let moving = implicit(&[Midpoint, Newmark], &[Gimp], &none);
    let midpoint = &moving[..1];
    let resting = implicit(&[QuasiStatic], &[Gimp, Bspline2], &none);
    let means = &resting[..1];
    let mut all = vec![
        family(Pr, &[h1], midpoint, &[]),
        family(Quick, &[h1], means, &[]),
        family(Pr, &[h1], &moving[1..], BRIEF),
        family(Pr, &[h1], midpoint, BRIEF_PERFECT),
        family(Pr, &[h1], midpoint, BRIEF_SLIDING),
        family(Pr, &[h1], means, PERFECT),
        family(Pr, &[h1], means, WEAK_AT_ONCE),
        family(Pr, &[h1], means, SLIPPERY_PERFECT),
        family(Nightly, &[h1, h2], &moving, &[]),
        family(Nightly, &[h1, h2, h3], &resting, &[]),
        family(Nightly, &[h1, h2, h3], &resting, AT_ONCE),
        family(Nightly, &[h1, h2], &resting, PERFECT),
        family(Nightly, &[h1, h2], midpoint, PERFECT),
        family(Nightly, &[h1, h2], midpoint, AT_ONCE),
        family(Nightly, &[h1, h2], midpoint, SLIDING),
        family(Nightly, &[h2], &moving[1..], SLIDING),
        family(Nightly, &[h1, h2, h3], means, SLIDING),
        family(Nightly, &[h1, h2, h3], means, LATERAL),
        family(Nightly, &[h1, h2], midpoint, LATERAL),
        family(Nightly, &[h1], means, WEAK),
        family(Nightly, &[h1], means, SLIPPERY),
        family(Nightly, &[h2], means, SLIPPERY_PERFECT),
        family(Nightly, &[h1, h2], midpoint, &["law=jaumann-j2"]),
        family(Nightly, &[h1], midpoint, &["ghost=0.001"]),
        family(Nightly, &[h1], midpoint, &["cfl=1"]),
        family(Long, &[h3], &moving, &[]),
    ];
    all.extend(FRICTIONS.map(|set| family(Nightly, &[h1, h2], means, set)));
    all
}
