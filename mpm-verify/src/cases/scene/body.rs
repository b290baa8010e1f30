//! The bodies of a scene: `[body]`, whose law has a table of its own, and those of `[[bodies]]`.

use super::fault::{Line, Source};
use super::form::{BodyForm, Form, LawForm};
use super::law::law_of;
use super::phase::Phase;
use super::setup::Setup;
use super::shape::Seeds;
use crate::cases::prelude::*;
use mpm_core::bodies::Body;
use std::ops::Range;
use std::sync::Arc;

/// Name of `[body]` where it has none.
const FIRST: &str = "body";

impl Form {
    /// All bodies, in their order.
    pub(super) fn all_bodies(&self) -> impl Iterator<Item = &Line<BodyForm>> {
        [&self.body].into_iter().chain(&self.bodies)
    }

    /// Whether bodies slide on each other.
    pub(super) fn slides(&self) -> bool {
        self.all_bodies().any(|body| body.get_ref().friction.is_some())
    }

    /// All laws at the start, in the order of the bodies.
    pub(super) fn laws(&self) -> impl Iterator<Item = &Line<LawForm>> {
        [&self.law].into_iter().chain(self.bodies.iter().filter_map(|body| body.get_ref().law.as_ref()))
    }
}

impl BodyForm {
    /// Its name.
    pub(super) fn name(&self) -> &str {
        self.name.as_ref().map_or(FIRST, |name| &name.0)
    }
}

/// Laws of the bodies after the first one, whose law phases may change.
pub(super) fn other_laws(source: &Source, form: &Form) -> Result<Vec<SharedLaw>, Error> {
    let of = |law: &Line<LawForm>| law_of(law.get_ref(), None).map_err(|e| source.at(law, e));
    form.laws().skip(1).map(of).collect()
}

/// That every body has what it needs, and nothing that acts on nothing or that the scheme can't do.
pub(super) fn check_bodies(source: &Source, form: &Form, scheme: Scheme) -> Result<(), Error> {
    for (k, body) in form.all_bodies().enumerate() {
        let own = body.get_ref();
        let several = !form.bodies.is_empty();
        let explicit = matches!(scheme, Scheme::Explicit(_));
        let averages = scheme.remedy() != RemedyName::None;
        let wrong = [
            (k == 0 && own.law.is_some(), "the law of [body] stands in [law]"),
            (k == 0 && own.particles_per_direction.is_none(), "no particles_per_direction"),
            (k > 0 && own.law.is_none(), "a body without a law"),
            (k > 0 && own.name.is_none(), "a body without a name"),
            (k > 0 && own.particles_per_direction.is_some(), "particles_per_direction is that of [body]"),
            (own.friction.is_some() && !several, "friction acts on nothing: there is one body"),
            (own.friction.is_some() && !explicit, "bodies that slide need an explicit scheme"),
            (own.remedy == Some(false) && !averages, "the scheme has no remedy that a body could be without"),
            (several && matches!(scheme, Scheme::Poro(_)), "a scheme with water has one body"),
            (several && averages && !explicit, "implicit schemes average over one body: remedy none is allowed"),
        ];
        if let Some((_, said)) = wrong.into_iter().find(|(is, _)| *is) {
            return Err(source.at(body, said));
        }
    }
    Ok(())
}

impl<const D: usize> Setup<D> {
    /// The bodies of a phase at its start.
    pub(super) fn bodies(&self, phase: &Phase) -> Result<Bodies<D>, mpm_core::Error> {
        let mut all: Option<Bodies<D>> = None;
        let laws = [&phase.law].into_iter().chain(&self.others);
        for ((body, law), range) in self.form.all_bodies().zip(laws).zip(self.ranges()) {
            let (body, law) = (body.get_ref(), Arc::clone(law));
            let particles = self.particles_of(body, range)?;
            let mut bodies = match all.take() {
                None => Bodies::new(law, particles)?,
                Some(others) => others.and(law, particles)?,
            };
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
        let Seeds { places, volumes, velocities } = &self.seeds;
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

/// Displacement of the centre of mass of a body (m).
pub(super) fn moved<const D: usize>(particles: &Particles<D>, body: &Body) -> [f64; D] {
    let mass: f64 = particles.mass[body.range()].iter().sum();
    std::array::from_fn(|a| {
        let way = |k: usize| particles.mass[k] * (particles.position[k][a] - particles.reference[k][a]);
        body.range().map(way).sum::<f64>() / mass
    })
}
