//! Explicit and implicit runs of what both can solve, at equal error: cost, steps and iterations.

use super::prelude::*;

/// Name of the table on pages.
pub(super) const NAME: &str = "explicit-implicit";
/// Parameters that divide time or load, and change nothing else.
const STEPS: [&str; 4] = ["cfl=", "step_factor=", "load_steps=", "step_scaling="];
/// An error this much larger is still the same.
const EQUAL: f64 = 1.1;

/// The problems, in the order of their rows.
const PROBLEMS: &str = include_str!("../../assets/rivals.toml");

/// A problem, with the scheme to take for it, whose functions and remedy are those of the implicit runs too.
#[derive(Deserialize)]
pub(super) struct Problem {
    case: String,
    /// Parameters changed from the case's own.
    #[serde(default)]
    set: Vec<String>,
    /// Scheme of the explicit runs.
    scheme: Scheme,
    /// Error in which the runs are equal: name, metric.
    pub(super) motion: (String, String),
    /// Metric of the error of the pressure, or of the pressure where that has an exact value.
    pressure: Option<String>,
    exact: Option<f64>,
    /// Title of its panel in the picture of [`super::solvers`], if it has one.
    pub(super) panel: Option<String>,
}

/// Reads the problems.
pub(super) fn problems() -> Result<Vec<Problem>, Error> {
    let read = toml::from_str::<BTreeMap<String, Vec<Problem>>>(PROBLEMS);
    let all = read.map_err(|e| Error::Input(format!("problems of explicit and implicit runs: {e}")))?;
    Ok(all.into_values().flatten().collect())
}

impl Problem {
    /// Whether a run is of its case, functions and remedy.
    pub(super) fn has(&self, r: &Record) -> bool {
        r.case == self.case && (r.basis(), r.remedy()) == (self.scheme.basis(), self.scheme.remedy())
    }

    /// The size of the error of motion of a run.
    pub(super) fn error(&self, r: &Record) -> f64 {
        r.value(&self.motion.1).abs()
    }

    /// The size of its error of pressure; NaN if the problem has none.
    fn error_of_pressure(&self, r: &Record) -> f64 {
        let value = self.pressure.as_ref().map_or(f64::NAN, |metric| r.value(metric));
        self.exact.map_or(value, |exact| value / exact - 1.0).abs()
    }

    /// Whether a run is of it, however divided in time.
    fn is_of(&self, r: &Record) -> bool {
        let only = |s: &String| self.set.contains(s) || STEPS.iter().any(|p| s.starts_with(p));
        let set = r.set.iter().filter(|s| self.set.contains(s)).count() == self.set.len();
        let told = r.status == Status::Ok && r.time.cpu_s > 0.0 && self.error(r).is_finite();
        self.has(r) && set && r.set.iter().all(only) && told
    }

    fn title(&self) -> String {
        let title = cases::find(&self.case).map_or(&*self.case, |case| case.title);
        format!("{title} ({})", self.scheme.title())
    }

    /// The cheapest run of each kind of solver among those whose error is that which both reach.
    fn rivals<'a>(&self, records: &[&'a Record]) -> Option<[&'a Record; 2]> {
        let of_kind = |implicit: bool| -> Vec<&'a Record> {
            let fits = |r: &&Record| match r.scheme().rule() {
                Some(_) => implicit,
                None => !implicit && r.transfer() == TransferName::Flip,
            };
            records.iter().copied().filter(|r| self.is_of(r)).filter(fits).collect()
        };
        let kinds = [false, true].map(of_kind);
        let least = |runs: &Vec<&Record>| runs.iter().map(|r| self.error(r)).fold(f64::INFINITY, f64::min);
        let target = EQUAL * kinds.iter().map(least).fold(0.0, f64::max);
        let [explicit, implicit] = kinds.map(|runs| {
            let good = runs.into_iter().filter(|r| self.error(r) <= target);
            good.min_by(|a, b| a.time.cpu_s.total_cmp(&b.time.cpu_s))
        });
        Some([explicit?, implicit?])
    }

    /// A row of a run, with how many times the cost of `other` it has.
    fn row(&self, r: &Record, other: Option<&Record>) -> Vec<String> {
        let number = |name| r.value(name);
        let name = if r.scheme().rule().is_some() { &*r.solver } else { "explicit" };
        let own = r.set.iter().filter(|s| !self.set.contains(s));
        let run = [r.level.clone()].into_iter().chain(own.cloned());
        let iterations = match number("newton_iterations") {
            n if n > 0.0 => fixed(0).text(n),
            _ => "–".to_owned(),
        };
        vec![
            self.title(),
            name.to_owned(),
            run.collect::<Vec<_>>().join(" "),
            format!("{}: {}", self.motion.0, SHORT.text(self.error(r))),
            SHORT.text(self.error_of_pressure(r)),
            r.work.steps.to_string(),
            iterations,
            SHORT.text(r.time.cpu_s),
            other.map_or_else(String::new, |other| SHORT.text(ratio(r, other))),
        ]
    }
}

