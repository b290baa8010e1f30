//! The report in a browser: no error, every picture loads, every link leads somewhere, and it fits a
//! phone. Skipped where there is no Chromium or Chrome.

use super::{copy_tree, quick, stderr, stdout};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Put into a copy of a page, before all else: tells the page around it what it found, under its name.
const PROBE: &str = r#"<head><script>
const found = [];
addEventListener("error", e => found.push("fault error: " + (e.message || e.target.outerHTML)), true);
addEventListener("load", () => {
  for (const image of document.images)
    found.push((image.naturalWidth > 0 ? "picture " : "fault no picture: ") + image.getAttribute("src"));
  for (const a of document.querySelectorAll("a[href]")) found.push("link " + a.getAttribute("href"));
  for (const e of document.querySelectorAll("[id]")) found.push("id " + e.id);
  const width = document.documentElement.scrollWidth;
  if (width > innerWidth) found.push("fault scrolls: " + width + " in " + innerWidth);
  parent.postMessage([name].concat(found).join("\n"), "*");
});
</script>"#;

/// Page around the copies, each in a phone: the window itself can't be as narrow. It writes down the messages it gets.
const PHONES: &str = r#"<!DOCTYPE html><script>
addEventListener("message", e => {
  document.body.append("\nbegin " + e.data + "\nend\n");
});
</script><body>"#;

fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROME").map(PathBuf::from);
    named.or_else(|| {
        let path = std::env::var_os("PATH")?;
        ["chromium", "chromium-browser", "google-chrome"]
            .iter()
            .flat_map(|name| std::env::split_paths(&path).map(move |folder| folder.join(name)))
            .find(|file| file.is_file())
    })
}

/// Findings of the browser on pages of a folder, line by line: `fault …`, `picture …`, `link …`, `id …`.
fn look_at(browser: &Path, folder: &Path, pages: &[String]) -> Vec<Vec<String>> {
    let mut phones = PHONES.to_owned();
    for page in pages {
        let text = std::fs::read_to_string(folder.join(page)).unwrap();
        let probe = PROBE.replacen("const found", &format!("const name = {page:?}, found"), 1);
        let copy = format!("probed-{page}");
        std::fs::write(folder.join(&copy), text.replacen("<head>", &probe, 1)).unwrap();
        phones += &format!(r#"<iframe src="{copy}" width="400" height="800"></iframe>"#);
    }
    std::fs::write(folder.join("phones.html"), phones).unwrap();
    let profile = tempfile::tempdir().unwrap();
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu"])
        .args(["--no-first-run", "--disable-background-networking"])
        .args(["--disable-component-update", "--disable-sync"])
        .args(["--virtual-time-budget=20000", "--dump-dom"])
        .args(["--enable-logging=stderr", "--v=0"])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}/phones.html", folder.display()))
        .output()
        .expect("the browser starts");
    let dom = stdout(&output);
    let console = stderr(&output);
    let found = |page: &String| {
        let told = dom
            .split_once(&format!("\nbegin {page}"))
            .and_then(|(_, rest)| rest.split_once("\nend\n"))
            .unwrap_or_else(|| panic!("{page} did not load: {dom}"));
        let of_page = format!("/probed-{page}");
        let errors = console
            .lines()
            .filter(|l| l.contains("CONSOLE"))
            // One that names no page may be of any.
            .filter(|l| l.contains(&of_page) || !l.contains("/probed-"));
        told.0.lines().map(str::to_owned).chain(errors.map(|line| format!("fault console: {line}"))).collect()
    };
    pages.iter().map(found).collect()
}

fn all<'a>(found: &'a [String], kind: &str) -> Vec<&'a str> {
    found.iter().filter_map(|line| line.strip_prefix(kind)?.strip_prefix(' ')).collect()
}

#[test]
fn the_report_works_in_a_browser() {
    let Some(browser) = browser() else {
        // Written past the test harness, which would keep it to itself.
        writeln!(std::io::stderr(), "skipped: no browser").unwrap();
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    copy_tree(quick().0, out);

    let mut pages = ["index.html", "faults.html"].map(str::to_owned).to_vec();
    let cases = super::json(&out.join("summary.json"));
    for study in cases["cases"].as_array().unwrap() {
        pages.push(format!("{}.html", study["case"].as_str().unwrap()));
    }
    let looked = look_at(&browser, out, &pages);
    for (page, found) in pages.iter().zip(&looked) {
        assert!(all(found, "fault").is_empty(), "{page}: {found:?}");
        for target in all(found, "link") {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { page } else { file };
            assert!(out.join(file).is_file(), "{page} links to {target}");
            if let Some(k) = pages.iter().position(|p| p == file) {
                let there = anchor.is_empty() || all(&looked[k], "id").contains(&anchor);
                assert!(there, "{page} links to {target}");
            }
        }
    }
    assert!(all(&looked[2], "picture").len() > 2, "{:?}", looked[2]);

    // What is missing is seen.
    std::fs::remove_file(out.join("cook/rest.png")).unwrap();
    let found = look_at(&browser, out, &["cook.html".to_owned()]).remove(0);
    assert!(all(&found, "fault").iter().any(|f| f.contains("rest.png")));
    let spoken = "<script>console.error('spoken')</script>";
    std::fs::write(out.join("spoken.html"), format!("<head></head>{spoken}")).unwrap();
    std::fs::write(out.join("silent.html"), "<head></head>").unwrap();
    let pages = ["spoken.html", "silent.html"].map(str::to_owned);
    let [spoken, silent] = look_at(&browser, out, &pages).try_into().unwrap();
    assert!(all(&spoken, "fault")[0].contains("spoken"), "{spoken:?}");
    assert!(all(&silent, "fault").is_empty(), "{silent:?}");
}
