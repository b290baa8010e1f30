//! Schemes by solver kind, and their names.

use mpm_core::explicit::Remedy;
use mpm_core::explicit::remedy::{Fbar, Form, Onto, Standard};
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::fmt;
use std::sync::OnceLock;
use thiserror::Error;

/// An error in a name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NameError {
    /// One of several kinds of names; the error lists those that are known.
    #[error("unknown {kind} \"{given}\"; allowed: {}", allowed.join(", "))]
    Unknown {
        /// Kind of the name.
        kind: &'static str,
        /// The name.
        given: String,
        /// Those that are known.
        allowed: &'static [&'static str],
    },
    /// A scheme that lacks a part.
    #[error(
        "scheme \"{0}\" is not of the form basis-remedy-transfer, solver-basis-remedy or poro-basis-space, as gimp-fbar-consistent-flip, quasi-static-gimp-none or poro-gimp-two-grid; `explain` lists those of a case"
    )]
    Form(String),
    /// A second remedy of one's own.
    #[error("the remedy `own` is set already")]
    SetAlready,
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
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
    /// Another member of the family: its form, and the functions that average.
    Other(Form, Onto),
    /// A remedy of the program that links this package: see [`set_own_remedy`].
    Own,
}

/// The remedy `own` of runs in `D` dimensions, once it is set.
static OWN: OnceLock<Box<dyn Any + Send + Sync>> = OnceLock::new();

/// Sets the remedy that `own` stands for in explicit runs of `D` dimensions of this process: once, for one `D`.
///
/// # Errors
/// It is set already.
pub fn set_own_remedy<const D: usize>(make: fn() -> Box<dyn Remedy<D>>) -> Result<(), NameError> {
    OWN.set(Box::new(make)).map_err(|_| NameError::SetAlready)
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
    /// FLIP with strains from velocities that were mapped again.
    Musl,
    /// No transfer: implicit solvers have no choice of it.
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
    /// The remedy; that of standard MPM for an `own` that is not set, which the solvers of this package refuse.
    #[must_use]
    pub fn build<const D: usize>(self) -> Box<dyn Remedy<D>> {
        match (self.fbar(), self.own()) {
            (Some(fbar), _) => Box::new(fbar),
            (None, Some(make)) => make(),
            (None, None) => Box::new(Standard),
        }
    }

    /// Maker of the remedy set by [`set_own_remedy`], if this is its name and it is of `D` dimensions.
    #[must_use]
    pub fn own<const D: usize>(self) -> Option<fn() -> Box<dyn Remedy<D>>> {
        let own = OWN.get().filter(|_| self == Self::Own)?;
        own.downcast_ref().copied()
    }

    /// The member of the F̄ family, if it is one.
    #[must_use]
    pub fn fbar(self) -> Option<Fbar> {
        let (form, onto) = match self {
            Self::None | Self::Own => return None,
            Self::FbarRecursive => (Form::Recursive, Onto::Basis),
            Self::FbarTotal => (Form::Total, Onto::Basis),
            Self::FbarRate => (Form::Rate, Onto::Basis),
            Self::FbarConsistent => (Form::Consistent, Onto::Basis),
            Self::Other(form, onto) => (form, onto),
        };
        Some(Fbar::new(form).onto(onto))
    }
}

