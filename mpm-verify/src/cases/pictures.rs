//! Parts shared by the pictures of several problems: their titles, their runs and their arrangement.

use crate::prelude::*;

/// Whether a run came to its end and has the transfer that problems are shown with.
pub(super) fn is_shown(record: &&Record) -> bool {
    record.status == Status::Ok && record.transfer() == TransferName::Flip
}

/// How the title of a picture names a basis.
pub(super) fn basis_title(basis: BasisName) -> &'static str {
    match basis {
        BasisName::Linear => "linear",
        BasisName::Gimp => "GIMP",
        BasisName::Bspline2 => "quadratic B-splines",
        BasisName::Bspline3 => "cubic B-splines",
        BasisName::Q8 => "serendipity elements",
    }
}

/// How a legend or the title of a panel names a remedy.
pub(super) fn remedy_title(remedy: RemedyName) -> String {
    match remedy {
        RemedyName::None => "standard".to_owned(),
        _ => remedy.to_string(),
    }
}

/// Distance of particles (m).
pub(super) fn spacing(record: &Record) -> f64 {
    let dimension = record.discretisation.dim as f64;
    record.discretisation.h / f64::from(record.discretisation.ppc).powf(1.0 / dimension)
}

/// The runs that a case shows, and the place for its pictures.
pub(super) struct Exhibit<'a, 'g> {
    pub(super) gallery: &'a mut Gallery<'g>,
    /// The runs shown; the first of several alike.
    pub(super) records: Vec<&'g Record>,
}

impl<'a, 'g> Exhibit<'a, 'g> {
    /// The records among `records` that [are shown](is_shown).
    pub(super) fn new(gallery: &'a mut Gallery<'g>, records: impl IntoIterator<Item = &'g Record>) -> Self {
        Self { gallery, records: records.into_iter().filter(is_shown).collect() }
    }

    pub(super) fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&'g Record> {
        self.records.iter().find(|r| r.basis() == basis && r.remedy() == remedy && r.level == level).copied()
    }

    /// The first of `levels` at which all `remedies` have run.
    pub(super) fn level(
        &self,
        basis: BasisName,
        remedies: &[RemedyName],
        levels: &[&'static str],
    ) -> Option<&'static str> {
        let has_all = |level: &&str| remedies.iter().all(|&remedy| self.find(basis, remedy, level).is_some());
        levels.iter().copied().find(has_all)
    }
}

/// Panels `at` every time (s) of an animation with frames this far apart (s), up to the first without any.
pub(super) fn frames<T>(apart: f64, at: impl Fn(f64) -> Result<Vec<T>, Error>) -> Result<Vec<Vec<T>>, Error> {
    let frames = (1..).map(|k| at(f64::from(k) * apart));
    frames.take_while(|frame| !frame.as_ref().is_ok_and(Vec::is_empty)).collect()
}

/// A column of particles as a panel, without an outline.
pub(super) fn field_panel(record: &Record, table: &Table, title: impl Into<String>, column: &str) -> FieldPanel {
    FieldPanel {
        title: title.into(),
        points: table.points("x", "y"),
        values: table.column(column).to_vec(),
        size: spacing(record),
        outline: Vec::new(),
    }
}

/// Panels of particle fields in one picture.
pub(super) struct Fields(pub(super) FieldFigure);

impl Fields {
    /// At most two in a row, by label and range of the colour scale.
    pub(super) fn new(panels: Vec<FieldPanel>, label: &str, range: (f64, f64)) -> Self {
        let (title, label) = (String::new(), label.to_owned());
        Self(FieldFigure { title, panels, columns: 2, range, label, ..FieldFigure::default() })
    }

    pub(super) fn titled(mut self, title: String) -> Self {
        self.0.title = title;
        self
    }

    pub(super) fn columns(mut self, columns: usize) -> Self {
        self.0.columns = columns;
        self
    }

    /// In these ranges of x and y (m).
    pub(super) fn within(mut self, window: ((f64, f64), (f64, f64))) -> Self {
        self.0.window = Some(window);
        self
    }

    /// Draws and hangs the picture `NAME.png`, if there is a panel.
    pub(super) fn draw(self, gallery: &mut Gallery, name: &str, caption: impl Into<String>) -> Result<(), Error> {
        if self.0.panels.is_empty() {
            return Ok(());
        }
        let file = format!("{name}.png");
        draw_fields(&gallery.place(&file), &self.0)?;
        gallery.hang(&file, caption);
        Ok(())
    }
}
