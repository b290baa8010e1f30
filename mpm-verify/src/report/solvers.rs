//! Cost of the errors of some problems, by explicit steps and by implicit ones of several lengths.

use super::prelude::*;
use crate::draw::{Dash, Marker};
use crate::figure::{Figure, Panel};
use crate::scheme::BasisName::{Bspline2, Gimp};
use crate::scheme::RemedyName::{FbarConsistent, None as Standard};
use crate::scheme::RuleName;

/// One curve each.
const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];

/// A problem, with the functions and the remedy to take for it, its title, the error that is compared and what this is called.
type Problem = (&'static str, (BasisName, RemedyName), &'static str, (&'static str, &'static str));

const MOTION: (&str, &str) = ("displacement_l2", "rms error of u (m)");

const PROBLEMS: [Problem; 4] = [
    ("mms-axis", (Bspline2, Standard), "A wave that steps follow (ν = 0.3)", MOTION),
    ("mms-vortex-box", (Gimp, FbarConsistent), "A vortex, slow beside its waves (ν = 0.4999)", MOTION),
    (
        "footing",
        (Gimp, FbarConsistent),
        "Clay under a footing, to its limit load (ν = 0.49)",
        ("prandtl_error", "error of N_c by B"),
    ),
    (
        "slope-stability",
        (Gimp, FbarConsistent),
        "A slope, its strength reduced until it fails",
        ("factor_error", "error of the factor"),
    ),
];

/// Which curve a run is on, if it is on any: explicit with the case's own step, or implicit with one of its own.
fn curve(r: &Record) -> Option<String> {
    let changed = r.set.join(" ");
    let name = match r.scheme().rule() {
        None if changed.is_empty() && r.transfer().to_string() == "flip" => "explicit",
        Some(RuleName::Midpoint) => "midpoint",
        Some(RuleName::Newmark) => "newmark",
        Some(RuleName::QuasiStatic) => "quasi-static",
        None => return None,
    };
    let steps = changed.is_empty() || (changed.starts_with("cfl=") && r.set.len() == 1);
    steps.then(|| format!("{name} {changed}").trim_end().to_owned())
}

fn panel<'a>(records: &'a [Record], (case, schemes, title, error): Problem) -> Panel<'a> {
    let own = |r: &Record| {
        let of_case = r.case == case && (r.basis(), r.remedy()) == schemes && r.time.cpu_s > 0.0;
        if of_case { curve(r) } else { None }
    };
    let runs = records.iter().filter_map(|r| Some((own(r)?, r)));
    let mut runs: Vec<(String, &Record)> = runs.collect();
    runs.sort_by(|a, b| a.0.cmp(&b.0));
    let point = |r: &Record| (r.time.cpu_s, r.value(error.0).abs());
    Panel::new(title, ["CPU time (s)", error.1])
        .log_x()
        .log_y()
        .points_by(runs.into_iter().map(|(_, r)| r), |r| curve(r).unwrap_or_default(), point)
        .least(2)
        .styled(|k, curve| Series {
            dash: match &*curve.name {
                "explicit" => Dash::Solid,
                _ => Dash::Dashed,
            },
            marker: MARKERS[k % MARKERS.len()],
            colour: k,
            ..curve
        })
}

/// Draws it, if there are such runs.
///
/// # Errors
/// The picture can't be written.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let panels = PROBLEMS.map(|problem| panel(gallery.records, problem));
    Figure::new("solvers", "", panels).columns(2).whole().draw(gallery)
}
