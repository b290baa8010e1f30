//! Checkpoints: runs that are killed go on bit for bit, and what is no checkpoint of theirs is refused.

use super::{code, copy_tree, files, golden, json, mpm_verify, quick, stderr, stdout, text};
use mpm_verify::case::{Case, Tier};
use mpm_verify::cases;
use mpm_verify::job::Job;
use mpm_verify::parameter::Parameters;
use mpm_verify::run::checkpoint::{Checkpoint, Identity};
use mpm_verify::run::series;
use mpm_verify::scheme::{BasisName, RemedyName, Scheme};
use mpm_verify::spec::RunSpec;
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A run of part of a second, too short to come to rest.
const RUN: [&str; 6] = ["run", "cook", "--remedy", "fbar-total", "--set", "max_periods=0.75"];
/// How it ends: not at rest.
const ENDS: i32 = 1;

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Kills a program (SIGKILL) so long after `ready` has become true; false if it had ended by itself.
fn kill_when(mut child: Child, later: Duration, ready: impl Fn() -> bool) -> bool {
    let begun = Instant::now();
    while !ready() {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing happens");
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        sleep(Duration::from_millis(1));
    }
    sleep(later);
    let running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    running
}

fn size(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |m| m.len())
}

fn resume(folder: &Path, more: &[&str]) -> Output {
    mpm_verify(&[&RUN[..], &["--resume", text(folder)], more].concat())
}

/// The folder of [`RUN`], killed after some hundred rows.
fn killed() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let every = ["--checkpoint-every", "0", "--out", text(folder.path())];
    let child = start(&[&RUN[..], &every].concat());
    let rows = || size(&folder.path().join(series::FILE)) > 20_000;
    assert!(kill_when(child, Duration::ZERO, rows), "too fast");
    folder
}

/// Asserts the same files, except for the time that the run took and the checkpoint.
fn assert_same(folder: &Path, straight: &Path) {
    let (mut found, mut expected) = (files(folder), files(straight));
    assert!(found.keys().eq(expected.keys()), "{:?}", found.keys());
    let name = Path::new("record.json");
    assert!(found.remove(name).is_some() && expected.remove(name).is_some());
    for (name, content) in &found {
        assert!(content == &expected[name], "{} differs", name.display());
    }
    let [found, expected] = [folder, straight].map(|folder| {
        let mut record = json(&folder.join(name));
        for varying in ["time", "machine"] {
            record.as_object_mut().unwrap().remove(varying).unwrap();
        }
        record
    });
    assert_eq!(found, expected);
}

fn identity_of_run() -> Identity {
    let case = cases::find("cook").unwrap();
    let set = vec![RUN[5].to_owned()];
    let parameters = Parameters::new(&case.parameters, &set).unwrap();
    let spec = RunSpec {
        scheme: Scheme::flip(BasisName::Gimp, RemedyName::FbarTotal),
        level: case.levels[0],
        set,
        perturbed: false,
    };
    Identity::of(case, &spec, &parameters)
}

#[test]
fn a_run_that_is_killed_again_and_again_ends_as_if_it_had_not_been() {
    let folder = tempfile::tempdir().unwrap();
    let [straight, pieces] = ["straight", "pieces"].map(|name| folder.path().join(name));
    let output = mpm_verify(&[&RUN[..], &["--out", text(&straight)]].concat());
    assert_eq!(code(&output), ENDS, "{}", stderr(&output));
    let identity = identity_of_run();
    let rows = pieces.join(series::FILE);
    let mut kills = 0;
    for piece in 0..12_u64 {
        let threads = if piece % 2 == 0 { "1" } else { "2" };
        let saving = ["--checkpoint-every", "0", "--threads", threads];
        let child = start(&[&RUN[..], &["--resume", text(&pieces)], &saving].concat());
        let before = size(&rows);
        // At the very start, and anywhere between two rows later on.
        let later = Duration::from_micros(1700 * piece);
        if !kill_when(child, later, || piece == 0 || size(&rows) > before) {
            break;
        }
        kills += 1;
        let Some(checkpoint) = Checkpoint::read(&pieces, &identity).unwrap() else {
            assert!(piece < 2, "no checkpoint");
            continue;
        };
        // All that is lost is the last row, and one that is half written; of the first row the heads too.
        let written = fs::read(&rows).unwrap();
        let lost = &written[checkpoint.series.bytes as usize..];
        assert!(lost.iter().filter(|b| **b == b'\n').count() <= 1 + usize::from(checkpoint.series.bytes == 0));
    }
    assert!(kills >= 4, "killed {kills} times only");
    let output = resume(&pieces, &[]);
    assert_eq!(code(&output), ENDS, "{}", stderr(&output));
    assert_same(&pieces, &straight);

    let before = files(&pieces);
    let again = resume(&pieces, &[]);
    assert_eq!(code(&again), ENDS, "{}", stderr(&again));
    assert!(stdout(&again).contains("is already complete; nothing to resume"));
    assert!(files(&pieces) == before);
}

