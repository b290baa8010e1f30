//! Cost of the errors of some problems, by explicit steps and by implicit ones of several lengths.

use super::prelude::*;
use super::rivals::{Problem, problems};

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
    let title = problem.panel.as_ref()?;
    let own = |r: &&Record| problem.has(r) && r.time.cpu_s > 0.0 && curve(r).is_some();
    let mut runs: Vec<&Record> = records.iter().filter(own).collect();
    runs.sort_by_cached_key(|r| curve(r));
    let point = |r: &Record| (r.time.cpu_s, problem.error(r));
    let panel = Panel::new(title, ["CPU time (s)", &format!("error of {}", problem.motion.0)])
        .log_x()
        .log_y()
        .points_by(runs, |r| curve(r).unwrap_or_default(), point)
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
    let problems = problems()?;
    let panels = problems.iter().filter_map(|problem| panel(gallery.records, problem));
    Figure::new("solvers", "", panels).columns(2).whole().draw(gallery)
}
