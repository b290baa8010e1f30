//! Results of other codes: the columns they supply, and the metrics computed from them with our own functions.

use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::{ParameterSet, Parameters};
use crate::problem::Problem;
use crate::record::Discretisation;
use crate::scheme::{BasisName, RemedyName, Scheme};
use crate::setup::Setup;
use crate::spec::RunSpec;
use crate::table::Table;
use mpm_core::Particles;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Most particles of another code over ours, which have two along each axis of a cell: more are those of smaller cells.
const MOST_OF_OURS: f64 = 4.0;
/// Most rows of a table.
pub(crate) const MOST_ROWS: usize = 5_000_000;

/// The table that a column stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A row a particle, at the end.
    Particles,
    /// A row a time.
    Series,
}

impl Part {
    /// Its key in a manifest.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Particles => "particles",
            Self::Series => "series",
        }
    }
}

/// A column that a code may give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Asked {
    pub part: Part,
    /// Name, as our runs have it.
    pub name: &'static str,
    pub unit: &'static str,
    /// Meaning, for the form to fill in.
    pub meaning: &'static str,
}

impl Asked {
    /// A column of the particles.
    pub(crate) const fn particle(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        Self { part: Part::Particles, name, unit, meaning }
    }

    /// A column of the series.
    pub(crate) const fn series(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        Self { part: Part::Series, ..Self::particle(name, unit, meaning) }
    }

    /// As it stands at the head of a table.
    pub fn header(&self) -> String {
        format!("{} ({})", self.name, self.unit)
    }

    /// Its head and table.
    pub(crate) fn place(&self) -> String {
        format!("{} of the {}", self.header(), self.part.name())
    }

    /// Whether a head names it, if its case, blanks, brackets, marks and unit are left out of account.
    fn is_meant_by(&self, head: &str) -> bool {
        let name = head.split(['(', '[', '{', '<']).find(|part| !letters(part).is_empty());
        let [whole, name] = [head, name.unwrap_or_default()].map(letters);
        [letters(self.name), letters(&self.header())].iter().any(|own| *own == whole || *own == name)
    }
}

/// Columns that several cases ask for: where a particle of a plane starts, its pressure, times and energies.
pub(crate) const START_X: Asked = Asked::particle("reference_x", "m", "x before anything moves");
pub(crate) const START_Y: Asked = Asked::particle("reference_y", "m", "y before anything moves");
pub(crate) const MEAN_STRESS: Asked =
    Asked::particle("mean_stress", "Pa", "mean normal stress at the end, (σ_xx + σ_yy + σ_zz)/3, tension positive");
pub(crate) const KINETIC: Asked = Asked::series("kinetic_energy", "J/m", "kinetic energy");
pub(crate) const STRESS_WORK: Asked =
    Asked::series("stress_work", "J/m", "work of the stress on the body since the start: what it stores and loses");
pub(crate) const POTENTIAL: Asked = Asked::series("potential_energy", "J/m", "Σ m g y, zero at the floor");

/// Letters and digits of a head.
fn letters(head: &str) -> String {
    head.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Metrics of a result.
pub(crate) type Measured = Result<Vec<(Metric, f64)>, Error>;

/// A value between rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Between {
    /// The value of the parabolas through the nearest rows.
    pub value: f64,
    /// Their largest distance from the straight line: a bound of the error.
    pub error: f64,
}

/// A metric that the rows of a series leave open.
#[derive(Debug, Clone, PartialEq)]
pub enum Gap {
    /// They do not show it, and why.
    Unknown(String),
    /// It is off by at most this for what lies between them.
    Error(f64),
    /// It is this value between them, off by at most an error.
    Between(Between),
}

impl Gap {
    /// The value of a metric that was measured from the rows alone as `own`.
    pub fn value(&self, own: Option<f64>) -> Option<f64> {
        match self {
            Self::Unknown(_) => None,
            Self::Error(_) => own,
            Self::Between(between) => own.map(|_| between.value),
        }
    }

