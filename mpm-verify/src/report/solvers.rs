//! What the errors of some problems cost, by explicit steps and by implicit ones of several lengths.

use crate::draw::{Chart, Dash, Marker, Scale, Series, draw_charts};
use crate::error::Error;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName};
use std::collections::BTreeMap;
use std::path::Path;

/// File of the picture, without its ending.
pub(super) const NAME: &str = "solvers";
/// One curve each.
const MARKERS: [Marker; 4] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
];

/// A problem, with the functions and the remedy to take for it.
struct Problem {
    case: &'static str,
    basis: BasisName,
    remedy: RemedyName,
    title: &'static str,
    /// What is compared, and what it is called.
    error: (&'static str, &'static str),
}

const MOTION: (&str, &str) = ("displacement_l2", "rms error of u (m)");

const PROBLEMS: [Problem; 4] = [
    Problem {
        case: "mms-axis",
        basis: BasisName::Bspline2,
        remedy: RemedyName::None,
        title: "A wave that steps follow (ν = 0.3)",
        error: MOTION,
    },
    Problem {
        case: "mms-vortex-box",
        basis: BasisName::Gimp,
        remedy: RemedyName::FbarConsistent,
        title: "A vortex, slow beside its waves (ν = 0.4999)",
        error: MOTION,
    },
    Problem {
        case: "footing",
        basis: BasisName::Gimp,
        remedy: RemedyName::FbarConsistent,
        title: "Clay under a footing, to its limit load (ν = 0.49)",
        error: ("prandtl_error", "error of N_c by B"),
    },
    Problem {
        case: "slope-stability",
        basis: BasisName::Gimp,
        remedy: RemedyName::FbarConsistent,
        title: "A slope, its strength reduced until it fails",
        error: ("factor_error", "error of the factor"),
    },
];

impl Problem {
    /// Which curve a run is on, if it is on any: explicit with the case's own step, or implicit with one of its own.
    fn curve(&self, r: &Record) -> Option<String> {
        let own = r.case == self.case && r.basis() == self.basis && r.remedy() == self.remedy;
        let changed = r.set.join(" ");
        let name = match r.scheme().rule() {
            None if changed.is_empty() && r.transfer().to_string() == "flip" => "explicit",
            Some(RuleName::Midpoint) => "midpoint",
            Some(RuleName::Newmark) => "newmark",
            Some(RuleName::QuasiStatic) => "quasi-static",
            None => return None,
        };
        let steps = changed.is_empty() || (changed.starts_with("cfl=") && r.set.len() == 1);
        (own && steps).then(|| format!("{name} {changed}").trim_end().to_owned())
    }

    fn chart(&self, records: &[Record]) -> Chart {
        let mut curves: BTreeMap<String, Vec<(f64, f64)>> = BTreeMap::new();
        for r in records.iter().filter(|r| r.time.cpu_s > 0.0) {
            if let Some(name) = self.curve(r) {
                let point = (r.time.cpu_s, r.value(self.error.0).abs());
                curves.entry(name).or_default().push(point);
            }
        }
        curves.retain(|_, points| points.len() > 1);
        let series = curves
            .into_iter()
            .enumerate()
            .map(|(k, (name, mut points))| {
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                Series {
                    dash: if name == "explicit" {
                        Dash::Solid
                    } else {
                        Dash::Dashed
                    },
                    marker: MARKERS[k % MARKERS.len()],
                    colour: k,
                    name,
                    points,
                }
            });
        Chart {
            title: self.title.to_owned(),
            x_label: "CPU time (s)".to_owned(),
            y_label: self.error.1.to_owned(),
            x_scale: Scale::Log10,
            y_scale: Scale::Log10,
            series: series.collect(),
            reference_lines: Vec::new(),
            slope_triangle: None,
            x_range: None,
            y_range: None,
        }
    }
}

/// Draws it into `out`, if there are such runs.
///
/// # Errors
/// The picture can't be written.
pub(super) fn draw(records: &[Record], out: &Path) -> Result<(), Error> {
    let charts = PROBLEMS.map(|problem| problem.chart(records));
    if charts.iter().all(Chart::shows_something) {
        draw_charts(&out.join(format!("{NAME}.png")), &charts, 2)?;
    }
    Ok(())
}
