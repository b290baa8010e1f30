//! Convergence and work–precision of every case.

use super::price;
use crate::cases;
use crate::distinct;
use crate::draw::style::{Panel, Panels};
use crate::draw::{Chart, Dash, Marker, Scale, Series, SlopeTriangle};
use crate::error::Error;
use crate::files::{write_csv, write_json};
use crate::gallery::Picture;
use crate::metric::Quantity;
use crate::scheme::Scheme;
use crate::study::convergence::{Convergence, Point, precision};
use crate::study::summary::CaseStudy;
use std::collections::BTreeSet;
use std::path::Path;

/// The picture that shows times taken.
pub(super) const CPU_PICTURE: &str = "cpu-precision.png";
/// Likewise for what is no error.
pub(super) const CPU_VALUE_PICTURE: &str = "cpu-value.png";
/// What a run's error must be of that of its scheme's line so far for the line to go on to it: else runs with a smaller time
/// step, dearer and no better, would bend the line.
const GAIN: f64 = 0.9;
/// A value is far off the bulk if it lies farther than so many times the range of the middle half from that half.
const FAR: f64 = 10.0;
/// Margin of a range about the bulk, as a share of it.
const MARGIN: f64 = 0.05;
/// Colour of the front.
const FRONT: usize = 7;
/// Room between a slope triangle and the curves above it, as a ratio of errors.
const CLEARANCE: f64 = 1.3;
/// Width of a slope triangle, as a share of that of the curves.
const SHARE: f64 = 0.22;

/// Writes the numbers of the study and draws every error against cell size and every quantity of the case's own problem
/// against cost.
pub(super) fn draw(study: &CaseStudy, out: &Path) -> Result<Vec<Picture>, Error> {
    let folder = out.join(&study.case);
    write_json(&folder.join("study.json"), &study.convergence)?;
    write_points(&study.convergence, &folder.join("convergence.csv"))?;

    let case = cases::find(&study.case)?;
    let mut pictures = Vec::new();
    let mut draw = |diagram: &Diagram, name: &str, against: Against, caption: String| {
        let file = format!("{}/{name}", study.case);
        if diagram.draw(&out.join(&file), against)? {
            pictures.push(Picture { file, caption });
        }
        Ok::<(), Error>(())
    };
    let errors = || study.convergence.iter().filter(|c| c.is_error);
    for set in distinct(errors().map(|c| &c.set[..])) {
        let diagram = Diagram {
            entries: errors().filter(|c| c.set == set).collect(),
            quantities: &case.quantities,
        };
        let changed = if set.is_empty() {
            String::new()
        } else {
            format!(" with {}", set.join(", "))
        };
        let name = if set == case.ladder {
            "convergence.png".to_owned()
        } else if set.is_empty() {
            "convergence-own.png".to_owned()
        } else {
            format!("convergence-{}.png", slug(set))
        };
        let caption = format!(
            "Error against cell size{changed}, for every scheme, converging or not. Both axes are logarithmic; the triangle shows an order."
        );
        draw(&diagram, &name, Against::Size, caption)?;
    }
    let costs = precision(case, &study.records);
    let diagram = Diagram {
        entries: costs.iter().collect(),
        quantities: &case.quantities,
    };
    for (cost, error, value) in [
        (&PAIRS, "work-precision.png", "work-value.png"),
        (&TIME, CPU_PICTURE, CPU_VALUE_PICTURE),
    ] {
        let what = cost.what;
        let caption = format!(
            "Error against its cost in {what}. A line joins those runs of a scheme that are better by a tenth than the line so far, whatever their time step and number of particles per cell; dots are its other runs. The front of what no run of any scheme beats is the same in every panel of an error; rings mark the runs that make it."
        );
        draw(&diagram, error, Against::Cost(cost), caption)?;
        let caption = format!(
            "What has no exact value, against its cost in {what}: how soon each scheme settles, and where. Runs of another time step or number of particles per cell, and slices of a problem, are lines of their own; what lies far off the bulk is cut off."
        );
        draw(&diagram, value, Against::CostOfValues(cost), caption)?;
    }
    Ok(pictures)
}

/// The changed parameters as part of a file's name.
fn slug(set: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._+".contains(c);
    set.join("+").replace(|c| !plain(c), "-")
}

fn write_points(convergence: &[Convergence], path: &Path) -> Result<(), Error> {
    let header = [
        "quantity",
        "scheme",
        "changed",
        "level",
        "set",
        "h (m)",
        "value",
        "cpu_s (s)",
        "particle_node_pairs",
    ];
    let rows = convergence.iter().flat_map(|c| {
        c.points.iter().map(|p| {
            vec![
                c.metric.clone(),
                c.scheme.to_string(),
                c.set.join(" "),
                p.level.clone(),
                p.set.join(" "),
                p.h.to_string(),
                p.value.to_string(),
                p.cpu_s.to_string(),
                p.particle_node_pairs.to_string(),
            ]
        })
    });
    write_csv(path, &header.map(str::to_owned), rows)
}

