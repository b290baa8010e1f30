//! A run as its case sees it: parameters, scheme and cells, read once from a plan or from a record. Quantities that follow from
//! these are methods of a case's `Setup`, for scene, observation, checks, tables and figures alike.

use crate::error::Error;
use crate::metric::Metric;
use crate::parameter::{Parameter, ParameterSet, Parameters};
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, SpaceName, TransferName};
use crate::spec::RunSpec;
use std::ops::Deref;

/// The parameters `P` of a case, its scheme and its cells.
#[derive(Debug, Clone)]
pub(crate) struct Setup<P> {
    pub scheme: Scheme,
    /// Cell size (m).
    pub h: f64,
    /// Name of the level.
    pub level: String,
    /// Parameters changed from their defaults, as `name=value`.
    pub set: Vec<String>,
    /// Whether every particle starts a last bit beside its place.
    pub perturbed: bool,
    /// All parameters by name.
    pub values: Parameters,
    own: P,
}

impl<P> Deref for Setup<P> {
    type Target = P;

    fn deref(&self) -> &P {
        &self.own
    }
}

impl<P: ParameterSet> Setup<P> {
    /// The setup of a run to be made.
    ///
    /// # Errors
    /// A parameter of another type.
    pub(crate) fn of_spec(spec: &RunSpec, values: &Parameters) -> Result<Self, Error> {
        Ok(Self::new(spec, values, P::read(values)?))
    }

    /// The same, with the parameters that the run sets.
    ///
    /// # Errors
    /// A parameter that is unknown, or of another type.
    pub(crate) fn of_plan(spec: &RunSpec) -> Result<Self, Error> {
        Self::of_spec(spec, &Parameters::new(&P::list(), &spec.set)?)
    }

    /// The setup of a run that was made.
    ///
    /// # Errors
    /// A parameter of another type.
    pub(crate) fn of_record(record: &Record) -> Result<Self, Error> {
        Ok(Self {
            scheme: record.scheme(),
            h: record.discretisation.h,
            level: record.level.clone(),
            set: record.set.clone(),
            perturbed: record.perturbed,
            values: record.parameters.clone(),
            own: P::read(&record.parameters)?,
        })
    }

    /// A number that follows from the setup of a record; NaN if the record's parameters are of another type.
    pub(crate) fn number_of(record: &Record, number: impl FnOnce(&Self) -> f64) -> f64 {
        Self::of_record(record).map_or(f64::NAN, |setup| number(&setup))
    }

    /// Whether the setup of a record meets a condition; false if the record's parameters are of another type.
    pub(crate) fn holds(record: &Record, condition: impl FnOnce(&Self) -> bool) -> bool {
        Self::of_record(record).is_ok_and(|setup| condition(&setup))
    }
}

impl<P> Setup<P> {
    /// The number that a parameter is; NaN without it.
    pub(crate) fn number(&self, parameter: Parameter) -> f64 {
        self.values.number(parameter)
    }

    /// The setup of a run to be made, with parameters of its `own`.
    pub(crate) fn new(spec: &RunSpec, values: &Parameters, own: P) -> Self {
        Self {
            scheme: spec.scheme,
            h: spec.level.h,
            level: spec.level.name.to_owned(),
            set: spec.set.clone(),
            perturbed: spec.perturbed,
            values: values.clone(),
            own,
        }
    }

    /// The basis functions.
    pub(crate) fn basis(&self) -> BasisName {
        self.scheme.basis()
    }

    /// The locking remedy.
    pub(crate) fn remedy(&self) -> RemedyName {
        self.scheme.remedy()
    }

    pub(crate) fn transfer(&self) -> TransferName {
        self.scheme.transfer()
    }

    /// The time rule of an implicit scheme.
    pub(crate) fn rule(&self) -> Option<RuleName> {
        self.scheme.rule()
    }

    /// The pressure space of a scheme of solid and water.
    pub(crate) fn space(&self) -> Option<SpaceName> {
        match self.scheme {
            Scheme::Poro(parts) => Some(parts.space),
            _ => None,
        }
    }

    /// Whether the scheme is explicit.
    pub(crate) fn is_explicit(&self) -> bool {
        matches!(self.scheme, Scheme::Explicit(_))
    }

    /// Whether the scheme is implicit, static or not.
    pub(crate) fn is_implicit(&self) -> bool {
        self.rule().is_some()
    }

    /// Whether steps are of equilibrium.
    pub(crate) fn is_static(&self) -> bool {
        self.rule() == Some(RuleName::QuasiStatic)
    }

    /// Whether the case's own parameters were changed in nothing.
    pub(crate) fn is_default(&self) -> bool {
        self.set.is_empty()
    }

    /// Initial positions (m) of particles seeded at `positions`: these, or, in a perturbed run, the next floating-point numbers.
    pub(crate) fn start_at<const D: usize>(&self, positions: impl IntoIterator<Item = [f64; D]>) -> Vec<[f64; D]> {
        crate::spec::start_at(positions.into_iter().collect(), self.perturbed)
    }
}

/// A run that has come to its end: its [`Setup`], and its record.
pub(crate) struct Run<'a, P> {
    pub(crate) record: &'a Record,
    setup: Setup<P>,
}

impl<P> Deref for Run<'_, P> {
    type Target = Setup<P>;

    fn deref(&self) -> &Setup<P> {
        &self.setup
    }
}

impl<'a, P: ParameterSet> Run<'a, P> {
    pub(crate) fn of(record: &'a Record) -> Result<Self, Error> {
        Ok(Self { record, setup: Setup::of_record(record)? })
    }

    /// The runs of records whose parameters are of the case's types; the checks of a run name the others.
    pub(crate) fn all(records: impl IntoIterator<Item = &'a Record>) -> impl Iterator<Item = Self> {
        records.into_iter().filter_map(|record| Self::of(record).ok())
    }

    /// Those that have come to their end.
    pub(crate) fn ended(records: &'a [Record]) -> Vec<Self> {
        Self::all(records.iter().filter(|r| r.status == Status::Ok)).collect()
    }
}

impl<P> Run<'_, P> {
    /// The value of a metric; NaN if it is missing.
    pub(crate) fn metric(&self, of: Metric) -> f64 {
        self.record.metric(of)
    }

    /// Whether a metric was measured.
    pub(crate) fn has(&self, metric: Metric) -> bool {
        self.metric(metric).is_finite()
    }

    /// Time step (s).
    pub(crate) fn dt(&self) -> f64 {
        self.record.discretisation.dt
    }
}
