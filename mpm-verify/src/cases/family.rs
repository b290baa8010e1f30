//! Families of runs that several problems have.

use crate::prelude::*;

pub(super) const BASES: [BasisName; 4] = [BasisName::Linear, BasisName::Gimp, BasisName::Bspline2, BasisName::Bspline3];

/// Bases whose functions are smooth enough for particles that cross cells.
pub(super) const SMOOTH: [BasisName; 2] = [Gimp, Bspline2];

pub(super) const REMEDIES: [RemedyName; 5] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];

/// The levels of `n` cells per side of length `side` (m).
pub(super) fn levels<const N: usize>(side: f64, names: [(&'static str, f64); N]) -> Vec<Level> {
    names.into_iter().map(|(name, n)| Level { name, h: side / n }).collect()
}

/// Cost of a step with the remedy of a run, of those in the order of [`REMEDIES`].
pub(super) fn remedy_cost(spec: &RunSpec, costs: [f64; 5]) -> f64 {
    let of = REMEDIES.into_iter().zip(costs).find(|(remedy, _)| *remedy == spec.scheme.remedy());
    of.map_or(1.0, |(_, cost)| cost)
}

/// Every pair of a basis and a remedy, with FLIP.
pub(super) fn pairs(bases: &[BasisName], remedies: &[RemedyName]) -> Vec<Scheme> {
    bases.iter().flat_map(|&basis| remedies.iter().map(move |&r| Scheme::flip(basis, r))).collect()
}

/// Every combination of a rule of time, a basis and a remedy.
pub(super) fn implicit(rules: &[RuleName], bases: &[BasisName], remedies: &[RemedyName]) -> Vec<Scheme> {
    let of_rule =
        |&rule| bases.iter().flat_map(move |&basis| remedies.iter().map(move |&r| Scheme::implicit(rule, basis, r)));
    rules.iter().flat_map(of_rule).collect()
}

/// The schemes that are also run with another transfer or number of particles per cell than the case's own.
pub(super) fn main_pairs() -> Vec<Scheme> {
    pairs(&[BasisName::Gimp, BasisName::Bspline2], &[RemedyName::None, RemedyName::FbarConsistent])
}

/// The main pairs with APIC and XPIC(2).
pub(super) fn other_transfers() -> Vec<Scheme> {
    let with = |transfer| main_pairs().into_iter().map(move |s| Scheme::explicit(s.basis(), s.remedy(), transfer));
    [TransferName::Apic, TransferName::Xpic2].into_iter().flat_map(with).collect()
}

/// Table of the results of other transfers and particle numbers per direction beside FLIP with the case's default of
/// two; rows with FLIP results only are left out.
pub(super) fn transfers(name: &str, labels: &[Label], more: &[&str], text: fn(&Record) -> String) -> ResultTable {
    let own =
        [("FLIP, 2 per direction", TransferName::Flip), ("APIC", TransferName::Apic), ("XPIC(2)", TransferName::Xpic2)];
    let own =
        own.map(|(title, transfer)| Column::text(title, text).of(move |r| r.transfer() == transfer && r.is_default()));
    let more = more.iter().map(|n| {
        let set = [format!("ppc_per_direction={n}")];
        Column::text(format!("{n} per direction"), text).of(move |r| is_flip(r) && r.set == set)
    });
    let shows = |r: &Record| main_pairs().contains(&Scheme::flip(r.basis(), r.remedy()));
    ResultTable::new(name, shows, labels, own.into_iter().chain(more)).least(2)
}

/// Two metrics, the ends of a range, as a table shows it.
pub(super) fn range(r: &Record, ends: [Metric; 2]) -> String {
    let [least, most] = ends.map(|end| fixed(2).text(r.metric(end)));
    format!("{least} … {most}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Tier;
    use crate::cases;
    use crate::parameter::Parameters;
    use crate::record::fixture::spec;
    use crate::spec::RunSpec;

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
            let night = cases::find(name).unwrap().runs(Tier::Nightly);
            for scheme in main_pairs() {
                let levels = |transfer, set: &[&str]| {
                    let scheme = Scheme::explicit(scheme.basis(), scheme.remedy(), transfer);
                    let like = |s: &&RunSpec| s.scheme == scheme && s.set == set;
                    night.iter().filter(like).count()
                };
                for transfer in [TransferName::Apic, TransferName::Xpic2] {
                    // A ladder takes three.
                    assert!(levels(transfer, &[]) >= 3, "{name} {scheme} {transfer}");
                }
                for ppc in ["ppc_per_direction=3", "ppc_per_direction=4"] {
                    let found = levels(TransferName::Flip, &[ppc]);
                    assert_eq!(found, 3, "{name} {scheme} {ppc}");
                }
            }
        }
    }

    #[test]
    fn problems_in_the_plane_run_with_other_transfers_at_two_levels() {
        for (name, per_direction) in [("cook", 2), ("footing", 1), ("landslide-2d", 2)] {
            let long = cases::find(name).unwrap().runs(Tier::Long);
            for scheme in other_transfers() {
                let own = |s: &&RunSpec| s.scheme == scheme && s.set.is_empty();
                assert!(long.iter().filter(own).count() >= 2, "{name} {scheme}");
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
        let spec = spec(other_transfers()[0], case.levels[0], &[set]);
        let parameters = Parameters::new(&case.parameters, &spec.set).unwrap();
        let begun = (case.begin)(&spec, &parameters);
        begun.err().unwrap().to_string()
    }

    #[test]
    fn another_transfer_is_refused_where_it_would_be_flip() {
        for dimension in ["dimension=1", "dimension=3"] {
            let refused = refusal("mms-axis", dimension);
            let said = refused.contains("dimension") && refused.contains("flip");
            assert!(said, "{refused}");
        }
    }

    #[test]
    fn a_blend_is_refused_where_it_would_not_be_seen() {
        for case in ["cook", "footing", "mms-axis"] {
            let refused = refusal(case, "flip=0.9");
            let said = refused.contains("share of FLIP") && refused.contains("0.9");
            assert!(said, "{refused}");
        }
        assert!(refusal("dam-break", "pic_rate=1").contains("share of FLIP"));
    }
}