/// What a run costs.
struct Cost {
    /// In words.
    what: &'static str,
    label: &'static str,
    of: fn(&Point) -> f64,
}

const PAIRS: Cost = Cost {
    what: "particle–node pairs visited",
    label: "particle–node pairs",
    of: |p| p.particle_node_pairs as f64,
};
const TIME: Cost = Cost {
    what: "CPU time (one thread)",
    label: "CPU time (s)",
    of: |p| p.cpu_s,
};

/// What is drawn against what.
#[derive(Clone, Copy)]
enum Against {
    /// Errors against cell size.
    Size,
    /// Errors against cost.
    Cost(&'static Cost),
    /// What is no error against cost.
    CostOfValues(&'static Cost),
}

/// The point at which a line ends and another of the same look begins.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

/// Quantities that share their axes.
struct Diagram<'a> {
    entries: Vec<&'a Convergence>,
    quantities: &'a [Quantity],
}

impl Diagram<'_> {
    /// Draws every quantity that has something to show; returns whether any has.
    fn draw(&self, path: &Path, against: Against) -> Result<bool, Error> {
        let schemes: BTreeSet<Scheme> = self.entries.iter().map(|c| c.scheme).collect();
        let errors = !matches!(against, Against::CostOfValues(_));
        let quantities = self.quantities.iter().filter(|q| q.is_error == errors);
        // A value has something to show once a scheme has two.
        let quantities = quantities.filter(|q| errors || self.of(q).any(|c| c.points.len() > 1));
        let chart = |quantity: &&Quantity, panel: &Panel| match against {
            Against::Size => self.by_size(quantity, panel),
            Against::Cost(cost) => self.error_by_cost(quantity, cost, panel),
            Against::CostOfValues(cost) => self.value_by_cost(quantity, cost, panel),
        };
        Ok(Panels::new(&schemes).draw(path, quantities, chart)?)
    }

    /// The curves of a quantity.
    fn of(&self, quantity: &Quantity) -> impl Iterator<Item = &Convergence> {
        let metric = quantity.metric.name;
        let own = self.entries.iter().filter(move |c| c.metric == metric);
        own.copied()
    }

    fn by_size(&self, quantity: &Quantity, panel: &Panel) -> Chart {
        let series = panel.curves(|scheme| {
            let own = self.of(quantity).filter(|c| c.scheme == scheme);
            own.flat_map(|c| positive(c, |p| p.h)).collect()
        });
        let orders = self
            .of(quantity)
            .filter(|c| panel.schemes.contains(&c.scheme))
            .filter_map(|c| Some(c.order.as_ref()?.order));
        let slope_triangle = typical_order(orders.collect())
            .and_then(|slope| below_the_curves(slope, series.iter().map(|s| &s.points[..])));
        Chart {
            slope_triangle,
            ..self.axes(quantity, "cell size h (m)", panel, series)
        }
    }

    fn error_by_cost(&self, quantity: &Quantity, cost: &Cost, panel: &Panel) -> Chart {
        let runs = |of: &dyn Fn(Scheme) -> bool| -> Vec<(f64, f64)> {
            let own = self.of(quantity).filter(|c| of(c.scheme));
            own.flat_map(|c| positive(c, cost.of)).collect()
        };
        let own = |scheme| runs(&|s| s == scheme);
        let dots = panel.curves(own).into_iter().map(|curve| Series {
            name: String::new(),
            marker: Marker::Dot,
            dash: Dash::None,
            ..curve
        });
        let curves = panel.curves(|scheme| price::front(own(scheme), GAIN));
        let front = price::front(runs(&|_| true), 1.0);
        let here = runs(&|s| panel.schemes.contains(&s));
        let line = Series::line("front", price::steps(&front), FRONT);
        let rings = Series {
            name: "on the front".to_owned(),
            points: front.into_iter().filter(|p| here.contains(p)).collect(),
            marker: Marker::Ring,
            dash: Dash::None,
            ..line.clone()
        };
        let series = [line].into_iter().chain(dots).chain(curves).chain([rings]);
        self.axes(quantity, cost.label, panel, series.collect())
    }

    fn value_by_cost(&self, quantity: &Quantity, cost: &Cost, panel: &Panel) -> Chart {
        let points = |c: &Convergence| -> Vec<(f64, f64)> {
            let points = c.points.iter().map(|p| ((cost.of)(p), p.value));
            points.filter(|(x, _)| *x > 0.0).collect()
        };
        let series = panel.curves(|scheme| {
            let own = self.of(quantity).filter(|c| c.scheme == scheme);
            let curves: Vec<Vec<_>> = own.map(points).collect();
            curves.join(&GAP)
        });
        let all = self.of(quantity).flat_map(points).map(|p| p.1).collect();
        Chart {
            y_scale: Scale::Linear,
            y_range: bulk(all),
            ..self.axes(quantity, cost.label, panel, series)
        }
    }

