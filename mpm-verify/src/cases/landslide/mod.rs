//! Landslides of a slope of soft clay that loses its strength as it flows, in plane strain and in three dimensions.
//!
//! Section 4.4 of Zhao, Jiang & Choo (2023). Set-up, choices and tolerances: `docs/landslide.md`.

mod checks;
mod ground;
mod metrics;
mod observation;
pub(super) mod parameters;
mod pictures;
mod plane_strain;
mod section;
mod sketch;
mod tables;
mod watch;

pub(super) use ground::{Ground, RISE, STABILITY, STAGE, STAGE_DAMPING, factor_of_safety};
pub(super) use section::GRAVITY;
pub(super) use sketch::sketch;

use super::family::{family, more_particles, other_transfers, pairs};
use crate::case::{Begin, Case, Family, FieldView, Tier};
use crate::metric::{Sweep, value};
use crate::parameter::Parameter;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::{Level, RunSpec};
use metrics::{METRICS, RUNOUT_2_5S, headlines};
use parameters::{CFL, PARAMETERS, REDUCTION, parameters_3d};
use plane_strain::Beside;
use watch::Slide;

use Tier::{Long, Nightly, Pr};

fn levels_2d() -> [Level; 4] {
    let names = [("h0.4", 0.4), ("h0.2", 0.2), ("h0.1", 0.1), ("h0.05", 0.05)];
    names.map(|(name, h)| Level { name, h })
}

fn levels_3d() -> [Level; 4] {
    let names = [
        ("h0.5", 0.5),
        ("slice-h0.4", 0.4),
        ("h0.25", 0.25),
        ("h0.2", 0.2),
    ];
    names.map(|(name, h)| Level { name, h })
}

const LIMITS: &[&str] = &[
    "Softening is local: shear bands are as thin as the cells allow, and what flows after the onset depends on their size.",
    "The reduced slope stands at a factor of safety of one: which scheme and level tips is part of the answer.",
    "The clay is undrained; nothing drains, and nothing cracks. Its averaged volume is kept; that of single particles in the flow is not (J).",
];

fn references() -> Vec<String> {
    vec![
        "Zhao, Jiang & Choo (2023), section 4.4, Figures 14 to 16: in kind; the paper gives no numbers but those of the set-up".to_owned(),
        "Limit analysis (docs/exact.md): γH/c = 6.04 (6.015 to 6.078) for 45° on a firm base, so the slope's factor of safety is 1.65 before and 1.00 after the reduction".to_owned(),
    ]
}

/// What every level is solved with.
fn schemes() -> Vec<Scheme> {
    let remedies = [
        RemedyName::None,
        RemedyName::FbarRecursive,
        RemedyName::FbarConsistent,
    ];
    pairs(&[BasisName::Gimp, BasisName::Bspline2], &remedies)
}

fn cost(spec: &RunSpec, dimension: i32) -> f64 {
    let sweep = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarRecursive | RemedyName::FbarTotal | RemedyName::FbarRate => 1.2,
        RemedyName::FbarConsistent => 1.7,
    };
    let short = spec.set.iter().any(|set| set.starts_with("duration="));
    let across = if spec.level.name.starts_with("slice") {
        0.3
    } else {
        1.0
    };
    across * sweep / spec.level.h.powi(dimension + 1) / if short { 3.0 } else { 1.0 }
}

