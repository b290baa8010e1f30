//! Loads on the bodies of a scene: gravity, forces, tractions, and sides that let waves out.

use super::fault::{Line, Source};
use super::form::{LoadForm, Name, NotNegative};
use super::law::shear_modulus;
use super::phase::Phase;
use super::setup::{Setup, acts, components, end_of, own_axis};
use super::shape::{holds, vector};
use crate::cases::prelude::*;
use mpm_core::stage::{Dashpots, DeadForce, Load, Pressure};

impl LoadForm {
    /// Rise, amplitude and phases.
    pub(super) fn when(&self) -> (&NotNegative, &Option<Name>, &Vec<String>) {
        match self {
            Self::Gravity { rise_s, amplitude, phases, .. }
            | Self::Force { rise_s, amplitude, phases, .. }
            | Self::Traction { rise_s, amplitude, phases, .. }
            | Self::Pressure { rise_s, amplitude, phases, .. }
            | Self::Absorbing { rise_s, amplitude, phases, .. } => (rise_s, amplitude, phases),
        }
    }
}

impl<const D: usize> Setup<D> {
    /// That a load has as many components as the grid has axes, and that the solver can take it.
    pub(super) fn check_load(&self, source: &Source, load: &Line<LoadForm>) -> Result<(), Error> {
        let (name, numbers) = match load.get_ref() {
            LoadForm::Gravity { rise_s, phases, .. }
                if rise_s.0 > 0.0 && self.phases.iter().filter(|phase| acts(phases, &phase.name)).count() > 1 =>
            {
                let said = "a gravity that rises in every phase anew: `phases` names one for the rise, and another gravity \
                            acts in those after it";
                return Err(source.at(load, said));
            }
            LoadForm::Gravity { acceleration_m_s2, .. } => ("acceleration_m_s2", acceleration_m_s2),
            LoadForm::Force { total_n, .. } => ("total_n", total_n),
            LoadForm::Traction { traction_pa, axis, .. } => {
                own_axis::<D, _>(source, load, *axis)?;
                ("traction_pa", traction_pa)
            }
            LoadForm::Pressure { axis, .. } => return own_axis::<D, _>(source, load, *axis),
            LoadForm::Absorbing { axis, incoming_m_s, rise_s, amplitude, .. } => {
                own_axis::<D, _>(source, load, *axis)?;
                if !matches!(self.scheme, Scheme::Explicit(_)) {
                    return Err(source.at(load, "absorbing sides need an explicit scheme: an equilibrium has no waves"));
                }
                match incoming_m_s {
                    Some(incoming) => ("incoming_m_s", incoming),
                    None if rise_s.0 == 0.0 && amplitude.is_none() => return Ok(()),
                    None => return Err(source.at(load, "rise_s or amplitude without incoming_m_s")),
                }
            }
        };
        vector::<D, _>(source, load, name, numbers).map(|_| ())
    }

    /// The loads of a phase, with their factors over its time.
    fn acting(&self, phase: &Phase) -> impl Iterator<Item = (&LoadForm, Amplitude)> {
        let forms = self.form.loads.iter().map(Line::get_ref).map(|load| (load, load.when()));
        let forms = forms.filter(|(_, (.., phases))| acts(phases, &phase.name));
        forms.map(|(load, (rise, amplitude, _))| (load, self.over_time(*rise, amplitude)))
    }

