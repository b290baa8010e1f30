//! The commands `run` and `scene`: one run, begun or resumed.

use super::verify::make_and_report;
use super::*;
use crate::progress::{Teller, so_far};
use mpm_verify::cases::scene::SceneFile;
use mpm_verify::error::one_line;
use mpm_verify::files::{read_text, write_whole};
use mpm_verify::parameter::Parameters;
use mpm_verify::report::single;
use mpm_verify::run::checkpoint::Identity;
use mpm_verify::run::size::available_memory;
use mpm_verify::run::{RECORD, require_tables};
use mpm_verify::scheme::{RemedyName, TransferName};
use mpm_verify::size::Size;
use mpm_verify::study::found::own_record;
use mpm_verify::study::judge::{judge, judged_run};

#[derive(Args)]
pub(crate) struct Run {
    /// Name of the case
    #[arg(value_parser = case(), hide_possible_values = true)]
    case: &'static Case,
    /// Full name of the scheme, as in `explain` and records (replaces its parts); several between commas make a sweep
    #[arg(long, value_parser = Schemes, hide_possible_values = true, value_delimiter = ',',
            conflicts_with_all = ["solver", "basis", "remedy", "transfer"])]
    scheme: Vec<Scheme>,
    /// Solver (default: explicit, if the case has it)
    #[arg(long, value_parser = Scheme::SOLVERS.to_vec())]
    solver: Option<String>,
    /// Basis functions (default: gimp, or those of the case's first scheme with that solver)
    #[arg(long, value_parser = one_of(BasisName::NAMES, BasisName::parse))]
    basis: Option<BasisName>,
    /// Locking remedy (default: fbar-consistent, or that of the case's first scheme with that solver)
    #[arg(long, value_parser = one_of(RemedyName::NAMES, RemedyName::parse))]
    remedy: Option<RemedyName>,
    /// Transfer of an explicit run (default: flip)
    #[arg(long, value_parser = one_of(TransferName::NAMES, TransferName::parse))]
    transfer: Option<TransferName>,
    /// Level of refinement (default: the coarsest); several between commas make a sweep, with orders in its report
    #[arg(long, value_delimiter = ',')]
    level: Vec<String>,
    /// Value of a parameter, in place of its default
    #[arg(long = "set", value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Perturb every initial coordinate by one unit in the last place
    #[arg(long)]
    perturb: bool,
    #[command(flatten)]
    pub(super) making: Making,
}

impl Run {
    pub(super) fn execute(self) -> Result<ExitCode, Error> {
        let case = self.case;
        let parts = if self.scheme.is_empty() { vec![self.scheme_of_parts()?] } else { Vec::new() };
        let schemes = [self.scheme, parts].concat();
        let coarsest = self.level.is_empty().then_some(Ok(case.levels[0]));
        let levels = coarsest.into_iter().chain(self.level.iter().map(|name| find_level(case, name)));
        let levels = levels.collect::<Result<Vec<_>, _>>()?;
        schemes.iter().try_for_each(|scheme| require_offered(case, *scheme))?;
        if let ([scheme], [level]) = (&schemes[..], &levels[..]) {
            let spec = RunSpec { scheme: *scheme, level: *level, set: self.set, perturbed: self.perturb };
            return self.making.run(case, &spec);
        }
        let Some(out) = self.making.folder().filter(|_| !self.perturb) else {
            return Err(Error::Input("several runs need --out DIR for their report, and are not perturbed".to_owned()));
        };
        Parameters::new(&case.parameters, &self.set)?;
        let plan = Plan::sweep(case, &schemes, &levels, &self.set)?;
        let making = &self.making;
        let saving = saving(making.checkpoint_every, making.resume.is_some());
        make_and_report(&plan, (out, Files::All), saving, making.threads, &golden::place(None), making.told)
    }

    /// The scheme of the given parts, with the case's defaults for the others.
    fn scheme_of_parts(&self) -> Result<Scheme, Error> {
        let own = self.case.default_scheme(self.solver.as_deref());
        let solver = self.solver.as_deref().unwrap_or(own.solver());
        let usual = if solver == own.solver() { own.transfer() } else { TransferName::None };
        let remedy = match solver {
            "poro" => RemedyName::None,
            _ => own.remedy(),
        };
        Ok(Scheme::of_parts(
            solver,
            self.basis.unwrap_or(own.basis()),
            self.remedy.unwrap_or(remedy),
            self.transfer.unwrap_or(usual),
        )?)
    }
}

