//! Fingerprint of the sources that determine the numbers of a record, so that records of different
//! programs are never mixed.

mod sources;

use sha2::{Digest, Sha256};
use std::path::Path;
use std::{fs, io};

fn main() -> io::Result<()> {
    let mut files = Vec::new();
    for source in sources::SOURCES {
        println!("cargo:rerun-if-changed={source}");
        sources::list(Path::new(source), &mut files)?;
    }
    files.sort();
    let mut digest = Sha256::new();
    for file in files {
        digest.update(file.to_string_lossy().as_bytes());
        digest.update(fs::read(file)?);
    }
    let fingerprint: String = digest.finalize()[..6].iter().map(|b| format!("{b:02x}")).collect();
    println!("cargo:rustc-env=MPM_SOURCE_FINGERPRINT={fingerprint}");
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=sources.rs");
    Ok(())
}
