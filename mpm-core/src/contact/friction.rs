//! Coulomb's law with an elastic stick.

use crate::error::{Error, positive, require};
use nalgebra::{SMatrix, SVector};

/// Friction between a particle and a rigid body: a spring of tangential stiffness k_t holds the particle to the
/// body, up to μ times the normal force, beyond which its foot slides (Coulomb's law with the return of plasticity,
/// Simo & Laursen 1992, doi 10.1016/0045-7949(92)90540-G). A stick is elastic: it does not creep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    mu: f64,
    stiffness: f64,
}

impl Friction {
    /// The coefficient μ = `mu` with a stick of k_t = `stiffness` (N/m per particle; per metre of depth in plane
    /// strain).
    ///
    /// # Errors
    /// A coefficient that is negative or not finite, a stiffness that is not positive and finite.
    pub fn new(mu: f64, stiffness: f64) -> Result<Self, Error> {
        require(mu >= 0.0, "friction coefficient", mu, "not negative")?;
        Ok(Self { mu, ..Self::rough(stiffness)? })
    }

    /// A stick of k_t = `stiffness` (N/m per particle) that never slips while the bodies touch: μ is infinite.
    ///
    /// # Errors
    /// A stiffness that is not positive and finite.
    pub fn rough(stiffness: f64) -> Result<Self, Error> {
        positive(stiffness, "stiffness of a stick", "positive (N/m)")?;
        Ok(Self { mu: f64::INFINITY, stiffness })
    }

    /// The same friction in units of which a stiffness of one is `stiffness`.
    pub(super) fn in_units(self, stiffness: f64) -> Self {
        Self { stiffness: stiffness * self.stiffness, ..self }
    }

    /// Stiffness k_t (N/m) of the stick.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The coefficient μ, unless the stick never slips.
    pub fn coefficient(&self) -> Option<f64> {
        self.mu.is_finite().then_some(self.mu)
    }

    /// The share of a stretch (m) that the stick cannot hold which it keeps under the normal force `normal` (N), and
    /// the length of the stretch (m); none if it holds all of it.
    fn kept<const D: usize>(&self, stretch: &[f64; D], normal: f64) -> Option<[f64; 2]> {
        let length = stretch.iter().map(|u| u * u).sum::<f64>().sqrt();
        let longest = self.mu * normal / self.stiffness;
        (length > longest).then_some([longest / length, length])
    }

    /// Force (N) on a particle whose stick is stretched by `stretch` (m), under the normal force `normal` (N,
    /// positive). The stick gives up the stretch that it cannot hold.
    pub fn force<const D: usize>(&self, stretch: &mut [f64; D], normal: f64) -> [f64; D] {
        if let Some([share, _]) = self.kept(stretch, normal) {
            *stretch = stretch.map(|u| u * share);
        }
        stretch.map(|u| -self.stiffness * u)
    }

    /// −∂t/∂u (N/m) and ∂t/∂N of the [`force`](Self::force) t at the `stretch` u (m) before it gives up anything: k_t I
    /// and zero while it holds, (μN/|u|) (I − e ⊗ e) and −μ e, e = u/|u|, while it slips.
    pub(crate) fn tangent<const D: usize>(
        &self,
        stretch: &[f64; D],
        normal: f64,
    ) -> (SMatrix<f64, D, D>, SVector<f64, D>) {
        match self.kept(stretch, normal) {
            // A smooth face holds nothing, unstretched or not.
            None if self.mu == 0.0 => (SMatrix::zeros(), SVector::zeros()),
            None => (SMatrix::identity() * self.stiffness, SVector::zeros()),
            Some([share, length]) => {
                let along = SVector::from(*stretch) / length;
                ((SMatrix::identity() - along * along.transpose()) * (share * self.stiffness), along * -self.mu)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_bodies_slide_and_rough_ones_hold() {
        let mut stretch = [0.3, 0.0];
        assert_eq!(Friction::rough(10.0).unwrap().force(&mut stretch, 1e-9), [-3.0, -0.0]);
        let smooth = Friction::new(0.0, 10.0).unwrap();
        assert_eq!(smooth.force(&mut stretch, 1e9), [0.0; 2]);
        assert_eq!(smooth.tangent(&[0.0; 2], 1e9), Default::default());
        assert_eq!(stretch, [0.0; 2]);
        assert_eq!(smooth.force(&mut stretch, 1e9), [0.0; 2]);
    }
}
