//! The pictures of the landslide: the paper's Figures 14 to 16, in plane strain and in three dimensions.

use super::metrics::PARTICLES_ACROSS;
use super::parameters::DURATION;
use crate::draw::style::{Markers, series};
use crate::draw::{
    Camera, Chart, Dash, FieldFigure, FieldPanel, Marker, Scale, Series, SolidFigure, SolidPanel,
    animate_fields, animate_solids, draw_charts, draw_fields, draw_solids, share_ranges,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};
use crate::table::Table;
use std::path::PathBuf;

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
/// Those without which there is nothing to compare.
const COMPARED: [RemedyName; 2] = [RemedyName::None, RemedyName::FbarConsistent];
/// The one that long runs begin with.
const OURS: RemedyName = RemedyName::FbarConsistent;
/// Least number of frames of an animation: else it is but the snapshots.
const LEAST_FRAMES: usize = 3;
/// Times (s) of the pictures.
const TIMES: [f64; 3] = [1.0, 2.5, 5.5];
/// Times (s) between frames of the animation, and between showing them (hundredths of a second).
const FRAME: f64 = 0.2;
const DELAY: u16 = 20;
/// Colours of levels: those that no remedy shown here has.
const LEVEL_COLOURS: [usize; 5] = [5, 0, 2, 4, 7];
/// Coordinate of the first toe (m).
const TOE: f64 = 15.0;
/// What is shown of the section (m), and across (m).
const WINDOW: ((f64, f64), (f64, f64)) = ((0.0, 45.0), (0.0, 5.5));
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (15.0, 0.0), (10.0, 5.0), (0.0, 5.0)];

/// A field of the snapshots: its column, the factor to the unit shown, its range and its label.
struct Field {
    name: &'static str,
    column: &'static str,
    factor: f64,
    range: (f64, f64),
    label: &'static str,
    /// The paper's figure of it.
    figure: &'static str,
}

const FIELDS: [Field; 2] = [
    Field {
        name: "plastic-strain",
        column: "plastic_strain",
        factor: 1.0,
        range: (0.0, 2.0),
        label: "equivalent plastic strain (–)",
        figure: "Figure 14",
    },
    Field {
        name: "mean-stress",
        column: "mean_stress",
        factor: 1e-3,
        range: (-120.0, 0.0),
        label: "mean normal stress (kPa)",
        figure: "Figure 15",
    },
];

/// A run at one time, as a panel.
struct Shown {
    title: String,
    /// Distance of particles (m), and their number across the width.
    spacing: f64,
    across: usize,
    particles: Table,
}

impl Shown {
    /// Whether particles lie in three dimensions.
    fn is_solid(&self) -> bool {
        !self.particles.column("z").is_empty()
    }

    fn values(&self, field: &Field) -> Vec<f64> {
        let values = self.particles.column(field.column).iter();
        values.map(|v| field.factor * v).collect()
    }

    /// Of values in seeding order those in the middle of the width.
    fn in_the_middle<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let from = self.across / 2;
        values
            .iter()
            .skip(from)
            .step_by(self.across)
            .copied()
            .collect()
    }
}

