//! Bodies of particles in three dimensions, as solids with hidden surfaces and light, in panels of one scale.
//!
//! A particle is drawn as a sphere a little larger than its share of space, and the nearest sphere at a pixel gives its
//! colour. Light comes from how full space is: the body's smoothed density gives the direction of its surface, a wide
//! average of it (with the ground) how much of the sky is hidden.

mod bulk;
mod camera;
mod rulers;
mod surface;

pub use camera::{Camera, Up};

use super::axes::{Axis, TICK, extent, widen};
use super::bar::{BAR, BAR_TIP, draw_bar};
use super::canvas::{Block, Canvas, FINE, HEADING, LABEL, Point, Rgb, SMALL, TITLE};
use super::canvas::{largest, save_animation, stone_of};
use super::{EDGE, NO_VALUE, PlotError, nothing};
use camera::{Place, View};
use rayon::prelude::*;
use rulers::Ruler;
use std::path::Path;
use surface::{Cloud, Ground, Screen};

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

/// Bodies seen by one camera, at one scale, with one colour scale.
///
/// The colours diverge from a neutral zero as those of a [`FieldFigure`](super::FieldFigure); else they run from the
/// lightest at the lower end to the darkest. Every pixel of a body has that of the particle nearest to the eye, and
/// light, which changes its brightness alone.
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
    /// Where the bodies are seen from.
    pub camera: Camera,
    /// Names of the axes x, y, z, with unit.
    pub axes: [String; 3],
    /// What is shown of each axis (m): particles beyond, by more than half their size, are left out, and the marks run
    /// along its edges. Its lower end on the vertical axis is the ground. Without, all particles are shown.
    pub window: Option<[(f64, f64); 3]>,
}

/// Widths of panels by their number in a row, and the largest height, in pixels.
const WIDTHS: [f64; 4] = [1200.0, 760.0, 560.0, 460.0];
const HEIGHT: f64 = 1000.0;
/// Distance of panels, and from a panel's title to it.
const PANEL_GAP: f64 = 24.0;
const TITLE_GAP: f64 = 8.0;
/// Distance of the colour bar from the panels, and height of the line that tells of the camera.
const BAR_GAP: f64 = 20.0;
const NOTE: f64 = 40.0;
/// Least and largest length of the colour bar.
const BAR_LENGTH: (f64, f64) = (200.0, 700.0);

/// Draws bodies as one PNG file.
///
/// # Errors
/// A figure without panels, a finite range, camera or window that is not empty; a panel without a size or a particle in
/// the window, or whose points and values differ in number; or a file that can't be written.
pub fn draw_solids(path: &Path, figure: &SolidFigure) -> Result<(), PlotError> {
    compose(path, figure)?.save(path)
}

/// Draws figures one after the other as an animated PNG at half the size, each shown for a `delay` of hundredths of a
/// second. They should have the same window and number of panels.
///
/// # Errors
/// As [`draw_solids`]; or there are no figures.
pub fn animate_solids(path: &Path, figures: &[SolidFigure], delay: u16) -> Result<(), PlotError> {
    let frame = |figure: &SolidFigure| compose(path, figure)?.pixels(path, 2);
    let frames: Result<Vec<_>, PlotError> = figures.iter().map(frame).collect();
    save_animation(path, &frames?, delay)
}

/// What is drawn of a panel: the particles in the window, with their colours.
struct Body {
    points: Vec<Place>,
    colours: Vec<Rgb>,
    size: f64,
}

impl Body {
    fn new(panel: &SolidPanel, window: &[(f64, f64); 3], range: Point) -> Self {
        // A particle on the ground may have sunk in a little.
        let half = panel.size / 2.0;
        let inside = |(lo, hi): Point, v: f64| (lo - half..=hi + half).contains(&v);
        let shown = |p: &Place| (0..3).all(|k| inside(window[k], p[k]));
        let colour = |value: f64| match value.is_nan() {
            true => NO_VALUE,
            false => stone_of(value, range),
        };
        let particles = panel.points.iter().zip(&panel.values);
        let particles = particles.filter(|(p, _)| shown(p));
        let (points, colours) = particles.map(|(p, v)| (*p, colour(*v))).unzip();
        Self {
            points,
            colours,
            size: panel.size,
        }
    }

    fn cloud(&self) -> Cloud<'_> {
        Cloud {
            points: &self.points,
            colours: &self.colours,
            size: self.size,
        }
    }
}

