//! Scenes of one's own: a file in TOML describes grid, body, law, what acts, solver and phases, and is run like a case.
//! Nothing is known of the answer, so nothing is judged but that the run ends and keeps its mass.
//!
//! The format: `docs/reference/scene-files.md`.

mod body;
mod fault;
mod form;
mod geostatic;
mod law;
mod made;
mod phase;
mod polygon;
mod setup;
mod shape;
mod watch;
mod weight;

#[cfg(test)]
mod tests;

use crate::case::Tier;
use crate::cases::prelude::*;
use crate::check::On;
use crate::files::{Mark, read_text};
use crate::problem::Driver;
use crate::size::Size;
use crate::verdict::Kind;
use fault::Source;
use form::{FORMAT, Form};
use setup::Setup;
use shape::Seeds;
use std::path::Path;
use std::sync::Mutex;
use watch::{Course, MASS};

/// Relative tolerance of the check of a run's mass: a sum of many terms rounds.
const ROUNDING: f64 = 1e-9;

/// A scene that a file describes.
pub struct SceneFile {
    /// It, as a case with one run.
    pub case: Case,
    /// Its run.
    pub spec: RunSpec,
    /// The title in the file.
    pub title: String,
    /// Bodies and steps made from the file, a line each: a wrong unit shows here.
    pub made: Vec<String>,
    /// Height of the body, along the last axis (m).
    pub height: f64,
}

impl SceneFile {
    /// Reads a file and divides the strengths in it by `weaker`. Names made from it live as long as the program, which reads few.
    ///
    /// # Errors
    /// The file can't be read, or makes no scene: the error names line and key; no strength is there to be divided; the
    /// scene is larger than `memory` (bytes), if that is known, and is not built.
    pub fn read(path: &Path, weaker: f64, memory: Option<f64>) -> Result<Self, Error> {
        let source = Source { path: path.to_path_buf(), text: read_text(path)?, weaker, memory };
        let form = source.form()?;
        let format = form.format.get_ref();
        if *format != FORMAT {
            let said = format!("format {format} where {FORMAT} is read");
            return Err(source.at(&form.format, said));
        }
        let title = form.title.clone();
        let dimension = form.grid.get_ref().cells.len();
        let h = form.grid.get_ref().cell_size_m.0;
        let open = match dimension {
            1 => open::<1>,
            2 => open::<2>,
            3 => open::<3>,
            _ => {
                let said = format!("cells has {dimension} numbers where 1 to 3 are allowed");
                return Err(source.at(&form.grid, said));
            }
        };
        let (found, begin) = open(source, form)?;
        let scheme = found.scheme;
        let level = Level { name: Box::leak(format!("{:08x}", found.mark).into_boxed_str()), h };
        Ok(Self {
            case: Case { size: Some(found.size), ..case(dimension, level, scheme, found.mass, begin) },
            spec: RunSpec { scheme, level, set: Vec::new(), perturbed: false },
            title,
            made: found.made,
            height: found.height,
        })
    }
}

/// Result of building a scene.
struct Found {
    scheme: Scheme,
    /// Mass (kg, kg/m in plane strain).
    mass: f64,
    /// A checksum of file and particles, by which a checkpoint tells its scene from others.
    mark: u32,
    made: Vec<String>,
    height: f64,
    size: Size,
}

/// Builds every phase once, so that what is wrong in the last one is said before the first; and what begins a run, the
/// first time by what is built here.
fn open<const D: usize>(source: Source, form: Form) -> Result<(Found, Begin), Error> {
    let setup = Setup::<D>::new(&source, form)?;
    let (mut mass, mut size) = (0.0, setup.size);
    for phase in &setup.phases {
        let run = setup.solve(phase).map_err(|e| setup.fault(&source, phase, &e))?;
        mass = run.totals().mass;
        (size.particles, size.nodes) = (run.particles().len() as f64, run.work().nodes as f64);
    }
    let mut all = source.text.clone().into_bytes();
    let Seeds { places, volumes, velocities } = &setup.seeds;
    let numbers = places.as_flattened().iter().chain(volumes).chain(velocities.as_flattened());
    all.extend(numbers.flat_map(|x| x.to_le_bytes()));
    all.extend(source.weaker.to_le_bytes());
    let (made, height) = (setup.made(), setup.reach()[D - 1]);
    let found = Found { scheme: setup.scheme, mass, mark: Mark::of(&all).checksum, made, height, size };
    let built = Mutex::new(Some(setup));
    let begin = move |spec: &RunSpec, values: &Parameters| {
        let made = match built.lock().ok().and_then(|mut built| built.take()) {
            Some(built) => built,
            None => Setup::<D>::new(&source, source.form()?)?,
        };
        let course = Course::new(crate::setup::Setup::new(spec, values, made))?;
        Ok(Box::new(Driver::new(course)?) as Box<dyn Job>)
    };
    Ok((found, Box::new(begin)))
}

/// The case of a scene in `dimension` dimensions whose bodies have a `mass` (kg).
fn case(dimension: usize, level: Level, scheme: Scheme, mass: f64, begin: Begin) -> Case {
    let why = "particles carry their mass: a sum of it rounds";
    let kept = move |r: &Record| vec![Finding::within(MASS, r.metric(MASS), mass, ROUNDING * mass, why)];
    let (statement, on) = ("The mass stays what it was.", On::Run(Box::new(kept)));
    Case {
        description: "What a scene file describes.",
        limits: vec!["Nothing is known of the answer, so nothing is judged."],
        levels: vec![level],
        plan: vec![Family { tier: Tier::Long, levels: vec![level], schemes: vec![scheme], set: Vec::new() }],
        checks: vec![Check { name: "mass", kind: Kind::Bookkeeping, statement, on }],
        watched: &["displacement_max", "kinetic_energy"],
        ..Case::begun_by("scene", "A scene of one's own", &watch::metrics_in(dimension), Vec::new(), begin)
    }
}
