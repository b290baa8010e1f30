//! What is seen of particles and ground: the nearest at every pixel, lit.

use super::super::canvas::Rgb;
use super::bulk::Bulk;
use super::camera::{Place, View, dot, sum, unit};
use image::RgbImage;
use rayon::prelude::*;

/// Radius of a particle in distances of particles that fill space: large enough to leave no holes between them.
const RADIUS: f64 = 0.85;
/// Where a body is less full than this, its particles are drawn larger, in steps of a factor.
const SPARSE: f64 = 0.35;
const GROWTH: [f64; 4] = [1.0, 1.12, 1.26, 1.41];
/// Distance of the lit surface before a particle, towards the eye, in distances of particles.
const SKIN: f64 = 0.5;
/// Rows of pixels that are drawn at a time.
const BAND: usize = 64;
/// Where the light comes from: to the right, up, and towards the eye.
const LIGHT: Place = [-0.25, 0.75, 0.62];
/// Light from all around, and from there.
const AMBIENT: f64 = 0.56;
const DIRECT: f64 = 0.48;
/// By how much a body is dimmed where it ends in front of what lies farther away than this (in distances of particles),
/// and the width of that rim in pixels.
const RIM: f64 = 0.45;
const STEP: f64 = 3.0;
const RIM_WIDTH: usize = 2;
const GROUND: [f64; 3] = [236.0, 234.0, 230.0];
const GRID: f64 = 0.86;
/// Width of a line of the ground's grid in pixels.
const GRID_WIDTH: f64 = 3.0;

/// No particle: the ground, or nothing at all.
const NONE: u32 = u32::MAX;

/// Places of pixels: the projection of the left upper corner (m), and pixels in a metre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Screen {
    pub(super) view: View,
    pub(super) corner: (f64, f64),
    pub(super) scale: f64,
    pub(super) size: (usize, usize),
}

impl Screen {
    /// Pixels from the left and from above, and distance towards the eye (m).
    pub(super) fn place(&self, at: Place) -> Place {
        let [right, up, near] = self.view.project(at);
        let across = (right - self.corner.0) * self.scale;
        [across, (self.corner.1 - up) * self.scale, near]
    }

    /// The place that lies at a pixel, at a distance towards the eye (m).
    fn restore(&self, [across, down]: [usize; 2], near: f64) -> Place {
        let right = self.corner.0 + (across as f64 + 0.5) / self.scale;
        let up = self.corner.1 - (down as f64 + 0.5) / self.scale;
        self.view.restore([right, up, near])
    }
}

/// A rectangle of ground with lines on it.
#[derive(Debug, Clone)]
pub(super) struct Ground {
    /// The vertical axis, and the height of the ground on it (m).
    pub(super) up: usize,
    pub(super) height: f64,
    /// Its ends on all axes (m); those on the vertical one mean nothing.
    pub(super) ends: [(f64, f64); 3],
    /// Where lines cross each axis (m).
    pub(super) lines: [Vec<f64>; 3],
}

impl Ground {
    /// The place on it that a pixel shows, if any.
    fn at(&self, screen: &Screen, pixel: [usize; 2]) -> Option<Place> {
        let base = screen.restore(pixel, 0.0);
        let sight = screen.view.restore([0.0, 0.0, 1.0]);
        if sight[self.up] < 1e-6 {
            return None;
        }
        let near = (self.height - base[self.up]) / sight[self.up];
        let place = sum([(1.0, base), (near, sight)]);
        for (k, (lo, hi)) in self.ends.iter().enumerate() {
            if k != self.up && !(*lo..=*hi).contains(&place[k]) {
                return None;
            }
        }
        Some(place)
    }

    /// Brightness of its paint at a place.
    fn paint(&self, screen: &Screen, place: Place) -> f64 {
        let on_line = |k: usize| {
            let half = 0.5 * GRID_WIDTH / self.pixels(screen, k);
            self.lines[k]
                .iter()
                .any(|line| (place[k] - line).abs() < half)
        };
        if (0..3).any(on_line) { GRID } else { 1.0 }
    }

