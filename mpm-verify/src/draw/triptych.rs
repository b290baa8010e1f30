//! Two pictures side by side with their difference.

use image::{Rgb, RgbImage, imageops};

const WHITE: Rgb<u8> = Rgb([255; 3]);
const RED: Rgb<u8> = Rgb([214, 39, 40]);
/// Pixels between the pictures.
const GAP: u32 = 24;
/// Share of a picture's ink that is left behind its differences.
const FADED: f64 = 0.25;

/// Pixels that differ, counting those that only one picture has.
pub(crate) fn different_pixels(old: &RgbImage, new: &RgbImage) -> usize {
    let (width, height) = joint_size(old, new);
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| differ(old, new, x, y)).count()
}

fn joint_size(old: &RgbImage, new: &RgbImage) -> (u32, u32) {
    (old.width().max(new.width()), old.height().max(new.height()))
}

fn differ(old: &RgbImage, new: &RgbImage, x: u32, y: u32) -> bool {
    old.get_pixel_checked(x, y) != new.get_pixel_checked(x, y)
}

/// Old, new, and the new one faded with what differs in red, from left to right.
pub(crate) fn triptych(old: &RgbImage, new: &RgbImage) -> RgbImage {
    let (width, height) = joint_size(old, new);
    let mut all = RgbImage::from_pixel(3 * width + 2 * GAP, height, WHITE);
    imageops::replace(&mut all, old, 0, 0);
    imageops::replace(&mut all, new, i64::from(width + GAP), 0);
    for y in 0..height {
        for x in 0..width {
            let pixel = if differ(old, new, x, y) {
                RED
            } else {
                let ink = new.get_pixel_checked(x, y).unwrap_or(&WHITE);
                Rgb(ink.0.map(|c| (255.0 - FADED * (255.0 - f64::from(c))).round() as u8))
            };
            all.put_pixel(2 * (width + GAP) + x, y, pixel);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_counted_and_red() {
        let old = RgbImage::from_pixel(4, 3, WHITE);
        let mut new = RgbImage::from_pixel(4, 4, WHITE);
        new.put_pixel(1, 1, Rgb([0; 3]));
        assert_eq!(different_pixels(&old, &old), 0);
        // One pixel, and a row that only the new picture has.
        assert_eq!(different_pixels(&old, &new), 5);
        let all = triptych(&old, &new);
        assert_eq!(all.dimensions(), (3 * 4 + 2 * GAP, 4));
        let red = all.pixels().filter(|p| **p == RED).count();
        assert_eq!(red, 5);
        assert_eq!(*all.get_pixel(2 * (4 + GAP) + 1, 1), RED);
    }
}
