//! Bodies of particles in three dimensions: a particle is a sphere a little larger than its share of space, and the
//! nearest sphere at a pixel gives its colour.

use super::axes::{Axis, THIN, TICK};
use super::colour::{INK, Rgb, stone_of};
use super::page::{Drawn, FINE, Medium, Page, Picture, Point, spot, stroke};
use super::panels::{Bar, Panels};
use super::png_file::save_animation;
use super::text::{Block, LABEL, SMALL, write};
use super::{EDGE, PlotError, between, largest, lengths, nothing};
use plotters::element::BitMapElement;
use rayon::prelude::*;
use std::path::Path;

/// A body at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidPanel {
    /// Title above the panel; may be empty.
    pub title: String,
    /// Positions of the particles (m); one that is not finite is left out.
    pub points: Vec<[f64; 3]>,
    /// Their values; one that is not a number is drawn grey.
    pub values: Vec<f64>,
    /// Distance of particles that fill space (m): the side of the cube that one stands for.
    pub size: f64,
}

/// Bodies seen from one place, at one scale, with one colour scale.
///
/// The colours diverge from a neutral zero as those of a [`FieldFigure`](super::FieldFigure); else they run from the
/// lightest at the lower end to the darkest.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidFigure {
    /// Title above the panels; may be empty.
    pub title: String,
    /// Panels, row by row.
    pub panels: Vec<SolidPanel>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Values at the ends of the colour scale.
    pub range: (f64, f64),
    /// Label of the colour bar, with unit.
    pub label: String,
    /// What is shown of each axis (m): particles beyond, by more than half their size, are left out, and the marks run
    /// along its edges. The ground lies at the lower end of y.
    pub window: [(f64, f64); 3],
}

/// Angle (degrees) by which the eye has turned about y, which points up: at 0 it would look straight at the plane of x
/// and y. And its angle above the horizontal plane. The projection is orthographic: a length along an axis is the same
/// everywhere in the picture.
const AZIMUTH: f64 = 35.0;
const ELEVATION: f64 = 28.0;
/// Widths of panels by their number in a row, and the largest height, in pixels.
const WIDTHS: [f64; 4] = [1200.0, 760.0, 560.0, 460.0];
const HEIGHT: f64 = 1000.0;
/// Distance of panels, space within them about what is shown, and height of the line that tells of the camera.
const GAP: f64 = 24.0;
const MARGIN: f64 = 6.0;
const NOTE: f64 = 40.0;
/// Radius of a particle in distances of particles that fill space: large enough to leave no holes between them.
const RADIUS: f64 = 0.85;
/// Where the light comes from: left, up, and towards the eye; light from all around, and from there.
const LIGHT: Place = [-0.25, 0.75, 0.62];
const AMBIENT: f64 = 0.52;
const DIRECT: f64 = 0.55;
const GROUND: Rgb = 0xECEAE6;
/// Height of a tick's label, distance from it to the axis' label, and height of that.
const DIGITS: f64 = 24.0;
const LABEL_GAP: f64 = 10.0;
const LABEL_HEIGHT: f64 = 40.0;
/// An axis shorter than this, in pixels, has its range in its label instead of ticks.
const SHORT: f64 = 60.0;

/// A position or direction in the axes of the problem.
type Place = [f64; 3];