/// A name that is written and read as serde does.
macro_rules! plain_text {
    ($type:ty, $kind:literal, [$($variant:expr => $text:literal),+] $(, unlisted $other:expr => $name:literal)?) => {
        impl $type {
            /// The names.
            pub const NAMES: &[&str] = &[$($text),+];

            /// The name as it stands on the command line and in records.
            #[must_use]
            pub fn text(self) -> &'static str {
                $(if self == $variant { return $text; })+
                $(if self == $other { return $name; })?
                ""
            }

            /// From its name.
            ///
            /// # Errors
            /// An unknown name; the error lists the known ones.
            pub fn parse(name: &str) -> Result<Self, NameError> {
                $(if name == $text { return Ok($variant); })+
                $(if name == $name { return Ok($other); })?
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
    Self::FbarConsistent => "fbar-consistent",
    Self::Other(Form::Bbar, Onto::Basis) => "bbar",
    Self::Other(Form::Bbar, Onto::Hats) => "bbar-hats",
    Self::Other(Form::Bbar, Onto::Cells) => "bbar-cells",
    Self::Other(Form::Bbar, Onto::Blocks) => "bbar-blocks",
    Self::Other(Form::Bbar, Onto::Patches) => "bbar-patches",
    Self::Other(Form::Recursive, Onto::Hats) => "fbar-recursive-hats",
    Self::Other(Form::Recursive, Onto::Cells) => "fbar-recursive-cells",
    Self::Other(Form::Recursive, Onto::Blocks) => "fbar-recursive-blocks",
    Self::Other(Form::Recursive, Onto::Patches) => "fbar-recursive-patches",
    Self::Other(Form::Total, Onto::Hats) => "fbar-total-hats",
    Self::Other(Form::Total, Onto::Cells) => "fbar-total-cells",
    Self::Other(Form::Total, Onto::Blocks) => "fbar-total-blocks",
    Self::Other(Form::Total, Onto::Patches) => "fbar-total-patches",
    Self::Other(Form::Rate, Onto::Hats) => "fbar-rate-hats",
    Self::Other(Form::Rate, Onto::Cells) => "fbar-rate-cells",
    Self::Other(Form::Rate, Onto::Blocks) => "fbar-rate-blocks",
    Self::Other(Form::Rate, Onto::Patches) => "fbar-rate-patches",
    Self::Other(Form::Consistent, Onto::Hats) => "fbar-consistent-hats",
    Self::Other(Form::Consistent, Onto::Cells) => "fbar-consistent-cells",
    Self::Other(Form::Consistent, Onto::Blocks) => "fbar-consistent-blocks",
    Self::Other(Form::Consistent, Onto::Patches) => "fbar-consistent-patches"],
    unlisted Self::Own => "own");
plain_text!(TransferName, "transfer", [
    Self::Flip => "flip", Self::Apic => "apic", Self::Xpic2 => "xpic2",
    Self::Musl => "musl", Self::None => "none"]);

/// Kinds of implicit solvers, by the equations of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleName {
    /// Equilibrium at every load step.
    QuasiStatic,
    /// The implicit midpoint rule.
    Midpoint,
    /// Newmark's rule, as Wang et al. 2016 print it.
    Newmark,
}

plain_text!(RuleName, "solver", [
    Self::QuasiStatic => "quasi-static", Self::Midpoint => "midpoint", Self::Newmark => "newmark"]);

/// Spaces of the pore pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpaceName {
    /// The displacement's functions on cells twice as large.
    TwoGrid,
    /// Those on the same cells.
    Equal,
    /// Those on the same cells, with a polynomial pressure projection.
    Ppp,
}

plain_text!(SpaceName, "pressure space", [
    Self::TwoGrid => "two-grid", Self::Equal => "equal", Self::Ppp => "ppp"]);

/// A scheme, by the kind of its solver. Files and the command line hold its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Scheme {
    /// Explicit in time: basis-remedy-transfer.
    Explicit(Explicit),
    /// Implicit: rule-basis-remedy, such as quasi-static-gimp-none.
    Implicit(Implicit),
    /// Solid and water: poro-basis-space, such as poro-gimp-two-grid.
    Poro(Poro),
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

/// A scheme of the implicit solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Implicit {
    /// The equations of a step.
    pub rule: RuleName,
    /// Basis functions.
    pub basis: BasisName,
    /// Locking remedy.
    pub remedy: RemedyName,
}

/// A scheme of the solver of solid and water.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poro {
    /// Basis functions of the displacement and the pressure.
    pub basis: BasisName,
    /// Space of the pressure.
    pub space: SpaceName,
}

impl Scheme {
    /// A scheme of solid and water.
    #[must_use]
    pub const fn poro(basis: BasisName, space: SpaceName) -> Self {
        Self::Poro(Poro { basis, space })
    }

    /// An explicit scheme.
    #[must_use]
    pub const fn explicit(basis: BasisName, remedy: RemedyName, transfer: TransferName) -> Self {
        Self::Explicit(Explicit { basis, remedy, transfer })
    }

    /// An explicit scheme with the FLIP transfer.
    #[must_use]
    pub const fn flip(basis: BasisName, remedy: RemedyName) -> Self {
        Self::explicit(basis, remedy, TransferName::Flip)
    }

    /// An implicit scheme.
    #[must_use]
    pub const fn implicit(rule: RuleName, basis: BasisName, remedy: RemedyName) -> Self {
        Self::Implicit(Implicit { rule, basis, remedy })
    }

    /// A quasi-static scheme.
    #[must_use]
    pub const fn quasi_static(basis: BasisName, remedy: RemedyName) -> Self {
        Self::implicit(RuleName::QuasiStatic, basis, remedy)
    }

    /// The same kind of scheme with another basis and remedy.
    #[must_use]
    pub const fn with(self, basis: BasisName, remedy: RemedyName) -> Self {
        match self {
            Self::Explicit(e) => Self::explicit(basis, remedy, e.transfer),
            Self::Implicit(i) => Self::implicit(i.rule, basis, remedy),
            Self::Poro(p) => Self::poro(basis, p.space),
        }
    }

