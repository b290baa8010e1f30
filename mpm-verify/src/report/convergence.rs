//! Convergence and work–precision of every case.

use super::errors::{Entry, Errors};
use super::prelude::*;
use super::price;
use crate::draw::ReferenceLine;
use crate::draw::style::Panel;
use crate::figure::below_the_curves;

/// The picture that shows times taken.
pub(super) const CPU_PICTURE: &str = "cpu-precision.png";
/// Largest ratio of a run's error to the error so far on its scheme's line for the line to go on to it: otherwise runs
/// with a smaller time step, dearer and no better, would bend the line.
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
    let all = || study.convergence.iter().filter(|c| c.is_error);
    for set in distinct(all().map(|c| &c.set[..])) {
        let changed = if set.is_empty() { String::new() } else { format!(" with {}", set.join(", ")) };
        let name = match set {
            _ if set == case.ladder => "convergence.png".to_owned(),
            [] => "convergence-own.png".to_owned(),
            _ => format!("convergence-{}.png", slug(set)),
        };
        let caption = format!(
            "Error against cell size{changed}, for every scheme, converging or not. Both axes are logarithmic; a triangle shows the order that theory gives, a dashed line the uncertainty of the reference."
        );
        let errors = errors(all().filter(|c| c.set == set), "cell size h (m)", |p| p.h);
        let finish = |quantity: &Quantity, _: &Panel, chart: Chart| {
            let curves = || chart.series.iter().map(|s| &s.points[..]);
            let slope_triangle = quantity.order.and_then(|slope| below_the_curves(slope, curves()));
            Chart { slope_triangle, ..with_uncertainty(quantity, chart) }
        };
        pictures.extend(errors.draw(case, (&name, &caption), out, finish)?);
    }
    let costs = precision(case, &study.records);
    for (name, what, label, cost) in COSTS {
        let caption = format!(
            "Error against its cost in {what}. Each line joins a scheme's best runs at rising cost, each at least a tenth more accurate than the last, whatever their time step and number of particles per cell; dots are its other runs. The grey staircase is the front over all schemes, the same in every panel of an error; runs on it are ringed."
        );
        let errors = errors(costs.iter(), label, cost);
        let finish = |q: &Quantity, panel: &Panel, chart| by_cost(&errors, q, panel, chart);
        pictures.extend(errors.draw(case, (name, &caption), out, finish)?);
    }
    Ok(pictures)
}

/// Quantities by level, each under a name, with their orders.
pub(super) fn by_level(case: &Case, own: &[&Convergence], (title, name): (&str, fn(&Convergence) -> String)) -> Sheet {
    let mut levels = distinct(own.iter().flat_map(|c| &c.points).map(|p| &*p.level));
    levels.sort_by_key(|level| case.levels.iter().position(|l| l.name == *level));
    let row = |c: &&Convergence| {
        let value =
            |level: &&str| c.points.iter().find(|p| p.level == *level).map_or(String::new(), |p| number(Some(p.value)));
        [name(c)].into_iter().chain(levels.iter().map(value).chain([order(c), local_orders(c)])).collect()
    };
    let head = [title].into_iter().chain(levels.iter().copied());
    Sheet::new(head.chain(["order", "between levels"])).with(own.iter().map(row))
}

/// The changed parameters as part of a file's name.
fn slug(set: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._+".contains(c);
    set.join("+").replace(|c| !plain(c), "-")
}