struct Runs<'a, 'g> {
    gallery: &'a mut Gallery<'g>,
    records: Vec<&'g Record>,
}

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| r.is_default() || r.changes_only(DURATION.name);
    let ended = |r: &&Record| r.status == Status::Ok && r.transfer() == TransferName::Flip;
    let records = gallery.records.iter().filter(ended).filter(own).collect();
    let mut runs = Runs { gallery, records };
    // Of several the one that changes least, and the finest first.
    runs.records.sort_by(|a, b| {
        let key = |r: &Record| (r.set.len(), r.discretisation.h);
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    for (basis, title) in BASES {
        let compared = runs.levels(basis).into_iter().next();
        // The finest of all, if others have yet to run on it.
        let finest = runs
            .level_of(basis, OURS)
            .filter(|l| Some(l) != compared.as_ref());
        for field in &FIELDS {
            let name = format!("{}-{basis}", field.name);
            if let Some(level) = &compared {
                runs.snapshots(basis, level, field, (title, &name))?;
            }
            if let Some(level) = &finest {
                runs.snapshots(basis, level, field, (title, &format!("{name}-{level}")))?;
            }
        }
    }
    runs.run_out()?;
    runs.animation()
}

impl<'g> Runs<'_, 'g> {
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&'g Record> {
        self.records
            .iter()
            .find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level)
            .copied()
    }

    /// Levels at which remedies can be compared with a basis, the longest runs and the finest first.
    fn levels(&self, basis: BasisName) -> Vec<String> {
        let compares = |r: &&&Record| {
            let has = |&remedy: &RemedyName| self.find(basis, remedy, &r.level).is_some();
            COMPARED.iter().all(has)
        };
        let levels = self.records.iter().filter(compares);
        crate::distinct(levels.map(|r| r.level.clone()))
    }

    /// The finest level of the longest runs with a basis and a remedy.
    fn level_of(&self, basis: BasisName, remedy: RemedyName) -> Option<String> {
        let own = |r: &&&Record| r.basis() == basis && r.remedy() == remedy;
        self.records.iter().find(own).map(|r| r.level.clone())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.gallery.place(&format!("{name}.png"))
    }

    fn picture(&mut self, name: &str, caption: String) {
        self.gallery.hang(&format!("{name}.png"), caption);
    }

    /// All that has run with a basis at a level, at `time` (s); none if a run has not kept it.
    fn shown(&self, basis: BasisName, level: &str, time: f64) -> Result<Vec<Shown>, Error> {
        let mut shown = Vec::new();
        for remedy in REMEDIES {
            let Some(record) = self.find(basis, remedy, level) else {
                continue;
            };
            let Some(particles) = self.gallery.snapshot(record, time)? else {
                return Ok(Vec::new());
            };
            shown.push(Shown {
                title: format!("{}, {time:.1} s", name_of(remedy)),
                spacing: spacing(record),
                across: record.metric(PARTICLES_ACROSS).max(1.0) as usize,
                particles,
            });
        }
        Ok(shown)
    }

    /// A field at all times, a row for each remedy: in three dimensions the solid and the section in its middle.
    fn snapshots(
        &mut self,
        basis: BasisName,
        level: &str,
        field: &Field,
        (of, name): (&str, &str),
    ) -> Result<(), Error> {
        let mut times = Vec::new();
        for time in TIMES {
            let shown = self.shown(basis, level, time)?;
            if !shown.is_empty() {
                times.push(shown);
            }
        }
        let (columns, rows) = (times.len(), times.first().map_or(0, Vec::len));
        let panels: Vec<&Shown> = (0..rows)
            .flat_map(|row| times.iter().map(move |shown| &shown[row]))
            .collect();
        if panels.is_empty() {
            return Ok(());
        }
        let title = format!("{of}, {}", level_title(level));
        let solid = panels.iter().all(|shown| shown.is_solid());
        if solid {
            draw_solids(
                &self.path(name),
                &solids(title.clone(), &panels, columns, field),
            )?;
            self.picture(
                name,
                format!(
                    "The slide with {title}: {}. The paper's {} (data: snapshots of each run).",
                    field.label, field.figure
                ),
            );
        }
        let (section, where_it_is) = match solid {
            true => (format!("section-{name}"), ", in the middle of the width"),
            false => (name.to_owned(), ""),
        };
        draw_fields(
            &self.path(&section),
            &fields(title.clone(), &panels, columns, field),
        )?;
        self.picture(
            &section,
            format!(
                "The slide with {title}{where_it_is}: {}. The paper's {} (data: snapshots of each run).",
                field.label, field.figure
            ),
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
        let table = self.gallery.table(record, "series.csv")?;
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
            let Some(level) = self.levels(basis).into_iter().next() else {
                continue;
            };
            for (column, scale, label) in quantities {
                let mut curves = Vec::new();
                for remedy in REMEDIES {
                    if let Some(record) = self.find(basis, remedy, &level) {
                        let points = self.history(record, column, scale)?;
                        let mut curve = series(Scheme::flip(basis, remedy), points, Markers::None);
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
        self.gallery.write_curves("run-out.csv", &charts)?;
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
        for (level, colour) in levels.into_iter().zip(LEVEL_COLOURS) {
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
        let (basis, field) = (BasisName::Gimp, &FIELDS[0]);
        for level in self.levels(basis) {
            let mut frames = Vec::new();
            for k in 1.. {
                let shown = self.shown(basis, &level, f64::from(k) * FRAME)?;
                if shown.is_empty() {
                    break;
                }
                frames.push(shown);
            }
            if frames.len() < LEAST_FRAMES {
                continue;
            }
            let panels = frames.iter().map(|shown| shown.iter().collect::<Vec<_>>());
            let (name, path) = ("slide", self.path("slide"));
            if frames.iter().flatten().all(Shown::is_solid) {
                let solid = |panels: Vec<&Shown>| solids(String::new(), &panels, 1, field);
                animate_solids(&path, &panels.map(solid).collect::<Vec<_>>(), DELAY)?;
            } else {
                let flat = |panels: Vec<&Shown>| fields(String::new(), &panels, 1, field);
                animate_fields(&path, &panels.map(flat).collect::<Vec<_>>(), DELAY)?;
            }
            let level = level_title(&level);
            self.picture(
                name,
                format!("The slide with GIMP, {level}: {}.", field.label),
            );
            break;
        }
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
        None => format!("h = {}\u{a0}m", level.trim_start_matches('h')),
    }
}

/// Distance of particles (m).
fn spacing(record: &Record) -> f64 {
    let dimension = record.discretisation.dim as f64;
    record.discretisation.h / f64::from(record.discretisation.ppc).powf(1.0 / dimension)
}

fn fields(title: String, panels: &[&Shown], columns: usize, field: &Field) -> FieldFigure {
    let panel = |shown: &&Shown| FieldPanel {
        title: shown.title.clone(),
        points: shown.in_the_middle(&shown.particles.points("x", "y")),
        values: shown.in_the_middle(&shown.values(field)),
        size: shown.spacing,
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

fn solids(title: String, panels: &[&Shown], columns: usize, field: &Field) -> SolidFigure {
    let width = |shown: &&Shown| shown.across as f64 * shown.spacing;
    let panel = |shown: &&Shown| {
        let [x, y, z] = ["x", "y", "z"].map(|axis| shown.particles.column(axis));
        SolidPanel {
            title: shown.title.clone(),
            points: (0..x.len()).map(|k| [x[k], y[k], z[k]]).collect(),
            values: shown.values(field),
            size: shown.spacing,
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
        },
        axes: ["x (m)", "y (m)", "z (m)"].map(str::to_owned),
        window: [
            WINDOW.0,
            WINDOW.1,
            (0.0, panels.iter().map(width).fold(0.0, f64::max)),
        ],
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
