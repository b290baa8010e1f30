//! The figures of the strip, beside Figures 10 and 11 of the paper.

use super::*;

/// Shares of the load at which particles are drawn.
const SHARES: [f64; 2] = [0.25, 0.5];
/// Pressures over the load, and decimal logarithms of plastic strains, that are drawn.
const PRESSURES: (f64, f64) = (0.0, 1.0);
const STRAINS: (f64, f64) = (-4.0, -1.0);

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    pressures(gallery)?;
    plastic_strain(gallery)?;
    settlements(gallery)
}

/// The finest of the runs of two grids that `own` takes.
fn finest<'g>(gallery: &Gallery<'g>, own: impl Fn(&Record) -> bool) -> Option<&'g Record> {
    LEVELS.iter().rev().find_map(|(level, _)| {
        let like = |r: &&Record| is_of(r, TwoGrid) && r.status == Status::Ok && r.level == *level && own(r);
        gallery.records.iter().find(like)
    })
}

fn panel(record: &Record, table: &Table, title: String, column: &str, of: impl Fn(f64) -> f64) -> FieldPanel {
    FieldPanel {
        values: table.column(column).iter().map(|value| of(*value)).collect(),
        outline: vec![(0.0, SIDE), (1.0, SIDE), (1.0, SIDE + 0.1), (0.0, SIDE + 0.1)],
        ..field_panel(record, table, title, column)
    }
}

/// Pressure over the load of elastic soil at shares of the load, and of clay at its limit: Figures 10 and 11(b).
fn pressures(gallery: &mut Gallery) -> Result<(), Error> {
    let of =
        |record, table: &Table, title: String, load: f64| panel(record, table, title, "pore_pressure", |p| p / load);
    let mut panels = Vec::new();
    if let Some(record) = finest(gallery, Record::is_default) {
        let (load, duration) = (Loaded::number_of(record, |s| s.load), Loaded::number_of(record, |s| s.duration));
        let title = |load: f64| format!("elastic, q = {} kPa", 1e-3 * load);
        for share in SHARES {
            if let Some(table) = gallery.snapshot(record, share * duration)? {
                panels.push(of(record, &table, title(share * load), share * load));
            }
        }
        panels.push(of(record, &gallery.table(record, "particles.csv")?, title(load), load));
    }
    if let Some(record) = finest(gallery, |r| r.changes(CLAY)) {
        let table = gallery.table(record, "particles.csv")?;
        let load = record.metric(LAST_LOAD);
        panels.push(of(record, &table, format!("Cam clay, q = {:.1} kPa", 1e-3 * load), load));
    }
    let caption = "Pressure at the particles over the load, of two grids, of elastic soil as the load grows and of Cam clay at its limit. The paper's Figures 10 and 11(b) (data: particles.csv and snapshots of the runs).";
    Fields::new(panels, "p/q", PRESSURES).draw(gallery, "pressure", caption)
}

/// Where clay has yielded: Figure 11(a).
fn plastic_strain(gallery: &mut Gallery) -> Result<(), Error> {
    let mut panels = Vec::new();
    if let Some(record) = finest(gallery, |r| r.changes(CLAY)) {
        let table = gallery.table(record, "particles.csv")?;
        panels.push(panel(record, &table, "Cam clay at its limit".to_owned(), "plastic_strain", f64::log10));
    }
    let caption = "Equivalent plastic strain of Cam clay at its limit, of two grids. The paper's Figure 11(a) (data: particles.csv of the run).";
    Fields::new(panels, "log₁₀ of the equivalent plastic strain", STRAINS).draw(gallery, "plastic-strain", caption)
}

/// Load over settlement: of elastic soil and of clay in several steps, and of undrained clay under load and settlement.
fn settlements(gallery: &mut Gallery) -> Result<(), Error> {
    type Own = fn(&Record) -> bool;
    let kinds: [(&str, Own); 3] = [
        ("elastic", is_elastic_but_steps),
        ("Cam clay", |r| Loaded::holds(r, |s| s.is_plastic()) && is_set_but_steps(r, CLAY)),
        ("undrained, stiff Cam clay", is_limit),
    ];
    let panel = |(title, own): (&str, Own)| {
        let runs =
            gallery.records.iter().filter(|r| is_of(r, TwoGrid) && r.level == "b4" && r.status == Status::Ok && own(r));
        let panel = Panel::new(title, ["settlement/B (%)", "q (kPa)"]);
        let panel =
            panel.histories(gallery, runs, |_, t| t.pairs(["settlement", "load"], |s, q| (100.0 * s, 1e-3 * q)))?;
        let named = panel.by_run(|r, curve| {
            let given = if Loaded::holds(r, |s| s.is_driven()) { "settlement, " } else { "" };
            Series { name: format!("{given}{} steps", Loaded::number_of(r, |s| f64::from(s.steps))), ..curve }
        });
        Ok(named.styled(|colour, curve| Series {
            marker: Marker::Circle,
            ..Series::line(curve.name, curve.points, colour)
        }))
    };
    let panels: Result<Vec<Panel>, Error> = kinds.map(panel).into_iter().collect();
    Figure::new("load-settlement", "Load over settlement at h = B/4 in several steps.", panels?).draw(gallery)
}
