//! Which sources determine the numbers of a record; shared by `build.rs` and the tests of the workspace.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// Where they lie, from this package's folder: what computes, and not what judges, reports or draws.
pub(crate) const SOURCES: [&str; 21] = [
    "../.cargo/config.toml",
    "../Cargo.lock",
    "../Cargo.toml",
    "../mpm-core/Cargo.toml",
    "../mpm-core/src",
    "Cargo.toml",
    "exact/Cargo.toml",
    "exact/references",
    "exact/src",
    "references",
    "solvers/Cargo.toml",
    "solvers/src",
    "surfaces/Cargo.toml",
    "surfaces/src",
    CASES,
    "src/cases/manufactured/mod.rs",
    "src/job.rs",
    "src/probe.rs",
    "src/run",
    "src/spec.rs",
    "src/statistics.rs",
];

/// The problems.
const CASES: &str = "src/cases";

/// Files and folders of a case that judge, plan, say or draw. `mod` has its parameters, which a record keeps; every other
/// name determines numbers.
const WORDING: [&str; 10] =
    ["checks", "family", "figures", "foreign", "metrics", "mod", "pictures", "sketch", "tables", "tests"];

/// Whether a source determines numbers, by where it lies and the names of its file and folders.
pub(crate) fn makes_numbers(source: &Path) -> bool {
    let Ok(place) = source.strip_prefix(CASES) else {
        return true;
    };
    let stem = place.with_extension("");
    !stem.iter().any(|name| WORDING.iter().any(|word| name == *word))
}

/// Adds `path`, or the files below it that determine numbers.
pub(crate) fn list(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        files.push(path.to_path_buf());
        return Ok(());
    }
    for entry in fs::read_dir(path)? {
        let inner = entry?.path();
        if makes_numbers(&inner) {
            list(&inner, files)?;
        }
    }
    Ok(())
}
