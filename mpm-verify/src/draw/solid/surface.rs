//! What is seen of particles and ground: the nearest at every pixel, in light.
//!
//! Depths decide on everything: the nearest sphere is seen; the depths of spheres, smoothed, make the surface whose
//! slope Lambert's law lights; and what lies deeper than its surroundings sees less of the sky (Luft, Colditz and
//! Deussen 2006, "Image enhancement by unsharp masking the depth buffer").

use super::super::colour::{Rgb, channels};
use super::super::raster::FINE;
use super::super::shape::Point;
use image::RgbImage;

/// A position or direction in the axes of the problem.
pub(super) type Place = [f64; 3];

/// Radius of a particle in distances of particles that fill space: large enough to leave no holes between them.
const RADIUS: f64 = 0.85;
/// Depths that differ by more than this, in distances of particles, belong to two surfaces.
const STEP: f64 = 3.0;
/// Half the width, in distances of particles, over which depths are smoothed, and over which surroundings are; and the
/// most pixels of the former: particles larger than that are seen as spheres.
const SMOOTH: f64 = 1.0;
const MOST_SMOOTH: usize = 24;
const WIDE: f64 = 6.0;
/// Where the light comes from: to the right, up, and towards the eye.
const LIGHT: Place = [-0.25, 0.75, 0.62];
/// Light from all around, and from there.
const AMBIENT: f64 = 0.52;
const DIRECT: f64 = 0.55;
/// By how much a place is dimmed at most for its surroundings, and where a surface ends in front of another.
const SHADE: f64 = 0.45;
const RIM: f64 = 0.4;
/// Colour of the ground, and of paper.
const GROUND: Rgb = 0xECEAE6;
const PAPER: Rgb = 0xFFFFFF;
/// Space about what is shown, in pixels of the picture: spheres at the rim reach a little beyond.
const MARGIN: f64 = 6.0;

/// Where places lie in a panel.
pub(super) struct Screen {
    /// Unit vectors to the right, upwards, and towards the eye.
    view: [Place; 3],
    /// Projection of the left upper corner (m), and pixels of the picture in a metre.
    corner: Point,
    scale: f64,
    /// Size in pixels of the picture.
    pub(super) size: Point,
    window: [(f64, f64); 3],
}

impl Screen {
    /// Of a size that holds a window, seen from these angles (degrees), and is not larger than `most`.
    pub(super) fn new((azimuth, elevation): Point, window: &[(f64, f64); 3], most: Point) -> Self {
        let (st, ct) = azimuth.to_radians().sin_cos();
        let (se, ce) = elevation.to_radians().sin_cos();
        let view = [
            [ct, 0.0, -st],
            [-se * st, ce, -se * ct],
            [ce * st, se, ce * ct],
        ];
        // The middle of the window's projection and its half sides.
        let reach = |direction: Place| {
            let of = |k: usize, sign: f64| 0.5 * (window[k].1 + sign * window[k].0) * direction[k];
            let half: f64 = (0..3).map(|k| of(k, -1.0).abs()).sum();
            ((0..3).map(|k| of(k, 1.0)).sum::<f64>(), half.max(1e-9))
        };
        let ((middle, wide), (height, high)) = (reach(view[0]), reach(view[1]));
        let fit = |most: f64, half: f64| (most - 2.0 * MARGIN) / (2.0 * half);
        let scale = fit(most.0, wide).min(fit(most.1, high));
        let side = |half: f64| (2.0 * (scale * half + MARGIN)).ceil();
        let margin = MARGIN / scale;
        Self {
            view,
            corner: (middle - wide - margin, height + high + margin),
            scale,
            size: (side(wide), side(high)),
            window: *window,
        }
    }

    /// Of a direction: to the right, up, and towards the eye.
    pub(super) fn turn(&self, at: Place) -> Place {
        self.view.map(|axis| dot(axis, at))
    }

    /// Pixels from the left and from above, and distance towards the eye (m).
    pub(super) fn place(&self, at: Place) -> Place {
        let [right, up, near] = self.turn(at);
        let across = (right - self.corner.0) * self.scale;
        [across, (self.corner.1 - up) * self.scale, near]
    }

