//! External actions in a step: forces of faces and plates on the nodes, and drains. Each sum must equal the whole of
//! its face; otherwise the step fails.

use super::Solver;
use super::face::{Acts, Corner, Face};
use super::step::Drain;
use super::unknowns::{Place, Unknowns};
use crate::implicit::failure::Failure;
use nalgebra::SVector;

/// Share of a whole that its sum may lack: rounding, and the loss of a corner.
const LACKING: f64 = 1e-9;

impl<const D: usize> Solver<D> {
    /// Adds to the forces (N) on the nodes at the end of a step of `dt` (s) those of faces and plates, and finds the
    /// corners by which water leaves.
    ///
    /// # Errors
    /// A corner in an empty cell; forces or drained areas whose sum is not the whole; a plate without nodes.
    pub(super) fn outside(
        &self,
        dt: f64,
        unknowns: &Unknowns<D>,
        external: &mut [SVector<f64, D>],
    ) -> Result<Vec<Drain>, Failure> {
        let mut drains = Vec::new();
        let end = self.ledger.time + dt;
        for face in &self.water.faces {
            match &face.acts {
                Acts::Load(traction) => {
                    self.load(face, SVector::from(traction(end)), unknowns, external)?;
                }
                Acts::Drains { penalty } => drains.extend(self.drain(face, *penalty, unknowns)?),
            }
        }
        for (k, plate) in self.water.plates.iter().enumerate() {
            let (a, force) = (plate.axis, (plate.force)(end));
            let bears =
                |node: &usize| self.tied[*node][a] == Some(k) && unknowns.displacement[*node][a] != Place::Unseen;
            let nodes: Vec<usize> = (0..external.len()).filter(bears).collect();
            if nodes.is_empty() {
                return Err(Failure::Lost("force of a plate", 0.0, force));
            }
            for node in &nodes {
                external[*node][a] += force / nodes.len() as f64;
            }
        }
        Ok(drains)
    }

    /// Adds the forces of a loaded face.
    fn load(
        &self,
        face: &Face<D>,
        traction: SVector<f64, D>,
        unknowns: &Unknowns<D>,
        external: &mut [SVector<f64, D>],
    ) -> Result<(), Failure> {
        let (particles, space) = (&self.scene.bodies.particles, &self.solid_space);
        let seen = |node: usize| unknowns.displacement[node][0] != Place::Unseen;
        let area = face.area(&particles.half_size);
        let of_corner = traction * (area / Face::<D>::CORNERS as f64);
        let mut sum = SVector::<f64, D>::zeros();
        for corner in face.corners(space, seen, particles, &self.pores)? {
            for (node, w) in corner.node.iter().zip(&corner.w) {
                let force = of_corner * *w;
                external[*node] += force;
                sum += force;
            }
        }
        let whole = traction * (area * face.sides as f64);
        let lacks = (sum - whole).norm() > LACKING * whole.norm();
        if lacks {
            return Err(Failure::Lost("load of a face", sum.norm(), whole.norm()));
        }
        Ok(())
    }

    /// The corners of a drained face.
    fn drain(&self, face: &Face<D>, penalty: f64, unknowns: &Unknowns<D>) -> Result<Vec<Drain>, Failure> {
        let (particles, space) = (&self.scene.bodies.particles, &self.water_space);
        let seen = |node: usize| unknowns.pressure[node] != Place::Unseen;
        let corners = face.corners(space, seen, particles, &self.pores)?;
        let of = |corner: Corner| {
            let side = face.area(&self.pores.half_size[corner.particle]);
            let area = side / Face::<D>::CORNERS as f64;
            Drain { unknown: unknowns.of(&[], &corner.node), node: corner.node, w: corner.w, rate: penalty * area }
        };
        let drains: Vec<Drain> = corners.into_iter().map(of).collect();
        let rates = drains.iter().map(|d| d.rate * d.w.iter().sum::<f64>());
        let sum = rates.sum::<f64>() / penalty;
        let sides = (0..particles.len()).filter(|p| face.takes(particles.id[*p]));
        let whole: f64 = sides.map(|p| face.area(&self.pores.half_size[p])).sum();
        if (sum - whole).abs() > LACKING * whole {
            return Err(Failure::Lost("drained area of a face", sum, whole));
        }
        Ok(drains)
    }
}
