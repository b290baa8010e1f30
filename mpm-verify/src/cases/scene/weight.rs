//! Size of a scene from its own numbers, before anything is built.

use super::fault::Source;
use super::form::{Ends, Form, ShapeForm};
use super::shape::{MOST, too_many};
use crate::cases::prelude::*;
use crate::size::Size;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// Bytes of an entry of a matrix: its value and its place, once in the elements and once in the matrix.
const ENTRY: f64 = 48.0;

/// Memory that the machine gives, over that in use at once: memory that is given back is kept.
const KEPT: f64 = 1.3;
/// Copies of the bytes of a body while it is handed over.
const HANDED: f64 = 2.0;

/// Length, area or volume of a shape in `dimension` dimensions (m, m², m³); zero of a table, whose rows are its particles.
fn measure(shape: &ShapeForm, dimension: usize) -> f64 {
    match shape {
        ShapeForm::Box { from_m, to_m } => from_m.iter().zip(to_m).map(|(from, to)| (to.0 - from.0).abs()).product(),
        ShapeForm::Disc { radius_m: r, .. } => {
            [2.0 * r.0, PI * r.0.powi(2), 4.0 / 3.0 * PI * r.0.powi(3)][dimension - 1]
        }
        ShapeForm::Polygon { corners_m, z_m } => {
            let next = corners_m.iter().cycle().skip(1);
            let twice = corners_m.iter().zip(next).map(|(a, b)| match (&a[..], &b[..]) {
                ([ax, ay, ..], [bx, by, ..]) => ax.0 * by.0 - bx.0 * ay.0,
                _ => 0.0,
            });
            0.5 * twice.sum::<f64>().abs() * z_m.map_or(1.0, |Ends([lo, hi])| (hi - lo).abs())
        }
        ShapeForm::Particles { .. } => 0.0,
    }
}

/// Rows of a table, whose lines are counted and not kept; none of what is no plain file, which its reader refuses.
fn rows(path: &Path) -> Result<f64, Error> {
    let (fault, mut count) = (|e| Error::file(path, e), 0);
    if !path.symlink_metadata().is_ok_and(|about| about.is_file()) {
        return Ok(0.0);
    }
    let mut file = BufReader::new(File::open(path).map_err(fault)?);
    loop {
        let read = file.fill_buf().map_err(fault)?;
        let bytes = read.len();
        if bytes == 0 {
            return Ok(count as f64);
        }
        count += read.iter().filter(|byte| **byte == b'\n').count();
        file.consume(bytes);
    }
}

/// Size of the bodies of particles `spacing` (m) apart on a grid, with what `scheme` keeps for it.
///
/// # Errors
/// A shape has more particles than a scene may have.
pub(super) fn weigh<const D: usize>(
    source: &Source,
    form: &Form,
    grid: &Grid<D>,
    spacing: f64,
    scheme: Scheme,
) -> Result<Size, Error> {
    let mut particles = 0.0;
    for shape in form.all_bodies().flat_map(|body| &body.get_ref().shapes) {
        let count = match shape.get_ref() {
            ShapeForm::Particles { file } => rows(&source.beside(shape, file)?)?,
            form => measure(form, D) / spacing.powi(D as i32),
        };
        if count > MOST as f64 {
            return Err(too_many(source, shape));
        }
        particles += count;
    }
    let nodes: f64 = grid.axes.iter().map(|axis| (axis.cells + scheme.basis().degree()) as f64).product();
    let (vectors, matrices) = (8.0 * D as f64, 8.0 * (D * D) as f64);
    // A second phase is made beside the first, whose body is handed over as bytes.
    let phases = form.phases.len().min(2) as f64;
    let handed = (phases - 1.0) * particles * HANDED * (200.0 + 5.0 * vectors + matrices);
    let bytes = match scheme {
        // Columns, the seeds, and what sorting holds twice.
        Scheme::Explicit(_) => phases * (particles * (220.0 + 10.0 * vectors + matrices) + nodes * 160.0),
        Scheme::Implicit(_) | Scheme::Poro(_) => {
            let seen = ((scheme.basis().degree() + 1) as f64).powi(D as i32);
            let beside = ((2 * scheme.basis().degree() + 1) as f64).powi(D as i32);
            let unknown = nodes.min(2.0 * particles);
            let of_particle = 400.0 + 12.0 * vectors + matrices * matrices / 8.0 + seen * (16.0 + vectors);
            // Operators of averages and of water beside that of the solid, and work arrays of the solution.
            let operators = if scheme.remedy() == RemedyName::None && form.water.is_none() { 1.5 } else { 2.6 };
            operators * phases * (particles * of_particle + nodes * 200.0 + unknown * beside * matrices / 8.0 * ENTRY)
        }
    };
    Ok(Size { particles, nodes, bytes: KEPT * (bytes + handed), worked_out: true })
}
