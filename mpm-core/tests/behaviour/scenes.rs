//! Bodies to try the solver on.

use mpm_core::explicit::remedy::{Fbar, Form, Onto, Standard};
use mpm_core::explicit::{Remedy, Settings, courant_time_step};
use mpm_core::material::{Law, NeoHookean};
use mpm_core::{Axis, Bodies, Grid, Particles, Scene, Simulation};

pub(crate) const DENSITY: f64 = 2.0;

pub(crate) fn law() -> NeoHookean {
    NeoHookean::new(100.0, 0.3).unwrap()
}

/// A block of particles, `per_cell` per cell and direction, filling `[lo, hi]` cells of size `h`.
pub(crate) fn block<const D: usize>(h: f64, per_cell: usize, lo: [usize; D], hi: [usize; D]) -> Particles<D> {
    let spacing = h / per_cell as f64;
    let counts: [usize; D] = std::array::from_fn(|a| (hi[a] - lo[a]) * per_cell);
    let total: usize = counts.iter().product();
    let positions = (0..total)
        .map(|k| {
            let mut rest = k;
            std::array::from_fn(|a| {
                let i = rest % counts[a];
                rest /= counts[a];
                lo[a] as f64 * h + (i as f64 + 0.5) * spacing
            })
        })
        .collect();
    Particles::new(positions, spacing.powi(D as i32), DENSITY, [0.5 * spacing; D]).unwrap()
}

/// A body of these particles on `grid`, and steps of the CFL number 0.3.
pub(crate) fn scene<const D: usize>(grid: Grid<D>, particles: Particles<D>) -> (Scene<D>, Settings<D>) {
    let law = law();
    let dt = courant_time_step(0.3, grid.h, law.wave_speed(DENSITY));
    let body = Bodies::new(law, particles).unwrap();
    (Scene::new(grid, body), Settings::new(dt))
}

pub(crate) fn scene_with<const D: usize, T>(
    grid: Grid<D>,
    particles: Particles<D>,
    transfer: T,
) -> (Scene<D>, Settings<D, T>) {
    let (scene, settings) = scene(grid, particles);
    (scene, settings.transfer(transfer))
}

pub(crate) fn remedies<const D: usize>() -> Vec<Box<dyn Remedy<D>>> {
    vec![
        Box::new(Standard),
        Box::new(Fbar::new(Form::Recursive)),
        Box::new(Fbar::new(Form::Total)),
        Box::new(Fbar::new(Form::Rate)),
        Box::new(Fbar::new(Form::Consistent)),
        Box::new(Fbar::new(Form::Bbar).onto(Onto::Cells)),
        Box::new(Fbar::new(Form::Consistent).onto(Onto::Hats)),
        Box::new(Fbar::new(Form::Bbar).onto(Onto::Blocks)),
        Box::new(Fbar::new(Form::Bbar).onto(Onto::Patches)),
        Box::new(Fbar::new(Form::Consistent).onto(Onto::Patches).relaxing(10.0)),
    ]
}

/// Positions by identity.
pub(crate) fn places(run: &dyn Simulation<2>) -> Vec<[f64; 2]> {
    let p = run.particles();
    p.seeded(|k| p.position[k])
}

/// Result of `work` in a pool of `threads` threads.
pub(crate) fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(work)
}

pub(crate) fn open_grid<const D: usize>(h: f64, cells: usize) -> Grid<D> {
    Grid::new(h, [Axis::open(0.0, cells); D]).unwrap()
}

/// A motion with gradients, decided by position alone.
pub(crate) fn swirl<const D: usize>(particles: &mut Particles<D>, speed: f64) {
    for (v, x) in particles.velocity.iter_mut().zip(&particles.position) {
        for a in 0..D {
            v[a] = speed * (3.0 * x[(a + 1) % D] + a as f64).sin();
        }
    }
}

/// Σ m (x × v + ε:B), as an antisymmetric matrix.
pub(crate) fn angular_momentum<const D: usize>(p: &Particles<D>) -> [[f64; D]; D] {
    let mut sum = [[0.0; D]; D];
    for k in 0..p.len() {
        let (m, x, v) = (p.mass[k], &p.position[k], &p.velocity[k]);
        let spin = |a, b| p.affine.get(k).map_or(0.0, |q| q[(b, a)] - q[(a, b)]);
        for a in 0..D {
            for b in 0..D {
                sum[a][b] += m * (x[a] * v[b] - x[b] * v[a] + spin(a, b));
            }
        }
    }
    sum
}
