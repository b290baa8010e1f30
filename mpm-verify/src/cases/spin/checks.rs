//! What is checked of the disc. The bounds are derived in `docs/spin.md`.

use super::metrics as m;
use super::parameters::{FLIP, PPC_PER_DIRECTION, RIM_SPEED, TURNS};
use super::scene::RADIUS;
use crate::check::{Check, Finding, judge, run, study};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, TransferName};

/// What a sum over the particles gathers of rounding in a step, of many: nothing is kept better.
const ROUNDING: f64 = 1e-9;
/// Turns up to which a disc is judged by the exact one; beyond them by what its transfer takes.
const SHORT: f64 = 2.0;
/// Order of what FLIP loses.
const ORDER: f64 = 2.0;
/// Half of what there was.
const HALF: f64 = 0.5;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "momentum",
            "linear momentum stays zero, to rounding",
            run(|r| {
                let why = "weights sum to one and their gradients to zero";
                Some(judge(r, m::MOMENTUM_ERROR).at_most(ROUNDING, why))
            }),
        ),
        Check::truth(
            "affine-keeps-angular-momentum",
            "apic: angular momentum, that of the affine parts with it, is kept to rounding",
            run(|r| {
                let why = "the affine part carries what a node's arm has (Jiang et al. 2015), and stresses are symmetric";
                (r.transfer() == TransferName::Apic)
                    .then(|| judge(r, m::ANGULAR_MOMENTUM_ERROR).at_most(ROUNDING, why))
            }),
        ),
        Check::truth(
            "affine-parts-take-their-share",
            "apic, up to two turns: the disc turns slower by what its affine parts, which start at rest, take of the angular momentum: by 4D/R² over one and that, D the mean second moment of the functions, within h/R of it",
            run(|r| {
                let h = r.discretisation.h;
                // Hats averaged over places, and over a domain of half the spacing; quadratic splines everywhere.
                let half = 0.5 / r.parameters.number(PPC_PER_DIRECTION);
                let moment = match r.basis() {
                    BasisName::Gimp => 1.0 / 6.0 + half * half / 3.0,
                    _ => 0.25,
                };
                let share = 4.0 * moment * (h / RADIUS).powi(2);
                let slower = share / (1.0 + share);
                let why = "angular momentum is kept, and I ω is then (M R²/2 + 2 M D) ω";
                (r.transfer() == TransferName::Apic && !is_long(r))
                    .then(|| judge(r, m::PHASE_ERROR).within(-slower, h / RADIUS * slower, why))
            }),
        ),
        Check::truth(
            "no-energy-gain",
            "none and fbar-consistent, not musl: kinetic and stored energy never above their start by more than what is stored at the start",
            run(|r| {
                let why = "velocities live half a step before places: what the disc stores and its motion can exchange, and no more";
                let keeps = matches!(r.remedy(), RemedyName::None | RemedyName::FbarConsistent);
                (keeps && r.transfer() != TransferName::Musl)
                    .then(|| judge(r, m::ENERGY_GAIN).at_most(r.metric(m::STORED_SHARE), why))
            }),
        ),
        Check::truth(
            "stretch",
            "splines with flip and apic and no remedy, up to two turns: the mean stretch of their last half is that of the exact disc, within h/R of it and the strain's square",
            run(|r| {
                let judged = matches!(r.transfer(), TransferName::Flip | TransferName::Apic);
                let plain = r.remedy() == RemedyName::None && r.parameters.number(FLIP) == 1.0;
                let bound = r.discretisation.h / RADIUS + r.parameters.number(RIM_SPEED).powi(2);
                let why = "the rim lies within a cell, and the exact disc is that of small strains";
                let splines = r.basis().degree() > 1 && r.basis() != BasisName::Gimp;
                (judged && plain && splines && !is_long(r)).then(|| {
                    judge(r, m::STRETCH_MEAN_ERROR)
                        .within(0.0, bound, why)
                        .of_scale(1.0)
                })
            }),
        ),
        Check::truth(
            "loss-falls-with-cells",
            "flip, two turns: the loss of angular momentum falls with h² from 4 to 8 cells in the radius, to within 0.15 of the order",
            study(|records| {
                let of = |r: &&Record| r.transfer() == TransferName::Flip && r.set == ["turns=2"];
                let lost = |r: &Record| r.metric(m::ANGULAR_MOMENTUM_ERROR);
                let runs = || records.iter().filter(of).filter(|r| lost(r).is_finite());
                let pairs = runs().flat_map(|a| runs().map(move |b| (a, b)));
                let pairs = pairs.filter(|(a, b)| {
                    a.scheme() == b.scheme() && a.discretisation.h == 2.0 * b.discretisation.h
                });
                let found = pairs.map(|(a, b)| {
                    let [a_lost, b_lost] = [a, b].map(lost);
                    let name = format!("order of angular_momentum_error of {}", a.scheme());
                    let why = "what a node's mass is off the node, times the layer in which it is";
                    Finding::above(name, (a_lost / b_lost).log2(), ORDER - 0.15, why)
                });
                found.collect()
            }),
        ),
        Check::known_limit(
            "flip-spins-down",
            "flip with η = 1, ten turns and more, four cells in the radius: a tenth of the angular momentum is gone",
            run(|r| {
                let whole = r.transfer() == TransferName::Flip && r.parameters.number(FLIP) == 1.0;
                let coarse = r.discretisation.h >= 0.25 * RADIUS;
                let why = "a lumped mass beside the rim lies off its node: FLIP keeps the nodes' angular momentum, not the particles'";
                (whole && coarse && is_long(r))
                    .then(|| judge(r, m::ANGULAR_MOMENTUM_END).at_most(0.9, why))
            }),
        ),
        Check::known_limit(
            "filters-spin-down",
            "PIC and xpic2, ten turns and more: half of the angular momentum is gone",
            run(|r| {
                let filters =
                    r.parameters.number(FLIP) < 1.0 || r.transfer() == TransferName::Xpic2;
                let why = "a node beside the rim turns as fast as the mass that it sees, which lies further in; a filter hands that to the particles in every step";
                (filters && is_long(r))
                    .then(|| judge(r, m::ANGULAR_MOMENTUM_END).at_most(HALF, why))
            }),
        ),
        Check::known_limit(
            "gimp-swells",
            "gimp with apic, ten turns and more: the mean stretch of the last half is above the exact one by more than h/R of it",
            run(|r| {
                let own = r.basis() == BasisName::Gimp && r.transfer() == TransferName::Apic;
                let bound = r.discretisation.h / RADIUS;
                let why = "domains keep to the axes of the grid while their lattice turns: they no longer tile it, and crossing makes noise";
                (own && is_long(r)).then(|| judge(r, m::STRETCH_MEAN_ERROR).above(bound, why))
            }),
        ),
        Check::known_limit(
            "musl-swells",
            "musl, ten turns and more: the radius leaves that of the exact disc by more than all that turning adds to it",
            run(|r| {
                let why = "strains are those of velocities mapped again, places are not: the rim moves off what its stress knows";
                (r.transfer() == TransferName::Musl && is_long(r))
                    .then(|| judge(r, m::STRETCH_ERROR).above(1.0, why))
            }),
        ),
    ]
}

fn is_long(r: &Record) -> bool {
    r.parameters.number(TURNS) > SHORT
}
