//! State of a particle of clay.

use crate::material::State;
use crate::number::{Lanes, Real};
use crate::tensor::SymmetricTensor;
use serde::{Deserialize, Serialize};

/// The state of [`CamClay`](super::CamClay).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CamClayState<T = f64> {
    /// The elastic left Cauchy–Green tensor b_e.
    pub elastic: SymmetricTensor<T>,
    /// ln J_p = ln J − ½ ln det b_e, the plastic volume strain, extension positive.
    pub plastic_volume: T,
    /// Equivalent plastic strain √(2/3) ∫‖ε̇ᵖ‖ dt.
    pub plastic_strain: T,
}

impl State for CamClayState {
    type Of<T: Real> = CamClayState<T>;

    #[inline(always)]
    fn pack<T: Real>(of: impl Fn(usize) -> Self) -> CamClayState<T> {
        CamClayState {
            elastic: SymmetricTensor::pack(|k| of(k).elastic),
            plastic_volume: T::pack(|k| of(k).plastic_volume),
            plastic_strain: T::pack(|k| of(k).plastic_strain),
        }
    }

    #[inline(always)]
    fn part<T: Lanes>(of: &CamClayState<T>, k: usize) -> Self {
        Self {
            elastic: of.elastic.part(k),
            plastic_volume: of.plastic_volume.part(k),
            plastic_strain: of.plastic_strain.part(k),
        }
    }
}
