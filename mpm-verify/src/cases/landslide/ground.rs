//! The ground of the landslide: particles, floor and walls, strengths, the stage in which gravity rises.

use super::parameters::{
    CFL, DENSITY, FLOOR, HEIGHT, PEAK_STRENGTH, POISSON_RATIO, PPC_PER_DIRECTION,
    RESIDUAL_STRENGTH, SOFTENING, WIDTH, YOUNG_MODULUS,
};
use super::section::{GRAVITY, Section};
use crate::cases::observe::settings;
use crate::error::Error;
use crate::parameter::Parameters;
use crate::spec::RunSpec;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{HenckyJ2, Law, Strength};
use mpm_core::stage::{End, Gravity, Wall, WallKind, smooth_rise};
use mpm_core::{Axis, Body, Grid, Particles, Scene, Side};
use std::f64::consts::SQRT_2;

/// Time (s) between two rows of the series.
pub(crate) const ROW: f64 = 0.01;
/// Duration (s) of the gravity stage, and of the part in which gravity rises: three and one of the longest periods of
/// shear waves in the slope, 4H/c_s = 0.32 s.
pub(crate) const STAGE: f64 = 1.0;
pub(crate) const RISE: f64 = 0.4;
/// Local damping of the gravity stage.
pub(crate) const STAGE_DAMPING: f64 = 0.7;
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
    let number = |p| parameters.number(p);
    stability * strength / SQRT_2 / (number(DENSITY) * GRAVITY * number(HEIGHT))
}

/// The longest period (s) of shear waves in the slope, 4H/c_s.
pub(crate) fn longest_period(parameters: &Parameters) -> f64 {
    let number = |p| parameters.number(p);
    let shear_modulus = 0.5 * number(YOUNG_MODULUS) / (1.0 + number(POISSON_RATIO));
    4.0 * number(HEIGHT) / (shear_modulus / number(DENSITY)).sqrt()
}

/// The strength with its peak, and only that, divided by `reduction`.
pub(crate) fn strength(
    parameters: &Parameters,
    reduction: f64,
) -> Result<Strength, mpm_core::Error> {
    let number = |p| parameters.number(p);
    let peak = number(PEAK_STRENGTH) / reduction;
    Strength::softening(peak, number(RESIDUAL_STRENGTH).min(peak), number(SOFTENING))
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
        let spacing = h / parameters.number(PPC_PER_DIRECTION);
        // The speed of waves doesn't ask for the strength.
        let law = Self::law(parameters, Strength::perfect(1.0)?)?;
        let density = parameters.number(DENSITY);
        let wave_speed = law.wave_speed(density);
        // The largest step of the CFL number of which a whole number makes a row.
        let most = courant_time_step(parameters.number(CFL), h, wave_speed);
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
        let number = |p| parameters.number(p);
        HenckyJ2::new(number(YOUNG_MODULUS), number(POISSON_RATIO), strength)
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
    pub(super) fn seed(&self) -> Vec<[f64; D]> {
        let coordinate = |k: usize| (k as f64 + 0.5) * self.spacing;
        let section = self.section.seed(self.spacing).into_iter();
        section
            .flat_map(|[x, y]| {
                (0..self.across).map(move |k| std::array::from_fn(|a| [x, y, coordinate(k)][a]))
            })
            .collect()
    }

    /// A scene of it at rest and without stress, under gravity that rises over `rise` (s), to be solved with local damping.
    pub(crate) fn scene(
        &self,
        spec: &RunSpec,
        parameters: &Parameters,
        strength: Strength,
        (rise, damping): (f64, f64),
    ) -> Result<(Scene<D, HenckyJ2>, Settings<D>), mpm_core::Error> {
        let scene = self.under_gravity(spec, parameters, strength, rise)?;
        Ok((scene, settings(spec, parameters, self.dt, damping)?))
    }

    /// That scene alone.
    pub(crate) fn under_gravity(
        &self,
        spec: &RunSpec,
        parameters: &Parameters,
        strength: Strength,
        rise: f64,
    ) -> Result<Scene<D, HenckyJ2>, mpm_core::Error> {
        let volume = self.spacing.powi(D as i32);
        let half_size = [0.5 * self.spacing; D];
        let places = spec.start_at(self.seed());
        let particles = Particles::new(places, volume, self.density, half_size)?;
        let weight = Gravity(Box::new(move |time| {
            let mut g = [0.0; D];
            g[1] = -GRAVITY * smooth_rise(time, rise);
            g
        }));
        let law = Self::law(parameters, strength)?;
        let grid = self.grid(parameters.number(FLOOR))?;
        Ok(Scene::new(grid, Body::new(law, particles)?)
            .load(weight)
            .constrain_all(walls::<D>()))
    }
}

