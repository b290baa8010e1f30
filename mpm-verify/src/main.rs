//! The program `mpm-verify`: from its command line to the library.

mod cli;
mod progress;

use clap::Parser;
use cli::run::run_one;
use cli::{Cli, Command, one_line, say};
use mpm_verify::bench::{self, Peers};
use mpm_verify::bless::Candidates;
use mpm_verify::case::{Case, Tier, find_level};
use mpm_verify::cases;
use mpm_verify::error::{Error, ExitCode};
use mpm_verify::exact;
use mpm_verify::golden::Goldens;
use mpm_verify::night::Night;
use mpm_verify::record::Version;
use mpm_verify::report::diff::Difference;
use mpm_verify::report::{describe, discard_report, keep::keep, shown, tables::Page, write_report};
use mpm_verify::run::checkpoint::Saving;
use mpm_verify::scheme::Scheme;
use mpm_verify::spec::RunSpec;
use mpm_verify::study::complete::Completeness;
use mpm_verify::study::gather::Gathered;
use mpm_verify::study::judge::exit_code;
use mpm_verify::study::plan::{Plan, Shard};
use mpm_verify::study::schedule::make_runs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn main() -> std::process::ExitCode {
    let outcome = match Cli::try_parse() {
        Ok(cli) => dispatch(cli.command),
        Err(error) if error.use_stderr() => Err(Error::Input(one_line(&error))),
        Err(help) => help
            .print()
            .map(|()| ExitCode::Good)
            .map_err(|e| Error::Input(e.to_string())),
    };
    let code = outcome.unwrap_or_else(|error| {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "error: {error}");
        ExitCode::Input
    });
    std::process::ExitCode::from(code as u8)
}

/// More threads than this are surely a slip.
const MAX_THREADS: usize = 1024;

fn parse_threads(threads: Option<usize>) -> Result<usize, Error> {
    match threads {
        Some(n) if !(1..=MAX_THREADS).contains(&n) => Err(Error::Input(format!(
            "--threads {n} is not allowed; allowed: 1 to {MAX_THREADS}"
        ))),
        Some(n) => Ok(n),
        None => Ok(std::thread::available_parallelism().map_or(1, usize::from)),
    }
}

