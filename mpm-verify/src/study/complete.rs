//! Whether everything that is planned has been measured: a plan against the rows that are kept of nights.

use super::plan::Plan;
use super::*;
use crate::case::Tier;

/// Key of a kept row's run, and its program; the row has more columns.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
struct Row {
    case: String,
    scheme: String,
    level: String,
    /// Parameters changed from the case's own, apart by spaces.
    set: String,
    /// Fingerprint of the sources.
    program: String,
}

/// Kept results of the planned runs of a case.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
struct Known {
    planned: usize,
    /// Folders of runs that have no row.
    missing: Vec<String>,
    /// Rows of every program.
    programs: BTreeMap<String, usize>,
}

/// A plan compared with the rows that are kept of nights.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completeness {
    tier: String,
    /// Fingerprint of the sources now.
    program: String,
    /// By case, in the order of the plan.
    cases: Vec<(String, Known)>,
}

impl Completeness {
    /// Completeness of `plan` against the rows of the file `results`; rows of other programs than `program` are counted
    /// apart.
    ///
    /// # Errors
    /// The file is missing or damaged.
    pub fn of(plan: &Plan, results: &Path, program: &str) -> Result<Self, Error> {
        Ok(Self::compare(plan, &read_rows::<Row>(results)?, program))
    }

    fn compare(plan: &Plan, rows: &[Row], program: &str) -> Self {
        let run = |row: &Row| [&row.case, &row.scheme, &row.level, &row.set].map(String::clone);
        let made: BTreeMap<[String; 4], &str> = rows.iter().map(|row| (run(row), &*row.program)).collect();
        let mut cases: Vec<(String, Known)> = Vec::new();
        for run in &plan.runs {
            if cases.last().is_none_or(|(case, _)| *case != run.case) {
                cases.push((run.case.clone(), Known::default()));
            }
            let Some((_, known)) = cases.last_mut() else { continue };
            let [case, level] = [&run.case, &run.level].map(String::clone);
            known.planned += 1;
            match made.get(&[case, run.scheme.to_string(), level, run.set.join(" ")]) {
                None => known.missing.push(run.folder().display().to_string()),
                Some(made_by) => *known.programs.entry((*made_by).to_owned()).or_default() += 1,
            }
        }
        Self { tier: plan.tier.clone(), program: program.to_owned(), cases }
    }

    /// Whether every planned run has a row, and those of a case are of one program, as they stand in its tables side by side;
    /// the largest runs, of the tier `long`, may be older.
    ///
    /// # Errors
    /// One has none, or a case has rows of several programs.
    pub fn require(&self) -> Result<(), Error> {
        let several = |known: &Known| known.programs.len() > 1 && self.tier != Tier::Long.to_string();
        let mixed: Vec<&str> = self.cases.iter().filter(|(_, known)| several(known)).map(|(case, _)| &**case).collect();
        match self.missing() {
            0 if mixed.is_empty() => Ok(()),
            0 => {
                Err(Error::Input(format!("rows of several programs in a case: run the night of {}", mixed.join(", "))))
            }
            missing => {
                Err(Error::Input(format!("incomplete: {missing} of {} planned runs have no row", self.planned())))
            }
        }
    }

    fn planned(&self) -> usize {
        self.cases.iter().map(|(_, known)| known.planned).sum()
    }

    fn missing(&self) -> usize {
        self.cases.iter().map(|(_, k)| k.missing.len()).sum()
    }
}

