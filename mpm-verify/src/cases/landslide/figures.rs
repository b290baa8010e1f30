//! Figures of the landslide: the paper's Figures 14 to 16, in plane strain and in three dimensions.

use super::*;
use crate::cases::pictures::frames;
use crate::draw::{SolidFigure, SolidPanel, animate_fields, animate_solids, draw_solids};

/// Remedies without which there is nothing to compare.
const COMPARED: [RemedyName; 2] = [RemedyName::None, FbarConsistent];
/// Least number of frames of an animation: with fewer it is the snapshots alone.
const LEAST_FRAMES: usize = 3;
/// Times (s) of the pictures.
const TIMES: [f64; 3] = [1.0, 2.5, 5.5];
/// Times (s) between frames of the animation, and between showing them (hundredths of a second).
const FRAME: f64 = 0.2;
const DELAY: u16 = 20;
/// Coordinate of the first toe (m).
const TOE: f64 = 15.0;
/// Window of the section (m).
const WINDOW: ((f64, f64), (f64, f64)) = ((0.0, 45.0), (0.0, 5.5));
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (15.0, 0.0), (10.0, 5.0), (0.0, 5.0)];

/// A field of the snapshots: its column, the factor to the unit shown, its range and its label.
struct Field {
    column: &'static str,
    factor: f64,
    range: (f64, f64),
    label: &'static str,
    figure: &'static str,
}

const FIELDS: [Field; 2] = [
    Field {
        column: "plastic_strain",
        factor: 1.0,
        range: (0.0, 2.0),
        label: "equivalent plastic strain (–)",
        figure: "Figure 14",
    },
    Field {
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
        self.particles.column(field.column).iter().map(|v| field.factor * v).collect()
    }

    /// Values in seeding order of the particles in the middle of the width.
    fn in_the_middle<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let from = self.across / 2;
        values.iter().skip(from).step_by(self.across).copied().collect()
    }
}

impl<'g> Exhibit<'_, 'g> {
    fn remedies(&self, basis: BasisName, level: &str) -> impl Iterator<Item = &'g Record> {
        REMEDIES.into_iter().filter_map(move |remedy| self.find(basis, remedy, level))
    }

    /// Levels at which remedies can be compared with a basis, the longest runs and the finest first.
    fn levels(&self, basis: BasisName) -> Vec<&'g str> {
        let compares = |r: &&&Record| COMPARED.iter().all(|&remedy| self.find(basis, remedy, &r.level).is_some());
        crate::distinct(self.records.iter().filter(compares).map(|r| &*r.level))
    }

    /// All runs with a basis at a level, at `time` (s); none if a run has not kept it.
    fn at(&self, (basis, level): (BasisName, &str), time: f64) -> Result<Vec<Shown>, Error> {
        let mut shown = Vec::new();
        for record in self.remedies(basis, level) {
            let Some(particles) = self.gallery.snapshot(record, time)? else { return Ok(Vec::new()) };
            shown.push(Shown {
                title: format!("{}, {time:.1} s", remedy_title(record.remedy())),
                spacing: spacing(record),
                across: record.metric(PARTICLES_ACROSS).max(1.0) as usize,
                particles,
            });
        }
        Ok(shown)
    }
}

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| r.is_default() || r.changes_only("duration");
    let records = gallery.records.iter().filter(own);
    let mut runs = Exhibit::new(gallery, records);
    // Those that change least and the finest come first.
    runs.records.sort_by(|a, b| {
        let by_size = a.discretisation.h.total_cmp(&b.discretisation.h);
        a.set.len().cmp(&b.set.len()).then(by_size)
    });
    for basis in SMOOTH {
        let compared = runs.levels(basis).first().copied();
        // The finest level of all, if other remedies have yet to run on it.
        let ours = |r: &&&Record| r.basis() == basis && r.remedy() == FbarConsistent;
        let finest = runs.records.iter().find(ours).map(|r| &*r.level).filter(|level| Some(*level) != compared);
        for field in &FIELDS {
            let name = format!("{}-{basis}", field.column.replace('_', "-"));
            if let Some(level) = compared {
                snapshots(&mut runs, (basis, level), field, &name)?;
            }
            if let Some(level) = finest {
                snapshots(&mut runs, (basis, level), field, &format!("{name}-{level}"))?;
            }
        }
    }
    run_out(&mut runs)?;
    animation(&mut runs)
}

