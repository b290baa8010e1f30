//! The README tells the truth: its commands are those that continuous integration runs.

use super::{code, copy_tree, golden, quick, stderr, stdout, text};

fn read(file: &str) -> String {
    let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap()
}

#[test]
fn the_commands_of_the_readme_are_run_by_continuous_integration() {
    let readme = read("README.md");
    let ci = read(".ci/run");
    for command in ["cargo run --release -- verify", "cargo test --release"] {
        assert!(readme.lines().any(|l| l.trim() == command), "README lacks: {command}");
        assert!(ci.lines().any(|l| l.trim() == command), ".ci/run lacks: {command}");
    }
}

/// Commands of README and of the documentation's first page: each is run as it stands, in a folder of its own.
#[test]
fn every_command_of_the_first_pages_works() {
    let readme = read("README.md").replace("cargo run --release -- ", "mpm-verify ") + &read("docs/README.md");
    let folder = tempfile::tempdir().unwrap();
    let [report, goldens] = ["report", "golden"].map(|name| folder.path().join(name));
    copy_tree(quick().0, &report);
    copy_tree(&golden(), &goldens);
    let place = text(&report);
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/slope.toml");
    let commands: Vec<&str> = readme
        .lines()
        .filter_map(|line| line.strip_prefix("mpm-verify "))
        .map(|line| line.split('#').next().unwrap().trim())
        .collect();
    assert!(commands.len() >= 7, "{commands:?}");
    // `quick` has run it, and a gate runs the whole tier.
    for command in commands.into_iter().filter(|c| !["verify", "verify --tier quick"].contains(c)) {
        let mut words: Vec<&str> = Vec::new();
        for (k, part) in command.split('"').enumerate() {
            if k % 2 == 1 {
                words.push(part);
            } else {
                words.extend(part.split_whitespace());
            }
        }
        let words = words.into_iter().map(|word| match word {
            "DIR" | "OUT" | "OLD" | "NEW" => place,
            // The level of the example takes ten times as long.
            "h1" => "h2",
            "mpm-verify/scenes/slope.toml" => scene,
            word => word,
        });
        let mut arguments: Vec<&str> = words.collect();
        if arguments[0] == "bless" {
            arguments.extend(["--from", place]);
        }
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
            .args(&arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(code(&output), 0, "{command}: {}{}", stdout(&output), stderr(&output));
    }
}

/// The pages of the repository.
fn documents() -> Vec<String> {
    let root = super::workspace();
    let pages = super::files(&root.join("docs")).into_keys();
    let docs = pages.map(|name| format!("docs/{}", name.display()));
    let at_root = ["README", "ARCHITECTURE", "CHANGELOG", "CONTRIBUTING"];
    let at_root = at_root.map(|name| format!("{name}.md"));
    let all = docs.chain(at_root).chain(["golden/README.md".to_owned()]);
    all.filter(|name| name.ends_with(".md")).collect()
}

#[test]
fn every_link_of_the_documents_leads_somewhere() {
    for file in documents() {
        let text = read(&file);
        let folder = std::path::Path::new(&file).parent().unwrap();
        for target in text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()) {
            if target.starts_with("http") || target.is_empty() {
                continue;
            }
            let path = format!("{}/../{}", env!("CARGO_MANIFEST_DIR"), folder.join(target).display());
            assert!(std::path::Path::new(&path).exists(), "{file} links to {target}");
        }
    }
}

/// A line as it is read: what fills a number is not.
fn without_comments(line: &str) -> String {
    let mut parts = line.split("<!--");
    let before = parts.next().unwrap_or("").to_owned();
    let after = parts.map(|part| part.split_once("-->").map_or(part, |(_, after)| after));
    before + &after.collect::<String>()
}

#[test]
fn the_readme_is_read_in_one_go() {
    let readme = read("README.md");
    let [lines, words] = [readme.lines().count(), readme.split_whitespace().count()];
    assert!(lines <= 80 && words <= 900, "{lines} lines, {words} words");
}

/// Tables can't be broken. Not yet wrapped: the page named here.
#[test]
fn lines_of_the_documents_are_short() {
    let later = ["ARCHITECTURE.md".to_owned()];
    for file in documents().into_iter().filter(|file| !later.contains(file)) {
        let text = read(&file);
        let lines = text.lines().filter(|line| !line.starts_with('|'));
        let lines = lines.map(without_comments);
        let long: Vec<String> = lines.filter(|line| line.chars().count() > 120).collect();
        assert!(long.is_empty(), "{file}: {long:?}");
    }
}

/// A picture that no page shows is weight; one that no command draws can't be made again.
#[test]
fn the_pages_show_the_pictures_that_the_program_draws() {
    let root = super::workspace();
    let pages = super::files(&root.join("docs"));
    let pages = pages.iter().filter(|(name, _)| name.extension().is_some_and(|e| e == "md"));
    let shown: Vec<_> = pages
        .map(|(_, text)| (std::path::Path::new("docs"), String::from_utf8_lossy(text).into_owned()))
        .chain([(std::path::Path::new(""), read("README.md"))])
        .flat_map(|(folder, text)| {
            let links = text.split("![").skip(1).filter_map(|rest| rest.split("](").nth(1));
            let files = links.filter_map(|rest| rest.split(')').next());
            files.map(|file| folder.join(file)).collect::<Vec<_>>()
        })
        .collect();
    // Pictures of goldens are drawn and compared by themselves.
    let (golden, shown): (std::collections::BTreeSet<_>, std::collections::BTreeSet<_>) =
        shown.into_iter().partition(|file: &std::path::PathBuf| file.starts_with("docs/../golden"));
    assert!(golden.iter().all(|file| root.join(file).is_file()), "{golden:?}");
    let there = super::files(&root.join("docs/pictures"));
    let place = std::path::Path::new("docs/pictures");
    assert_eq!(shown, there.into_keys().map(|name| place.join(name)).collect());
    // A chart that waits for the runs of a night may still be there as pixels.
    let plain = |file: std::path::PathBuf| file.with_extension("");
    let drawn: std::collections::BTreeSet<_> = mpm_verify::report::shown::files().map(plain).collect();
    assert_eq!(shown.into_iter().map(plain).collect::<std::collections::BTreeSet<_>>(), drawn);
}
