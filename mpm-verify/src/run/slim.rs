//! A run without the files that no report reads.

use super::series;
use super::*;
use crate::files::read_versioned;
use crate::record::SCHEMA;
use crate::table::Table;

/// Rows of a series that no picture shows: a multiple of those of a golden, which are among them.
pub(crate) const ROWS: usize = 400;

/// Removes the files of the run in `folder` that nothing reads: particles and snapshots that are not among the tables `shown`,
/// what is for ParaView, and all but [`ROWS`] rows of a series that is not among them. The record vouches for the others.
///
/// # Errors
/// A file can't be read, written or removed.
pub(crate) fn slim(folder: &Path, shown: &BTreeSet<PathBuf>) -> Result<(), Error> {
    let path = folder.join(RECORD);
    let mut record: Record = read_versioned(&path, SCHEMA)?;
    for name in tables(folder)? {
        let file = folder.join(&name);
        if shown.contains(&file) {
            continue;
        }
        if name == series::FILE {
            let table = Table::read(&file)?;
            if table.rows() > ROWS {
                table.thinned(ROWS).write(&file)?;
                record.files.insert(name, Mark::of(&read(&file, TABLE)?));
            }
        } else {
            discard(&file)?;
            record.files.remove(&name);
        }
    }
    let mut for_paraview = files_in(&folder.join(SNAPSHOTS), &["vtu"])?;
    for_paraview.extend([Path::new(PARTICLES).with_extension("vtu"), COLLECTION.into()].map(|file| folder.join(file)));
    for_paraview.iter().try_for_each(|file| discard(file))?;
    // Stays if anything else is there.
    let _ = std::fs::remove_dir(folder.join(SNAPSHOTS));
    write_json(&path, &record)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::run::checkpoint::Saving;
    use crate::study::found::record_in;
    use crate::study::judge::judged_run;

    #[test]
    fn what_nothing_shows_is_gone_and_the_record_vouches_for_the_rest() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path();
        let case = cases::find("vibrating-bar").unwrap();
        let spec = &case.runs(crate::case::Tier::Pr)[0];
        judged_run(case, spec, Some((out, Saving::resuming())), 1, &|_| {}).unwrap();
        let [series, particles] = [series::FILE, PARTICLES].map(|name| out.join(name));
        let whole = Table::read(&series).unwrap();
        assert!(whole.rows() > 2 * ROWS);
        slim(out, &BTreeSet::from([series.clone()])).unwrap();
        assert_eq!(Table::read(&series).unwrap(), whole);
        assert!(!particles.exists() && !particles.with_extension("vtu").exists());
        slim(out, &BTreeSet::new()).unwrap();
        let thin = Table::read(&series).unwrap();
        assert_eq!(thin.rows(), ROWS);
        // A golden has eighths of the rows.
        for ((_, thin), (_, whole)) in thin.iter().zip(whole.iter()) {
            assert!((1..=8).all(|k| thin[k * ROWS / 8 - 1] == whole[(k * whole.len()).div_ceil(8) - 1]));
        }
        assert!(record_in(out, case, spec).unwrap().is_some());
    }
}
