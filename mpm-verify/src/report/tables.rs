//! The tables of results in README and docs, the numbers in their sentences, and the summary of all nights, filled from the
//! rows that are kept.
//!
//! A table stands between `<!-- table NAME -->` and `<!-- end -->`, each on a line of its own.

use super::document::Text;
use super::prelude::*;
use super::rows::RESULTS;
use super::speed::Speed;
use super::values::Values;
use super::{board, criteria, map, rivals, rows, speed, summary};
use crate::files::entries;

const BEGIN: &str = "<!-- table ";
const CLOSE: &str = " -->";
const END: &str = "<!-- end -->";
/// Columns of a line of text.
const LINE: usize = 110;
const GIST: &str = "reports/nightly/summary.md";
/// Most bytes of the summary.
const MOST_GIST: usize = 100_000;

/// A page with its tables and numbers as they should be.
#[derive(Debug)]
pub struct Page {
    /// File.
    pub file: PathBuf,
    /// Names of the tables and numbers that are not as they should be.
    pub stale: Vec<String>,
    text: String,
}

impl Page {
    /// The pages of the repository in `root`: its README, those of docs and docs/notes, and the summary of all nights.
    ///
    /// # Errors
    /// Rows or pages are missing or damaged; a page has a block or a number that nothing fills or that does not end.
    pub fn all(root: &Path) -> Result<Vec<Self>, Error> {
        let results = root.join(RESULTS);
        if !results.exists() {
            return Err(Error::file(&results, "there is no such file"));
        }
        let rows = rows::read(&results)?;
        let (mut tables, values) = (tables(&rows)?, Values::new(&rows));
        let codes = root.join("mpm-verify/codes");
        if codes.exists() {
            let kept: Vec<Record> = rows.iter().filter_map(rows::Row::record).collect();
            let board = board::tables(&board::among(&[codes], &kept)?);
            tables.extend(board.into_iter().map(|(name, sheet)| (name, sheet.markdown())));
        }
        let mut files = [entries(&root.join("docs"))?, entries(&root.join("docs/notes"))?].concat();
        files.retain(|file| file.extension().is_some_and(|e| e == "md"));
        files.insert(0, root.join("README.md"));
        let pages = files.into_iter().map(|file| Self::read(file, &tables, &values));
        let mut pages = pages.collect::<Result<Vec<Self>, Error>>()?;
        pages.push(Self::gist(root.join(GIST), &rows)?);
        Ok(pages)
    }

    /// The summary of all nights.
    fn gist(file: PathBuf, rows: &[rows::Row]) -> Result<Self, Error> {
        let studied = |case: &Case| {
            let own = rows.iter().filter(|row| row.case == case.name).filter_map(rows::Row::record);
            let mut study = CaseStudy::new(case.name, own.collect());
            study.convergence = convergence(case, &study.records);
            study
        };
        let studies = cases::all().iter().map(studied).filter(|study| !study.records.is_empty());
        let text = summary::of_rows(studies.collect(), &programs(&dated(rows)))?;
        if text.len() > MOST_GIST {
            return Err(Error::file(&file, format!("{} bytes where {MOST_GIST} are allowed", text.len())));
        }
        let same = file.exists() && read_text(&file)? == text;
        let stale = if same { Vec::new() } else { vec!["all of it".to_owned()] };
        Ok(Self { file, stale, text })
    }

    fn read(file: PathBuf, tables: &BTreeMap<String, String>, values: &Values) -> Result<Self, Error> {
        let old = read_text(&file)?;
        let (mut text, mut stale) = (String::new(), Vec::new());
        let mut lines = old.split_inclusive('\n').enumerate();
        while let Some((k, line)) = lines.next() {
            let refuse = |cause: String| Error::file(&file, format!("line {}: {cause}", k + 1));
            let (line, changed) = values.fill(line).map_err(|e| refuse(e.to_string()))?;
            text.push_str(&line);
            stale.extend(changed);
            let Some(comment) = line.trim_end().strip_prefix("<!-- ") else { continue };
            let Some(name) = line.trim_end().strip_prefix(BEGIN) else {
                return Err(refuse(format!("nothing fills the block <!-- {comment}")));
            };
            let name = name.trim_end_matches(CLOSE);
            let Some(table) = tables.get(name) else {
                return Err(refuse(Error::unknown("table", name, tables.keys().map(String::as_str)).to_string()));
            };
            let mut former = String::new();
            loop {
                match lines.next() {
                    Some((_, line)) if line.trim_end() == END => break,
                    Some((_, line)) if !line.starts_with("<!--") => former.push_str(line),
                    _ => return Err(refuse(format!("the block {name} does not end"))),
                }
            }
            if former != *table {
                stale.push(name.to_owned());
            }
            text.push_str(table);
            text.push_str(END);
            text.push('\n');
        }
        Ok(Self { file, stale, text })
    }

