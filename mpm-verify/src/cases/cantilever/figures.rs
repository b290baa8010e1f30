//! Figures of the cantilever, after those of the paper.

use super::*;

/// Range of σ_xx that is drawn (Pa).
const STRESS_RANGE: f64 = 4e4;
/// The paper's choices without its soft stiffness.
const UNSTABLE: [&str; 3] = ["law=jaumann-linear", "points=gauss", "stabilisation=none"];
/// Colour of values that the paper prints.
const FROM_PAPER: usize = 7;
/// Displacement (m) of the paper's corner at 4 kN/m³.
const CORNER_OF_PAPER: [f64; 2] = [-0.38, -0.61];

pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    beams(gallery)?;
    charts(gallery)
}

/// The beam by quadratic splines, and by the paper's elements and choices: its Figure 2.
fn beams(gallery: &mut Gallery) -> Result<(), Error> {
    let shown: [(_, _, _, &[&str]); 2] =
        [(Bspline2, "quadratic splines", "h0.05", &[]), (Q8, "serendipity elements", "h0.1", &PAPER)];
    let mut panels = Vec::new();
    for (basis, title, level, set) in shown {
        let of = |r: &&Record| r.basis() == basis && r.level == level && r.set == set && r.status == Status::Ok;
        let Some(record) = gallery.records.iter().find(of) else { return Ok(()) };
        let table = gallery.table(record, "particles.csv")?;
        let [from, to] = [STRESS_MIN, STRESS_MAX].map(|m| fixed(1).text(1e-3 * record.metric(m)));
        panels.push(FieldPanel {
            outline: vec![(0.0, 0.0), (LENGTH, 0.0), (LENGTH, DEPTH), (0.0, DEPTH)],
            ..field_panel(record, &table, format!("{title}: {from}…{to} kPa"), "stress_xx")
        });
    }
    Fields::new(panels, "σ_xx (Pa)", (-STRESS_RANGE, STRESS_RANGE)).draw(gallery, "beams", "The beam at 4 kN/m³ and where it began, σ_xx: at h = 0.05 m, and at h = 0.1 m with the paper's elements, points, soft stiffness and linear update. Its Figure 2 tells of −40.8…27.6 kPa at the points and, extrapolated, −47.5…32.0 kPa at the nodes, where its finite elements have −47.4…32.6 kPa.")
}

/// Value of the parameter `name`, the `default` where it is not set, of a run with serendipity elements at h = 0.1 m and the
/// paper's other choices.
fn of_paper<'a>(r: &'a Record, name: &str, default: &'a str) -> Option<&'a str> {
    let value = |s: &'a String| s.strip_prefix(name)?.strip_prefix('=');
    let changed = r.set.iter().find_map(value);
    let others = r.set.iter().filter(|s| value(s).is_none());
    let own = r.basis() == Q8 && r.level == "h0.1";
    (own && others.eq(PAPER.iter())).then(|| changed.unwrap_or(default))
}

