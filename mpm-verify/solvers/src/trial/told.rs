//! State of a simulation as columns: every quantity it can give, by dimension.

use mpm_core::{Axis, Field, Frame, Grid, Part, Particles, Reaction, Scene, Simulation};

/// Numbers of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// The exponents of pascal, metre and second in its unit.
    pub unit: [i32; 3],
    /// Whether each value is a sum over the body.
    pub summed: bool,
    /// The period (m) of each value that has one: of places on an axis without ends.
    pub periods: Vec<f64>,
    /// The values.
    pub values: Vec<f64>,
}

/// Natural scales of a scene, in its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// ρ₀ c² (Pa) of the fastest wave at the start.
    pub stress: f64,
    /// The size of a cell (m).
    pub length: f64,
    /// The time (s) in which that wave crosses a cell.
    pub time: f64,
    /// The shortest length that matters (m): of a cell, or of the barrier of a contact.
    pub finest: f64,
    /// The distance (m) between numbers as large as the farthest coordinate in the frame.
    pub place: f64,
    /// Particles.
    pub particles: usize,
}

impl Scales {
    /// Scales of the scene `seen` from `frame`.
    pub(super) fn of<const D: usize>(seen: &Scene<D>, frame: &Frame<D>) -> Self {
        let (bodies, moduli) = (&seen.bodies, seen.bodies.wave_moduli());
        let stress = moduli.iter().copied().fold(0.0, f64::max);
        let squares =
            moduli.iter().zip(&bodies.each).map(|(modulus, body)| modulus / body.least_density(&bodies.particles));
        let barriers = seen.contacts.iter().map(|c| c.barrier().distance());
        let length = frame.scale(0, 1);
        let axes = seen.grid.axes.iter();
        let ends = axes.flat_map(|a| [a.lo.abs(), a.hi(seen.grid.h).abs()]);
        let farthest = ends.fold(0.0, f64::max);
        Self {
            stress: stress / frame.scale(1, 0),
            length: seen.grid.h / length,
            time: seen.grid.h / squares.fold(0.0, f64::max).sqrt(),
            finest: barriers.fold(seen.grid.h, f64::min) / length,
            place: (farthest.next_up() - farthest) / length,
            particles: seen.bodies.particles.len(),
        }
    }
}

/// Fields that any simulation can be asked for.
const FIELDS: [(&str, Field, i32); 5] = [
    ("mean stress", Field::MeanStress, 1),
    ("averaged mean stress", Field::AveragedMeanStress, 1),
    ("plastic strain", Field::PlasticStrain, 0),
    ("pore pressure", Field::PorePressure, 1),
    ("porosity", Field::Porosity, 0),
];

/// Columns of `run`, a scene on `grid` seen from `frame`.
pub(super) fn columns<const D: usize>(run: &mut dyn Simulation<D>, frame: &Frame<D>, grid: &Grid<D>) -> Vec<Column> {
    let mut told = Told { frame, columns: Vec::new() };
    let d = D as i32;
    told.add("time", [0, 0, 1], false, vec![run.time()]);
    let p = run.particles();
    let places = vectors(p, |k| frame.place_of_scene(&p.position[k]));
    told.columns.push(Column {
        name: "position".to_owned(),
        unit: [0, 1, 0],
        summed: false,
        periods: grid.axes.map(|a| period(grid, a)).to_vec(),
        values: places,
    });
    if !p.velocity.is_empty() {
        let velocity = vectors(p, |k| frame.vector_of_scene(&p.velocity[k], frame.scale(0, 1)));
        told.push("velocity", [0, 1, -1], false, velocity);
    }
    let stress = p.seeded(|k| frame.stress_of_scene(&p.stress[k]));
    let components = stress.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy, s.yz, s.xz]);
    told.push("stress", [1, 0, 0], false, components.collect());
    told.push("J", [0; 3], false, p.seeded(|k| p.jacobian[k]));
    told.add("volume", [0, d, 0], false, p.seeded(|k| p.volume[k]));
    for (name, field, stress) in FIELDS {
        let values = run.field(field);
        if !values.is_empty() {
            let p = run.particles();
            told.add(name, [stress, 0, 0], false, p.seeded(|k| values[k]));
        }
    }
    told.sums(run);
    for (name, part) in [("constraint", Part::Constraint as fn(usize) -> Part), ("contact", Part::Contact)] {
        for place in 0.. {
            let reaction = run.on(part(place));
            if reaction.force[0].is_nan() {
                break;
            }
            told.reaction(&format!("{name} {place}"), &reaction);
        }
    }
    if let Some(water) = run.water() {
        let volumes = vec![water.outflow, water.inflow, water.imbalance];
        told.add("water", [0, d, 0], true, volumes);
    }
    told.columns
}

