//! Body and steps made from a scene file, in words: a wrong unit shows here.

use super::fault::Line;
use super::form::LoadForm;
use super::phase::Phase;
use super::setup::Setup;

impl<const D: usize> Setup<D> {
    /// Size of the body (m).
    pub(super) fn reach(&self) -> [f64; D] {
        std::array::from_fn(|a| {
            let along = || self.seeds.places.iter().map(|x| x[a]);
            let (least, most) = (along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max));
            most - least + self.spacing
        })
    }

    /// Description of the body and of every phase.
    pub(super) fn made(&self) -> Vec<String> {
        let reach = self.reach();
        let density = self.form.body.get_ref().density_kg_m3.0;
        // Σ |g| times the reach: the stress below a column as high as the body.
        let weight = |load: &Line<LoadForm>| match load.get_ref() {
            LoadForm::Gravity { acceleration_m_s2: g, .. } => {
                g.iter().zip(&reach).map(|(g, reach)| density * g.0.abs() * reach).sum()
            }
            LoadForm::Force { .. } => 0.0,
        };
        let weight = self.form.loads.iter().map(weight).fold(0.0, f64::max);
        let size: Vec<String> = reach.iter().map(|reach| format!("{reach:.2}")).collect();
        let volume: f64 = self.seeds.volumes.iter().sum();
        let of = |phase: &Phase| {
            let strength = phase.strength.map_or(String::new(), |s| format!(", undrained shear strength {s:.0} Pa"));
            format!(
                "Phase {}: speed of sound {:.1} m/s{strength}; {} steps of {:.3e} s.",
                phase.name,
                phase.law.wave_speed(density),
                phase.steps,
                phase.dt
            )
        };
        let unit = ["m", "m²", "m³"][D - 1];
        let body = format!(
            "Body: {} m, {volume:.2} {unit}, {density} kg/m³; its height weighs {weight:.0} Pa.",
            size.join(" × ")
        );
        std::iter::once(body).chain(self.phases.iter().map(of)).collect()
    }
}
