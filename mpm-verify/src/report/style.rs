//! How the curve of a scheme looks, the same in every picture.

use super::plot::{Dash, Marker, Series};
use crate::scheme::{BasisName, RemedyName, Scheme};

/// What the colour of a curve tells.
#[derive(Clone, Copy)]
pub(super) enum Colour {
    /// The basis; remedies differ in marker and line.
    Basis,
    /// The remedy, for curves of one basis with too many points for markers.
    Remedy,
}

/// The curve of a scheme.
pub(super) fn series(scheme: Scheme, points: Vec<(f64, f64)>, colour: Colour) -> Series {
    // Total and rate nearly coincide: the dashed line and the hollow marker let the other show.
    let (marker, dash, of_remedy) = match scheme.remedy {
        RemedyName::None => (Marker::Cross, Dash::Dotted, 6),
        RemedyName::FbarRecursive => (Marker::Triangle, Dash::Solid, 1),
        RemedyName::FbarTotal => (Marker::Square, Dash::Solid, 2),
        RemedyName::FbarRate => (Marker::Circle, Dash::Dashed, 0),
    };
    let of_basis = match scheme.basis {
        BasisName::Gimp => 0,
        BasisName::Bspline2 => 1,
        BasisName::Bspline3 => 2,
        BasisName::Linear => 3,
    };
    let (colour, marker) = match colour {
        Colour::Basis => (of_basis, marker),
        Colour::Remedy => (of_remedy, Marker::None),
    };
    Series {
        name: format!("{} {}", scheme.basis, scheme.remedy),
        points,
        colour,
        marker,
        dash,
    }
}
