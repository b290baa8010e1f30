//! Bodies of particles in three dimensions, in panels of one scale: a particle is a sphere a little larger than its
//! share of space, and the nearest sphere at a pixel gives its colour.

mod rulers;
mod surface;

use super::axes::{Axis, TICK, widen};
use super::bar::{BAR, BAR_TIP, draw_bar};
use super::canvas::Canvas;
use super::colour::{Rgb, stone_of};
use super::font::{Block, HEADING, LABEL, SMALL, TITLE};
use super::png_file::save_animation;
use super::shape::Point;
use super::{EDGE, PlotError, largest, nothing};
use rayon::prelude::*;
use rulers::Ruler;
use std::path::Path;
use surface::{Cloud, Place, Screen};

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
/// A figure without panels, a finite range or window that is not empty; a panel without a size or a particle in
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

/// The particles of a panel that lie in the window, with their colours.
fn cloud(path: &Path, figure: &SolidFigure, panel: &SolidPanel) -> Result<Cloud, PlotError> {
    if panel.points.len() != panel.values.len() {
        return Err(PlotError::Lengths {
            path: path.into(),
            title: panel.title.clone(),
            points: panel.points.len(),
            values: panel.values.len(),
        });
    }
    // A particle on the ground may have sunk in a little.
    let half = panel.size / 2.0;
    let inside = |(lo, hi): Point, v: f64| (lo - half..=hi + half).contains(&v);
    let shown = |p: &Place| (0..3).all(|k| inside(figure.window[k], p[k]));
    let range = widen(figure.range, 0.0);
    let particles = panel.points.iter().zip(&panel.values);
    let particles: Vec<(Place, Rgb)> = particles
        .filter(|(p, _)| shown(p))
        .map(|(p, v)| (*p, stone_of(*v, range)))
        .collect();
    let drawable = panel.size.is_finite() && panel.size > 0.0 && !particles.is_empty();
    drawable
        .then_some(Cloud {
            particles,
            size: panel.size,
        })
        .ok_or_else(|| nothing(path, &panel.title))
}

fn compose(path: &Path, figure: &SolidFigure) -> Result<Canvas, PlotError> {
    let (least, most) = figure.range;
    let sound = |(lo, hi): &Point| lo < hi && (hi - lo).is_finite();
    let sound = figure.window.iter().all(sound) && least.is_finite() && most.is_finite();
    if figure.panels.is_empty() || !sound {
        return Err(nothing(path, &figure.title));
    }
    let columns = figure.columns.min(figure.panels.len()).max(1);
    let rows = figure.panels.len().div_ceil(columns);
    let width = WIDTHS[columns.min(4) - 1];
    let screen = Screen::new((AZIMUTH, ELEVATION), &figure.window, (width, HEIGHT));
    let draw = |panel| Ok(surface::draw(&cloud(path, figure, panel)?, &screen));
    let images: Result<Vec<_>, PlotError> = figure.panels.par_iter().map(draw).collect();

    let rulers = Ruler::all(&screen, &figure.window);
    let titles = figure.panels.iter();
    let titles: Vec<Block> = titles.map(|p| Block::new(&p.title, TITLE, width)).collect();
    let above = largest(titles.iter().map(Block::height)) + TITLE_GAP;
    let (wide, high) = screen.size;
    let room = |side: usize| largest(rulers.iter().map(|r| r.room((wide, high))[side])).ceil();
    let (left, right, below) = (room(0), room(1), room(2));
    let all = |count: usize, one: f64| count as f64 * (one + PANEL_GAP) - PANEL_GAP;
    let across = left + all(columns, wide) + right;
    let down = all(rows, above + high) + below;

    let bar_length = (down - 2.0 * BAR_TIP).clamp(BAR_LENGTH.0, BAR_LENGTH.1);
    let bar = Axis::new(widen(figure.range, 0.0), false, bar_length.floor(), true);
    let bar_label = Block::new(&figure.label, LABEL, bar_length + 2.0 * BAR_TIP);
    let bar_left = (EDGE + across + BAR_GAP).round();
    let bar_label_left = bar_left + BAR + TICK + bar.label_width() + 12.0;
    let full_width = bar_label_left + bar_label.height() + EDGE;
    let heading = Block::new(&figure.title, HEADING, full_width - 2.0 * EDGE);
    let head = (EDGE + heading.height() * 1.2).round();
    let full = down.max(bar_length + 2.0 * BAR_TIP);
    let mut canvas = Canvas::new((full_width, head + full + NOTE + EDGE));
    canvas.block(&heading, (full_width / 2.0, EDGE), false);
    for (k, (image, title)) in images?.into_iter().zip(&titles).enumerate() {
        let (row, column) = (k / columns, k % columns);
        let x = EDGE + left + column as f64 * (wide + PANEL_GAP);
        let y = (head + above + row as f64 * (above + high + PANEL_GAP)).round();
        canvas.image(image, (x, y));
        let last_row = k + columns >= figure.panels.len();
        let labelled = [last_row, column == 0, column + 1 == columns];
        for (ruler, labelled) in rulers.iter().zip(labelled) {
            ruler.draw(&mut canvas, (x, y), labelled);
        }
        let over = y - TITLE_GAP - title.height();
        canvas.block(title, (x + wide / 2.0, over), false);
    }
    let values = || figure.panels.iter().flat_map(|p| &p.values);
    let (lo, hi) = bar.range;
    let beyond = [values().any(|v| *v < lo), values().any(|v| *v > hi)];
    let middle = head + full / 2.0;
    let foot = (middle + bar.length / 2.0).round();
    draw_bar(&mut canvas, (&bar, stone_of), beyond, (bar_left, foot));
    canvas.block(&bar_label, (bar_label_left, middle), true);
    let note = format!("orthographic, azimuth {AZIMUTH}°, elevation {ELEVATION}°");
    let at = (EDGE, head + full + NOTE / 2.0);
    canvas.text(&note, at, SMALL, (0.0, 0.5), false);
    Ok(canvas)
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