fn write_points(convergence: &[Convergence], path: &Path) -> Result<(), Error> {
    let header =
        ["quantity", "scheme", "changed", "level", "set", "h (m)", "value", "cpu_s (s)", "particle_node_pairs"];
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

/// A measure of cost: file of the picture, in words, label of the axis, and value at a point.
type Cost = (&'static str, &'static str, &'static str, fn(&Point) -> f64);

const COSTS: [Cost; 2] = [
    ("work-precision.png", "particle–node pairs visited", "particle–node pairs", |p| p.particle_node_pairs as f64),
    (CPU_PICTURE, "CPU time (one thread)", "CPU time (s)", |p| p.cpu_s),
];

fn errors<'a>(curves: impl Iterator<Item = &'a Convergence>, label: &'static str, x: fn(&Point) -> f64) -> Errors<'a> {
    let entry = |c: &'a Convergence| {
        let (scheme, metric) = (c.scheme, &*c.metric);
        c.points.iter().map(move |p| Entry { scheme, metric, x: x(p), value: p.value })
    };
    Errors { entries: curves.flat_map(entry).collect(), label, is_logarithmic: true }
}

fn with_uncertainty(quantity: &Quantity, chart: Chart) -> Chart {
    let uncertainty = quantity.uncertainty.map(|value| ReferenceLine {
        name: "uncertainty of the reference".to_owned(),
        value,
        band: None,
    });
    Chart { reference_lines: uncertainty.into_iter().collect(), ..chart }
}

/// The runs of the schemes of a panel as dots, their best ones joined, and the front over all schemes.
fn by_cost(errors: &Errors, quantity: &Quantity, panel: &Panel, chart: Chart) -> Chart {
    let dots = chart.series.iter().cloned().map(|curve| Series {
        name: String::new(),
        marker: Marker::Dot,
        dash: Dash::None,
        ..curve
    });
    let curves = chart.series.iter().cloned().map(|curve| Series { points: price::front(curve.points, GAIN), ..curve });
    let front = price::front(errors.points(quantity, |_| true), 1.0);
    let here = errors.points(quantity, |s| panel.schemes.contains(&s));
    let line = Series::line("front", price::steps(&front), FRONT);
    let rings = Series {
        name: "on the front".to_owned(),
        points: front.into_iter().filter(|p| here.contains(p)).collect(),
        marker: Marker::Ring,
        dash: Dash::None,
        ..line.clone()
    };
    let series = [line].into_iter().chain(dots).chain(curves).chain([rings]).collect();
    with_uncertainty(quantity, Chart { series, ..chart })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{error, metric};
    use crate::record::fixture::changed;
    use crate::report::fixture::curve;
    use crate::scheme::RemedyName;

    /// With two curves of a scheme the line joins points that are clearly better than all cheaper ones; the front goes
    /// through the best runs of all.
    #[test]
    fn a_line_joins_what_its_scheme_does_best() {
        let curves = [
            curve(RemedyName::None, &[], &[(10, 0.5), (100, 0.1)]),
            curve(RemedyName::None, &[], &[(20, 0.6), (50, -0.2), (200, 0.099)]),
            curve(RemedyName::FbarRate, &[], &[(40, 0.3), (400, 0.02)]),
        ];
        let errors = errors(curves.iter(), COSTS[0].2, COSTS[0].3);
        let quantity = error(metric("e", "-", ""), "error");
        let schemes = distinct(curves.iter().map(|c| c.scheme));
        let panel = Panel { title: String::new(), schemes };
        let chart = by_cost(&errors, &quantity, &panel, errors.chart(&quantity, &panel));
        let points = |name: &str| {
            let own = chart.series.iter().filter(|s| s.name.contains(name));
            own.map(|s| s.points.clone()).collect::<Vec<_>>()
        };
        assert_eq!(points("none"), [[(10.0, 0.5), (50.0, 0.2), (100.0, 0.1)]]);
        let best = [(10.0, 0.5), (40.0, 0.3), (50.0, 0.2), (100.0, 0.1), (200.0, 0.099), (400.0, 0.02)];
        assert_eq!(points("on the front"), [best]);
        let dots = chart.series.iter().filter(|s| s.marker == Marker::Dot);
        assert_eq!(dots.map(|s| s.points.len()).collect::<Vec<_>>(), [5, 2]);
        assert_eq!(chart.y_label, "|error|");
    }

    #[test]
    fn changed_parameters_make_a_plain_name_of_a_file() {
        let slug = |set: &[&str]| slug(&changed(set));
        assert_eq!(slug(&["poisson_ratio=0.4999"]), "poisson_ratio-0.4999");
        assert_eq!(slug(&["load=-2", "wall=a/b"]), "load--2+wall-a-b");
    }
}
