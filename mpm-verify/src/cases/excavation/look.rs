//! What can be seen of the particles.

use super::parameters::{PEAK, RESIDUAL, SOFTENING};
use super::scene::HEIGHT;
use crate::parameter::Parameters;
use mpm_core::{Field, Simulation};

/// Largest displacement (m) from these places, in seeding order.
pub(super) fn moved(start: &[[f64; 2]], run: &dyn Simulation<2>) -> f64 {
    let p = run.particles();
    let now = p.seeded(|k| p.position[k]);
    let pairs = start.iter().zip(&now);
    let distance = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
    distance.fold(0.0, f64::max)
}

/// The edge (m) of the particle that lies farthest from the rollers.
pub(super) fn front(run: &dyn Simulation<2>) -> f64 {
    let p = run.particles();
    let farthest = p.position.iter().map(|x| x[0]).fold(0.0, f64::max);
    farthest + p.half_size[0]
}

/// Largest settlement (m), from these places, of what was the crest's layer of particles.
pub(super) fn crest_drop(start: &[[f64; 2]], run: &dyn Simulation<2>) -> f64 {
    let p = run.particles();
    let now = p.seeded(|k| p.position[k][1]);
    let first = p.seeded(|k| p.reference[k][1]);
    let top = HEIGHT - 2.0 * p.half_size[1];
    let columns = start.iter().zip(&now).zip(&first);
    let drops = columns
        .filter(|(_, y)| **y > top)
        .map(|((a, b), _)| a[1] - b);
    drops.fold(0.0, f64::max)
}

/// Area (m²) whose strength is residual; none where strength doesn't fall.
pub(super) fn softened(parameters: &Parameters, run: &mut dyn Simulation<2>) -> f64 {
    let number = |p| parameters.number(p);
    if number(PEAK) == number(RESIDUAL) {
        return 0.0;
    }
    let end = (number(PEAK) - number(RESIDUAL)) / number(SOFTENING);
    let strain = run.field(Field::PlasticStrain);
    let pairs = strain.iter().zip(&run.particles().volume);
    pairs.filter(|(e, _)| **e >= end).map(|(_, v)| v).sum()
}

/// Stresses (Pa) in seeding order.
pub(super) fn stresses(run: &dyn Simulation<2>) -> Vec<[f64; 4]> {
    let p = run.particles();
    p.seeded(|k| {
        let s = p.stress[k];
        [s.xx, s.yy, s.zz, s.xy]
    })
}

/// Largest difference (Pa) of the stresses that both lists have.
pub(super) fn difference(before: &[[f64; 4]], after: &[[f64; 4]]) -> f64 {
    let pairs = before.iter().flatten().zip(after.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