/// Draws bodies as one PNG file.
///
/// # Errors
/// A figure without panels, a finite range or window that is not empty; a panel without a size or a particle in
/// the window, or whose points and values differ in number; or a file that can't be written.
pub fn draw_solids(path: &Path, figure: &SolidFigure) -> Result<(), PlotError> {
    Solids::new(path, figure)?.save(path)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. They should have the same window and number of panels.
///
/// # Errors
/// As [`draw_solids`]; or there are no figures.
pub fn animate_solids(path: &Path, figures: &[SolidFigure], delay: u16) -> Result<(), PlotError> {
    let frame = |figure: &SolidFigure| Solids::new(path, figure)?.pixels(path, 2);
    let frames: Result<Vec<_>, PlotError> = figures.iter().map(frame).collect();
    save_animation(path, &frames?, delay)
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A figure, laid out, with the fine pixels of its panels.
struct Solids {
    panels: Panels,
    size: Point,
    rulers: [Ruler; 3],
    images: Vec<Vec<u8>>,
}

impl Solids {
    fn new(path: &Path, figure: &SolidFigure) -> Result<Self, PlotError> {
        let sound = |(lo, hi): &Point| lo < hi && (hi - lo).is_finite();
        let finite = figure.range.0.is_finite() && figure.range.1.is_finite();
        if figure.panels.is_empty() || !figure.window.iter().all(sound) || !finite {
            return Err(nothing(path, &figure.title));
        }
        let columns = figure.columns.min(figure.panels.len()).max(1);
        let screen = Screen::new(&figure.window, WIDTHS[columns.min(4) - 1]);
        let values = figure.panels.iter().flat_map(|p| &p.values);
        let bar = Bar::new(figure.range, &figure.label, stone_of, values);
        let draw = |panel: &SolidPanel| {
            let (points, values) = (panel.points.len(), panel.values.len());
            lengths(path, &panel.title, points, values)?;
            let image = screen.spheres(panel, bar.range);
            image.ok_or_else(|| nothing(path, &panel.title))
        };
        let images: Result<Vec<_>, PlotError> = figure.panels.par_iter().map(draw).collect();
        let rulers = [0, 1, 2].map(|axis| Ruler::new(&screen, axis));
        let room = |side: usize| largest(rulers.iter().map(|r| r.room(screen.size)[side])).ceil();
        let titles = figure.panels.iter().map(|p| &*p.title).collect();
        let panel = (screen.size, [0, 1, 2].map(room));
        Ok(Self {
            panels: Panels::new(&figure.title, titles, columns, panel, GAP, bar),
            size: screen.size,
            rulers,
            images: images?,
        })
    }
}

impl Picture for Solids {
    fn size(&self) -> Point {
        let (width, height) = self.panels.size();
        (width, height + NOTE)
    }

    fn draw<B: Medium>(&self, page: &Page<B>) -> Drawn<B> {
        let side = |length: f64| FINE * length as u32;
        let size = (side(self.size.0), side(self.size.1));
        for (k, image) in self.images.iter().enumerate() {
            let [left, top, ..] = self.panels.frame(k);
            let image = BitMapElement::with_ref(spot((left, top)), size, image);
            image.map_or(Ok(()), |image| page.draw(&image))?;
            let [below, beside] = self.panels.labelled(k);
            let last = k % self.panels.columns + 1 == self.panels.columns;
            for (ruler, labelled) in self.rulers.iter().zip([below, beside, last]) {
                ruler.draw(page, (left, top), labelled)?;
            }
        }
        let note = format!("orthographic, azimuth {AZIMUTH}°, elevation {ELEVATION}°");
        let at = (EDGE, self.panels.size().1 - EDGE + NOTE / 2.0);
        write(page, &note, at, SMALL, (0.0, 0.5), false)?;
        self.panels.draw(page)
    }
}

/// Where places lie in a panel.
struct Screen {
    /// Unit vectors to the right, upwards, and towards the eye.
    view: [Place; 3],
    /// Projection of the left upper corner (m), and pixels in a metre.
    corner: Point,
    scale: f64,
    /// Size in pixels.
    size: Point,
    window: [(f64, f64); 3],
}

impl Screen {
    /// Of a size that holds a window and is no wider than `most`.
    fn new(window: &[(f64, f64); 3], most: f64) -> Self {
        let (st, ct) = AZIMUTH.to_radians().sin_cos();
        let (se, ce) = ELEVATION.to_radians().sin_cos();
        let view = [
            [ct, 0.0, -st],
            [-se * st, ce, -se * ct],
            [ce * st, se, ce * ct],
        ];
        // The middle of the window's projection and its half sides.
        let reach = |direction: Place| {
            let of = |k: usize, sign: f64| 0.5 * (window[k].1 + sign * window[k].0) * direction[k];
            let half: f64 = (0..3).map(|k| of(k, -1.0).abs()).sum();
            ((0..3).map(|k| of(k, 1.0)).sum::<f64>(), half)
        };
        let ((middle, wide), (height, high)) = (reach(view[0]), reach(view[1]));
        let fit = |most: f64, half: f64| (most - 2.0 * MARGIN) / (2.0 * half);
        let scale = fit(most, wide).min(fit(HEIGHT, high));
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

    /// Pixels from the left and from above, and distance towards the eye (m).
    fn place(&self, at: Place) -> Place {
        let [right, up, near] = self.view.map(|axis| dot(axis, at));
        let across = (right - self.corner.0) * self.scale;
        [across, (self.corner.1 - up) * self.scale, near]
    }

    /// The fine pixels of the ground and of the particles in the window; `None` without any.
    fn spheres(&self, panel: &SolidPanel, range: Point) -> Option<Vec<u8>> {
        // A particle on the ground may have sunk in a little.
        let half = panel.size / 2.0;
        let inside = |k: usize, v: f64| {
            let (lo, hi) = self.window[k];
            (lo - half..=hi + half).contains(&v)
        };
        let particles = panel.points.iter().zip(&panel.values);
        let mut particles = particles
            .filter(|(p, _)| (0..3).all(|k| inside(k, p[k])))
            .peekable();
        if !(panel.size.is_finite() && panel.size > 0.0) {
            return None;
        }
        particles.peek()?;
        let scale = f64::from(FINE) * self.scale;
        let (width, height) = (
            self.size.0 as usize * FINE as usize,
            self.size.1 as usize * FINE as usize,
        );
        let mut pixels = vec![255; 3 * width * height];
        let mut depths = vec![f64::NEG_INFINITY; width * height];
        self.ground(width, &mut pixels, &mut depths);
        let radius = RADIUS * panel.size;
        let reach = (radius * scale).ceil() as i64;
        let lamp = LIGHT.map(|v| v / dot(LIGHT, LIGHT).sqrt());
        for (at, value) in particles {
            let colour = stone_of(*value, range).to_be_bytes();
            let [across, down, depth] = self.place(*at);
            let (across, down) = (f64::from(FINE) * across, f64::from(FINE) * down);
            let span = |middle: f64, end: usize| {
                let (from, to) = (middle as i64 - reach, middle as i64 + reach + 1);
                from.clamp(0, end as i64) as usize..to.clamp(0, end as i64) as usize
            };
            for y in span(down, height) {
                for x in span(across, width) {
                    let [dx, dy] = [x as f64 + 0.5 - across, y as f64 + 0.5 - down]
                        .map(|d| d / (scale * radius));
                    let rest = 1.0 - dx * dx - dy * dy;
                    let (n, front) = (y * width + x, depth + radius * rest.max(0.0).sqrt());
                    if rest <= 0.0 || front <= depths[n] {
                        continue;
                    }
                    depths[n] = front;
                    let facing = 0.5 + 0.5 * dot([dx, -dy, rest.sqrt()], lamp);
                    let light = AMBIENT + DIRECT * facing * facing;
                    for k in 0..3 {
                        let lit = f64::from(colour[k + 1]) * light;
                        pixels[3 * n + k] = lit.round().min(255.0) as u8;
                    }
                }
            }
        }
        Some(pixels)
    }

    /// Colours the ground within the window, with its depths.
    fn ground(&self, width: usize, pixels: &mut [u8], depths: &mut [f64]) {
        let ([right, up, eye], [_, colour @ ..]) = (self.view, GROUND.to_be_bytes());
        let metres = |pixel: usize| (pixel as f64 + 0.5) / (f64::from(FINE) * self.scale);
        for (n, depth) in depths.iter_mut().enumerate() {
            let (x, y) = (
                self.corner.0 + metres(n % width),
                self.corner.1 - metres(n / width),
            );
            let base = [0, 1, 2].map(|k| x * right[k] + y * up[k]);
            let near = (self.window[1].0 - base[1]) / eye[1];
            let within = |k: usize| {
                let value = base[k] + near * eye[k];
                (self.window[k].0..=self.window[k].1).contains(&value)
            };
            if within(0) && within(2) {
                *depth = near;
                pixels[3 * n..3 * n + 3].copy_from_slice(&colour);
            }
        }
    }
}

/// Marks in metres along an edge of the window.
struct Ruler {
    ends: [Point; 2],
    /// Direction away from the body, of unit length; and that of labels from their marks.
    away: Point,
    side: Point,
    /// Parts of the length, with labels.
    ticks: Vec<(f64, String)>,
    label: String,
    /// Where that stands.
    place: Point,
}

impl Ruler {
    /// Along x below, y on the left or z on the right.
    fn new(screen: &Screen, axis: usize) -> Self {
        let [x, y, z] = screen.window;
        let (from, to, side) = [
            ([x.0, y.0, z.1], [x.1, y.0, z.1], (0.0, 1.0)),
            ([x.0, y.0, z.1], [x.0, y.1, z.1], (-1.0, 0.0)),
            ([x.1, y.0, z.0], [x.1, y.0, z.1], (1.0, 0.0)),
        ][axis];
        let ends = [from, to].map(|at| screen.place(at)).map(|p| (p[0], p[1]));
        let along = (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1);
        let length = along.0.hypot(along.1);
        let across = (along.1 / length, -along.0 / length);
        let outwards = (across.0 * side.0 + across.1 * side.1).signum();
        let scale = Axis::new(screen.window[axis], false, length, axis == 1);
        let marks = scale.marks().filter(|_| length >= SHORT);
        let ticks: Vec<_> = marks
            .map(|(at, text)| (at / length, text.to_owned()))
            .collect();
        let (name, range) = (["x (m)", "y (m)", "z (m)"][axis], screen.window[axis]);
        let label = match ticks.is_empty() {
            true => format!("{name}: {} … {}", range.0, range.1),
            false => name.to_owned(),
        };
        let digits = match (ticks.is_empty(), axis) {
            (true, _) => 0.0,
            (_, 0) => DIGITS + LABEL_GAP,
            _ => scale.label_width() + LABEL_GAP,
        };
        let (middle, out) = (between(ends[0], ends[1], 0.5), TICK + digits);
        // Below a tilted edge, clear of its ticks' labels; beside one that recedes, beyond its far end.
        let clear = (along.1 / along.0).abs() * LABEL.width(&label) / 2.0;
        let place = match axis {
            0 => (middle.0, middle.1 + out + clear),
            1 => (middle.0 - out - LABEL_HEIGHT, middle.1),
            _ => (ends[0].0.max(ends[1].0) + out, middle.1),
        };
        Self {
            ends,
            away: (outwards * across.0, outwards * across.1),
            side,
            ticks,
            label,
            place,
        }
    }

    /// Room for its labels left of, right of and below a panel of a size.
    fn room(&self, (wide, high): Point) -> [f64; 3] {
        let lowest = self.ends[0].1.max(self.ends[1].1) + TICK + DIGITS;
        let ((x, y), width) = (self.place, LABEL.width(&self.label));
        let right = x + (0.5 + 0.5 * self.side.0) * width;
        [-x, right - wide, lowest.max(y + LABEL_HEIGHT) - high].map(|room| room.max(0.0))
    }

    /// Draws it into a panel whose left upper corner is given, with labels if asked for.
    fn draw<B: Medium>(&self, page: &Page<B>, corner: Point, labelled: bool) -> Drawn<B> {
        let at = |p: Point| (corner.0 + p.0, corner.1 + p.1);
        let out = |p: Point, (x, y): Point, length: f64| (p.0 + length * x, p.1 + length * y);
        let [from, to] = self.ends.map(at);
        stroke(page, &[from, to], THIN, INK, &[])?;
        let anchor = (0.5 - 0.5 * self.side.0, 0.5 - 0.5 * self.side.1);
        for (part, text) in &self.ticks {
            let foot = between(from, to, *part);
            stroke(
                page,
                &[foot, out(foot, self.away, TICK / 2.0)],
                THIN,
                INK,
                &[],
            )?;
            if labelled {
                write(page, text, out(foot, self.side, TICK), SMALL, anchor, false)?;
            }
        }
        if !labelled {
            return Ok(());
        }
        match self.side.0 < 0.0 {
            true => Block::new(&self.label, LABEL, f64::INFINITY).draw(page, at(self.place), true),
            false => write(page, &self.label, at(self.place), LABEL, anchor, false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of particles on the ground, and a figure that shows it.
    fn figure() -> SolidFigure {
        let place = |n: usize| [n / 6, n / 3 % 2, n % 3].map(|k| k as f64 + 0.5);
        SolidFigure {
            title: "A slope".into(),
            panels: vec![SolidPanel {
                title: "block".into(),
                points: (0..36).map(place).collect(),
                values: vec![1.0; 36],
                size: 1.0,
            }],
            columns: 1,
            range: (0.0, 2.0),
            label: "equivalent plastic strain (-)".into(),
            window: [(0.0, 30.0), (0.0, 3.0), (0.0, 3.0)],
        }
    }

    #[test]
    fn pixels_follow_from_the_input_alone() {
        let folder = tempfile::tempdir().unwrap();
        let mut figure = figure();
        figure.panels.push(figure.panels[0].clone());
        let draw = |threads: usize| {
            let path = folder.path().join(format!("{threads}.png"));
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            pool.install(|| draw_solids(&path, &figure)).unwrap();
            std::fs::read(path).unwrap()
        };
        assert!(draw(1) == draw(3));
        let frames = [figure.clone(), figure.clone()];
        animate_solids(&folder.path().join("moving.png"), &frames, 8).unwrap();
    }

    #[test]
    fn what_is_not_there_to_be_drawn_is_an_error() {
        type Spoil = fn(&mut SolidFigure);
        let cases: [(&str, Spoil); 6] = [
            ("A slope", |f| f.panels.clear()),
            ("A slope", |f| f.range = (f64::NAN, f64::NAN)),
            ("A slope", |f| f.window[1] = (1.0, 1.0)),
            ("block", |f| f.window[0] = (10.0, 20.0)),
            ("block", |f| f.panels[0].size = 0.0),
            ("36 points but 35 values", |f| {
                f.panels[0].values.truncate(35)
            }),
        ];
        for (name, spoil) in cases {
            let mut spoilt = figure();
            spoil(&mut spoilt);
            let path = Path::new("no such folder/picture.png");
            let error = draw_solids(path, &spoilt).unwrap_err().to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}
