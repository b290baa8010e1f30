//! The problems, one file each.

mod column;
mod cook;
mod dam_break;
mod footing;
mod landslide;
mod manufactured;
mod mms_axis;
mod mms_double_shear;
mod mms_swirl;
mod mms_vortex_box;
mod mms_vortex_pressure;
mod mms_vortex_ring;
mod mms_wall_pressure;
mod slope_stability;
mod standing_wave;
mod vibrating_bar;

pub(crate) use dam_break::dam_break_front;
pub(crate) use footing::footing_limit;

use crate::case::Case;
use crate::error::Error;

/// All problems.
#[must_use]
pub fn all() -> Vec<&'static dyn Case> {
    vec![
        &cook::Cook,
        &footing::Footing,
        &dam_break::DamBreak,
        &landslide::Landslide,
        &landslide::Landslide2d,
        &slope_stability::SlopeStability,
        &*mms_axis::CASE,
        &*mms_wall_pressure::CASE,
        &*mms_vortex_ring::CASE,
        &*mms_vortex_box::CASE,
        &*mms_vortex_pressure::CASE,
        &*mms_double_shear::CASE,
        &*mms_swirl::CASE,
        &*vibrating_bar::CASE,
        &*column::CASE,
        &*standing_wave::CASE,
    ]
}

/// The place of a case among all; behind them if it is not known.
#[must_use]
pub fn place(name: &str) -> usize {
    let cases = all();
    let known = cases.iter().position(|c| c.name() == name);
    known.unwrap_or(cases.len())
}

/// The problem of a name.
///
/// # Errors
/// There is none; the error lists those there are.
pub fn find(name: &str) -> Result<&'static dyn Case, Error> {
    let cases = all();
    cases
        .iter()
        .find(|c| c.name() == name)
        .copied()
        .ok_or_else(|| Error::unknown("case", name, cases.iter().map(|c| c.name())))
}