/// A case of the slope.
fn slope(
    [name, title, description, size]: [&'static str; 4],
    parameters: Vec<Parameter>,
    levels: &[Level],
    plan: Vec<Family>,
    dimension: i32,
    begin: Begin,
) -> Case {
    Case {
        name,
        title,
        description,
        references: references(),
        limits: LIMITS,
        parameters,
        levels: levels.to_vec(),
        plan,
        metrics: METRICS.to_vec(),
        checks: checks::checks(),
        headlines: headlines(),
        quantities: vec![value(RUNOUT_2_5S, "run-out at 2.5 s (m)")],
        sweeps: vec![
            Sweep {
                parameter: REDUCTION,
                label: "reduction of the peak strength (–)",
                abscissa: |reduction| reduction,
                logarithmic: false,
            },
            Sweep {
                parameter: CFL,
                label: "CFL number (–)",
                abscissa: |cfl| cfl,
                logarithmic: true,
            },
        ],
        watched: &["toe", "settlement", "kinetic_energy", "failed_share"],
        field: (dimension == 2).then_some(FieldView {
            time: Some(1.0),
            value: "plastic_strain",
            label: "plastic strain after 1 s (-)",
            range: (0.0, 0.004),
            window: [(0.0, 16.0), (0.0, 5.0)],
        }),
        sketch: sketch(size),
        cost: Box::new(move |spec| cost(spec, dimension)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin,
        pictures: pictures::draw,
        tables: tables::all(dimension),
        breaks_down: checks::breaks_down,
    }
}

/// The landslide in plane strain.
pub(super) fn plane_case() -> Case {
    slope(
        [
            "landslide-2d",
            "Landslide in plane strain",
            "A slope of clay, 5 m high at 45°, under its weight. Its peak strength is divided by 1.65; it softens as it flows. \
             The section of the landslide in three dimensions, for studies of cell size, remedy and time step.",
            "5 m",
        ],
        PARAMETERS.to_vec(),
        &levels_2d(),
        plan_2d(),
        2,
        Box::new(|spec, parameters| Ok(Box::new(Slide::<2>::drive(spec, parameters)?))),
    )
}

/// The landslide in three dimensions.
pub(super) fn case() -> Case {
    slope(
        [
            "landslide",
            "Landslide",
            "A slope of clay, 5 m high at 45° and 5 m wide between smooth walls, under its weight. Its peak strength is divided by \
             1.65; it softens as it flows and slides out onto a rough floor. Standard MPM locks: with GIMP it stands.",
            "5 m, 5 m wide",
        ],
        parameters_3d(),
        &levels_3d(),
        plan_3d(),
        3,
        Box::new(|spec, parameters| Ok(Box::new(Beside::new(spec, parameters)?))),
    )
}

fn plan_2d() -> Vec<Family> {
    let levels = levels_2d();
    let [h40, h20, h10, h05] = levels;
    let all = schemes();
    let [three, four] = more_particles(Long, &[h40]);
    vec![
        family(Pr, &[h40], &all, &["duration=1"]),
        family(Nightly, &[h40, h20, h10], &all, &[]),
        family(Nightly, &[h40], &all, &["reduction=1", "duration=2.5"]),
        family(Nightly, &[h40, h20], &all, &["reduction=1.8"]),
        family(Nightly, &[h40, h20], &all, &["reduction=2"]),
        family(Nightly, &[h40, h20], &all, &["cfl=0.175"]),
        family(Nightly, &[h40], &all, &["damping=0.7"]),
        family(Nightly, &[h40, h20], &all, &["release=2"]),
        family(Long, &[h20], &all, &["damping=0.7"]),
        family(Long, &[h05], &all, &[]),
        family(Long, &levels, &other_transfers(), &[]),
        three,
        four,
    ]
}

fn plan_3d() -> Vec<Family> {
    let [h50, slice, h25, h20] = levels_3d();
    let all = schemes();
    let early = pairs(
        &[BasisName::Gimp],
        &[RemedyName::None, RemedyName::FbarConsistent],
    );
    vec![
        family(Pr, &[h50], &early, SHORT),
        family(Nightly, &[slice], &early, &["duration=0.5"]),
        family(Nightly, &[slice], &all, &[]),
        family(Nightly, &[slice], &early, &["reduction=1", "duration=1"]),
        family(Nightly, &[slice], &early, &["reduction=2", "duration=2.5"]),
        family(Nightly, &[h50], &all, &[]),
        family(Nightly, &[h50], &all, &["width=2"]),
        family(Nightly, &[h25], &early, &[]),
        family(Long, &[h25, h20], &all, &[]),
    ]
}

/// Of the pull request in three dimensions: a narrow slice before a short floor, from under rising gravity to just
/// after the reduction, by long steps.
const SHORT: &[&str] = &["width=2", "floor=3", "duration=0.06", "cfl=0.6"];
