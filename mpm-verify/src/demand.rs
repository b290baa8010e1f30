//! Checks as sentences: a quantity of a run or of several, its reference and tolerance, where it applies, and the source.

use crate::accuracy::fit_order;
use crate::check::{Check, Finding, On};
use crate::metric::Metric;
use crate::parameter::ParameterSet;
use crate::record::Record;
use crate::scheme::Scheme;
use crate::setup::Run;
use crate::verdict::Kind;
use std::collections::BTreeMap;

/// Largest deficit of an observed order from the order that theory gives.
pub(crate) const SLACK: f64 = 0.15;
/// Number of finest levels or steps that decide an order.
const DECIDING: usize = 3;

/// A closure that a check holds, on any thread.
pub(crate) trait Held: Send + Sync + 'static {}
impl<T: Send + Sync + 'static> Held for T {}

type Of<P, T> = Box<dyn Fn(&Run<P>) -> T + Send + Sync>;

/// A quantity of a run: a metric, or a number computed from the run, by name.
pub(crate) struct Quantity<P> {
    name: String,
    value: Of<P, f64>,
}

impl<P> Quantity<P> {
    /// A number that follows from the run.
    pub(crate) fn new(name: impl Into<String>, value: impl Fn(&Run<P>) -> f64 + Held) -> Self {
        Self { name: name.into(), value: Box::new(value) }
    }

    /// The absolute value of a metric.
    pub(crate) fn abs(metric: Metric) -> Self {
        Self::new(metric.name, move |r| r.metric(metric).abs())
    }
}

impl<P> From<Metric> for Quantity<P> {
    fn from(metric: Metric) -> Self {
        Self::new(metric.name, move |r| r.metric(metric))
    }
}

enum Bound<P> {
    Within { reference: Of<P, f64>, tolerance: Of<P, f64> },
    AtMost(Of<P, f64>),
    Above(Of<P, f64>),
}

impl<P> Bound<P> {
    fn finding(&self, name: String, value: f64, run: &Run<P>, why: String) -> Finding {
        match self {
            Self::Within { reference, tolerance } => Finding::within(name, value, reference(run), tolerance(run), why),
            Self::AtMost(bound) => Finding::at_most(name, value, bound(run), why),
            Self::Above(bound) => Finding::above(name, value, bound(run), why),
        }
    }
}

enum Gate<P> {
    /// Nothing is said where it does not hold.
    When(Of<P, bool>),
    /// Not judged where there is a reason.
    Unless(Of<P, Option<String>>),
}

/// Decision of the gates on a run.
enum Passage {
    Judged,
    Unmentioned,
    NotJudged(String),
}

impl<P> Gate<P> {
    /// The first gate that stops a run decides.
    fn passage(gates: &[Self], run: &Run<P>) -> Passage {
        let stops = |gate: &Self| match gate {
            Self::When(holds) => (!holds(run)).then_some(Passage::Unmentioned),
            Self::Unless(reason) => reason(run).map(Passage::NotJudged),
        };
        gates.iter().find_map(stops).unwrap_or(Passage::Judged)
    }
}

/// Terms of a check, and of one quantity of it.
macro_rules! terms {
    () => {
        /// Says nothing of runs where `holds` is false.
        pub(crate) fn when(mut self, holds: impl Fn(&Run<P>) -> bool + Held) -> Self {
            self.gates.push(Gate::When(Box::new(holds)));
            self
        }

        /// Does not judge a run where there is a reason.
        pub(crate) fn unless(mut self, reason: impl Fn(&Run<P>) -> Option<String> + Held) -> Self {
            self.gates.push(Gate::Unless(Box::new(reason)));
            self
        }

        /// Does not judge a run where `holds`, for this reason.
        pub(crate) fn except(self, holds: impl Fn(&Run<P>) -> bool + Held, why: &'static str) -> Self {
            self.unless(move |r| holds(r).then(|| why.to_owned()))
        }

        /// The magnitude of a wrong value, where the reference is zero or a difference.
        pub(crate) fn of_scale(self, scale: impl Fn(&Run<P>) -> f64 + Held) -> Self {
            let scale: Of<P, f64> = Box::new(scale);
            Self { scale: Some(scale), ..self }
        }
    };
}

/// One quantity of a check with its bound.
pub(crate) struct Demand<P> {
    quantity: Quantity<P>,
    bound: Bound<P>,
    scale: Option<Of<P, f64>>,
    gates: Vec<Gate<P>>,
    why: Option<Of<P, String>>,
}

impl<P: ParameterSet> Demand<P> {
    fn new(quantity: Quantity<P>, bound: Bound<P>) -> Self {
        Self { quantity, bound, scale: None, gates: Vec::new(), why: None }
    }

