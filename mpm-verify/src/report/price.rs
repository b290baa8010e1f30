//! What an error costs: the runs that no other beats, and the cost to reach a target error.

use super::describe;
use crate::cases;
use crate::convergence::{Convergence, Point};
use crate::scheme::Scheme;
use crate::study::CaseStudy;
use std::fmt::Write;

/// The points that no other beats in both cost and error, by rising cost, and the corners of the steps between them: no
/// point is below the line.
pub(super) fn front(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = points.collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for (cost, error) in points {
        let Some(&(_, best)) = front.last() else {
            front.push((cost, error));
            continue;
        };
        if error < best {
            front.extend([(cost, best), (cost, error)]);
        }
    }
    front
}

/// What a target error costs with every scheme.
#[derive(Debug, PartialEq)]
pub(super) struct Prices {
    /// The metric.
    pub(super) metric: String,
    /// What it is.
    pub(super) label: &'static str,
    /// The target: the least error that half of the schemes reach at one of their levels.
    pub(super) target: f64,
    /// Cheapest first, then those that don't reach it.
    pub(super) rows: Vec<Price>,
}

/// What a target error costs with a scheme.
#[derive(Debug, PartialEq)]
pub(super) struct Price {
    pub(super) scheme: Scheme,
    /// The least error that it has reached.
    pub(super) least: f64,
    /// Particle–node pairs and CPU time (s), if it has reached the target.
    pub(super) cost: Option<Cost>,
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
    /// Of the first error of a case at its own parameters, if two schemes have it at two levels.
    pub(super) fn of(study: &CaseStudy) -> Option<Self> {
        let case = cases::find(&study.case).ok()?;
        let quantity = case.quantities().iter().find(|q| q.is_error)?;
        let wanted = |c: &&Convergence| {
            c.metric == quantity.metric && c.set.is_empty() && c.points.len() > 1
        };
        let curves: Vec<&Convergence> = study.convergence.iter().filter(wanted).collect();
        if curves.len() < 2 {
            return None;
        }
        let mut reached: Vec<f64> = curves.iter().map(|c| least(c)).collect();
        reached.sort_by(f64::total_cmp);
        let target = reached[reached.len() / 2];
        let mut rows: Vec<Price> = curves
            .iter()
            .map(|c| Price {
                scheme: c.scheme,
                least: least(c),
                cost: cost(&c.points, target),
            })
            .collect();
        let key = |row: &Price| row.cost.map_or(f64::INFINITY, |c| c.pairs);
        rows.sort_by(|a, b| key(a).total_cmp(&key(b)).then(a.least.total_cmp(&b.least)));
        Some(Self {
            metric: quantity.metric.to_owned(),
            label: quantity.label,
            target,
            rows,
        })
    }

    /// How many times as many pairs as the cheapest, as shown.
    pub(super) fn relative(&self, row: &Price) -> String {
        let cheapest = self.rows.first().and_then(|r| r.cost);
        let ratio = row.cost.zip(cheapest).map(|(c, best)| c.pairs / best.pairs);
        ratio.map_or_else(String::new, |ratio| format!("{ratio:.1}"))
    }
}

impl Price {
    /// Pairs (10⁶) and CPU time (s) as shown.
    pub(super) fn shown(&self) -> [String; 2] {
        let Some(cost) = self.cost else {
            return ["not reached".to_owned(), String::new()];
        };
        let bound = if cost.at_most { "≤ " } else { "" };
        let short = |value: f64| describe::number(Some(value));
        [
            format!("{bound}{}", short(rounded(1e-6 * cost.pairs))),
            format!("{bound}{}", short(rounded(cost.cpu_s))),
        ]
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

fn least(c: &Convergence) -> f64 {
    let errors = c.points.iter().map(|p| p.value.abs());
    errors.fold(f64::INFINITY, f64::min)
}

/// The cost of `target` on the way from coarse to fine.
fn cost(points: &[Point], target: f64) -> Option<Cost> {
    let reached = points.iter().position(|p| p.value.abs() <= target)?;
    let fine = &points[reached];
    let Some(coarse) = reached.checked_sub(1).map(|k| &points[k]) else {
        return Some(Cost {
            pairs: fine.particle_node_pairs as f64,
            cpu_s: fine.cpu_s,
            at_most: true,
        });
    };
    let log = |p: &Point| p.value.abs().max(f64::MIN_POSITIVE).ln();
    let share = (log(coarse) - target.ln()) / (log(coarse) - log(fine));
    let between = |a: f64, b: f64| a.powf(1.0 - share) * b.powf(share);
    Some(Cost {
        pairs: between(
            coarse.particle_node_pairs as f64,
            fine.particle_node_pairs as f64,
        ),
        cpu_s: between(coarse.cpu_s, fine.cpu_s),
        at_most: false,
    })
}

/// The table in Markdown, if there is anything to compare.
pub(super) fn table(study: &CaseStudy) -> Option<String> {
    let prices = Prices::of(study)?;
    let mut t = format!(
        "\n### Cost of an error\n\nTo reach {} in `{}`, as half of the schemes do:\n\n| scheme | particle–node pairs (10⁶) | CPU time (s) | × cheapest | least error |\n|---|---|---|---|---|\n",
        describe::number(Some(rounded(prices.target))),
        prices.metric
    );
    for row in &prices.rows {
        let [pairs, cpu] = row.shown();
        let _ = writeln!(
            t,
            "| {} | {pairs} | {cpu} | {} | {} |",
            describe::scheme(row.scheme),
            prices.relative(row),
            describe::number(Some(rounded(row.least)))
        );
    }
    Some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(value: f64, pairs: u64) -> Point {
        Point {
            level: String::new(),
            set: Vec::new(),
            h: 1.0,
            value,
            cpu_s: 1e-6 * pairs as f64,
            particle_node_pairs: pairs,
        }
    }

    #[test]
    fn the_front_holds_what_none_beats() {
        let points = [(4.0, 0.1), (1.0, 0.5), (2.0, 0.5), (3.0, 0.2), (5.0, 0.15)];
        assert_eq!(
            front(points.into_iter()),
            [(1.0, 0.5), (3.0, 0.5), (3.0, 0.2), (4.0, 0.2), (4.0, 0.1)]
        );
    }

    #[test]
    fn a_cost_is_interpolated_in_logarithms() {
        let points = [point(-0.4, 100), point(0.1, 1600)];
        let half_way = cost(&points, 0.2).unwrap();
        assert!((half_way.pairs - 400.0).abs() < 1e-9 && !half_way.at_most);
        let coarse = cost(&points, 0.5).unwrap();
        assert!(coarse.at_most && coarse.pairs == 100.0);
        assert_eq!(cost(&points, 0.05), None);
    }

    #[test]
    fn numbers_are_shown_to_three_digits() {
        assert_eq!(rounded(12345.0), 12300.0);
        assert_eq!(rounded(0.0012345), 0.00123);
        assert_eq!(rounded(0.0), 0.0);
    }
}
