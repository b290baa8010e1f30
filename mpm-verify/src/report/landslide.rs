//! The pictures of the landslide: the paper's Figures 14 to 16, in plane strain and in three dimensions.

use super::Picture;
use super::curves::write_curves;
use super::plot::{
    Camera, Chart, Dash, FieldFigure, FieldPanel, Marker, Scale, Series, SolidFigure, SolidPanel,
    Up, animate_fields, draw_charts, draw_fields, draw_solids, share_ranges,
};
use super::style::{Colour, series};
use crate::error::Error;
use crate::record::{Record, Status};
use crate::run::snapshot_file;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::study::{CaseStudy, Gathered};
use crate::table::Table;
use std::path::Path;

const BASES: [(BasisName, &str); 2] = [
    (BasisName::Gimp, "GIMP"),
    (BasisName::Bspline2, "quadratic B-splines"),
];
/// From above: standard, the paper's, ours.
const REMEDIES: [RemedyName; 3] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarConsistent,
];
/// Times (s) of the pictures.
const TIMES: [f64; 3] = [1.0, 2.5, 5.5];
/// Times (s) between frames of the animation, and between showing them (hundredths of a second).
const FRAME: f64 = 0.2;
const DELAY: u16 = 20;
/// Coordinate of the first toe (m).
const TOE: f64 = 15.0;
/// What is shown of the section (m), and across (m).
const WINDOW: ((f64, f64), (f64, f64)) = ((0.0, 40.0), (0.0, 5.5));
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (15.0, 0.0), (10.0, 5.0), (0.0, 5.0)];

/// A field of the snapshots: its column, the factor to the unit shown, its range and its label.
struct Field {
    name: &'static str,
    column: &'static str,
    factor: f64,
    range: (f64, f64),
    label: &'static str,
}

const FIELDS: [Field; 2] = [
    Field {
        name: "plastic-strain",
        column: "plastic_strain",
        factor: 1.0,
        range: (0.0, 2.0),
        label: "equivalent plastic strain (–)",
    },
    Field {
        name: "mean-stress",
        column: "mean_stress",
        factor: 1e-3,
        range: (-120.0, 0.0),
        label: "mean normal stress (kPa)",
    },
];

