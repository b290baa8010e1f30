//! What is seen of the excavation, load step by load step, then twenty times a second; and what follows from it: which
//! phase comes next.

use super::look;
use super::metrics as m;
use super::parameters::{
    ALL, BASE, CREST, FRICTION, FRICTIONAL, GRAVITY, LOAD_STEPS, STEP, UNIT_WEIGHT,
};
use super::reference::factors;
use super::scene::{
    GRAVITATION, Ground, HEIGHT, HELD_BASE, Phase, ROLLERS, begin, foot, rows, strength, timing,
};
use crate::cases::observe::{column, discretisation, forbid, position_columns, reference_columns};
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::{Column, Snapshot};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::{RuleName, Scheme};
use crate::spec::RunSpec;
use mpm_core::material::Strength;
use mpm_core::monitor::Convergence;
use mpm_core::{Field, Part, Reaction, Simulation};
use serde::{Deserialize, Serialize};

/// A particle that moves by this share of the height has left with what collapses.
const COLLAPSES: f64 = 0.1;
/// What has not come to rest grows by more than this from the middle of a phase to its end: at a steady speed by two.
const RESTS: f64 = 1.5;
/// Seconds from row to row at which the particles are kept, after the excavation.
const KEPT: [f64; 3] = [0.5, 1.0, 2.0];

/// Energies of the ground (J/m).
#[derive(Debug, Default, Clone, Copy, Serialize, Deserialize)]
struct Energies {
    stored: f64,
    dissipated: f64,
}

/// What has been seen of the ground.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    phase: Phase,
    /// Rows of this phase and of all.
    rows: u64,
    all: u64,
    /// Time (s) that ran in phases before this one.
    before: f64,
    /// Places (m) at the phase's start, and plastic strains at the last row, be it of the phase before, in seeding order.
    start: Vec<[f64; 2]>,
    flowed: Vec<f64>,
    /// Largest displacement (m) in the middle of this phase.
    halfway: f64,
    energies: Energies,
    carried: f64,
    stands: [Option<bool>; 2],
    uncut: Option<Uncut>,
    friction_ratio: f64,
    flow_least: f64,
    motion: Motion,
    handed_over: Option<f64>,
}

/// The extremes of a motion since it began (J/m; the momentum's error over that of the weight).
#[derive(Debug, Default, Clone, Copy, Serialize, Deserialize)]
struct Motion {
    momentum: f64,
    kinetic: f64,
    balance: f64,
    gain: f64,
    work: f64,
}

/// The whole slope under full gravity.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Uncut {
    ratios: [f64; 2],
    reaction_error: f64,
    side_error: f64,
    plastic_strain: f64,
    mass: f64,
}

/// A slope that is cut.
pub(super) struct Excavation {
    spec: RunSpec,
    parameters: Parameters,
    discretisation: Discretisation,
    ground: Ground,
    strength: Strength,
    steps_in_row: u64,
}

