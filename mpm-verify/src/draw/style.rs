//! How the curve of a scheme looks, and which schemes share their axes, the same in every picture.

use super::{Chart, Dash, Marker, PlotError, Series, draw_charts, share_ranges_of_columns};
use crate::scheme::{BasisName, RemedyName, Scheme, SpaceName, TransferName};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Maximum number of distinguishable curves on one pair of axes.
const MOST_CURVES: usize = 8;
/// Panels of a picture, at most.
const MOST_PANELS: usize = 6;

/// Lines of levels that share axes, the finest first.
pub(crate) const LEVEL_DASHES: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::Dotted];

/// The curve of a scheme: its colour tells the remedy, or the space of the pressure, and the kind of solver, its marker the
/// basis, its line the transfer (solid FLIP, dashed APIC, dotted XPIC; markers of the latter two are hollow).
pub(crate) fn series(scheme: Scheme, points: Vec<(f64, f64)>) -> Series {
    let colour = match (scheme, scheme.remedy()) {
        (Scheme::Poro(poro), _) => match poro.space {
            SpaceName::TwoGrid => 4,
            SpaceName::Equal => 1,
            SpaceName::Ppp => 3,
        },
        (Scheme::Implicit(_), RemedyName::None) => 4,
        (Scheme::Implicit(_), RemedyName::FbarConsistent) => 5,
        (_, RemedyName::None) => 6,
        (_, RemedyName::FbarRecursive) => 1,
        (_, RemedyName::FbarTotal) => 2,
        (_, RemedyName::FbarRate) => 0,
        (_, RemedyName::FbarConsistent) => 3,
        (_, RemedyName::Other(..) | RemedyName::Own) => 7,
    };
    let marker = match scheme.basis() {
        BasisName::Gimp => Marker::Circle,
        BasisName::Bspline2 => Marker::Square,
        BasisName::Bspline3 => Marker::Triangle,
        BasisName::Linear | BasisName::Q8 => Marker::Diamond,
    };
    let dash = match scheme.transfer() {
        TransferName::Flip | TransferName::None => Dash::Solid,
        TransferName::Apic => Dash::Dashed,
        TransferName::Xpic2 | TransferName::Musl => Dash::Dotted,
    };
    Series { name: scheme.title(), points, colour, marker, dash }
}

/// The same against time: of too many points for markers.
pub(crate) fn history(scheme: Scheme, points: Vec<(f64, f64)>) -> Series {
    Series { marker: Marker::None, ..series(scheme, points) }
}

/// Schemes whose curves share a pair of axes.
pub(crate) struct Panel {
    /// Common title of the schemes; may be empty.
    pub(crate) title: String,
    pub(crate) schemes: Vec<Scheme>,
}

impl Panel {
    /// The curve of every scheme.
    pub(crate) fn curves(&self, points: impl Fn(Scheme) -> Vec<(f64, f64)>) -> Vec<Series> {
        let curve = |scheme: &Scheme| {
            let mut curve = series(*scheme, points(*scheme));
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

pub(crate) struct Panels(Vec<Panel>);

impl Panels {
    /// All schemes in one panel while they are distinguishable, else a panel for every basis.
    pub(crate) fn new(schemes: &BTreeSet<Scheme>) -> Self {
        let bases: BTreeSet<BasisName> = schemes.iter().map(|s| s.basis()).collect();
        // Schemes with their basis replaced by one, as all bases have the same curves.
        let others: BTreeSet<Scheme> = schemes.iter().map(|s| s.with(BasisName::Linear, s.remedy())).collect();
        let transfers: BTreeSet<_> = others.iter().map(|s| s.transfer()).collect();
        if schemes.len() <= MOST_CURVES && transfers.len() == 1 {
            return Self(vec![Panel { title: String::new(), schemes: schemes.iter().copied().collect() }]);
        }
        // Each panel has the same curves, be they empty, and so all have one legend.
        let of_basis = |basis: BasisName| Panel {
            title: basis.to_string(),
            schemes: others.iter().map(|other| other.with(basis, other.remedy())).collect(),
        };
        Self(bases.into_iter().map(of_basis).collect())
    }

    /// Draws a row of panels with common ranges for each of `items` that has something to show. A picture has
    /// [`MOST_PANELS`] at most: what is more goes into `NAME-2.png` and so on. Returns the files.
    pub(crate) fn draw<T>(
        &self,
        path: &Path,
        items: impl IntoIterator<Item = T>,
        chart: impl Fn(&T, &Panel) -> Chart,
    ) -> Result<Vec<PathBuf>, PlotError> {
        let mut charts = Vec::new();
        for item in items {
            let mut row: Vec<Chart> = self.0.iter().map(|p| chart(&item, p)).collect();
            if row.iter().any(Chart::shows_something) {
                if row.len() > 1 {
                    share_ranges_of_columns(path, &mut row, 1)?;
                }
                charts.extend(row);
            }
        }
        let across = self.0.len().max(1);
        let rows = (MOST_PANELS / across).max(1);
        let pictures = charts.chunks(rows * across).enumerate();
        let draw = |(k, charts): (usize, &[Chart])| {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let file = match k {
                0 => path.to_path_buf(),
                k => path.with_file_name(format!("{stem}-{}.png", k + 1)),
            };
            draw_charts(&file, charts, across.max(2))?;
            Ok(file)
        };
        pictures.map(draw).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schemes(bases: &[BasisName], transfers: &[TransferName]) -> BTreeSet<Scheme> {
        let remedies = [RemedyName::None, RemedyName::FbarRecursive, RemedyName::FbarTotal, RemedyName::FbarRate];
        let mut all = BTreeSet::new();
        for &basis in bases {
            for remedy in remedies {
                all.extend(transfers.iter().map(|&transfer| Scheme::explicit(basis, remedy, transfer)));
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
        let plain = |panel: &[Series]| -> Vec<Series> {
            let plain = |s: &Series| Series { marker: Marker::None, ..s.clone() };
            panel.iter().map(plain).collect()
        };
        assert_eq!(plain(&panels[0]), plain(&panels[1]));
        let look = |s: &Series| (s.colour, format!("{:?} {:?}", s.marker, s.dash));
        let looks: BTreeSet<_> = panels[0].iter().map(look).collect();
        assert_eq!(looks.len(), 12);
        assert_eq!(panels[0][1].name, "none apic");
    }

    #[test]
    fn a_picture_has_six_panels_at_most() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let all = schemes(&[BasisName::Gimp, BasisName::Bspline2], &[TransferName::Flip, TransferName::Apic]);
        let chart = |_: &usize, panel: &Panel| Chart::new("", ["", ""], panel.curves(|_| vec![(1.0, 1.0), (2.0, 2.0)]));
        let files = Panels::new(&all).draw(&path, 0..4, chart).unwrap();
        assert_eq!(files, [path.clone(), path.with_file_name("a-2.png")]);
        assert!(files.iter().all(|file| file.exists()));
        assert!(Panels(Vec::new()).draw(&path, 0..4, chart).unwrap().is_empty());
    }
}
