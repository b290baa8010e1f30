//! Pictures of several cases, a panel each: those that pages of cases share.

use super::convergence::below_the_curves;
use crate::case::Case;
use crate::cases;
use crate::draw::style::series;
use crate::draw::{Chart, Dash, ReferenceLine, Scale, Series, draw_charts};
use crate::error::Error;
use crate::record::Record;
use crate::scheme::{NameError, Scheme};
use std::path::Path;

/// Colour of what is predicted.
const PREDICTION: usize = 7;
const COLUMNS: usize = 3;

/// What a panel has on its abscissa.
enum Over {
    /// The size of cells.
    CellSize,
    /// A parameter, at one level: its name, what it is called, the level.
    Parameter(&'static str, &'static str, &'static str),
    /// What the case predicts of the ordinate, in runs of all parameters.
    Prediction(&'static str),
}

use Over::{CellSize, Parameter, Prediction};

/// What one case measures.
struct Panel {
    case: &'static str,
    schemes: &'static [&'static str],
    /// What else is changed, where it is not what the convergence of the case has.
    set: Option<&'static [&'static str]>,
    over: Over,
    metric: &'static str,
    label: &'static str,
    scale: Scale,
    /// What the metric should be.
    exact: Option<f64>,
}

const PANEL: Panel = Panel {
    case: "",
    schemes: &[],
    set: None,
    over: CellSize,
    metric: "displacement_l2",
    label: "rms error of u (m)",
    scale: Scale::Log10,
    exact: None,
};

/// Explicit FLIP: nothing, F̄ as printed, from rates and consistent.
const REMEDIES: &[&str] = &[
    "gimp-none-flip",
    "gimp-fbar-recursive-flip",
    "gimp-fbar-rate-flip",
    "gimp-fbar-consistent-flip",
    "bspline2-none-flip",
    "bspline2-fbar-recursive-flip",
    "bspline2-fbar-rate-flip",
    "bspline2-fbar-consistent-flip",
];
const NONE_AND_OURS: &[&str] = &[
    "gimp-none-flip",
    "gimp-fbar-consistent-flip",
    "bspline2-none-flip",
    "bspline2-fbar-consistent-flip",
];
const BASES: &[&str] = &[
    "linear-none-flip",
    "gimp-none-flip",
    "bspline2-none-flip",
    "bspline3-none-flip",
];
const QUASI_STATIC: &[&str] = &[
    "quasi-static-linear-none",
    "quasi-static-linear-fbar-consistent",
    "quasi-static-gimp-none",
    "quasi-static-gimp-fbar-consistent",
    "quasi-static-bspline2-none",
    "quasi-static-bspline2-fbar-consistent",
];

const MANUFACTURED: [Panel; 6] = {
    const fn of(case: &'static str) -> Panel {
        Panel {
            case,
            schemes: REMEDIES,
            ..PANEL
        }
    }
    [
        of("mms-axis"),
        of("mms-double-shear"),
        of("mms-swirl"),
        of("mms-vortex-pressure"),
        of("mms-vortex-ring"),
        of("mms-wall-pressure"),
    ]
};

const OVER_CELLS: [Panel; 6] = [
    Panel {
        case: "mms-static",
        schemes: QUASI_STATIC,
        ..PANEL
    },
    Panel {
        case: "mms-poro",
        schemes: &[
            "poro-gimp-two-grid",
            "poro-gimp-equal",
            "poro-gimp-ppp",
            "poro-linear-two-grid",
            "poro-linear-equal",
            "poro-linear-ppp",
        ],
        metric: "pressure_l2",
        label: "rms error of p (Pa)",
        ..PANEL
    },
    Panel {
        case: "vibrating-bar",
        schemes: REMEDIES,
        metric: "frequency_error",
        label: "|relative error of the frequency|",
        ..PANEL
    },
    Panel {
        case: "thin",
        schemes: &[
            "linear-none-flip",
            "linear-fbar-consistent-flip",
            "gimp-none-flip",
            "gimp-fbar-consistent-flip",
            "bspline2-none-flip",
            "bspline2-fbar-consistent-flip",
        ],
        metric: "frequency_ratio",
        label: "frequency over the exact one",
        scale: Scale::Linear,
        exact: Some(1.0),
        ..PANEL
    },
    Panel {
        case: "sparse",
        schemes: QUASI_STATIC,
        set: Some(&["ppc_per_direction=2"]),
        metric: "error_median",
        label: "median error of the displacement",
        ..PANEL
    },
    Panel {
        case: "undrained",
        schemes: &[
            "poro-gimp-two-grid",
            "poro-gimp-equal",
            "poro-bspline2-two-grid",
        ],
        metric: "inf_sup",
        label: "inf–sup constant",
        ..PANEL
    },
];

