//! The picture of the column.

use super::parameters::LOAD;
use super::reference::solution;
use crate::draw::style::{history, series};
use crate::draw::{Chart, Dash, Series, draw_charts};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, Scheme, SpaceName};

/// The level that is drawn: differences of finer ones can't be seen.
const LEVEL: &str = "n8";

/// Settlement and base pressure over time at both loads.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let mut charts = Vec::new();
    for load in [0.3, 1.0] {
        for (column, title) in [
            ("settlement", "settlement/H (%)"),
            ("base_pressure", "p/q at the base (%)"),
        ] {
            charts.extend(chart(gallery, load, column, title)?);
        }
    }
    if charts.is_empty() {
        return Ok(());
    }
    gallery.write_curves("settlement.csv", &charts)?;
    draw_charts(&gallery.place("settlement.png"), &charts, 2)?;
    gallery.hang(
        "settlement.png",
        "Settlement and pressure at the base on 8 cells, GIMP, at loads of 0.3 and 1 M₀, and the independent solution.",
    );
    Ok(())
}

fn chart(gallery: &Gallery, load: f64, column: &str, title: &str) -> Result<Option<Chart>, Error> {
    let own = |r: &&Record| {
        r.basis() == BasisName::Gimp
            && r.status == Status::Ok
            && r.level == LEVEL
            && r.changes_none_but(&[LOAD.name])
            && r.parameters.number(LOAD) == load
    };
    let mut curves = Vec::new();
    for record in gallery.records.iter().filter(own) {
        let table = gallery.table(record, "series.csv")?;
        let points = table.points("time_factor", column).into_iter();
        let points = points.map(|(t, y)| (t, 100.0 * y)).collect();
        curves.push(history(record.scheme(), points));
    }
    if curves.is_empty() {
        return Ok(None);
    }
    let exact = solution(load, None).into_iter().map(|at| {
        let value = if column == "settlement" {
            at.settlement
        } else {
            at.base
        };
        (at.t, 100.0 * value)
    });
    curves.push(Series {
        name: "independent solution".to_owned(),
        colour: 6,
        dash: Dash::None,
        ..series(
            Scheme::poro(BasisName::Gimp, SpaceName::TwoGrid),
            exact.collect(),
        )
    });
    let chart = Chart::new("", ["T", title], curves);
    Ok(Some(Chart {
        title: format!("q = {load} M₀"),
        ..chart
    }))
}
