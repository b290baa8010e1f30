//! References of a setup: finite elements of high order, at one load and three laws.

use super::{Cantilever, LawName};
use crate::exact::cantilever::{self, Solution, Stresses};
use crate::setup::Setup;

impl Setup<Cantilever> {
    /// The stresses; those of rate laws are not known.
    pub(super) fn stresses(&self) -> Result<&'static Stresses, String> {
        let stored = cantilever::stresses().ok_or("the stored stresses can't be read")?;
        self.solution()?;
        if self.young_modulus != 1e5 {
            return Err("the reference is for E = 100 kPa".to_owned());
        }
        match self.law {
            LawName::Hencky => Ok(&stored.hencky),
            LawName::NeoHookean => Ok(&stored.neo_hookean),
            _ => Err("no reference stresses of Jaumann's law".to_owned()),
        }
    }

    /// The solution: displacements depend on ν and weight over E alone.
    pub(super) fn solution(&self) -> Result<&'static Solution, String> {
        let stored = cantilever::solutions().ok_or("the stored reference can't be read")?;
        let load = self.weight / self.young_modulus;
        if (load - 0.04).abs() > 1e-12 || self.poisson_ratio != 0.0 {
            return Err("the reference is for ν = 0 and weight/E = 0.04/m".to_owned());
        }
        Ok(match self.law {
            LawName::Hencky => &stored.hencky,
            LawName::NeoHookean => &stored.neo_hookean,
            _ => &stored.jaumann,
        })
    }
}
