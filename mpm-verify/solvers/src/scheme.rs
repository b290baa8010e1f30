//! Schemes by solver kind, and their names.

use mpm_core::explicit::Remedy;
use mpm_core::explicit::remedy::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal, Standard};
use serde::{Deserialize, Serialize};
use std::fmt;
use thiserror::Error;

/// A name that stands for nothing.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NameError {
    /// One of several kinds of names; the error lists those that are known.
    #[error("unknown {kind} \"{given}\"; allowed: {}", allowed.join(", "))]
    Unknown {
        /// What it should name.
        kind: &'static str,
        /// The name.
        given: String,
        /// Those that are known.
        allowed: &'static [&'static str],
    },
    /// A scheme that lacks a part.
    #[error("scheme \"{0}\" is not of the form basis-remedy-transfer or quasi-static-basis-remedy")]
    Form(String),
}

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
    /// Serendipity elements with eight nodes.
    Q8,
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
    /// Of a solver without velocities.
    None,
}

impl BasisName {
    /// Polynomial degree, along an axis, of its smoothest piecewise functions.
    #[must_use]
    pub const fn degree(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Gimp | Self::Bspline2 | Self::Q8 => 2,
            Self::Bspline3 => 3,
        }
    }
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
            /// The names.
            pub const NAMES: &[&str] = &[$($text),+];

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
            pub fn parse(name: &str) -> Result<Self, NameError> {
                $(if name == $text { return Ok($variant); })+
                Err(NameError::Unknown {
                    kind: $kind,
                    given: name.to_owned(),
                    allowed: Self::NAMES,
                })
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
    Self::Bspline2 => "bspline2", Self::Bspline3 => "bspline3", Self::Q8 => "q8"]);
plain_text!(RemedyName, "remedy", [
    Self::None => "none", Self::FbarRecursive => "fbar-recursive",
    Self::FbarTotal => "fbar-total", Self::FbarRate => "fbar-rate",
    Self::FbarConsistent => "fbar-consistent"]);
plain_text!(TransferName, "transfer", [
    Self::Flip => "flip", Self::Apic => "apic", Self::Xpic2 => "xpic2", Self::None => "none"]);

/// A scheme, by the kind of its solver. Files and the command line hold its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Scheme {
    /// Explicit in time: basis-remedy-transfer.
    Explicit(Explicit),
    /// Equilibrium at every load step: quasi-static-basis-remedy.
    QuasiStatic(QuasiStatic),
}

/// A scheme of the explicit solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Explicit {
    /// Basis functions.
    pub basis: BasisName,
    /// Locking remedy.
    pub remedy: RemedyName,
    /// Transfer.
    pub transfer: TransferName,
}

/// A scheme of the quasi-static solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct QuasiStatic {
    /// Basis functions.
    pub basis: BasisName,
    /// Locking remedy.
    pub remedy: RemedyName,
}

/// What names of quasi-static schemes begin with.
const QUASI_STATIC: &str = "quasi-static";

impl Scheme {
    /// An explicit scheme, or without a transfer a quasi-static one.
    #[must_use]
    pub const fn new(basis: BasisName, remedy: RemedyName, transfer: TransferName) -> Self {
        match transfer {
            TransferName::None => Self::quasi_static(basis, remedy),
            _ => Self::explicit(basis, remedy, transfer),
        }
    }

    /// A quasi-static scheme.
    #[must_use]
    pub const fn quasi_static(basis: BasisName, remedy: RemedyName) -> Self {
        Self::QuasiStatic(QuasiStatic { basis, remedy })
    }

    /// An explicit scheme.
    #[must_use]
    pub const fn explicit(basis: BasisName, remedy: RemedyName, transfer: TransferName) -> Self {
        Self::Explicit(Explicit {
            basis,
            remedy,
            transfer,
        })
    }

    /// An explicit scheme with the FLIP transfer.
    #[must_use]
    pub const fn flip(basis: BasisName, remedy: RemedyName) -> Self {
        Self::explicit(basis, remedy, TransferName::Flip)
    }

    /// The kinds of solvers.
    pub const SOLVERS: &[&str] = &["explicit", QUASI_STATIC];