/// A field at all times, a row for each remedy: in three dimensions the solid and the section in its middle.
fn snapshots(runs: &mut Exhibit, (basis, level): (BasisName, &str), field: &Field, name: &str) -> Result<(), Error> {
    let times = TIMES.iter().map(|time| runs.at((basis, level), *time));
    let mut times = times.collect::<Result<Vec<_>, Error>>()?;
    times.retain(|shown| !shown.is_empty());
    let (columns, rows) = (times.len(), times.first().map_or(0, Vec::len));
    let row = |row| times.iter().map(move |shown: &Vec<Shown>| &shown[row]);
    let panels: Vec<&Shown> = (0..rows).flat_map(row).collect();
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
    if !panels.iter().all(|shown| shown.is_solid()) {
        return flat.draw(runs.gallery, name, caption(""));
    }
    let file = format!("{name}.png");
    draw_solids(&runs.gallery.place(&file), &solids(title.clone(), &panels, columns, field))?;
    runs.gallery.hang(&file, caption(""));
    flat.draw(runs.gallery, &format!("section-{name}"), caption(", in the middle of the width"))
}

/// Run-out, settlement and kinetic energy against time: remedies at the finest common level, levels of F̄.
fn run_out(runs: &mut Exhibit) -> Result<(), Error> {
    let quantities = [
        ("toe", (1.0, TOE), "run-out (m)"),
        ("settlement", (1.0, 0.0), "settlement of the crest (m)"),
        ("kinetic_energy", (1e-3, 0.0), "kinetic energy (kJ/m)"),
    ];
    let levels = crate::distinct(runs.records.iter().map(|r| &*r.level));
    let place = |r: &Record| levels.iter().position(|level| *level == r.level);
    let mut panels = Vec::new();
    for basis in SMOOTH {
        let Some(level) = runs.levels(basis).first().copied() else { continue };
        let of = basis_title(basis);
        // Since the reduction of the strength.
        let panel = |title: &str, records: Vec<_>, (column, (factor, start), label)| {
            Panel::new(format!("{of}, {title}"), ["time (s)", label]).histories(runs.gallery, records, |_, table| {
                let mut points = table.points("time", column);
                points.retain(|(time, _)| *time >= 0.0);
                points.iter().map(|(time, value)| (*time, factor * (value - start))).collect()
            })
        };
        for quantity in quantities {
            let panel = panel(&level_title(level), runs.remedies(basis, level).collect(), quantity)?;
            panels.push(panel.by_run(|r, s| Series { name: remedy_title(r.remedy()), ..s }));
        }
        for quantity in quantities {
            let own = levels.iter().take(LEVEL_DASHES.len());
            let own = own.filter_map(|level| runs.find(basis, FbarConsistent, level));
            let panel = panel("fbar-consistent", own.collect(), quantity)?;
            panels.push(panel.by_run(|r, s| Series {
                name: level_title(&r.level),
                dash: place(r).map_or(s.dash, |place| LEVEL_DASHES[place]),
                ..s
            }));
        }
    }
    Figure::new(
        "run-out",
        "Run-out, settlement of the crest and kinetic energy against time since the reduction: all remedies at the finest common level, then fbar-consistent at the finest levels (full: the finest). The paper's Figure 16.",
        panels,
    )
    .columns(quantities.len())
    .share_axes_of_columns()
    .draw(runs.gallery)
}

/// The plastic strain with GIMP, frame by frame, of the finest level that has kept frames.
fn animation(runs: &mut Exhibit) -> Result<(), Error> {
    let field = &FIELDS[0];
    for level in runs.levels(Gimp) {
        let frames = frames(FRAME, |time| runs.at((Gimp, level), time))?;
        if frames.len() < LEAST_FRAMES {
            continue;
        }
        let panels = frames.iter().map(|shown| shown.iter().collect::<Vec<_>>());
        let path = runs.gallery.place("slide.png");
        if frames.iter().flatten().all(Shown::is_solid) {
            let solid = |panels: Vec<&Shown>| solids(String::new(), &panels, 1, field);
            animate_solids(&path, &panels.map(solid).collect::<Vec<_>>(), DELAY)?;
        } else {
            let flat = |panels: Vec<&Shown>| fields(String::new(), &panels, 1, field).0;
            animate_fields(&path, &panels.map(flat).collect::<Vec<_>>(), DELAY)?;
        }
        let (level, label) = (level_title(level), field.label);
        runs.gallery.hang("slide.png", format!("The slide with GIMP, {level}: {label}."));
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

fn fields(title: String, panels: &[&Shown], columns: usize, field: &Field) -> Fields {
    let panel = |shown: &&Shown| FieldPanel {
        title: shown.title.clone(),
        points: shown.in_the_middle(&shown.particles.points("x", "y")),
        values: shown.in_the_middle(&shown.values(field)),
        size: shown.spacing,
        outline: OUTLINE.to_vec(),
    };
    let panels = panels.iter().map(panel).collect();
    Fields::new(panels, field.label, field.range).titled(title).columns(columns).within(WINDOW)
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
        window: [WINDOW.0, WINDOW.1, (0.0, panels.iter().map(width).fold(0.0, f64::max))],
    }
}
