//! The ground of the slope: clay, particles, floor and walls, and the stage in which gravity rises.

use super::section::{GRAVITY, Section};
use super::*;
use crate::cases::prelude::*;

/// Time (s) between two rows of the series.
pub(in crate::cases) const ROW: f64 = 0.01;
/// Duration (s) of the gravity stage, and of the part in which gravity rises: three and one of the longest periods of
/// shear waves in the slope, 4H/c_s = 0.32 s.
pub(in crate::cases) const STAGE: f64 = 1.0;
pub(in crate::cases) const RISE: f64 = 0.4;
/// Local damping of the gravity stage.
pub(in crate::cases) const STAGE_DAMPING: f64 = 0.7;
/// Height (m) of the grid above the crest.
const ROOM: f64 = 1.0;
/// Index of the base among the constraints of the scene.
pub(in crate::cases) const BASE: usize = 0;

/// Stability number γH/c of a slope at 45° on a firm base and its bounds: docs/exact.md.
pub(in crate::cases) const STABILITY: (f64, f64, f64) = (6.04, 6.015, 6.078);

/// Section and clay of a slope.
pub(in crate::cases) struct Slope {
    pub(in crate::cases) section: Section,
    /// Young's modulus (Pa) and Poisson's ratio, density (kg/m³).
    pub(in crate::cases) elasticity: (f64, f64),
    pub(in crate::cases) density: f64,
}

impl<P: ParameterSet> Setup<P> {
    pub(in crate::cases) fn slope(&self) -> Slope {
        let number = |p| self.number(p);
        let height = number(HEIGHT);
        Slope {
            section: Section { height, crest: number(CREST), run: height / number(FACE_ANGLE).to_radians().tan() },
            elasticity: (number(YOUNG_MODULUS), number(POISSON_RATIO)),
            density: number(DENSITY),
        }
    }
}

impl Slope {
    /// Factor of safety with the strength κ (Pa), by a stability number.
    pub(in crate::cases) fn factor_of_safety(&self, strength: f64, stability: f64) -> f64 {
        stability * strength / SQRT_2 / (self.density * GRAVITY * self.section.height)
    }

    /// The longest period (s) of shear waves, 4H/c_s.
    pub(in crate::cases) fn longest_period(&self) -> f64 {
        let shear_modulus = 0.5 * self.elasticity.0 / (1.0 + self.elasticity.1);
        4.0 * self.section.height / (shear_modulus / self.density).sqrt()
    }

    pub(in crate::cases) fn law(&self, strength: Strength) -> Result<HenckyJ2, Fault> {
        HenckyJ2::new(self.elasticity.0, self.elasticity.1, strength)
    }
}

/// The ground, its floor and its walls, on a grid with room for the slide.
pub(in crate::cases) struct Ground<const D: usize> {
    pub(in crate::cases) slope: Slope,
    /// Width (m); one metre in plane strain.
    pub(in crate::cases) width: f64,
    /// Distance of particles (m).
    pub(in crate::cases) spacing: f64,
    /// Particles across the width.
    pub(in crate::cases) across: usize,
    /// Time step (s), and number of steps in a row.
    pub(in crate::cases) dt: f64,
    pub(in crate::cases) steps_per_row: u64,
    h: f64,
    /// Length of the floor (m).
    floor: f64,
}

impl<const D: usize> Ground<D> {
    pub(in crate::cases) fn new<P: ParameterSet>(setup: &Setup<P>, width: f64) -> Result<Self, Fault> {
        let (slope, h) = (setup.slope(), setup.h);
        let number = |p| setup.number(p);
        let spacing = h / number(PPC_PER_DIRECTION);
        // The speed of waves does not depend on the strength.
        let wave_speed = slope.law(Strength::perfect(1.0)?)?.wave_speed(slope.density);
        // The largest step of the CFL number of which a whole number makes a row.
        let steps_per_row = (ROW / courant_time_step(number(CFL), h, wave_speed)).ceil().max(1.0);
        Ok(Self {
            slope,
            width,
            spacing,
            across: if D == 3 { (width / spacing).round() as usize } else { 1 },
            dt: ROW / steps_per_row,
            steps_per_row: steps_per_row as u64,
            h,
            floor: number(FLOOR),
        })
    }

    /// Vertical stress (Pa) under the full height.
    pub(in crate::cases) fn overburden(&self) -> f64 {
        self.slope.density * GRAVITY * self.slope.section.height
    }

    fn grid(&self) -> Result<Grid<D>, Fault> {
        let cells = |length: f64| (length / self.h - 1e-9).ceil() as usize;
        let open = |length| Axis::bounded(0.0, cells(length), (Side::Wall, Side::Open));
        let along = open(self.slope.section.toe() + self.floor);
        let upward = open(self.slope.section.height + ROOM);
        let across = Axis::walls(0.0, cells(self.width));
        Grid::new(self.h, std::array::from_fn(|a| [along, upward, across][a]))
    }

    /// The particles: places of the section in their order, at each those across the width.
    pub(in crate::cases) fn seed(&self) -> Vec<[f64; D]> {
        let coordinate = |k: usize| (k as f64 + 0.5) * self.spacing;
        let section = self.slope.section.seed(self.spacing).into_iter();
        section
            .flat_map(|[x, y]| (0..self.across).map(move |k| std::array::from_fn(|a| [x, y, coordinate(k)][a])))
            .collect()
    }

    /// A scene of the ground at rest and without stress, under gravity that rises over `rise` (s).
    pub(in crate::cases) fn scene<P: ParameterSet>(
        &self,
        setup: &Setup<P>,
        law: impl Into<SharedLaw>,
        rise: f64,
    ) -> Result<Scene<D>, Fault> {
        let particles = setup.particles_at(self.seed(), self.spacing, self.slope.density)?;
        let weight = Gravity(Box::new(move |time| {
            let mut g = [0.0; D];
            g[1] = -GRAVITY * Amplitude::Rise(rise).at(time);
            g
        }));
        let body = Bodies::new(law, particles)?;
        // The fixed base, then rollers at the back and, in three dimensions, at the sides.
        let walls = [clamp(1, End::Lo), roller(0, End::Lo), roller(2, End::Lo), roller(2, End::Hi)];
        let walls = walls.into_iter().filter(|wall| wall.axis < D);
        Ok(Scene::new(self.grid()?, body).load(weight).constrain_all(walls))
    }
}
