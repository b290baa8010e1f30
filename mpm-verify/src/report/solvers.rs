//! Cost of the errors of some problems, by explicit steps and by implicit ones of several lengths.

use super::prelude::*;
use super::rivals::{PROBLEMS, Problem};
use crate::draw::{Dash, Marker};
use crate::figure::{Figure, Panel};
use crate::scheme::RuleName;

/// One curve each.
const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];

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

fn panel<'a>(records: &'a [Record], problem: &Problem) -> Option<Panel<'a>> {
    let title = problem.panel?;
    let own = |r: &Record| {
        let of_case = r.case == problem.case && (r.basis(), r.remedy()) == problem.schemes && r.time.cpu_s > 0.0;
        if of_case { curve(r) } else { None }
    };
    let mut runs: Vec<(String, &Record)> = records.iter().filter_map(|r| Some((own(r)?, r))).collect();
    runs.sort_by(|a, b| a.0.cmp(&b.0));
    let (name, error) = problem.motion;
    let point = |r: &Record| (r.time.cpu_s, r.value(error).abs());
    let panel = Panel::new(title, ["CPU time (s)", &format!("error of {name}")])
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
        });
    Some(panel)
}

/// Draws it, if there are such runs.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let panels = PROBLEMS.iter().filter_map(|problem| panel(gallery.records, problem));
    Figure::new("solvers", "", panels).columns(2).whole().draw(gallery)
}
