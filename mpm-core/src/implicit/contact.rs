//! Contact with rigid bodies in a step: barrier and friction at a trial, their stiffness, and gaps that stay open.
//!
//! Both act at a particle's place, x + Σ w u, so that their force on a node is Σ w f and their stiffness Σ w w ∂f/∂x. The
//! barrier pushes by −B′ along the normal n; its stiffness is B″ n ⊗ n + B′ ∇n, where n turns by ∇n over the place. A stick
//! starts from where the last step left it, however often a step is tried.

use super::elements::Elements;
use super::{Remedy, Solver};
use crate::contact::{Barrier, Friction, Gap, RigidContact, RigidFace, tangential};
use crate::error::{Error, Fault, require};
use crate::particles::Particles;
use crate::scene::Scene;
use nalgebra::{SMatrix, SVector};

/// The share of the way to the first closed gap that a correction goes at most.
const OPEN: f64 = 0.9;

/// A rigid face with its barrier and friction, where it stands at one time.
pub(super) struct Obstacle<const D: usize> {
    face: RigidFace<D>,
    barrier: Barrier,
    /// Displacement of the face (m).
    moved: SVector<f64, D>,
    friction: Option<Friction>,
    /// Displacement of the face (m) since the step's start.
    carried: SVector<f64, D>,
    /// Stretch of the sticks at the step's start (m), by id; empty without friction.
    sticks: Vec<[f64; D]>,
}

/// Action of an obstacle on a particle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push<const D: usize> {
    /// Place of the particle, and of the obstacle in its list.
    pub(super) particle: usize,
    pub(super) by: usize,
    /// Force on the particle (N).
    pub(super) force: SVector<f64, D>,
    /// −∂force/∂x (N/m).
    pub(super) stiffness: SMatrix<f64, D, D>,
    /// Stretch of the stick (m).
    pub(super) stretch: [f64; D],
}

impl<const D: usize> Obstacle<D> {
    /// A contact as it is at `time` (s) of a step from `start` (s) on.
    fn new(contact: &RigidContact<D>, start: f64, time: f64) -> Self {
        let [before, moved] = [start, time].map(|time| SVector::from(contact.face().displacement(time)));
        Self {
            face: contact.face().clone(),
            barrier: contact.barrier(),
            moved,
            friction: contact.friction(),
            carried: moved - before,
            sticks: contact.sticks().to_vec(),
        }
    }

    /// Whether it moves in the step.
    pub(super) fn moves(&self) -> bool {
        self.carried.iter().any(|moved| *moved != 0.0)
    }

    /// The face as what lies at `x` (m) sees it, if it lies before it.
    fn gap(&self, x: &SVector<f64, D>) -> Option<Gap<D>> {
        self.face.seen_at(&(x - self.moved).into(), f64::INFINITY)
    }

    /// The gap at a place where the barrier pushes.
    fn touched(&self, x: &SVector<f64, D>) -> Result<Option<Gap<D>>, Fault> {
        match self.gap(x) {
            Some(gap) if gap.size <= 0.0 => Err(Fault::GapClosed(gap.size)),
            gap => Ok(gap.filter(|gap| gap.size < self.barrier.distance())),
        }
    }

    /// Adds to a push with the normal force `normal` (N) and stiffness `slope` (N/m) what the stick of the particle
    /// `id` does that has moved by `moved` (m) in the step.
    fn rub(&self, push: &mut Push<D>, id: u32, moved: &SVector<f64, D>, gap: &Gap<D>, [normal, slope]: [f64; 2]) {
        let Some((friction, stick)) = self.friction.zip(self.sticks.get(id as usize)) else {
            return;
        };
        let (n, pulled) = (gap.normal, SVector::from(*stick) + (moved - self.carried));
        push.stretch = tangential(pulled, &n).into();
        let (resisting, by_normal) = friction.tangent(&push.stretch, normal);
        push.force += SVector::from(friction.force(&mut push.stretch, normal));
        // ∂s/∂x of s = (I − n ⊗ n) pulled, and ∂N/∂x = −B″ n.
        let turning = n * (gap.bend * pulled).transpose() + gap.bend * n.dot(&pulled);
        let slope_of_stretch = SMatrix::identity() - n * n.transpose() - turning;
        push.stiffness += resisting * slope_of_stretch + by_normal * slope * n.transpose();
    }
}

