//! The explicit step (update stress last), Sections 2.2 and 3.3 of the paper.

mod between;
mod contact;
mod memory;
pub mod remedy;
mod scratch;
mod second_half;
mod settings;
mod sort;
mod stages;
mod start;
pub mod transfer;

pub use contact::contact_cfl;
pub use remedy::Remedy;
pub use settings::{Settings, courant_time_step, stable_cfl};
pub use transfer::Transfer;

use crate::basis::Basis;
use crate::bodies::{Chunk, check_jacobian};
use crate::eights::entries;
use crate::error::{Error, Fault};
use crate::lattice::Lattice;
use crate::ledger::Ledger;
use crate::memory::Saved;
use crate::nodes::{NodalState, Node};
use crate::number::{EIGHT, Eight};
use crate::order::Slabs;
use crate::parallel::CHUNK;
use crate::projection::{Onto, Space, space};
use crate::reach::Reach;
use crate::scene::Scene;
use crate::simulation::{Field, Simulation};
use crate::stage::Prescribed;
use crate::tensor::SymmetricTensor;
use between::Touching;
use remedy::{Columns, Deformation};
use scratch::Scratch;
use second_half::SecondHalf;
use std::sync::Mutex;
use transfer::Flip;

/// Largest (c + |v|) Δt / h: beyond it a wave or a particle crosses more than a cell in a step.
const CFL_LIMIT: f64 = 1.0;

/// Sums of one chunk of particles in a gather.
#[derive(Debug, Clone, Copy, Default)]
struct ChunkSums {
    stress_power: f64,
    load_power: f64,
    largest_increment: f64,
    /// Greatest moduli ρ₀ c² of waves (Pa), lane by lane.
    wave_modulus: Eight,
    wrapped: bool,
    /// How often the remedy averaged.
    averages: u64,
    /// The first particle that has no volume, and the first that cannot go where it should; by place in the columns.
    collapsed: Option<(usize, Fault)>,
    astray: Option<(usize, Fault)>,
}

impl ChunkSums {
    /// Whether the Jacobians of the `k`-th eight of a chunk are positive and finite.
    fn check_jacobians<const D: usize>(&mut self, chunk: &Chunk<'_, D>, k: usize, j: Eight) -> bool {
        let (zero, infinity) = (Eight::ZERO, Eight::splat(f64::INFINITY));
        if (j.simd_gt(zero) & j.simd_lt(infinity)).all() {
            return true;
        }
        let checked = j.to_array().into_iter().take(entries(chunk.len(), k));
        for (l, j) in checked.enumerate() {
            if let Err(fault) = check_jacobian(j) {
                let index = chunk.begin + k * EIGHT + l;
                self.collapsed.get_or_insert((index, fault));
            }
        }
        false
    }
}

/// Sums of one chunk of nodes in the update.
#[derive(Debug, Clone, Copy, Default)]
struct NodeSums {
    /// Σ|f_i| (N).
    free_force: f64,
    /// After the update (J).
    kinetic_energy: f64,
    /// Power that filters take (W).
    damping: f64,
    /// Momentum after the update (kg m/s).
    momentum: Node,
}

/// A velocity field: the nodes that some bodies share, by which they move as one.
struct VelocityField<T> {
    /// Its bodies, by place in the list, and their slabs.
    bodies: Vec<usize>,
    slabs: Vec<Slabs>,
    nodes: Vec<NodalState>,
    /// The nodes that its particles see until they are sorted again; all others are zero.
    reach: Reach,
    /// Prescribed velocities of these nodes.
    prescribed: Vec<Prescribed>,
    transfer: T,
}

