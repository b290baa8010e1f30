//! Faces of a body: sides of particle domains, on whose corners loads and drainage act.

use super::Space;
use super::pores::Pores;
use crate::error::{Error, Fault, require};
use crate::frame::Frame;
use crate::implicit::Functions;
use crate::particles::Particles;
use crate::stage::End;

/// A force, or one per area, as a function of time (s).
pub(super) type Force<T> = Box<dyn Fn(f64) -> T + Send + Sync>;

/// A function of a position (m).
pub type OfPlace<const D: usize, T> = Box<dyn Fn(&[f64; D]) -> T + Send + Sync>;

/// Boundary condition on a face.
pub(super) enum Acts<const D: usize> {
    /// A force per area of the undeformed face: dead, whatever becomes of it.
    Load(Force<[f64; D]>),
    /// Water leaves at β p (m/s), so that p tends to zero there.
    Drains {
        /// β (m/(Pa s)).
        penalty: f64,
    },
}

/// The sides at one `end` of an axis of the domains of some particles.
pub struct Face<const D: usize> {
    /// By identity of a particle, whether its side is part of the face.
    chosen: Vec<bool>,
    /// How many they are.
    pub(super) sides: usize,
    axis: usize,
    end: End,
    pub(super) acts: Acts<D>,
}

/// The share of a face in one corner of a particle's domain.
pub(super) struct Corner {
    /// The particle.
    pub(super) particle: usize,
    /// Its nodes, with the values of their hats.
    pub(super) node: Vec<usize>,
    pub(super) w: Vec<f64>,
}

impl<const D: usize> Face<D> {
    fn new(
        particles: &Particles<D>,
        select: impl Fn(&[f64; D]) -> bool,
        (axis, end): (usize, End),
        acts: Acts<D>,
    ) -> Self {
        let chosen = particles.seeded(|k| select(&particles.reference[k]));
        Self { sides: chosen.iter().filter(|taken| **taken).count(), chosen, axis, end, acts }
    }

    /// The sides `at` an end of an axis of the particles that `select` takes by their reference positions (m), under a
    /// `traction` (Pa, of undeformed area) that depends on the time (s).
    pub fn loaded(
        particles: &Particles<D>,
        select: impl Fn(&[f64; D]) -> bool,
        at: (usize, End),
        traction: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) -> Self {
        Self::new(particles, select, at, Acts::Load(Box::new(traction)))
    }

    /// The same sides, where the water leaves at `penalty` (m/(Pa s)) times its pressure.
    pub fn drained(
        particles: &Particles<D>,
        select: impl Fn(&[f64; D]) -> bool,
        at: (usize, End),
        penalty: f64,
    ) -> Self {
        Self::new(particles, select, at, Acts::Drains { penalty })
    }

    /// The same face seen from `frame`.
    pub(super) fn seen_from(self, frame: &Frame<D>) -> Self {
        let (axis, end) = self.end.seen_from(self.axis, frame);
        let frame = *frame;
        let acts = match self.acts {
            Acts::Load(of) => Acts::Load(Box::new(move |time| frame.vector(&of(time), frame.scale(1, 0)))),
            Acts::Drains { penalty } => Acts::Drains { penalty: frame.scale(-1, 1) * penalty },
        };
        Self { axis, end, acts, ..self }
    }

    /// Refuses a face chosen from another number of `particles`.
    pub(super) fn check(&self, particles: usize) -> Result<(), Error> {
        let (of, axis) = (self.chosen.len(), self.axis);
        let what = "particles of the body that a face was chosen from";
        require(of == particles, what, of as f64, "those of the scene")?;
        require(axis < D, "axis of a face", axis as f64, "one of the grid's")?;
        let what = "particles of a loaded or drained face";
        require(self.sides > 0, what, self.sides as f64, "at least 1")?;
        match &self.acts {
            Acts::Load(traction) => {
                let mut components = traction(0.0).into_iter();
                let what = "traction on a face";
                components.try_for_each(|t| require(true, what, t, "finite (Pa)"))
            }
            Acts::Drains { penalty } => {
                let what = "penalty of a drained face";
                require(*penalty > 0.0, what, *penalty, "positive (m/(Pa s))")
            }
        }
    }

    /// Whether the side of a particle of this identity is part of it.
    pub(super) fn takes(&self, id: u32) -> bool {
        self.chosen[id as usize]
    }

    /// Corners of a side.
    pub(super) const CORNERS: usize = 1 << (D - 1);

    /// Area (m²; m in plane strain, 1 in 1D) of a side of a domain of half sizes `half_size` (m).
    pub(super) fn area(&self, half_size: &[f64; D]) -> f64 {
        let across = (0..D).filter(|a| *a != self.axis);
        across.map(|a| 2.0 * half_size[a]).product()
    }

    /// The corners of the face, with the hats of the nodes of a `space` there.
    ///
    /// # Errors
    /// A particle one of whose corners has a share on a node that is not `seen` by any particle, and so bears nothing.
    pub(super) fn corners(
        &self,
        space: &Space<D>,
        seen: impl Fn(usize) -> bool,
        particles: &Particles<D>,
        pores: &Pores<D>,
    ) -> Result<Vec<Corner>, (usize, Fault)> {
        let mut functions = Functions::new();
        let mut corners = Vec::new();
        let outward = match self.end {
            End::Lo => -1.0,
            End::Hi => 1.0,
        };
        for (p, x) in particles.position.iter().enumerate() {
            if !self.takes(particles.id[p]) {
                continue;
            }
            for corner in 0..Self::CORNERS {
                let mut bit = 0;
                let place = std::array::from_fn(|a| {
                    let sign = if a == self.axis {
                        outward
                    } else {
                        bit += 1;
                        f64::from((corner >> (bit - 1) & 1) as u8) * 2.0 - 1.0
                    };
                    x[a] + sign * pores.half_size[p][a]
                });
                space.functions.hats(&place, &mut functions);
                let node: Vec<usize> = (functions.node.iter()).map(|n| space.originals[*n]).collect();
                let mut shares = node.iter().zip(&functions.w);
                if let Some((_, share)) = shares.find(|(n, w)| w.abs() > NOTHING && !seen(**n)) {
                    return Err((p, Fault::EmptyCell(*share)));
                }
                corners.push(Corner { particle: p, node, w: functions.w.clone() });
            }
        }
        Ok(corners)
    }
}

/// A share of a corner that is rounding.
const NOTHING: f64 = 1e-10;
