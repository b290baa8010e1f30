//! Parts shared by the pictures of several problems: their titles, their runs and their arrangement.

use crate::cases::prelude::*;
use std::path::PathBuf;

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
        let records = records.into_iter().filter(is_shown).collect();
        Self { gallery, records }
    }

    pub(super) fn find(&self, basis: BasisName, remedy: RemedyName, level: &str) -> Option<&'g Record> {
        let wanted = |r: &&&Record| r.basis() == basis && r.remedy() == remedy && r.level == level;
        self.records.iter().find(wanted).copied()
    }

    /// The first of `levels` at which all `remedies` have run.
    pub(super) fn level(
        &self,
        basis: BasisName,
        remedies: &[RemedyName],
        levels: &[&'static str],
    ) -> Option<&'static str> {
        let has_all = |level: &&str| {
            let has = |&remedy: &RemedyName| self.find(basis, remedy, level).is_some();
            remedies.iter().all(has)
        };
        levels.iter().copied().find(has_all)
    }

    /// The file of a picture.
    pub(super) fn place(&self, name: &str) -> PathBuf {
        self.gallery.place(&format!("{name}.png"))
    }

    /// Hangs a picture that was drawn at its [place](Self::place).
    pub(super) fn hang(&mut self, name: &str, caption: impl Into<String>) {
        self.gallery.hang(&format!("{name}.png"), caption);
    }

    /// Draws panels of fields.
    pub(super) fn fields(&mut self, name: &str, figure: &FieldFigure, caption: impl Into<String>) -> Result<(), Error> {
        draw_fields(&self.place(name), figure)?;
        self.hang(name, caption);
        Ok(())
    }
}
