//! Damaged files and command lines, in process: nothing panics, hangs, or passes for what it is not.
//!
//! `MPM_FUZZ` sets how many inputs there are in all and `MPM_FUZZ_SEED` which; a night takes a million, by seeds of its own.

use super::cli_syntax::Cli;
use super::scene::{RUN, Scene, one_case};
use super::{code, copy_tree, golden, json, stderr, text, workspace};
use clap::Parser;
use cpu_time::ThreadTime;
use mpm_verify::cases;
use mpm_verify::cases::scene::SceneFile;
use mpm_verify::files::{Mark, read_picture};
use mpm_verify::golden::Golden;
use mpm_verify::parameter::{Parameters, Value};
use mpm_verify::record::Version;
use mpm_verify::report::diff::Difference;
use mpm_verify::report::keep::keep;
use mpm_verify::report::scored;
use mpm_verify::run::checkpoint::{Checkpoint, Identity, Keeper};
use mpm_verify::score::Scores;
use mpm_verify::study::complete::Completeness;
use mpm_verify::study::gather::Gathered;
use mpm_verify::study::plan::Plan;
use mpm_verify::table::Table;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Damaged formats, and the share of the inputs each gets.
const FAMILIES: [(&str, usize); 16] = [
    ("record", 10),
    ("series and particles", 8),
    ("plan", 8),
    ("golden", 10),
    ("field of a golden", 8),
    ("picture", 4),
    ("checkpoint", 10),
    ("summary", 2),
    ("history", 6),
    ("kept rows", 6),
    ("manifest of a result", 3),
    ("tables of a result", 2),
    ("grid of a result", 3),
    ("parameters", 10),
    ("command line", 9),
    ("scene file", 1),
];

/// Inputs of the tests.
const INPUTS: usize = 10_000;
/// No reader takes longer of the processor's time, whatever else the machine does.
const LONGEST: Duration = Duration::from_secs(2);

/// Inputs of a family, of all that are asked for.
fn inputs(family: &str) -> u32 {
    let all = std::env::var("MPM_FUZZ").map_or(INPUTS, |n| n.parse().unwrap());
    let (_, share) = FAMILIES.iter().find(|(name, _)| *name == family).unwrap();
    (all * share / 100) as u32
}

/// Checks a number of values of a strategy, the same ones each time.
fn check<S: Strategy>(family: &str, strategy: &S, test: impl Fn(&S::Value)) {
    let seed: u8 = std::env::var("MPM_FUZZ_SEED").map_or(1, |n| n.parse().unwrap());
    let config = Config { cases: inputs(family), failure_persistence: None, ..Config::default() };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let result = runner.run(strategy, |value| {
        let begun = ThreadTime::now();
        test(&value);
        assert!(begun.elapsed() < LONGEST, "{:?}", begun.elapsed());
        Ok(())
    });
    if let Err(failure) = result {
        panic!("{family}: {failure}");
    }
}

/// Bytes that readers stumble over.
const TOKENS: [&[u8]; 20] = [
    b"\0",
    b"\n",
    b"\r",
    b"\"",
    b",",
    b"-",
    b"NaN",
    b"inf",
    b"1e999",
    b"-0",
    b"../",
    b"/",
    b"\x1b[31m",
    b"\xff",
    b"\xef\xbb\xbf",
    b"[[[[[[[[",
    b"{\"a\":",
    b"99999999999999999999999",
    b"=1+1",
    b"null",
];

