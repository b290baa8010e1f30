//! Where the particles of a body stand: at the points (k + ½) s of a lattice, with whole numbers k and the distance s, that
//! lie in one of its shapes, or where a table has them.

use super::fault::{Line, Source};
use super::form::{Ends, Finite, Form, Region, ShapeForm};
use super::polygon::{Polygon, crossing};
use crate::cases::prelude::*;
use mpm_core::SymmetricTensor;
use std::collections::HashMap;

/// Most particles of a scene.
pub(super) const MOST: usize = 50_000_000;
/// Most lattice points about a shape, over that: each is looked at.
const LOOKED_AT: f64 = 4.0;
/// A point this near to a side, over the distance of points, is in the shape.
const ON_SIDE: f64 = 1e-9;
const AXES: [&str; 3] = ["x", "y", "z"];
/// Parts of a stress; the first four in the plane and along a line.
const STRESSES: [&str; 6] = ["xx", "yy", "zz", "xy", "yz", "xz"];

/// Share of the mean size of two particles within which the one stands on the other, along every axis.
const OVERLAP: f64 = 0.75;

/// The particles at the start.
#[derive(Default)]
pub(super) struct Seeds<const D: usize> {
    /// Places (m).
    pub(super) places: Vec<[f64; D]>,
    /// Volumes (m³; m² in the plane, m along a line).
    pub(super) volumes: Vec<f64>,
    /// Velocities (m/s).
    pub(super) velocities: Vec<[f64; D]>,
    /// Cauchy stresses (Pa), if a table has any.
    pub(super) stresses: Vec<SymmetricTensor>,
}

/// The particles, body by body and shape by shape, and where those of every body end; a point of two shapes is there once.
///
/// # Errors
/// A shape without a particle, off the grid or that can't be read; too many particles, or two at one place.
pub(super) fn seed<const D: usize>(
    source: &Source,
    form: &Form,
    grid: &Grid<D>,
    spacing: f64,
) -> Result<(Seeds<D>, Vec<usize>), Error> {
    let mut seeds = Seeds::default();
    let mut taken = HashMap::new();
    let shapes =
        || form.all_bodies().enumerate().flat_map(|(k, body)| body.get_ref().shapes.iter().map(move |s| (k, body, s)));
    let alone = shapes().count() == 1;
    let mut ends = vec![0; form.bodies.len() + 1];
    for (k, body, shape) in shapes() {
        let velocity = match &body.get_ref().velocity_m_s {
            Some(given) => vector(source, body, "velocity_m_s", given)?,
            None => [0.0; D],
        };
        let before = seeds.places.len();
        if let ShapeForm::Particles { file } = shape.get_ref() {
            read(source, shape, file, grid.h, &mut seeds)?;
            let (stressed, k0) = (seeds.stresses.len() > before, body.get_ref().k0.is_some());
            if stressed && (k0 || form.water.is_some()) {
                let said = "a table with stress is of ground without k0 and without [water]";
                return Err(source.at(shape, said));
            }
        } else {
            let form = Shape::<D>::of(source, shape, spacing)?;
            let room = MOST.saturating_sub(before);
            if form.points() > LOOKED_AT * MOST as f64 {
                return Err(too_many(source, shape));
            }
            for point in form.lattice() {
                let x = point.map(|k| (k as f64 + 0.5) * spacing);
                let holds = (form.holds)(&x);
                let first = if holds && !alone {
                    *taken.entry(point).or_insert((k, seeds.places.len()))
                } else {
                    (k, usize::MAX)
                };
                if holds && first.0 != k {
                    return Err(source.at(shape, format!("a particle of two bodies at {x:?} m")));
                }
                if holds && first.1 >= seeds.places.len() {
                    if seeds.places.len() - before >= room {
                        return Err(too_many(source, shape));
                    }
                    seeds.places.push(x);
                }
            }
        }
        let count = seeds.places.len();
        seeds.volumes.resize(count, spacing.powi(D as i32));
        seeds.velocities.resize(count, velocity);
        if !seeds.stresses.is_empty() {
            seeds.stresses.resize(count, SymmetricTensor::default());
        }
        if count == before {
            let said = format!("a shape without a particle: they stand {spacing} m apart");
            return Err(source.at(shape, said));
        }
        check_on_grid(source, shape, grid, &seeds.places[before..])?;
        ends[k] = count;
    }
    let table = shapes().map(|(.., shape)| shape).find(|shape| matches!(shape.get_ref(), ShapeForm::Particles { .. }));
    match table.and_then(|table| Some((table, overlapping(&seeds)?))) {
        None => Ok((seeds, ends)),
        Some((table, [j, k])) => {
            let [a, b] = [j, k].map(|k| seeds.places[k]);
            let said = format!("particles {j} and {k} of the bodies, counted from 0, overlap: at {a:?} and {b:?} m");
            Err(source.at(table, said))
        }
    }
}

