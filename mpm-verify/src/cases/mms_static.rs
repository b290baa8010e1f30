//! A vortex in a box so slow that it is always in equilibrium: the quasi-static solver against an exact solution.
//!
//! Set-up, choices and tolerances: `docs/mms-static.md`.

use super::family::family;
use super::manufactured::checks::{
    Claim, Claims, is_beyond_unseen, locking, of_motion, stress_order,
};
use super::manufactured::metrics::{self as m, DISPLACEMENT_L2};
use super::manufactured::{DURATION, LOAD_STEPS, Manufactured, PPC_PER_DIRECTION, levels};
use super::mms_vortex_box::{LOCKING_CURVE, WAVE};
use super::parameters::{POISSON_RATIO, UNSEEN};
use crate::case::{Case, Family, Tier};
use crate::check::{Check, Finding, study};
use crate::exact::common::ANGULAR_FREQUENCY;
use crate::exact::twist::ANGLE;
use crate::exact::vortex_pressure::PRESSURE;
use crate::exact::{self, Exact, swirl, vortex_pressure};
use crate::metric::Metric;
use crate::parameter::{Domain, Parameter, Parameters, number, parameters};
use crate::record::Record;
use crate::results::{Column, Format, ResultTable, SCHEME, SHORT, fixed, share};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::spec::Level;

use BasisName::{Bspline2, Bspline3, Gimp, Linear};
use RemedyName::FbarConsistent;
use Tier::{Nightly, Pr, Quick};

parameters! { const:
    DIMENSION = "dimension", "-", "2", Domain::Integer { least: 2, most: 3 },
        "2: plane strain; 3: the swirl in a cube, whose pressure is zero";
}

const SOFT: &[&str] = &["poisson_ratio=0.3"];
const PRESSED: &[&str] = &["pressure=100"];
const ORDERS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, claim)];

pub(super) fn case() -> Case {
    let levels = levels()[..3].to_vec();
    let names = [
        "mms-static",
        "Slow vortex in a box",
        "The middle of a square turns so slowly that the body is always in equilibrium, by the quasi-static solver: isochoric, or with a pressure that is known. Second order in u; with F̄ no locking.",
    ];
    let mut checks = of_motion(ORDERS, WAVE);
    checks.push(stress_order(ORDERS));
    checks.extend(locking());
    checks.push(unseen_locks());
    Case {
        limits: &[
            "Quadrature by moved particles: of linear functions, whose gradients jump, it spoils convergence from the second step on.",
            "In three dimensions one level: a direct factorisation fills up.",
        ],
        sweeps: vec![LOCKING_CURVE],
        references: vec![
            "Exact solution: that of mms-vortex-pressure, in three dimensions of mms-swirl, at a frequency whose inertia is below 10⁻¹⁰ of the forces.".to_owned(),
        ],
        plan: plan(&levels),
        levels,
        checks,
        tables: vec![over_cells("mms-static", &[]), over_cells("mms-static-soft", SOFT), over_cells("mms-static-pressure", PRESSED), ratios(), iterations()],
        ..Manufactured::solid(solution).slow_case(names, all_parameters())
    }
}

/// A quarter of the period, over which the angle grows to its amplitude.
fn all_parameters() -> Vec<Parameter> {
    let slowest = ANGULAR_FREQUENCY
        .with_default("1.570796326794897e-6")
        .meaning(
            "angular frequency ω: so low that inertia, which the solver doesn't have, is nothing",
        );
    let mut all = vortex_pressure::ENTRY.parameters.to_vec();
    for p in &mut all {
        if p.name == POISSON_RATIO.name {
            p.default = "0.4999";
        } else if p.name == ANGLE.name {
            p.default = "0.1";
        } else if p.name == PRESSURE.name {
            p.default = "0";
        } else if p.name == ANGULAR_FREQUENCY.name {
            *p = Parameter {
                domain: number(1e-6, 1e-5, false),
                ..slowest
            };
        }
    }
    all.extend([
        DIMENSION,
        DURATION.with_default("1e6"),
        LOAD_STEPS,
        // In the middle of a cell what alternates from node to node has no strain, and nothing holds it in equilibrium.
        PPC_PER_DIRECTION.within(Domain::Integer { least: 2, most: 4 }),
    ]);
    all
}

fn solution(p: &Parameters) -> Result<Box<dyn Exact>, exact::Error> {
    if p.number(DIMENSION) == 2.0 {
        return (vortex_pressure::ENTRY.build)(p);
    }
    if p.number(PRESSURE) != 0.0 {
        let given = p.number(PRESSURE);
        return Err(exact::Error(format!(
            "pressure = {given} with dimension = 3; allowed: 0"
        )));
    }
    (swirl::ENTRY.build)(p)
}

