//! The phases of a scene, and how each is solved.

use super::fault::{Line, Source};
use super::form::{Form, LawForm, WaterForm};
use super::law::{law_of, shear_modulus, shear_strength};
use crate::cases::prelude::*;
use std::sync::Arc;

/// Most rows of a phase.
const MOST_ROWS: f64 = 1e7;
/// Resolution of the time (s) in the names of snapshots.
const NAMED: f64 = 1e-3;
/// Share of a duration by which it may differ from a whole number of steps.
const WHOLE: f64 = 1e-3;

/// A phase.
pub(super) struct Phase {
    pub(super) name: String,
    pub(super) law: SharedLaw,
    /// Undrained shear strength at the start (Pa), of a law that has one.
    pub(super) strength: Option<f64>,
    /// Shear modulus at rest (Pa).
    pub(super) shear_modulus: f64,
    pub(super) steps: u64,
    steps_per_row: u64,
    pub(super) dt: f64,
    pub(super) damping: f64,
}

impl Phase {
    /// Duration (s).
    pub(super) fn duration(&self) -> f64 {
        self.steps as f64 * self.dt
    }

    /// Number of rows, of which the last may be shorter.
    pub(super) fn rows(&self) -> usize {
        self.steps.div_ceil(self.steps_per_row) as usize
    }

    /// Steps of a row.
    pub(super) fn steps_of(&self, row: usize) -> u64 {
        self.steps_per_row.min(self.steps - row as u64 * self.steps_per_row)
    }
}

/// The scheme, and that nothing is set that only another kind of solver has.
pub(super) fn scheme(source: &Source, form: &Form) -> Result<Scheme, Error> {
    let given = form.solver.get_ref();
    let scheme = Scheme::parse(&given.scheme).map_err(|e| source.at(&form.solver, e))?;
    let kind = match scheme {
        Scheme::Explicit(_) => "explicit",
        Scheme::Implicit(_) => "implicit",
        Scheme::Poro(_) => "poro",
    };
    let own = [
        ("cfl", given.cfl.is_some(), &["explicit"][..]),
        ("flip", given.flip.is_some(), &["explicit"]),
        ("pic_rate_per_s", given.pic_rate_per_s.is_some(), &["explicit"]),
        ("kinetic_damping", given.kinetic_damping.is_some(), &["explicit"]),
        ("walls", given.walls.is_some(), &["explicit"]),
        ("tolerance", given.tolerance.is_some(), &["implicit", "poro"]),
        ("ghost_penalty", given.ghost_penalty.is_some(), &["implicit", "poro"]),
        ("lumped", given.lumped.is_some(), &["implicit"]),
        ("ghost_pressure", given.ghost_pressure.is_some(), &["poro"]),
        ("projection_per_pa", given.projection_per_pa.is_some(), &["poro"]),
    ];
    for (name, is_set, kinds) in own {
        if is_set && !kinds.contains(&kind) {
            return Err(source.at(&form.solver, format!("{name} has no meaning with the scheme {scheme}")));
        }
    }
    let fluid = form.laws().find(|law| matches!(law.get_ref(), LawForm::NewtonianFluid { .. }));
    if let (Some(law), Some(_)) = (fluid, &form.water) {
        return Err(source.at(law, "a newtonian-fluid has no pores: the law of a solid is allowed beside water"));
    }
    if form.water.is_some() != (kind == "poro") {
        let said = "water and a scheme of the kind poro go together: the one is there without the other";
        return Err(source.at(&form.solver, said));
    }
    Ok(scheme)
}

/// The phases of a scene whose bodies after the first one have the laws `others`.
pub(super) fn phases(
    source: &Source,
    form: &Form,
    scheme: Scheme,
    h: f64,
    others: &[SharedLaw],
) -> Result<Vec<Phase>, Error> {
    let porosity = form.water.as_ref().map(|w: &Line<WaterForm>| w.get_ref().porosity.0);
    let own = law_of(form.law.get_ref(), porosity).map_err(|e| source.at(&form.law, e))?;
    let (solver, row) = (form.solver.get_ref(), form.output.get_ref().row_s.0);
    let explicit = matches!(scheme, Scheme::Explicit(_));
    let mut all: Vec<Phase> = Vec::new();
    for phase in &form.phases {
        let given = phase.get_ref();
        let (kind, law) = match &given.law {
            Some(changed) => (changed, law_of(changed, porosity).map_err(|e| source.at(phase, e))?),
            None => (form.law.get_ref(), Arc::clone(&own)),
        };
        if std::mem::discriminant(kind) != std::mem::discriminant(form.law.get_ref()) {
            let said = "another kind of law than the scene's: only its constants may change";
            return Err(source.at(phase, said));
        }
        let laws = [&law].into_iter().chain(others).zip(form.all_bodies());
        let speeds = laws.map(|(law, body)| law.wave_speed(body.get_ref().density_kg_m3.0));
        let speed = speeds.fold(0.0, f64::max);
        let (dt, steps_per_row) = match (solver.time_step_s, solver.cfl) {
            (Some(dt), None) => (dt.0, (row / dt.0).round().max(1.0)),
            (None, Some(cfl)) => {
                // The largest step of the CFL number of which a whole number makes a row; a phase, if rows do not make one.
                let rows = given.duration_s.0 / row;
                let whole = if (rows - rows.round()).abs() <= WHOLE * rows { row } else { given.duration_s.0 };
                let dt = whole / (whole / courant_time_step(cfl.0, h, speed)).ceil().max(1.0);
                (dt, (row / dt).round().max(1.0))
            }
            _ => {
                let said = "either time_step_s or, of an explicit scheme, cfl";
                return Err(source.at(&form.solver, said));
            }
        };
        let (duration, steps) = (given.duration_s.0, (given.duration_s.0 / dt).round());
        if (steps * dt - duration).abs() > WHOLE * duration || steps / steps_per_row > MOST_ROWS {
            let row = dt * steps_per_row;
            let said = format!(
                "{duration} s in steps of {dt} s, rows of {row} s: whole steps, to 0.1 % of the duration, in at most 10⁷ rows are allowed"
            );
            return Err(source.at(phase, said));
        }
        let kept = form.output.get_ref().snapshot_rows.map(|rows| f64::from(rows.0) * steps_per_row * dt);
        if let Some(apart) = kept.filter(|apart| *apart < NAMED * (1.0 - WHOLE)) {
            let said =
                format!("snapshots {apart} s apart, where at least {NAMED} s is allowed, which their names tell");
            return Err(source.at(&form.output, said));
        }
        if given.local_damping.is_some() && !explicit {
            return Err(source.at(phase, "local_damping has no meaning with an implicit scheme"));
        }
        if all.iter().any(|p| p.name == given.name.0) {
            return Err(source.at(phase, format!("a second phase {:?}", given.name.0)));
        }
        all.push(Phase {
            name: given.name.0.clone(),
            law,
            strength: shear_strength(kind),
            shear_modulus: shear_modulus(kind),
            steps: steps as u64,
            steps_per_row: steps_per_row as u64,
            dt,
            damping: given.local_damping.unwrap_or_default().0,
        });
    }
    if all.is_empty() { Err(Error::file(&source.path, "phases: none, where 1 or more are allowed")) } else { Ok(all) }
}
