//! The pictures of the dam break: the paper's Figure 12, the flow against time, an animation.

use super::LADDER;
use super::parameters::{CFL, DURATION};
use super::reference::{TANK, front_curve, time_scale};
use crate::draw::style::{Markers, series};
use crate::draw::{
    Chart, Dash, FieldFigure, FieldPanel, Marker, Scale, Series, animate_fields, draw_charts,
    draw_fields, share_ranges,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::{Record, Status};
use crate::scheme::{BasisName, RemedyName, Scheme, TransferName};

const BASES: [(BasisName, &str); 2] = [
    (BasisName::Gimp, "GIMP"),
    (BasisName::Bspline2, "quadratic B-splines"),
];
/// From above: standard, the paper's, ours.
const SHOWN: [RemedyName; 3] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarConsistent,
];
const REMEDIES: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarTotal,
    RemedyName::FbarConsistent,
];
/// The paper's level, or else the one that a short tier has.
const PREFERRED: [&str; 2] = ["h0.25", "h0.5"];
/// The paper's times (s).
const TIMES: [f64; 4] = [0.4, 1.0, 1.5, 2.0];
/// Times (s) between frames of the animation, and between showing them (hundredths of a second).
const FRAME: f64 = 0.05;
const DELAY: u16 = 15;
/// Height (m) of what is drawn of the tank, and its outline (m).
const HEIGHT: f64 = 3.2;
const OUTLINE: [(f64, f64); 4] = [(0.0, HEIGHT), (0.0, 0.0), (TANK, 0.0), (TANK, HEIGHT)];
const WINDOW: ((f64, f64), (f64, f64)) = ((0.0, TANK), (0.0, HEIGHT));
/// Pressures (kPa) of the colour scale.
const PRESSURES: (f64, f64) = (0.0, 20.0);
const LEVELS: [&str; 4] = ["h0.0625", "h0.125", "h0.25", "h0.5"];

struct Runs<'a, 'b> {
    records: Vec<&'a Record>,
    gallery: &'b mut Gallery<'a>,
}

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let own = |r: &&Record| r.changes_none_but(&[CFL.name, DURATION.name]);
    let flip = |r: &&Record| r.status == Status::Ok && r.transfer() == TransferName::Flip;
    let mut records: Vec<&Record> = gallery.records.iter().filter(flip).filter(own).collect();
    records.sort_by_key(|r| r.set.len());
    let mut runs = Runs { records, gallery };
    for (basis, title) in BASES {
        runs.snapshots(basis, title)?;
        runs.flow(basis, title)?;
    }
    runs.animation()
}

