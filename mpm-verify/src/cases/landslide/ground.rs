//! The ground of the landslide: particles, floor and walls, strengths, the stage in which gravity rises.

use super::section::{GRAVITY, Section};
use crate::case::RunSpec;
use crate::error::Error;
use crate::parameter::Parameters;
use mpm_core::basis::WallTreatment;
use mpm_core::material::{HenckyJ2, Law, Strength};
use mpm_core::solver::courant_time_step;
use mpm_core::stage::{
    BodyForce, Constraint, End, ForceFilter, LocalDamping, Wall, WallKind, smooth_rise,
};
use mpm_core::transfer::Flip;
use mpm_core::{Axis, Grid, Particles, Scene, Side};
use std::f64::consts::SQRT_2;

/// Time (s) between two rows of the series.
pub(crate) const ROW: f64 = 0.01;
/// Duration (s) of the gravity stage, and of the part in which gravity rises: three and one of the longest periods of
/// shear waves in the slope, 4H/c_s = 0.32 s.
pub(crate) const STAGE: f64 = 1.0;
pub(crate) const RISE: f64 = 0.4;
/// Local damping of the gravity stage.
pub(crate) const DAMPING: f64 = 0.7;
/// Height (m) of the grid above the crest.
const ROOM: f64 = 1.0;
/// Width (m) in full, and cells across a slice.
const FULL: f64 = 5.0;
const SLICE: f64 = 4.0;
/// Place of the base in the scene's list of constraints.
pub(crate) const BASE: usize = 0;

/// Stability number γH/c of a slope at 45° on a firm base and its bounds: docs/exact.md.
pub(crate) const STABILITY: (f64, f64, f64) = (6.04, 6.015, 6.078);

/// Factor of safety of the slope of `parameters` with the strength κ (Pa), if the stability number is this.
pub(crate) fn factor_of_safety(parameters: &Parameters, strength: f64, stability: f64) -> f64 {
    let number = |name| parameters.number(name);
    stability * strength / SQRT_2 / (number("density") * GRAVITY * number("height"))
}

/// The longest period (s) of shear waves in the slope, 4H/c_s.
pub(crate) fn longest_period(parameters: &Parameters) -> f64 {
    let number = |name| parameters.number(name);
    let shear_modulus = 0.5 * number("young_modulus") / (1.0 + number("poisson_ratio"));
    4.0 * number("height") / (shear_modulus / number("density")).sqrt()
}

/// Strengths before and after the reduction: only the peak is reduced.
pub(crate) fn strengths(parameters: &Parameters) -> Result<[Strength; 2], Error> {
    let number = |name| parameters.number(name);
    let (peak, residual) = (number("peak_strength"), number("residual_strength"));
    let of = |peak: f64| Strength::softening(peak, residual.min(peak), number("softening"));
    Ok([of(peak)?, of(peak / number("reduction"))?])
}

/// The ground, its floor and its walls, on a grid with room for the slide.
pub(crate) struct Ground<const D: usize> {
    /// The section.
    pub(crate) section: Section,
    /// Width (m); one metre in plane strain.
    pub(crate) width: f64,
    /// Distance of particles (m).
    pub(crate) spacing: f64,
    /// Particles across the width.
    pub(crate) across: usize,
    /// Time step (s), and how many make a row.
    pub(crate) dt: f64,
    pub(crate) steps_per_row: u64,
    /// Density (kg/m³).
    pub(crate) density: f64,
    h: f64,
}