    /// |quantity − reference| ≤ tolerance.
    pub(crate) fn within(
        quantity: impl Into<Quantity<P>>,
        reference: impl Fn(&Run<P>) -> f64 + Held,
        tolerance: impl Fn(&Run<P>) -> f64 + Held,
    ) -> Self {
        let (reference, tolerance) = (Box::new(reference), Box::new(tolerance));
        Self::new(quantity.into(), Bound::Within { reference, tolerance })
    }

    /// The quantity is a known number within a tolerance, where the run has these.
    pub(crate) fn known(
        quantity: impl Into<Quantity<P>>,
        known: impl Fn(&Run<P>) -> Option<(f64, f64)> + Copy + Held,
    ) -> Self {
        let of = move |part: fn((f64, f64)) -> f64| move |run: &Run<P>| known(run).map_or(f64::NAN, part);
        Self::within(quantity, of(|(number, _)| number), of(|(_, tolerance)| tolerance))
            .when(move |run| known(run).is_some())
    }

    pub(crate) fn at_most(quantity: impl Into<Quantity<P>>, bound: impl Fn(&Run<P>) -> f64 + Held) -> Self {
        Self::new(quantity.into(), Bound::AtMost(Box::new(bound)))
    }

    pub(crate) fn above(quantity: impl Into<Quantity<P>>, bound: impl Fn(&Run<P>) -> f64 + Held) -> Self {
        Self::new(quantity.into(), Bound::Above(Box::new(bound)))
    }

    terms!();

    /// The source of reference and tolerance, where it differs from that of the check.
    pub(crate) fn because_of(self, why: impl Fn(&Run<P>) -> String + Held) -> Self {
        let why: Of<P, String> = Box::new(why);
        Self { why: Some(why), ..self }
    }

    fn finding(&self, run: &Run<P>, why: &str) -> Option<Finding> {
        let name = &*self.quantity.name;
        match Gate::passage(&self.gates, run) {
            Passage::Unmentioned => return None,
            Passage::NotJudged(reason) => return Some(Finding::not_applicable(name, reason)),
            Passage::Judged => {}
        }
        let why = self.why.as_ref().map_or_else(|| why.to_owned(), |why| why(run));
        let found = self.bound.finding(name.to_owned(), (self.quantity.value)(run), run, why);
        Some(self.scale.iter().fold(found, |found, scale| found.of_scale(scale(run))))
    }
}

/// Variable of a set of runs in a study of orders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Over {
    /// The cell size h.
    CellSize,
    /// The time step Δt.
    TimeStep,
}

enum Subject<P> {
    /// Quantities of one run.
    Run(Vec<Demand<P>>),
    /// The observed order of a metric over the runs of each scheme: name, metric, and the formal order.
    Order { name: Of<P, String>, metric: Metric, over: Over, formal: f64 },
    /// A number of two runs, and its demand on the first.
    Pair(Pair<P>, Bound<P>),
    /// Findings of a function of its own, of one run.
    Own(Of<P, Vec<Finding>>),
}

type OfTwo<P, T> = Box<dyn Fn(&Run<P>, &Run<P>) -> T + Send + Sync>;

/// A number of two runs: the partner of the first, and the number by name.
struct Pair<P> {
    partner: OfTwo<P, bool>,
    name: OfTwo<P, String>,
    value: OfTwo<P, f64>,
}

/// A check of a case with the parameters `P`, under construction.
pub(crate) struct CheckOf<P> {
    kind: Kind,
    name: &'static str,
    statement: &'static str,
    gates: Vec<Gate<P>>,
    subject: Subject<P>,
    scale: Option<Of<P, f64>>,
    why: Of<P, String>,
}

impl<P: ParameterSet> CheckOf<P> {
    fn new(kind: Kind, name: &'static str, statement: &'static str) -> Self {
        Self {
            kind,
            name,
            statement,
            gates: Vec::new(),
            subject: Subject::Run(Vec::new()),
            scale: None,
            why: Box::new(|_| String::new()),
        }
    }

    /// Against an exact value, an independent reference or a law of physics.
    pub(crate) fn truth(name: &'static str, statement: &'static str) -> Self {
        Self::new(Kind::Truth, name, statement)
    }

    /// A known limit: the check fails if the limit vanishes.
    pub(crate) fn known_limit(name: &'static str, statement: &'static str) -> Self {
        Self::new(Kind::KnownLimit, name, statement)
    }

    /// A former observation, which no theory demands.
    pub(crate) fn regression(name: &'static str, statement: &'static str) -> Self {
        Self::new(Kind::Regression, name, statement)
    }

