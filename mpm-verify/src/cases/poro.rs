//! Scenes and observations that cases of solid and water share.

use crate::cases::prelude::*;
use mpm_core::poro::PressureSpace;

pub(super) const WATER_WEIGHT: f64 = 9810.0;
pub(super) const CONDUCTIVITY: Parameter =
    real("m/s", "1e-5", 1e-12, 1.0).named("conductivity").meaning("hydraulic conductivity k, of water of 9810 N/m³");
pub(super) const PROJECTION: Parameter =
    real("-", "1", 0.01, 100.0).named("projection").meaning("ppp: its strength times 2G");
pub(super) const TOLERANCE: Parameter =
    real("-", "1e-10", 1e-13, 1e-8).named("tolerance").meaning("residual of a converged step over what it balances");

/// Height (m) of a column, particles a cell, and empty cells above.
pub(super) const HEIGHT: f64 = 1.0;
pub(super) const PER_CELL: usize = 2;
const ROOM: usize = 2;

/// A column on a sealed floor.
pub(super) fn column<P: ParameterSet>(setup: &Setup<P>, law: impl Into<SharedLaw>) -> Result<Scene<1>, Fault> {
    let (h, cells) = (setup.h, (HEIGHT / setup.h).round() as usize);
    let axis = Axis::bounded(0.0, cells + ROOM, (Side::Wall, Side::Open));
    let spacing = h / PER_CELL as f64;
    // Nothing moves by its weight: any density will do.
    let particles = setup.particles_at(by_rows([cells * PER_CELL], spacing), spacing, 1000.0)?;
    Ok(Scene::new(Grid::new(h, [axis])?, Bodies::new(law, particles)?).constrain(roller(0, End::Lo)))
}

/// Whether a particle of a column on cells of size `h` (m) is its topmost.
pub(super) fn topmost(h: f64) -> impl Fn(&[f64; 1]) -> bool + Copy {
    move |x| x[0] > HEIGHT - h / PER_CELL as f64
}

/// Columns that are kept of particles: where they start, their water, and their stress along the first axis.
pub(super) fn kept<const D: usize>(columns: Columns<'_, D>) -> Columns<'_, D> {
    let columns = columns.references().field("pore_pressure", "Pa", Field::PorePressure);
    columns.field("porosity", "-", Field::Porosity).each("effective_stress_xx", "Pa", |p, k| p.stress[k].xx)
}

/// A column under its load.
pub(super) fn column_sketch(description: &'static str) -> Sketch {
    Sketch::block(description, [0.3, 1.0])
        .held([0.0, 0.0], [0.3, 0.0])
        .length([-0.1, 0.0], [-0.1, 1.0], "1 m")
        .note([0.15, 1.2], "q, drained")
        .loads((0..3).map(|k| 0.05 + 0.1 * f64::from(k)), [1.13, 1.02])
}

/// The three pressure spaces with the functions `basis`.
pub(super) fn spaces(basis: BasisName) -> [Scheme; 3] {
    [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(basis, space))
}

impl<P: ParameterSet> Setup<P> {
    /// Shear modulus G (Pa) of undeformed material.
    pub(super) fn shear_modulus(&self) -> f64 {
        self.number(common::YOUNG_MODULUS) / (2.0 * (1.0 + self.number(common::POISSON_RATIO)))
    }

    /// Oedometric modulus M (Pa) of undeformed material.
    pub(super) fn oedometric_modulus(&self) -> f64 {
        let ratio = self.number(common::POISSON_RATIO);
        2.0 * self.shear_modulus() * (1.0 - ratio) / (1.0 - 2.0 * ratio)
    }

    /// κ (m²/(Pa s)) of undeformed material, by the parameter `conductivity`.
    pub(super) fn kappa(&self) -> f64 {
        self.number(CONDUCTIVITY) / WATER_WEIGHT
    }

    /// τ M of a projection by the parameter `projection`; zero without one.
    pub(super) fn projection_strength(&self) -> f64 {
        self.space().map_or(0.0, |space| self.strength_in(space))
    }

    /// The same in a pressure space.
    pub(super) fn strength_in(&self, space: SpaceName) -> f64 {
        match space {
            Ppp => self.number(PROJECTION) * self.oedometric_modulus() / (2.0 * self.shear_modulus()),
            _ => 0.0,
        }
    }

    /// The pressure space; a projection has the strength τ `strength` (1/Pa).
    pub(super) fn pressure_space(&self, strength: f64) -> PressureSpace {
        match self.space() {
            Some(TwoGrid) => PressureSpace::TwoGrid,
            Some(Ppp) => PressureSpace::Projected { strength },
            // No other kind of scheme has a solver.
            _ => PressureSpace::Equal,
        }
    }
}

/// A distance that is at least [`ROUNDING`]; NaN stays NaN.
pub(super) fn above_rounding(distance: f64) -> f64 {
    if distance < ROUNDING { ROUNDING } else { distance }
}

/// Volumes of the particles (m³, m² in plane strain, m in one dimension) by their identity.
pub(super) fn volumes<const D: usize>(run: &dyn Simulation<D>) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.volume[k])
}

/// Loss of the body's volume since the start (m³, m² in plane strain, m in one dimension).
pub(super) fn lost_volume<const D: usize>(run: &dyn Simulation<D>) -> f64 {
    let p = run.particles();
    let volume = |of: &[f64]| of.iter().sum::<f64>();
    volume(&p.reference_volume) - volume(&p.volume)
}

/// Entries of a matrix, on average.
pub(super) fn matrix_entries<const D: usize>(run: &dyn Simulation<D>) -> f64 {
    let work = run.work();
    work.nonzeros as f64 / work.factorisations.max(1) as f64
}

/// Pressure (Pa) at the lowest node of a column.
pub(super) fn base_pressure(run: &dyn Simulation<1>) -> f64 {
    run.pressure_nodes().iter().min_by(|a, b| a.0[0].total_cmp(&b.0[0])).map_or(f64::NAN, |(_, p)| *p)
}

/// Outflow of a run's water (m³, m² in plane strain, m in one dimension).
pub(super) fn outflow<const D: usize>(run: &dyn Simulation<D>) -> f64 {
    run.water().map_or(f64::NAN, |w| w.outflow)
}

/// |`volume` / outflow|.
pub(super) fn over_outflow<const D: usize>(run: &dyn Simulation<D>, volume: f64) -> f64 {
    run.water().map_or(f64::NAN, |w| (volume / w.outflow).abs())
}

/// An overshoot; zero where it is at most [`ROUNDING`].
pub(super) fn beyond_rounding(overshoot: f64) -> f64 {
    if overshoot > ROUNDING { overshoot } else { 0.0 }
}

/// Change of the volume and outflow together, over the outflow, at least [`ROUNDING`].
pub(super) fn mass_error<const D: usize>(run: &dyn Simulation<D>) -> f64 {
    above_rounding(over_outflow(run, run.water().map_or(f64::NAN, |w| w.imbalance)))
}
