//! Pictures of several cases, a panel each: those that pages of cases share.

use super::prelude::*;
use crate::draw::{Dash, ReferenceLine};
use crate::figure::{Figure, Panel};
use crate::scheme::NameError;

/// Colour of what is predicted.
const PREDICTION: usize = 7;

/// Abscissa of a panel.
#[derive(Clone, Copy)]
enum Over {
    /// The size of cells.
    CellSize,
    /// A parameter, at one level: its name, what it is called, the level.
    Parameter(&'static str, &'static str, &'static str),
    /// Prediction of the ordinate by the case, in runs of all parameters.
    Prediction(&'static str),
}

use Over::{CellSize, Parameter, Prediction};

/// Curve of one case.
#[derive(Clone, Copy)]
struct Plot {
    case: &'static str,
    schemes: &'static [&'static str],
    /// Other changed parameters, if they differ from those of the convergence of the case.
    set: Option<&'static [&'static str]>,
    over: Over,
    metric: &'static str,
    label: &'static str,
    linear: bool,
    /// Exact value of the metric.
    exact: Option<f64>,
}

/// A metric of a case over the size of cells.
const fn plot(
    case: &'static str,
    schemes: &'static [&'static str],
    (metric, label): (&'static str, &'static str),
) -> Plot {
    let (set, over, linear, exact) = (None, CellSize, false, None);
    Plot { case, schemes, set, over, metric, label, linear, exact }
}

impl Plot {
    const fn over(self, over: Over) -> Self {
        Self { over, ..self }
    }

    const fn linear(self) -> Self {
        Self { linear: true, ..self }
    }
}

const DISPLACEMENT: (&str, &str) = ("displacement_l2", "rms error of u (m)");

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
const NONE_AND_OURS: &[&str] =
    &["gimp-none-flip", "gimp-fbar-consistent-flip", "bspline2-none-flip", "bspline2-fbar-consistent-flip"];
const BASES: &[&str] = &["linear-none-flip", "gimp-none-flip", "bspline2-none-flip", "bspline3-none-flip"];
const QUASI_STATIC: &[&str] = &[
    "quasi-static-linear-none",
    "quasi-static-linear-fbar-consistent",
    "quasi-static-gimp-none",
    "quasi-static-gimp-fbar-consistent",
    "quasi-static-bspline2-none",
    "quasi-static-bspline2-fbar-consistent",
];

const POROUS: &[&str] = &[
    "poro-gimp-two-grid",
    "poro-gimp-equal",
    "poro-gimp-ppp",
    "poro-linear-two-grid",
    "poro-linear-equal",
    "poro-linear-ppp",
];
const INF_SUP: &[&str] = &["poro-gimp-two-grid", "poro-gimp-equal", "poro-bspline2-two-grid"];
const THIN: &[&str] = &[
    "linear-none-flip",
    "linear-fbar-consistent-flip",
    "gimp-none-flip",
    "gimp-fbar-consistent-flip",
    "bspline2-none-flip",
    "bspline2-fbar-consistent-flip",
];
const TRANSFERS: &[&str] = &[
    "gimp-none-flip",
    "gimp-none-apic",
    "gimp-none-xpic2",
    "gimp-none-musl",
    "bspline2-none-flip",
    "bspline2-none-apic",
    "bspline2-none-xpic2",
];
const TWO_GRIDS: &[&str] = &["poro-gimp-two-grid", "poro-linear-two-grid"];

/// Names of the pictures, without their ending, and their panels.
const PICTURES: [(&str, [Plot; 6]); 3] = [
    (
        "manufactured",
        [
            plot("mms-axis", REMEDIES, DISPLACEMENT),
            plot("mms-double-shear", REMEDIES, DISPLACEMENT),
            plot("mms-swirl", REMEDIES, DISPLACEMENT),
            plot("mms-vortex-pressure", REMEDIES, DISPLACEMENT),
            plot("mms-vortex-ring", REMEDIES, DISPLACEMENT),
            plot("mms-wall-pressure", REMEDIES, DISPLACEMENT),
        ],
    ),
    (
        "over-cells",
        [
            plot("mms-static", QUASI_STATIC, DISPLACEMENT),
            plot("mms-poro", POROUS, ("pressure_l2", "rms error of p (Pa)")),
            plot("vibrating-bar", REMEDIES, ("frequency_error", "|relative error of the frequency|")),
            Plot {
                exact: Some(1.0),
                ..plot("thin", THIN, ("frequency_ratio", "frequency over the exact one")).linear()
            },
            Plot {
                set: Some(&["ppc_per_direction=2"]),
                ..plot("sparse", QUASI_STATIC, ("error_median", "median error of the displacement"))
            },
            plot("undrained", INF_SUP, ("inf_sup", "inf–sup constant")),
        ],
    ),
    (
        "hard-cases",
        [
            plot("critical-step", BASES, ("critical_cfl", "largest stable CFL number, up to one"))
                .over(Prediction("predicted_cfl")),
            plot("stretch", BASES, ("stress_noise", "noise of the stress")).over(Prediction("predicted_noise")),
            plot("spin", TRANSFERS, ("angular_momentum_error", "loss of angular momentum"))
                .over(Parameter("turns", "turns", "r4")),
            plot("shock", NONE_AND_OURS, ("overshoot", "overshoot of the stress")).over(Parameter(
                "mach",
                "Mach number",
                "n64",
            )),
            plot("newton", QUASI_STATIC, ("equilibrium_error", "error of equilibrium")).over(Parameter(
                "load_steps",
                "load steps",
                "n8",
            )),
            plot("conditioning", TWO_GRIDS, ("log10_cond_uu", "log₁₀ of the condition number"))
                .over(Parameter("alpha", "ghost penalty α", "h0.1"))
                .linear(),
        ],
    ),
];

