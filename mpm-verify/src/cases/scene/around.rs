//! Lines around the particles in pictures of a scene in the plane: the bodies at the start, and supports.

use super::fault;
use super::form::{Finite, ShapeForm, SupportForm, SurfaceForm};
use super::setup::{Setup, acts, components, speeds};
use super::shape::ends;
use crate::case::{Scenery, Timed};
use crate::cases::prelude::*;
use crate::draw::Line;

/// Corners of the polygon that a disc is drawn as.
const ROUND: u32 = 72;
/// Relative difference of two times that is rounding.
const ROUNDING: f64 = 1e-9;

/// A support, a face or a surface: a box or a chain that may move.
struct Held<const D: usize> {
    ends: [[f64; 2]; D],
    /// Corners of a surface; none of a box.
    chain: Vec<[f64; D]>,
    velocity: [f64; D],
    amplitude: Amplitude,
    /// Beginning and duration (s) of the phases in which it acts.
    acts: Vec<[f64; 2]>,
}

impl<const D: usize> Held<D> {
    /// The line about it at a time (s), within the grid, if it acts then.
    fn line(&self, grid: &Grid<D>, time: f64) -> Option<Line> {
        let acts = |[begin, duration]: &[f64; 2]| *begin <= time && time <= (begin + duration) * (1.0 + ROUNDING);
        if !self.acts.iter().any(acts) {
            return None;
        }
        let stroke = |[begin, duration]: &[f64; 2]| self.amplitude.integral((time - begin).min(*duration));
        let stroke: f64 = self.acts.iter().map(stroke).sum();
        let place = |x: [f64; D], a: usize| x[a] + self.velocity[a] * stroke;
        if !self.chain.is_empty() {
            return Some((self.chain.iter().map(|x| (place(*x, 0), place(*x, D - 1))).collect(), true));
        }
        let end = |a: usize, side: usize| {
            place(self.ends.map(|ends| ends[side]), a).clamp(grid.axes[a].lo, grid.axes[a].hi(grid.h))
        };
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)];
        Some((corners.map(|(i, j)| (end(0, i), end(D - 1, j))).to_vec(), true))
    }
}

impl<const D: usize> Setup<D> {
    /// Title, lines and input that pictures and page show.
    pub(super) fn scenery(&self, title: &'static str) -> Result<Scenery, toml::ser::Error> {
        let mut last = 0.0;
        let mut phases: Vec<(f64, String)> = Vec::new();
        for phase in &self.phases {
            phases.push((last, phase.name.clone()));
            last += phase.duration();
        }
        let heading = move |time: f64| {
            let phase = phases.iter().rfind(|(begin, _)| *begin < time).or(phases.first());
            let name = phase.map_or("", |(_, name)| name);
            format!("{title}: {name}, t = {} s", (1e6 * time).round() / 1e6)
        };
        let filled = toml::to_string(&self.form)?;
        Ok(Scenery { end: last, up: self.up(), heading: Box::new(heading), around: self.around(), filled })
    }

    /// Outlines of the bodies at the start, and supports and faces at a time.
    fn around(&self) -> Timed<Vec<Line>> {
        if D != 2 {
            return Box::new(|_| Vec::new());
        }
        let during = |names: &[String]| {
            let mut before = 0.0;
            let all = self.phases.iter().map(|phase| {
                before += phase.duration();
                (acts(names, &phase.name), [before - phase.duration(), phase.duration()])
            });
            all.filter(|(acts, _)| *acts).map(|(_, span)| span).collect::<Vec<_>>()
        };
        let support = |form: &SupportForm| match form {
            SupportForm::Wall { axis, end, phases, .. } => {
                let own = &self.grid.axes[*axis as usize];
                let mut ends = [[f64::NEG_INFINITY, f64::INFINITY]; D];
                ends[*axis as usize] = [[own.lo, own.hi(self.grid.h)][*end as usize]; 2];
                Held {
                    ends,
                    chain: Vec::new(),
                    velocity: [0.0; D],
                    amplitude: Amplitude::Rise(0.0),
                    acts: during(phases),
                }
            }
            SupportForm::Nodes { within, velocity_m_s, moves, rise_s, amplitude, phases, .. } => {
                let velocity = speeds(velocity_m_s).map(|speed| speed.filter(|_| *moves).unwrap_or(0.0));
                Held {
                    ends: ends(within),
                    chain: Vec::new(),
                    velocity,
                    amplitude: self.over_time(*rise_s, amplitude),
                    acts: during(phases),
                }
            }
        };
        let supports = self.form.supports.iter().map(|form| support(form.get_ref()));
        let faces = self.form.contacts.iter().map(|form| {
            let (form, mut ends) = (form.get_ref(), ends(&form.get_ref().within));
            let chain = match &form.surface {
                Some(SurfaceForm::Polygon { corners_m }) => corners_m.iter().map(|corner| components(corner)).collect(),
                _ => Vec::new(),
            };
            if let Some((axis, at)) = form.axis.zip(form.at_m) {
                ends[axis as usize] = [at.0; 2];
            }
            let velocity = components(form.velocity_m_s.as_deref().unwrap_or_default());
            let amplitude = self.over_time(form.rise_s, &form.amplitude);
            Held { ends, chain, velocity, amplitude, acts: during(&form.phases) }
        });
        let held: Vec<Held<D>> = supports.chain(faces).collect();
        let bodies: Vec<Line> = self.form.all_bodies().flat_map(|body| &body.get_ref().shapes).map(outline).collect();
        let grid = self.grid;
        Box::new(move |time| {
            let held = held.iter().filter_map(|held| held.line(&grid, time));
            bodies.iter().cloned().chain(held).collect()
        })
    }
}

/// Outline of a shape in the plane; none of a table's particles.
fn outline(shape: &fault::Line<ShapeForm>) -> Line {
    let point = |x: &[Finite]| -> (f64, f64) { components::<2>(x).into() };
    let mut corners: Vec<(f64, f64)> = match shape.get_ref() {
        ShapeForm::Box { from_m, to_m } => {
            let ((a, b), (c, d)) = (point(from_m), point(to_m));
            vec![(a, b), (c, b), (c, d), (a, d)]
        }
        ShapeForm::Polygon { corners_m, .. } => corners_m.iter().map(|corner| point(corner)).collect(),
        ShapeForm::Disc { centre_m, radius_m: r } => {
            let (x, y) = point(centre_m);
            let turn = |k| f64::from(k) * TAU / f64::from(ROUND);
            (0..ROUND).map(turn).map(|turn| (x + r.0 * turn.cos(), y + r.0 * turn.sin())).collect()
        }
        ShapeForm::Particles { .. } => Vec::new(),
    };
    corners.extend(corners.first().copied());
    (corners, false)
}
