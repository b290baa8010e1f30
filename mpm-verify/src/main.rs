//! The program `mpm-verify`: from its command line to the library.

mod cli;
mod progress;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use cli::run::run_one;
use cli::score::{score, write_export};
use cli::{Cli, Command, Told, of_syntax, say, say_json};
use mpm_core::number::FUSED;
use mpm_verify::bench::{self, Peers};
use mpm_verify::bless::{Blessing, Candidates};
use mpm_verify::case::{Case, find_level};
use mpm_verify::cases::{self, scene::SceneFile};
use mpm_verify::error::{Error, ExitCode, is_unfit, one_line};
use mpm_verify::exact;
use mpm_verify::files::lock::hold;
use mpm_verify::golden::{self, Goldens};
use mpm_verify::night::Night;
use mpm_verify::record::Version;
use mpm_verify::report::diff::Difference;
use mpm_verify::report::{describe, discard_report, keep::keep, shown, tables::Page, write_report};
use mpm_verify::run::{checkpoint::Saving, size};
use mpm_verify::scheme::{RemedyName, Scheme, TransferName};
use mpm_verify::spec::RunSpec;
use mpm_verify::study::complete::Completeness;
use mpm_verify::study::gather::Gathered;
use mpm_verify::study::judge::exit_code;
use mpm_verify::study::plan::{Plan, Shard};
use mpm_verify::study::schedule::{make_runs, require_memory};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What a build without fused multiply-adds says when it starts.
const SLOW: &str = "note: built without AVX2 and fused multiply-adds: steps take more than twice as long, and last digits \
    differ. Build with RUSTFLAGS=\"-C target-cpu=native\"; a checkout does so by itself.";

fn main() -> std::process::ExitCode {
    if !FUSED {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "{SLOW}");
    }
    let outcome = match Cli::try_parse() {
        Ok(cli) => bound_threads(&cli.command).and_then(|()| dispatch(cli.command)),
        Err(help) if help.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            // Nothing more can be done if stderr is closed.
            let _ = help.print();
            Ok(ExitCode::Input)
        }
        Err(error) if error.use_stderr() => Err(Error::Input(of_syntax(&error))),
        // A reader that is gone has read enough.
        Err(help) => match help.print() {
            Err(e) if e.kind() != io::ErrorKind::BrokenPipe => Err(Error::Input(e.to_string())),
            _ => Ok(ExitCode::Good),
        },
    };
    let code = outcome.unwrap_or_else(|error| {
        // Nothing more can be done if stderr is closed.
        let _ = writeln!(io::stderr(), "error: {}", one_line(&error.to_string()));
        ExitCode::Input
    });
    std::process::ExitCode::from(code as u8)
}

/// All cores, unless it is said how many threads.
fn or_all_cores(threads: Option<usize>) -> usize {
    threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
}

/// The memory (bytes) that a scene may take: so many gibibytes, or what the machine has to give, if it tells.
fn memory_of(gib: Option<f64>) -> Option<f64> {
    let bytes = gib.map(|gib| gib * size::GIBIBYTE);
    bytes.or_else(size::available_memory)
}

/// Bounds what starts besides the threads of a run, whatever the environment says.
fn bound_threads(command: &Command) -> Result<(), Error> {
    let asked = match command {
        Command::Run { threads, .. }
        | Command::Scene { threads, .. }
        | Command::Verify { threads, .. } => *threads,
        Command::Bless { threads, .. } => *threads,
        _ => None,
    };
    let threads = or_all_cores(asked).min(or_all_cores(None));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build_global()
        .map_err(|e| Error::Input(format!("{threads} threads can't be started: {e}")))
}