/// Folder, threads and memory of a run, and its verbosity.
#[derive(Args)]
pub(crate) struct Making {
    /// Output folder for record, series, particles, VTU and pictures
    #[arg(long, group = "folder")]
    out: Option<PathBuf>,
    /// Resume from this folder's checkpoint, or start; bit-identical results (replaces --out)
    #[arg(long, value_name = "DIR", group = "folder")]
    resume: Option<PathBuf>,
    /// Checkpoint interval in wall-clock seconds (0: after every row of the series)
    #[arg(long, value_name = "SECONDS", default_value_t = checkpoint::EVERY_S, requires = "folder")]
    checkpoint_every: u64,
    /// Number of threads (default: all cores)
    #[arg(long, value_parser = threads())]
    pub(super) threads: Option<usize>,
    /// Memory limit of the scene at its start, in GiB (default: the available memory)
    #[arg(long, value_name = "GIB", value_parser = memory)]
    memory: Option<f64>,
    #[command(flatten)]
    told: Told,
    /// Whether the motion is drawn as well.
    #[arg(skip)]
    animated: bool,
}

impl Making {
    /// The folder of results, if there is one.
    pub(super) fn folder(&self) -> Option<&Path> {
        self.resume.as_deref().or(self.out.as_deref())
    }

    /// Makes `spec` of `case` and prints its results.
    fn run(&self, case: &Case, spec: &RunSpec) -> Result<ExitCode, Error> {
        let record = self.make(case, spec, self.folder())?;
        tell(case, &record, self.told)?;
        Ok(exit_code(&record))
    }

    /// Makes `spec` of `case` in a folder, if there is one.
    pub(super) fn make(&self, case: &Case, spec: &RunSpec, folder: Option<&Path>) -> Result<Record, Error> {
        let saving = saving(self.checkpoint_every, self.resume.is_some());
        let place = folder.map(|folder| (folder, saving, self.animated));
        run_one(case, spec, place, (or_all_cores(self.threads), self.memory()), self.told)
    }

    /// Memory that a scene may have (bytes), if the machine tells.
    pub(super) fn memory(&self) -> Option<f64> {
        self.memory.map(|gib| gib * GIBIBYTE).or_else(available_memory)
    }
}

/// Copy of a scene file beside its results, and the same with every key that it leaves out.
const AS_RUN: &str = "scene-as-run.toml";
const FILLED: &str = "scene-filled.toml";

#[derive(Args)]
pub(crate) struct Scene {
    /// Scene file in TOML: docs/reference/scene-files.md
    file: PathBuf,
    /// Draw the snapshots one after the other as an animated PNG; the file has snapshot_rows
    #[arg(long, requires = "folder")]
    animate: bool,
    #[command(flatten)]
    pub(super) making: Making,
}

impl Scene {
    pub(super) fn execute(mut self) -> Result<ExitCode, Error> {
        // Asked once: what the scene takes is missing afterwards.
        let memory = self.making.memory();
        self.making.memory = memory.map(|bytes| bytes / GIBIBYTE);
        let scene = SceneFile::read(&self.file, 1.0, memory)?;
        if self.animate && !scene.moves {
            let cause = "--animate: snapshot_rows in [output] of a scene in the plane is needed";
            return Err(Error::file(&self.file, cause));
        }
        self.making.animated = self.animate;
        if self.making.told.progress() {
            say(format!("{}\n", scene.case.title))?;
            for line in &scene.made {
                say(format!("{line}\n"))?;
            }
        }
        let text = read_text(&self.file)?;
        let code = self.making.run(&scene.case, &scene.spec)?;
        if let Some(folder) = self.making.folder() {
            write_whole(&folder.join(AS_RUN), text.as_bytes())?;
            let filled = scene.case.scenery.as_ref().map_or("", |scenery| &scenery.filled);
            write_whole(&folder.join(FILLED), filled.as_bytes())?;
        }
        Ok(code)
    }
}

