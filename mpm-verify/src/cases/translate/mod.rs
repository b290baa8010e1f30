//! A prestressed body that crosses a hundred cells: its exact stress is constant, and every deviation is noise of crossing.

mod run;

use super::parameters::TimeStep;
use crate::cases::prelude::*;
use run::{PERIOD, Translation};

const LEVELS: [Level; 1] = [Level { name: "n8", h: 1.0 / PERIOD as f64 }];
/// Fastest body whose noise is predicted: beyond it the wave of the lattice is as fast as sound.
const SLOW: f64 = 0.06;

parameters! {
    struct Translate {
        stretch: f64 = real("-", "0.98", 0.8, 1.2), "equal stretch in the plane that the body is under: below 1 a pressure, above a tension";
        speed: f64 = real("-", "0.05", 1e-3, 0.5), "speed of the body over that of waves";
        cells: f64 = real("-", "100", 1.0, 1e5), "cells that it crosses";
        particles: usize = whole("-", "14", 8, 32), "particles in the eight cells of a period along the motion";
        cfl: f64 = common::CFL.with_default("0.3");
        time_step: TimeStep = common::TIME_STEP;
        flip: f64 = common::FLIP;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION, "particles per cell across the motion";
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        wall: common::Wall = common::WALL;
    }
}

metrics! { ALL:
    STRESS_NOISE = "stress_noise", "-", "largest rms over the particles of σ_xx minus its mean, over its exact value; 10⁻¹⁰ if it is less";
    STRESS_NOISE_MEAN = "stress_noise_mean", "-", "mean over the rows of the last half of the run of that rms over the exact value";
    STRESS_KEPT = "stress_kept", "-", "mean of σ_xx over the particles at the end, over its exact value";
    PREDICTED_NOISE = "predicted_noise", "-", "rms of the stress that answers the forces of a uniform stress on this lattice; flip without a remedy";
    VELOCITY_NOISE = "velocity_noise", "-", "largest rms of the velocity less that of the body, over its speed; 10⁻¹⁰ if it is less";
    MOMENTUM_ERROR = "momentum_error", "-", "largest change of the momentum over its start; 10⁻¹² if it is less";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy, over the kinetic energy at the start";
    ENERGY_LOSS = "energy_loss", "-", "largest fall of kinetic and stored energy, over the kinetic energy at the start";
    MASS = "mass", "kg/m", "mass of the body";
}

pub(super) fn case() -> Case {
    Case::of::<2, Translation>("translate", "A stress that crosses a hundred cells", ALL)
        .planned(plan())
        .described("A body under a uniform stress fills a periodic grid on a lattice that doesn't fit the cells and moves through a \
            hundred of them: exactly, nothing changes. What does is the noise of crossing, basis by basis.")
        .reference("Exact: translation keeps a uniform stress.")
        .reference("The forces of a lattice under a uniform stress and the stiffness that they meet, docs/translate.md.")
        .limit("One lattice, seven particles to four cells along the motion: another has other waves.")
        .limit("What is foretold is of particles at rest relative to each other and small noise.")
        .wanted("stress", "noise of the stress that is carried along", "domains-that-tile-are-silent noise")
        .checks(checks())
        .headline(STRESS_NOISE, "noise of the stress (%)", 100.0, 3)
        .headline(STRESS_NOISE_MEAN, "mean (%)", 100.0, 3)
        .headline(PREDICTED_NOISE, "predicted (%)", 100.0, 3)
        .headline(STRESS_KEPT, "mean stress kept (%)", 100.0, 1)
        .headline(VELOCITY_NOISE, "of the velocity (%)", 100.0, 3)
        .headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5)
        .watched(&["stress_kept", "stress_noise"])
        .sketch(Sketch::block("A body that fills a periodic grid of 8 by 4 cells and moves along it.", [1.0, 0.5])
            .load([0.35, 0.25], [0.65, 0.25])
            .note([0.5, 0.38], "0.05 c")
            .length([0.0, -0.08], [1.0, -0.08], "8 h, periodic"))
        .cost(|_| 0.2)
        .table(ResultTable::of("translate", Record::is_default)
            .by(&[SCHEME])
            .metric("noise of the stress, most", STRESS_NOISE, share(3))
            .metric("mean", STRESS_NOISE_MEAN, share(3))
            .metric("predicted", PREDICTED_NOISE, share(3))
            .metric("mean stress kept", STRESS_KEPT, share(1))
            .metric("noise of the velocity", VELOCITY_NOISE, share(3))
            .metric("energy gain", ENERGY_GAIN, SHORT))
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let mut all = pairs(&BASES, &REMEDIES);
    all.extend(other_transfers());
    all.extend([Linear, Gimp].map(|b| Scheme::explicit(b, none, TransferName::Musl)));
    let plain = pairs(&BASES, &[none]);
    let offered = pairs(&BASES[1..], &[none, FbarConsistent]);
    Plan::of(LEVELS)
        .runs(Quick, "n8", &plain[1..2], "cells=10")
        .runs(Pr, "n8", &all, "")
        .runs(Pr, "n8", &plain, "stretch=1.02")
        .each(Nightly, "n8", &all, ["stretch=1.02", "speed=0.1"])
        .runs(Nightly, "n8", &offered, "time_step=auto")
}

