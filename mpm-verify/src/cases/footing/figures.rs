//! The figures of the strip footing: the paper's Figures 8 and 10, and Prandtl's mechanism.

use super::reference::{limit_curve, limit_uncertainty};
use super::*;

/// Finest first.
const LEVELS: [&str; 4] = ["b80", "b40", "b20", "b10"];
/// Largest pressure over strength drawn; and the range about Prandtl's that is drawn larger.
const MOST: f64 = 10.0;
const ABOUT: (f64, f64) = (4.8, 5.8);
/// Part of the ground (m) that is drawn: to the right and down.
const NEAR: (f64, f64) = (2.5, 2.0);
/// Least mean normal stress (kPa) that is drawn.
const LEAST_STRESS: f64 = -0.6;
/// Decimal logarithm of the plastic strains drawn.
const STRAINS: (f64, f64) = (-5.0, -2.0);
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.08), (0.0, 0.08)];

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let shorter = |r: &&Record| r.changes_only("penetration");
    let records = own_runs(gallery.records).into_iter();
    let records = records.chain(gallery.records.iter().filter(shorter));
    let mut runs = Exhibit::new(gallery, records);
    if runs.records.is_empty() {
        return Ok(());
    }
    curves(&mut runs)?;
    for basis in SMOOTH {
        mean_stress(&mut runs, basis)?;
        mechanism(&mut runs, basis)?;
    }
    Ok(())
}

/// "h = B/20" of the level "b20".
fn level_title(level: &str) -> String {
    format!("h = B/{}", &level[1..])
}

/// Pressure over strength over penetration. What rings at the start is inertia, and would hide the elastic branch.
fn load(_: &Record, series: &Table) -> Vec<(f64, f64)> {
    let mut points = series.pairs(["penetration", "pressure_over_strength"], |s, q| (1e3 * s, q));
    points.retain(|(_, q)| *q <= MOST);
    points
}

/// Above: standard and consistent at the finest levels, whole and about the limit load. Below: all remedies at one.
fn curves(runs: &mut Exhibit) -> Result<(), Error> {
    let remedies = [RemedyName::None, FbarConsistent];
    // A curve that no basis has needs no entry in the legend.
    let has = |remedy, level: &str| SMOOTH.iter().any(|&basis| runs.find(basis, remedy, level).is_some());
    let (mut whole, mut by_remedy) = (Vec::new(), Vec::new());
    for basis in SMOOTH {
        let title = basis_title(basis);
        let mut panel = panel_of_loads(title.to_owned());
        let levels = LEVELS.into_iter().filter(|level| remedies.iter().any(|r| has(*r, level)));
        for (level, dash) in levels.zip(LEVEL_DASHES) {
            for remedy in remedies.into_iter().filter(|r| has(*r, level)) {
                let name = format!("{} B/{}", remedy_title(remedy), &level[1..]);
                let line = |points| Series { name: name.clone(), dash, ..history(Scheme::flip(basis, remedy), points) };
                panel = match runs.find(basis, remedy, level) {
                    Some(record) => panel.histories(runs.gallery, [record], load)?.styled(|_, s| line(s.points)),
                    None => panel.curve(line(Vec::new())),
                };
            }
        }
        whole.push(with_elements(runs, panel));
        if let Some(level) = runs.level(basis, &COMPARED, &LEVELS) {
            let all = COMPARED.iter().filter_map(|r| runs.find(basis, *r, level));
            let panel = panel_of_loads(format!("{title}, {}", level_title(level)))
                .histories(runs.gallery, all, load)?
                .by_run(|r, s| Series { name: remedy_title(r.remedy()), ..s });
            by_remedy.push(with_elements(runs, panel));
        }
    }
    let about: Vec<Panel> = whole.iter().map(|p| p.zoomed(ABOUT.0, ABOUT.1)).collect();
    Figure::new(
        "load-settlement",
        "Pressure over undrained strength against penetration over the footing's width: above, standard MPM and fbar-consistent at the finest levels (full: the finest), whole and about the limit load; below, all remedies at one level; with Prandtl's limit load and, on ground of the full size, the finite elements of vanishing size. The paper's Figure 8.",
        whole.into_iter().chain(about).chain(by_remedy),
    )
    .columns(2)
    .share_axes()
    .draw(runs.gallery)
}

