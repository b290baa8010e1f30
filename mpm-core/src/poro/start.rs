//! A solver before its first step.

use super::face::Acts;
use super::plate::ties;
use super::pores::{Pores, check_width, grown, keep_before_walls};
use super::step::solid_shares;
use super::{Moduli, OfHats, PressureSpace, Settings, Solver, Space, Tangent, Water};
use crate::error::{Error, Fault, positive, require, require_none};
use crate::grid::{Axis, Grid};
use crate::implicit::failure::Failure;
use crate::implicit::held;
use crate::implicit::linear::Direct;
use crate::implicit::start::moduli_of;
use crate::ledger::Ledger;
use crate::monitor::{Convergence, WaterBalance};
use crate::particles::Particles;
use crate::room::Room;
use crate::scene::Scene;
use nalgebra::SVector;

/// The grid of the pressure: of cells twice as large between the same ends, or the same.
fn grid_of_pressure<const D: usize>(grid: &Grid<D>, space: PressureSpace) -> Result<Grid<D>, Error> {
    if space != PressureSpace::TwoGrid {
        return Ok(*grid);
    }
    for axis in &grid.axes {
        let allowed = "even: a cell of the pressure spans two cells along every axis";
        require(axis.cells.is_multiple_of(2), "cells of an axis on two grids", axis.cells as f64, allowed)?;
    }
    let coarse = |axis: &Axis| Axis { cells: axis.cells / 2, ..*axis };
    Grid::new(2.0 * grid.h, grid.axes.each_ref().map(coarse))
}

/// Places the particle `k` on the grid; half the sizes (m) of its domain, which has the deformation of the start: the
/// mean extents of what it makes of the box, brought to the particle's volume.
///
/// # Errors
/// A particle off the grid, or whose domain is too wide for its functions.
pub(super) fn begin<const D: usize>(
    functions: &dyn OfHats<D>,
    particles: &mut Particles<D>,
    k: usize,
) -> Result<[f64; D], Fault> {
    let (before, f) = (particles.half_size, &particles.delta_f[k]);
    let after = std::array::from_fn(|a| before[a] * f[(a, a)]);
    let mut half_size = grown(&before, &after, particles.jacobian[k]);
    let grid = functions.grid();
    check_width(functions, &half_size)?;
    let x = &mut particles.position[k];
    Room::new(grid, half_size.map(|l| functions.beyond_wall(l))).place(x)?;
    keep_before_walls(grid, x, &mut half_size);
    Ok(half_size)
}

impl<const D: usize> Space<D> {
    fn on<I: OfHats<D>>(grid: Grid<D>) -> Result<Self, Error> {
        let functions = Box::new(I::on(grid)?);
        Ok(Self { originals: functions.originals(), functions })
    }
}

impl<const D: usize> Solver<D> {
    /// A solver of `scene`, whose pores are full of `water`, with `settings` at time zero.
    ///
    /// # Errors
    /// A setting, a property of the water or a particle that is not allowed; a contact, or a constraint on one side
    /// only or that holds no node of its own; a particle off the grid; a face without particles or in an empty cell, a
    /// plate without nodes or on nodes that something else holds.
    pub fn new<I: OfHats<D>>(scene: Scene<D>, water: Water<D>, settings: Settings) -> Result<Self, Error> {
        let of_pressure = grid_of_pressure(&scene.grid, settings.pressure_space)?;
        Self::on([Space::on::<I>(scene.grid)?, Space::on::<I>(of_pressure)?], scene, water, settings)
    }

