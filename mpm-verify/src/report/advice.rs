//! Which scheme to take: the table of the README, so that a report begins with it. Its numbers are of the last nights.

use super::document::{Cell, Row, Table, Text};
use crate::files::read_text;
use std::path::Path;

/// Heading of the section that the table stands in.
const SECTION: &str = "\n## Which scheme to take\n";

/// The table of the checkout that the program was built from, if there is one.
pub(super) fn advice() -> Option<Table> {
    table(&read_text(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md")).ok()?)
}

/// The first table of the section. Code keeps its marks, numbers and links leave their text.
fn table(readme: &str) -> Option<Table> {
    let (_, section) = readme.split_once(SECTION)?;
    let lines = section.split("\n## ").next()?.lines().skip_while(|line| !line.starts_with('|'));
    let mut rows = lines.take_while(|line| line.starts_with('|')).map(|line| {
        let cells = line.trim_matches('|').split('|').enumerate();
        let cell = |(k, cell): (usize, &str)| {
            let text = Text::marked(&without_comments(cell.trim())).unlinked();
            if k == 0 { Cell::head(text) } else { Cell::from(text) }
        };
        Row::from(cells.map(cell).collect::<Vec<_>>())
    });
    let head = rows.next()?.cells;
    Some(Table { class: "prose", head, rows: rows.skip(1).collect() })
}

fn without_comments(cell: &str) -> String {
    let mut parts = cell.split("<!--");
    let first = parts.next().unwrap_or_default().to_owned();
    first + &parts.map(|part| part.split_once("-->").map_or("", |(_, after)| after)).collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::Scheme;

    #[test]
    fn the_table_is_that_of_its_section() {
        let readme = "\n|a|\n|-|\n\n## Which scheme to take\n\ntext\n\n| a | b |\n|---|---|\n| `c` | [d](e.md): <!--= cook 2-->5<!--/--> s |\n\n| f |\n\n## Next\n";
        let markdown = table(readme).unwrap().markdown();
        assert_eq!(markdown, "| a | b |\n|---|---|\n| `c` | d: 5 s |\n");
        let none = "\n## Which scheme to take\n\n## Next\n\n| a |\n";
        assert_eq!(table(none), None);
    }

    /// The README's recommendations are schemes, each with its findings and failures.
    #[test]
    fn the_readme_names_schemes() {
        let markdown = advice().unwrap().markdown();
        let rows: Vec<&str> = markdown.lines().skip(2).collect();
        assert!(rows.len() >= 8);
        for row in rows {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            assert!(cells.len() == 5 && cells.iter().all(|c| !c.is_empty()), "{row}");
            assert!(Scheme::parse(cells[1].trim_matches('`')).is_ok(), "{row}");
            assert!(!row.contains("<!--") && !row.contains("]("), "{row}");
        }
    }
}