    /// A chart of `series`, with logarithmic axes.
    fn axes(&self, quantity: &Quantity, x: &str, panel: &Panel, series: Vec<Series>) -> Chart {
        let negative = |c: &Convergence| c.points.iter().any(|p| p.value < 0.0);
        let signed = quantity.is_error && self.of(quantity).any(negative);
        let labels = [x, &error_label(quantity, signed)];
        Chart {
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            ..Chart::new(panel.title.clone(), labels, series)
        }
    }
}

/// Where the bulk of `values` lies, with a margin, if others lie so far off that they would leave it no room.
fn bulk(mut values: Vec<f64>) -> Option<(f64, f64)> {
    values.sort_by(f64::total_cmp);
    let quartile = |k: usize| values.get(k * values.len() / 4).copied();
    let (lower, upper) = (quartile(1)?, quartile(3)?);
    let reach = FAR * (upper - lower);
    let near: Vec<f64> = values
        .iter()
        .copied()
        .filter(|v| (lower - reach..=upper + reach).contains(v))
        .collect();
    let (least, most) = (near.first()?, near.last()?);
    let margin = MARGIN * (most - least);
    (near.len() < values.len() && margin > 0.0).then_some((least - margin, most + margin))
}

/// The magnitudes of an error. One of zero has no logarithm.
fn positive(curve: &Convergence, of: fn(&Point) -> f64) -> impl Iterator<Item = (f64, f64)> {
    let points = curve.points.iter().map(move |p| (of(p), p.value.abs()));
    points.filter(|(x, y)| *x > 0.0 && *y > 0.0)
}

/// How the axis of an error is labelled on which its magnitude is drawn.
pub(super) fn error_label(quantity: &Quantity, signed: bool) -> String {
    if signed {
        format!("|{}|", quantity.label)
    } else {
        quantity.label.to_owned()
    }
}

/// The median of observed orders as a whole number, at least one; none where errors grow with refinement.
fn typical_order(mut orders: Vec<f64>) -> Option<f64> {
    orders.sort_by(f64::total_cmp);
    let median = orders.get(orders.len() / 2).filter(|m| **m > 0.0)?;
    Some(median.round().max(1.0))
}

