//! Colours, and scales of them for values.

/// A colour as 0xRRGGBB.
pub(super) type Rgb = u32;

/// Okabe–Ito, with grey for its yellow, which is too faint for lines on white.
pub(super) const PALETTE: [Rgb; 8] = [0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x000000, 0x7F7F7F];
/// Colour of axes and text.
pub(super) const INK: Rgb = 0x222222;
/// Colour of the paper.
pub(super) const WHITE: Rgb = 0xFFFFFF;
/// Colour of a value that is not a number.
const NO_VALUE: Rgb = 0xB0B0B0;
/// Viridis at steps of a tenth.
const SEQUENTIAL: [Rgb; 11] =
    [0x440154, 0x482475, 0x414487, 0x355F8D, 0x2A788E, 0x21918C, 0x22A884, 0x44BF70, 0x7AD151, 0xBDDF26, 0xFDE725];
/// Stone to purple through orange, of falling lightness: its light end shows the shadows of a body.
const STONE: [Rgb; 11] =
    [0xE8E2D4, 0xEFD9AE, 0xF4CB8A, 0xF4B86B, 0xF0A256, 0xE78A4A, 0xD97145, 0xC55846, 0xAB434B, 0x8C3250, 0x692653];
/// Blue to red through grey, of CIE lightness 22, 38, 54, 69, 83, 94 and back.
const DIVERGING: [Rgb; 11] =
    [0x133463, 0x0F5AA3, 0x2D86CD, 0x6AAFE4, 0xAFD4EE, 0xEEEEEE, 0xF2C6AD, 0xEA926F, 0xD25D43, 0xA52E28, 0x661819];

/// Red, green and blue.
pub(super) fn channels(colour: Rgb) -> [u8; 3] {
    let [_, red, green, blue] = colour.to_be_bytes();
    [red, green, blue]
}

/// Ends of the colours of a stress or pressure that is expected to lie between zero and `most`. What has the wrong sign,
/// such as tension in sand, is seen too, up to a quarter of that: the colours diverge from zero.
pub(crate) const fn signed(most: f64) -> (f64, f64) {
    let least = -0.25 * most;
    if most < least { (most, least) } else { (least, most) }
}

/// Colour of a value on the scale of a range; beyond its ends the colour of the end.
pub(super) fn colour_of(value: f64, range: (f64, f64)) -> Rgb {
    on_scale(value, range, &SEQUENTIAL)
}

/// The same for a surface in light.
pub(super) fn stone_of(value: f64, range: (f64, f64)) -> Rgb {
    on_scale(value, range, &STONE)
}

fn on_scale(value: f64, (lo, hi): (f64, f64), sequential: &[Rgb; 11]) -> Rgb {
    if value.is_nan() {
        return NO_VALUE;
    }
    let (small, large) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    let (table, t) = if lo < 0.0 && hi > 0.0 && small >= 0.2 * large {
        (&DIVERGING, 0.5 + 0.5 * value.clamp(lo, hi) / large)
    } else {
        (sequential, (value.clamp(lo, hi) - lo) / (hi - lo))
    };
    let place = t * (table.len() - 1) as f64;
    let index = (place as usize).min(table.len() - 2);
    let [below, above] = [table[index], table[index + 1]].map(u32::to_be_bytes);
    let channel = |k: usize| {
        let (below, above) = (f64::from(below[k]), f64::from(above[k]));
        (below + (place - index as f64) * (above - below)).round() as u8
    };
    u32::from_be_bytes([0, 1, 2, 3].map(channel))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_run_between_their_ends() {
        let lightness = |rgb: Rgb| {
            let linear = channels(rgb).map(|c| (f64::from(c) / 255.0).powf(2.2));
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        assert_eq!(colour_of(-1.0, (0.0, 2.0)), SEQUENTIAL[0]);
        assert_eq!(colour_of(3.0, (0.0, 2.0)), SEQUENTIAL[10]);
        let of = |k: i32, range| lightness(colour_of(f64::from(k) / 50.0, range));
        assert!((0..50).all(|k| of(k, (0.0, 1.0)) < of(k + 1, (0.0, 1.0))));
        let stone = |k: i32| lightness(stone_of(f64::from(k) / 50.0, (0.0, 1.0)));
        assert!((0..50).all(|k| stone(k) > stone(k + 1)));
        assert_eq!(stone_of(0.0, (-2.0, 2.0)), DIVERGING[5]);
        assert_eq!(colour_of(0.0, (-2.0, 2.0)), DIVERGING[5]);
        assert_eq!(colour_of(0.0, (-1.0, 3.0)), DIVERGING[5]);
        assert_eq!(signed(-2.0), (-2.0, 0.5));
        assert_eq!(colour_of(0.0, signed(8.0)), DIVERGING[5]);
        assert!((0..50).all(|k| of(k, (-1.0, 1.0)) > of(k + 1, (-1.0, 1.0))));
        assert!((0..50).all(|k| of(-k, (-1.0, 1.0)) > of(-k - 1, (-1.0, 1.0))));
    }
}
