//! The water of a scene: how it fills and leaves the pores, what it weighs, and the faces of the body that it leaves
//! by.

use super::face::{Face, OfPlace};
use super::plate::Plate;
use crate::bodies::Bodies;
use crate::error::{Error, require};
use crate::frame::Frame;
use crate::grid::Grid;
use crate::number::Real;

/// κ = k/(ρ g) (m²/(Pa s)) of a hydraulic conductivity k (m/s): the flux that a pressure gradient of one drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Conductivity {
    /// The same at any porosity.
    Constant(f64),
    /// c n³/(1 − n)² with the given c, after Kozeny and Carman.
    KozenyCarman(f64),
}

impl Conductivity {
    /// κ (m²/(Pa s)) at the porosity `n`.
    #[inline(always)]
    pub fn at<T: Real>(&self, n: T) -> T {
        match *self {
            Self::Constant(k) => T::splat(k),
            Self::KozenyCarman(c) => {
                let solid = T::splat(1.0) - n;
                T::splat(c) * n * n * n / (solid * solid)
            }
        }
    }
}

/// Gravity on water and grains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity<const D: usize> {
    /// Density of the water (kg/m³).
    pub water: f64,
    /// Density of the grains (kg/m³).
    pub grains: f64,
    /// Acceleration (m/s²).
    pub acceleration: [f64; D],
}

/// Water that comes into a place of the body between two times (s), as a share of the undeformed volume there: a
/// function of the reference position (m). Over short times it is the rate (1/s) times their difference.
pub type Source<const D: usize> = Box<dyn Fn(&[f64; D], [f64; 2]) -> f64 + Send + Sync>;

/// The pores of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Porosity n₀ of the undeformed solid; n = 1 − (1 − n₀)/J.
    pub porosity: f64,
    /// Conductivity.
    pub conductivity: Conductivity,
    /// Density of its grains (kg/m³), where that is not [`Gravity::grains`].
    pub grains: Option<f64>,
}

impl Medium {
    /// κ (m²/(Pa s)) of undeformed material.
    pub fn initial_conductivity(&self) -> f64 {
        self.conductivity.at(self.porosity)
    }
}

/// The water in one or several bodies, and where it may leave.
pub struct Water<const D: usize> {
    /// The pores of every body.
    pub media: Vec<Medium>,
    /// Gravity, if there is any.
    pub gravity: Option<Gravity<D>>,
    /// Pressure (Pa) at the start, as hydrostatic water has it.
    pub start: OfPlace<D, f64>,
    /// Pressure nodes that are held at zero, by their places (m): for bodies whose drained faces lie on grid lines.
    pub drained: OfPlace<D, bool>,
    /// Loaded and drained faces.
    pub faces: Vec<Face<D>>,
    /// Where water comes in or is taken out within the body.
    pub sources: Vec<Source<D>>,
    /// Rigid plates.
    pub plates: Vec<Plate<D>>,
}

impl<const D: usize> Water<D> {
    /// Weightless water without pressure that cannot leave.
    #[must_use]
    pub fn new(porosity: f64, conductivity: Conductivity) -> Self {
        Self {
            media: vec![Medium { porosity, conductivity, grains: None }],
            gravity: None,
            start: Box::new(|_| 0.0),
            drained: Box::new(|_| false),
            faces: Vec::new(),
            sources: Vec::new(),
            plates: Vec::new(),
        }
    }

    /// With the pores of another body, after those that are there.
    #[must_use]
    pub fn and(mut self, porosity: f64, conductivity: Conductivity) -> Self {
        self.media.push(Medium { porosity, conductivity, grains: None });
        self
    }

    /// With grains of another density (kg/m³) in the last of the bodies that are there.
    #[must_use]
    pub fn grains(mut self, density: f64) -> Self {
        self.media.iter_mut().last().into_iter().for_each(|medium| medium.grains = Some(density));
        self
    }

    /// With gravity.
    #[must_use]
    pub fn gravity(self, gravity: Gravity<D>) -> Self {
        Self { gravity: Some(gravity), ..self }
    }

    /// With a pressure (Pa) at the start, a function of the place (m).
    #[must_use]
    pub fn start(self, pressure: impl Fn(&[f64; D]) -> f64 + Send + Sync + 'static) -> Self {
        Self { start: Box::new(pressure), ..self }
    }

