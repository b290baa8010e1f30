//! Results of other codes: the columns they supply, and the metrics computed from them with our own functions.

use crate::error::Error;
use crate::job::Column;
use crate::metric::Metric;
use crate::parameter::{ParameterSet, Parameters};
use crate::record::Discretisation;
use crate::scheme::{BasisName, Scheme};
use crate::setup::Setup;
use crate::spec::RunSpec;
use crate::table::Table;
use std::path::{Path, PathBuf};

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
    #[must_use]
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
    /// Where it stands.
    pub part: Part,
    /// Name, as our runs have it.
    pub name: &'static str,
    /// Unit.
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
    #[must_use]
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

/// Where a particle of a plane starts.
pub(crate) const START_X: Asked = Asked::particle("reference_x", "m", "x before anything moves");
pub(crate) const START_Y: Asked = Asked::particle("reference_y", "m", "y before anything moves");

/// Letters and digits of a head.
fn letters(head: &str) -> String {
    head.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Metrics of a result.
pub type Measured = Result<Vec<(Metric, f64)>, Error>;

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
    #[must_use]
    pub fn value(&self, own: Option<f64>) -> Option<f64> {
        match self {
            Self::Unknown(_) => None,
            Self::Error(_) => own,
            Self::Between(between) => own.map(|_| between.value),
        }
    }

    /// Why a verdict can't be given, if it can't.
    #[must_use]
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
pub type Gaps = Result<Vec<(Metric, Gap)>, Error>;

/// Metrics, and the columns that all of them are measured from.
pub struct Group {
    /// The columns.
    pub columns: &'static [Asked],
    /// The metrics.
    pub metrics: Vec<Metric>,
    /// Measures them.
    pub measure: fn(&Given) -> Measured,
}

/// A curve of a reference, to be compared with: the name of its file, and its columns with their units.
pub type Curve = (&'static str, Vec<(String, Vec<f64>)>);

/// How another code is scored by a case.
pub struct Foreign {
    /// The scheme that a code with these functions is judged as: one whose results are to be right.
    pub judged_as: fn(BasisName) -> Scheme,
    /// Discretisation as far as it is known, given the time step (s).
    pub discretisation: fn(&RunSpec, &Parameters, f64) -> Discretisation,
    /// Groups of metrics, each with the columns it needs.
    pub groups: Vec<Group>,
    /// The column by which the rows of the series are ordered, if there is one.
    pub abscissa: Option<Asked>,
    /// Metrics that the rows leave open.
    pub gaps: fn(&Given) -> Gaps,
    /// The particles before anything moves.
    pub start: fn(&RunSpec, &Parameters) -> Result<Vec<Column>, Error>,
    /// The problem in words: body, supports, loads, end.
    pub setup: &'static [&'static str],
    /// Curves of the reference.
    pub curves: fn(&Parameters) -> Vec<Curve>,
}

impl Foreign {
    /// The columns, each once.
    #[must_use]
    pub fn columns(&self) -> Vec<Asked> {
        crate::distinct(self.groups.iter().flat_map(|g| g.columns).copied())
    }

    /// Its tables.
    #[must_use]
    pub fn parts(&self) -> Vec<Part> {
        crate::distinct(self.columns().iter().map(|c| c.part))
    }
}

/// Columns that a code supplies of one run.
pub struct Given {
    /// The run that it is compared with: scheme, level, parameters that are changed.
    pub spec: RunSpec,
    /// All parameters.
    pub parameters: Parameters,
    /// The discretisation.
    pub discretisation: Discretisation,
    /// The tables.
    pub tables: Vec<(Part, PathBuf, Table)>,
}

impl Given {
    /// The setup of the run that it is compared with.
    ///
    /// # Errors
    /// A parameter of another type.
    pub(crate) fn setup<P: ParameterSet>(&self) -> Result<Setup<P>, Error> {
        Setup::of_spec(&self.spec, &self.parameters)
    }

    /// A column; empty if it is not there.
    pub(crate) fn column(&self, asked: &Asked) -> &[f64] {
        let table = self.tables.iter().find(|(part, ..)| *part == asked.part);
        let column = table.and_then(|(.., table)| table.get(&asked.header()));
        column.unwrap_or_default()
    }

    /// Whether a column is there.
    #[must_use]
    pub fn has(&self, asked: &Asked) -> bool {
        !self.column(asked).is_empty()
    }

    /// Rows of a table.
    #[must_use]
    pub fn rows(&self, part: Part) -> usize {
        let table = self.tables.iter().find(|(of, ..)| *of == part);
        table.map_or(0, |(.., table)| table.rows())
    }

    /// Checks that the rows of the series, which stand in these lines of its file, rise along their abscissa.
    ///
    /// # Errors
    /// A row does not: the error names its line.
    pub(crate) fn require_order(&self, abscissa: &Asked, lines: &[u64]) -> Result<(), Error> {
        let column = self.column(abscissa);
        let Some(row) = column.windows(2).position(|pair| pair[1] <= pair[0]) else {
            return Ok(());
        };
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

    /// Two columns as points.
    pub(crate) fn points(&self, [x, y]: [&Asked; 2]) -> Vec<[f64; 2]> {
        let ys = self.column(y).iter();
        let both = self.column(x).iter().zip(ys);
        both.map(|(x, y)| [*x, *y]).collect()
    }

    /// The places in the table of the particles that start at `seeded` (m), where parts of the size `spacing` (m) along
    /// the axes have one each.
    ///
    /// # Errors
    /// Others start, or in other places.
    pub(crate) fn in_order(&self, start: [&Asked; 2], seeded: &[[f64; 2]], spacing: f64) -> Result<Vec<usize>, Error> {
        let part = |x: &[f64; 2]| x.map(|x| (x / spacing).floor() as i64);
        let given = self.points(start);
        let places: std::collections::HashMap<[i64; 2], usize> = given.iter().map(part).zip(0..).collect();
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
                    let said = format!("no particle starts at ({}, {}) m: see `export`", x[0], x[1]);
                    return refused(said);
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
                let said = format!("{rows} rows where 1 to {MOST_ROWS} are allowed");
                return Err(Error::file(path, said));
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
mod tests {
    use super::*;
    use crate::case::Tier;
    use crate::cases;

    const X: Asked = Asked::particle("x0", "m", "");
    const Y: Asked = Asked::particle("y0", "m", "");
    const TIME: Asked = Asked::series("time", "s", "");
    const FORCE: Asked = Asked::series("force", "N", "");

    /// Two particles, and a series of three rows, with these heads.
    fn given(heads: [&str; 2]) -> Given {
        let case = cases::find("cook").unwrap();
        let spec = case.runs(Tier::Pr).remove(0);
        let column = |head: &str, values: &[f64]| (head.to_owned(), values.to_vec());
        let particles = vec![column("x0 (m)", &[0.75, 0.25]), column("y0 (m)", &[0.25, -0.25])];
        let series = vec![column(heads[0], &[0.0, 1.0, 2.0]), column(heads[1], &[0.0, 3.0, 5.0])];
        let tables = [(Part::Particles, particles), (Part::Series, series)];
        let table = |(part, columns): (Part, _)| {
            let path = PathBuf::from(part.name()).with_extension("csv");
            (part, path, Table::of_columns(columns))
        };
        Given {
            parameters: Parameters::new(&case.parameters, &[]).unwrap(),
            discretisation: Discretisation { dim: 2, h: spec.level.h, ppc: 4, dt: 1.0, wall: String::new() },
            spec,
            tables: tables.map(table).into(),
        }
    }

    #[test]
    fn columns_are_those_of_their_own_table() {
        let given = given(["time (s)", "force (kN)"]);
        assert_eq!(given.column(&X), [0.75, 0.25]);
        assert_eq!(given.column(&TIME), [0.0, 1.0, 2.0]);
        let elsewhere = Asked { part: Part::Series, ..X };
        for missing in [elsewhere, FORCE] {
            assert!(!given.has(&missing) && given.column(&missing).is_empty());
        }
        assert!(given.has(&X) && given.has(&TIME));
        assert_eq!([Part::Particles, Part::Series].map(|p| given.rows(p)), [2, 3]);
        assert_eq!(given.points([&X, &Y]), [[0.75, 0.25], [0.25, -0.25]]);
        let none = Given { tables: Vec::new(), ..given };
        assert_eq!(none.rows(Part::Series), 0);
    }

    #[test]
    fn columns_and_tables_are_asked_for_once() {
        fn nothing(_: &Given) -> Measured {
            Ok(Vec::new())
        }
        let group = |columns| Group { columns, metrics: Vec::new(), measure: nothing };
        let (_, own) = cases::find_scored("cook").unwrap();
        let foreign = Foreign {
            groups: vec![group(&[X, TIME]), group(&[X, Y, FORCE])],
            judged_as: own.judged_as,
            discretisation: own.discretisation,
            abscissa: None,
            gaps: own.gaps,
            start: own.start,
            setup: own.setup,
            curves: own.curves,
        };
        assert_eq!(foreign.columns(), [X, TIME, Y, FORCE]);
        assert_eq!(foreign.parts(), [Part::Particles, Part::Series]);
        let names: Vec<&str> = foreign.parts().into_iter().map(Part::name).collect();
        assert_eq!(names, ["particles", "series"]);
    }

    #[test]
    fn particles_are_known_by_where_they_start_in_any_order() {
        let given = given(["time (s)", "force (N)"]);
        // Anywhere in their parts, half a metre wide.
        let order = |seeded: &[[f64; 2]]| given.in_order([&X, &Y], seeded, 0.5);
        assert_eq!(order(&[[0.1, -0.4], [0.9, 0.1]]).unwrap(), [1, 0]);
        assert_eq!(order(&[[0.9, 0.1], [0.1, -0.4]]).unwrap(), [0, 1]);
        for (seeded, why) in [
            (&[[0.25, -0.25]][..], "2 particles where 1 start"),
            (&[[0.25, -0.25], [0.75, 0.75]], "no particle starts at (0.75, 0.75) m"),
        ] {
            let told = order(seeded).unwrap_err().to_string();
            assert!(told.contains("particles.csv") && told.contains(why), "{told}");
        }
    }

    #[test]
    fn heads_have_the_unit_that_is_asked_for() {
        let asked = [X, Y, TIME, FORCE];
        let heads = |heads| given(heads).require_heads(&asked);
        assert!(heads(["time (s)", "force (N)"]).unwrap().is_empty());
        assert_eq!(heads(["time (s)", "work (J)"]).unwrap(), ["work (J)"]);
        // Columns of the other table don't count here.
        assert_eq!(heads(["time (s)", "x0 (m)"]).unwrap(), ["x0 (m)"]);
        let told = heads(["time (s)", "force (kN)"]).unwrap_err().to_string();
        let said = "column \"force (kN)\"; allowed: \"force (N)\"";
        assert!(told.contains("series.csv") && told.contains(said), "{told}");
    }

    #[test]
    fn a_head_that_misses_a_name_by_its_form_is_refused_with_the_name() {
        let asked = [X, Y, TIME, FORCE];
        for head in [
            "# force (N)",
            "#force (N)",
            "force",
            "force [N]",
            "force(N)",
            "FORCE (N)",
            " force (N)",
            "force  (N)",
            "force ( N )",
            "force_(N)",
            "force N",
            "force, N",
            "force (n)",
            "\"force (N)\"",
            "(force)",
            "Force {kN}",
            "force <N>",
        ] {
            let told = given(["time (s)", head]).require_heads(&asked).unwrap_err().to_string();
            let said = format!("column \"{}\"; allowed: \"force (N)\"", crate::error::one_line(head));
            assert!(told.contains(&said), "{told}");
        }
        for other in ["forces (N)", "force_x (N)", "Force on base (N)", "#", "", "(N)"] {
            assert_eq!(given(["time (s)", other]).require_heads(&asked).unwrap(), [other]);
        }
    }

    #[test]
    fn a_table_has_a_row_and_not_too_many() {
        let rows = |count: usize| {
            let mut given = given(["time (s)", "force (N)"]);
            let column = ("time (s)".to_owned(), vec![0.0; count]);
            given.tables = vec![(Part::Series, "a.csv".into(), Table::of_columns(vec![column]))];
            given.require_heads(&[TIME]).map_err(|e| e.to_string())
        };
        for count in [1, MOST_ROWS] {
            assert!(rows(count).is_ok());
        }
        for count in [0, MOST_ROWS + 1] {
            let told = rows(count).unwrap_err();
            assert!(told.contains(&format!("{count} rows where 1 to {MOST_ROWS}")), "{told}");
        }
    }
}
