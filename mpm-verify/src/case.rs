//! Definition of a verification case.

use crate::check::Check;
use crate::demand::Held;
use crate::draw::Line;
use crate::error::Error;
use crate::gallery::Gallery;
use crate::job::Job;
use crate::metric::{Metric, Quantity, Sweep};
use crate::parameter::{Parameter, ParameterSet, Parameters};
use crate::problem::Problem;
use crate::record::Record;
use crate::results::{Column, ResultTable, headline};
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::size::Size;
use crate::sketch::Sketch;
use crate::spec::{Level, RunSpec};
use crate::verdict::Verdict;
use crate::wanted::{Wanted, settled};
use std::collections::BTreeSet;
use std::fmt;

/// When a run is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// Within ten seconds.
    Quick,
    /// On every pull request.
    Pr,
    /// Every night.
    Nightly,
    /// By hand: a night's, and what takes days.
    Long,
}

impl Tier {
    /// All, in their order.
    pub const ALL: [Self; 4] = [Self::Quick, Self::Pr, Self::Nightly, Self::Long];
    /// Their names.
    pub const NAMES: [&str; 4] = ["quick", "pr", "nightly", "long"];

    /// By its name.
    ///
    /// # Errors
    /// No tier has that name.
    pub fn parse(name: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|t| t.to_string() == name);
        found.ok_or_else(|| Error::unknown("tier", name, Self::NAMES))
    }
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::NAMES[*self as usize])
    }
}

/// The particle field of a run that is kept among the goldens, as a picture shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldView {
    /// Time of the snapshot (s); without, the particles at the end.
    pub time: Option<f64>,
    /// Column of the values, without its unit.
    pub value: &'static str,
    /// Label of the colour scale.
    pub label: &'static str,
    /// Values at the ends of the colour scale.
    pub range: (f64, f64),
    /// Ranges of x and y that are shown (m).
    pub window: [(f64, f64); 2],
}

impl FieldView {
    /// The particles at the end, by column and label of their values, range of these, and window.
    pub(crate) fn at_end(names: [&'static str; 2], range: (f64, f64), window: [(f64, f64); 2]) -> Option<Self> {
        let [value, label] = names;
        Some(Self { time: None, value, label, range, window })
    }

    /// The same at a `time` (s).
    pub(crate) fn at(time: f64, names: [&'static str; 2], range: (f64, f64), window: [(f64, f64); 2]) -> Option<Self> {
        Self::at_end(names, range, window).map(|view| Self { time: Some(time), ..view })
    }
}

/// Begins a run of a case.
pub type Begin = Box<dyn Fn(&RunSpec, &Parameters) -> Result<Box<dyn Job>, Error> + Send + Sync>;

/// A function of the time (s) since a run began.
pub type Timed<T> = Box<dyn Fn(f64) -> T + Send + Sync>;

/// Title, lines and input that pictures and page of a scene of one's own show beside its particles.
pub struct Scenery {
    /// Time at its end (s).
    pub end: f64,
    /// The axis that points up.
    pub up: usize,
    /// Title of its pictures.
    pub heading: Timed<String>,
    /// Lines around its particles.
    pub around: Timed<Vec<Line>>,
    /// Its file with every key that it could have left out.
    pub filled: String,
}

/// A problem: data, how a run of it begins, and what is checked.
pub struct Case {
    /// Name on the command line.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Description in a few lines.
    pub description: &'static str,
    /// References with their uncertainty.
    pub references: Vec<String>,
    /// Limits: claims that the case does not support.
    pub limits: Vec<&'static str>,
    /// Parameters.
    pub parameters: Vec<Parameter>,
    /// Levels, coarsest first.
    pub levels: Vec<Level>,
    /// Its runs, tier by tier.
    pub plan: Vec<Family>,
    /// Metrics.
    pub metrics: Vec<Metric>,
    /// Checks.
    pub checks: Vec<Check>,
    /// Quantities for which it is run: all have to be right for a run to be right.
    pub wanted: Vec<Wanted>,
    /// Columns of the table of results.
    pub headlines: Vec<Column>,
    /// Quantities whose convergence is studied.
    pub quantities: Vec<Quantity>,
    /// Parameters over whose values the errors are drawn.
    pub sweeps: Vec<Sweep>,
    /// Columns of the time series, without units, that a reader should see first.
    pub watched: &'static [&'static str],
    /// The particle field of its first run that is kept among the goldens.
    pub field: Option<FieldView>,
    /// Title, lines and input of a scene of one's own.
    pub scenery: Option<Scenery>,
    /// The geometry.
    pub sketch: Sketch,
    /// Relative cost of a run, to start the longest first.
    pub cost: Box<dyn Fn(&RunSpec) -> f64 + Send + Sync>,
    /// The parameters, as `name=value`, at which schemes are run at the most levels: those of its convergence and
    /// trends.
    pub ladder: &'static [&'static str],
    /// The runs at its own parameters and what stands in for them, one for each scheme and level: those of
    /// its convergence.
    pub own_runs: fn(&[Record]) -> Vec<&Record>,
    /// Size of its runs, where it is known before one begins.
    pub size: Option<Size>,
    /// Begins a run.
    pub begin: Begin,
    /// Draws what only this case has.
    pub pictures: fn(&mut Gallery) -> Result<(), Error>,
    /// Tables of its results that pages show.
    pub tables: Vec<ResultTable>,
    /// Why a run of this kind is known to break down before its end, if it is.
    pub breaks_down: fn(&Record) -> Option<&'static str>,
}

