//! What the dam break is made of: water, tank, gate.

use super::parameters::{
    BULK_MODULUS, CFL, DENSITY, DURATION, GRAVITY_STAGE, PIC_RATE, PPC_PER_DIRECTION, SEED, START,
    STICKY, VISCOSITY, WALL_CONTACT,
};
use super::reference::{DEPTH, GRAVITY, LENGTH, TANK};
use crate::cases::observe::{discretisation, settings};
use crate::cases::parameters::require_quotient;
use crate::error::Error;
use crate::exact::Exact;
use crate::exact::hydrostatic::Hydrostatic;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::scheme::BasisName;
use crate::spec::RunSpec;
use mpm_core::explicit::transfer::Flip;
use mpm_core::explicit::{Settings, courant_time_step};
use mpm_core::material::{Law, NewtonianFluid};
use mpm_core::stage::{End, Gravity, LocalDamping, RigidNodes, Wall, WallKind, smooth_rise};
use mpm_core::{Axis, Body, Grid, Particles, Scene, Side, Simulation};
use mpm_solvers::solver;
use nalgebra::{SMatrix, Vector3};

/// Height (m) of the grid: jets rise to 10 m.
const HEIGHT: f64 = 16.0;
/// Time (s) between two rows of the series.
pub(super) const ROW: f64 = 0.005;
/// Duration (s) of the gravity stage, and of the part in which gravity rises: ten and six of the longest periods of
/// the water behind the gate.
pub(super) const STAGE: f64 = 0.06;
const RISE: f64 = 0.035;
/// Local damping of the gravity stage.
const DAMPING: f64 = 0.2;
/// Places of constraints in the scene's list.
pub(super) const FLOOR: usize = 0;
pub(super) const BACK: usize = 1;
pub(super) const FRONT: usize = 2;
pub(super) const GATE: usize = 3;
/// How many last bits the starts of an ensemble differ by, at most.
const LAST_BITS: u64 = 3;

/// The water in its tank, behind the gate or free.
pub(super) struct Dam {
    spec: RunSpec,
    parameters: Parameters,
    law: NewtonianFluid,
    /// The exact state of rest.
    pub(super) water: Hydrostatic,
    /// Distance (m) between particles.
    pub(super) spacing: f64,
    pub(super) steps_per_row: u64,
    /// Time step (s).
    pub(super) dt: f64,
}

impl Dam {
    /// Of a run.
    ///
    /// # Errors
    /// Parameters out of range.
    pub(super) fn new(spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let number = |p| parameters.number(p);
        let water = Hydrostatic {
            density: number(DENSITY),
            bulk_modulus: number(BULK_MODULUS),
            gravity: GRAVITY,
            width: LENGTH,
            height: DEPTH,
        };
        let pressure = water.density * GRAVITY * DEPTH;
        let why = "above which weight compresses the water by more than the 0.1 % that the force on the gate is granted";
        let what = "density g H / bulk_modulus";
        require_quotient(what, pressure / water.bulk_modulus, 0.0..=1e-3, why)?;
        let law = NewtonianFluid::new(water.bulk_modulus, number(VISCOSITY))?;
        // The largest step of the CFL number of which a whole number makes a row.
        let most = courant_time_step(number(CFL), spec.level.h, law.wave_speed(water.density));
        let steps_per_row = (ROW / most).ceil().max(1.0);
        Ok(Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            law,
            water,
            spacing: spec.level.h / number(PPC_PER_DIRECTION),
            steps_per_row: steps_per_row as u64,
            dt: ROW / steps_per_row,
        })
    }

    pub(super) fn discretisation(&self) -> Discretisation {
        discretisation(2, &self.spec, &self.parameters, self.dt)
    }

    /// Rows of the series that a gravity stage has behind the gate.
    pub(super) fn stage_rows(&self) -> usize {
        let rows = (STAGE / ROW).round() as usize;
        if self.is_staged() { rows } else { 0 }
    }

    /// Rows of the series after the removal of the gate.
    pub(super) fn free_rows(&self) -> usize {
        (self.parameters.number(DURATION) / ROW).round() as usize
    }

    /// The longest period (s) of the water behind the gate.
    pub(super) fn period(&self) -> f64 {
        4.0 * DEPTH / self.law.wave_speed(self.water.density)
    }

    fn is_staged(&self) -> bool {
        self.parameters.is(START, GRAVITY_STAGE)
    }

    /// The water behind the gate: exactly at rest, or without weight yet.
    ///
    /// # Errors
    /// Parameters that make no scene.
    pub(super) fn behind_the_gate(&self) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        let rise = if self.is_staged() { RISE } else { 0.0 };
        let gate = gate_of(self.spec.scheme.basis(), self.spec.level.h);
        let scene = self.tank(rise)?.constrain(gate);
        let mut settings = self.settings()?;
        if self.is_staged() {
            settings = settings.filter_forces(LocalDamping::new(DAMPING)?);
        }
        solver(self.spec.scheme, scene, settings)
    }

    /// The same water without a gate.
    ///
    /// # Errors
    /// Parameters that make no scene.
    pub(super) fn released(&self) -> Result<Box<dyn Simulation<2>>, mpm_core::Error> {
        solver(self.spec.scheme, self.tank(0.0)?, self.settings()?)
    }

    /// The water in the tank, under gravity that rises over `rise` (s).
    fn tank(&self, rise: f64) -> Result<Scene<2, NewtonianFluid>, mpm_core::Error> {
        let kind = if self.parameters.is(WALL_CONTACT, STICKY) {
            WallKind::Roller
        } else {
            WallKind::Separable
        };
        let walls = [(1, End::Lo), (0, End::Lo), (0, End::Hi)];
        let weight = Gravity(Box::new(move |time| {
            [0.0, -GRAVITY * smooth_rise(time, rise)]
        }));
        let body = Body::new(self.law, self.particles()?)?;
        Ok(Scene::new(grid(self.spec.level.h)?, body)
            .load(weight)
            .constrain_all(walls.map(|(axis, end)| Wall { axis, end, kind })))
    }

    fn settings(&self) -> Result<Settings<2>, mpm_core::Error> {
        let flip = (-self.parameters.number(PIC_RATE) * self.dt).exp();
        let settings = settings(&self.spec, &self.parameters, self.dt, 0.0)?;
        Ok(settings.transfer(Flip::new(flip)?))
    }

    fn particles(&self) -> Result<Particles<2>, mpm_core::Error> {
        let places = self.spec.start_at(seed(self.spacing));
        let places = perturbed(places, self.parameters.number(SEED) as u64);
        let (volume, half_size) = (self.spacing * self.spacing, [0.5 * self.spacing; 2]);
        let particles = Particles::new(places, volume, self.water.density, half_size)?;
        Ok(if self.is_staged() {
            particles
        } else {
            particles.deformed(|x| compressed(&self.water, x))
        })
    }
}

