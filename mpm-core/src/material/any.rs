//! A law as bodies hold it: chosen at run time, with the states of its particles as rows of numbers.

use super::{
    CamClay, DruckerPrager, Hencky, HenckyJ2, Hypoelastic, HypoelasticJ2, ImprovedHencky, Law, MohrCoulomb, NeoHookean,
    NewtonianFluid, State, StateOf, Viscous,
};
use crate::number::{Dual, EIGHT, Eight, Real};
use crate::space::embed_entries;
use crate::tensor::SymmetricTensor;
use nalgebra::Matrix3;
use std::array::from_fn;
use std::sync::Arc;

/// A law that answers with numbers `T`, of one particle.
pub trait Answers<T> {
    /// Cauchy stress (Pa) after the deformation `delta_f` over `dt` (s) from the state in `row`.
    fn stress(&self, delta_f: &Matrix3<T>, dt: f64, row: &[f64]) -> SymmetricTensor<T>;
}

impl<M: Law, T: Real> Answers<T> for M {
    fn stress(&self, delta_f: &Matrix3<T>, dt: f64, row: &[f64]) -> SymmetricTensor<T> {
        self.response(delta_f, dt, &read::<M, T>(row)).0
    }
}

/// A law as solvers ask it: one call for eight particles, and derivatives in a plane and in space. Every [`Law`] is one.
///
/// The state of a particle is a row of [`AnyLaw::numbers`] numbers; rows of several particles follow each other.
pub trait AnyLaw: Answers<f64> + Answers<Dual<5>> + Answers<Dual<10>> + Send + Sync {
    /// How many numbers the state of a particle has.
    fn numbers(&self) -> usize;

    /// [`Law::CONSERVATIVE`].
    fn conservative(&self) -> bool;

    /// [`Law::porosity`].
    fn porosity(&self) -> Option<f64>;

    /// [`Law::in_units`].
    fn in_units(&self, stress: f64) -> SharedLaw;

    /// [`Law::resting`] of the particle in `row`, whose state that becomes.
    fn at_rest(&self, f: &Matrix3<f64>, row: &mut [f64]) -> SymmetricTensor;

    /// [`Law::stronger`] of the state in `row`; whether the law can.
    fn stronger(&self, row: &mut [f64], share: f64) -> bool;

    /// Stress and state of up to eight particles after the deformation `delta_f` over `dt` (s), and their
    /// [`Law::wave_modulus`] (Pa) at the Jacobians `j`. `delta_f` has its entries row by row: one, four in plane strain or
    /// nine. `rows` has the state of each particle that there is, then the new one; Cauchy stresses (Pa) go to `stresses`.
    fn update_eight(
        &self,
        delta_f: &[Eight],
        dt: f64,
        j: Eight,
        rows: &mut [f64],
        stresses: &mut [SymmetricTensor],
    ) -> Eight;

    /// [`Law::wave_modulus`] of one particle.
    fn wave_modulus(&self, j: f64, stress: &SymmetricTensor, row: &[f64]) -> f64;

    /// [`Law::wave_speed`].
    fn wave_speed(&self, density: f64) -> f64;

    /// [`Law::plastic_strain`].
    fn plastic_strain(&self, row: &[f64]) -> f64;

    /// [`Law::energy`].
    fn energy(&self, row: &[f64]) -> f64;
}

/// A law that is chosen at run time, for as many bodies as have it.
pub type SharedLaw = Arc<dyn AnyLaw>;

/// Any law as one that is chosen at run time. Those of this crate become one by `into`, compiled here.
pub fn shared(law: impl Law + 'static) -> SharedLaw {
    Arc::new(law)
}

/// Compiles laws as those that are chosen at run time.
macro_rules! shared {
    ($($law:ty),*) => {$(
        impl From<$law> for SharedLaw {
            #[inline(never)]
            fn from(law: $law) -> Self {
                shared(law)
            }
        }
    )*};
}