    /// With pressure nodes held at zero where `at` says so of their places (m).
    #[must_use]
    pub fn drained(self, at: impl Fn(&[f64; D]) -> bool + Send + Sync + 'static) -> Self {
        Self { drained: Box::new(at), ..self }
    }

    /// With another loaded or drained face.
    #[must_use]
    pub fn face(mut self, face: Face<D>) -> Self {
        self.faces.push(face);
        self
    }

    /// With another source.
    #[must_use]
    pub fn source(mut self, of: impl Fn(&[f64; D], [f64; 2]) -> f64 + Send + Sync + 'static) -> Self {
        self.sources.push(Box::new(of));
        self
    }

    /// With another rigid plate.
    #[must_use]
    pub fn plate(mut self, plate: Plate<D>) -> Self {
        self.plates.push(plate);
        self
    }

    /// The same water in a body on `grid`, seen from `frame`.
    #[must_use]
    pub fn seen_from(self, frame: &Frame<D>, grid: &Grid<D>) -> Self {
        let (frame, grid) = (*frame, *grid);
        let permeability = frame.scale(-1, 2);
        let density = frame.scale(1, -2);
        let scaled = |medium: Medium| Medium {
            conductivity: match medium.conductivity {
                Conductivity::Constant(k) => Conductivity::Constant(permeability * k),
                Conductivity::KozenyCarman(c) => Conductivity::KozenyCarman(permeability * c),
            },
            grains: medium.grains.map(|grains| density * grains),
            ..medium
        };
        let (start, drained) = (self.start, self.drained);
        let sources = self
            .sources
            .into_iter()
            .map(|source| -> Source<D> { Box::new(move |x, times| source(&frame.place_of_scene(x), times)) });
        let faces = self.faces.into_iter().map(|f| f.seen_from(&frame));
        let plates = self.plates.into_iter();
        Self {
            media: self.media.into_iter().map(scaled).collect(),
            gravity: self.gravity.map(|gravity| Gravity {
                water: density * gravity.water,
                grains: density * gravity.grains,
                acceleration: frame.vector(&gravity.acceleration, frame.scale(0, 1)),
            }),
            start: Box::new(move |x| frame.scale(1, 0) * start(&frame.place_of_scene(x))),
            drained: Box::new(move |x| drained(&frame.node_of_scene(&grid, x))),
            faces: faces.collect(),
            sources: sources.collect(),
            plates: plates.map(|p| p.seen_from(&frame, &grid)).collect(),
        }
    }

    /// Greatest κ (m²/(Pa s)) of undeformed material.
    pub(super) fn greatest_conductivity(&self) -> f64 {
        self.media.iter().map(Medium::initial_conductivity).fold(0.0, f64::max)
    }

    /// `drains`: whether water may leave.
    pub(super) fn check(&self, drains: bool, bodies: &Bodies<D>) -> Result<(), Error> {
        let (count, allowed) = (self.media.len(), "as many as there are bodies");
        require(count == bodies.each.len(), "media of a body with water", count as f64, allowed)?;
        for (medium, body) in self.media.iter().zip(&bodies.each) {
            let n = medium.porosity;
            require(n > 0.0 && n < 1.0, "porosity", n, "above 0 and below 1")?;
            let same = body.law.porosity().is_none_or(|of_law| of_law == n);
            require(same, "porosity of the water", n, "that of the solid's law")?;
            let k = medium.initial_conductivity();
            require(k >= 0.0, "conductivity", k, "at least 0 (m²/(Pa s))")?;
            require(k > 0.0 || !drains, "conductivity of a body that drains", k, "positive (m²/(Pa s))")?;
        }
        let Some(gravity) = &self.gravity else {
            return Ok(());
        };
        let own = self.media.iter().map(|medium| medium.grains.unwrap_or(gravity.grains));
        let grains = own.map(|density| ("density of grains", density));
        for (what, density) in [("density of water", gravity.water)].into_iter().chain(grains) {
            require(density > 0.0, what, density, "positive (kg/m³)")?;
        }
        let mut components = gravity.acceleration.into_iter();
        let (what, allowed) = ("acceleration of gravity", "finite (m/s²)");
        components.try_for_each(|g| require(true, what, g, allowed))
    }
}
