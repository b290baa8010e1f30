//! Which checks see which fault: the file that a run of the faults leaves, and the page that shows it.

use crate::faults::faults;
use mpm_verify::cases;
use mpm_verify::verdict::Kind;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// The file, and the page that is made of it, from the root of the repository.
pub(crate) const FILE: &str = "mpm-verify/assets/kills.csv";
pub(crate) const PAGE: &str = "docs/notes/kill-matrix.md";

const HEAD: &str = "fault,case,checks";

/// A check of a case.
pub(crate) type Seer = (String, String);

/// The checks that see every fault, by the name of the fault.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Kills(pub(crate) BTreeMap<String, BTreeSet<Seer>>);

impl Kills {
    /// Reads the file of the repository.
    pub(crate) fn read(root: &Path) -> Self {
        let text = fs::read_to_string(root.join(FILE)).unwrap();
        let mut kills = Self::default();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some(HEAD), "{FILE}");
        for line in lines {
            // Names of faults may have commas.
            let mut cells = line.rsplitn(3, ',');
            let [checks, case, fault] = [(); 3].map(|()| cells.next().unwrap());
            let seers = checks.split(';').map(|check| (case.to_owned(), check.to_owned()));
            kills.0.entry(fault.trim_matches('"').to_owned()).or_default().extend(seers);
        }
        kills
    }

    /// Writes the file and its page.
    pub(crate) fn write(&self, root: &Path) {
        let mut text = format!("{HEAD}\n");
        for (fault, seers) in &self.0 {
            let mut cases: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
            seers.iter().for_each(|(case, check)| cases.entry(case).or_default().push(check));
            for (case, checks) in cases {
                writeln!(text, "\"{fault}\",{case},{}", checks.join(";")).unwrap();
            }
        }
        fs::write(root.join(FILE), text).unwrap();
        fs::write(root.join(PAGE), self.page()).unwrap();
    }

    /// Faults by the number of checks that see them.
    fn alone(&self) -> impl Iterator<Item = (&str, &Seer)> {
        let few = self.0.iter().filter(|(_, seers)| seers.len() == 1);
        few.flat_map(|(fault, seers)| seers.iter().map(move |seer| (fault.as_str(), seer)))
    }

    /// Faults that no check against the truth sees.
    fn untrue(&self) -> BTreeSet<&str> {
        let judges = |(case, check): &Seer| {
            let mut checks = cases::find(case).unwrap().checks.iter();
            checks.any(|c| c.name == check && c.kind == Kind::Truth)
        };
        let unseen = self.0.iter().filter(|(_, seers)| !seers.iter().any(judges));
        unseen.map(|(fault, _)| fault.as_str()).collect()
    }

    /// The page.
    pub(crate) fn page(&self) -> String {
        let mut page = INTRODUCTION.to_owned();
        let alone: Vec<_> = self.alone().collect();
        let (count, few) = (self.0.len(), alone.len());
        let untrue = self.untrue();
        let sees = format!("Checks against the truth see {} of {count} faults.", count - untrue.len());
        let others = "The others are marked **no truth**: bookkeeping, a breakdown, a regression band or a known limit\nsees them.";
        writeln!(page, "\n{sees}\n{others}").unwrap();
        writeln!(page, "{few} faults hang on one check only and are marked **alone**.\n").unwrap();
        writeln!(page, "| file | fault | seen by |\n|---|---|---|").unwrap();
        for fault in faults() {
            let none = BTreeSet::new();
            let seers = self.0.get(fault.name).unwrap_or(&none);
            let mut of_case: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
            for (case, check) in seers {
                of_case.entry(case).or_default().push(check);
            }
            let cells = of_case.iter().map(|(case, checks)| {
                let checks: Vec<String> = checks.iter().map(|c| format!("`{c}`")).collect();
                format!("{case}: {}", checks.join(" "))
            });
            let cells: Vec<String> = cells.collect();
            let alone = if seers.len() == 1 { "**alone** " } else { "" };
            let mark = if untrue.contains(fault.name) { format!("{alone}**no truth** ") } else { alone.to_owned() };
            let (file, name) = (fault.file, fault.name);
            let cells = cells.join("; ");
            writeln!(page, "| `{file}` | {name} | {mark}{cells} |").unwrap();
        }
        let mut by_check: BTreeMap<&Seer, Vec<&str>> = BTreeMap::new();
        for (fault, seers) in &self.0 {
            for seer in seers {
                by_check.entry(seer).or_default().push(fault);
            }
        }
        page.push_str("\n## Check by check\n\n");
        page.push_str("| case | check | faults that it sees | of them alone |\n|---|---|---|---|\n");
        for (seer, seen) in &by_check {
            let own = alone.iter().filter(|(_, by)| by == seer).count();
            let (case, check) = seer;
            let own = if own == 0 { String::new() } else { own.to_string() };
            writeln!(page, "| {case} | `{check}` | {} | {own} |", seen.len()).unwrap();
        }
        page
    }
}

const INTRODUCTION: &str = "# Which check sees which fault

Written by `just mutants` from its own runs: every [seeded fault](../verification.md#seeded-faults) in all runs that
reach the line it breaks, and the checks that go red there. Three sets of runs that take seconds each, a landslide and
two of a slope that is cut, are made for their own faults only. A check is named once a case, however many of the
runs see the fault by it.

A fault that one check alone sees tells what would be lost with that check.
";
