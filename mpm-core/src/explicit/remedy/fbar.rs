//! The F̄ family: a form of J̄ⁿ⁺¹ and of the force, and the functions that Π averages with.

use super::{Columns, Filled, Known, Mean, Remedy, fill, mean, multiply};
use crate::eights::{AHEAD, Eights};
use crate::error::{Error, positive, require};
use crate::memory::Memoryless;
use crate::number::Eight;
use crate::parallel::{CHUNK, for_each_piece};
use crate::projection::Onto;
use crate::tensor::SymmetricTensor;

/// How J̄ⁿ⁺¹ is formed, and with which pressure the force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// J̄ⁿ⁺¹ = Π(J̄ⁿ ΔJ): Algorithm 1 as printed, Eq. (26) of Zhao, Jiang & Choo (2023). What is averaged is averaged
    /// again in every step, which diffuses J̄ with D = ½ s² h²/Δt, s² being the spread of Π: `docs/method.md`.
    Recursive,
    /// J̄ⁿ⁺¹ = Π(Jⁿ⁺¹), Eqs. (18)–(21): nothing accumulates.
    Total,
    /// J̄ⁿ⁺¹ = J̄ⁿ Π(ΔJ): only the increment is averaged. On constants of a cell that of Coombs et al. (2018).
    Rate,
    /// J̄ⁿ⁺¹ = J̄ⁿ A(ΔJ) with A = Π, and the force from the stress (J̄/J) dev σ + A((J̄/J) p) I: the B̄ method of Hughes
    /// (1980) for large strains.
    Bbar,
    /// The same with A = I − (1 − ε)(I − Π)², ε = 0.01, less a relaxation of what Π cannot see.
    ///
    /// A is symmetric in the volume-weighted product, as Π is, so the power that the pressure takes from the grid is
    /// the rate of the energy stored: `docs/remedy.md` derives it. It errs by the square of Π's error. Modes that Π
    /// cannot see keep the share ε of their strain, a stiffness ε² K, so that a pressure does not feed them. It fills
    /// as particles pass each other, and is emptied by J̄ ← J̄ − (I − Π) θ (I − Π) J̄ with θ = min(1, β γ) and γ the
    /// shear strain of the step, which keeps the volume, never adds energy to first order, and does nothing at rest.
    ///
    /// A pressure above ε² K does feed it. [`Fbar::holding`] gives every particle an ε of its own, that the pressure
    /// there asks for: A = I − (I − Π)(1 − ε)(I − Π) is as symmetric (`docs/remedy.md`).
    Consistent,
}

/// A member of the family.
#[derive(Debug, Clone)]
pub struct Fbar {
    form: Form,
    onto: Onto,
    /// β.
    relaxation: f64,
    /// How many times the smooth pressure ε² K holds at least, over K (1/Pa); zero for the same ε everywhere.
    hold: f64,
}

/// The relaxation β that serves every problem of the bench.
const RELAXATION: f64 = 10.0;
/// The share ε of a strain that Π cannot see which is kept. ε² K has to hold against the pressure of a body,
/// 10⁻⁴ K is ten times that of two metres of water; from 0.1 on bodies lock (`docs/averages.md`).
const UNSEEN: f64 = 0.01;

impl Fbar {
    /// The member of this form on the basis functions.
    #[must_use]
    pub fn new(form: Form) -> Self {
        let relaxation = if form == Form::Consistent { RELAXATION } else { 0.0 };
        Self { form, onto: Onto::Basis, relaxation, hold: 0.0 }
    }

    /// With other functions to average with.
    #[must_use]
    pub fn onto(self, onto: Onto) -> Self {
        Self { onto, ..self }
    }

    /// With relaxation β (dimensionless, zero for none).
    #[must_use]
    pub fn relaxing(self, relaxation: f64) -> Self {
        Self { relaxation, ..self }
    }

    /// With a stiffness ε² K of what Π cannot see that is at least `times` the smooth pressure Π p at every particle,
    /// in a material of the modulus K = `modulus` (Pa); ε is at most one. Zero `times` for the same ε everywhere.
    /// [`Form::Consistent`] has one.
    ///
    /// # Errors
    /// `times` that are negative, a modulus that is not positive, or either not finite.
    pub fn holding(mut self, times: f64, modulus: f64) -> Result<Self, Error> {
        require(times >= 0.0, "pressures to hold", times, "zero or positive")?;
        positive(modulus, "modulus", "positive (Pa)")?;
        self.hold = times / modulus;
        Ok(self)
    }

    /// Whether A is not Π: a share of what Π cannot see is kept.
    #[must_use]
    pub fn keeps_unseen(&self) -> bool {
        self.form == Form::Consistent
    }

