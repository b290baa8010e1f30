//! Damaged scene files: each is refused in one message that names it, or makes a scene, and soon.
//!
//! `MPM_FUZZ_SCENES` sets how many there are and `MPM_FUZZ_SEED` which; a night takes 50,000.

use super::*;
use std::time::{Duration, Instant};

const INPUTS: usize = 2_000;
/// Memory of a scene (bytes), so that none takes long to build.
const MEMORY: f64 = 2e7;
/// No file is read for longer.
const LONGEST: Duration = Duration::from_secs(5);
/// Values that a reader may stumble over.
const VALUES: [&str; 24] = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-0.0",
    "-1",
    "1e308",
    "1e-308",
    "1e999",
    "99999999999999999999",
    "4294967296",
    "0.1",
    "3",
    "\"\"",
    "\"\\u001b[31m\"",
    "\"../x\"",
    "true",
    "[]",
    "{}",
    "[[]]",
    "[1, 2, 3, 4]",
    "{ x = 1 }",
    "2020-01-01",
    "'",
];

/// A text with some lines removed, doubled, swapped or cut, numbers replaced by other values, or characters by others.
fn damaged(text: &str, random: &mut fastrand::Rng) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..random.usize(1..4) {
        let (k, other) = (random.usize(..lines.len()), random.usize(..lines.len()));
        match random.usize(..10) {
            0 if lines.len() > 1 => drop(lines.remove(k)),
            1 => lines.insert(other, lines[k].clone()),
            2 => lines.swap(k, other),
            3 => lines.truncate(k.max(1)),
            4 => {
                let mut letters: Vec<char> = lines[k].chars().collect();
                let place = random.usize(..=letters.len());
                letters.insert(place, random.char('\u{1}'..'\u{100}'));
                lines[k] = letters.into_iter().collect();
            }
            _ => {
                let is_number = |word: &&str| word.parse::<f64>().is_ok();
                let words: Vec<&str> = lines[k].split([' ', ',', '[', ']', '{', '}']).filter(is_number).collect();
                if let Some(word) = words.get(random.usize(..words.len().max(1))) {
                    lines[k] = lines[k].replacen(*word, VALUES[random.usize(..VALUES.len())], 1);
                }
            }
        }
    }
    lines.join("\n")
}

#[test]
fn damaged_files_are_refused_in_one_message_or_make_a_scene() {
    let set = |name: &str, or: usize| std::env::var(name).map_or(or, |n| n.parse().unwrap());
    let (inputs, seed) = (set("MPM_FUZZ_SCENES", INPUTS), set("MPM_FUZZ_SEED", 1));
    let mut random = fastrand::Rng::with_seed(seed as u64);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    let scenes = std::fs::read_dir(shipped("")).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<PathBuf> = scenes.collect();
    scenes.sort();
    let texts: Vec<String> = scenes.iter().map(|path| std::fs::read_to_string(path).unwrap()).collect();
    let mut refused = 0;
    for k in 0..inputs {
        let text = damaged(&texts[k % texts.len()], &mut random);
        std::fs::write(&path, &text).unwrap();
        let begun = Instant::now();
        let read = std::panic::catch_unwind(|| {
            SceneFile::read(&path, 1.0, Some(MEMORY)).err().map(|e| one_line(&e.to_string()))
        });
        let lasted = begun.elapsed();
        let said = read.unwrap_or_else(|_| panic!("file {k} panics:\n{text}"));
        assert!(lasted < LONGEST, "file {k} is read for {lasted:?}:\n{text}");
        if let Some(said) = said {
            refused += 1;
            let plain = said.contains("own.toml: ") && !said.contains(['\n', '\u{1b}']);
            assert!(plain, "file {k}: {said:?}\n{text}");
        }
    }
    assert!(std::fs::read_dir(folder.path()).unwrap().count() == 1);
    assert!(refused > inputs / 2 && refused < inputs, "{refused} of {inputs} are refused");
}
