//! Cost of an error: the runs on the Pareto front, and the cost to reach a target error.

use super::prelude::*;

/// By rising cost, the points whose error is less than `gain` times that of the point before: with a gain of one, those that
/// no other beats in both.
pub(super) fn front(mut points: Vec<(f64, f64)>, gain: f64) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut best = f64::INFINITY;
    points.retain(|(_, error)| {
        let counts = *error < gain * best;
        if counts {
            best = *error;
        }
        counts
    });
    points
}

/// A front with the corners of the steps between its points: no point is below the line.
pub(super) fn steps(front: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let corners = front.windows(2).flat_map(|pair| [(pair[1].0, pair[0].1), pair[1]]);
    front.iter().take(1).copied().chain(corners).collect()
}

/// Prices of a target error with every scheme.
#[derive(Debug, PartialEq)]
pub(super) struct Prices {
    /// Whether it is an error of the stress, not of the motion.
    pub(super) of_stress: bool,
    /// Label of the error.
    pub(super) label: &'static str,
    /// The target: the least error that half of the schemes reach with one of their runs.
    pub(super) target: f64,
    /// Cheapest first, then those that don't reach it.
    pub(super) rows: Vec<Price>,
}

/// Price of a target error with a scheme.
#[derive(Debug, PartialEq)]
pub(super) struct Price {
    pub(super) scheme: Scheme,
    /// The least error that it has reached.
    pub(super) least: f64,
    /// Particle–node pairs and CPU time (s), if it has reached the target.
    pub(super) cost: Option<Cost>,
    /// The time step and particles per cell with which it costs that, if they aren't the case's own.
    set: Vec<String>,
    /// Whether one of those runs is wrong as known.
    is_wrong: bool,
}

/// Between two levels, a cost is interpolated in logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    pub(super) pairs: f64,
    pub(super) cpu_s: f64,
    /// Whether the coarsest level reaches the target already, so that this is more than it costs.
    pub(super) at_most: bool,
}

impl Prices {
    /// Prices of the errors that two schemes of the case's own problem have at two levels: the first error of the
    /// motion, then the last of the stress, which is that of the pressure. Solvers of the case's own kind only: another
    /// kind does other work for a pair, and more beside it.
    pub(super) fn of(study: &CaseStudy) -> Vec<Self> {
        let Ok(case) = cases::find(&study.case) else { return Vec::new() };
        let kind = case.default_scheme(None).solver();
        let mut curves = precision(case, &study.records);
        curves.retain(|curve| curve.scheme.solver() == kind);
        let of_metric = |q: &Quantity| {
            let own = curves.iter().filter(|c| c.metric == q.metric.name);
            Self::over(&own.collect::<Vec<_>>(), q, &study.records)
        };
        let priced = |of_stress| {
            let mut errors = case.quantities.iter().filter(move |q| q.is_error && is_of_stress(q) == of_stress);
            if of_stress { errors.next_back() } else { errors.next() }
        };
        [priced(false), priced(true)].into_iter().flatten().filter_map(of_metric).collect()
    }

    /// Prices from the curves of an error, and the runs behind them.
    fn over(curves: &[&Convergence], quantity: &Quantity, runs: &[Record]) -> Option<Self> {
        let mut schemes = BTreeMap::<Scheme, Vec<&Convergence>>::new();
        for &curve in curves {
            schemes.entry(curve.scheme).or_default().push(curve);
        }
        schemes.retain(|_, own| own.iter().any(|c| c.points.len() > 1));
        if schemes.len() < 2 {
            return None;
        }
        let least = |own: &[&Convergence]| {
            own.iter().flat_map(|c| &c.points).map(|p| p.value.abs()).fold(f64::INFINITY, f64::min)
        };
        let mut reached: Vec<f64> = schemes.values().map(|own| least(own)).collect();
        reached.sort_by(f64::total_cmp);
        let target = reached[reached.len() / 2];
        let row = |(scheme, own): (&Scheme, &Vec<&Convergence>)| {
            let costs = own.iter().filter_map(|c| Some((cost(&c.points, target)?, &c.set)));
            let cheapest = costs.min_by(|(a, _), (b, _)| a.pairs.total_cmp(&b.pairs));
            let set = cheapest.map_or(Vec::new(), |(_, set)| set.clone());
            let is_wrong = runs.iter().any(|run| {
                let own = run.scheme() == *scheme && run.set == set;
                own && outcome_of_run(run) == Outcome::WrongAsKnown
            });
            Price { scheme: *scheme, least: least(own), cost: cheapest.map(|(cost, _)| cost), set, is_wrong }
        };
        let mut rows: Vec<Price> = schemes.iter().map(row).collect();
        let key = |row: &Price| row.cost.map_or(f64::INFINITY, |c| c.pairs);
        rows.sort_by(|a, b| key(a).total_cmp(&key(b)).then(a.least.total_cmp(&b.least)));
        Some(Self { of_stress: is_of_stress(quantity), label: quantity.label, target, rows })
    }

