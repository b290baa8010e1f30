//! Plans of runs, and what a run costs.

use super::{Manufactured, scene::Timing};
use crate::case::{Level, RunSpec};
use crate::parameter::Parameters;
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};

/// Every basis.
pub(in crate::cases) const BASES: [BasisName; 4] = [
    BasisName::Linear,
    BasisName::Gimp,
    BasisName::Bspline2,
    BasisName::Bspline3,
];

/// Every remedy.
pub(in crate::cases) const REMEDIES: [RemedyName; 5] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

/// Every pair of a basis and a remedy, with FLIP.
pub(in crate::cases) fn pairs(bases: &[BasisName], remedies: &[RemedyName]) -> Vec<Scheme> {
    bases
        .iter()
        .flat_map(|&basis| remedies.iter().map(move |&r| Scheme::flip(basis, r)))
        .collect()
}

/// The schemes that are also run with another transfer or number of particles per cell than the case's own.
fn main_pairs() -> Vec<Scheme> {
    pairs(
        &[BasisName::Gimp, BasisName::Bspline2],
        &[RemedyName::None, RemedyName::FbarConsistent],
    )
}

/// The main pairs with APIC and XPIC(2).
pub(in crate::cases) fn other_transfers() -> Vec<Scheme> {
    let with = |transfer| {
        main_pairs()
            .into_iter()
            .map(move |scheme| Scheme::explicit(scheme.basis(), scheme.remedy(), transfer))
    };
    [TransferName::Apic, TransferName::Xpic2]
        .into_iter()
        .flat_map(with)
        .collect()
}

/// The main pairs with more particles per cell than the case's own two per direction.
pub(in crate::cases) fn more_particles(levels: &[Level]) -> Vec<RunSpec> {
    ["ppc_per_direction=3", "ppc_per_direction=4"]
        .iter()
        .flat_map(|ppc| ladder(levels, &main_pairs(), &[ppc]))
        .collect()
}

/// The levels of `n` cells per side of length `side` (m).
pub(in crate::cases) fn levels<const N: usize>(
    side: f64,
    names: [(&'static str, f64); N],
) -> Vec<Level> {
    let level = |(name, n)| Level { name, h: side / n };
    names.into_iter().map(level).collect()
}

/// Every scheme at every level with the parameters `set`.
pub(in crate::cases) fn ladder(levels: &[Level], schemes: &[Scheme], set: &[&str]) -> Vec<RunSpec> {
    levels
        .iter()
        .flat_map(|&level| schemes.iter().map(move |&scheme| (level, scheme)))
        .map(|(level, scheme)| RunSpec {
            scheme,
            level,
            set: set.iter().map(|s| (*s).to_owned()).collect(),
            perturbed: false,
        })
        .collect()
}

/// The runs of all `parts`, each once.
pub(in crate::cases) fn union(parts: impl IntoIterator<Item = Vec<RunSpec>>) -> Vec<RunSpec> {
    let mut seen = std::collections::BTreeSet::new();
    let all = parts.into_iter().flatten();
    all.filter(|spec| seen.insert(spec.folder())).collect()
}

/// Particle steps per unit of cost, without a remedy.
const STEPS_PER_COST: f64 = 5e7;

/// Cost of a run, by its particle steps.
pub(super) fn cost(case: &Manufactured, spec: &RunSpec) -> f64 {
    let known = || {
        let p = Parameters::new(&case.parameters, &spec.set).ok()?;
        let solution = (case.solution)(&p).ok()?;
        let timing = Timing::new(case, spec.level, &p, solution.as_ref()).ok()?;
        let per_cell = p.number("ppc_per_direction");
        let extent = solution.extent();
        let along = |a: usize| (extent[a][1] - extent[a][0]) / spec.level.h * per_cell;
        let particles: f64 = (0..solution.dimension()).map(along).product();
        Some(particles * timing.steps)
    };
    let remedy = match spec.scheme.remedy() {
        RemedyName::None => 1.0,
        RemedyName::FbarConsistent => 3.0,
        _ => 1.5,
    };
    known().unwrap_or(0.0) * remedy / STEPS_PER_COST
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Tier;
    use crate::cases;

    #[test]
    fn cases_in_the_plane_run_with_other_transfers_and_more_particles() {
        let names = [
            "mms-axis",
            "mms-wall-pressure",
            "mms-vortex-ring",
            "mms-vortex-box",
            "mms-vortex-pressure",
            "mms-double-shear",
        ];
        for name in names {
            let night = cases::find(name).unwrap().plan(Tier::Nightly);
            for scheme in main_pairs() {
                let levels = |transfer, set: &[&str]| {
                    let like = |s: &&RunSpec| {
                        s.scheme == Scheme::explicit(scheme.basis(), scheme.remedy(), transfer)
                            && s.set == set
                    };
                    night.iter().filter(like).count()
                };
                for transfer in [TransferName::Apic, TransferName::Xpic2] {
                    assert!(levels(transfer, &[]) >= 4, "{name} {scheme} {transfer}");
                }
                for ppc in ["ppc_per_direction=3", "ppc_per_direction=4"] {
                    assert_eq!(
                        levels(TransferName::Flip, &[ppc]),
                        3,
                        "{name} {scheme} {ppc}"
                    );
                }
            }
        }
    }

    #[test]
    fn problems_in_the_plane_run_with_other_transfers_at_two_levels() {
        for (name, per_direction) in [("cook", 2), ("footing", 1), ("landslide-2d", 2)] {
            let case = cases::find(name).unwrap();
            let long = case.plan(Tier::Long);
            for scheme in other_transfers() {
                let levels = long
                    .iter()
                    .filter(|s| s.scheme == scheme && s.set.is_empty());
                assert!(levels.count() >= 2, "{name} {scheme}");
                assert!(case.schemes().contains(&scheme), "{name} {scheme}");
            }
            for scheme in main_pairs() {
                let of = |s: &&RunSpec| {
                    let changed = s.set.iter().any(|s| s.starts_with("ppc_per_direction="));
                    s.scheme == scheme && s.set.len() == 1 && changed
                };
                let numbers = crate::distinct(long.iter().filter(of).map(|s| &s.set[..]));
                assert_eq!(numbers.len(), per_direction, "{name} {scheme}");
            }
        }
    }

    /// Why a run with APIC and a changed parameter does not begin.
    fn refusal(case: &str, set: &str) -> String {
        let case = cases::find(case).unwrap();
        let spec = RunSpec {
            scheme: other_transfers()[0],
            level: case.levels()[0],
            set: vec![set.to_owned()],
            perturbed: false,
        };
        let parameters = Parameters::new(case.parameters(), &spec.set).unwrap();
        case.start(&spec, &parameters).err().unwrap().to_string()
    }

    #[test]
    fn another_transfer_is_refused_where_it_would_be_flip() {
        for dimension in ["dimension=1", "dimension=3"] {
            let refused = refusal("mms-axis", dimension);
            assert!(
                refused.contains("dimension") && refused.contains("flip"),
                "{refused}"
            );
        }
    }

    #[test]
    fn a_blend_is_refused_where_it_would_not_be_seen() {
        for case in ["cook", "footing", "mms-axis"] {
            let refused = refusal(case, "flip=0.9");
            assert!(
                refused.contains("share of FLIP") && refused.contains("0.9"),
                "{refused}"
            );
        }
        assert!(refusal("dam-break", "pic_rate=1").contains("share of FLIP"));
    }
}