/// The bytes of a checkpoint with other content, sealed as the program does.
fn resealed(bytes: &[u8], content: &[u8]) -> Vec<u8> {
    let length = (content.len() as u64).to_le_bytes();
    let checksum = crc32fast::hash(content).to_le_bytes();
    [&bytes[..12], &length, &checksum, content].concat()
}

fn replaced(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let place = bytes.windows(from.len()).position(|w| w == from.as_bytes());
    let mut bytes = bytes.to_vec();
    bytes[place.unwrap()..][..from.len()].copy_from_slice(to.as_bytes());
    bytes
}

#[test]
fn what_is_not_the_checkpoint_of_the_run_is_refused_and_left_alone() {
    let folder = killed();
    let place = folder.path();
    let path = place.join("checkpoint.bin");
    let refused = |output: Output, needles: &[&str], before: &_| {
        let said = stderr(&output);
        assert_eq!(code(&output), 2, "{needles:?}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(needles.iter().all(|n| said.contains(n)), "{needles:?}: {said}");
        assert!(&files(place) == before, "{needles:?}: something has changed");
    };

    // Sound, but of another run.
    let sound = files(place);
    let parameter = ["checkpoint.bin", "of other parameters", "poisson_ratio = 0.499, not 0.3"];
    refused(resume(place, &["--set", "poisson_ratio=0.3"]), &parameter, &sound);
    let run = "of another run: cook gimp-fbar-total-flip/h2, not";
    let level = [run, "cook gimp-fbar-total-flip/h1"];
    refused(resume(place, &["--level", "h1"]), &level, &sound);
    refused(resume(place, &["--perturb"]), &[run, "(perturbed)"], &sound);
    let of = |arguments: &[&str]| mpm_verify(&[arguments, &["--resume", text(place)]].concat());
    refused(of(&["run", "cook"]), &[run, "gimp-fbar-consistent-flip"], &sound);
    refused(of(&["run", "column"]), &[run, "column"], &sound);

    // A checkpoint of this run, but not sound.
    let bytes = fs::read(&path).unwrap();
    let content = &bytes[24..];
    let flipped = |k: usize| {
        let mut bytes = bytes.clone();
        bytes[k] ^= 0x10;
        bytes
    };
    let source = env!("CARGO_PKG_VERSION");
    let source = format!("{{\"mpm_verify\":\"{source}\",\"source\":\"");
    let version = mpm_verify::record::Version::current().source;
    let [from, to] = [&version, "000000000000"].map(|v| format!("{source}{v}"));
    let foreign = resealed(&bytes, &replaced(content, &from, &to));
    for (content, needles) in [
        (Vec::new(), ["not a checkpoint", ""]),
        (bytes[..5].to_vec(), ["not a checkpoint", ""]),
        (bytes[..10].to_vec(), ["truncated: 10 bytes", "12 are expected"]),
        (bytes[..20].to_vec(), ["truncated: 20 bytes", ""]),
        (bytes[..1000].to_vec(), ["truncated: 1000 bytes", ""]),
        (bytes[..bytes.len() - 1].to_vec(), ["truncated", ""]),
        ([&bytes[..], b"x"].concat(), ["damaged: checksum", ""]),
        (flipped(0), ["not a checkpoint", ""]),
        (flipped(8), ["format 17", "1 is expected"]),
        (flipped(21), ["damaged: checksum", ""]),
        (flipped(100), ["damaged: checksum", ""]),
        (flipped(bytes.len() / 2), ["damaged: checksum", ""]),
        (foreign, ["of another program: source 000000000000", &version]),
        (resealed(&bytes, &content[..50]), ["can't be read", ""]),
        (resealed(&bytes, &content[..content.len() - 1]), ["saved state does not match a run", ""]),
        (resealed(&bytes, &[content, b"x"].concat()), ["saved state does not match a run", "1 unexpected bytes"]),
    ] {
        fs::write(&path, content).unwrap();
        let before = files(place);
        refused(resume(place, &[]), &needles, &before);
    }

    // Beside another series.
    fs::write(&path, &bytes).unwrap();
    let rows = place.join(series::FILE);
    let written = fs::read(&rows).unwrap();
    let mut other = written.clone();
    other[500] ^= 1;
    for content in [&other, &written[..10_000]] {
        fs::write(&rows, content).unwrap();
        let before = files(place);
        refused(resume(place, &[]), &["series.csv is not the series"], &before);
    }
    fs::remove_file(&rows).unwrap();
    refused(resume(place, &[]), &["series.csv is not"], &files(place));

    fs::write(&rows, &written).unwrap();
    assert_eq!(code(&resume(place, &[])), ENDS);
    let ended = files(place);
    let parameter = ["record.json", "poisson_ratio = 0.499, not 0.3"];
    refused(resume(place, &["--set", "poisson_ratio=0.3"]), &parameter, &ended);
}

#[test]
fn without_resume_a_run_begins_anew_and_removes_the_checkpoint() {
    let folder = killed();
    let (out, fresh) = (folder.path(), tempfile::tempdir().unwrap());
    for out in [out, fresh.path()] {
        let output = mpm_verify(&[&RUN[..], &["--out", text(out)]].concat());
        assert_eq!(code(&output), ENDS, "{}", stderr(&output));
    }
    assert_same(out, fresh.path());
}

/// The files that a run's collection of snapshots names, with their times.
fn collected(folder: &Path) -> Vec<(String, String)> {
    let text = fs::read_to_string(folder.join("snapshots.pvd")).unwrap();
    let value = |line: &str, name: &str| {
        let (_, rest) = line.split_once(&format!(" {name}=\"")).unwrap();
        rest.split_once('"').unwrap().0.to_owned()
    };
    let sets = text.lines().filter(|line| line.contains("<DataSet "));
    sets.map(|line| (value(line, "timestep"), value(line, "file"))).collect()
}

#[test]
fn a_run_with_snapshots_that_is_killed_has_them_all_in_its_collection() {
    let run = ["run", "dam-break", "--set", "duration=0.06"];
    let folder = tempfile::tempdir().unwrap();
    let [straight, pieces] = ["straight", "pieces"].map(|name| folder.path().join(name));
    let output = mpm_verify(&[&run[..], &["--out", text(&straight)]].concat());
    let ends = code(&output);
    let saving = ["--resume", text(&pieces), "--checkpoint-every", "0"];
    let child = start(&[&run[..], &saving].concat());
    let first = pieces.join("snapshots.pvd");
    assert!(kill_when(child, Duration::ZERO, || first.exists()), "too fast");
    let snapshot = |time: &str| (time.to_owned(), format!("snapshots/{time:0>7}.vtu"));
    let early = snapshot("0.025");
    assert_eq!(collected(&pieces).first(), Some(&early));

    let output = mpm_verify(&[&run[..], &saving].concat());
    assert_eq!(code(&output), ends, "{}", stderr(&output));
    assert_same(&pieces, &straight);
    let late = ("0.05".to_owned(), snapshot("0.050").1);
    assert_eq!(collected(&pieces), [early, late]);
    for (_, file) in collected(&pieces) {
        assert!(fs::read(pieces.join(file)).unwrap().starts_with(b"<?xml"));
    }

    // A run that begins anew has none of an earlier one.
    fs::write(pieces.join("snapshots/009.000.vtu"), "").unwrap();
    let short = ["run", "dam-break", "--set", "duration=0.02"];
    mpm_verify(&[&short[..], &["--out", text(&pieces)]].concat());
    assert!(!first.exists() && !pieces.join("snapshots").exists());
}

/// Times of the checkpointed piece of a run, from a checkpoint set back by a million seconds.
fn set_back(path: &Path) {
    type About = (String, ((u64, u32), (f64, f64)));
    let bytes = fs::read(path).unwrap();
    let (about, memory) = postcard::take_from_bytes::<About>(&bytes[24..]).unwrap();
    let (whose, (mark, (wall, cpu))) = about;
    let about = postcard::to_stdvec(&(whose, (mark, (wall + 1e6, cpu + 2e6)))).unwrap();
    fs::write(path, resealed(&bytes, &[&about, memory].concat())).unwrap();
}

#[test]
fn a_verification_that_is_killed_goes_on_from_its_checkpoints() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    copy_tree(quick().0, &out);
    let runs = ["cook/gimp-fbar-rate-flip/h2", "cook/gimp-fbar-total-flip/h2"];
    let [sound, damaged] = runs.map(|run| out.join(run));
    for run in [&sound, &damaged] {
        fs::remove_file(run.join("record.json")).unwrap();
        fs::remove_file(run.join(series::FILE)).unwrap();
    }
    let golden = golden();
    let verify = ["verify", "--tier", "quick", "--resume", "--out", text(&out)];
    let more = ["--golden", text(&golden), "--threads", "2"];
    let verify = [&verify[..], &more].concat();
    let child = start(&[&verify[..], &["--checkpoint-every", "0"]].concat());
    let begun = |run: &Path| size(&run.join(series::FILE)) > 5_000;
    let both = || begun(&sound) && begun(&damaged);
    assert!(kill_when(child, Duration::ZERO, both), "too fast");
    set_back(&sound.join("checkpoint.bin"));
    fs::write(damaged.join("checkpoint.bin"), "no checkpoint at all").unwrap();

    let output = mpm_verify(&verify);
    let said = stderr(&output);
    assert_eq!(code(&output), 0, "{said}");
    // One that can't be used is said and done without.
    let again: Vec<&str> = said.lines().filter(|l| l.contains("begins again")).collect();
    assert_eq!(again.len(), 1, "{said}");
    assert!(again[0].starts_with(runs[1]), "{said}");
    assert!(again[0].ends_with("checkpoint.bin: not a checkpoint"), "{said}");
    for (run, folder) in runs.iter().zip([&sound, &damaged]) {
        assert_same(folder, &quick().0.join(run));
    }
    let time = |run: &Path| json(&run.join("record.json"))["time"].clone();
    assert!(time(&sound)["wall_s"].as_f64().unwrap() > 1e6, "it began again");
    assert!(time(&sound)["cpu_s"].as_f64().unwrap() > 2e6, "it began again");
    assert!(time(&damaged)["wall_s"].as_f64().unwrap() < 1e6);
}

