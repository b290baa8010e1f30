//! Contact with rigid bodies in a step: the barrier at a trial, its stiffness, and gaps that stay open.
//!
//! A barrier acts at a particle's place, x + Σ w u, so that its force on a node is Σ w f and its stiffness Σ w w ∂f/∂x. Both
//! are of any form in the place; smooth faces have B′ and B″ along the normal.

use super::elements::Elements;
use super::{Interpolation, Solver};
use crate::contact::{Barrier, RigidContact, RigidFace};
use crate::error::{Error, Fault, require};
use crate::material::Law;
use crate::particles::Particles;
use nalgebra::{SMatrix, SVector};

/// The share of the way to the first closed gap that a correction goes at most.
const OPEN: f64 = 0.9;

/// A rigid face with its barrier, where it stands at one time.
pub(super) struct Obstacle<const D: usize> {
    face: RigidFace<D>,
    barrier: Barrier,
    /// Displacement of the face (m).
    moved: [f64; D],
}

/// What an obstacle does to a particle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push<const D: usize> {
    /// Place of the particle, and of the obstacle in its list.
    pub(super) particle: usize,
    pub(super) by: usize,
    /// Force on the particle (N).
    pub(super) force: SVector<f64, D>,
    /// −∂force/∂x (N/m).
    pub(super) stiffness: SMatrix<f64, D, D>,
}

impl<const D: usize> Obstacle<D> {
    /// A contact as it is at `time` (s).
    pub(super) fn new(contact: &RigidContact<D>, time: f64) -> Self {
        Self {
            face: *contact.face(),
            barrier: contact.barrier(),
            moved: contact.face().displacement(time),
        }
    }

    /// Gap (m) to what lies at `x` (m), if it lies before the face.
    fn gap(&self, x: &SVector<f64, D>) -> Option<f64> {
        let moved = SVector::from(self.moved);
        self.face.gap(&(x - moved).into())
    }

    /// Force and stiffness at a place.
    ///
    /// # Errors
    /// The gap is closed.
    fn push(&self, x: &SVector<f64, D>) -> Result<Option<[f64; 2]>, Fault> {
        match self.gap(x) {
            Some(gap) if gap <= 0.0 => Err(Fault::GapClosed(gap)),
            Some(gap) if gap < self.barrier.distance() => {
                Ok(Some([self.barrier.force(gap), self.barrier.stiffness(gap)]))
            }
            _ => Ok(None),
        }
    }
}

/// What obstacles do to the particles at a trial with the nodal increments `u` (m).
///
/// # Errors
/// The first particle whose gap is closed.
pub(super) fn pushes<const D: usize>(
    obstacles: &[Obstacle<D>],
    elements: &Elements<D>,
    particles: &Particles<D>,
    u: &[SVector<f64, D>],
) -> Result<Vec<Push<D>>, (usize, Fault)> {
    let mut found = Vec::new();
    for (by, obstacle) in obstacles.iter().enumerate() {
        let (axis, sign) = (obstacle.face.axis(), obstacle.face.sign());
        for (particle, x) in particles.position.iter().enumerate() {
            let place = SVector::from(*x) + elements.value(particle, u);
            let push = obstacle.push(&place).map_err(|fault| (particle, fault))?;
            let Some([size, slope]) = push else {
                continue;
            };
            let (mut force, mut stiffness) = (SVector::zeros(), SMatrix::zeros());
            force[axis] = sign * size;
            stiffness[(axis, axis)] = slope;
            found.push(Push {
                particle,
                by,
                force,
                stiffness,
            });
        }
    }
    Ok(found)
}

/// How much of a `correction` to the nodal increments `u` (m) may be taken: all of it, or nine tenths of what would close
/// the first gap. Gaps are linear in the increments.
pub(super) fn open_share<const D: usize>(
    obstacles: &[Obstacle<D>],
    elements: &Elements<D>,
    particles: &Particles<D>,
    u: &[SVector<f64, D>],
    correction: &[SVector<f64, D>],
) -> f64 {
    let mut share: f64 = 1.0;
    for obstacle in obstacles {
        let (axis, sign) = (obstacle.face.axis(), obstacle.face.sign());
        for (particle, x) in particles.position.iter().enumerate() {
            let place = SVector::from(*x) + elements.value(particle, u);
            let closing = -sign * elements.value(particle, correction)[axis];
            if let Some(gap) = obstacle.gap(&place).filter(|_| closing > 0.0) {
                share = share.min(OPEN * gap / closing);
            }
        }
    }
    share
}

/// That a solver can have these contacts on `grid`.
///
/// # Errors
/// A face across a periodic axis; friction.
pub(super) fn check<const D: usize>(
    contacts: &[RigidContact<D>],
    grid: &crate::Grid<D>,
) -> Result<(), Error> {
    for contact in contacts {
        let axis = contact.face().axis();
        let periodic = grid.axes[axis].is_periodic();
        require(
            !periodic,
            "axis of a rigid face",
            axis as f64,
            "not periodic",
        )?;
        require(
            contact.is_smooth(),
            "friction of an implicit run's contact",
            1.0,
            "none: Coulomb's law needs a regularised slip, whose stiffness is not symmetric",
        )?;
    }
    Ok(())
}

impl<const D: usize, I: Interpolation<D>, M: Law> Solver<D, I, M> {
    /// The contacts as they are at `time` (s).
    pub(super) fn obstacles(&self, time: f64) -> Vec<Obstacle<D>> {
        let contacts = self.scene.contacts.iter();
        contacts.map(|c| Obstacle::new(c, time)).collect()
    }

    /// Gives the rigid bodies what the particles did to them in a step of `dt` (s).
    pub(super) fn react(&mut self, pushes: &[Push<D>], dt: f64) {
        for (place, contact) in self.scene.contacts.iter_mut().enumerate() {
            let own = pushes.iter().filter(|push| push.by == place);
            let sum = own.fold(SVector::<f64, D>::zeros(), |sum, push| sum + push.force);
            contact.react((-sum).into(), dt);
        }
    }
}

/// Takes the forces (N) of pushes on the nodes from `forces`: they are no resistance of the body.
pub(super) fn relieve<const D: usize>(
    pushes: &[Push<D>],
    elements: &Elements<D>,
    forces: &mut [SVector<f64, D>],
) {
    for push in pushes {
        let (nodes, w, _) = elements.seen(push.particle);
        for (node, w) in nodes.iter().zip(w) {
            forces[*node] -= push.force * *w;
        }
    }
}

/// The work (J) of pushes on the nodal increments `u` (m).
pub(super) fn work<const D: usize>(
    pushes: &[Push<D>],
    elements: &Elements<D>,
    u: &[SVector<f64, D>],
) -> f64 {
    let pairs = pushes.iter();
    pairs
        .map(|push| push.force.dot(&elements.value(push.particle, u)))
        .sum()
}
