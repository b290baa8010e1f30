//! PNG files as small as they get: with a palette where few colours do, else lossless.

use super::PlotError;
use crate::files::write_whole;
use image::RgbImage;
use std::collections::HashMap;
use std::path::Path;

/// Colours of a palette.
const PALETTE: usize = 256;
/// A picture of more colours than this keeps all of them.
const FEW: usize = 4096;
/// Largest distance of a colour from that of the palette in its place, by the squares of channels' differences.
const NEAR: u32 = 24 * 24;

type Pixel = [u8; 3];

/// Writes a picture as PNG. One of few colours, such as a chart, is left with 256 of them at most: the commonest stay,
/// and each of the others, which only smooth the rims of shapes, becomes the nearest of these. Where none is near, or
/// of very many colours, the file is lossless.
///
/// # Errors
/// The file can't be written.
pub fn write_small_png(path: &Path, image: &RgbImage) -> Result<(), PlotError> {
    let size = image.dimensions();
    let write = |bytes: &mut Vec<u8>| match with_palette(image) {
        Some((palette, indices)) => {
            let mut encoder = encoder(bytes, size, png::ColorType::Indexed);
            encoder.set_filter(png::FilterType::NoFilter);
            encoder.set_adaptive_filter(png::AdaptiveFilterType::NonAdaptive);
            encoder.set_palette(palette.concat());
            encoder.write_header()?.write_image_data(&indices)
        }
        None => encoder(bytes, size, png::ColorType::Rgb)
            .write_header()?
            .write_image_data(image),
    };
    written(path, write)
}

/// Writes pictures of one size as an animated PNG that repeats for ever, each shown for a `delay` of hundredths of a
/// second; beside it one from the middle, `NAME.still.png`, for who shows the first alone.
pub(super) fn save_animation(
    path: &Path,
    frames: &[RgbImage],
    delay: u16,
) -> Result<(), PlotError> {
    let first = frames.first();
    let size = first.ok_or_else(|| PlotError::write(path, &"no pictures"))?;
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

fn encoder(
    bytes: &mut Vec<u8>,
    (width, height): (u32, u32),
    colour: png::ColorType,
) -> png::Encoder<'_, &mut Vec<u8>> {
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    // `Best` takes twice as long, and its files are no smaller: 2 % larger over those of a report.
    encoder.set_compression(png::Compression::Default);
    encoder.set_adaptive_filter(png::AdaptiveFilterType::Adaptive);
    encoder
}

fn written(
    path: &Path,
    write: impl FnOnce(&mut Vec<u8>) -> Result<(), png::EncodingError>,
) -> Result<(), PlotError> {
    let mut bytes = Vec::new();
    write(&mut bytes).map_err(|e| PlotError::write(path, &e))?;
    write_whole(path, &bytes).map_err(|e| PlotError::write(path, &e))
}

/// The palette of a picture of few colours, and the index of each pixel's. Neighbours of one colour, most of a chart,
/// are looked up once.
fn with_palette(image: &RgbImage) -> Option<(Vec<Pixel>, Vec<u8>)> {
    let (pixels, _) = image.as_raw().as_chunks::<3>();
    let mut counts: HashMap<Pixel, usize> = HashMap::new();
    for alike in pixels.chunk_by(Pixel::eq) {
        *counts.entry(alike[0]).or_default() += alike.len();
        if counts.len() > FEW {
            return None;
        }
    }
    let mut colours: Vec<(Pixel, usize)> = counts.into_iter().collect();
    colours.sort_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
    let palette: Vec<Pixel> = colours.iter().take(PALETTE).map(|c| c.0).collect();
    let distance = |a: &Pixel, b: &Pixel| -> u32 {
        let squares = [0, 1, 2].map(|k| u32::from(a[k].abs_diff(b[k])).pow(2));
        squares.iter().sum()
    };
    let mut index: HashMap<Pixel, u8> = HashMap::new();
    for (colour, _) in &colours {
        let away = |k: &usize| distance(&palette[*k], colour);
        let nearest = (0..palette.len()).min_by_key(away)?;
        if away(&nearest) > NEAR {
            return None;
        }
        index.insert(*colour, nearest as u8);
    }
    let mut indices = Vec::with_capacity(pixels.len());
    for alike in pixels.chunk_by(Pixel::eq) {
        indices.resize(indices.len() + alike.len(), index[&alike[0]]);
    }
    Some((palette, indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_back(image: &RgbImage) -> (RgbImage, u64) {
        let file = tempfile::Builder::new().suffix(".png").tempfile().unwrap();
        write_small_png(file.path(), image).unwrap();
        let bytes = std::fs::metadata(file.path()).unwrap().len();
        (image::open(file.path()).unwrap().to_rgb8(), bytes)
    }

    #[test]
    fn pictures_of_256_colours_or_very_many_are_lossless_others_nearly() {
        let with = |colours: u32| {
            RgbImage::from_fn(128, 128, |x, y| {
                let k = (x + 128 * y) % colours;
                image::Rgb([k % 150, k / 150, 0].map(|c| c as u8))
            })
        };
        for colours in [1, 256, 5000] {
            let image = with(colours);
            assert!(read_back(&image).0 == image, "{colours}");
        }
        // A single pixel that is like no other stays what it is.
        let mut marked = with(300);
        marked.put_pixel(0, 0, image::Rgb([214, 39, 200]));
        assert!(read_back(&marked).0 == marked);
        let (found, size) = read_back(&with(300));
        let off = |(a, b): (&u8, &u8)| u32::from(a.abs_diff(*b));
        let worst = found.iter().zip(with(300).iter()).map(off).max();
        assert!(
            (1..=1).contains(&worst.unwrap()) && size < 30_000,
            "{worst:?} {size}"
        );
    }
}