fn dispatch(command: Command) -> Result<ExitCode, Error> {
    match command {
        Command::List { tier, format } => {
            match &*format {
                "json" => say_json(&describe::list_json(cases::all(), tier))?,
                _ => {
                    let goldens = golden::place(None);
                    let pairs = |case: &str| golden::pairs(&goldens, case).ok();
                    say(describe::list_text(cases::all(), tier, pairs))?;
                }
            }
            Ok(ExitCode::Good)
        }
        Command::Explain { case, json } => {
            match json {
                true => say_json(&describe::explain_json(case))?,
                false => say(describe::explain(case))?,
            }
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
            memory,
            told,
        } => {
            let scheme = match scheme {
                Some(scheme) => scheme,
                None => {
                    let own = case.default_scheme(solver.as_deref());
                    let solver = solver.as_deref().unwrap_or(own.solver());
                    let usual = match solver == own.solver() {
                        true => own.transfer(),
                        false => TransferName::None,
                    };
                    Scheme::of_parts(
                        solver,
                        basis.unwrap_or(own.basis()),
                        remedy.unwrap_or(match solver {
                            "poro" => RemedyName::None,
                            _ => own.remedy(),
                        }),
                        transfer.unwrap_or(usual),
                    )?
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
            let resources = (or_all_cores(threads), memory_of(memory));
            run_one(case, &spec, place, resources, told)
        }
        Command::Scene {
            file,
            out,
            resume,
            checkpoint_every,
            memory,
            threads,
            told,
        } => {
            let scene = SceneFile::read(&file)?;
            if told.progress() {
                say(format!("{}\n", one_line(&scene.title)))?;
                for line in &scene.made {
                    say(format!("{line}\n"))?;
                }
            }
            let saving = saving(checkpoint_every, resume.is_some());
            let folder = resume.or(out);
            let place = folder.as_deref().map(|folder| (folder, saving));
            let resources = (or_all_cores(threads), memory_of(memory));
            run_one(&scene.case, &scene.spec, place, resources, told)
        }
        Command::Score { folder, out, told } => score(&folder, out.as_deref(), told),
        Command::Export {
            case,
            level,
            set,
            out,
        } => write_export(&case, level.as_deref(), set, &out),
        Command::Verify {
            cases: named,
            tier,
            shard,
            resume,
            checkpoint_every,
            out,
            golden,
            threads,
            memory,
            told,
        } => {
            let chosen = |c: &&Case| named.is_empty() || named.iter().any(|n| n.name == c.name);
            let plan = Plan::new(cases::all().iter().filter(chosen), tier, shard)?;
            let saving = saving(checkpoint_every, resume);
            let (golden, workers) = (golden::place(golden), or_all_cores(threads));
            if let Some(gib) = memory {
                require_memory(&plan, gib * size::GIBIBYTE, workers)?;
            }
            verify(&plan, saving, &out, &golden, workers, told)
        }
        Command::Report {
            folders,
            out,
            golden,
            night,
            commit,
            told,
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
            let goldens = Goldens::open(&golden::place(golden))?;
            let _held = hold(&out)?;
            report_in(&folders, &out, &goldens, night.as_ref(), told)
        }
        Command::Keep { report, into } => {
            let _held = hold(&into)?;
            let rows = keep(&report, &into)?;
            say(format!("{rows} runs are kept in {}\n", into.display()))?;
            Ok(ExitCode::Good)
        }
        Command::Tables { check, root } => tables(&root, check),
        Command::Pictures { from, root } => {
            say(shown::draw(&root, &from)?)?;
            Ok(ExitCode::Good)
        }
        Command::Complete { tier, rows } => {
            let plan = Plan::new(cases::all(), tier, Shard::WHOLE)?;
            let found = Completeness::of(&plan, &rows, &Version::current().source)?;
            say(&found)?;
            found.require().map(|()| ExitCode::Good)
        }
        Command::Bless {
            case,
            reason,
            from,
            golden,
            allow,
            threads,
        } => bless(
            case,
            (&reason, &allow),
            &from,
            &golden::place(golden),
            or_all_cores(threads),
        ),
        Command::Diff {
            old,
            new,
            out,
            told,
        } => {
            let difference = Difference::between(&old, &new)?;
            if let Some(out) = out {
                let _held = hold(&out)?;
                difference.write(&out)?;
            }
            match told {
                Told { json: true, .. } => say_json(&difference.json())?,
                Told { quiet: true, .. } => say(difference.counts() + "\n")?,
                _ => say(difference.text())?,
            }
            Ok(difference.exit_code())
        }
        Command::Exact {
            name,
            at,
            time,
            set,
        } => {
            say(exact::State::ask(&name, &at, &time, &set)?.json()?)?;
            Ok(ExitCode::Good)
        }
        Command::Bench {
            rounds,
            threads,
            only,
            peers,
            python,
            out,
        } => {
            let options = bench::Options {
                rounds,
                threads: compared_threads(threads),
                only,
                peers: peers.map(|_| Peers::taichi(python)),
            };
            let _held = hold(&out)?;
            let bar = progress::single("bench", true);
            let text = bench::measure(&options, &out, &|share| {
                bar.set_position((share * progress::SCALE) as u64);
            })?;
            bar.finish_and_clear();
            say(&text)?;
            Ok(ExitCode::Good)
        }
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "mpm-verify", &mut script);
            say(String::from_utf8_lossy(&script))?;
            Ok(ExitCode::Good)
        }
    }
}