fn schemes(bases: &[BasisName], remedies: &[RemedyName]) -> Vec<Scheme> {
    let of = |&basis: &BasisName| {
        remedies
            .iter()
            .map(move |r| Scheme::quasi_static(basis, *r))
    };
    bases.iter().flat_map(of).collect()
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let both = [RemedyName::None, FbarConsistent];
    let all = schemes(&[Linear, Gimp, Bspline2, Bspline3], &both);
    let few = schemes(&[Gimp, Bspline2], &both);
    let averaged = schemes(&[Bspline2], &[FbarConsistent]);
    let (two, three) = (&levels[..2], &levels[..3]);
    vec![
        family(Quick, &levels[..1], &averaged, &[]),
        family(Pr, three, &averaged, &[]),
        family(Pr, two, &few, &[]),
        family(Pr, three, &averaged, SOFT),
        family(Pr, two, &few, SOFT),
        family(Pr, &levels[..1], &averaged, PRESSED),
        family(Nightly, three, &all, &[]),
        family(Nightly, three, &all, SOFT),
        family(Nightly, three, &all, &["poisson_ratio=0.49"]),
        family(Nightly, three, &all, &["poisson_ratio=0.499"]),
        family(Nightly, two, &all, &["poisson_ratio=0.49999"]),
        family(Nightly, two, &all, &["poisson_ratio=0.499999"]),
        family(Nightly, two, &all, &["poisson_ratio=0.4999999"]),
        family(Nightly, three, &all, &["load_steps=1"]),
        family(Nightly, three, &few, &["load_steps=16"]),
        family(Nightly, three, &all, PRESSED),
        // Another pressure, as the body is softer: no pair for the check of locking, whose motion mustn't depend on ν.
        family(Nightly, three, &all, &["poisson_ratio=0.3", "pressure=20"]),
        family(Nightly, three, &few, &["ppc_per_direction=4"]),
        family(Nightly, &levels[..1], &few, &["dimension=3"]),
        family(
            Nightly,
            &levels[..1],
            &few,
            &["dimension=3", "poisson_ratio=0.3"],
        ),
    ]
}

/// Errors relative to the motion over the cells, and the error of the mean stress, of runs that change `set`.
fn over_cells(name: &str, set: &'static [&'static str]) -> ResultTable {
    let relative = |r: &Record| r.metric(m::DISPLACEMENT_L2) / r.metric(m::DISPLACEMENT_SCALE);
    let levels = ["n8", "n16", "n32"];
    let errors = levels.map(|level| {
        Column::value(format!("error of u, {level}"), relative, share(2))
            .of(move |r| r.level == level)
    });
    let stress = levels.map(|level| {
        Column::metric(format!("of σ_m (Pa), {level}"), m::MEAN_STRESS_L2, SHORT)
            .of(move |r| r.level == level)
    });
    let columns = errors.into_iter().chain(stress);
    ResultTable::new(name, move |r| r.set == set, &[SCHEME], columns)
}

/// Poisson's ratios of the tables.
const RATIOS: [f64; 7] = [0.3, 0.49, 0.499, 0.4999, 0.49999, 0.499999, 0.4999999];

/// Errors at n16 over Poisson's ratios.
fn ratios() -> ResultTable {
    let relative = |r: &Record| r.metric(m::DISPLACEMENT_L2) / r.metric(m::DISPLACEMENT_SCALE);
    over_ratios("mms-static-ratios", relative, share(2))
}

/// Newton iterations of a load step, likewise.
fn iterations() -> ResultTable {
    let in_a_step = |r: &Record| r.metric(m::NEWTON_ITERATIONS) / r.work.steps as f64;
    over_ratios("mms-static-iterations", in_a_step, fixed(1))
}

fn over_ratios(name: &str, value: fn(&Record) -> f64, format: Format) -> ResultTable {
    let columns = RATIOS.map(|ratio| {
        Column::value(format!("ν = {ratio}"), value, format)
            .of(move |r| r.parameters.number(POISSON_RATIO) == ratio)
    });
    ResultTable::new(
        name,
        |r| r.level == "n16" && r.changes_none_but(&[POISSON_RATIO.name]),
        &[SCHEME],
        columns,
    )
}

/// What a run errs by beside one that has the stiffness of the unseen everywhere.
const ALIKE: f64 = 0.1;

/// Where the stiffness ε² K of what the average can't see is what locks.
fn unseen_locks() -> Check {
    Check::known_limit(
        "unseen-locks",
        "GIMP with fbar-consistent beyond 1 − 2ν = ε²: the rms error of u is, within a tenth, that of no remedy at the ratio ν′ with 1 − 2ν′ = (1 − 2ν)/ε², whose bulk modulus is ε² K",
        study(|records| {
            let beyond = records.iter().filter(|r| {
                r.basis() == Gimp
                    && is_beyond_unseen(r)
                    && r.changes_none_but(&[POISSON_RATIO.name])
            });
            let compressible = |r: &Record| 1.0 - 2.0 * r.parameters.number(POISSON_RATIO);
            let found = beyond.filter_map(|r| {
                let soft = compressible(r) / (UNSEEN * UNSEEN);
                let like = records.iter().find(|l| {
                    l.basis() == Gimp
                        && l.remedy() == RemedyName::None
                        && l.level == r.level
                        && l.changes_none_but(&[POISSON_RATIO.name])
                        && (compressible(l) / soft - 1.0).abs() < 1e-6
                })?;
                let ratio = r.metric(DISPLACEMENT_L2) / like.metric(DISPLACEMENT_L2);
                let about = format!("{} of {} over that of none at {}", DISPLACEMENT_L2.name, r.level, like.set.join(" "));
                let why = "strains that Π can't see are as stiff as without a remedy at that ratio, and more than nodes can avoid";
                Some(Finding::within(about, ratio, 1.0, ALIKE, why))
            });
            found.collect()
        }),
    )
}

/// What is known of convergence.
fn claim(r: &Record) -> Claim {
    let squeezed = r.parameters.number(PRESSURE) > 0.0;
    let stiff = r.parameters.number(POISSON_RATIO) > 0.3;
    match (r.basis(), r.remedy()) {
        (Linear, _) if r.parameters.number(LOAD_STEPS) > 1.0 => {
            Claim::Open("the gradient of a linear basis jumps where particles cross cells")
        }
        (_, RemedyName::None) if stiff => {
            Claim::Open("without a remedy the error is that of locking until the cells resolve it")
        }
        (Bspline3, _) if squeezed => Claim::Open(
            "two particles per direction don't integrate cubics at a wall that a pressure acts on",
        ),
        (Gimp, _) if squeezed => Claim::Observed(
            [1.5, 3.1],
            "domains of fixed size part and overlap where the body is strained",
        ),
        _ => Claim::Second,
    }
}
