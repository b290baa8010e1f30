//! Judgement of given records: reads records from standard input, one JSON object a line, with their parameters at
//! default or as `set` has them; writes the verdicts on every run, then those on the runs of every case together.
//!
//! `scripts/same_results.py collect` gives it the kept rows, to compare the checks before and after a change.

use mpm_verify::parameter::Parameters;
use mpm_verify::record::Record;
use mpm_verify::study::judge::judge;
use mpm_verify::verdict::Verdict;
use mpm_verify::{cases, error::Error};
use serde::Serialize;
use std::io::{BufWriter, Write, stdin, stdout};

#[derive(Serialize)]
struct Judged<'a> {
    case: &'a str,
    /// Folder of the run; none for the runs of the case together.
    run: Option<String>,
    verdicts: &'a [Verdict],
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut records: Vec<Record> = Vec::new();
    for line in stdin().lines() {
        records.push(serde_json::from_str(&line?)?);
    }
    for record in &mut records {
        let case = cases::find(&record.case)?;
        record.solver = record.scheme.solver().to_owned();
        record.parameters = Parameters::new(&case.parameters, &record.set).map_err(Error::from)?;
        record.verdicts = judge(case, record);
    }
    let mut out = BufWriter::new(stdout().lock());
    let mut write = |judged: Judged| -> Result<(), Box<dyn std::error::Error>> {
        serde_json::to_writer(&mut out, &judged)?;
        Ok(out.write_all(b"\n")?)
    };
    for case in cases::all() {
        let own = records.iter().filter(|r| r.case == case.name);
        let own: Vec<Record> = own.cloned().collect();
        for record in &own {
            write(Judged { case: case.name, run: Some(record.folder()), verdicts: &record.verdicts })?;
        }
        write(Judged { case: case.name, run: None, verdicts: &case.judge_study(&own) })?;
    }
    Ok(())
}
