//! The pictures of Cook's membrane.

use super::Picture;
use crate::draw::style::{Colour, series};
use crate::draw::{
    Chart, FieldFigure, FieldPanel, ReferenceLine, Scale, Series, draw_charts, draw_fields,
};
use crate::error::Error;
use crate::files::write_csv;
use crate::record::{Record, Status, of_own_parameters};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::study::{CaseStudy, Gathered};
use crate::table::Table;
use std::path::Path;

/// The mean normal stress is drawn between plus and minus this (Pa); the reference reaches 0.127 Pa
/// away from the corners.
const STRESS_RANGE: f64 = 0.15;
const BASES: [BasisName; 3] = [BasisName::Gimp, BasisName::Bspline2, BasisName::Bspline3];
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0)];

struct Runs<'a> {
    records: Vec<&'a Record>,
    gathered: &'a Gathered,
    out: &'a Path,
    pictures: Vec<Picture>,
}

/// Draws everything there are runs for.
pub(super) fn draw(
    study: &CaseStudy,
    gathered: &Gathered,
    out: &Path,
) -> Result<Vec<Picture>, Error> {
    let mut runs = Runs {
        records: of_own_parameters(&study.records)
            .into_iter()
            .filter(|r| r.status == Status::Ok && r.transfer() == TransferName::Flip)
            .collect(),
        gathered,
        out,
        pictures: Vec::new(),
    };
    for basis in BASES {
        runs.fields(basis)?;
    }
    runs.displacement()?;
    runs.rest()?;
    Ok(runs.pictures)
}

fn basis_title(basis: BasisName) -> &'static str {
    match basis {
        BasisName::Linear => "linear",
        BasisName::Gimp => "GIMP",
        BasisName::Bspline2 => "quadratic B-splines",
        BasisName::Bspline3 => "cubic B-splines",
    }
}