fn panel_of_loads<'a>(title: String) -> Panel<'a> {
    Panel::new(title, ["s/B (10⁻³)", "q / s_u"]).y_range(0.0, MOST).level(ReferenceLine {
        name: "2 + π".to_owned(),
        value: EXACT,
        band: None,
    })
}

/// The curve of vanishing elements beside. Smaller ground is stiffer on the way to the same limit load.
fn with_elements<'a>(runs: &Exhibit, panel: Panel<'a>) -> Panel<'a> {
    if !runs.records.iter().all(|r| r.changes_none_but(&["penetration"])) {
        return panel;
    }
    let points = limit_curve().into_iter().map(|(s, q)| (1e3 * s, q));
    let name = format!("finite elements, h → 0, ± {}", limit_uncertainty());
    panel.reference(name, points.filter(|(s, _)| *s <= 4.0).collect())
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

fn mean_stress(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let remedies = [RemedyName::None, FbarConsistent];
    let Some(level) = runs.level(basis, &remedies, &LEVELS) else { return Ok(()) };
    let kilopascals = |table: &Table, k: usize| 1e-3 * table.column("mean_stress")[k];
    let found = remedies.into_iter().filter_map(|remedy| runs.find(basis, remedy, level));
    let panels = found.map(|r| panel(runs, r, remedy_title(r.remedy()), kilopascals)).collect::<Result<_, Error>>()?;
    let of = basis_title(basis);
    let title = format!("{of}, {}", level_title(level));
    Fields::new(panels, "mean normal stress (kPa)", signed(LEAST_STRESS)).titled(title).draw(
        runs.gallery,
        &format!("mean-stress-{basis}"),
        format!("Mean normal stress at the end with {of}: standard MPM against F̄. The paper's Figure 10 (data: particles.csv of each run)."),
    )
}

/// Velocity while the load stands still, and plastic strain.
fn mechanism(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let remedy = FbarConsistent;
    let level = runs.level(basis, &[remedy], &LEVELS);
    let Some(record) = level.and_then(|level| runs.find(basis, remedy, level)) else { return Ok(()) };
    let of = basis_title(basis);
    let title = format!("{of}, {}", level_title(&record.level));
    let stroke = 0.25 * Setup::<Footing>::number_of(record, |c| c.penetration);
    let speed = |table: &Table, k: usize| table.column("plateau_ux")[k].hypot(table.column("plateau_uy")[k]) / stroke;
    let strain = |table: &Table, k: usize| table.column("plastic_strain")[k].log10();
    let velocity = panel(runs, record, title.clone(), speed)?;
    let plastic = panel(runs, record, title, strain)?;
    Fields::new(vec![velocity], "|u| / |u of the footing|", (0.0, 1.0)).titled("Prandtl's mechanism".to_owned()).draw(
        runs.gallery,
        &format!("velocity-{basis}"),
        format!("Displacement over the last quarter of the penetration over that of the footing, {remedy}, {of}: a wedge that sinks with the footing, a fan, a wedge that is pushed up, and ground at rest."),
    )?;
    let caption =
        format!("Equivalent plastic strain at the end, {remedy}, {of}: the bands along which Prandtl's wedges slide.");
    let yielded = Fields::new(vec![plastic], "log₁₀ of the equivalent plastic strain", STRAINS);
    let yielded = yielded.titled("Where the ground has yielded".to_owned());
    yielded.draw(runs.gallery, &format!("plastic-strain-{basis}"), caption)
}
