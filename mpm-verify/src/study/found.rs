//! Results of runs in their folders.

use super::*;

/// The record of a run in `folder`, if the run has ended there. One of this program is of the parameters asked for, says
/// what can be, and vouches for the tables beside it; of another program's only the run is known.
///
/// # Errors
/// It is damaged, of another run or other parameters, or a table is not what the run wrote.
pub fn record_in(folder: &Path, case: &Case, spec: &RunSpec) -> Result<Option<Record>, Error> {
    let found = own_record(folder, case, spec)?;
    if let Some(record) = found.as_ref().filter(|r| r.version == Version::current()) {
        require_tables(record, folder)?;
    }
    Ok(found)
}

/// [`record_in`] without a look at the tables.
///
/// # Errors
/// It is damaged, or of another run or other parameters.
pub fn own_record(folder: &Path, case: &Case, spec: &RunSpec) -> Result<Option<Record>, Error> {
    let path = folder.join(RECORD);
    if !path.exists() {
        return Ok(None);
    }
    let record: Record = read_versioned(&path, record::SCHEMA)?;
    let asked = Identity::of(case, spec, &Parameters::new(&case.parameters, &spec.set)?);
    let verdict = match asked.require(&Identity::of_record(&record)) {
        Err(Refusal::Program(..)) => Ok(()),
        Err(Refusal::Parameter(..)) if record.version != Version::current() => Ok(()),
        Ok(()) => require_possible(&record),
        refused => refused,
    };
    verdict.map_err(|refusal| refusal.of(&path))?;
    Ok(Some(record))
}

/// Checks what no run can have.
fn require_possible(record: &Record) -> Result<(), Refusal> {
    let (d, time) = (&record.discretisation, record.time);
    let lengths = [d.h, d.dt].into_iter().all(|value| value.is_finite() && value > 0.0);
    let times = [time.wall_s, time.cpu_s].into_iter().all(|t| t.is_finite() && t >= 0.0);
    let counts = (1..=3).contains(&d.dim) && record.machine.cores > 0 && record.machine.threads > 0;
    match lengths && times && counts {
        true => Ok(()),
        false => Err(Refusal::Content("a size, step, time or number of threads that no run has".to_owned())),
    }
}