    /// The scheme for which a case is made: `fbar-consistent` for another member of its family.
    #[must_use]
    pub const fn of_the_family(self) -> Self {
        match self.remedy() {
            RemedyName::Other(..) => self.with(self.basis(), RemedyName::FbarConsistent),
            _ => self,
        }
    }

    /// The kinds of solvers.
    pub const SOLVERS: &[&str] = &["explicit", "quasi-static", "midpoint", "newmark", "poro"];

    /// Name of the solver's kind, as `--solver` takes it.
    #[must_use]
    pub fn solver(self) -> &'static str {
        match self {
            Self::Explicit(_) => "explicit",
            Self::Implicit(i) => i.rule.text(),
            Self::Poro(_) => "poro",
        }
    }

    /// Its rule of time, if it is implicit.
    #[must_use]
    pub const fn rule(self) -> Option<RuleName> {
        match self {
            Self::Explicit(_) | Self::Poro(_) => None,
            Self::Implicit(i) => Some(i.rule),
        }
    }

    /// Its basis functions.
    #[must_use]
    pub const fn basis(self) -> BasisName {
        match self {
            Self::Explicit(e) => e.basis,
            Self::Implicit(i) => i.basis,
            Self::Poro(p) => p.basis,
        }
    }

    /// Its locking remedy.
    #[must_use]
    pub const fn remedy(self) -> RemedyName {
        match self {
            Self::Explicit(e) => e.remedy,
            Self::Implicit(i) => i.remedy,
            Self::Poro(_) => RemedyName::None,
        }
    }

    /// Its transfer, if it has a choice of it.
    #[must_use]
    pub const fn transfer(self) -> TransferName {
        match self {
            Self::Explicit(e) => e.transfer,
            Self::Implicit(_) | Self::Poro(_) => TransferName::None,
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
        let unknown = |kind, given: &str, allowed| NameError::Unknown { kind, given: given.to_owned(), allowed };
        let none = transfer == TransferName::None;
        match (solver, RuleName::parse(solver)) {
            ("explicit", _) if none => {
                let what = "transfer of an explicit scheme";
                Err(unknown(what, transfer.text(), &["flip", "apic", "xpic2", "musl"]))
            }
            ("explicit", _) => Ok(Self::explicit(basis, remedy, transfer)),
            (_, Ok(rule)) if none => Ok(Self::implicit(rule, basis, remedy)),
            (_, Ok(_)) => {
                let what = "transfer of an implicit scheme";
                Err(unknown(what, transfer.text(), &["none"]))
            }
            ("poro", _) if none && remedy == RemedyName::None => Ok(Self::poro(basis, SpaceName::TwoGrid)),
            ("poro", _) => {
                let what = "remedy or transfer of a scheme of solid and water";
                let given = if none { remedy.text() } else { transfer.text() };
                Err(unknown(what, given, &["none"]))
            }
            _ => Err(unknown("solver", solver, Self::SOLVERS)),
        }
    }

    /// In short, for people: FLIP goes without saying.
    #[must_use]
    pub fn title(self) -> String {
        let (basis, remedy) = (self.basis(), self.remedy());
        match self {
            Self::Explicit(e) if e.transfer == TransferName::Flip => format!("{basis} {remedy}"),
            Self::Explicit(e) => format!("{basis} {remedy} {}", e.transfer),
            Self::Implicit(i) if i.rule == RuleName::QuasiStatic => {
                format!("{basis} {remedy} static")
            }
            Self::Implicit(i) => format!("{basis} {remedy} {}", i.rule),
            Self::Poro(p) => format!("{basis} {}", p.space),
        }
    }

    /// From its name.
    ///
    /// # Errors
    /// A part that is missing or unknown.
    pub fn parse(name: &str) -> Result<Self, NameError> {
        for rule in [RuleName::QuasiStatic, RuleName::Midpoint, RuleName::Newmark] {
            if let Some(rest) = name.strip_prefix(rule.text()) {
                let parts = rest.strip_prefix('-').and_then(|rest| rest.split_once('-'));
                let (basis, remedy) = parts.ok_or_else(|| NameError::Form(name.to_owned()))?;
                let (basis, remedy) = (BasisName::parse(basis)?, RemedyName::parse(remedy)?);
                return Ok(Self::implicit(rule, basis, remedy));
            }
        }
        if let Some(rest) = name.strip_prefix("poro-") {
            let parts = rest.split_once('-');
            let (basis, space) = parts.ok_or_else(|| NameError::Form(name.to_owned()))?;
            return Ok(Self::poro(BasisName::parse(basis)?, SpaceName::parse(space)?));
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
            Self::Implicit(i) => write!(f, "{}-{}-{}", i.rule, i.basis, i.remedy),
            Self::Poro(p) => write!(f, "poro-{}-{}", p.basis, p.space),
        }
    }
}
