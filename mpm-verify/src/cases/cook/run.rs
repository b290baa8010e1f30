//! Derived quantities, scene and observations of the membrane: on its way to rest, or load step by load step.

use super::probes::Probes;
use super::reference::{LEFT_HEIGHT, RIGHT_HEIGHT};
use super::*;
use crate::cases::observe::mean_stress;
use crate::statistics::Line;
use mpm_core::Memory;
use mpm_core::implicit::Settings;
use mpm_core::stage::{DeadForce, KineticDamping, Load, Observation, RestCriterion};

/// Particles on a side count as inside (m).
const ON_SIDE: f64 = 1e-9;
/// Room of the grid beyond the membrane (m): right, below, above.
const MARGIN: (f64, f64, f64) = (2.0, 2.0, 6.0);
/// Headroom (m) of a quasi-static run per load over Young's modulus.
const RISE: f64 = 20.0;
/// The fundamental period (s) at E = 70 Pa and ρ = 1 kg/m³, rounded; it scales as √(ρ/E).
const PERIOD_OF_DEFAULTS: f64 = 60.0;
/// Allowed load per metre of depth over Young's modulus (m).
const LOAD_OVER_MODULUS: RangeInclusive<f64> = 1e-7..=100.0;
/// Strain per period that counts as creep.
pub(super) const CREEP: f64 = 1e-4;
/// Observations per period.
const OBSERVATIONS: f64 = 240.0;
/// Criterion of rest: relative out-of-balance virtual work, kinetic over stored energy, relative
/// drift of the tip over the window.
const REST: (f64, f64, f64) = (1e-3, 1e-5, 1e-4);
/// Parameters of an explicit run only, and of a quasi-static run only.
const OF_EXPLICIT: [&str; 8] =
    ["load_ramp", "damping", "kinetic_damping", "cfl", "flip", "wall", "max_periods", "rest_window"];
const OF_QUASI_STATIC: [&str; 2] = ["load_steps", "ghost"];

/// Particles of a lattice of the given spacing that lie inside the membrane or on its sides.
fn seed(spacing: f64) -> Vec<[f64; 2]> {
    let lower = |x: f64| LEFT_HEIGHT * x / LENGTH;
    let upper = |x: f64| LEFT_HEIGHT + RIGHT_HEIGHT * x / LENGTH;
    let counts = [LENGTH, LEFT_HEIGHT + RIGHT_HEIGHT].map(|length| (length / spacing).round() as usize);
    by_columns(counts, spacing).filter(|[x, y]| *y >= lower(*x) - ON_SIDE && *y <= upper(*x) + ON_SIDE).collect()
}

impl Setup<Cook> {
    /// The fundamental period (s).
    fn period(&self) -> f64 {
        PERIOD_OF_DEFAULTS * (self.density * 70.0 / self.young_modulus).sqrt()
    }

    /// Duration of the growth of the load (s).
    fn ramp(&self) -> f64 {
        self.load_ramp * self.period()
    }

    fn law(&self) -> Result<NeoHookean, Fault> {
        NeoHookean::new(self.young_modulus, self.poisson_ratio)
    }

    fn particles(&self) -> Result<Particles<2>, Fault> {
        self.particles_at(seed(self.pitch()), self.pitch(), self.density)
    }

    /// The particles at their start, with the shares of the full load as their external forces.
    pub(super) fn loaded_particles(&self) -> Result<Particles<2>, Fault> {
        let mut particles = self.particles()?;
        for load in self.loads(0.0, &particles) {
            load.add(0.0, &mut particles);
        }
        Ok(particles)
    }

    /// The dead load, which grows over `ramp` (s): on the last column of particles, or on the last two with shares 3/2 and
    /// −1/2, whose resultant acts on the side itself.
    fn loads(&self, ramp: f64, particles: &Particles<2>) -> Vec<DeadForce<2>> {
        let spacing = self.pitch();
        let column = |share: f64, from_edge: f64| {
            DeadForce::shared([0.0, share * self.load], Amplitude::Rise(ramp), particles, |x| {
                (x[0] - (LENGTH - from_edge * spacing)).abs() < 0.25 * spacing
            })
        };
        match self.load_at {
            LoadAt::Column => vec![column(1.0, 0.5)],
            LoadAt::Edge => vec![column(1.5, 0.5), column(-0.5, 1.5)],
        }
    }

