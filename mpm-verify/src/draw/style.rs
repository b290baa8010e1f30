//! How the curve of a scheme looks, and which schemes share their axes, the same in every picture.

use super::{Chart, Dash, Marker, PlotError, Series, draw_charts, share_ranges};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use std::collections::BTreeSet;
use std::path::Path;

/// More curves than this can't be told apart on one pair of axes.
const MOST_CURVES: usize = 8;

/// What the markers of curves tell.
#[derive(Clone, Copy)]
pub(crate) enum Markers {
    /// Nothing: the curves have too many points for markers.
    None,
    /// The basis.
    Basis,
    /// The transfer, of curves of one basis.
    Transfer,
}

/// The curve of a scheme: colour and line tell the remedy.
pub(crate) fn series(scheme: Scheme, points: Vec<(f64, f64)>, markers: Markers) -> Series {
    // Total and rate nearly coincide: the dashed line and the hollow marker let the other show.
    let (colour, dash) = match scheme.remedy() {
        RemedyName::None => (6, Dash::Dotted),
        RemedyName::FbarRecursive => (1, Dash::Solid),
        RemedyName::FbarTotal => (2, Dash::Solid),
        RemedyName::FbarRate => (0, Dash::Dashed),
        RemedyName::FbarConsistent => (3, Dash::Solid),
    };
    let marker = match markers {
        Markers::None => Marker::None,
        Markers::Basis => match scheme.basis() {
            BasisName::Gimp => Marker::Circle,
            BasisName::Bspline2 => Marker::Square,
            BasisName::Bspline3 => Marker::Triangle,
            BasisName::Linear | BasisName::Q8 => Marker::Diamond,
        },
        Markers::Transfer => match scheme.transfer() {
            TransferName::Flip => Marker::Circle,
            TransferName::Apic => Marker::Square,
            TransferName::Xpic2 => Marker::Triangle,
            TransferName::None => Marker::Diamond,
        },
    };
    Series {
        name: scheme.title(),
        points,
        colour,
        marker,
        dash,
    }
}

/// Schemes whose curves share a pair of axes.
pub(crate) struct Panel {
    /// What they have in common; may be empty.
    pub(crate) title: String,
    pub(crate) schemes: Vec<Scheme>,
    markers: Markers,
}

impl Panel {
    /// The curve of every scheme.
    pub(crate) fn curves(&self, points: impl Fn(Scheme) -> Vec<(f64, f64)>) -> Vec<Series> {
        let curve = |scheme: &Scheme| {
            let mut curve = series(*scheme, points(*scheme), self.markers);
            // What the title says already would keep panels from sharing a legend.
            let common = format!("{} ", self.title);
            if let Some(rest) = curve.name.strip_prefix(&common) {
                curve.name = rest.to_owned();
            }
            curve
        };
        self.schemes.iter().map(curve).collect()
    }
}

/// Panels side by side.
pub(crate) struct Panels(Vec<Panel>);

impl Panels {
    /// All schemes in one panel while they can be told apart, else a panel for every basis.
    pub(crate) fn new(schemes: &BTreeSet<Scheme>) -> Self {
        let bases: BTreeSet<BasisName> = schemes.iter().map(|s| s.basis()).collect();
        let others: BTreeSet<_> = schemes.iter().map(|s| (s.remedy(), s.transfer())).collect();
        let transfers: BTreeSet<_> = others.iter().map(|(_, transfer)| transfer).collect();
        let markers = match transfers.len() {
            1 => Markers::Basis,
            _ => Markers::Transfer,
        };
        if schemes.len() <= MOST_CURVES && transfers.len() == 1 {
            return Self(vec![Panel {
                title: String::new(),
                schemes: schemes.iter().copied().collect(),
                markers,
            }]);
        }
        // Each panel has the same curves, be they empty, and so all have one legend.
        let of_basis = |basis: BasisName| Panel {
            title: basis.to_string(),
            schemes: others
                .iter()
                .map(|&(remedy, transfer)| Scheme::new(basis, remedy, transfer))
                .collect(),
            markers,
        };
        Self(bases.into_iter().map(of_basis).collect())
    }

    /// Draws a row of panels with common ranges for each of `items` that has something to show;
    /// returns whether any has.
    pub(crate) fn draw<T>(
        &self,
        path: &Path,
        items: impl IntoIterator<Item = T>,
        chart: impl Fn(&T, &Panel) -> Chart,
    ) -> Result<bool, PlotError> {
        let mut charts = Vec::new();
        for item in items {
            let mut row: Vec<Chart> = self.0.iter().map(|p| chart(&item, p)).collect();
            if row.iter().any(Chart::shows_something) {
                if row.len() > 1 {
                    share_ranges(path, &mut row)?;
                }
                charts.extend(row);
            }
        }
        if !charts.is_empty() {
            draw_charts(path, &charts, self.0.len().max(2))?;
        }
        Ok(!charts.is_empty())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schemes(bases: &[BasisName], transfers: &[TransferName]) -> BTreeSet<Scheme> {
        let remedies = [
            RemedyName::None,
            RemedyName::FbarRecursive,
            RemedyName::FbarTotal,
            RemedyName::FbarRate,
        ];
        let mut all = BTreeSet::new();
        for &basis in bases {
            for remedy in remedies {
                all.extend(
                    transfers
                        .iter()
                        .map(|&transfer| Scheme::explicit(basis, remedy, transfer)),
                );
            }
        }
        all
    }

    /// How the curves of each panel look, without their points.
    fn looks(schemes: &BTreeSet<Scheme>) -> Vec<Vec<Series>> {
        let Panels(panels) = Panels::new(schemes);
        panels.iter().map(|p| p.curves(|_| Vec::new())).collect()
    }

    #[test]
    fn few_curves_share_their_axes_many_are_split_by_basis() {
        use BasisName::{Bspline2, Bspline3, Gimp};
        use TransferName::{Apic, Flip};
        for (bases, transfers, panels) in [
            (&[Gimp][..], &[Flip][..], 1),
            (&[Gimp, Bspline2], &[Flip], 1),
            (&[Gimp, Bspline2, Bspline3], &[Flip], 3),
            (&[Bspline2], &[Flip, Apic], 1),
            (&[Gimp, Bspline2], &[Flip, Apic], 2),
        ] {
            assert_eq!(looks(&schemes(bases, transfers)).len(), panels);
        }
    }

    #[test]
    fn panels_of_bases_have_one_legend_whose_curves_all_differ() {
        let mut all = schemes(
            &[BasisName::Gimp, BasisName::Bspline2],
            &[TransferName::Flip, TransferName::Apic, TransferName::Xpic2],
        );
        all.pop_last();
        let panels = looks(&all);
        assert_eq!(panels[0], panels[1]);
        let look = |s: &Series| (s.colour, format!("{:?} {:?}", s.marker, s.dash));
        let looks: BTreeSet<_> = panels[0].iter().map(look).collect();
        assert_eq!(looks.len(), 12);
        assert_eq!(panels[0][1].name, "none apic");
    }
}