/// Width (m) of a run in three dimensions: a whole number of cells.
fn width(spec: &RunSpec, parameters: &Parameters) -> Result<f64, Error> {
    let (h, given) = (spec.level.h, parameters.number(WIDTH));
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

/// The fixed base, then rollers at the back and, in three dimensions, at the sides.
fn walls<const D: usize>() -> Vec<Wall> {
    let wall = |axis, end, kind| Wall { axis, end, kind };
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

#[cfg(test)]
mod tests {
    use super::super::{levels_3d, parameters_3d};
    use super::*;
    use crate::scheme::{BasisName, RemedyName, Scheme};

    fn parameters(set: &[&str]) -> Parameters {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        Parameters::new(&parameters_3d(), &set).unwrap()
    }

    fn spec(level: &str) -> RunSpec {
        RunSpec {
            scheme: Scheme::flip(BasisName::Gimp, RemedyName::None),
            level: *levels_3d().iter().find(|l| l.name == level).unwrap(),
            set: Vec::new(),
            perturbed: false,
        }
    }

    fn ground(level: &str, set: &[&str]) -> Result<Ground<3>, Error> {
        Ground::new(&spec(level), &parameters(set))
    }

    #[test]
    fn the_ground_has_the_papers_particles_and_time_step() {
        let ground = ground("h0.2", &[]).unwrap();
        let places = ground.seed();
        assert_eq!((places.len(), ground.across), (311_250, 50));
        assert!((ground.dt - 5e-5).abs() < 1e-18);
        assert_eq!(ground.steps_per_row, 200);
        // Those of one place of the section follow one another.
        let (first, last) = (places[0], places[49]);
        assert_eq!(first[..2], last[..2]);
        assert!((first[2] - 0.05).abs() < 1e-12 && (last[2] - 4.95).abs() < 1e-12);
    }

    #[test]
    fn a_slice_is_four_cells_wide_and_a_width_is_whole_cells() {
        let wide = |level: &str, set: &[&str]| ground(level, set).map(|g| g.width);
        assert!((wide("slice-h0.4", &[]).unwrap() - 1.6).abs() < 1e-12);
        assert!((wide("h0.5", &[]).unwrap() - 5.0).abs() < 1e-12);
        assert!((wide("h0.5", &["width=2"]).unwrap() - 2.0).abs() < 1e-12);
        for width in ["width=1.5", "width=2.2"] {
            let refused = wide("h0.5", &[width]).unwrap_err().to_string();
            assert!(refused.contains("parameter width"), "{refused}");
        }
    }

    #[test]
    fn only_the_peak_is_reduced() {
        let parameters = parameters(&[]);
        let at = |reduction: f64, strain: f64| {
            let strength = strength(&parameters, reduction).unwrap();
            strength.at(strain).0
        };
        assert!((at(1.0, 0.0) - 40.82e3).abs() < 1e-6);
        assert!((at(1.65, 0.0) - 40.82e3 / 1.65).abs() < 1e-6);
        for reduction in [1.0, 1.65] {
            assert!((at(reduction, 100.0) - 2.45e3).abs() < 1e-6);
        }
        // A peak reduced below the residual strength takes that with it.
        assert!((at(100.0, 100.0) - 408.2).abs() < 1e-6);
    }

    #[test]
    fn the_reduced_slope_is_at_its_limit() {
        let parameters = parameters(&[]);
        let factor = |strength| factor_of_safety(&parameters, strength, STABILITY.0);
        assert!((factor(40.82e3) - 1.653).abs() < 5e-4);
        assert!((factor(40.82e3 / 1.65) - 1.002).abs() < 5e-4);
        assert!((longest_period(&parameters) - 0.321).abs() < 5e-4);
    }
}
