//! Pictures of several cases, a panel each: those that pages of cases share.

use super::prelude::*;
use crate::draw::ReferenceLine;
use crate::scheme::NameError;

/// Colour of what is predicted.
const PREDICTION: usize = 7;

/// Names of the pictures, without their ending, and their panels.
const PICTURES: &str = include_str!("../../assets/together.toml");

/// Pictures of several cases.
#[derive(Deserialize)]
struct Pictures {
    /// Schemes that are shown together, by a name.
    schemes: BTreeMap<String, Vec<String>>,
    picture: Vec<PictureOf>,
}

/// A picture, by its name without an ending.
#[derive(Deserialize)]
struct PictureOf {
    name: String,
    panel: Vec<Plot>,
}

/// A metric of one case over the size of cells, or over what is named.
#[derive(Deserialize)]
struct Plot {
    case: String,
    /// Name of its schemes.
    schemes: String,
    /// Other changed parameters, if they differ from those of the convergence of the case.
    set: Option<Vec<String>>,
    /// A parameter in place of the size of cells.
    parameter: Option<Abscissa>,
    /// Prediction of the ordinate by the case, a metric, in place of the size of cells: in runs of all parameters.
    prediction: Option<String>,
    metric: String,
    label: String,
    #[serde(default)]
    linear: bool,
    /// Exact value of the metric.
    exact: Option<f64>,
}

/// A parameter at one level, and its label.
#[derive(Deserialize)]
struct Abscissa {
    name: String,
    label: String,
    level: String,
}

impl Pictures {
    fn read() -> Result<Self, Error> {
        toml::from_str(PICTURES).map_err(|e| Error::Input(format!("pictures of several cases: {e}")))
    }
}

/// Draws them, each if there are runs for all of its panels.
pub(super) fn draw(gallery: &mut Gallery) -> Result<(), Error> {
    let Pictures { schemes, picture } = Pictures::read()?;
    for PictureOf { name, panel } in picture {
        let panels = panel.iter().map(|plot| plot.panel(&schemes, gallery.records));
        Figure::new(name, "", panels.collect::<Result<Vec<_>, Error>>()?).whole().draw(gallery)?;
    }
    Ok(())
}

impl Plot {
    fn panel<'a>(&self, schemes: &BTreeMap<String, Vec<String>>, records: &'a [Record]) -> Result<Panel<'a>, Error> {
        let case = cases::find(&self.case)?;
        let x = match (&self.parameter, &self.prediction) {
            (Some(parameter), _) => &*parameter.label,
            (None, Some(_)) => "predicted",
            (None, None) => "cell size h (m)",
        };
        let schemes = schemes.get(&self.schemes).into_iter().flatten().map(|name| Scheme::parse(name));
        let schemes = schemes.collect::<Result<Vec<Scheme>, NameError>>()?;
        let is_own = |r: &&Record| r.case == self.case && self.abscissa(case, r).is_some();
        let runs: Vec<&Record> = records.iter().filter(is_own).collect();
        let point = |r: &Record| {
            let (x, y) = (self.abscissa(case, r).unwrap_or(f64::NAN), r.value(&self.metric));
            (x, if self.linear { y } else { y.abs() })
        };
        let panel = Panel::new(case.title, [x, &*self.label]).log_x();
        let panel = if self.linear { panel } else { panel.log_y() };
        let mut panel = panel.points_of(schemes, &runs, point);
        if self.prediction.is_some() {
            panel = panel.styled(|_, curve| Series { dash: Dash::None, ..curve }).identity("as predicted", PREDICTION);
        }
        if self.prediction.is_none() && self.parameter.is_none() {
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
        if let Some(metric) = &self.prediction {
            return Some(run.value(metric));
        }
        let ladder = || case.ladder.iter().map(|set| (*set).to_owned()).collect();
        let fixed: Vec<String> = self.set.clone().unwrap_or_else(ladder);
        let Some(Abscissa { name, level, .. }) = &self.parameter else {
            return (run.set == fixed).then_some(run.discretisation.h);
        };
        let value = |assignment: &String| {
            let (changed, value) = assignment.split_once('=')?;
            (changed == name).then(|| value.parse().ok())?
        };
        let others = run.set.iter().filter(|a| value(a).is_none());
        let own = run.level == *level && others.eq(fixed.iter());
        let changed = run.set.iter().find_map(value);
        let default = || case.parameters.iter().find(|p| p.name == name);
        changed.or_else(|| default()?.default.parse().ok()).filter(|_| own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::{changed, record};

    #[test]
    fn panels_name_what_there_is() {
        let Pictures { schemes, picture } = Pictures::read().unwrap();
        for panel in picture.iter().flat_map(|of| &of.panel) {
            let case = cases::find(&panel.case).unwrap();
            let metric = |name: &str| case.metrics.iter().any(|m| m.name == name);
            assert!(metric(&panel.metric), "{}: {}", panel.case, panel.metric);
            for scheme in &schemes[&panel.schemes] {
                let own = case.schemes().iter().any(|s| s.to_string() == *scheme);
                let recursive = scheme.contains("recursive");
                assert!(own || recursive, "{}: {scheme}", panel.case);
            }
            assert!(panel.prediction.as_ref().is_none_or(|name| metric(name)), "{}", panel.case);
            if let Some(Abscissa { name, level, .. }) = &panel.parameter {
                assert!(case.parameters.iter().any(|p| p.name == name));
                assert!(case.levels.iter().any(|l| l.name == level));
            }
        }
    }

    #[test]
    fn a_curve_has_the_runs_that_differ_in_its_abscissa_alone() {
        let Pictures { schemes, picture } = Pictures::read().unwrap();
        let [.., shock, _, _] = &picture[2].panel[..] else { panic!("six panels") };
        let case = cases::find(&shock.case).unwrap();
        let run = |level: &str, set: &[&str], overshoot: f64| {
            let mut run = record(level, Vec::new());
            run.case = shock.case.clone();
            run.scheme = Scheme::parse("gimp-none-flip").unwrap();
            run.set = changed(set);
            run.measure(&[("overshoot", overshoot)]);
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
        let chart = shock.panel(&schemes, &runs).unwrap().chart().unwrap();
        assert_eq!(chart.series.len(), schemes[&shock.schemes].len());
        assert_eq!(chart.series[0].points, [(own, 0.7), (2.0, 6.0)]);
    }
}
