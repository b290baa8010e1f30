//! One run: a scheme at a level, with the parameters that are changed.

use crate::scheme::Scheme;
use serde::Serialize;

/// A level of refinement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Level {
    /// Name.
    pub name: &'static str,
    /// Cell size (m).
    pub h: f64,
}

impl Level {
    /// A level by name and cell size (m).
    pub(crate) const fn new(name: &'static str, h: f64) -> Self {
        Self { name, h }
    }
}

/// One run of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSpec {
    /// Scheme.
    pub scheme: Scheme,
    /// Level.
    pub level: Level,
    /// Parameters changed from the defaults, as `name=value`.
    pub set: Vec<String>,
    /// Whether every particle starts a last bit beside its place: what such a twin differs in is how far
    /// results can be trusted to the digit.
    pub perturbed: bool,
}

impl RunSpec {
    /// Folder of the run below that of its case.
    #[must_use]
    pub fn folder(&self) -> String {
        run_folder(self.scheme, self.level.name, &self.set) + if self.perturbed { "/twin" } else { "" }
    }
}

/// Initial positions (m) of particles seeded at `positions`: these, or, if `perturbed`, the next floating-point numbers above
/// and below in turn.
pub(crate) fn start_at<const D: usize>(mut positions: Vec<[f64; D]>, perturbed: bool) -> Vec<[f64; D]> {
    if perturbed {
        for (k, x) in positions.iter_mut().flatten().enumerate() {
            *x = if k % 3 == 0 { x.next_up() } else { x.next_down() };
        }
    }
    positions
}

/// Name of a run, which is also its folder below that of its case.
pub(crate) fn run_folder(scheme: Scheme, level: &str, set: &[String]) -> String {
    let set: String = set.iter().map(|assignment| format!("+{assignment}")).collect();
    format!("{scheme}/{level}{set}")
}

#[cfg(test)]
mod tests {
    use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, SpaceName};

    #[test]
    fn a_scheme_reads_back_from_its_name() {
        let scheme = Scheme::flip(BasisName::Bspline2, RemedyName::FbarRate);
        assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        for rule in [RuleName::QuasiStatic, RuleName::Midpoint, RuleName::Newmark] {
            let scheme = Scheme::implicit(rule, BasisName::Gimp, RemedyName::FbarConsistent);
            assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        }
        for space in [SpaceName::TwoGrid, SpaceName::Equal, SpaceName::Ppp] {
            let scheme = Scheme::poro(BasisName::Linear, space);
            assert_eq!(Scheme::parse(&scheme.to_string()).unwrap(), scheme);
        }
        for bad in [
            "poro",
            "poro-gimp",
            "poro-gimp-none",
            "",
            "gimp",
            "gimp-flip",
            "gimp-none-",
            "gimp-fbar-flip",
            "gimp-none-none",
            "quasi-static",
            "quasi-static-gimp",
            "quasi-static-gimp-none-flip",
            "midpointgimp-none",
        ] {
            assert!(Scheme::parse(bad).is_err(), "{bad}");
        }
    }
}