/// Actions of obstacles on the particles at a trial with the nodal increments `u` (m).
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
        for (particle, x) in particles.position.iter().enumerate() {
            let moved = elements.value(particle, u);
            let touched = obstacle.touched(&(SVector::from(*x) + moved));
            let Some(gap) = touched.map_err(|fault| (particle, fault))? else {
                continue;
            };
            let (n, barrier) = (gap.normal, obstacle.barrier);
            let [normal, slope] = [barrier.force(gap.size), barrier.stiffness(gap.size)];
            let stiffness = n * n.transpose() * slope - gap.bend * normal;
            let mut push = Push { particle, by, force: n * normal, stiffness, stretch: [0.0; D] };
            obstacle.rub(&mut push, particles.id[particle], &moved, &gap, [normal, slope]);
            found.push(push);
        }
    }
    Ok(found)
}

/// How much of a `correction` to the nodal increments `u` (m) may be taken: all of it, or nine tenths of what would
/// close the first gap. Gaps before a facet are linear in the increments; a trial that closes another one is refused.
pub(super) fn open_share<const D: usize>(
    obstacles: &[Obstacle<D>],
    elements: &Elements<D>,
    particles: &Particles<D>,
    u: &[SVector<f64, D>],
    correction: &[SVector<f64, D>],
) -> f64 {
    let mut share: f64 = 1.0;
    for obstacle in obstacles {
        for (particle, x) in particles.position.iter().enumerate() {
            let place = SVector::from(*x) + elements.value(particle, u);
            let Some(gap) = obstacle.gap(&place) else { continue };
            let closing = -gap.normal.dot(&elements.value(particle, correction));
            if closing > 0.0 {
                share = share.min(OPEN * gap.size / closing);
            }
        }
    }
    share
}

/// Whether the stiffness of a scene is symmetric: friction has a potential where it can't slip on a plane.
pub(super) fn is_symmetric<const D: usize>(scene: &Scene<D>) -> bool {
    scene.bodies.each.iter().all(|body| body.law.conservative()) && scene.contacts.iter().all(has_potential)
}

fn has_potential<const D: usize>(contact: &RigidContact<D>) -> bool {
    contact.friction().is_none_or(|friction| friction.coefficient().is_none() && contact.face().is_plane())
}

/// That a solver with `remedy` can have these contacts on `grid`.
///
/// # Errors
/// A face across a periodic axis; friction without a potential, with F̄.
pub(super) fn check<const D: usize>(
    contacts: &[RigidContact<D>],
    grid: &crate::Grid<D>,
    remedy: Remedy,
) -> Result<(), Error> {
    for contact in contacts {
        let periodic = contact.face().crosses(|axis| grid.axes[axis].is_periodic());
        require(periodic.is_none(), "axis of a rigid face", periodic.unwrap_or(0) as f64, "not periodic")?;
        let slipping = contact.friction().and_then(|f| f.coefficient());
        require(
            has_potential(contact) || remedy == Remedy::None,
            "friction coefficient of an implicit run with F-bar",
            slipping.unwrap_or(0.0),
            "none, or infinite (rough) on a plane face: F-bar is solved by conjugate gradients, and other friction has no \
             symmetric stiffness",
        )?;
    }
    Ok(())
}

impl<const D: usize> Solver<D> {
    /// The contacts as they are at `time` (s).
    pub(super) fn obstacles(&self, time: f64) -> Vec<Obstacle<D>> {
        let contacts = self.scene.contacts.iter();
        let start = self.ledger.time;
        contacts.map(|c| Obstacle::new(c, start, time)).collect()
    }

    /// Keeps the sticks of pushes at a step's end.
    pub(super) fn stick(&mut self, pushes: &[Push<D>]) {
        let ids = &self.scene.bodies.particles.id;
        for (place, contact) in self.scene.contacts.iter_mut().enumerate() {
            let own = pushes.iter().filter(|push| push.by == place);
            contact.stick(own.map(|push| (ids[push.particle], push.stretch)));
        }
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
pub(super) fn relieve<const D: usize>(pushes: &[Push<D>], elements: &Elements<D>, forces: &mut [SVector<f64, D>]) {
    for push in pushes {
        let (nodes, w, _) = elements.seen(push.particle);
        for (node, w) in nodes.iter().zip(w) {
            forces[*node] -= push.force * *w;
        }
    }
}

/// The work (J) of pushes on the nodal increments `u` (m).
pub(super) fn work<const D: usize>(pushes: &[Push<D>], elements: &Elements<D>, u: &[SVector<f64, D>]) -> f64 {
    let pairs = pushes.iter();
    pairs.map(|push| push.force.dot(&elements.value(push.particle, u))).sum()
}