/// A change of bytes, at a share of their length.
#[derive(Debug, Clone)]
pub(super) enum Change {
    Flip(f64, u8),
    Cut(f64),
    Remove(f64, usize),
    Double(f64, usize),
    Insert(f64, &'static [u8]),
    Replace(f64, &'static [u8]),
}

pub(super) fn changes() -> impl Strategy<Value = Vec<Change>> {
    let at = || 0.0..1.0;
    let one = prop_oneof![
        (at(), 0_u8..8).prop_map(|(a, bit)| Change::Flip(a, bit)),
        at().prop_map(Change::Cut),
        (at(), 1_usize..40).prop_map(|(a, n)| Change::Remove(a, n)),
        (at(), 1_usize..4000).prop_map(|(a, n)| Change::Double(a, n)),
        (at(), select(&TOKENS[..])).prop_map(|(a, t)| Change::Insert(a, t)),
        (at(), select(&TOKENS[..])).prop_map(|(a, t)| Change::Replace(a, t)),
    ];
    vec(one, 1..4)
}

pub(super) fn changed(sound: &[u8], changes: &[Change]) -> Vec<u8> {
    let mut bytes = sound.to_vec();
    for change in changes {
        let place = |share: f64| (share * bytes.len() as f64) as usize;
        let range = |share: f64, n: usize| place(share)..(place(share) + n).min(bytes.len());
        match *change {
            _ if bytes.is_empty() => {}
            Change::Flip(at, bit) => {
                let k = place(at);
                bytes[k] ^= 1 << bit;
            }
            Change::Cut(at) => bytes.truncate(place(at)),
            Change::Remove(at, n) => drop(bytes.drain(range(at, n))),
            Change::Double(at, n) => {
                let (k, part) = (place(at), bytes[range(at, n)].to_vec());
                bytes.splice(k..k, part);
            }
            Change::Insert(at, token) => {
                let k = place(at);
                bytes.splice(k..k, token.iter().copied());
            }
            Change::Replace(at, token) => {
                let range = range(at, token.len());
                bytes.splice(range, token.iter().copied());
            }
        }
    }
    bytes
}

/// Checks a reader with changes of the file at `path`, which is put back at the end.
fn damage(family: &str, path: &Path, test: impl Fn(&[u8])) {
    let sound = fs::read(path).unwrap();
    check(family, &changes(), |changes| {
        let bytes = changed(&sound, changes);
        if bytes != sound {
            fs::write(path, &bytes).unwrap();
            test(&bytes);
        }
    });
    fs::write(path, sound).unwrap();
}

/// A folder of one run.
fn run() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy_tree(&one_case().join("cook").join(RUN), folder.path());
    folder
}

#[test]
fn damaged_records_are_refused_or_judged() {
    let folder = run();
    let root = [folder.path().to_path_buf()];
    damage("record", &folder.path().join("record.json"), |_| {
        if let Ok(gathered) = Gathered::read(&root) {
            gathered.judge(|_| Ok(Vec::new())).unwrap();
        }
    });
}

#[test]
fn damaged_tables_of_runs_are_refused() {
    let folder = run();
    let root = [folder.path().to_path_buf()];
    damage("series and particles", &folder.path().join("series.csv"), |_| {
        assert!(Gathered::read(&root).is_err());
    });
}

#[test]
fn damaged_plans_are_refused_or_are_those_of_no_tier() {
    let scene = Scene::new();
    let sound = Plan::read(&scene.report).unwrap();
    let names = |plan: &Plan| {
        let mut names: Vec<PathBuf> = plan.runs.iter().map(|run| run.folder()).collect();
        names.sort();
        names
    };
    damage("plan", &scene.report.join("plan.json"), |_| {
        if let Ok(plan) = Plan::read(&scene.report) {
            let is_sound = names(&plan) == names(&sound);
            assert!(is_sound || plan.gap().unwrap().is_some());
        }
    });
}

#[test]
fn a_damaged_golden_is_refused_or_of_other_numbers() {
    let scene = Scene::new();
    let path = scene.golden.join("cook.json");
    let (sound, again) = (Golden::read(&path).unwrap(), scene.golden.join("again.json"));
    damage("golden", &path, |bytes| {
        if let Ok(golden) = Golden::read(&path) {
            assert!(golden != sound);
            golden.write(&again).unwrap();
            assert!(fs::read(&again).unwrap() == bytes);
        }
    });
    let path = scene.golden.join("cook-field.csv");
    let sound = Table::read_own(&path).unwrap();
    damage("field of a golden", &path, |_| {
        assert!(Table::read_own(&path).is_err() || Table::read_own(&path).unwrap() != sound);
    });
    let path = scene.golden.join("cook.png");
    damage("picture", &path, |_| drop(read_picture(&path)));
}

#[test]
fn a_damaged_checkpoint_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let case = cases::find("cook").unwrap();
    let spec = case.runs(mpm_verify::case::Tier::Quick).swap_remove(0);
    let parameters = Parameters::new(&case.parameters, &spec.set).unwrap();
    let identity = || Identity::of(case, &spec, &parameters);
    let mut keeper = Keeper::new(folder.path(), identity(), Duration::ZERO);
    let job = (case.begin)(&spec, &parameters).unwrap();
    let (series, time) = (Mark::of(b"t\n0\n"), Default::default());
    let memory = job.save().unwrap();
    keeper.keep(&Checkpoint { series, time, memory }).unwrap();
    let asked = identity();
    assert!(Checkpoint::read(folder.path(), &asked).unwrap().is_some());
    damage("checkpoint", &folder.path().join("checkpoint.bin"), |_| {
        assert!(Checkpoint::read(folder.path(), &asked).is_err());
    });
}

