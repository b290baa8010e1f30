//! The problems, a folder or a file each. The page `docs/NAME.md` of a problem has its set-up and choices, and derives its bounds.

use crate::case::Case;
use crate::error::Error;
use crate::foreign::Foreign;
use std::sync::LazyLock;

mod analysis;
mod bearing;
mod build;
mod cantilever;
mod checks;
mod column;
mod conditioning;
mod consolidation;
mod cook;
mod critical_step;
mod dam_break;
mod discs;
mod drop;
mod excavation;
mod family;
mod footing;
mod forms;
mod landslide;
mod mandel;
mod manufactured;
mod mms_axis;
mod mms_double_shear;
mod mms_poro;
mod mms_static;
mod mms_swirl;
mod mms_vortex_box;
mod mms_vortex_pressure;
mod mms_vortex_ring;
mod mms_wall_pressure;
mod newton;
mod observe;
pub(crate) mod parameters;
mod patch;
mod pictures;
mod poro;
mod prelude;
mod rest;
pub mod scene;
mod shock;
mod slope;
mod slope_stability;
mod soils;
mod sparse;
mod spin;
mod standing_wave;
mod stretch;
mod strip;
mod terzaghi;
mod thin;
mod translate;
mod undrained;
mod vibrating_bar;

static ALL: LazyLock<Vec<Case>> = LazyLock::new(|| {
    vec![
        cook::case(),
        footing::case(),
        bearing::case(),
        dam_break::case(),
        landslide::case(),
        landslide::plane_case(),
        slope_stability::case(),
        soils::case(),
        mms_axis::case(),
        mms_wall_pressure::case(),
        mms_vortex_ring::case(),
        mms_vortex_box::case(),
        mms_vortex_pressure::case(),
        mms_double_shear::case(),
        mms_swirl::case(),
        mms_static::case(),
        vibrating_bar::case(),
        column::case(),
        standing_wave::case(),
        cantilever::case(),
        discs::case(),
        excavation::case(),
        terzaghi::case(),
        mandel::case(),
        conditioning::case(),
        undrained::case(),
        mms_poro::case(),
        consolidation::case(),
        strip::case(),
        critical_step::case(),
        spin::case(),
        translate::case(),
        shock::case(),
        stretch::case(),
        newton::case(),
        drop::case(),
        sparse::case(),
        thin::case(),
        rest::case(),
        patch::case(),
    ]
});

/// All problems.
#[must_use]
pub fn all() -> &'static [Case] {
    &ALL
}

static FOREIGN: LazyLock<Vec<(&str, Foreign)>> = LazyLock::new(|| {
    vec![
        ("cook", cook::foreign::foreign()),
        ("footing", footing::foreign::foreign()),
        ("dam-break", dam_break::foreign::foreign()),
        ("landslide", landslide::foreign::foreign::<3>()),
        ("landslide-2d", landslide::foreign::foreign::<2>()),
        ("slope-stability", slope_stability::foreign::foreign()),
        ("vibrating-bar", vibrating_bar::foreign()),
        ("column", column::foreign()),
        ("cantilever", cantilever::foreign::foreign()),
        ("terzaghi", terzaghi::foreign::foreign()),
        ("consolidation", consolidation::foreign::foreign()),
    ]
});

/// The problems by which other codes are scored, and how.
pub fn scored() -> impl Iterator<Item = (&'static Case, &'static Foreign)> {
    FOREIGN.iter().filter_map(|(name, foreign)| Some((find(name).ok()?, foreign)))
}

/// The problem of a name by which other codes are scored.
///
/// # Errors
/// The name is unknown; the error lists the known names.
pub fn find_scored(name: &str) -> Result<(&'static Case, &'static Foreign), Error> {
    let unknown = || Error::unknown("case that scores", name, FOREIGN.iter().map(|(n, _)| *n));
    scored().find(|(case, _)| case.name == name).ok_or_else(unknown)
}

/// The place of a case among all; behind them if it is not known.
pub(crate) fn place(name: &str) -> usize {
    ALL.iter().position(|c| c.name == name).unwrap_or(ALL.len())
}

/// The problem of a name.
///
/// # Errors
/// The name is unknown; the error lists the known names.
pub fn find(name: &str) -> Result<&'static Case, Error> {
    ALL.iter().find(|c| c.name == name).ok_or_else(|| Error::unknown("case", name, ALL.iter().map(|c| c.name)))
}