    /// Pixels between lines that are a metre apart on an axis: the other one of the ground runs along them.
    fn pixels(&self, screen: &Screen, axis: usize) -> f64 {
        let step = |k: usize| {
            let mut step = [0.0; 3];
            step[k] = 1.0;
            screen.view.project(step)
        };
        let [a, b] = [step(axis), step(3 - axis - self.up)];
        let area = (a[0] * b[1] - a[1] * b[0]).abs();
        screen.scale * area / b[0].hypot(b[1])
    }
}

/// Particles with their colours.
pub(super) struct Cloud<'a> {
    pub(super) points: &'a [Place],
    pub(super) colours: &'a [Rgb],
    /// Their distance when they fill space (m).
    pub(super) size: f64,
}

/// The nearest particle at every pixel, and how near it is.
struct Depths {
    near: Vec<f32>,
    particle: Vec<u32>,
}

/// A half sphere towards the eye: for every row of pixels from its middle the half width, and its heights (m).
struct Stamp(Vec<(i64, Vec<f32>)>);

impl Stamp {
    fn new(radius: f64, scale: f64) -> Self {
        let reach = (radius * scale).max(0.6);
        let most = reach as i64;
        let row = |down: i64| {
            let half = (reach * reach - (down * down) as f64).max(0.0).sqrt() as i64;
            let height = |across: i64| {
                let left = reach * reach - (down * down + across * across) as f64;
                (left.max(0.0).sqrt() / scale) as f32
            };
            (half, (-half..=half).map(height).collect())
        };
        Self((-most..=most).map(row).collect())
    }
}

impl Depths {
    /// Of equally near particles the first is seen.
    fn new(cloud: &Cloud, bulk: &Bulk, screen: &Screen, ground: Option<&Ground>) -> Self {
        let (width, height) = screen.size;
        let stamps = GROWTH.map(|factor| Stamp::new(factor * RADIUS * cloud.size, screen.scale));
        let placed = |at: &Place| {
            let [across, down, near] = screen.place(*at);
            let stamp = &stamps[growth(bulk.fullness(*at))];
            (
                across.floor() as i64,
                down.floor() as i64,
                near as f32,
                stamp,
            )
        };
        let spheres: Vec<(i64, i64, f32, &Stamp)> = cloud.points.par_iter().map(placed).collect();
        let mut all = Self {
            near: vec![f32::NEG_INFINITY; width * height],
            particle: vec![NONE; width * height],
        };
        let near = all.near.par_chunks_mut(BAND * width);
        let bands = near.zip(all.particle.par_chunks_mut(BAND * width));
        bands.enumerate().for_each(|(band, (near, particle))| {
            let mut rows = Rows {
                top: (band * BAND) as i64,
                count: (near.len() / width) as i64,
                width: width as i64,
                near,
                particle,
            };
            rows.lay(screen, ground);
            for (k, (across, down, depth, stamp)) in spheres.iter().enumerate() {
                rows.press(stamp, [*across, *down], *depth, k as u32);
            }
        });
        all
    }

    /// Whether what is seen at a pixel ends near by in front of something far behind.
    fn ends(&self, screen: &Screen, [across, down]: [usize; 2], size: f64) -> bool {
        let (width, height) = screen.size;
        let own = self.near[down * width + across];
        let behind = |across: usize, down: usize| {
            own - self.near[down * width + across] > (STEP * size) as f32
        };
        let [left, above] = [across, down].map(|n| n.saturating_sub(RIM_WIDTH));
        let right = (across + RIM_WIDTH).min(width - 1);
        let below = (down + RIM_WIDTH).min(height - 1);
        let beside = behind(left, down) || behind(right, down);
        beside || behind(across, above) || behind(across, below)
    }
}

/// Some rows of pixels.
struct Rows<'a> {
    top: i64,
    count: i64,
    width: i64,
    near: &'a mut [f32],
    particle: &'a mut [u32],
}

