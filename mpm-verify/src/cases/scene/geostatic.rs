//! Stress of ground that has always been there: the vertical one as what lies above weighs, the horizontal one K₀ times it.

use super::fault::{Line, Source};
use super::form::{LoadForm, WaterForm};
use super::setup::{Setup, acts, components};
use crate::cases::prelude::*;
use mpm_core::SymmetricTensor;

/// Share of a particle by which a level may be above the ground.
const ROUNDING: f64 = 1e-6;

/// σ_v along the last axis, K₀ σ_v across it.
pub(super) fn geostatic<const D: usize>(vertical: f64, k0: f64) -> SymmetricTensor {
    let [xx, yy, zz] = std::array::from_fn(|axis| if axis + 1 == D { vertical } else { k0 * vertical });
    SymmetricTensor { xx, yy, zz, ..SymmetricTensor::default() }
}

impl<const D: usize> Setup<D> {
    /// That bodies with a K₀, and water with a weight, have a gravity that presses down from the start.
    pub(super) fn check_geostatic(&self, source: &Source) -> Result<(), Error> {
        self.check_weight_of_water(source)?;
        let stressed = self.form.all_bodies().find(|body| body.get_ref().k0.is_some());
        match stressed {
            Some(body) if self.gravity().is_none_or(|g| g[..D - 1].iter().any(|g| *g != 0.0)) => Err(source.at(
                body,
                "k0 needs one gravity in the first phase, down along the last axis and without rise_s or amplitude",
            )),
            _ => Ok(()),
        }
    }

    fn check_weight_of_water(&self, source: &Source) -> Result<(), Error> {
        let Some(water) = &self.form.water else { return Ok(()) };
        let WaterForm { density_kg_m3, level_m, .. } = water.get_ref();
        let Some(density) = density_kg_m3 else {
            let said = "level_m acts on nothing: water without a density_kg_m3 begins without pressure";
            return if level_m.is_some() { Err(source.at(water, said)) } else { Ok(()) };
        };
        let pulls = |load: &&Line<LoadForm>| matches!(load.get_ref(), LoadForm::Gravity { .. });
        let always = |load: &Line<LoadForm>| self.phases.iter().all(|phase| acts(load.get_ref().when().2, &phase.name));
        let mut all = self.form.loads.iter().filter(pulls);
        if self.gravity().is_none() || !all.next().is_some_and(always) || all.next().is_some() {
            let said = "density_kg_m3 needs one gravity, in all phases, with a part down along the last axis and without \
                        rise_s or amplitude";
            return Err(source.at(water, said));
        }
        if level_m.is_some_and(|level| level.0 > self.top() + ROUNDING * self.spacing) {
            let said = format!(
                "level_m above the bodies, at {} m: water on the ground is a traction of [[water.faces]]",
                self.top()
            );
            return Err(source.at(water, said));
        }
        for body in self.form.all_bodies() {
            let filled = density.0 * body.get_ref().porosity.unwrap_or(water.get_ref().porosity).0;
            if body.get_ref().density_kg_m3.0 <= filled {
                let said = format!("density_kg_m3 of saturated ground is above that of its water, {filled} kg/m³");
                return Err(source.at(body, said));
            }
        }
        Ok(())
    }

    /// The highest place of the bodies (m).
    fn top(&self) -> f64 {
        self.seeds.places.iter().map(|x| x[D - 1]).fold(f64::NEG_INFINITY, f64::max) + 0.5 * self.spacing
    }

    /// The density (kg/m³) of water with a weight, its acceleration (m/s²), and the level (m) of no pressure at the start.
    pub(super) fn heavy_water(&self) -> Option<(f64, [f64; D], f64)> {
        let water = self.form.water.as_ref()?.get_ref();
        let level = water.level_m.map_or(self.top(), |level| level.0);
        Some((water.density_kg_m3?.0, self.gravity()?, level))
    }

    /// Acceleration (m/s²) of the one gravity of the first phase, if it acts from the start, and down along the last axis.
    fn gravity(&self) -> Option<[f64; D]> {
        let first = &self.phases.first()?.name;
        let mut all = self.form.loads.iter().filter_map(|load| match load.get_ref() {
            LoadForm::Gravity { acceleration_m_s2, rise_s, amplitude, phases } if acts(phases, first) => {
                let gravity = components::<D>(acceleration_m_s2);
                Some((gravity, rise_s.0 == 0.0 && amplitude.is_none() && gravity[D - 1] < 0.0))
            }
            _ => None,
        });
        let (gravity, steady) = all.next()?;
        (steady && all.next().is_none()).then_some(gravity)
    }

    /// Vertical stress (Pa) at every particle: what its column weighs above its middle, over the column's area. None where
    /// no body begins under one.
    pub(super) fn overburden(&self) -> Vec<f64> {
        let stressed = self.form.all_bodies().any(|body| body.get_ref().k0.is_some());
        let Some(gravity) = self.gravity().filter(|_| stressed) else { return Vec::new() };
        let per_mass = gravity[D - 1] / self.spacing.powi(D as i32 - 1);
        let weights: Vec<f64> = (self.form.all_bodies().zip(self.ranges()))
            .flat_map(|(body, range)| range.map(|k| body.get_ref().density_kg_m3.0 * self.seeds.volumes[k]))
            .map(|mass| mass * per_mass)
            .collect();
        let column = |k: usize| self.seeds.places[k].map(|x| (x / self.spacing).floor() as i64);
        let mut order: Vec<usize> = (0..weights.len()).collect();
        order.sort_by_cached_key(|k| {
            let mut key = column(*k);
            key[D - 1] = -key[D - 1];
            key
        });
        let mut stress = vec![0.0; weights.len()];
        let (mut above, mut last) = (0.0, None);
        for k in order {
            let mut own = column(k);
            own[D - 1] = 0;
            if last != Some(own) {
                (above, last) = (0.0, Some(own));
            }
            stress[k] = above + 0.5 * weights[k];
            above += weights[k];
        }
        stress
    }
}