/// Draws them, each if there are runs for all of its panels.
///
/// # Errors
/// A picture can't be written.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    for (name, plots) in PICTURES {
        let panels = plots.iter().map(|plot| plot.panel(gallery.records));
        let panels = panels.collect::<Result<Vec<_>, Error>>()?;
        Figure::new(name, "", panels).whole().draw(gallery)?;
    }
    Ok(())
}

impl Plot {
    fn panel<'a>(&self, records: &'a [Record]) -> Result<Panel<'a>, Error> {
        let case = cases::find(self.case)?;
        let x = match self.over {
            CellSize => "cell size h (m)",
            Parameter(_, label, _) => label,
            Prediction(_) => "predicted",
        };
        let schemes = self.schemes.iter().map(|name| Scheme::parse(name));
        let schemes = schemes.collect::<Result<Vec<Scheme>, NameError>>()?;
        let is_own = |r: &&Record| r.case == self.case && self.abscissa(case, r).is_some();
        let runs: Vec<&Record> = records.iter().filter(is_own).collect();
        let point = |r: &Record| {
            let (x, y) = (self.abscissa(case, r).unwrap_or(f64::NAN), r.value(self.metric));
            (x, if self.linear { y } else { y.abs() })
        };
        let panel = Panel::new(case.title, [x, self.label]).log_x();
        let panel = if self.linear { panel } else { panel.log_y() };
        let mut panel = panel.points_of(schemes, &runs, point);
        if let Prediction(_) = self.over {
            panel = panel.styled(|_, curve| Series { dash: Dash::None, ..curve }).identity("as predicted", PREDICTION);
        }
        if let CellSize = self.over {
            let mut own = case.quantities.iter().filter(|q| q.metric.name == self.metric);
            panel = own.next().and_then(|q| q.order).into_iter().fold(panel, Panel::order);
        }
        Ok(self
            .exact
            .into_iter()
            .fold(panel, |panel, value| panel.level(ReferenceLine { name: "exact".to_owned(), value, band: None })))
    }

    /// Where a run stands, if it is on the curve of its scheme.
    fn abscissa(&self, case: &Case, run: &Record) -> Option<f64> {
        let fixed = self.set.unwrap_or(case.ladder);
        match self.over {
            CellSize => (run.set == fixed).then_some(run.discretisation.h),
            Prediction(metric) => Some(run.value(metric)),
            Parameter(name, _, level) => {
                let value = |assignment: &String| {
                    let (changed, value) = assignment.split_once('=')?;
                    (changed == name).then(|| value.parse().ok())?
                };
                let others = run.set.iter().filter(|a| value(a).is_none());
                let own = run.level == level && others.eq(fixed.iter());
                let changed = run.set.iter().find_map(value);
                let default = || case.parameters.iter().find(|p| p.name == name);
                changed.or_else(|| default()?.default.parse().ok()).filter(|_| own)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measured;
    use crate::record::fixture::record;

    #[test]
    fn panels_name_what_there_is() {
        for panel in PICTURES.iter().flat_map(|(_, plots)| plots.iter()) {
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
        let [.., (_, [.., shock, _, _])] = &PICTURES;
        let case = cases::find(shock.case).unwrap();
        let run = |level: &str, set: &[&str], overshoot: f64| {
            let mut run = record(level, Vec::new());
            run.case = shock.case.to_owned();
            run.scheme = Scheme::parse("gimp-none-flip").unwrap();
            run.set = set.iter().map(|s| (*s).to_owned()).collect();
            let (value, unit) = (Some(overshoot), "-".to_owned());
            run.metrics.insert("overshoot".to_owned(), Measured { value, unit });
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
        let chart = shock.panel(&runs).unwrap().chart().unwrap();
        assert_eq!(chart.series.len(), shock.schemes.len());
        assert_eq!(chart.series[0].points, [(own, 0.7), (2.0, 6.0)]);
    }
}