fn dispatch(command: Command) -> Result<ExitCode, Error> {
    match command {
        Command::List { tier, format } => list(tier.as_deref(), &format),
        Command::Explain { case } => {
            say(&describe::explain(cases::find(&case)?))?;
            Ok(ExitCode::Good)
        }
        Command::Run {
            case,
            scheme,
            solver,
            basis,
            remedy,
            transfer,
            level,
            set,
            perturb,
            out,
            resume,
            checkpoint_every,
            threads,
        } => {
            let case = cases::find(&case)?;
            let scheme = match scheme {
                Some(name) => Scheme::parse(&name)?,
                None => {
                    let [solver, basis, remedy, transfer] =
                        [&solver, &basis, &remedy, &transfer].map(Option::as_deref);
                    let own = case.default_scheme(solver);
                    let [basis, remedy, transfer] = [
                        basis.unwrap_or(own.basis().text()),
                        remedy.unwrap_or(own.remedy().text()),
                        transfer.unwrap_or(own.transfer().text()),
                    ];
                    Scheme::of_parts(solver.unwrap_or(own.solver()), basis, remedy, transfer)?
                }
            };
            let level = match level {
                Some(name) => find_level(case, &name)?,
                None => case.levels[0],
            };
            let spec = RunSpec {
                scheme,
                level,
                set,
                perturbed: perturb,
            };
            let saving = saving(checkpoint_every, resume.is_some());
            let folder = resume.or(out);
            let place = folder.as_deref().map(|folder| (folder, saving));
            run_one(case, &spec, place, parse_threads(threads)?)
        }
        Command::Verify {
            cases: names,
            tier,
            shard,
            resume,
            checkpoint_every,
            out,
            golden,
            threads,
        } => {
            let shard = match shard {
                Some(text) => Shard::parse(&text)?,
                None => Shard::WHOLE,
            };
            let plan = Plan::new(chosen(names)?, Tier::parse(&tier)?, shard)?;
            let saving = saving(checkpoint_every, resume);
            verify(&plan, saving, &out, &golden, parse_threads(threads)?)
        }
        Command::Report {
            folders,
            out,
            golden,
            night,
            commit,
        } => {
            let out = match (out, &folders[..]) {
                (Some(out), _) => out,
                (None, [folder]) => folder.clone(),
                (None, _) => {
                    return Err(Error::Input(
                        "several folders: --out must say where the report goes".to_owned(),
                    ));
                }
            };
            let night = match night.zip(commit) {
                Some((date, commit)) => Some(Night::new(&date, &commit)?),
                None => None,
            };
            report_on(&folders, &out, &Goldens::open(&golden)?, night.as_ref())
        }
        Command::Keep { report, into } => {
            let rows = keep(&report, &into)?;
            say(&format!("{rows} runs are kept in {}\n", into.display()))?;
            Ok(ExitCode::Good)
        }
        Command::Tables { check, root } => tables(&root, check),
        Command::Pictures { from, root } => {
            say(&shown::draw(&root, &from)?)?;
            Ok(ExitCode::Good)
        }
        Command::Complete { tier, rows } => {
            let plan = Plan::new(cases::all(), Tier::parse(&tier)?, Shard::WHOLE)?;
            let found = Completeness::of(&plan, &rows, &Version::current().source)?;
            say(&found.to_string())?;
            found.require().map(|()| ExitCode::Good)
        }
        Command::Bless {
            case,
            reason,
            from,
            golden,
            threads,
        } => bless(
            cases::find(&case)?,
            &reason,
            &from,
            &golden,
            parse_threads(threads)?,
        ),
        Command::Diff { old, new, out } => {
            let difference = Difference::between(&old, &new)?;
            if let Some(out) = out {
                difference.write(&out)?;
            }
            say(&difference.text())?;
            Ok(difference.exit_code())
        }
        Command::Exact {
            name,
            at,
            time,
            set,
        } => {
            say(&exact::State::ask(&name, &at, &time, &set)?.json()?)?;
            Ok(ExitCode::Good)
        }
        Command::Bench {
            rounds,
            threads,
            no_scaling,
            peers,
            python,
            out,
        } => {
            let options = bench::Options {
                rounds: parse_rounds(rounds)?,
                threads: compared_threads(threads)?,
                scaling: !no_scaling,
                peers: peers.map(|name| Peers::of(&name, python)).transpose()?,
            };
            let bar = progress::single("bench");
            let text = bench::measure(&options, &out, &|share| {
                bar.set_position((share * progress::SCALE) as u64);
            })?;
            bar.finish_and_clear();
            say(&text)?;
            Ok(ExitCode::Good)
        }
    }
}

/// More rounds than this are surely a slip.
const MAX_ROUNDS: usize = 1000;

fn parse_rounds(rounds: usize) -> Result<usize, Error> {
    match rounds {
        1..=MAX_ROUNDS => Ok(rounds),
        _ => Err(Error::Input(format!(
            "--rounds {rounds} is not allowed; allowed: 1 to {MAX_ROUNDS}"
        ))),
    }
}

/// One thread and the others that are asked for, all cores if none is.
fn compared_threads(asked: Vec<usize>) -> Result<Vec<usize>, Error> {
    let mut threads = vec![1];
    if asked.is_empty() {
        threads.push(parse_threads(None)?);
    }
    for n in asked {
        threads.push(parse_threads(Some(n))?);
    }
    threads.sort_unstable();
    threads.dedup();
    Ok(threads)
}

/// The named cases, in the order of all; all if none is named.
fn chosen(names: Vec<String>) -> Result<Vec<&'static Case>, Error> {
    for name in &names {
        cases::find(name)?;
    }
    let asked = |c: &&Case| names.is_empty() || names.iter().any(|n| n == c.name);
    Ok(cases::all().iter().filter(asked).collect())
}