#[test]
fn damaged_summaries_histories_and_rows_are_refused_or_kept_inside() {
    let scene = Scene::new();
    let root = scene.report.parent().unwrap();
    let kept = root.join("kept");
    copy_tree(&workspace().join("reports/nightly"), &kept.join("nightly"));
    let summary = scene.report.join("summary.json");
    damage("summary", &summary, |_| {
        if let Ok(difference) = Difference::between(&scene.report, one_case()) {
            assert!(!difference.text().contains('\x1b'));
        }
    });
    let mut night = json(&summary);
    for study in night["cases"].as_array_mut().unwrap() {
        study["night"] = serde_json::json!({"date": "2026-01-01", "commit": "c"});
    }
    fs::write(&summary, night.to_string()).unwrap();
    let history = scene.report.join("history.csv");
    let row = "2026-01-01,c,cook,gimp-none-flip,cpu_s,1.5\n";
    fs::write(&history, format!("night,commit,case,run,quantity,value\n{}", row.repeat(20))).unwrap();
    let inside = |root: &Path| fs::read_dir(root).unwrap().count();
    let before = inside(root);
    damage("history", &history, |_| {
        if keep(&scene.report, &kept).is_ok() {
            let text = fs::read_to_string(kept.join("history.csv")).unwrap();
            let formula = |line: &str| line.split(',').any(|c| c.starts_with(['=', '+', '@']));
            assert!(!text.lines().any(formula), "{text}");
        }
        // Each begins anew.
        let _ = fs::remove_file(kept.join("history.csv"));
    });
    let plan = Plan::read(one_case()).unwrap();
    let rows = kept.join("nightly/results.csv");
    damage("kept rows", &rows, |_| {
        if let Ok(found) = Completeness::of(&plan, &rows, &Version::current().source) {
            let _ = found.require();
        }
    });
    assert_eq!(inside(root), before);
    assert!(golden().exists());
}

#[test]
fn a_damaged_result_of_another_code_is_refused_or_judged() {
    let folder = tempfile::tempdir().unwrap();
    super::mpm_verify(&["run", "cook", "--out", folder.path().to_str().unwrap()]);
    let manifest = folder.path().join("score.json");
    let of = |particles: &str| {
        format!(
            "{{\"schema\": 1, \"code\": {{\"name\": \"another\"}}, \"scheme\": \"GIMP\", \"case\": \"cook\", \"level\": \"h2\", \
             \"parameters\": {{\"load\": 1.0, \"load_at\": \"column\"}}, \"particles\": \"{particles}\", \
             \"series\": \"series.csv\", \"cost\": {{\"cpu_s\": 1.5}}}}"
        )
    };
    let score = || {
        if let Ok(scored) = Scores::read(folder.path()) {
            let ours = scored::beside(&scored).unwrap();
            assert!(!scored::text(&scored, &ours).replace("\x1b[", "").contains('\x1b'));
        }
    };
    fs::write(&manifest, of("particles.csv")).unwrap();
    assert!(Scores::read(folder.path()).is_ok());
    damage("manifest of a result", &manifest, |_| score());
    damage("tables of a result", &folder.path().join("particles.csv"), |_| score());
    fs::write(&manifest, of("particles.vtu")).unwrap();
    assert!(Scores::read(folder.path()).is_ok());
    damage("grid of a result", &folder.path().join("particles.vtu"), |_| score());
}

