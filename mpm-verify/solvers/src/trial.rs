//! A scene on trial: built as it is seen from elsewhere, run for some steps, and told in its own terms.
//!
//! Every case comes to its solver through this package, so that here is where any of them can be seen from elsewhere, without
//! its help. A trial is of the first solver that is asked for within it, on the thread that runs it.

mod told;

pub use told::{Column, Scales};

use crate::Built;
use mpm_core::{Error, Frame, Grid, Saved, Scene, Simulation, Work};
use std::cell::RefCell;
use std::ops::Range;

/// Where a scene is seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View {
    /// From where it is.
    Own,
    /// In a mirror: an axis points the other way.
    Mirrored(usize),
    /// Turned by a right angle, the first two axes into each other.
    Turned,
    /// Shifted by this number of cells along every axis.
    Cells(f64),
    /// Shifted by this distance (m) along every axis.
    Far(f64),
    /// In units in which a metre and a pascal have these values.
    Units(f64, f64),
}

impl View {
    /// The frame; none where the dimension has no such view.
    fn frame<const D: usize>(self, grid: &Grid<D>) -> Option<Frame<D>> {
        let own = Frame::own();
        match self {
            Self::Own => Some(own),
            Self::Mirrored(mirrored) => (mirrored < D)
                .then(|| Frame::along(std::array::from_fn(|axis| (axis, if axis == mirrored { -1.0 } else { 1.0 })))),
            Self::Turned => (D > 1).then(|| {
                Frame::along(std::array::from_fn(|axis| match axis {
                    0 => (1, -1.0),
                    1 => (0, 1.0),
                    _ => (axis, 1.0),
                }))
            }),
            Self::Cells(cells) => Some(own.shifted([cells * grid.h; D])),
            Self::Far(distance) => Some(own.shifted([distance; D])),
            Self::Units(length, stress) => Some(own.in_units(length, stress)),
        }
    }
}

/// How far a trial goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Until this number of pairs of particles and nodes or entries of factors has been worked on, or this number of
    /// steps.
    Until(u64, u64),
    /// This number of steps.
    Steps(u64),
}

/// Set-up of a trial.
#[derive(Debug, Clone)]
pub struct Trial {
    /// Where the scene is seen from.
    pub view: View,
    /// Whether the particles stand in another order.
    pub shuffled: bool,
    /// Whether domains are a little smaller, so that none ends on a grid line.
    pub shrunk: bool,
    /// The memory that it goes on from, of a run that stopped.
    pub from: Option<Saved>,
    /// How far it goes.
    pub length: Length,
}

/// Result of a trial, in the scene's own frame.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// All that can be asked of a simulation, particle by particle in seeding order.
    pub columns: Vec<Column>,
    /// Natural scales of the scene.
    pub scales: Scales,
    /// The condition of the matrix of equilibrium at the end; NaN of a solver without one.
    pub condition: f64,
    /// The greatest share of the loads that Newton's method left unbalanced in a step; zero without it.
    pub unbalanced: f64,
    /// Parts that its steps were cut into.
    pub parts: u32,
    /// Work, and all that the next step would remember.
    pub work: Work,
    /// Its memory.
    pub saved: Saved,
}

/// Nodes along an axis that a particle sees, of most functions.
const FEWEST_NODES: u64 = 3;
/// Factor of the size of a shrunk domain: more than 10⁶ m away rounding sets in, for any number of particles in a cell.
const SHRUNK: f64 = 1.0 - 1.0 / 1024.0;

/// A trial before and after it has met its scene.
enum Stage {
    Waiting(Trial),
    Over(Option<Result<Outcome, Error>>),
}

thread_local! {
    static TRIAL: RefCell<Option<Stage>> = const { RefCell::new(None) };
}

