//! The README tells the truth: its commands are those that continuous integration runs.

fn read(file: &str) -> String {
    let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap()
}

#[test]
fn the_commands_of_the_readme_are_run_by_continuous_integration() {
    let readme = read("README.md");
    let ci = read(".ci/run");
    for command in [
        "cargo run --release -- verify",
        "cargo test --release --workspace",
    ] {
        assert!(
            readme.lines().any(|l| l.trim() == command),
            "README lacks: {command}"
        );
        assert!(
            ci.lines().any(|l| l.trim() == command),
            ".ci/run lacks: {command}"
        );
    }
}

#[test]
fn every_link_of_the_documents_leads_somewhere() {
    for file in [
        "README.md",
        "ARCHITECTURE.md",
        "docs/method.md",
        "docs/cook.md",
    ] {
        let text = read(file);
        let folder = std::path::Path::new(file).parent().unwrap();
        for target in text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split([')', '#']).next())
        {
            if target.starts_with("http") || target.is_empty() {
                continue;
            }
            let path = format!(
                "{}/../{}",
                env!("CARGO_MANIFEST_DIR"),
                folder.join(target).display()
            );
            assert!(
                std::path::Path::new(&path).exists(),
                "{file} links to {target}"
            );
        }
    }
}