/// Two particles of which one stands on the other.
fn overlapping<const D: usize>(seeds: &Seeds<D>) -> Option<[usize; 2]> {
    let size: Vec<f64> = seeds.volumes.iter().map(|volume| volume.powf(1.0 / D as f64)).collect();
    let largest = size.iter().copied().fold(0.0, f64::max);
    let mut bins: HashMap<[i64; D], Vec<usize>> = HashMap::new();
    for (k, x) in seeds.places.iter().enumerate() {
        let own = x.map(|x| (x / largest).floor() as i64);
        for beside in 0..3_usize.pow(D as u32) {
            let bin = std::array::from_fn(|a| own[a] + (beside / 3_usize.pow(a as u32) % 3) as i64 - 1);
            let near = |j: &&usize| {
                let apart = x.iter().zip(&seeds.places[**j]).map(|(x, y)| (x - y).abs());
                apart.fold(0.0, f64::max) < OVERLAP * 0.5 * (size[k] + size[**j])
            };
            if let Some(j) = bins.get(&bin).and_then(|bin| bin.iter().find(near)) {
                return Some([*j, k]);
            }
        }
        bins.entry(own).or_default().push(k);
    }
    None
}

/// Refuses a shape with a particle off the grid.
fn check_on_grid<const D: usize>(
    source: &Source,
    shape: &Line<ShapeForm>,
    grid: &Grid<D>,
    places: &[[f64; D]],
) -> Result<(), Error> {
    for (a, axis) in grid.axes.iter().enumerate() {
        let (lo, hi) = (axis.lo, axis.hi(grid.h));
        let off = places.iter().map(|x| x[a]).find(|x| *x < lo || *x > hi);
        if let Some(x) = off {
            let said = format!("a particle at {} = {x} m, off the grid, which reaches from {lo} to {hi} m", AXES[a]);
            return Err(source.at(shape, said));
        }
    }
    Ok(())
}

pub(super) fn too_many<T>(source: &Source, shape: &Line<T>) -> Error {
    let said = format!("more particles than the {MOST} that a scene may have");
    source.at(shape, said)
}

/// Components along the axes.
pub(super) fn vector<const D: usize, T>(
    source: &Source,
    at: &Line<T>,
    name: &str,
    given: &[Finite],
) -> Result<[f64; D], Error> {
    let numbers: Vec<f64> = given.iter().map(|x| x.0).collect();
    <[f64; D]>::try_from(numbers).map_err(|numbers| {
        let count = numbers.len();
        let said = format!("{name} has {count} numbers where {D} axes have one each");
        source.at(at, said)
    })
}

/// Lower and upper end (m) of a region along the axes.
pub(super) fn ends<const D: usize>(region: &Region) -> [[f64; 2]; D] {
    let all = [region.x_m, region.y_m, region.z_m];
    std::array::from_fn(|a| all[a].map_or([f64::NEG_INFINITY, f64::INFINITY], |ends| ends.0))
}