const HARD: [Panel; 6] = [
    Panel {
        case: "critical-step",
        schemes: BASES,
        over: Prediction("predicted_cfl"),
        metric: "critical_cfl",
        label: "largest stable CFL number, up to one",
        ..PANEL
    },
    Panel {
        case: "stretch",
        schemes: BASES,
        over: Prediction("predicted_noise"),
        metric: "stress_noise",
        label: "noise of the stress",
        ..PANEL
    },
    Panel {
        case: "spin",
        schemes: &[
            "gimp-none-flip",
            "gimp-none-apic",
            "gimp-none-xpic2",
            "gimp-none-musl",
            "bspline2-none-flip",
            "bspline2-none-apic",
            "bspline2-none-xpic2",
        ],
        over: Parameter("turns", "turns", "r4"),
        metric: "angular_momentum_error",
        label: "loss of angular momentum",
        ..PANEL
    },
    Panel {
        case: "shock",
        schemes: NONE_AND_OURS,
        over: Parameter("mach", "Mach number", "n64"),
        metric: "overshoot",
        label: "overshoot of the stress",
        ..PANEL
    },
    Panel {
        case: "newton",
        schemes: QUASI_STATIC,
        over: Parameter("load_steps", "load steps", "n8"),
        metric: "equilibrium_error",
        label: "error of equilibrium",
        ..PANEL
    },
    Panel {
        case: "conditioning",
        schemes: &["poro-gimp-two-grid", "poro-linear-two-grid"],
        over: Parameter("alpha", "ghost penalty α", "h0.1"),
        metric: "log10_cond_uu",
        label: "log₁₀ of the condition number",
        scale: Scale::Linear,
        ..PANEL
    },
];

/// Names of the pictures, without their ending, and their panels.
const PICTURES: [(&str, &[Panel; 6]); 3] = [
    ("manufactured", &MANUFACTURED),
    ("over-cells", &OVER_CELLS),
    ("hard-cases", &HARD),
];

/// Draws them into `out`, each if there are runs for all of its panels.
///
/// # Errors
/// A picture can't be written.
pub(super) fn draw(records: &[Record], out: &Path) -> Result<(), Error> {
    for (name, panels) in PICTURES {
        let charts = panels.iter().map(|panel| panel.chart(records));
        let charts = charts.collect::<Result<Vec<Chart>, Error>>()?;
        if charts.iter().all(Chart::shows_something) {
            draw_charts(&out.join(format!("{name}.png")), &charts, COLUMNS)?;
        }
    }
    Ok(())
}

impl Panel {
    fn chart(&self, records: &[Record]) -> Result<Chart, Error> {
        let case = cases::find(self.case)?;
        let (x_label, joined) = match self.over {
            CellSize => ("cell size h (m)", true),
            Parameter(_, label, _) => (label, true),
            Prediction(_) => ("predicted", false),
        };
        // One without runs too, so that panels may share a legend.
        let curve = |name: &&str| {
            let scheme = Scheme::parse(name)?;
            let own = records
                .iter()
                .filter(|r| r.case == self.case && r.scheme() == scheme);
            let points = own.filter_map(|r| self.point(case, r));
            let mut points: Vec<(f64, f64)> = points.collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let curve = series(scheme, points);
            let dash = if joined { curve.dash } else { Dash::None };
            Ok(Series { dash, ..curve })
        };
        let curves = self.schemes.iter().map(curve);
        let mut curves = curves.collect::<Result<Vec<Series>, NameError>>()?;
        let mut quantities = case.quantities.iter();
        let quantity = quantities.find(|q| q.metric.name == self.metric);
        let slope = quantity
            .and_then(|q| q.order)
            .filter(|_| matches!(self.over, CellSize));
        let triangle =
            slope.and_then(|slope| below_the_curves(slope, curves.iter().map(|c| &c.points[..])));
        if !joined {
            let all = curves.iter().flat_map(|c| &c.points);
            let ends = all.fold((f64::INFINITY, 0.0_f64), |(lo, hi), p| {
                (lo.min(p.0), hi.max(p.0))
            });
            let line = vec![(ends.0, ends.0), (ends.1, ends.1)];
            curves.insert(0, Series::line("as predicted", line, PREDICTION));
        }
        let exact = self.exact.map(|value| ReferenceLine {
            name: "exact".to_owned(),
            value,
            band: None,
        });
        Ok(Chart {
            x_scale: Scale::Log10,
            y_scale: self.scale,
            reference_lines: exact.into_iter().collect(),
            slope_triangle: triangle,
            ..Chart::new(case.title, [x_label, self.label], curves)
        })
    }