    /// Writes its tables as they should be, if any is not.
    ///
    /// # Errors
    /// The file can't be written.
    pub fn write(&self) -> Result<(), Error> {
        if self.stale.is_empty() { Ok(()) } else { write_whole(&self.file, self.text.as_bytes()) }
    }
}

fn dated(rows: &[rows::Row]) -> Vec<(Record, Date)> {
    rows.iter().filter_map(|row| Some((row.record()?, row.night))).collect()
}

/// The programs whose runs are shown, the newest first, with how many are planned for a night, and how many beyond.
fn programs(kept: &[(Record, Date)]) -> Sheet {
    let nightly = cases::all().iter().flat_map(|c| c.runs(Tier::Nightly).into_iter().map(|s| (c.name, s.folder())));
    let nightly: BTreeSet<(&str, String)> = nightly.collect();
    let mut all = distinct(kept.iter().map(|(r, night)| (std::cmp::Reverse(*night), &*r.version.source)));
    all.sort_unstable();
    let row = |(night, program): (std::cmp::Reverse<Date>, &str)| {
        let of = |(r, at): &&(Record, Date)| *at == night.0 && r.version.source == program;
        let own = || kept.iter().filter(of).map(|(r, _)| r);
        let in_night = own().filter(|r| nightly.contains(&(&*r.case, r.folder()))).count();
        let names = distinct(own().map(|r| &*r.case)).join(", ");
        vec![
            night.0.to_string(),
            program.to_owned(),
            in_night.to_string(),
            (own().count() - in_night).to_string(),
            names,
        ]
    };
    Sheet::new(["night", "program", "runs of a night", "larger ones", "cases"]).with(all.into_iter().map(row))
}

