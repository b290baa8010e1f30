//! Standard MPM: J̄ = J.

use super::Remedy;
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::projection::Average;

/// No remedy: ΔF̄ = ΔF, no averaged Jacobian is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Standard;

impl Memoryless for Standard {}

impl<const D: usize> Remedy<D> for Standard {
    fn adjust_delta_f(&mut self, _particles: &mut Particles<D>, _average: &mut dyn Average<D>) {}
}
