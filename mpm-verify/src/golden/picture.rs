//! The picture of runs: the watched columns of their series.

use super::format::{Column, Run, SERIES};
use crate::distinct;
use crate::draw::style::series;
use crate::draw::triptych::different_pixels;
use crate::draw::{Chart, PlotError, Series, draw_charts};
use crate::error::Error;
use crate::files::{DOCUMENT, OTHER_LAYOUT, read, read_picture, write_whole};
use crate::scheme::Scheme;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{RgbImage, imageops};
use std::path::Path;

/// Width of a picture, in pixels, and of one with a single chart, whose curves are longer.
pub(super) const WIDTH: u32 = 480;
const NARROW: u32 = 400;
/// Step of a colour channel: with sixteen shades a field takes half of the bytes.
const SHADE: u16 = 17;

/// The last chunk of a PNG file.
const END_OF_PNG: &[u8] = b"IEND\xaeB`\x82";

/// Draws the watched columns of runs over the first column of their series, a chart each, with a curve a run.
///
/// # Errors
/// There are none, a run is of no scheme, or the picture can't be drawn.
pub(super) fn curves(runs: &[Run], abscissa: &str) -> Result<RgbImage, Error> {
    let columns = runs.iter().flat_map(|run| &run.columns);
    let watched = columns.filter_map(|c| c.quantity.strip_prefix(SERIES));
    let charts: Result<Vec<Chart>, Error> = distinct(watched)
        .into_iter()
        .map(|header| {
            let curves = runs.iter().map(|run| curve(run, header));
            let curves = curves.collect::<Result<Vec<Series>, Error>>()?;
            Ok(Chart::new("", [abscissa, header], curves))
        })
        .collect();
    let charts = charts?;
    let width = if charts.len() == 1 { NARROW } else { WIDTH };
    small(width, |path| {
        draw_charts(path, &charts, charts.len().min(2))
    })
}

/// A column of a run, as its scheme looks everywhere.
fn curve(run: &Run, header: &str) -> Result<Series, Error> {
    let scheme = run.name.split('/').next().unwrap_or_default();
    let scheme = Scheme::parse(scheme).map_err(|e| Error::Input(e.to_string()))?;
    let own = |c: &&Column| c.quantity.strip_prefix(SERIES) == Some(header);
    let points = run.columns.iter().filter(own).flat_map(|c| &c.points);
    let points = points.filter_map(|p| Some((p.time?, p.value)));
    Ok(series(scheme, points.collect()))
}

/// What `draw` writes, so wide and in few shades.
pub(super) fn small(
    width: u32,
    draw: impl Fn(&Path) -> Result<(), PlotError>,
) -> Result<RgbImage, Error> {
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

/// Pixels in which a picture differs from the one that is kept.
///
/// # Errors
/// The kept one is missing or damaged.
pub(super) fn pixels_of(kept: &Path, drawn: &RgbImage) -> Result<usize, Error> {
    if !read(kept, DOCUMENT)?.ends_with(END_OF_PNG) {
        return Err(Error::file(kept, OTHER_LAYOUT));
    }
    Ok(different_pixels(&read_picture(kept)?, drawn))
}

/// Writes a PNG file as small as it gets.
///
/// # Errors
/// It can't be written.
pub(super) fn write_small(picture: &RgbImage, path: &Path) -> Result<(), Error> {
    let mut bytes = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    let written = picture.write_with_encoder(encoder);
    written.map_err(|e| Error::file(path, e))?;
    write_whole(path, &bytes)
}
