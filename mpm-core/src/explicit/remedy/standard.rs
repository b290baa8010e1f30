//! Standard MPM: J̄ = J.

use super::{Deformation, Remedy};
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;

/// No remedy: ΔF̄ = ΔF, no averaged Jacobian is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Standard;

impl Memoryless for Standard {}

impl<const D: usize> Remedy<D> for Standard {
    fn averages(&self) -> bool {
        false
    }

    fn next_j_bar(&mut self, _: &Particles<D>, _: &Deformation<D>, _: &mut dyn Average<D>) -> Option<&[f64]> {
        None
    }
}