    /// The cheapest row of a remedy that reaches the target.
    pub(super) fn cheapest(&self, remedy: RemedyName) -> Option<&Price> {
        let mut reached = self.rows.iter().filter(|row| row.cost.is_some());
        reached.find(|row| row.scheme.remedy() == remedy)
    }

    /// Whether a remedy has been run, be it that it doesn't reach the target.
    pub(super) fn has(&self, remedy: RemedyName) -> bool {
        self.rows.iter().any(|row| row.scheme.remedy() == remedy)
    }

    /// How many times as many pairs as the cheapest, if both reach the target.
    pub(super) fn over_cheapest(&self, row: &Price) -> Option<f64> {
        let best = self.rows.first()?.cost?;
        Some(row.cost?.pairs / best.pairs)
    }

    /// How many times as many pairs as the cheapest, as shown.
    pub(super) fn relative(&self, row: &Price) -> String {
        let cheapest = self.rows.first();
        let Some((cost, best)) = row.cost.zip(cheapest.and_then(|r| r.cost)) else { return String::new() };
        // A bound on one makes a bound of the ratio, bounds on both an estimate.
        let bound = match (cost.at_most, best.at_most) {
            _ if cheapest == Some(row) => "",
            (true, false) => "≤ ",
            (false, true) => "≥ ",
            (true, true) => "~ ",
            (false, false) => "",
        };
        format!("{bound}{:.1}", cost.pairs / best.pairs)
    }

    /// Cheapest first.
    pub(super) fn table(&self) -> Sheet {
        let head = ["scheme", "particle–node pairs (10⁶)", "CPU time (s)", "× cheapest", "least error"];
        let row = |row: &Price| {
            let [pairs, cpu] = row.shown();
            vec![row.name(), pairs, cpu, self.relative(row), words::number(Some(rounded(row.least)))]
        };
        Sheet::new(head).with(self.rows.iter().map(row))
    }

    /// The target as shown.
    pub(super) fn aim(&self) -> String {
        words::number(Some(rounded(self.target)))
    }
}

impl Price {
    /// The scheme, what it was run with, and whether it is wrong there.
    pub(super) fn name(&self) -> String {
        let parts = std::iter::once(self.scheme.title()).chain(self.set.iter().cloned());
        let mark = self.is_wrong.then(|| words::shown(Outcome::WrongAsKnown)[0].to_owned());
        parts.chain(mark).collect::<Vec<_>>().join(" ")
    }

    /// Pairs (10⁶) and CPU time (s) as shown.
    pub(super) fn shown(&self) -> [String; 2] {
        let Some(cost) = self.cost else { return ["not reached".to_owned(), String::new()] };
        let bound = if cost.at_most { "≤ " } else { "" };
        let short = |value: f64| words::number(Some(value));
        [format!("{bound}{}", short(rounded(1e-6 * cost.pairs))), format!("{bound}{}", short(rounded(cost.cpu_s)))]
    }
}

/// To three digits.
fn rounded(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let unit = 10f64.powi(2 - value.abs().log10().floor() as i32);
    (value * unit).round() / unit
}

