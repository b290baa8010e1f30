//! Derived quantities, scene and observations of the motion, beside the exact one.

use super::*;
use crate::cases::poro::matrix_entries;
use crate::exact::poro::{Moment, SolidAndWater};
use mpm_core::poro::{Gravity, Predictor, Settings, Tangent};
use std::array::from_fn;

/// Densities of water and grains (kg/m³).
const DENSITIES: [f64; 2] = [1000.0, 2600.0];

impl Setup<Motion> {
    /// Duration of a step (s).
    fn step(&self) -> f64 {
        self.duration / f64::from(self.steps)
    }

    /// Whether particles with linear functions have moved before the last step.
    pub(super) fn has_moved(&self) -> bool {
        self.basis() == Linear && self.steps > 1
    }

    /// Bulk parameter of the law (Pa).
    fn bulk_parameter(&self) -> f64 {
        self.porosity * self.young_modulus / (3.0 * (1.0 - 2.0 * self.poisson_ratio))
    }

    /// Pressure and weight of a metre of water over Young's modulus.
    pub(super) fn load(&self) -> f64 {
        (self.pressure + DENSITIES[0] * self.gravity) / self.young_modulus
    }

    fn own(&self) -> Result<(ImprovedHencky, Conductivity), Fault> {
        let (porosity, kappa) = (self.porosity, self.kappa());
        let conductivity = match self.conductivity_law {
            Law::Constant => Conductivity::Constant(kappa),
            Law::KozenyCarman => Conductivity::KozenyCarman(kappa * (1.0 - porosity).powi(2) / porosity.powi(3)),
        };
        Ok((ImprovedHencky::new(self.bulk_parameter(), self.shear_modulus(), porosity)?, conductivity))
    }

    /// The exact motion, with a law and a conductivity of its own.
    fn solution(&self) -> SolidAndWater {
        SolidAndWater {
            dimension: self.dimension as usize,
            moduli: [self.bulk_parameter(), self.shear_modulus()],
            porosity: self.porosity,
            kappa: self.kappa(),
            kozeny_carman: self.conductivity_law == Law::KozenyCarman,
            densities: DENSITIES,
            gravity: self.gravity,
            amplitude: self.amplitude,
            pressure: self.pressure,
            angular_frequency: self.angular_frequency,
        }
    }
}

/// A position in three dimensions.
fn place<const D: usize>(x: &[f64; D]) -> [f64; 3] {
    from_fn(|a| x.get(a).copied().unwrap_or(0.0))
}

pub(super) struct Moving {
    setup: Setup<Motion>,
    solution: SolidAndWater,
}

/// Errors of every particle, in the particles' order, and the exact values.
struct Errors {
    displacement: Vec<f64>,
    pressure: Vec<f64>,
    stress: Vec<f64>,
    exact: Vec<Moment>,
}