    /// The membrane, its clamp and its load, which grows over `ramp` (s), with this `headroom` (m) beyond the margin.
    fn scene(&self, ramp: f64, headroom: f64) -> Result<Scene<2>, Fault> {
        let h = self.h;
        let cells = |length: f64| (length / h).ceil() as usize;
        let (right, below, above) = MARGIN;
        let below = cells(below) as f64 * h;
        let along = Axis::bounded(0.0, cells(LENGTH + right), (Side::Wall, Side::Open));
        let up = Axis::open(-below, cells(below + LEFT_HEIGHT + RIGHT_HEIGHT + above + headroom));
        let particles = self.particles()?;
        let loads = self.loads(ramp, &particles);
        let scene =
            Scene::new(Grid::new(h, [along, up])?, Bodies::new(self.law()?, particles)?).constrain(clamp(0, End::Lo));
        Ok(loads.into_iter().fold(scene, Scene::load))
    }
}

pub(super) struct Membrane {
    setup: Setup<Cook>,
    probes: Probes,
    /// Time step (s); of a quasi-static run, whose time is the share of the steps, that share.
    dt: f64,
}

#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// The criterion of rest with its observations; none before the first row.
    rest: Option<Saved>,
    at_rest: bool,
    /// (time, rms ln(J/J̄)).
    gaps: Vec<(f64, f64)>,
    /// Largest gain and largest loss of energy that nothing accounts for (J/m).
    energy_defect: (f64, f64),
    work_residuals: Vec<f64>,
}

impl Seen {
    /// The growth of rms ln(J/J̄) over the second half of the `time` (s) so far.
    fn creep(&self, time: f64) -> Option<Line> {
        fit_line(&self.gaps.iter().copied().filter(|(t, _)| *t >= 0.5 * time).collect::<Vec<_>>())
    }
}

/// One step, and the out-of-balance virtual work in it: Σ m a·u over Σ f·u of the load. In a
/// linear body this is the relative error of the displacement under the load (Betti).
fn step_and_weigh(run: &mut dyn Simulation<2>, dt: f64) -> Result<f64, Fault> {
    let p = run.particles();
    let before = [0, 1].map(|a| p.seeded(|k| p.velocity[k][a]));
    run.step()?;
    let p = run.particles();
    let (mut imbalance, mut load) = (0.0, 0.0);
    for (k, id) in p.id.iter().enumerate() {
        for a in 0..2 {
            let u = p.position[k][a] - p.reference[k][a];
            let acceleration = (p.velocity[k][a] - before[a][*id as usize]) / dt;
            imbalance += p.mass[k] * acceleration * u;
            load += p.external_force[k][a] * u;
        }
    }
    Ok((imbalance / load).abs())
}

/// Energy (J/m) that nothing accounts for: gained, or, if negative, lost.
pub(super) fn energy_defect(kinetic: f64, stress_work: f64, losses: f64, load_work: f64) -> f64 {
    kinetic + stress_work + losses - load_work
}

impl Membrane {
    fn rest(&self, seen: &Seen) -> Result<RestCriterion, Fault> {
        let (force_ratio, energy_ratio, drift) = REST;
        let mut rest = RestCriterion::new(force_ratio, energy_ratio, drift, self.window());
        if let Some(saved) = &seen.rest {
            rest.restore(saved)?;
        }
        Ok(rest)
    }

    /// Window of the criterion of rest (s): with local damping at least a period, as its force on velocities of any sign holds a
    /// slow motion back like friction, and what is out of balance no longer tells how far rest is.
    fn window(&self) -> f64 {
        let least = if self.setup.damping > 0.0 { 1.0 } else { 0.0 };
        self.setup.rest_window.max(least) * self.setup.period()
    }

    /// Whether the run has shown, over a whole period, that it will never rest.
    fn creeps(&self, seen: &Seen, time: f64) -> bool {
        let period = self.setup.period();
        self.setup.remedy() == FbarRecursive
            && time >= period.max(2.0 * self.setup.ramp())
            && seen.creep(time).is_some_and(|line| line.slope * period > CREEP)
    }

