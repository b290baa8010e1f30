//! How loads, tractions and prescribed velocities vary over the time of a phase: a smooth rise, or a table by its name.

use super::fault::{Line, Source};
use super::form::{AmplitudeForm, Form, Name, NotNegative, SupportForm};
use crate::cases::prelude::*;

/// Heads of the columns of a table in a file.
const COLUMNS: [&str; 2] = ["time (s)", "factor (-)"];

/// Tables by name.
pub(super) type Amplitudes = BTreeMap<String, Amplitude>;

/// The tables of a scene.
///
/// # Errors
/// A table that can't be read, that nothing names, or that is named and not there; one beside a rise.
pub(super) fn amplitudes(source: &Source, form: &Form) -> Result<Amplitudes, Error> {
    let mut all = Amplitudes::new();
    for table in &form.amplitudes {
        let given = table.get_ref();
        if all.insert(given.name.0.clone(), read(source, table)?).is_some() {
            return Err(source.at(table, format!("a second amplitude {:?}", given.name.0)));
        }
    }
    let mut idle: Vec<&Line<AmplitudeForm>> = form.amplitudes.iter().collect();
    for (at, rise, name) in timed(form).filter_map(|(at, rise, name)| Some((at, rise, name.as_ref()?))) {
        if !all.contains_key(&name.0) {
            let names: Vec<&str> = all.keys().map(String::as_str).collect();
            let said = format!("no amplitude {:?}; [[amplitudes]] has {}", name.0, names.join(", "));
            return Err(source.fault(&at, said));
        }
        if rise.0 != 0.0 {
            return Err(source.fault(&at, "either rise_s or amplitude"));
        }
        idle.retain(|table| table.get_ref().name != *name);
    }
    match idle.first() {
        Some(table) => Err(source.at(*table, format!("an amplitude that nothing names: {:?}", table.get_ref().name.0))),
        None => Ok(all),
    }
}

/// Everything that varies over time: its place in the file, and its rise or the name of its table.
fn timed(form: &Form) -> impl Iterator<Item = (std::ops::Range<usize>, &NotNegative, &Option<Name>)> {
    let loads = form.loads.iter().map(|load| {
        let (rise, amplitude, _) = load.get_ref().when();
        (load.span(), rise, amplitude)
    });
    let supports = form.supports.iter().filter_map(|support| match support.get_ref() {
        SupportForm::Wall { .. } => None,
        SupportForm::Nodes { rise_s, amplitude, .. } => Some((support.span(), rise_s, amplitude)),
    });
    let contacts = form.contacts.iter().map(|c| (c.span(), &c.get_ref().rise_s, &c.get_ref().amplitude));
    let faces = form.water.iter().flat_map(|water| &water.get_ref().faces);
    let faces = faces.map(|face| (face.span(), &face.get_ref().rise_s, &face.get_ref().amplitude));
    loads.chain(supports).chain(contacts).chain(faces)
}

fn read(source: &Source, table: &Line<AmplitudeForm>) -> Result<Amplitude, Error> {
    match (&table.get_ref().knots, &table.get_ref().file) {
        (Some(knots), None) => {
            let knots: Vec<[f64; 2]> = knots.iter().map(|[time, factor]| [time.0, factor.0]).collect();
            Amplitude::table(&knots).map_err(|e| source.at(table, e))
        }
        (None, Some(name)) => {
            let path = source.beside(table, name)?;
            let read = Table::read_finite(&path)?;
            let heads: Vec<&str> = read.iter().map(|(head, _)| head).collect();
            match COLUMNS.map(|head| read.get(head)) {
                [Some(times), Some(factors)] if heads.len() == COLUMNS.len() => {
                    let knots: Vec<[f64; 2]> = times.iter().zip(factors).map(|(t, f)| [*t, *f]).collect();
                    Amplitude::table(&knots).map_err(|e| Error::file(&path, e))
                }
                _ => Err(Error::file(&path, format!("columns {heads:?} where {COLUMNS:?} are read"))),
            }
        }
        _ => Err(source.at(table, "an amplitude has either knots or file")),
    }
}