impl Setup<Translate> {
    fn is_plain(&self) -> bool {
        self.remedy() == RemedyName::None && self.transfer() == TransferName::Flip && self.flip == 1.0
    }

    /// Largest share of the mean stress that is kept by functions which lose stress.
    fn most_kept(&self) -> Option<f64> {
        match self.basis() {
            Linear => Some(0.5),
            Bspline2 => Some(0.9),
            Bspline3 if self.speed < SLOW => Some(0.99),
            _ => None,
        }
    }
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Translate>;
    vec![
        Check::truth("momentum", "momentum constant to rounding")
            .at_most(MOMENTUM_ERROR, |_| ROUNDING)
            .because("weights sum to one and their gradients to zero"),
        Check::truth("domains-that-tile-are-silent", "gimp with flip and no remedy: stress constant to rounding")
            .when(|b| b.is_plain() && b.basis() == Gimp)
            .at_most(STRESS_NOISE, |_| ROUNDING)
            .within(STRESS_KEPT, |_| 1.0, |_| ROUNDING)
            .because("domains that tile the body integrate a gradient of hats exactly: a uniform stress pushes no node"),
        Check::truth("noise", "other functions with flip and no remedy: noise of the stress at most twice the response to the lattice's forces")
            .when(|b| b.is_plain() && b.basis() != Gimp && b.speed < SLOW)
            .at_most(STRESS_NOISE, |b| (SWING * b.metric(PREDICTED_NOISE)).max(ROUNDING))
            .because("forces of a wave that the lattice makes, over the stiffness that it meets; twice of what begins at once"),
        Check::truth("no-energy-gain", "all but musl: kinetic and stored energy rise by rounding at most")
            .when(|b| b.transfer() != TransferName::Musl)
            .at_most(ENERGY_GAIN, |_| ROUNDING)
            .because("what a stress gives to the velocities that its errors make is taken from what it stores"),
        Check::known_limit("crossing", "linear functions and splines, a hundred cells: mean stress falls by more than a half (linear), a tenth (quadratic), a hundredth (cubic, slow)")
            .when(|b| b.cells >= 100.0 && b.transfer() != TransferName::Musl && b.most_kept().is_some())
            .at_most(STRESS_KEPT, |b| b.most_kept().unwrap_or(f64::NAN))
            .because("a uniform stress works on the velocities that its own quadrature error makes, and the transfer takes what it gives them"),
        Check::known_limit("musl-gains", "linear functions with musl, a hundred cells: energy rises by more than a tenth of the kinetic energy")
            .when(|b| b.basis() == Linear && b.transfer() == TransferName::Musl && b.cells >= 100.0)
            .above(ENERGY_GAIN, |_| 0.1)
            .because("the stress' work is that of velocities mapped again, not that of the nodes' forces"),
    ]
}
