//! The linear model: waves on the particles of a periodic axis, in closed form for a step.

use mpm_core::basis::WallTreatment;
use mpm_core::explicit::Remedy;
use mpm_core::explicit::remedy::{Fbar, Form, Standard};
use mpm_core::{Axis, Basis};
use nalgebra::Complex;
use std::f64::consts::TAU;

pub(super) type Wave = Vec<Complex<f64>>;

pub(super) const H: f64 = 0.5;
pub(super) const CELLS: usize = 16;
pub(super) const LENGTH: f64 = H * CELLS as f64;
/// ε of the consistent average.
pub(super) const UNSEEN: f64 = 0.01;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    None,
    Recursive,
    Total,
    Rate,
    Consistent,
}

pub(super) const KINDS: [Kind; 5] = [Kind::None, Kind::Recursive, Kind::Total, Kind::Rate, Kind::Consistent];

impl Kind {
    pub(super) fn remedy<const D: usize>(self) -> Box<dyn Remedy<D>> {
        match self {
            Self::None => Box::new(Standard),
            Self::Recursive => Box::new(Fbar::new(Form::Recursive)),
            Self::Total => Box::new(Fbar::new(Form::Total)),
            Self::Rate => Box::new(Fbar::new(Form::Rate)),
            Self::Consistent => Box::new(Fbar::new(Form::Consistent).relaxing(0.0)),
        }
    }
}

/// Waves e^{iθx/h} on the nodes of a periodic axis with `n` particles per cell. The particles of one cell define what
/// all carry: those of the cell `c` carry e^{iθc} times as much.
pub(super) struct Bloch<const S: usize, B> {
    basis: B,
    nodes: Vec<f64>,
    n: usize,
    theta: f64,
}

impl<const S: usize, B: Basis<S>> Bloch<S, B> {
    pub(super) fn new(n: usize, theta: f64) -> Self {
        let basis = B::new(&Axis::periodic(0.0, CELLS), H, WallTreatment::OpenKnot);
        Self { nodes: basis.nodes().position, basis, n, theta }
    }

    /// The nodal wave, φ, and h times its gradient, ψ, as the particles of the first cell see them after
    /// all have moved by `shift` (m).
    pub(super) fn seen(&self, shift: f64) -> (Wave, Wave) {
        let see = |j| {
            let x = (j as f64 + 0.5) * H / self.n as f64 + shift;
            let at = self.basis.weights(x.rem_euclid(LENGTH), 0.5 * H / self.n as f64);
            let mut sums = (Complex::ZERO, Complex::ZERO);
            for k in 0..S {
                let wave = Complex::cis(self.theta * self.nodes[at.first + k] / H);
                sums.0 += wave * at.w[k];
                sums.1 += wave * at.dw[k] * H;
            }
            sums
        };
        (0..self.n).map(see).unzip()
    }

    /// Value of `wave` at the particle with the number `id`.
    pub(super) fn carried(&self, wave: &Wave, id: usize) -> Complex<f64> {
        Complex::cis(self.theta * (id / self.n) as f64) * wave[id % self.n]
    }
}

/// (a, b) = (1/n) Σ a* b.
pub(super) fn product(a: &Wave, b: &Wave) -> Complex<f64> {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum::<Complex<f64>>() / a.len() as f64
}

/// a ← a + factor b.
pub(super) fn add(a: &mut Wave, factor: Complex<f64>, b: &Wave) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += factor * b;
    }
}

/// Deterministic noise.
pub(super) fn noise(n: usize, seed: usize) -> Wave {
    (0..n).map(|j| Complex::cis((1 + seed + j) as f64 * 2.4) * (1.0 + (7.7 * j as f64).sin())).collect()
}

/// The wave number kh of `m` waves on the grid.
pub(super) fn theta(m: usize) -> f64 {
    TAU * m as f64 / CELLS as f64
}

/// A wave on particles that all move with one velocity, in the linear model: velocities over c, what J, J̄ and
/// the places (over h) differ by from those of the mean motion.
#[derive(Clone)]
pub(super) struct Moving {
    pub(super) velocity: Wave,
    jacobian: Wave,
    j_bar: Wave,
    place: Wave,
}

impl Moving {
    pub(super) fn new(velocity: Wave) -> Self {
        let zero = vec![Complex::ZERO; velocity.len()];
        Self { velocity, jacobian: zero.clone(), j_bar: zero.clone(), place: zero }
    }

    /// The root of the energy, kinetic and stored; J and the places only drift.
    pub(super) fn norm(&self) -> f64 {
        [&self.velocity, &self.j_bar].map(|q| product(q, q).re).iter().sum::<f64>().sqrt()
    }

    /// One step of Courant number `tau` under the mean stress `mean` (over ρc²), with the particles `shift`
    /// (m) from where they started.
    pub(super) fn step<const S: usize, B: Basis<S>>(
        &mut self,
        axis: &Bloch<S, B>,
        kind: Kind,
        tau: f64,
        mean: f64,
        shift: f64,
    ) {
        let (phi, psi) = axis.seen(shift);
        // The slope of ψ, exact for pieces of up to second degree.
        let small = 1e-6 * H;
        let (ahead, behind) = (axis.seen(shift + small).1, axis.seen(shift - small).1);
        let mut chi = ahead;
        add(&mut chi, -Complex::ONE, &behind);
        chi.iter_mut().for_each(|c| *c *= H / (2.0 * small));

        let project = |q: &Wave| -> Wave {
            let share = product(&phi, q);
            phi.iter().map(|f| f * share).collect()
        };
        let sharp = |q: &Wave| -> Wave {
            let seen = project(q);
            let mut rough = q.clone();
            add(&mut rough, -Complex::ONE, &seen);
            let mut out = seen;
            add(&mut out, (1.0 - UNSEEN).into(), &project(&rough));
            add(&mut out, UNSEEN.into(), &rough);
            out
        };

        // V σ over V⁰ ρc²: mean (1 + j) + j̄, or with the averages of the consistent force.
        let (j, j_bar) = (&self.jacobian, &self.j_bar);
        let mut stress = j_bar.clone();
        if kind == Kind::Consistent {
            add(&mut stress, mean.into(), j_bar);
            add(&mut stress, (-mean).into(), j);
            stress = sharp(&stress);
        }
        add(&mut stress, mean.into(), j);
        let force = -product(&psi, &stress) - product(&chi, &self.place) * mean;
        let nodal = product(&phi, &self.velocity) + force * tau;

        add(&mut self.velocity, force * tau, &phi);
        add(&mut self.place, nodal * tau, &phi);
        let strain: Wave = psi.iter().map(|s| s * nodal * tau).collect();
        add(&mut self.jacobian, Complex::ONE, &strain);
        match kind {
            Kind::None => self.j_bar.clone_from(&self.jacobian),
            Kind::Total => self.j_bar = project(&self.jacobian),
            Kind::Rate => add(&mut self.j_bar, Complex::ONE, &project(&strain)),
            Kind::Consistent => add(&mut self.j_bar, Complex::ONE, &sharp(&strain)),
            Kind::Recursive => {
                add(&mut self.j_bar, Complex::ONE, &strain);
                self.j_bar = project(&self.j_bar);
            }
        }
    }
}