/// One thread and the others that are asked for, all cores if none is.
fn compared_threads(asked: Vec<usize>) -> Vec<usize> {
    let mut threads = match asked.is_empty() {
        true => vec![or_all_cores(None)],
        false => asked,
    };
    threads.push(1);
    threads.sort_unstable();
    threads.dedup();
    threads
}

/// Fills the tables of the pages in `root`, or, to check, says which are stale.
fn tables(root: &Path, check: bool) -> Result<ExitCode, Error> {
    let mut code = ExitCode::Good;
    for page in Page::all(root)? {
        for name in &page.stale {
            let what = if check { "stale" } else { "filled" };
            say(format!("{}: {name} {what}\n", page.file.display()))?;
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
    told: Told,
) -> Result<ExitCode, Error> {
    let names = plan.own().map(|run| run.folder().display().to_string());
    let listener = progress::Runs::new(names.collect(), told.progress());
    // A folder of goldens that is not there is told before hours of runs.
    let goldens = Goldens::open(golden)?;
    let _held = hold(out)?;
    discard_report(out)?;
    let records = make_runs(plan, out, saving, workers, &listener)?;
    listener.finish();
    if plan.shard == Shard::WHOLE {
        return report_in(&[out.to_path_buf()], out, &goldens, None, told);
    }
    let code = records.iter().map(exit_code).max();
    if told.json {
        say_json(&records)?;
        return Ok(code.unwrap_or(ExitCode::Good));
    }
    for record in records.iter().filter(|r| exit_code(r) != ExitCode::Good) {
        say(describe::record(cases::find(&record.case)?, record) + "\n")?;
    }
    say(format!(
        "shard {} of tier {}: {} runs; `mpm-verify report` with the folders of all {} shards judges them together\n",
        plan.shard,
        plan.tier,
        records.len(),
        plan.shard.count
    ))?;
    Ok(code.unwrap_or(ExitCode::Good))
}

/// Judges the runs of `folders` and reports them in `out`, which is held.
fn report_in(
    folders: &[PathBuf],
    out: &Path,
    goldens: &Goldens,
    night: Option<&Night>,
    told: Told,
) -> Result<ExitCode, Error> {
    discard_report(out)?;
    let gathered = Gathered::read(folders)?;
    let judged = gathered.judge(|r| goldens.compare(r, gathered.folder(r)?))?;
    let summary = write_report(&gathered, judged, goldens, night, out)?;
    match told {
        Told { json: true, .. } => say_json(&describe::verification_json(&summary))?,
        Told { quiet: true, .. } => say(describe::verification_line(&summary))?,
        _ => {
            say(format!("Report: {}\n", out.join("index.html").display()))?;
            say(describe::verification(&summary))?;
        }
    }
    match gathered.gap() {
        Some(gap) => Err(Error::Input(gap.to_owned())),
        None => Ok(summary.exit_code()),
    }
}

fn bless(
    case: &'static Case,
    (reason, allowed): (&str, &[String]),
    from: &[PathBuf],
    root: &Path,
    workers: usize,
) -> Result<ExitCode, Error> {
    let words = reason.split_whitespace().collect::<String>();
    if !words.contains(char::is_alphanumeric) || words.contains(is_unfit) || reason.len() > 500 {
        return Err(Error::Input(
            "--reason is empty, longer than 500 bytes or has control characters; say why the results have changed"
                .to_owned(),
        ));
    }
    let goldens = Goldens::open(root)?;
    let _held = hold(root)?;
    let gathered = Gathered::read(from)?;
    gathered.require_tier()?;
    let study = gathered.judge_case(case, |r| goldens.compare(r, gathered.folder(r)?))?;
    let candidates = Candidates::of(&study)?;
    say(candidates.table())?;
    if let Some(refusal) = candidates.refusal() {
        say(&refusal)?;
        return Ok(ExitCode::TruthFailed);
    }
    let listener = progress::Runs::new(candidates.twin_names(), true);
    let blessed = candidates.bless(&gathered, &goldens, (reason, allowed), workers, &listener)?;
    listener.finish();
    let (told, code) = match blessed {
        Blessing::Done(count) => (
            format!("{count} goldens blessed: {reason}\n"),
            ExitCode::Good,
        ),
        Blessing::Broken(told) => (told, ExitCode::RunFailed),
        Blessing::Doubtful(told) => (told, ExitCode::Input),
    };
    say(told)?;
    Ok(code)
}
