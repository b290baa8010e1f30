//! Metrics, and what is shown of them.

use crate::parameter::Parameter;
use serde::Serialize;
use std::ops::RangeInclusive;

/// A metric: what a run measures, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Metric {
    pub name: &'static str,
    pub unit: &'static str,
    pub meaning: &'static str,
}

/// A metric by name, unit and meaning.
pub(crate) const fn metric(name: &'static str, unit: &'static str, meaning: &'static str) -> Metric {
    Metric { name, unit, meaning }
}

/// Metrics by name, unit and meaning, and the list of all: each a constant, or each with where it is measured.
macro_rules! metrics {
    ($seen:vis $all:ident: $($metric:ident = $name:literal, $unit:literal, $meaning:literal;)*) => {
        $($seen const $metric: $crate::metric::Metric = $crate::metric::metric($name, $unit, $meaning);)*
        $seen const $all: &[$crate::metric::Metric] = &[$($metric),*];
    };
    ($(#[$doc:meta])* $seen:vis $all:ident at $place:ty:
        $($at:expr => $name:literal, $unit:literal, $meaning:literal;)*) => {
        $(#[$doc])*
        $seen const $all: &[($crate::metric::Metric, $place)] =
            &[$(($crate::metric::metric($name, $unit, $meaning), $at)),*];
    };
}
pub(crate) use metrics;

/// The metrics of a list, without where they are measured.
pub(crate) fn names<T>(measured: &[(Metric, T)]) -> impl Iterator<Item = Metric> {
    measured.iter().map(|(metric, _)| *metric)
}

/// The values that a metric of this name can have, whatever the case and the run: names mean the same everywhere.
pub(crate) fn possible(name: &str) -> RangeInclusive<f64> {
    const NEVER_NEGATIVE: [&str; 12] = [
        "_l2",
        "_linf",
        "_rms",
        "_rms_error",
        "_dissipation",
        "_strain_max",
        "_iterations",
        "energy_gain",
        "energy_loss",
        "mass",
        "_volume",
        "momentum_error",
    ];
    if name.starts_with("jacobian_m") {
        f64::MIN_POSITIVE..=f64::MAX
    } else if name == "at_rest" || name.contains("_share") {
        0.0..=1.0
    } else if NEVER_NEGATIVE.iter().any(|end| name.ends_with(end)) {
        0.0..=f64::MAX
    } else {
        f64::MIN..=f64::MAX
    }
}

impl From<Metric> for String {
    fn from(metric: Metric) -> Self {
        metric.name.to_owned()
    }
}

/// A quantity whose convergence over the levels is studied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    pub metric: Metric,
    /// Label of the axis.
    pub label: &'static str,
    /// Whether the metric is an error, whose exact value is zero; if not, Richardson's extrapolation
    /// stands in for the exact value.
    pub is_error: bool,
    /// The order of an error, where theory gives it.
    pub order: Option<f64>,
    /// The uncertainty of the reference of an error: smaller errors decide nothing.
    pub uncertainty: Option<f64>,
}

impl Quantity {
    /// Sets the theoretical order.
    pub(crate) const fn of_order(self, order: f64) -> Self {
        Self { order: Some(order), ..self }
    }

    /// Against a reference with this uncertainty.
    pub(crate) const fn known_to(self, uncertainty: f64) -> Self {
        Self { uncertainty: Some(uncertainty), ..self }
    }
}

/// A parameter over whose values the errors are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// The parameter, a number.
    pub parameter: Parameter,
    /// Label of the axis.
    pub label: &'static str,
    /// Abscissa of a value, such as its distance from a limit; positive if drawn by its logarithm.
    pub abscissa: fn(f64) -> f64,
    /// Whether it is drawn by its logarithm.
    pub logarithmic: bool,
}

impl Sweep {
    /// Over the values themselves.
    pub(crate) const fn of(parameter: Parameter, label: &'static str) -> Self {
        Self { parameter, label, abscissa: |value| value, logarithmic: false }
    }

    /// Drawn by the logarithm of the abscissa.
    pub(crate) const fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// Over another abscissa.
    pub(crate) const fn over(self, abscissa: fn(f64) -> f64) -> Self {
        Self { abscissa, ..self }
    }
}

/// An error whose convergence is studied, by metric and label.
pub(crate) const fn error(metric: Metric, label: &'static str) -> Quantity {
    Quantity { metric, label, is_error: true, order: None, uncertainty: None }
}

/// A quantity that is not an error, by metric and label.
pub(crate) const fn value(metric: Metric, label: &'static str) -> Quantity {
    Quantity { is_error: false, ..error(metric, label) }
}