/// The window, given or about all particles, if there is something to see in it.
fn window(path: &Path, figure: &SolidFigure) -> Result<[(f64, f64); 3], PlotError> {
    let angles = [figure.camera.azimuth, figure.camera.elevation];
    if figure.panels.is_empty() || !angles.iter().all(|angle| angle.is_finite()) {
        return Err(nothing(path, &figure.title));
    }
    if let Some(window) = figure.window {
        let sound = |(lo, hi): &Point| lo < hi && (hi - lo).is_finite();
        let sound = window.iter().all(sound);
        return sound
            .then_some(window)
            .ok_or_else(|| nothing(path, &figure.title));
    }
    let mut window = [(0.0, 0.0); 3];
    for (axis, ends) in window.iter_mut().enumerate() {
        let ends_of = |panel: &SolidPanel| {
            let finite = panel
                .points
                .iter()
                .filter(|p| p.iter().all(|v| v.is_finite()));
            let half = panel.size / 2.0;
            extent(finite.flat_map(|p| [p[axis] - half, p[axis] + half]))
        };
        let all = figure.panels.iter().filter_map(ends_of);
        let all = extent(all.flat_map(|(lo, hi)| [lo, hi]));
        *ends = all.ok_or_else(|| nothing(path, &figure.title))?;
    }
    Ok(window)
}

/// The bodies of a figure that can be drawn.
fn bodies(
    path: &Path,
    figure: &SolidFigure,
    window: &[(f64, f64); 3],
) -> Result<Vec<Body>, PlotError> {
    let range = extent([figure.range.0, figure.range.1].into_iter());
    let range = range.ok_or_else(|| nothing(path, &figure.title))?;
    let body = |panel: &SolidPanel| {
        if panel.points.len() != panel.values.len() {
            return Err(PlotError::Lengths {
                path: path.into(),
                title: panel.title.clone(),
                points: panel.points.len(),
                values: panel.values.len(),
            });
        }
        let body = Body::new(panel, window, widen(range, 0.0));
        let drawable = panel.size.is_finite() && panel.size > 0.0 && !body.points.is_empty();
        drawable
            .then_some(body)
            .ok_or_else(|| nothing(path, &panel.title))
    };
    figure.panels.iter().map(body).collect()
}

/// Places of all that a figure shows.
struct Layout {
    screen: Screen,
    rulers: [Ruler; 3],
    ground: Ground,
    /// Size of a panel, and room left of the first column, right of the last and below the last row.
    panel: Point,
    room: [f64; 3],
    columns: usize,
    rows: usize,
    /// Room for a panel's title.
    title: f64,
}

impl Layout {
    fn new(figure: &SolidFigure, window: &[(f64, f64); 3], titles: &[Block]) -> Self {
        let columns = figure.columns.min(figure.panels.len()).max(1);
        let mut screen = screen(figure.camera, window, WIDTHS[columns.min(4) - 1]);
        let panel = (screen.size.0 as f64, screen.size.1 as f64);
        let rulers = Ruler::all(&screen, window, figure.camera.up);
        let mut lines = [const { Vec::new() }; 3];
        let up = figure.camera.up.index();
        for ruler in rulers.iter().filter(|ruler| ruler.axis != up) {
            lines[ruler.axis] = ruler.values();
        }
        screen.scale *= FINE;
        screen.size = (screen.size.0 * FINE as usize, screen.size.1 * FINE as usize);
        let rooms = rulers
            .each_ref()
            .map(|ruler| ruler.room(&figure.axes[ruler.axis], panel));
        let room = [0, 1, 2].map(|side| largest(rooms.iter().map(|room| room[side])));
        Self {
            screen,
            rulers,
            ground: Ground {
                up,
                height: window[up].0,
                ends: *window,
                lines,
            },
            panel,
            room,
            columns,
            rows: figure.panels.len().div_ceil(columns),
            title: largest(titles.iter().map(Block::height)) + TITLE_GAP,
        }
    }

    /// Left upper corner of a panel, from that of all.
    fn corner(&self, k: usize) -> Point {
        let (row, column) = ((k / self.columns) as f64, (k % self.columns) as f64);
        let across = self.room[0] + column * (self.panel.0 + PANEL_GAP);
        let down = self.title + row * (self.title + self.panel.1 + PANEL_GAP);
        (across.round(), down.round())
    }

    /// Size of all panels with their labels.
    fn size(&self) -> Point {
        let (left, top) = self.corner(self.columns * self.rows - 1);
        let [_, right, below] = self.room;
        (left + self.panel.0 + right, top + self.panel.1 + below)
    }

    /// Draws the rulers of a panel whose corner is given, with labels at the rim of the figure.
    fn draw_rulers(&self, canvas: &mut Canvas, k: usize, corner: Point, figure: &SolidFigure) {
        let last = (k % self.columns) + 1 == self.columns;
        let labelled = [
            k + self.columns >= figure.panels.len(),
            last,
            k.is_multiple_of(self.columns),
        ];
        for (ruler, labelled) in self.rulers.iter().zip(labelled) {
            let label = labelled.then_some(&*figure.axes[ruler.axis]);
            ruler.draw(canvas, corner, label);
        }
    }
}