    /// The point of a run, if it is on the curve of its scheme.
    fn point(&self, case: &Case, run: &Record) -> Option<(f64, f64)> {
        let fixed = self.set.unwrap_or(case.ladder);
        let x = match self.over {
            CellSize => (run.set == fixed).then_some(run.discretisation.h)?,
            Prediction(metric) => run.value(metric),
            Parameter(name, _, level) => {
                let value = |assignment: &String| {
                    let (changed, value) = assignment.split_once('=')?;
                    (changed == name).then(|| value.parse().ok())?
                };
                let others = run.set.iter().filter(|a| value(a).is_none());
                let own = run.level == level && others.eq(fixed.iter());
                let changed = run.set.iter().find_map(value);
                let default = || case.parameters.iter().find(|p| p.name == name);
                let x = changed.or_else(|| default()?.default.parse().ok());
                x.filter(|_| own)?
            }
        };
        let y = match self.scale {
            Scale::Log10 => run.value(self.metric).abs(),
            Scale::Linear => run.value(self.metric),
        };
        let shown =
            x > 0.0 && x.is_finite() && y.is_finite() && (y > 0.0 || self.scale == Scale::Linear);
        shown.then_some((x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measured;
    use crate::record::fixture::record;

    #[test]
    fn panels_name_what_there_is() {
        for panel in PICTURES.iter().flat_map(|(_, panels)| panels.iter()) {
            let case = cases::find(panel.case).unwrap();
            let metric = |name: &str| case.metrics.iter().any(|m| m.name == name);
            assert!(metric(panel.metric), "{}: {}", panel.case, panel.metric);
            for scheme in panel.schemes {
                let own = case.schemes().iter().any(|s| s.to_string() == *scheme);
                let recursive = scheme.contains("recursive");
                assert!(own || recursive, "{}: {scheme}", panel.case);
            }
            match panel.over {
                CellSize => {}
                Prediction(name) => assert!(metric(name), "{}: {name}", panel.case),
                Parameter(name, _, level) => {
                    assert!(case.parameters.iter().any(|p| p.name == name));
                    assert!(case.levels.iter().any(|l| l.name == level));
                }
            }
        }
    }

    #[test]
    fn a_curve_has_the_runs_that_differ_in_its_abscissa_alone() {
        let [.., shock, _, _] = &HARD;
        let case = cases::find(shock.case).unwrap();
        let run = |level: &str, set: &[&str], overshoot: f64| {
            let mut run = record(level, Vec::new());
            run.case = shock.case.to_owned();
            run.scheme = Scheme::parse("gimp-none-flip").unwrap();
            run.set = set.iter().map(|s| (*s).to_owned()).collect();
            let (value, unit) = (Some(overshoot), "-".to_owned());
            run.metrics
                .insert("overshoot".to_owned(), Measured { value, unit });
            run
        };
        let runs = [
            run("n64", &["mach=2"], 6.0),
            run("n64", &[], 0.7),
            run("n128", &[], 0.8),
            run("n64", &["mach=2", "linear_viscosity=0.5"], 0.1),
        ];
        let mach = case.parameters.iter().find(|p| p.name == "mach").unwrap();
        let own: f64 = mach.default.parse().unwrap();
        let chart = shock.chart(&runs).unwrap();
        assert_eq!(chart.series.len(), shock.schemes.len());
        assert_eq!(chart.series[0].points, [(own, 0.7), (2.0, 6.0)]);
    }
}
