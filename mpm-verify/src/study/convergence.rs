//! Convergence and work–precision of a case: every quantity of every scheme over the levels.

use super::*;
use crate::accuracy::{Order, Richardson, extrapolate, fit_order};
use crate::cases::parameters::is_of_own_problem;
use crate::metric::Quantity;

/// Levels that show an order, at least.
const LEAST_LEVELS: usize = 3;

/// A quantity at one level, and what it cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    pub level: String,
    /// Parameters of the run that differ from the case's own.
    pub set: Vec<String>,
    /// Cell size (m).
    pub h: f64,
    /// The quantity.
    pub value: f64,
    /// Processor time (s).
    pub cpu_s: f64,
    /// Particle–node pairs visited.
    pub particle_node_pairs: u64,
}

/// A quantity of a scheme over the levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Parameters changed from the case's own, the same at all levels.
    #[serde(default)]
    pub set: Vec<String>,
    pub scheme: Scheme,
    pub metric: String,
    /// Whether it is an error, whose exact value is zero.
    pub is_error: bool,
    /// Coarsest first.
    pub points: Vec<Point>,
    /// Order of an error, by least squares.
    pub order: Option<Order>,
    /// Richardson's extrapolation of a value without a reference, in the asymptotic range.
    pub extrapolation: Option<Richardson>,
    /// Why there is neither.
    pub remark: Option<String>,
}

/// The records of each scheme over the levels that have the same [`stem`].
type Ladders<'a> = BTreeMap<(Scheme, &'a str), Vec<&'a Record>>;

/// The convergence of every quantity of `case`, scheme by scheme: over its own runs, then over those at each set of others, in order of appearance, that a scheme has run at three levels.
pub(crate) fn convergence(case: &Case, records: &[Record]) -> Vec<Convergence> {
    let mut all = over_levels(case, &[], &ladders((case.own_runs)(records).into_iter()));
    for set in distinct(records.iter().filter(|r| !r.is_default()).map(|r| &r.set[..])) {
        let mut ladders = ladders(records.iter().filter(|r| r.set == set));
        ladders.retain(|_, ladder| ladder.len() >= LEAST_LEVELS);
        all.extend(over_levels(case, set, &ladders));
    }
    all
}

/// The quantities of `case` scheme by scheme over the levels of its own problem (slices apart), for each time step and number of
/// particles per cell that it has been divided into: what a value costs depends on these.
pub(crate) fn precision(case: &Case, records: &[Record]) -> Vec<Convergence> {
    let own = || records.iter().filter(|r| is_of_own_problem(r));
    let mut sets = distinct(own().map(|r| &r.set[..]));
    sets.sort_by_key(|set| set.len());
    sets.into_iter().flat_map(|set| over_levels(case, set, &ladders(own().filter(|r| r.set == set)))).collect()
}

fn ladders<'a>(records: impl Iterator<Item = &'a Record>) -> Ladders<'a> {
    let mut ladders = Ladders::new();
    for record in records {
        ladders.entry((record.scheme(), stem(&record.level))).or_default().push(record);
    }
    ladders
}

/// Common name of the levels of one problem, and not of a slice and the whole: the name without the number at its end.
fn stem(level: &str) -> &str {
    level.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.')
}

fn over_levels(case: &Case, set: &[String], ladders: &Ladders) -> Vec<Convergence> {
    let mut all = Vec::new();
    for quantity in &case.quantities {
        for ((scheme, _), ladder) in ladders {
            let mut points: Vec<Point> = ladder
                .iter()
                .map(|r| Point {
                    level: r.level.clone(),
                    set: r.set.clone(),
                    h: r.discretisation.h,
                    value: r.metric(quantity.metric),
                    cpu_s: r.time.cpu_s,
                    particle_node_pairs: r.work.particle_node_pairs,
                })
                .filter(|p| p.value.is_finite())
                .collect();
            points.sort_by(|a, b| b.h.total_cmp(&a.h));
            if !points.is_empty() {
                all.push(study(set, *scheme, *quantity, points));
            }
        }
    }
    all
}

