//! The faults: what is broken, and the checks that must go red.

mod body;
mod explicit;
mod implicit;

use crate::runs::Runs;

/// A fault: where, which expression becomes which, the runs that must notice, and the check that must
/// go red.
pub(crate) struct Fault {
    pub(crate) name: &'static str,
    pub(crate) file: &'static str,
    pub(crate) sound: &'static str,
    pub(crate) broken: &'static str,
    pub(crate) seen_by: &'static [(Runs, &'static str)],
}

/// All faults that a check against the truth must see.
pub(crate) fn faults() -> impl Iterator<Item = &'static Fault> {
    let parts: [&'static [Fault]; 3] = [&explicit::EXPLICIT, &body::BODY, &implicit::IMPLICIT];
    parts.into_iter().flatten()
}

/// A constant that is off by a millionth: no check against the truth can see it, the goldens do.
pub(crate) const DRIFT: Fault = Fault {
    name: "the neo-Hookean pressure is a millionth too large",
    file: "material/neo_hookean.rs",
    sound: "T::splat(0.5 * self.lambda) * squared_jacobian.ln()",
    broken: "T::splat(0.500_000_5 * self.lambda) * squared_jacobian.ln()",
    seen_by: &[],
};
