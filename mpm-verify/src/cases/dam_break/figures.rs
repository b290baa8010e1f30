//! Figures: the paper's Figure 12, the flow against time, an animation.

use super::*;
use crate::cases::pictures::frames;
use crate::draw::animate_fields;
use crate::exact::dam_break::{front_curve, time_scale, uncertainty};

/// From above: standard, the paper's, ours.
const SHOWN: [RemedyName; 3] = [RemedyName::None, FbarRecursive, FbarConsistent];
const REMEDIES: [RemedyName; 4] = [RemedyName::None, FbarRecursive, FbarTotal, FbarConsistent];
/// The paper's level, or else the one that a short tier has.
const PREFERRED: [&str; 2] = ["h0.25", "h0.5"];
/// The paper's times (s).
const TIMES: [f64; 4] = [0.4, 1.0, 1.5, 2.0];
/// Times (s) between frames of the animation, and between showing them (hundredths of a second).
const FRAME: f64 = 0.05;
const DELAY: u16 = 15;
/// Height (m) of what is drawn of the tank, and its outline (m).
const HEIGHT: f64 = 3.2;
const OUTLINE: [(f64, f64); 4] = [(0.0, HEIGHT), (0.0, 0.0), (TANK, 0.0), (TANK, HEIGHT)];
const WINDOW: ((f64, f64), (f64, f64)) = ((0.0, TANK), (0.0, HEIGHT));
/// Greatest pressure (kPa) of the colour scale.
const MOST_PRESSURE: f64 = 20.0;
const FINEST_FIRST: [&str; 4] = ["h0.0625", "h0.125", "h0.25", "h0.5"];

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| r.changes_none_but(&["cfl", "duration"]);
    let mut records: Vec<&Record> = gallery.records.iter().filter(own).collect();
    // The run that changes least comes first.
    records.sort_by_key(|r| r.set.len());
    let mut runs = Exhibit::new(gallery, records);
    for basis in SMOOTH {
        snapshots(&mut runs, basis)?;
        flow(&mut runs, basis)?;
    }
    animation(&mut runs)
}

/// Our run among those that are compared over the levels.
fn on_the_ladder<'g>(runs: &Exhibit<'_, 'g>, basis: BasisName, level: &str) -> Option<&'g Record> {
    let mut own = runs.records.iter().filter(|r| (r.basis(), r.remedy()) == (basis, FbarConsistent)).copied();
    own.find(|r| r.level == level && r.set.iter().any(|s| s == LADDER))
}

/// "h = 0.25 m" of the level "h0.25".
fn level_title(level: &str) -> String {
    format!("h = {} m", &level[1..])
}

/// The water at `time` (s) in colours of its pressure, if the run has kept it.
fn panel(runs: &Exhibit, record: &Record, time: f64, title: String) -> Result<Option<FieldPanel>, Error> {
    let Some(table) = runs.gallery.snapshot(record, time)? else { return Ok(None) };
    let values = table.column("pressure").iter().map(|p| 1e-3 * p).collect();
    let panel = FieldPanel { values, outline: OUTLINE.to_vec(), ..field_panel(record, &table, title, "pressure") };
    Ok(Some(panel.showing(|(_, y)| y <= HEIGHT)))
}

/// A column of panels, one for each of the remedies, if all have kept this time.
fn column(runs: &Exhibit, (basis, level): (BasisName, &str), time: f64) -> Result<Vec<FieldPanel>, Error> {
    let mut panels = Vec::new();
    for remedy in SHOWN {
        let title = format!("{}, {time:.1} s", remedy_title(remedy));
        let Some(record) = runs.find(basis, remedy, level) else { return Ok(Vec::new()) };
        let Some(panel) = panel(runs, record, time, title)? else { return Ok(Vec::new()) };
        panels.push(panel);
    }
    Ok(panels)
}

fn figure(panels: Vec<FieldPanel>, columns: usize) -> Fields {
    Fields::new(panels, "pressure (kPa)", signed(MOST_PRESSURE)).columns(columns).within(WINDOW)
}

