//! Particles, as columns.

use crate::error::{Error, positive, require};
use crate::frame::Frame;
use crate::memory::{self, MemoryError, row, rows};
use crate::parallel::{CHUNK, Rows, for_each_piece};
use crate::tensor::SymmetricTensor;
use nalgebra::SMatrix;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// `$of!` of the names of all columns.
macro_rules! columns {
    ($of:ident) => {
        $of!(id reference position velocity acceleration affine mass reference_volume volume jacobian j_bar stress
            external_force delta_f increment)
    };
}

/// Columns of the particles of all bodies. All have one entry per particle, but `j_bar`, `acceleration`, `affine` and `external_force`,
/// which are empty in a run without a remedy, transfer or load that needs them.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Particles<const D: usize> {
    /// Half the size of every particle's domain along each axis (m).
    #[serde(with = "row")]
    pub half_size: [f64; D],
    /// Place in the seeding order.
    pub id: Vec<u32>,
    /// Reference position X (m).
    #[serde(with = "rows")]
    pub reference: Vec<[f64; D]>,
    /// Current position x (m).
    #[serde(with = "rows")]
    pub position: Vec<[f64; D]>,
    /// Velocity v (m/s).
    #[serde(with = "rows")]
    pub velocity: Vec<[f64; D]>,
    /// Acceleration (m/s²), where a time rule keeps it.
    #[serde(with = "rows")]
    pub acceleration: Vec<[f64; D]>,
    /// Moment B of the nodal velocities around the particle (m²/s), row by component of velocity. At
    /// the start it is zero unless given: C D for a velocity gradient C.
    pub affine: Vec<SMatrix<f64, D, D>>,
    /// Mass (kg; per metre of depth in plane strain, per square metre of section in 1D).
    pub mass: Vec<f64>,
    /// Reference volume V⁰ (m³; m² in plane strain, m in 1D).
    pub reference_volume: Vec<f64>,
    /// Volume that weights stresses and averages, V (m³), Eq. (15).
    pub volume: Vec<f64>,
    /// Jacobian J = det F.
    pub jacobian: Vec<f64>,
    /// Averaged Jacobian J̄.
    pub j_bar: Vec<f64>,
    /// Cauchy stress (Pa), as the law gives it.
    pub stress: Vec<SymmetricTensor>,
    /// External force (N).
    #[serde(with = "rows")]
    pub external_force: Vec<[f64; D]>,
    /// At the start, the deformation gradient F. Then the relative deformation gradient ΔF, or ΔF̄, of a step, where a
    /// solver keeps it here; the explicit one does not.
    pub delta_f: Vec<SMatrix<f64, D, D>>,
    /// Displacement of the step (m).
    #[serde(with = "rows")]
    pub increment: Vec<[f64; D]>,
}

impl<const D: usize> Particles<D> {
    /// Particles at rest at `positions` (m), each of the given `volume` (m³), `density` (kg/m³) and
    /// `half_size` (m).
    ///
    /// # Errors
    /// A volume, density or half size that is not positive and finite, or a position that is not finite.
    pub fn new(positions: Vec<[f64; D]>, volume: f64, density: f64, half_size: [f64; D]) -> Result<Self, Error> {
        positive(volume, "particle volume", "positive (m³)")?;
        positive(density, "density", "positive (kg/m³)")?;
        for l in half_size {
            positive(l, "particle half size", "positive (m)")?;
        }
        for x in positions.iter().flatten() {
            require(true, "particle position", *x, "finite (m)")?;
        }
        let n = positions.len();
        Ok(Self {
            half_size,
            id: (0..n as u32).collect(),
            reference: positions.clone(),
            position: positions,
            velocity: vec![[0.0; D]; n],
            acceleration: Vec::new(),
            affine: Vec::new(),
            mass: vec![density * volume; n],
            reference_volume: vec![volume; n],
            volume: vec![volume; n],
            jacobian: vec![1.0; n],
            j_bar: Vec::new(),
            stress: vec![SymmetricTensor::default(); n],
            external_force: vec![[0.0; D]; n],
            delta_f: vec![SMatrix::identity(); n],
            increment: vec![[0.0; D]; n],
        })
    }

    /// Starts from the deformed state `state`, which maps a reference position X (m) to the position x
    /// (m) and the deformation gradient F there. The law then gives the stress, as after one step
    /// without viscosity.
    #[must_use]
    pub fn deformed(mut self, state: impl Fn(&[f64; D]) -> ([f64; D], SMatrix<f64, D, D>)) -> Self {
        let columns = self.position.iter_mut().zip(&mut self.delta_f);
        for (reference, (position, delta_f)) in self.reference.iter().zip(columns) {
            (*position, *delta_f) = state(reference);
        }
        self
    }

