//! The laws that a scene file can name.

use super::fault::{Line, Source};
use super::form::{Finite, Form, LawForm, MatchedForm, NotNegative, StrengthForm};
use crate::error::Error;
use mpm_core::material::{
    CamClay, DruckerPrager, Hencky, HenckyJ2, ImprovedHencky, Matched, MohrCoulomb, NeoHookean, NewtonianFluid,
    SharedLaw, Strength,
};

/// The law of a form, in a body of the given porosity.
pub(super) fn law_of(form: &LawForm, porosity: Option<f64>) -> Result<SharedLaw, mpm_core::Error> {
    let soaked = |bulk: f64, shear: f64| {
        let what = "water in the pores of a body of this law";
        let dry = mpm_core::Error::Input { what, value: 0.0, allowed: "one [water], whose porosity the law has" };
        ImprovedHencky::new(bulk, shear, porosity.ok_or(dry)?)
    };
    Ok(match form {
        LawForm::NeoHookean { young_modulus_pa: e, poisson_ratio: nu } => NeoHookean::new(e.0, nu.0)?.into(),
        LawForm::Hencky { young_modulus_pa: e, poisson_ratio: nu } => Hencky::new(e.0, nu.0)?.into(),
        LawForm::HenckyJ2 { young_modulus_pa: e, poisson_ratio: nu, strength } => {
            HenckyJ2::new(e.0, nu.0, strength_of(strength)?)?.into()
        }
        LawForm::DruckerPrager {
            young_modulus_pa,
            poisson_ratio,
            cohesion_pa,
            friction_deg,
            dilation_deg,
            matched,
        } => {
            let matched = match matched {
                MatchedForm::PlaneStrain => Matched::PlaneStrain,
                MatchedForm::Compression => Matched::Compression,
                MatchedForm::Extension => Matched::Extension,
            };
            let angles = [friction_deg.0, dilation_deg.0].map(f64::to_radians);
            DruckerPrager::new((young_modulus_pa.0, poisson_ratio.0), cohesion_pa.0, angles, matched)?.into()
        }
        LawForm::MohrCoulomb {
            young_modulus_pa: e,
            poisson_ratio: nu,
            cohesion_pa,
            friction_deg,
            dilation_deg,
            tension_pa,
            residual,
        } => {
            let angles = [friction_deg.0, dilation_deg.0].map(f64::to_radians);
            let mut law = MohrCoulomb::new((e.0, nu.0), cohesion_pa.0, angles)?;
            if let Some(to) = residual {
                let angles = [to.friction_deg.0, to.dilation_deg.0].map(f64::to_radians);
                law = law.softening(to.cohesion_pa.0, angles, to.plastic_strain.0)?;
            }
            tension_pa.map_or(Ok(law), |tension| law.cut_off(tension.0))?.into()
        }
        LawForm::NewtonianFluid { bulk_modulus_pa: k, viscosity_pa_s: mu } => NewtonianFluid::new(k.0, mu.0)?.into(),
        LawForm::ImprovedHencky { bulk_parameter: k, shear_modulus_pa: g } => soaked(k.0, g.0)?.into(),
        LawForm::CamClay {
            bulk_parameter: k,
            shear_modulus_pa: g,
            critical_ratio: m,
            plastic_compressibility: c,
            preconsolidation_pa: yields,
            initial_pressure_pa: initial,
            alpha,
            gamma,
        } => {
            let clay = CamClay::new(soaked(k.0, g.0)?, m.0, c.0, yields.0, initial.0)?;
            clay.shaped(alpha.0, gamma.0)?.into()
        }
    })
}

