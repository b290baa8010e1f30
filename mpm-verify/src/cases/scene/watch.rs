//! Observation of a scene's run: phase by phase, row by row.

use super::balance::Balance;
use super::body::moved;
use super::form::SupportForm;
use super::phase::Phase;
use super::setup::Setup as Made;
use super::{Measure, lasting};
use crate::cases::prelude::*;
use crate::problem;
use crate::statistics::checkerboard;
use mpm_core::SymmetricTensor;
use mpm_core::basis::WallTreatment;

metrics! { pub(in crate::cases) ALL:
    MASS = "mass", "kg", "mass of the body";
    MOST_MOVED = "displacement_max", "m", "largest displacement of a particle";
    KINETIC = "kinetic_energy", "J", "kinetic energy at the end";
    RUNOUT = "runout", "m", "greatest horizontal displacement of a particle";
    RUNOUT_BULK = "runout_bulk", "m", "horizontal displacement that a hundredth of the particles exceed";
    SPEED = "speed_max", "m/s", "greatest speed of a particle at the end";
    SETTLEMENT = "settlement", "m", "greatest downward displacement of a particle";
    J_MIN = "jacobian_min", "-", "least J of a particle";
    J_MAX = "jacobian_max", "-", "greatest J of a particle";
    VOLUME = "volume_change_max", "-", "largest |J − 1| of a particle of a nearly incompressible body";
    MOMENTUM = "momentum_gap", "-", "momentum that nothing gave, over the rounding of what passed";
    ENERGY = "energy_gain", "-", "kinetic energy that nothing gave, over the rounding of what was moved";
    STRESS_MIN = "mean_stress_least", "Pa", "least mean normal stress of a particle, tension positive";
    STRESS_MAX = "mean_stress_greatest", "Pa", "greatest mean normal stress of a particle";
    BOARD = "mean_stress_oscillation", "Pa", "rms over particles of the mean stress less its average in the cells";
    PLASTIC = "plastic_strain_max", "-", "largest equivalent plastic strain of a particle";
}

/// A unit in `dimension` dimensions: in the plane masses, energies and forces are per metre of depth.
fn per_depth(unit: &'static str, dimension: usize) -> &'static str {
    match (unit, dimension) {
        ("kg", 2) => "kg/m",
        ("J", 2) => "J/m",
        ("N", 2) => "N/m",
        (unit, _) => unit,
    }
}

/// Most charts of a run's history.
const CHARTS: usize = 6;

/// The metrics of a scene in `dimension` dimensions.
pub(super) fn metrics_in(dimension: usize) -> Vec<Metric> {
    let of = |m: &Metric| Metric { unit: per_depth(m.unit, dimension), ..*m };
    ALL.iter().map(of).collect()
}

/// Observed state of a run.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// The phase, and its rows so far.
    phase: usize,
    row: usize,
    /// Rows of all phases.
    rows: usize,
    /// Time (s) of the phases before.
    before: f64,
    /// Impulses (N s) on the parts at the last row.
    impulses: Vec<[f64; 3]>,
    balance: Balance,
    /// The last row of every phase.
    ends: Vec<Vec<f64>>,
}

/// A run of a scene file.
pub(super) struct Course<const D: usize> {
    setup: Setup<Made<D>>,
    /// Names of all parts, and of the columns.
    parts: Vec<String>,
    columns: Vec<&'static str>,
    /// The measures that a case takes.
    measure: Option<Measure>,
}

impl<const D: usize> Course<D> {
    /// The same, of which a case measures something.
    pub(super) fn measured(self, measure: Measure) -> Self {
        Self { measure: Some(measure), ..self }
    }

    fn phase(&self, seen: &Seen) -> &Phase {
        &self.setup.phases[seen.phase.min(self.setup.phases.len() - 1)]
    }

    /// Rows of all phases.
    fn whole(&self) -> usize {
        self.setup.phases.iter().map(Phase::rows).sum()
    }

    fn named(&self, row: Vec<f64>) -> Row {
        Row(self.columns.iter().copied().zip(row).collect())
    }