fn list(tier: Option<&str>, format: &str) -> Result<ExitCode, Error> {
    let tier = tier.map(Tier::parse).transpose()?;
    let text = match format {
        "text" => describe::list_text(cases::all(), tier),
        "json" => describe::list_json(cases::all(), tier),
        other => return Err(Error::unknown("format", other, ["text", "json"])),
    };
    say(&text)?;
    Ok(ExitCode::Good)
}

/// Fills the tables of the pages in `root`, or, to check, says which are stale.
fn tables(root: &Path, check: bool) -> Result<ExitCode, Error> {
    let mut code = ExitCode::Good;
    for page in Page::all(root)? {
        for name in &page.stale {
            let what = if check { "stale" } else { "filled" };
            say(&format!("{}: {name} {what}\n", page.file.display()))?;
        }
        if check && !page.stale.is_empty() {
            code = ExitCode::TruthFailed;
        } else {
            page.write()?;
        }
    }
    Ok(code)
}

fn saving(seconds: u64, resume: bool) -> Saving {
    Saving {
        every: Duration::from_secs(seconds),
        resume,
    }
}

fn verify(
    plan: &Plan,
    saving: Saving,
    out: &Path,
    golden: &Path,
    workers: usize,
) -> Result<ExitCode, Error> {
    let names = plan.own().map(|run| run.folder().display().to_string());
    let listener = progress::Runs::new(names.collect());
    // A folder of goldens that is not there is told before hours of runs.
    let goldens = Goldens::open(golden)?;
    discard_report(out)?;
    let records = make_runs(plan, out, saving, workers, &listener)?;
    listener.finish();
    if plan.shard == Shard::WHOLE {
        return report_on(&[out.to_path_buf()], out, &goldens, None);
    }
    let failed = records.iter().filter(|r| exit_code(r) != ExitCode::Good);
    for record in failed {
        say(&describe::record(record))?;
    }
    say(&format!(
        "shard {} of tier {}: {} runs; `mpm-verify report` with the folders of all {} shards judges them together\n",
        plan.shard,
        plan.tier,
        records.len(),
        plan.shard.count
    ))?;
    Ok(records
        .iter()
        .map(exit_code)
        .max()
        .unwrap_or(ExitCode::Good))
}

fn report_on(
    folders: &[PathBuf],
    out: &Path,
    goldens: &Goldens,
    night: Option<&Night>,
) -> Result<ExitCode, Error> {
    discard_report(out)?;
    let gathered = Gathered::read(folders)?;
    let judged = gathered.judge(|r| goldens.compare(r, gathered.folder(r)?))?;
    let summary = write_report(&gathered, judged, goldens, night, out)?;
    say(&describe::verdict_summary(&summary))?;
    say(&format!("Report: {}\n", out.join("index.html").display()))?;
    Ok(summary.exit_code())
}

fn bless(
    case: &'static Case,
    reason: &str,
    from: &[PathBuf],
    root: &Path,
    workers: usize,
) -> Result<ExitCode, Error> {
    if reason.trim().is_empty() {
        return Err(Error::Input(
            "--reason is empty; say why the results have changed".to_owned(),
        ));
    }
    let goldens = Goldens::open(root)?;
    let gathered = Gathered::read(from)?;
    let summary = gathered.judge(|r| goldens.compare(r, gathered.folder(r)?))?;
    let Some(study) = summary.cases.into_iter().find(|s| s.case == case.name) else {
        let name = case.name;
        return Err(Error::Input(format!("the folder has no runs of {name}")));
    };
    let candidates = Candidates::of(&study)?;
    say(&candidates.table())?;
    if let Some(refusal) = candidates.refusal() {
        say(&refusal)?;
        return Ok(ExitCode::TruthFailed);
    }
    let listener = progress::Runs::new(candidates.twin_names());
    let blessed = candidates.bless(&gathered, &goldens, reason, workers, &listener)?;
    listener.finish();
    let blessed = match blessed {
        Ok(count) => count,
        Err(broken) => {
            say(&broken)?;
            return Ok(ExitCode::RunFailed);
        }
    };
    say(&format!("{blessed} goldens blessed: {reason}\n"))?;
    Ok(ExitCode::Good)
}
