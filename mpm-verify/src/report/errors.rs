//! Errors of a case against cell size, cost or a parameter, a row of panels each.

use super::prelude::*;
use crate::draw::Scale;
use crate::draw::style::{Panel, Panels};
use crate::figure::Points;

/// An error of a run.
pub(super) struct Entry<'a> {
    pub(super) scheme: Scheme,
    pub(super) metric: &'a str,
    pub(super) x: f64,
    pub(super) value: f64,
}

/// Errors of runs, by scheme in the order of their abscissae.
pub(super) struct Errors<'a> {
    pub(super) entries: Vec<Entry<'a>>,
    /// Label of the abscissa.
    pub(super) label: &'static str,
    pub(super) is_logarithmic: bool,
}

impl Errors<'_> {
    fn of(&self, quantity: &Quantity) -> impl Iterator<Item = &Entry<'_>> {
        let metric = quantity.metric.name;
        self.entries.iter().filter(move |entry| entry.metric == metric)
    }

    /// The sizes of an error of some schemes. One of zero has no logarithm.
    pub(super) fn points(&self, quantity: &Quantity, is_shown: impl Fn(Scheme) -> bool) -> Points {
        let own = self.of(quantity).filter(|entry| is_shown(entry.scheme));
        let points = own.map(|entry| (entry.x, entry.value.abs()));
        points.filter(|(x, y)| (*x > 0.0 || !self.is_logarithmic) && *y > 0.0).collect()
    }

    /// The curves of the schemes of a panel.
    pub(super) fn chart(&self, quantity: &Quantity, panel: &Panel) -> Chart {
        let label = match self.of(quantity).any(|entry| entry.value < 0.0) {
            true => format!("|{}|", quantity.label),
            false => quantity.label.to_owned(),
        };
        let series = panel.curves(|scheme| self.points(quantity, |s| s == scheme));
        let x_scale = if self.is_logarithmic { Scale::Log10 } else { Scale::Linear };
        Chart { x_scale, y_scale: Scale::Log10, ..Chart::new(panel.title.clone(), [self.label, &label], series) }
    }

    /// Draws a row of panels for every error of a case that has something to show, each as `finish` makes it.
    pub(super) fn draw(
        &self,
        case: &Case,
        (name, caption): (&str, &str),
        out: &Path,
        finish: impl Fn(&Quantity, &Panel, Chart) -> Chart,
    ) -> Result<Vec<Picture>, Error> {
        let schemes = self.entries.iter().map(|entry| entry.scheme).collect();
        let errors = case.quantities.iter().filter(|q| q.is_error);
        let chart = |q: &&Quantity, panel: &Panel| finish(q, panel, self.chart(q, panel));
        let place = out.join(case.name).join(name);
        Ok(Picture::of_files(case.name, Panels::new(&schemes).draw(&place, errors, chart)?, caption))
    }
}