    /// The same particles, before their first step, seen from `frame`; those of a [`Bodies`](crate::Bodies) get their
    /// stress and volume from it.
    #[must_use]
    pub fn seen_from(&self, frame: &Frame<D>) -> Self {
        let [length, area, volume] = [1, 2, D as i32].map(|power| frame.scale(0, power));
        let vectors = |column: &[[f64; D]], scale: f64| -> Vec<[f64; D]> {
            column.iter().map(|v| frame.vector(v, scale)).collect()
        };
        let places = |column: &[[f64; D]]| -> Vec<[f64; D]> { column.iter().map(|x| frame.place(x)).collect() };
        let scaled = |column: &[f64], scale: f64| -> Vec<f64> { column.iter().map(|value| scale * value).collect() };
        let matrices = |column: &[SMatrix<f64, D, D>], scale: f64| -> Vec<_> {
            column.iter().map(|m| frame.matrix(m, scale)).collect()
        };
        Self {
            half_size: frame.vector(&self.half_size, length).map(f64::abs),
            id: self.id.clone(),
            reference: places(&self.reference),
            position: places(&self.position),
            velocity: vectors(&self.velocity, length),
            acceleration: vectors(&self.acceleration, length),
            affine: matrices(&self.affine, area),
            mass: scaled(&self.mass, frame.stiffness()),
            reference_volume: scaled(&self.reference_volume, volume),
            volume: scaled(&self.volume, volume),
            jacobian: self.jacobian.clone(),
            j_bar: self.j_bar.clone(),
            stress: vec![SymmetricTensor::default(); self.stress.len()],
            external_force: vectors(&self.external_force, frame.force()),
            delta_f: matrices(&self.delta_f, 1.0),
            increment: vectors(&self.increment, length),
        }
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Values of `f` at every place in the columns, in seeding order.
    pub fn seeded<T: Copy + Default>(&self, f: impl Fn(usize) -> T) -> Vec<T> {
        let mut values = vec![T::default(); self.len()];
        for (k, id) in self.id.iter().enumerate() {
            values[*id as usize] = f(k);
        }
        values
    }

    /// Kinetic energy Σ ½ m v² (J); that of affine parts is left out.
    pub fn kinetic_energy(&self) -> f64 {
        self.kinetic_energy_of(0..self.len())
    }

    /// The same of the particles in a range.
    pub fn kinetic_energy_of(&self, range: Range<usize>) -> f64 {
        let square = |v: &[f64; D]| v.iter().map(|v| v * v).sum::<f64>();
        let pairs = self.mass[range.clone()].iter().zip(self.velocity.get(range).unwrap_or_default());
        pairs.map(|(m, v)| 0.5 * m * square(v)).sum()
    }

    /// The lengths of the columns, by name.
    fn lengths(&self) -> [(&'static str, usize); 15] {
        macro_rules! lengths {
            ($($column:ident)*) => {[$((stringify!($column), self.$column.len())),*]};
        }
        columns!(lengths)
    }

    /// Checks that these could be the particles of `scene`, later: columns as long, the same identities.
    pub(crate) fn check_against(&self, scene: &Self) -> Result<(), MemoryError> {
        for ((what, saved), (_, expected)) in self.lengths().into_iter().zip(scene.lengths()) {
            MemoryError::unless_equal(what, saved, expected)?;
        }
        self.check_whole()
    }

    /// Checks that these could be the particles of any run: whole columns or none, every identity once.
    pub(crate) fn check_whole(&self) -> Result<(), MemoryError> {
        for (what, saved) in self.lengths().into_iter().filter(|(_, l)| *l > 0) {
            MemoryError::unless_equal(what, saved, self.len())?;
        }
        let mut seen = vec![false; self.len()];
        for id in &self.id {
            let first = seen.get_mut(*id as usize).is_some_and(|seen| !std::mem::replace(seen, true));
            let allowed = "each number below the number of particles, once";
            memory::require(first, "id of a particle", f64::from(*id), allowed)?;
        }
        Ok(())
    }

    /// Those that were seeded before `count`, in their order: what was seeded later is taken away.
    pub(crate) fn first(&self, count: usize) -> Vec<u32> {
        let places = 0..self.len() as u32;
        places.filter(|k| (self.id[*k as usize] as usize) < count).collect()
    }

    /// Makes these, of a run that ended, the particles of one that begins as `scene`: motion that only one of the two
    /// has a column for begins at rest, or is forgotten.
    pub(crate) fn go_on_as(&mut self, scene: &Self) {
        let columns = [
            (&mut self.velocity, &scene.velocity),
            (&mut self.acceleration, &scene.acceleration),
            (&mut self.external_force, &scene.external_force),
            (&mut self.increment, &scene.increment),
        ];
        for (column, like) in columns {
            if column.is_empty() != like.is_empty() {
                *column = vec![[0.0; D]; like.len()];
            }
        }
    }

    /// Puts every column in the order `order`: entry `k` becomes the former entry `order[k]`. An order of some leaves
    /// the others out.
    pub fn permute(&mut self, order: &[u32]) {
        macro_rules! permute_each {
            ($($column:ident)*) => {$(permute(&mut self.$column, order, 1);)*};
        }
        columns!(permute_each);
    }

    /// Puts other particles behind these, seeded after them.
    pub(crate) fn append(&mut self, mut others: Self) {
        let count = self.len() as u32;
        others.id.iter_mut().for_each(|id| *id += count);
        if !(self.affine.is_empty() && others.affine.is_empty()) {
            self.affine.resize(self.len(), SMatrix::zeros());
            others.affine.resize(others.len(), SMatrix::zeros());
        }
        macro_rules! append_each {
            ($($column:ident)*) => {$(self.$column.append(&mut others.$column);)*};
        }
        columns!(append_each);
    }
}

/// Puts the rows of a column, `width` entries each, in the order `order`, in which some may be left out; an empty column
/// stays empty.
pub(crate) fn permute<T: Copy + Send + Sync>(column: &mut Vec<T>, order: &[u32], width: usize) {
    if !column.is_empty() {
        let before = column.clone();
        column.truncate(width * order.len());
        let rows = (Rows { entries: column, width }, order);
        for_each_piece(rows, order.len(), CHUNK, &|_, (rows, order)| {
            for (row, p) in rows.entries.chunks_exact_mut(width).zip(order) {
                row.copy_from_slice(&before[*p as usize * width..][..width]);
            }
        });
    }
}
