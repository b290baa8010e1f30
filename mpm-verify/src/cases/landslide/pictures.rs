//! The pictures of the landslide: the paper's Figures 14 to 16, in plane strain and in three dimensions.

use super::metrics::PARTICLES_ACROSS;
use super::parameters::DURATION;
use crate::cases::pictures::{Exhibit, basis_title, remedy_title, spacing};
use crate::draw::{
    Chart, FieldFigure, FieldPanel, Series, SolidFigure, SolidPanel, animate_fields,
    animate_solids, draw_solids, share_ranges_of_columns, signed,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};
use crate::table::Table;

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
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
        range: signed(-120.0),
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

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| r.is_default() || r.changes_only(DURATION.name);
    let records = gallery.records.iter().filter(own);
    let mut runs = Exhibit::new(gallery, records);
    // Of several the one that changes least, and the finest first.
    runs.records.sort_by(|a, b| {
        let by_size = a.discretisation.h.total_cmp(&b.discretisation.h);
        a.set.len().cmp(&b.set.len()).then(by_size)
    });
    for basis in BASES {
        let compared = levels(&runs, basis).into_iter().next();
        // The finest of all, if others have yet to run on it.
        let finest = level_of(&runs, basis, OURS).filter(|l| Some(l) != compared.as_ref());
        for field in &FIELDS {
            let name = format!("{}-{basis}", field.name);
            if let Some(level) = &compared {
                snapshots(&mut runs, basis, level, field, &name)?;
            }
            if let Some(level) = &finest {
                snapshots(&mut runs, basis, level, field, &format!("{name}-{level}"))?;
            }
        }
    }
    run_out(&mut runs)?;
    animation(&mut runs)
}

/// Levels at which remedies can be compared with a basis, the longest runs and the finest first.
fn levels(runs: &Exhibit, basis: BasisName) -> Vec<String> {
    let compares = |r: &&&Record| {
        let has = |&remedy: &RemedyName| runs.find(basis, remedy, &r.level).is_some();
        COMPARED.iter().all(has)
    };
    let levels = runs.records.iter().filter(compares);
    crate::distinct(levels.map(|r| r.level.clone()))
}

/// The finest level of the longest runs with a basis and a remedy.
fn level_of(runs: &Exhibit, basis: BasisName, remedy: RemedyName) -> Option<String> {
    let own = |r: &&&Record| r.basis() == basis && r.remedy() == remedy;
    runs.records.iter().find(own).map(|r| r.level.clone())
}

/// All that has run with a basis at a level, at `time` (s); none if a run has not kept it.
fn shown(runs: &Exhibit, basis: BasisName, level: &str, time: f64) -> Result<Vec<Shown>, Error> {
    let mut shown = Vec::new();
    for remedy in REMEDIES {
        let Some(record) = runs.find(basis, remedy, level) else {
            continue;
        };
        let Some(particles) = runs.gallery.snapshot(record, time)? else {
            return Ok(Vec::new());
        };
        shown.push(Shown {
            title: format!("{}, {time:.1} s", remedy_title(remedy)),
            spacing: spacing(record),
            across: record.metric(PARTICLES_ACROSS).max(1.0) as usize,
            particles,
        });
    }
    Ok(shown)
}

