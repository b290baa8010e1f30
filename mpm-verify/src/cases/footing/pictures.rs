//! The pictures of the strip footing: the paper's Figures 8 and 10, and Prandtl's mechanism.

use super::own::own_runs;
use super::parameters::PENETRATION;
use super::reference::{EXACT, limit_curve, limit_uncertainty};
use crate::cases::pictures::{Exhibit, basis_title, remedy_title, spacing};
use crate::draw::{
    Chart, Dash, FieldFigure, FieldPanel, Marker, ReferenceLine, Series, draw_charts, share_ranges,
    signed,
};
use crate::error::Error;
use crate::gallery::Gallery;
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName};
use crate::table::Table;

const BASES: [BasisName; 2] = [BasisName::Gimp, BasisName::Bspline2];
const REMEDIES: [RemedyName; 4] = [
    RemedyName::None,
    RemedyName::FbarRecursive,
    RemedyName::FbarRate,
    RemedyName::FbarConsistent,
];
/// Finest first.
const LEVELS: [&str; 4] = ["b80", "b40", "b20", "b10"];
/// Largest pressure over strength drawn; and the range about Prandtl's that is drawn larger.
const MOST: f64 = 10.0;
const ABOUT: (f64, f64) = (4.8, 5.8);
/// What is drawn of the ground (m): so far to the right and down.
const NEAR: (f64, f64) = (2.5, 2.0);
/// Least mean normal stress (kPa) that is drawn.
const LEAST_STRESS: f64 = -0.6;
/// Decimal logarithm of the plastic strains drawn.
const STRAINS: (f64, f64) = (-5.0, -2.0);
/// The footing (m).
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.08), (0.0, 0.08)];

/// Draws everything there are runs for.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let shorter = |r: &&Record| r.changes_only(PENETRATION.name);
    let records = own_runs(gallery.records).into_iter();
    let records = records.chain(gallery.records.iter().filter(shorter));
    let mut runs = Exhibit::new(gallery, records);
    if runs.records.is_empty() {
        return Ok(());
    }
    curves(&mut runs)?;
    for basis in BASES {
        mean_stress(&mut runs, basis)?;
        mechanism(&mut runs, basis)?;
    }
    Ok(())
}

/// "h = B/20" of the level "b20".
fn level_title(level: &str) -> String {
    format!("h = B/{}", &level[1..])
}

fn curve(runs: &Exhibit, record: &Record) -> Result<Vec<(f64, f64)>, Error> {
    let points = runs.history(record, ["penetration", "pressure_over_strength"])?;
    // What rings at the start is inertia, and would hide the elastic branch.
    let shown = points.into_iter().filter(|(_, q)| *q <= MOST);
    Ok(shown.map(|(s, q)| (1e3 * s, q)).collect())
}

/// Above: standard and consistent at all levels, whole and about the limit load. Below: all remedies at one.
fn curves(runs: &mut Exhibit) -> Result<(), Error> {
    let (mut charts, mut all_remedies) = (Vec::new(), Vec::new());
    for basis in BASES {
        let mut curves = Vec::new();
        for (colour, level) in LEVELS.into_iter().enumerate() {
            for (remedy, dash) in [
                (RemedyName::None, Dash::Dotted),
                (RemedyName::FbarConsistent, Dash::Solid),
            ] {
                let points = match runs.find(basis, remedy, level) {
                    Some(record) => curve(runs, record)?,
                    None => Vec::new(),
                };
                let name = format!("{remedy} B/{}", &level[1..]);
                curves.push(Series {
                    dash,
                    ..Series::line(name, points, colour)
                });
            }
        }
        let title = basis_title(basis);
        charts.push(chart(runs, title.to_owned(), curves));
        if let Some(level) = runs.level(basis, &REMEDIES, &LEVELS) {
            let curves = runs.by_remedy((basis, level), &REMEDIES, |r| curve(runs, r))?;
            let title = format!("{title}, {}", level_title(level));
            all_remedies.push(chart(runs, title, curves));
        }
    }
    // A curve that no basis has needs no entry in the legend.
    for k in (0..2 * LEVELS.len()).rev() {
        if charts.iter().all(|c| c.series[k].points.is_empty()) {
            for chart in &mut charts {
                chart.series.remove(k);
            }
        }
    }
    charts.retain(Chart::shows_something);
    let bases = charts.len();
    all_remedies.retain(Chart::shows_something);
    charts.extend(all_remedies);
    if charts.is_empty() {
        return Ok(());
    }
    let (name, path) = ("load-settlement", runs.place("load-settlement"));
    share_ranges(&path, &mut charts)?;
    runs.gallery.write_curves("load-settlement.csv", &charts)?;
    let about = |chart: &Chart| Chart {
        y_range: Some(ABOUT),
        ..chart.clone()
    };
    let about: Vec<Chart> = charts.iter().take(bases).map(about).collect();
    charts.splice(bases..bases, about);
    draw_charts(&path, &charts, 2)?;
    runs.hang(
        name,
        "Pressure over undrained strength against penetration over the footing's width: above, standard MPM (dotted) and fbar-consistent (full) at all levels, whole and about the limit load; below, all remedies at one level; with Prandtl's limit load and, on ground of the full size, the finite elements of vanishing size. The paper's Figure 8.",
    );
    Ok(())
}