/// Refuses a scheme that a case does not offer.
fn require_offered(case: &Case, scheme: Scheme) -> Result<(), Error> {
    let offered = case.schemes();
    if offered.contains(&scheme.of_the_family()) {
        return Ok(());
    }
    let names: Vec<String> = offered.iter().map(Scheme::to_string).collect();
    let what = format!("scheme of {}", case.name);
    Err(Error::unknown(&what, &scheme.to_string(), names.iter().map(String::as_str)))
}

/// Runs `spec` of `case` on `threads` threads within `memory` (bytes), if that is known, draws it into its folder, if it has
/// one, and prints its size and progress.
fn run_one(
    case: &Case,
    spec: &RunSpec,
    place: Option<(&Path, Saving, bool)>,
    (threads, memory): (usize, Option<f64>),
    told: Told,
) -> Result<Record, Error> {
    if let Some((folder, ..)) = place {
        // A run leaves one of these, also if it is killed.
        let traces = [RECORD, checkpoint::FILE, ".mpm-verify", ".mpm-verify.lock"].map(|file| folder.join(file));
        let files = ["series.csv", "particles.csv", "particles.vtu", AS_RUN, FILLED].map(|file| folder.join(file));
        let in_the_way = files.iter().find(|file| {
            // A link is replaced, and what it leads to stays.
            file.is_file() && !file.is_symlink() && !traces.iter().any(|trace| trace.exists())
        });
        if let Some(file) = in_the_way {
            return Err(Error::file(file, "in the way, and not of a run of this program: name another folder"));
        }
    }
    let held = place.map(|(folder, ..)| hold(folder)).transpose()?;
    if let Some((folder, Saving { resume: true, .. }, animated)) = place {
        if let Some(record) = ended(case, spec, folder, told)? {
            checkpoint::discard(folder)?;
            // A run may have been killed between its record and its pictures.
            single::draw(case, &record, folder, animated)?;
            if told.progress() {
                say("The run is already complete; nothing to resume.\n\n")?;
            }
            return Ok(record);
        }
        if !folder.join(checkpoint::FILE).exists() && told.progress() {
            say(format!("{}: no checkpoint; the run begins.\n", folder.display()))?;
        }
    }
    let size = Size::of(case, spec)?;
    size.require(memory, spec)?;
    if told.progress() {
        say(format!("{size}.\n"))?;
    }
    if let Some((folder, ..)) = place {
        discard_report(folder)?;
    }
    let name = format!("{} {}", case.name, spec.folder());
    let teller = Teller::new(&name, told.progress());
    let kept = place.map(|(folder, saving, _)| (folder, saving));
    let record = judged_run(case, spec, kept, threads, &|now| teller.hear(|seconds| so_far(now, seconds)))?;
    if let Some((folder, _, animated)) = place {
        let pictures = single::draw(case, &record, folder, animated)?;
        if told.progress() {
            let names = pictures.iter().map(|p| folder.join(&p.file).display().to_string());
            say(names.map(|name| format!("Picture: {name}\n")).collect::<String>())?;
            say(format!("Page: {}\n", folder.join("index.html").display()))?;
        }
    } else if told.progress() {
        say("No files written; use --out DIR to keep results and pictures.\n")?;
    }
    drop(held);
    Ok(record)
}

fn tell(case: &Case, record: &Record, told: Told) -> Result<(), Error> {
    match told {
        Told { json: true, .. } => say_json(record),
        Told { quiet: true, .. } => say(describe::run_line(record)),
        _ => say(describe::record(case, record)),
    }
}

/// The record of this very run in a folder, judged again, or `None` if it has not ended there. If its tables differ
/// from those the run wrote, this is reported and the run made again.
fn ended(case: &Case, spec: &RunSpec, folder: &Path, told: Told) -> Result<Option<Record>, Error> {
    let Some(mut record) = own_record(folder, case, spec)? else { return Ok(None) };
    let path = folder.join(RECORD);
    let asked = Identity::of(case, spec, &Parameters::new(&case.parameters, &spec.set)?);
    asked.require(&Identity::of_record(&record)).map_err(|refusal| refusal.of(&path))?;
    if let Err(damage) = require_tables(&record, folder) {
        if told.progress() {
            say(format!("{}; the run is made again.\n", one_line(&damage.to_string())))?;
        }
        return Ok(None);
    }
    record.verdicts = judge(case, &record);
    Ok(Some(record))
}
