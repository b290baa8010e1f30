//! Sizes of the house in lines: a change may lower a bound and never raises one.

use crate::{files, workspace};
use std::path::Path;

/// Part, its folder, lines of its tests included or not, and most lines.
const BOUNDS: [(&str, &str, bool, usize); 8] = [
    ("the harness without tests", "mpm-verify/src", false, 45_080),
    ("its cases without tests", "mpm-verify/src/cases", false, 25_720),
    ("its reports without tests", "mpm-verify/src/report", false, 5_050),
    ("its drawing without tests", "mpm-verify/src/draw", false, 2_590),
    ("terzaghi", "mpm-verify/src/cases/terzaghi", true, 500),
    ("the footing", "mpm-verify/src/cases/footing", true, 1_800),
    ("tests of the workspace", "tests/workspace", true, 4_750),
    ("the core", "mpm-core/src", true, 21_200),
];
/// Most lines of a source.
const LONGEST: usize = 500;

/// Lines of a source without the tests at its end.
fn without_tests(text: &str) -> usize {
    let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines().count()
}

fn is_test(source: &Path) -> bool {
    let stem = source.with_extension("");
    stem.iter().any(|name| ["tests", "fixture", "crash", "bite"].iter().any(|own| name == *own))
}

fn lines(folder: &str, with_tests: bool) -> usize {
    let sources = files(&workspace().join(folder));
    let sources = sources.iter().filter(|(source, _)| source.extension().is_some_and(|e| e == "rs"));
    let counted = sources.map(|(source, text)| {
        let text = String::from_utf8_lossy(text);
        match with_tests {
            true => text.lines().count(),
            false if is_test(source) => 0,
            false => without_tests(&text),
        }
    });
    counted.sum()
}

#[test]
fn no_part_grows() {
    for (name, folder, with_tests, most) in BOUNDS {
        let found = lines(folder, with_tests);
        assert!(found <= most, "{name}: {found} lines where {most} are allowed");
    }
}

#[test]
fn no_source_is_longer_than_a_reader_holds() {
    for folder in ["mpm-core", "mpm-verify", "tests"] {
        for (source, text) in files(&workspace().join(folder)) {
            let lines = String::from_utf8_lossy(&text).lines().count();
            let is_source = source.extension().is_some_and(|e| e == "rs");
            assert!(!is_source || lines <= LONGEST, "{folder}/{}: {lines} lines", source.display());
        }
    }
}