impl Rows<'_> {
    /// Begins with how near the ground is.
    fn lay(&mut self, screen: &Screen, ground: Option<&Ground>) {
        let (width, top) = (self.width as usize, self.top as usize);
        for (n, near) in self.near.iter_mut().enumerate() {
            let place = ground.and_then(|g| g.at(screen, [n % width, top + n / width]));
            if let Some(place) = place {
                *near = screen.view.project(place)[2] as f32;
            }
        }
    }

    /// Adds a particle at a pixel, where nothing is nearer.
    fn press(&mut self, stamp: &Stamp, [across, down]: [i64; 2], depth: f32, k: u32) {
        let first = down - (stamp.0.len() / 2) as i64 - self.top;
        let skipped = (-first).clamp(0, stamp.0.len() as i64);
        for (row, (half, heights)) in
            (first + skipped..self.count).zip(&stamp.0[skipped as usize..])
        {
            let left = across - half;
            let start = left.clamp(0, self.width);
            let end = (across + half + 1).clamp(start, self.width);
            let [start, end, left] = [start, end, left].map(|across| row * self.width + across);
            let skip = (start - left).max(0) as usize;
            let span = start as usize..end as usize;
            let pixels = self.near[span.clone()]
                .iter_mut()
                .zip(&mut self.particle[span]);
            for ((near, particle), height) in pixels.zip(heights.iter().skip(skip)) {
                if depth + height > *near {
                    (*near, *particle) = (depth + height, k);
                }
            }
        }
    }
}

/// By which of the factors a particle is larger.
fn growth(fullness: f64) -> usize {
    let wanted = (SPARSE / fullness.max(1e-6)).sqrt();
    GROWTH
        .iter()
        .rposition(|factor| *factor <= wanted)
        .unwrap_or(0)
}

/// Draws particles, of which there is at least one, and the ground on white.
pub(super) fn draw(cloud: &Cloud, screen: &Screen, ground: Option<&Ground>) -> RgbImage {
    let bulk = Bulk::new(cloud.points, cloud.size, ground.map(|g| (g.up, g.height)));
    let scene = Scene {
        depths: Depths::new(cloud, &bulk, screen, ground),
        lamp: unit(screen.view.restore(LIGHT)).unwrap_or(LIGHT),
        bulk,
        cloud,
        screen,
        ground,
    };
    let (width, height) = screen.size;
    let mut image = RgbImage::from_pixel(width as u32, height as u32, image::Rgb([255; 3]));
    let rows = image.par_chunks_mut(3 * width).enumerate();
    rows.for_each(|(down, row)| {
        for (across, pixel) in row.chunks_mut(3).enumerate() {
            let colour = scene.colour([across, down]).unwrap_or([255.0; 3]);
            for (channel, value) in pixel.iter_mut().zip(colour) {
                *channel = value.round().clamp(0.0, 255.0) as u8;
            }
        }
    });
    image
}

/// All that decides on the colour of a pixel.
struct Scene<'a> {
    depths: Depths,
    lamp: Place,
    bulk: Bulk,
    cloud: &'a Cloud<'a>,
    screen: &'a Screen,
    ground: Option<&'a Ground>,
}

impl Scene<'_> {
    /// The channels at a pixel, from 0 to 255; none where nothing is seen.
    fn colour(&self, pixel: [usize; 2]) -> Option<[f64; 3]> {
        let n = pixel[1] * self.screen.size.0 + pixel[0];
        if self.depths.particle[n] == NONE {
            return self.ground_colour(pixel);
        }
        let particle = self.depths.particle[n] as usize;
        let [_, r, g, b] = self.cloud.colours[particle].to_be_bytes();
        let centre = self.screen.view.project(self.cloud.points[particle])[2];
        let place = (self.screen).restore(pixel, centre + SKIN * self.cloud.size);
        let rim = self.depths.ends(self.screen, pixel, self.cloud.size);
        let light = self.light(place) * if rim { 1.0 - RIM } else { 1.0 };
        Some([r, g, b].map(|c| f64::from(c) * light))
    }

    fn ground_colour(&self, pixel: [usize; 2]) -> Option<[f64; 3]> {
        let ground = self.ground?;
        let place = ground.at(self.screen, pixel)?;
        let mut upwards = [0.0; 3];
        upwards[ground.up] = 1.0;
        let light = ground.paint(self.screen, place) * self.bulk.openness(place, upwards);
        Some(GROUND.map(|c| c * light))
    }

    /// Brightness of the body's surface at a place.
    fn light(&self, place: Place) -> f64 {
        let sight = self.screen.view.restore([0.0, 0.0, 1.0]);
        let outward = self.bulk.normal(place).unwrap_or(sight);
        let facing = 0.5 + 0.5 * dot(outward, self.lamp);
        (AMBIENT + DIRECT * facing * facing) * self.bulk.openness(place, outward)
    }
}
