//! Set-up and observation shared by several problems.

use super::parameters::{ALPHA, AUTO, CFL, DELTA, LUMPED, TIME_STEP, TOLERANCE, WALL, WALL_LINE};
use crate::prelude::*;
use mpm_core::basis::WallTreatment;
use mpm_core::explicit::Settings;
use mpm_core::implicit::{self, TimeRule};
use mpm_core::stage::LocalDamping;

impl<P: ParameterSet> Setup<P> {
    /// How B-splines meet walls, by the parameter `wall`.
    pub(super) fn wall_treatment(&self) -> WallTreatment {
        if self.values.is(WALL, WALL_LINE) { WallTreatment::WallLine } else { WallTreatment::OpenKnot }
    }

    /// Wall treatment and remedy of an explicit run that takes steps of `dt` (s), and local damping if there is any.
    pub(super) fn settings<const D: usize>(&self, dt: f64, damping: f64) -> Result<Settings<D>, Fault> {
        let settings = Settings::new(dt).wall(self.wall_treatment()).remedy(self.remedy().build());
        if damping > 0.0 { Ok(settings.filter_forces(LocalDamping::new(damping)?)) } else { Ok(settings) }
    }

    /// The discretisation in `dim` dimensions with `ppc` particles a cell and steps of `dt` (s).
    pub(super) fn discretisation(&self, dim: usize, ppc: usize, dt: f64) -> Discretisation {
        let wall = self.values.text(WALL);
        Discretisation {
            dim,
            h: self.h,
            ppc: ppc as u32,
            dt,
            wall: if wall.is_empty() { "open-knot".to_owned() } else { wall },
        }
    }

    /// Requires the defaults of the parameters with these `names`, which only another kind of solver has.
    pub(super) fn forbid(&self, names: &[&str]) -> Result<(), Error> {
        for p in P::list().into_iter().filter(|p| names.contains(&p.name)) {
            let (value, default) = (self.values.text(p), p.parse(p.default)?.to_string());
            if value != default {
                return Err(Error::Input(format!(
                    "{} = {value} has no meaning with the solver {}; allowed: {default}",
                    p.name,
                    self.scheme.solver()
                )));
            }
        }
        Ok(())
    }

    /// Requires a solver of bodies that move, and the defaults of all parameters that it does not use.
    pub(super) fn check_rule(&self) -> Result<(), Error> {
        let refused = |solver: &str| {
            let solvers = ["explicit", "midpoint", "newmark"];
            Err(Error::unknown("solver of bodies that move", solver, solvers))
        };
        const OF_EXPLICIT: [&str; 5] = ["wall", "flip", "relaxation", "hold", "time_step"];
        let foreign: Vec<&str> = match (self.scheme, self.rule()) {
            (Scheme::Poro(_), _) | (_, Some(RuleName::QuasiStatic)) => {
                return refused(self.scheme.solver());
            }
            (_, None) => vec!["step_factor", "lumped", "alpha", "delta", "tolerance"],
            (_, Some(RuleName::Midpoint)) => [&["alpha", "delta"], &OF_EXPLICIT[..]].concat(),
            (_, Some(RuleName::Newmark)) => [&["lumped"], &OF_EXPLICIT[..]].concat(),
        };
        self.forbid(&foreign)
    }

    /// Settings of an implicit run with steps of `dt` (s), with the tolerance that the parameter sets, if there is
    /// one; nothing for another scheme.
    pub(super) fn implicit_settings(&self, dt: f64) -> Option<implicit::Settings> {
        let number = |p| self.number(p);
        let rule = match self.rule()? {
            RuleName::QuasiStatic => TimeRule::Static,
            RuleName::Midpoint => TimeRule::Midpoint { lumped: number(LUMPED) },
            RuleName::Newmark => TimeRule::Newmark { alpha: number(ALPHA), delta: number(DELTA) },
        };
        let (settings, tolerance) = (implicit::Settings::new(dt).rule(rule), number(TOLERANCE));
        Some(if tolerance.is_nan() { settings } else { implicit::Settings { tolerance, ..settings } })
    }

    /// The CFL number in `dimension` dimensions: the parameter, or, with `time_step=auto`, that of the step which is stable for
    /// any positions of particles, the smallest of which have a half size of `half_size` cells.
    pub(super) fn cfl_number(&self, dimension: usize, half_size: f64) -> Result<f64, Error> {
        let basis = self.basis();
        if !self.values.is(TIME_STEP, AUTO) {
            return Ok(self.number(CFL));
        }
        mpm_solvers::stable_cfl(basis, dimension, half_size).ok_or_else(|| {
            Error::Input(format!(
                "time_step = {AUTO} has no step for the basis {basis}, whose functions vanish with a slope; allowed: cfl"
            ))
        })
    }
}

/// Whether steps have ended well: a static one that has found no equilibrium leaves the body as it was.
pub(super) fn finds_equilibrium(step: Result<(), Fault>) -> Result<bool, Fault> {
    use mpm_core::Error::{Breakdown, NoConvergence, Singular};
    match step {
        Ok(()) => Ok(true),
        Err(NoConvergence { .. } | Singular { .. } | Breakdown { .. }) => Ok(false),
        Err(other) => Err(other),
    }
}

/// Displacement (m) along an axis, in seeding order.
pub(super) fn displacement(run: &dyn Simulation<2>, axis: usize) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.position[k][axis] - p.reference[k][axis])
}

/// Places (m) of the particles in seeding order.
pub(super) fn places(run: &dyn Simulation<2>) -> Vec<[f64; 2]> {
    let p = run.particles();
    p.seeded(|k| p.position[k])
}

/// Largest distance (m) between places and those before.
pub(super) fn farthest(before: &[[f64; 2]], now: &[[f64; 2]]) -> f64 {
    before.iter().zip(now).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max)
}

/// Mean normal stress (Pa) as it enters the forces and its average Π, in seeding order.
pub(super) fn mean_stress(run: &mut dyn Simulation<2>) -> (Vec<f64>, Vec<f64>) {
    let mean = run.field(Field::MeanStress);
    let averaged = run.field(Field::AveragedMeanStress);
    let p = run.particles();
    (p.seeded(|k| mean[k]), p.seeded(|k| averaged[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Parameters;
    use crate::record::fixture::spec;
    use crate::scheme::{BasisName, RemedyName};
    use crate::spec::Level;

    #[test]
    fn the_particle_that_moved_farthest_decides() {
        let moved = farthest(&[[0.0, 0.0], [1.0, 1.0]], &[[0.1, 0.0], [4.0, 5.0]]);
        assert!((moved - 5.0).abs() < 1e-12);
    }

    #[test]
    fn walls_are_open_knots_unless_the_parameter_says_otherwise() {
        let treatment = |set: &[&str]| {
            let scheme = Scheme::flip(BasisName::Gimp, RemedyName::None);
            let spec = spec(scheme, Level { name: "h1", h: 1.0 }, set);
            let values = Parameters::new(&[WALL], &spec.set).unwrap();
            Setup::<()>::of_spec(&spec, &values).unwrap().wall_treatment()
        };
        assert!(matches!(treatment(&[]), WallTreatment::OpenKnot));
        assert!(matches!(treatment(&["wall=wall-line"]), WallTreatment::WallLine));
    }
}
