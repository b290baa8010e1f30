//! Records read from the folders of all shards of a plan.

use super::convergence::convergence;
use super::judge::judge;
use super::plan::{Plan, PlannedRun};
use super::summary::{CaseStudy, Summary};
use crate::cases;
use crate::error::Error;
use crate::files::read_versioned;
use crate::record::{self, Record};
use crate::spec::run_folder;
use crate::verdict::Verdict;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// File of a run's record.
const RECORD: &str = "record.json";

/// The runs of a whole plan, gathered from the folders of its shards.
#[derive(Debug)]
pub struct Gathered {
    tier: String,
    studies: Vec<CaseStudy>,
    folders: BTreeMap<String, PathBuf>,
}

impl Gathered {
    /// One run by itself, whose outputs lie in `folder`.
    #[must_use]
    pub fn single(record: Record, folder: &Path) -> Self {
        let place = format!("{}/{}", record.case, record.folder());
        Self {
            tier: "of a single run".to_owned(),
            folders: BTreeMap::from([(place, folder.to_path_buf())]),
            studies: vec![CaseStudy::new(&record.case.clone(), vec![record])],
        }
    }

    /// Reads every record of a plan; `folders` are those of all its shards, in any order, or that of a single run.
    ///
    /// # Errors
    /// A folder holds no plan, the plans are not shares of one whole, a shard is missing or there
    /// twice, a run has no record, or a record is damaged, of another schema, run or program.
    pub fn read(folders: &[PathBuf]) -> Result<Self, Error> {
        if let [folder] = folders
            && !Plan::is_in(folder)
            && folder.join(RECORD).exists()
        {
            let record = read_versioned(&folder.join(RECORD), record::SCHEMA)?;
            return Ok(Self::single(record, folder));
        }
        let plans = read_plans(folders)?;
        let (_, whole) = &plans[0];
        let mut gathered = Self {
            tier: whole.tier.clone(),
            studies: Vec::new(),
            folders: BTreeMap::new(),
        };
        let mut missing = Vec::new();
        for run in &whole.runs {
            let folder = plans[run.shard - 1].0.join(run.folder());
            let Some(record) = read_record(&folder, run)? else {
                missing.push(run);
                continue;
            };
            let place = run.folder().display().to_string();
            gathered.folders.insert(place, folder);
            match gathered.studies.last_mut() {
                Some(study) if study.case == run.case => study.records.push(record),
                _ => gathered
                    .studies
                    .push(CaseStudy::new(&run.case, vec![record])),
            }
        }
        let [first, ..] = missing[..] else {
            of_one_program(gathered.studies.iter().flat_map(|s| &s.records))?;
            return Ok(gathered);
        };
        let (shard, _) = &plans[first.shard - 1];
        Err(Error::Input(format!(
            "{}: incomplete: {} of {} runs have no record, the first is {}; `verify --resume` with the same tier, shard and folder makes them",
            shard.display(),
            missing.len(),
            whole.runs.len(),
            first.folder().display()
        )))
    }

    /// Where the raw outputs of a run lie.
    ///
    /// # Errors
    /// The run is not among those gathered.
    pub fn folder(&self, record: &Record) -> Result<&Path, Error> {
        let place = format!("{}/{}", record.case, record.folder());
        match self.folders.get(&place) {
            Some(folder) => Ok(folder),
            None => Err(Error::Input(format!("{place} is not among the runs read"))),
        }
    }

    /// Forms every verdict by the checks as they are now; `drift` gives those on drift.
    ///
    /// # Errors
    /// A case that is not known, or an error of `drift`.
    pub fn judge(
        &self,
        drift: impl Fn(&Record) -> Result<Vec<Verdict>, Error> + Sync,
    ) -> Result<Summary, Error> {
        let mut cases = self.studies.clone();
        for study in &mut cases {
            let case = cases::find(&study.case)?;
            study.records.par_iter_mut().try_for_each(|record| {
                record.verdicts = judge(case, record);
                record.verdicts.extend(drift(record)?);
                Ok::<(), Error>(())
            })?;
            study.verdicts = case.judge_study(&study.records);
            study.convergence = convergence(case, &study.records);
        }
        Ok(Summary::new(&self.tier, cases))
    }
}

/// Whether one program made all records.
///
/// # Errors
/// Two did; the error names a record of each.
fn of_one_program<'a>(mut records: impl Iterator<Item = &'a Record>) -> Result<(), Error> {
    let Some(first) = records.next() else {
        return Ok(());
    };
    match records.find(|r| r.version != first.version) {
        None => Ok(()),
        Some(other) => Err(Error::Input(format!(
            "records of two programs: {} {} is of source {}, {} {} of {}",
            first.case,
            first.folder(),
            first.version.source,
            other.case,
            other.folder(),
            other.version.source
        ))),
    }
}

/// The folders with their plans, in the order of the shards.
fn read_plans(folders: &[PathBuf]) -> Result<Vec<(&Path, Plan)>, Error> {
    let mut plans = Vec::new();
    for folder in folders {
        plans.push((folder.as_path(), Plan::read(folder)?));
    }
    plans.sort_by_key(|(_, plan)| plan.shard.index);
    let Some((first, whole)) = plans.first() else {
        return Err(Error::Input("no folder is given".to_owned()));
    };
    for (k, (folder, plan)) in plans.iter().enumerate() {
        if !plan.is_of_one_whole_with(whole) {
            return Err(Error::Input(format!(
                "{} (tier {}, shard {}) and {} (tier {}, shard {}) are not shards of one plan",
                first.display(),
                whole.tier,
                whole.shard,
                folder.display(),
                plan.tier,
                plan.shard
            )));
        }
        if k > 0 && plans[k - 1].1.shard == plan.shard {
            return Err(Error::Input(format!(
                "shard {} is there twice: {} and {}",
                plan.shard,
                plans[k - 1].0.display(),
                folder.display()
            )));
        }
    }
    let given = |k: &usize| plans.iter().any(|(_, p)| p.shard.index == *k);
    let missing: Vec<String> = (1..=whole.shard.count)
        .filter(|k| !given(k))
        .map(|k| k.to_string())
        .collect();
    if missing.is_empty() {
        Ok(plans)
    } else {
        Err(Error::Input(format!(
            "of {} shards these are missing: {}",
            whole.shard.count,
            missing.join(", ")
        )))
    }
}

/// The record of a planned run, or `None` if the run has not ended.
fn read_record(folder: &Path, run: &PlannedRun) -> Result<Option<Record>, Error> {
    let path = folder.join(RECORD);
    if !path.exists() {
        return Ok(None);
    }
    let record: Record = read_versioned(&path, record::SCHEMA)?;
    if record.perturbed
        || record.case != run.case
        || record.folder() != run_folder(run.scheme, &run.level, &run.set)
    {
        let cause = format!("of another run: {} {}", record.case, record.folder());
        return Err(Error::file(&path, cause));
    }
    Ok(Some(record))
}