impl Runs<'_, '_> {
    /// Of several the one that changes least.
    fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&Record> {
        self.records
            .iter()
            .find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level)
            .copied()
    }

    /// Our run among those that are compared over the levels.
    fn on_the_ladder(&self, basis: BasisName, level: &str) -> Option<&Record> {
        let ours = |r: &&&Record| (r.basis(), r.remedy()) == (basis, RemedyName::FbarConsistent);
        let mut own = self.records.iter().filter(ours).copied();
        own.find(|r| r.level == level && LADDER.iter().all(|set| r.set.iter().any(|s| s == set)))
    }

    /// The level at which the remedies are compared, if there is one that has all.
    fn level(&self, basis: BasisName) -> Option<&'static str> {
        let has_all = |level: &&str| {
            let has = |&remedy: &RemedyName| self.find(basis, remedy, level).is_some();
            SHOWN.iter().all(has)
        };
        PREFERRED.into_iter().find(has_all)
    }

    /// The water at `time` (s) in colours of its pressure, if the run has kept it.
    fn panel(
        &self,
        record: &Record,
        time: f64,
        title: String,
    ) -> Result<Option<FieldPanel>, Error> {
        let Some(table) = self.gallery.snapshot(record, time)? else {
            return Ok(None);
        };
        let visible = |(_, y): &(f64, f64)| *y <= HEIGHT;
        let kept: Vec<(usize, (f64, f64))> = (table.points("x", "y").into_iter())
            .enumerate()
            .filter(|(_, x)| visible(x))
            .collect();
        let pressure = table.column("pressure");
        Ok(Some(FieldPanel {
            title,
            values: kept.iter().map(|(k, _)| 1e-3 * pressure[*k]).collect(),
            points: kept.into_iter().map(|(_, x)| x).collect(),
            size: record.discretisation.h / f64::from(record.discretisation.ppc).sqrt(),
            outline: OUTLINE.to_vec(),
        }))
    }

    /// A column of panels, one for each of the remedies, if all have kept this time.
    fn column(
        &self,
        (basis, level): (BasisName, &str),
        time: f64,
    ) -> Result<Vec<FieldPanel>, Error> {
        let mut panels = Vec::new();
        for remedy in SHOWN {
            let name = match remedy {
                RemedyName::None => "standard".to_owned(),
                _ => remedy.to_string(),
            };
            let panel = match self.find(basis, remedy, level) {
                Some(record) => self.panel(record, time, format!("{name}, {time:.1} s"))?,
                None => None,
            };
            match panel {
                Some(panel) => panels.push(panel),
                None => return Ok(Vec::new()),
            }
        }
        Ok(panels)
    }

    fn figure(title: String, panels: Vec<FieldPanel>, columns: usize) -> FieldFigure {
        FieldFigure {
            title,
            panels,
            columns,
            range: PRESSURES,
            label: "pressure (kPa)".to_owned(),
            x_label: "x (m)".to_owned(),
            y_label: "y (m)".to_owned(),
            window: Some(WINDOW),
        }
    }

    fn snapshots(&mut self, basis: BasisName, of: &str) -> Result<(), Error> {
        let Some(level) = self.level(basis) else {
            return Ok(());
        };
        let mut columns = Vec::new();
        for time in TIMES {
            let column = self.column((basis, level), time)?;
            if !column.is_empty() {
                columns.push(column);
            }
        }
        if columns.is_empty() {
            return Ok(());
        }
        let count = columns.len();
        let panels = (0..SHOWN.len() * count)
            .map(|k| columns[k % count][k / count].clone())
            .collect();
        let file = format!("snapshots-{basis}.png");
        let figure = Self::figure(format!("{of}, h = {} m", &level[1..]), panels, count);
        draw_fields(&self.gallery.place(&file), &figure)?;
        self.gallery.hang(
            &file,
            format!("The water with {of} in colours of its pressure: standard MPM, the paper's F̄, ours. The paper's Figure 12 (data: snapshots of each run; jets above {HEIGHT} m are cut off)."),
        );
        Ok(())
    }

    fn animation(&mut self) -> Result<(), Error> {
        let Some(level) = self.level(BasisName::Gimp) else {
            return Ok(());
        };
        let mut frames = Vec::new();
        for k in 1.. {
            let column = self.column((BasisName::Gimp, level), f64::from(k) * FRAME)?;
            if column.is_empty() {
                break;
            }
            frames.push(Self::figure(String::new(), column, SHOWN.len()));
        }
        if frames.is_empty() {
            return Ok(());
        }
        animate_fields(&self.gallery.place("flow.png"), &frames, DELAY)?;
        self.gallery.hang(
            "flow.png",
            format!(
                "The flow with GIMP at h = {} m, a third of its speed: standard MPM, the paper's F̄, ours.",
                &level[1..]
            ),
        );
        Ok(())
    }

    /// A column of the series of a run against time (s).
    fn history(
        &self,
        record: &Record,
        column: &str,
        factor: f64,
    ) -> Result<Vec<(f64, f64)>, Error> {
        let table = self.gallery.table(record, "series.csv")?;
        let points = table.points("time", column);
        Ok(points.into_iter().map(|(t, v)| (t, factor * v)).collect())
    }

    /// Front, energy and forces against time: remedies at the paper's level, ours at all levels.
    fn flow(&mut self, basis: BasisName, of: &str) -> Result<(), Error> {
        let quantities = [
            ("front", 1.0, "front x (m)"),
            ("energy", 1e-3, "energy (kJ/m)"),
            ("front_force", 1e-3, "force on the front wall (kN/m)"),
        ];
        let Some(shared) = self.level(basis) else {
            return Ok(());
        };
        let (mut by_remedy, mut by_level) = (Vec::new(), Vec::new());
        for (column, factor, label) in quantities {
            let mut curves = Vec::new();
            for remedy in REMEDIES {
                if let Some(record) = self.find(basis, remedy, shared) {
                    let points = self.history(record, column, factor)?;
                    let mut curve = series(Scheme::flip(basis, remedy), points, Markers::None);
                    curve.name = remedy.to_string();
                    curves.push(curve);
                }
            }
            let title = format!("h = {} m", &shared[1..]);
            by_remedy.push(chart(&title, label, column, curves));
            let mut curves = Vec::new();
            for (colour, level) in LEVELS.into_iter().enumerate() {
                if let Some(record) = self.on_the_ladder(basis, level) {
                    curves.push(Series {
                        name: format!("h = {} m", &level[1..]),
                        points: self.history(record, column, factor)?,
                        colour,
                        marker: Marker::None,
                        dash: Dash::Solid,
                    });
                }
            }
            let title = format!("fbar-consistent, {}", LADDER.join(" "));
            by_level.push(chart(&title, label, column, curves));
        }
        let mut charts = [by_remedy, by_level].concat();
        if charts
            .iter()
            .all(|c| c.series.iter().all(|s| s.points.is_empty()))
        {
            return Ok(());
        }
        let file = format!("flow-{basis}.png");
        let path = self.gallery.place(&file);
        charts.retain(Chart::shows_something);
        let columns = quantities.len();
        for k in 0..columns {
            let mut pair: Vec<Chart> = charts.iter().skip(k).step_by(columns).cloned().collect();
            share_ranges(&path, &mut pair)?;
            for (chart, ranged) in charts.iter_mut().skip(k).step_by(columns).zip(pair) {
                *chart = ranged;
            }
        }
        (self.gallery).write_curves(&format!("flow-{basis}.csv"), &charts)?;
        draw_charts(&path, &charts, columns)?;
        self.gallery.hang(
            &file,
            format!("Front, energy (kinetic, potential, stress work) and force on the wall against time with {of}: above, all remedies at h = {} m; below, fbar-consistent at all levels with one CFL number. The inviscid front is drawn in; water at rest in the tank has 52.2 kJ/m and presses with 8.7 kN/m.", &shared[1..]),
        );
        Ok(())
    }
}

fn chart(title: &str, label: &str, column: &str, mut curves: Vec<Series>) -> Chart {
    if column == "front" {
        curves.push(Series {
            name: "inviscid".to_owned(),
            points: front_curve()
                .into_iter()
                .filter(|(t, _)| *t <= 1.05 * time_scale())
                .collect(),
            colour: 7,
            marker: Marker::Circle,
            dash: Dash::Dashed,
        });
    }
    Chart {
        title: title.to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: label.to_owned(),
        x_scale: Scale::Linear,
        y_scale: Scale::Linear,
        series: curves,
        reference_lines: Vec::new(),
        slope_triangle: None,
        x_range: None,
        y_range: None,
    }
}