fn study(set: &[String], scheme: Scheme, quantity: Quantity, points: Vec<Point>) -> Convergence {
    let values: Vec<(f64, f64)> = points.iter().map(|p| (p.h, p.value)).collect();
    let (order, extrapolation, remark) = if quantity.is_error {
        let order = fit_order(&values);
        let why = if values.len() < LEAST_LEVELS {
            "fewer than three levels"
        } else {
            "the error changes sign or vanishes: no power law"
        };
        let remark = order.is_none().then(|| why.to_owned());
        (order, None, remark)
    } else {
        match extrapolate(&values) {
            Ok(found) => (None, Some(found), None),
            Err(why) => (None, None, Some(why)),
        }
    };
    Convergence {
        set: set.to_vec(),
        scheme,
        metric: quantity.metric.into(),
        is_error: quantity.is_error,
        points,
        order,
        extrapolation,
        remark,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::record::fixture::{changed, record};
    use crate::scheme::RemedyName;

    /// A run whose errors are those of second order.
    fn run(level: &str, h: f64, set: &[&str]) -> Record {
        let mut run = record(level, Vec::new());
        run.set = changed(set);
        run.discretisation.h = h;
        run.measure(&[("fem_edge_mean_error", h * h)]);
        run
    }

    fn of_sets(records: &[Record]) -> Vec<(String, usize)> {
        let case = cases::find("cook").unwrap();
        let entries = convergence(case, records);
        let told = entries.iter().map(|c| (c.set.join(" "), c.points.len()));
        told.collect()
    }

    const LEVELS: [(&str, f64); 3] = [("h2", 2.0), ("h1", 1.0), ("h0.5", 0.5)];

    #[test]
    fn every_set_of_parameters_has_a_ladder_of_its_own() {
        let sets: [&[&str]; 3] = [&["poisson_ratio=0.3"], &[], &["load=2", "flip=0.9"]];
        let mut records = Vec::new();
        for set in sets {
            records.extend(LEVELS.iter().rev().map(|(name, h)| run(name, *h, set)));
        }
        let expected = ["", "poisson_ratio=0.3", "load=2 flip=0.9"];
        assert_eq!(of_sets(&records), expected.map(|s| (s.to_owned(), 3)));
        let entries = convergence(cases::find("cook").unwrap(), &records);
        for entry in entries {
            assert_eq!(entry.points[0].level, "h2");
            assert!((entry.order.unwrap().order - 2.0).abs() < 1e-12);
        }
    }

    /// The numbers of levels with the case's own time step and with another one that a level each has run with.
    fn levels_of(case: &str, metric: &str) -> Vec<(String, usize)> {
        let sets: [&[&str]; 3] = [&[], &[], &["cfl=0.2"]];
        let mut records: Vec<Record> = LEVELS.iter().zip(sets).map(|((name, h), set)| run(name, *h, set)).collect();
        for record in &mut records {
            record.measure(&[(metric, record.value("fem_edge_mean_error"))]);
        }
        let entries = convergence(cases::find(case).unwrap(), &records);
        let own = entries.iter().filter(|c| c.metric == metric);
        own.map(|c| (c.set.join(" "), c.points.len())).collect()
    }

    #[test]
    fn another_time_step_stands_in_only_where_runs_settle() {
        let own = |levels| vec![(String::new(), levels)];
        assert_eq!(levels_of("cook", "fem_edge_mean_error"), own(3));
        assert_eq!(levels_of("dam-break", "front_rms_error"), own(2));
    }

    #[test]
    fn fewer_than_three_levels_of_a_scheme_make_no_ladder() {
        let set = &["poisson_ratio=0.3"][..];
        let mut records: Vec<Record> = LEVELS.iter().map(|(n, h)| run(n, *h, set)).collect();
        records[0].scheme = Scheme::flip(records[0].basis(), RemedyName::FbarTotal);
        assert_eq!(of_sets(&records), []);
        // At the case's own parameters, one level is shown.
        records[0].set.clear();
        assert_eq!(of_sets(&records), [(String::new(), 1)]);
    }

    #[test]
    fn a_cost_is_that_of_runs_with_the_same_time_step_and_particles() {
        let sets: [&[&str]; 3] = [&["cfl=0.6"], &[], &["poisson_ratio=0.3"]];
        let mut records = Vec::new();
        for set in sets {
            records.extend(LEVELS[..2].iter().map(|(name, h)| run(name, *h, set)));
        }
        let entries = precision(cases::find("cook").unwrap(), &records);
        let told = entries.iter().map(|c| (c.set.join(" "), c.points.len()));
        let expected = [(String::new(), 2), ("cfl=0.6".to_owned(), 2)];
        assert_eq!(told.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn slices_are_no_levels_of_the_whole() {
        let names = ["h0.5", "slice-h0.4", "h0.25", "h0.2", "slice-h0.1"];
        let records = names.map(|name| {
            let h = name.rsplit('h').next().unwrap().parse().unwrap();
            run(name, h, &[])
        });
        let own = [(String::new(), 3), (String::new(), 2)];
        assert_eq!(of_sets(&records), own);
    }

    #[test]
    fn a_run_without_the_quantity_leaves_a_shorter_ladder() {
        let set = &["poisson_ratio=0.3"][..];
        let mut records: Vec<Record> = LEVELS.iter().map(|(n, h)| run(n, *h, set)).collect();
        records[2].metrics.clear();
        assert_eq!(of_sets(&records), [(set[0].to_owned(), 2)]);
    }
}
