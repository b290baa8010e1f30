//! A pressure on free sides that follows them.

use super::sides::free_sides;
use super::{Amplitude, End, Load};
use crate::frame::Frame;
use crate::memory::Memoryless;
use crate::particles::Particles;
use crate::space;
use nalgebra::SMatrix;
use std::array::from_fn;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// A side of a particle, by ids.
#[derive(Debug, Clone, Copy)]
struct Side<const D: usize> {
    own: u32,
    behind: Option<u32>,
    /// The particles beside it, before and after it along each axis but that of the side, and the size of its own domain
    /// over their distance; of particles that stand alone, that size.
    beside: [([u32; 2], f64); D],
}

/// A pressure on the free sides of particles: its force is normal to them, and goes with their area.
///
/// A side is spanned by the ways between the particles beside its own: with t = s (x₊ − x₋)/|X₊ − X₋| along each axis its
/// area vector is that of a parallelogram of these. Its particle takes 3/2 of the force and the one behind −1/2, as of
/// [`DeadForce::traction`](super::DeadForce::traction). An implicit step has the sides of its start.
#[derive(Debug)]
pub struct Pressure<const D: usize> {
    sides: Vec<Side<D>>,
    axis: usize,
    /// Pressure (Pa), times the orientation of the axes.
    pressure: f64,
    amplitude: Amplitude,
    /// Places of particles by id, anew in every step.
    places: Mutex<Vec<u32>>,
}

impl<const D: usize> Pressure<D> {
    /// A `pressure` (Pa) times the `amplitude` on the free sides at an end of an axis of the particles whose reference
    /// position satisfies `select`.
    pub fn new(
        pressure: f64,
        amplitude: Amplitude,
        particles: &Particles<D>,
        (axis, end): (usize, End),
        select: impl Fn(&[f64; D]) -> bool,
    ) -> Self {
        let (reference, id) = (&particles.reference, &particles.id);
        let size = particles.half_size.map(|half| 2.0 * half);
        let cell = |k: usize| -> [i64; D] { from_fn(|a| (reference[k][a] / size[a]).floor() as i64) };
        let all = free_sides(particles, (axis, end), |_| true);
        let row: HashMap<[i64; D], usize> = all.iter().map(|(k, _)| (cell(*k), *k)).collect();
        let side = |(k, behind): (usize, Option<usize>)| {
            let beside = from_fn(|a| {
                let next = |step: i64| {
                    let mut there = cell(k);
                    there[a] += step;
                    row.get(&there).copied().unwrap_or(k)
                };
                let ends = if a == axis { [k; 2] } else { [next(-1), next(1)] };
                let apart = reference[ends[1]][a] - reference[ends[0]][a];
                (ends.map(|end| id[end]), if apart > 0.0 { size[a] / apart } else { size[a] })
            });
            Side { own: id[k], behind: behind.map(|behind| id[behind]), beside }
        };
        let chosen = all.into_iter().filter(|(k, _)| select(&reference[*k]));
        let outward = if end == End::Lo { -1.0 } else { 1.0 };
        Self {
            sides: chosen.map(side).collect(),
            axis,
            pressure: outward * pressure,
            amplitude,
            places: Mutex::default(),
        }
    }

    /// How many particles carry the load.
    pub fn count(&self) -> usize {
        self.sides.len()
    }
}

impl<const D: usize> Memoryless for Pressure<D> {}

impl<const D: usize> Load<D> for Pressure<D> {
    fn add(&self, time: f64, particles: &mut Particles<D>) {
        let pressure = self.pressure * self.amplitude.at(time);
        let mut places = self.places.lock().unwrap_or_else(PoisonError::into_inner);
        places.resize(particles.len(), 0);
        for (place, id) in particles.id.iter().enumerate() {
            places[*id as usize] = place as u32;
        }
        let place = |id: u32| places[id as usize] as usize;
        for side in &self.sides {
            // Column a: the side along the axis a; that of the axis itself makes the determinant an area.
            let mut spans = SMatrix::<f64, D, D>::zeros();
            for (a, ([before, after], scale)) in side.beside.iter().enumerate() {
                let [from, to] = [before, after].map(|id| particles.position[place(*id)]);
                for i in 0..D {
                    spans[(i, a)] = if before == after { 0.0 } else { scale * (to[i] - from[i]) };
                }
                if before == after && a != self.axis {
                    spans[(a, a)] = *scale;
                }
            }
            let (own, behind) = (place(side.own), side.behind.map(place));
            for i in 0..D {
                spans.column_mut(self.axis).fill(0.0);
                spans[(i, self.axis)] = 1.0;
                let force = -pressure * space::determinant(&spans);
                particles.external_force[own][i] += if behind.is_some() { 1.5 * force } else { force };
                if let Some(behind) = behind {
                    particles.external_force[behind][i] -= 0.5 * force;
                }
            }
        }
    }

    fn seen_from(self: Box<Self>, frame: &Frame<D>) -> Box<dyn Load<D>> {
        // The determinant of the sides changes its sign with every axis that points the other way.
        let mirrored: f64 = (0..D).map(|a| frame.axis(a).1).product();
        let own = self.axis;
        let sides = self.sides.into_iter().map(|side| {
            let mut beside = side.beside;
            for (a, (ends, scale)) in side.beside.into_iter().enumerate() {
                let (there, sign) = frame.axis(a);
                let alone = a != own && ends[0] == ends[1];
                beside[there] = (ends, if alone { sign * frame.scale(0, 1) * scale } else { scale });
            }
            Side { beside, ..side }
        });
        let (axis, _) = frame.axis(own);
        Box::new(Self { sides: sides.collect(), axis, pressure: mirrored * frame.scale(1, 0) * self.pressure, ..*self })
    }
}