/// A vector of every particle, by its place in the columns, one after the other in seeding order.
fn vectors<const D: usize>(p: &Particles<D>, of: impl Fn(usize) -> [f64; D]) -> Vec<f64> {
    let mut seeded = vec![[0.0; D]; p.len()];
    for (k, id) in p.id.iter().enumerate() {
        seeded[*id as usize] = of(k);
    }
    seeded.into_flattened()
}

/// The period of an axis; infinite without one.
fn period<const D: usize>(grid: &Grid<D>, axis: Axis) -> f64 {
    match axis.is_periodic() {
        true => axis.hi(grid.h) - axis.lo,
        false => f64::INFINITY,
    }
}

struct Told<'a, const D: usize> {
    frame: &'a Frame<D>,
    columns: Vec<Column>,
}

impl<const D: usize> Told<'_, D> {
    /// Adds values that are already in the scene's own frame.
    fn push(&mut self, name: &str, unit: [i32; 3], summed: bool, values: Vec<f64>) {
        self.columns.push(Column { name: name.to_owned(), unit, summed, periods: vec![f64::INFINITY], values });
    }

    /// Scalars of the frame.
    fn add(&mut self, name: &str, unit: [i32; 3], summed: bool, values: Vec<f64>) {
        let scale = self.frame.scale(unit[0], unit[1]);
        let values = values.into_iter().map(|value| value / scale);
        self.push(name, unit, summed, values.collect());
    }

    /// A vector of the frame.
    fn vector(&mut self, name: &str, unit: [i32; 3], vector: &[f64; 3]) {
        let own = std::array::from_fn(|k| vector[k]);
        let scale = self.frame.scale(unit[0], unit[1]);
        let values = self.frame.vector_of_scene(&own, scale);
        self.push(name, unit, true, values.to_vec());
    }

    fn reaction(&mut self, name: &str, reaction: &Reaction) {
        let d = D as i32;
        self.vector(&format!("force on {name}"), [1, d - 1, 0], &reaction.force);
        self.vector(&format!("impulse on {name}"), [1, d - 1, 1], &reaction.impulse);
    }

    fn sums(&mut self, run: &dyn Simulation<D>) {
        let d = D as i32;
        let (totals, residual) = (run.totals(), run.residual());
        let a = totals.accumulated;
        self.add("mass", [1, d - 2, 2], true, vec![totals.mass]);
        self.vector("momentum", [1, d - 1, 1], &totals.momentum);
        let energies = [
            ("kinetic energy", totals.kinetic_energy),
            ("stored energy", totals.stored_energy),
            ("kinetic energy of nodes", residual.kinetic_energy),
            ("stress work", a.stress_work),
            ("load work", a.load_work),
            ("damping", a.damping),
            ("loss at constraints", a.constraint_loss),
            ("loss of filters", a.filter_loss),
            ("loss of lumping", a.lumping_loss),
        ];
        for (name, energy) in energies {
            self.add(name, [1, d, 0], true, vec![energy]);
        }
        let (least, greatest) = totals.jacobian;
        let gaps = [totals.log_jacobian_gap_rms, totals.log_jacobian_gap_max];
        self.push("J and its gaps", [0; 3], false, vec![least, greatest, gaps[0], gaps[1]]);
        self.add("free force", [1, d - 1, 0], true, vec![residual.free_force]);
        self.vector("held force", [1, d - 1, 0], &residual.held_force);
    }
}