    /// Mean force (N) over the last row on every part of the scene, in all phases' order; zero on one that a phase has not.
    fn forces(&self, seen: &mut Seen, run: &dyn Simulation<D>) -> Vec<f64> {
        let phase = self.phase(seen);
        let duration = phase.steps_of(seen.row - 1) as f64 * phase.dt;
        let here = self.setup.parts(&phase.name);
        let mut forces = Vec::new();
        for (k, name) in self.parts.iter().enumerate() {
            let place = |names: &[&str]| names.iter().position(|n| n == name);
            let kinds: [fn(usize) -> Part; 3] = [Part::Constraint, Part::Contact, Part::Body];
            let part = here.iter().zip(kinds).find_map(|(names, kind)| place(names).map(kind));
            let on = part.map(|part| run.on(part)).unwrap_or_default();
            let explicit = self.setup.is_explicit();
            let now = if explicit { on.impulse } else { on.force.map(|f| f * duration) };
            let before = std::mem::replace(&mut seen.impulses[k], now);
            forces.extend((0..D).map(|a| (now[a] - if explicit { before[a] } else { 0.0 }) / duration));
        }
        forces
    }
}

/// Columns that a reader should see first: displacement, kinetic energy of a scheme that has it, and forces: on nodes that
/// push, along their way, on others upright.
pub(super) fn watched<const D: usize>(setup: &Made<D>) -> Vec<&'static str> {
    let pushed = |name: &str| {
        setup.form.supports.iter().find_map(|support| match support.get_ref() {
            SupportForm::Nodes { name: own, velocity_m_s, .. } if own.0 == name => {
                velocity_m_s.iter().find(|(_, speed)| speed.0 != 0.0).map(|(axis, _)| *axis as usize)
            }
            _ => None,
        })
    };
    let mut all = vec!["displacement_max"];
    all.extend(matches!(setup.scheme, Scheme::Explicit(_)).then_some("kinetic_energy"));
    for name in setup.phases.iter().flat_map(|phase| setup.parts(&phase.name)).flatten() {
        let axis = pushed(name).unwrap_or_else(|| setup.up());
        let column = format!("{name}_{}", ["x", "y", "z"][axis]);
        if all.len() < CHARTS && !all.contains(&&*column) {
            all.push(lasting(column));
        }
    }
    all
}

/// Names of the columns, which live as long as the program: a scene is read once in it.
fn columns<const D: usize>(scheme: Scheme, parts: &[String], bodies: &[&str]) -> Vec<&'static str> {
    let [energy, force, volume] = ["J", "N", "m³"].map(|unit| per_depth(unit, D));
    let mut all = vec![
        "time (s)",
        lasting(format!("kinetic_energy ({energy})")),
        lasting(format!("stored_energy ({energy})")),
        "displacement_max (m)",
    ];
    match scheme {
        Scheme::Explicit(_) => {}
        Scheme::Implicit(_) => all.push("newton_iterations (-)"),
        Scheme::Poro(_) => all.extend(["newton_iterations (-)", lasting(format!("outflow ({volume})"))]),
    }
    for name in parts {
        for axis in ["x", "y", "z"].into_iter().take(D) {
            all.push(lasting(format!("{name}_{axis} ({force})")));
        }
    }
    for name in bodies {
        all.extend(["x", "y", "z"].into_iter().take(D).map(|axis| lasting(format!("{name}_moved_{axis} (m)"))));
    }
    all
}

/// Greatest horizontal displacement of a particle, that which a hundredth of them exceed, and greatest settlement (m); not a
/// number along a line, which has no horizontal.
fn runout<const D: usize>(run: &dyn Simulation<D>, up: usize) -> [f64; 3] {
    let p = run.particles();
    let ways =
        p.position.iter().zip(&p.reference).map(|(x, from)| std::array::from_fn::<f64, D, _>(|a| x[a] - from[a]));
    let settled = ways.clone().map(|way| -way[up]).fold(f64::NEG_INFINITY, f64::max);
    let sideways = |way: [f64; D]| (0..D).filter(|a| *a != up).map(|a| way[a] * way[a]).sum::<f64>().sqrt();
    let mut sideways: Vec<f64> = ways.map(sideways).collect();
    let (_, bulk, outer) = sideways.select_nth_unstable_by(p.len() - 1 - p.len() / 100, f64::total_cmp);
    let bulk = *bulk;
    let outer = outer.iter().copied().fold(bulk, f64::max);
    if D == 1 { [f64::NAN, f64::NAN, settled] } else { [outer, bulk, settled] }
}

