//! Where the slab begins: a quarter of it.

use super::parameters::{
    CONDUCTIVITY, LOAD, POISSON_RATIO, POROSITY, PROJECTION, STEPS, TOLERANCE, YOUNG_MODULUS,
};
use crate::exact::mandel::{Cells, Mandel, Slab, of_particles};
use crate::parameter::Parameters;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::spec::RunSpec;
use mpm_core::material::Hencky;
use mpm_core::poro::{Conductivity, Plate, PressureSpace, Settings, Water};
use mpm_core::stage::{End, Wall, WallKind};
use mpm_core::{Axis, Body, Error, Grid, Particles, Scene, Side, Simulation};

/// Half the width a, and half the height b (m).
pub(super) const WIDTH: f64 = 1.0;
pub(super) const HEIGHT: f64 = 0.25;
/// T = c t/a² at the end.
pub(super) const END: f64 = 0.3;
/// From this T on errors are measured: a first step is none yet of what an exact solution would do.
pub(super) const FROM: f64 = 0.01;
/// Particles a cell along an axis.
pub(super) const PER_CELL: usize = 2;
/// Empty cells beside and above it: of eight cells of the displacement an axis has four of the pressure, the fewest.
const ROOM: [usize; 2] = [2, 6];
/// The largest F/(G a): ten times as much, which what is finite of the strain may add to a distance, is a percent.
pub(super) const SMALL: f64 = 1e-3;
/// Weight of water (N/m³).
const WATER_WEIGHT: f64 = 9810.0;

/// Oedometric modulus M (Pa) and shear modulus G (Pa).
pub(super) fn moduli(parameters: &Parameters) -> [f64; 2] {
    let ratio = parameters.number(POISSON_RATIO);
    let shear = parameters.number(YOUNG_MODULUS) / (2.0 * (1.0 + ratio));
    [2.0 * shear * (1.0 - ratio) / (1.0 - 2.0 * ratio), shear]
}

/// κ (m²/(Pa s)).
fn kappa(parameters: &Parameters) -> f64 {
    parameters.number(CONDUCTIVITY) / WATER_WEIGHT
}

/// a²/c (s).
pub(super) fn time_scale(parameters: &Parameters) -> f64 {
    WIDTH * WIDTH / (kappa(parameters) * moduli(parameters)[0])
}

/// Steps, and the duration of one (T).
pub(super) fn steps(parameters: &Parameters) -> (i32, f64) {
    let count = parameters.number(STEPS);
    (count as i32, END / count)
}

/// The step after which errors are measured.
pub(super) fn first_measured(parameters: &Parameters) -> i32 {
    let (_, step) = steps(parameters);
    (FROM / step * (1.0 - 1e-9)).ceil() as i32
}

/// τ M of a run's projection; zero of one without.
fn projection(scheme: Scheme, parameters: &Parameters) -> f64 {
    let [modulus, shear] = moduli(parameters);
    match scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => {
            parameters.number(PROJECTION) * modulus / (2.0 * shear)
        }
        _ => 0.0,
    }
}

/// The slab, exactly, from the first step on.
pub(super) fn slab(parameters: &Parameters) -> Mandel {
    Mandel::new(parameters.number(POISSON_RATIO), steps(parameters).1)
}

/// The slab in a run's steps, from where errors are measured.
pub(super) fn slab_of_steps(parameters: &Parameters) -> Mandel {
    let ratio = parameters.number(POISSON_RATIO);
    Mandel::of_steps(ratio, steps(parameters).1, first_measured(parameters))
}

fn cells(scheme: Scheme, h: f64, parameters: &Parameters) -> Cells {
    let n = (WIDTH / h).round() as usize;
    match scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => Cells::two_grid(n),
        _ => Cells::same(n, projection(scheme, parameters)),
    }
}

/// The slab by the difference equations of cells of size `h` (m), exactly in time.
pub(super) fn slab_of_cells(scheme: Scheme, h: f64, parameters: &Parameters) -> Mandel {
    let cells = cells(scheme, h, parameters);
    Mandel::of_cells(parameters.number(POISSON_RATIO), cells)
}

/// Likewise after every step of a run. Means of hats give the outermost particles strains of their own.
pub(super) fn slab_of_run(scheme: Scheme, h: f64, parameters: &Parameters) -> Vec<Slab> {
    let (count, step) = steps(parameters);
    let ratio = parameters.number(POISSON_RATIO);
    let apart = scheme.basis() == BasisName::Gimp;
    of_particles(ratio, cells(scheme, h, parameters), apart, step, count)
}

/// The simulation at its start: the planes of symmetry at zero.
///
/// # Errors
/// The parameters don't make a scene, or the scheme doesn't solve it.
pub(super) fn begin(
    spec: &RunSpec,
    parameters: &Parameters,
) -> Result<Box<dyn Simulation<2>>, Error> {
    let number = |p| parameters.number(p);
    let h = spec.level.h;
    let cells = [WIDTH, HEIGHT].map(|length| (length / h).round() as usize);
    let axis = |a: usize| Axis::bounded(0.0, cells[a] + ROOM[a], (Side::Wall, Side::Open));
    let grid = Grid::new(h, [axis(0), axis(1)])?;
    let spacing = h / PER_CELL as f64;
    let row = cells[0] * PER_CELL;
    let places = (0..row * cells[1] * PER_CELL)
        .map(|k| [k % row, k / row].map(|i| (i as f64 + 0.5) * spacing));
    // Nothing moves by its weight: any density will do.
    let particles = Particles::new(
        spec.start_at(places.collect()),
        spacing * spacing,
        1000.0,
        [0.5 * spacing; 2],
    )?;
    let law = Hencky::new(number(YOUNG_MODULUS), number(POISSON_RATIO))?;
    let roller = |axis| Wall {
        axis,
        end: End::Lo,
        kind: WallKind::Roller,
    };
    let scene = Scene::new(grid, Body::new(law, particles)?).constrain_all([0, 1].map(roller));
    let load = number(LOAD);
    let water = Water::new(number(POROSITY), Conductivity::Constant(kappa(parameters)))
        .drained(move |x| x[0] > WIDTH - 0.25 * h)
        .plate(Plate::new(
            1,
            move |x| x[1] > HEIGHT - 0.25 * h,
            move |_| -load,
        ));
    let [modulus, _] = moduli(parameters);
    let pressure_space = match spec.scheme {
        Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
        Scheme::Poro(parts) if parts.space == SpaceName::Ppp => PressureSpace::Projected {
            strength: projection(spec.scheme, parameters) / modulus,
        },
        // Of another kind of scheme no solver is compiled.
        _ => PressureSpace::Equal,
    };
    let settings = Settings {
        pressure_space,
        tolerance: number(TOLERANCE),
        ..Settings::new(steps(parameters).1 * time_scale(parameters))
    };
    mpm_solvers::poro(spec.scheme, scene, water, settings)
}