fn chart(runs: &Exhibit, title: String, mut curves: Vec<Series>) -> Chart {
    // Smaller ground is stiffer on the way to the same limit load.
    let full_size = |r: &&Record| r.changes_none_but(&[PENETRATION.name]);
    if runs.records.iter().all(full_size) {
        let points = limit_curve().into_iter().map(|(s, q)| (1e3 * s, q));
        let points = points.filter(|(s, _)| *s <= 4.0).collect();
        curves.push(Series {
            marker: Marker::Circle,
            dash: Dash::Dashed,
            ..Series::line(
                format!("finite elements, h → 0, ± {}", limit_uncertainty()),
                points,
                7,
            )
        });
    }
    Chart {
        reference_lines: vec![ReferenceLine {
            name: "2 + π".to_owned(),
            value: EXACT,
            band: None,
        }],
        y_range: Some((0.0, MOST)),
        ..Chart::new(title, ["s/B (10⁻³)", "q / s_u"], curves)
    }
}

fn panel(
    runs: &Exhibit,
    record: &Record,
    title: String,
    value: impl Fn(&Table, usize) -> f64,
) -> Result<FieldPanel, Error> {
    let table = runs.gallery.table(record, "particles.csv")?;
    let points = table.points("reference_x", "reference_y");
    let panel = FieldPanel {
        title,
        values: (0..points.len()).map(|k| value(&table, k)).collect(),
        points,
        size: spacing(record),
        outline: OUTLINE.to_vec(),
    };
    Ok(panel.showing(|(x, y)| x <= NEAR.0 && y >= -NEAR.1))
}

fn figure(title: String, panels: Vec<FieldPanel>, range: (f64, f64), label: &str) -> FieldFigure {
    FieldFigure {
        title,
        panels,
        columns: 2,
        range,
        label: label.to_owned(),
        window: None,
    }
}

fn mean_stress(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let remedies = [RemedyName::None, RemedyName::FbarConsistent];
    let Some(level) = runs.level(basis, &remedies, &LEVELS) else {
        return Ok(());
    };
    let mut panels = Vec::new();
    for remedy in remedies {
        if let Some(record) = runs.find(basis, remedy, level) {
            let kilopascals = |table: &Table, k: usize| 1e-3 * table.column("mean_stress")[k];
            panels.push(panel(runs, record, remedy_title(remedy), kilopascals)?);
        }
    }
    let of = basis_title(basis);
    let title = format!("{of}, {}", level_title(level));
    runs.fields(
        &format!("mean-stress-{basis}"),
        &figure(title, panels, signed(LEAST_STRESS), "mean normal stress (kPa)"),
        format!("Mean normal stress at the end with {of}: standard MPM against F̄. The paper's Figure 10 (data: particles.csv of each run)."),
    )
}

/// Velocity while the load stands still, and plastic strain.
fn mechanism(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let remedy = RemedyName::FbarConsistent;
    let level = runs.level(basis, &[remedy], &LEVELS);
    let Some(record) = level.and_then(|level| runs.find(basis, remedy, level)) else {
        return Ok(());
    };
    let of = basis_title(basis);
    let title = format!("{of}, {}", level_title(&record.level));
    let stroke = 0.25 * record.parameters.number(PENETRATION);
    let speed = |table: &Table, k: usize| {
        table.column("plateau_ux")[k].hypot(table.column("plateau_uy")[k]) / stroke
    };
    let strain = |table: &Table, k: usize| table.column("plastic_strain")[k].log10();
    let velocity = panel(runs, record, title.clone(), speed)?;
    let plastic = panel(runs, record, title, strain)?;
    runs.fields(
        &format!("velocity-{basis}"),
        &figure(
            "Prandtl's mechanism".to_owned(),
            vec![velocity],
            (0.0, 1.0),
            "|u| / |u of the footing|",
        ),
        format!("Displacement over the last quarter of the penetration over that of the footing, {remedy}, {of}: a wedge that sinks with the footing, a fan, a wedge that is pushed up, and ground at rest."),
    )?;
    runs.fields(
        &format!("plastic-strain-{basis}"),
        &figure(
            "Where the ground has yielded".to_owned(),
            vec![plastic],
            STRAINS,
            "log₁₀ of the equivalent plastic strain",
        ),
        format!("Equivalent plastic strain at the end, {remedy}, {of}: the bands along which Prandtl's wedges slide."),
    )
}