    /// Why a verdict can't be given, if it can't.
    pub fn refusal(&self, tolerance: Option<f64>) -> Option<String> {
        match (self, tolerance) {
            (Self::Unknown(why), _) => Some(why.clone()),
            (Self::Error(error) | Self::Between(Between { error, .. }), Some(allowed))
                if error.is_nan() || *error > allowed =>
            {
                Some(format!(
                    "taken between rows with an error of up to {error:.2e}, where {allowed:.2e} is allowed: closer rows show it"
                ))
            }
            _ => None,
        }
    }
}

/// Metrics that the rows of a series leave open.
pub(crate) type Gaps = Result<Vec<(Metric, Gap)>, Error>;

/// Metrics, and the columns that all of them are measured from.
pub struct Group {
    pub columns: &'static [Asked],
    pub metrics: Vec<Metric>,
    pub measure: fn(&Given) -> Measured,
}

impl Group {
    /// Metrics that `measure` takes from these columns.
    pub(crate) fn new(
        columns: &'static [Asked],
        metrics: impl IntoIterator<Item = Metric>,
        measure: fn(&Given) -> Measured,
    ) -> Self {
        Self { columns, metrics: metrics.into_iter().collect(), measure }
    }
}

/// A curve of a reference, to be compared with: the name of its file, and its columns with their units.
pub(crate) type Curve = (&'static str, Vec<(String, Vec<f64>)>);

/// How another code is scored by a case.
pub struct Foreign {
    /// The scheme that a code with these functions is judged as: one whose results are to be right.
    pub judged_as: fn(BasisName) -> Scheme,
    /// Discretisation of a run of ours.
    pub discretisation: fn(&RunSpec, &Parameters) -> Result<Discretisation, Error>,
    /// Groups of metrics, each with the columns it needs.
    pub groups: Vec<Group>,
    /// The column by which the rows of the series are ordered, if there is one.
    pub abscissa: Option<Asked>,
    /// Metrics that the rows leave open.
    pub gaps: fn(&Given) -> Gaps,
    /// The particles before anything moves.
    pub start: fn(&RunSpec, &Parameters) -> Result<Vec<Column>, Error>,
    /// Curves of the reference.
    pub curves: fn(&Parameters) -> Vec<Curve>,
    /// Checks by the discrete equations of our schemes, which are no demand on another code.
    pub own_checks: &'static [&'static str],
}

impl Foreign {
    /// That of the problem `P` in `D` dimensions, with these groups. A code is judged as quadratic splines with `fbar-consistent`,
    /// and its rows leave nothing open.
    pub(crate) fn of<const D: usize, P: Problem<D>>(groups: Vec<Group>) -> Self
    where
        P::Parameters: ParameterSet,
    {
        Self {
            judged_as: |_| Scheme::flip(BasisName::Bspline2, RemedyName::FbarConsistent),
            discretisation: |spec, parameters| Ok(P::new(Setup::of_spec(spec, parameters)?)?.discretisation()),
            groups,
            abscissa: None,
            gaps: |_| Ok(Vec::new()),
            start: |spec, parameters| {
                let problem = P::new(Setup::of_spec(spec, parameters)?)?;
                Ok(start_columns(problem.begin(&problem.unseen())?.particles()))
            },
            curves: |_| Vec::new(),
            own_checks: &[],
        }
    }

    /// The columns, each once.
    pub fn columns(&self) -> Vec<Asked> {
        crate::distinct(self.groups.iter().flat_map(|g| g.columns).copied())
    }

    /// Whether a check of the case judges another code.
    pub(crate) fn asks(&self, check: &str) -> bool {
        !self.own_checks.contains(&check)
    }

    /// Its tables.
    pub fn parts(&self) -> Vec<Part> {
        crate::distinct(self.columns().iter().map(|c| c.part))
    }
}