impl Excavation {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters don't make a scene; a parameter that has no meaning with the scheme, base or gravity is changed.
    pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Drive<2, Self>, Error> {
        let mut foreign = match spec.scheme {
            Scheme::Implicit(parts) => match parts.rule {
                RuleName::Midpoint => vec!["alpha", "delta"],
                RuleName::Newmark => vec!["lumped"],
                RuleName::QuasiStatic => vec!["alpha", "delta", "lumped", "cfl", "duration"],
            },
            Scheme::Explicit(_) | Scheme::Poro(_) => {
                let solvers = ["quasi-static", "midpoint", "newmark"];
                let kind = "solver of the excavation";
                return Err(Error::unknown(kind, spec.scheme.solver(), solvers));
            }
        };
        foreign.push("wall");
        if !parameters.is(BASE, FRICTIONAL) {
            foreign.push(FRICTION.name);
        }
        if parameters.is(GRAVITY, STEP) {
            foreign.push(LOAD_STEPS.name);
        }
        forbid(spec, parameters, &ALL, &foreign)?;
        let (dt, steps_in_row) = timing(spec.level.h, parameters)?;
        let excavation = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            discretisation: discretisation(2, spec, parameters, dt),
            ground: Ground::new(spec, parameters),
            strength: strength(parameters)?,
            steps_in_row,
        };
        let seen = Seen {
            phase: Phase::Gravity,
            rows: 0,
            all: 0,
            before: 0.0,
            start: Vec::new(),
            flowed: Vec::new(),
            halfway: 0.0,
            energies: Energies::default(),
            carried: 0.0,
            stands: [None; 2],
            uncut: None,
            friction_ratio: 0.0,
            flow_least: 0.0,
            motion: Motion::default(),
            handed_over: None,
        };
        Ok(Drive::new(excavation, seen)?)
    }

    fn is_static(&self) -> bool {
        self.spec.scheme.rule() == Some(RuleName::QuasiStatic)
    }

    fn has_friction(&self) -> bool {
        self.parameters.is(BASE, FRICTIONAL)
    }

    /// What the ground does to its base.
    fn base(&self, run: &dyn Simulation<2>) -> Reaction {
        run.on(if self.has_friction() {
            Part::Contact(0)
        } else {
            Part::Constraint(HELD_BASE)
        })
    }

    fn energies(&self, run: &mut dyn Simulation<2>) -> Energies {
        let strain = run.field(Field::PlasticStrain);
        let pairs = strain.iter().zip(&run.particles().reference_volume);
        Energies {
            dissipated: pairs.map(|(e, v)| v * self.strength.plastic_work(*e)).sum(),
            stored: run.totals().stored_energy,
        }
    }

    /// Distance (m) of the farthest particle's edge from the foot of the cut.
    fn run_out(&self, run: &dyn Simulation<2>) -> f64 {
        look::front(run) - foot(&self.parameters)
    }

    /// Begins a phase with the ground as it is.
    fn enter(
        &self,
        seen: &mut Seen,
        stage: &mut Stage<2>,
        phase: Phase,
    ) -> Result<(), mpm_core::Error> {
        if seen.phase.moves() {
            seen.before += stage.run.time();
        }
        let body = stage.run.body()?;
        (seen.phase, seen.rows) = (phase, 0);
        if phase == Phase::Over {
            return Ok(());
        }
        let before = look::stresses(stage.run.as_ref());
        stage.enter(self.scene(seen)?, Some(&body))?;
        let change = look::difference(&before, &look::stresses(stage.run.as_ref()));
        let scale = self.parameters.number(UNIT_WEIGHT) * HEIGHT;
        seen.handed_over = Some(seen.handed_over.unwrap_or(0.0).max(change / scale));
        seen.motion = Motion::default();
        self.note_start(seen, stage);
        Ok(())
    }

    fn note_start(&self, seen: &mut Seen, stage: &mut Stage<2>) {
        seen.energies = self.energies(stage.run.as_mut());
        let p = stage.run.particles();
        seen.start = p.seeded(|k| p.position[k]);
    }

    /// Steps through a row; false where there is no equilibrium, the ground being as it was before it was looked for.
    fn goes_on(&self, seen: &Seen, stage: &mut Stage<2>) -> Result<bool, mpm_core::Error> {
        if seen.phase.moves() {
            stage.steps(self.steps_in_row)?;
            return Ok(true);
        }
        match stage.steps(1) {
            Ok(()) => Ok(true),
            Err(
                mpm_core::Error::NoConvergence { .. }
                | mpm_core::Error::Singular { .. }
                | mpm_core::Error::Breakdown { .. },
            ) => Ok(false),
            Err(other) => Err(other),
        }
    }

    /// Whether the ground stands at the end of a phase, if that can be told: where it moves, a short time may not suffice.
    fn stands(&self, seen: &Seen, found: bool, moved: f64) -> Option<bool> {
        if !found || moved > COLLAPSES * HEIGHT {
            return Some(false);
        }
        (!seen.phase.moves() || moved <= RESTS * seen.halfway).then_some(true)
    }

    /// What comes after a row of this phase.
    fn next(&self, seen: &Seen, found: bool, moved: f64) -> Option<Phase> {
        let last = seen.rows == rows(seen.phase, &self.parameters);
        let stands = self.stands(seen, true, moved) == Some(true);
        let after = if self.is_static() {
            Phase::Cut
        } else {
            Phase::Collapse
        };
        match seen.phase {
            Phase::Gravity if !found && self.is_static() => Some(Phase::Over),
            Phase::Gravity if !found => Some(Phase::Settling),
            Phase::Gravity | Phase::Settling if last && !stands => Some(Phase::Over),
            Phase::Gravity | Phase::Settling => last.then_some(after),
            Phase::Cut | Phase::Collapse => last.then_some(Phase::Over),
            Phase::Over => None,
        }
    }

    /// Notes of the whole slope what is asked of it at rest.
    fn uncut(&self, stage: &mut Stage<2>) -> Uncut {
        let strain = stage.run.field(Field::PlasticStrain);
        let run = stage.run.as_ref();
        let convergence = run.convergence().cloned().unwrap_or_default();
        let number = |p| self.parameters.number(p);
        let weight = number(UNIT_WEIGHT) * HEIGHT * (number(CREST) + 0.5 * HEIGHT);
        let base = self.base(run).force;
        let sides = base[0] + run.on(Part::Constraint(ROLLERS)).force[0];
        Uncut {
            ratios: [convergence.force_ratio, convergence.energy_ratio],
            reaction_error: (-base[1] / weight - 1.0).abs(),
            side_error: sides.abs() / weight,
            plastic_strain: strain.iter().copied().fold(0.0, f64::max),
            mass: run.totals().mass,
        }
    }

    /// Notes what a row of motion says of energy and momentum.
    fn note_energy(&self, seen: &mut Seen, run: &mut dyn Simulation<2>) {
        let totals = run.totals();
        let sums = totals.accumulated;
        let now = self.energies(run);
        let taken = sums.lumping_loss + sums.damping;
        let balance = totals.kinetic_energy + sums.stress_work + taken - sums.load_work;
        let kept = now.stored - seen.energies.stored + now.dissipated - seen.energies.dissipated;
        // What the weight gave, less what the base took, is what there is.
        let given = totals.mass * GRAVITATION * run.time();
        let taken = self.base(run).impulse[1];
        let error = (totals.momentum[1] + given + taken).abs() / given;
        let gain = totals.kinetic_energy + kept - sums.load_work;
        let motion = &mut seen.motion;
        motion.momentum = motion.momentum.max(error);
        motion.balance = motion.balance.max(balance.abs());
        motion.gain = motion.gain.max(gain);
        motion.work = motion.work.max(sums.load_work.abs());
        motion.kinetic = motion.kinetic.max(totals.kinetic_energy);
    }
}