/// Functions that set a field each, by field and type.
macro_rules! setters {
    ($($(#[$doc:meta])* $field:ident: $kind:ty;)*) => {
        $($(#[$doc])*
        pub(crate) fn $field(self, $field: $kind) -> Self {
            Self { $field, ..self }
        })*
    };
}

impl Case {
    /// A case of the problem `P` in `D` dimensions, by name, title and metrics, with nothing else.
    pub(crate) fn of<const D: usize, P: Problem<D> + 'static>(
        name: &'static str,
        title: &'static str,
        metrics: &[Metric],
    ) -> Self
    where
        P::Parameters: ParameterSet,
    {
        let begin = Box::new(crate::problem::begin::<D, P>);
        Self {
            cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-(D as i32) - 1)),
            ..Self::begun_by(name, title, metrics, P::Parameters::list(), begin)
        }
    }

    /// A case by name, title, metrics, parameters and the beginning of a run, with nothing else.
    pub(crate) fn begun_by(
        name: &'static str,
        title: &'static str,
        metrics: &[Metric],
        parameters: Vec<Parameter>,
        begin: Begin,
    ) -> Self {
        Self {
            name,
            title,
            description: "",
            references: Vec::new(),
            limits: Vec::new(),
            parameters,
            levels: Vec::new(),
            plan: Vec::new(),
            metrics: metrics.to_vec(),
            checks: Vec::new(),
            wanted: Vec::new(),
            headlines: Vec::new(),
            quantities: Vec::new(),
            sweeps: Vec::new(),
            watched: &[],
            field: None,
            scenery: None,
            sketch: Sketch::default(),
            cost: Box::new(|_| 1.0),
            ladder: &[],
            own_runs: crate::record::of_defaults,
            size: None,
            begin,
            pictures: |_| Ok(()),
            tables: Vec::new(),
            breaks_down: |_| None,
        }
    }

    /// With the levels and the runs of a plan.
    pub(crate) fn planned(self, plan: Plan) -> Self {
        Self { levels: plan.levels, plan: plan.families, ..self }
    }

    /// With a description in a few lines.
    pub(crate) fn described(self, description: &'static str) -> Self {
        Self { description, ..self }
    }

    /// Adds a reference with its uncertainty.
    pub(crate) fn reference(mut self, reference: &str) -> Self {
        self.references.push(reference.to_owned());
        self
    }

    /// Adds a limit: a claim that the case does not support.
    pub(crate) fn limit(mut self, limit: &'static str) -> Self {
        self.limits.push(limit);
        self
    }

    /// Adds a quantity for which the case is run: see [`Wanted::new`].
    pub(crate) fn wanted(mut self, name: &'static str, title: &'static str, checks: &'static str) -> Self {
        self.wanted.push(Wanted::new(name, title, checks));
        self
    }

    /// Changes the wanted quantity that was added last.
    fn rewanted(mut self, change: impl FnOnce(Wanted) -> Wanted) -> Self {
        let last = self.wanted.pop().map(change);
        self.wanted.extend(last);
        self
    }

    /// The wanted quantity that was added last is missed by these limits: see [`Wanted::missed_by`].
    pub(crate) fn missed_by(self, limits: &'static str) -> Self {
        self.rewanted(|wanted| wanted.missed_by(limits))
    }

    /// The same quantity is judged where these checks are: see [`Wanted::firmly_by`].
    pub(crate) fn firmly_by(self, checks: &'static str) -> Self {
        self.rewanted(|wanted| wanted.firmly_by(checks))
    }

    /// The same quantity may have no reference: see [`Wanted::where_referenced`].
    pub(crate) fn where_referenced(self) -> Self {
        self.rewanted(Wanted::where_referenced)
    }

    /// Without the wanted quantities, the headlines and the studied quantities so far.
    pub(crate) fn anew(self) -> Self {
        Self { wanted: Vec::new(), headlines: Vec::new(), quantities: Vec::new(), ..self }
    }

    /// Adds a column of the table of results: see [`headline`].
    pub(crate) fn headline(mut self, metric: Metric, title: &str, factor: f64, decimals: usize) -> Self {
        self.headlines.push(headline(metric, title, factor, decimals));
        self
    }

    /// Adds a quantity whose convergence is studied.
    pub(crate) fn quantity(mut self, quantity: Quantity) -> Self {
        self.quantities.push(quantity);
        self
    }

    /// Adds a parameter over whose values the errors are drawn.
    pub(crate) fn sweep(mut self, sweep: Sweep) -> Self {
        self.sweeps.push(sweep);
        self
    }

    /// With the relative cost of a run.
    pub(crate) fn cost(self, cost: impl Fn(&RunSpec) -> f64 + Held) -> Self {
        Self { cost: Box::new(cost), ..self }
    }

    /// With another beginning of a run.
    pub(crate) fn begun(self, begin: impl Fn(&RunSpec, &Parameters) -> Result<Box<dyn Job>, Error> + Held) -> Self {
        Self { begin: Box::new(begin), ..self }
    }

    /// Adds checks.
    pub(crate) fn checks(mut self, checks: impl IntoIterator<Item = Check>) -> Self {
        self.checks.extend(checks);
        self
    }

    /// Adds a table of its results.
    pub(crate) fn table(mut self, table: ResultTable) -> Self {
        self.tables.push(table);
        self
    }

    setters! {
        /// Replaces all references.
        references: Vec<String>;
        /// With other metrics.
        metrics: Vec<Metric>;
        /// Replaces all columns of the table of results.
        headlines: Vec<Column>;
        /// Replaces all quantities whose convergence is studied.
        quantities: Vec<Quantity>;
        /// With these columns of the time series for a first look.
        watched: &'static [&'static str];
        /// With a particle field that is kept among the goldens.
        field: Option<FieldView>;
        /// With a sketch of the geometry.
        sketch: Sketch;
        /// With the parameters at which schemes are run at the most levels.
        ladder: &'static [&'static str];
        /// With the runs that stand for its own: see [`Case::own_runs`].
        own_runs: fn(&[Record]) -> Vec<&Record>;
        /// With pictures of its own.
        pictures: fn(&mut Gallery) -> Result<(), Error>;
        /// With tables of its results.
        tables: Vec<ResultTable>;
        /// With reasons why a run is known to break down before its end.
        breaks_down: fn(&Record) -> Option<&'static str>;
    }

    /// Verdicts on a run that has come to its end, those on its wanted quantities first.
    pub(crate) fn judge(&self, record: &Record) -> Vec<Verdict> {
        let verdicts = self.verdicts(record).into_iter();
        let verdicts = match self.plans(record) {
            true => verdicts.collect(),
            false => verdicts.map(Verdict::unplanned).collect(),
        };
        settled(&self.wanted, verdicts)
    }

    /// Whether a run is among those of its plan, for which its known limits were established.
    pub(crate) fn plans(&self, record: &Record) -> bool {
        let has = |f: &Family| {
            let level = f.levels.iter().any(|l| l.name == record.level);
            level && f.set == record.set && f.schemes.contains(&record.scheme())
        };
        self.plan.iter().any(has)
    }

    /// Verdicts of all checks on a run that has come to its end.
    pub(crate) fn verdicts(&self, record: &Record) -> Vec<Verdict> {
        self.checks.iter().flat_map(|c| c.of_run(record)).collect()
    }

    /// Verdicts on the runs of the case together.
    #[must_use]
    pub fn judge_study(&self, records: &[Record]) -> Vec<Verdict> {
        self.checks.iter().flat_map(|c| c.of_study(records)).collect()
    }

    /// The schemes that it compares, each once: those of its plan, by transfer, basis and remedy.
    #[must_use]
    pub fn schemes(&self) -> Vec<Scheme> {
        let mut schemes = crate::distinct(self.plan.iter().flat_map(|f| f.schemes.clone()));
        schemes.sort_by_key(|s| (s.transfer(), s.basis(), s.remedy()));
        schemes
    }

    /// The scheme whose parts stand for those that are not asked for, of a kind of solver or any: of the explicit one
    /// always the same; of another the first in the plan.
    #[must_use]
    pub fn default_scheme(&self, solver: Option<&str>) -> Scheme {
        let explicit = Scheme::flip(BasisName::Gimp, RemedyName::FbarConsistent);
        let mut schemes = self.plan.iter().flat_map(|f| &f.schemes);
        match schemes.find(|s| solver.is_none_or(|name| s.solver() == name)) {
            Some(scheme) if scheme.solver() != explicit.solver() => *scheme,
            _ => explicit,
        }
    }

    /// The runs of a tier, each once: a tier has those of the ones below it.
    #[must_use]
    pub fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut seen = BTreeSet::new();
        let mut runs: Vec<RunSpec> = self.plan.iter().filter(|f| f.tier <= tier).flat_map(Family::runs).collect();
        runs.retain(|spec| seen.insert(spec.folder()));
        runs
    }
}

