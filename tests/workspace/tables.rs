//! The tables of README and docs are those of the results that are kept.

use super::{code, copy_tree, mpm_verify, stdout, text, workspace};
use std::fs;

#[test]
fn no_page_shows_a_table_that_the_kept_results_do_not_give() {
    let check = mpm_verify(&["tables", "--check", "--root", text(&workspace())]);
    assert_eq!(code(&check), 0, "fill them with `just tables`:\n{}", stdout(&check));
}

#[test]
fn a_changed_digit_is_named_and_filling_mends_it() {
    let root = tempfile::tempdir().unwrap();
    let place = |file: &str| root.path().join(file);
    for folder in ["docs", "reports/nightly", "mpm-verify/codes"] {
        copy_tree(&workspace().join(folder), &place(folder));
    }
    fs::copy(workspace().join("README.md"), place("README.md")).unwrap();
    let page = fs::read_to_string(place("docs/results.md")).unwrap();
    let (before, table) = page.split_once("<!-- table slope -->").unwrap();
    let wrong = table.replacen("2.96", "2.97", 1);
    assert_ne!(table, wrong);
    fs::write(place("docs/results.md"), format!("{before}<!-- table slope -->{wrong}")).unwrap();
    let tables = |options: &[&str]| mpm_verify(&[&["tables", "--root", text(root.path())], options].concat());
    let stale = tables(&["--check"]);
    assert_eq!(code(&stale), 1);
    assert!(stdout(&stale).contains("docs/results.md: slope stale\n"), "{}", stdout(&stale));
    assert_ne!(fs::read_to_string(place("docs/results.md")).unwrap(), page);
    assert_eq!(code(&tables(&[])), 0);
    assert_eq!(fs::read_to_string(place("docs/results.md")).unwrap(), page);
}