/// The largest displacement (m).
fn most_moved<const D: usize>(run: &dyn Simulation<D>) -> f64 {
    let p = run.particles();
    let pairs = p.position.iter().zip(&p.reference);
    let squares = pairs.map(|(x, from)| x.iter().zip(from).map(|(x, from)| (x - from) * (x - from)).sum::<f64>());
    squares.fold(0.0, f64::max).sqrt()
}

impl<const D: usize> Problem<D> for Course<D> {
    type Parameters = Made<D>;
    type Seen = Seen;

    fn new(setup: Setup<Made<D>>) -> Result<Self, Error> {
        let mut parts: Vec<String> = Vec::new();
        for phase in &setup.phases {
            for name in setup.parts(&phase.name).concat() {
                if parts.iter().all(|known| known != name) {
                    parts.push(name.to_owned());
                }
            }
        }
        let columns = columns::<D>(setup.scheme, &parts, &setup.several());
        Ok(Self { setup, parts, columns, measure: None })
    }

    fn discretisation(&self) -> Discretisation {
        let wall = match self.setup.walls() {
            WallTreatment::OpenKnot => "open-knot",
            WallTreatment::WallLine => "wall-line",
        };
        Discretisation {
            dim: D,
            h: self.setup.grid.h,
            ppc: self.setup.per_cell(),
            dt: self.setup.phases[0].dt,
            wall: wall.to_owned(),
        }
    }

