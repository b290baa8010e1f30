//! Scenes of one's own: a file in TOML describes grid, body, law, what acts, solver and phases, and is run like a case.
//! Nothing is known of the answer, so nothing is judged but that the run ends and keeps its mass.
//!
//! The format: `docs/reference/scene-files.md`.

mod around;
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
use crate::error::one_line;
use crate::files::{Mark, read_text};
use crate::problem::Driver;
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
    /// It, as a case with one run, whose title is that of the file.
    pub case: Case,
    /// Its run.
    pub spec: RunSpec,
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
        match form.grid.get_ref().cells.len() {
            1 => open::<1>(source, form),
            2 => open::<2>(source, form),
            3 => open::<3>(source, form),
            dimension => {
                let said = format!("cells has {dimension} numbers where 1 to 3 are allowed");
                Err(source.at(&form.grid, said))
            }
        }
    }
}

/// Builds every phase once, so that what is wrong in the last one is said before the first; and what begins a run, the
/// first time by what is built here.
fn open<const D: usize>(source: Source, form: Form) -> Result<SceneFile, Error> {
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
    // A checksum of file and particles, by which a checkpoint tells its scene from others.
    let level = Level { name: lasting(format!("{:08x}", Mark::of(&all).checksum)), h: setup.grid.h };
    let (scheme, made, height, around) = (setup.scheme, setup.made(), setup.reach()[D - 1], setup.around());
    let duration: f64 = setup.form.phases.iter().map(|phase| phase.get_ref().duration_s.0).sum();
    let title = lasting(one_line(&setup.form.title));
    let last = setup.phases.last().map_or("", |phase| &phase.name);
    let heading = format!("{title}: {last}, t = {} s", (1e6 * duration).round() / 1e6);
    let built = Mutex::new(Some(setup));
    let begin: Begin = Box::new(move |spec: &RunSpec, values: &Parameters| {
        let made = match built.lock().ok().and_then(|mut built| built.take()) {
            Some(built) => built,
            None => Setup::<D>::new(&source, source.form()?)?,
        };
        let course = Course::new(crate::setup::Setup::new(spec, values, made))?;
        Ok(Box::new(Driver::new(course)?) as Box<dyn Job>)
    });
    let why = "particles carry their mass: a sum of it rounds";
    let kept = move |r: &Record| vec![Finding::within(MASS, r.metric(MASS), mass, ROUNDING * mass, why)];
    let (statement, on) = ("The mass stays what it was.", On::Run(Box::new(kept)));
    let case = Case {
        description: "What a scene file describes.",
        limits: vec!["Nothing is known of the answer, so nothing is judged."],
        levels: vec![level],
        plan: vec![Family { tier: Tier::Long, levels: vec![level], schemes: vec![scheme], set: Vec::new() }],
        checks: vec![Check { name: "mass", kind: Kind::Bookkeeping, statement, on }],
        watched: &["displacement_max", "kinetic_energy"],
        size: Some(size),
        heading,
        around,
        ..Case::begun_by("scene", title, &watch::metrics_in(D), Vec::new(), begin)
    };
    Ok(SceneFile { case, spec: RunSpec { scheme, level, set: Vec::new(), perturbed: false }, made, height })
}

/// A text that lives as long as the program, which reads few scenes.
fn lasting(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}