/// The tank, open above.
fn grid(h: f64) -> Result<Grid<2>, mpm_core::Error> {
    let cells = |length: f64| (length / h).round() as usize;
    let upward = Axis::bounded(0.0, cells(HEIGHT), (Side::Wall, Side::Open));
    Grid::new(h, [Axis::walls(0.0, cells(TANK)), upward])
}

/// Particles row by row from the floor up, in columns from the back wall.
pub(super) fn seed(spacing: f64) -> Vec<[f64; 2]> {
    let count = |length: f64| (length / spacing).round() as usize;
    let coordinate = |k: usize| (k as f64 + 0.5) * spacing;
    (0..count(LENGTH))
        .flat_map(|i| (0..count(DEPTH)).map(move |j| [coordinate(i), coordinate(j)]))
        .collect()
}

/// Places that differ from `places` in their last bits, at random, in a way of its own for every `seed` but zero,
/// which keeps them.
fn perturbed(mut places: Vec<[f64; 2]>, seed: u64) -> Vec<[f64; 2]> {
    if seed > 0 {
        let mut random = fastrand::Rng::with_seed(seed);
        for x in places.iter_mut().flatten() {
            for _ in 0..random.u64(0..=LAST_BITS) {
                *x = x.next_up();
            }
        }
    }
    places
}

/// Where water at rest from `x` (m) lies under its weight, and its deformation gradient.
fn compressed(water: &Hydrostatic, x: &[f64; 2]) -> ([f64; 2], SMatrix<f64, 2, 2>) {
    let reference = Vector3::new(x[0], x[1], 0.0);
    let moved = reference + water.displacement(&reference, 0.0);
    let f = water.deformation_gradient(&reference, 0.0);
    ([moved.x, moved.y], f.fixed_view::<2, 2>(0, 0).into_owned())
}

/// The gate: it holds, across, all functions that reach it. Nothing flows through it then, and in water at rest, whose
/// pressure is the same all along a cell, the force on it is exact.
fn gate_of(basis: BasisName, h: f64) -> RigidNodes<2> {
    let reach = match basis {
        BasisName::Linear | BasisName::Gimp | BasisName::Q8 => 0.0,
        BasisName::Bspline2 => 0.5 * h,
        BasisName::Bspline3 => h,
    };
    RigidNodes {
        extent: [
            [LENGTH - reach, f64::INFINITY],
            [f64::NEG_INFINITY, f64::INFINITY],
        ],
        velocity: [Some(0.0), None],
        ramp: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ensemble_differs_in_last_bits() {
        let (places, other) = (seed(0.1), perturbed(seed(0.1), 3));
        assert_eq!(perturbed(seed(0.1), 0), places);
        for another in [0, 1, 2, 4, 7] {
            assert_ne!(perturbed(seed(0.1), another), other, "{another}");
        }
        let moved = places.iter().flatten().zip(other.iter().flatten());
        assert!(moved.clone().any(|(a, b)| a != b));
        assert!(moved.clone().all(|(a, b)| (a - b).abs() < 1e-14));
    }
}
