//! Figures of Cook's membrane: the state of rest, its convergence, and the way there.

use super::*;
use reference::Measure;

/// The mean normal stress is drawn between plus and minus this (Pa); the reference reaches 0.127 Pa
/// away from the corners.
const STRESS_RANGE: f64 = 0.15;
const BASES: [BasisName; 3] = [Gimp, Bspline2, Bspline3];
const OUTLINE: [(f64, f64); 4] = [(0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0)];

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let mut runs = Exhibit::new(gallery, own_runs(gallery.records));
    for basis in BASES {
        fields(&mut runs, basis)?;
    }
    displacement(&mut runs)?;
    rest(&mut runs)
}

fn fields(runs: &mut Exhibit, basis: BasisName) -> Result<(), Error> {
    let mut panels = Vec::new();
    let has = |level: &&str| runs.records.iter().any(|r| r.basis() == basis && r.level == **level);
    let levels: Vec<&str> = ["h0.5", "h1", "h2"].into_iter().filter(has).take(2).collect();
    for level in levels.into_iter().rev() {
        for remedy in [RemedyName::None, FbarConsistent] {
            let Some(record) = runs.find(basis, remedy, level) else { continue };
            let table = runs.gallery.table(record, "particles.csv")?;
            let title = format!("{}, h = {} m", remedy_title(remedy), record.discretisation.h);
            let outline = OUTLINE.to_vec();
            panels.push(FieldPanel { outline, ..field_panel(record, &table, title, "mean_stress") });
        }
    }
    let title = basis_title(basis);
    let caption =
        format!("Mean normal stress at rest with {title}: standard MPM against F̄ (data: particles.csv of each run).");
    Fields::new(panels, "mean normal stress (Pa)", (-STRESS_RANGE, STRESS_RANGE))
        .titled(format!("Cook's membrane at rest, {title}"))
        .draw(runs.gallery, &format!("mean-stress-{basis}"), caption)
}

/// Displacement over the cell size, of the schemes that come to rest.
fn displacement(runs: &mut Exhibit) -> Result<(), Error> {
    let panel = |title: &str, measure: Measure| {
        let [metric, error] = measure.metrics();
        let panel = Panel::new(title, ["cell size h (m)", "u_y (m)"])
            .log_x()
            .points_of(pairs(&BASES, &[RemedyName::None, FbarTotal, FbarRate, FbarConsistent]), &runs.records, |r| {
                (r.discretisation.h, r.metric(metric))
            })
            .least(1);
        let reference = runs.records.iter().find_map(|r| {
            let exact = r.metric(metric) / (1.0 + r.metric(error));
            let uncertainty = Setup::<Cook>::of_record(r).ok()?.solution().ok()?.uncertainty_displacement;
            exact.is_finite().then(|| ReferenceLine::known_to("FEM reference", exact, uncertainty))
        });
        reference.into_iter().fold(panel, Panel::level)
    };
    let both = [panel("Middle of the right side", Measure::MidEdge), panel("Upper right corner", Measure::Tip)];
    let caption = "Vertical displacement at rest of the middle of the right side and of its upper corner, against the FEM reference.";
    Figure::new("displacement", caption, both).whole().draw(runs.gallery)
}

/// Approach to rest at the finest level that all remedies have run with GIMP.
fn rest(runs: &mut Exhibit) -> Result<(), Error> {
    let Some(level) = runs.level(Gimp, &REMEDIES, &["h1", "h2"]) else { return Ok(()) };
    let panel = |title: &str, label: &str, column: &str, remedies: &[RemedyName]| {
        let shown = remedies.iter().filter_map(|remedy| runs.find(Gimp, *remedy, level));
        let panel = Panel::new(title, ["time (s)", label]);
        let panel = panel.histories(runs.gallery, shown, |_, t| t.points("time", column))?;
        Ok::<_, Error>(panel.by_run(|r, s| Series { name: remedy_title(r.remedy()), ..s }))
    };
    let both = [
        panel("Tip", "u_y (m)", "tip_uy", &REMEDIES)?,
        panel("True against averaged Jacobian", "rms ln(J / averaged J)", "log_jacobian_gap_rms", &REMEDIES[1..])?,
    ];
    let caption =
        format!("Approach to rest with GIMP at {level}: the recursive F̄ creeps and never rests, the others stop.");
    Figure::new("rest", caption, both).whole().draw(runs.gallery)
}
