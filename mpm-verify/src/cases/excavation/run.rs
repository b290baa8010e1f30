//! Observations of the excavation, load step by load step, then twenty times a second, and the order of its stages.

use super::scene::{GRAVITATION, HELD_BASE, ROLLERS, Stage};
use super::*;
use mpm_core::Reaction;

/// A particle that moves by this share of the height has left with what collapses.
const COLLAPSES: f64 = 0.1;
/// Ground that has not come to rest moves by more than this from the middle of a stage to its end: at a steady speed by two.
const RESTS: f64 = 1.5;
/// Times (s) of the snapshots, after the excavation.
const KEPT: [f64; 3] = [0.5, 1.0, 2.0];

impl Setup<Excavation> {
    fn reaction(&self, run: &dyn Simulation<2>) -> Reaction {
        run.on(if self.slides() { Part::Contact(0) } else { Part::Constraint(HELD_BASE) })
    }

    /// Distance (m) of the farthest particle's edge from the foot of the cut.
    fn run_out(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let farthest = p.position.iter().map(|x| x[0]).fold(0.0, f64::max);
        farthest + p.half_size[0] - self.foot()
    }

    /// Area (m²) whose strength is residual; none where strength does not fall.
    fn softened(&self, run: &mut dyn Simulation<2>) -> f64 {
        if self.peak == self.residual {
            return 0.0;
        }
        let end = (self.peak - self.residual) / self.softening;
        let strain = run.field(Field::PlasticStrain);
        strain.iter().zip(&run.particles().volume).filter(|(e, _)| **e >= end).map(|(_, v)| v).sum()
    }

    /// Largest ‖J dev σ‖ of a particle over its strength, less one.
    fn yield_excess(&self, run: &dyn Simulation<2>, strain: &[f64]) -> f64 {
        let p = run.particles();
        let volume = if p.j_bar.is_empty() { &p.jacobian } else { &p.j_bar };
        let excess = (0..p.len()).map(|k| {
            let strength = SQRT_2 * (self.peak - self.softening * strain[k]).max(self.residual);
            volume[k] * p.stress[k].deviator().norm() / strength - 1.0
        });
        excess.fold(-1.0, f64::max)
    }

    /// Whether the ground stands at the end of a stage, if that is known: where it moves, a short time may not suffice.
    fn stands(&self, seen: &Seen, found: bool, moved: f64) -> Option<bool> {
        if !found || moved > COLLAPSES * HEIGHT {
            return Some(false);
        }
        (!seen.stage.moves() || moved <= RESTS * seen.halfway).then_some(true)
    }

    fn next(&self, seen: &Seen, found: bool, moved: f64) -> Option<Stage> {
        let last = seen.rows == self.rows(seen.stage);
        let stands = self.stands(seen, true, moved) == Some(true);
        match seen.stage {
            Stage::Gravity if !found && self.is_static() => Some(Stage::Over),
            Stage::Gravity if !found => Some(Stage::Settling),
            Stage::Gravity | Stage::Settling if last && !stands => Some(Stage::Over),
            Stage::Gravity | Stage::Settling => last.then_some(self.after_the_cut()),
            Stage::Cut | Stage::Collapse => last.then_some(Stage::Over),
            Stage::Over => None,
        }
    }

    fn after_the_cut(&self) -> Stage {
        if self.is_static() { Stage::Cut } else { Stage::Collapse }
    }
}

/// Largest settlement (m), from the places `start`, of the crest's layer of particles.
fn crest_drop(start: &[[f64; 2]], run: &dyn Simulation<2>) -> f64 {
    let p = run.particles();
    let now = p.seeded(|k| p.position[k][1]);
    let first = p.seeded(|k| p.reference[k][1]);
    let top = HEIGHT - 2.0 * p.half_size[1];
    start.iter().zip(&now).zip(&first).filter(|(_, y)| **y > top).map(|((a, b), _)| a[1] - b).fold(0.0, f64::max)
}