struct Runs<'a> {
    case: &'a str,
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
    let own = |r: &&Record| r.is_default() || r.changes_only("duration");
    let mut runs = Runs {
        case: &study.case,
        records: (study.records.iter())
            .filter(|r| r.status == Status::Ok)
            .filter(own)
            .collect(),
        gathered,
        out,
        pictures: Vec::new(),
    };
    // Of several the one that changes least, and the finest first.
    runs.records.sort_by(|a, b| {
        let key = |r: &Record| (r.set.len(), r.discretisation.h);
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    for (basis, title) in BASES {
        for field in &FIELDS {
            runs.snapshots(basis, title, field)?;
        }
    }
    runs.run_out()?;
    runs.animation()?;
    Ok(runs.pictures)
}

impl Runs<'_> {
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&Record> {
        self.records
            .iter()
            .find(|r| r.basis == basis && r.remedy == remedy && r.level == level)
            .copied()
    }

    /// The finest level at which all remedies have run with a basis, the longest runs first.
    fn level(&self, basis: BasisName) -> Option<String> {
        let has_all = |r: &&&Record| {
            let has = |&remedy: &RemedyName| self.find(basis, remedy, &r.level).is_some();
            REMEDIES.iter().all(has)
        };
        self.records.iter().find(has_all).map(|r| r.level.clone())
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.out.join(format!("{}/{name}.png", self.case))
    }

    fn picture(&mut self, name: &str, caption: String) {
        self.pictures.push(Picture {
            file: format!("{}/{name}.png", self.case),
            caption,
        });
    }

    /// The particles of a run at `time` (s), if it has kept them.
    fn snapshot(&self, record: &Record, time: f64) -> Result<Option<Table>, Error> {
        let file = snapshot_file(self.gathered.folder(record)?, time);
        file.exists().then(|| Table::read(&file)).transpose()
    }

    fn snapshots(&mut self, basis: BasisName, of: &str, field: &Field) -> Result<(), Error> {
        let Some(level) = self.level(basis) else {
            return Ok(());
        };
        let mut shown: Vec<(String, f64, Table)> = Vec::new();
        let mut columns = 0;
        for time in TIMES {
            let mut column = Vec::new();
            for remedy in REMEDIES {
                let Some(record) = self.find(basis, remedy, &level) else {
                    continue;
                };
                if let Some(table) = self.snapshot(record, time)? {
                    let title = format!("{}, {time:.1} s", name_of(remedy));
                    column.push((title, spacing(record), table));
                }
            }
            if column.len() == REMEDIES.len() {
                columns += 1;
                shown.extend(column);
            }
        }
        if columns == 0 {
            return Ok(());
        }
        // By rows: a remedy each.
        let order = (0..shown.len()).map(|k| (k % columns) * REMEDIES.len() + k / columns);
        let panels: Vec<&(String, f64, Table)> = order.map(|k| &shown[k]).collect();
        let title = format!("{of}, {}", level_title(&level));
        let name = format!("{}-{basis}", field.name);
        if panels.iter().all(|(_, _, table)| is_solid(table)) {
            draw_solids(&self.path(&name), &solids(title, &panels, columns, field))?;
        } else {
            draw_fields(&self.path(&name), &fields(title, &panels, columns, field))?;
        }
        self.picture(
            &name,
            format!("The slide with {of}: {}; standard MPM, the paper's F̄, ours. The paper's Figures 14 and 15 (data: snapshots of each run).", field.label),
        );
        Ok(())
    }

    /// A column of the series of a run since the reduction of the strength, against time (s).
    fn history(
        &self,
        record: &Record,
        column: &str,
        (factor, start): (f64, f64),
    ) -> Result<Vec<(f64, f64)>, Error> {
        let table = Table::read(&self.gathered.folder(record)?.join("series.csv"))?;
        let points = table.points("time", column).into_iter();
        Ok(points
            .filter(|(time, _)| *time >= 0.0)
            .map(|(time, value)| (time, factor * (value - start)))
            .collect())
    }

    /// Run-out, settlement and kinetic energy against time: remedies at the finest common level, levels of F̄.
    fn run_out(&mut self) -> Result<(), Error> {
        let quantities = [
            ("toe", (1.0, TOE), "run-out (m)"),
            ("settlement", (1.0, 0.0), "settlement of the crest (m)"),
            ("kinetic_energy", (1e-3, 0.0), "kinetic energy (kJ/m)"),
        ];
        let mut charts = Vec::new();
        for (basis, title) in BASES {
            let Some(level) = self.level(basis) else {
                continue;
            };
            for (column, scale, label) in quantities {
                let mut curves = Vec::new();
                for remedy in REMEDIES {
                    if let Some(record) = self.find(basis, remedy, &level) {
                        let points = self.history(record, column, scale)?;
                        let mut curve = series(Scheme::flip(basis, remedy), points, Colour::Remedy);
                        curve.name = name_of(remedy);
                        curves.push(curve);
                    }
                }
                charts.push(chart(
                    format!("{title}, {}", level_title(&level)),
                    label,
                    curves,
                ));
            }
            for (column, scale, label) in quantities {
                let curves = self.by_level(basis, column, scale)?;
                charts.push(chart(format!("{title}, fbar-consistent"), label, curves));
            }
        }
        if charts.is_empty() {
            return Ok(());
        }
        let (name, path) = ("run-out", self.path("run-out"));
        for k in 0..quantities.len() {
            let every = || (k..).step_by(quantities.len());
            let count = charts.len();
            let mut same: Vec<Chart> = every()
                .take_while(|i| *i < count)
                .map(|i| charts[i].clone())
                .collect();
            share_ranges(&path, &mut same)?;
            for (i, ranged) in every().zip(same) {
                charts[i] = ranged;
            }
        }
        write_curves(&path.with_extension("csv"), &charts)?;
        draw_charts(&path, &charts, quantities.len())?;
        self.picture(
            name,
            "Run-out, settlement of the crest and kinetic energy against time since the reduction: all remedies at the finest common level, then fbar-consistent at all levels. The paper's Figure 16.".to_owned(),
        );
        Ok(())
    }

    fn by_level(
        &self,
        basis: BasisName,
        column: &str,
        scale: (f64, f64),
    ) -> Result<Vec<Series>, Error> {
        let levels = crate::distinct(self.records.iter().map(|r| r.level.clone()));
        let mut curves = Vec::new();
        for (colour, level) in levels.into_iter().enumerate() {
            if let Some(record) = self.find(basis, RemedyName::FbarConsistent, &level) {
                curves.push(Series {
                    name: level_title(&level),
                    points: self.history(record, column, scale)?,
                    colour,
                    marker: Marker::None,
                    dash: Dash::Solid,
                });
            }
        }
        Ok(curves)
    }

    /// The plastic strain with GIMP, frame by frame, of the finest level that has kept frames.
    fn animation(&mut self) -> Result<(), Error> {
        let mut frames = Vec::new();
        let Some(level) = self.level(BasisName::Gimp) else {
            return Ok(());
        };
        for k in 1.. {
            let time = f64::from(k) * FRAME;
            let mut shown = Vec::new();
            for remedy in REMEDIES {
                let Some(record) = self.find(BasisName::Gimp, remedy, &level) else {
                    continue;
                };
                if let Some(table) = self
                    .snapshot(record, time)?
                    .filter(|table| !is_solid(table))
                {
                    let title = format!("{}, {time:.1} s", name_of(remedy));
                    shown.push((title, spacing(record), table));
                }
            }
            if shown.len() < REMEDIES.len() {
                break;
            }
            let panels: Vec<&(String, f64, Table)> = shown.iter().collect();
            frames.push(fields(String::new(), &panels, 1, &FIELDS[0]));
        }
        // Else it is but the snapshots.
        if frames.len() < 3 {
            return Ok(());
        }
        animate_fields(&self.path("slide"), &frames, DELAY)?;
        self.picture(
            "slide",
            format!(
                "The slide with GIMP, {}: plastic strain; standard MPM, the paper's F̄, ours.",
                level_title(&level)
            ),
        );
        Ok(())
    }
}

