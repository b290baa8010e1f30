//! Bodies and steps made from a scene file, in words: a wrong unit shows here.

use super::fault::Line;
use super::form::LoadForm;
use super::phase::Phase;
use super::setup::Setup;

impl<const D: usize> Setup<D> {
    /// Size of all bodies together (m).
    pub(super) fn reach(&self) -> [f64; D] {
        std::array::from_fn(|a| {
            let along = || self.seeds.places.iter().map(|x| x[a]);
            let (least, most) = (along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max));
            most - least + self.spacing
        })
    }

    /// Description of the bodies and of every phase.
    pub(super) fn made(&self) -> Vec<String> {
        let reach = self.reach();
        let densities = || self.form.all_bodies().map(|body| body.get_ref().density_kg_m3.0);
        let density = densities().fold(0.0, f64::max);
        // Σ |g| times the reach: the stress below a column as high as the body.
        let weight = |load: &Line<LoadForm>| match load.get_ref() {
            LoadForm::Gravity { acceleration_m_s2: g, .. } => {
                g.iter().zip(&reach).map(|(g, reach)| density * g.0.abs() * reach).sum()
            }
            LoadForm::Force { .. } => 0.0,
        };
        let weight = self.form.loads.iter().map(weight).fold(0.0, f64::max);
        let size: Vec<String> = reach.iter().map(|reach| format!("{reach:.2}")).collect();
        let of = |phase: &Phase| {
            let strength = phase.strength.map_or(String::new(), |s| format!(", undrained shear strength {s:.0} Pa"));
            let laws = [&phase.law].into_iter().chain(&self.others).zip(densities());
            let speed = laws.map(|(law, density)| law.wave_speed(density)).fold(0.0, f64::max);
            format!(
                "Phase {}: speed of sound {speed:.1} m/s{strength}; {} steps of {:.3e} s.",
                phase.name, phase.steps, phase.dt
            )
        };
        let unit = ["m", "m²", "m³"][D - 1];
        let each = self.form.all_bodies().zip(self.ranges()).map(|(body, range)| {
            let (body, volume) = (body.get_ref(), self.seeds.volumes[range].iter().sum::<f64>());
            format!("{}: {volume:.2} {unit}, {} kg/m³", body.name(), body.density_kg_m3.0)
        });
        let each: Vec<String> = each.collect();
        let all =
            format!("Bodies: {} m; {}; their height weighs at most {weight:.0} Pa.", size.join(" × "), each.join("; "));
        std::iter::once(all).chain(self.phases.iter().map(of)).collect()
    }
}
