//! The pictures of Cook's membrane.

use super::checks::own_runs;
use super::metrics::{FEM_MID_EDGE_ERROR, FEM_TIP_ERROR, MID_EDGE_UY, TIP_UY};
use crate::draw::style::{Markers, series};
use crate::draw::{
    Chart, FieldFigure, FieldPanel, ReferenceLine, Scale, Series, draw_charts, draw_fields,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::metric::Metric;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};

/// The mean normal stress is drawn between plus and minus this (Pa); the reference reaches 0.127 Pa
/// away from the corners.
const STRESS_RANGE: f64 = 0.15;
const BASES: [BasisName; 3] = [BasisName::Gimp, BasisName::Bspline2, BasisName::Bspline3];
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0)];

struct Runs<'a, 'g> {
    gallery: &'a mut Gallery<'g>,
    records: Vec<&'g Record>,
}

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let ended = |r: &&Record| r.status == Status::Ok && r.transfer() == TransferName::Flip;
    let records = own_runs(gallery.records)
        .into_iter()
        .filter(ended)
        .collect();
    let mut runs = Runs { gallery, records };
    for basis in BASES {
        runs.fields(basis)?;
    }
    runs.displacement()?;
    runs.rest()
}

fn basis_title(basis: BasisName) -> &'static str {
    match basis {
        BasisName::Linear => "linear",
        BasisName::Gimp => "GIMP",
        BasisName::Bspline2 => "quadratic B-splines",
        BasisName::Bspline3 => "cubic B-splines",
    }
}

impl<'g> Runs<'_, 'g> {
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&'g Record> {
        self.records
            .iter()
            .find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level)
            .copied()
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
                    all.push(series(Scheme::flip(basis, remedy), points, Markers::Basis));
                }
            }
        }
        all
    }

    fn charts(&mut self, name: &str, caption: &str, charts: &[Chart]) -> Result<(), Error> {
        if charts.iter().any(|c| c.series.is_empty()) {
            return Ok(());
        }
        self.gallery.write_curves(&format!("{name}.csv"), charts)?;
        draw_charts(&self.gallery.place(&format!("{name}.png")), charts, 2)?;
        self.picture(name, caption);
        Ok(())
    }

    fn picture(&mut self, name: &str, caption: &str) {
        self.gallery.hang(&format!("{name}.png"), caption);
    }

    fn fields(&mut self, basis: BasisName) -> Result<(), Error> {
        let mut panels = Vec::new();
        for level in ["h1", "h0.5"] {
            for remedy in [RemedyName::None, RemedyName::FbarConsistent] {
                let Some(record) = self.find(basis, remedy, level) else {
                    continue;
                };
                let table = self.gallery.table(record, "particles.csv")?;
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
            &self.gallery.place(&format!("{name}.png")),
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
        let chart = |title: &str, metric: Metric, error: Metric| {
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
            chart("Middle of the right side", MID_EDGE_UY, FEM_MID_EDGE_ERROR),
            chart("Upper right corner", TIP_UY, FEM_TIP_ERROR),
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
            let table = self.gallery.table(record, "series.csv")?;
            let scheme = record.scheme();
            tip.push(series(
                scheme,
                table.points("time", "tip_uy"),
                Markers::None,
            ));
            if remedy != RemedyName::None {
                let points = table.points("time", "log_jacobian_gap_rms");
                gap.push(series(scheme, points, Markers::None));
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