fn name_of(remedy: RemedyName) -> String {
    match remedy {
        RemedyName::None => "standard".to_owned(),
        _ => remedy.to_string(),
    }
}

/// "h = 0.4 m" of a level "h0.4", "slice, h = 0.4 m" of "slice-h0.4".
fn level_title(level: &str) -> String {
    match level.strip_prefix("slice-") {
        Some(rest) => format!("slice, {}", level_title(rest)),
        None => format!("h = {} m", level.trim_start_matches('h')),
    }
}

/// Whether particles lie in three dimensions.
fn is_solid(table: &Table) -> bool {
    !table.column("z").is_empty()
}

/// Distance of particles (m).
fn spacing(record: &Record) -> f64 {
    let dimension = record.discretisation.dim as f64;
    record.discretisation.h / f64::from(record.discretisation.ppc).powf(1.0 / dimension)
}

fn values(table: &Table, field: &Field) -> Vec<f64> {
    table
        .column(field.column)
        .iter()
        .map(|v| field.factor * v)
        .collect()
}

fn fields(
    title: String,
    panels: &[&(String, f64, Table)],
    columns: usize,
    field: &Field,
) -> FieldFigure {
    let panel = |(title, size, table): &&(String, f64, Table)| FieldPanel {
        title: title.clone(),
        points: table.points("x", "y"),
        values: values(table, field),
        size: *size,
        outline: OUTLINE.to_vec(),
    };
    FieldFigure {
        title,
        panels: panels.iter().map(panel).collect(),
        columns,
        range: field.range,
        label: field.label.to_owned(),
        x_label: "x (m)".to_owned(),
        y_label: "y (m)".to_owned(),
        window: Some(WINDOW),
    }
}

fn solids(
    title: String,
    panels: &[&(String, f64, Table)],
    columns: usize,
    field: &Field,
) -> SolidFigure {
    let across = |(_, size, table): &&(String, f64, Table)| {
        table.column("z").iter().fold(0.0_f64, |z, v| z.max(*v)) + 0.5 * size
    };
    let width = panels.iter().map(across).fold(0.0, f64::max);
    let panel = |(title, size, table): &&(String, f64, Table)| {
        let (x, y, z) = (table.column("x"), table.column("y"), table.column("z"));
        SolidPanel {
            title: title.clone(),
            points: (0..x.len()).map(|k| [x[k], y[k], z[k]]).collect(),
            values: values(table, field),
            size: *size,
        }
    };
    SolidFigure {
        title,
        panels: panels.iter().map(panel).collect(),
        columns,
        range: field.range,
        label: field.label.to_owned(),
        camera: Camera {
            azimuth: 35.0,
            elevation: 28.0,
            up: Up::Y,
        },
        axes: ["x (m)", "y (m)", "z (m)"].map(str::to_owned),
        window: Some([WINDOW.0, WINDOW.1, (0.0, width)]),
    }
}

fn chart(title: String, label: &str, series: Vec<Series>) -> Chart {
    Chart {
        title,
        x_label: "time (s)".to_owned(),
        y_label: label.to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        series,
        reference_lines: Vec::new(),
        slope_triangle: None,
        x_range: None,
        y_range: None,
    }
}