/// Whether a region, its sides with it, has a place (m).
pub(super) fn holds<const D: usize>(region: &Region) -> impl Fn(&[f64; D]) -> bool + use<D> {
    let ends = ends::<D>(region);
    move |x| x.iter().zip(&ends).all(|(x, [lo, hi])| lo <= x && x <= hi)
}

/// Whether a place (m) is in a shape.
type Holds<const D: usize> = Box<dyn Fn(&[f64; D]) -> bool>;

/// A shape, between two corners.
struct Shape<const D: usize> {
    /// Along the axes, the first whole number of its lattice points, the step to the next, and how many there are.
    rows: [(i64, i64, u64); D],
    /// Whether a point between the corners is in it.
    holds: Holds<D>,
}

impl<const D: usize> Shape<D> {
    fn of(source: &Source, at: &Line<ShapeForm>, spacing: f64) -> Result<Self, Error> {
        let margin = ON_SIDE * spacing;
        match at.get_ref() {
            ShapeForm::Box { from_m, to_m } => {
                let from = vector(source, at, "from_m", from_m)?;
                let to = vector(source, at, "to_m", to_m)?;
                Ok(Self::between(from, to, spacing, |_| true))
            }
            ShapeForm::Disc { centre_m, radius_m } => {
                let centre: [f64; D] = vector(source, at, "centre_m", centre_m)?;
                let (least, most) = (centre.map(|c| c - radius_m.0), centre.map(|c| c + radius_m.0));
                let square = (radius_m.0 + margin).powi(2);
                Ok(Self::between(least, most, spacing, move |x| {
                    let off = x.iter().zip(&centre).map(|(x, c)| (x - c) * (x - c));
                    off.sum::<f64>() <= square
                }))
            }
            ShapeForm::Polygon { corners_m, z_m } => {
                if D == 1 || z_m.is_some() != (D == 3) || corners_m.len() < 3 {
                    let said = "a polygon has three corners or more in the plane of x and y, and z_m where the grid \
                                has a third axis, nowhere else";
                    return Err(source.at(at, said));
                }
                let corners = corners_m.iter().map(|corner| vector::<2, _>(source, at, "a corner", corner));
                let corners = corners.collect::<Result<Vec<_>, _>>()?;
                if let Some([k, m]) = crossing(&corners) {
                    let said = format!(
                        "the polygon crosses itself: its side {} crosses its side {}, the first from its first corner to its second",
                        k + 1,
                        m + 1
                    );
                    return Err(source.at(at, said));
                }
                let z = z_m.map_or([0.0; 2], |Ends(ends)| ends);
                if z.iter().any(|end| !end.is_finite()) {
                    return Err(source.at(at, "z_m of a polygon without an end: two finite heights are allowed (m)"));
                }
                let end = |best: fn(f64, f64) -> f64, side: usize| {
                    std::array::from_fn(|a| match a {
                        2 => z[side],
                        _ => corners.iter().map(|c| c[a]).reduce(best).unwrap_or(0.0),
                    })
                };
                let (least, most) = (end(f64::min, 0), end(f64::max, 1));
                let polygon = Polygon::new(corners, margin);
                Ok(Self::between(least, most, spacing, move |x| polygon.holds([x[0], x[1]])))
            }
            ShapeForm::Particles { .. } => Ok(Self { rows: [(0, 1, 0); D], holds: Box::new(|_| false) }),
        }
    }

    /// Between two corners, in the order from the first to the second along each axis.
    fn between(from: [f64; D], to: [f64; D], spacing: f64, holds: impl Fn(&[f64; D]) -> bool + 'static) -> Self {
        let up = |x: f64| (x / spacing - 0.5 - ON_SIDE).ceil() as i64;
        let down = |x: f64| (x / spacing - 0.5 + ON_SIDE).floor() as i64;
        let row = |from: f64, to: f64| {
            let (least, most) = (up(from.min(to)), down(from.max(to)));
            let count = (most - least + 1).max(0) as u64;
            if from <= to { (least, 1, count) } else { (most, -1, count) }
        };
        Self { rows: std::array::from_fn(|a| row(from[a], to[a])), holds: Box::new(holds) }
    }

