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

/// The anchor of a heading.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || " -_\u{304}".contains(*c);
    heading.trim_start_matches('#').trim().chars().filter(kept).collect::<String>().to_lowercase().replace(' ', "-")
}

#[test]
fn every_link_of_the_documents_leads_somewhere() {
    let mut lost = Vec::new();
    for file in documents() {
        let text = read(&file);
        let folder = std::path::Path::new(&file).parent().unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (target, part) = link.split_once('#').unwrap_or((link, ""));
            let page = if target.is_empty() { file.clone() } else { folder.join(target).display().to_string() };
            let path = super::workspace().join(&page);
            let has_part = || part.is_empty() || read(&page).lines().any(|l| l.starts_with('#') && anchor(l) == part);
            if !(target.starts_with("http") || path.exists() && has_part()) {
                lost.push(format!("{file}: {link}"));
            }
        }
    }
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

/// Rust of the pages stands in an example, line by line, which is compiled.
#[test]
fn every_snippet_is_compiled() {
    let lines = |text: &str| text.lines().map(str::trim).collect::<Vec<_>>().join("\n");
    let examples = ["mpm-core/examples/block.rs", "mpm-verify/examples/own_remedy.rs"].map(|file| lines(&read(file)));
    let mut snippets = 0;
    for file in documents() {
        for snippet in read(&file).split("```rust\n").skip(1).filter_map(|rest| rest.split("```").next()) {
            snippets += 1;
            assert!(examples.iter().any(|e| e.contains(lines(snippet).trim())), "{file}: {snippet}");
        }
    }
    assert!(snippets >= 3);
}

/// Pages that list the items of a trait end with a link to its source.
#[test]
fn every_item_of_a_trait_that_a_page_lists_is_there() {
    let mut items = 0;
    for file in ["law", "basis", "remedy"].map(|name| format!("docs/how-to/add-a-{name}.md")) {
        let page = read(&file);
        let source = read(&format!("docs/how-to/{}", page.trim_end().rsplit(' ').next().unwrap()));
        for row in page.lines().filter_map(|l| l.trim_start().strip_prefix("| `")) {
            let name = row.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
            items += 1;
            let is_there = ["fn", "const", "type"].iter().any(|kind| source.contains(&format!("{kind} {name}")));
            assert!(is_there, "{file}: {name}");
        }
    }
    assert!(items > 15);
}

/// Words of README and docs, without notes.
#[test]
fn the_documents_are_short() {
    let is_counted =
        |file: &String| file == "README.md" || file.starts_with("docs/") && !file.starts_with("docs/notes/");
    let text: String = documents().iter().filter(|file| is_counted(file)).map(|file| read(file)).collect();
    let lines = text.lines().map(without_comments);
    let words: usize = lines.map(|l| l.split_whitespace().filter(|w| w.contains(char::is_alphanumeric)).count()).sum();
    assert!(words <= 45_000, "{words} words");
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

/// Tables can't be broken.
#[test]
fn lines_of_the_documents_are_short() {
    for file in documents() {
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
            let links = text.split("![").skip(1).filter_map(|rest| rest.lines().next()?.split("](").nth(1));
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
    let drawn: std::collections::BTreeSet<_> = mpm_verify::report::shown::files().collect();
    assert_eq!(shown, drawn);
}
