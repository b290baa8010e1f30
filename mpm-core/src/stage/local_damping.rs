//! Local (Cundall) damping.

use super::ForceFilter;
use crate::error::{Error, require};
use crate::memory::Memoryless;
use crate::nodes::NodalState;

/// Opposes every component of a nodal velocity by the fraction `alpha` of that component's
/// out-of-balance force: f ← f − α |f| sign(v). It vanishes with the out-of-balance force and so
/// leaves the state of rest where it is (Al-Kafaji 2013, section 3.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalDamping {
    alpha: f64,
}

impl LocalDamping {
    /// Damping by the fraction `alpha`.
    ///
    /// # Errors
    /// `alpha` outside [0, 1).
    pub fn new(alpha: f64) -> Result<Self, Error> {
        require((0.0..1.0).contains(&alpha), "local damping factor", alpha, "at least 0 and less than 1")?;
        Ok(Self { alpha })
    }
}

impl Memoryless for LocalDamping {}

impl ForceFilter for LocalDamping {
    fn filter(&self, node: &mut NodalState) -> f64 {
        let mut power = 0.0;
        let velocity = node.motion.as_array()[..3].iter();
        for (v, f) in velocity.zip(&mut node.change.as_mut_array()[..3]) {
            if *v != 0.0 {
                let opposing = self.alpha * f.abs();
                power += opposing * v.abs();
                *f -= opposing * v.signum();
            }
        }
        power
    }
}
