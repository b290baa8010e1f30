//! PNG files, of single pictures and animated.

use super::PlotError;
use crate::files::write_whole;
use image::RgbImage;
use std::collections::BTreeMap;
use std::path::Path;

type Pixel = [u8; 3];

/// Writes a picture as PNG, with a palette if it has no more than 256 colours.
pub(crate) fn write_small_png(path: &Path, image: &RgbImage) -> Result<(), PlotError> {
    let size = image.dimensions();
    let write = |bytes: &mut Vec<u8>| match with_palette(image) {
        Some((palette, indices)) => {
            let mut encoder = encoder(bytes, size, png::ColorType::Indexed);
            encoder.set_filter(png::FilterType::NoFilter);
            encoder.set_adaptive_filter(png::AdaptiveFilterType::NonAdaptive);
            encoder.set_palette(palette);
            encoder.write_header()?.write_image_data(&indices)
        }
        None => encoder(bytes, size, png::ColorType::Rgb).write_header()?.write_image_data(image),
    };
    written(path, write)
}

/// Writes pictures of one size as an animated PNG that repeats for ever, each shown for a `delay` of hundredths of a
/// second; beside it one from the middle, `NAME.still.png`, for who shows the first alone.
pub(super) fn save_animation(path: &Path, frames: &[RgbImage], delay: u16) -> Result<(), PlotError> {
    let first = frames.first();
    let size = first.ok_or_else(|| PlotError::new(path, &"no pictures"))?;
    written(path, |bytes| {
        let mut encoder = encoder(bytes, size.dimensions(), png::ColorType::Rgb);
        encoder.set_animated(frames.len() as u32, 0)?;
        encoder.set_frame_delay(delay, 100)?;
        let mut writer = encoder.write_header()?;
        for frame in frames {
            writer.write_image_data(frame)?;
        }
        writer.finish()
    })?;
    write_small_png(&path.with_extension("still.png"), &frames[frames.len() / 2])
}

fn encoder(bytes: &mut Vec<u8>, (width, height): (u32, u32), colour: png::ColorType) -> png::Encoder<'_, &mut Vec<u8>> {
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    // `Best` takes twice as long, and its files are no smaller: 2 % larger over those of a report.
    encoder.set_compression(png::Compression::Default);
    encoder.set_adaptive_filter(png::AdaptiveFilterType::Adaptive);
    encoder
}

fn written(path: &Path, write: impl FnOnce(&mut Vec<u8>) -> Result<(), png::EncodingError>) -> Result<(), PlotError> {
    let mut bytes = Vec::new();
    write(&mut bytes).map_err(|e| PlotError::new(path, &e))?;
    write_whole(path, &bytes).map_err(|e| PlotError::new(path, &e))
}

/// The palette of a picture of few colours, and the index of each pixel's. Neighbours of one colour, most of a chart,
/// are looked up once.
fn with_palette(image: &RgbImage) -> Option<(Vec<u8>, Vec<u8>)> {
    let (pixels, _) = image.as_raw().as_chunks::<3>();
    let mut known: BTreeMap<Pixel, u8> = BTreeMap::new();
    let (mut palette, mut indices) = (Vec::new(), Vec::with_capacity(pixels.len()));
    for alike in pixels.chunk_by(Pixel::eq) {
        let next = known.len();
        let index = *known.entry(alike[0]).or_insert(next as u8);
        if known.len() > next {
            u8::try_from(next).ok()?;
            palette.extend(alike[0]);
        }
        indices.resize(indices.len() + alike.len(), index);
    }
    Some((palette, indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_lossless_with_a_palette_and_without() {
        for colours in [1, 256, 257, 5000] {
            let image = RgbImage::from_fn(128, 128, |x, y| {
                let k = (x + 128 * y) % colours;
                image::Rgb([k % 150, k / 150, 0].map(|c| c as u8))
            });
            assert_eq!(with_palette(&image).is_some(), colours <= 256);
            let file = tempfile::Builder::new().suffix(".png").tempfile().unwrap();
            write_small_png(file.path(), &image).unwrap();
            let found = image::open(file.path()).unwrap().to_rgb8();
            assert!(found == image, "{colours}");
        }
    }
}