/// The explicit solver.
pub struct Solver<const D: usize, const S: usize, B, T = Flip> {
    scene: Scene<D>,
    settings: Settings<D, T>,
    lattice: Lattice<D, S, B>,
    /// That of the bodies that stick, if there are any, and one of each that slides.
    fields: Vec<VelocityField<T>>,
    /// The field of every body.
    field_of: Vec<usize>,
    /// Where bodies of different fields may touch.
    touching: Touching<D>,
    /// The acceleration of all material in the step (m/s²).
    gravity: Node,
    /// The functions that the remedy averages with, of every body.
    spaces: Vec<Box<dyn Space<D>>>,
    /// All prescribed velocities.
    declared: Vec<Prescribed>,
    /// Amplitudes of the constraints in the step.
    amplitudes: Vec<f64>,
    /// Cells by which the nodes that they hold have moved on.
    shifts: Vec<[f64; D]>,
    /// Columns that the remedy fills; the mean stress there is that of the step, if it is current.
    columns: Columns,
    mean_is_current: bool,
    /// Between G2P and the law, where that needs it of all particles.
    deformation: Deformation<D>,
    /// Whether averages need no more than a chunk of particles, and nothing else stands between G2P and the law. Every
    /// thread then has room for a chunk.
    in_one_pass: bool,
    scratch: Vec<Mutex<Scratch<D>>>,
    /// The step of every body after G2P.
    second_half: Vec<SecondHalf<D>>,
    chunk_sums: Vec<ChunkSums>,
    node_sums: Vec<NodeSums>,
    /// Largest distance (m) that a particle can have moved since the particles were sorted.
    drift: f64,
    /// Least density of the undeformed material (kg/m³) and greatest modulus ρ₀ c² of waves (Pa), body by body.
    density: Vec<f64>,
    wave_modulus: Vec<f64>,
    ledger: Ledger,
    /// Particle–node visits per particle and step, averages aside.
    transfer_pairs: u64,
}

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Simulation<D> for Solver<D, S, B, T> {
    fn step(&mut self) -> Result<(), Error> {
        self.apply_loads();
        self.apply_contacts()?;
        self.average_stress();
        self.particles_to_grid();
        self.move_constraints()?;
        self.update_grid();
        self.meet();
        self.grid_to_particles()?;
        self.keep_gaps_open(self.ledger.time + self.settings.dt)?;
        self.average_volume_change()?;
        self.find_fastest_wave();
        self.sort_if_needed();
        self.filter_particles();
        self.ledger.time += self.settings.dt;
        self.ledger.count_step();
        Ok(())
    }

    fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    fn scene(&self) -> &Scene<D> {
        &self.scene
    }

    fn force_stress(&mut self) -> Vec<SymmetricTensor> {
        let work = self.ledger.work;
        self.average_stress();
        self.ledger.work = work;
        let p = &self.scene.bodies.particles;
        let mut stress = p.stress.clone();
        let columns = stress.iter_mut().zip(&self.columns.mean);
        for ((stress, mean), (j_bar, j)) in columns.zip(p.j_bar.iter().zip(&p.jacobian)) {
            *stress = remedy::force_stress::<f64, D>(stress, j_bar / j, *mean);
        }
        stress
    }

    fn field(&mut self, field: Field) -> Vec<f64> {
        match field {
            Field::PorePressure | Field::Porosity => Vec::new(),
            Field::PlasticStrain => self.scene.bodies.plastic_strain(),
            Field::MeanStress => self.force_stress().iter().map(|s| s.mean()).collect(),
            Field::AveragedMeanStress => {
                let mut mean = self.field(Field::MeanStress);
                self.average(&mut mean);
                mean
            }
        }
    }

    fn body(&self) -> Result<Saved, Error> {
        Ok(self.scene.hand_over(self.save_body()?)?)
    }

    fn take_over(&mut self, body: &Saved) -> Result<(), Error> {
        let (body, sticks): (Saved, Vec<Vec<f64>>) = body.read("a body with its sticks")?;
        self.restore_body(&body)?;
        self.scene.take_sticks(&sticks);
        Ok(())
    }
}

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// Replaces `field` (one value per particle) by its average Π `field`. No work of the run: it is not counted.
    pub fn average(&mut self, field: &mut [f64]) {
        let particles = &self.scene.bodies.particles;
        let other = self.settings.remedy.averages_onto().is_some_and(|onto| onto != Onto::Basis);
        for (fields, slabs) in self.fields.iter().flat_map(|field| field.bodies.iter().zip(&field.slabs)) {
            let mut own = other.then(|| {
                let mut own = space::<D, S, B>(self.scene.grid, self.settings.wall, None);
                own.find_reach(particles, slabs);
                own
            });
            own.as_mut().unwrap_or(&mut self.spaces[*fields]).average(particles, field);
        }
    }

    /// After the law: the greatest modulus of waves.
    fn find_fastest_wave(&mut self) {
        let mut sums = &self.chunk_sums[..];
        for (modulus, body) in self.wave_modulus.iter_mut().zip(&self.scene.bodies.each) {
            let (own, others) = sums.split_at(body.range().len().div_ceil(CHUNK));
            let greatest = own.iter().map(|sums| sums.wave_modulus).fold(Eight::ZERO, Eight::fast_max);
            *modulus = greatest.to_array().into_iter().fold(0.0, f64::max);
            sums = others;
        }
    }

    /// Speed of the fastest wave (m/s).
    fn wave_speed(&self) -> f64 {
        let squares = self.wave_modulus.iter().zip(&self.density).map(|(modulus, density)| modulus / density);
        squares.fold(0.0, f64::max).sqrt()
    }

    fn breakdown(&self, index: usize, fault: Fault) -> Error {
        let ids = &self.scene.bodies.particles.id;
        self.ledger.breakdown(ids, index, fault)
    }

    fn first_fault(&self) -> Result<(), Error> {
        let sums = &self.chunk_sums;
        let collapsed = sums.iter().find_map(|s| s.collapsed);
        match collapsed.or_else(|| sums.iter().find_map(|s| s.astray)) {
            Some((index, fault)) => Err(self.breakdown(index, fault)),
            None => Ok(()),
        }
    }
}

/// Whether what moves `distance` (m) in a step stays within the CFL limit on cells of size `h` (m).
fn check_cfl(distance: f64, h: f64) -> Result<(), Fault> {
    if distance > CFL_LIMIT * h {
        return Err(Fault::UnstableTimeStep { cfl: distance / h, limit: CFL_LIMIT });
    }
    Ok(())
}