/// Stresses (Pa) in seeding order.
fn stresses(run: &dyn Simulation<2>) -> Vec<[f64; 4]> {
    let p = run.particles();
    p.seeded(|k| {
        let s = p.stress[k];
        [s.xx, s.yy, s.zz, s.xy]
    })
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

#[derive(Debug, Default, Clone, Serialize, Deserialize)]
pub(super) struct Seen {
    stage: Stage,
    /// Rows of this stage and of all.
    rows: u64,
    all: u64,
    /// Time (s) that ran in stages before this one.
    before: f64,
    /// Places (m) at the start of the stage, and plastic strains at the last row, in seeding order.
    start: Vec<[f64; 2]>,
    flowed: Vec<f64>,
    /// Largest displacement (m) in the middle of this stage.
    halfway: f64,
    /// Stored and dissipated energy (J/m) at the start of the stage.
    energies: [f64; 2],
    carried: f64,
    stands: [Option<bool>; 2],
    /// Values of [`OF_UNCUT`].
    uncut: Option<[f64; 6]>,
    friction_ratio: f64,
    flow_least: f64,
    yield_excess: Option<f64>,
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

/// Metrics of the whole slope at rest.
const OF_UNCUT: [Metric; 6] =
    [FORCE_RATIO_UNCUT, ENERGY_RATIO_UNCUT, REACTION_ERROR, SIDE_ERROR, PLASTIC_STRAIN_UNCUT, MASS];

impl Ground {
    /// Stored and dissipated energy (J/m).
    fn energies(&self, run: &mut dyn Simulation<2>) -> [f64; 2] {
        let strain = run.field(Field::PlasticStrain);
        let pairs = strain.iter().zip(&run.particles().reference_volume);
        [run.totals().stored_energy, pairs.map(|(e, v)| v * self.strength.plastic_work(*e)).sum()]
    }

    fn enter(&self, seen: &mut Seen, phase: &mut Phase<2>, stage: Stage) -> Result<(), Fault> {
        if seen.stage.moves() {
            seen.before += phase.run.time();
        }
        let body = phase.run.body()?;
        (seen.stage, seen.rows) = (stage, 0);
        if stage == Stage::Over {
            return Ok(());
        }
        let before = stresses(phase.run.as_ref());
        phase.enter(self.begin(seen)?, Some(&body))?;
        // Those of particles that are taken away come last.
        let pairs = before.as_flattened().iter().zip(stresses(phase.run.as_ref()).into_flattened());
        let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let scale = self.setup.unit_weight * HEIGHT;
        seen.handed_over = Some(seen.handed_over.unwrap_or(0.0).max(change / scale));
        seen.motion = Motion::default();
        self.note_start(seen, phase);
        Ok(())
    }

    fn note_start(&self, seen: &mut Seen, phase: &mut Phase<2>) {
        seen.energies = self.energies(phase.run.as_mut());
        seen.start = places(phase.run.as_ref());
    }

    /// Values of [`OF_UNCUT`].
    fn uncut(&self, run: &mut dyn Simulation<2>) -> [f64; 6] {
        let strain = run.field(Field::PlasticStrain);
        let convergence = run.convergence().cloned().unwrap_or_default();
        let weight = self.setup.unit_weight * HEIGHT * (self.setup.crest + 0.5 * HEIGHT);
        let base = self.setup.reaction(run).force;
        let sides = base[0] + run.on(Part::Constraint(ROLLERS)).force[0];
        let [reaction, sides] = [(-base[1] / weight - 1.0).abs(), sides.abs() / weight];
        let ratios = (convergence.force_ratio, convergence.energy_ratio);
        [ratios.0, ratios.1, reaction, sides, largest(&strain), run.totals().mass]
    }

    /// Notes the errors of energy and momentum of a row of motion.
    fn note_energy(&self, seen: &mut Seen, run: &mut dyn Simulation<2>) {
        let totals = run.totals();
        let sums = totals.accumulated;
        let ([stored, dissipated], [had, lost]) = (self.energies(run), seen.energies);
        let taken = sums.lumping_loss + sums.damping;
        let balance = totals.kinetic_energy + sums.stress_work + taken - sums.load_work;
        let kept = stored - had + dissipated - lost;
        // The impulse of the weight, less that of the base, is the momentum.
        let given = totals.mass * GRAVITATION * run.time();
        let taken = self.setup.reaction(run).impulse[1];
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

impl Problem<2> for Ground {
    type Parameters = Excavation;
    type Seen = Seen;

    fn new(setup: Setup<Excavation>) -> Result<Self, Error> {
        Self::of(setup)
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    fn begin(&self, seen: &Seen) -> Begun<2> {
        self.simulation(seen.stage)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        if seen.start.is_empty() {
            self.note_start(seen, phase);
        }
        let before = phase.run.work().newton_iterations;
        // Without an equilibrium the ground is as it was before the row.
        let found = match seen.stage.moves() {
            true => phase.steps(self.steps_in_row).map(|()| true)?,
            false => finds_equilibrium(phase.steps(1))?,
        };
        let iterations = phase.run.work().newton_iterations - before;
        seen.rows += 1;
        seen.all += 1;
        let stage = seen.stage;
        if stage == Stage::Gravity {
            seen.carried = phase.run.time();
        }
        if stage.moves() {
            self.note_energy(seen, phase.run.as_mut());
        }
        let strain = phase.run.field(Field::PlasticStrain);
        let [_, dissipated] = self.energies(phase.run.as_mut());
        let run = phase.run.as_ref();
        let flowed = run.particles().seeded(|k| strain[k]);
        seen.flow_least = flowed.iter().zip(&seen.flowed).map(|(a, b)| a - b).fold(seen.flow_least, f64::min);
        seen.flowed = flowed;
        let excess = self.setup.yield_excess(run, &strain);
        seen.yield_excess = Some(seen.yield_excess.map_or(excess, |most| most.max(excess)));
        let moved = farthest(&seen.start, &places(run));
        let base = self.setup.reaction(run).force;
        if self.setup.slides() && base[1] < 0.0 {
            seen.friction_ratio = seen.friction_ratio.max(base[0].abs() / -base[1]);
        }
        let convergence = run.convergence().cloned().unwrap_or_default();
        let totals = run.totals();
        let clock = if stage.moves() { run.time() } else { 0.0 };
        let gravity = if stage == Stage::Gravity { run.time() } else { 1.0 };
        let row = row! {
            "time (s)": seen.before + clock,
            "phase (-)": f64::from(stage as u8),
            "gravity (-)": gravity,
            "moved (m)": moved,
            "front (m)": self.setup.run_out(run),
            "plastic_strain (-)": largest(&strain),
            "kinetic_energy (J/m)": totals.kinetic_energy,
            "stored_energy (J/m)": totals.stored_energy,
            "dissipated (J/m)": dissipated,
            "stress_work (J/m)": totals.accumulated.stress_work,
            "load_work (J/m)": totals.accumulated.load_work,
            "base_x (N/m)": base[0],
            "base_y (N/m)": base[1],
            "force_ratio (-)": convergence.force_ratio,
            "energy_ratio (-)": convergence.energy_ratio,
            "residual (-)": convergence.residuals.last().copied().unwrap_or(f64::NAN),
            "newton_iterations (-)": iterations as f64,
            "parts (-)": f64::from(convergence.parts),
        };
        if seen.rows == self.setup.rows(stage) / 2 {
            seen.halfway = moved;
        }
        if let Some(next) = self.setup.next(seen, found, moved) {
            let stands = self.setup.stands(seen, found, moved);
            if next != Stage::Settling {
                seen.stands[usize::from(!stage.is_whole())] = stands;
            }
            if stage.is_whole() && stands == Some(true) {
                seen.uncut = Some(self.uncut(phase.run.as_mut()));
            }
            self.enter(seen, phase, next)?;
        }
        Ok(row)
    }

    fn progress(&self, seen: &Seen, _: &Phase<2>) -> f64 {
        if seen.stage == Stage::Over {
            return 1.0;
        }
        let stages = [Stage::Gravity, Stage::Settling, self.setup.after_the_cut()];
        let most: u64 = stages.iter().map(|stage| self.setup.rows(*stage)).sum();
        seen.all as f64 / (most + 1) as f64
    }

    fn snapshot(&self, seen: &Seen, phase: &mut Phase<2>) -> Option<Snapshot> {
        let time = phase.run.time();
        (seen.stage.moves() && KEPT.iter().any(|kept| (time - kept).abs() < 1e-6))
            .then(|| self.snapshot_at(seen.before + time, seen, phase))
    }

    fn particles<'a>(&self, _: &Seen, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns
            .references()
            .field("plastic_strain", "-", Field::PlasticStrain)
            .each("mean_stress", "Pa", |p, k| p.stress[k].mean())
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let (cut, peak, residual) = (self.setup.cut, self.setup.peak, self.setup.residual);
        let (factor_cut, length) = self.setup.factor(cut, peak);
        let truth = |stands: Option<bool>| stands.map_or(f64::NAN, |s| f64::from(u8::from(s)));
        let softened = self.setup.softened(phase.run.as_mut());
        let [_, dissipated] = self.energies(phase.run.as_mut());
        let run = phase.run.as_ref();
        let work = run.totals().accumulated.load_work;
        let mut values = vec![
            (FACTOR_UNCUT, self.setup.factor(0.0, peak).0),
            (FACTOR_CUT, factor_cut),
            (FACTOR_CUT_RESIDUAL, self.setup.factor(cut, residual).0),
            (GRAVITY_CARRIED, seen.carried),
            (STANDS_UNCUT, truth(seen.stands[0])),
            (STANDS_CUT, truth(seen.stands[1])),
            (FLOW_LEAST, seen.flow_least),
            (PLASTIC_STRAIN_END, largest(&seen.flowed)),
            (MOVED_CUT, farthest(&seen.start, &places(run))),
            (RUNOUT_END, self.setup.run_out(run)),
            (CREST_DROP, crest_drop(&seen.start, run)),
            (NEWTON_ITERATIONS, phase.work().newton_iterations as f64),
        ];
        values.extend(OF_UNCUT.into_iter().zip(seen.uncut.unwrap_or([f64::NAN; 6])));
        if softened > 0.0 {
            values.extend([(SOFTENED_END, softened), (BAND_WIDTH, softened / length)]);
        }
        // Ground that was never loaded says nothing.
        let loaded = seen.yield_excess.filter(|most| self.setup.law == LawName::Hencky && *most > -1.0);
        values.extend(loaded.map(|most| (YIELD_EXCESS, most)));
        values.extend(seen.handed_over.map(|change| (HANDED_OVER, change)));
        if self.setup.slides() {
            values.push((FRICTION_RATIO, seen.friction_ratio));
        }
        if seen.motion.work > 0.0 {
            let exchanged = seen.motion.work.max(seen.energies[0]);
            values.extend([
                (KINETIC_PEAK, seen.motion.kinetic),
                (KINETIC_END, run.totals().kinetic_energy / work.abs()),
                (DISSIPATED, dissipated - seen.energies[1]),
                (LOAD_WORK, work),
                (BALANCE_ERROR, seen.motion.balance / exchanged),
                (MOMENTUM_ERROR, seen.motion.momentum),
                (ENERGY_GAIN, seen.motion.gain / exchanged),
            ]);
        }
        values
    }
}
