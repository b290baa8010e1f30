//! The camera: from where a body is seen, and where its points lie in the picture.

/// A position or direction in the axes of the problem.
pub(super) type Place = [f64; 3];

/// The vertical axis of a problem, upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Up {
    /// y.
    Y,
    /// z.
    Z,
}

impl Up {
    /// Index of the vertical axis.
    pub(super) fn index(self) -> usize {
        match self {
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    /// Index of the horizontal axis beside x.
    pub(super) fn across(self) -> usize {
        3 - self.index()
    }

    /// Horizontal direction out of the picture, if x points to its right.
    fn front(self) -> Place {
        match self {
            Self::Y => [0.0, 0.0, 1.0],
            Self::Z => [0.0, -1.0, 0.0],
        }
    }

    fn vertical(self) -> Place {
        match self {
            Self::Y => [0.0, 1.0, 0.0],
            Self::Z => [0.0, 0.0, 1.0],
        }
    }
}

/// Where a body is seen from. The projection is orthographic: a length along an axis is the same everywhere in the
/// picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Angle (degrees) by which the eye has turned about the vertical: at 0 it looks straight at the plane of x and the
    /// vertical, with x to the right; at 90 from the positive end of x along it.
    pub azimuth: f64,
    /// Angle (degrees) of the eye above the horizontal plane.
    pub elevation: f64,
    /// The vertical axis.
    pub up: Up,
}

/// The unit vectors of a camera: rightwards and upwards in the picture, and out of it towards the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct View([Place; 3]);

impl View {
    pub(super) fn new(camera: Camera) -> Self {
        let (turn, tilt) = (camera.azimuth.to_radians(), camera.elevation.to_radians());
        let (front, vertical) = (camera.up.front(), camera.up.vertical());
        let x = [1.0, 0.0, 0.0];
        let level = sum([(turn.cos(), front), (turn.sin(), x)]);
        Self([
            sum([(turn.cos(), x), (-turn.sin(), front)]),
            sum([(tilt.cos(), vertical), (-tilt.sin(), level)]),
            sum([(tilt.cos(), level), (tilt.sin(), vertical)]),
        ])
    }

    /// Of a point or direction: to the right, up, and towards the eye (m).
    #[inline]
    pub(super) fn project(&self, at: Place) -> Place {
        let [right, up, eye] = self.0;
        [dot(right, at), dot(up, at), dot(eye, at)]
    }

    /// The point or direction with this projection.
    #[inline]
    pub(super) fn restore(&self, [right, up, near]: Place) -> Place {
        let [r, u, e] = self.0;
        let flat = sum([(right, r), (up, u)]);
        sum([(1.0, flat), (near, e)])
    }
}

#[inline]
pub(super) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(super) fn sum([(p, a), (q, b)]: [(f64, Place); 2]) -> Place {
    [
        p * a[0] + q * b[0],
        p * a[1] + q * b[1],
        p * a[2] + q * b[2],
    ]
}

/// The direction of a vector; none if it has no length.
pub(super) fn unit(a: Place) -> Option<Place> {
    let length = dot(a, a).sqrt();
    (length > 1e-9).then(|| a.map(|v| v / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Place, b: Place) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn known_points_are_projected_to_known_places() {
        let half = 0.5_f64.sqrt();
        let view = |azimuth, elevation, up| {
            View::new(Camera {
                azimuth,
                elevation,
                up,
            })
        };
        for (view, at, expected) in [
            // The front: x to the right, the vertical up.
            (view(0.0, 0.0, Up::Y), [1.0, 2.0, 3.0], [1.0, 2.0, 3.0]),
            (view(0.0, 0.0, Up::Z), [1.0, 2.0, 3.0], [1.0, 3.0, -2.0]),
            // From the end of x, and from above.
            (view(90.0, 0.0, Up::Y), [1.0, 2.0, 3.0], [-3.0, 2.0, 1.0]),
            (view(0.0, 90.0, Up::Y), [1.0, 2.0, 3.0], [1.0, -3.0, 2.0]),
            (view(0.0, 90.0, Up::Z), [1.0, 2.0, 3.0], [1.0, 2.0, 3.0]),
            (view(45.0, 0.0, Up::Y), [1.0, 0.0, 0.0], [half, 0.0, half]),
            (view(0.0, 45.0, Up::Y), [0.0, 1.0, 0.0], [0.0, half, half]),
        ] {
            let found = view.project(at);
            assert!(near(found, expected), "{found:?} {expected:?}");
            assert!(near(view.restore(found), at));
        }
    }
}
