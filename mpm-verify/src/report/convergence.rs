//! Convergence and work–precision of every case.

use super::price;
use crate::cases;
use crate::distinct;
use crate::draw::style::{Panel, Panels};
use crate::draw::{Chart, Dash, Marker, ReferenceLine, Scale, Series};
use crate::error::Error;
use crate::figure::{Points, below_the_curves};
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
/// What a run's error must be of that of its scheme's line so far for the line to go on to it: else runs with a smaller time
/// step, dearer and no better, would bend the line.
const GAIN: f64 = 0.9;
/// Colour of the front.
const FRONT: usize = 7;

/// Writes the numbers of the study and draws every error against cell size and every quantity of the case's own problem
/// against cost.
pub(super) fn draw(study: &CaseStudy, out: &Path) -> Result<Vec<Picture>, Error> {
    let folder = out.join(&study.case);
    write_json(&folder.join("study.json"), &study.convergence)?;
    write_points(&study.convergence, &folder.join("convergence.csv"))?;

    let case = cases::find(&study.case)?;
    let mut pictures = Vec::new();
    let errors = || study.convergence.iter().filter(|c| c.is_error);
    for set in distinct(errors().map(|c| &c.set[..])) {
        let (changed, name) = match (set.is_empty(), set == case.ladder) {
            (true, true) => (String::new(), "convergence.png".to_owned()),
            (true, false) => (String::new(), "convergence-own.png".to_owned()),
            (false, is_ladder) => (
                format!(" with {}", set.join(", ")),
                match is_ladder {
                    true => "convergence.png".to_owned(),
                    false => format!("convergence-{}.png", slug(set)),
                },
            ),
        };
        let caption = format!(
            "Error against cell size{changed}, for every scheme, converging or not. Both axes are logarithmic; a triangle shows the order that theory gives, a dashed line the uncertainty of the reference."
        );
        let entries: Vec<&Convergence> = errors().filter(|c| c.set == set).collect();
        let schemes = entries.iter().map(|c| c.scheme).collect();
        let chart = |q: &&Quantity, panel: &Panel| by_size(&entries, q, panel);
        pictures.extend(draw_errors(study, &schemes, chart, (&name, &caption), out)?);
    }
    let costs = precision(case, &study.records);
    let costs: Vec<&Convergence> = costs.iter().collect();
    let schemes = costs.iter().map(|c| c.scheme).collect();
    for cost in [&PAIRS, &TIME] {
        let caption = format!(
            "Error against its cost in {}. Each line joins a scheme's best runs at rising cost, each at least a tenth more accurate than the last, whatever their time step and number of particles per cell; dots are its other runs. The grey staircase is the front over all schemes, the same in every panel of an error; runs on it are ringed.",
            cost.what
        );
        let chart = |q: &&Quantity, panel: &Panel| by_cost(&costs, q, cost, panel);
        pictures.extend(draw_errors(
            study,
            &schemes,
            chart,
            (cost.file, &caption),
            out,
        )?);
    }
    Ok(pictures)
}

/// Draws a row of panels for every error of a case that has something to show.
pub(super) fn draw_errors(
    study: &CaseStudy,
    schemes: &BTreeSet<Scheme>,
    chart: impl Fn(&&Quantity, &Panel) -> Chart,
    (name, caption): (&str, &str),
    out: &Path,
) -> Result<Vec<Picture>, Error> {
    let errors = cases::find(&study.case)?
        .quantities
        .iter()
        .filter(|q| q.is_error);
    let place = out.join(&study.case).join(name);
    let files = Panels::new(schemes).draw(&place, errors, chart)?;
    Ok(Picture::of_files(&study.case, files, caption))
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
    file: &'static str,
    /// In words.
    what: &'static str,
    label: &'static str,
    of: fn(&Point) -> f64,
}

