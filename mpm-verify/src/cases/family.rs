//! Families of runs that several problems have.

use crate::case::{Family, Tier};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::spec::Level;

/// Every basis.
pub(super) const BASES: [BasisName; 4] = [
    BasisName::Linear,
    BasisName::Gimp,
    BasisName::Bspline2,
    BasisName::Bspline3,
];

/// Every remedy.
pub(super) const REMEDIES: [RemedyName; 5] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

/// The levels of `n` cells per side of length `side` (m).
pub(super) fn levels<const N: usize>(side: f64, names: [(&'static str, f64); N]) -> Vec<Level> {
    let level = |(name, n)| Level { name, h: side / n };
    names.into_iter().map(level).collect()
}

/// Runs of `schemes` at `levels` with the parameters `set`, from the tier `tier` on.
pub(super) fn family(
    tier: Tier,
    levels: &[Level],
    schemes: &[Scheme],
    set: &'static [&'static str],
) -> Family {
    Family {
        tier,
        levels: levels.to_vec(),
        schemes: schemes.to_vec(),
        set,
    }
}

/// Every pair of a basis and a remedy, with FLIP.
pub(super) fn pairs(bases: &[BasisName], remedies: &[RemedyName]) -> Vec<Scheme> {
    let of_basis = |&basis| remedies.iter().map(move |&r| Scheme::flip(basis, r));
    bases.iter().flat_map(of_basis).collect()
}

/// The schemes that are also run with another transfer or number of particles per cell than the case's own.
pub(super) fn main_pairs() -> Vec<Scheme> {
    pairs(
        &[BasisName::Gimp, BasisName::Bspline2],
        &[RemedyName::None, RemedyName::FbarConsistent],
    )
}

/// The main pairs with APIC and XPIC(2).
pub(super) fn other_transfers() -> Vec<Scheme> {
    let with = |transfer| {
        let pairs = main_pairs().into_iter();
        pairs.map(move |s| Scheme::explicit(s.basis(), s.remedy(), transfer))
    };
    let transfers = [TransferName::Apic, TransferName::Xpic2];
    transfers.into_iter().flat_map(with).collect()
}

/// The main pairs with more particles per cell than the case's own two per direction.
pub(super) fn more_particles(tier: Tier, levels: &[Level]) -> [Family; 2] {
    let sets: [&'static [&'static str]; 2] = [&["ppc_per_direction=3"], &["ppc_per_direction=4"]];
    sets.map(|set| family(tier, levels, &main_pairs(), set))
}