shared!(
    CamClay,
    DruckerPrager,
    Hencky,
    HenckyJ2,
    Hypoelastic,
    HypoelasticJ2,
    ImprovedHencky,
    MohrCoulomb,
    NeoHookean,
    NewtonianFluid
);
shared!(Viscous<NeoHookean>);

/// The state in a row, as a constant.
#[inline(always)]
fn read<M: Law, T: Real>(row: &[f64]) -> StateOf<M, T> {
    M::State::read(|i| T::splat(row[i]))
}

/// [`AnyLaw::update_eight`] in `D` dimensions.
#[inline(always)]
fn eight<M: Law, const D: usize>(
    law: &M,
    delta_f: &[[Eight; D]; D],
    dt: f64,
    j: Eight,
    rows: &mut [f64],
    stresses: &mut [SymmetricTensor],
) -> Eight {
    let n = M::State::NUMBERS;
    let particles = rows.len() / n;
    let before = if particles == EIGHT {
        let rows = &rows[..EIGHT * n];
        M::State::read(|i| Eight::pack(|l| rows[l * n + i]))
    } else {
        M::State::read(|i| Eight::pack(|l| rows[l.min(particles - 1) * n + i]))
    };
    let (stress, after) = law.response(&embed_entries(delta_f), dt, &before);
    let put = |l: usize, row: &mut [f64]| M::State::write(&after, |i, number: &Eight| row[i] = number.as_array()[l]);
    if particles == EIGHT {
        let (rows, stresses) = (&mut rows[..EIGHT * n], &mut stresses[..EIGHT]);
        for l in 0..EIGHT {
            stresses[l] = stress.part(l);
            put(l, &mut rows[l * n..(l + 1) * n]);
        }
    } else {
        for (l, (row, one)) in rows.chunks_exact_mut(n).zip(stresses).enumerate() {
            *one = stress.part(l);
            put(l, row);
        }
    }
    law.wave_modulus(j, &stress, &after)
}

impl<M: Law + 'static> AnyLaw for M {
    fn numbers(&self) -> usize {
        M::State::NUMBERS
    }

    fn conservative(&self) -> bool {
        M::CONSERVATIVE
    }

    fn porosity(&self) -> Option<f64> {
        Law::porosity(self)
    }

    fn in_units(&self, stress: f64) -> SharedLaw {
        Arc::new(Law::in_units(self, stress))
    }

    fn at_rest(&self, f: &Matrix3<f64>, row: &mut [f64]) -> SymmetricTensor {
        let (stress, state) = Law::resting(self, f, &self.undeformed(&read::<M, f64>(row)));
        M::State::write::<f64>(&state, |i, number| row[i] = *number);
        stress
    }

    fn stronger(&self, row: &mut [f64], share: f64) -> bool {
        let state = Law::stronger(self, read::<M, f64>(row), share);
        state.inspect(|state| M::State::write::<f64>(state, |i, number| row[i] = *number)).is_some()
    }

    fn update_eight(
        &self,
        delta_f: &[Eight],
        dt: f64,
        j: Eight,
        rows: &mut [f64],
        stresses: &mut [SymmetricTensor],
    ) -> Eight {
        match *delta_f {
            [xx] => eight(self, &[[xx]], dt, j, rows, stresses),
            [xx, xy, yx, yy] => eight(self, &[[xx, xy], [yx, yy]], dt, j, rows, stresses),
            _ => eight::<_, 3>(self, &from_fn(|i| from_fn(|j| delta_f[3 * i + j])), dt, j, rows, stresses),
        }
    }

    fn wave_modulus(&self, j: f64, stress: &SymmetricTensor, row: &[f64]) -> f64 {
        Law::wave_modulus(self, j, stress, &read::<M, f64>(row))
    }

    fn wave_speed(&self, density: f64) -> f64 {
        Law::wave_speed(self, density)
    }

    fn plastic_strain(&self, row: &[f64]) -> f64 {
        Law::plastic_strain(self, &read::<M, f64>(row))
    }

    fn energy(&self, row: &[f64]) -> f64 {
        Law::energy(self, &read::<M, f64>(row))
    }
}
