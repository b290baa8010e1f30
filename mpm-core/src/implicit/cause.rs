//! Cause of a step without equilibrium, told by the motion of the body that meets the least resistance.

use super::algebra::{dot, norm};
use super::elements::Elements;
use super::linear::Direct;
use super::{GHOST, Setting, Solver, contact};
use crate::error::Cause;
use nalgebra::SVector;

/// Inverse iterations that find the softest motion: each divides other motions by the ratio of their stiffnesses.
const ITERATIONS: usize = 12;
/// A motion of which particles see a smaller share is one of functions at the rim.
const HARDLY_SEEN: f64 = 1e-2;
/// Such a motion stops a run where it is softer than a tenth of what the ghost penalty of scenes leaves it.
const SOFT_RIM: f64 = 0.1 * GHOST;
/// A motion whose strain times h is a smaller share of it is rigid, squared: a beam of ten thousand cells bends by more.
const RIGID: f64 = 1e-10;
/// Particles that move by more than this share of the fastest one move.
const MOVES: f64 = 0.1;
/// A body whose stiffness is a smaller share of the elastic one gives way.
const GIVES_WAY: f64 = 0.1;
/// Share of the greatest diagonal entry that keeps the matrix of a loose body regular.
const SHIFT: f64 = 1e-13;

/// A motion: values of all nodes (m), and the energy uᵀ K u (J).
struct Motion<const D: usize> {
    nodes: Vec<[f64; D]>,
    energy: f64,
}

impl<const D: usize> Motion<D> {
    /// Squares of the particles' displacements (m²) and of their deviatoric strains.
    fn on_particles(&self, elements: &Elements<D>, count: usize) -> [Vec<f64>; 2] {
        let moved = (0..count).map(|p| {
            let (nodes, w, _) = elements.seen(p);
            let parts = nodes.iter().zip(w).map(|(node, w)| SVector::from(self.nodes[*node]) * *w);
            parts.sum::<SVector<f64, D>>().norm_squared()
        });
        let strain = (0..count).map(|p| {
            let gradient = elements.gradient(p, &self.nodes);
            let strain = (gradient + gradient.transpose()) * 0.5;
            strain.norm_squared() - strain.trace().powi(2) / 3.0
        });
        [moved.collect(), strain.collect()]
    }
}

/// Place of the greatest of some values.
fn most(of: &[f64]) -> usize {
    (0..of.len()).fold(0, |most, k| if of[k] > of[most] { k } else { most })
}

fn in_space<const D: usize>(x: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|a| x.get(a).copied().unwrap_or(f64::NAN))
}

impl<const D: usize> Solver<D> {
    /// The factors of the stiffness at the last equilibrium.
    fn factors(&self, setting: &Setting<D>) -> Option<Direct> {
        let pattern = &setting.pattern;
        let step = setting.step(&self.scene.bodies, self.settings.rule.place() * self.settings.dt);
        let trial = step.trial(&vec![0.0; setting.unknowns.len()], self.functions.len()).ok()?;
        let mut values = step.stiffness(&step.tangents(&trial), pattern);
        let diagonal: Vec<usize> = (0..pattern.len()).filter_map(|i| pattern.place(i, i)).collect();
        let greatest = diagonal.iter().fold(0.0, |greatest: f64, k| greatest.max(values[*k].abs()));
        diagonal.iter().for_each(|k| values[*k] += SHIFT * greatest);
        let mut direct = Direct::new(contact::is_symmetric(&self.scene));
        direct.analyse(pattern).and_then(|()| direct.factorise(&values)).ok()?;
        Some(direct)
    }

