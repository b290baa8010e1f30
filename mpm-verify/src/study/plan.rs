//! Plan of a folder of runs, and the share of it to run.

use super::*;
use crate::spec::{Level, run_folder};

/// Version of the plan's format.
const SCHEMA: u32 = 1;
/// Name of the plan's file.
pub(super) const FILE: &str = "plan.json";
/// Maximum number of shards; more is almost certainly a typo.
const MAX_SHARDS: usize = 10_000;

/// A share of a plan: the `index`-th of `count`, counted from one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Which.
    pub index: usize,
    /// Number of shards.
    pub count: usize,
}

impl Shard {
    /// All there is.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// From `i/n`.
    ///
    /// # Errors
    /// The text is not of that form, or i is not between 1 and n.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let plain = text.bytes().all(|b| b.is_ascii_digit() || b == b'/');
        text.split_once('/')
            .filter(|_| plain)
            .and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)))
            .map(|(index, count)| Self { index, count })
            .filter(|s| (1..=s.count).contains(&s.index) && s.count <= MAX_SHARDS)
            .ok_or_else(|| {
                Error::Input(format!("--shard \"{text}\" is not allowed; allowed: i/n with 1 ≤ i ≤ n ≤ {MAX_SHARDS}"))
            })
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// A run of a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedRun {
    pub(crate) case: String,
    pub(crate) scheme: Scheme,
    pub(crate) level: String,
    /// Parameters changed from the defaults, as `name=value`.
    pub(crate) set: Vec<String>,
    /// Index of the shard that makes it.
    pub(crate) shard: usize,
}

impl PlannedRun {
    /// Made by the first shard.
    fn of(case: &Case, scheme: Scheme, level: &Level, set: Vec<String>) -> Self {
        Self { case: case.name.to_owned(), scheme, level: level.name.to_owned(), set, shard: 1 }
    }

    /// Folder of the run's outputs below that of the report.
    #[must_use]
    pub fn folder(&self) -> PathBuf {
        Path::new(&self.case).join(run_folder(self.scheme, &self.level, &self.set))
    }

    /// The case and what to run of it.
    ///
    /// # Errors
    /// The case or the level is not known to this program.
    pub fn resolve(&self) -> Result<(&'static Case, RunSpec), Error> {
        resolve(&self.case, self.scheme, &self.level, &self.set)
    }
}

/// The case and what to run of it, by the names of case and level.
fn resolve(case: &str, scheme: Scheme, level: &str, set: &[String]) -> Result<(&'static Case, RunSpec), Error> {
    let case = cases::find(case)?;
    Ok((case, RunSpec { scheme, level: find_level(case, level)?, set: set.to_vec(), perturbed: false }))
}

/// The case of a record and what was run of it.
pub(crate) fn resolve_record(r: &Record) -> Result<(&'static Case, RunSpec), Error> {
    let (case, spec) = resolve(&r.case, r.scheme(), &r.level, &r.set)?;
    Ok((case, RunSpec { perturbed: r.perturbed, ..spec }))
}

/// The plan of a folder of runs; it is written there before the first run begins.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Version of this format.
    pub(crate) schema: u32,
    /// Tier.
    pub tier: String,
    /// The share of this folder.
    pub shard: Shard,
    /// Every run of every shard, in the order of the report.
    pub runs: Vec<PlannedRun>,
}

/// Tier of a plan of runs that a user chose.
pub(super) const SWEEP: &str = "sweep";

impl Plan {
    /// The plan of runs of `case` with each of these schemes on each of these levels, with the same changed parameters.
    ///
    /// # Errors
    /// A run is there twice.
    pub fn sweep(case: &Case, schemes: &[Scheme], levels: &[Level], set: &[String]) -> Result<Self, Error> {
        let of = |scheme| levels.iter().map(move |level| PlannedRun::of(case, scheme, level, set.to_vec()));
        let runs = schemes.iter().copied().flat_map(of).collect();
        let plan = Self { schema: SCHEMA, tier: SWEEP.to_owned(), shard: Shard::WHOLE, runs };
        plan.check().map_err(Error::Input)?;
        Ok(plan)
    }

