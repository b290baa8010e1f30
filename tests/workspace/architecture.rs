//! The order of the modules, and what the fingerprint of the sources covers.

#[path = "../../mpm-verify/sources.rs"]
mod sources;

use crate::{files, workspace};
use sources::{SOURCES, list};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// Names of a module, from the root of its crate.
type Names = Vec<String>;

/// Module of a source.
fn module(source: &Path) -> Names {
    let stem = source.with_extension("");
    let mut names: Names = stem.iter().map(|n| n.to_string_lossy().into()).collect();
    names.pop_if(|last| ["mod", "lib"].contains(&&**last));
    names
}

/// Reads one path, or a tree of paths in braces, at the start of `text`: every path that it stands for is appended to
/// `found`, after `prefix`. Returns the text behind it.
fn read_paths<'a>(text: &'a str, prefix: &Names, found: &mut Vec<Names>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut inner) = text.strip_prefix('{') {
        loop {
            inner = inner.trim_start_matches(|c: char| c == ',' || c.is_whitespace());
            match inner.strip_prefix('}') {
                Some(behind) => return behind,
                None if inner.is_empty() => return inner,
                None => {}
            }
            let behind = read_paths(inner, prefix, found);
            // A name may be followed by `as` and another.
            let end = behind.find([',', '{', '}']).unwrap_or(behind.len());
            inner = if behind.len() < inner.len() { &behind[end..] } else { "" };
        }
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    let (name, behind) = text.split_at(end.unwrap_or(text.len()));
    let mut path = prefix.clone();
    match name {
        "self" => {}
        "super" => drop(path.pop()),
        _ => path.push(name.to_owned()),
    }
    match behind.strip_prefix("::") {
        Some(rest) => read_paths(rest, &path, found),
        None => {
            found.push(path);
            behind
        }
    }
}

/// Code of a source without its comments and the tests at its end.
fn code(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    let code = text.split("\nmod tests").next().unwrap();
    let lines = code.lines().filter(|l| !l.trim_start().starts_with("//"));
    lines.fold(String::new(), |code, line| code + line + "\n")
}

/// Paths in the `code` of a module that begin at the root of its crate or at a module around it.
fn paths(module: &Names, code: &str) -> Vec<Names> {
    let mut found = Vec::new();
    for (start, parents) in [("crate::", 0), ("super::", 1)] {
        let outside = &module[..module.len().saturating_sub(parents)];
        let prefix = if parents == 0 { Names::new() } else { outside.to_vec() };
        let mut rest = code;
        while let Some(at) = rest.find(start) {
            rest = read_paths(&rest[at + start.len()..], &prefix, &mut found);
        }
    }
    found
}

/// Where the names come from that a module makes its own by `pub use`.
fn origins(code: &str) -> BTreeMap<String, String> {
    let mut found = Vec::new();
    for part in code.split("\npub use ").chain(code.split("\npub(crate) use ")).skip(1) {
        read_paths(part, &Names::new(), &mut found);
    }
    let pairs = found.into_iter().filter(|path| path.len() > 1);
    pairs.map(|path| (path[path.len() - 1].clone(), path[0].clone())).collect()
}

/// Which modules of each folder of a crate use which others of it, themselves or by what lies below them. What a folder
/// itself defines, and its own use of what it holds, is no arrow.
fn arrows(krate: &str) -> BTreeMap<Names, Arrows> {
    let sources = files(&workspace().join(krate).join("src"));
    let modules: BTreeMap<Names, String> =
        (sources.iter()).map(|(source, text)| (module(source), code(text))).collect();
    let known: BTreeSet<&[String]> =
        (modules.keys()).flat_map(|names| (0..=names.len()).map(|end| &names[..end])).collect();
    let mut arrows: BTreeMap<Names, Arrows> = BTreeMap::new();
    for (own, code) in &modules {
        let apart = ["main", "tests", "fixture"];
        if own.iter().any(|name| apart.contains(&&**name)) {
            continue;
        }
        for path in paths(own, code) {
            let same = own.iter().zip(&path).take_while(|(a, b)| a == b).count();
            let (folder, [of_own, ..], [name, ..]) = (&own[..same], &own[same..], &path[same..]) else {
                continue;
            };
            let module_of_name = [folder, std::slice::from_ref(name)].concat();
            let used = if known.contains(&module_of_name[..]) {
                name.clone()
            } else {
                let folder = modules.get(folder);
                let origin = folder.and_then(|code| origins(code).remove(name));
                match origin.filter(|origin| origin != of_own) {
                    Some(origin) => origin,
                    None => continue,
                }
            };
            let of_folder = arrows.entry(folder.to_vec()).or_default();
            of_folder.entry(of_own.clone()).or_default().insert(used);
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
    for krate in ["mpm-core", "mpm-verify/bench", "mpm-verify/exact", "mpm-verify"] {
        let arrows = arrows(krate);
        assert!(!arrows.is_empty(), "{krate}");
        for (folder, arrows) in arrows {
            assert_eq!(circles(arrows), Arrows::new(), "{krate}: {}", folder.join("/"));
        }
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
    for file in ["cook/run.rs", "cook/reference.rs", "exact/src/twist.rs", "src/basis/mod.rs"] {
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
    for dry in ["particles.rs", "scene.rs", "bodies.rs", "nodes.rs", "explicit/mod.rs"] {
        let text = String::from_utf8_lossy(&sources[Path::new(dry)]).to_lowercase();
        let code = text.lines().filter(|l| !l.trim_start().starts_with("//"));
        for line in code.filter(|l| !l.contains("field::")) {
            assert!(!line.contains("pore") && !line.contains("porosity"), "{dry}: {line}");
        }
    }
}

/// The kept results are made by one toolchain, new enough for the packages.
#[test]
fn the_workflows_pin_one_toolchain() {
    let value = |file: &str, name: &str| {
        let text = std::fs::read_to_string(workspace().join(file)).unwrap();
        let mut found = text.lines().filter_map(|l| l.trim().strip_prefix(name));
        let version = found.next().unwrap().trim_matches('"').split('.');
        version.map(|n| n.parse().unwrap()).collect::<Vec<u32>>()
    };
    let [pr, nightly] = ["pr", "nightly"].map(|w| value(&format!(".github/workflows/{w}.yml"), "RUSTUP_TOOLCHAIN: "));
    assert_eq!(pr, nightly);
    assert!(pr >= value("Cargo.toml", "rust-version = "));
}
