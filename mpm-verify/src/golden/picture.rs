//! The picture of a run: the watched columns of its series.

use super::format::{Column, Run, SERIES};
use crate::draw::triptych::different_pixels;
use crate::draw::{Chart, Marker, PlotError, Series, draw_charts};
use crate::error::Error;
use crate::files::{DOCUMENT, OTHER_LAYOUT, read, read_picture, write_whole};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{RgbImage, imageops};
use std::path::Path;

/// Width of a picture, in pixels.
const WIDTH: u32 = 480;
/// Step of a colour channel: with sixteen shades a field takes half of the bytes.
const SHADE: u16 = 17;

/// The last chunk of a PNG file.
const END_OF_PNG: &[u8] = b"IEND\xaeB`\x82";

/// Draws the watched columns of a run over the first column of its series, a chart each.
///
/// # Errors
/// There are none, or the picture can't be drawn.
pub(super) fn curves(run: &Run, abscissa: &str) -> Result<RgbImage, Error> {
    let charts: Vec<Chart> = run
        .columns
        .iter()
        .filter_map(|column| chart(column, abscissa))
        .collect();
    small(|path| draw_charts(path, &charts, charts.len().min(2)))
}

/// What `draw` writes, [`WIDTH`] wide and in few shades.
pub(super) fn small(draw: impl Fn(&Path) -> Result<(), PlotError>) -> Result<RgbImage, Error> {
    let folder = tempfile::tempdir().map_err(|e| Error::Input(format!("temporary folder: {e}")))?;
    let path = folder.path().join("picture.png");
    draw(&path)?;
    let picture = read_picture(&path)?;
    let height = picture.height() * WIDTH / picture.width();
    let mut picture = imageops::thumbnail(&picture, WIDTH, height);
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

fn chart(column: &Column, abscissa: &str) -> Option<Chart> {
    let header = column.quantity.strip_prefix(SERIES)?;
    let points = column
        .points
        .iter()
        .filter_map(|p| Some((p.time?, p.value)));
    let curve = Series {
        marker: Marker::Circle,
        ..Series::line("", points.collect(), 0)
    };
    Some(Chart::new("", [abscissa, header], vec![curve]))
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
