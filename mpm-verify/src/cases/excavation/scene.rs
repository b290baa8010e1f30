//! The scenes of the excavation: ground, base, rollers, and the order in which one takes over from another.

use super::parameters::{
    BASE, CFL, CREST, CUT, DURATION, FRICTION, FRICTIONAL, GHOST, GRAVITY, JAUMANN, LAW,
    LOAD_STEPS, PEAK, POISSON_RATIO, PPC_PER_DIRECTION, RESIDUAL, SOFTENING, STEP, UNIT_WEIGHT,
    YOUNG_MODULUS,
};
use crate::cases::observe::implicit_settings;
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
use mpm_core::implicit::{Settings, Stabilisation, TimeRule};
use mpm_core::material::{HenckyJ2, HypoelasticJ2, JaumannUpdate, Law, Strength};
use mpm_core::stage::{End, Gravity, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::{Solved, implicit};
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;

/// Height (m) of the slope, and its run, at 45°.
pub(super) const HEIGHT: f64 = 1.0;
/// Acceleration of gravity (m/s²), which makes a mass of the paper's unit weight.
pub(super) const GRAVITATION: f64 = 9.81;
/// Room beyond the toe (m), and cells above the crest and below a base with friction.
const ROOM: f64 = 4.0;
const MARGIN: usize = 4;
/// Reach d̂ of the base's barrier over the cell size: that of the lowest particles of four a cell.
const REACH: f64 = 0.25;
/// Share of its reach by which the barrier gives way under the full height.
const GIVES_WAY: f64 = 0.1;
/// Time (s) between two rows after the excavation, of which there is one at least, as nearly as they fit.
const ROW: f64 = 0.05;

/// Places of the constraints in the scene's list; a base with friction is the first contact instead.
pub(super) const ROLLERS: usize = 0;
pub(super) const HELD_BASE: usize = 1;

/// What comes after what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Phase {
    /// Gravity rises on the whole slope; equilibrium in every step.
    Gravity,
    /// What found none goes on moving under full gravity, uncut.
    Settling,
    /// The wedge at the toe is gone: equilibrium again, of the scheme that knows no other.
    Cut,
    /// The wedge is gone: motion.
    Collapse,
    /// Nothing comes any more.
    Over,
}

impl Phase {
    /// Whether the wedge at the toe is there.
    pub(super) fn is_whole(self) -> bool {
        matches!(self, Self::Gravity | Self::Settling)
    }

    /// Whether velocities exist.
    pub(super) fn moves(self) -> bool {
        matches!(self, Self::Settling | Self::Collapse)
    }
}

/// The ground in particles.
pub(super) struct Ground {
    h: f64,
    spacing: f64,
    /// Places (m); the wedge that will be cut away comes last.
    places: Vec<[f64; 2]>,
    /// Of the particles on the face, half a one each, their places in the list.
    halves: Vec<usize>,
    /// Particles that stay.
    kept: usize,
}

impl Ground {
    /// On cells of size `h` (m).
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Self {
        let h = spec.level.h;
        let number = |p| parameters.number(p);
        let spacing = h / number(PPC_PER_DIRECTION);
        let (toe, cut) = (number(CREST) + HEIGHT, number(CUT));
        let [across, up] = [toe, HEIGHT].map(|l| (l / spacing).round() as usize);
        let rows = (0..across).flat_map(|i| (0..up).map(move |j| (i, j)));
        // Centres on the face have i + j + 1 = `across`.
        let inside = rows.filter(|(i, j)| i + j < across);
        let foot = ((toe - cut) / spacing).round() as usize;
        let (kept, wedge): (Vec<_>, Vec<_>) = inside.partition(|(i, _)| *i < foot);
        let all = [kept.as_slice(), wedge.as_slice()].concat();
        let on_face = |(k, (i, j)): (usize, &(usize, usize))| (i + j + 1 == across).then_some(k);
        let centre = |k: usize| (k as f64 + 0.5) * spacing;
        Self {
            h,
            spacing,
            halves: all.iter().enumerate().filter_map(on_face).collect(),
            places: spec.start_at(all.iter().map(|(i, j)| [centre(*i), centre(*j)]).collect()),
            kept: kept.len(),
        }
    }

    fn particles(&self, parameters: &Parameters, whole: bool) -> Result<Particles<2>, Error> {
        let count = if whole { self.places.len() } else { self.kept };
        let density = parameters.number(UNIT_WEIGHT) / GRAVITATION;
        let places = self.places[..count].to_vec();
        let volume = self.spacing * self.spacing;
        let mut particles = Particles::new(places, volume, density, [0.5 * self.spacing; 2])?;
        for half in self.halves.iter().filter(|k| **k < count) {
            particles.mass[*half] *= 0.5;
            particles.reference_volume[*half] *= 0.5;
        }
        Ok(particles)
    }

    fn grid(&self, parameters: &Parameters) -> Result<Grid<2>, Error> {
        let cells = |length: f64| (length / self.h).round() as usize;
        let along = cells(parameters.number(CREST) + HEIGHT + ROOM);
        let up = cells(HEIGHT) + MARGIN;
        let upward = if parameters.is(BASE, FRICTIONAL) {
            Axis::open(-(MARGIN as f64) * self.h, up + MARGIN)
        } else {
            Axis::bounded(0.0, up, (Side::Wall, Side::Open))
        };
        let across = Axis::bounded(0.0, along, (Side::Wall, Side::Open));
        Grid::new(self.h, [across, upward])
    }