impl<const D: usize> Ground<D> {
    /// The ground of a level.
    pub(crate) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let h = spec.level.h;
        let section = Section::of(parameters);
        let width = if D == 3 {
            width(spec, parameters)?
        } else {
            1.0
        };
        let spacing = h / parameters.number("ppc_per_direction");
        // The speed of waves doesn't ask for the strength.
        let law = Self::law(parameters, Strength::perfect(1.0)?)?;
        let density = parameters.number("density");
        let wave_speed = law.wave_speed(density);
        // The largest step of the CFL number of which a whole number makes a row.
        let most = courant_time_step(parameters.number("cfl"), h, wave_speed);
        let steps_per_row = (ROW / most).ceil().max(1.0);
        Ok(Self {
            section,
            width,
            spacing,
            across: if D == 3 {
                (width / spacing).round() as usize
            } else {
                1
            },
            dt: ROW / steps_per_row,
            steps_per_row: steps_per_row as u64,
            density,
            h,
        })
    }

    pub(crate) fn law(
        parameters: &Parameters,
        strength: Strength,
    ) -> Result<HenckyJ2, mpm_core::Error> {
        let number = |name| parameters.number(name);
        HenckyJ2::new(number("young_modulus"), number("poisson_ratio"), strength)
    }

    fn grid(&self, floor: f64) -> Result<Grid<D>, mpm_core::Error> {
        let cells = |length: f64| (length / self.h - 1e-9).ceil() as usize;
        let along = Axis::bounded(
            0.0,
            cells(self.section.toe() + floor),
            (Side::Wall, Side::Open),
        );
        let upward = Axis::bounded(
            0.0,
            cells(self.section.height + ROOM),
            (Side::Wall, Side::Open),
        );
        let across = Axis::walls(0.0, cells(self.width));
        Grid::new(self.h, std::array::from_fn(|a| [along, upward, across][a]))
    }

    /// The particles: places of the section in their order, at each those across the width.
    fn seed(&self) -> Vec<[f64; D]> {
        let coordinate = |k: usize| (k as f64 + 0.5) * self.spacing;
        let section = self.section.seed(self.spacing).into_iter();
        section
            .flat_map(|[x, y]| {
                (0..self.across).map(move |k| std::array::from_fn(|a| [x, y, coordinate(k)][a]))
            })
            .collect()
    }

    /// A scene of it at rest and without stress, under gravity that rises over `rise` (s), with local damping.
    pub(crate) fn scene(
        &self,
        spec: &RunSpec,
        parameters: &Parameters,
        strength: Strength,
        (rise, damping): (f64, f64),
    ) -> Result<Scene<D, HenckyJ2, Flip>, mpm_core::Error> {
        let volume = self.spacing.powi(D as i32);
        let half_size = [0.5 * self.spacing; D];
        let places = spec.start_at(self.seed());
        let particles = Particles::new(places, volume, self.density, half_size)?;
        let weight = BodyForce(Box::new(move |_: &[f64; D], time| {
            let mut g = [0.0; D];
            g[1] = -GRAVITY * smooth_rise(time, rise);
            g
        }));
        Ok(Scene {
            grid: self.grid(parameters.number("floor"))?,
            wall: if parameters.is("wall", "wall-line") {
                WallTreatment::WallLine
            } else {
                WallTreatment::OpenKnot
            },
            law: Self::law(parameters, strength)?,
            particles,
            remedy: spec.scheme.remedy.build(),
            loads: vec![Box::new(weight)],
            contacts: Vec::new(),
            force_filters: filters(damping)?,
            constraints: walls(),
            particle_filters: Vec::new(),
            transfer: Flip::default(),
            dt: self.dt,
        })
    }
}

/// Width (m) of a run in three dimensions: a whole number of cells.
fn width(spec: &RunSpec, parameters: &Parameters) -> Result<f64, Error> {
    let (h, given) = (spec.level.h, parameters.number("width"));
    let width = match spec.level.name.starts_with("slice") {
        _ if given > 0.0 => given,
        true => SLICE * h,
        false => FULL,
    };
    let cells = width / h;
    if (cells - cells.round()).abs() > 1e-9 || cells < SLICE - 0.5 {
        return Err(Error::Input(format!(
            "parameter width: {width} m is {cells} cells of {h} m; allowed: a whole number of cells, four or more"
        )));
    }
    Ok(width)
}

fn filters(damping: f64) -> Result<Vec<Box<dyn ForceFilter>>, mpm_core::Error> {
    Ok(if damping > 0.0 {
        vec![Box::new(LocalDamping::new(damping)?)]
    } else {
        Vec::new()
    })
}

/// The fixed base, then rollers at the back and, in three dimensions, at the sides.
fn walls<const D: usize>() -> Vec<Box<dyn Constraint<D>>> {
    let wall = |axis, end, kind| -> Box<dyn Constraint<D>> { Box::new(Wall { axis, end, kind }) };
    let mut walls = vec![
        wall(1, End::Lo, WallKind::Fixed),
        wall(0, End::Lo, WallKind::Roller),
    ];
    if D == 3 {
        walls.push(wall(2, End::Lo, WallKind::Roller));
        walls.push(wall(2, End::Hi, WallKind::Roller));
    }
    walls
}
