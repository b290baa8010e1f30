//! Records read from the folders of all shards of a plan.

use super::convergence::convergence;
use super::found::record_in;
use super::judge::judge;
use super::plan::{self, Plan, PlannedRun};
use super::summary::{CaseStudy, Summary};
use super::*;
use rayon::prelude::*;

/// The runs of a whole plan, gathered from the folders of its shards.
#[derive(Debug)]
pub struct Gathered {
    tier: String,
    studies: Vec<CaseStudy>,
    folders: BTreeMap<String, PathBuf>,
    /// Reason why the runs are not those of a tier.
    gap: Option<String>,
}

impl Gathered {
    /// One run by itself, whose outputs lie in `folder`.
    pub(crate) fn single(record: Record, folder: &Path) -> Self {
        let place = format!("{}/{}", record.case, record.folder());
        Self {
            tier: "of a single run".to_owned(),
            folders: BTreeMap::from([(place, folder.to_path_buf())]),
            studies: vec![CaseStudy::new(&record.case.clone(), vec![record])],
            gap: None,
        }
    }

    /// Reason why the runs are not those of their tier, if there is one: such runs are shown, and pass nothing.
    #[must_use]
    pub fn gap(&self) -> Option<&str> {
        self.gap.as_deref()
    }

    /// Checks that the runs are those of a tier.
    ///
    /// # Errors
    /// Some are missing, or it is one run by itself.
    pub fn require_tier(&self) -> Result<(), Error> {
        match &self.gap {
            Some(gap) => Err(Error::Input(gap.clone())),
            None => Tier::parse(&self.tier).map(drop),
        }
    }

    /// Reads one run by itself; its record says what it is of.
    fn read_single(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(RECORD);
        let record: Record = read_versioned(&path, record::SCHEMA)?;
        let (case, spec) = plan::resolve_record(&record).map_err(|e| Error::file(&path, e))?;
        Ok(Self::single(record_in(folder, case, &spec)?.unwrap_or(record), folder))
    }

    /// Reads runs that were made one by one.
    fn read_alone(folders: &[PathBuf]) -> Result<Self, Error> {
        let mut all = Self { tier: plan::SWEEP.to_owned(), studies: Vec::new(), folders: BTreeMap::new(), gap: None };
        for folder in folders {
            let one = Self::read_single(folder)?;
            if let Some(place) = one.folders.keys().find(|place| all.folders.contains_key(*place)) {
                return Err(Error::Input(format!("{place} is there twice, also in {}", folder.display())));
            }
            all.folders.extend(one.folders);
            for study in one.studies {
                match all.studies.iter_mut().find(|own| own.case == study.case) {
                    Some(own) => own.records.extend(study.records),
                    None => all.studies.push(study),
                }
            }
        }
        of_one_program(all.studies.iter().flat_map(|s| &s.records))?;
        Ok(all)
    }

    /// Reads every record of a plan; `folders` are those of all its shards, in any order, or those of single runs.
    ///
    /// # Errors
    /// A folder holds no plan, the plans are not shares of one whole, a shard is missing or there
    /// twice, a run has no record, or a record is damaged, of another schema, run or program.
    pub fn read(folders: &[PathBuf]) -> Result<Self, Error> {
        let alone = |folder: &PathBuf| !folder.join(plan::FILE).exists() && folder.join(RECORD).exists();
        match folders {
            [folder] if alone(folder) => return Self::read_single(folder),
            [first, ..] if alone(first) => return Self::read_alone(folders),
            _ => {}
        }
        let plans = read_plans(folders)?;
        let (_, whole) = &plans[0];
        let mut gathered =
            Self { tier: whole.tier.clone(), studies: Vec::new(), folders: BTreeMap::new(), gap: whole.gap()? };
        let mut missing = Vec::new();
        for run in &whole.runs {
            let root = plans[run.shard - 1].0;
            let folder = root.join(run.folder());
            let Some(record) = read_record(root, run)? else {
                missing.push(run);
                continue;
            };
            gathered.folders.insert(run.folder().display().to_string(), folder);
            match gathered.studies.last_mut() {
                Some(study) if study.case == run.case => study.records.push(record),
                _ => gathered.studies.push(CaseStudy::new(&run.case, vec![record])),
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
        let absent = || Error::Input(format!("{place} is not among the runs read"));
        self.folders.get(&place).map(PathBuf::as_path).ok_or_else(absent)
    }

    /// Forms every verdict by the checks as they are now; `drift` gives those on drift.
    ///
    /// # Errors
    /// A case that is not known, or an error of `drift`.
    pub fn judge(&self, drift: impl Fn(&Record) -> Result<Vec<Verdict>, Error> + Sync) -> Result<Summary, Error> {
        let cases = self.studies.iter().map(|study| judged(study, &drift));
        Ok(Summary::new(&self.tier, cases.collect::<Result<_, _>>()?))
    }

    /// As [`Self::judge`], of the runs of one case.
    ///
    /// # Errors
    /// It has none, or as there.
    pub fn judge_case(
        &self,
        case: &Case,
        drift: impl Fn(&Record) -> Result<Vec<Verdict>, Error> + Sync,
    ) -> Result<CaseStudy, Error> {
        let absent = || Error::Input(format!("the folder has no runs of {}", case.name));
        judged(self.studies.iter().find(|study| study.case == case.name).ok_or_else(absent)?, &drift)
    }
}

/// A study with its verdicts.
fn judged(
    study: &CaseStudy,
    drift: &(impl Fn(&Record) -> Result<Vec<Verdict>, Error> + Sync),
) -> Result<CaseStudy, Error> {
    let mut study = study.clone();
    let case = cases::find(&study.case)?;
    study.records.par_iter_mut().try_for_each(|record| {
        // What it vouches for was compared when it was read.
        record.files.clear();
        record.verdicts = judge(case, record);
        record.verdicts.extend(drift(record)?);
        Ok::<(), Error>(())
    })?;
    study.verdicts = case.judge_study(&study.records);
    study.convergence = convergence(case, &study.records);
    Ok(study)
}

/// Whether one program made all records.
fn of_one_program<'a>(mut records: impl Iterator<Item = &'a Record>) -> Result<(), Error> {
    let Some(first) = records.next() else { return Ok(()) };
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
    let Some((first, whole)) = plans.first() else { return Err(Error::Input("no folder is given".to_owned())) };
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
    let missing: Vec<String> = (1..=whole.shard.count).filter(|k| !given(k)).map(|k| k.to_string()).collect();
    if missing.is_empty() {
        Ok(plans)
    } else {
        Err(Error::Input(format!("of {} shards these are missing: {}", whole.shard.count, missing.join(", "))))
    }
}

/// The record of a planned run below `root`, or `None` if the run has not ended.
fn read_record(root: &Path, run: &PlannedRun) -> Result<Option<Record>, Error> {
    require_inside(root, &run.folder())?;
    let (folder, (case, spec)) = (root.join(run.folder()), run.resolve()?);
    match record_in(&folder, case, &spec)? {
        Some(record) if record.set != run.set => {
            Err(Error::file(&folder.join(RECORD), format!("of another run: {} {}", record.case, record.folder())))
        }
        found => Ok(found),
    }
}
