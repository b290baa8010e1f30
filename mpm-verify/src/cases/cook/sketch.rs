//! The geometry of Cook's membrane, drawn.

use super::geometry::{LEFT_HEIGHT, LENGTH, RIGHT_HEIGHT};
use super::metrics::MEAN_STRESSES;
use crate::sketch::{Shape, Sketch};

/// The membrane as it is drawn.
pub(super) fn sketch() -> Sketch {
    let tip = LEFT_HEIGHT + RIGHT_HEIGHT;
    let length = |from, to, label: &str| Shape::Length { from, to, label: label.to_owned() };
    let probe = |at, label: &str| Shape::Probe { at, label: label.to_owned() };
    let mut shapes = vec![
        Shape::Body(vec![[0.0, 0.0], [LENGTH, LEFT_HEIGHT], [LENGTH, tip], [0.0, LEFT_HEIGHT]]),
        Shape::Held([0.0, 0.0], [0.0, LEFT_HEIGHT]),
        length([0.0, -6.0], [LENGTH, -6.0], "48 m"),
        length([-8.0, 0.0], [-8.0, LEFT_HEIGHT], "44 m"),
        length([58.0, LEFT_HEIGHT], [58.0, tip], "16 m"),
        Shape::Note { at: [52.0, 40.0], text: "1 N/m".to_owned() },
    ];
    for k in 0..4 {
        let y = LEFT_HEIGHT + 4.0 * f64::from(k);
        shapes.push(Shape::Load([LENGTH + 2.0, y], [LENGTH + 2.0, y + 3.2]));
    }
    shapes.push(probe([LENGTH, tip], "tip"));
    shapes.push(probe([LENGTH, LEFT_HEIGHT + 0.5 * RIGHT_HEIGHT], "mid-edge"));
    shapes.extend(MEAN_STRESSES.iter().map(|(_, x)| probe(*x, "σ_m")));
    Sketch {
        shapes,
        description: "A trapezoid 48 m long, 44 m high at its clamped left side and 16 m at its right side, which carries an upward load.",
    }
}
