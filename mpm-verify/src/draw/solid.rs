//! Bodies of particles in three dimensions: a particle is a sphere a little larger than its share of space, and the
//! nearest sphere at a pixel gives its colour.

use super::axes::{Axis, BELOW, LEFT, RIGHT, THIN, TICK};
use super::colour::{INK, Rgb, stone_of};
use super::page::{FINE, Page, Point, fine, ink, pixels, spot};
use super::png_file::{save_animation, write_small_png};
use super::sheet::{Bar, Sheet};
use super::text::{Block, LABEL, SMALL};
use super::{EDGE, PlotError, between, same_length};
use image::RgbImage;
use plotters::element::Pixel;
use rayon::prelude::*;
use std::path::Path;

/// A body at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SolidPanel {
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
pub(crate) struct SolidFigure {
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
    /// Shown range of each axis (m): particles beyond, by more than half their size, are left out, and the marks run
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
/// Space in a panel about what is shown, and height of the line that tells of the camera.
const MARGIN: f64 = 6.0;
const NOTE: f64 = 40.0;
/// Radius of a particle in distances of particles that fill space: large enough to leave no holes between them.
const RADIUS: f64 = 0.85;
/// Where the light comes from: left, up, and towards the eye; light from all around, and from there.
const LIGHT: Place = [-0.25, 0.75, 0.62];
const AMBIENT: f64 = 0.52;
const DIRECT: f64 = 0.55;
const GROUND: Rgb = 0xECEAE6;
/// Height of a text, and gap between texts.
const LINE: f64 = 40.0;
const GAP: f64 = 10.0;

/// A position or direction in the axes of the problem.
type Place = [f64; 3];

/// Draws bodies as one PNG file.
///
/// # Errors
/// A figure without panels, a finite range or window that is not empty; a panel without a size or a particle in
/// the window, or whose points and values differ in number; or a file that can't be written.
pub(crate) fn draw_solids(path: &Path, figure: &SolidFigure) -> Result<(), PlotError> {
    write_small_png(path, &picture(path, figure, 1)?)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. They should have the same window and number of panels.
///
/// # Errors
/// As [`draw_solids`]; or there are no figures.
pub(crate) fn animate_solids(path: &Path, figures: &[SolidFigure], delay: u16) -> Result<(), PlotError> {
    let frames = figures.iter().map(|figure| picture(path, figure, 2));
    save_animation(path, &frames.collect::<Result<Vec<_>, _>>()?, delay)
}

fn picture(path: &Path, figure: &SolidFigure, coarser: u32) -> Result<RgbImage, PlotError> {
    let sound = |(lo, hi): &Point| lo < hi && (hi - lo).is_finite();
    let finite = figure.range.0.is_finite() && figure.range.1.is_finite();
    if figure.panels.is_empty() || !figure.window.iter().all(sound) || !finite {
        return Err(PlotError::no_data(path, &figure.title));
    }
    let columns = figure.columns.min(figure.panels.len()).max(1);
    let screen = Screen::new(&figure.window, WIDTHS[columns.min(4) - 1]);
    let rulers = Ruler::all(&screen);
    let room = [1, 2, 0].map(|side| rulers[side].room());
    let titles = figure.panels.iter().map(|p| &*p.title).collect();
    let sheet = Sheet::new(&figure.title, titles, columns, screen.size, room);
    let values = figure.panels.iter().flat_map(|p| &p.values);
    let bar = Bar::new(&sheet, (figure.range, &figure.label), stone_of, values);
    let draw = |panel: &SolidPanel| {
        let (points, values) = (panel.points.len(), panel.values.len());
        same_length(path, &panel.title, points, values)?;
        let image = screen.spheres(panel, bar.range());
        image.ok_or_else(|| PlotError::no_data(path, &panel.title))
    };
    let images: Result<Vec<_>, PlotError> = figure.panels.par_iter().map(draw).collect();
    let (images, (width, height)) = (images?, bar.size(&sheet));
    pixels(path, (width, height + NOTE), coarser, |page| {
        for (k, image) in images.iter().enumerate() {
            let [left, top, ..] = sheet.frame(k);
            let ground = screen.ground().map(|p| (left + p.0, top + p.1));
            page.area(&ground, GROUND, 1.0);
            let (corner, width) = (spot((left, top)), fine(screen.size.0) as usize);
            for (n, (_, colour)) in image.iter().enumerate().filter(|(_, p)| p.0.is_finite()) {
                let at = (corner.0 + (n % width) as i32, corner.1 + (n / width) as i32);
                page.put(&Pixel::new(at, ink(*colour, 1.0)));
            }
            for ruler in &rulers {
                ruler.draw(page, (left, top));
            }
        }
        let note = format!("orthographic, azimuth {AZIMUTH}°, elevation {ELEVATION}°");
        page.text(&note, (EDGE, height - EDGE + NOTE / 2.0), SMALL, (0.0, 0.5));
        sheet.draw(page);
        bar.draw(page);
    })
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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
    /// Screen of a size that holds a window and is no wider than `most`.
    fn new(window: &[(f64, f64); 3], most: f64) -> Self {
        let (st, ct) = AZIMUTH.to_radians().sin_cos();
        let (se, ce) = ELEVATION.to_radians().sin_cos();
        let view = [[ct, 0.0, -st], [-se * st, ce, -se * ct], [ce * st, se, ce * ct]];
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

    fn flat(&self, at: Place) -> Point {
        let [across, down, _] = self.place(at);
        (across, down)
    }

    /// Corners of the ground within the window.
    fn ground(&self) -> [Point; 4] {
        let [x, y, z] = self.window;
        let corners = [(x.0, z.0), (x.1, z.0), (x.1, z.1), (x.0, z.1)];
        corners.map(|(x, z)| self.flat([x, y.0, z]))
    }

    /// Depth and colour of the nearest sphere at every fine pixel, far away for a pixel beside all spheres; `None`
    /// without any.
    fn spheres(&self, panel: &SolidPanel, range: Point) -> Option<Vec<(f64, Rgb)>> {
        // A particle on the ground may have sunk in a little.
        let half = panel.size / 2.0;
        let inside = |(lo, hi): Point, v: f64| (lo - half..=hi + half).contains(&v);
        let shown = |p: &Place| (0..3).all(|k| inside(self.window[k], p[k]));
        let drawable = panel.size.is_finite() && panel.size > 0.0;
        if !drawable || !panel.points.iter().any(shown) {
            return None;
        }
        let (width, height) = (fine(self.size.0), fine(self.size.1));
        let mut pixels = vec![(f64::NEG_INFINITY, 0); (width * height) as usize];
        let scale = f64::from(FINE) * self.scale;
        let radius = RADIUS * panel.size;
        let reach = (radius * scale).ceil() as i32;
        let lamp = LIGHT.map(|v| v / dot(LIGHT, LIGHT).sqrt());
        let particles = panel.points.iter().zip(&panel.values);
        for (at, value) in particles.filter(|(p, _)| shown(p)) {
            let colour = stone_of(*value, range).to_be_bytes().map(f64::from);
            let [across, down, depth] = self.place(*at).map(|v| v * f64::from(FINE));
            let span = |middle: f64, end: i32| {
                let middle = middle as i32;
                (middle - reach).max(0)..(middle + reach + 1).min(end)
            };
            let part = |pixel: i32, middle: f64| (f64::from(pixel) + 0.5 - middle) / (scale * radius);
            for (y, x) in span(down, height).flat_map(|y| span(across, width).map(move |x| (y, x))) {
                let (dx, dy) = (part(x, across), part(y, down));
                let rest = (1.0 - dx * dx - dy * dy).max(0.0).sqrt();
                let front = depth / f64::from(FINE) + radius * rest;
                let nearest = &mut pixels[(y * width + x) as usize];
                if rest > 0.0 && front > nearest.0 {
                    let facing = 0.5 + 0.5 * dot([dx, -dy, rest], lamp);
                    let light = AMBIENT + DIRECT * facing * facing;
                    let lit = colour.map(|c| (c * light).round().min(255.0) as u8);
                    *nearest = (front, Rgb::from_be_bytes(lit));
                }
            }
        }
        Some(pixels)
    }
}

/// Marks in metres along an edge of the window, with the directions of ticks and of labels.
struct Ruler {
    name: &'static str,
    ends: [Point; 2],
    scale: Axis,
    tick: Point,
    side: Point,
}

impl Ruler {
    /// Along x below, y on the left and z on the right.
    fn all(screen: &Screen) -> [Self; 3] {
        let [x, y, z] = screen.window;
        let (low, left) = ([x.0, y.0, z.1], [x.0, y.1, z.1]);
        let (right, far) = ([x.1, y.0, z.1], [x.1, y.0, z.0]);
        [
            ("x (m)", x, [low, right], BELOW, BELOW),
            ("y (m)", y, [low, left], LEFT, LEFT),
            ("z (m)", z, [far, right], (0.6, 0.8), RIGHT),
        ]
        .map(|(name, range, ends, tick, side)| {
            let ends = ends.map(|at| screen.flat(at));
            let length = (ends[1].0 - ends[0].0).hypot(ends[1].1 - ends[0].1);
            Self { name, ends, scale: Axis::new(range, false, length, side == LEFT), tick, side }
        })
    }

    /// Distance of the name from the edge.
    fn gap(&self) -> f64 {
        TICK + if self.side == BELOW { LINE / 2.0 } else { self.scale.label_width() + GAP }
    }

    /// Room for its labels beside a panel, or below.
    fn room(&self) -> f64 {
        self.gap() + if self.side == RIGHT { LABEL.width(self.name) } else { LINE }
    }

    /// Draws it into a panel whose left upper corner is given.
    fn draw(&self, page: &mut Page, corner: Point) {
        let ends = self.ends.map(|p| (corner.0 + p.0, corner.1 + p.1));
        page.line(&ends, THIN, INK, &[]);
        self.scale.draw(page, ends, self.tick, self.side);
        let ((x, y), gap) = (between(ends[0], ends[1], 0.5), self.gap());
        // Clear of the ticks' labels along an edge that falls or rises.
        match self.side {
            LEFT => {
                let name = Block::new(self.name, LABEL, f64::INFINITY);
                page.block(&name, (x - gap - LINE, y), true);
            }
            RIGHT => page.text(self.name, (x + gap, y + LINE), LABEL, (0.0, 0.5)),
            _ => page.text(self.name, (x, y + gap + LINE / 2.0), LABEL, (1.0, 0.5)),
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
    fn a_nearer_particle_hides_a_farther_one_and_what_faces_the_light_is_lighter() {
        let screen = Screen::new(&figure().window, 600.0);
        let [right, up, eye] = screen.view;
        let middle: Place = [15.0, 1.5, 1.5];
        let moved = |along: Place, by: f64| [0, 1, 2].map(|k| middle[k] + by * along[k]);
        for order in [[0, 1], [1, 0]] {
            let points = [middle, moved(eye, 0.9)];
            let panel = SolidPanel {
                title: String::new(),
                points: order.map(|k| points[k]).into(),
                values: order.map(|k| k as f64).into(),
                size: 1.0,
            };
            let pixels = screen.spheres(&panel, (0.0, 1.0)).unwrap();
            let at = |place: Place| {
                let (x, y) = screen.flat(place);
                let (depth, colour) = pixels[(fine(y) * fine(screen.size.0) + fine(x)) as usize];
                (depth, colour.to_be_bytes())
            };
            let (depth, colour) = at(middle);
            assert!((depth - dot(moved(eye, 0.9), eye) - RADIUS).abs() < 1e-3);
            // The colour of the nearer one, in light: dark purple.
            assert!(colour[1] > colour[2] && colour[1] < 0x80, "{colour:?}");
            let [lit, dark] = [0.6, -0.6].map(|by| at(moved(up, by)).1);
            assert!(lit[1] > dark[1] && at(moved(right, 2.0)).0.is_infinite());
        }
    }

    #[test]
    fn solids_are_drawn_whatever_the_number_of_threads() {
        let folder = tempfile::tempdir().unwrap();
        let mut figure = figure();
        figure.panels.push(figure.panels[0].clone());
        let draw = |threads: usize| {
            let path = folder.path().join("moving.png");
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let frames = [figure.clone(), figure.clone()];
            let drawn = || animate_solids(&path, &frames, 8);
            pool.build().unwrap().install(drawn).unwrap();
            std::fs::read(path).unwrap()
        };
        assert!(draw(1) == draw(3));
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
            ("36 points but 35 values", |f| f.panels[0].values.truncate(35)),
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