    fn observe(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let mut rest = self.rest(seen)?;
        let steps = ((self.setup.period() / OBSERVATIONS / self.dt).round() as u64).max(1);
        phase.steps(steps - 1)?;
        let run = phase.run.as_mut();
        let mut work_residual = step_and_weigh(run, self.dt)?;
        if run.particles().velocity.iter().flatten().all(|v| *v == 0.0) {
            // Kinetic damping struck in this very step: weigh the next one.
            work_residual = step_and_weigh(run, self.dt)?;
        }
        let (totals, residual) = (run.totals(), run.residual());
        let (uy, time) = (displacement(run, 1), run.time());
        let tip = self.probes.tip.value(&uy);
        let rests = rest.observe(Observation {
            time,
            force_ratio: work_residual,
            energy_ratio: residual.kinetic_energy / totals.stored_energy,
            displacement: tip,
        });
        seen.rest = Some(rest.save()?);
        seen.at_rest = rests && time >= self.setup.ramp();
        seen.work_residuals.push(work_residual);
        seen.gaps.push((time, totals.log_jacobian_gap_rms));
        let work = totals.accumulated;
        let losses = work.damping + work.filter_loss + work.constraint_loss;
        let defect = energy_defect(totals.kinetic_energy, work.stress_work, losses, work.load_work);
        let (gain, loss) = seen.energy_defect;
        seen.energy_defect = (gain.max(defect), loss.max(-defect));
        Ok(row! {
            "time (s)": time,
            "tip_uy (m)": tip,
            "mid_edge_uy (m)": self.probes.mid_edge.value(&uy),
            "kinetic_energy (J/m)": totals.kinetic_energy,
            "nodal_kinetic_energy (J/m)": residual.kinetic_energy,
            "stored_energy (J/m)": totals.stored_energy,
            "stress_work (J/m)": work.stress_work,
            "load_work (J/m)": work.load_work,
            "damping_losses (J/m)": losses,
            "momentum_x (kg/s)": totals.momentum[0],
            "momentum_y (kg/s)": totals.momentum[1],
            "mass (kg/m)": totals.mass,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
            "log_jacobian_gap_rms (-)": totals.log_jacobian_gap_rms,
            "log_jacobian_gap_max (-)": totals.log_jacobian_gap_max,
            "work_residual (-)": work_residual,
            "free_force (N/m)": residual.free_force,
            "reaction_y (N/m)": -residual.held_force[1],
        })
    }

    fn press(&self, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let iterations = phase.iterate(1)?;
        let run = phase.run.as_ref();
        let (uy, totals) = (displacement(run, 1), run.totals());
        let convergence = run.convergence().cloned().unwrap_or_default();
        Ok(row! {
            "time (-)": run.time(),
            "tip_uy (m)": self.probes.tip.value(&uy),
            "mid_edge_uy (m)": self.probes.mid_edge.value(&uy),
            "stored_energy (J/m)": totals.stored_energy,
            "stress_work (J/m)": totals.accumulated.stress_work,
            "load_work (J/m)": totals.accumulated.load_work,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
            "log_jacobian_gap_rms (-)": totals.log_jacobian_gap_rms,
            "newton_iterations (-)": iterations as f64,
            "residual (-)": convergence.residuals.last().copied().unwrap_or(0.0),
            "parts (-)": f64::from(convergence.parts),
        })
    }

    fn of_motion(&self, seen: &Seen, run: &dyn Simulation<2>) -> Vec<(Metric, f64)> {
        let time = run.time();
        let creep = seen.creep(time);
        let residuals = &seen.work_residuals;
        let in_window = (self.window() / time * residuals.len() as f64) as usize;
        let last = &residuals[residuals.len().saturating_sub(in_window + 1)..];
        let load_work = run.totals().accumulated.load_work;
        vec![
            (CREEP_RATE, creep.map_or(f64::NAN, |l| l.slope)),
            (CREEP_LINEARITY, creep.map_or(f64::NAN, |l| l.r_squared)),
            (AT_REST, f64::from(u8::from(seen.at_rest))),
            (REST_TIME, time),
            (WORK_RESIDUAL, last.iter().copied().fold(0.0, f64::max)),
            (ENERGY_GAIN, seen.energy_defect.0 / load_work),
            (ENERGY_LOSS, seen.energy_defect.1 / load_work),
            (PERIOD, self.setup.period()),
        ]
    }
}

impl Problem<2> for Membrane {
    type Parameters = Cook;
    type Seen = Seen;