impl Watch<2> for Excavation {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        self.discretisation.clone()
    }

    fn scene(&self, seen: &Seen) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        begin(&self.spec, &self.parameters, &self.ground, seen.phase)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "phase (-)",
            "gravity (-)",
            "moved (m)",
            "front (m)",
            "plastic_strain (-)",
            "kinetic_energy (J/m)",
            "stored_energy (J/m)",
            "dissipated (J/m)",
            "stress_work (J/m)",
            "load_work (J/m)",
            "base_x (N/m)",
            "base_y (N/m)",
            "force_ratio (-)",
            "energy_ratio (-)",
            "residual (-)",
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<2>) -> Result<Vec<f64>, mpm_core::Error> {
        if seen.start.is_empty() {
            self.note_start(seen, stage);
        }
        let before = stage.run.work().newton_iterations;
        let found = self.goes_on(seen, stage)?;
        let iterations = stage.run.work().newton_iterations - before;
        seen.rows += 1;
        seen.all += 1;
        let phase = seen.phase;
        if phase == Phase::Gravity {
            seen.carried = stage.run.time();
        }
        if phase.moves() {
            self.note_energy(seen, stage.run.as_mut());
        }
        let strain = stage.run.field(Field::PlasticStrain);
        let run = stage.run.as_ref();
        let p = run.particles();
        let flowed = p.seeded(|k| strain[k]);
        let changes = flowed.iter().zip(&seen.flowed).map(|(a, b)| a - b);
        seen.flow_least = changes.fold(seen.flow_least, f64::min);
        seen.flowed = flowed;
        let moved = look::moved(&seen.start, run);
        let base = self.base(run).force;
        if self.has_friction() && base[1] < 0.0 {
            seen.friction_ratio = seen.friction_ratio.max(base[0].abs() / -base[1]);
        }
        let convergence: Convergence = run.convergence().cloned().unwrap_or_default();
        let totals = run.totals();
        let clock = if phase.moves() { run.time() } else { 0.0 };
        let values = vec![
            seen.before + clock,
            f64::from(phase as u8),
            if phase == Phase::Gravity {
                run.time()
            } else {
                1.0
            },
            moved,
            self.run_out(run),
            strain.iter().copied().fold(0.0, f64::max),
            totals.kinetic_energy,
            totals.stored_energy,
            self.energies(stage.run.as_mut()).dissipated,
            totals.accumulated.stress_work,
            totals.accumulated.load_work,
            base[0],
            base[1],
            convergence.force_ratio,
            convergence.energy_ratio,
            convergence.residuals.last().copied().unwrap_or(f64::NAN),
            iterations as f64,
            f64::from(convergence.parts),
        ];
        if seen.rows == rows(phase, &self.parameters) / 2 {
            seen.halfway = moved;
        }
        let next = self.next(seen, found, moved);
        if let Some(next) = next {
            let whole = phase.is_whole();
            let stands = self.stands(seen, found, moved);
            if next != Phase::Settling {
                seen.stands[usize::from(!whole)] = stands;
            }
            if whole && stands == Some(true) {
                seen.uncut = Some(self.uncut(stage));
            }
            self.enter(seen, stage, next)?;
        }
        Ok(values)
    }

    fn progress(&self, seen: &Seen, _: &Stage<2>) -> f64 {
        if seen.phase == Phase::Over {
            return 1.0;
        }
        let of = |phase| rows(phase, &self.parameters);
        let after = if self.is_static() {
            of(Phase::Cut)
        } else {
            of(Phase::Collapse)
        };
        let most = of(Phase::Gravity) + of(Phase::Settling) + after;
        seen.all as f64 / (most + 1) as f64
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<2>) -> Option<Snapshot> {
        let time = stage.run.time();
        let near = |kept: &f64| (time - kept).abs() < 1e-6;
        if !seen.phase.moves() || !KEPT.iter().any(near) {
            return None;
        }
        let columns = self.particles(seen, stage);
        Some(Snapshot {
            time: seen.before + time,
            columns,
        })
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<2>) -> Vec<Column> {
        let strain = stage.run.field(Field::PlasticStrain);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend(reference_columns(p));
        columns.push(column("plastic_strain", "-", p.seeded(|k| strain[k])));
        columns.push(column(
            "mean_stress",
            "Pa",
            p.seeded(|k| p.stress[k].mean()),
        ));
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<2>) -> Vec<(Metric, f64)> {
        let [uncut, cut, residual] = factors(&self.parameters);
        let truth = |stands: Option<bool>| stands.map_or(f64::NAN, |s| f64::from(u8::from(s)));
        let softened = look::softened(&self.parameters, stage.run.as_mut());
        let now = self.energies(stage.run.as_mut());
        let run = stage.run.as_ref();
        let of = |f: fn(&Uncut) -> f64| seen.uncut.as_ref().map_or(f64::NAN, f);
        let work = run.totals().accumulated.load_work;
        let mut values = vec![
            (m::FACTOR_UNCUT, uncut.0),
            (m::FACTOR_CUT, cut.0),
            (m::FACTOR_CUT_RESIDUAL, residual.0),
            (m::GRAVITY_CARRIED, seen.carried),
            (m::STANDS_UNCUT, truth(seen.stands[0])),
            (m::STANDS_CUT, truth(seen.stands[1])),
            (m::FORCE_RATIO_UNCUT, of(|u| u.ratios[0])),
            (m::ENERGY_RATIO_UNCUT, of(|u| u.ratios[1])),
            (m::REACTION_ERROR, of(|u| u.reaction_error)),
            (m::SIDE_ERROR, of(|u| u.side_error)),
            (m::PLASTIC_STRAIN_UNCUT, of(|u| u.plastic_strain)),
            (m::MASS, of(|u| u.mass)),
            (m::FLOW_LEAST, seen.flow_least),
            (
                m::PLASTIC_STRAIN_END,
                seen.flowed.iter().copied().fold(0.0, f64::max),
            ),
            (m::MOVED_CUT, look::moved(&seen.start, run)),
            (m::RUNOUT_END, self.run_out(run)),
            (m::CREST_DROP, look::crest_drop(&seen.start, run)),
            (m::NEWTON_ITERATIONS, stage.work().newton_iterations as f64),
        ];
        if softened > 0.0 {
            values.extend([
                (m::SOFTENED_END, softened),
                (m::BAND_WIDTH, softened / cut.1),
            ]);
        }
        values.extend(seen.handed_over.map(|change| (m::HANDED_OVER, change)));
        if self.has_friction() {
            values.push((m::FRICTION_RATIO, seen.friction_ratio));
        }
        if seen.motion.work > 0.0 {
            values.extend([
                (m::KINETIC_PEAK, seen.motion.kinetic),
                (m::KINETIC_END, run.totals().kinetic_energy / work.abs()),
                (m::DISSIPATED, now.dissipated - seen.energies.dissipated),
                (m::LOAD_WORK, work),
                (m::BALANCE_ERROR, seen.motion.balance / seen.motion.work),
                (m::MOMENTUM_ERROR, seen.motion.momentum),
                (m::ENERGY_GAIN, seen.motion.gain / seen.motion.work),
            ]);
        }
        values
    }
}