    /// The plan of `cases` for `tier`. The shards are dealt the runs in turn, the costliest first.
    ///
    /// # Errors
    /// The cases have no runs in this tier, or fewer than there are shards.
    pub fn new<'a>(cases: impl IntoIterator<Item = &'a Case>, tier: Tier, shard: Shard) -> Result<Self, Error> {
        let mut runs = Vec::new();
        let mut costs = Vec::new();
        for case in cases {
            for spec in case.runs(tier) {
                costs.push((case.cost)(&spec));
                runs.push(PlannedRun::of(case, spec.scheme, &spec.level, spec.set));
            }
        }
        if runs.len() < shard.count {
            return Err(Error::Input(format!("tier {tier} has {} runs for {} shards", runs.len(), shard.count)));
        }
        let mut order: Vec<usize> = (0..runs.len()).collect();
        order.sort_by(|&a, &b| costs[b].total_cmp(&costs[a]));
        for (turn, k) in order.into_iter().enumerate() {
            runs[k].shard = turn % shard.count + 1;
        }
        Ok(Self { schema: SCHEMA, tier: tier.to_string(), shard, runs })
    }

    /// The runs of this folder.
    pub fn own(&self) -> impl Iterator<Item = &PlannedRun> {
        self.runs.iter().filter(|r| r.shard == self.shard.index)
    }

    /// Whether the two are shares of the same whole.
    pub(crate) fn is_of_one_whole_with(&self, other: &Self) -> bool {
        self.tier == other.tier && self.shard.count == other.shard.count && self.runs == other.runs
    }

    /// Difference from the plan of this program for its tier and its cases, if there is one: such a plan is not that of
    /// the tier it names.
    ///
    /// # Errors
    /// A tier or case that is not known.
    pub fn gap(&self) -> Result<Option<String>, Error> {
        if self.tier == SWEEP {
            return Ok(None);
        }
        let tier = Tier::parse(&self.tier)?;
        for name in distinct(self.runs.iter().map(|run| &run.case)) {
            let case = cases::find(name)?;
            let planned: BTreeSet<String> = case.runs(tier).iter().map(RunSpec::folder).collect();
            let own = self.runs.iter().filter(|run| run.case == *name);
            let own: BTreeSet<String> = own.map(|run| run_folder(run.scheme, &run.level, &run.set)).collect();
            if own != planned {
                let (found, all) = (own.intersection(&planned).count(), planned.len());
                return Ok(Some(format!(
                    "incomplete: of the {all} runs that tier {tier} has of {name} the plan has {found}"
                )));
            }
        }
        Ok(None)
    }

    /// Writes the plan into its folder.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Error> {
        write_json(&folder.join(FILE), self)
    }

    /// Reads the plan of a folder.
    ///
    /// # Errors
    /// It is missing, damaged or of another schema.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(FILE);
        if !path.exists() {
            return Err(Error::file(
                folder,
                format!("no {FILE} and no record: not a folder that `verify` or `run` has written"),
            ));
        }
        let plan: Self = crate::files::read_versioned(&path, SCHEMA)?;
        plan.check().map_err(|why| Error::file(&path, why))?;
        Ok(plan)
    }

    /// Checks the invariants of a plan that was read.
    fn check(&self) -> Result<(), String> {
        let Shard { index, count } = self.shard;
        if !(1..=MAX_SHARDS).contains(&count) || !(1..=count).contains(&index) {
            return Err(format!("shard {index}/{count}; allowed: 1 ≤ i ≤ n ≤ {MAX_SHARDS}"));
        }
        if self.runs.is_empty() {
            return Err("no runs".to_owned());
        }
        if self.tier != SWEEP {
            Tier::parse(&self.tier).map_err(|e| e.to_string())?;
        }
        let mut seen = BTreeSet::new();
        for run in &self.runs {
            let folder = run.folder();
            let names =
                run.resolve().and_then(|(case, spec)| Ok(Parameters::new(&case.parameters, &spec.set).map(drop)?));
            names.map_err(|e| e.to_string())?;
            if !(1..=count).contains(&run.shard) {
                return Err(format!("{}: shard {}; allowed: 1 to {count}", folder.display(), run.shard));
            }
            if !seen.insert(folder.clone()) {
                return Err(format!("{} is there twice", folder.display()));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_read_and_bad_ones_refused() {
        assert_eq!(Shard::parse("2/4").unwrap(), Shard { index: 2, count: 4 });
        for bad in ["0/4", "5/4", "1", "a/b", "1/0", "-1/4", "1/4/2", "1/100000", "+1/4", "1/+4"] {
            let error = Shard::parse(bad).unwrap_err().to_string();
            assert!(error.contains(bad) && error.contains("1 ≤ i ≤ n"), "{error}");
        }
    }

    #[test]
    fn every_run_belongs_to_exactly_one_shard_and_shards_are_alike() {
        let all = cases::all();
        let plan = |index| Plan::new(all, Tier::Nightly, Shard { index, count: 4 }).unwrap();
        let whole = plan(1);
        assert!((1..=4).all(|k| plan(k).is_of_one_whole_with(&whole)));
        let sizes: Vec<usize> = (1..=4).map(|k| plan(k).own().count()).collect();
        assert_eq!(sizes.iter().sum::<usize>(), whole.runs.len());
        assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 1);
        let costliest = |k: usize| plan(k).own().any(|r| r.level == "h0.25");
        assert!((1..=4).all(costliest));
    }

    #[test]
    fn no_run_is_planned_twice_and_a_long_plan_has_the_night() {
        let all = cases::all();
        let of = |tier| Plan::new(all, tier, Shard::WHOLE).unwrap();
        for tier in [Tier::Quick, Tier::Pr, Tier::Nightly, Tier::Long] {
            of(tier).check().unwrap();
        }
        let long = of(Tier::Long);
        let same = |a: &PlannedRun, b: &PlannedRun| a.folder() == b.folder();
        let has = |run: &PlannedRun| long.runs.iter().any(|other| same(run, other));
        assert!(of(Tier::Nightly).runs.iter().all(has));
    }

    #[test]
    fn a_sweep_has_every_pair_once_and_is_no_tier() {
        let case = cases::find("cook").unwrap();
        let schemes = &case.schemes()[..2];
        let plan = Plan::sweep(case, schemes, &case.levels[..3], &[]).unwrap();
        assert_eq!((plan.own().count(), plan.gap().unwrap()), (6, None));
        let twice = [case.levels[0]; 2];
        assert!(Plan::sweep(case, schemes, &twice, &[]).unwrap_err().to_string().contains("h"));
    }

    #[test]
    fn more_shards_than_runs_are_refused() {
        let shard = Shard { index: 1, count: 100 };
        assert!(Plan::new(cases::all(), Tier::Quick, shard).is_err());
    }
}