fn ratio(r: &Record, other: &Record) -> f64 {
    r.time.cpu_s / other.time.cpu_s
}

/// The table of some runs, the runs it contains, and its conclusion in a sentence.
pub(super) fn table(records: &[&Record]) -> Result<(Sheet, String), Error> {
    let head = "problem,solver,run,error,error of pressure,steps,Newton's iterations,CPU (s),over explicit".split(',');
    let mut rows = Vec::new();
    let (mut cheaper, mut dearer) = (Vec::new(), Vec::new());
    for problem in problems()? {
        let Some([explicit, implicit]) = problem.rivals(records) else { continue };
        rows.push(problem.row(explicit, None));
        rows.push(problem.row(implicit, Some(explicit)));
        let ratio = ratio(implicit, explicit);
        let side = if ratio < 1.0 { &mut cheaper } else { &mut dearer };
        side.push(format!("{} {}", problem.case, SHORT.text(ratio)));
    }
    let advice = format!(
        "At equal error implicit steps cost this share of explicit ones where they are cheaper: {}; and this many times as much \
         where they are dearer: {}.",
        list(cheaper),
        list(dearer)
    );
    Ok((Sheet::new(head).with(rows), advice))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::{changed, record};
    use crate::scheme::{RuleName, Scheme};

    fn run(rule: Option<RuleName>, level: &str, set: &[&str], error: f64, cpu: f64) -> Record {
        let mut r = record(level, Vec::new());
        r.set = changed(set);
        let (basis, remedy) = (BasisName::Gimp, RemedyName::FbarConsistent);
        r.scheme = match rule {
            Some(rule) => Scheme::implicit(rule, basis, remedy),
            None => Scheme::flip(basis, remedy),
        };
        r.solver = r.scheme.solver().to_owned();
        r.measure(&[("fem_tip_error", error)]);
        r.time.cpu_s = cpu;
        r
    }

    #[test]
    fn problems_name_what_there_is() {
        let all = problems().unwrap();
        assert_eq!(all.iter().filter(|p| p.panel.is_some()).count(), 4);
        for problem in &all {
            let case = cases::find(&problem.case).unwrap();
            for name in [&problem.motion.1].into_iter().chain(&problem.pressure) {
                assert!(case.metrics.iter().any(|m| m.name == name), "{}: {name}", case.name);
            }
            assert!(case.schemes().contains(&problem.scheme), "{}", case.name);
            crate::parameter::Parameters::new(&case.parameters, &problem.set).unwrap();
        }
    }

    /// The finest implicit run has no explicit rival; the error of both is that of the coarser level.
    #[test]
    fn the_cheapest_runs_of_the_error_that_both_reach_are_compared() {
        let still = Some(RuleName::QuasiStatic);
        let runs = [
            run(None, "h2", &[], -0.10, 1.0),
            run(None, "h1", &[], -0.05, 10.0),
            run(still, "h2", &[], -0.10, 0.1),
            run(still, "h1", &[], 0.05, 2.0),
            run(still, "h1", &["load_steps=1"], -0.054, 0.5),
            run(still, "h0.5", &[], 0.02, 8.0),
            // A run of another problem.
            run(still, "h1", &["load=10"], 0.01, 0.01),
        ];
        let (sheet, advice) = table(&runs.each_ref()).unwrap();
        assert_eq!(sheet.rows.len(), 2);
        assert_eq!(sheet.rows[1][8], "0.05");
        assert!(advice.contains("cheaper: cook 0.05;"), "{advice}");
        assert!(advice.ends_with("dearer: none."), "{advice}");
    }

    #[test]
    fn what_only_one_can_solve_is_left_out() {
        let runs = [run(None, "h2", &[], 0.1, 1.0)];
        assert!(table(&runs.each_ref()).unwrap().0.rows.is_empty());
    }
}