/// A triangle at the right end, below every curve that passes there.
fn below_the_curves<'a>(
    slope: f64,
    curves: impl Iterator<Item = &'a [(f64, f64)]> + Clone,
) -> Option<SlopeTriangle> {
    let xs = || curves.clone().flatten().map(|p| p.0);
    let (least, most) = (xs().fold(f64::INFINITY, f64::min), xs().fold(0.0, f64::max));
    let decades = SHARE * (most / least).log10();
    if !(decades > 0.0 && decades.is_finite()) {
        return None;
    }
    let left = most / 10f64.powf(decades);
    let at_left = |pair: &[(f64, f64)]| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let share = (left / x0).ln() / (x1 / x0).ln();
        (0.0..=1.0)
            .contains(&share)
            .then(|| y0 * (y1 / y0).powf(share))
    };
    let crossing = curves
        .clone()
        .flat_map(|c| c.windows(2).filter_map(at_left));
    let inside = curves
        .clone()
        .flatten()
        .filter(|p| p.0 >= left)
        .map(|p| p.1);
    let lowest = crossing.chain(inside).fold(f64::INFINITY, f64::min);
    Some(SlopeTriangle {
        slope,
        at: (left, lowest / CLEARANCE / 10f64.powf(slope * decades)),
        decades,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{error, metric};
    use crate::scheme::{BasisName, RemedyName};
    use std::cell::RefCell;

    /// A curve of a scheme with GIMP through errors and the pairs that they cost.
    fn curve(remedy: RemedyName, runs: &[(u64, f64)]) -> Convergence {
        let point = |&(pairs, value): &(u64, f64)| Point {
            level: String::new(),
            set: Vec::new(),
            h: 1.0,
            value,
            cpu_s: 1.0,
            particle_node_pairs: pairs,
        };
        Convergence {
            set: Vec::new(),
            scheme: Scheme::flip(BasisName::Gimp, remedy),
            metric: "e".to_owned(),
            is_error: true,
            points: runs.iter().map(point).collect(),
            order: None,
            extrapolation: None,
            remark: None,
        }
    }

    /// Of two curves of a scheme the line joins what is clearly better than all that is cheaper; the front goes through the
    /// best runs of all.
    #[test]
    fn a_line_joins_what_its_scheme_does_best() {
        let curves = [
            curve(RemedyName::None, &[(10, 0.5), (100, 0.1)]),
            curve(RemedyName::None, &[(20, 0.6), (50, -0.2), (200, 0.099)]),
            curve(RemedyName::FbarRate, &[(40, 0.3), (400, 0.02)]),
        ];
        let diagram = Diagram {
            entries: curves.iter().collect(),
            quantities: &[],
        };
        let charts = RefCell::new(Vec::new());
        let folder = tempfile::tempdir().unwrap();
        let chart = |quantity: &Quantity, panel: &Panel| {
            let chart = diagram.error_by_cost(quantity, &PAIRS, panel);
            charts.borrow_mut().push(chart.clone());
            chart
        };
        let schemes = curves.iter().map(|c| c.scheme).collect();
        let picture = folder.path().join("a.png");
        let drawn =
            Panels::new(&schemes).draw(&picture, [error(metric("e", "-", ""), "error")], chart);
        assert!(drawn.unwrap() && picture.exists());
        let [chart] = &charts.borrow()[..] else {
            panic!("one panel");
        };
        let points = |name: &str| {
            let own = chart.series.iter().filter(|s| s.name.contains(name));
            own.map(|s| s.points.clone()).collect::<Vec<_>>()
        };
        assert_eq!(points("none"), [[(10.0, 0.5), (50.0, 0.2), (100.0, 0.1)]]);
        let best = [
            (10.0, 0.5),
            (40.0, 0.3),
            (50.0, 0.2),
            (100.0, 0.1),
            (200.0, 0.099),
            (400.0, 0.02),
        ];
        assert_eq!(points("on the front"), [best]);
        let dots = chart.series.iter().filter(|s| s.marker == Marker::Dot);
        assert_eq!(dots.map(|s| s.points.len()).collect::<Vec<_>>(), [5, 2]);
        assert_eq!(chart.y_label, "|error|");
    }

    #[test]
    fn what_is_no_error_keeps_its_sign_and_what_lies_far_off_is_cut_off() {
        let mut values = curve(RemedyName::None, &[(10, -0.2), (100, 4.0)]);
        values.is_error = false;
        let diagram = Diagram {
            entries: vec![&values],
            quantities: &[],
        };
        let quantity = Quantity {
            metric: metric("e", "-", ""),
            label: "run-out (m)",
            is_error: false,
        };
        let folder = tempfile::tempdir().unwrap();
        let chart = |quantity: &Quantity, panel: &Panel| {
            let chart = diagram.value_by_cost(quantity, &PAIRS, panel);
            assert_eq!(chart.y_label, "run-out (m)");
            assert_eq!(chart.series[0].points[0], (10.0, -0.2));
            chart
        };
        let schemes = [values.scheme].into();
        let drawn = Panels::new(&schemes).draw(&folder.path().join("a.png"), [quantity], chart);
        assert!(drawn.unwrap());
        assert_eq!(bulk(vec![1.0, 2.0, 3.0, 4.0]), None);
        let far = bulk(vec![1.0, 2.0, 3.0, 2.0, 4.0, 1.5, 2.5, 90.0]).unwrap();
        assert!((far.0 - 0.85).abs() < 1e-12 && (far.1 - 4.15).abs() < 1e-12);
    }

    #[test]
    fn changed_parameters_make_a_plain_name_of_a_file() {
        let slug = |set: &[&str]| slug(&set.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>());
        assert_eq!(slug(&["poisson_ratio=0.4999"]), "poisson_ratio-0.4999");
        assert_eq!(slug(&["load=-2", "wall=a/b"]), "load--2+wall-a-b");
    }

    #[test]
    fn the_triangle_lies_below_all_curves() {
        let steep = [(1.0, 0.1), (0.5, 0.025), (0.25, 0.006)];
        let flat = [(1.0, 0.04), (0.25, 0.03)];
        let triangle = below_the_curves(2.0, [&steep[..], &flat[..]].into_iter()).unwrap();
        let (left, bottom) = triangle.at;
        let right = left * 10f64.powf(triangle.decades);
        let top = bottom * (right / left).powi(2);
        assert!(
            (right - 1.0).abs() < 1e-12 && top < 0.04 / 1.2,
            "{triangle:?}"
        );
    }

    #[test]
    fn one_level_has_no_triangle_and_no_order_no_slope() {
        assert_eq!(below_the_curves(1.0, [&[(1.0, 0.1)][..]].into_iter()), None);
        assert_eq!(typical_order(Vec::new()), None);
        assert_eq!(typical_order(vec![0.2]), Some(1.0));
        assert_eq!(typical_order(vec![-0.2]), None);
        assert_eq!(typical_order(vec![-1.8, -0.3, 2.0]), None);
        assert_eq!(typical_order(vec![1.8, 2.3, -1.0]), Some(2.0));
    }
}
