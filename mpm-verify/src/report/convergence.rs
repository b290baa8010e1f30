//! Convergence and work–precision of every case.

use super::price;
use crate::cases;
use crate::distinct;
use crate::draw::style::{Panel, Panels};
use crate::draw::{Chart, Dash, Marker, ReferenceLine, Scale, Series, SlopeTriangle};
use crate::error::Error;
use crate::files::{write_csv, write_json};
use crate::gallery::Picture;
use crate::metric::Quantity;
use crate::scheme::Scheme;
use crate::study::convergence::{Convergence, Point, precision};
use crate::study::summary::CaseStudy;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The picture that shows times taken.
pub(super) const CPU_PICTURE: &str = "cpu-precision.png";
/// What a run's error must be of that of its scheme's line so far for the line to go on to it: else runs with a smaller time
/// step, dearer and no better, would bend the line.
const GAIN: f64 = 0.9;
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
        let files = diagram.draw(&out.join(&file), against)?;
        pictures.extend(Picture::of_files(&study.case, files, &caption));
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
            "Error against cell size{changed}, for every scheme, converging or not. Both axes are logarithmic; a triangle shows the order that theory gives, a dashed line the uncertainty of the reference."
        );
        draw(&diagram, &name, Against::Size, caption)?;
    }
    let costs = precision(case, &study.records);
    let diagram = Diagram {
        entries: costs.iter().collect(),
        quantities: &case.quantities,
    };
    for (cost, name) in [(&PAIRS, "work-precision.png"), (&TIME, CPU_PICTURE)] {
        let what = cost.what;
        let caption = format!(
            "Error against its cost in {what}. Each line joins a scheme's best runs at rising cost, each at least a tenth more accurate than the last, whatever their time step and number of particles per cell; dots are its other runs. The grey staircase is the front over all schemes, the same in every panel of an error; runs on it are ringed."
        );
        draw(&diagram, name, Against::Cost(cost), caption)?;
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
}

/// Quantities that share their axes.
struct Diagram<'a> {
    entries: Vec<&'a Convergence>,
    quantities: &'a [Quantity],
}

impl Diagram<'_> {
    /// Draws every quantity that has something to show; returns the files.
    fn draw(&self, path: &Path, against: Against) -> Result<Vec<PathBuf>, Error> {
        let schemes: BTreeSet<Scheme> = self.entries.iter().map(|c| c.scheme).collect();
        let quantities = self.quantities.iter().filter(|q| q.is_error);
        let chart = |quantity: &&Quantity, panel: &Panel| match against {
            Against::Size => self.by_size(quantity, panel),
            Against::Cost(cost) => self.error_by_cost(quantity, cost, panel),
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
        let slope_triangle = quantity
            .order
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

    /// A chart of `series`, with logarithmic axes.
    fn axes(&self, quantity: &Quantity, x: &str, panel: &Panel, series: Vec<Series>) -> Chart {
        let negative = |c: &Convergence| c.points.iter().any(|p| p.value < 0.0);
        let signed = self.of(quantity).any(negative);
        let labels = [x, &error_label(quantity, signed)];
        let uncertainty = quantity.uncertainty.map(|value| ReferenceLine {
            name: "uncertainty of the reference".to_owned(),
            value,
            band: None,
        });
        Chart {
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            reference_lines: uncertainty.into_iter().collect(),
            ..Chart::new(panel.title.clone(), labels, series)
        }
    }
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

/// A triangle at the right end, below every curve that passes there.
pub(super) fn below_the_curves<'a>(
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
        assert!(drawn.unwrap() == [picture.clone()] && picture.exists());
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
    fn one_level_has_no_triangle() {
        assert_eq!(below_the_curves(1.0, [&[(1.0, 0.1)][..]].into_iter()), None);
    }
}
