//! Explicit and implicit runs of what both can solve, at equal error: cost, steps and iterations.

use super::prelude::*;
use super::words::list;
use crate::record::Status;
use crate::results::{SHORT, fixed};
use crate::scheme::BasisName::{Bspline2, Gimp};
use crate::scheme::RemedyName::{FbarConsistent, None as Standard};
use crate::scheme::TransferName;
use std::f64::consts::PI;

/// Name of the table on pages.
pub(super) const NAME: &str = "explicit-implicit";
/// Parameters that divide time or load, and change nothing else.
const STEPS: [&str; 4] = ["cfl=", "step_factor=", "load_steps=", "step_scaling="];
/// An error this much larger is still the same.
const EQUAL: f64 = 1.1;

/// A problem, with the functions and the remedy to take for it.
pub(super) struct Problem {
    pub(super) case: &'static str,
    /// Parameters changed from the case's own.
    set: &'static [&'static str],
    pub(super) schemes: (BasisName, RemedyName),
    /// Error in which the runs are equal: name, metric.
    pub(super) motion: (&'static str, &'static str),
    pressure: fn(&Record) -> f64,
    /// Title of its panel in the picture of [`super::solvers`], if it has one.
    pub(super) panel: Option<&'static str>,
}

const fn problem(
    case: &'static str,
    schemes: (BasisName, RemedyName),
    motion: (&'static str, &'static str),
    pressure: fn(&Record) -> f64,
) -> Problem {
    Problem { case, set: &[], schemes, motion, pressure, panel: None }
}

const DISPLACEMENT: (&str, &str) = ("u (m)", "displacement_l2");
const FREQUENCY: (&str, &str) = ("frequency", "frequency_error");

fn stress(r: &Record) -> f64 {
    r.value("mean_stress_l2")
}

fn no_pressure(_: &Record) -> f64 {
    f64::NAN
}

pub(super) const PROBLEMS: [Problem; 9] = [
    Problem {
        panel: Some("A wave that steps follow (ν = 0.3)"),
        ..problem("mms-axis", (Bspline2, Standard), DISPLACEMENT, stress)
    },
    problem("mms-wall-pressure", (Bspline2, Standard), DISPLACEMENT, stress),
    Problem {
        panel: Some("A vortex, slow beside its waves (ν = 0.4999)"),
        ..problem("mms-vortex-box", (Gimp, FbarConsistent), DISPLACEMENT, stress)
    },
    problem("vibrating-bar", (Bspline2, Standard), FREQUENCY, stress),
    Problem { set: &["duration=24"], ..problem("standing-wave", (Bspline2, Standard), FREQUENCY, stress) },
    problem("discs", (Gimp, Standard), ("energy", "energy_error_accumulated"), no_pressure),
    problem("cook", (Gimp, FbarConsistent), ("deflection", "fem_tip_error"), |r| r.value("mean_stress_rms_error")),
    // Prandtl's mean stress under the footing is −(1 + π) s_u.
    Problem {
        panel: Some("Clay under a footing, to its limit load (ν = 0.49)"),
        ..problem("footing", (Gimp, FbarConsistent), ("N_c by B", "prandtl_error"), |r| {
            r.value("mean_stress_0.25_0.25") / (1.0 + PI) + 1.0
        })
    },
    Problem {
        panel: Some("A slope, its strength reduced until it fails"),
        ..problem("slope-stability", (Gimp, FbarConsistent), ("factor", "factor_error"), no_pressure)
    },
];

impl Problem {
    /// The size of the error of motion of a run.
    fn error(&self, r: &Record) -> f64 {
        r.value(self.motion.1).abs()
    }

    /// Whether a run is of it, however divided in time.
    fn is_of(&self, r: &Record) -> bool {
        let own = r.case == self.case && (r.basis(), r.remedy()) == self.schemes;
        let is_set = |s: &String| self.set.contains(&&**s);
        let only = |s: &String| is_set(s) || STEPS.iter().any(|p| s.starts_with(p));
        let set = r.set.iter().filter(|s| is_set(s)).count() == self.set.len();
        let told = r.status == Status::Ok && r.time.cpu_s > 0.0 && self.error(r).is_finite();
        own && set && r.set.iter().all(only) && told
    }

    fn title(&self) -> String {
        let title = cases::find(self.case).map_or(self.case, |case| case.title);
        format!("{title} ({} {})", self.schemes.0, self.schemes.1)
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
        let own = r.set.iter().filter(|s| !self.set.contains(&&***s));
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
            SHORT.text((self.pressure)(r).abs()),
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
pub(super) fn table<'a>(records: &[&'a Record]) -> (Sheet, Vec<&'a Record>, String) {
    let head = [
        "problem",
        "solver",
        "run",
        "error",
        "error of pressure",
        "steps",
        "Newton's iterations",
        "CPU (s)",
        "over explicit",
    ];
    let (mut rows, mut told) = (Vec::new(), Vec::new());
    let (mut cheaper, mut dearer) = (Vec::new(), Vec::new());
    for problem in &PROBLEMS {
        let Some([explicit, implicit]) = problem.rivals(records) else { continue };
        rows.push(problem.row(explicit, None));
        rows.push(problem.row(implicit, Some(explicit)));
        told.extend([explicit, implicit]);
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
    (Sheet::new(head).with(rows), told, advice)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measured;
    use crate::record::fixture::record;
    use crate::scheme::{RuleName, Scheme};

    fn run(rule: Option<RuleName>, level: &str, set: &[&str], error: f64, cpu: f64) -> Record {
        let mut r = record(level, Vec::new());
        r.set = set.iter().map(|s| (*s).to_owned()).collect();
        let (basis, remedy) = (Gimp, FbarConsistent);
        r.scheme = match rule {
            Some(rule) => Scheme::implicit(rule, basis, remedy),
            None => Scheme::flip(basis, remedy),
        };
        r.solver = r.scheme.solver().to_owned();
        let value = Measured { value: Some(error), unit: "-".to_owned() };
        r.metrics.insert("fem_tip_error".to_owned(), value);
        r.time.cpu_s = cpu;
        r
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
        let (sheet, told, advice) = table(&runs.each_ref());
        assert_eq!(told.len(), 2);
        assert!(std::ptr::eq(told[0], &runs[1]) && std::ptr::eq(told[1], &runs[4]));
        assert_eq!(sheet.rows[1][8], "0.05");
        assert!(advice.contains("cheaper: cook 0.05;"), "{advice}");
        assert!(advice.ends_with("dearer: none."), "{advice}");
    }

    #[test]
    fn what_only_one_can_solve_is_left_out() {
        let runs = [run(None, "h2", &[], 0.1, 1.0)];
        assert!(table(&runs.each_ref()).0.rows.is_empty());
    }
}
