//! Values of the keys that a scene file leaves out.

use super::body::FIRST;
use super::fault::Line;
use super::form::{Finite, Form, LoadForm, Name, NotNegative, Positive, Share, SupportForm, WallsForm};
use crate::cases::prelude::*;
use mpm_core::implicit::{self, GHOST};
use mpm_core::poro;

/// Share of the lumped mass with the midpoint rule: with the consistent mass alone a body that flies is singular.
const LUMPED: f64 = 0.1;

impl Form {
    /// Fills in every key that the file leaves out and that has a meaning with the scheme.
    pub(super) fn fill(&mut self, scheme: Scheme) {
        let solver = self.solver.as_mut();
        match scheme {
            Scheme::Explicit(_) => {
                if solver.pic_rate_per_s.is_none() {
                    solver.flip.get_or_insert(Share(1.0));
                }
                solver.kinetic_damping.get_or_insert(false);
                solver.walls.get_or_insert(WallsForm::OpenKnot);
                for phase in &mut self.phases {
                    phase.as_mut().local_damping.get_or_insert(Share(0.0));
                }
            }
            Scheme::Implicit(_) => {
                solver.tolerance.get_or_insert(Positive(implicit::Settings::new(1.0).tolerance));
                solver.ghost_penalty.get_or_insert(NotNegative(GHOST));
                if scheme.rule() == Some(RuleName::Midpoint) {
                    solver.lumped.get_or_insert(Share(LUMPED));
                }
            }
            Scheme::Poro(_) => {
                solver.tolerance.get_or_insert(Positive(poro::Settings::new(1.0).tolerance));
                solver.ghost_penalty.get_or_insert(NotNegative(GHOST));
                solver.ghost_pressure.get_or_insert(NotNegative(0.0));
            }
        }
        let axes = self.grid.get_ref().cells.len();
        for body in
            [&mut self.body].into_iter().chain(&mut self.bodies).filter(|_| matches!(scheme, Scheme::Explicit(_)))
        {
            body.as_mut().velocity_m_s.get_or_insert_with(|| vec![Finite(0.0); axes]);
        }
        self.body.as_mut().name.get_or_insert_with(|| Name(FIRST.to_owned()));
        let averages = scheme.remedy() != RemedyName::None;
        for body in [&mut self.body].into_iter().chain(&mut self.bodies).filter(|_| averages) {
            body.as_mut().remedy.get_or_insert(true);
        }
        let names: Vec<String> = self.phases.iter().map(|phase| phase.get_ref().name.0.clone()).collect();
        let loads = self.loads.iter_mut().map(|load| match load.as_mut() {
            LoadForm::Gravity { phases, .. }
            | LoadForm::Force { phases, .. }
            | LoadForm::Traction { phases, .. }
            | LoadForm::Pressure { phases, .. }
            | LoadForm::Absorbing { phases, .. } => phases,
        });
        let supports = self.supports.iter_mut().map(|support| match support.as_mut() {
            SupportForm::Wall { phases, .. } | SupportForm::Nodes { phases, .. } => phases,
        });
        let contacts = self.contacts.iter_mut().map(|contact| &mut Line::as_mut(contact).phases);
        for phases in loads.chain(supports).chain(contacts).filter(|phases| phases.is_empty()) {
            phases.clone_from(&names);
        }
    }
}