/// Every table by its name, in Markdown.
fn tables(rows: &[rows::Row]) -> Result<BTreeMap<String, String>, Error> {
    let kept = dated(rows);
    let records = || kept.iter().map(|(r, _)| r);
    let table = |table: &ResultTable, case: Option<&str>| {
        let sheet = table.fill(records().filter(|r| case.is_none_or(|case| r.case == case)));
        (table.name.clone(), sheet.markdown())
    };
    let studies = cases::all()
        .iter()
        .map(|case| CaseStudy::new(case.name, records().filter(|r| r.case == case.name).cloned().collect()));
    let studies: Vec<CaseStudy> = studies.collect();
    let speed = Speed::of(&studies);
    let wrapped = |text: &str| {
        let options = textwrap::Options::new(LINE);
        textwrap::fill(text, options.word_splitter(textwrap::WordSplitter::NoHyphenation))
    };
    let nights = || kept.iter().map(|(_, night)| night);
    let outcomes = match (nights().min(), nights().max()) {
        (Some(oldest), Some(newest)) => {
            let counts = Summary::new("", studies).counts.to_string();
            let counts: Vec<&str> = counts.lines().take(2).collect();
            let of = format!("Nights of {oldest} to {newest}, each run judged by the program of its night:");
            format!("{}\n", wrapped(&format!("{of} {}", counts.join(" "))))
        }
        _ => String::new(),
    };
    let unless = |empty: bool, text: String| if empty { String::new() } else { text };
    let prices = format!("{}\n{}\n", speed.table().markdown(), wrapped(&speed.advice()));
    let (sheet, advice) = rivals::table(&records().collect::<Vec<_>>())?;
    let rivals = format!("{}\n{}\n", sheet.markdown(), wrapped(&advice));
    let panels = map::panels(records(), &speed);
    let map = map::PANELS.map(|name| {
        let text = panels.iter().find(|panel| panel.name == name).map(|panel| {
            let page = |case: &str| Text::link(case, format!("../{case}.md"));
            let marks = panel.marks().markdown();
            let below = if marks.is_empty() { marks } else { format!("\n{marks}\n") };
            panel.table(page, false).markdown() + &below
        });
        (format!("map-{name}"), text.unwrap_or_default())
    });
    let of_cases = cases::all().iter().flat_map(|c| c.tables.iter().map(|t| table(t, Some(c.name))));
    let over_cases = criteria::all();
    let over_cases = over_cases.iter().map(|t| table(t, None)).chain(map);
    let costs = [
        ("outcomes", outcomes),
        (speed::NAME, unless(speed.is_empty(), prices)),
        (rivals::NAME, unless(sheet.rows.is_empty(), rivals)),
        ("programs", programs(&kept).markdown()),
    ];
    Ok(of_cases.chain(over_cases).chain(costs.map(|(name, text)| (name.to_owned(), text))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    const ROWS: &str = "case,scheme,level,set,h,status,right,wrong_as_known,not_judged,failed,particles,steps,particle_node_pairs,cpu_s,night,program,metrics
slope-stability,gimp-none-flip,h0.2,,0.2,ok,0,0,0,0,1,1,1,1.5,2026-01-02,abc,stands_at=2.5;fails_at=2.75;strength_reduction_factor=2.6
slope-stability,gimp-none-flip,h0.1,,0.1,failed at 1.5 s,0,0,0,0,1,1,1,1.5,2026-01-01,def,
";

    /// A repository whose README shows `shown`.
    fn repository(shown: &str) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        let write = |file: &str, text: &str| {
            write_whole(&root.path().join(file), text.as_bytes()).unwrap();
        };
        write(RESULTS, ROWS);
        write("README.md", shown);
        root
    }

    fn refusal(shown: &str) -> String {
        let root = repository(shown);
        Page::all(root.path()).unwrap_err().to_string()
    }

    #[test]
    fn tables_are_filled_in_place_and_a_changed_digit_is_stale() {
        let root = repository("# Title\n\n<!-- table slope-stability -->\n<!-- end -->\n\nEnd.\n");
        let readme = root.path().join("README.md");
        let stale = || {
            let pages = Page::all(root.path()).unwrap();
            let page = pages.into_iter().find(|p| p.file == readme).unwrap();
            page.write().unwrap();
            page.stale
        };
        assert_eq!(stale(), ["slope-stability"]);
        let filled = fs::read_to_string(&readme).unwrap();
        let table = "<!-- table slope-stability -->
| scheme | h = 0.4 m | 0.2 m | 0.1 m | CPU (s), h = 0.4 m | CPU (s), 0.2 m | CPU (s), 0.1 m |
|---|---|---|---|---|---|---|
| gimp none |  | 2.600 (2.500 … 2.750) | breaks down at 1.50 s |  | 1.50 |  |
<!-- end -->
";
        assert_eq!(filled, format!("# Title\n\n{table}\nEnd.\n"));
        assert!(stale().is_empty());
        fs::write(&readme, filled.replace("2.600", "2.601")).unwrap();
        assert_eq!(stale(), ["slope-stability"]);
        assert_eq!(fs::read_to_string(&readme).unwrap(), filled);
    }

    #[test]
    fn what_nothing_fills_is_named_with_file_and_line() {
        let unknown = refusal("\n<!-- table slopes -->\n<!-- end -->\n");
        assert!(unknown.contains("README.md: line 2: unknown table \"slopes\""), "{unknown}");
        for open in ["<!-- table slope -->\n|", "<!-- table slope -->\n<!-- table cook -->\n<!-- end -->\n"] {
            let endless = refusal(open);
            assert!(endless.contains("line 1: the block slope does not end"), "{endless}");
        }
        for block in ["<!-- results -->\n<!-- end -->\n", "<!-- end -->\n"] {
            let unfilled = refusal(block);
            assert!(unfilled.contains("line 1: nothing fills the block"), "{unfilled}");
        }
    }

    #[test]
    fn a_missing_file_is_an_error() {
        for file in [RESULTS, "README.md"] {
            let root = repository("");
            fs::remove_file(root.path().join(file)).unwrap();
            let missing = Page::all(root.path()).unwrap_err().to_string();
            assert!(missing.contains(file), "{file}");
        }
    }

    #[test]
    fn every_column_of_every_table_says_something() {
        let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(RESULTS);
        let mut empty = Vec::new();
        for (name, table) in tables(&rows::read(&kept).unwrap()).unwrap() {
            let rows = table.lines().filter(|l| l.starts_with('|'));
            let rows: Vec<Vec<&str>> = rows.map(|l| l.split(" | ").collect()).collect();
            let says = |k: usize| rows.iter().skip(2).any(|row| !["", "–"].contains(&row[k].trim_matches(['|', ' '])));
            let columns = rows.first().map_or(0, Vec::len);
            empty.extend((0..columns).filter(|k| !says(*k)).map(|k| format!("{name}: {}", rows[0][k])));
        }
        assert_eq!(empty, Vec::<String>::new());
    }
}
