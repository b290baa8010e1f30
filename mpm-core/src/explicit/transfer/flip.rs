//! The PIC/FLIP transfer, Eqs. (7), (8), (10)–(13).
//!
//! FLIP (Brackbill & Ruppel 1986, doi 10.1016/0021-9991(86)90211-1) adds the nodes' change to the
//! particle's velocity, PIC replaces it by the nodes' velocity. Particles move with Σ w_ip v_iⁿ⁺¹.

use super::Transfer;
use super::kernel::{Received, gather};
use crate::error::{Error, require};
use crate::lattice::StencilRef;
use crate::memory::Memoryless;
use crate::nodes::NodalState;
use crate::number::{EIGHT, Eight};
use nalgebra::SMatrix;

/// The blend η FLIP + (1 − η) PIC of Eq. (13); FLIP by default.
///
/// With no forces FLIP changes no velocity, so no energy, and keeps what no node sees; PIC keeps of a
/// velocity field what the transfer to the grid and back does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flip {
    eta: f64,
}

impl Flip {
    /// The blend with the share `eta` of FLIP: 1 is FLIP, 0 is PIC.
    ///
    /// # Errors
    /// `eta` outside [0, 1].
    pub fn new(eta: f64) -> Result<Self, Error> {
        require((0.0..=1.0).contains(&eta), "PIC/FLIP blend", eta, "from 0 (PIC) to 1 (FLIP)")?;
        Ok(Self { eta })
    }

    /// The share η of FLIP.
    pub fn share(&self) -> f64 {
        self.eta
    }
}

impl Default for Flip {
    fn default() -> Self {
        Self { eta: 1.0 }
    }
}

impl Memoryless for Flip {}

impl<const D: usize> Transfer<D> for Flip {
    type Gives<const S: usize> = ();
    type Receives = ();

    #[inline(always)]
    fn grid_to_particle<const S: usize>(
        &self,
        stencil: StencilRef<'_, D, S>,
        _gives: &(),
        nodes: &[NodalState],
        received: &mut Received<D>,
        _receives: &mut (),
    ) {
        gather(stencil, nodes, received, |_, _, _, _, _| {});
    }

    #[inline(always)]
    fn receive(
        &self,
        received: &Received<D>,
        _receives: &(),
        velocity: &mut [Eight; D],
        _affine: &mut Option<[SMatrix<f64, D, D>; EIGHT]>,
    ) -> [Eight; D] {
        let mut moving = [Eight::ZERO; D];
        let (flip, pic) = (Eight::splat(self.eta), Eight::splat(1.0 - self.eta));
        for a in 0..D {
            moving[a] = received.velocity(a);
            let changed = velocity[a] + received.increment(a);
            velocity[a] = flip * changed + pic * moving[a];
        }
        moving
    }
}