    /// Whether the force has a mean stress of its own.
    fn averages_pressure(&self) -> bool {
        matches!(self.form, Form::Bbar | Form::Consistent)
    }

    /// Takes (I − Π) θ (I − Π) J̄ off the next J̄.
    fn relax(&self, shear: &[f64], next: &mut [f64], rest: &mut [f64], average: Mean<'_>) {
        rest.copy_from_slice(next);
        average(rest);
        for_each_pair(next, rest, |p, next, rest| {
            let theta = (self.relaxation * shear[p]).min(1.0);
            *rest = theta * (*next - *rest);
            *next -= *rest;
        });
        average(rest);
        for_each_pair(next, rest, |_, next, smooth| {
            *next += *smooth;
        });
    }
}

/// Replaces `field` by A `field` = Π field + ε r + Π (1 − ε) r with r = (I − Π) field, which `rest` is for; ε is that
/// which every particle has `kept`, or the same of all.
fn sharpened(field: &mut [f64], rest: &mut [f64], kept: &[f64], average: Mean<'_>) {
    let kept = |p: usize| kept.get(p).copied().unwrap_or(UNSEEN);
    rest.copy_from_slice(field);
    average(rest);
    for_each_pair(field, rest, |p, field, smooth| {
        let rough = *field - *smooth;
        *field = *smooth + kept(p) * rough;
        // The factor is one, and changes no bit, where all have the same ε.
        *smooth = rough * ((1.0 - kept(p)) / (1.0 - UNSEEN));
    });
    average(rest);
    for_each_pair(field, rest, |_, field, seen| {
        *field += (1.0 - UNSEEN) * *seen;
    });
}

/// `change(p, a, b)` for the entries of two fields at every particle p, in parallel.
fn for_each_pair(a: &mut [f64], b: &mut [f64], change: impl Fn(usize, &mut f64, &mut f64) + Sync) {
    let n = a.len();
    for_each_piece((a, b), n, CHUNK, &|begin, (a, b)| {
        for (k, (a, b)) in a.iter_mut().zip(b).enumerate() {
            change(begin + k, a, b);
        }
    });
}

impl Memoryless for Fbar {}

impl<const D: usize> Remedy<D> for Fbar {
    fn averages_onto(&self) -> Option<Onto> {
        Some(self.onto)
    }

    fn asks_for_shear(&self) -> bool {
        self.relaxation > 0.0
    }

    fn columns(&self, n: usize) -> Columns {
        let column = |needed: bool, value: f64| vec![value; if needed { n } else { 0 }];
        Columns {
            next: column(true, 0.0),
            mean: column(self.averages_pressure(), 0.0),
            kept: column(self.hold > 0.0, UNSEEN),
            rest: column(self.keeps_unseen() || self.relaxation > 0.0, 0.0),
        }
    }

    fn force_mean(&self, known: Known<'_>, filled: &mut Filled<'_>, average: Mean<'_>) {
        if !self.averages_pressure() {
            return;
        }
        let Filled { mean: of_force, kept, rest, .. } = filled;
        fill(of_force, |chunk| {
            let stress = Eights::of(&known.stress[chunk.clone()]);
            let j = Eights::of(&known.jacobian[chunk.clone()]);
            let j_bar = Eights::of(&known.j_bar[chunk]);
            move |k| {
                stress.fetch(k + AHEAD);
                let stress = stress.at(k);
                let stress = SymmetricTensor::pack(|l| stress[l]);
                Eight::new(*j_bar.at(k)) / Eight::new(*j.at(k)) * mean::<Eight, D>(&stress)
            }
        });
        if !self.keeps_unseen() {
            return average(of_force);
        }
        if self.hold > 0.0 {
            // The pressure that drives is the smooth one; noise of the true one would hold the more, the more there is.
            kept.copy_from_slice(of_force);
            average(kept);
            for kept in kept.iter_mut() {
                *kept = (self.hold * kept.abs()).sqrt().clamp(UNSEEN, 1.0);
            }
        }
        sharpened(of_force, rest, kept, average);
    }

    fn next_j_bar(&self, known: Known<'_>, filled: &mut Filled<'_>, average: Mean<'_>) {
        let Filled { next, kept, rest, .. } = filled;
        match self.form {
            Form::Total => next.copy_from_slice(known.jacobian),
            _ => next.copy_from_slice(known.volume_change),
        }
        if self.form == Form::Recursive {
            multiply(next, known.j_bar);
        }
        match self.keeps_unseen() {
            true => sharpened(next, rest, kept, average),
            false => average(next),
        }
        if !matches!(self.form, Form::Total | Form::Recursive) {
            multiply(next, known.j_bar);
        }
        if self.relaxation > 0.0 {
            self.relax(known.shear, next, rest, average);
        }
    }
}
