//! Balance of momentum and energy of an explicit run: what loads gave and supports took is what the bodies have.

use super::phase::Phase;
use super::setup::Setup;
use crate::cases::prelude::*;

/// Momentum and kinetic energy at the start of a phase, and what the phases so far lack.
#[derive(Default, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Balance {
    momentum: [f64; 3],
    kinetic: f64,
    /// Momentum (N s) that nothing gave, and the impulse of all that acts.
    lacking: [f64; 3],
    passed: f64,
    /// Kinetic energy (J) that nothing gave, and the energy that was moved.
    gained: f64,
    moved: f64,
}

/// Share of what is moved that is rounding of its sums.
const ROUNDING: f64 = 1e-9;

impl Balance {
    /// Momentum that nothing gave, over rounding of what passed.
    pub(super) fn momentum(&self) -> f64 {
        let lacking = self.lacking.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if lacking == 0.0 { 0.0 } else { lacking / (ROUNDING * self.passed) }
    }

    /// Kinetic energy that nothing gave, over rounding of what was moved. Transfers with a lumped mass give none: they lose,
    /// and works at the velocity after a step exceed those along its way by ½ Σ m Δv², so that a gain below that is hidden.
    pub(super) fn energy(&self) -> f64 {
        if self.gained <= 0.0 { 0.0 } else { self.gained / (ROUNDING * self.moved) }
    }

    /// At the start of a phase.
    pub(super) fn begin<const D: usize>(&mut self, run: &dyn Simulation<D>) {
        let totals = run.totals();
        (self.momentum, self.kinetic) = (totals.momentum, totals.kinetic_energy);
        self.moved += totals.kinetic_energy;
        self.passed += totals.momentum.iter().map(|p| p.abs()).sum::<f64>();
    }

    /// At the end of a phase, in which loads gave an `impulse` (N s).
    fn end<const D: usize>(&mut self, run: &dyn Simulation<D>, impulse: [f64; D], held: [usize; 2]) {
        let (totals, done) = (run.totals(), run.totals().accumulated);
        let [constraints, contacts] = held;
        let parts = (0..constraints).map(Part::Constraint).chain((0..contacts).map(Part::Contact));
        let taken: Vec<[f64; 3]> = parts.map(|part| run.on(part).impulse).collect();
        for a in 0..D {
            let taken: f64 = taken.iter().map(|impulse| impulse[a]).sum();
            self.passed += taken.abs() + impulse[a].abs();
            self.lacking[a] += totals.momentum[a] - self.momentum[a] + taken - impulse[a];
        }
        let losses = done.damping + done.constraint_loss + done.filter_loss;
        self.gained += totals.kinetic_energy - self.kinetic + done.stress_work - done.load_work + losses;
        self.moved += done.stress_work.abs() + done.load_work.abs() + losses.abs();
    }
}

impl<const D: usize> Setup<D> {
    /// Ends a phase in a balance; one with local damping, whose work is taken at the velocity before a step, is left out.
    pub(super) fn balance(&self, phase: &Phase, run: &dyn Simulation<D>, balance: &mut Balance) {
        if phase.damping > 0.0 {
            return;
        }
        let [supports, contacts, _] = self.parts(&phase.name);
        balance.end(run, self.impulse(phase, run), [supports.len(), contacts.len()]);
    }

    /// Why momentum and energy of a run are not balanced, if they are not.
    pub(super) fn unbalanced(&self) -> [Option<&'static str>; 2] {
        let damped = self.phases.iter().all(|phase| phase.damping > 0.0);
        let stopped = self.form.solver.get_ref().kinetic_damping == Some(true);
        match self.scheme {
            Scheme::Explicit(_) if damped => [Some("every phase has local damping"); 2],
            Scheme::Explicit(_) if self.follows() => {
                [Some("the impulse of an absorbing side or of a pressure follows the motion"), None]
            }
            Scheme::Explicit(_) if stopped => [Some("kinetic damping takes momentum"), None],
            Scheme::Explicit(_) => [None; 2],
            _ => [Some("an implicit scheme has no impulses"), Some("an implicit scheme balances it within its step")],
        }
    }
}