/// The particles of a body before anything moves, as another code needs them: places, masses, volumes, and the volume ratio
/// where there is one.
pub(crate) fn start_columns<const D: usize>(particles: &Particles<D>) -> Vec<Column> {
    const AXES: [[&str; 3]; 2] = [["reference_x", "reference_y", "reference_z"], ["x", "y", "z"]];
    const UNITS: [[&str; 2]; 3] = [["kg/m²", "m"], ["kg/m", "m²"], ["kg", "m³"]];
    let column = |name, unit, of: &dyn Fn(usize) -> f64| Column { name, unit, values: particles.seeded(of) };
    let of_places = AXES
        .iter()
        .zip([&particles.reference, &particles.position])
        .flat_map(|(names, places)| (0..D).map(move |a| column(names[a], "m", &|k| places[k][a])));
    let mut columns: Vec<Column> = of_places.collect();
    let [mass, volume] = UNITS[D - 1];
    columns.push(column("mass", mass, &|k| particles.mass[k]));
    columns.push(column("reference_volume", volume, &|k| particles.reference_volume[k]));
    if particles.jacobian.iter().any(|j| *j != 1.0) {
        columns.push(column("jacobian", "-", &|k| particles.jacobian[k]));
    }
    columns
}

/// Columns that a code supplies of one run.
pub struct Given {
    /// The run that it is compared with: scheme, level, parameters that are changed.
    pub spec: RunSpec,
    /// All parameters.
    pub parameters: Parameters,
    pub discretisation: Discretisation,
    /// Steps, if they are known.
    pub steps: Option<u64>,
    pub tables: Vec<(Part, PathBuf, Table)>,
}

impl Given {
    /// The setup of the run that it is compared with.
    pub(crate) fn setup<P: ParameterSet>(&self) -> Result<Setup<P>, Error> {
        Setup::of_spec(&self.spec, &self.parameters)
    }

    /// A column; empty if it is not there.
    pub(crate) fn column(&self, asked: &Asked) -> &[f64] {
        let table = self.tables.iter().find(|(part, ..)| *part == asked.part);
        table.and_then(|(.., table)| table.get(&asked.header())).unwrap_or_default()
    }

    /// The value of a column in a row; zero if it is not there: no group takes what is measured of that.
    pub(crate) fn value(&self, asked: &Asked, row: usize) -> f64 {
        self.column(asked).get(row).copied().unwrap_or_default()
    }

    /// Whether a column is there.
    pub fn has(&self, asked: &Asked) -> bool {
        !self.column(asked).is_empty()
    }

    /// Rows of a table.
    pub fn rows(&self, part: Part) -> usize {
        let table = self.tables.iter().find(|(of, ..)| *of == part);
        table.map_or(0, |(.., table)| table.rows())
    }

    /// Checks that the rows of the series, which stand in these lines of its file, rise along their abscissa.
    pub(crate) fn require_order(&self, abscissa: &Asked, lines: &[u64]) -> Result<(), Error> {
        let column = self.column(abscissa);
        let Some(row) = column.windows(2).position(|pair| pair[1] <= pair[0]) else { return Ok(()) };
        let path = self.tables.iter().find(|(of, ..)| *of == abscissa.part);
        let path = path.map_or(Path::new("series"), |(_, path, _)| path);
        let said = format!(
            "line {}: {} {} after {}; allowed: rows in rising order",
            lines.get(row + 1).copied().unwrap_or_default(),
            abscissa.header(),
            column[row + 1],
            column[row]
        );
        Err(Error::file(path, said))
    }

