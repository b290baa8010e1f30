//! Columns that another code supplies, and the metrics computed from them.

use super::probes::Probes;
use super::run::{Membrane, energy_defect};
use super::*;
use crate::foreign::{Asked, Foreign, Gap, Gaps, Given, Group, KINETIC, MEAN_STRESS, Measured, START_X, START_Y};
use crate::foreign::{STRESS_WORK, start_columns};

const MOVED_X: Asked = Asked::particle("ux", "m", "displacement along x at rest");
const MOVED_Y: Asked = Asked::particle("uy", "m", "displacement along y at rest");
const REACTION: Asked = Asked::series(
    "reaction_y",
    "N/m",
    "upward force of the clamp on the membrane, the last row at rest: −1 N/m under the case's own load",
);
const LOAD_WORK: Asked = Asked::series("load_work", "J/m", "work of the load so far");
const LOSSES: Asked = Asked::series("damping_losses", "J/m", "what damping has taken so far");

/// Largest share of the load's work between two rows.
const LOADING: f64 = 0.25;

pub(in crate::cases) fn foreign() -> Foreign {
    let of_stress = [MEAN_STRESS_RMS_ERROR, MEAN_STRESS_RMS].into_iter().chain(names(MEAN_STRESSES));
    let errors = [FEM_MID_EDGE_ERROR, FEM_EDGE_MEAN_ERROR, FEM_TIP_ERROR];
    let of_edge = [MID_EDGE_UY, EDGE_MEAN_UY, TIP_UY, TIP_UY_NEAREST, TIP_UX].into_iter().chain(errors);
    let groups = vec![
        Group::new(&[START_X, START_Y, MOVED_X, MOVED_Y], of_edge, |given| {
            let moved = [&MOVED_X, &MOVED_Y].map(|u| given.column(u));
            Ok(probes(given)?.of_displacement(moved, &given.setup::<Cook>()?))
        }),
        Group::new(&[START_X, START_Y, MEAN_STRESS], of_stress, |given| {
            Ok(probes(given)?.of_stress(given.column(&MEAN_STRESS), &given.setup::<Cook>()?))
        }),
        Group::new(&[REACTION], [REACTION_UY], |given| {
            Ok(vec![(REACTION_UY, given.column(&REACTION).last().copied().unwrap_or(f64::NAN))])
        }),
        Group::new(&[KINETIC, STRESS_WORK, LOAD_WORK, LOSSES], [ENERGY_GAIN], energy_gain),
    ];
    Foreign {
        gaps,
        start: |spec, parameters| {
            let particles = Setup::<Cook>::of_spec(spec, parameters)?.loaded_particles()?;
            let mut columns = start_columns(&particles);
            let load = particles.seeded(|k| particles.external_force[k][1]);
            columns.push(crate::job::Column { name: "load_y", unit: "N/m", values: load });
            Ok(columns)
        },
        ..Foreign::of::<2, Membrane>(groups)
    }
}

/// The probes in the particles of a code. Its cells need not have as many particles as ours; two cells are as wide for all.
fn probes(given: &Given) -> Result<Probes, Error> {
    Probes::new(given.points([&START_X, &START_Y]), given.spec.level.h)
}

/// A bound on the energy over the whole loading is judged of rows that show the loading: between two of them the load does
/// at most a quarter of its work.
fn gaps(given: &Given) -> Gaps {
    let work = given.column(&LOAD_WORK);
    let most = LOADING * work.last().copied().unwrap_or_default();
    let mut steps = work.first().copied().into_iter().chain(work.windows(2).map(|pair| pair[1] - pair[0]));
    let why = "the load does more than a quarter of its work before the first row or between two rows";
    let gap = (most > 0.0 && steps.any(|step| step > most)).then(|| (ENERGY_GAIN, Gap::Unknown(why.to_owned())));
    Ok(gap.into_iter().collect())
}

fn energy_gain(given: &Given) -> Measured {
    let [kinetic, stress, load, losses] = [&KINETIC, &STRESS_WORK, &LOAD_WORK, &LOSSES].map(|c| given.column(c));
    let rows = 0..kinetic.len();
    let defects = rows.map(|k| energy_defect(kinetic[k], stress[k], losses[k], load[k]));
    // A load that moves against itself has another sign than is asked for.
    let work = load.last().copied().filter(|work| *work > 0.0);
    let gain = defects.fold(0.0, f64::max) / work.unwrap_or(f64::NAN);
    Ok(vec![(ENERGY_GAIN, gain)])
}
