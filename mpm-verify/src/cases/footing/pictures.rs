//! The pictures of the strip footing: the paper's Figures 8 and 10, and Prandtl's mechanism.

use super::own::own_runs;
use super::parameters::PENETRATION;
use super::reference::{EXACT, limit_curve};
use crate::draw::style::{Markers, series};
use crate::draw::{
    Chart, Dash, FieldFigure, FieldPanel, Marker, ReferenceLine, Scale, Series, draw_charts,
    draw_fields, share_ranges,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::table::Table;

const BASES: [(BasisName, &str); 2] = [
    (BasisName::Gimp, "GIMP"),
    (BasisName::Bspline2, "quadratic B-splines"),
];
const REMEDIES: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];
/// Finest first.
const LEVELS: [&str; 4] = ["b80", "b40", "b20", "b10"];
/// Largest pressure over strength drawn; and the range about Prandtl's that is drawn larger.
const MOST: f64 = 10.0;
const ABOUT: (f64, f64) = (4.8, 5.8);
/// What is drawn of the ground (m): so far to the right and down.
const NEAR: (f64, f64) = (2.5, 2.0);
/// The mean normal stress (kPa) is drawn from this to zero.
const LEAST_STRESS: f64 = -0.6;
/// Decimal logarithm of the plastic strains drawn.
const STRAINS: (f64, f64) = (-5.0, -2.0);
/// The footing (m).
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.08), (0.0, 0.08)];

struct Runs<'a, 'g> {
    gallery: &'a mut Gallery<'g>,
    records: Vec<&'g Record>,
}

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let ended = |r: &&Record| r.status == Status::Ok && r.transfer() == TransferName::Flip;
    let shorter = |r: &&Record| r.changes_only(PENETRATION.name);
    let records = own_runs(gallery.records).into_iter();
    let records = records.chain(gallery.records.iter().filter(shorter));
    let records: Vec<&Record> = records.filter(ended).collect();
    if records.is_empty() {
        return Ok(());
    }
    let mut runs = Runs { gallery, records };
    runs.curves()?;
    for (basis, title) in BASES {
        runs.mean_stress(basis, title)?;
        runs.mechanism(basis, title)?;
    }
    Ok(())
}