/// Displacement over weight for shares of soft stiffness and for numbers of particles: the paper's Figures 3 and 4.
fn paths<'a>(gallery: &Gallery<'a>) -> Result<Vec<Panel<'a>>, Error> {
    fn factor(r: &Record) -> Option<String> {
        let none = r.basis() == Q8 && r.set == UNSTABLE;
        let value = of_paper(r, "stabilisation_factor", "0.01");
        value.map(|value| format!("soft stiffness {value}")).or_else(|| none.then(|| "none: stops".to_owned()))
    }
    fn points(r: &Record) -> Option<String> {
        let number: u32 = of_paper(r, "points_per_direction", "4")?.parse().ok()?;
        Some(format!("{} particles a cell", number * number))
    }
    type Name = fn(&Record) -> Option<String>;
    let x = ("edge_mean_ux", "edge mean u_x (m)", 0);
    let y = ("edge_mean_uy", "edge mean u_y (m)", 1);
    let figures: [(&str, Name, _); 3] = [("Figure 3", factor, y), ("Figure 4a", points, x), ("Figure 4b", points, y)];
    let default = gallery.records.iter().find(|r| r.is_default());
    let panel = |(title, name_of, (column, label, axis)): (&str, Name, (&str, &str, usize))| {
        let runs = gallery.records.iter().filter(|r| name_of(r).is_some());
        let mut panel = Panel::new(title, ["weight (kN/m³)", label])
            .histories(gallery, runs, |_, t| {
                [vec![(0.0, 0.0)], t.pairs(["weight", column], |weight, u| (1e-3 * weight, u))].concat()
            })?
            .styled(|k, curve| Series { colour: k, ..curve })
            .by_run(|r, curve| {
                let marker = if r.status == Status::Ok { Marker::None } else { Marker::Cross };
                Series { name: name_of(r).unwrap_or_default(), marker, dash: Dash::Solid, ..curve }
            })
            .curve(Series {
                name: "corner, as the paper prints it".to_owned(),
                points: vec![(4.0, CORNER_OF_PAPER[axis])],
                colour: FROM_PAPER,
                marker: Marker::Diamond,
                dash: Dash::None,
            });
        let setup = default.and_then(|r| Setup::<Cantilever>::of_record(r).ok());
        if let Some(known) = setup.and_then(|c| c.solution().ok())
            && let Some(mean) = known.right_edge_mean
        {
            panel = panel.level(ReferenceLine::known_to("finite elements (Hencky)", mean[axis], known.uncertainty));
        }
        Ok(panel)
    };
    figures.into_iter().map(panel).collect()
}

/// The error of the corner's u_y (%) over `x`, a curve for every basis, of the runs of which `own` holds.
fn errors<'a>(
    gallery: &Gallery<'a>,
    label: &str,
    x: impl Fn(&Record) -> f64,
    own: impl Fn(&Record) -> bool,
) -> Panel<'a> {
    [Linear, Gimp, Bspline2, Bspline3, Q8].into_iter().fold(
        Panel::new("", [label, "error of the corner's u_y (%)"]).log_x().log_y(),
        |panel, basis| {
            let runs = gallery.records.iter().filter(|r| r.basis() == basis && r.status == Status::Ok && own(r));
            panel
                .points_by(runs, |r| r.basis().to_string(), |r| (x(r), 100.0 * r.metric(CORNER_ERROR)))
                .styled(|_, curve| Series { colour: basis as usize, ..curve })
        },
    )
}

/// Whether a run has the stabilisation of its basis: serendipity elements the soft stiffness.
fn is_held(r: &Record) -> bool {
    let soft: &[&str] = if r.basis() == Q8 { &["stabilisation=soft"] } else { &[] };
    r.set.iter().filter(|s| !s.starts_with("load_steps")).eq(soft)
}

/// The paper's Figures 3 and 4, the convergence that explains them, and that over load steps.
fn charts(gallery: &mut Gallery) -> Result<(), Error> {
    let steps = |r: &Record| Setup::<Cantilever>::number_of(r, |c| f64::from(c.load_steps));
    let mut panels = paths(gallery)?;
    let twenty = |r: &Record| is_held(r) && steps(r) == 20.0;
    panels.push(errors(gallery, "cell size (m)", |r| r.discretisation.h, twenty));
    panels.push(errors(gallery, "load steps", steps, |r| is_held(r) && r.level == "h0.05"));
    let caption = "The paper's elements, points and linear update at h = 0.1 m, 20 load steps: mean displacement of the right side over the weight, for shares of soft stiffness (its Figure 3; without any the run stops) and numbers of particles (its Figure 4). It prints where the corner goes, (−0.38, −0.61) m. Below, what explains them: the error of the corner's u_y against the finite elements, over the cell size with 20 load steps, and over the load steps at h = 0.05 m. Serendipity elements do not converge.";
    Figure::new("figures", caption, panels).columns(2).draw(gallery)
}
