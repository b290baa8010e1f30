//! Lines around the particles in pictures of a scene in the plane: the bodies at the start, and supports.

use super::fault;
use super::form::{Finite, ShapeForm, SupportForm};
use super::setup::{Setup, components};
use super::shape::ends;
use crate::cases::prelude::*;
use crate::draw::Line;

/// Corners of the polygon that a disc is drawn as.
const ROUND: u32 = 72;

impl<const D: usize> Setup<D> {
    /// Outlines of the bodies at the start, and of supports and faces at the end.
    pub(super) fn around(&self) -> Vec<Line> {
        let (open, all) = ([[f64::NEG_INFINITY, f64::INFINITY]; D], self.phases.len());
        let support = |form: &SupportForm| match form {
            SupportForm::Wall { axis, end, .. } => {
                let (mut ends, own) = (open, &self.grid.axes[*axis as usize]);
                ends[*axis as usize] = [[own.lo, own.hi(self.grid.h)][*end as usize]; 2];
                self.support(ends, [0.0; D])
            }
            SupportForm::Nodes { within, moves, .. } => {
                self.support(ends(within), self.strokes(form, if *moves { all } else { 0 }))
            }
        };
        let supports = self.form.supports.iter().map(|form| support(form.get_ref()));
        let faces = self.form.contacts.iter().map(|form| {
            let (form, mut ends) = (form.get_ref(), ends(&form.get_ref().within));
            ends[form.axis as usize] = [form.at_m.0; 2];
            let time = self.stroke_time(form.rise_s.0, &form.phases, all);
            self.support(ends, components(form.velocity_m_s.as_deref().unwrap_or_default()).map(|v| v * time))
        });
        let bodies = self.form.all_bodies().flat_map(|body| &body.get_ref().shapes).map(outline);
        if D == 2 { bodies.chain(supports).chain(faces).collect() } else { Vec::new() }
    }

    /// The line about a box that has moved, within the grid.
    fn support(&self, ends: [[f64; 2]; D], stroke: [f64; D]) -> Line {
        let grid = &self.grid;
        let end = |a: usize, side: usize| (ends[a][side] + stroke[a]).clamp(grid.axes[a].lo, grid.axes[a].hi(grid.h));
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)];
        (corners.map(|(i, j)| (end(0, i), end(D - 1, j))).to_vec(), true)
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