impl<'g> Runs<'_, 'g> {
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&'g Record> {
        self.records
            .iter()
            .find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level)
            .copied()
    }

    /// The finest level that all `remedies` have run with.
    fn finest(&self, basis: BasisName, remedies: &[RemedyName]) -> Option<&'static str> {
        let there = |level: &&str| {
            let run = |&remedy: &RemedyName| self.find(basis, remedy, level).is_some();
            remedies.iter().all(run)
        };
        LEVELS.into_iter().find(there)
    }

    fn curve(&self, record: &Record) -> Result<Vec<(f64, f64)>, Error> {
        let table = self.gallery.table(record, "series.csv")?;
        let points = table.points("penetration", "pressure_over_strength");
        // What rings at the start is inertia, and would hide the elastic branch.
        Ok(points
            .into_iter()
            .map(|(s, q)| (1e3 * s, q))
            .filter(|(_, q)| *q <= MOST)
            .collect())
    }

    /// Above: standard and consistent at all levels, whole and about the limit load. Below: all remedies at one.
    fn curves(&mut self) -> Result<(), Error> {
        let (mut all_levels, mut all_remedies) = (Vec::new(), Vec::new());
        for (basis, title) in BASES {
            let mut curves = Vec::new();
            for (colour, level) in LEVELS.into_iter().enumerate() {
                for (remedy, dash) in [
                    (RemedyName::None, Dash::Dotted),
                    (RemedyName::FbarConsistent, Dash::Solid),
                ] {
                    let points = match self.find(basis, remedy, level) {
                        Some(record) => self.curve(record)?,
                        None => Vec::new(),
                    };
                    curves.push(Series {
                        name: format!("{remedy} B/{}", &level[1..]),
                        points,
                        colour,
                        marker: Marker::None,
                        dash,
                    });
                }
            }
            all_levels.push(self.chart(title.to_owned(), curves));
            let Some(level) = self.finest(basis, &REMEDIES) else {
                continue;
            };
            let mut curves = Vec::new();
            for remedy in REMEDIES {
                if let Some(record) = self.find(basis, remedy, level) {
                    let points = self.curve(record)?;
                    let mut curve = series(Scheme::flip(basis, remedy), points, Markers::None);
                    curve.name = remedy.to_string();
                    curves.push(curve);
                }
            }
            let title = format!("{title}, h = B/{}", &level[1..]);
            all_remedies.push(self.chart(title, curves));
        }
        let mut charts = all_levels;
        // A curve that no basis has needs no entry in the legend.
        for k in (0..2 * LEVELS.len()).rev() {
            if charts.iter().all(|c| c.series[k].points.is_empty()) {
                for chart in &mut charts {
                    chart.series.remove(k);
                }
            }
        }
        charts.extend(all_remedies);
        charts.retain(Chart::shows_something);
        if charts.is_empty() {
            return Ok(());
        }
        let path = self.gallery.place("load-settlement.png");
        share_ranges(&path, &mut charts)?;
        self.gallery.write_curves("load-settlement.csv", &charts)?;
        let about: Vec<Chart> = charts
            .iter()
            .take(BASES.len())
            .map(about_the_limit)
            .collect();
        charts.splice(BASES.len()..BASES.len(), about);
        draw_charts(&path, &charts, 2)?;
        self.picture(
            "load-settlement",
            "Pressure over undrained strength against penetration over the footing's width: above, standard MPM (dotted) and fbar-consistent (full) at all levels, whole and about the limit load; below, all remedies at one level; with Prandtl's limit load and, on ground of the full size, the finite elements of vanishing size. The paper's Figure 8.",
        );
        Ok(())
    }

    fn chart(&self, title: String, mut curves: Vec<Series>) -> Chart {
        // Smaller ground is stiffer on the way to the same limit load.
        if self
            .records
            .iter()
            .all(|r| r.changes_none_but(&[PENETRATION.name]))
        {
            curves.push(Series {
                name: "finite elements, h → 0".to_owned(),
                points: (limit_curve().into_iter())
                    .map(|(s, q)| (1e3 * s, q))
                    .filter(|(s, _)| *s <= 4.0)
                    .collect(),
                colour: 7,
                marker: Marker::Circle,
                dash: Dash::Dashed,
            });
        }
        Chart {
            title,
            x_label: "s/B (10⁻³)".to_owned(),
            y_label: "q / s_u".to_owned(),
            x_scale: Scale::Linear,
            y_scale: Scale::Linear,
            series: curves,
            reference_lines: vec![ReferenceLine {
                name: "2 + π".to_owned(),
                value: EXACT,
                band: None,
            }],
            slope_triangle: None,
            x_range: None,
            y_range: Some((0.0, MOST)),
        }
    }

    fn picture(&mut self, name: &str, caption: &str) {
        self.gallery.hang(&format!("{name}.png"), caption);
    }

    fn panel(
        &self,
        record: &Record,
        title: String,
        value: impl Fn(&Table, usize) -> f64,
    ) -> Result<FieldPanel, Error> {
        let table = self.gallery.table(record, "particles.csv")?;
        let near = |(x, y): &(f64, f64)| *x <= NEAR.0 && *y >= -NEAR.1;
        let kept: Vec<(usize, (f64, f64))> = (table.points("reference_x", "reference_y"))
            .into_iter()
            .enumerate()
            .filter(|(_, x)| near(x))
            .collect();
        Ok(FieldPanel {
            title,
            values: kept.iter().map(|(k, _)| value(&table, *k)).collect(),
            points: kept.into_iter().map(|(_, x)| x).collect(),
            size: record.discretisation.h / f64::from(record.discretisation.ppc).sqrt(),
            outline: OUTLINE.to_vec(),
        })
    }

    fn fields(
        &mut self,
        name: &str,
        (title, caption): (String, &str),
        panels: Vec<FieldPanel>,
        (range, label): ((f64, f64), &str),
    ) -> Result<(), Error> {
        draw_fields(
            &self.gallery.place(&format!("{name}.png")),
            &FieldFigure {
                title,
                panels,
                columns: 2,
                range,
                label: label.to_owned(),
                x_label: "x (m)".to_owned(),
                y_label: "y (m)".to_owned(),
                window: None,
            },
        )?;
        self.picture(name, caption);
        Ok(())
    }

    fn mean_stress(&mut self, basis: BasisName, of: &str) -> Result<(), Error> {
        let remedies = [RemedyName::None, RemedyName::FbarConsistent];
        let Some(level) = self.finest(basis, &remedies) else {
            return Ok(());
        };
        let mut panels = Vec::new();
        for remedy in remedies {
            if let Some(record) = self.find(basis, remedy, level) {
                let title = match remedy {
                    RemedyName::None => "standard".to_owned(),
                    _ => remedy.to_string(),
                };
                panels.push(self.panel(record, title, |table, k| {
                    1e-3 * table.column("mean_stress")[k]
                })?);
            }
        }
        self.fields(
            &format!("mean-stress-{basis}"),
            (
                format!("{of}, h = B/{}", &level[1..]),
                &format!("Mean normal stress at the end with {of}: standard MPM against F̄. The paper's Figure 10 (data: particles.csv of each run)."),
            ),
            panels,
            ((LEAST_STRESS, 0.0), "mean normal stress (kPa)"),
        )
    }

    /// Velocity while the load stands still, and plastic strain.
    fn mechanism(&mut self, basis: BasisName, of: &str) -> Result<(), Error> {
        let remedy = RemedyName::FbarConsistent;
        let Some(level) = self.finest(basis, &[remedy]) else {
            return Ok(());
        };
        let Some(record) = self.find(basis, remedy, level) else {
            return Ok(());
        };
        let stroke = 0.25 * record.parameters.number(PENETRATION);
        let speed = |table: &Table, k: usize| {
            table.column("plateau_ux")[k].hypot(table.column("plateau_uy")[k]) / stroke
        };
        let strain = |table: &Table, k: usize| table.column("plastic_strain")[k].log10();
        let velocity = self.panel(record, format!("{of}, h = B/{}", &level[1..]), speed)?;
        let plastic = self.panel(record, format!("{of}, h = B/{}", &level[1..]), strain)?;
        self.fields(
            &format!("velocity-{basis}"),
            (
                "Prandtl's mechanism".to_owned(),
                &format!("Displacement over the last quarter of the penetration over that of the footing, {remedy}, {of}: a wedge that sinks with the footing, a fan, a wedge that is pushed up, and ground at rest."),
            ),
            vec![velocity],
            ((0.0, 1.0), "|u| / |u of the footing|"),
        )?;
        self.fields(
            &format!("plastic-strain-{basis}"),
            (
                "Where the ground has yielded".to_owned(),
                &format!("Equivalent plastic strain at the end, {remedy}, {of}: the bands along which Prandtl's wedges slide."),
            ),
            vec![plastic],
            (STRAINS, "log₁₀ of the equivalent plastic strain"),
        )
    }
}

/// The part of a chart of loads about Prandtl's.
fn about_the_limit(chart: &Chart) -> Chart {
    let (least, most) = ABOUT;
    let mut chart = chart.clone();
    chart.y_range = Some(ABOUT);
    for series in &mut chart.series {
        series.points.retain(|(_, q)| (least..=most).contains(q));
    }
    chart
}
