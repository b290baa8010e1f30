//! Bodies and steps made from a scene file, and the same in words: a wrong unit shows here.

use super::fault::Line;
use super::form::{BodyForm, LoadForm};
use super::geostatic::geostatic;
use super::law::cohesion;
use super::phase::Phase;
use super::setup::{Setup, acts};
use super::shape::Seeds;
use crate::cases::prelude::*;
use mpm_core::SymmetricTensor;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

impl<const D: usize> Setup<D> {
    /// The bodies of a phase at its start.
    pub(super) fn bodies(&self, phase: &Phase) -> Result<Bodies<D>, mpm_core::Error> {
        let mut all: Option<Bodies<D>> = None;
        let laws = [&phase.law].into_iter().chain(&self.others);
        // Later phases go on with the stress that they find.
        let begins = self.phases.first().is_some_and(|first| first.name == phase.name);
        let overburden = if begins { self.overburden() } else { Vec::new() };
        let each = self.form.all_bodies().zip(laws).zip(self.ranges()).zip(self.form.laws());
        for (((body, law), range), own) in each {
            let own = own.get_ref();
            let (body, law) = (body.get_ref(), Arc::clone(law));
            let vertical = overburden.get(range.clone()).unwrap_or_default();
            let particles = self.particles_of(body, range.clone())?;
            let mut bodies = match all.take() {
                None => Bodies::new(law, particles)?,
                Some(others) => others.and(law, particles)?,
            };
            if let Some(gradient) = body.cohesion_gradient_pa_m.filter(|_| begins) {
                let height = |k: usize| self.seeds.places[k][D - 1];
                let top = range.clone().map(height).fold(f64::NEG_INFINITY, f64::max) + 0.5 * self.spacing;
                let per_metre = gradient.0 / cohesion(own);
                bodies = bodies.stronger(|k| 1.0 + per_metre * (top - height(range.start + k)))?;
            }
            if let Some(k0) = body.k0.filter(|_| begins) {
                let water = self.heavy_water();
                let borne = |x: &[f64; D]| water.map_or(0.0, |(rho, g, level)| rho * g[D - 1] * (x[D - 1] - level));
                bodies = bodies.under(|k, x| geostatic::<D>(vertical[k] + borne(x), k0.0))?;
            }
            let stresses = self.seeds.stresses.get(range).unwrap_or_default();
            if begins && stresses.iter().any(|stress| *stress != SymmetricTensor::default()) {
                bodies = bodies.under(|k, _| stresses[k])?;
            }
            if body.remedy == Some(false) {
                bodies = bodies.without_remedy();
            }
            all = Some(match body.friction {
                Some(friction) => bodies.sliding(friction.0)?,
                None => bodies,
            });
        }
        all.ok_or(mpm_core::Error::Input { what: "bodies of a scene", value: 0.0, allowed: "1 or more" })
    }

    /// The names of the bodies, if there are several.
    pub(super) fn several(&self) -> Vec<&str> {
        let all = self.form.all_bodies().filter(|_| self.ends.len() > 1);
        all.map(|body| body.get_ref().name()).collect()
    }

    /// Places of the particles of every body among all.
    pub(super) fn ranges(&self) -> impl Iterator<Item = Range<usize>> {
        let begins = [0].into_iter().chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, end)| begin..*end)
    }

    fn particles_of(&self, body: &BodyForm, range: Range<usize>) -> Result<Particles<D>, mpm_core::Error> {
        let Seeds { places, volumes, velocities, .. } = &self.seeds;
        let (density, lattice) = (body.density_kg_m3.0, self.spacing.powi(D as i32));
        // Domains are alike: those of a table that has volumes are as large as its largest particle.
        let largest = volumes.iter().copied().fold(0.0, f64::max);
        let size = if largest == lattice { self.spacing } else { largest.powf(1.0 / D as f64) };
        let (places, volumes) = (places[range.clone()].to_vec(), &volumes[range.clone()]);
        let mut particles = Particles::new(places, lattice, density, [0.5 * size.min(self.grid.h); D])?;
        if volumes.iter().any(|volume| *volume != lattice) {
            particles.mass = volumes.iter().map(|volume| density * volume).collect();
            (particles.volume, particles.reference_volume) = (volumes.to_vec(), volumes.to_vec());
        }
        particles.velocity.copy_from_slice(&velocities[range]);
        Ok(particles)
    }
}

