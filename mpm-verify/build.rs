//! Fingerprint of the sources that determine the numbers of a record, so that records of different
//! programs are never mixed.

use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Where they lie, from this package's folder: all but what only draws and prints.
const SOURCES: [&str; 21] = [
    "../.cargo/config.toml",
    "../Cargo.lock",
    "../Cargo.toml",
    "../mpm-core/Cargo.toml",
    "../mpm-core/src",
    "Cargo.toml",
    "references",
    "solvers/Cargo.toml",
    "solvers/src",
    "src/case.rs",
    "src/cases",
    "src/checkpoint.rs",
    "src/exact",
    "src/parameter.rs",
    "src/probe.rs",
    "src/record.rs",
    "src/run.rs",
    "src/series.rs",
    "src/sketch.rs",
    "src/statistics.rs",
    "src/study.rs",
];

fn main() -> io::Result<()> {
    let mut files = Vec::new();
    for source in SOURCES {
        println!("cargo:rerun-if-changed={source}");
        list(Path::new(source), &mut files)?;
    }
    files.sort();
    let mut digest = Sha256::new();
    for file in files {
        digest.update(file.to_string_lossy().as_bytes());
        digest.update(fs::read(file)?);
    }
    let fingerprint: String = digest.finalize()[..6]
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect();
    println!("cargo:rustc-env=MPM_SOURCE_FINGERPRINT={fingerprint}");
    println!("cargo:rerun-if-changed=build.rs");
    Ok(())
}

fn list(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            list(&entry?.path(), files)?;
        }
    } else {
        files.push(path.to_path_buf());
    }
    Ok(())
}
