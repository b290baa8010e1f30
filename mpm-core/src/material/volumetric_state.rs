//! State of a particle of a law whose flow changes the volume.

use super::State;
use crate::number::Real;
use crate::tensor::SymmetricTensor;

/// Elastic strain, and what flow has changed the volume by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumetricState<T = f64> {
    /// The elastic left Cauchy–Green tensor b_e.
    pub elastic: SymmetricTensor<T>,
    /// ln J_p = ln J − ½ ln det b_e, the plastic volume strain, extension positive.
    pub plastic_volume: T,
    /// Equivalent plastic strain √(2/3) ∫‖ε̇ᵖ‖ dt.
    pub plastic_strain: T,
}

impl State for VolumetricState {
    const NUMBERS: usize = 8;
    type Of<T: Real> = VolumetricState<T>;

    #[inline(always)]
    fn read<T: Real>(of: impl Fn(usize) -> T) -> VolumetricState<T> {
        VolumetricState { plastic_volume: of(6), plastic_strain: of(7), elastic: SymmetricTensor::read(of) }
    }

    #[inline(always)]
    fn write<T: Real>(of: &VolumetricState<T>, mut put: impl FnMut(usize, &T)) {
        SymmetricTensor::write(&of.elastic, &mut put);
        put(6, &of.plastic_volume);
        put(7, &of.plastic_strain);
    }
}