    /// A condition that a wrong solution fulfils as well, such as its mass: it makes no run judged.
    pub(crate) fn bookkeeping(name: &'static str, statement: &'static str) -> Self {
        Self::new(Kind::Bookkeeping, name, statement)
    }

    terms!();

    /// |quantity − reference| ≤ tolerance.
    pub(crate) fn within(
        self,
        quantity: impl Into<Quantity<P>>,
        reference: impl Fn(&Run<P>) -> f64 + Held,
        tolerance: impl Fn(&Run<P>) -> f64 + Held,
    ) -> Self {
        self.each([Demand::within(quantity, reference, tolerance)])
    }

    /// quantity ≤ bound; of a pair of runs, the number of the two.
    pub(crate) fn at_most(self, quantity: impl Into<Quantity<P>>, bound: impl Fn(&Run<P>) -> f64 + Held) -> Self {
        self.each([Demand::at_most(quantity, bound)])
    }

    pub(crate) fn above(self, quantity: impl Into<Quantity<P>>, bound: impl Fn(&Run<P>) -> f64 + Held) -> Self {
        self.each([Demand::above(quantity, bound)])
    }

    /// Several quantities.
    pub(crate) fn each(mut self, demands: impl IntoIterator<Item = Demand<P>>) -> Self {
        match &mut self.subject {
            Subject::Run(all) => all.extend(demands),
            _ => self.subject = Subject::Run(demands.into_iter().collect()),
        }
        self
    }

    /// The order of `metric` is at least the `formal` one less [`SLACK`], over the three finest runs of each scheme among those
    /// that pass `when`.
    pub(crate) fn order(self, metric: Metric, over: Over, formal: f64) -> Self {
        let of = match over {
            Over::CellSize => format!("order of {}", metric.name),
            Over::TimeStep => format!("order in Δt of {}", metric.name),
        };
        let name: Of<P, String> = Box::new(move |r| format!("{of} of {}", r.scheme));
        Self { subject: Subject::Order { name, metric, over, formal }, ..self }
    }

    /// The same with another name of the quantity.
    pub(crate) fn named(mut self, named: impl Fn(&Run<P>) -> String + Held) -> Self {
        if let Subject::Order { name, .. } = &mut self.subject {
            *name = Box::new(named);
        }
        self
    }

    /// A number, by name and value, of each run that passes `when` and the first other run that is its `partner`.
    pub(crate) fn pairs(
        self,
        partner: impl Fn(&Run<P>, &Run<P>) -> bool + Held,
        name: impl Fn(&Run<P>, &Run<P>) -> String + Held,
        value: impl Fn(&Run<P>, &Run<P>) -> f64 + Held,
    ) -> PairsOf<P> {
        PairsOf { check: self, pair: Pair { partner: Box::new(partner), name: Box::new(name), value: Box::new(value) } }
    }

    /// Findings of a function on one run, with their sources.
    pub(crate) fn own(self, found: impl Fn(&Run<P>) -> Vec<Finding> + Held) -> Check {
        Self { subject: Subject::Own(Box::new(found)), ..self }.into()
    }

    /// Findings of a function on all runs of the case, with their sources; it selects its runs itself.
    pub(crate) fn study(self, found: impl Fn(&[Record]) -> Vec<Finding> + Held) -> Check {
        Check { name: self.name, kind: self.kind, statement: self.statement, on: On::Study(Box::new(found)) }
    }

    /// The source of reference and tolerance.
    pub(crate) fn because(self, why: &'static str) -> Check {
        self.because_of(move |_| why.to_owned())
    }

    /// The source of reference and tolerance, by run.
    pub(crate) fn because_of(mut self, why: impl Fn(&Run<P>) -> String + Held) -> Check {
        self.why = Box::new(why);
        self.into()
    }

    fn of_run(&self, record: &Record) -> Vec<Finding> {
        let unjudged = |reason: String| {
            let first = match &self.subject {
                Subject::Run(demands) => demands.first().map_or("", |d| &d.quantity.name),
                _ => "",
            };
            vec![Finding::not_applicable(first, reason)]
        };
        let run = match Run::of(record) {
            Ok(run) => run,
            Err(error) => return unjudged(error.to_string()),
        };
        match Gate::passage(&self.gates, &run) {
            Passage::Unmentioned => return Vec::new(),
            Passage::NotJudged(reason) => return unjudged(reason),
            Passage::Judged => {}
        }
        match &self.subject {
            Subject::Own(found) => found(&run),
            Subject::Run(demands) => {
                let why = (self.why)(&run);
                demands.iter().filter_map(|d| d.finding(&run, &why)).map(|f| self.scaled(f, &run)).collect()
            }
            Subject::Order { .. } | Subject::Pair(..) => Vec::new(),
        }
    }