impl Errors {
    /// Rms of the exact p (Pa).
    fn pressure_scale(&self) -> f64 {
        rms(self.exact.iter().map(|e| e.pressure))
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

impl Moving {
    fn errors<const D: usize>(&self, run: &mut dyn Simulation<D>) -> Errors {
        let (t, pressure, stress) = (run.time(), run.field(Field::PorePressure), run.force_stress());
        let p = run.particles();
        let exact: Vec<Moment> = p.reference.iter().map(|x| self.solution.at(place(x), t)).collect();
        let off = |k: usize| {
            let (x, y, u) = (&p.reference[k], &p.position[k], &exact[k].displacement);
            (0..D).map(|a| (y[a] - x[a] - u[a]).powi(2)).sum::<f64>().sqrt()
        };
        Errors {
            displacement: (0..p.len()).map(off).collect(),
            pressure: (pressure.iter().zip(&exact)).map(|(p, e)| p - e.pressure).collect(),
            stress: (stress.iter().zip(&exact)).map(|(s, e)| (s.to_matrix() - e.stress).norm()).collect(),
            exact,
        }
    }
}

impl<const D: usize> Problem<D> for Moving {
    type Parameters = Motion;
    type Seen = ();

    fn new(setup: Setup<Motion>) -> Result<Self, Error> {
        setup.own()?;
        let closed = std::f64::consts::TAU * setup.amplitude / setup.porosity;
        require_quotient("2π amplitude over porosity", closed, 0.0..=1.0, "1/m: beyond, the motion closes its pores")?;
        Ok(Self { solution: setup.solution(), setup })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(D, self.setup.step())
    }

    fn begin(&self, (): &()) -> Begun<D> {
        let (m, exact, h) = (&self.setup, self.solution, self.setup.h);
        let (law, conductivity) = m.own()?;
        let grid = Grid::new(h, [Axis::walls(0.0, (1.0 / h).round() as usize); D])?;
        let spacing = m.pitch();
        let places = by_rows([(1.0 / spacing).round() as usize; D], spacing);
        let particles = m.particles_at(places, spacing, exact.dry_density())?;
        let rollers = (0..D).flat_map(|axis| [End::Lo, End::Hi].map(|end| roller(axis, end)));
        let force = BodyForce(Box::new(move |x: &[f64; D], t| {
            let force = exact.at(place(x), t).body_force;
            from_fn(|a| force[a])
        }));
        let scene = Scene::new(grid, Bodies::new(law, particles)?).load(force).constrain_all(rollers);
        let whole = m.source == Source::Steps;
        let [water, grains] = DENSITIES;
        let mut acceleration = [0.0; D];
        acceleration[D - 1] = -exact.gravity;
        let water = Water::new(exact.porosity, conductivity)
            .gravity(Gravity { water, grains, acceleration })
            .start(move |x| exact.at(place(x), 0.0).pressure)
            .drained(move |x| x[D - 1] > 1.0 - 0.25 * h)
            .source(move |x, span| exact.inflow(place(x), span, whole));
        let settings = Settings {
            pressure_space: m.pressure_space(m.projection / (2.0 * m.shear_modulus())),
            tangent: Tangent::Consistent,
            predictor: match m.predictor {
                Start::Zero => Predictor::Zero,
                Start::Particles => Predictor::Particles,
            },
            tolerance: m.tolerance,
            ..Settings::new(m.step())
        };
        mpm_solvers::poro(m.scheme, scene, water, settings)
    }

    fn row(&self, (): &mut (), phase: &mut Phase<D>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        let errors = self.errors(phase.run.as_mut());
        let run = phase.run.as_ref();
        let (least, most) = run.totals().jacobian;
        let water = run.water().copied().unwrap_or_default();
        Ok(row! {
            "time (s)": run.time(),
            "displacement_l2 (m)": rms(errors.displacement.iter().copied()),
            "pressure_l2 (-)": rms(errors.pressure.iter().copied()) / errors.pressure_scale(),
            "jacobian_min (-)": least,
            "jacobian_max (-)": most,
            "inflow (m)": water.inflow,
            "outflow (m)": water.outflow,
            "water_made (m)": water.imbalance,
            "newton_iterations (-)": iterations as f64,
            "parts (-)": run.convergence().map_or(0.0, |c| f64::from(c.parts)),
        })
    }

    fn progress(&self, (): &(), phase: &Phase<D>) -> f64 {
        phase.share_of(self.setup.steps as u64)
    }

    fn particles<'a>(&self, (): &(), mut columns: Columns<'a, D>) -> Columns<'a, D> {
        let errors = self.errors(columns.run());
        columns
            .references()
            .each("displacement_error", "m", |_, k| errors.displacement[k])
            .field("pore_pressure", "Pa", Field::PorePressure)
            .each("pore_pressure_error", "Pa", |_, k| errors.pressure[k])
            .each("stress_error", "Pa", |_, k| errors.stress[k])
            .field("porosity", "-", Field::Porosity)
            .jacobian()
    }

    fn metrics(&self, (): &(), phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let errors = self.errors(phase.run.as_mut());
        let scale = errors.pressure_scale();
        let moved = |e: &Moment| e.displacement.iter().map(|u| u * u).sum::<f64>().sqrt();
        let run = phase.run.as_ref();
        vec![
            (DISPLACEMENT_L2, rms(errors.displacement.iter().copied())),
            (DISPLACEMENT_LINF, largest(&errors.displacement)),
            (DISPLACEMENT_SCALE, rms(errors.exact.iter().map(moved))),
            (PRESSURE_L2, rms(errors.pressure.iter().copied()) / scale),
            (PRESSURE_LINF, largest(&errors.pressure) / scale),
            (PRESSURE_SCALE, scale),
            (STRESS_L2, rms(errors.stress.iter().copied())),
            (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
            (ENTRIES, matrix_entries(run)),
        ]
    }
}