    /// Coulomb's friction beneath the particles, with a barrier that just touches the lowest ones.
    fn base(&self, parameters: &Parameters) -> Result<RigidContact<2>, Error> {
        let reach = REACH * self.h;
        let weight = parameters.number(UNIT_WEIGHT) * HEIGHT * self.spacing;
        let gap = (1.0 - GIVES_WAY) * reach;
        let barrier = Barrier::carrying_at(weight, gap, reach)?;
        let lowest = 0.5 * self.spacing;
        let face = RigidFace::half_space(1, End::Lo, lowest - 0.5 * (gap + reach))?;
        let friction = Friction::new(parameters.number(FRICTION), barrier.stiffness(gap))?;
        Ok(RigidContact::new(face, barrier).with_friction(friction))
    }
}

/// How strength falls.
///
/// # Errors
/// A residual strength above the peak.
pub(super) fn strength(parameters: &Parameters) -> Result<Strength, Error> {
    let [peak, residual, slope] =
        [PEAK, RESIDUAL, SOFTENING].map(|p| SQRT_2 * parameters.number(p));
    Strength::softening_linearly(peak, residual, slope)
}

/// Step (s) after the excavation on cells of size `h` (m), and how many there are in a row.
///
/// # Errors
/// Parameters that make no law.
pub(super) fn timing(h: f64, parameters: &Parameters) -> Result<(f64, u64), Error> {
    let density = parameters.number(UNIT_WEIGHT) / GRAVITATION;
    let speed = hencky(parameters)?.wave_speed(density);
    let row = parameters.number(DURATION) / rows(Phase::Collapse, parameters) as f64;
    let steps = (row * speed / (parameters.number(CFL) * h)).ceil().max(1.0);
    Ok((row / steps, steps as u64))
}

fn hencky(parameters: &Parameters) -> Result<HenckyJ2, Error> {
    let [young, poisson] = [YOUNG_MODULUS, POISSON_RATIO].map(|p| parameters.number(p));
    HenckyJ2::new(young, poisson, strength(parameters)?)
}

/// Rows of a phase, if it comes to its end.
pub(super) fn rows(phase: Phase, parameters: &Parameters) -> u64 {
    match phase {
        Phase::Gravity if parameters.is(GRAVITY, STEP) => 1,
        Phase::Gravity => parameters.number(LOAD_STEPS) as u64,
        Phase::Cut => 1,
        Phase::Settling | Phase::Collapse => {
            (parameters.number(DURATION) / ROW).round().max(1.0) as u64
        }
        Phase::Over => 0,
    }
}

/// The simulation of a phase at its start.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
    ground: &Ground,
    phase: Phase,
) -> Result<Box<dyn Simulation<2>>, Error> {
    if !parameters.is(LAW, JAUMANN) {
        return build(spec, parameters, ground, phase, hencky(parameters)?);
    }
    let [young, poisson] = [YOUNG_MODULUS, POISSON_RATIO].map(|p| parameters.number(p));
    let strength = strength(parameters)?;
    let law = HypoelasticJ2::new(young, poisson, JaumannUpdate::Split, strength)?;
    build(spec, parameters, ground, phase, law)
}

fn build<M: Law + Solved<2>>(
    spec: &RunSpec,
    parameters: &Parameters,
    ground: &Ground,
    phase: Phase,
    law: M,
) -> Result<Box<dyn Simulation<2>>, Error> {
    let body = Body::new(law, ground.particles(parameters, phase.is_whole())?)?;
    let rises = phase == Phase::Gravity;
    let gravity = move |time: f64| {
        let share = if rises { time } else { 1.0 };
        [0.0, -GRAVITATION * share]
    };
    let wall = |axis, kind| Wall {
        axis,
        end: End::Lo,
        kind,
    };
    let scene = Scene::new(ground.grid(parameters)?, body)
        .load(Gravity(Box::new(gravity)))
        .constrain(wall(0, WallKind::Roller));
    let scene = if parameters.is(BASE, FRICTIONAL) {
        scene.contact(ground.base(parameters)?)
    } else {
        scene.constrain(wall(1, WallKind::Fixed))
    };
    let (dt, _) = timing(ground.h, parameters)?;
    let settings = implicit_settings(spec, parameters, dt).ok_or(Error::Input {
        what: "solvers of the excavation other than quasi-static, midpoint and newmark",
        value: 1.0,
        allowed: "none",
    })?;
    let settings = if phase.moves() {
        settings
    } else {
        let once = phase == Phase::Gravity && parameters.is(GRAVITY, STEP);
        Settings {
            rule: TimeRule::Static,
            dt: 1.0 / rows(phase, parameters) as f64,
            most_halvings: if once { 0 } else { settings.most_halvings },
            ..settings
        }
    };
    let settings = match parameters.number(GHOST) {
        0.0 => settings,
        factor => settings.stabilised(Stabilisation::Ghost(factor)),
    };
    implicit(spec.scheme, scene, settings)
}

/// Where the foot of the cut face is (m).
pub(super) fn foot(parameters: &Parameters) -> f64 {
    parameters.number(CREST) + HEIGHT - parameters.number(CUT)
}