    pub(super) fn loads(
        &self,
        phase: &Phase,
        particles: &Particles<D>,
    ) -> Result<Vec<Box<dyn Load<D>>>, mpm_core::Error> {
        // The weight of ground and water is that of the water.
        let soaked = self.heavy_water().is_some();
        let acting = self.acting(phase).filter(|(form, _)| !soaked || !matches!(form, LoadForm::Gravity { .. }));
        let all = acting.map(|(form, amplitude)| {
            let (load, count): (Box<dyn Load<D>>, usize) = match form {
                LoadForm::Gravity { acceleration_m_s2, .. } => {
                    let g = components::<D>(acceleration_m_s2);
                    (Box::new(Gravity(Box::new(move |time| g.map(|g| g * amplitude.at(time))))), particles.len())
                }
                LoadForm::Pressure { pressure_pa, axis, end, on, .. } => {
                    let side = (*axis as usize, end_of(*end));
                    let pressure = Pressure::new(pressure_pa.0, amplitude, particles, side, holds(on));
                    let count = pressure.count();
                    (Box::new(pressure), count)
                }
                LoadForm::Absorbing { axis, end, on, incoming_m_s, .. } => {
                    let wave = (components(incoming_m_s.as_deref().unwrap_or_default()), amplitude);
                    let side = (*axis as usize, end_of(*end));
                    let dashpots = Dashpots::new(self.impedance(phase), wave, particles, side, holds(on));
                    let count = dashpots.count();
                    (Box::new(dashpots), count)
                }
                LoadForm::Force { .. } | LoadForm::Traction { .. } => {
                    let force = dead(form, amplitude, particles);
                    let count = force.count();
                    (Box::new(force), count)
                }
            };
            let allowed =
                "1 or more in the region `on` of a load, of a traction or an absorbing side with a free side there";
            match count {
                0 => Err(mpm_core::Error::Input { what: "particles that a load acts on", value: 0.0, allowed }),
                _ => Ok(load),
            }
        });
        all.collect()
    }

    /// ρ c (Pa s/m) of pressure and of shear waves at a particle.
    fn impedance(&self, phase: &Phase) -> impl Fn(usize) -> [f64; 2] {
        let others = self.form.laws().skip(1).map(|law| shear_modulus(law.get_ref()));
        let shear = [phase.shear_modulus].into_iter().chain(others);
        let laws = [&phase.law].into_iter().chain(&self.others).zip(shear);
        let bodies = self.form.all_bodies().map(|body| body.get_ref().density_kg_m3.0).zip(laws).zip(&self.ends);
        let of = |((density, (law, shear)), end): ((f64, (&SharedLaw, f64)), &usize)| {
            (*end, [density * law.wave_speed(density), (density * shear).sqrt()])
        };
        let all: Vec<(usize, [f64; 2])> = bodies.map(of).collect();
        move |particle| all.iter().find(|(end, _)| particle < *end).map_or([0.0; 2], |(_, impedance)| *impedance)
    }

    /// Impulse (N s) of the loads in the steps of a phase, which take them as they are at their start.
    pub(super) fn impulse(&self, phase: &Phase, run: &dyn Simulation<D>) -> [f64; D] {
        let mut impulse = [0.0; D];
        for (form, amplitude) in self.acting(phase) {
            let stroke: f64 = (0..phase.steps).map(|step| amplitude.at(step as f64 * phase.dt) * phase.dt).sum();
            let force = match form {
                LoadForm::Gravity { acceleration_m_s2, .. } => {
                    let mass = run.totals().mass;
                    components::<D>(acceleration_m_s2).map(|g| g * mass)
                }
                _ => dead(form, amplitude, run.particles()).total(),
            };
            for (sum, force) in impulse.iter_mut().zip(force) {
                *sum += force * stroke;
            }
        }
        impulse
    }

    /// Whether a load depends on the motion.
    pub(super) fn follows(&self) -> bool {
        let follows = |load: &LoadForm| matches!(load, LoadForm::Absorbing { .. } | LoadForm::Pressure { .. });
        self.form.loads.iter().map(Line::get_ref).any(follows)
    }
}

/// The dead load of a form; none of other kinds.
fn dead<const D: usize>(form: &LoadForm, amplitude: Amplitude, particles: &Particles<D>) -> DeadForce<D> {
    match form {
        LoadForm::Traction { traction_pa, axis, end, on, .. } => {
            let side = (*axis as usize, end_of(*end));
            DeadForce::traction(components(traction_pa), amplitude, particles, side, holds(on))
        }
        LoadForm::Force { total_n, on, .. } => DeadForce::shared(components(total_n), amplitude, particles, holds(on)),
        _ => DeadForce::shared([0.0; D], amplitude, particles, |_| false),
    }
}