/// The cost of `target` on the way from coarse to fine, from where no finer level misses it: a coarse one that meets it by
/// luck doesn't count.
fn cost(points: &[Point], target: f64) -> Option<Cost> {
    let reached = points.iter().rposition(|p| p.value.abs() > target).map_or(0, |k| k + 1);
    if reached == points.len() {
        return None;
    }
    let fine = &points[reached];
    let Some(coarse) = reached.checked_sub(1).map(|k| &points[k]) else {
        return Some(Cost { pairs: fine.particle_node_pairs as f64, cpu_s: fine.cpu_s, at_most: true });
    };
    let log = |p: &Point| p.value.abs().max(f64::MIN_POSITIVE).ln();
    let share = (log(coarse) - target.ln()) / (log(coarse) - log(fine));
    let between = |a: f64, b: f64| a.powf(1.0 - share) * b.powf(share);
    Some(Cost {
        pairs: between(coarse.particle_node_pairs as f64, fine.particle_node_pairs as f64),
        cpu_s: between(coarse.cpu_s, fine.cpu_s),
        at_most: false,
    })
}

/// Whether an error is one of the stress.
fn is_of_stress(quantity: &Quantity) -> bool {
    quantity.metric.unit == "Pa"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Finding;
    use crate::record::fixture::record;
    use crate::report::fixture::{curve, point};
    use crate::scheme::BasisName;
    use crate::verdict::Kind;

    #[test]
    fn the_front_holds_what_none_beats() {
        let points = vec![(4.0, 0.1), (1.0, 0.5), (2.0, 0.5), (3.0, 0.2), (5.0, 0.15)];
        assert_eq!(front(points.clone(), 0.45), [(1.0, 0.5), (3.0, 0.2)]);
        let slow: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), 0.93f64.powi(k))).collect();
        assert_eq!(front(slow, 0.9).len(), 5, "small gains add up");
        let front = front(points, 1.0);
        assert_eq!(front, [(1.0, 0.5), (3.0, 0.2), (4.0, 0.1)]);
        let line = [(1.0, 0.5), (3.0, 0.5), (3.0, 0.2), (4.0, 0.2), (4.0, 0.1)];
        assert_eq!(steps(&front), line);
    }

    #[test]
    fn a_cost_is_interpolated_in_logarithms() {
        let points = [(100, -0.4), (1600, 0.1)].map(point);
        let half_way = cost(&points, 0.2).unwrap();
        assert!((half_way.pairs - 400.0).abs() < 1e-9 && !half_way.at_most);
        let coarse = cost(&points, 0.5).unwrap();
        assert!(coarse.at_most && coarse.pairs == 100.0);
        assert_eq!(cost(&points, 0.05), None);
        let lucky = [(100, 0.01), (800, 0.4), (6400, 0.1)].map(point);
        assert!(cost(&lucky, 0.2).unwrap().pairs > 800.0);
        assert_eq!(cost(&lucky[..2], 0.2), None);
    }

    /// A scheme costs what its cheapest curve costs; a bound on a cost is one on its ratio.
    #[test]
    fn the_cheapest_curve_of_a_scheme_counts() {
        let (coarse, fine) = ((100, 0.4), (1600, 0.1));
        let curves = [
            curve(RemedyName::None, &[], &[(400, 0.4), (6400, 0.1)]),
            curve(RemedyName::None, &["cfl=0.6"], &[coarse, fine]),
            curve(RemedyName::FbarRate, &[], &[fine, fine]),
            curve(RemedyName::FbarTotal, &[], &[coarse]),
        ];
        let quantity = crate::metric::error(crate::metric::metric("e", "-", ""), "error");
        // A run of the first that is wrong as known; the next is of the curve that costs more.
        let run = |remedy, set: &str| {
            let limit = Finding::above("e", 1.0, 0.5, "locks").verdict("locked", Kind::KnownLimit);
            let mut run = record("n8", vec![limit]);
            run.scheme = Scheme::flip(BasisName::Gimp, remedy);
            run.set = vec![set.to_owned()];
            run
        };
        let runs = [run(RemedyName::None, "cfl=0.6"), run(RemedyName::FbarRate, "cfl=0.6")];
        let prices = Prices::over(&curves.each_ref(), &quantity, &runs).unwrap();
        let told = prices.rows.iter().map(|row| format!("{} {}", row.name(), prices.relative(row)));
        let told: Vec<_> = told.collect();
        assert_eq!(told, ["gimp none cfl=0.6 ≈ 1.0", "gimp fbar-rate ≤ 1.0"]);
        assert_eq!(prices.target, 0.1);
    }

    #[test]
    fn numbers_are_shown_to_three_digits() {
        assert_eq!(rounded(12345.0), 12300.0);
        assert_eq!(rounded(0.0012345), 0.00123);
        assert_eq!(rounded(0.0), 0.0);
    }
}
