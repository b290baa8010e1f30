//! The pictures of the slab.

use super::parameters::POISSON_RATIO;
use super::scene::{END, slab};
use crate::draw::style::{history, series};
use crate::draw::{Chart, Dash, Marker, Series, draw_charts};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, Scheme, SpaceName};

/// Points of a curve.
const POINTS: u32 = 300;

/// Draws the pressure in the middle over the time, of two grids on 16 cells, on Mandel's series, for every ratio.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let scheme = Scheme::poro(BasisName::Gimp, SpaceName::TwoGrid);
    let own = |r: &&Record| {
        let ratio_alone = r.is_default() || r.changes_only(POISSON_RATIO.name);
        r.scheme() == scheme && r.level == "n16" && r.status == Status::Ok && ratio_alone
    };
    let mut runs: Vec<&Record> = gallery.records.iter().filter(own).collect();
    runs.sort_by(|a, b| {
        let ratio = |r: &Record| r.parameters.number(POISSON_RATIO);
        ratio(a).total_cmp(&ratio(b))
    });
    let mut curves = Vec::new();
    for (colour, record) in runs.into_iter().enumerate() {
        let ratio = record.parameters.number(POISSON_RATIO);
        let exact = slab(&record.parameters);
        let points = (1..=POINTS).map(|k| {
            let t = END * f64::from(k) / f64::from(POINTS);
            (t, exact.at(t).centre)
        });
        curves.push(Series {
            name: format!("ν = {ratio}, exact"),
            colour,
            ..history(scheme, points.collect())
        });
        let table = gallery.table(record, "series.csv")?;
        let points = table.points("time_factor", "centre_pressure");
        curves.push(Series {
            name: format!("ν = {ratio}"),
            colour,
            marker: Marker::Circle,
            dash: Dash::Dotted,
            ..series(scheme, points.into_iter().step_by(8).collect())
        });
    }
    if curves.is_empty() {
        return Ok(());
    }
    let charts = [Chart::new("", ["T", "p/(F/2a) in the middle"], curves)];
    gallery.write_curves("centre-pressure.csv", &charts)?;
    draw_charts(&gallery.place("centre-pressure.png"), &charts, 1)?;
    gallery.hang(
        "centre-pressure.png",
        "Pressure in the middle of the slab over the time, of two grids with GIMP on 16 cells, and Mandel's series.",
    );
    Ok(())
}
