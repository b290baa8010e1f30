//! The picture of runs: the watched columns of their series.

use super::format::{Column, Run, SERIES};
use super::*;
use crate::distinct;
use crate::draw::style::series;
use crate::draw::triptych::different_pixels;
use crate::draw::{Chart, PlotError, Series, draw_charts};
use crate::files::{DOCUMENT, OTHER_LAYOUT, read, read_picture};
use crate::scheme::Scheme;
use image::imageops;

/// Width of a picture, in pixels, and of one with a single chart, whose curves are longer.
pub(super) const WIDTH: u32 = 480;
const NARROW: u32 = 400;
/// Step of a colour channel: with sixteen shades a field takes half of the bytes.
const SHADE: u16 = 17;

/// The last chunk of a PNG file.
const END_OF_PNG: &[u8] = b"IEND\xaeB`\x82";

/// Draws the watched columns of runs over the first column of their series, a chart each, with a curve a run.
pub(super) fn curves(runs: &[Run], abscissa: &str) -> Result<RgbImage, Error> {
    let watched = runs.iter().flat_map(|run| &run.columns).filter_map(|c| c.quantity.strip_prefix(SERIES));
    let charts: Result<Vec<Chart>, Error> = distinct(watched)
        .into_iter()
        .map(|header| {
            let curves = runs.iter().map(|run| curve(run, header)).collect::<Result<Vec<Series>, Error>>()?;
            Ok(Chart::new("", [abscissa, header], curves))
        })
        .collect();
    let charts = charts?;
    let width = if charts.len() == 1 { NARROW } else { WIDTH };
    small(width, |path| draw_charts(path, &charts, charts.len().min(2)))
}

/// A column of a run, as its scheme looks everywhere.
fn curve(run: &Run, header: &str) -> Result<Series, Error> {
    let scheme = run.name.split('/').next().unwrap_or_default();
    let scheme = Scheme::parse(scheme).map_err(|e| Error::Input(e.to_string()))?;
    let own = |c: &&Column| c.quantity.strip_prefix(SERIES) == Some(header);
    let points = run.columns.iter().filter(own).flat_map(|c| &c.points).filter_map(|p| Some((p.time?, p.value)));
    Ok(series(scheme, points.collect()))
}

/// Picture written by `draw`, scaled to this width (pixels) and few shades.
pub(super) fn small(width: u32, draw: impl Fn(&Path) -> Result<(), PlotError>) -> Result<RgbImage, Error> {
    let folder = tempfile::tempdir().map_err(|e| Error::Input(format!("temporary folder: {e}")))?;
    let path = folder.path().join("picture.png");
    draw(&path)?;
    let picture = read_picture(&path)?;
    let height = picture.height() * width / picture.width();
    let mut picture = imageops::thumbnail(&picture, width, height);
    for channel in picture.iter_mut() {
        *channel = ((u16::from(*channel) + SHADE / 2) / SHADE * SHADE) as u8;
    }
    Ok(picture)
}

/// The verdict on the pixels in which a picture differs from the one that is kept.
pub(super) fn judged(metric: &str, kept: &Path, drawn: Result<RgbImage, Error>, blessing: &str) -> Verdict {
    let different = drawn.and_then(|drawn| match read(kept, DOCUMENT)?.ends_with(END_OF_PNG) {
        true => Ok(different_pixels(&read_picture(kept)?, &drawn)),
        false => Err(Error::file(kept, OTHER_LAYOUT)),
    });
    match different {
        Ok(different) => of_drift(Finding::within(metric, different as f64, 0.0, 0.0, blessing)),
        Err(error) => mismatch(metric, &error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::write_small_png;
    use crate::golden::Point;
    use image::Rgb;

    /// A picture is 480 pixels wide, of sixteen shades, and shows each row: a single one, too.
    #[test]
    fn pictures_are_small() {
        let draw = |path: &Path| {
            let line = Series::line("", vec![(0.0, 0.0), (1.0, 1.0)], 0);
            draw_charts(path, &[Chart::new("", ["x", "y"], vec![line])], 1)
        };
        let blank = small(480, draw).unwrap();
        assert_eq!(blank.width(), 480);
        assert_eq!(small(30, draw).unwrap().width(), 30);
        let whole = tempfile::tempdir().unwrap();
        let path = whole.path().join("whole.png");
        draw(&path).unwrap();
        let whole = read_picture(&path).unwrap();
        assert_eq!(blank.height(), whole.height() * 480 / whole.width());
        assert!(blank.pixels().flat_map(|p| p.0).all(|channel| channel % 17 == 0));
        assert!(blank.pixels().any(|p| *p == Rgb([255; 3])));
        // Every shade is the nearest of sixteen.
        let shades = small(480, |path| {
            let ramp = RgbImage::from_fn(480, 256, |_, y| Rgb([y as u8; 3]));
            write_small_png(path, &ramp)
        });
        for (_, y, pixel) in shades.unwrap().enumerate_pixels() {
            let nearest = 17 * ((f64::from(y) / 17.0).round() as u8);
            assert_eq!(pixel.0, [nearest; 3], "{y}");
        }
        let run = |times: &[f64]| {
            let points = times.iter().map(|t| Point { time: Some(*t), value: 2.0, response: 0.0 });
            let column = |quantity: &str| Column { quantity: quantity.to_owned(), points: points.clone().collect() };
            let columns = vec![column("series/a (m)"), column("metric/b (m)"), column("series/c (m)")];
            Run { name: "gimp-fbar-consistent-flip/h2".to_owned(), columns }
        };
        let ink = |picture: &RgbImage| {
            let coloured = |p: &&Rgb<u8>| p.0[0] != p.0[1] || p.0[1] != p.0[2];
            picture.pixels().filter(coloured).count()
        };
        let [one, two] = [&[1.0][..], &[1.0, 1.5, 2.0]].map(|t| curves(&[run(t)], "time (s)").unwrap());
        assert!(ink(&one) > 0 && ink(&two) > ink(&one), "{} {}", ink(&one), ink(&two));
        // Two charts side by side.
        assert!(one.height() < blank.height());
        // A curve a run, as its scheme looks, with a legend.
        let other = Run { name: "bspline2-none-flip/h2".to_owned(), columns: run(&[1.2, 1.4]).columns };
        let both = curves(&[run(&[1.0]), other.clone()], "time (s)").unwrap();
        assert!(both != curves(&[run(&[1.0]), run(&[1.2, 1.4])], "time (s)").unwrap());
        // A chart has its own column, and what is no series has none.
        let part = |count: usize| {
            let mut part = run(&[1.0, 2.0]);
            part.columns.truncate(count);
            curves(&[part], "time (s)").unwrap()
        };
        assert!(part(1) == part(2) && part(1) != part(3));
        let unknown = Run { name: "a/h2".to_owned(), ..other };
        assert!(curves(&[unknown], "time (s)").is_err() && curves(&[], "time (s)").is_err());
    }
}
