//! Schemes: a basis, a locking remedy and a transfer.

use crate::error::Error;
use mpm_core::Remedy;
use mpm_core::remedy::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal, Standard};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Basis functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BasisName {
    /// Linear hat functions.
    Linear,
    /// Uniform generalised interpolation.
    Gimp,
    /// Quadratic B-splines.
    Bspline2,
    /// Cubic B-splines.
    Bspline3,
}

/// Locking remedies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RemedyName {
    /// Standard MPM.
    None,
    /// Algorithm 1 as printed.
    FbarRecursive,
    /// The average of the true Jacobian.
    FbarTotal,
    /// The average of the increment.
    FbarRate,
    /// The average of the increment, and of the pressure in the force.
    FbarConsistent,
}

/// Transfers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TransferName {
    /// PIC/FLIP blend.
    Flip,
    /// Affine particle-in-cell.
    Apic,
    /// XPIC of order 2.
    Xpic2,
    /// XPIC of order 3.
    Xpic3,
}

impl RemedyName {
    /// The remedy.
    #[must_use]
    pub fn build<const D: usize>(self) -> Box<dyn Remedy<D>> {
        match self {
            Self::None => Box::new(Standard),
            Self::FbarRecursive => Box::new(FbarRecursive::default()),
            Self::FbarTotal => Box::new(FbarTotal::default()),
            Self::FbarRate => Box::new(FbarRate::default()),
            Self::FbarConsistent => Box::new(FbarConsistent::default()),
        }
    }
}

/// A name that is written and read as serde does.
macro_rules! plain_text {
    ($type:ty, $kind:literal, [$($variant:expr => $text:literal),+]) => {
        impl $type {
            /// The name as it stands on the command line and in records.
            #[must_use]
            pub fn text(self) -> &'static str {
                $(if self == $variant { return $text; })+
                ""
            }

            /// From its name.
            ///
            /// # Errors
            /// An unknown name; the error lists the known ones.
            pub fn parse(name: &str) -> Result<Self, Error> {
                $(if name == $text { return Ok($variant); })+
                Err(Error::unknown($kind, name, [$($text),+]))
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.text())
            }
        }
    };
}

plain_text!(BasisName, "basis", [
    Self::Linear => "linear", Self::Gimp => "gimp",
    Self::Bspline2 => "bspline2", Self::Bspline3 => "bspline3"]);
plain_text!(RemedyName, "remedy", [
    Self::None => "none", Self::FbarRecursive => "fbar-recursive",
    Self::FbarTotal => "fbar-total", Self::FbarRate => "fbar-rate",
    Self::FbarConsistent => "fbar-consistent"]);
plain_text!(TransferName, "transfer", [
    Self::Flip => "flip", Self::Apic => "apic", Self::Xpic2 => "xpic2", Self::Xpic3 => "xpic3"]);

/// A scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Scheme {
    /// Basis functions.
    pub basis: BasisName,
    /// Locking remedy.
    pub remedy: RemedyName,
    /// Transfer.
    pub transfer: TransferName,
}

impl Scheme {
    /// A scheme with the FLIP transfer.
    #[must_use]
    pub fn flip(basis: BasisName, remedy: RemedyName) -> Self {
        Self {
            basis,
            remedy,
            transfer: TransferName::Flip,
        }
    }
}

impl Scheme {
    /// From its name, basis-remedy-transfer.
    ///
    /// # Errors
    /// A part that is missing or unknown.
    pub fn parse(name: &str) -> Result<Self, Error> {
        let parts = name.split_once('-').and_then(|(basis, rest)| {
            let (remedy, transfer) = rest.rsplit_once('-')?;
            Some((basis, remedy, transfer))
        });
        let Some((basis, remedy, transfer)) = parts else {
            return Err(Error::Input(format!(
                "scheme \"{name}\" is not of the form basis-remedy-transfer"
            )));
        };
        Ok(Self {
            basis: BasisName::parse(basis)?,
            remedy: RemedyName::parse(remedy)?,
            transfer: TransferName::parse(transfer)?,
        })
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}-{}", self.basis, self.remedy, self.transfer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scheme_reads_back_from_its_name() {
        let scheme = Scheme::flip(BasisName::Bspline2, RemedyName::FbarRate);
        assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        for bad in ["", "gimp", "gimp-flip", "gimp-none-", "gimp-fbar-flip"] {
            assert!(Scheme::parse(bad).is_err(), "{bad}");
        }
    }
}