    /// Checks the places at which particles of a plane start: each of ours has one within a cell and each of theirs has one of
    /// ours, and their number is that of cells of the level.
    ///
    /// # Errors
    /// A place that has none, a particle elsewhere, or more than [`MOST_OF_OURS`] times ours.
    pub(crate) fn require_whole_body(&self, start: impl Fn() -> Result<Vec<Column>, Error>) -> Result<(), Error> {
        let (h, given) = (self.discretisation.h, self.points([&START_X, &START_Y]));
        let table = self.tables.iter().find(|(part, ..)| *part == Part::Particles);
        let Some((_, path, _)) = table.filter(|_| !given.is_empty()) else { return Ok(()) };
        let start = start()?;
        let of = |name: &str| start.iter().find(|c| c.name == name).map_or(&[][..], |c| &c.values);
        let ours: Vec<[f64; 2]> = of("reference_x").iter().zip(of("reference_y")).map(|(x, y)| [*x, *y]).collect();
        let cell = |x: &[f64; 2]| x.map(|x| (x / h).floor() as i64);
        let alone = |from: &[[f64; 2]], to: &[[f64; 2]]| {
            let mut cells = HashMap::<[i64; 2], Vec<[f64; 2]>>::new();
            to.iter().for_each(|x| cells.entry(cell(x)).or_default().push(*x));
            let near = |x: &[f64; 2]| {
                let [i, j] = cell(x);
                let around = (-1..2).flat_map(|a| (-1..2).map(move |b| [i + a, j + b]));
                let mut others = around.filter_map(|place| cells.get(&place)).flatten();
                others.any(|y| (x[0] - y[0]).abs().max((x[1] - y[1]).abs()) <= h)
            };
            from.iter().find(|x| !near(x)).copied()
        };
        let refused = |said: String| Err(Error::file(path, said));
        if let Some([x, y]) = alone(&ours, &given) {
            return refused(format!(
                "no particle starts within a cell ({h} m) of ({x}, {y}) m; allowed: all of the body"
            ));
        }
        if let Some([x, y]) = alone(&given, &ours) {
            return refused(format!("a particle starts at ({x}, {y}) m, where no body is within a cell ({h} m)"));
        }
        let most = (ours.len() as f64 * MOST_OF_OURS) as usize;
        match given.len() <= most {
            true => Ok(()),
            false => refused(format!("{} particles; allowed: up to {most} on cells of {h} m", given.len())),
        }
    }

    /// Two columns as points.
    pub(crate) fn points(&self, [x, y]: [&Asked; 2]) -> Vec<[f64; 2]> {
        self.column(x).iter().zip(self.column(y).iter()).map(|(x, y)| [*x, *y]).collect()
    }

    /// The places in the table of the particles that start at `seeded` (m), where parts of the size `spacing` (m) along
    /// the axes have one each.
    pub(crate) fn in_order(&self, start: [&Asked; 2], seeded: &[[f64; 2]], spacing: f64) -> Result<Vec<usize>, Error> {
        let part = |x: &[f64; 2]| x.map(|x| (x / spacing).floor() as i64);
        let given = self.points(start);
        let places: HashMap<[i64; 2], usize> = given.iter().map(part).zip(0..).collect();
        let refused = |cause: String| {
            let table = self.tables.iter().find(|(of, ..)| *of == start[0].part);
            let path = table.map_or(Path::new("particles"), |(_, path, _)| path);
            Err(Error::file(path, cause))
        };
        if given.len() != seeded.len() {
            let said =
                format!("{} particles where {} start: those of `export`, in any order", given.len(), seeded.len());
            return refused(said);
        }
        let mut order = Vec::with_capacity(seeded.len());
        for x in seeded {
            match places.get(&part(x)) {
                Some(place) => order.push(*place),
                None => {
                    return refused(format!("no particle starts at ({}, {}) m: see `export`", x[0], x[1]));
                }
            }
        }
        Ok(order)
    }

    /// Checks the heads of the tables against the columns that a case asks for: those that it does not know.
    ///
    /// # Errors
    /// A table has no row, or too many, or a column in another unit, or one whose head misses a name that is asked for by
    /// case, blanks, brackets or marks.
    pub fn require_heads(&self, asked: &[Asked]) -> Result<Vec<String>, Error> {
        let mut unknown = Vec::new();
        for (part, path, table) in &self.tables {
            if table.rows() == 0 || table.rows() > MOST_ROWS {
                let rows = table.rows();
                return Err(Error::file(path, format!("{rows} rows where 1 to {MOST_ROWS} are allowed")));
            }
            for (head, _) in table.iter() {
                match asked.iter().find(|a| a.part == *part && a.is_meant_by(head)) {
                    Some(own) if own.header() != head => {
                        let said = format!("column \"{head}\"; allowed: \"{}\"", own.header());
                        return Err(Error::file(path, said));
                    }
                    Some(_) => {}
                    None => unknown.push(head.to_owned()),
                }
            }
        }
        Ok(unknown)
    }
}

#[cfg(test)]
mod tests;
