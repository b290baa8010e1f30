//! What is seen of the slab, step by step.

use super::metrics as m;
use super::parameters::{LOAD, STEPS};
use super::scene::{
    PER_CELL, SMALL, WIDTH, begin, first_measured, moduli, slab, slab_of_cells, slab_of_run,
    slab_of_steps, steps, time_scale,
};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::cases::parameters::{least_strain, require_quotient};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::exact::mandel::{Mandel, Slab};
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use mpm_core::{Field, Part, Simulation};
use serde::{Deserialize, Serialize};

/// Least value of what is rounding.
const ROUNDING: f64 = 1e-9;
/// The plane of symmetry below, among the scene's constraints.
const BELOW: Part = Part::Constraint(1);

/// What has been seen of the slab: largest distances, and the peak.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: i32,
    whole: f64,
    space: f64,
    time: f64,
    equations: f64,
    settlement: f64,
    bulge: f64,
    support: f64,
    peak: (f64, f64),
}

/// A slab that consolidates.
pub(super) struct Consolidation {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    exact: Mandel,
    of_steps: Mandel,
    of_cells: Mandel,
    of_run: Vec<Slab>,
}

impl Consolidation {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let strain = parameters.number(LOAD) / (moduli(parameters)[1] * WIDTH);
        let (least, why) = (
            least_strain(parameters.number(STEPS)),
            "below which rounding hides the answer and above which the strain is not small",
        );
        require_quotient("load / (a G) of young_modulus", strain, least..=SMALL, why)?;
        let h = spec.level.h;
        let consolidation = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: Discretisation {
                dim: 2,
                h,
                ppc: (PER_CELL * PER_CELL) as u32,
                dt: steps(parameters).1 * time_scale(parameters),
                wall: "open-knot".to_owned(),
            },
            exact: slab(parameters),
            of_steps: slab_of_steps(parameters),
            of_cells: slab_of_cells(spec.scheme, h, parameters),
            of_run: slab_of_run(spec.scheme, h, parameters),
        };
        Ok(Drive::new(consolidation, Seen::default())?)
    }

    fn load(&self) -> f64 {
        self.parameters.number(LOAD)
    }

    /// The slab as it is, in the units of the exact one.
    fn slab(&self, run: &dyn Simulation<2>) -> Slab {
        let h = self.spec.level.h;
        let pressures = run.pressure_nodes();
        let middle = pressures.iter().filter(|(x, _)| x[0].abs() < 1e-9 * h);
        let [_, shear] = moduli(&self.parameters);
        let p = run.particles();
        let strain = mean((0..p.len()).map(|k| p.position[k][1] / p.reference[k][1] - 1.0));
        let change = mean((0..p.len()).map(|k| p.volume[k] / p.reference_volume[k] - 1.0));
        let unit = self.load() / (shear * WIDTH);
        Slab {
            centre: mean(middle.map(|(_, p)| *p)) * 2.0 * WIDTH / self.load(),
            settlement: -strain / unit,
            bulge: (change - strain) / unit,
        }
    }
}

/// NaN of none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    sum / count
}

/// Raises `most` to |a − b|; what is no number stays none.
fn raise(most: &mut f64, a: f64, b: f64) {
    let distance = (a - b).abs();
    if distance > *most || distance.is_nan() {
        *most = distance;
    }
}

impl Watch<2> for Consolidation {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "time_factor (-)",
            "centre_pressure (-)",
            "centre_pressure_exact (-)",
            "settlement (-)",
            "settlement_exact (-)",
            "bulge (-)",
            "bulge_exact (-)",
            "outflow (m²)",
            "newton_iterations (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        let before = stage.run.work().newton_iterations;
        stage.steps(1)?;
        let run = stage.run.as_ref();
        seen.steps += 1;
        let (_, step) = steps(&self.parameters);
        let t = f64::from(seen.steps) * step;
        let own = self.slab(run);
        let exact = self.exact.at(t);
        let of_run = self.of_run[seen.steps as usize - 1];
        raise(&mut seen.equations, own.centre, of_run.centre);
        raise(&mut seen.equations, own.settlement, of_run.settlement);
        raise(&mut seen.equations, own.bulge, of_run.bulge);
        raise(
            &mut seen.support,
            -run.on(BELOW).force[1] / self.load(),
            1.0,
        );
        if seen.steps >= first_measured(&self.parameters) {
            let of_steps = self.of_steps.after(seen.steps, step);
            raise(&mut seen.whole, own.centre, exact.centre);
            raise(&mut seen.space, own.centre, of_steps.centre);
            raise(&mut seen.time, own.centre, self.of_cells.at(t).centre);
            raise(&mut seen.settlement, own.settlement, exact.settlement);
            raise(&mut seen.bulge, own.bulge, exact.bulge);
        }
        if own.centre > seen.peak.0 {
            seen.peak = (own.centre, t);
        }
        Ok(vec![
            run.time(),
            t,
            own.centre,
            exact.centre,
            own.settlement,
            exact.settlement,
            own.bulge,
            exact.bulge,
            run.water().map_or(f64::NAN, |w| w.outflow),
            (run.work().newton_iterations - before) as f64,
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        f64::from(seen.steps) / f64::from(steps(&self.parameters).0)
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let pressure = stage.run.field(Field::PorePressure);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend(reference_columns(p));
        columns.extend([
            column("pore_pressure", "Pa", p.seeded(|k| pressure[k])),
            column("effective_stress_xx", "Pa", p.seeded(|k| p.stress[k].xx)),
            column("effective_stress_yy", "Pa", p.seeded(|k| p.stress[k].yy)),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let run = stage.run.as_ref();
        let work = run.work();
        let lost = run
            .water()
            .map_or(f64::NAN, |w| (w.imbalance / w.outflow).abs());
        // What is no number stays none.
        let above = |value: f64| if value < ROUNDING { ROUNDING } else { value };
        vec![
            (m::CENTRE_PRESSURE_ERROR, seen.whole),
            (m::CENTRE_PRESSURE_ERROR_SPACE, seen.space),
            (m::CENTRE_PRESSURE_ERROR_TIME, seen.time),
            (m::EQUATIONS_DISTANCE, seen.equations),
            (m::PEAK, seen.peak.0),
            (m::PEAK_TIME, seen.peak.1),
            (m::SETTLEMENT_ERROR, seen.settlement),
            (m::BULGE_ERROR, seen.bulge),
            (m::SUPPORT_ERROR, above(seen.support)),
            (m::MASS_ERROR, above(lost)),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (
                m::ENTRIES,
                work.nonzeros as f64 / work.factorisations.max(1) as f64,
            ),
        ]
    }
}
