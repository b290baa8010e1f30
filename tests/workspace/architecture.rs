//! The order of the modules, and what the fingerprint of the sources covers.

#[path = "../../mpm-verify/sources.rs"]
mod sources;

use crate::{files, workspace};
use sources::{SOURCES, list};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The module at the top of a crate that a source belongs to: the first name of its path.
fn module(source: &Path) -> String {
    let stem = source.with_extension("");
    stem.iter().next().unwrap().to_string_lossy().into_owned()
}

/// Which modules at the top of a crate use which others. Tests at a file's end, and comments, are left out.
fn arrows(krate: &str) -> Arrows {
    let sources = files(&workspace().join(krate).join("src"));
    let modules: BTreeSet<String> = sources.keys().map(|s| module(s)).collect();
    let mut arrows = Arrows::new();
    for (source, text) in &sources {
        let own = module(source);
        if ["lib", "main", "tests", "fixture"].contains(&&*own) {
            continue;
        }
        let text = String::from_utf8_lossy(text);
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
        let lines = code.lines().filter(|l| !l.trim_start().starts_with("//"));
        let up = "super::".repeat(source.components().count());
        for line in lines {
            let used = line.split("crate::").skip(1);
            for path in used.chain(line.split(&up).skip(1)) {
                let end = path.find(|c: char| !c.is_alphanumeric() && c != '_');
                let name = &path[..end.unwrap_or(path.len())];
                if name != own && modules.contains(name) {
                    let of_own = arrows.entry(own.clone()).or_default();
                    of_own.insert(name.to_owned());
                }
            }
        }
    }
    arrows
}

/// Modules that can't be put in an order in which each uses earlier ones only.
fn circles(mut arrows: Arrows) -> Arrows {
    loop {
        let left: BTreeSet<String> = arrows.keys().cloned().collect();
        for used in arrows.values_mut() {
            used.retain(|name| left.contains(name));
        }
        arrows.retain(|_, used| !used.is_empty());
        if arrows.len() == left.len() {
            return arrows;
        }
    }
}

#[test]
fn no_module_uses_one_that_uses_it() {
    for krate in [
        "mpm-core",
        "mpm-verify/bench",
        "mpm-verify/exact",
        "mpm-verify",
    ] {
        let arrows = arrows(krate);
        assert!(!arrows.is_empty(), "{krate}");
        assert_eq!(circles(arrows), Arrows::new(), "{krate}");
    }
}

#[test]
fn the_fingerprint_covers_what_makes_numbers_and_not_what_judges_or_draws() {
    let mut covered = Vec::new();
    for source in SOURCES {
        assert!(Path::new(source).exists(), "{source}");
        list(Path::new(source), &mut covered).unwrap();
    }
    let has = |file: &str| covered.iter().any(|f| f.ends_with(file));
    for file in [
        "cook/scene.rs",
        "cook/watch.rs",
        "exact/src/twist.rs",
        "src/basis/mod.rs",
    ] {
        assert!(has(file), "{file}");
    }
    for file in ["checks.rs", "checks/study.rs", "pictures.rs", "sketch.rs"] {
        assert!(!has(file), "{file}");
    }
}

/// A body without water carries nothing of it: no source but those of that solver knows a pore, and neither particles nor a
/// scene have a column or part for it.
#[test]
fn a_dry_body_carries_no_water() {
    let sources = files(&workspace().join("mpm-core").join("src"));
    let mut own = 0;
    for (source, text) in &sources {
        let text = String::from_utf8_lossy(text);
        if source.starts_with("poro") {
            own += 1;
        } else if source != Path::new("lib.rs") {
            assert!(!text.contains("poro::"), "{}", source.display());
        }
    }
    assert!(own > 0);
    for dry in [
        "particles.rs",
        "scene.rs",
        "body.rs",
        "nodes.rs",
        "explicit/mod.rs",
    ] {
        let text = String::from_utf8_lossy(&sources[Path::new(dry)]).to_lowercase();
        let code = text.lines().filter(|l| !l.trim_start().starts_with("//"));
        for line in code.filter(|l| !l.contains("field::")) {
            assert!(
                !line.contains("pore") && !line.contains("porosity"),
                "{dry}: {line}"
            );
        }
    }
}

/// What makes the results that are kept is one toolchain, and new enough for the packages.
#[test]
fn the_workflows_pin_one_toolchain() {
    let value = |file: &str, name: &str| {
        let text = std::fs::read_to_string(workspace().join(file)).unwrap();
        let mut found = text.lines().filter_map(|l| l.trim().strip_prefix(name));
        let version = found.next().unwrap().trim_matches('"').split('.');
        version.map(|n| n.parse().unwrap()).collect::<Vec<u32>>()
    };
    let [pr, nightly] = ["pr", "nightly"]
        .map(|w| value(&format!(".github/workflows/{w}.yml"), "RUSTUP_TOOLCHAIN: "));
    assert_eq!(pr, nightly);
    assert!(pr >= value("Cargo.toml", "rust-version = "));
}