const PAIRS: Cost = Cost {
    file: "work-precision.png",
    what: "particle–node pairs visited",
    label: "particle–node pairs",
    of: |p| p.particle_node_pairs as f64,
};
const TIME: Cost = Cost {
    file: CPU_PICTURE,
    what: "CPU time (one thread)",
    label: "CPU time (s)",
    of: |p| p.cpu_s,
};

/// The sizes of an error of some schemes. One of zero has no logarithm.
fn points(
    entries: &[&Convergence],
    quantity: &Quantity,
    x: fn(&Point) -> f64,
    is_shown: impl Fn(Scheme) -> bool,
) -> Points {
    let own = entries
        .iter()
        .filter(|c| c.metric == quantity.metric.name && is_shown(c.scheme));
    let points = own.flat_map(|c| &c.points).map(|p| (x(p), p.value.abs()));
    points.filter(|(x, y)| *x > 0.0 && *y > 0.0).collect()
}

fn by_size(entries: &[&Convergence], quantity: &Quantity, panel: &Panel) -> Chart {
    let series = panel.curves(|scheme| points(entries, quantity, |p| p.h, |s| s == scheme));
    let curves = || series.iter().map(|s| &s.points[..]);
    let slope_triangle = quantity
        .order
        .and_then(|slope| below_the_curves(slope, curves()));
    Chart {
        slope_triangle,
        ..chart(entries, quantity, "cell size h (m)", panel, series)
    }
}

fn by_cost(entries: &[&Convergence], quantity: &Quantity, cost: &Cost, panel: &Panel) -> Chart {
    let own = |scheme| points(entries, quantity, cost.of, |s| s == scheme);
    let dots = panel.curves(own).into_iter().map(|curve| Series {
        name: String::new(),
        marker: Marker::Dot,
        dash: Dash::None,
        ..curve
    });
    let curves = panel.curves(|scheme| price::front(own(scheme), GAIN));
    let front = price::front(points(entries, quantity, cost.of, |_| true), 1.0);
    let here = points(entries, quantity, cost.of, |s| panel.schemes.contains(&s));
    let line = Series::line("front", price::steps(&front), FRONT);
    let rings = Series {
        name: "on the front".to_owned(),
        points: front.into_iter().filter(|p| here.contains(p)).collect(),
        marker: Marker::Ring,
        dash: Dash::None,
        ..line.clone()
    };
    let series = [line].into_iter().chain(dots).chain(curves).chain([rings]);
    chart(entries, quantity, cost.label, panel, series.collect())
}

fn chart(
    entries: &[&Convergence],
    quantity: &Quantity,
    x: &str,
    panel: &Panel,
    series: Vec<Series>,
) -> Chart {
    let own = entries.iter().filter(|c| c.metric == quantity.metric.name);
    let has_sign = own.flat_map(|c| &c.points).any(|p| p.value < 0.0);
    let uncertainty = quantity.uncertainty.map(|value| ReferenceLine {
        name: "uncertainty of the reference".to_owned(),
        value,
        band: None,
    });
    Chart {
        x_scale: Scale::Log10,
        reference_lines: uncertainty.into_iter().collect(),
        ..error_chart(quantity, has_sign, x, panel, series)
    }
}

/// Curves of the size of an error on a logarithmic axis.
pub(super) fn error_chart(
    quantity: &Quantity,
    has_sign: bool,
    x: &str,
    panel: &Panel,
    series: Vec<Series>,
) -> Chart {
    let label = match has_sign {
        true => format!("|{}|", quantity.label),
        false => quantity.label.to_owned(),
    };
    Chart {
        y_scale: Scale::Log10,
        ..Chart::new(panel.title.clone(), [x, &label], series)
    }
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
        let entries: Vec<&Convergence> = curves.iter().collect();
        let charts = RefCell::new(Vec::new());
        let folder = tempfile::tempdir().unwrap();
        let chart = |quantity: &Quantity, panel: &Panel| {
            let chart = by_cost(&entries, quantity, &PAIRS, panel);
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
}