    /// Name of the solver's kind, as `--solver` takes it.
    #[must_use]
    pub const fn solver(self) -> &'static str {
        match self {
            Self::Explicit(_) => "explicit",
            Self::QuasiStatic(_) => QUASI_STATIC,
        }
    }

    /// Its basis functions.
    #[must_use]
    pub const fn basis(self) -> BasisName {
        match self {
            Self::Explicit(e) => e.basis,
            Self::QuasiStatic(q) => q.basis,
        }
    }

    /// Its locking remedy.
    #[must_use]
    pub const fn remedy(self) -> RemedyName {
        match self {
            Self::Explicit(e) => e.remedy,
            Self::QuasiStatic(q) => q.remedy,
        }
    }

    /// Its transfer, if it has velocities.
    #[must_use]
    pub const fn transfer(self) -> TransferName {
        match self {
            Self::Explicit(e) => e.transfer,
            Self::QuasiStatic(_) => TransferName::None,
        }
    }

    /// From the names of a solver and of its parts.
    ///
    /// # Errors
    /// One of them is unknown.
    pub fn of_parts(
        solver: &str,
        basis: BasisName,
        remedy: RemedyName,
        transfer: TransferName,
    ) -> Result<Self, NameError> {
        let unknown = |kind, given: &str, allowed| NameError::Unknown {
            kind,
            given: given.to_owned(),
            allowed,
        };
        match (solver, transfer) {
            ("explicit", TransferName::None) => {
                let allowed = &["flip", "apic", "xpic2"];
                Err(unknown(
                    "transfer of an explicit scheme",
                    transfer.text(),
                    allowed,
                ))
            }
            ("explicit", transfer) => Ok(Self::explicit(basis, remedy, transfer)),
            (QUASI_STATIC, TransferName::None) => Ok(Self::quasi_static(basis, remedy)),
            (QUASI_STATIC, _) => {
                let what = "transfer of a quasi-static scheme";
                Err(unknown(what, transfer.text(), &["none"]))
            }
            _ => Err(unknown("solver", solver, Self::SOLVERS)),
        }
    }

    /// In short, for people: FLIP goes without saying.
    #[must_use]
    pub fn title(self) -> String {
        let (basis, remedy, transfer) = (self.basis(), self.remedy(), self.transfer());
        match transfer {
            TransferName::Flip => format!("{basis} {remedy}"),
            TransferName::None => format!("{basis} {remedy} static"),
            _ => format!("{basis} {remedy} {transfer}"),
        }
    }

    /// From its name.
    ///
    /// # Errors
    /// A part that is missing or unknown.
    pub fn parse(name: &str) -> Result<Self, NameError> {
        if let Some((_, rest)) = name.split_once(QUASI_STATIC).filter(|(b, _)| b.is_empty()) {
            let parts = rest.strip_prefix('-').and_then(|rest| rest.split_once('-'));
            let (basis, remedy) = parts.ok_or_else(|| NameError::Form(name.to_owned()))?;
            let (basis, remedy) = (BasisName::parse(basis)?, RemedyName::parse(remedy)?);
            return Ok(Self::quasi_static(basis, remedy));
        }
        let parts = name.split_once('-').and_then(|(basis, rest)| {
            let (remedy, transfer) = rest.rsplit_once('-')?;
            Some((basis, remedy, transfer))
        });
        let (basis, remedy, transfer) = parts.ok_or_else(|| NameError::Form(name.to_owned()))?;
        let (basis, remedy) = (BasisName::parse(basis)?, RemedyName::parse(remedy)?);
        Self::of_parts("explicit", basis, remedy, TransferName::parse(transfer)?)
    }
}

impl From<Scheme> for String {
    fn from(scheme: Scheme) -> Self {
        scheme.to_string()
    }
}

impl TryFrom<String> for Scheme {
    type Error = NameError;

    fn try_from(name: String) -> Result<Self, NameError> {
        Self::parse(&name)
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Explicit(e) => write!(f, "{}-{}-{}", e.basis, e.remedy, e.transfer),
            Self::QuasiStatic(q) => write!(f, "{QUASI_STATIC}-{}-{}", q.basis, q.remedy),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scheme_reads_back_from_its_name() {
        let scheme = Scheme::flip(BasisName::Bspline2, RemedyName::FbarRate);
        assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        let scheme = Scheme::quasi_static(BasisName::Gimp, RemedyName::FbarConsistent);
        assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        for bad in [
            "",
            "gimp",
            "gimp-flip",
            "gimp-none-",
            "gimp-fbar-flip",
            "gimp-none-none",
            "quasi-static",
            "quasi-static-gimp",
            "quasi-static-gimp-none-flip",
        ] {
            assert!(Scheme::parse(bad).is_err(), "{bad}");
        }
    }
}
