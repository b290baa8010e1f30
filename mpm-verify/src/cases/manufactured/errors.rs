//! Errors of a run against the exact motion.

use super::{metrics::*, vector};
use crate::cases::prelude::*;

/// Displacement of a particle minus the exact one (m); across a periodic end the nearest image counts.
pub(in crate::cases) fn of_displacement<const D: usize>(
    solution: &dyn Exact,
    p: &Particles<D>,
    k: usize,
    t: f64,
) -> Vector3<f64> {
    let x = vector(&p.reference[k]);
    let exact = x + solution.displacement(&x, t);
    let mut error = vector(&p.position[k]) - exact;
    let grid_extent = solution.extent();
    for a in 0..D {
        let length = grid_extent[a][1] - grid_extent[a][0];
        error[a] -= length * (error[a] / length).round();
    }
    error
}

/// Magnitudes of the displacement errors of all particles (m).
pub(in crate::cases) fn of_displacements<const D: usize>(solution: &dyn Exact, run: &dyn Simulation<D>) -> Vec<f64> {
    let (p, t) = (run.particles(), run.time());
    (0..p.len()).map(|k| of_displacement(solution, p, k, t).norm()).collect()
}

/// Cauchy stress of a run, as it enters the forces, minus that of the exact motion (Pa), in the particles' order.
pub(in crate::cases) fn of_stress<const D: usize>(
    solution: &dyn Exact,
    run: &mut dyn Simulation<D>,
) -> Vec<Matrix3<f64>> {
    let t = run.time();
    let stress = run.force_stress();
    let references = &run.particles().reference;
    let pairs = references.iter().zip(stress).map(|(x, s)| {
        let x = vector(x);
        let f = solution.deformation_gradient(&x, t);
        let p = solution.first_piola(&x, t);
        s.to_matrix() - p * f.transpose() / f.determinant()
    });
    pairs.collect()
}

/// Magnitudes of the errors of stress and mean stress of all particles (Pa).
pub(in crate::cases) fn of_stresses<const D: usize>(
    solution: &dyn Exact,
    run: &mut dyn Simulation<D>,
) -> [Vec<f64>; 2] {
    let errors = of_stress(solution, run);
    let mean = errors.iter().map(|s| (s.trace() / 3.0).abs()).collect();
    [errors.iter().map(|s| s.norm()).collect(), mean]
}

/// Rms and largest of the errors of all particles, as two metrics.
pub(super) fn norms([l2, linf]: [Metric; 2], errors: &[f64]) -> [(Metric, f64); 2] {
    [(l2, rms(errors.iter().copied())), (linf, errors.iter().copied().fold(0.0, f64::max))]
}

/// Metrics that every motion has at its end: errors of displacement and stress, and masses.
pub(in crate::cases) fn at_end<const D: usize>(
    solution: &dyn Exact,
    run: &mut dyn Simulation<D>,
) -> Vec<(Metric, f64)> {
    let [stress, mean_stress] = of_stresses(solution, run);
    let (displacement, totals) = (of_displacements(solution, run), run.totals());
    let volume: f64 = solution.extent()[..D].iter().map(|[lo, hi]| hi - lo).product();
    let mut values = vec![
        (LOG_JACOBIAN_GAP, totals.log_jacobian_gap_rms),
        (MASS, totals.mass),
        (BODY_MASS, volume * solution.material().density),
    ];
    values.extend(norms([DISPLACEMENT_L2, DISPLACEMENT_LINF], &displacement));
    values.extend(norms([STRESS_L2, STRESS_LINF], &stress));
    values.extend(norms([MEAN_STRESS_L2, MEAN_STRESS_LINF], &mean_stress));
    values
}