    fn points(&self) -> f64 {
        self.rows.iter().map(|(.., count)| *count as f64).product()
    }

    /// Its lattice points, the last axis fastest.
    fn lattice(&self) -> impl Iterator<Item = [i64; D]> + use<D> {
        let rows = self.rows;
        let all: u64 = rows.iter().map(|(.., count)| count).product();
        (0..all).map(move |mut place| {
            let mut k = [0; D];
            for a in (0..D).rev() {
                let (first, step, count) = rows[a];
                k[a] = first + step * (place % count) as i64;
                place /= count;
            }
            k
        })
    }
}

/// Adds the particles of a table. Without a volume they have that of the lattice, without a velocity that of the body,
/// without stress none.
fn read<const D: usize>(
    source: &Source,
    at: &Line<ShapeForm>,
    name: &str,
    h: f64,
    seeds: &mut Seeds<D>,
) -> Result<(), Error> {
    let path = source.beside(at, name)?;
    let table = Table::read_finite(&path)?;
    let places = AXES.map(|axis| format!("{axis} (m)"));
    let velocities = AXES.map(|axis| format!("velocity_{axis} (m/s)"));
    let volume = format!("volume ({})", ["m", "m²", "m³"][D - 1]);
    let stresses: Vec<String> = STRESSES.map(|part| format!("stress_{part} (Pa)")).into();
    let stresses = &stresses[..if D == 3 { 6 } else { 4 }];
    let known: Vec<&String> = places[..D].iter().chain(&velocities[..D]).chain([&volume]).chain(stresses).collect();
    let fault = |said: String| Err(Error::file(&path, said));
    if let Some((head, _)) = table.iter().find(|(head, _)| known.iter().all(|known| known != head)) {
        return fault(format!("column {head:?} where {known:?} are read"));
    }
    if let Some(lacks) = places[..D].iter().find(|head| table.get(head).is_none_or(<[f64]>::is_empty)) {
        return fault(format!("no column {lacks:?}, or no rows"));
    }
    if table.rows() > MOST {
        return Err(too_many(source, at));
    }
    let row =
        |heads: &[String; 3], k: usize| std::array::from_fn(|a| table.get(&heads[a]).map_or(0.0, |column| column[k]));
    seeds.places.extend((0..table.rows()).map(|k| row(&places, k)));
    if let Some(volumes) = table.get(&volume) {
        let most = h.powi(D as i32);
        if let Some(k) = volumes.iter().position(|v| *v <= 0.0 || *v > most) {
            return fault(format!(
                "{volume}, row {}: {} where at most that of a cell is allowed, {most}",
                k + 1,
                volumes[k]
            ));
        }
        seeds.volumes.extend(volumes);
    }
    if velocities.iter().any(|head| table.get(head).is_some()) {
        // Particles of shapes before this one have theirs already.
        seeds.velocities.extend((0..table.rows()).map(|k| row(&velocities, k)));
    }
    let given: Vec<Option<&[f64]>> = stresses.iter().map(|part| table.get(part)).collect();
    if let (Some(_), Some(lacks)) = (given.iter().flatten().next(), given.iter().position(Option::is_none)) {
        return fault(format!("no column {:?}, where there are other parts of the stress", stresses[lacks]));
    }
    let (before, stressed) = (seeds.places.len() - table.rows(), given[0].is_some());
    if stressed {
        seeds.stresses.resize(before, SymmetricTensor::default());
    }
    let part = |part: usize, k: usize| given.get(part).copied().flatten().map_or(0.0, |column| column[k]);
    seeds.stresses.extend((0..table.rows()).filter(|_| stressed).map(|k| {
        let [xx, yy, zz, xy, yz, xz] = std::array::from_fn(|own| part(own, k));
        SymmetricTensor { xx, yy, zz, xy, yz, xz }
    }));
    Ok(())
}
