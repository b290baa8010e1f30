//! Pictures of motions: the mean stress of one that locks, the energy of one that lasts.

use super::tables::changes;
use crate::cases::family::REMEDIES;
use crate::draw::{FieldFigure, FieldPanel, draw_fields};
use crate::prelude::*;

/// Mean stress at the end of runs of one level in the plane, on a scale of ± `most` (Pa): standard, by rates, and ours.
pub(in crate::cases) fn mean_stress(
    gallery: &mut Gallery,
    level: &str,
    most: f64,
) -> Result<(), Error> {
    let mut panels = Vec::new();
    for scheme in [Gimp, Bspline2]
        .into_iter()
        .flat_map(|b| [RemedyName::None, FbarRate, FbarConsistent].map(|r| Scheme::flip(b, r)))
    {
        let run = gallery.records.iter().find(|r| {
            r.level == level && r.is_default() && r.scheme() == scheme && r.status == Status::Ok
        });
        let Some(run) = run else {
            continue;
        };
        let table = gallery.table(run, "particles.csv")?;
        panels.push(FieldPanel {
            title: scheme.title(),
            points: table.points("x", "y"),
            values: table.column("mean_stress").to_vec(),
            size: run.discretisation.h / f64::from(run.discretisation.ppc).sqrt(),
            outline: Vec::new(),
        });
    }
    if panels.is_empty() {
        return Ok(());
    }
    let figure = FieldFigure {
        title: String::new(),
        panels,
        columns: 3,
        range: (-most, most),
        label: "mean stress (Pa)".to_owned(),
        window: None,
    };
    draw_fields(&gallery.place("mean-stress.png"), &figure)?;
    gallery.hang(
        "mean-stress.png",
        format!("Mean stress of the particles at the end, at level {level}."),
    );
    Ok(())
}

/// Kinetic energy over time of the runs at the two coarsest levels in which `set` was changed, with FLIP: a panel per
/// basis and level. A cross marks a breakdown.
pub(in crate::cases) fn kinetic_energy(gallery: &mut Gallery, set: &str) -> Result<(), Error> {
    let mut panels = Vec::new();
    for basis in [Gimp, Bspline2] {
        for level in ["n8", "n16"] {
            let schemes = REMEDIES.map(|remedy| Scheme::flip(basis, remedy));
            let run = |scheme: Scheme| {
                let is_of =
                    |r: &&Record| r.level == level && changes(r, set) && r.scheme() == scheme;
                gallery.records.iter().find(is_of)
            };
            let runs: Vec<&Record> = schemes.into_iter().filter_map(run).collect();
            let broken = runs.iter().copied().filter(|r| r.status == Status::Failed);
            let energy = |t: &Table| t.points("time", "kinetic_energy");
            let labels = ["time (s)", "kinetic energy (J/m)"];
            let panel = Panel::new(format!("{basis}, {level}"), labels)
                .log_y()
                .histories(gallery, runs.iter().copied(), |_, t| energy(t))?
                .by_run(|r, curve| Series {
                    name: r.remedy().to_string(),
                    ..curve
                })
                .histories(gallery, broken, |_, t| {
                    energy(t).last().copied().into_iter().collect()
                })?
                .styled(|_, cross| Series {
                    name: String::new(),
                    marker: Marker::Cross,
                    dash: Dash::None,
                    ..cross
                });
            panels.push(panel);
        }
    }
    let changed = set.replace(' ', ", ");
    let caption = format!("Kinetic energy with {changed}; a cross marks a breakdown.");
    Figure::new("energy", caption, panels)
        .columns(2)
        .share_axes()
        .draw(gallery)
}