#[test]
fn a_parameter_is_refused_or_within_its_range() {
    let names: Vec<(usize, usize)> =
        cases::all().iter().enumerate().flat_map(|(c, case)| (0..case.parameters.len()).map(move |p| (c, p))).collect();
    let text = prop_oneof![
        "[-+]?[0-9]{0,4}[.]?[0-9]{0,4}(e[-+]?[0-9]{1,3})?",
        "\\PC{0,12}",
        select(vec!["nan", "inf", "-inf", "-0", "1e-400", "true", "1_000", "0x10", " 1", "½", "1e", "."])
            .prop_map(str::to_owned),
    ];
    check("parameters", &(select(names), text), |((c, p), text)| {
        let case = &cases::all()[*c];
        let parameter = &case.parameters[*p];
        let set = [format!("{}={text}", parameter.name)];
        if Parameters::new(&case.parameters, &set).is_ok()
            && let Ok(Value::Number(x)) = parameter.parse(text)
        {
            assert!(x.is_finite() && !(x == 0.0 && x.is_sign_negative()), "{text}");
        }
    });
}

#[test]
fn a_command_line_is_read_or_refused() {
    let words = "run verify report bless list explain diff keep exact bench score export cook column --out --set --level --shard 1/2 \
        --threads 1 --tier quick --resume --scheme --basis gimp gimp-none-flip --json --quiet --reason --allow --night \
        --commit --at --time --help - -- = load=1 --golden";
    let words: Vec<&str> = words.split_whitespace().chain([""]).collect();
    let word = prop_oneof![
        4 => select(words).prop_map(str::to_owned),
        1 => "\\PC{0,8}",
        1 => "[-a-z=/0-9]{0,12}",
    ];
    check("command line", &vec(word, 0..9), |words: &Vec<String>| {
        let program = std::iter::once("mpm-verify".to_owned());
        let _ = Cli::try_parse_from(program.chain(words.iter().cloned()));
    });
}

#[test]
fn a_damaged_scene_file_ends_the_program_in_one_message() {
    let folder = tempfile::tempdir().unwrap();
    let [path, out] = ["own.toml", "out"].map(|name| folder.path().join(name));
    fs::copy(workspace().join("mpm-verify/scenes/slope.toml"), &path).unwrap();
    damage("scene file", &path, |_| {
        if SceneFile::read(&path, 1.0, Some(1e7)).is_err() {
            let ended = super::mpm_verify(&["scene", text(&path), "--memory", "0.0093", "--out", text(&out)]);
            let said = stderr(&ended);
            let one = said.starts_with("error: ") && said.lines().count() == 1;
            assert!(code(&ended) == 2 && one && !out.exists(), "{said}");
        }
    });
}

/// The figures of the page are those of these tests.
#[test]
fn the_page_tells_what_is_tried() {
    let mut table = "| what is damaged | inputs in the tests | panics, hangs, passes |\n|---|---|---|\n".to_owned();
    for (family, share) in FAMILIES {
        table += &format!("| {family} | {} | 0 |\n", INPUTS * share / 100);
    }
    assert_eq!(FAMILIES.iter().map(|(_, share)| share).sum::<usize>(), 100);
    let page = fs::read_to_string(workspace().join("docs/reliability.md")).unwrap();
    assert!(page.contains(&table), "docs/reliability.md lacks:\n{table}");
}