impl Source {
    /// Form of the text, with its strengths divided.
    pub(super) fn form(&self) -> Result<Form, Error> {
        let mut form: Form = self.parse()?;
        if self.weaker != 1.0 {
            let place = form.law.span();
            let strong = |law: &Line<LawForm>| {
                matches!(
                    law.get_ref(),
                    LawForm::HenckyJ2 { .. } | LawForm::DruckerPrager { .. } | LawForm::MohrCoulomb { .. }
                )
            };
            if !form.laws().any(strong) {
                let why = "no strength to be divided: hencky-j2, drucker-prager and mohr-coulomb have one";
                return Err(self.fault(&place, why));
            }
            let bodies = [&mut form.body].into_iter().chain(&mut form.bodies);
            bodies
                .filter_map(|body| body.as_mut().cohesion_gradient_pa_m.as_mut())
                .for_each(|rise| rise.0 /= self.weaker);
            let phases = form.phases.iter_mut().filter_map(|phase| phase.as_mut().law.as_mut());
            let others = form.bodies.iter_mut().filter_map(|body| body.as_mut().law.as_mut()).map(Line::as_mut);
            for law in phases.chain([form.law.as_mut()]).chain(others) {
                let divide = |cohesion: &mut Finite, friction: &mut Finite, dilation: &mut NotNegative| {
                    cohesion.0 /= self.weaker;
                    friction.0 = (friction.0.to_radians().tan() / self.weaker).atan().to_degrees();
                    // Ground that flows with a smaller angle of friction does not dilate more than by that.
                    dilation.0 = dilation.0.min(friction.0);
                };
                if let LawForm::DruckerPrager { cohesion_pa, friction_deg, dilation_deg, .. }
                | LawForm::MohrCoulomb { cohesion_pa, friction_deg, dilation_deg, .. } = law
                {
                    divide(cohesion_pa, friction_deg, dilation_deg);
                }
                if let LawForm::MohrCoulomb { tension_pa, residual, .. } = law {
                    tension_pa.iter_mut().for_each(|tension| tension.0 /= self.weaker);
                    if let Some(to) = residual {
                        divide(&mut to.cohesion_pa, &mut to.friction_deg, &mut to.dilation_deg);
                    }
                }
                let LawForm::HenckyJ2 { strength, .. } = law else { continue };
                match strength {
                    StrengthForm::Undrained { shear_strength_pa: peak } | StrengthForm::Perfect { norm_pa: peak } => {
                        peak.0 /= self.weaker;
                    }
                    StrengthForm::Softening { peak_pa, residual_pa, .. } => {
                        peak_pa.0 /= self.weaker;
                        residual_pa.0 /= self.weaker;
                    }
                }
            }
        }
        Ok(form)
    }
}

/// The cohesion (Pa) at the start of a law whose particles can have a strength of their own; zero of others.
pub(super) fn cohesion(form: &LawForm) -> f64 {
    if let LawForm::MohrCoulomb { cohesion_pa, .. } = form { cohesion_pa.0 } else { 0.0 }
}

/// The undrained shear strength (Pa) at the start, ‖s‖/√2, of a law that yields by one.
pub(super) fn shear_strength(form: &LawForm) -> Option<f64> {
    let LawForm::HenckyJ2 { strength, .. } = form else {
        return None;
    };
    Some(match strength {
        StrengthForm::Undrained { shear_strength_pa } => shear_strength_pa.0,
        StrengthForm::Perfect { norm_pa } => norm_pa.0 / f64::sqrt(2.0),
        StrengthForm::Softening { peak_pa, .. } => peak_pa.0 / f64::sqrt(2.0),
    })
}

/// Shear modulus at rest (Pa).
pub(super) fn shear_modulus(form: &LawForm) -> f64 {
    match form {
        LawForm::NeoHookean { young_modulus_pa: e, poisson_ratio: nu }
        | LawForm::Hencky { young_modulus_pa: e, poisson_ratio: nu }
        | LawForm::HenckyJ2 { young_modulus_pa: e, poisson_ratio: nu, .. }
        | LawForm::DruckerPrager { young_modulus_pa: e, poisson_ratio: nu, .. }
        | LawForm::MohrCoulomb { young_modulus_pa: e, poisson_ratio: nu, .. } => e.0 / (2.0 + 2.0 * nu.0),
        LawForm::NewtonianFluid { .. } => 0.0,
        LawForm::ImprovedHencky { shear_modulus_pa: g, .. } | LawForm::CamClay { shear_modulus_pa: g, .. } => g.0,
    }
}

fn strength_of(form: &StrengthForm) -> Result<Strength, mpm_core::Error> {
    match form {
        StrengthForm::Undrained { shear_strength_pa } => Strength::undrained(shear_strength_pa.0),
        StrengthForm::Perfect { norm_pa } => Strength::perfect(norm_pa.0),
        StrengthForm::Softening { peak_pa, residual_pa, eta } => Strength::softening(peak_pa.0, residual_pa.0, eta.0),
    }
}
