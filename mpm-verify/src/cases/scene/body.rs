//! The bodies of a scene: `[body]`, whose law has a table of its own, and those of `[[bodies]]`.

use super::fault::{Line, Source};
use super::form::{BodyForm, Form, LawForm};
use super::law::{cohesion, law_of};
use crate::cases::prelude::*;
use mpm_core::bodies::Body;

/// Name of `[body]` where it has none.
pub(super) const FIRST: &str = "body";

/// Poisson's ratio from which a solid is nearly incompressible: its bulk modulus is ten times its shear modulus.
const NEARLY: f64 = 0.45;

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

impl LawForm {
    /// Whether it hardly lets the volume change: a fluid, or a solid of a Poisson's ratio near one half.
    pub(super) fn nearly_incompressible(&self) -> bool {
        match self {
            Self::NewtonianFluid { .. } => true,
            Self::NeoHookean { poisson_ratio, .. }
            | Self::Hencky { poisson_ratio, .. }
            | Self::HenckyJ2 { poisson_ratio, .. } => poisson_ratio.0 >= NEARLY,
            Self::DruckerPrager { .. }
            | Self::MohrCoulomb { .. }
            | Self::ImprovedHencky { .. }
            | Self::CamClay { .. } => false,
        }
    }
}

/// Needs of a cohesion that grows with depth.
const GRADIENT: &str = "cohesion_gradient_pa_m is of a law mohr-coulomb with a cohesion_pa above zero, at the body's \
                        highest point";

impl BodyForm {
    /// Whether the law of this body, number `k`, has a cohesion that can grow with depth.
    fn cohesive(&self, form: &Form, k: usize) -> bool {
        let law = if k == 0 { Some(&form.law) } else { self.law.as_ref() };
        law.is_some_and(|law| cohesion(law.get_ref()) > 0.0)
    }

    /// Whether it has pores of its own.
    fn has_pores(&self) -> bool {
        self.porosity.is_some() || self.conductivity.is_some()
    }

    /// Its name.
    pub(super) fn name(&self) -> &str {
        self.name.as_ref().map_or(FIRST, |name| &name.0)
    }
}

/// Laws of the bodies after the first one, whose law phases may change.
pub(super) fn other_laws(source: &Source, form: &Form) -> Result<Vec<SharedLaw>, Error> {
    let water = form.water.as_ref().map(|water| water.get_ref().porosity);
    let each = form.laws().skip(1).zip(&form.bodies);
    let of = |(law, body): (&Line<LawForm>, &Line<BodyForm>)| {
        let porosity = body.get_ref().porosity.or(water).map(|n| n.0);
        law_of(law.get_ref(), porosity).map_err(|e| source.at(law, e))
    };
    each.map(of).collect()
}

/// That every body has what it needs, and nothing that acts on nothing or that the scheme can't do.
pub(super) fn check_bodies(source: &Source, form: &Form, scheme: Scheme) -> Result<(), Error> {
    for (k, body) in form.all_bodies().enumerate() {
        let own = body.get_ref();
        let several = !form.bodies.is_empty();
        let weightless = form.water.as_ref().is_some_and(|water| water.get_ref().density_kg_m3.is_none());
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
            (own.has_pores() && form.water.is_none(), "porosity and conductivity act on nothing: there is no [water]"),
            (own.cohesion_gradient_pa_m.is_some() && !own.cohesive(form, k), GRADIENT),
            (own.k0.is_some() && weightless, "k0 needs a density_kg_m3 of [water]"),
            (k == 0 && own.has_pores(), "porosity and conductivity of [body] stand in [water]"),
            (
                several && averages && !explicit,
                "implicit schemes average over one body: an explicit scheme or the remedy none is allowed",
            ),
        ];
        if let Some((_, said)) = wrong.into_iter().find(|(is, _)| *is) {
            return Err(source.at(body, said));
        }
    }
    Ok(())
}

/// Displacement of the centre of mass of a body (m).
pub(super) fn moved<const D: usize>(particles: &Particles<D>, body: &Body) -> [f64; D] {
    let mass: f64 = particles.mass[body.range()].iter().sum();
    std::array::from_fn(|a| {
        let way = |k: usize| particles.mass[k] * (particles.position[k][a] - particles.reference[k][a]);
        body.range().map(way).sum::<f64>() / mass
    })
}