    /// How near the plane of the ground is at a pixel, and whether that is in the window; looked at from its edge, the
    /// ground is far.
    fn ground(&self, across: f64, down: f64) -> (f64, bool) {
        let [right, up, eye] = self.view;
        let (x, y) = (
            self.corner.0 + across / self.scale,
            self.corner.1 - down / self.scale,
        );
        let base = [0, 1, 2].map(|k| x * right[k] + y * up[k]);
        let near = (self.window[1].0 - base[1]) / eye[1].max(1e-3);
        let within = |k: usize| {
            let value = base[k] + near * eye[k];
            (self.window[k].0..=self.window[k].1).contains(&value)
        };
        (near, eye[1] > 1e-3 && within(0) && within(2))
    }
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Particles, of which there is at least one, with their colours.
pub(super) struct Cloud {
    pub(super) particles: Vec<(Place, Rgb)>,
    /// Their distance when they fill space (m).
    pub(super) size: f64,
}

/// A depth for every pixel.
struct Layer {
    width: usize,
    values: Vec<f32>,
}

impl Layer {
    /// Replaces every row, and then every column, by what `act` makes of it.
    fn along_both(&self, act: impl Fn(&[f32]) -> Vec<f32>) -> Self {
        let mut turned = Self {
            width: self.width,
            values: self.values.clone(),
        };
        for _ in 0..2 {
            let rows: Vec<Vec<f32>> = turned.values.chunks(turned.width).map(&act).collect();
            let column = |k: usize| rows.iter().map(move |row| row[k]);
            turned.values = (0..turned.width).flat_map(column).collect();
            turned.width = rows.len();
        }
        turned
    }

    /// The mean over pixels up to `half` away along a row and a column that lie within `step` of the middle one.
    /// Towards an end both sides shrink, which keeps a slope as it is.
    fn smoothed(&self, half: usize, step: f32) -> Self {
        self.along_both(|line| {
            let mean = |k: usize| {
                let near = |v: &f32| (v - line[k]).abs() <= step;
                let pairs =
                    (1..=half.min(k).min(line.len() - 1 - k)).map(|d| (line[k - d], line[k + d]));
                let pairs = pairs.filter(|(a, b)| near(a) && near(b));
                let whole = |(sum, number), (a, b)| (sum + a + b, number + 2.0);
                let (sum, number) = pairs.fold((line[k], 1.0), whole);
                sum / number
            };
            (0..line.len()).map(mean).collect()
        })
    }

    /// The mean over all pixels up to `half` away, likewise.
    fn averaged(&self, half: usize) -> Self {
        self.along_both(|line| {
            let mut sums = vec![0.0];
            for (k, value) in line.iter().enumerate() {
                sums.push(sums[k] + f64::from(*value));
            }
            let mean = |k: usize| {
                let half = half.min(k).min(line.len() - 1 - k);
                ((sums[k + half + 1] - sums[k - half]) / (2 * half + 1) as f64) as f32
            };
            (0..line.len()).map(mean).collect()
        })
    }

