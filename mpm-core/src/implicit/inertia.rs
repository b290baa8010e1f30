//! Inertia of a step: what dynamics adds to equilibrium, `docs/implicit.md`.
//!
//! A time rule makes of F_ext − f(u) = M a an equation in the increment x at the place where it holds,
//! c M x + f(x) = F_ext + b, with a factor c (1/s²) and what particles bring along, b (N).

use super::algebra::dot;
use super::elements::Elements;
use super::failure::Failure;
use super::settings::TimeRule;
use crate::particles::Particles;
use nalgebra::SVector;

/// Tolerance of a solution with the mass, maximum number of iterations, and the tolerance after these, where rounding
/// allows no more.
const TO: f64 = 1e-15;
const MOST: usize = 500;
const ENOUGH: f64 = 1e-10;

/// The mass M_β = (1 − β) M_c + β M_l on the functions of a step: M_c = Σ m w wᵀ, and M_l its sums of rows.
pub(super) struct Mass {
    /// The share β.
    pub(super) lumped: f64,
    /// Mass of every particle (kg).
    particle: Vec<f64>,
    /// Mass of every node (kg), zero of one that sees none.
    pub(super) node: Vec<f64>,
}

impl Mass {
    /// Mass of the heaviest node (kg).
    pub(super) fn heaviest(&self) -> f64 {
        self.node.iter().copied().fold(0.0, f64::max)
    }

    /// (1 − β) m of a particle (kg), of which a pair of functions has w w.
    pub(super) fn shared(&self, particle: usize) -> f64 {
        (1.0 - self.lumped) * self.particle[particle]
    }

    /// Σ m w `of`(particle) of every node.
    pub(super) fn scatter<const D: usize>(
        &self,
        elements: &Elements<D>,
        of: impl Fn(usize) -> SVector<f64, D> + Sync,
    ) -> Vec<SVector<f64, D>> {
        let mut nodes = vec![SVector::zeros(); self.node.len()];
        elements.scatter_values(SVector::zeros(), &mut nodes, |p| of(p) * self.particle[p]);
        nodes
    }

    /// M `x`.
    pub(super) fn times<const D: usize>(&self, elements: &Elements<D>, x: &[SVector<f64, D>]) -> Vec<SVector<f64, D>> {
        let shared = 1.0 - self.lumped;
        let mut product = self.scatter(elements, |p| elements.value(p, x) * shared);
        for ((sum, x), m) in product.iter_mut().zip(x).zip(&self.node) {
            *sum += x * (self.lumped * m);
        }
        product
    }

    /// The field that is `held` where something holds it, and elsewhere M times it is `right`, and how many iterations
    /// of conjugate gradients found it. Nodes without mass get zero.
    pub(super) fn solve<const D: usize>(
        &self,
        elements: &Elements<D>,
        right: &[SVector<f64, D>],
        held: impl Fn(usize, usize) -> Option<f64>,
    ) -> Result<(Vec<SVector<f64, D>>, u64), Failure> {
        let fixed = |node: usize, axis: usize| {
            let nothing = (self.node[node] <= 0.0).then_some(0.0);
            held(node, axis).or(nothing)
        };
        let at = |node: usize| SVector::from_fn(|a, _| fixed(node, a).unwrap_or(0.0));
        let free = |mut field: Vec<SVector<f64, D>>| {
            for (node, value) in field.iter_mut().enumerate() {
                for a in 0..D {
                    if fixed(node, a).is_some() {
                        value[a] = 0.0;
                    }
                }
            }
            field
        };
        let mut x: Vec<SVector<f64, D>> = (0..right.len()).map(at).collect();
        let carried = self.times(elements, &x);
        let mut rest = free(right.iter().zip(&carried).map(|(r, c)| r - c).collect());
        let over_mass = |field: &[SVector<f64, D>]| -> Vec<SVector<f64, D>> {
            let pairs = field.iter().zip(&self.node);
            pairs.map(|(r, m)| if *m > 0.0 { r / *m } else { SVector::zeros() }).collect()
        };
        let inner = |a: &[SVector<f64, D>], b: &[SVector<f64, D>]| {
            let pairs = a.iter().zip(b);
            pairs.map(|(a, b)| dot(a.as_slice(), b.as_slice())).sum::<f64>()
        };
        let mut direction = over_mass(&rest);
        let mut product = inner(&rest, &direction);
        let first = product;
        for iteration in 0..MOST {
            if product <= TO * TO * first {
                return Ok((x, iteration as u64));
            }
            let image = free(self.times(elements, &direction));
            let length = product / inner(&direction, &image);
            for (((x, d), r), i) in x.iter_mut().zip(&direction).zip(&mut rest).zip(&image) {
                *x += d * length;
                *r -= i * length;
            }
            let next = over_mass(&rest);
            let ahead = inner(&rest, &next);
            for (d, z) in direction.iter_mut().zip(&next) {
                *d = z + *d * (ahead / product);
            }
            product = ahead;
        }
        if product <= ENOUGH * ENOUGH * first {
            return Ok((x, MOST as u64));
        }
        Err(Failure::Singular(0))
    }
}

/// c M x and b of a step.
pub(super) struct Inertia<const D: usize> {
    /// M.
    pub(super) mass: Mass,
    /// c (1/s²).
    pub(super) factor: f64,
    /// b (N).
    pub(super) push: Vec<SVector<f64, D>>,
}

impl<const D: usize> Inertia<D> {
    /// Inertia in a step of `dt` (s) of a rule, if it has any.
    pub(super) fn of(
        rule: TimeRule,
        dt: f64,
        elements: &Elements<D>,
        nodes: usize,
        particles: &Particles<D>,
    ) -> Option<Self> {
        let velocity = |p: usize| SVector::from(particles.velocity[p]);
        let (lumped, factor) = match rule {
            TimeRule::Static => return None,
            TimeRule::Midpoint { lumped } => (lumped, 4.0 / (dt * dt)),
            TimeRule::Newmark { alpha, .. } => (1.0, 1.0 / (alpha * dt * dt)),
        };
        let node = elements.sums(nodes, &particles.mass).iter().map(|m| m.max(0.0)).collect();
        let mass = Mass { lumped, particle: particles.mass.clone(), node };
        let push = mass.scatter(elements, |p| match rule {
            TimeRule::Newmark { alpha, .. } => {
                let acceleration = SVector::from(particles.acceleration[p]);
                velocity(p) / (alpha * dt) + acceleration * (0.5 / alpha - 1.0)
            }
            _ => velocity(p) * (2.0 / dt),
        });
        Some(Self { mass, factor, push })
    }
}
