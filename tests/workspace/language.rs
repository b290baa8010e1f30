//! Language of comments, messages and pages: plain technical English, without the phrases refused here.

use super::{files, workspace};
use mpm_verify::cases;
use std::path::{Path, PathBuf};

/// Files and folders of prose.
const PLACES: &str = "mpm-core mpm-verify tests docs scripts .ci justfile golden/README.md README.md ARCHITECTURE.md \
                      CHANGELOG.md CONTRIBUTING.md";
/// Stand-ins for a reference, a quantity or a negation that should be named.
const PHRASES: [&str; 6] = ["likewise", "so many", "so often", "but for", "is none", "is told"];

/// Whether a file is of comments, messages or pages.
fn is_prose(file: &str) -> bool {
    let extension = Path::new(file).extension().and_then(|e| e.to_str());
    let script = file == "justfile" || [".ci/", "scripts/"].iter().any(|folder| file.starts_with(folder));
    file != "tests/workspace/language.rs" && (script || matches!(extension, Some("rs" | "md")))
}

/// The refused phrase of a line.
fn refused(line: &str, file: &str) -> Option<&'static str> {
    let words = line.split_whitespace().map(|word| word.trim_matches(|c| ".,;:?!()\"*`|".contains(c)));
    let words = format!(" {} ", words.collect::<Vec<_>>().join(" "));
    let start = line.trim_start();
    let title = ["/// What ", "//! What "].iter().any(|mark| start.starts_with(mark))
        || file.ends_with(".md") && start.starts_with('#') && start.trim_start_matches('#').starts_with(" What ");
    match title {
        true => Some("What …"),
        false if words.contains(" Of ") && !words.contains(" Of = ") => Some("Of …"),
        false => PHRASES.into_iter().find(|phrase| words.to_lowercase().contains(&format!(" {phrase} "))),
    }
}

#[test]
fn sentences_name_their_subject_and_quantity() {
    let mut found = Vec::new();
    for place in PLACES.split_whitespace() {
        let root = workspace().join(place);
        let all = match root.is_file() {
            true => [(PathBuf::new(), std::fs::read(&root).unwrap())].into(),
            false => files(&root),
        };
        for (file, text) in all {
            let file = Path::new(place).join(file).display().to_string().trim_end_matches('/').to_owned();
            let text = String::from_utf8_lossy(&text).into_owned();
            let lines = text.lines().enumerate().filter(|_| is_prose(&file));
            let bad = lines.filter_map(|(k, line)| Some((k + 1, refused(line, &file)?)));
            found.extend(bad.map(|(line, phrase)| format!("{file}:{line}: \"{phrase}\"")));
        }
    }
    assert!(found.is_empty(), "{} phrases to replace:\n{}", found.len(), found.join("\n"));
}

/// Symbols and numbers are no words.
#[test]
fn statements_of_checks_are_short() {
    let is_word = |text: &&str| text.chars().filter(|c| c.is_alphabetic()).count() > 1;
    let is_long = |text: &str| text.split_whitespace().filter(is_word).count() > 25;
    for case in cases::all() {
        let long: Vec<_> = case.checks.iter().filter(|c| is_long(c.statement)).map(|c| c.name).collect();
        assert!(long.is_empty(), "{}: {long:?}", case.name);
    }
}
