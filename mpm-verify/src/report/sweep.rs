//! Errors over the values of a parameter.

use super::errors::{Entry, Errors};
use super::prelude::*;
use crate::metric::Sweep;

/// Values of a parameter that make a sweep, at least.
const LEAST_VALUES: usize = 3;

/// Draws every error against each parameter that was swept, and writes what is drawn.
pub(super) fn draw(study: &CaseStudy, out: &Path) -> Result<Vec<Picture>, Error> {
    let case = cases::find(&study.case)?;
    let mut pictures = Vec::new();
    for sweep in &case.sweeps {
        let Some(runs) = Runs::select(case, sweep, &study.records) else { continue };
        let shown = |q: &&Quantity| q.is_error && runs.measure(q);
        let (mut entries, mut rows) = (Vec::new(), Vec::new());
        for metric in case.quantities.iter().filter(shown).map(|q| q.metric) {
            let of_all = runs.of_scheme.iter().flat_map(|(scheme, own)| own.iter().map(move |run| (*scheme, run)));
            for (scheme, &(value, run)) in of_all {
                let (x, error) = ((sweep.abscissa)(value), run.metric(metric));
                if error.is_finite() {
                    let words = [metric.name, &scheme.to_string(), runs.level].map(str::to_owned);
                    rows.push([words, [value, x, error].map(|x| x.to_string())].concat());
                    entries.push(Entry { scheme, metric: metric.name, x, value: error });
                }
            }
        }
        if entries.is_empty() {
            continue;
        }
        let (parameter, label) = (sweep.parameter.name, sweep.label);
        let name = format!("sweep-{parameter}");
        let header = ["quantity", "scheme", "level", parameter, label, "value"];
        write_csv(&out.join(case.name).join(format!("{name}.csv")), &header.map(str::to_owned), rows)?;
        let caption = format!(
            "Error at level {} over the values of {parameter}, for every scheme that ran at least {LEAST_VALUES} of them.",
            runs.level
        );
        let errors = Errors { entries, label, is_logarithmic: sweep.logarithmic };
        pictures.extend(errors.draw(case, (&*format!("{name}.png"), &*caption), out, |_, _, chart| chart)?);
    }
    Ok(pictures)
}

/// The runs of a sweep, all at one level.
struct Runs<'a> {
    level: &'static str,
    /// By rising value of the parameter.
    of_scheme: BTreeMap<Scheme, Vec<(f64, &'a Record)>>,
}

impl<'a> Runs<'a> {
    /// The runs that differ in the parameter alone, of the schemes that ran enough of its values at the
    /// finest level at which any has; `None` if there is no such level.
    fn select(case: &Case, sweep: &Sweep, records: &'a [Record]) -> Option<Self> {
        let at_level = |level: &'static str| {
            let mut of_scheme: BTreeMap<Scheme, Vec<(f64, &Record)>> = BTreeMap::new();
            for record in records.iter().filter(|r| r.level == level) {
                if record.is_default() || record.changes_only(sweep.parameter.name) {
                    let value = record.parameters.number(sweep.parameter);
                    of_scheme.entry(record.scheme()).or_default().push((value, record));
                }
            }
            of_scheme.retain(|_, runs| {
                runs.sort_by(|a, b| a.0.total_cmp(&b.0));
                runs.dedup_by_key(|run| run.0);
                runs.len() >= LEAST_VALUES
            });
            (!of_scheme.is_empty()).then_some(Self { level, of_scheme })
        };
        case.levels.iter().rev().find_map(|l| at_level(l.name))
    }

    /// Whether some scheme has measured a quantity at enough values of the parameter.
    fn measure(&self, quantity: &Quantity) -> bool {
        self.of_scheme
            .values()
            .any(|runs| runs.iter().filter(|run| run.1.metric(quantity.metric).is_finite()).count() >= LEAST_VALUES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture;

    fn cook() -> &'static Case {
        cases::find("cook").unwrap()
    }

    fn run(level: &str, remedy: RemedyName, set: &[&str]) -> Record {
        let error = [("fem_edge_mean_error", 0.01)];
        fixture::run(&cook().parameters, (BasisName::Gimp, remedy), (level, 1.0), set, &error)
    }

    /// Two values at the finest level, three at the next, for one of two schemes.
    fn records() -> Vec<Record> {
        use RemedyName::{FbarRate, None};
        vec![
            run("h0.5", FbarRate, &[]),
            run("h0.5", FbarRate, &["poisson_ratio=0.3"]),
            run("h1", FbarRate, &["poisson_ratio=0.4999"]),
            run("h1", FbarRate, &[]),
            run("h1", FbarRate, &["poisson_ratio=0.499"]),
            run("h1", FbarRate, &["poisson_ratio=0.3"]),
            run("h1", FbarRate, &["poisson_ratio=0.45", "load=2"]),
            run("h1", None, &[]),
            run("h1", None, &["poisson_ratio=0.3"]),
            run("h1", None, &["load=2"]),
        ]
    }

    #[test]
    fn a_sweep_changes_one_parameter_at_the_finest_level_with_three_values() {
        let records = records();
        let runs = Runs::select(cook(), &cook().sweeps[0], &records).unwrap();
        assert_eq!((runs.level, runs.of_scheme.len()), ("h1", 1));
        let values = runs.of_scheme.values().flatten().map(|(value, _)| *value);
        assert_eq!(values.collect::<Vec<_>>(), [0.3, 0.499, 0.4999]);
        assert!(Runs::select(cook(), &cook().sweeps[0], &records[..4]).is_none());
    }

    #[test]
    fn an_error_that_only_two_values_have_is_not_shown() {
        let mut records = records();
        records[3].metrics.clear();
        records[4].metrics.clear();
        let sweep = &cook().sweeps[0];
        let runs = Runs::select(cook(), sweep, &records).unwrap();
        assert!(!cook().quantities.iter().any(|q| runs.measure(q)));
    }

    #[test]
    fn what_is_drawn_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let study = CaseStudy::new("cook", records());
        let pictures = draw(&study, folder.path()).unwrap();
        assert_eq!(pictures.len(), 1);
        assert!(folder.path().join(&pictures[0].file).exists());
        let csv = folder.path().join("cook/sweep-poisson_ratio.csv");
        let text = std::fs::read_to_string(csv).unwrap();
        let mut lines = text.lines();
        let header = "quantity,scheme,level,poisson_ratio,0.5 − ν,value";
        assert_eq!(lines.next(), Some(header));
        let first = "fem_edge_mean_error,gimp-fbar-rate-flip,h1,0.3,0.2,0.01";
        assert_eq!(lines.next(), Some(first));
        assert_eq!(lines.count(), 2);
    }
}