impl<const D: usize> Setup<D> {
    /// Size of all bodies together (m).
    pub(super) fn reach(&self) -> [f64; D] {
        std::array::from_fn(|a| {
            let along = || self.seeds.places.iter().map(|x| x[a]);
            let (least, most) = (along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max));
            most - least + self.spacing
        })
    }

    /// The axis along which gravity is greatest; the last one without gravity.
    pub(super) fn up(&self) -> usize {
        let mut most = [0.0; D];
        for load in &self.form.loads {
            if let LoadForm::Gravity { acceleration_m_s2: g, .. } = load.get_ref() {
                most = std::array::from_fn(|a| f64::max(most[a], g[a].0.abs()));
            }
        }
        (0..D).max_by(|a, b| most[*a].total_cmp(&most[*b])).unwrap_or(D - 1)
    }

    /// Height of the highest place of the surface over its lowest (m): that of a slope, whatever lies below; of level
    /// ground the whole height.
    pub(super) fn relief(&self) -> f64 {
        let (up, mut tops) = (self.up(), HashMap::new());
        for x in &self.seeds.places {
            let mut column = x.map(|x| (x / self.spacing).floor() as i64);
            column[up] = 0;
            let top = tops.entry(column).or_insert(f64::MIN);
            *top = f64::max(*top, x[up]);
        }
        let (lo, hi) = tops.values().fold((f64::MAX, f64::MIN), |(lo, hi), x| (lo.min(*x), hi.max(*x)));
        if hi - lo > self.grid.h { hi - lo } else { self.reach()[up] }
    }

    /// Density of every body (kg/m³).
    fn densities(&self) -> impl Iterator<Item = f64> {
        self.form.all_bodies().map(|body| body.get_ref().density_kg_m3.0)
    }

    /// Σ |g| times the reach and the greatest density: the stress (Pa) below a column as high as the bodies.
    pub(super) fn weight(&self) -> f64 {
        let (reach, density) = (self.reach(), self.densities().fold(0.0, f64::max));
        let weight = |load: &Line<LoadForm>| match load.get_ref() {
            LoadForm::Gravity { acceleration_m_s2: g, .. } => {
                g.iter().zip(&reach).map(|(g, reach)| density * g.0.abs() * reach).sum()
            }
            _ => 0.0,
        };
        self.form.loads.iter().map(weight).fold(0.0, f64::max)
    }

    /// Description of the bodies and of every phase.
    pub(super) fn made(&self) -> Vec<String> {
        let (reach, weight) = (self.reach(), self.weight());
        let size: Vec<String> = reach.iter().map(|reach| format!("{reach:.2}")).collect();
        let of = |phase: &Phase| {
            let strength = phase.strength.map_or(String::new(), |s| format!(", undrained shear strength {s:.0} Pa"));
            let laws = [&phase.law].into_iter().chain(&self.others).zip(self.densities());
            let speed = laws.map(|(law, density)| law.wave_speed(density)).fold(0.0, f64::max);
            let pulls = |load: &Line<LoadForm>, name: &str| matches!(load.get_ref(), LoadForm::Gravity { phases, .. } if acts(phases, name));
            let without = self.form.loads.iter().any(|load| matches!(load.get_ref(), LoadForm::Gravity { .. }))
                && !self.form.loads.iter().any(|load| pulls(load, &phase.name));
            format!(
                "Phase {}: speed of sound {speed:.1} m/s{strength}; {} steps of {:.3e} s{}.",
                phase.name,
                phase.steps,
                phase.dt,
                if without { ", without gravity" } else { "" }
            )
        };
        let unit = ["m", "m²", "m³"][D - 1];
        let each = self.form.all_bodies().zip(self.ranges()).map(|(body, range)| {
            let (body, volume) = (body.get_ref(), self.seeds.volumes[range].iter().sum::<f64>());
            format!("{}: {volume:.2} {unit}, {} kg/m³", body.name(), body.density_kg_m3.0)
        });
        let each: Vec<String> = each.collect();
        let means = || self.seeds.stresses.iter().map(SymmetricTensor::mean);
        let stress = (!self.seeds.stresses.is_empty()).then(|| {
            let (least, most) = (means().fold(f64::MAX, f64::min), means().fold(f64::MIN, f64::max));
            format!("Mean stress of the tables at the start, tension positive: {least:.0} to {most:.0} Pa.")
        });
        let all =
            format!("Bodies: {} m; {}; their height weighs at most {weight:.0} Pa.", size.join(" × "), each.join("; "));
        std::iter::once(all).chain(stress).chain(self.phases.iter().map(of)).collect()
    }
}