/// Runs of some schemes at some levels, with the same parameters changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// The least tier that has them.
    pub(crate) tier: Tier,
    pub(crate) levels: Vec<Level>,
    pub(crate) schemes: Vec<Scheme>,
    /// Parameters changed from the defaults, as `name=value`.
    pub(crate) set: Vec<String>,
}

/// The plan of a case, in words.
pub(crate) struct Plan {
    levels: Vec<Level>,
    families: Vec<Family>,
}

impl Plan {
    /// An empty plan over `levels`.
    pub(crate) fn of(levels: impl IntoIterator<Item = Level>) -> Self {
        Self { levels: levels.into_iter().collect(), families: Vec::new() }
    }

    /// Adds runs of `schemes` at the levels of these names, apart by spaces, with the parameters `set`, as `name=value` apart by
    /// spaces, from the tier `tier` on.
    pub(crate) fn runs(mut self, tier: Tier, levels: &str, schemes: &[Scheme], set: &str) -> Self {
        // The plan's test finds a level that the case does not have.
        let unknown = Level { name: "unknown", h: f64::NAN };
        let levels = levels.split_whitespace().map(|name| self.levels.iter().find(|l| l.name == name));
        self.families.push(Family {
            tier,
            levels: levels.map(|l| l.copied().unwrap_or(unknown)).collect(),
            schemes: schemes.to_vec(),
            set: set.split_whitespace().map(str::to_owned).collect(),
        });
        self
    }

    /// Adds runs for each of `sets` by itself: see [`Plan::runs`].
    pub(crate) fn each<S: AsRef<str>>(
        self,
        tier: Tier,
        levels: &str,
        schemes: &[Scheme],
        sets: impl IntoIterator<Item = S>,
    ) -> Self {
        sets.into_iter().fold(self, |plan, set| plan.runs(tier, levels, schemes, set.as_ref()))
    }
}

impl Family {
    fn runs(&self) -> impl Iterator<Item = RunSpec> {
        let pairs = self.levels.iter().flat_map(|&level| self.schemes.iter().map(move |&scheme| (level, scheme)));
        pairs.map(|(level, scheme)| RunSpec { scheme, level, set: self.set.clone(), perturbed: false })
    }
}

/// Finds a level of a case by name.
///
/// # Errors
/// No level of this name; the error lists those there are.
pub fn find_level(case: &Case, name: &str) -> Result<Level, Error> {
    let levels = &case.levels;
    levels
        .iter()
        .find(|l| l.name == name)
        .copied()
        .ok_or_else(|| Error::unknown("level", name, levels.iter().map(|l| l.name)))
}