/// Runs a trial of the scene of the first solver that `begin` asks for. None if it asks for none, the scene can't be seen
/// so, for it has too few dimensions, or a step of it alone takes more than what the trial may.
///
/// # Errors
/// The scene is refused, or breaks down.
pub fn run<T>(trial: Trial, begin: impl FnOnce() -> T) -> Option<Result<Outcome, Error>> {
    TRIAL.with_borrow_mut(|stage| *stage = Some(Stage::Waiting(trial)));
    drop(begin());
    match TRIAL.take() {
        Some(Stage::Over(outcome)) => outcome,
        Some(Stage::Waiting(_)) | None => None,
    }
}

/// The solver that `build` makes of `scene`, or, on trial, of what is seen of it, after the trial.
pub(crate) fn built<const D: usize>(
    scene: Scene<D>,
    build: impl FnOnce(Scene<D>, Option<&Frame<D>>) -> Built<D>,
) -> Built<D> {
    let stage = TRIAL.take();
    let Some(Stage::Waiting(trial)) = stage else {
        TRIAL.set(stage);
        return build(scene, None);
    };
    let pairs = scene.bodies.particles.len() as u64 * FEWEST_NODES.pow(D as u32);
    let too_large = matches!(trial.length, Length::Until(most, _) if pairs > most);
    let frame = trial.view.frame(&scene.grid);
    let Some(frame) = frame.filter(|_| !too_large) else {
        TRIAL.set(Some(Stage::Over(None)));
        return build(scene, None);
    };
    let (outcome, built) = match tried(&trial, scene, &frame, build) {
        Ok((outcome, solver)) => (Ok(outcome), Ok(solver)),
        Err(error) => (Err(error.clone()), Err(error)),
    };
    TRIAL.set(Some(Stage::Over(Some(outcome))));
    built
}

type Tried<const D: usize> = (Outcome, Box<dyn Simulation<D>>);

fn tried<const D: usize>(
    trial: &Trial,
    scene: Scene<D>,
    frame: &Frame<D>,
    build: impl FnOnce(Scene<D>, Option<&Frame<D>>) -> Built<D>,
) -> Result<Tried<D>, Error> {
    let grid = scene.grid;
    let mut seen = match trial.view {
        View::Own => scene,
        _ => scene.seen_from(frame)?,
    };
    if trial.shrunk {
        let sizes = &mut seen.bodies.particles.half_size;
        *sizes = sizes.map(|half| SHRUNK * half);
    }
    if trial.shuffled {
        let of_body = |range: Range<usize>| shuffled(range.len()).into_iter().map(move |k| range.start as u32 + k);
        let order: Vec<u32> = seen.bodies.each.iter().flat_map(|body| of_body(body.range())).collect();
        seen.bodies.permute(&order);
    }
    let scales = Scales::of(&seen, frame);
    let mut run = build(seen, (trial.view != View::Own).then_some(frame))?;
    if let Some(saved) = &trial.from {
        run.restore(saved)?;
    }
    let begun = run.work().steps;
    let (mut unbalanced, mut parts) = (0.0_f64, 0);
    loop {
        run.step()?;
        if let Some(convergence) = run.convergence() {
            unbalanced = unbalanced.max(*convergence.residuals.last().unwrap_or(&0.0));
            parts += convergence.parts;
        }
        let work = run.work();
        let steps = work.steps - begun;
        let over = match trial.length {
            Length::Until(most, most_steps) => {
                let done = work.particle_node_pairs + work.nonzeros;
                done + done / steps > most || steps >= most_steps
            }
            Length::Steps(count) => steps >= count,
        };
        if over {
            break;
        }
    }
    let outcome = Outcome {
        columns: told::columns(run.as_mut(), frame, &grid),
        scales,
        condition: run.condition(),
        unbalanced,
        parts,
        work: run.work(),
        saved: run.save()?,
    };
    Ok((outcome, run))
}

/// An order that puts far what is near: multiples of a number that has no divisor in common with the count.
fn shuffled(count: usize) -> Vec<u32> {
    let divisor = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let golden = (count as f64 * 0.618) as usize;
    let stride = (golden.max(1)..).find(|stride| divisor(*stride, count) == 1);
    let stride = stride.unwrap_or(1);
    (0..count).map(|k| (k * stride % count) as u32).collect()
}