    fn on(
        [solid_space, water_space]: [Space<D>; 2],
        mut scene: Scene<D>,
        water: Water<D>,
        settings: Settings,
    ) -> Result<Self, Error> {
        let sliding = scene.bodies.each.iter().filter(|body| body.slides.is_some()).count();
        require_none(sliding, "bodies with water that slide", "none: they stick where they touch")?;
        let laws = || scene.bodies.each.iter().map(|body| &body.law);
        settings.check(laws().all(|law| law.conservative()))?;
        let allowed = "none: rigid bodies are constraints in such a scene";
        require_none(scene.contacts.len(), "contacts of a body with water", allowed)?;
        held::check(&scene.constraints)?;
        let moduli: Vec<Moduli> = laws().map(|law| moduli_of(law.as_ref(), settings.dt)).collect();
        for own in &moduli {
            positive(own.mu, "shear modulus of a body with water", "positive (Pa)")?;
        }
        let moduli = moduli.into_iter().max_by(|a, b| a.mu.total_cmp(&b.mu)).unwrap_or(Moduli { lambda: 0.0, mu: 0.0 });
        let mut drained = vec![false; water_space.functions.len()];
        water_space.functions.for_each_node(&mut |node, place| drained[node] = (water.drained)(&place));
        let by_faces = |face: &super::Face<D>| matches!(face.acts, Acts::Drains { .. });
        let drains = drained.contains(&true) || water.faces.iter().any(by_faces);
        water.check(drains, &scene.bodies)?;
        for face in &water.faces {
            face.check(scene.bodies.particles.len())?;
        }
        let held = held::components(solid_space.functions.as_ref(), &scene, 0.0)?;
        let tied = ties(&water.plates, solid_space.functions.as_ref(), &held)?;
        scene.check_half_size()?;
        let particles = &mut scene.bodies.particles;
        let nodes = solid_space.functions.len() + water_space.functions.len();
        let mut ledger = Ledger::new([particles.len(), nodes], scene.constraints.len(), scene.bodies.each.len());
        ledger.convergence = Some(Convergence::default());
        let mut half_size = Vec::with_capacity(particles.len());
        for k in 0..particles.len() {
            let begun = begin(solid_space.functions.as_ref(), particles, k);
            half_size.push(begun.map_err(|fault| ledger.breakdown(&particles.id, k, fault))?);
        }
        let solid = solid_shares(&scene.bodies, &water);
        let particles = &scene.bodies.particles;
        for (k, (j, solid)) in particles.jacobian.iter().zip(solid).enumerate() {
            if *j <= solid {
                let fault = Fault::NonPositivePorosity(1.0 - solid / j);
                return Err(ledger.breakdown(&particles.id, k, fault));
            }
        }
        let particles = &mut scene.bodies.particles;
        particles.velocity = Vec::new();
        particles.affine = Vec::new();
        particles.increment = Vec::new();
        if scene.loads.is_empty() {
            particles.external_force = Vec::new();
        }
        let watched = if settings.watches_increments() { &particles.position[..] } else { &[] };
        let pressures = particles.position.iter().map(|x| (water.start)(x));
        let pores = Pores {
            pressure: pressures.collect(),
            slope: vec![[0.0; D]; watched.len()],
            place: watched.to_vec(),
            half_size,
        };
        let mut nodal_pressure = vec![f64::NAN; water_space.functions.len()];
        water_space.functions.for_each_node(&mut |node, place| nodal_pressure[node] = (water.start)(&place));
        let solver = Self {
            held,
            tied,
            direct: Direct::new(settings.tangent == Tangent::Symmetric),
            ledger,
            balance: WaterBalance::default(),
            drained,
            nodal_pressure,
            solid_space,
            water_space,
            pores,
            moduli,
            scene,
            water,
            settings,
        };
        solver.check_outside()?;
        Ok(solver)
    }

    /// Refuses faces of which the body bears less than all.
    fn check_outside(&self) -> Result<(), Error> {
        let [solid, water] = self.elements();
        let dt = self.duration();
        let unknowns = self.unknowns([&solid, &water], dt);
        let mut forces = vec![SVector::zeros(); self.solid_space.functions.len()];
        match self.outside(dt, &unknowns, &mut forces) {
            Ok(_) => Ok(()),
            Err(Failure::Particle(_, Fault::EmptyCell(share))) => require(
                false,
                "share of a corner of a loaded or drained face in an empty cell",
                share,
                "none: nodes in an empty cell bear no load and let no water out",
            ),
            Err(Failure::Lost(what, sum, _)) => {
                let allowed = "the whole: nodes in an empty cell bear nothing";
                require(false, what, sum, allowed)
            }
            Err(failure) => Err(self.error(failure)),
        }
    }
}