/// The screen on which a window is at most so wide, in pixels of the picture.
fn screen(camera: Camera, window: &[(f64, f64); 3], width: f64) -> Screen {
    let view = View::new(camera);
    let corners = (0..8).map(|k| {
        let end = |axis: usize| match k >> axis & 1 {
            0 => window[axis].0,
            _ => window[axis].1,
        };
        view.project([end(0), end(1), end(2)])
    });
    let corners: Vec<Place> = corners.collect();
    let ends = |k: usize| extent(corners.iter().map(|c| c[k])).unwrap_or_default();
    let (across, upwards) = (ends(0), ends(1));
    let least = 1e-9;
    let (wide, high) = (
        (across.1 - across.0).max(least),
        (upwards.1 - upwards.0).max(least),
    );
    // Spheres at the rim reach a little beyond.
    let margin = 6.0;
    let scale = f64::min(
        (width - 2.0 * margin) / wide,
        (HEIGHT - 2.0 * margin) / high,
    );
    let side = |length: f64| (scale * length + 2.0 * margin).ceil() as usize;
    Screen {
        view,
        corner: (across.0 - margin / scale, upwards.1 + margin / scale),
        scale,
        size: (side(wide), side(high)),
    }
}

/// The colour bar with its label.
struct Bar {
    scale: Axis,
    label: Block,
}

impl Bar {
    /// Beside panels of a height.
    fn new(figure: &SolidFigure, height: f64) -> Self {
        let length = height - 2.0 * BAR_TIP;
        let length = length.clamp(BAR_LENGTH.0, BAR_LENGTH.1).floor();
        Self {
            scale: Axis::new(widen(figure.range, 0.0), false, length, true),
            label: Block::new(&figure.label, LABEL, length + 2.0 * BAR_TIP),
        }
    }

    fn label_left(&self) -> f64 {
        BAR + TICK + self.scale.label_width() + 12.0
    }

    fn width(&self) -> f64 {
        self.label_left() + self.label.height()
    }

    fn height(&self) -> f64 {
        self.scale.length + 2.0 * BAR_TIP
    }

    /// Draws it right of a place, centred there.
    fn draw(&self, canvas: &mut Canvas, figure: &SolidFigure, (left, middle): Point) {
        let values = || figure.panels.iter().flat_map(|p| &p.values);
        let (lo, hi) = self.scale.range;
        let beyond = [values().any(|v| *v < lo), values().any(|v| *v > hi)];
        let foot = (middle + self.scale.length / 2.0).round();
        draw_bar(
            canvas,
            (&self.scale, stone_of),
            beyond,
            (left.round(), foot),
        );
        canvas.block(&self.label, (left + self.label_left(), middle), true);
    }
}

fn compose(path: &Path, figure: &SolidFigure) -> Result<Canvas, PlotError> {
    let window = window(path, figure)?;
    let bodies = bodies(path, figure, &window)?;
    let width = WIDTHS[figure.columns.clamp(1, 4) - 1];
    let titles = (figure.panels.iter()).map(|p| Block::new(&p.title, TITLE, width));
    let titles: Vec<Block> = titles.collect();
    let layout = Layout::new(figure, &window, &titles);
    let images: Vec<_> = (bodies.par_iter())
        .map(|body| surface::draw(&body.cloud(), &layout.screen, Some(&layout.ground)))
        .collect();

    let (wide, high) = layout.size();
    let bar = Bar::new(figure, high);
    let bar_left = EDGE + wide + BAR_GAP;
    let width = bar_left + bar.width() + EDGE;
    let heading = Block::new(&figure.title, HEADING, width - 2.0 * EDGE);
    let head = EDGE + heading.height() * 1.2;
    let foot = head + high.max(bar.height()) + NOTE / 2.0;
    let mut canvas = Canvas::new((width, foot + NOTE / 2.0 + EDGE));
    canvas.block(&heading, (width / 2.0, EDGE), false);
    for (k, (image, title)) in images.iter().zip(&titles).enumerate() {
        let (left, top) = layout.corner(k);
        let corner = (EDGE + left, head + top);
        canvas.picture(image, corner);
        layout.draw_rulers(&mut canvas, k, corner, figure);
        let over = corner.1 - TITLE_GAP - title.height();
        canvas.block(title, (corner.0 + layout.panel.0 / 2.0, over), false);
    }
    let middle = head + high.max(bar.height()) / 2.0;
    bar.draw(&mut canvas, figure, (bar_left, middle));
    let Camera {
        azimuth, elevation, ..
    } = figure.camera;
    let note = format!("orthographic, azimuth {azimuth}°, elevation {elevation}°");
    canvas.text(&note, (EDGE, foot), SMALL, (0.0, 0.5), false);
    Ok(canvas)
}

#[cfg(test)]
mod tests;