    /// By how much the layer rises to the right and downwards at a pixel, from what lies within `step`.
    fn slope(&self, n: usize, step: f32) -> [f64; 2] {
        let count = self.values.len();
        [1, self.width].map(|stride| {
            let (before, after) = (n.saturating_sub(stride), (n + stride).min(count - 1));
            let own = self.values[n];
            let rise = |m: usize| Some(self.values[m] - own).filter(|rise| rise.abs() <= step);
            match (rise(before), rise(after)) {
                (Some(a), Some(b)) => f64::from(b - a) / 2.0,
                (Some(a), None) => f64::from(-a),
                (None, Some(b)) => f64::from(b),
                (None, None) => 0.0,
            }
        })
    }
}

/// Draws particles and the ground on white, in [`FINE`] times the pixels.
pub(super) fn draw(cloud: &Cloud, screen: &Screen) -> RgbImage {
    let fine = f64::from(FINE);
    let (width, height) = (
        screen.size.0 as usize * FINE as usize,
        screen.size.1 as usize * FINE as usize,
    );
    let (mut near, mut colours) = (Vec::new(), Vec::new());
    for n in 0..width * height {
        let middle = |k: usize| (k as f64 + 0.5) / fine;
        let (depth, inside) = screen.ground(middle(n % width), middle(n / width));
        near.push(depth as f32);
        colours.push(if inside { GROUND } else { PAPER });
    }
    let scale = fine * screen.scale;
    let radius = RADIUS * cloud.size;
    let reach = (radius * scale).ceil() as i64;
    for (at, colour) in &cloud.particles {
        let [across, down, depth] = screen.place(*at);
        let (across, down) = (fine * across, fine * down);
        let rows = down as i64 - reach..=down as i64 + reach;
        for y in rows.filter(|y| (0..height as i64).contains(y)) {
            let columns = across as i64 - reach..=across as i64 + reach;
            for x in columns.filter(|x| (0..width as i64).contains(x)) {
                let (dx, dy) = (x as f64 + 0.5 - across, y as f64 + 0.5 - down);
                let height = radius * radius - (dx * dx + dy * dy) / (scale * scale);
                let n = y as usize * width + x as usize;
                let front = (depth + height.max(0.0).sqrt()) as f32;
                if height > 0.0 && front > near[n] {
                    (near[n], colours[n]) = (front, *colour);
                }
            }
        }
    }
    let near = Layer {
        width,
        values: near,
    };
    let pixels = |sizes: f64| ((sizes * cloud.size * scale) as usize).max(1);
    let step = (STEP * cloud.size) as f32;
    let half = pixels(SMOOTH).min(MOST_SMOOTH);
    let surface = near.smoothed(half, step).smoothed(half, step);
    let around = surface.averaged(pixels(WIDE));
    let lamp = LIGHT.map(|v| v / dot(LIGHT, LIGHT).sqrt());
    let light = |n: usize| {
        let [right, down] = surface.slope(n, step).map(|rise| rise * scale);
        let normal = [-right, down, 1.0];
        let facing = 0.5 + 0.5 * dot(normal, lamp) / dot(normal, normal).sqrt();
        let deeper = f64::from(around.values[n] - surface.values[n]) / (WIDE * cloud.size);
        let shade = 1.0 - SHADE * deeper.clamp(0.0, 1.0);
        let ends = |m: Option<usize>| {
            m.and_then(|m| near.values.get(m))
                .is_some_and(|m| near.values[n] - m > step)
        };
        let beside = [
            n.checked_sub(2),
            Some(n + 2),
            n.checked_sub(2 * width),
            Some(n + 2 * width),
        ];
        let rim = if beside.into_iter().any(ends) {
            1.0 - RIM
        } else {
            1.0
        };
        (AMBIENT + DIRECT * facing * facing) * shade * rim
    };
    let dimmed = |(n, colour): (usize, &Rgb)| {
        let light = match *colour {
            PAPER => 1.0,
            _ => light(n),
        };
        channels(*colour).map(|c| (f64::from(c) * light).round().min(255.0) as u8)
    };
    let bytes = colours.iter().enumerate().flat_map(dimmed).collect();
    RgbImage::from_raw(width as u32, height as u32, bytes).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The image of particles from the front: ten pixels of the picture to a metre.
    fn from_the_front(particles: Vec<(Place, Rgb)>) -> RgbImage {
        let window = [(0.0, 30.0), (0.0, 20.0), (0.0, 8.0)];
        let most = (300.0 + 2.0 * MARGIN, 1000.0);
        let screen = Screen::new((0.0, 0.0), &window, most);
        let size = 1.0;
        draw(&Cloud { particles, size }, &screen)
    }

    /// The pixel at a place in the plane (m).
    fn at(image: &RgbImage, x: f64, y: f64) -> [u8; 3] {
        let pixel = |v: f64| (f64::from(FINE) * (10.0 * v + MARGIN)) as u32;
        image.get_pixel(pixel(x), pixel(20.0 - y)).0
    }

    /// Whether the channels stand to each other as those of a colour.
    fn same_hue(pixel: [u8; 3], colour: Rgb) -> bool {
        let share = |c: [u8; 3]| c.map(|v| f64::from(v) / f64::from(c[0].max(c[1]).max(c[2])));
        let pairs = share(pixel).into_iter().zip(share(channels(colour)));
        pairs.into_iter().all(|(a, b)| (a - b).abs() < 0.02)
    }

    #[test]
    fn a_nearer_particle_hides_a_farther_one() {
        let (red, blue) = (0xC04020, 0x2040C0);
        let particles = vec![([10.0, 10.0, 3.0], red), ([10.5, 10.0, 0.0], blue)];
        for particles in [particles.clone(), particles.into_iter().rev().collect()] {
            let image = from_the_front(particles);
            // Each about its own middle, and the nearer where both are.
            assert!(same_hue(at(&image, 10.0, 10.0), red));
            assert!(same_hue(at(&image, 10.6, 10.0), red));
            assert!(same_hue(at(&image, 11.2, 10.0), blue));
            assert_eq!(at(&image, 10.0, 12.0), [255; 3]);
        }
    }

    #[test]
    fn a_plane_is_lit_evenly_and_a_slope_that_faces_the_light_more() {
        let colour = 0xF0A256;
        let face = |lean: f64| {
            let place = |n: usize| [n / 80, n % 80].map(|k| 0.25 * k as f64);
            let on = |[x, y]: [f64; 2]| ([x + 5.0, y, 8.0 - lean * y], colour);
            from_the_front((0..6400).map(|n| on(place(n))).collect())
        };
        let levels = |image: &RgbImage| -> Vec<u8> {
            let inner =
                (0..80).map(|k| at(image, 9.0 + 0.1 * f64::from(k), 6.0 + 0.1 * f64::from(k)));
            let inner: Vec<[u8; 3]> = inner.collect();
            assert!(inner.iter().all(|p| same_hue(*p, colour)));
            inner.iter().map(|p| p[0]).collect()
        };
        let (upright, leaning) = (levels(&face(0.0)), levels(&face(0.5)));
        for levels in [&upright, &leaning] {
            let spread = levels.iter().max().unwrap() - levels.iter().min().unwrap();
            assert!(spread <= 12, "{levels:?}");
        }
        assert!(upright.iter().max() < leaning.iter().min());
    }
}
