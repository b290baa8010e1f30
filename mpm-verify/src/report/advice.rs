//! Which scheme to take: the table of the README, so that a report begins with it. Its numbers are of the last nights.

use crate::files::read_text;
use crate::table::Sheet;
use std::path::Path;

/// Heading of the section that the table stands in.
const SECTION: &str = "\n## Which scheme to take\n";

/// The table of the checkout that the program was built from, if there is one.
pub(super) fn advice() -> Option<Sheet> {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    table(&read_text(&readme).ok()?)
}

/// The first table of the section. Code keeps its marks, numbers and links leave their text.
fn table(readme: &str) -> Option<Sheet> {
    let (_, section) = readme.split_once(SECTION)?;
    let section = section.split("\n## ").next()?;
    let lines = section.lines().skip_while(|line| !line.starts_with('|'));
    let lines = lines.take_while(|line| line.starts_with('|'));
    let mut rows = lines.map(|line| {
        let inner = line.trim_matches('|').split('|');
        inner.map(|cell| plain(cell.trim())).collect::<Vec<_>>()
    });
    let head = rows.next()?;
    Some(Sheet::new(head).with(rows.skip(1)))
}

/// Text without comments and targets of links.
fn plain(cell: &str) -> String {
    let mut text = String::new();
    let mut rest = cell;
    while let Some((before, comment)) = rest.split_once("<!--") {
        text += before;
        rest = comment.split_once("-->").map_or("", |(_, after)| after);
    }
    text += rest;
    while let Some((before, (label, after))) = link(&text) {
        text = format!("{before}{label}{after}");
    }
    text
}

/// What is before the first link, its label, and what is behind it.
fn link(text: &str) -> Option<(&str, (&str, &str))> {
    let (label, rest) = text.split_once("](")?;
    let (before, label) = label.rsplit_once('[')?;
    Some((before, (label, rest.split_once(')')?.1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::Scheme;

    #[test]
    fn a_cell_is_its_text() {
        let text = "see [a](b.md) and [c d](e.md#f): <!--= cook x 2-->5.14<!--/--> s, `code`";
        assert_eq!(plain(text), "see a and c d: 5.14 s, `code`");
        for whole in ["", "no link", "x [y", "a](b"] {
            assert_eq!(plain(whole), whole);
        }
    }

    #[test]
    fn the_table_is_that_of_its_section() {
        let readme = "\n|a|\n|-|\n\n## Which scheme to take\n\ntext\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n| c |\n\n## Next\n";
        let sheet = table(readme).unwrap();
        assert_eq!(
            (sheet.head, sheet.rows),
            (
                vec!["a".into(), "b".into()],
                vec![vec!["1".into(), "2".into()]]
            )
        );
        for none in [
            "",
            "\n## Which scheme to take\n",
            "\n## Which scheme to take\n\n## Next\n\n| a |\n",
        ] {
            assert_eq!(table(none), None);
        }
    }

    /// What the README says to take are schemes, each with what it finds and where it fails.
    #[test]
    fn the_readme_names_schemes() {
        let sheet = advice().unwrap();
        assert_eq!(sheet.head.len(), 5);
        assert!(sheet.rows.len() >= 8);
        for row in &sheet.rows {
            let scheme = row[1].trim_matches('`');
            assert!(Scheme::parse(scheme).is_ok(), "{scheme}");
            assert!(
                row.iter()
                    .all(|cell| !cell.is_empty() && !cell.contains("<!--")),
                "{row:?}"
            );
        }
    }
}