fn start_job(case: &Case, spec: &RunSpec) -> Box<dyn Job> {
    let parameters = Parameters::new(&case.parameters, &spec.set).unwrap();
    (case.begin)(spec, &parameters).unwrap()
}

/// All that a job has to tell at its end, and at how many rows that was. Debug writes every bit of a number.
fn end(job: &mut dyn Job) -> String {
    let broken = format!("{:?} {}", job.work(), job.finished());
    format!("{:?} {:?} {broken}", job.metrics(), job.particles())
}

/// Drives a job to its end; at each place in `stops` another one, made from the saved memory, takes over.
fn drive(case: &Case, spec: &RunSpec, stops: &[usize]) -> (Vec<String>, String) {
    let name = format!("{} {}", case.name, spec.folder());
    let mut job = start_job(case, spec);
    let mut rows = Vec::new();
    while !job.finished() {
        match job.advance() {
            Ok(row) => rows.push(format!("{row:?}")),
            Err(error) => {
                rows.push(error.to_string());
                break;
            }
        }
        if stops.contains(&rows.len()) {
            let saved = job.save().unwrap();
            job = start_job(case, spec);
            job.restore(&saved).unwrap();
            assert!(job.save().unwrap() == saved, "{name}: saved again");
        }
    }
    (rows, end(job.as_mut()))
}