    fn new(setup: Setup<Cook>) -> Result<Self, Error> {
        let why = "m; below, rounding hides the answer";
        require_quotient("load / young_modulus", setup.load / setup.young_modulus, LOAD_OVER_MODULUS, why)?;
        let dt = if setup.is_explicit() {
            setup.forbid(&OF_QUASI_STATIC)?;
            for (name, periods) in [("rest_window", setup.rest_window), ("load_ramp", setup.load_ramp)] {
                if periods >= setup.max_periods {
                    let most = setup.max_periods;
                    return Err(Error::Input(format!("{name} = {periods} is not below max_periods = {most}")));
                }
            }
            courant_time_step(setup.cfl, setup.h, setup.law()?.wave_speed(setup.density))
        } else {
            setup.forbid(&OF_EXPLICIT)?;
            1.0 / f64::from(setup.load_steps)
        };
        Ok(Self { probes: Probes::new(setup.start_at(seed(setup.pitch())), setup.h)?, setup, dt })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    fn begin(&self, _: &Seen) -> Begun<2> {
        let setup = &self.setup;
        if setup.is_explicit() {
            let mut settings = setup.settings(self.dt, setup.damping)?.transfer(Flip::new(setup.flip)?);
            if setup.kinetic_damping {
                settings = settings.filter_particles(KineticDamping::default());
            }
            return mpm_solvers::solver(setup.scheme, setup.scene(setup.ramp(), 0.0)?, settings);
        }
        let settings = Settings::new(self.dt).stabilised(Stabilisation::ghost(setup.ghost));
        // The tip rises by 0.28 m a newton at first, and by less under larger loads.
        let strain = setup.load / setup.young_modulus;
        let headroom = (RISE * strain.abs()).max(MARGIN.2) - MARGIN.2;
        mpm_solvers::implicit(setup.scheme, setup.scene(1.0, headroom)?, settings)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        if self.setup.is_explicit() { self.observe(seen, phase) } else { self.press(phase) }
    }

    fn progress(&self, seen: &Seen, phase: &Phase<2>) -> f64 {
        if !self.setup.is_explicit() {
            return phase.share_of(self.setup.load_steps as u64);
        }
        let time = phase.run.time();
        if seen.at_rest || self.creeps(seen, time) {
            return 1.0;
        }
        let longest = self.setup.max_periods * self.setup.period();
        (time / longest).min(1.0)
    }

    fn particles<'a>(&self, _: &Seen, mut columns: Columns<'a, 2>) -> Columns<'a, 2> {
        let (mean_stress, averaged) = mean_stress(columns.run());
        columns
            .references()
            .displacements()
            .seeded("mean_stress", "Pa", mean_stress)
            .seeded("averaged_mean_stress", "Pa", averaged)
            .jacobian()
            .each("averaged_jacobian", "-", |p, k| p.j_bar.get(k).copied().unwrap_or(p.jacobian[k]))
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let (setup, run) = (&self.setup, phase.run.as_mut());
        let [ux, uy] = [0, 1].map(|axis| displacement(run, axis));
        let (mean_stress, averaged) = mean_stress(run);
        let board = checkerboard(&mean_stress, &averaged);
        let (totals, reaction) = (run.totals(), -run.residual().held_force[1]);
        let mut values = self.probes.of_displacement([&ux, &uy], setup);
        values.extend(self.probes.of_stress(&mean_stress, setup));
        values.extend([
            (CHECKERBOARD_RMS, board),
            (CHECKERBOARD_RATIO, board / rms(mean_stress.iter().copied())),
            (LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
            (REACTION_UY, reaction),
            (MASS, totals.mass),
            (SEEDED_VOLUME, totals.mass / setup.density),
        ]);
        if setup.is_explicit() {
            values.extend(self.of_motion(seen, run));
        } else {
            values.extend([
                (REACTION_ERROR, (reaction / setup.load + 1.0).abs().max(ROUNDING)),
                (NEWTON_ITERATIONS, run.work().newton_iterations as f64),
                (LINEAR_ITERATIONS, run.work().linear_iterations as f64),
            ]);
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::setup;

    #[test]
    fn the_papers_particle_counts_are_met_exactly() {
        assert_eq!([2.0, 1.0, 0.5, 0.25].map(|h| seed(0.5 * h).len()), [1448, 5776, 23_072, 92_224]);
    }

    #[test]
    fn the_edge_load_has_its_resultant_on_the_side() {
        for (name, arm) in [("edge", 48.0), ("column", 47.75)] {
            let (level, set) = (Level { name: "h1", h: 1.0 }, format!("load_at={name}"));
            let cook: Setup<Cook> = setup(Scheme::flip(Gimp, FbarConsistent), level, &[&set]);
            let particles = cook.loaded_particles().unwrap();
            let force: f64 = particles.external_force.iter().map(|f| f[1]).sum();
            let moment: f64 = particles.external_force.iter().zip(&particles.reference).map(|(f, x)| f[1] * x[0]).sum();
            assert!((force - 1.0).abs() < 1e-12);
            assert!((moment - arm).abs() < 1e-10);
        }
    }
}
