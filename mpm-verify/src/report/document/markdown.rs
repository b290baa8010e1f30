//! Documents in Markdown.

use super::{Block, Cell, Document, Row, Shown, Span, Table, Text};
use crate::table::Sheet;

impl Document {
    pub(in crate::report) fn markdown(&self) -> String {
        let blocks: Vec<String> = self.blocks.iter().map(Block::markdown).collect();
        blocks.join("\n")
    }
}

impl Block {
    fn markdown(&self) -> String {
        match self {
            Self::Heading { level, text, .. } => {
                format!("{} {}\n", "#".repeat(*level), text.markdown())
            }
            Self::Paragraph { text, .. } => text.markdown() + "\n",
            Self::Table { table, .. } => table.markdown(),
            Self::Picture { picture: Shown { file, caption, .. } } => format!("![{caption}]({file})\n"),
            Self::Drawing { caption, .. } => format!("{caption}\n"),
            Self::List { items } => items.iter().map(|item| format!("- {}\n", item.markdown())).collect(),
            Self::Facts { facts } => facts.iter().map(|[name, value]| format!("- {name}: {value}\n")).collect(),
            Self::Folded { summary, blocks, .. } => {
                let blocks: Vec<String> = blocks.iter().map(Self::markdown).collect();
                format!("### {summary}\n\n{}", blocks.join("\n"))
            }
        }
    }
}

impl Text {
    pub(in crate::report) fn markdown(&self) -> String {
        let span = |Span { kind, text, to }: &Span| match *kind {
            "code" => format!("`{text}`"),
            "strong" => format!("**{text}**"),
            "link" => format!("[{text}]({to})"),
            "image" => format!("![{text}]({to})"),
            "break" => "  \n".to_owned(),
            _ => text.replace('&', "&amp;").replace('<', "&lt;"),
        };
        self.0.iter().map(span).collect()
    }
}

impl Table {
    pub(in crate::report) fn markdown(&self) -> String {
        let text = |cell: &Cell| cell.text.markdown().replace('\n', " ") + &cell.aside;
        let row = |row: &Row| row.cells.iter().map(text).collect();
        Sheet::new(self.head.iter().map(text)).with(self.rows.iter().map(row)).markdown()
    }
}
