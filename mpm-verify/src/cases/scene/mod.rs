//! Scenes of one's own: a file in TOML describes grid, body, law, what acts, solver and phases, and is run like a case.
//! Nothing is known of the answer, so nothing is judged but that the run ends and keeps its mass.
//!
//! The format: `docs/reference/scene-files.md`.

mod amplitude;
mod around;
mod balance;
mod body;
mod checks;
mod contact;
mod defaults;
mod fault;
mod form;
mod geostatic;
mod law;
mod loads;
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
use crate::error::one_line;
use crate::files::read_text;
use crate::job::Column;
use crate::problem::Driver;
use checks::checks;
use fault::Source;
use form::{Courant, FORMAT, Form};
use setup::Setup;
use shape::Seeds;
use std::path::Path;
use std::sync::Mutex;
use watch::Course;
pub(super) use watch::ENERGY;

/// A scene that a file describes.
pub struct SceneFile {
    /// It, as a case with one run, whose title is that of the file.
    pub case: Case,
    /// Its run.
    pub spec: RunSpec,
    /// Bodies and steps made from the file, a line each: a wrong unit shows here.
    pub made: Vec<String>,
    /// Whether it keeps snapshots of particles in the plane, which show its motion.
    pub moves: bool,
    /// Height of the surface of its bodies over its lowest place (m).
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
        setup.keep_first(run);
    }
    let mut sum = crc32fast::Hasher::new();
    sum.update(source.text.as_bytes());
    let Seeds { places, volumes, velocities, stresses } = &setup.seeds;
    let parts = stresses.iter().flat_map(|s| [s.xx, s.yy, s.zz, s.xy, s.yz, s.xz]);
    let numbers = places.as_flattened().iter().chain(volumes).chain(velocities.as_flattened()).copied().chain(parts);
    sum.update(format!("{:?}", setup.amplitudes).as_bytes());
    numbers.chain([source.weaker]).for_each(|x| sum.update(&x.to_le_bytes()));
    let files = setup.surfaces.iter().flatten().map(|(_, file)| *file).filter(|file| *file != 0);
    files.for_each(|file| sum.update(&file.to_le_bytes()));
    // A checksum of file, amplitudes, particles and surfaces, by which a checkpoint tells its scene from others.
    let level = Level { name: lasting(format!("{:08x}", sum.finalize())), h: setup.grid.h };
    let (scheme, made, height, weight) = (setup.scheme, setup.made(), setup.relief(), setup.weight());
    let title = lasting(one_line(&setup.form.title));
    let watched = watch::watched(&setup);
    let moves = D == 2 && setup.form.output.get_ref().snapshot_rows.is_some();
    let scenery = setup.scenery(title).map_err(|e| Error::file(&source.path, e))?;
    let unbalanced = setup.unbalanced();
    let built = Mutex::new(Some(setup));
    let begin: Begin = Box::new(move |spec: &RunSpec, values: &Parameters| {
        let made = match built.lock().ok().and_then(|mut built| built.take()) {
            Some(built) => built,
            None => Setup::<D>::new(&source, source.form()?)?,
        };
        let course = Course::new(crate::setup::Setup::new(spec, values, made))?;
        Ok(Box::new(Driver::new(course)?) as Box<dyn Job>)
    });
    let checks = checks(mass, weight, unbalanced);
    let case = Case {
        description: lasting(made.join("\n")),
        limits: vec!["Nothing is known of the answer, so nothing is judged."],
        levels: vec![level],
        plan: vec![Family { tier: Tier::Long, levels: vec![level], schemes: vec![scheme], set: Vec::new() }],
        checks,
        watched: Box::leak(watched.into_boxed_slice()),
        size: Some(size),
        scenery: Some(scenery),
        ..Case::begun_by("scene", title, &watch::metrics_in(D), Vec::new(), begin)
    };
    Ok(SceneFile { case, spec: RunSpec { scheme, level, set: Vec::new(), perturbed: false }, made, moves, height })
}

/// The CFL number of a scene whose own scheme is not explicit.
const CFL: f64 = 0.3;

/// The measures that a case takes of a run: of the last rows of its phases, and of its particles at the end.
pub(super) type Measure = Box<dyn Fn(&[Row], &[Column]) -> Vec<(Metric, f64)> + Send>;

/// Begins a run of a shipped scene in the plane, by the scheme of `spec` and with cells larger by a `ratio`.
pub(super) fn begin(
    text: &str,
    ratio: f64,
    spec: &RunSpec,
    values: &Parameters,
    measure: Measure,
) -> Result<Box<dyn Job>, Error> {
    let source = Source { path: "scene".into(), text: text.to_owned(), weaker: 1.0, memory: None };
    let mut form = source.form()?;
    let grid = form.grid.as_mut();
    grid.cell_size_m.0 *= ratio;
    grid.cells.iter_mut().for_each(|cells| cells.0 = (f64::from(cells.0) / ratio).round() as u32);
    form.contacts.iter_mut().for_each(|contact| contact.as_mut().reach_m.0 *= ratio);
    let (solver, row) = (form.solver.as_mut(), form.output.get_ref().row_s);
    solver.scheme = spec.scheme.to_string();
    // A scheme of another kind than the scene's has another step.
    match spec.scheme {
        Scheme::Explicit(_) => {
            (solver.time_step_s, solver.tolerance) = (None, None);
            solver.cfl.get_or_insert(Courant(CFL));
        }
        _ => {
            solver.cfl = None;
            solver.time_step_s.get_or_insert(row);
        }
    }
    match form.grid.get_ref().cells.len() {
        3 => measured::<3>(&source, form, (spec, values), measure),
        _ => measured::<2>(&source, form, (spec, values), measure),
    }
}

fn measured<const D: usize>(
    source: &Source,
    form: Form,
    (spec, values): (&RunSpec, &Parameters),
    measure: Measure,
) -> Result<Box<dyn Job>, Error> {
    let made = crate::setup::Setup::new(spec, values, Setup::<D>::new(source, form)?);
    Ok(Box::new(Driver::new(Course::new(made)?.measured(measure))?))
}

/// A text that lives as long as the program, which reads few scenes.
fn lasting(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}
