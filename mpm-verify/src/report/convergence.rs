//! Convergence and work–precision of every case.

use super::Picture;
use super::plot::{Chart, Dash, Marker, Scale, Series, SlopeTriangle};
use super::price;
use super::style::{Panel, Panels};
use crate::case::Quantity;
use crate::cases;
use crate::convergence::{Convergence, Point, precision};
use crate::distinct;
use crate::error::Error;
use crate::files::{write_csv, write_json};
use crate::scheme::Scheme;
use crate::study::CaseStudy;
use std::collections::BTreeSet;
use std::path::Path;

/// The picture that shows work done.
const PAIRS_PICTURE: &str = "work-precision.png";
/// The picture that shows times taken.
pub(super) const CPU_PICTURE: &str = "cpu-precision.png";
/// Colour of the front.
const FRONT: usize = 7;
/// Room between a slope triangle and the curves above it, as a ratio of errors.
const CLEARANCE: f64 = 1.3;
/// Width of a slope triangle, as a share of that of the curves.
const SHARE: f64 = 0.22;

/// Writes the numbers of the study and draws every error against cell size and, at the case's own
/// parameters, against cost.
pub(super) fn draw(study: &CaseStudy, out: &Path) -> Result<Vec<Picture>, Error> {
    let folder = out.join(&study.case);
    write_json(&folder.join("study.json"), &study.convergence)?;
    write_points(&study.convergence, &folder.join("convergence.csv"))?;

    let case = cases::find(&study.case)?;
    let costs = precision(case, &study.records);
    let errors = || study.convergence.iter().filter(|c| c.is_error);
    let mut pictures = Vec::new();
    let mut draw = |entries: Vec<&Convergence>, name: &str, axis: &Axis, caption: String| {
        let quantities = case.quantities();
        let errors = Errors {
            entries,
            quantities,
        };
        let file = format!("{}/{name}", study.case);
        if errors.draw(&out.join(&file), axis)? {
            pictures.push(Picture { file, caption });
        }
        Ok::<(), Error>(())
    };
    for set in distinct(errors().map(|c| &c.set[..])) {
        let entries = errors().filter(|c| c.set == set).collect();
        if set.is_empty() {
            draw(
                entries,
                "convergence.png",
                &SIZE,
                "Error against cell size, for every scheme, converging or not. Both axes are logarithmic; the triangle shows an order.".to_owned(),
            )?;
            for (file, axis, cost) in [
                (PAIRS_PICTURE, &PAIRS, "particle–node pairs visited"),
                (CPU_PICTURE, &TIME, "CPU time (one thread)"),
            ] {
                draw(
                    costs.iter().filter(|c| c.is_error).collect(),
                    file,
                    axis,
                    format!(
                        "Error against its cost in {cost}, for every scheme, converging or not. Runs of another time step or number of particles per cell are curves of their own, of the same look. The front of what no run of any scheme beats is the same in every panel of an error."
                    ),
                )?;
            }
        } else {
            draw(
                entries,
                &format!("convergence-{}.png", slug(set)),
                &SIZE,
                format!("Error against cell size with {}, likewise.", set.join(", ")),
            )?;
        }
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

/// What errors are drawn against.
struct Axis {
    label: &'static str,
    of: fn(&Point) -> f64,
    /// Whether a slope is an order, which a triangle shows.
    order: bool,
}

const SIZE: Axis = Axis {
    label: "cell size h (m)",
    of: |p| p.h,
    order: true,
};
const PAIRS: Axis = Axis {
    label: "particle–node pairs",
    of: |p| p.particle_node_pairs as f64,
    order: false,
};
const TIME: Axis = Axis {
    label: "CPU time (s)",
    of: |p| p.cpu_s,
    order: false,
};

/// The point at which a line ends and another of the same look begins.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

/// Errors that share their axes.
struct Errors<'a> {
    entries: Vec<&'a Convergence>,
    quantities: &'a [Quantity],
}

impl Errors<'_> {
    /// Draws every error that has something to show; returns whether any has.
    fn draw(&self, path: &Path, axis: &Axis) -> Result<bool, Error> {
        let schemes: BTreeSet<Scheme> = self.entries.iter().map(|c| c.scheme).collect();
        let chart = |quantity: &&Quantity, panel: &Panel| self.chart(quantity, axis, panel);
        Ok(Panels::new(&schemes).draw(path, self.quantities, chart)?)
    }

    fn chart(&self, quantity: &Quantity, axis: &Axis, panel: &Panel) -> Chart {
        let of_quantity = || self.entries.iter().filter(|c| c.metric == quantity.metric);
        let points_of = |c: &Convergence| -> Vec<(f64, f64)> {
            let points = c.points.iter().map(|p| ((axis.of)(p), p.value.abs()));
            // An error of zero has no logarithm.
            points.filter(|(x, y)| *x > 0.0 && *y > 0.0).collect()
        };
        let series = panel.curves(|scheme| {
            let own = of_quantity().filter(|c| c.scheme == scheme);
            let curves: Vec<_> = own.map(|c| points_of(c)).collect();
            curves.join(&GAP)
        });
        let front = (!axis.order).then(|| Series {
            name: "front".to_owned(),
            points: price::front(of_quantity().flat_map(|c| points_of(c))),
            colour: FRONT,
            marker: Marker::None,
            dash: Dash::Solid,
        });
        let orders = of_quantity()
            .filter(|c| panel.schemes.contains(&c.scheme))
            .filter_map(|c| Some(c.order.as_ref()?.order));
        let slope_triangle = typical_order(orders.collect())
            .filter(|_| axis.order)
            .and_then(|slope| below_the_curves(slope, series.iter().map(|s| &s.points[..])));
        let signed = of_quantity().any(|c| c.points.iter().any(|p| p.value < 0.0));
        Chart {
            title: panel.title.clone(),
            x_label: axis.label.to_owned(),
            y_label: error_label(quantity, signed),
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            series: front.into_iter().chain(series).collect(),
            reference_lines: Vec::new(),
            slope_triangle,
            x_range: None,
            y_range: None,
        }
    }
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