/// A field at all times, a row for each remedy: in three dimensions the solid and the section in its middle.
fn snapshots(
    runs: &mut Exhibit,
    basis: BasisName,
    level: &str,
    field: &Field,
    name: &str,
) -> Result<(), Error> {
    let mut times = Vec::new();
    for time in TIMES {
        let shown = shown(runs, basis, level, time)?;
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
    let title = format!("{}, {}", basis_title(basis), level_title(level));
    let caption = |place: &str| {
        format!(
            "The slide with {title}{place}: {}. The paper's {} (data: snapshots of each run).",
            field.label, field.figure
        )
    };
    let flat = fields(title.clone(), &panels, columns, field);
    if panels.iter().all(|shown| shown.is_solid()) {
        let solid = solids(title.clone(), &panels, columns, field);
        draw_solids(&runs.place(name), &solid)?;
        runs.hang(name, caption(""));
        let section = format!("section-{name}");
        runs.fields(&section, &flat, caption(", in the middle of the width"))
    } else {
        runs.fields(name, &flat, caption(""))
    }
}

/// A column of the series of a run since the reduction of the strength, against time (s).
fn history(
    runs: &Exhibit,
    record: &Record,
    column: &str,
    (factor, start): (f64, f64),
) -> Result<Vec<(f64, f64)>, Error> {
    let points = runs.history(record, ["time", column])?.into_iter();
    let since = points.filter(|(time, _)| *time >= 0.0);
    Ok(since
        .map(|(time, value)| (time, factor * (value - start)))
        .collect())
}

/// Run-out, settlement and kinetic energy against time: remedies at the finest common level, levels of F̄.
fn run_out(runs: &mut Exhibit) -> Result<(), Error> {
    let quantities = [
        ("toe", (1.0, TOE), "run-out (m)"),
        ("settlement", (1.0, 0.0), "settlement of the crest (m)"),
        ("kinetic_energy", (1e-3, 0.0), "kinetic energy (kJ/m)"),
    ];
    let mut charts = Vec::new();
    for basis in BASES {
        let Some(level) = levels(runs, basis).into_iter().next() else {
            continue;
        };
        let of = basis_title(basis);
        for (column, scale, label) in quantities {
            let curves = runs.by_remedy((basis, &level), &REMEDIES, |r| {
                history(runs, r, column, scale)
            })?;
            let title = format!("{of}, {}", level_title(&level));
            charts.push(Chart::new(title, ["time (s)", label], curves));
        }
        for (column, scale, label) in quantities {
            let curves = by_level(runs, basis, column, scale)?;
            let title = format!("{of}, fbar-consistent");
            charts.push(Chart::new(title, ["time (s)", label], curves));
        }
    }
    if charts.is_empty() {
        return Ok(());
    }
    share_ranges_of_columns(&runs.place("run-out"), &mut charts, quantities.len())?;
    runs.charts(
        "run-out",
        &charts,
        quantities.len(),
        "Run-out, settlement of the crest and kinetic energy against time since the reduction: all remedies at the finest common level, then fbar-consistent at all levels. The paper's Figure 16.",
    )
}

fn by_level(
    runs: &Exhibit,
    basis: BasisName,
    column: &str,
    scale: (f64, f64),
) -> Result<Vec<Series>, Error> {
    let levels = crate::distinct(runs.records.iter().map(|r| r.level.clone()));
    let mut curves = Vec::new();
    for (level, colour) in levels.into_iter().zip(LEVEL_COLOURS) {
        if let Some(record) = runs.find(basis, OURS, &level) {
            let points = history(runs, record, column, scale)?;
            curves.push(Series::line(level_title(&level), points, colour));
        }
    }
    Ok(curves)
}

/// The plastic strain with GIMP, frame by frame, of the finest level that has kept frames.
fn animation(runs: &mut Exhibit) -> Result<(), Error> {
    let (basis, field) = (BasisName::Gimp, &FIELDS[0]);
    for level in levels(runs, basis) {
        let mut frames = Vec::new();
        for k in 1.. {
            let shown = shown(runs, basis, &level, f64::from(k) * FRAME)?;
            if shown.is_empty() {
                break;
            }
            frames.push(shown);
        }
        if frames.len() < LEAST_FRAMES {
            continue;
        }
        let panels = frames.iter().map(|shown| shown.iter().collect::<Vec<_>>());
        let path = runs.place("slide");
        if frames.iter().flatten().all(Shown::is_solid) {
            let solid = |panels: Vec<&Shown>| solids(String::new(), &panels, 1, field);
            animate_solids(&path, &panels.map(solid).collect::<Vec<_>>(), DELAY)?;
        } else {
            let flat = |panels: Vec<&Shown>| fields(String::new(), &panels, 1, field);
            animate_fields(&path, &panels.map(flat).collect::<Vec<_>>(), DELAY)?;
        }
        let (level, label) = (level_title(&level), field.label);
        runs.hang("slide", format!("The slide with GIMP, {level}: {label}."));
        break;
    }
    Ok(())
}

/// "h = 0.4 m" of a level "h0.4", "slice, h = 0.4 m" of "slice-h0.4".
fn level_title(level: &str) -> String {
    match level.strip_prefix("slice-") {
        Some(rest) => format!("slice, {}", level_title(rest)),
        None => format!("h = {}\u{a0}m", level.trim_start_matches('h')),
    }
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
        window: [
            WINDOW.0,
            WINDOW.1,
            (0.0, panels.iter().map(width).fold(0.0, f64::max)),
        ],
    }
}