/// Parameters for less ground in three dimensions and in a row of trials.
fn less_ground(case: &Case) -> Option<[&'static str; 5]> {
    let last = match case.name {
        "landslide" => ["duration=0.1", "reduction=2"],
        "slope-stability" => ["most=20", "trials=6"],
        _ => return None,
    };
    Some(["height=2", "crest=2", "floor=2", last[0], last[1]])
}

/// A new case whose job forgets something shows here.
#[test]
fn the_job_of_every_case_goes_on_bit_for_bit() {
    let runs = cases::all().iter().map(|case| {
        let cost = |s: &RunSpec| (case.cost)(s);
        let tiers = [Tier::Quick, Tier::Pr, Tier::Nightly].into_iter();
        let specs = tiers.map(|tier| case.runs(tier)).find(|s| !s.is_empty());
        let specs = specs.unwrap().into_iter().rev();
        let cheapest = specs.min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let mut spec = cheapest.unwrap();
        if let Some(set) = less_ground(case) {
            spec.set = set.map(str::to_owned).into();
        }
        (case, spec)
    });
    let runs: Vec<(&Case, RunSpec)> = runs.collect();
    runs.par_iter().for_each(|(case, spec)| goes_on(case, spec));
}

fn goes_on(case: &Case, spec: &RunSpec) {
    let name = format!("{} {}", case.name, spec.folder());
    let (rows, at_end) = drive(case, spec, &[]);
    let n = rows.len();
    if n == 1 {
        // Nothing to go on from.
        return;
    }
    // One after the first row, one in the middle, one before the last.
    assert!(n > 3, "{name}: {n} rows");
    let (again, end_again) = drive(case, spec, &[1, n / 3, n / 2, n - 1]);
    assert!(rows == again, "{name}: rows differ");
    assert!(at_end == end_again, "{name}: the end differs");
}

/// Behind the gate and after it is gone.
#[test]
fn a_job_of_two_scenes_goes_on_in_either() {
    let case = cases::find("dam-break").unwrap();
    let mut spec = case.runs(Tier::Pr).swap_remove(0);
    spec.set = ["start=gravity-stage", "duration=0.06"].map(str::to_owned).into();
    goes_on(case, &spec);
}