/// Every run that has no row, and case by case how many rows are of other programs.
impl fmt::Display for Completeness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut others = 0;
        for (case, known) in &self.cases {
            for run in &known.missing {
                writeln!(f, "{run}: no row")?;
            }
            let made = known.planned - known.missing.len();
            write!(f, "{case}: {made} of {} runs have a row", known.planned)?;
            let mut joint = "; of other programs";
            for (program, count) in known.programs.iter().filter(|(program, _)| **program != self.program) {
                others += count;
                write!(f, "{joint} {count} ({program})")?;
                joint = ",";
            }
            writeln!(f)?;
        }
        writeln!(
            f,
            "Tier {}: {} of {} planned runs have no row; {others} rows are of another program than {}.",
            self.tier,
            self.missing(),
            self.planned(),
            self.program
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::plan::Shard;
    use super::*;
    use crate::cases;

    /// The quick tier of two cases, and a row of "now" for each of its runs.
    fn measured() -> (Plan, Vec<Row>) {
        let two = ["cook", "column"].map(|name| cases::find(name).unwrap());
        let plan = Plan::new(two, Tier::Pr, Shard::WHOLE).unwrap();
        let row = |run: &super::super::plan::PlannedRun| Row {
            case: run.case.clone(),
            scheme: run.scheme.to_string(),
            level: run.level.clone(),
            set: run.set.join(" "),
            program: "now".to_owned(),
        };
        let rows = plan.runs.iter().map(row).collect();
        (plan, rows)
    }

    #[test]
    fn a_run_without_a_row_is_named_and_refused() {
        let (plan, mut rows) = measured();
        let whole = Completeness::compare(&plan, &rows, "now");
        assert!(whole.require().is_ok(), "{whole}");
        // One that differs from another by what is changed alone.
        let changed = rows.iter().position(|row| !row.set.is_empty()).unwrap();
        rows.remove(changed);
        let found = Completeness::compare(&plan, &rows, "now");
        let folder = plan.runs[changed].folder().display().to_string();
        let told = found.to_string();
        assert_eq!(told.matches("no row\n").count(), 1, "{told}");
        assert!(told.contains(&format!("{folder}: no row\n")), "{told}");
        let error = found.require().unwrap_err().to_string();
        let count = plan.runs.len();
        assert!(error.contains(&format!("1 of {count} planned")), "{error}");
    }

    #[test]
    fn rows_of_another_program_are_counted_by_case_and_refused_beside_others() {
        let (mut plan, mut rows) = measured();
        let of_column = rows.iter_mut().filter(|row| row.case == "column");
        for row in of_column.take(2) {
            row.program = "then".to_owned();
        }
        let found = Completeness::compare(&plan, &rows, "now");
        let error = found.require().unwrap_err().to_string();
        assert!(error.contains("several programs in a case: run the night of column"), "{error}");
        plan.tier = Tier::Long.to_string();
        assert!(Completeness::compare(&plan, &rows, "now").require().is_ok());
        plan.tier = Tier::Pr.to_string();
        let all_older: Vec<Row> = rows.iter().map(|row| Row { program: "then".to_owned(), ..row.clone() }).collect();
        assert!(Completeness::compare(&plan, &all_older, "now").require().is_ok());
        let told = found.to_string();
        assert!(told.contains("; of other programs 2 (then)\n"), "{told}");
        assert!(told.contains("2 rows are of another program than now."));
        assert_eq!(told.lines().count(), 3, "{told}");
    }

    #[test]
    fn columns_beside_those_that_name_the_run_are_not_asked_for() {
        let (plan, rows) = measured();
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut text = "case,scheme,night,level,set,program,new\n".to_owned();
        for row in &rows {
            let Row { case, scheme, level, set, program } = row;
            text += &format!("{case},{scheme},2026-01-01,{level},{set},{program},1\n");
        }
        std::fs::write(file.path(), &text).unwrap();
        let found = Completeness::of(&plan, file.path(), "now").unwrap();
        assert_eq!(found, Completeness::compare(&plan, &rows, "now"));
        std::fs::write(file.path(), "case,scheme\ncook,gimp\n").unwrap();
        assert!(Completeness::of(&plan, file.path(), "now").is_err());
        let nowhere = Path::new("no such file");
        assert!(Completeness::of(&plan, nowhere, "now").is_err());
    }
}