    fn of_study(&self, records: &[Record]) -> Vec<Finding> {
        match &self.subject {
            Subject::Order { name, metric, over, formal } => self.orders(records, (name, *metric), (*over, *formal)),
            Subject::Pair(pair, bound) => self.pair(records, pair, bound),
            Subject::Own(_) | Subject::Run(_) => Vec::new(),
        }
    }

    fn scaled(&self, found: Finding, run: &Run<P>) -> Finding {
        self.scale.iter().fold(found, |found, scale| found.of_scale(scale(run)))
    }

    /// The runs that pass `when`.
    fn runs<'a>(&self, records: &'a [Record]) -> Vec<Run<'a, P>> {
        Run::all(records).filter(|r| matches!(Gate::passage(&self.gates, r), Passage::Judged)).collect()
    }

    fn orders(
        &self,
        records: &[Record],
        (name, metric): (&Of<P, String>, Metric),
        (over, formal): (Over, f64),
    ) -> Vec<Finding> {
        let runs = self.runs(records);
        let mut ladders: BTreeMap<Scheme, Vec<(f64, &Run<P>)>> = BTreeMap::new();
        for run in &runs {
            let at = match over {
                Over::CellSize => run.h,
                Over::TimeStep => run.dt(),
            };
            ladders.entry(run.scheme).or_default().push((at, run));
        }
        let found = ladders.into_values().filter_map(|mut ladder| {
            ladder.sort_by(|a, b| b.0.total_cmp(&a.0));
            let finest = ladder.get(ladder.len().checked_sub(DECIDING)?..)?;
            let points: Vec<_> = finest.iter().map(|(at, r)| (*at, r.metric(metric))).collect();
            let order = fit_order(&points).map_or(f64::NAN, |o| o.order);
            let run = ladder[0].1;
            Some(Finding::above(name(run), order, formal - SLACK, (self.why)(run)))
        });
        found.collect()
    }

    fn pair(&self, records: &[Record], pair: &Pair<P>, bound: &Bound<P>) -> Vec<Finding> {
        let all: Vec<Run<P>> = Run::all(records).collect();
        let found = self.runs(records).into_iter().filter_map(|run| {
            let other = all.iter().find(|other| (pair.partner)(&run, other))?;
            let (name, value, why) = ((pair.name)(&run, other), (pair.value)(&run, other), (self.why)(&run));
            Some(self.scaled(bound.finding(name, value, &run, why), &run))
        });
        found.collect()
    }
}

/// A check on pairs of runs, under construction.
pub(crate) struct PairsOf<P> {
    check: CheckOf<P>,
    pair: Pair<P>,
}

impl<P: ParameterSet> PairsOf<P> {
    fn bound(self, bound: Bound<P>) -> CheckOf<P> {
        CheckOf { subject: Subject::Pair(self.pair, bound), ..self.check }
    }

    /// value ≤ bound of the first run.
    pub(crate) fn at_most(self, bound: impl Fn(&Run<P>) -> f64 + Held) -> CheckOf<P> {
        self.bound(Bound::AtMost(Box::new(bound)))
    }

    /// value > bound of the first run.
    pub(crate) fn above(self, bound: impl Fn(&Run<P>) -> f64 + Held) -> CheckOf<P> {
        self.bound(Bound::Above(Box::new(bound)))
    }

    /// |value − reference| ≤ tolerance, both of the first run.
    pub(crate) fn within(
        self,
        reference: impl Fn(&Run<P>) -> f64 + Held,
        tolerance: impl Fn(&Run<P>) -> f64 + Held,
    ) -> CheckOf<P> {
        let (reference, tolerance) = (Box::new(reference), Box::new(tolerance));
        self.bound(Bound::Within { reference, tolerance })
    }
}

impl<P: ParameterSet> From<CheckOf<P>> for Check {
    fn from(check: CheckOf<P>) -> Self {
        let (kind, name, statement) = (check.kind, check.name, check.statement);
        let on = match check.subject {
            Subject::Run(_) | Subject::Own(_) => On::Run(Box::new(move |record| check.of_run(record))),
            _ => On::Study(Box::new(move |records| check.of_study(records))),
        };
        Self { name, kind, statement, on }
    }
}

/// Whether two runs differ in the parameter `name` only.
pub(crate) fn same_but<P>(name: &str, run: &Run<P>, other: &Run<P>) -> bool {
    let names = [name];
    let [own, others] = [run, other].map(|r| r.record.changed_beside(&names));
    (run.scheme, &run.level) == (other.scheme, &other.level) && own.eq(others)
}

/// Whether two runs differ in their schemes only.
pub(crate) fn same_but_scheme<P>(run: &Run<P>, other: &Run<P>) -> bool {
    run.level == other.level && run.set == other.set
}
