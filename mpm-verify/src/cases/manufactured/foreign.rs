//! Columns that another code supplies of a motion that is known in closed form.

use super::motion::{Sample, drift, growth, of_energies};
use super::*;
use crate::foreign::{Asked, Gap, Gaps, Given, Group, MEAN_STRESS, Measured, Part, START_X, START_Y};

pub(in crate::cases) const TIME: Asked = Asked::series("time", "s", "time");
const KINETIC: Asked = Asked::series("kinetic_energy", "J", "kinetic energy");
const ENERGY: Asked = Asked::series("energy", "J", "kinetic and stored energy less the work of the loads");
const SHAPE: Asked = Asked::series(
    "mode",
    "-",
    "Σ u sin kX / Σ A sin² kX over the particles: the share of the wave in the displacement",
);
const AVERAGED: Asked = Asked::particle(
    "averaged_jacobian",
    "-",
    "volume ratio J that the pressure is computed from at the end, averaged or not",
);

/// With these rows a period, Δφ apart, straight lines miss a zero of sin φ by at most 0.016 Δφ³ = 4·10⁻³ rad.
const ROWS_PER_PERIOD: f64 = 10.0;
/// Rows in which thirds of a run at rest are compared.
const ROWS: f64 = 30.0;

/// The motion by the steps of a code, and its rows, after the exact start if that is not among them.
fn rows<const D: usize, K: Known>(given: &Given) -> Result<(Motion<D, K>, Vec<Sample>), Error> {
    let mut motion = Motion::new(given.setup()?)?;
    if given.discretisation.dt.is_finite() {
        motion.timing.dt = given.discretisation.dt;
    }
    let start = motion.sample(motion.begin(&motion.unseen())?.as_ref());
    let row = |k| Sample {
        time: given.value(&TIME, k),
        kinetic: given.value(&KINETIC, k),
        energy: given.value(&ENERGY, k),
        mode: given.value(&SHAPE, k),
    };
    let rows: Vec<Sample> = (0..given.rows(Part::Series)).map(row).collect();
    let start = rows.first().is_none_or(|row| row.time > 0.0).then_some(start);
    Ok((motion, start.into_iter().chain(rows).collect()))
}

pub(in crate::cases) fn of_wave<K: Known>() -> Vec<Group> {
    let measure = |given: &Given| {
        let (motion, rows) = rows::<1, K>(given)?;
        Ok(of_energies(&rows).into_iter().chain(motion.vibration(&rows).into_iter().flatten()).collect())
    };
    let energies = [ENERGY_GAIN, ENERGY_LOSS, ENERGY_END, KINETIC_ENERGY_PEAK];
    vec![
        Group::new(&[TIME, KINETIC, ENERGY], energies, measure),
        Group::new(&[TIME, SHAPE], [FREQUENCY_RATIO, FREQUENCY_ERROR, AMPLITUDE_RATIO, DAMPING], measure),
    ]
}

/// The rows are to show every period to the end, and a bound that depends on the time step is judged of a known one.
pub(in crate::cases) fn gaps_of_wave<K: Known>(given: &Given) -> Gaps {
    let period = K::FREQUENCY.map_or(f64::NAN, |of| std::f64::consts::TAU / of(&given.parameters));
    let of_all = [ENERGY_GAIN, ENERGY_LOSS, ENERGY_END, FREQUENCY_RATIO, FREQUENCY_ERROR, AMPLITUDE_RATIO, DAMPING];
    let span = [0.0, given.parameters.number(DURATION)];
    let mut gaps = given.unseen(&TIME, span, period / ROWS_PER_PERIOD, &of_all);
    if given.discretisation.dt.is_nan() {
        let why = "the bound depends on the time step: `time_step_s` of score.json";
        gaps.push((ENERGY_GAIN, Gap::Unknown(why.to_owned())));
    }
    Ok(gaps)
}

/// Metrics of a body at rest in plane strain.
pub(in crate::cases) fn of_rest<K: Known>() -> Vec<Group> {
    vec![
        Group::new(&[START_Y, MEAN_STRESS], [BASE_PRESSURE], rest::<K>),
        Group::new(&[TIME, KINETIC], [KINETIC_ENERGY_PEAK, KINETIC_GROWTH], rest::<K>),
        Group::new(&[START_X, START_Y, AVERAGED], [J_DRIFT_PER_1E5_STEPS], rest::<K>),
    ]
}

/// The drift is that from the exact volumes of the start.
fn rest<K: Known>(given: &Given) -> Measured {
    let (motion, rows) = rows::<2, K>(given)?;
    let (references, solution) = (given.points([&START_X, &START_Y]), (K::SOLUTION)(&given.parameters)?);
    let start = references.iter().map(|x| solution.deformation_gradient(&vector(x), 0.0).determinant());
    let before = motion.cell_means(&references, &start.collect::<Vec<f64>>());
    let now = motion.cell_means(&references, given.column(&AVERAGED));
    let steps = given.steps.map_or(f64::NAN, |steps| steps as f64);
    let base = motion.base_pressure(given.column(&START_Y), given.column(&MEAN_STRESS));
    let own = [growth(&rows), (BASE_PRESSURE, base), (J_DRIFT_PER_1E5_STEPS, drift(&before, &now, steps))];
    Ok(of_energies(&rows).into_iter().chain(own).collect())
}

/// The rows are to show the kinetic energy over the whole run, and a drift is one over known steps.
pub(in crate::cases) fn gaps_of_rest(given: &Given) -> Gaps {
    let end = given.parameters.number(DURATION);
    let mut gaps = given.unseen(&TIME, [0.0, end], end / ROWS, &[KINETIC_GROWTH]);
    if given.steps.is_none() {
        let why = "the drift is judged by steps: `cost.steps` of score.json";
        gaps.push((J_DRIFT_PER_1E5_STEPS, Gap::Unknown(why.to_owned())));
    }
    Ok(gaps)
}