impl Runs<'_> {
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&Record> {
        self.records
            .iter()
            .find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level)
            .copied()
    }

    fn table(&self, record: &Record, file: &str) -> Result<Table, Error> {
        Table::read(&self.gathered.folder(record)?.join(file))
    }

    /// One series per scheme over the levels, of records for which `measure` is finite.
    fn over_levels(
        &self,
        remedies: &[RemedyName],
        measure: impl Fn(&Record) -> (f64, f64),
    ) -> Vec<Series> {
        let mut all = Vec::new();
        for basis in BASES {
            for &remedy in remedies {
                let mut points: Vec<(f64, f64)> = self
                    .records
                    .iter()
                    .filter(|r| r.basis() == basis && r.remedy() == remedy)
                    .map(|r| measure(r))
                    .filter(|(x, y)| x.is_finite() && y.is_finite())
                    .collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                if !points.is_empty() {
                    all.push(series(Scheme::flip(basis, remedy), points, Colour::Basis));
                }
            }
        }
        all
    }

    fn charts(&mut self, name: &str, caption: &str, charts: &[Chart]) -> Result<(), Error> {
        if charts.iter().any(|c| c.series.is_empty()) {
            return Ok(());
        }
        let rows = charts.iter().flat_map(|chart| {
            chart.series.iter().flat_map(move |s| {
                s.points.iter().map(move |(x, y)| {
                    vec![
                        chart.title.clone(),
                        s.name.clone(),
                        x.to_string(),
                        y.to_string(),
                    ]
                })
            })
        });
        let header = ["chart", "series", "x", "y"].map(str::to_owned);
        write_csv(&self.out.join(format!("cook/{name}.csv")), &header, rows)?;
        draw_charts(&self.out.join(format!("cook/{name}.png")), charts, 2)?;
        self.picture(name, caption);
        Ok(())
    }

    fn picture(&mut self, name: &str, caption: &str) {
        self.pictures.push(Picture {
            file: format!("cook/{name}.png"),
            caption: caption.to_owned(),
        });
    }

    fn fields(&mut self, basis: BasisName) -> Result<(), Error> {
        let mut panels = Vec::new();
        for level in ["h1", "h0.5"] {
            for remedy in [RemedyName::None, RemedyName::FbarRate] {
                let Some(record) = self.find(basis, remedy, level) else {
                    continue;
                };
                let table = self.table(record, "particles.csv")?;
                let spacing = record.discretisation.h / f64::from(record.discretisation.ppc).sqrt();
                panels.push(FieldPanel {
                    title: match remedy {
                        RemedyName::None => format!("standard, h = {} m", record.discretisation.h),
                        _ => format!("{remedy}, h = {} m", record.discretisation.h),
                    },
                    points: table.points("x", "y"),
                    values: table.column("mean_stress").to_vec(),
                    size: spacing,
                    outline: OUTLINE.to_vec(),
                });
            }
        }
        if panels.is_empty() {
            return Ok(());
        }
        let name = format!("mean-stress-{basis}");
        draw_fields(
            &self.out.join(format!("cook/{name}.png")),
            &FieldFigure {
                title: format!("Cook's membrane at rest, {}", basis_title(basis)),
                panels,
                columns: 2,
                range: (-STRESS_RANGE, STRESS_RANGE),
                label: "mean normal stress (Pa)".to_owned(),
                x_label: "x (m)".to_owned(),
                y_label: "y (m)".to_owned(),
                window: None,
            },
        )?;
        self.picture(
            &name,
            &format!(
                "Mean normal stress at rest with {}: standard MPM against F̄ (data: particles.csv of each run).",
                basis_title(basis)
            ),
        );
        Ok(())
    }

    fn displacement(&mut self) -> Result<(), Error> {
        let at_rest = [
            RemedyName::None,
            RemedyName::FbarTotal,
            RemedyName::FbarRate,
        ];
        let chart = |title: &str, metric: &'static str, error: &'static str| {
            let series = self.over_levels(&at_rest, |r| (r.discretisation.h, r.metric(metric)));
            let reference = self.records.iter().find_map(|r| {
                let exact = r.metric(metric) / (1.0 + r.metric(error));
                exact.is_finite().then_some(exact)
            });
            Chart {
                title: title.to_owned(),
                x_label: "cell size h (m)".to_owned(),
                y_label: "u_y (m)".to_owned(),
                x_scale: Scale::Log10,
                y_scale: Scale::Linear,
                series,
                reference_lines: reference
                    .map(|value| ReferenceLine {
                        name: "FEM reference".to_owned(),
                        value,
                        band: None,
                    })
                    .into_iter()
                    .collect(),
                slope_triangle: None,
                x_range: None,
                y_range: None,
            }
        };
        let charts = [
            chart(
                "Middle of the right side",
                "mid_edge_uy",
                "fem_mid_edge_error",
            ),
            chart("Upper right corner", "tip_uy", "fem_tip_error"),
        ];
        self.charts(
            "displacement",
            "Vertical displacement at rest of the middle of the right side and of its upper corner, against the FEM reference.",
            &charts,
        )
    }

    /// Approach to rest at the finest level that all four remedies have run with GIMP.
    fn rest(&mut self) -> Result<(), Error> {
        let remedies = [
            RemedyName::None,
            RemedyName::FbarRecursive,
            RemedyName::FbarTotal,
            RemedyName::FbarRate,
        ];
        let level = ["h1", "h2"].into_iter().find(|level| {
            remedies
                .iter()
                .all(|&r| self.find(BasisName::Gimp, r, level).is_some())
        });
        let Some(level) = level else { return Ok(()) };
        let mut tip = Vec::new();
        let mut gap = Vec::new();
        for remedy in remedies {
            let Some(record) = self.find(BasisName::Gimp, remedy, level) else {
                continue;
            };
            let table = self.table(record, "series.csv")?;
            let scheme = record.scheme();
            tip.push(series(
                scheme,
                table.points("time", "tip_uy"),
                Colour::Remedy,
            ));
            if remedy != RemedyName::None {
                let points = table.points("time", "log_jacobian_gap_rms");
                gap.push(series(scheme, points, Colour::Remedy));
            }
        }
        let chart = |title: &str, y_label: &str, series| Chart {
            title: title.to_owned(),
            x_label: "time (s)".to_owned(),
            y_label: y_label.to_owned(),
            x_scale: Scale::Linear,
            y_scale: Scale::Linear,
            series,
            reference_lines: Vec::new(),
            slope_triangle: None,
            x_range: None,
            y_range: None,
        };
        let charts = [
            chart("Tip", "u_y (m)", tip),
            chart(
                "True against averaged Jacobian",
                "rms ln(J / averaged J)",
                gap,
            ),
        ];
        self.charts(
            "rest",
            &format!("Approach to rest with GIMP at {level}: the recursive F̄ creeps and never rests, the others stop."),
            &charts,
        )
    }
}