fn snapshots(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let Some(level) = runs.level(basis, &SHOWN, &PREFERRED) else { return Ok(()) };
    let columns = TIMES.iter().map(|time| column(runs, (basis, level), *time));
    let mut columns = columns.collect::<Result<Vec<_>, Error>>()?;
    columns.retain(|column| !column.is_empty());
    if columns.is_empty() {
        return Ok(());
    }
    let count = columns.len();
    let panels = (0..SHOWN.len() * count).map(|k| columns[k % count][k / count].clone()).collect();
    let of = basis_title(basis);
    let caption = format!(
        "The water with {of} in colours of its pressure: standard MPM, the paper's F̄, ours. The paper's Figure 12 (data: snapshots of each run; jets above {HEIGHT} m are cut off)."
    );
    let figure = figure(panels, count).titled(format!("{of}, {}", level_title(level)));
    figure.draw(runs.gallery, &format!("snapshots-{basis}"), caption)
}

fn animation(runs: &mut Exhibit) -> Result<(), Error> {
    let Some(level) = runs.level(Gimp, &SHOWN, &PREFERRED) else { return Ok(()) };
    let columns = frames(FRAME, |time| column(runs, (Gimp, level), time))?;
    let frames: Vec<FieldFigure> = columns.into_iter().map(|column| figure(column, SHOWN.len()).0).collect();
    if frames.is_empty() {
        return Ok(());
    }
    animate_fields(&runs.gallery.place("flow.png"), &frames, DELAY)?;
    let level = level_title(level);
    let caption = format!("The flow with GIMP at {level}, a third of its speed: standard MPM, the paper's F̄, ours.");
    runs.gallery.hang("flow.png", caption);
    Ok(())
}

/// Front, energy and forces against time: remedies at the paper's level, ours at all levels.
fn flow(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let quantities = [
        ("front", 1.0, "front x (m)"),
        ("energy", 1e-3, "energy (kJ/m)"),
        ("front_force", 1e-3, "force on the front wall (kN/m)"),
    ];
    let Some(shared) = runs.level(basis, &SHOWN, &PREFERRED) else { return Ok(()) };
    let (mut by_remedy, mut by_level) = (Vec::new(), Vec::new());
    for (column, factor, label) in quantities {
        let points = |_: &Record, t: &Table| t.pairs(["time", column], |t, v| (t, factor * v));
        let all = REMEDIES.iter().filter_map(|remedy| runs.find(basis, *remedy, shared));
        let panel = Panel::new(level_title(shared), ["time (s)", label])
            .histories(runs.gallery, all, points)?
            .by_run(|r, s| Series { name: remedy_title(r.remedy()), ..s });
        by_remedy.push(beside_front(panel, column));
        let mut panel = Panel::new(format!("fbar-consistent, {LADDER}"), ["time (s)", label]);
        for (colour, level) in FINEST_FIRST.into_iter().enumerate() {
            panel = panel
                .histories(runs.gallery, on_the_ladder(runs, basis, level), points)?
                .styled(|_, s| Series::line(level_title(level), s.points, colour));
        }
        by_level.push(beside_front(panel, column));
    }
    let (of, level) = (basis_title(basis), level_title(shared));
    let caption = format!(
        "Front, energy (kinetic, potential, stress work) and force on the wall against time with {of}: above, all remedies at {level}; below, fbar-consistent at all levels with one CFL number. The inviscid front is drawn in; water at rest in the tank has 52.2 kJ/m and presses with 8.7 kN/m."
    );
    Figure::new(format!("flow-{basis}"), caption, by_remedy.into_iter().chain(by_level))
        .columns(quantities.len())
        .share_axes_of_columns()
        .draw(runs.gallery)
}

/// The inviscid front beside the curves of the front.
fn beside_front<'a>(panel: Panel<'a>, column: &str) -> Panel<'a> {
    if column != "front" {
        return panel;
    }
    let points = front_curve().into_iter().filter(|(t, _)| *t <= 1.05 * time_scale()).collect();
    panel.reference(format!("inviscid ± {} m", uncertainty()), points)
}