    fn begin(&self, seen: &Seen) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        if seen.phase == 0 { self.setup.begin() } else { self.setup.solve(self.phase(seen)) }
    }

    fn row(&self, seen: &mut Seen, phase: &mut problem::Phase<D>) -> Result<Row, mpm_core::Error> {
        if seen.row == self.phase(seen).rows() {
            let body = phase.run.body()?;
            seen.before += phase.run.time();
            (seen.phase, seen.row) = (seen.phase + 1, 0);
            seen.impulses.clear();
            phase.enter(self.begin(seen)?, Some(&body))?;
        }
        seen.impulses.resize(self.parts.len(), [0.0; 3]);
        if seen.row == 0 {
            seen.balance.begin(phase.run.as_ref());
        }
        let iterations = phase.iterate(self.phase(seen).steps_of(seen.row))?;
        (seen.row, seen.rows) = (seen.row + 1, seen.rows + 1);
        let run = phase.run.as_ref();
        if seen.row == self.phase(seen).rows() {
            self.setup.balance(self.phase(seen), run, &mut seen.balance);
        }
        let totals = run.totals();
        let mut row = vec![seen.before + run.time(), totals.kinetic_energy, totals.stored_energy, most_moved(run)];
        if !self.setup.is_explicit() {
            row.push(iterations as f64);
        }
        row.extend(run.water().map(|water| water.outflow));
        row.extend(self.forces(seen, run));
        let bodies = run.scene().bodies.each.iter().take(self.setup.several().len());
        row.extend(bodies.flat_map(|body| moved(run.particles(), body)));
        if seen.row == self.phase(seen).rows() {
            seen.ends.push(row.clone());
        }
        Ok(self.named(row))
    }

    fn progress(&self, seen: &Seen, _: &problem::Phase<D>) -> f64 {
        seen.rows as f64 / self.whole() as f64
    }

    fn before(&self, seen: &Seen) -> (f64, String) {
        let (name, begun) = (&self.phase(seen).name, seen.before);
        (begun, format!("phase {name}, which began at {begun} s: "))
    }

    fn snapshot(&self, seen: &Seen, phase: &mut problem::Phase<D>) -> Option<Snapshot> {
        let every = self.setup.form.output.get_ref().snapshot_rows.as_ref()?.0 as usize;
        let time = seen.before + phase.run.time();
        let mut columns = || self.particles(seen, Columns::positions(phase.run.as_mut())).done();
        seen.rows.is_multiple_of(every).then(|| Snapshot { time, columns: columns() })
    }

    /// Without the velocities, which equilibrium lacks, and the fields that solver or law lacks.
    fn particles<'a>(&self, _: &Seen, mut columns: Columns<'a, D>) -> Columns<'a, D> {
        let (count, stress) = (columns.run().particles().len(), columns.run().force_stress());
        columns = columns.axes(["displacement_x", "displacement_y", "displacement_z"], "m", |p, k| {
            std::array::from_fn(|a| p.position[k][a] - p.reference[k][a])
        });
        if !columns.run().particles().velocity.is_empty() {
            columns = columns.axes(["velocity_x", "velocity_y", "velocity_z"], "m/s", |p, k| p.velocity[k]);
        }
        for (name, unit, field) in [
            ("mean_stress", "Pa", Field::MeanStress),
            ("mean_stress_averaged", "Pa", Field::AveragedMeanStress),
            ("plastic_strain", "-", Field::PlasticStrain),
            ("pore_pressure", "Pa", Field::PorePressure),
        ] {
            if columns.run().field(field).len() == count {
                columns = columns.field(name, unit, field);
            }
        }
        type Part = (&'static str, fn(&SymmetricTensor) -> f64);
        let parts: [Part; 7] = [
            ("stress_xx", |s| s.xx),
            ("stress_yy", |s| s.yy),
            ("stress_zz", |s| s.zz),
            ("stress_xy", |s| s.xy),
            ("stress_yz", |s| s.yz),
            ("stress_xz", |s| s.xz),
            ("von_mises_stress", |s| 1.5_f64.sqrt() * s.deviator().norm()),
        ];
        for (name, of) in parts.into_iter().filter(|(name, _)| D == 3 || !name.ends_with("z") || *name == "stress_zz") {
            columns = columns.each(name, "Pa", |_, k| of(&stress[k]));
        }
        let columns = columns.jacobian().each("volume", ["m", "m²", "m³"][D - 1], |p, k| p.volume[k]);
        let body = |id: u32| self.setup.ends.partition_point(|end| *end <= id as usize) as f64;
        columns.each("id", "-", |p, k| f64::from(p.id[k])).each("body", "-", |p, k| body(p.id[k]))
    }

    fn metrics(&self, seen: &Seen, phase: &mut problem::Phase<D>) -> Vec<(Metric, f64)> {
        let ends: Vec<Row> = seen.ends.iter().map(|row| self.named(row.clone())).collect();
        let particles = self.particles(seen, Columns::positions(phase.run.as_mut())).done();
        let measured = self.measure.iter().flat_map(|measure| measure(&ends, &particles));
        let run = phase.run.as_mut();
        let mean = run.field(Field::MeanStress);
        let averaged = run.field(Field::AveragedMeanStress);
        let plastic = run.field(Field::PlasticStrain);
        let most = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let totals = run.totals();
        let [outer, bulk, settlement] = runout(run, self.setup.up());
        let [momentum, energy] = self.setup.unbalanced();
        let speeds = run.particles().velocity.iter().map(|v| v.iter().map(|v| v * v).sum::<f64>().sqrt());
        // No number where equilibrium has no velocity.
        let speed = speeds.fold(f64::NAN, f64::max);
        let bodies = run.scene().bodies.each.iter().zip(self.setup.form.laws());
        let tight = bodies.filter(|(_, law)| law.get_ref().nearly_incompressible()).map(|(body, _)| body.range());
        let changes = tight.flat_map(|range| &run.particles().jacobian[range]).map(|j| (j - 1.0).abs());
        let volume = changes.fold(0.0, f64::max);
        let all = [
            (MASS, totals.mass),
            (MOST_MOVED, most_moved(run)),
            (KINETIC, totals.kinetic_energy),
            (RUNOUT, outer),
            (RUNOUT_BULK, bulk),
            (SPEED, speed),
            (SETTLEMENT, settlement),
            (J_MIN, totals.jacobian.0),
            (J_MAX, totals.jacobian.1),
            (VOLUME, volume),
            (MOMENTUM, if momentum.is_none() { seen.balance.momentum() } else { f64::NAN }),
            (ENERGY, if energy.is_none() { seen.balance.energy() } else { f64::NAN }),
            (STRESS_MIN, least(&mean)),
            (STRESS_MAX, most(&mean)),
            (BOARD, checkerboard(&mean, &averaged)),
            (PLASTIC, most(&plastic)),
        ];
        // A case is judged by what it measures itself, and by the energy.
        let kept = |metric: &Metric| self.measure.is_none() || *metric == ENERGY;
        let all = all.into_iter().filter(|(metric, value)| value.is_finite() && kept(metric));
        all.map(|(m, value)| (Metric { unit: per_depth(m.unit, D), ..m }, value)).chain(measured).collect()
    }
}
