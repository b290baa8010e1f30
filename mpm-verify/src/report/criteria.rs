//! Tables over several cases: every remedy, and every space of the pressure, against every criterion; transfers and particles
//! per cell.

use super::prelude::*;
use super::values::{quantity, read_format};
use crate::results::{PAIR, order};

/// The bases that are compared.
pub(super) const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
/// rms ln(J/J̄) beyond which particles have lost their order.
const DISORDER: f64 = 0.1;
/// The error that orders, prices and locking are those of.
const ERROR: &str = "displacement_l2";

/// The criteria: table, title, the case, level and changed parameters of a run, what is shown of it, and the format of a
/// number, as that of numbers on pages.
const CRITERIA: &str = include_str!("../../assets/criteria.csv");

#[derive(Clone, Deserialize)]
struct Criterion {
    table: String,
    title: String,
    case: String,
    level: String,
    set: String,
    shows: String,
    format: String,
}

impl Criterion {
    /// Those of a table, as columns.
    fn columns(table: &str) -> Vec<Column> {
        let all = csv::Reader::from_reader(CRITERIA.as_bytes()).into_deserialize::<Self>();
        all.flatten().filter(|line| line.table == table).map(Self::column).collect()
    }

    fn has(&self, r: &Record) -> bool {
        self.is_of_set(r, &self.set) && r.level == self.level
    }

    fn is_of_set(&self, r: &Record, set: &str) -> bool {
        r.case == self.case && r.set.join(" ") == set
    }

    fn column(self) -> Column {
        let (title, this) = (self.title.clone(), self.clone());
        let (shows, of) = self.shows.split_once(' ').unwrap_or((&self.shows, ""));
        let of = of.to_owned();
        match shows {
            // Over all levels.
            "order" => Column::row(title, move |own, _| {
                let runs = own.iter().filter(|r| self.is_of_set(r, &self.set));
                order(runs.copied(), &of).map_or_else(String::new, |order| order.to_string())
            }),
            "over-none" | "over-set" => Column::row(title, move |own, all| self.over(own, all, &of)),
            "at-rest" => Column::text(title, move |r| {
                let error = fixed(2).times(100.0).text(r.value(&of));
                if r.value("at_rest") == 1.0 { error } else { format!("{error}, never at rest") }
            })
            .of(move |r| this.has(r)),
            "frequency" => Column::text(title, |r| match r.value("log_jacobian_gap") > DISORDER {
                true => "in disorder".to_owned(),
                false => format!("frequency × {}", fixed(2).text(r.value("frequency_ratio"))),
            })
            .of(move |r| this.has(r)),
            _ => {
                let format = read_format(&self.format).unwrap_or(SHORT);
                Column::value(title, move |r| quantity(r, &self.shows), format).of(move |r| this.has(r))
            }
        }
    }

    /// The error over that of a run without a remedy, or of the same remedy with the parameters `set`.
    fn over(&self, own: &[&Record], all: &[&Record], set: &str) -> String {
        let Some(run) = own.iter().find(|r| self.has(r)) else { return String::new() };
        let (set, remedy) = match set {
            "" => (&*self.set, RemedyName::None),
            set => (set, run.remedy()),
        };
        let is_other = |r: &&&Record| self.is_of_set(r, set) && r.level == self.level && r.remedy() == remedy;
        let other = all.iter().find(is_other).map_or(f64::NAN, |r| r.value(ERROR));
        SHORT.text(run.value(ERROR) / other)
    }
}

/// Every remedy against every criterion, with a basis.
pub(super) fn remedies(basis: BasisName) -> ResultTable {
    const REMEDY: Label = ("", |r| r.remedy().to_string());
    let shows = move |r: &Record| is_flip(r) && r.basis() == basis;
    ResultTable::new(format!("remedies-{basis}"), shows, &[REMEDY], Criterion::columns("remedies")).across()
}

/// The error of u on 32 cells (16 in three dimensions), and by what factor another transfer or number of particles per
/// direction changes it.
fn transfers() -> ResultTable {
    const CASE: Label = ("case", |r| r.case.replace("mms-", ""));
    let own = |r: &Record| r.transfer() == TransferName::Flip && r.is_default();
    let error = |r: &Record| match 1e6 * r.value(ERROR) {
        x if x < 10.0 => fixed(2).text(x),
        x if x < 100.0 => fixed(1).text(x),
        x => fixed(0).text(x),
    };
    let over = move |title: &str, of: fn(&Record) -> bool| {
        Column::row(title, move |runs, _| {
            let first = |of: &dyn Fn(&Record) -> bool| runs.iter().find(|r| of(r));
            let (Some(run), Some(own)) = (first(&of), first(&own)) else { return String::new() };
            fixed(2).text(run.value(ERROR) / own.value(ERROR))
        })
    };
    let columns = [
        Column::text("FLIP, 2 per direction (µm)", error).of(own),
        over("APIC ×", |r| r.transfer() == TransferName::Apic && r.is_default()),
        over("XPIC(2) ×", |r| r.transfer() == TransferName::Xpic2 && r.is_default()),
        over("3 per direction ×", |r| r.set == ["ppc_per_direction=3"]),
        over("4 ×", |r| r.set == ["ppc_per_direction=4"]),
    ];
    let shows = |r: &Record| {
        let level = if r.case == "mms-swirl" { "n16" } else { "n32" };
        let pair = [RemedyName::None, RemedyName::FbarConsistent].contains(&r.remedy());
        r.case.starts_with("mms-") && r.level == level && pair && BASES.contains(&r.basis())
    };
    ResultTable::new("transfers-and-particles", shows, &[CASE, PAIR], columns)
}

/// Every space of the pressure against every criterion, with its cost.
fn spaces() -> ResultTable {
    const SPACE: Label = ("", |r| match r.scheme() {
        Scheme::Poro(parts) => parts.space.to_string(),
        _ => String::new(),
    });
    let shows = |r: &Record| matches!(r.scheme(), Scheme::Poro(_)) && r.basis() == BasisName::Gimp;
    let name = "pressure-spaces";
    ResultTable::new(name, shows, &[SPACE], Criterion::columns(name)).across()
}

/// All of them.
pub(super) fn all() -> Vec<ResultTable> {
    BASES.into_iter().map(remedies).chain([transfers(), spaces()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn criteria_name_what_there_is() {
        let all = csv::Reader::from_reader(CRITERIA.as_bytes()).into_deserialize::<Criterion>();
        for line in all.map(Result::unwrap) {
            let case = cases::find(&line.case).unwrap();
            assert!(case.levels.iter().any(|l| l.name == line.level), "{}", line.title);
            assert!(line.format.is_empty() || read_format(&line.format).is_some(), "{}", line.format);
            let (shows, of) = line.shows.split_once(' ').unwrap_or((&line.shows, &line.shows));
            let known = |name: &str| name == "cpu_s" || case.metrics.iter().any(|m| m.name == name);
            match shows {
                "over-none" | "over-set" | "frequency" => {}
                _ => assert!(known(of), "{}: {of}", line.title),
            }
        }
    }
}