    /// The softest motion where nodes weigh as told, by inverse iteration.
    fn softest(&self, setting: &Setting<D>, direct: &mut Direct, weight: &[f64]) -> Option<Motion<D>> {
        let unknowns = &setting.unknowns;
        let weigh = |(i, x): (usize, &f64)| match unknowns.is_free(i / D, i % D) {
            true => x * weight[unknowns.node[i / D]],
            false => 0.0,
        };
        // No symmetry of a body has all its motions orthogonal to this one.
        let mut x: Vec<f64> = (0..unknowns.len()).map(|i| (i as f64).sin() + 1.5).collect();
        let mut energy = f64::NAN;
        for _ in 0..ITERATIONS {
            let size = norm(&x);
            x.iter_mut().for_each(|x| *x /= size);
            let weighed: Vec<f64> = x.iter().enumerate().map(weigh).collect();
            x = direct.displacements::<D>(&weighed);
            energy = dot(&x, &weighed);
        }
        let mut nodes = vec![[0.0; D]; self.functions.len()];
        unknowns.spread(&x, &mut nodes);
        (norm(&x).is_finite() && norm(&x) > 0.0).then_some(Motion { nodes, energy })
    }

    /// Why no equilibrium was found from the present one on: with the factors of the last iteration, if it has any, in
    /// which the body flows where it yields.
    pub(super) fn cause(&mut self, has_factors: bool) -> Cause {
        let setting = self.setting(self.settings.dt);
        let symmetric = contact::is_symmetric(&self.scene);
        let last = std::mem::replace(&mut self.direct, Direct::new(symmetric));
        let last = Some(last).filter(|direct| has_factors && direct.pattern == setting.pattern);
        let found = last.and_then(|direct| self.found_cause(&setting, direct));
        let at_rest = || self.found_cause(&setting, self.factors(&setting)?);
        found.or_else(at_rest).unwrap_or(Cause::Unknown)
    }

    fn found_cause(&self, setting: &Setting<D>, mut direct: Direct) -> Option<Cause> {
        let (particles, h) = (&self.scene.bodies.particles, self.functions.grid().h);
        let (cell, elements) = (h.powi(D as i32), &setting.elements);
        let sums = elements.sums(self.functions.len(), &particles.volume);
        let seen: Vec<f64> = sums.iter().map(|sum| sum.max(0.0) / cell).collect();
        // Functions alone, whatever they see: those that a hair of the body leaves loose come first.
        let rim = self.softest(setting, &mut direct, &vec![1.0; seen.len()])?;
        let [moved, _] = rim.on_particles(elements, particles.len());
        let size: Vec<f64> = rim.nodes.iter().map(|u| SVector::from(*u).norm_squared()).collect();
        let whole: f64 = size.iter().sum();
        let soft = SOFT_RIM * self.moduli.young() * cell / (h * h) * whole;
        if dot(&particles.volume, &moved) < HARDLY_SEEN * cell * whole && rim.energy.abs() < soft {
            let (node, mut at) = (most(&size), [f64::NAN; D]);
            self.functions.for_each_node(&mut |k, x| at = if k == node { x } else { at });
            return Some(Cause::Rim(in_space(&at), seen[node]));
        }
        let body = self.softest(setting, &mut direct, &seen)?;
        let [moved, strain] = body.on_particles(elements, particles.len());
        let strained = dot(&particles.volume, &strain);
        if strained * h * h < RIGID * dot(&particles.volume, &moved) {
            let fastest = moved[most(&moved)];
            let moving: Vec<usize> = (0..moved.len()).filter(|p| moved[*p] > MOVES * MOVES * fastest).collect();
            let volume: f64 = moving.iter().map(|p| particles.volume[*p]).sum();
            let parts = moving.iter().map(|p| SVector::from(particles.position[*p]) * (particles.volume[*p] / volume));
            let at = in_space(&parts.sum::<SVector<f64, D>>().into());
            return Some(Cause::Loose(at, volume / particles.volume.iter().sum::<f64>()));
        }
        let share = body.energy / (2.0 * self.moduli.mu * strained);
        Some(match share < GIVES_WAY {
            true => Cause::GivesWay(in_space(&particles.position[most(&strain)]), share),
            false => Cause::Sound(share),
        })
    }
}
